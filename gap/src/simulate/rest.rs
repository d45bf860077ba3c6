//! Static equilibrium of the arm on its deformed geometry.
//!
//! Every site is displaced, the loads are taken in the displaced posture, and every site gives
//! under its load: repeated until nothing moves any more. The repetition contracts exactly where
//! the equilibrium is stable (each step shrinks by the load's geometric stiffness over the
//! springs'), so a load that buckles the arm finds no rest.

use nalgebra::{DVector, Isometry3, Matrix6, Translation3, UnitQuaternion, Vector3, Vector6};
use stiffarm_kernels::Unstable;

use super::actual::{Actual, axis};
use super::site::Site;
use super::state::State;

/// Parts of a step that are tried: a load that stiffens the arm much can make whole steps swing.
const PARTS: [f64; 3] = [1.0, 0.5, 0.15];

/// Steps of one part.
const MOST_STEPS: usize = 400;

/// A change below this changes nothing more, m and rad, relative to the largest number.
const CONVERGED: f64 = 1e-15;

/// A change that no longer shrinks is rounding error if it is below this.
const ROUNDING: f64 = 1e-11;

/// By which loads are differentiated, m and rad.
const STEP: f64 = 1e-5;

/// A displacement beyond this is no displacement, m and rad.
const LARGEST: f64 = 1e3;

/// The small transform of a displacement: translation, then rotation about the displaced origin.
pub(super) fn transform(displacement: &Vector6<f64>) -> Isometry3<f64> {
    let d = displacement;
    let turn = Vector3::new(d[3], d[4], d[5]);
    Isometry3::from_parts(
        Translation3::new(d[0], d[1], d[2]),
        if turn == Vector3::zeros() {
            UnitQuaternion::identity()
        } else {
            UnitQuaternion::from_scaled_axis(turn)
        },
    )
}

/// The arm at rest; `near` is where to begin: a displacement for each site.
///
/// # Errors
/// [`Unstable`] if no stable rest is found.
pub fn rest(actual: &Actual<'_>, near: Option<&[Vector6<f64>]>) -> Result<State, Unstable> {
    let walk = Walk::new(actual);
    if actual.is_rigid() {
        let frames = walk.frames(&actual.fixed);
        let loads = walk.loads(&frames);
        return finish(&walk, frames, loads, actual.fixed.clone());
    }
    for (attempt, part) in PARTS.into_iter().enumerate() {
        let mut at: Vec<Vector6<f64>> = match near.filter(|n| attempt == 0 && n.len() == walk.sites)
        {
            Some(near) => near.to_vec(),
            None => actual.fixed.clone(),
        };
        let mut last = f64::INFINITY;
        let (mut frames, mut loads) = (Vec::new(), Vec::new());
        for _ in 0..MOST_STEPS {
            walk.put_frames(&at, &mut frames);
            walk.put_loads(&frames, &mut loads);
            let mut change = 0.0_f64;
            let mut largest = 0.0_f64;
            for (index, now) in at.iter_mut().enumerate() {
                let next = actual.fixed[index] + walk.give(index, &frames[index], &loads[index]);
                let step = next - *now;
                change = change.max(step.amax());
                *now += step * part;
                largest = largest.max(now.amax());
            }
            if !(change.is_finite() && largest < LARGEST) {
                break;
            }
            if change <= CONVERGED * (1.0 + largest) || (change <= ROUNDING && change >= last) {
                return finish(&walk, frames, loads, at);
            }
            last = change;
        }
    }
    Err(Unstable)
}

/// Where the arm at rest stands beyond its deflection to first order on the undeformed geometry:
/// twist of the tool, base axes.
pub fn beyond_first_order(actual: &Actual<'_>, state: &State) -> Vector6<f64> {
    let walk = Walk::new(actual);
    let frames = walk.frames(&actual.fixed);
    let loads = walk.loads(&frames);
    let tool = frames[walk.sites - 1].behind;
    let mut first = Vector6::zeros();
    for (index, (frame, load)) in frames.iter().zip(&loads).enumerate() {
        let give = walk.give(index, frame, load);
        let turn = frame.before.rotation * give.fixed_rows::<3>(3);
        let shift = frame.before.rotation * give.fixed_rows::<3>(0);
        let lever = tool.translation.vector - frame.before.translation.vector;
        let moved = shift + turn.cross(&lever);
        first += Vector6::new(moved.x, moved.y, moved.z, turn.x, turn.y, turn.z);
    }
    let turned = UnitQuaternion::from_scaled_axis(first.fixed_rows::<3>(3).into_owned());
    let beyond = (state.tool.rotation * (turned * tool.rotation).inverse()).scaled_axis();
    let moved = tool.translation.vector + first.fixed_rows::<3>(0);
    let shift = state.tool.translation.vector - moved;
    Vector6::new(shift.x, shift.y, shift.z, beyond.x, beyond.y, beyond.z)
}

/// Lets the twists that `state` carries to the tool take in how displacements move the loads, to
/// first order. A deflection changes by little else: between two readings of one pose the
/// displacement itself cancels.
pub(super) fn follow_loads(actual: &Actual<'_>, state: &mut State) {
    let walk = Walk::new(actual);
    let gives = |at: &[Vector6<f64>]| -> Vec<Vector6<f64>> {
        let frames = walk.frames(at);
        let loads = walk.loads(&frames);
        (0..walk.sites).map(|k| walk.give(k, &frames[k], &loads[k])).collect()
    };
    let at_rest = gives(&state.displacements);
    let column = |site: usize, component: usize| -> Vector6<f64> {
        let mut moved = state.displacements.clone();
        moved[site][component] += STEP;
        let change = gives(&moved);
        let answers = change.iter().zip(&at_rest).enumerate();
        let answered: Vector6<f64> =
            answers.map(|(k, (c, a))| state.carry_rigid(k, &((c - a) / STEP))).sum();
        state.carry_rigid(site, &Vector6::ith(component, 1.0)) + answered
    };
    let carriers = (0..walk.sites)
        .map(|site| Matrix6::from_columns(&std::array::from_fn::<_, 6, _>(|k| column(site, k))));
    state.carriers = Some(carriers.collect());
}

