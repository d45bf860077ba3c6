//! Set-points of any serial arm: joint values within the limits at which the arm, at equilibrium
//! under its load and weights ([`stiffarm_gap::simulate`]), stands at a target.
//!
//! Levenberg's and Marquardt's steps on what the loaded tool misses, along the motions that the
//! joints give the loaded tool. A joint at its limit that would have
//! to leave it stands still for that step.

mod steps;
#[cfg(test)]
mod tests;

use nalgebra::{UnitQuaternion, Vector3, Vector6};
use stiffarm_kernels::generic::Arm;

use super::{CompensateError, finite};
use crate::rng::{Rng, Stream};
use crate::robot::ranges;
use crate::whole::{Situation, Whole};

/// Where the tool should be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Target {
    /// Of the tool origin in the measuring frame, which is the base frame unless an effect moves it, m.
    pub position: Vector3<f64>,
    /// Of the tool frame there; none if any will do.
    pub rotation: Option<UnitQuaternion<f64>>,
}

/// What is good enough, and how long to look for it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Search {
    /// Largest distance from the target, m.
    pub translation: f64,
    /// Largest angle from the target, rad.
    pub rotation: f64,
    /// Random starts where the first one does not lead there.
    pub starts: usize,
    /// Of the random starts.
    pub seed: u64,
}

impl Default for Search {
    /// A micrometre, a microradian, 24 starts.
    fn default() -> Search {
        Search { translation: 1e-6, rotation: 1e-6, starts: 24, seed: 0 }
    }
}

/// How a search ended.
#[derive(Clone, Debug, PartialEq)]
pub enum Ended {
    /// At the target.
    Reached,
    /// No start leads nearer; these joints (from 1) stand at a limit there. Without any, the target
    /// is out of reach.
    Nearest(Vec<usize>),
    /// The arm has no stable rest under the load, from whatever start.
    Unstable,
}

/// What a search found.
#[derive(Clone, Debug, PartialEq)]
pub struct Reached {
    /// Set-points, rad or m.
    pub q: Vec<f64>,
    /// From the loaded tool to the target: translation and rotation vector, base axes. The rotation
    /// is 0 if any will do.
    pub error: Vector6<f64>,
    /// The same at the set-points of an arm that does not give way, which would be commanded
    /// without compensation; none if it does not reach the target.
    pub uncompensated: Option<Vector6<f64>>,
    /// How it ended.
    pub ended: Ended,
}

/// Set-points for one target in a situation; the effects of the robot file count.
///
/// From `start` if there is one; where that is not given or leads nowhere, from random starts, of
/// which the one is taken whose arm gives way least.
///
/// # Errors
/// [`CompensateError::NotFinite`]; [`CompensateError::JointValues`] if the start has not as many values
/// as the arm has joints; [`CompensateError::Unlimited`] if a prismatic joint has no limits and no
/// start is given; [`CompensateError::NotPositive`] for a tolerance; [`CompensateError::Unknown`] if an
/// effect depends on what the situation leaves open.
pub fn reach<'a>(
    arm: impl Into<Whole<'a>>,
    target: &Target,
    at: &Situation,
    start: Option<&[f64]>,
    search: &Search,
) -> Result<Reached, CompensateError> {
    reach_by_branches(arm, target, at, (start, &Vec::new), search)
}

/// What tells the branches of an inverse kinematics, each as joint values.
pub type Branches<'b> = &'b dyn Fn() -> Vec<Vec<f64>>;

