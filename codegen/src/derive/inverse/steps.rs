//! How many steps lead from the closed form to the arm as it is, found by trying: its graphs are evaluated.

use std::sync::Arc;

use stiffarm_kernels::{AtRest, Axes, Motion, Pose, Solution, Steps, Unstable, nearest_branch};

use super::{elbow_angle, gives, inverse};
use crate::derive::{Given, Program, derive};
use crate::expr::Symbol;
use crate::robot::beyond::{Law, Move};
use crate::robot::{ClosedForm, DEFLECTION, Family, Robot, STEPPED};

/// What the steps leave at most, m and rad: a tenth of a nanometre, with which a nanometre has a margin of ten.
const LEFT: f64 = 1e-10;

/// Postures at which it is tried, and of how many of them the steps have to lead there. Of arms that are off by 0.5 mm and
/// 0.5 mrad two steps do at 65 to 80 % of them and three at 93 to 97 %; from there each step takes one in a hundred, all
/// near singular postures, where no fixed number is enough.
const POSTURES: [usize; 2] = [160, 144];

/// How far a load moves the tool, as a part of the arm's size: about what a maker's rated load does.
const MOVED: f64 = 1e-3;

/// How much warmer the arm is than its table, K: about what a day's work and a hall in summer do.
const WARMED: f64 = 30.0;

/// An arm of N joints whose inverse kinematics is evaluated from its graphs, with every `[[effect]]` that kernels have. It has
/// no symbols.
#[derive(Clone, Debug)]
pub struct AsItIs<const N: usize> {
    programs: Arc<Programs>,
    given: Given,
    /// The joint that the closed form is given.
    held: Option<usize>,
    /// The axes where solutions are searched for, and the joint in the middle of the equations.
    search: Option<(Axes<N>, usize)>,
    motion: [Motion; N],
    links: bool,
    readings: usize,
}

#[derive(Debug)]
struct Programs {
    closed: Program,
    /// Of a closed form that is given the elbow's angle.
    elbow: Option<Program>,
    rigid: Program,
    gives: Program,
    sag: Program,
}

/// The same under a wrench and its weights; `None` is the rigid arm.
struct Under<'a, const N: usize>(&'a AsItIs<N>, Option<&'a [f64; 6]>);

impl<const N: usize> AsItIs<N> {
    /// An arm of N joints whose closed form, or that of the nearest table, is `form`.
    pub fn new(robot: &Robot, form: ClosedForm, given: Given) -> AsItIs<N> {
        let links = robot.joints.iter().any(|joint| joint.beam.is_some());
        let programs = Programs {
            closed: inverse(robot, form),
            elbow: (form.family == Family::ElbowAngle).then(|| elbow_angle(robot, form)),
            rigid: derive(robot, &STEPPED),
            gives: gives(robot),
            sag: derive(robot, &[DEFLECTION]),
        };
        let motion = |k: usize| robot.joints.get(k).map_or(Motion::Revolute, |joint| joint.motion);
        AsItIs {
            programs: Arc::new(programs),
            given,
            held: form.given,
            search: match form.family {
                Family::Search { third } => Some((robot.axes(), third)),
                _ => None,
            },
            motion: core::array::from_fn(motion),
            links: links || !robot.beyond.springs.is_empty(),
            readings: readings(robot),
        }
    }

    /// The same of joints that come from other sides, of an arm that is warmer.
    pub fn with(&self, given: &Given) -> AsItIs<N> {
        AsItIs { given: given.clone(), ..self.clone() }
    }

    /// Every branch of the closed form, as joint values.
    pub fn closed_form(&self, pose: &Pose<f64>, near: &[f64; N]) -> Vec<Solution<f64, N>> {
        let columns = pose.columns();
        let target = columns.as_flattened();
        let (joints, _) = self.programs.closed.readings.evaluate(near, &self.given);
        if let Some((axes, third)) = &self.search {
            return axes.search(pose, &array(&joints), (self.held, *third)).iter().collect();
        }
        let elbow = self.given.elbow_angle.or_else(|| {
            let Program { graph, blocks, .. } = self.programs.elbow.as_ref()?;
            let value = |symbol: &Symbol| match symbol {
                Symbol::Joint(joint) => joints[*joint],
                _ => f64::NAN,
            };
            graph.evaluate(&blocks[0].entries, value).first().copied()
        });
        let value = |symbol: &Symbol| match symbol {
            Symbol::Own { input: 1, .. } => elbow.unwrap_or(0.0),
            Symbol::Own { entry, .. } => target[*entry],
            Symbol::Joint(joint) => joints[*joint],
            _ => f64::NAN,
        };
        let closed = &self.programs.closed;
        let block = |k: usize| closed.graph.evaluate(&closed.blocks[k].entries, value);
        let (q, missed) = (block(0), block(1).into_iter().zip(block(2)));
        let each = q.chunks(N).zip(missed).enumerate();
        each.map(|(branch, (q, (distance, tilt)))| Solution {
            branch,
            q: array(q),
            distance,
            tilt,
            motion: self.motion,
        })
        .collect()
    }

