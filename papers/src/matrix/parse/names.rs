//! Symbols with their typeface, accents and indices.

use super::{Name, Read, Reader};

impl Reader<'_> {
    pub(super) fn name(&mut self) -> Read<Name> {
        let mut base = String::new();
        self.rest();
        let start = self.at;
        if self.eat("{}^") {
            base.push('^');
            base.push_str(&self.group()?);
        }
        base.push_str(&self.letters()?);
        base.retain(|c| c != '\\');
        let printed = self.text[start..self.at].trim().to_owned();
        let mut indices = Vec::new();
        if self.eat("_") {
            let inner = self.group()?;
            indices = inner.split(',').map(str::to_owned).collect();
        }
        Ok(Name { base, indices, printed })
    }

    /// A letter in whatever typeface.
    fn letters(&mut self) -> Read<String> {
        for typeface in ["\\mathbf", "\\boldsymbol", "\\mathrm", "\\text"] {
            if self.eat(typeface) {
                return self.group();
            }
        }
        for accent in ["\\dot", "\\overline", "\\bar"] {
            if self.eat(accent) {
                let braced = self.eat("{");
                let inner = self.letters()?;
                if braced {
                    self.expect("}")?;
                }
                return Ok(format!("{}{inner}", &accent[1..]));
            }
        }
        let rest = self.rest();
        let length = match rest.strip_prefix('\\') {
            Some(command) => {
                1 + command.find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(command.len())
            }
            None => rest.chars().next().filter(|c| c.is_alphabetic()).map_or(0, char::len_utf8),
        };
        if length < 1 || &rest[..length] == "\\" {
            return Err(self.wrong("stands where a matrix is expected"));
        }
        self.at += length;
        Ok(rest[..length].trim_start_matches('\\').to_owned())
    }

    /// A group in braces or one letter, without typefaces.
    fn group(&mut self) -> Read<String> {
        self.rest();
        if self.eat("{") {
            let inner = self.until('}')?;
            let plain = ["mathbf", "boldsymbol", "text"]
                .iter()
                .fold(inner.to_owned(), |text, face| text.replace(&format!("\\{face}"), ""));
            return Ok(plain.chars().filter(|c| !" {}".contains(*c)).collect());
        }
        let rest = self.rest();
        if rest.starts_with('\\') {
            let start = self.at;
            self.letters()?;
            return Ok(self.text[start..self.at].to_owned());
        }
        let length = rest.chars().next().map_or(0, char::len_utf8);
        self.at += length;
        Ok(rest[..length].to_owned())
    }
}
