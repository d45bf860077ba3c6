//! LaTeX of matrices into a tree.

mod names;

use super::tree::{Name, Tree};

/// Brackets deeper than this are no formula.
const DEEPEST: usize = 60;

/// Reads the sides of a relation, cut at its equals signs.
///
/// # Errors
/// What cannot be read, and the byte at which it stands.
pub fn sides(latex: &str) -> Result<Vec<Tree>, (usize, String)> {
    let mut reader = Reader { text: latex, at: 0, depth: 0, norm: false };
    let mut sides = vec![reader.sum()?];
    while reader.eat("=") {
        sides.push(reader.sum()?);
    }
    match reader.rest().trim_end_matches([',', '.']).is_empty() {
        true => Ok(sides),
        false => Err(reader.wrong("stands where a sum should go on")),
    }
}

/// Whether a text is a single symbol.
pub fn is_symbol(latex: &str) -> bool {
    name(latex).is_some()
}

/// Reads a single name, such as a key of a data file.
pub fn name(latex: &str) -> Option<Name> {
    let mut reader = Reader { text: latex, at: 0, depth: 0, norm: false };
    let name = reader.name().ok()?;
    reader.rest().is_empty().then_some(name)
}

/// What a formula is set with and does not mean anything.
const SKIPPED: [&str; 9] =
    ["\\left.", "\\right.", "\\left", "\\right", "\\quad", "\\Big", "\\ldots", "\\dots", "&"];

struct Reader<'t> {
    text: &'t str,
    at: usize,
    depth: usize,
    /// Whether a norm is open, which the next `\|` closes.
    norm: bool,
}

type Read<T> = Result<T, (usize, String)>;

