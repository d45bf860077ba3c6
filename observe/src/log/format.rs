//! What kind of file a log stands in, by its first bytes.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use stiffarm_kernels::Motion;

use super::column::is_log;
use super::{Log, Names, text};
use crate::io::{Fault, ReadError};

/// The kind of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Comma-separated or the like.
    Text,
    /// Columns of numbers (Apache Parquet).
    Parquet,
    /// Messages of ROS (MCAP).
    Mcap,
    /// A bag of ROS 2 (SQLite).
    Rosbag2,
}

/// The first bytes of each kind but text.
const MAGIC: [(&[u8], Format); 3] = [
    (b"PAR1", Format::Parquet),
    (b"\x89MCAP0\r\n", Format::Mcap),
    (b"SQLite format 3\0", Format::Rosbag2),
];

impl Format {
    /// As a sentence has it.
    pub fn words(self) -> &'static str {
        match self {
            Format::Text => "a text",
            Format::Parquet => "a Parquet file",
            Format::Mcap => "an MCAP file",
            Format::Rosbag2 => "a bag of ROS 2",
        }
    }

    /// Of a file that begins so.
    pub fn of(head: &[u8]) -> Format {
        let found = MAGIC.iter().find(|(magic, _)| head.starts_with(magic));
        found.map_or(Format::Text, |(_, format)| *format)
    }
}

/// A file that is open, with its first bytes.
pub struct Opened {
    head: Vec<u8>,
    rest: Box<dyn Read>,
}

impl core::fmt::Debug for Opened {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Opened").field("head", &self.head.len()).finish_non_exhaustive()
    }
}

impl From<Vec<u8>> for Opened {
    /// Of what was read of a pipe.
    fn from(head: Vec<u8>) -> Opened {
        Opened { head, rest: Box::new(io::empty()) }
    }
}

impl Opened {
    /// So many bytes hold the comments and names of a log.
    const HEAD: u64 = 1 << 16;

    /// Opens a file.
    ///
    /// # Errors
    /// What the system says.
    pub fn new(path: &Path) -> io::Result<Opened> {
        let mut rest = File::open(path)?;
        let mut head = Vec::new();
        rest.by_ref().take(Self::HEAD).read_to_end(&mut head)?;
        Ok(Opened { head, rest: Box::new(rest) })
    }

    /// Its first bytes.
    pub fn head(&self) -> &[u8] {
        &self.head
    }

    /// Whether it is a log by its columns, as far as its kind does not say it.
    pub fn is_log(&self) -> bool {
        Format::of(&self.head) != Format::Text
            || text::header(&self.head).is_some_and(|names| is_log(&names))
    }

    /// All of them, from the first.
    pub fn whole(self) -> impl Read {
        io::Cursor::new(self.head).chain(self.rest)
    }
}

impl Log {
    /// Reads a file that was opened at this path, whatever its kind; `motions` are those of the arm's
    /// joints. Text and messages are not held in memory beside their numbers.
    ///
    /// # Errors
    /// [`ReadError`]: what is wrong with its columns, or that none of its rows can be read.
    pub fn from_file(
        path: &Path,
        opened: Opened,
        motions: &[Motion],
        names: &Names,
    ) -> Result<Log, ReadError> {
        let file = path.display().to_string();
        match Format::of(opened.head()) {
            Format::Text => text::read(&file, opened.whole(), motions, names),
            #[cfg(feature = "parquet")]
            Format::Parquet => super::parquet::read(&file, path, motions, names),
            #[cfg(feature = "mcap")]
            Format::Mcap => super::mcap::read(&file, opened.whole(), motions, names),
            #[cfg(feature = "rosbag2")]
            Format::Rosbag2 => super::rosbag2::read(&file, path, motions, names),
            #[allow(unreachable_patterns, reason = "with all features there is no other")]
            other => Err(Fault::not_built(other.words(), "logs").of(&file)),
        }
    }
}
