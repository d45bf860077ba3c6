//! The small linear system of the deflection, `(Kθ − K_C) δθ = τ`, and when the arm bears the load.
//!
//! **Stability.** The arm is stable where the symmetric part of `Kθ − K_C` is positive definite: then
//! `δθᵀ (Kθ − K_C) δθ > 0`, every small displacement takes work, in whatever direction.
//!
//! * Under forces and weights `Kθ − K_C` is symmetric, the second derivative of the potential energy, and
//!   this is the buckling load (Lagrange and Dirichlet).
//! * A moment that stays constant in base axes has no potential (its work depends on the order of two
//!   rotations) and gives `K_C` an antisymmetric part. Positive work in every direction (Hill's criterion)
//!   then excludes that the arm gives way statically, also with any of its joints locked or coupled; it
//!   does not depend on how the joints are numbered or measured. It is on the safe side: the first load that
//!   it refuses may be borne by an arm that is damped. The pivots of `Kθ − K_C` itself say less: under a
//!   pure moment they are the springs, whatever the moment, and `[1, −10; 10, −50]`, which falls, has
//!   pivots 1 and 50.
//!
//! The test are the pivots of `L D Lᵀ` of the symmetric part, half as many operations as an elimination.
//! Where they are positive those of `Kθ − K_C` are too, so that it is solved without exchanging rows. A load
//! that is small beside the springs in every posture needs no test: where the table tells how small, the generated
//! text passes the load's [`margin`]. Nor does the mass matrix: it is symmetric, so that the pivots of its elimination
//! are those of its `L D Lᵀ`, and the text passes 1.

use core::fmt;

use crate::Scalar;

/// The loaded arm is not in stable equilibrium: under this load the symmetric part of `Kθ − K_C` is not
/// positive definite (or the input was not finite), so that some displacement takes no work and the arm
/// would buckle rather than deflect. Forces and weights reach this at the buckling load; for a moment
/// constant in base axes, which has no potential, it is the safe side.
///
/// Of forward dynamics: the mass matrix is not positive definite, as a joint moves no mass.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Unstable;

impl fmt::Display for Unstable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("the arm is not stable under this load: K_theta - K_C is not positive definite")
    }
}

impl core::error::Error for Unstable {}

/// `1 − |f|²/F² − |m|²/M²` of a wrench and `[F, M]`, N and N·m: where it is positive, the arm surely bears the
/// load.
#[inline(always)]
pub fn margin<S: Scalar>(wrench: &[S; 6], [force, moment]: [S; 2]) -> S {
    let [fx, fy, fz, mx, my, mz] = *wrench;
    let (forces, moments) = (fx * fx + fy * fy + fz * fz, mx * mx + my * my + mz * mz);
    S::lit(1.0) - forces * (force * force).recip() - moments * (moment * moment).recip()
}

/// Solves `a · x = b` by elimination without pivoting; `a` is column-major, `a[column][row]`. Nothing
/// depends on the unknowns from `M` on, whose columns are zero but for the diagonal: the first `M` are solved for
/// together, each of the others follows from its row.
///
/// `Kθ − K_C` is unsymmetric under a moment, so this is LU and not Cholesky. The test of stability is left
/// out where `margin` is positive (in every lane), which says that it would succeed.
///
/// # Errors
/// [`Unstable`] if the symmetric part of `a` is not positive definite (in some lane), or `a` is not finite.
#[inline]
pub fn solve<S: Scalar, const N: usize, const M: usize>(
    a: [[S; N]; N],
    b: [S; N],
    margin: S,
) -> Result<[S; N], Unstable> {
    follow::<S, N, M>(a, b, margin, |x, factor, y| x - factor * y)
}

/// The same for text that asks for its products to be fused into sums ([`Scalar::mul_add`]).
///
/// # Errors
/// As [`solve`].
#[inline]
pub fn solve_fused<S: Scalar, const N: usize, const M: usize>(
    a: [[S; N]; N],
    b: [S; N],
    margin: S,
) -> Result<[S; N], Unstable> {
    follow::<S, N, M>(a, b, margin, |x, factor, y| S::mul_add(factor, -y, x))
}

