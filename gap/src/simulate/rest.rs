//! Static equilibrium of the arm on its deformed geometry.
//!
//! Every site is displaced, the loads are taken in the displaced posture, and every site gives
//! under its load: repeated until nothing moves any more. Each round shrinks the change by the
//! load's geometric stiffness over the springs'. Of a stiff arm that is a hundredth or less, and a
//! few rounds are the rest; of a soft one the steps are Newton's, with the [`Tangent`] at hand.
//! Where these do not settle, parts of the plain steps do, as long as they contract. A rest counts where
//! it is stable: [`Tangent::is_stable`], which steps that contract show under any load but a moment. The work is bounded, whatever the load: one that buckles the arm finds
//! no rest.

use nalgebra::{DVector, Isometry3, UnitQuaternion, Vector6};
use stiffarm_kernels::Unstable;

use super::actual::{Actual, axis};
use super::site::Site;
use super::state::State;
use super::tangent::Tangent;
use super::walk::{Frames, Walk};
use crate::infer::limits::NEWTON_STEPS;

/// As long as each plain step is shorter than the one before by this, none of Newton's is worth its
/// cost.
const QUICK: f64 = 0.1;

/// Halvings of one of Newton's steps.
const MOST_HALVINGS: i32 = 6;

/// Longest of Newton's steps, m and rad: beyond, the tangent says nothing.
const FURTHEST: f64 = 0.5;

/// Parts of a plain step that are tried: a load that stiffens the arm much can make whole steps
/// swing.
const PARTS: [f64; 3] = [1.0, 0.5, 0.15];

/// Plain steps of one part.
const MOST_STEPS: usize = 400;

/// Over so many plain steps the change has to shrink to [`SHRINKS`]: 35 e-foldings lead to rounding
/// in [`MOST_STEPS`], 1.7 in each twentieth of these.
const SPAN: usize = 20;

/// What shrinks less comes to no rest within [`MOST_STEPS`]; a good deal more than `e^−1.7` is let
/// through.
const SHRINKS: f64 = 0.5;

/// A change below this changes nothing more, m and rad, relative to the largest number.
const CONVERGED: f64 = 1e-15;

/// A change that no longer shrinks is rounding error if it is below this.
const ROUNDING: f64 = 1e-11;

/// A displacement beyond this is no displacement, m and rad.
const LARGEST: f64 = 1e3;

/// The arm at rest; `near` is where to begin: a displacement for each site.
///
/// # Errors
/// [`Unstable`] if no stable rest is found.
pub fn rest(actual: &Actual<'_>, near: Option<&[Vector6<f64>]>) -> Result<State, Unstable> {
    let walk = Walk::new(actual);
    if actual.is_rigid() {
        let mut posture = Posture::new(&walk, &actual.fixed);
        posture.look(&walk);
        return posture.finish(&walk);
    }
    let mut starts = near.filter(|n| n.len() == walk.sites).into_iter().chain([&actual.fixed[..]]);
    let settled = starts.find_map(|from| Posture::new(&walk, from).newton(&walk)).or_else(|| {
        PARTS.iter().find_map(|&part| Posture::new(&walk, &actual.fixed).plain(&walk, part))
    });
    settled.ok_or(Unstable)?.finish(&walk)
}

/// A posture on the way to rest.
struct Posture {
    /// The displacement of each site.
    at: Vec<Vector6<f64>>,
    frames: Vec<Frames>,
    loads: Vec<Vector6<f64>>,
    /// What each site gives beyond its displacement.
    misses: Vec<Vector6<f64>>,
    /// Largest of these.
    change: f64,
    /// How often the arm was looked at.
    rounds: usize,
}

impl Posture {
    fn new(walk: &Walk<'_>, from: &[Vector6<f64>]) -> Self {
        let misses = vec![Vector6::zeros(); walk.sites];
        let (frames, loads) = (Vec::with_capacity(walk.sites), Vec::with_capacity(walk.sites));
        Self { at: from.to_vec(), frames, loads, misses, change: f64::INFINITY, rounds: 0 }
    }

