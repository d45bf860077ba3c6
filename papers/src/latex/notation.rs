//! A paper's notation: which letters are sines, which names have more than one letter, how far a
//! slash reaches.

use super::tree::{Angle, Function};

/// How far a division by `/` reaches.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Slash {
    /// `a/bc` divides by `b` alone.
    #[default]
    Factor,
    /// `a/bc` divides by the product `bc`, up to the next sum sign or bracket.
    Product,
}

/// The table of a data file that says how its formulas are to be read.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Notation {
    /// Letters that are sines or cosines of what their subscript names: `s` with the angle `\theta`
    /// makes `s_{23}` the sine of θ2 + θ3.
    pub functions: Vec<(String, Function, String)>,
    /// Names of more than one letter or command: `RL`, `d\phi`.
    pub names: Vec<String>,
    /// How far a slash reaches.
    pub slash: Slash,
}

impl Notation {
    /// All names of more than one letter, spaces removed, longest first.
    pub(crate) fn long_names(&self) -> Vec<String> {
        let letters = self.functions.iter().flat_map(|(letter, _, angle)| [letter, angle]);
        let mut all: Vec<String> = letters.chain(&self.names).map(|name| squeezed(name)).collect();
        all.sort_by(|a, b| b.len().cmp(&a.len()).then(a.cmp(b)));
        all.dedup();
        all
    }

    /// What `s_{23}` means, if its letter is a sine or cosine; `None` is a plain symbol.
    pub(crate) fn function(&self, base: &str, sub: Option<&str>) -> Option<(Function, Angle)> {
        let (_, function, angle) = self.functions.iter().find(|(letter, ..)| letter == base)?;
        let mut terms = Angle::default();
        let mut sign = 1;
        for c in sub?.chars().filter(|c| !c.is_whitespace()) {
            match c {
                '-' => sign = -1,
                '+' | ',' => sign = 1,
                c if c.is_alphanumeric() => {
                    terms.add(&key(angle, Some(c.encode_utf8(&mut [0; 4]))), sign);
                    sign = 1;
                }
                _ => return None,
            }
        }
        (!terms.is_zero()).then_some((*function, terms))
    }
}

/// The name of a printed symbol in the graph: `RL_4` is `RL4`, `\lambda_6` is `lambda6`.
pub(crate) fn key(base: &str, sub: Option<&str>) -> String {
    let letters = base.chars().chain(sub.unwrap_or_default().chars());
    letters.filter(|c| c.is_alphanumeric() || *c == '\'').collect()
}

/// A name without the spaces that LaTeX ignores.
pub(crate) fn squeezed(name: &str) -> String {
    name.chars().filter(|c| !c.is_whitespace()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn notation() -> Notation {
        let function = |letter: &str, f, angle: &str| (letter.to_owned(), f, angle.to_owned());
        Notation {
            functions: vec![
                function("c", Function::Cos, "\\theta"),
                function("cd", Function::Cos, "d\\phi"),
            ],
            names: vec!["\\delta x".into()],
            slash: Slash::Factor,
        }
    }

    #[test]
    fn subscripts_name_sums_of_angles() {
        let (f, angle) = notation().function("c", Some("23")).unwrap();
        assert_eq!((f, angle.to_string()), (Function::Cos, "theta2+theta3".into()));
        let (_, angle) = notation().function("cd", Some("1-2")).unwrap();
        assert_eq!(angle.to_string(), "dphi1-dphi2");
        assert_eq!(notation().function("c", None), None);
        assert_eq!(notation().function("x", Some("1")), None);
    }

    #[test]
    fn names_become_identifiers() {
        assert_eq!(key("\\lambda", Some("6")), "lambda6");
        assert_eq!(key("\\delta x", Some("{2}")), "deltax2");
        assert_eq!(notation().long_names()[0], "\\deltax");
    }
}