/// Whether a pivot is positive and finite, by its inverse, and `x` is finite: the inverse of an infinite pivot is zero.
#[allow(clippy::eq_op, reason = "it is not zero where a number is not finite")]
#[inline(always)]
fn sound<S: Scalar>(inverse: S, x: S) -> bool {
    (inverse + (x - x)).is_positive()
}

#[inline(always)]
fn follow<S: Scalar, const N: usize, const M: usize>(
    a: [[S; N]; N],
    mut b: [S; N],
    margin: S,
    less: impl Fn(S, S, S) -> S,
) -> Result<[S; N], Unstable> {
    if !margin.is_positive() {
        core::hint::cold_path();
        definite(a, &less)?;
    }
    let leading: [[S; M]; M] = core::array::from_fn(|k| core::array::from_fn(|i| a[k][i]));
    let x = eliminate(leading, core::array::from_fn(|i| b[i]), &less)?;
    let mut stable = true;
    for i in M..N {
        // The first unknown is the last to be known.
        for k in (0..M).rev() {
            b[i] = less(b[i], a[k][i], x[k]);
        }
        let inverse = a[i][i].recip();
        b[i] = b[i] * inverse;
        stable &= sound(inverse, b[i]);
    }
    if !stable {
        return Err(Unstable);
    }
    b[..M].copy_from_slice(&x);
    Ok(b)
}

/// Unknowns up to which all loops have fixed bounds, so that the compiler writes them out and keeps the
/// system in registers: three times as fast for six.
const WRITTEN_OUT: usize = 8;

/// Whether the pivots of `L D Lᵀ` of `a + aᵀ` are positive, by its lower triangle. Few loads need it: it stays
/// out of the way of the others.
#[allow(clippy::needless_range_loop, reason = "a column is changed while another one is read")]
#[inline(always)]
fn definite<S: Scalar, const N: usize>(
    a: [[S; N]; N],
    less: impl Fn(S, S, S) -> S,
) -> Result<(), Unstable> {
    let mut twice = a;
    for column in 0..N {
        for row in 0..N {
            twice[column][row] = a[column][row] + a[row][column];
        }
    }
    let mut stable = true;
    let begin = |k: usize| if N <= WRITTEN_OUT { 0 } else { k };
    for k in 0..N {
        stable &= twice[k][k].is_positive();
        let inverse = twice[k][k].recip();
        for column in begin(k + 1)..N {
            if column > k {
                let factor = twice[k][column] * inverse;
                for row in begin(column)..N {
                    if row >= column {
                        twice[column][row] = less(twice[column][row], factor, twice[k][row]);
                    }
                }
            }
        }
    }
    if stable { Ok(()) } else { Err(Unstable) }
}

/// Elimination with `less(x, factor, y)` for `x - factor·y`, two unknowns at a time. What it costs is mostly that
/// each pivot waits for the one before:
///
/// * The second pivot of the two, times the first, is a determinant, so that both are divided by at once.
/// * It is the rows of the pivots that are divided, not the columns: then each unknown follows from the next ones
///   without a product of its own.
///
/// In single precision the product of two pivots is a number for springs from 1e-18 to 1e18 N·m/rad; others are refused.
#[inline(always)]
fn eliminate<S: Scalar, const N: usize>(
    mut a: [[S; N]; N],
    mut b: [S; N],
    less: impl Fn(S, S, S) -> S,
) -> Result<[S; N], Unstable> {
    let mut stable = true;
    if N <= WRITTEN_OUT {
        // Each call is for one number, so that the compiler knows all bounds before it writes loops out.
        stable &= N == 0 || two(0, &mut a, &mut b, &less);
        stable &= N <= 2 || two(2, &mut a, &mut b, &less);
        stable &= N <= 4 || two(4, &mut a, &mut b, &less);
        stable &= N <= 6 || two(6, &mut a, &mut b, &less);
    } else {
        (0..N).step_by(2).for_each(|k| stable &= two(k, &mut a, &mut b, &less));
    }
    if !stable {
        return Err(Unstable);
    }
    for k in (0..N).rev() {
        for i in 0..if N <= WRITTEN_OUT { N } else { k } {
            if i < k {
                b[i] = less(b[i], a[k][i], b[k]);
            }
        }
    }
    Ok(b)
}