    /// Takes the loads in this posture, and what every site gives under its own.
    fn look(&mut self, walk: &Walk<'_>) {
        walk.put_frames(&self.at, &mut self.frames);
        walk.put_loads(&self.frames, &mut self.loads);
        self.change = 0.0;
        for (index, miss) in self.misses.iter_mut().enumerate() {
            let gives = walk.give(index, &self.frames[index], &self.loads[index]);
            *miss = walk.actual.fixed[index] + gives - self.at[index];
            // A NaN is no change that is small.
            self.change = if miss.amax() <= self.change { self.change } else { miss.amax() };
        }
        self.rounds += 1;
    }

    fn largest(&self) -> f64 {
        self.at.iter().map(|at| at.amax()).fold(0.0, f64::max)
    }

    /// Goes on by a part of a step.
    fn go(&mut self, from: &[Vector6<f64>], step: &[Vector6<f64>], part: f64) {
        for ((at, from), step) in self.at.iter_mut().zip(from).zip(step) {
            *at = from + step * part;
        }
    }

    /// Whether nothing moves any more, after a change of `last`.
    fn is_settled(&self, last: f64) -> bool {
        let change = self.change;
        change <= CONVERGED * (1.0 + self.largest()) || (change <= ROUNDING && change >= last)
    }

    fn is_lost(&self) -> bool {
        !(self.change.is_finite() && self.largest() < LARGEST)
    }

    fn tangent<'w, 'a>(&'w self, walk: &'w Walk<'a>) -> Tangent<'w, 'a> {
        Tangent::new(walk, &self.at, &self.frames, &self.loads)
    }

    /// To a stable rest: by plain steps as long as they are quick, else by Newton's, shortened
    /// until they help. None where they do not.
    fn newton(mut self, walk: &Walk<'_>) -> Option<Self> {
        let mut last = f64::INFINITY;
        let (mut from, mut step) = (self.at.clone(), Vec::new());
        let (mut by_newton, mut halvings) = (false, 0);
        while self.rounds < NEWTON_STEPS {
            self.look(walk);
            if self.is_lost() || (self.change > last && self.change > ROUNDING) {
                if step.is_empty() {
                    return None;
                }
                if !by_newton {
                    // A plain step that leads astray is taken back.
                    self.at.clone_from(&from);
                    self.look(walk);
                } else {
                    halvings += 1;
                    if halvings > MOST_HALVINGS {
                        return None;
                    }
                    let part = 0.5_f64.powi(halvings);
                    self.go(&from, &step, part);
                    continue;
                }
            } else if !by_newton && (self.change <= QUICK * last || self.change <= ROUNDING) {
                from.clone_from(&self.at);
                step.clone_from(&self.misses);
                self.go(&from, &step, 1.0);
                if self.is_settled(last) {
                    // Steps that shrank have shown that it is stable; where there was none to be
                    // made, or a moment follows no potential, nothing has.
                    let shown = self.rounds > 1 && !walk.has_moment();
                    return (shown || self.tangent(walk).is_stable()).then_some(self);
                }
                last = self.change;
                continue;
            }
            let tangent = self.tangent(walk);
            let settled = self.is_settled(last);
            if settled && !tangent.is_stable() {
                return None;
            }
            step = tangent.matrix().solve(&self.misses)?;
            from.clone_from(&self.at);
            let longest = step.iter().map(|s| s.amax()).fold(0.0, f64::max);
            if longest > FURTHEST {
                step.iter_mut().for_each(|s| *s *= FURTHEST / longest);
            }
            self.go(&from, &step, 1.0);
            if settled {
                return Some(self);
            }
            (last, by_newton, halvings) = (self.change, true, 0);
        }
        None
    }