impl<'t> Reader<'t> {
    /// What is left, after what does not mean anything.
    fn rest(&mut self) -> &'t str {
        loop {
            let rest = &self.text[self.at..];
            let spaces = rest.len() - rest.trim_start().len();
            let rest = &rest[spaces..];
            self.at += spaces;
            match SKIPPED.iter().find(|skipped| rest.starts_with(**skipped)) {
                Some(skipped) => self.at += skipped.len(),
                None => return rest,
            }
        }
    }

    fn eat(&mut self, mark: &str) -> bool {
        let found = self.rest().starts_with(mark);
        self.at += if found { mark.len() } else { 0 };
        found
    }

    fn expect(&mut self, mark: &str) -> Read<()> {
        match self.eat(mark) {
            true => Ok(()),
            false => Err(self.wrong(&format!("stands where `{mark}` is expected"))),
        }
    }

    fn wrong(&mut self, what: &str) -> (usize, String) {
        let found = self.rest().chars().next();
        let found = found.map_or("the end".into(), |c| format!("`{c}`"));
        (self.at, format!("{found} {what}"))
    }

    fn sum(&mut self) -> Read<Tree> {
        if self.depth >= DEEPEST {
            return Err((self.at, "brackets are nested too deeply here".into()));
        }
        self.depth += 1;
        let mut terms = Vec::new();
        loop {
            let negative = self.eat("-");
            if !negative && !self.eat("+") && !terms.is_empty() {
                break;
            }
            terms.push((negative, self.product()?));
        }
        self.depth -= 1;
        Ok(match terms.as_mut_slice() {
            [(false, _)] => terms.remove(0).1,
            _ => Tree::Sum(terms),
        })
    }

    fn product(&mut self) -> Read<Tree> {
        let mut factors = vec![self.factor()?];
        while self.begins_factor() {
            factors.push(self.factor()?);
        }
        Ok(if factors.len() == 1 { factors.remove(0) } else { Tree::Product(factors) })
    }

    fn begins_factor(&mut self) -> bool {
        let rest = self.rest();
        let ends = ["\\end", "\\\\", "\\}"];
        let first = rest.chars().next();
        let opens = first.is_some_and(|c| c.is_alphanumeric() || "([{\\".contains(c));
        let norm_closes = self.norm && rest.starts_with("\\|");
        opens && !norm_closes && !ends.iter().any(|end| rest.starts_with(end))
    }

    fn factor(&mut self) -> Read<Tree> {
        let mut tree = self.primary()?;
        while self.eat("^") {
            let braced = self.eat("{");
            let rest = self.rest();
            let power = ["-T", "-1", "T", "2"].into_iter().find(|power| rest.starts_with(power));
            let Some(power) = power else {
                return Err(self.wrong("is no power of a matrix: T, -1, -T or 2"));
            };
            self.at += power.len();
            if braced {
                self.expect("}")?;
            }
            let inner = Box::new(tree);
            tree = match power {
                "T" => Tree::Transpose(inner),
                "-1" => Tree::Inverse(inner),
                "-T" => Tree::Transpose(Box::new(Tree::Inverse(inner))),
                _ => Tree::Product(vec![inner.as_ref().clone(), *inner]),
            };
        }
        Ok(tree)
    }

    fn primary(&mut self) -> Read<Tree> {
        let rest = self.rest();
        // `{}^BR`: an index before its letter.
        if rest.starts_with("{}") {
            return self.name().map(Tree::Name);
        }
        for (open, close) in [("(", ")"), ("[", "]"), ("{", "}"), ("\\|", "\\|")] {
            if self.eat(open) {
                let outer = core::mem::replace(&mut self.norm, open == "\\|");
                let inner = self.sum()?;
                self.norm = outer;
                self.expect(close)?;
                return Ok(if open == "\\|" { Tree::Norm(Box::new(inner)) } else { inner });
            }
        }
        if self.eat("\\frac") {
            return self.fraction();
        }
        if self.eat("\\sqrt") {
            return self.braced().map(|inner| Tree::Sqrt(Box::new(inner)));
        }
        if self.eat("\\text{tr}") || self.eat("\\mathrm{tr}") {
            return self.primary().map(|inner| Tree::Trace(Box::new(inner)));
        }
        if self.eat("\\prod") {
            return self.over();
        }
        if self.eat("\\begin{bmatrix}") {
            return self.blocks();
        }
        let digits = rest.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(rest.len());
        if digits > 0 {
            self.at += digits;
            return Ok(Tree::Number(rest[..digits].to_owned()));
        }
        self.name().map(Tree::Name)
    }

    fn braced(&mut self) -> Read<Tree> {
        self.expect("{")?;
        let inner = self.sum()?;
        self.expect("}")?;
        Ok(inner)
    }

    /// A quotient, or `\frac{\partial A}{\partial \theta_i}`, or `\frac{\partial}{\partial x}(A)`.
    fn fraction(&mut self) -> Read<Tree> {
        self.expect("{")?;
        if !self.eat("\\partial") {
            let above = self.sum()?;
            self.expect("}")?;
            return Ok(Tree::Quotient(Box::new(above), Box::new(self.braced()?)));
        }
        let body = if self.rest().starts_with('}') { None } else { Some(self.product()?) };
        self.expect("}")?;
        self.expect("{")?;
        self.expect("\\partial")?;
        let by = self.name()?;
        self.expect("}")?;
        let body = match body {
            Some(body) => body,
            None => self.primary()?,
        };
        Ok(Tree::Derivative(Box::new(body), by))
    }

    /// `\prod_{j=1}^{n} A_j`, over all that follows in the bracket.
    fn over(&mut self) -> Read<Tree> {
        self.expect("_{")?;
        let bounds = self.until('}')?;
        let (index, from) = bounds.split_once('=').unwrap_or((bounds, ""));
        self.expect("^")?;
        let to = match self.eat("{") {
            true => self.until('}')?,
            false => {
                let end = self.rest().chars().next().map_or(0, char::len_utf8);
                self.at += end;
                &self.text[self.at - end..self.at]
            }
        };
        let [index, from, to] = [index, from, to].map(|t| t.replace(' ', ""));
        Ok(Tree::Over { index, from, to, body: Box::new(self.product()?) })
    }

    fn until(&mut self, end: char) -> Read<&'t str> {
        let rest = &self.text[self.at..];
        let Some(length) = rest.find(end) else { return Err(self.wrong("is never closed")) };
        self.at += length + 1;
        Ok(&rest[..length])
    }

    fn blocks(&mut self) -> Read<Tree> {
        let mut rows = vec![Vec::new()];
        loop {
            let cell = self.cell()?;
            if let Some(row) = rows.last_mut() {
                row.push(cell);
            }
            // `&` stands between cells; elsewhere it would be skipped.
            if self.cell_ends_with('&') {
                continue;
            }
            if self.eat("\\\\") {
                rows.push(Vec::new());
                continue;
            }
            self.expect("\\end{bmatrix}")?;
            return Ok(Tree::Blocks(rows));
        }
    }

    fn cell(&mut self) -> Read<Tree> {
        let rest = &self.text[self.at..];
        let end =
            ["&", "\\\\", "\\end{bmatrix}"].into_iter().filter_map(|end| rest.find(end)).min();
        let end = self.at + end.unwrap_or(rest.len());
        let mut inner =
            Reader { text: &self.text[..end], at: self.at, depth: self.depth, norm: false };
        let tree = inner.sum()?;
        if !inner.rest().is_empty() {
            return Err(inner.wrong("stands where a cell should end"));
        }
        self.at = end;
        Ok(tree)
    }

    fn cell_ends_with(&mut self, mark: char) -> bool {
        let found = self.text[self.at..].starts_with(mark);
        self.at += usize::from(found);
        found
    }
}

#[cfg(test)]
mod tests;
