//! Products of elementary transforms, written in a data file: `["Rz(\\theta_1)", "Tx(a_1)"]`.

use num_rational::Ratio;
use stiffarm_codegen::expr::Expr;

use super::arithmetic::Arithmetic;
use super::forms::Forms;
use crate::latex::notation::Notation;
use crate::latex::parser::{collect, parse};
use crate::latex::tree::{Angle, Function, Tree};

/// A matrix of formulas, row by row.
#[derive(Clone, Debug, PartialEq)]
pub struct Matrix {
    /// Number of columns.
    pub columns: usize,
    /// The entries, row by row.
    pub entries: Vec<Expr>,
}

impl Matrix {
    /// An entry; both indices from 0, and within the matrix.
    pub(super) fn at(&self, (row, column): (usize, usize)) -> Expr {
        self.entries[row * self.columns + column]
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.entries.len().checked_div(self.columns).unwrap_or(0)
    }

    fn identity(n: usize) -> Self {
        let one = |k: usize| if k.is_multiple_of(n + 1) { Expr::ONE } else { Expr::ZERO };
        Matrix { columns: n, entries: (0..n * n).map(one).collect() }
    }

    /// Rows for columns.
    pub fn transposed(&self) -> Matrix {
        let places = (0..self.columns).flat_map(|c| (0..self.rows()).map(move |r| (r, c)));
        Matrix { columns: self.rows(), entries: places.map(|place| self.at(place)).collect() }
    }

    fn times(&self, other: &Matrix, forms: &Forms) -> Result<Matrix, &'static str> {
        let entry = |row, column| {
            (0..self.columns).try_fold(Expr::ZERO, |sum, k| {
                forms.add(sum, forms.mul(self.at((row, k)), other.at((k, column)))?)
            })
        };
        let places = (0..self.rows()).flat_map(|r| (0..other.columns).map(move |c| (r, c)));
        let entries = places.map(|(r, c)| entry(r, c)).collect::<Result<_, _>>()?;
        Ok(Matrix { columns: other.columns, entries })
    }

    /// Of a 4×4 transform the 6×6 matrix that carries a wrench (force, moment) given in this frame at
    /// its origin to the base frame at its origin: [R 0; p× R R].
    ///
    /// # Errors
    /// Never for what has a value.
    pub fn transport(&self, forms: &Forms) -> Result<Matrix, &'static str> {
        let mut out = Matrix { columns: 6, entries: vec![Expr::ZERO; 36] };
        for r in 0..3 {
            let (i, j) = ((r + 1) % 3, (r + 2) % 3);
            for c in 0..3 {
                out.entries[6 * r + c] = self.at((r, c));
                out.entries[6 * (r + 3) + c + 3] = self.at((r, c));
                // Row r of p × column c of R.
                let left = forms.mul(self.at((i, 3)), self.at((j, c)))?;
                let right = forms.mul(self.at((j, 3)), self.at((i, c)))?;
                out.entries[6 * (r + 3) + c] = forms.sub(left, right)?;
            }
        }
        Ok(out)
    }
}

/// The 4×4 product of elements.
///
/// # Errors
/// What is wrong with which element.
pub fn product(elements: &[String], notation: &Notation, forms: &Forms) -> Result<Matrix, String> {
    let mut out = Matrix::identity(4);
    for text in elements {
        let element = element(text, notation, forms).map_err(|why| format!("`{text}`: {why}"))?;
        out = out.times(&element, forms)?;
    }
    Ok(out)
}

const KINDS: &str = "Rx, Ry, Rz, Tx, Ty, Tz of one argument, small of three angles, frame of the \
                     twelve entries n, o, a, p";

