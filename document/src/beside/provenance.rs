//! Of what and how a report was made: the command, the files' hashes, a date.

use serde::Serialize;

/// Of what and how.
#[derive(Clone, Debug, PartialEq)]
pub struct Provenance {
    /// As it was given, words with spaces in quotation marks.
    pub command: String,
    /// What the date is of, and the day.
    pub date: Option<(&'static str, String)>,
    /// Of the files.
    pub hashes: Hashes,
}

/// SHA-256 of the bytes, in hexadecimal digits, as `sha256sum` prints them.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Hashes {
    /// Of the measurement file.
    pub data_sha256: String,
    /// Of the robot file, as it was read.
    pub robot_sha256: String,
}