/// Eliminates unknown `k` and the next one; whether their pivots are positive.
#[allow(clippy::needless_range_loop, reason = "a column is changed while another one is read")]
#[inline(always)]
fn two<S: Scalar, const N: usize>(
    k: usize,
    a: &mut [[S; N]; N],
    b: &mut [S; N],
    less: &impl Fn(S, S, S) -> S,
) -> bool {
    let (l, pivot) = (k + 1, a[k][k]);
    let mut stable = true;
    if l < N {
        let below = a[k][l];
        let inverse = less(pivot * a[l][l], below, a[l][k]).recip();
        stable = sound(inverse, inverse);
        for column in l + 1..N {
            a[column][l] = less(pivot * a[column][l], below, a[column][k]) * inverse;
        }
        b[l] = less(pivot * b[l], below, b[k]) * inverse;
    }
    let inverse = pivot.recip();
    stable &= sound(inverse, inverse);
    for column in l..N {
        a[column][k] = a[column][k] * inverse;
    }
    b[k] = b[k] * inverse;
    for i in l + 1..N {
        for of in [k, l] {
            for column in of + 1..N {
                a[column][i] = less(a[column][i], a[of][i], a[column][of]);
            }
            b[i] = less(b[i], a[of][i], b[of]);
        }
    }
    stable
}

#[cfg(test)]
mod tests {
    use super::*;

    /// All unknowns together, the test never left out.
    fn all<const N: usize>(a: [[f64; N]; N], b: [f64; N]) -> Result<[f64; N], Unstable> {
        solve::<_, N, N>(a, b, 0.0)
    }

