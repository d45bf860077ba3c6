//! Least squares over values that have a least physical one: an active set.
//!
//! Values that want to go below are held at their bounds, one after the other. A bound that was hit
//! is given up again where the squares would fall by that (its multiplier is negative), so that the
//! end meets the conditions of Karush, Kuhn and Tucker whatever the order in which the bounds
//! were hit (Lawson & Hanson 1974, ch. 23).

use nalgebra::{DMatrix, DVector};

use super::basis::Basis;
use super::limits::LAST_DIGITS;

/// `A`, `b` of the squares `xᵀ A x − 2 bᵀ x`, and when a direction is undecided.
pub struct Squares<'s> {
    /// `A`, k×k.
    pub matrix: &'s DMatrix<f64>,
    /// `b`.
    pub right: &'s DVector<f64>,
    /// Squared size of each unknown's column before others were projected out of it.
    pub sizes: DVector<f64>,
    /// A direction whose part of the matrix, scaled by the sizes, is below this stays as it is.
    pub decided: f64,
}

impl Squares<'_> {
    /// By how much such values make the squares fall.
    pub fn fall(&self, x: &DVector<f64>) -> f64 {
        2.0 * x.dot(self.right) - x.dot(&(self.matrix * x))
    }

    /// The values of least squares that are nowhere below `least`, and the number of directions
    /// that are decided without any bound.
    pub fn solve(&self, least: &[f64]) -> (DVector<f64>, usize) {
        let count = self.right.len();
        let mut x = DVector::<f64>::zeros(count);
        let mut free: Vec<usize> = (0..count).collect();
        let mut rank = None;
        loop {
            let decided = self.minimise(&free, &mut x);
            let rank = *rank.get_or_insert(decided);
            let Some(position) = free.iter().position(|at| x[*at] < least[*at]) else {
                self.release(least, &mut free, &mut x);
                return (x, rank);
            };
            let at = free.remove(position);
            x[at] = least[at];
        }
    }

    /// Puts the `free` values where the squares are least, the others where they are; the number
    /// of directions decided.
    fn minimise(&self, free: &[usize], x: &mut DVector<f64>) -> usize {
        let mut held = x.clone();
        free.iter().for_each(|at| held[*at] = 0.0);
        let part = self.matrix.select_rows(free).select_columns(free);
        let target = (self.right - self.matrix * held).select_rows(free);
        let basis = Basis::decided(&part, &self.sizes.select_rows(free), self.decided);
        for (at, value) in free.iter().zip(basis.solve(&target).iter()) {
            x[*at] = *value;
        }
        basis.rank()
    }

    /// Gives up bounds as long as the squares fall by that. They fall with each, so that no set
    /// of bounds comes twice.
    fn release(&self, least: &[f64], free: &mut Vec<usize>, x: &mut DVector<f64>) {
        while free.len() < x.len() {
            let slope = self.right - self.matrix * &*x;
            let worth = |at: &usize| slope[*at].max(0.0).powi(2) / self.matrix[(*at, *at)];
            let held = (0..x.len()).filter(|at| !free.contains(at) && worth(at).is_finite());
            let Some(best) = held.max_by(|a, b| worth(a).total_cmp(&worth(b))) else { return };
            if worth(&best) <= LAST_DIGITS * self.fall(x).abs() {
                return;
            }
            let before = (x.clone(), self.fall(x));
            free.push(best);
            // Towards the new minimum, as far as no other value leaves what is physical.
            loop {
                let mut next = x.clone();
                self.minimise(free, &mut next);
                let part = |at: usize| (x[at] - least[at]) / (x[at] - next[at]);
                let first = (0..free.len())
                    .filter(|&k| next[free[k]] < least[free[k]])
                    .min_by(|&a, &b| part(free[a]).total_cmp(&part(free[b])));
                let Some(first) = first else {
                    *x = next;
                    break;
                };
                let (at, part) = (free[first], part(free[first]));
                *x += (next - &*x) * part;
                x[at] = least[at];
                free.remove(first);
            }
            if self.fall(x) <= before.1 {
                // Rounding: nothing is left to be gained.
                *x = before.0;
                return;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn any(k: usize) -> f64 {
        let x = (12.9898 * (k as f64 + 1.0)).sin() * 43_758.545_3;
        2.0 * (x - x.floor()) - 1.0
    }

    /// The least of all sets of bounds.
    fn by_trial(squares: &Squares<'_>, least: &[f64]) -> f64 {
        let p = least.len();
        let feasible = (0..1_usize << p).filter_map(|set| {
            let free: Vec<usize> = (0..p).filter(|k| set >> k & 1 == 1).collect();
            let mut x = DVector::from_column_slice(least);
            squares.minimise(&free, &mut x);
            let inside = (0..p).all(|k| x[k] >= least[k]);
            inside.then(|| squares.fall(&x))
        });
        feasible.fold(f64::MIN, f64::max)
    }

    /// What the search did before: bounds that were hit stay.
    fn held_for_good(squares: &Squares<'_>, least: &[f64]) -> f64 {
        let mut x = DVector::zeros(least.len());
        let mut free: Vec<usize> = (0..least.len()).collect();
        loop {
            squares.minimise(&free, &mut x);
            let Some(position) = free.iter().position(|at| x[*at] < least[*at]) else {
                return squares.fall(&x);
            };
            let at = free.remove(position);
            x[at] = least[at];
        }
    }

    #[test]
    fn the_least_squares_over_all_sets_of_bounds_are_found() {
        let (mut stuck, p) = (0, 5);
        for draw in 0..300 {
            let rows = DMatrix::from_fn(7, p, |r, c| any(draw * 100 + r * p + c));
            let gap = DVector::from_fn(7, |r, _| any(draw * 100 + 60 + r));
            let (matrix, right) = (rows.tr_mul(&rows), rows.tr_mul(&gap));
            let squares = Squares {
                matrix: &matrix,
                right: &right,
                sizes: matrix.diagonal(),
                decided: 1e-11,
            };
            let least: Vec<f64> =
                (0..p).map(|k| if k == 0 { f64::NEG_INFINITY } else { -0.1 }).collect();
            let bounds: Vec<f64> = least.iter().map(|l| l.max(-1e3)).collect();
            let (x, rank) = squares.solve(&least);
            assert!(rank == p && x.iter().zip(&least).all(|(x, l)| x >= l), "{x}");
            let (found, want) = (squares.fall(&x), by_trial(&squares, &bounds));
            // Sums of some ten products.
            assert!((found - want).abs() < 1e-12 * (1.0 + want.abs()), "{draw}: {found} {want}");
            stuck += usize::from(held_for_good(&squares, &least) < want - 1e-6);
        }
        assert!(stuck > 5, "{stuck} of 300 would be left at a bound that nothing asks for");
    }
}