fn element(text: &str, notation: &Notation, forms: &Forms) -> Result<Matrix, String> {
    let (kind, rest) = text.split_once('(').ok_or_else(|| format!("an element is {KINDS}"))?;
    let inner = rest.trim_end().strip_suffix(')').ok_or("the element is never closed")?;
    let trees: Vec<Tree> = arguments(inner)
        .into_iter()
        .map(|argument| parse(argument, notation).map_err(|mistake| mistake.message))
        .collect::<Result<_, _>>()?;
    let argument = |k: usize| trees.get(k).ok_or_else(|| format!("argument {} is missing", k + 1));
    let value = |k: usize| Ok::<Expr, String>(forms.tree(argument(k)?)?);
    let mut m = Matrix::identity(4);
    match (kind.trim(), kind.trim().get(1..).and_then(|axis| "xyz".find(axis))) {
        ("Tx" | "Ty" | "Tz", Some(axis)) => m.entries[4 * axis + 3] = value(0)?,
        ("Rx" | "Ry" | "Rz", Some(axis)) => {
            let mut angle = Angle::default();
            if !collect(argument(0)?, Ratio::from(1), &mut angle) {
                return Err("the argument is no sum of angles".into());
            }
            let (s, c) = (forms.trig(Function::Sin, &angle)?, forms.trig(Function::Cos, &angle)?);
            let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
            for (row, column, entry) in [(i, i, c), (j, j, c), (j, i, s), (i, j, -s)] {
                m.entries[4 * row + column] = entry;
            }
        }
        ("small", _) => {
            for k in 0..3 {
                let (i, j) = ((k + 1) % 3, (k + 2) % 3);
                m.entries[4 * j + i] = value(k)?;
                m.entries[4 * i + j] = -value(k)?;
            }
        }
        ("frame", _) => {
            for k in 0..12 {
                m.entries[4 * (k % 3) + k / 3] = value(k)?;
            }
        }
        _ => return Err(format!("an element is {KINDS}")),
    }
    Ok(m)
}

/// Cut at commas outside brackets.
fn arguments(text: &str) -> Vec<&str> {
    let mut depth = 0i32;
    let mut out = Vec::new();
    let mut start = 0;
    for (at, c) in text.char_indices() {
        match c {
            '(' | '{' | '[' => depth += 1,
            ')' | '}' | ']' => depth -= 1,
            ',' if depth == 0 => {
                out.push(&text[start..at]);
                start = at + 1;
            }
            _ => {}
        }
    }
    out.push(&text[start..]);
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(forms: &Forms, elements: &[&str]) -> Result<Matrix, String> {
        let elements: Vec<String> = elements.iter().map(|e| (*e).to_owned()).collect();
        product(&elements, &Notation::default(), forms)
    }

    fn zero(forms: Forms, matrix: Matrix) -> Vec<bool> {
        let truth = forms.truth(matrix.columns, matrix.entries).unwrap();
        truth.entries.iter().map(|entry| truth.form(*entry).is_zero()).collect()
    }

    #[test]
    fn a_turn_and_its_inverse_are_nothing() {
        let forms = Forms::new(&[], &[]).unwrap();
        let turns = ["Rz(\\theta_1)", "Rx(a+b)", "Rx(-a-b)", "Rz(-\\theta_1)"];
        let m = of(&forms, &turns).unwrap();
        let one = Matrix::identity(4).entries;
        let apart = m.entries.iter().zip(one).map(|(a, b)| forms.sub(*a, b).unwrap()).collect();
        assert!(zero(forms, Matrix { columns: 4, entries: apart }).into_iter().all(|zero| zero));
        let forms = Forms::new(&[], &[]).unwrap();
        let m = of(&forms, &["small(x,y,z)"]).unwrap();
        let [x, y, z] = ["x", "y", "z"].map(|name| forms.named(name).unwrap());
        let (o, one) = (Expr::ZERO, Expr::ONE);
        assert_eq!(m.entries, [one, -z, y, o, z, one, -x, o, -y, x, one, o, o, o, o, one]);
    }

    #[test]
    fn wrenches_are_carried_with_their_lever() {
        let forms = Forms::new(&[], &[]).unwrap();
        let m = of(&forms, &["Tx(L)"]).unwrap().transport(&forms).unwrap();
        let lever = forms.named("L").unwrap();
        // A force along y at L along x turns about z.
        assert_eq!((m.at((5, 1)), m.at((4, 2))), (lever, -lever));
    }

    #[test]
    fn mistakes_name_the_element() {
        let wrong = |text| of(&Forms::new(&[], &[]).unwrap(), &[text]).unwrap_err();
        assert!(wrong("Rw(a)").starts_with("`Rw(a)`: an element is"));
        assert!(wrong("Rz(a b)").contains("no sum of angles"));
        assert!(wrong("frame(a,b)").contains("argument 3 is missing"));
    }
}