    /// Without the test it is the elimination alone, and what is not finite is still refused.
    #[test]
    fn a_margin_leaves_the_test_out_and_nothing_else() {
        let falls = [[1.0, 10.0], [-10.0, -50.0]];
        assert!(solve::<_, 2, 2>(falls, [1.0, 0.0], 1.0).is_ok());
        assert_eq!(solve::<_, 2, 2>(falls, [1.0, 0.0], f64::NAN), Err(Unstable));
        for at in [(0, 0), (0, 1), (0, 2), (1, 0), (1, 1), (1, 2), (2, 2)] {
            let mut a = [[4.0, 1.0, 0.5], [1.0, 4.0, 0.5], [0.0, 0.0, 4.0]];
            for x in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
                a[at.0][at.1] = x;
                assert_eq!(solve::<_, 3, 2>(a, [1.0; 3], 1.0), Err(Unstable), "{at:?} {x}");
            }
        }
        // Pivots whose product, or whose inverse, is infinite.
        for x in [1e30_f32, 1e-30, 1e-39] {
            assert_eq!(solve::<_, 2, 2>([[x, 0.0], [0.0, x]], [1.0; 2], 1.0), Err(Unstable));
        }
        assert_eq!(solve::<_, 3, 2>([[1.0; 3]; 3], [1.0, 1.0, f64::INFINITY], 1.0), Err(Unstable));
        assert_eq!(margin(&[1.0, 2.0, 2.0, 0.0, 0.0, 4.0], [8.0, 8.0]), 1.0 - 9.0 / 64.0 - 0.25);
    }

    #[test]
    fn solves_an_unsymmetric_system() {
        let a = [[4.0, 1.0, -0.5], [-1.0, 5.0, 0.25], [0.5, 2.0, 3.0]];
        let x = [1.0, -2.0, 3.0];
        let b = core::array::from_fn(|i| (0..3).map(|k| a[k][i] * x[k]).sum::<f64>());
        let solved = all(a, b).unwrap();
        for (got, want) in solved.iter().zip(x) {
            assert!((got - want).abs() < 1e-14);
        }
    }

    /// Both ways of writing the loops, and both ways of rounding.
    #[test]
    fn small_and_large_systems_are_solved_alike() {
        fn check<const N: usize>() {
            let off = |i: usize, k: usize| ((7 * i + 3 * k) % 11) as f64 - 5.0;
            let entry = |i: usize, k: usize| if i == k { 8.0 * N as f64 } else { off(i, k) };
            let a: [[f64; N]; N] = core::array::from_fn(|k| core::array::from_fn(|i| entry(i, k)));
            let b = core::array::from_fn(|i| {
                (0..N).map(|k| entry(i, k) * (k as f64 - 2.5)).sum::<f64>()
            });
            for x in [all(a, b).unwrap(), solve_fused::<_, N, N>(a, b, 0.0).unwrap()] {
                for (k, x) in x.into_iter().enumerate() {
                    assert!((x - (k as f64 - 2.5)).abs() < 1e-12, "{N}: {k} is {x}");
                }
            }
            for k in 0..N {
                for x in [-1e3, f64::INFINITY] {
                    let mut buckled = a;
                    buckled[k][k] = x;
                    assert_eq!(all(buckled, b), Err(Unstable));
                    // By the pivots alone.
                    assert_eq!(solve::<_, N, N>(buckled, b, 1.0), Err(Unstable), "{N}: {k}");
                    assert_eq!(solve_fused::<_, N, N>(buckled, b, 1.0), Err(Unstable), "{N}: {k}");
                }
            }
        }
        check::<1>();
        check::<3>();
        check::<6>();
        check::<8>();
        check::<9>();
        check::<20>();
    }

    #[test]
    fn unknowns_that_nothing_depends_on_follow() {
        let apart = [[2.0, 0.0], [0.0, 4.0]];
        assert_eq!(solve::<_, 2, 0>(apart, [1.0, 1.0], 1.0), Ok([0.5, 0.25]));
        let mut a: [[f64; 5]; 5] =
            core::array::from_fn(|k| core::array::from_fn(|i| ((5 * i + k) % 7) as f64 - 3.0));
        (0..5).for_each(|k| a[k][k] = 30.0 + k as f64);
        for (column, entries) in a.iter_mut().enumerate().skip(3) {
            entries
                .iter_mut()
                .enumerate()
                .filter(|(i, _)| *i != column)
                .for_each(|(_, x)| *x = 0.0);
        }
        let b = [1.0, -2.0, 0.5, 4.0, -1.5];
        let whole = all(a, b).unwrap();
        for x in [solve::<_, 5, 3>(a, b, 0.0), solve_fused::<_, 5, 3>(a, b, 0.0)] {
            for (got, want) in x.unwrap().iter().zip(whole) {
                assert!((got - want).abs() < 1e-15, "{got} {want}");
            }
        }
        a[4][4] = -1.0;
        assert_eq!(solve::<_, 5, 3>(a, b, 0.0), Err(Unstable));
        a[4][4] = 1.0;
        a[0][0] = f64::NAN;
        assert_eq!(solve_fused::<_, 5, 3>(a, b, 0.0), Err(Unstable));
    }

    /// Positive pivots are not enough: a moment far beyond the springs, and an arm that falls.
    #[test]
    fn refuses_what_its_pivots_do_not_show() {
        let triangular = |m: f64| [[1.0, m], [0.0, 1.0]];
        assert!(all(triangular(1.999), [1.0, 0.0]).is_ok());
        assert_eq!(all(triangular(2.001), [1.0, 0.0]), Err(Unstable));
        assert_eq!(all([[1.0, 10.0], [-10.0, -50.0]], [1.0, 0.0]), Err(Unstable));
        let alone = |m: f64| [[1.0, 0.0, m], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        assert!(solve::<f64, 3, 2>(alone(1.999), [1.0; 3], 0.0).is_ok());
        assert_eq!(solve::<f64, 3, 2>(alone(2.001), [1.0; 3], 0.0), Err(Unstable));
        assert_eq!(solve_fused::<f64, 3, 2>(alone(-2.001), [1.0; 3], 0.0), Err(Unstable));
    }

    #[test]
    fn refuses_a_buckled_arm_and_nan() {
        assert_eq!(all([[1.0, 2.0], [2.0, 1.0]], [1.0, 1.0]), Err(Unstable));
        assert_eq!(all([[f64::NAN]], [1.0]), Err(Unstable));
        assert_eq!(all([[0.0]], [1.0]), Err(Unstable));
    }
}
