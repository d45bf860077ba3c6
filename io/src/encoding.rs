//! How a text is encoded, and the same as a stream of UTF-8: no file is held for it.

use std::io::{self, BufRead, BufReader, Read};

/// How the bytes of a file are a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Encoding {
    /// UTF-8, with a byte order mark or without.
    Utf8,
    /// UTF-16 with a byte order mark, the lower byte of a unit first or last.
    Utf16 {
        /// Whether the lower byte is first.
        lower_first: bool,
    },
    /// Windows-1252, in which any bytes are a text.
    Windows1252,
}

/// What Windows-1252 has from 0x80 to 0x9f; elsewhere it is ISO 8859-1, whose bytes are code points.
const WINDOWS: [char; 32] = [
    '€', '\u{81}', '‚', 'ƒ', '„', '…', '†', '‡', 'ˆ', '‰', 'Š', '‹', 'Œ', '\u{8d}', 'Ž', '\u{8f}',
    '\u{90}', '‘', '’', '“', '”', '•', '–', '—', '˜', '™', 'š', '›', 'œ', '\u{9d}', 'ž', 'Ÿ',
];

/// Bytes that are looked at, or decoded, at once.
const CHUNK: usize = 1 << 16;

impl Encoding {
    /// Of a text as another program wrote it, which is read to its end for that.
    pub fn of(source: impl Read) -> io::Result<Encoding> {
        let mut source = BufReader::with_capacity(CHUNK, source);
        if let Some(marked) = Encoding::marked(source.fill_buf()?) {
            return Ok(marked);
        }
        // What a chunk leaves of a character at its end.
        let mut begun: Vec<u8> = Vec::new();
        loop {
            let part = source.fill_buf()?;
            if part.is_empty() {
                return Ok(if begun.is_empty() { Encoding::Utf8 } else { Encoding::Windows1252 });
            }
            begun.extend_from_slice(part);
            let count = part.len();
            source.consume(count);
            let rest = match core::str::from_utf8(&begun) {
                Ok(_) => begun.len(),
                Err(error) if error.error_len().is_none() => error.valid_up_to(),
                Err(_) => return Ok(Encoding::Windows1252),
            };
            begun.drain(..rest);
        }
    }

    /// Of a text that begins so, by its lines down to the first that is no comment: a damaged byte further down is no
    /// other encoding.
    pub fn of_head(head: &[u8]) -> Encoding {
        let mut lines = head.split_inclusive(|b| matches!(b, b'\n' | b'\r'));
        let is_first = |line: &[u8]| !line.is_empty() && !line.starts_with(b"#");
        let is_read = |line: &&[u8]| is_first(line.trim_ascii());
        let behind: usize = match lines.find(is_read) {
            Some(_) => lines.map(<[u8]>::len).sum(),
            None => 0,
        };
        let begun = core::str::from_utf8(&head[..head.len() - behind]);
        let other = begun.is_err_and(|error| error.error_len().is_some());
        let unmarked = if other { Encoding::Windows1252 } else { Encoding::Utf8 };
        Encoding::marked(head).unwrap_or(unmarked)
    }

    /// By a byte order mark of UTF-16.
    fn marked(head: &[u8]) -> Option<Encoding> {
        let lower_first = match head {
            [0xff, 0xfe, ..] => true,
            [0xfe, 0xff, ..] => false,
            _ => return None,
        };
        Some(Encoding::Utf16 { lower_first })
    }

    /// What it is called, where that is not UTF-8.
    pub fn name(self) -> Option<&'static str> {
        match self {
            Encoding::Utf8 => None,
            Encoding::Utf16 { .. } => Some("UTF-16"),
            Encoding::Windows1252 => Some("Windows-1252"),
        }
    }

    /// A text in this encoding as UTF-8.
    pub fn decoded<'r>(self, source: impl Read + 'r) -> Box<dyn BufRead + 'r> {
        let source = BufReader::with_capacity(CHUNK, source);
        match self {
            Encoding::Utf8 => Box::new(source),
            encoding => {
                let decoding = Decoding { source, encoding, high: None, text: Vec::new(), at: 0 };
                Box::new(BufReader::with_capacity(CHUNK, decoding))
            }
        }
    }
}