/// The same where the branches of an inverse kinematics are known. They are asked for where `start` leads nowhere; if some
/// lead to the target, no start is random.
///
/// # Errors
/// As from [`reach()`].
pub fn reach_by_branches<'a>(
    arm: impl Into<Whole<'a>>,
    target: &Target,
    at: &Situation,
    (start, branches): (Option<&[f64]>, Branches),
    search: &Search,
) -> Result<Reached, CompensateError> {
    let whole = arm.into();
    let arm = whole.arm;
    check(arm, target, &at.load, start, search)?;
    if let Some((known, unknown)) = whole.undecided(at) {
        let effect = format!("{} at {}", known.effect.identifier(), known.spot.place);
        return Err(CompensateError::Unknown { effect, unknown });
    }
    let task = steps::Task::new(whole, at, *target, search);
    let mut best: Option<steps::Point> = None;
    if let Some(start) = start {
        match task.settle(&within(arm, start)) {
            Some(end) if task.reached(&end) => {
                return Ok(finish(&task, end, search));
            }
            missed => best = missed,
        }
    }
    let bounds = match ranges(arm) {
        Ok(bounds) => bounds,
        Err(joint) if start.is_none() => return Err(CompensateError::Unlimited { joint }),
        Err(_) => {
            let end = best.map(|end| finish(&task, end, search));
            return Ok(end.unwrap_or_else(|| nothing(arm, start)));
        }
    };
    let mut rng = Rng::new(search.seed, Stream::Starts);
    let mut reached: Option<(f64, steps::Point)> = None;
    let branches: Vec<Vec<f64>> = branches().iter().map(|q| within(arm, q)).collect();
    let random = branches.len();
    let starts = (0..search.starts).map(|_| rng.point(&bounds));
    for (k, from) in branches.into_iter().chain(starts).enumerate() {
        if k == random && reached.is_some() {
            break;
        }
        let Some(end) = task.settle(&from) else { continue };
        let end = task.turned_back(end);
        if task.reached(&end) {
            let gives = task.gives(&end);
            if reached.as_ref().is_none_or(|(least, _)| gives < *least) {
                reached = Some((gives, end));
            }
        } else if best.as_ref().is_none_or(|before| end.size < before.size) {
            best = Some(end);
        }
    }
    let end = reached.map(|(_, end)| end).or(best);
    Ok(end.map_or_else(|| nothing(arm, start), |end| finish(&task, end, search)))
}

fn finish(task: &steps::Task<'_>, end: steps::Point, search: &Search) -> Reached {
    let ended = if task.reached(&end) {
        Ended::Reached
    } else {
        Ended::Nearest(task.at_limits(&end).into_iter().map(|joint| joint + 1).collect())
    };
    let uncompensated = uncompensated(task, &end.q, search);
    Reached { error: end.error, q: end.q, uncompensated, ended }
}

/// The same arm where nothing gives way.
pub fn rigid(arm: &Arm) -> Arm {
    let mut rigid = arm.clone();
    for joint in &mut rigid.joints {
        (joint.compliance, joint.beam) = (0.0, None);
    }
    rigid
}

/// What the loaded arm misses at the set-points of a rigid one near `q`, of which nothing is wrong.
fn uncompensated(task: &steps::Task<'_>, q: &[f64], search: &Search) -> Option<Vector6<f64>> {
    let mut rigid = rigid(task.arm());
    // Where a rigid arm would have to stand is no question of limits.
    rigid.joints.iter_mut().for_each(|joint| joint.limits = None);
    let unloaded = Situation::under(Vector6::zeros());
    let ideal = steps::Task::new(Whole::from(&rigid), &unloaded, task.target, search);
    let end = ideal.settle(q).filter(|end| ideal.reached(end))?;
    Some(task.at(end.q)?.error)
}

fn nothing(arm: &Arm, start: Option<&[f64]>) -> Reached {
    let q = start.map_or_else(|| vec![0.0; arm.dof()], <[f64]>::to_vec);
    Reached { q, error: Vector6::zeros(), uncompensated: None, ended: Ended::Unstable }
}

fn check(
    arm: &Arm,
    target: &Target,
    load: &Vector6<f64>,
    start: Option<&[f64]>,
    search: &Search,
) -> Result<(), CompensateError> {
    finite("a coordinate of the target", &target.position)?;
    finite("a component of the load", load)?;
    if let Some(rotation) = target.rotation {
        finite("the rotation of the target", &rotation.coords)?;
    }
    if let Some(start) = start {
        if start.len() != arm.dof() {
            return Err(CompensateError::JointValues { expected: arm.dof(), found: start.len() });
        }
        finite("a joint value", start)?;
    }
    for (what, found) in
        [("the tolerance", search.translation), ("the tolerance of rotations", search.rotation)]
    {
        if !(found.is_finite() && found > 0.0) {
            return Err(CompensateError::NotPositive { what, found });
        }
    }
    Ok(())
}

/// The nearest values within the limits.
fn within(arm: &Arm, q: &[f64]) -> Vec<f64> {
    let clamped = |(q, joint): (&f64, &stiffarm_kernels::generic::Joint)| match joint.limits {
        Some([low, high]) => q.clamp(low, high),
        None => *q,
    };
    q.iter().zip(&arm.joints).map(clamped).collect()
}
