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

/// A shape in words.
pub fn shape(m: &Dense) -> String {
    format!("{}×{}", m.nrows(), m.ncols())
}

/// `a + factor · b`; a lone zero is a zero of any shape.
///
/// # Errors
/// Shapes that differ.
pub fn sum(a: &Dense, b: &Dense, factor: f64) -> Result<Dense, String> {
    match (a.shape() == b.shape(), is_scalar(a) && a[(0, 0)] == 0.0) {
        (true, _) => Ok(a + b * factor),
        (_, true) => Ok(b * factor),
        _ => Err(format!("{} and {} are added", shape(a), shape(b))),
    }
}

/// The product; a 1×1 factor is a number.
///
/// # Errors
/// Shapes that do not fit.
pub fn product(a: &Dense, b: &Dense) -> Result<Dense, String> {
    match (is_scalar(a), is_scalar(b)) {
        (true, _) => Ok(b * a[(0, 0)]),
        (_, true) => Ok(a * b[(0, 0)]),
        _ if a.ncols() == b.nrows() => Ok(a * b),
        _ => Err(format!("{} and {} are multiplied", shape(a), shape(b))),
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

/// Blocks side by side and one below the other; a number among matrices is that multiple of the
/// identity, or zeros.
///
/// # Errors
/// Blocks that do not fit.
pub fn blocks(rows: &[Vec<Dense>]) -> Result<Dense, String> {
    let columns = rows.first().map_or(0, Vec::len);
    if rows.iter().any(|row| row.len() != columns) {
        return Err("rows of different lengths".into());
    }
    let most = |sizes: &mut dyn Iterator<Item = usize>| sizes.max().unwrap_or(1);
    let height = |row: &Vec<Dense>| most(&mut row.iter().map(|block| block.nrows()));
    let heights: Vec<usize> = rows.iter().map(height).collect();
    let width = |c: usize| most(&mut rows.iter().map(|row| row[c].ncols()));
    let widths: Vec<usize> = (0..columns).map(width).collect();
    let mut whole = Dense::zeros(heights.iter().sum(), widths.iter().sum());
    for (r, row) in rows.iter().enumerate() {
        for (c, block) in row.iter().enumerate() {
            let (at, size) =
                ((heights[..r].iter().sum(), widths[..c].iter().sum()), (heights[r], widths[c]));
            let mut place = whole.view_mut(at, size);
            match block.shape() == size {
                true => place.copy_from(block),
                false if is_scalar(block) && (block[(0, 0)] == 0.0 || size.0 == size.1) => {
                    place.fill_diagonal(block[(0, 0)]);
                }
                false => return Err("the blocks do not fit".into()),
            }
        }
    }
    Ok(whole)
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
        assert_eq!(product(&a, &b).unwrap().shape(), (2, 3));
        assert!(product(&b, &a).is_err() && sum(&a, &b, 1.0).is_err());
        assert_eq!(product(&scalar(2.0), &a).unwrap()[(1, 2)], 2.0 * a[(1, 2)]);
        let rows = [vec![a.clone(), a.clone()], vec![b.clone(), scalar(4.0)]];
        let whole = blocks(&rows).unwrap();
        assert_eq!((whole.shape(), whole[(1, 3)], whole[(4, 5)]), ((5, 6), a[(1, 0)], 4.0));
        assert!(blocks(&[vec![a.clone()], vec![sample(2, 2)]]).is_err());
        assert!(blocks(&[vec![a.clone()], vec![a.clone(), a]]).is_err());
    }
}
