//! The file of a table, as text that is gone through as often as need be: what is on disk is not held.

use std::borrow::Cow;
use std::fs::File;
use std::io::{self, BufRead, Read};
use std::path::PathBuf;

use super::Map;
use crate::io::encoding::Encoding;
use crate::io::table::{Records, Separator};
use crate::io::{Fault, Mistake, ReadError};

/// A file of a table.
#[derive(Clone, Debug)]
pub struct Sheet {
    file: String,
    source: Source,
}

/// Where the bytes of a file are.
#[derive(Clone, Debug)]
enum Source {
    Held(Vec<u8>),
    OnDisk(PathBuf),
}

/// The text of a file.
pub(super) struct Text<'s> {
    source: Cow<'s, Source>,
    encoding: Encoding,
    /// What separates its cells, if that is known.
    separator: Option<Separator>,
}

/// A zip archive, which an xlsx or ods file is.
const ZIP: &[u8] = b"PK\x03\x04";

impl Source {
    fn open(&self) -> io::Result<Box<dyn Read + '_>> {
        Ok(match self {
            Source::Held(bytes) => Box::new(&bytes[..]),
            Source::OnDisk(path) => Box::new(File::open(path)?),
        })
    }
}

impl Text<'_> {
    /// The records from the first on; those of a file whose separator is not known are looked at for it.
    pub(super) fn records(
        &self,
        separator: Option<Separator>,
    ) -> Result<Records<Box<dyn BufRead + '_>>, Mistake> {
        let source = self.source.open().map_err(|error| unreadable(&error))?;
        Records::new(self.encoding.decoded(source), separator.or(self.separator))
    }
}

fn unreadable(error: &io::Error) -> Fault {
    Fault::new(format!("no file that can be read ({error})"), "a table", "")
}

impl Sheet {
    /// The bytes of a file; `file` is what messages call it.
    pub fn new(file: impl Into<String>, bytes: Vec<u8>) -> Sheet {
        Sheet { file: file.into(), source: Source::Held(bytes) }
    }

    /// A file on disk, which is read each time that it is gone through.
    pub fn on_disk(path: impl Into<PathBuf>) -> Sheet {
        let path = path.into();
        Sheet { file: path.display().to_string(), source: Source::OnDisk(path) }
    }

    pub(super) fn file(&self) -> &str {
        &self.file
    }

    /// The text of the file, of a workbook that of a sheet with a line for each row.
    pub(super) fn text(&self, map: &Map, said: &mut Vec<String>) -> Result<Text<'_>, ReadError> {
        let wrong = |error: io::Error| unreadable(&error).of(&self.file);
        let mut head = Vec::new();
        let source = self.source.open().map_err(wrong)?;
        source.take(ZIP.len() as u64).read_to_end(&mut head).map_err(wrong)?;
        if head == ZIP {
            let sheet = self.workbook(map, said).map_err(|fault| fault.of(&self.file))?;
            let (source, separator) = (Source::Held(sheet), Some(Separator::Byte(b',')));
            return Ok(Text { source: Cow::Owned(source), encoding: Encoding::Utf8, separator });
        }
        let encoding = self.source.open().and_then(Encoding::of).map_err(wrong)?;
        said.extend(encoding.name().map(|name| format!("the text is read as {name}")));
        Ok(Text { source: Cow::Borrowed(&self.source), encoding, separator: map.separator() })
    }

    /// All bytes.
    #[cfg(feature = "xlsx")]
    fn held(&self) -> Result<Cow<'_, [u8]>, Fault> {
        match &self.source {
            Source::Held(bytes) => Ok(Cow::Borrowed(bytes)),
            Source::OnDisk(path) => {
                crate::io::bytes(path).map(Cow::Owned).map_err(|error| unreadable(&error))
            }
        }
    }

    #[cfg(not(feature = "xlsx"))]
    fn workbook(&self, _: &Map, _: &mut Vec<String>) -> Result<Vec<u8>, Fault> {
        Err(Fault::not_built("a workbook", "xlsx"))
    }

    #[cfg(feature = "xlsx")]
    fn workbook(&self, map: &Map, said: &mut Vec<String>) -> Result<Vec<u8>, Fault> {
        super::workbook::text(&self.held()?, map, said)
    }
}