    /// The readings of a branch under a wrench and the weights, or of the rigid arm, from its closed form's joint values, and
    /// what they miss the pose by ([`AtRest::follow`]): by so many steps at most, until nothing is left. Of a pose out of
    /// reach it is the nearest that the steps come to.
    ///
    /// # Errors
    /// [`Unstable`] where the arm does not bear its load.
    pub fn follow(
        &self,
        joints: [f64; N],
        pose: &Pose<f64>,
        (wrench, most): (Option<&[f64; 6]>, usize),
    ) -> Result<([f64; N], [f64; 2]), Unstable> {
        let mut joints = joints;
        let arm = Under(self, wrench);
        let mut found = arm.follow(joints, pose, (0, self.readings))?;
        for _ in 0..most {
            if found.1.iter().all(|missed| *missed <= LEFT) {
                break;
            }
            joints = arm.step(&joints, pose)?;
            let next = arm.follow(joints, pose, (0, self.readings))?;
            let off = |[distance, tilt]: [f64; 2]| distance * distance + tilt * tilt;
            if off(next.1) < off(found.1) {
                found = next;
            }
        }
        Ok(found)
    }

    /// Every branch's readings, from those near some readings, by so many steps at most. A branch in which the arm does not
    /// bear its load misses the pose by an infinite distance.
    pub fn solutions(
        &self,
        pose: &Pose<f64>,
        near: &[f64; N],
        (wrench, most): (Option<&[f64; 6]>, usize),
    ) -> Vec<Solution<f64, N>> {
        let each = self.closed_form(pose, near).into_iter();
        let each = each.map(|begin| {
            // A search that has found fewer has no more to follow.
            let found = begin.distance.is_finite().then_some(begin.q).ok_or(Unstable);
            match found.and_then(|q| self.follow(q, pose, (wrench, most))) {
                Ok((q, [distance, tilt])) => Solution { q, distance, tilt, ..begin },
                Err(Unstable) => Solution { distance: f64::INFINITY, tilt: f64::INFINITY, ..begin },
            }
        });
        each.collect()
    }

    fn blocks(
        &self,
        program: &Program,
        joints: &[f64; N],
        wrench: &[f64; 6],
    ) -> Result<Vec<Vec<f64>>, Unstable> {
        let (_, growth) = program.readings.evaluate(joints, &self.given);
        let at = (joints.to_vec(), growth);
        program.evaluate_joints(&at, joints, wrench, |_| f64::NAN, &self.given)
    }
}

impl<const N: usize> AtRest<f64, N> for Under<'_, N> {
    fn stands(&self, joints: &[f64; N]) -> Result<(Pose<f64>, [[f64; 6]; N]), Unstable> {
        let blocks = self.0.blocks(&self.0.programs.rigid, joints, &[0.0; 6])?;
        let axis = |k: usize| array(&blocks[0][3 * k..]);
        let pose = Pose { rotation: [axis(0), axis(1), axis(2)], position: axis(3) };
        let jacobian = core::array::from_fn(|joint| match self.0.held == Some(joint) {
            true => [0.0; 6],
            false => array(&blocks[1][6 * joint..]),
        });
        Ok(match self.1.filter(|_| self.0.links) {
            Some(wrench) => {
                let gives = self.0.blocks(&self.0.programs.gives, joints, wrench)?;
                (pose.displaced(&array(&gives[1])), jacobian)
            }
            None => (pose, jacobian),
        })
    }

    fn gives(&self, joints: &[f64; N]) -> Result<[f64; N], Unstable> {
        let Some(wrench) = self.1 else { return Ok([0.0; N]) };
        self.0.blocks(&self.0.programs.sag, joints, wrench)?;
        Ok(array(&self.0.blocks(&self.0.programs.gives, joints, wrench)?[0]))
    }

    fn joints(&self, readings: &[f64; N]) -> [f64; N] {
        array(&self.0.programs.rigid.readings.evaluate(readings, &self.0.given).0)
    }
}

/// The first numbers of a list that has so many.
fn array<const N: usize>(values: &[f64]) -> [f64; N] {
    core::array::from_fn(|k| values.get(k).copied().unwrap_or(f64::NAN))
}

/// The steps behind a closed form of an arm.
pub fn steps(robot: &Robot, form: ClosedForm) -> Steps {
    by_joints!(robot.dof(), steps_of(robot, form))
}