/// A source whose text comes out as UTF-8.
struct Decoding<R> {
    source: BufReader<R>,
    encoding: Encoding,
    /// The first unit of a pair.
    high: Option<u16>,
    /// What is decoded and not yet taken, from `at`.
    text: Vec<u8>,
    at: usize,
}

impl<R: Read> Decoding<R> {
    /// Decodes the next chunk; whether there was one.
    fn next(&mut self) -> io::Result<bool> {
        self.text.clear();
        self.at = 0;
        let mut bytes = Vec::with_capacity(CHUNK);
        // An even number but for the end.
        if self.source.by_ref().take(CHUNK as u64).read_to_end(&mut bytes)? == 0 {
            return Ok(false);
        }
        let mut text = String::with_capacity(2 * bytes.len());
        match self.encoding {
            Encoding::Utf16 { lower_first } => {
                let unit = |pair: &[u8]| match lower_first {
                    true => u16::from_le_bytes([pair[0], pair[1]]),
                    false => u16::from_be_bytes([pair[0], pair[1]]),
                };
                let mut units: Vec<u16> = self.high.take().into_iter().collect();
                units.extend(bytes.chunks_exact(2).map(unit));
                self.high = units.pop_if(|unit| (0xd800..0xdc00).contains(unit));
                let read = char::decode_utf16(units);
                text.extend(read.map(|c| c.unwrap_or(char::REPLACEMENT_CHARACTER)));
            }
            _ => text.extend(bytes.iter().map(|byte| match byte {
                0x80..=0x9f => WINDOWS[usize::from(byte - 0x80)],
                other => char::from(*other),
            })),
        }
        self.text = text.into_bytes();
        Ok(true)
    }
}

impl<R: Read> Read for Decoding<R> {
    fn read(&mut self, to: &mut [u8]) -> io::Result<usize> {
        while self.at == self.text.len() {
            if !self.next()? {
                return Ok(0);
            }
        }
        let count = to.len().min(self.text.len() - self.at);
        to[..count].copy_from_slice(&self.text[self.at..self.at + count]);
        self.at += count;
        Ok(count)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(bytes: &[u8]) -> (String, Option<&'static str>) {
        let encoding = Encoding::of(bytes).unwrap();
        let mut text = String::new();
        encoding.decoded(bytes).read_to_string(&mut text).unwrap();
        (text.trim_start_matches('\u{feff}').to_owned(), encoding.name())
    }

    /// Longer than a chunk, with a character of several bytes or units across its end.
    #[test]
    fn texts_of_other_encodings_are_read() {
        for long in [0, CHUNK - 1, CHUNK / 2 - 2, 2 * CHUNK - 3] {
            let plain = format!("{}Höhe € 😀", "x".repeat(long));
            assert_eq!(text(plain.as_bytes()), (plain.clone(), None));
            let wide = |of: fn(u16) -> [u8; 2]| -> Vec<u8> {
                "\u{feff}".encode_utf16().chain(plain.encode_utf16()).flat_map(of).collect()
            };
            for bytes in [wide(u16::to_le_bytes), wide(u16::to_be_bytes)] {
                assert_eq!(text(&bytes), (plain.clone(), Some("UTF-16")), "{long}");
            }
            let mut windows = "x".repeat(long).into_bytes();
            windows.extend(b"H\xf6he \x80");
            let expected = format!("{}Höhe €", "x".repeat(long));
            assert_eq!(text(&windows), (expected, Some("Windows-1252")));
        }
        assert_eq!(text(b"cut off: \xe2\x82"), ("cut off: â‚".to_owned(), Some("Windows-1252")));
    }

    #[test]
    fn the_lines_to_the_header_decide() {
        let of = Encoding::of_head;
        assert_eq!(of(b"# H\xf6he\nt,q1\n"), Encoding::Windows1252);
        assert_eq!(of("# Höhe\n\nt,q1\n0,".as_bytes()), Encoding::Utf8);
        assert_eq!(of(b"t,q1\n0,\xff\n"), Encoding::Utf8);
        assert_eq!(of(b"\xfe\xff\0t"), Encoding::Utf16 { lower_first: false });
    }
}
