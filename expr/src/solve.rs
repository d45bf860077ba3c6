//! Linear systems and determinants written out.

use std::collections::HashMap;

use super::graph::{Expr, Graph};

impl Graph {
    /// The solutions of `matrix · x = right` for several right-hand sides, by elimination without pivoting,
    /// written out; the matrix is column-major. Its pivots must not be zero: those of a matrix with a positive
    /// definite symmetric part are not.
    pub fn eliminated(&mut self, matrix: &[Expr], rights: Vec<Vec<Expr>>) -> Vec<Vec<Expr>> {
        let n = rights.first().map_or(0, Vec::len);
        let (mut a, mut rights) = (matrix.to_vec(), rights);
        let mut inverses = Vec::with_capacity(n);
        for k in 0..n {
            let inverse = self.recip(a[k * n + k]);
            inverses.push(inverse);
            for row in k + 1..n {
                let factor = self.mul(a[k * n + row], inverse);
                for column in k + 1..n {
                    let part = self.mul(factor, a[column * n + k]);
                    a[column * n + row] = self.sub(a[column * n + row], part);
                }
                for right in &mut rights {
                    let part = self.mul(factor, right[k]);
                    right[row] = self.sub(right[row], part);
                }
            }
        }
        for right in &mut rights {
            for k in (0..n).rev() {
                for column in k + 1..n {
                    let part = self.mul(a[column * n + k], right[column]);
                    right[k] = self.sub(right[k], part);
                }
                right[k] = self.mul(right[k], inverses[k]);
            }
        }
        rights
    }

    /// All determinants of as many of `lines` (at most 64) as each has entries, in no order but always the same,
    /// without a division: of the first entries of subsets of the lines, then the first two, and so on (Laplace),
    /// each subset once.
    pub fn minors(&mut self, lines: &[Vec<Expr>]) -> Vec<Expr> {
        let size = lines.first().map_or(0, Vec::len);
        let mut minors: Vec<(u64, Expr)> = vec![(0, Expr::ONE)];
        for entry in 0..size {
            let mut order: Vec<u64> = Vec::new();
            let mut sums: HashMap<u64, Expr> = HashMap::new();
            for (subset, minor) in minors {
                for (line, entries) in
                    lines.iter().enumerate().filter(|(l, _)| subset >> l & 1 == 0)
                {
                    // The sign is that of the exchanges that bring the line behind the larger ones.
                    let odd = (subset >> line).count_ones() % 2 == 1;
                    let term = self.mul(entries[entry], minor).signed(odd);
                    let with = subset | 1 << line;
                    let sum = sums.entry(with).or_insert_with(|| {
                        order.push(with);
                        Expr::ZERO
                    });
                    *sum = self.add(*sum, term);
                }
            }
            minors = order.into_iter().map(|subset| (subset, sums[&subset])).collect();
            minors.retain(|(_, minor)| !minor.is_zero());
        }
        minors.into_iter().map(|(_, minor)| minor).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::super::graph::Symbol;
    use super::*;

    fn symbols(g: &mut Graph, count: usize) -> Vec<Expr> {
        (0..count).map(|k| g.symbol(Symbol::Joint(k))).collect()
    }

    /// Any numbers: none is a multiple of another.
    fn value(symbol: &Symbol) -> f64 {
        let Symbol::Joint(k) = symbol else { panic!("{symbol:?}") };
        (1.7 * (*k as f64 + 1.0)).sin() + if k % 5 == 0 { 4.0 } else { 0.0 }
    }

    #[test]
    fn what_is_eliminated_solves_the_system() {
        let mut g = Graph::new();
        let all = symbols(&mut g, 24);
        let (matrix, rights) = (&all[..16], vec![all[16..20].to_vec(), all[20..24].to_vec()]);
        for (right, solved) in rights.clone().into_iter().zip(g.eliminated(matrix, rights)) {
            for row in 0..4 {
                let sum = (0..4).fold(Expr::ZERO, |sum, column| {
                    let part = g.mul(matrix[4 * column + row], solved[column]);
                    g.add(sum, part)
                });
                let both = g.evaluate(&[sum, right[row]], value);
                assert!((both[0] - both[1]).abs() < 1e-14, "{both:?}");
            }
        }
    }

    /// Of a square by elimination; of 5 lines of 3 entries by Cauchy and Binet's sum against det of the Gram matrix.
    #[test]
    fn minors_are_determinants() {
        let mut g = Graph::new();
        let all = symbols(&mut g, 16);
        let lines: Vec<Vec<Expr>> = all.chunks(4).map(<[Expr]>::to_vec).collect();
        let [minor] = g.minors(&lines)[..] else { panic!("one") };
        let numbers = nested(&g.evaluate(&all, value), 4);
        assert!((g.evaluate(&[minor], value)[0] - determinant(numbers)).abs() < 1e-12);

        let lines: Vec<Vec<Expr>> = all[..15].chunks(3).map(<[Expr]>::to_vec).collect();
        let minors = g.minors(&lines);
        assert_eq!(minors.len(), 10);
        let squares: f64 = g.evaluate(&minors, value).iter().map(|m| m * m).sum();
        let lines = nested(&g.evaluate(&all[..15], value), 3);
        let gram = |r: usize, c: usize| lines.iter().map(|line| line[r] * line[c]).sum::<f64>();
        let gram = (0..3).map(|r| (0..3).map(|c| gram(r, c)).collect()).collect();
        assert!((squares / determinant(gram) - 1.0).abs() < 1e-13);
    }

    fn nested(flat: &[f64], row: usize) -> Vec<Vec<f64>> {
        flat.chunks(row).map(<[f64]>::to_vec).collect()
    }

    fn determinant(mut a: Vec<Vec<f64>>) -> f64 {
        let mut product = 1.0;
        for k in 0..a.len() {
            product *= a[k][k];
            for row in k + 1..a.len() {
                let factor = a[row][k] / a[k][k];
                let pivot = a[k].clone();
                a[row].iter_mut().zip(&pivot).for_each(|(x, p)| *x -= factor * p);
            }
        }
        product
    }
}
