//! Matrices of doubles whose shapes may not fit; a number is 1×1, a vector a column.

use nalgebra::DMatrix;

/// A pivot below this part of the largest entry makes a matrix singular.
const SINGULAR: f64 = 1e-11;

/// A matrix.
pub type Dense = DMatrix<f64>;

/// A number.
pub fn scalar(value: f64) -> Dense {
    Dense::from_element(1, 1, value)
}

/// Whether it is 1×1.
pub fn is_scalar(m: &Dense) -> bool {
    m.shape() == (1, 1)
}

/// `a + factor · b`; `None` if the shapes differ.
pub fn plus(a: &Dense, b: &Dense, factor: f64) -> Option<Dense> {
    (a.shape() == b.shape()).then(|| a + b * factor)
}

/// The product; a 1×1 factor is a number. `None` if the shapes do not fit.
pub fn times(a: &Dense, b: &Dense) -> Option<Dense> {
    match (is_scalar(a), is_scalar(b)) {
        (true, _) => Some(b * a[(0, 0)]),
        (_, true) => Some(a * b[(0, 0)]),
        _ => (a.ncols() == b.nrows()).then(|| a * b),
    }
}

/// The inverse; `None` if there is none.
pub fn inverse(m: &Dense) -> Option<Dense> {
    let parts = m.is_square().then(|| m.clone().lu())?;
    let least = parts.u().diagonal().abs().min();
    if least <= SINGULAR * m.amax() { None } else { parts.try_inverse() }
}

/// The pseudo-inverse, from singular values: it knows nothing of M Mᵀ and its inverse.
pub fn pseudo_inverse(m: &Dense) -> Option<Dense> {
    m.clone().pseudo_inverse(SINGULAR * m.amax()).ok()
}

/// Blocks side by side and one below the other; `None` if they do not fit.
pub fn blocks(rows: &[Vec<Dense>]) -> Option<Dense> {
    let columns = rows.first()?.iter().map(|block| block.ncols()).sum();
    let heights = rows.iter().map(|row| row.first().map_or(0, |block| block.nrows()));
    let mut whole = Dense::zeros(heights.clone().sum(), columns);
    let mut top = 0;
    for (row, height) in rows.iter().zip(heights) {
        let width: usize = row.iter().map(|block| block.ncols()).sum();
        if width != columns || row.iter().any(|block| block.nrows() != height) {
            return None;
        }
        let mut left = 0;
        for block in row {
            whole.view_mut((top, left), block.shape()).copy_from(block);
            left += block.ncols();
        }
        top += height;
    }
    Some(whole)
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
    fn what_has_no_inverse_has_none() {
        let m = sample(5, 5);
        assert!((&m * inverse(&m).unwrap() - Dense::identity(5, 5)).amax() < 1e-12);
        let wide = sample(3, 5);
        assert_eq!((inverse(&(wide.transpose() * &wide)), inverse(&wide)), (None, None));
        let back = pseudo_inverse(&wide).unwrap() * &wide;
        assert!((&wide * &back - &wide).amax() < 1e-12);
        // The shortest: its rows lie in the row space.
        assert!((&back - back.transpose()).amax() < 1e-12);
    }

    #[test]
    fn shapes_must_fit() {
        let (a, b) = (sample(2, 3), sample(3, 3));
        assert_eq!(times(&a, &b).unwrap().shape(), (2, 3));
        assert_eq!((times(&b, &a), plus(&a, &b, 1.0)), (None, None));
        assert_eq!(times(&scalar(2.0), &a).unwrap()[(1, 2)], 2.0 * a[(1, 2)]);
        let whole = blocks(&[vec![a.clone(), a.clone()], vec![b.clone(), b]]).unwrap();
        assert_eq!((whole.shape(), whole[(1, 3)]), ((5, 6), a[(1, 0)]));
        assert_eq!(blocks(&[vec![a.clone()], vec![sample(2, 2)]]), None);
    }
}
