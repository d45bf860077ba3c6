//! LaTeX as it stands in the data files, set as MathML: a page shows formulas without any script.
//!
//! Only what papers' formulas are made of is known; an unknown command is shown by its name.

mod symbols;

use super::escape::escaped;
use symbols::symbol;

/// A formula as a `math` element, its source kept as an annotation.
pub fn math(latex: &str) -> String {
    let lines = lines(latex);
    let set = |line: &str| Reader { rest: line, bold: false }.row(None);
    let row = match lines.as_slice() {
        [line] => set(line),
        lines => {
            let row = |line: &&str| format!("<mtr><mtd>{}</mtd></mtr>", set(line));
            format!(
                "<mtable class=\"lines\">{}</mtable>",
                lines.iter().map(row).collect::<String>()
            )
        }
    };
    format!(
        "<math displaystyle=\"true\"><semantics><mrow>{row}</mrow>\
         <annotation encoding=\"application/x-tex\">{}</annotation></semantics></math>",
        escaped(latex)
    )
}

/// The lines of a formula, broken at the `\\\\` that stand in no environment.
fn lines(latex: &str) -> Vec<&str> {
    let (mut found, mut start, mut depth) = (Vec::new(), 0, 0usize);
    for (at, _) in latex.match_indices('\\') {
        let rest = &latex[at..];
        if rest.starts_with("\\begin") {
            depth += 1;
        } else if rest.starts_with("\\end") {
            depth = depth.saturating_sub(1);
        } else if rest.starts_with("\\\\") && depth == 0 && at >= start {
            found.push(&latex[start..at]);
            start = at + 2;
        }
    }
    found.push(&latex[start..]);
    found.retain(|line| !line.trim().is_empty());
    if found.is_empty() { vec![latex] } else { found }
}

struct Reader<'t> {
    rest: &'t str,
    bold: bool,
}

/// A piece of a formula: its element, and whether its scripts stand above and below it.
struct Atom {
    text: String,
    limits: bool,
}

impl Atom {
    fn plain(text: String) -> Option<Atom> {
        Some(Atom { text, limits: false })
    }
}

impl<'t> Reader<'t> {
    /// Pieces up to `end`, which is taken, or to the end of the text.
    fn row(&mut self, end: Option<&str>) -> String {
        let mut out = String::new();
        loop {
            self.rest = self.rest.trim_start();
            if let Some(rest) = end.and_then(|end| self.rest.strip_prefix(end)) {
                self.rest = rest;
                return out;
            }
            if self.rest.is_empty() {
                return out;
            }
            if let Some(atom) = self.atom() {
                out.push_str(&self.scripted(atom));
            }
        }
    }

    /// A piece with what stands beside it above and below.
    fn scripted(&mut self, base: Atom) -> String {
        let (mut above, mut below) = (String::new(), String::new());
        loop {
            self.rest = self.rest.trim_start();
            let Some(mark) = self.rest.chars().next().filter(|c| "^_'".contains(*c)) else { break };
            self.rest = &self.rest[1..];
            match mark {
                '^' => above.push_str(&self.argument()),
                '_' => below.push_str(&self.argument()),
                _ => above.push_str("<mo>′</mo>"),
            }
        }
        let Atom { text, limits } = base;
        let row = |inner: &str| format!("<mrow>{inner}</mrow>");
        match (below.is_empty(), above.is_empty(), limits) {
            (true, true, _) => text,
            (false, true, false) => format!("<msub>{text}{}</msub>", row(&below)),
            (true, false, false) => format!("<msup>{text}{}</msup>", row(&above)),
            (false, false, false) => {
                format!("<msubsup>{text}{}{}</msubsup>", row(&below), row(&above))
            }
            (false, true, true) => format!("<munder>{text}{}</munder>", row(&below)),
            (true, false, true) => format!("<mover>{text}{}</mover>", row(&above)),
            (false, false, true) => {
                format!("<munderover>{text}{}{}</munderover>", row(&below), row(&above))
            }
        }
    }

    /// What a command is applied to: a group in braces or a single piece.
    fn argument(&mut self) -> String {
        self.rest = self.rest.trim_start();
        match self.rest.strip_prefix('{') {
            Some(rest) => {
                self.rest = rest;
                format!("<mrow>{}</mrow>", self.row(Some("}")))
            }
            None => self.atom().map_or_else(String::new, |atom| atom.text),
        }
    }