    /// To rest by parts of plain steps, as long as they contract.
    fn plain(mut self, walk: &Walk<'_>, part: f64) -> Option<Self> {
        let (mut last, mut before) = (f64::INFINITY, f64::INFINITY);
        let mut from = self.at.clone();
        while self.rounds < MOST_STEPS {
            self.look(walk);
            from.clone_from(&self.at);
            let step = std::mem::take(&mut self.misses);
            self.go(&from, &step, part);
            self.misses = step;
            if self.is_lost() {
                return None;
            }
            if self.is_settled(last) {
                // A start that is a rest, but for rounding, has been judged.
                let stable =
                    self.rounds > 1 && (!walk.has_moment() || self.tangent(walk).is_stable());
                return stable.then_some(self);
            }
            last = self.change;
            if self.rounds.is_multiple_of(SPAN) {
                if last > SHRINKS * before {
                    return None;
                }
                before = last;
            }
        }
        None
    }

    fn finish(self, walk: &Walk<'_>) -> Result<State, Unstable> {
        let Self { at: displacements, frames, loads, .. } = self;
        let actual = walk.actual;
        let n = actual.arm.dof();
        let axis = |row: usize| (Site::Joint(row).index(n), axis(actual.arm.joints[row].motion));
        let own = |row: usize, of: &[Vector6<f64>]| {
            let (index, component) = axis(row);
            of[index][component]
        };
        let tool = frames[walk.sites - 1].behind;
        let borne = |row: usize| actual.borne(row, &loads[axis(row).0])[axis(row).1];
        let torque = DVector::from_fn(n, |row, _| borne(row));
        let joints = (0..n).map(|row| actual.joints[row] + own(row, &displacements)).collect();
        let finite = tool.translation.vector.iter().chain(tool.rotation.coords.iter());
        if !finite.chain(torque.iter()).all(|x| x.is_finite()) {
            return Err(Unstable);
        }
        let before = frames.iter().map(|f| f.before).collect();
        let motions = actual.arm.joints.iter().map(|j| j.motion).collect();
        let carriers = None;
        Ok(State { tool, joints, torque, frames: before, loads, displacements, motions, carriers })
    }
}

/// Where the arm at rest stands beyond its deflection to first order on the undeformed geometry:
/// twist of the tool, base axes.
pub fn beyond_first_order(actual: &Actual<'_>, state: &State) -> Vector6<f64> {
    let walk = Walk::new(actual);
    let (tool, first) = first_order(&walk, |index, frame, load| walk.give(index, frame, load));
    let turned = UnitQuaternion::from_scaled_axis(first.fixed_rows::<3>(3).into_owned());
    let beyond = (state.tool.rotation * (turned * tool.rotation).inverse()).scaled_axis();
    let moved = tool.translation.vector + first.fixed_rows::<3>(0);
    let shift = state.tool.translation.vector - moved;
    Vector6::new(shift.x, shift.y, shift.z, beyond.x, beyond.y, beyond.z)
}

/// Deflection by what gives besides springs and beams, each law under the load of the undeformed
/// geometry: twist of the tool, base axes.
pub fn by_laws(actual: &Actual<'_>) -> Vector6<f64> {
    let walk = Walk::new(actual);
    let give = |index: usize, _: &Frames, load: &Vector6<f64>| {
        walk.laws(index).map(|law| law(load)).sum::<Vector6<f64>>()
    };
    first_order(&walk, give).1
}

/// Where the tool stands undeformed, and its twist, base axes, when every site gives under its load
/// there.
fn first_order(
    walk: &Walk<'_>,
    give: impl Fn(usize, &Frames, &Vector6<f64>) -> Vector6<f64>,
) -> (Isometry3<f64>, Vector6<f64>) {
    let frames = walk.frames(&walk.actual.fixed);
    let loads = walk.loads(&frames);
    let tool = frames[walk.sites - 1].behind;
    let mut first = Vector6::zeros();
    for (index, (frame, load)) in frames.iter().zip(&loads).enumerate() {
        let give = give(index, frame, load);
        let turn = frame.before.rotation * give.fixed_rows::<3>(3);
        let shift = frame.before.rotation * give.fixed_rows::<3>(0);
        let lever = tool.translation.vector - frame.before.translation.vector;
        let moved = shift + turn.cross(&lever);
        first += Vector6::new(moved.x, moved.y, moved.z, turn.x, turn.y, turn.z);
    }
    (tool, first)
}

