//! What columns span, and what lies beyond it.

/// Directions in which columns reach less than this part of the farthest are none: between rounding,
/// 1e-14 of torques, and what differs by posture.
const APART: f64 = 1e-9;

/// An orthonormal basis.
#[derive(Clone, Debug, Default)]
pub struct Basis(Vec<Vec<f64>>);

impl Basis {
    /// Of what these columns, of equal length, span.
    pub fn of(columns: Vec<Vec<f64>>) -> Basis {
        let largest = columns.iter().map(|column| norm(column)).fold(0.0, f64::max);
        let mut basis = Basis::default();
        for column in columns {
            basis.add(column, APART * largest);
        }
        basis
    }

    /// What of a column lies beyond.
    pub fn beyond(&self, mut column: Vec<f64>) -> Vec<f64> {
        // Twice is enough (Giraud, Langou & Rozložník 2005).
        for one in self.0.iter().chain(&self.0) {
            let along: f64 = one.iter().zip(&column).map(|(a, b)| a * b).sum();
            column.iter_mut().zip(one).for_each(|(x, one)| *x -= along * one);
        }
        column
    }

    /// Takes a column in if it reaches farther beyond than `least`; tells how far it does.
    pub fn add(&mut self, column: Vec<f64>, least: f64) -> f64 {
        let mut left = self.beyond(column);
        let size = norm(&left);
        if size > least {
            left.iter_mut().for_each(|x| *x /= size);
            self.0.push(left);
        }
        size
    }
}

/// Length of a column.
pub fn norm(column: &[f64]) -> f64 {
    column.iter().map(|x| x * x).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_spanned_is_not_beyond() {
        let columns =
            vec![vec![1.0, 2.0, 0.0, 0.0], vec![2.0, 4.0, 0.0, 0.0], vec![0.0, 1.0, 1.0, 0.0]];
        let basis = Basis::of(columns);
        assert_eq!(basis.0.len(), 2);
        assert!(norm(&basis.beyond(vec![3.0, 7.0, 1.0, 0.0])) < 1e-14);
        let beyond = basis.beyond(vec![1.0, 2.0, 0.0, 5.0]);
        assert!((norm(&beyond) - 5.0).abs() < 1e-14);
    }
}
