//! The fields of a message as ROS writes them.
//!
//! ROS 2 speaks the Common Data Representation (OMG, *DDS Interoperability Wire Protocol* 2.5, §10): four bytes
//! that say how, then every number at a multiple of its own size. ROS 1 puts them one behind the other.

/// How messages are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Encoding {
    /// Of ROS 2.
    Cdr,
    /// Of ROS 1.
    Ros1,
}

impl Encoding {
    /// As bags name it.
    pub(super) fn named(name: &str) -> Option<Encoding> {
        match name {
            "cdr" => Some(Encoding::Cdr),
            "ros1" => Some(Encoding::Ros1),
            _ => None,
        }
    }
}

/// A message that is read from its first field to its last.
pub(super) struct Fields<'b> {
    encoding: Encoding,
    /// Behind what says how it is written.
    bytes: &'b [u8],
    at: usize,
    big_endian: bool,
    /// Numbers stand at multiples of their size, or of this.
    widest: usize,
}

impl<'b> Fields<'b> {
    pub(super) fn new(encoding: Encoding, bytes: &'b [u8]) -> Result<Fields<'b>, String> {
        let (mut big_endian, mut widest, mut from) = (false, 1, 0);
        if encoding == Encoding::Cdr {
            // 0 and 1 are the first version, 6 and 7 the second, in which no number is aligned beyond four.
            let kind = bytes.get(1).filter(|_| bytes.len() >= 4).copied();
            (big_endian, widest) = match kind {
                Some(0) => (true, 8),
                Some(1) => (false, 8),
                Some(6) => (true, 4),
                Some(7) => (false, 4),
                _ => return Err("found no plain CDR in the message".to_owned()),
            };
            from = 4;
        }
        Ok(Fields { encoding, bytes: &bytes[from..], at: 0, big_endian, widest })
    }

    fn take<const N: usize>(&mut self) -> Result<[u8; N], String> {
        let at = self.at.next_multiple_of(N.min(self.widest));
        let cut = || "found the message cut short".to_owned();
        let bytes = self.bytes.get(at..at + N).ok_or_else(cut)?;
        self.at = at + N;
        let mut taken: [u8; N] = bytes.try_into().map_err(|_| cut())?;
        if self.big_endian {
            taken.reverse();
        }
        Ok(taken)
    }

    fn count(&mut self) -> Result<usize, String> {
        Ok(u32::from_le_bytes(self.take()?) as usize)
    }

    fn bytes(&mut self) -> Result<&'b [u8], String> {
        let count = self.count()?;
        let end = self.at.saturating_add(count);
        let bytes = self.bytes.get(self.at..end).ok_or("found the message cut short")?;
        self.at = end;
        Ok(bytes)
    }

    /// The header's stamp, ns.
    pub(super) fn stamp(&mut self) -> Result<i64, String> {
        if self.encoding == Encoding::Ros1 {
            self.count()?;
        }
        self.duration()
    }

    /// Seconds and nanoseconds, ns.
    pub(super) fn duration(&mut self) -> Result<i64, String> {
        let seconds = i32::from_le_bytes(self.take()?);
        let nanoseconds = u32::from_le_bytes(self.take()?);
        Ok(i64::from(seconds) * 1_000_000_000 + i64::from(nanoseconds))
    }

    pub(super) fn skip_text(&mut self) -> Result<(), String> {
        self.bytes().map(|_| ())
    }

    /// A list of texts.
    pub(super) fn texts(&mut self) -> Result<Vec<String>, String> {
        let text = |bytes: &[u8]| {
            let bytes = bytes.strip_suffix(b"\0").unwrap_or(bytes);
            String::from_utf8(bytes.to_vec()).map_err(|_| "found a name that is no text".to_owned())
        };
        (0..self.count()?).map(|_| text(self.bytes()?)).collect()
    }

    /// A list of doubles. Of one that is empty nothing is aligned.
    pub(super) fn numbers(&mut self) -> Result<Vec<f64>, String> {
        (0..self.count()?).map(|_| Ok(f64::from_le_bytes(self.take()?))).collect()
    }
}
