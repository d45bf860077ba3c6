//! The bytes of a file, and its text.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use serde::de::DeserializeOwned;

use super::mistake::{Fault, ReadError};

/// Largest file that is read, bytes.
pub const MOST_BYTES: u64 = 512 << 20;

/// The bytes of a file, which are held in memory.
///
/// # Errors
/// What the system says, and more than [`MOST_BYTES`].
pub fn bytes(path: &Path) -> io::Result<Vec<u8>> {
    let file = File::open(path)?;
    let large = || {
        let most = MOST_BYTES >> 20;
        let fault =
            format!("it has more than the {most} MB that are read: thin it out or split it");
        io::Error::new(io::ErrorKind::FileTooLarge, fault)
    };
    // A device or a pipe has no length, and may have no end.
    if file.metadata()?.len() > MOST_BYTES {
        return Err(large());
    }
    let mut bytes = Vec::new();
    file.take(MOST_BYTES + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > MOST_BYTES { Err(large()) } else { Ok(bytes) }
}

/// What TOML says; `file` is what messages call it, and `found` what it is where it says something else.
pub fn from_toml<T: DeserializeOwned>(file: &str, text: &str, found: &str) -> Result<T, ReadError> {
    toml::from_str(text).map_err(|error| {
        let before = error.span().and_then(|span| text.get(..span.start));
        let line = before.map(|before| 1 + before.matches('\n').count() as u64);
        Fault::new(found, "", error.message()).within(line, None).of(file)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn more_than_memory_holds_is_refused() {
        // A file of zeros that takes no room on the disk.
        let large = std::env::temp_dir().join(format!("stiffarm-large-{}.csv", std::process::id()));
        let made = File::create(&large).and_then(|file| file.set_len(MOST_BYTES + 1));
        let error = made.and_then(|()| bytes(&large)).unwrap_err().to_string();
        std::fs::remove_file(&large).unwrap();
        assert!(error.starts_with("it has more than the 512 MB"), "{error}");
    }
}
