//! Which of the files are a joint log.

use std::fs::File;
use std::io::{self, BufRead, BufReader};
use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};
use stiffarm_gap::log::{Format, Log, Names, Opened};
use stiffarm_gap::measurement::{Layout, Measurements};
use stiffarm_kernels::Motion;

use super::super::Settings;
use crate::host::Host;
use crate::input::data;
use crate::terminal::failure::Failure;

pub enum Files {
    /// A joint log, file by file.
    Log(Vec<Part>),
    Measurements(Vec<Part>),
    /// Measurement files and the log of the same arm.
    Both(Vec<Part>, Vec<Part>),
}

/// A file of a log or of measurements.
pub struct Part {
    pub path: PathBuf,
    opened: Opened,
}

impl Part {
    fn new(path: PathBuf, host: &Host) -> Result<Part, Failure> {
        let opened = match path.is_file() {
            true => Opened::new(&path).map_err(|error| Failure::io("read", &path, &error))?,
            false => Opened::from(host.read(&path)?),
        };
        Ok(Part { opened, path })
    }

    /// Whether it is a table of Parquet, or holds messages.
    pub fn is_no_text(&self) -> bool {
        Format::of(self.opened.head()) != Format::Text
    }

    /// The measurements in it; its bytes go into `hash`. A file on disk is gone through and not held.
    pub fn measurements(
        &self,
        layout: &Layout,
        hash: &mut Sha256,
        host: &Host,
    ) -> Result<Measurements, Failure> {
        if host.is_on_disk(&self.path) {
            let data = data::read(&self.path, layout, host)?;
            hashed(&self.path, hash).map_err(|error| Failure::io("read", &self.path, &error))?;
            return Ok(data);
        }
        let bytes = if self.path.is_file() { &host.read(&self.path)? } else { self.opened.head() };
        hash.update(bytes);
        data::read_bytes(&self.path, bytes, layout, host)
    }
}

fn hashed(path: &Path, hash: &mut Sha256) -> io::Result<()> {
    let mut file = BufReader::with_capacity(1 << 16, File::open(path)?);
    loop {
        let part = file.fill_buf()?;
        if part.is_empty() {
            return Ok(());
        }
        hash.update(part);
        let count = part.len();
        file.consume(count);
    }
}

/// The files that are meant: of a folder, as ROS 2 makes one of a bag, those that hold messages.
pub fn parts(given: &[PathBuf], host: &Host) -> Result<Vec<Part>, Failure> {
    let mut parts = Vec::new();
    for path in given {
        if path.is_dir() {
            let within = messages(path)?;
            if within.is_empty() {
                let message = format!("{}: found a folder without .mcap and .db3", path.display());
                return Err(Failure::new(format!("{message}, expected a file, or a bag of ROS 2")));
            }
            parts.extend(within);
        } else {
            parts.push(path.clone());
        }
    }
    parts.into_iter().map(|path| Part::new(path, host)).collect()
}

fn messages(folder: &Path) -> Result<Vec<PathBuf>, Failure> {
    let wrong = |error| Failure::io("read", folder, &error);
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(wrong)? {
        let path = entry.map_err(wrong)?.path();
        let kind = path.extension().and_then(|end| end.to_str());
        found.extend(matches!(kind, Some("mcap" | "db3")).then_some(path));
    }
    found.sort();
    Ok(found)
}

/// Opens the files, and knows by their columns what they are.
pub fn files(data: &[PathBuf], settings: &Settings, host: &Host) -> Result<Files, Failure> {
    let parts = parts(data, host)?;
    let is_log = |part: &Part| settings.map.is_some() || part.opened.is_log();
    let (of_log, others): (Vec<Part>, Vec<Part>) = parts.into_iter().partition(is_log);
    if !of_log.is_empty() {
        return Ok(match others.is_empty() {
            true => Files::Log(of_log),
            false => Files::Both(others, of_log),
        });
    }
    let refused = |what: String, help| {
        let first = data[0].display();
        Err(Failure::with_help(format!("{what}, and {first} is no joint log by its columns"), help))
    };
    if let Some(option) = settings.first_of(true) {
        let help =
            "a log has t, q1 …, and tau1 …, i1 … or q_cmd1 …; --map says how others call them";
        return refused(format!("{option} is for joint logs"), help);
    }
    Ok(Files::Measurements(others))
}

/// Whether a file is a log by its columns, or a folder of one.
pub fn is_log(path: &Path, host: &Host) -> Result<bool, Failure> {
    Ok(parts(&[path.to_owned()], host)?.iter().any(|part| part.opened.is_log()))
}

/// The log in these files.
pub fn read(parts: Vec<Part>, motions: &[Motion], names: &Names) -> Result<Log, Failure> {
    let mut log: Option<Log> = None;
    for Part { path, opened } in parts {
        let next = Log::from_file(&path, opened, motions, names)?;
        log = Some(match log {
            Some(log) => log.and(next)?,
            None => next,
        });
    }
    log.ok_or_else(|| Failure::new("found no log, expected a file"))
}