/// Lets the twists that `state` carries to the tool take in how displacements move the loads, to
/// first order. A deflection changes by little else: between two readings of one pose the
/// displacement itself cancels.
pub(super) fn follow_loads(actual: &Actual<'_>, state: &mut State) {
    let walk = Walk::new(actual);
    let frames = walk.frames(&state.displacements);
    let tangent = Tangent::new(&walk, &state.displacements, &frames, &state.loads);
    state.carriers = Some(tangent.carriers());
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixture::springy;
    use stiffarm_kernels::generic::Arm;

    /// A rod of 1 m on a spring of 1 N·m/rad, weightless.
    fn rod() -> Arm {
        let mut arm = springy();
        arm.joints.truncate(1);
        arm.joints[0] = stiffarm_kernels::generic::Joint {
            a: 1.0,
            alpha: 0.0,
            d: 0.0,
            mass: 0.0,
            compliance: 1.0,
            ..arm.joints[0].clone()
        };
        arm.tool = Isometry3::identity();
        arm
    }

    /// A rod pushed along its length rests where `θ − q = F sin θ`; near buckling that hardly
    /// contracts.
    #[test]
    fn near_buckling_a_few_rounds_are_enough() {
        let arm = rod();
        for (force, q) in [(0.95, 1e-3), (0.999, 1e-3), (0.98, 0.02), (-4.0, 1.2), (-40.0, 0.7)] {
            let push = Vector6::new(-force, 0.0, 0.0, 0.0, 0.0, 0.0);
            let actual = Actual::new(&arm, &[q], &push);
            let walk = Walk::new(&actual);
            let found = Posture::new(&walk, &actual.fixed).newton(&walk).unwrap();
            assert!(found.rounds <= 12, "{force} {}", found.rounds);
            let joints = found.finish(&walk).unwrap().joints;
            let miss = joints[0] - q - force * joints[0].sin();
            // Some ten roundings of the angle and of the load's moment.
            let rounding = 4e-15 * (1.0 + force.abs());
            assert!(miss.abs() < rounding, "{force} {miss:e}");
            let plain = Posture::new(&walk, &actual.fixed).plain(&walk, 1.0);
            assert!(plain.is_none_or(|p| p.rounds > 200), "{force}");
        }
    }

    /// The balanced posture is a rest only as long as the spring is stiffer than the push.
    #[test]
    fn a_rest_that_is_not_stable_is_none() {
        let arm = rod();
        for (force, stands) in [(0.99, true), (1.01, false)] {
            let push = Vector6::new(-force, 0.0, 0.0, 0.0, 0.0, 0.0);
            let found = rest(&Actual::new(&arm, &[0.0], &push), None);
            assert_eq!(found.is_ok(), stands, "{force}");
        }
    }

    /// Both ways lead to the same rest.
    #[test]
    fn newton_ends_where_plain_steps_do() {
        let mut arm = crate::fixture::bent();
        for joint in &mut arm.joints {
            joint.compliance *= 100.0;
        }
        let (q, w) = ([0.3, -0.7, 0.4], Vector6::new(300.0, -200.0, -400.0, 20.0, -30.0, 10.0));
        let mut actual = Actual::new(&arm, &q, &w);
        actual.laws.push((Site::Joint(1), Box::new(|l| Vector6::ith(5, -1e-11 * l[5].powi(3)))));
        actual.laws.push((Site::Joint(2), Box::new(|l| Vector6::ith(5, 3e-5 * l[5].abs()))));
        let walk = Walk::new(&actual);
        let newton = Posture::new(&walk, &actual.fixed).newton(&walk).unwrap();
        let plain = Posture::new(&walk, &actual.fixed).plain(&walk, 0.5).unwrap();
        assert!(newton.rounds <= 10 && plain.rounds > 30, "{} {}", newton.rounds, plain.rounds);
        for (a, b) in newton.at.iter().zip(&plain.at) {
            assert!((a - b).amax() < 1e-13, "{a} {b}");
        }
    }
}
