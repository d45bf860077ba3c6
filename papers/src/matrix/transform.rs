//! Numbers of a product of elementary transforms.

use nalgebra::Vector3;

use super::dense::Dense;
use crate::exact::arithmetic::Real;
use crate::exact::field::Modular;
use crate::exact::forms::Forms;
use crate::exact::product::{product, transport};
use crate::latex::notation::Notation;
use crate::latex::tree::Tree;

/// A part of a product of elementary transforms: its rotation, its position, the matrix of the
/// cross product with the position, or the transport of a wrench through it. Its symbols have
/// random values.
pub(super) fn transform(
    part: &str,
    elements: &[String],
    notation: &Notation,
    defined: &[(String, Tree)],
) -> Result<Dense, String> {
    let forms = Forms::new(defined, &[])?;
    let mut whole = product(elements, notation, &forms)?;
    if part == "transport" {
        whole = transport(&whole, &forms)?;
    }
    let value = |name: &str| Some(0.3 + 1.4 * Modular::point(0).part(name));
    let truth = forms.truth_of(&whole)?;
    let each = truth.entries.iter().map(|entry| truth.form(*entry).value(&Real(value)));
    let each = each.collect::<Result<Vec<f64>, _>>()?;
    let whole = Dense::from_row_slice(whole.nrows(), whole.ncols(), &each);
    let p = Vector3::from_fn(|k, _| whole[(k, 3)]);
    Ok(match part {
        "transport" => whole,
        "rotation" => Dense::from_fn(3, 3, |r, c| whole[(r, c)]),
        "position" => Dense::from_column_slice(3, 1, p.as_slice()),
        _ => Dense::from_column_slice(3, 3, p.cross_matrix().as_slice()),
    })
}