fn finish(
    walk: &Walk<'_>,
    frames: Vec<Frames>,
    loads: Vec<Vector6<f64>>,
    displacements: Vec<Vector6<f64>>,
) -> Result<State, Unstable> {
    let actual = walk.actual;
    let n = actual.arm.dof();
    let axis = |row: usize| (Site::Joint(row).index(n), axis(actual.arm.joints[row].motion));
    let own = |row: usize, of: &[Vector6<f64>]| {
        let (index, component) = axis(row);
        of[index][component]
    };
    let tool = frames[walk.sites - 1].behind;
    let torque = DVector::from_fn(n, |row, _| own(row, &loads));
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

/// The frame in which a site's displacement is expressed, and the one behind it; base frame.
#[derive(Clone, Copy, Debug)]
struct Frames {
    before: Isometry3<f64>,
    behind: Isometry3<f64>,
}

/// What does not change while the arm comes to rest.
struct Walk<'a> {
    actual: &'a Actual<'a>,
    sites: usize,
    /// For each site the transform from the one before it.
    steps: Vec<Isometry3<f64>>,
    links: Vec<Option<super::beam::Link<'a>>>,
}

impl<'a> Walk<'a> {
    fn new(actual: &'a Actual<'a>) -> Self {
        let n = actual.arm.dof();
        let mut steps = Vec::with_capacity(Site::count(n));
        let mut links = Vec::with_capacity(n);
        steps.push(Isometry3::identity());
        for row in 0..n {
            let (before, behind) = actual.row(row);
            links.push(actual.link(row, &(before * behind)));
            steps.extend([before, behind]);
        }
        steps.push(actual.arm.tool);
        Self { actual, sites: steps.len(), steps, links }
    }

    fn frames(&self, at: &[Vector6<f64>]) -> Vec<Frames> {
        let mut frames = Vec::new();
        self.put_frames(at, &mut frames);
        frames
    }

    /// The same in the place of what `frames` has.
    fn put_frames(&self, at: &[Vector6<f64>], frames: &mut Vec<Frames>) {
        let mut frame = Isometry3::identity();
        let each = self.steps.iter().zip(at).map(|(step, displacement)| {
            let before = frame * step;
            frame = if *displacement == Vector6::zeros() {
                before
            } else {
                before * transform(displacement)
            };
            Frames { before, behind: frame }
        });
        frames.clear();
        frames.extend(each);
    }

    /// The wrench at each site, in its axes (those before its displacement) about its displaced
    /// origin, from everything beyond it.
    fn loads(&self, frames: &[Frames]) -> Vec<Vector6<f64>> {
        let mut loads = Vec::new();
        self.put_loads(frames, &mut loads);
        loads
    }

    /// The same in the place of what `loads` has.
    fn put_loads(&self, frames: &[Frames], loads: &mut Vec<Vector6<f64>>) {
        let arm = &self.actual.arm;
        let tool = &frames[self.sites - 1].behind;
        let wrench = &self.actual.wrench;
        let mut force = wrench.fixed_rows::<3>(0).into_owned();
        let lever = tool * nalgebra::Point3::from(self.actual.load_point);
        // About the base's origin.
        let mut moment = wrench.fixed_rows::<3>(3).into_owned() + lever.coords.cross(&force);
        loads.clear();
        loads.resize(self.sites, Vector6::zeros());
        for index in (0..self.sites).rev() {
            let Frames { before, behind } = &frames[index];
            // Sites alternate: the link's stands behind row (index − 2) / 2.
            let row = (index >= 2 && index % 2 == 0).then(|| index / 2 - 1);
            if let Some(row) = row {
                let joint = &arm.joints[row];
                if joint.mass != 0.0 {
                    let weight = arm.gravity * joint.mass;
                    let at = (behind * nalgebra::Point3::from(joint.com)).coords;
                    force += weight;
                    moment += at.cross(&weight);
                }
            }
            let turn = before.rotation.inverse();
            let (f, m) = (turn * force, turn * (moment - behind.translation.vector.cross(&force)));
            loads[index] = Vector6::new(f.x, f.y, f.z, m.x, m.y, m.z);
            // A beam's own weight loads everything before it, and itself along its length.
            if let Some(link) = row.and_then(|row| self.links[row].as_ref()) {
                let weight = link.weight(&arm.gravity);
                let at = (before * nalgebra::Point3::from(link.middle())).coords;
                force += weight;
                moment += at.cross(&weight);
            }
        }
    }

    fn give(&self, index: usize, frames: &Frames, load: &Vector6<f64>) -> Vector6<f64> {
        let n = self.actual.arm.dof();
        let mut sum = Vector6::zeros();
        if index >= 1 && index % 2 == 1 && index / 2 < n {
            sum += self.actual.spring(index / 2, load);
        } else if index >= 2
            && index.is_multiple_of(2)
            && let Some(link) = &self.links[index / 2 - 1]
        {
            let gravity = frames.before.rotation.inverse() * self.actual.arm.gravity;
            sum += link.give(load, &link.weight(&gravity));
        }
        for (site, law) in &self.actual.laws {
            if site.index(n) == index {
                sum += law(load);
            }
        }
        sum
    }
}
