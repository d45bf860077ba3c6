//! Of what and how a report was made: the command, the files' hashes, a date.
//!
//! The same command on the same files gives the same bytes, so that no clock is asked: the date is that
//! of `SOURCE_DATE_EPOCH` where that is set, else the day on which the measurement file was last written.

use std::path::Path;
use std::time::{Duration, SystemTime};

use sha2::{Digest, Sha256};
use stiffarm_document::beside::{Hashes, Provenance};

use crate::host::Host;
use crate::terminal::failure::Failure;

/// Of the measurement file at `path` with that hash, and the text of a robot file.
pub fn of(path: &Path, data: Sha256, robot: &str, host: &Host) -> Result<Provenance, Failure> {
    let hashes = Hashes {
        data_sha256: hexadecimal(&data.finalize()),
        robot_sha256: hexadecimal(&Sha256::digest(robot)),
    };
    // What is no file, such as a pipe, has no date.
    let about = std::fs::metadata(path).ok().filter(std::fs::Metadata::is_file);
    let written = about.and_then(|about| about.modified().ok());
    let words = host.words().into_iter().map(|word| quoted(&word));
    let command = std::iter::once("stiffarm".to_owned()).chain(words).collect::<Vec<_>>();
    Ok(Provenance { command: command.join(" "), date: date(written)?, hashes })
}

fn date(written: Option<SystemTime>) -> Result<Option<(&'static str, String)>, Failure> {
    const EPOCH: &str = "SOURCE_DATE_EPOCH";
    // The last second of the year 9999.
    const LAST: u64 = 253_402_300_799;
    let (what, time) = match std::env::var(EPOCH) {
        Ok(seconds) => {
            let read = seconds.trim().parse::<u64>().ok().filter(|seconds| *seconds <= LAST);
            let seconds = read.ok_or_else(|| {
                Failure::new(format!("{EPOCH}: found `{seconds}`, expected seconds since 1970"))
            })?;
            ("made", Some(SystemTime::UNIX_EPOCH + Duration::from_secs(seconds)))
        }
        Err(_) => ("measurements written", written),
    };
    let day = |time| humantime::format_rfc3339_seconds(time).to_string();
    let is_told = |time: &SystemTime| time.duration_since(SystemTime::UNIX_EPOCH).is_ok();
    Ok(time.filter(is_told).map(|time| (what, day(time)[..10].to_owned())))
}

fn hexadecimal(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

/// A word as a shell reads it back.
fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_alphanumeric() || "-_./,:=@%+".contains(c);
    match !word.is_empty() && word.chars().all(plain) {
        true => word.to_owned(),
        false => format!("'{}'", word.replace('\'', "'\\''")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_command_reads_back() {
        assert_eq!(quoted("run1.csv"), "run1.csv");
        assert_eq!(quoted("joint 2=5 µm"), "'joint 2=5 µm'");
        assert_eq!(quoted("it's"), "'it'\\''s'");
        assert_eq!(quoted(""), "''");
    }

    /// The published vector of FIPS 180-2, B.1.
    #[test]
    fn hashes_are_those_of_sha256sum() {
        let hash = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
        assert_eq!(hexadecimal(&Sha256::digest("abc")), hash);
    }
}
