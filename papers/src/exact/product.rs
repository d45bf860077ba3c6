//! Products of elementary transforms, written in a data file: `["Rz(\\theta_1)", "Tx(a_1)"]`.

use std::collections::HashMap;

use num_rational::Ratio;

use super::evaluate::Arithmetic;
use super::polynomial::Polynomial;
use super::rational::{Exact, Inexact, Rational};
use crate::latex::notation::Notation;
use crate::latex::parser::{collect, parse};
use crate::latex::tree::{Angle, Function, Tree};

/// A matrix of exact forms, row by row.
#[derive(Clone, Debug, PartialEq)]
pub struct Matrix {
    /// Number of columns.
    pub columns: usize,
    /// The entries, row by row.
    pub entries: Vec<Rational>,
}

impl Matrix {
    /// An entry; both indices from 0.
    pub fn get(&self, row: usize, column: usize) -> Option<&Rational> {
        if column < self.columns { self.entries.get(row * self.columns + column) } else { None }
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.entries.len().checked_div(self.columns).unwrap_or(0)
    }

    fn identity(n: usize) -> Self {
        let one = |k: usize| Rational::number(Ratio::from(i128::from(k.is_multiple_of(n + 1))));
        Matrix { columns: n, entries: (0..n * n).map(one).collect() }
    }

    /// Rows for columns.
    pub fn transposed(&self) -> Matrix {
        let places = (0..self.columns).flat_map(|c| (0..self.rows()).map(move |r| (r, c)));
        let entries = places.filter_map(|(r, c)| self.get(r, c).cloned()).collect();
        Matrix { columns: self.rows(), entries }
    }

    /// The product of two matrices that fit.
    pub fn times(&self, other: &Matrix) -> Result<Matrix, Inexact> {
        let mut entries = Vec::new();
        for row in 0..self.rows() {
            for column in 0..other.columns {
                let mut sum = Rational::number(Ratio::from(0));
                for k in 0..self.columns {
                    if let (Some(a), Some(b)) = (self.get(row, k), other.get(k, column)) {
                        sum = sum.plus(&a.times(b)?, 1)?;
                    }
                }
                entries.push(sum);
            }
        }
        Ok(Matrix { columns: other.columns, entries })
    }

    /// The 6×6 matrix that carries a wrench (force, moment) given in this frame at its origin to
    /// the base frame at its origin: [R 0; p× R R].
    pub fn transport(&self) -> Result<Matrix, Inexact> {
        let mut out = Matrix { columns: 6, entries: vec![Rational::number(Ratio::from(0)); 36] };
        let at = |r: usize, c: usize| {
            self.get(r, c).cloned().unwrap_or_else(|| Rational::number(Ratio::from(0)))
        };
        for r in 0..3 {
            let (i, j) = ((r + 1) % 3, (r + 2) % 3);
            for c in 0..3 {
                out.entries[6 * r + c] = at(r, c);
                out.entries[6 * (r + 3) + c + 3] = at(r, c);
                // Row r of p × column c of R.
                let left = at(i, 3).times(&at(j, c))?;
                let right = at(j, 3).times(&at(i, c))?;
                out.entries[6 * (r + 3) + c] = left.plus(&right, -1)?;
            }
        }
        Ok(out)
    }
}

/// The 4×4 product of elements.
///
/// # Errors
/// What is wrong with which element.
pub fn product(
    elements: &[String],
    notation: &Notation,
    defined: &HashMap<String, Rational>,
) -> Result<Matrix, String> {
    let mut out = Matrix::identity(4);
    for text in elements {
        let element = element(text, notation, defined).map_err(|why| format!("`{text}`: {why}"))?;
        out = out.times(&element).map_err(|why| format!("`{text}`: {why:?}"))?;
    }
    Ok(out)
}

const KINDS: &str = "Rx, Ry, Rz, Tx, Ty, Tz of one argument, small of three angles, frame of the \
                     twelve entries n, o, a, p";

