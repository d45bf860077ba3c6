//! Numbers of a product of elementary transforms.

use std::collections::HashMap;

use nalgebra::Vector3;

use super::dense::Dense;
use crate::exact::evaluate::{Arithmetic, NoValue, Real};
use crate::exact::product::{Matrix, product};
use crate::exact::rational::Rational;
use crate::latex::notation::Notation;

/// A part of a product of elementary transforms: its rotation, its position, the matrix of the
/// cross product with the position, or the transport of a wrench through it. Its symbols have
/// random values.
pub(super) fn transform(
    part: &str,
    elements: &[String],
    notation: &Notation,
    defined: &HashMap<String, Rational>,
) -> Result<Dense, String> {
    let whole = product(elements, notation, defined)?;
    let value = |name: &str| {
        let sum =
            name.bytes().fold(7u32, |sum, byte| sum.wrapping_mul(31).wrapping_add(byte.into()));
        Some(0.3 + f64::from(sum % 1000) / 700.0)
    };
    let numbers = |matrix: &Matrix| {
        let each: Result<Vec<f64>, NoValue> =
            matrix.entries.iter().map(|entry| Real(value).rational(entry)).collect();
        each.map(|each| Dense::from_row_slice(matrix.rows(), matrix.columns, &each))
            .map_err(|NoValue| "the product has no value here")
    };
    if part == "transport" {
        let transport = whole.transport().map_err(|why| format!("{why:?}"))?;
        return Ok(numbers(&transport)?);
    }
    let whole = numbers(&whole)?;
    let p = Vector3::from_fn(|k, _| whole[(k, 3)]);
    Ok(match part {
        "rotation" => Dense::from_fn(3, 3, |r, c| whole[(r, c)]),
        "position" => Dense::from_column_slice(3, 1, p.as_slice()),
        _ => Dense::from_column_slice(3, 3, p.cross_matrix().as_slice()),
    })
}