    fn atom(&mut self) -> Option<Atom> {
        let first = self.rest.chars().next()?;
        if first == '\\' {
            return self.command();
        }
        if first.is_ascii_digit() {
            let digits = |c: char| c.is_ascii_digit() || c == '.';
            let end = self.rest.find(|c| !digits(c)).unwrap_or(self.rest.len());
            // A full stop that ends the formula is no decimal point.
            let number = self.rest[..end].trim_end_matches('.');
            self.rest = &self.rest[number.len()..];
            return Atom::plain(format!("<mn>{number}</mn>"));
        }
        self.rest = &self.rest[first.len_utf8()..];
        match first {
            '{' => Atom::plain(format!("<mrow>{}</mrow>", self.row(Some("}")))),
            '}' | '&' | '~' => None,
            '-' => Atom::plain("<mo>−</mo>".into()),
            c if c.is_alphabetic() => Atom::plain(self.letter(c)),
            c => Atom::plain(format!("<mo>{}</mo>", escaped(c.encode_utf8(&mut [0; 4])))),
        }
    }

    fn letter(&self, letter: char) -> String {
        let class = if self.bold { " class=\"bold\"" } else { "" };
        format!("<mi{class}>{letter}</mi>")
    }

    fn command(&mut self) -> Option<Atom> {
        let after = &self.rest[1..];
        let length = after.find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(after.len());
        if length == 0 {
            let mark = after.chars().next()?;
            self.rest = &after[mark.len_utf8()..];
            return match mark {
                '|' => Atom::plain("<mo>‖</mo>".into()),
                '{' | '}' => Atom::plain(format!("<mo>{mark}</mo>")),
                _ => None,
            };
        }
        let (name, rest) = after.split_at(length);
        self.rest = rest;
        let named = |text: &str| Atom::plain(format!("<mi>{text}</mi>"));
        match name {
            "frac" => {
                let (above, below) = (self.argument(), self.argument());
                Atom::plain(format!("<mfrac>{above}{below}</mfrac>"))
            }
            "sqrt" => Atom::plain(format!("<msqrt>{}</msqrt>", self.argument())),
            "mathbf" | "boldsymbol" => {
                let before = core::mem::replace(&mut self.bold, true);
                let text = self.argument();
                self.bold = before;
                Atom::plain(text)
            }
            "text" | "mathit" | "mathrm" => Atom::plain(self.words()),
            "dot" => Atom::plain(format!("<mover>{}<mo>˙</mo></mover>", self.argument())),
            "overline" | "bar" => {
                Atom::plain(format!("<mover>{}<mo>¯</mo></mover>", self.argument()))
            }
            "begin" => Atom::plain(self.environment()),
            // Sizes of brackets follow from what they hold; `\left.` is none.
            "left" | "right" => {
                self.rest = self.rest.trim_start();
                self.rest = self.rest.strip_prefix('.').unwrap_or(self.rest);
                None
            }
            "Big" | "big" | "bigl" | "bigr" | "end" => None,
            "quad" | "qquad" => Atom::plain("<mspace width=\"1em\"/>".into()),
            "sum" => Some(Atom { text: "<mo>∑</mo>".into(), limits: true }),
            "prod" => Some(Atom { text: "<mo>∏</mo>".into(), limits: true }),
            "sin" | "cos" | "tan" | "max" | "min" | "diag" | "tr" => named(name),
            _ => match symbol(name) {
                Some((symbol, true)) => Atom::plain(self.letter(symbol)),
                Some((symbol, false)) => Atom::plain(format!("<mo>{symbol}</mo>")),
                None => Atom::plain(format!("<mtext>{name}</mtext>")),
            },
        }
    }

    /// Words in braces.
    fn words(&mut self) -> String {
        let inner = self.rest.trim_start().strip_prefix('{').unwrap_or(self.rest);
        let end = inner.find('}').unwrap_or(inner.len());
        self.rest = inner.get(end + 1..).unwrap_or_default();
        format!("<mtext>{}</mtext>", escaped(&inner[..end]))
    }

    /// A matrix, or lines that are set one below the other.
    fn environment(&mut self) -> String {
        let name = self.rest.strip_prefix('{').and_then(|rest| rest.split_once('}'));
        let Some((name, rest)) = name else { return String::new() };
        let end = format!("\\end{{{name}}}");
        let (inner, after) = rest.split_once(end.as_str()).unwrap_or((rest, ""));
        self.rest = after;
        // An array's column specification.
        let columns = inner.trim_start().strip_prefix('{').and_then(|spec| spec.split_once('}'));
        let inner = match columns {
            Some((_, rest)) if name == "array" => rest,
            _ => inner,
        };
        let lines = inner.split("\\\\").filter(|line| !line.trim().is_empty());
        let rows: String = lines
            .map(|line| {
                let cell = |cell: &str| {
                    let mut reader = Reader { rest: cell, bold: self.bold };
                    format!("<mtd>{}</mtd>", reader.row(None))
                };
                format!("<mtr>{}</mtr>", line.split('&').map(cell).collect::<String>())
            })
            .collect();
        let table = format!("<mtable>{rows}</mtable>");
        match name {
            "bmatrix" => format!("<mrow><mo>[</mo>{table}<mo>]</mo></mrow>"),
            "pmatrix" => format!("<mrow><mo>(</mo>{table}<mo>)</mo></mrow>"),
            _ => table,
        }
    }
}

#[cfg(test)]
mod tests;