fn element(
    text: &str,
    notation: &Notation,
    defined: &HashMap<String, Rational>,
) -> Result<Matrix, String> {
    let (kind, rest) = text.split_once('(').ok_or_else(|| format!("an element is {KINDS}"))?;
    let inner = rest.trim_end().strip_suffix(')').ok_or("the element is never closed")?;
    let trees: Vec<Tree> = arguments(inner)
        .into_iter()
        .map(|argument| parse(argument, notation).map_err(|mistake| mistake.message))
        .collect::<Result<_, _>>()?;
    let value = |k: usize| {
        trees
            .get(k)
            .ok_or_else(|| format!("argument {} is missing", k + 1))
            .and_then(|t| Exact(defined).tree(t).map_err(|why| format!("{why:?}")))
    };
    let mut m = Matrix::identity(4);
    let axis = |c: char| "xyz".find(c);
    let letters: Vec<char> = kind.trim().chars().collect();
    match letters.as_slice() {
        ['T', c] if axis(*c).is_some() => {
            m.entries[4 * axis(*c).unwrap_or(0) + 3] = value(0)?;
        }
        ['R', c] if axis(*c).is_some() => {
            let mut angle = Angle::default();
            let tree = trees.first().ok_or("the angle is missing")?;
            if !collect(tree, Ratio::from(1), &mut angle) {
                return Err("the argument is no sum of angles".into());
            }
            turn(&mut m, axis(*c).unwrap_or(0), &angle)?;
        }
        _ if kind.trim() == "small" => {
            let minus = Rational::number(Ratio::from(-1));
            for k in 0..3 {
                let (i, j) = ((k + 1) % 3, (k + 2) % 3);
                m.entries[4 * j + i] = value(k)?;
                m.entries[4 * i + j] = value(k)?.times(&minus).map_err(|e| format!("{e:?}"))?;
            }
        }
        _ if kind.trim() == "frame" => {
            for k in 0..12 {
                m.entries[4 * (k % 3) + k / 3] = value(k)?;
            }
        }
        _ => return Err(format!("an element is {KINDS}")),
    }
    Ok(m)
}

fn turn(m: &mut Matrix, axis: usize, angle: &Angle) -> Result<(), String> {
    let trig = |f| Polynomial::trig(f, angle).map_err(|_| "the angle is too long".to_owned());
    let (s, c) = (trig(Function::Sin)?, trig(Function::Cos)?);
    let minus = Polynomial::default().minus(&s).map_err(|_| "the angle is too long")?;
    let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
    m.entries[4 * i + i] = c.clone().into();
    m.entries[4 * j + j] = c.into();
    m.entries[4 * j + i] = s.into();
    m.entries[4 * i + j] = minus.into();
    Ok(())
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

    fn of(elements: &[&str]) -> Result<Matrix, String> {
        let elements: Vec<String> = elements.iter().map(|e| (*e).to_owned()).collect();
        product(&elements, &Notation::default(), &HashMap::new())
    }

    #[test]
    fn a_turn_and_its_inverse_are_nothing() {
        let m = of(&["Rz(\\theta_1)", "Rx(a+b)", "Rx(-a-b)", "Rz(-\\theta_1)"]).unwrap();
        assert_eq!(m, Matrix::identity(4));
        let m = of(&["small(x,y,z)"]).unwrap();
        let printed = [["0", "-z", "y"], ["z", "0", "-x"], ["-y", "x", "0"]];
        for (r, row) in printed.iter().enumerate() {
            for (c, text) in row.iter().enumerate().filter(|(c, _)| *c != r) {
                let tree = parse(text, &Notation::default()).unwrap();
                let expected = Exact(&HashMap::new()).tree(&tree).unwrap();
                assert_eq!(m.get(r, c), Some(&expected), "{r} {c}");
            }
        }
    }

    #[test]
    fn wrenches_are_carried_with_their_lever() {
        let m = of(&["Tx(L)"]).unwrap().transport().unwrap();
        // A force along y at L along x turns about z.
        assert_eq!(m.get(5, 1), Some(&Polynomial::symbol("L").into()));
        assert_eq!(m.get(4, 2).map(|r| r.above.is_negative()), Some(true));
    }

    #[test]
    fn mistakes_name_the_element() {
        assert!(of(&["Rw(a)"]).unwrap_err().starts_with("`Rw(a)`: an element is"));
        assert!(of(&["Rz(a b)"]).unwrap_err().contains("no sum of angles"));
        assert!(of(&["frame(a,b)"]).unwrap_err().contains("argument 3 is missing"));
    }
}
