//! Products of elementary transforms, written in a data file: `["Rz(\\theta_1)", "Tx(a_1)"]`.

use nalgebra::DMatrix;
use num_rational::Ratio;
use stiffarm_codegen::expr::Expr;

use super::arithmetic::Arithmetic;
use super::forms::Forms;
use crate::latex::notation::Notation;
use crate::latex::parser::{collect, parse};
use crate::latex::tree::{Angle, Function, Tree};

/// A matrix of formulas.
pub type Matrix = DMatrix<Expr>;

fn identity() -> Matrix {
    Matrix::from_fn(4, 4, |r, c| if r == c { Expr::ONE } else { Expr::ZERO })
}

fn times(a: &Matrix, b: &Matrix, forms: &Forms) -> Result<Matrix, &'static str> {
    let mut out = Matrix::from_element(a.nrows(), b.ncols(), Expr::ZERO);
    for (r, c) in (0..a.nrows()).flat_map(|r| (0..b.ncols()).map(move |c| (r, c))) {
        for k in 0..a.ncols() {
            out[(r, c)] = forms.add(out[(r, c)], forms.mul(a[(r, k)], b[(k, c)])?)?;
        }
    }
    Ok(out)
}

/// Of a 4×4 transform the 6×6 matrix that carries a wrench (force, moment) given in this frame at
/// its origin to the base frame at its origin: [R 0; p× R R].
///
/// # Errors
/// Never for what has a value.
pub fn transport(m: &Matrix, forms: &Forms) -> Result<Matrix, &'static str> {
    let mut out = Matrix::from_element(6, 6, Expr::ZERO);
    for r in 0..3 {
        let (i, j) = ((r + 1) % 3, (r + 2) % 3);
        for c in 0..3 {
            out[(r, c)] = m[(r, c)];
            out[(r + 3, c + 3)] = m[(r, c)];
            // Row r of p × column c of R.
            let left = forms.mul(m[(i, 3)], m[(j, c)])?;
            let right = forms.mul(m[(j, 3)], m[(i, c)])?;
            out[(r + 3, c)] = forms.sub(left, right)?;
        }
    }
    Ok(out)
}

/// The 4×4 product of elements.
///
/// # Errors
/// What is wrong with which element.
pub fn product(elements: &[String], notation: &Notation, forms: &Forms) -> Result<Matrix, String> {
    let mut out = identity();
    for text in elements {
        let element = element(text, notation, forms).map_err(|why| format!("`{text}`: {why}"))?;
        out = times(&out, &element, forms)?;
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
    let mut m = identity();
    match (kind.trim(), kind.trim().get(1..).and_then(|axis| "xyz".find(axis))) {
        ("Tx" | "Ty" | "Tz", Some(axis)) => m[(axis, 3)] = value(0)?,
        ("Rx" | "Ry" | "Rz", Some(axis)) => {
            let mut angle = Angle::default();
            if !collect(argument(0)?, Ratio::from(1), &mut angle) {
                return Err("the argument is no sum of angles".into());
            }
            let (s, c) = (forms.trig(Function::Sin, &angle)?, forms.trig(Function::Cos, &angle)?);
            let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
            for (row, column, entry) in [(i, i, c), (j, j, c), (j, i, s), (i, j, -s)] {
                m[(row, column)] = entry;
            }
        }
        ("small", _) => {
            for k in 0..3 {
                let (i, j) = ((k + 1) % 3, (k + 2) % 3);
                m[(j, i)] = value(k)?;
                m[(i, j)] = -value(k)?;
            }
        }
        ("frame", _) => {
            for k in 0..12 {
                m[(k % 3, k / 3)] = value(k)?;
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
        let truth = forms.truth_of(&matrix).unwrap();
        truth.entries.iter().map(|entry| truth.form(*entry).is_zero()).collect()
    }

    #[test]
    fn a_turn_and_its_inverse_are_nothing() {
        let forms = Forms::new(&[], &[]).unwrap();
        let turns = ["Rz(\\theta_1)", "Rx(a+b)", "Rx(-a-b)", "Rz(-\\theta_1)"];
        let m = of(&forms, &turns).unwrap();
        let apart = m.zip_map(&identity(), |a, b| forms.sub(a, b).unwrap());
        assert!(zero(forms, apart).into_iter().all(|zero| zero));
        let forms = Forms::new(&[], &[]).unwrap();
        let m = of(&forms, &["small(x,y,z)"]).unwrap();
        let [x, y, z] = ["x", "y", "z"].map(|name| forms.named(name).unwrap());
        let (o, one) = (Expr::ZERO, Expr::ONE);
        assert_eq!(m.as_slice(), [one, z, -y, o, -z, one, x, o, y, -x, one, o, o, o, o, one]);
    }

    #[test]
    fn wrenches_are_carried_with_their_lever() {
        let forms = Forms::new(&[], &[]).unwrap();
        let m = transport(&of(&forms, &["Tx(L)"]).unwrap(), &forms).unwrap();
        let lever = forms.named("L").unwrap();
        // A force along y at L along x turns about z.
        assert_eq!((m[(5, 1)], m[(4, 2)]), (lever, -lever));
    }

    #[test]
    fn mistakes_name_the_element() {
        let wrong = |text| of(&Forms::new(&[], &[]).unwrap(), &[text]).unwrap_err();
        assert!(wrong("Rw(a)").starts_with("`Rw(a)`: an element is"));
        assert!(wrong("Rz(a b)").contains("no sum of angles"));
        assert!(wrong("frame(a,b)").contains("argument 3 is missing"));
    }
}
