//! A load that keeps its direction in the base: the wrench in the displaced tool is the one whose
//! deformation turns it into the given one.
//!
//! `ᴱw = R(ᴱw)ᵀ F` is solved by Newton's method. The plain fixed point converges slowly as the load
//! grows (rate 0.55 at 100 N on the three-joint arm of Bicchi & Melchiorri) and then not at all.

use nalgebra::{Matrix6, Matrix6x3, Vector6};

use super::arm::Posture;
use crate::chain::transport::{along, lower, stack, twist_matrix, upper};
use crate::chain::{ChainError, Settled};

/// Newton's steps for one load.
const MOST_STEPS: usize = 50;

/// Halvings of one step.
const MOST_HALVINGS: usize = 30;

/// What is left, relative to the load, that counts as balance.
const BALANCED: f64 = 1e-11;

/// In how many parts the load is put on, one try after the other.
const PARTS: [u32; 3] = [1, 10, 100];

/// How the wrench `u` (base axes, at the tool) turns with a rotation: `δφ × f` over `δφ × m`.
pub(super) fn spin(u: &Vector6<f64>) -> Matrix6x3<f64> {
    let mut spin = Matrix6x3::zeros();
    spin.fixed_view_mut::<3, 3>(0, 0).copy_from(&-upper(u).cross_matrix());
    spin.fixed_view_mut::<3, 3>(3, 0).copy_from(&-lower(u).cross_matrix());
    spin
}

/// The rotation of the tool for wrenches that keep their point, `blkdiag(R, R)`.
fn rotation(settled: &Settled) -> Matrix6<f64> {
    let mut still = settled.pose();
    still.translation.vector = nalgebra::Vector3::zeros();
    twist_matrix(&still)
}

/// The tool's wrench in base axes, at the tool.
fn in_base_axes(settled: &Settled, tip: &Vector6<f64>) -> Vector6<f64> {
    let turn = settled.pose().rotation;
    stack(&(turn * upper(tip)), &(turn * lower(tip)))
}

/// Change of the tool's wrench in base axes per unit of the wrench in the displaced tool.
pub(super) fn balance(settled: &Settled) -> Matrix6<f64> {
    let tip = settled.wrench(settled.places() - 1).copied().unwrap_or_default();
    let turned = spin(&in_base_axes(settled, &tip)) * settled.tip_rate().fixed_rows::<3>(3);
    rotation(settled) + turned
}

/// The arm at rest under the dead wrench `load`, base axes, at the tool.
pub(super) fn settle(posture: &Posture, load: &Vector6<f64>) -> Result<Settled, ChainError> {
    let nominal = along(posture.steps().iter().copied());
    let turn = nominal.rotation.inverse();
    let mut failure = ChainError::Load;
    for parts in PARTS {
        let mut tip = stack(&(turn * upper(load)), &(turn * lower(load))) / f64::from(parts);
        let mut result = Err(ChainError::Load);
        for part in 1..=parts {
            let fraction = f64::from(part) / f64::from(parts);
            result = newton(posture, &(load * fraction), tip);
            match &result {
                Ok((next, _)) => tip = next * (f64::from(part + 1) / f64::from(part)),
                Err(_) => break,
            }
        }
        match result {
            Ok((_, settled)) => return Ok(settled),
            Err(error) => failure = error,
        }
    }
    Err(failure)
}

/// Newton's method from `tip`: the wrench in the displaced tool, and the arm under it.
fn newton(
    posture: &Posture,
    load: &Vector6<f64>,
    mut tip: Vector6<f64>,
) -> Result<(Vector6<f64>, Settled), ChainError> {
    let size = load.norm();
    let mut settled = posture.settle(&tip)?;
    let mut left = load - in_base_axes(&settled, &tip);
    for _ in 0..MOST_STEPS {
        let before = left.norm();
        if before <= f64::EPSILON * size {
            return Ok((tip, settled));
        }
        let step = balance(&settled).lu().solve(&left).ok_or(ChainError::Load)?;
        let mut part = 1.0;
        let mut better = None;
        for _ in 0..MOST_HALVINGS {
            let trial = tip + step * part;
            if let Ok(at) = posture.settle(&trial) {
                let remains = load - in_base_axes(&at, &trial);
                if remains.norm() < before {
                    better = Some((trial, at, remains));
                    break;
                }
            }
            if before <= BALANCED * size {
                break;
            }
            part /= 2.0;
        }
        match better {
            Some(found) => (tip, settled, left) = found,
            None if before <= BALANCED * size => return Ok((tip, settled)),
            None => return Err(ChainError::Load),
        }
    }
    if left.norm() <= BALANCED * size { Ok((tip, settled)) } else { Err(ChainError::Load) }
}
