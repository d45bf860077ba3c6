//! A joint log: known by its columns, diagnosed by its rows.

mod files;
mod motion;
mod written;

use std::path::Path;

use stiffarm_gap::io::Map;
use stiffarm_gap::log::Names;

pub use files::{Files, Part, files, is_log, parts, read};
pub use motion::{Motion, Told};

use super::Settings;
use crate::host::Host;
use crate::input::source::{Source, text};
use crate::terminal::failure::Failure;

/// What the columns of a log are called, by its `--map` and `--topic`.
pub fn names(
    [map, topic]: [&Option<String>; 2],
    source: &Source,
    host: &Host,
) -> Result<Names, Failure> {
    let joints = source.robot.joints.iter().map(|joint| joint.name.clone()).collect();
    let own = Names::own(joints);
    let own = match topic {
        Some(topic) => own.of_topic(topic.clone()),
        None => own,
    };
    let Some(map) = map else { return Ok(own) };
    if let Some(names) = own.clone().of_format(map) {
        return Ok(names);
    }
    if !map.contains(['.', '/', '\\']) {
        let known: Vec<&str> = Names::formats().collect();
        let message =
            format!("--map: found `{map}`, expected a file or one of {}", known.join(", "));
        return Err(Failure::new(message));
    }
    Ok(own.mapped(Map::read(map, &text(Path::new(map), host)?)?))
}

impl Settings {
    /// What the columns are called.
    fn names(&self, source: &Source, host: &Host) -> Result<Names, Failure> {
        names([&self.map, &self.topic], source, host)
    }
}
