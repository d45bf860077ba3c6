//! Numbers as Rust and C write them.

use crate::number::Number;

/// A constant in Rust and C. A small one is written as the reciprocal of a large one: compliances are
/// then recognised as 1/k of the table, and a residue of rounding could not hide among them.
pub(super) fn constant(n: Number) -> String {
    if let Some((numerator, denominator)) = n.fraction() {
        return format!("{numerator}.0 / {denominator}.0");
    }
    let small = n.to_f64().abs() < SMALL && !n.is_zero();
    match n.recip().filter(|_| small) {
        Some(inverse) => format!("1.0 / {inverse}"),
        None => n.to_string(),
    }
}

/// Constants below this are written as reciprocals.
const SMALL: f64 = 1e-5;
