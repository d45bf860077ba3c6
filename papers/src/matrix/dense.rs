//! Small dense matrices of doubles.

/// A pivot below this part of the largest entry makes a matrix singular.
const SINGULAR: f64 = 1e-11;

/// A matrix, row by row; a scalar is 1×1, a vector a column.
#[derive(Clone, Debug, PartialEq)]
pub struct Dense {
    /// Number of rows.
    pub rows: usize,
    /// Number of columns.
    pub columns: usize,
    entries: Vec<f64>,
}

impl Dense {
    /// By a function of row and column.
    pub fn from_fn(rows: usize, columns: usize, of: impl Fn(usize, usize) -> f64) -> Self {
        let entries = (0..rows * columns).map(|k| of(k / columns, k % columns)).collect();
        Dense { rows, columns, entries }
    }

    /// A number.
    pub fn scalar(value: f64) -> Self {
        Dense { rows: 1, columns: 1, entries: vec![value] }
    }

    /// Ones on the diagonal.
    pub fn identity(n: usize) -> Self {
        Dense::from_fn(n, n, |r, c| f64::from(u8::from(r == c)))
    }

    /// An entry, from 0.
    pub fn at(&self, row: usize, column: usize) -> f64 {
        self.entries[row * self.columns + column]
    }

    /// Whether it is 1×1.
    pub fn is_scalar(&self) -> bool {
        (self.rows, self.columns) == (1, 1)
    }

    /// Rows and columns.
    pub fn shape(&self) -> (usize, usize) {
        (self.rows, self.columns)
    }

    /// Times a number.
    pub fn scaled(&self, factor: f64) -> Self {
        Dense::from_fn(self.rows, self.columns, |r, c| factor * self.at(r, c))
    }

    /// `self + factor · other`; `None` if the shapes differ.
    pub fn plus(&self, other: &Dense, factor: f64) -> Option<Self> {
        (self.shape() == other.shape()).then(|| {
            Dense::from_fn(self.rows, self.columns, |r, c| self.at(r, c) + factor * other.at(r, c))
        })
    }

    /// The product; a 1×1 factor is a number. `None` if the shapes do not fit.
    pub fn times(&self, other: &Dense) -> Option<Self> {
        if self.is_scalar() {
            return Some(other.scaled(self.at(0, 0)));
        }
        if other.is_scalar() {
            return Some(self.scaled(other.at(0, 0)));
        }
        (self.columns == other.rows).then(|| {
            Dense::from_fn(self.rows, other.columns, |r, c| {
                (0..self.columns).map(|k| self.at(r, k) * other.at(k, c)).sum()
            })
        })
    }

    /// Rows for columns.
    pub fn transposed(&self) -> Self {
        Dense::from_fn(self.columns, self.rows, |r, c| self.at(c, r))
    }

    /// The inverse; `None` if there is none.
    pub fn inverse(&self) -> Option<Self> {
        if self.rows != self.columns {
            return None;
        }
        let n = self.rows;
        let (mut a, mut out) = (self.clone(), Dense::identity(n));
        let size = self.largest();
        for k in 0..n {
            let pivot = (k..n).max_by(|i, j| a.at(*i, k).abs().total_cmp(&a.at(*j, k).abs()))?;
            if a.at(pivot, k).abs() <= SINGULAR * size {
                return None;
            }
            for m in [&mut a, &mut out] {
                (0..n).for_each(|c| m.entries.swap(k * n + c, pivot * n + c));
            }
            let inverse = 1.0 / a.at(k, k);
            for m in [&mut a, &mut out] {
                (0..n).for_each(|c| m.entries[k * n + c] *= inverse);
            }
            for row in (0..n).filter(|row| *row != k) {
                let factor = a.at(row, k);
                for m in [&mut a, &mut out] {
                    (0..n).for_each(|c| m.entries[row * n + c] -= factor * m.entries[k * n + c]);
                }
            }
        }
        Some(out)
    }

    /// The pseudo-inverse of a matrix of full rank, by Newton's iteration X ← X (2 I − M X) of
    /// Schulz and Ben-Israel: it knows nothing of M Mᵀ and its inverse.
    pub fn pseudo_inverse(&self) -> Option<Self> {
        let square: f64 = self.entries.iter().map(|x| x * x).sum();
        let mut x = self.transposed().scaled(1.0 / square);
        let twice = Dense::identity(self.rows).scaled(2.0);
        for _ in 0..100 {
            x = x.times(&twice.plus(&self.times(&x)?, -1.0)?)?;
        }
        Some(x)
    }

    /// The sum of the diagonal.
    pub fn trace(&self) -> Option<f64> {
        (self.rows == self.columns).then(|| (0..self.rows).map(|k| self.at(k, k)).sum())
    }

    /// Frobenius' norm.
    pub fn norm(&self) -> f64 {
        self.entries.iter().map(|x| x * x).sum::<f64>().sqrt()
    }

    /// The largest entry by magnitude.
    pub fn largest(&self) -> f64 {
        self.entries.iter().fold(0.0, |m: f64, x| m.max(x.abs()))
    }

    /// Blocks side by side and one below the other; `None` if they do not fit.
    pub fn blocks(rows: &[Vec<Dense>]) -> Option<Self> {
        let columns: usize = rows.first()?.iter().map(|block| block.columns).sum();
        let mut entries = Vec::new();
        for row in rows {
            let height = row.first()?.rows;
            let width: usize = row.iter().map(|block| block.columns).sum();
            if width != columns || row.iter().any(|block| block.rows != height) {
                return None;
            }
            for r in 0..height {
                let each = row.iter().flat_map(|block| (0..block.columns).map(move |c| (block, c)));
                entries.extend(each.map(|(block, c)| block.at(r, c)));
            }
        }
        Some(Dense { rows: entries.len() / columns, columns, entries })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample(rows: usize, columns: usize) -> Dense {
        Dense::from_fn(rows, columns, |r, c| {
            ((7 * r + 3 * c) % 11) as f64 - 4.5 + 0.1 * (r * c) as f64
        })
    }

    #[test]
    fn an_inverse_undoes() {
        let m = sample(5, 5);
        let one = m.times(&m.inverse().unwrap()).unwrap();
        assert!(one.plus(&Dense::identity(5), -1.0).unwrap().largest() < 1e-12);
        let wide = sample(3, 5);
        assert_eq!(wide.transposed().times(&wide).unwrap().inverse(), None);
        assert_eq!(wide.inverse(), None);
        let pseudo = wide.pseudo_inverse().unwrap();
        let one = wide.times(&pseudo).unwrap();
        assert!(one.plus(&Dense::identity(3), -1.0).unwrap().largest() < 1e-12);
        // The shortest: its rows lie in the row space.
        let back = pseudo.times(&wide).unwrap();
        assert!(back.plus(&back.transposed(), -1.0).unwrap().largest() < 1e-12);
    }

    #[test]
    fn shapes_must_fit() {
        let (a, b) = (sample(2, 3), sample(3, 3));
        assert_eq!(a.times(&b).unwrap().shape(), (2, 3));
        assert_eq!((b.times(&a), a.plus(&b, 1.0), a.trace()), (None, None, None));
        assert_eq!(Dense::scalar(2.0).times(&a).unwrap().at(1, 2), 2.0 * a.at(1, 2));
        let whole = Dense::blocks(&[vec![a.clone(), a.clone()], vec![b.clone(), b]]).unwrap();
        assert_eq!((whole.shape(), whole.at(1, 3)), ((5, 6), a.at(1, 0)));
        assert_eq!(Dense::blocks(&[vec![a.clone()], vec![sample(2, 2)]]), None);
    }
}
