//! Loads just below and just above the one that an arm no longer bears.

use nalgebra::{DMatrix, DVector};
use stiffarm::kernels::Output;
use stiffarm::kernels::generic::Arm;

use crate::compare::{Draws, terms};

/// What a load consists of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    Force,
    Moment,
    Both,
}

pub const KINDS: [Kind; 3] = [Kind::Force, Kind::Moment, Kind::Both];

impl Kind {
    /// A load of this kind, up to 1 N and 1 N·m.
    pub fn direction(self, draws: &mut Draws) -> [f64; 6] {
        core::array::from_fn(|k| {
            let zero = if k < 3 { self == Kind::Moment } else { self == Kind::Force };
            // As single precision has it, so that both precisions are loaded alike.
            if zero { 0.0 } else { f64::from(draws.unit() as f32) }
        })
    }
}

/// Roundings of an entry of `Kθ − K_C`, each of the size of its terms: the sines and cosines of a path
/// of nine joints, the cross products, the elimination.
const ROUNDINGS: f64 = 100.0;

/// The largest multiples of `direction` that are surely borne, and the smallest that are surely not, with
/// arithmetic of this rounding error; `None` where every load is borne, the arm hardly bears itself, or
/// rounding hides where the boundary lies.
///
/// Scaled to springs of 1 the smallest eigenvalue at the load λw is 1 − γ − λμ, γ the weights' part. Rounding
/// changes it by `n · ROUNDINGS · ε · (1 + terms / softest spring)`, hence the load at which it is 0 by
/// that over 1 − γ, relatively.
pub fn around(
    arm: &Arm,
    output: Output,
    q: &[f64],
    direction: &[f64; 6],
    epsilon: f64,
) -> Option<[[f64; 6]; 2]> {
    let load = |factor: f64| direction.map(|w| factor * w);
    let borne = |factor: f64| arm.evaluate(output, q, &load(factor)).is_ok();
    let margin = margin(arm, output, q).filter(|margin| *margin > 0.1)?;
    let (mut low, mut high) = (0.0, 1.0);
    while borne(high) {
        (low, high) = (high, 2.0 * high);
        if high > 1e15 {
            return None;
        }
    }
    while high - low > f64::EPSILON * high {
        let middle = (low + high) / 2.0;
        *if borne(middle) { &mut low } else { &mut high } = middle;
    }
    let softest = springs(arm).fold(f64::INFINITY, f64::min);
    let stiffness = match output {
        Output::DeflectionWithGravity => terms(arm, Output::WeightStiffness, q, direction),
        _ => 0.0,
    } + terms(arm, Output::ComplementaryStiffness, q, &load(high));
    let band = ROUNDINGS * q.len() as f64 * epsilon * (1.0 + stiffness / softest) / margin;
    (band < 0.5).then(|| [load(low * (1.0 - band)), load(high * (1.0 + band))])
}

fn springs(arm: &Arm) -> impl Iterator<Item = f64> {
    arm.joints.iter().map(|j| j.compliance).filter(|c| *c > 0.0).map(f64::recip)
}

/// The smallest eigenvalue without the load, scaled to springs of 1; `None` for an arm without springs.
fn margin(arm: &Arm, output: Output, q: &[f64]) -> Option<f64> {
    springs(arm).next()?;
    if output != Output::DeflectionWithGravity {
        return Some(1.0);
    }
    let roots = DVector::from_iterator(q.len(), arm.joints.iter().map(|j| j.compliance.sqrt()));
    let scale = DMatrix::from_diagonal(&roots);
    let scaled = DMatrix::identity(q.len(), q.len()) - &scale * arm.weight_stiffness(q) * &scale;
    Some(scaled.symmetric_eigenvalues().min())
}
