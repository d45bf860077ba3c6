//! A paper's notation: which letters are sines, which names have more than one letter, how far a
//! slash reaches.

use super::name::key;
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
    /// Whether letters stand for matrices, in whatever typeface and with whatever accent.
    pub matrices: bool,
}

impl Notation {
    /// That of relations between matrices.
    pub const MATRICES: Notation =
        Notation { functions: Vec::new(), names: Vec::new(), slash: Slash::Factor, matrices: true };

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
            ..Notation::default()
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
    fn the_longest_name_comes_first() {
        assert_eq!(notation().long_names()[0], "\\deltax");
    }
}
