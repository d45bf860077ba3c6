//! Columns of a normal matrix that others before them make up.

use nalgebra::{DMatrix, DVector};

use super::basis::Basis;

/// Which columns stand apart from those before them, and of the others what those make of them.
pub struct Dependent {
    /// Columns that stand apart.
    pub apart: Vec<usize>,
    /// The others, each with its parts of those that stand apart before it, all columns brought to length 1.
    pub others: Vec<(usize, Vec<(usize, f64)>)>,
}

impl Dependent {
    /// Of columns in an order; more than `least` of the squared size of one that stands apart is its own.
    pub fn of(normal: &DMatrix<f64>, order: impl Iterator<Item = usize>, least: f64) -> Self {
        let scale = normal.diagonal().map(|d| if d > 0.0 { 1.0 / d.sqrt() } else { 0.0 });
        let scaled = |r: usize, c: usize| normal[(r, c)] * scale[r] * scale[c];
        let (mut apart, mut others): (Vec<usize>, Vec<_>) = (Vec::new(), Vec::new());
        for column in order {
            let own = DMatrix::from_fn(apart.len(), apart.len(), |r, c| scaled(apart[r], apart[c]));
            let cross = DVector::from_fn(apart.len(), |r, _| scaled(apart[r], column));
            let parts = Basis::new(&own).solve(&cross);
            if 1.0 - cross.dot(&parts) > least {
                apart.push(column);
            } else {
                others.push((column, apart.iter().copied().zip(parts.iter().copied()).collect()));
            }
        }
        Self { apart, others }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sum_of_columns_is_told_with_its_parts() {
        // Column 2 is column 0 less twice column 1.
        let rows = DMatrix::from_fn(6, 4, |r, c| {
            let (a, b) = ((1.7 * r as f64).sin(), (0.9 * r as f64).cos());
            [a, b, a - 2.0 * b, (r * r) as f64][c]
        });
        let found = Dependent::of(&rows.tr_mul(&rows), 0..4, 1e-5);
        assert_eq!(found.apart, [0, 1, 3]);
        let (column, parts) = &found.others[0];
        let size = |c: usize| rows.column(c).norm();
        let wanted = [(0, size(0) / size(2)), (1, -2.0 * size(1) / size(2))];
        assert_eq!((*column, parts.len()), (2, 2));
        for ((of, part), (wanted_of, wanted)) in parts.iter().zip(wanted) {
            assert!(*of == wanted_of && (part - wanted).abs() < 1e-9, "{parts:?}");
        }
    }
}
