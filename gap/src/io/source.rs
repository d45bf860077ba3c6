//! The bytes of a file, and its text.

use std::borrow::Cow;
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

/// What Windows-1252 has from 0x80 to 0x9f; elsewhere it is ISO 8859-1, whose bytes are code points.
const WINDOWS: [char; 32] = [
    '€', '\u{81}', '‚', 'ƒ', '„', '…', '†', '‡', 'ˆ', '‰', 'Š', '‹', 'Œ', '\u{8d}', 'Ž', '\u{8f}',
    '\u{90}', '‘', '’', '“', '”', '•', '–', '—', '˜', '™', 'š', '›', 'œ', '\u{9d}', 'ž', 'Ÿ',
];

/// The text of a file as another program wrote it, and in which encoding if that is not UTF-8: UTF-16
/// with a byte order mark, else Windows-1252, in which any bytes are a text.
pub(crate) fn decoded(bytes: &[u8]) -> (Cow<'_, str>, Option<&'static str>) {
    let wide = |of: fn([u8; 2]) -> u16| {
        let units = bytes[2..].chunks_exact(2).map(|pair| of([pair[0], pair[1]]));
        let read = char::decode_utf16(units).map(|c| c.unwrap_or(char::REPLACEMENT_CHARACTER));
        (Cow::Owned(read.collect()), Some("UTF-16"))
    };
    match (bytes, core::str::from_utf8(bytes)) {
        ([0xff, 0xfe, ..], _) => wide(u16::from_le_bytes),
        ([0xfe, 0xff, ..], _) => wide(u16::from_be_bytes),
        (_, Ok(text)) => (Cow::Borrowed(text), None),
        (_, Err(_)) => {
            let read = bytes.iter().map(|byte| match byte {
                0x80..=0x9f => WINDOWS[usize::from(byte - 0x80)],
                other => char::from(*other),
            });
            (Cow::Owned(read.collect()), Some("Windows-1252"))
        }
    }
}

/// What TOML says; `file` is what messages call it, and `found` what it is where it says something else.
///
/// # Errors
/// [`ReadError`], with the line.
pub(crate) fn from_toml<T: DeserializeOwned>(
    file: &str,
    text: &str,
    found: &str,
) -> Result<T, ReadError> {
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
    fn texts_of_other_encodings_are_read() {
        assert_eq!(decoded("Höhe".as_bytes()), (Cow::Borrowed("Höhe"), None));
        assert_eq!(decoded(b"H\xf6he \x80"), (Cow::Borrowed("Höhe €"), Some("Windows-1252")));
        let wide: Vec<u8> = "Höhe €".encode_utf16().flat_map(u16::to_le_bytes).collect();
        let marked = [b"\xff\xfe", &wide[..]].concat();
        assert_eq!(decoded(&marked), (Cow::Borrowed("Höhe €"), Some("UTF-16")));
        let swapped: Vec<u8> = marked.chunks(2).flat_map(|pair| [pair[1], pair[0]]).collect();
        assert_eq!(decoded(&swapped), decoded(&marked));
    }

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
