//! Static equilibrium: the displacements that their own loads cause.
//!
//! `u = C(Q(u))`, `Q` the generalised forces on the deformed arm, `C` the laws of the sites, is
//! iterated as it stands while that converges fast, which it does for any arm that is stiff enough
//! to be one; else by Newton's method. `∂Q/∂u` is then a difference quotient, which costs accuracy
//! only in the steps, not in where they end.

use nalgebra::{DMatrix, DVector};

use super::chain::{Chain, Part};
use super::transform::origin;

/// The arm does not carry the load: it buckles, or no equilibrium was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Unstable;

/// Step of the difference quotient, rad and m: half of the digits.
const STEP: f64 = 1e-7;

/// Relative size of the last step: a few roundings of the generalised forces.
const CLOSE: f64 = 1e-13;

/// Steps are to shrink by this at least.
const FAST: f64 = 0.2;

const MOST_STEPS: usize = 60;

/// The unknowns of a chain at rest.
///
/// # Errors
/// [`Unstable`] if the iteration does not end, or ends where the elastic energy does not outweigh
/// the work of the loads.
pub(super) fn rest(chain: &Chain) -> Result<Vec<f64>, Unstable> {
    let mut u = DVector::zeros(chain.unknowns);
    if chain.unknowns == 0 {
        return Ok(Vec::new());
    }
    let mut newton: Option<Factors> = None;
    let mut last = f64::INFINITY;
    for _ in 0..MOST_STEPS {
        let away = DVector::from_vec(chain.wanted(u.as_slice())) - &u;
        let step = match &newton {
            Some(factors) => factors.solve(&away).ok_or(Unstable)?,
            None => away,
        };
        let size = step.amax();
        u += step;
        if !size.is_finite() || u.amax() > 10.0 {
            return Err(Unstable);
        }
        // The second condition ends at rounding, where steps no longer get smaller.
        let scale = u.amax();
        if size <= CLOSE * scale || (size <= 100.0 * CLOSE * scale && size >= 0.5 * last) {
            let stable = load_bound(chain, &u) < 1.0 || is_stable(chain, &u);
            return if stable { Ok(u.as_slice().to_vec()) } else { Err(Unstable) };
        }
        if size > FAST * last {
            newton = Some(iteration(chain, &u)?);
        }
        last = size;
    }
    Err(Unstable)
}

type Factors = nalgebra::LU<f64, nalgebra::Dyn, nalgebra::Dyn>;

/// `I − C'(Q) ∂Q/∂u`, factored.
fn iteration(chain: &Chain, u: &DVector<f64>) -> Result<Factors, Unstable> {
    let forces = chain.forces(u.as_slice());
    let mut slope = DMatrix::zeros(chain.unknowns, chain.unknowns);
    for site in chain.sites() {
        let k = site.components.len();
        let own = &forces[site.first..site.first + k];
        slope.view_mut((site.first, site.first), (k, k)).copy_from(&site.law.slope(own));
    }
    let matrix = DMatrix::identity(chain.unknowns, chain.unknowns)
        - slope * load_stiffness(chain, u, &forces);
    if matrix.iter().all(|x| x.is_finite()) { Ok(matrix.lu()) } else { Err(Unstable) }
}

/// `∂Q/∂u`, row by force, column by unknown.
fn load_stiffness(chain: &Chain, u: &DVector<f64>, forces: &[f64]) -> DMatrix<f64> {
    let mut moved = u.clone();
    let mut stiffness = DMatrix::zeros(u.len(), u.len());
    for k in 0..u.len() {
        moved[k] = u[k] + STEP;
        let there = chain.forces(moved.as_slice());
        for (row, (to, from)) in there.iter().zip(forces).enumerate() {
            stiffness[(row, k)] = (to - from) / STEP;
        }
        moved[k] = u[k];
    }
    stiffness
}

/// Whether `I − Lᵀ sym(∂Q/∂u) L` is positive definite, `L Lᵀ` the elastic flexibility: the
/// stiffness of springs and links less that of the loads, in coordinates in which rigid
/// directions do no harm.
fn is_stable(chain: &Chain, u: &DVector<f64>) -> bool {
    let n = chain.unknowns;
    let forces = chain.forces(u.as_slice());
    let stiffness = load_stiffness(chain, u, &forces);
    let symmetric = (&stiffness + stiffness.transpose()) / 2.0;
    let mut root = DMatrix::zeros(n, n);
    for site in chain.sites() {
        let k = site.components.len();
        let own = square_root(&site.law.flexibility());
        root.view_mut((site.first, site.first), (k, k)).copy_from(&own);
    }
    let matrix = DMatrix::identity(n, n) - root.transpose() * symmetric * &root;
    matrix.cholesky().is_some()
}

/// An upper bound of the largest eigenvalue of `Lᵀ sym(∂Q/∂u) L`: below 1, the arm is stable, and
/// no difference quotient is needed to say so.
///
/// A second derivative of a point's place is at most its distance by two rotations, 1 by a rotation
/// and a translation, 0 by two translations. With all forces `F` in the farthest point, at `R`,
/// and the couple `M`, and the traces `A` and `B` of the sites' flexibilities in rotation and in
/// translation, Cauchy and Schwarz give `(F R + M) A + 2 F √(A B)`.
fn load_bound(chain: &Chain, u: &DVector<f64>) -> f64 {
    let (mut reach, mut farthest) = (u.lp_norm(1), chain.payload.norm());
    let mut force = chain.force.norm();
    let (mut turning, mut sliding) = (0.0, 0.0);
    for part in &chain.parts {
        match part {
            Part::Fixed(transform) => reach += origin(transform).norm(),
            Part::Weight { point, force: weight } => {
                farthest = farthest.max(point.norm());
                force += weight.norm();
            }
            Part::Site(site) => {
                let flexibility = site.law.flexibility();
                for (k, component) in site.components.iter().enumerate() {
                    let sum = if *component < 3 { &mut sliding } else { &mut turning };
                    *sum += flexibility[(k, k)];
                }
            }
        }
    }
    let moment = force * (reach + farthest) + chain.couple.norm();
    moment * turning + 2.0 * force * (turning * sliding).sqrt()
}

/// `L` with `L Lᵀ` the matrix, which is positive semidefinite.
fn square_root(matrix: &DMatrix<f64>) -> DMatrix<f64> {
    let eigen = matrix.clone().symmetric_eigen();
    let roots = eigen.eigenvalues.map(|value| value.max(0.0).sqrt());
    eigen.eigenvectors * DMatrix::from_diagonal(&roots)
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::super::law::{Gear, Law};
    use super::super::transform::slide;
    use super::*;

    /// A column of length 0.8 on a spring buckles at 1/(C L): the bound is no smaller than what is.
    #[test]
    fn the_bound_is_on_the_safe_side() {
        for (share, expected) in [(0.5, true), (0.99, true), (1.01, false), (3.0, false)] {
            let mut chain = Chain::default();
            chain.site(&[5], Law::Joint(Gear { compliance: 1e-4, ..Gear::default() }));
            chain.fixed(slide(1, 0.8));
            chain.force = Vector3::new(0.0, -share / (1e-4 * 0.8), 0.0);
            let u = DVector::zeros(1);
            assert_eq!(is_stable(&chain, &u), expected);
            assert!((load_bound(&chain, &u) - share).abs() < 1e-12);
            assert_eq!(rest(&chain).is_ok(), expected);
        }
    }
}
