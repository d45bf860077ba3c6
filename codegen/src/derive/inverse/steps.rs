//! How many steps lead from the closed form to the arm as it is, found by trying: its graphs are evaluated.

use stiffarm_kernels::{Output, Pose, Solutions, Steps, Unstable};

use super::{BRANCHES, inverse};
use crate::derive::{Given, Program, derive};
use crate::expr::Symbol;
use crate::robot::{ClosedForm, Robot};

/// What the steps leave at most, m and rad: a tenth of a nanometre, with which a nanometre has a margin of ten.
const LEFT: f64 = 1e-10;

/// Postures at which it is tried, and of how many of them the steps have to lead there: the others, 5 %, are near
/// singular ones.
const POSTURES: [usize; 2] = [160, 152];

/// How far a load moves the tool, as a part of the arm's size: about what a maker's rated load does.
const GIVES: f64 = 1e-3;

/// Steps under a load of an arm whose table has no numbers to try.
const SYMBOLIC: usize = 4;

/// An arm whose inverse kinematics is evaluated from its graphs, with every `[[effect]]` that kernels have.
#[derive(Clone, Debug)]
pub struct AsItIs {
    closed: Program,
    rigid: Program,
    sag: Program,
    given: Given,
}

type Stands = (Pose<f64>, [[f64; 6]; 6]);

impl AsItIs {
    /// An arm without symbols, whose closed form, or that of the nearest table, is `form`.
    pub fn new(robot: &Robot, form: ClosedForm, given: Given) -> AsItIs {
        AsItIs {
            closed: inverse(robot, form),
            rigid: derive(robot, &[Output::Pose, Output::Jacobian]),
            sag: derive(robot, &[Output::DeflectionWithGravity]),
            given,
        }
    }

    /// Every branch of the closed form.
    pub fn closed_form(&self, pose: &Pose<f64>, near: &[f64; 6]) -> Solutions<f64, 6, BRANCHES> {
        let columns = pose.columns();
        let (target, (joints, _)) =
            (columns.as_flattened(), self.closed.readings.evaluate(near, &self.given));
        let value = |symbol: &Symbol| match symbol {
            Symbol::Own { entry, .. } => target[*entry],
            Symbol::Joint(joint) => joints[*joint],
            _ => f64::NAN,
        };
        let block =
            |k: usize| self.closed.graph.evaluate(&self.closed.blocks[k].entries, value).into_iter();
        let each = |mut values: std::vec::IntoIter<f64>| {
            core::array::from_fn(|_| values.next().unwrap_or(f64::NAN))
        };
        let mut q = block(0);
        let q = core::array::from_fn(|_| {
            core::array::from_fn(|_| q.next().unwrap_or(f64::NAN))
        });
        Solutions { q, distance: each(block(1)), tilt: each(block(2)) }
    }

    /// Where the rigid tool stands at readings, and how it moves.
    ///
    /// # Errors
    /// None.
    pub fn rigid(&self, q: &[f64; 6]) -> Result<Stands, Unstable> {
        let blocks = self.rigid.evaluate_given(q, &[0.0; 6], |_| f64::NAN, &self.given)?;
        let at = |block: usize, entry: usize| blocks[block][entry];
        let axis = |k: usize| core::array::from_fn(|row| at(0, 3 * k + row));
        let pose = Pose { rotation: [axis(0), axis(1), axis(2)], position: axis(3) };
        let jacobian = |joint: usize| core::array::from_fn(|row| at(1, 6 * joint + row));
        Ok((pose, core::array::from_fn(jacobian)))
    }

    /// The same of the tool under its weights and a wrench.
    ///
    /// # Errors
    /// [`Unstable`] where the arm does not bear the load.
    pub fn stands(&self, q: &[f64; 6], wrench: &[f64; 6]) -> Result<Stands, Unstable> {
        let by = self.sag.evaluate_given(q, wrench, |_| f64::NAN, &self.given)?;
        let (pose, jacobian) = self.rigid(q)?;
        Ok((pose.displaced(&core::array::from_fn(|k| by[0][k])), jacobian))
    }
}

/// The steps behind a closed form of an arm; with a load, of one that is generated with its deflection.
pub fn steps(robot: &Robot, form: ClosedForm) -> Steps {
    if !robot.symbols().is_empty() {
        return Steps { unloaded: 0, loaded: SYMBOLIC };
    }
    let arm = AsItIs::new(robot, form, Given::default());
    let unloaded = match robot.is_its_closed_form() {
        true => 0,
        false => needed(|q, _| taken(&arm, q, |q| arm.rigid(q))),
    };
    if !robot.generated().contains(&Output::DeflectionWithGravity) {
        return Steps { unloaded, loaded: unloaded };
    }
    let size = robot.size();
    let loaded = needed(|q, direction| {
        let newton = [direction[0], direction[1], direction[2], 0.0, 0.0, 0.0];
        let [own, with] = [[0.0; 6], newton].map(|w| arm.stands(q, &w));
        let (own, with) = (own?.0.position, with?.0.position);
        let moved: f64 = own.iter().zip(with).map(|(a, b)| (a - b) * (a - b)).sum();
        let load = match moved > 0.0 {
            true => newton.map(|force| GIVES * size / libm::sqrt(moved) * force),
            false => newton,
        };
        taken(&arm, q, |q| arm.stands(q, &load))
    });
    Steps { unloaded, loaded }
}

/// What so many postures take at most, but for a few; one in which the arm does not bear the load takes none.
fn needed(steps: impl Fn(&[f64; 6], [f64; 3]) -> Result<usize, Unstable>) -> usize {
    let [all, most] = POSTURES;
    let roots = [2.0, 3.0, 5.0, 7.0, 11.0, 13.0, 17.0, 19.0, 23.0].map(libm::sqrt);
    let mut counts: Vec<usize> = (1..=all)
        .map(|k| {
            // Multiples of irrational numbers fill the space evenly.
            let [a, b, c, d, e, f, x, y, z] =
                roots.map(|root| 2.0 * (k as f64 * root - libm::floor(k as f64 * root)) - 1.0);
            let q = [a, b, c, d, e, f].map(|part| core::f64::consts::PI * part);
            steps(&q, [x, y, z]).unwrap_or(0)
        })
        .collect();
    counts.sort_unstable();
    counts[most - 1]
}

/// How many steps lead back to where the arm stands at readings.
fn taken(
    arm: &AsItIs,
    q: &[f64; 6],
    at: impl Fn(&[f64; 6]) -> Result<Stands, Unstable>,
) -> Result<usize, Unstable> {
    let (pose, _) = at(q)?;
    let any = (f64::MAX, f64::MAX);
    let begin = arm.closed_form(&pose, q).nearest(q, &[None; 6], any);
    let Some(mut q) = begin.map(|begin| begin.q) else { return Ok(Steps::MOST) };
    for count in 0..Steps::MOST {
        let (next, [distance, tilt]) = Steps::follow(q, &pose, 0, &at)?;
        if distance <= LEFT && tilt <= LEFT {
            return Ok(count);
        }
        q = Steps::follow(next, &pose, 1, &at)?.0;
    }
    Ok(Steps::MOST)
}