fn steps_of<const N: usize>(robot: &Robot, form: ClosedForm) -> Steps {
    let readings = readings(robot);
    if !robot.symbols().is_empty() {
        // Its closed form is its own, and what its links give is not known.
        let links = robot.joints.iter().any(|joint| joint.beam.is_some());
        let loaded = if links { Steps::MOST / 2 } else { 0 };
        return Steps { unloaded: 0, loaded, readings };
    }
    let given = Given { warming: WARMED, ..Given::default() };
    let arm = AsItIs::<N>::new(robot, form, given);
    let unloaded = match robot.has_closed_form() {
        true => 0,
        false => needed(robot, |q, _| taken(&arm, q, None)),
    };
    if !robot.has_set_points() || !arm.links {
        return Steps { unloaded, loaded: unloaded, readings };
    }
    let size = robot.size();
    let loaded = needed(robot, |q, [x, y, z]| {
        let newton = [x, y, z, 0.0, 0.0, 0.0];
        let [own, with] = [[0.0; 6], newton].map(|w| arm.blocks(&arm.programs.sag, q, &w));
        let (own, with) = (own?, with?);
        let moved: f64 = own[0].iter().zip(&with[0]).take(3).map(|(a, b)| (a - b) * (a - b)).sum();
        let by = if moved > 0.0 { MOVED * size / libm::sqrt(moved) } else { 0.0 };
        taken(&arm, q, Some(&newton.map(|force| by * force)))
    });
    Steps { unloaded, loaded, readings }
}

/// From joint values to readings each step leaves as much of an error as the largest slope of what moves the joints; 1e-10 of
/// the milliradians that it moves them by is rounding.
fn readings(robot: &Robot) -> usize {
    let mut slopes = vec![0.0; robot.dof()];
    for each in &robot.beyond.moves {
        if let Move::Joint(joint, law) = each {
            slopes[*joint] += match law {
                Law::Ratio(slope) | Law::Coupling(_, slope) => slope.to_f64().abs(),
                Law::Wave(order, parts) => {
                    let [cos, sin] = parts.map(|part| part.to_f64());
                    *order as f64 * libm::hypot(cos, sin)
                }
                Law::Backlash(_) | Law::Warming(_) => 0.0,
            };
        }
    }
    let slope = slopes.into_iter().fold(0.0, f64::max);
    match (robot.is_as_its_table(), slope > 0.0) {
        (true, _) => 0,
        // A shift is taken off at once.
        (false, false) => 1,
        (false, true) => {
            let count = libm::ceil(libm::log(1e-10) / libm::log(slope.min(0.9)));
            (count as usize).min(40)
        }
    }
}

/// What so many postures take at most, but for a few; one in which the arm does not bear the load takes none.
fn needed<const N: usize>(
    robot: &Robot,
    steps: impl Fn(&[f64; N], [f64; 3]) -> Result<usize, Unstable>,
) -> usize {
    let [all, most] = POSTURES;
    let roots = [2.0, 3.0, 5.0, 7.0, 11.0, 13.0, 29.0].map(libm::sqrt);
    let of_load = [17.0, 19.0, 23.0].map(libm::sqrt);
    let mut counts: Vec<usize> = (1..=all)
        .map(|k| {
            // Multiples of irrational numbers fill the space evenly.
            let part = |root: f64| {
                let turns = k as f64 * root;
                2.0 * (turns - libm::floor(turns)) - 1.0
            };
            let q = core::array::from_fn(|joint| {
                let part = part(roots[joint % roots.len()]);
                match robot.joints.get(joint).map(|joint| (joint.motion, joint.limits)) {
                    Some((Motion::Prismatic, Some([low, high]))) => {
                        (low + high) / 2.0 + (high - low) / 2.0 * part
                    }
                    Some((Motion::Prismatic, None)) => part,
                    _ => core::f64::consts::PI * part,
                }
            });
            steps(&q, of_load.map(part)).unwrap_or(0)
        })
        .collect();
    counts.sort_unstable();
    counts[most - 1]
}

/// How many steps lead back to where the arm stands at joint values.
fn taken<const N: usize>(
    arm: &AsItIs<N>,
    joints: &[f64; N],
    wrench: Option<&[f64; 6]>,
) -> Result<usize, Unstable> {
    let under = Under(arm, wrench);
    let (pose, _) = under.stands(joints)?;
    // What a search has not found stays at the joint values themselves.
    let found =
        arm.closed_form(&pose, joints).into_iter().filter(|found| found.distance.is_finite());
    let begin = nearest_branch(found, joints, &[None; N]);
    let Some(mut at) = begin.map(|begin| begin.q) else { return Ok(Steps::MOST) };
    for count in 0..Steps::MOST {
        let (_, missed) = under.follow(at, &pose, (0, arm.readings))?;
        if missed.iter().all(|missed| *missed <= LEFT) {
            return Ok(count);
        }
        at = under.step(&at, &pose)?;
    }
    Ok(Steps::MOST)
}
