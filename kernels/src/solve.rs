//! The small linear system of the deflection, `(Kθ − K_C) δθ = τ`.

use core::fmt;

use crate::Scalar;

/// The loaded arm is not in stable equilibrium: under this load `Kθ − K_C` has a pivot that is not
/// positive (or the input was not finite), so it would buckle rather than deflect.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Unstable;

impl fmt::Display for Unstable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(
            "the arm is not stable under this load: K_theta - K_C has a pivot that is not positive",
        )
    }
}

impl core::error::Error for Unstable {}

/// Solves `a · x = b` by elimination without pivoting; `a` is column-major, `a[column][row]`.
///
/// `Kθ − K_C` is unsymmetric under a moment, so this is LU and not Cholesky. In a stable equilibrium
/// its symmetric part is positive definite, and then every pivot is positive and none needs exchanging.
///
/// # Errors
/// [`Unstable`] if a pivot is not positive (in some lane).
pub fn solve<S: Scalar, const N: usize>(
    mut a: [[S; N]; N],
    mut b: [S; N],
) -> Result<[S; N], Unstable> {
    let mut stable = true;
    for k in 0..N {
        stable &= a[k][k].is_positive();
        let inverse = a[k][k].recip();
        for i in k + 1..N {
            let factor = a[k][i] * inverse;
            for column in a.iter_mut().skip(k + 1) {
                column[i] = column[i] - factor * column[k];
            }
            b[i] = b[i] - factor * b[k];
        }
    }
    if !stable {
        return Err(Unstable);
    }
    for k in (0..N).rev() {
        b[k] = b[k] * a[k][k].recip();
        for i in 0..k {
            b[i] = b[i] - a[k][i] * b[k];
        }
    }
    Ok(b)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solves_an_unsymmetric_system() {
        let a = [[4.0, 1.0, -0.5], [-1.0, 5.0, 0.25], [0.5, 2.0, 3.0]];
        let x = [1.0, -2.0, 3.0];
        let b = core::array::from_fn(|i| (0..3).map(|k| a[k][i] * x[k]).sum::<f64>());
        let solved = solve(a, b).unwrap();
        for (got, want) in solved.iter().zip(x) {
            assert!((got - want).abs() < 1e-14);
        }
    }

    #[test]
    fn refuses_a_buckled_arm_and_nan() {
        assert_eq!(solve([[1.0, 2.0], [2.0, 1.0]], [1.0, 1.0]), Err(Unstable));
        assert_eq!(solve([[f64::NAN]], [1.0]), Err(Unstable));
        assert_eq!(solve([[0.0]], [1.0]), Err(Unstable));
    }
}
