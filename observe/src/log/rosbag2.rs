//! Logs in bags of ROS 2 as it stores them in SQLite.

use std::path::Path;

use rusqlite::{Connection, OpenFlags};
use stiffarm_kernels::Motion;

use super::cdr::Encoding;
use super::ros::{Heard, Kind};
use super::{Log, Names, unreadable};
use crate::io::ReadError;

const MESSAGES: &str = "SELECT topics.name, topics.type, topics.serialization_format, messages.data \
    FROM messages JOIN topics ON messages.topic_id = topics.id \
    WHERE topics.type LIKE '%/JointState' OR topics.type LIKE '%/JointTrajectoryControllerState' \
    ORDER BY messages.timestamp, messages.id";

pub(super) fn read(
    file: &str,
    path: &Path,
    motions: &[Motion],
    names: &Names,
) -> Result<Log, ReadError> {
    let heard = heard(path).map_err(|e| unreadable(file, "a bag of ROS 2", e))?;
    heard.log(file, motions, names)
}

fn heard(path: &Path) -> rusqlite::Result<Heard> {
    let mut heard = Heard::default();
    let bag = Connection::open_with_flags(path, OpenFlags::SQLITE_OPEN_READ_ONLY)?;
    let mut messages = bag.prepare(MESSAGES)?;
    let mut rows = messages.query([])?;
    while let Some(row) = rows.next()? {
        let [topic, schema, format] = [0, 1, 2].map(|k| row.get_ref(k));
        let (topic, schema, format) = (topic?.as_str()?, schema?.as_str()?, format?.as_str()?);
        if let (Some(kind), Some(encoding)) = (Kind::of(schema), Encoding::named(format)) {
            heard.push(topic, kind, encoding, row.get_ref(3)?.as_blob()?);
        }
    }
    Ok(heard)
}
