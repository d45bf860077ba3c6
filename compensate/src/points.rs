//! The points of a program, told so that the arm as it is stands where its controller believes.
//!
//! A controller computes with a table of its own: the nominal arm. A pose of a program is where the tool should stand;
//! the arm as it is stands there at other joint values, and what the nominal arm makes of these is what the program
//! has to say. A program's joint values mean the pose that the nominal arm has there.

mod configuration;

use core::f64::consts::TAU;

use nalgebra::{Isometry3, Vector6};
use stiffarm_kernels::Motion;

use crate::CompensateError;
use crate::program::notation;
use crate::program::{Change, Language, Point, Values, si};
use crate::reach::{Ended, Search, Target, reach};
use crate::whole::{Situation, Whole};
use configuration::{EDGE, configured};

/// Branches of the inverse kinematics of the nominal arm at a pose of its tool, each as joint values.
pub type Inverse<'b> = &'b dyn Fn(&Isometry3<f64>) -> Vec<Vec<f64>>;

/// Largest turn or shift of a joint that is still a correction, rad or m: ten times that of an arm that misses by
/// centimetres.
const LARGEST_CORRECTION: f64 = 0.1;

/// A joint that moves by less keeps the side from which it came to rest, rad or m: the resolution of encoders.
const MOVES: f64 = 1e-6;

/// Two arms and what is done with them.
pub struct Controlled<'a> {
    /// The arm as its controller computes it: rigid, without load.
    pub nominal: Whole<'a>,
    /// The arm as it is.
    pub real: Whole<'a>,
    /// The nominal arm's inverse.
    pub inverse: Inverse<'a>,
    /// Wrench on the tool, base axes, N and N·m.
    pub load: Vector6<f64>,
    /// What is near enough.
    pub search: Search,
}

/// Where the program is before a point.
#[derive(Clone, Debug, Default)]
pub struct Before {
    /// Joint values; `None` at the begin of a program that does not say.
    pub q: Option<Vec<f64>>,
    /// From which side each joint came to rest there.
    pub sides: Vec<i8>,
}

/// Where a point stands.
pub struct Placed<'a> {
    /// The point.
    pub point: &'a Point,
    /// Its frame in the robot's base.
    pub frame: Isometry3<f64>,
    /// Its tool on the flange, the last frame of the table; `None` for the `[tool]` of the robot files.
    pub tool: Option<Isometry3<f64>>,
}

/// What becomes of a point.
#[derive(Clone, Debug, PartialEq)]
pub struct Moved {
    /// The joint values of the nominal arm there, rad (m if prismatic).
    pub nominal: Vec<f64>,
    /// Those at which the arm as it is stands there.
    pub q: Vec<f64>,
    /// By how much what the program says is moved, m and rad.
    pub by: [f64; 2],
    /// The numbers that change.
    pub changes: Vec<Change>,
}

/// Why a point is not moved.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Unmoved {
    /// No branch of the nominal arm.
    #[error("the nominal arm does not reach it")]
    Unreached,
    /// None of those with the configuration that the point says.
    #[error("no branch of the nominal arm has the configuration that it says")]
    NoSuchConfiguration,
    /// Several branches, and nothing to choose by.
    #[error(
        "{0} sets of joint values of the nominal arm reach it, and nothing is said of those before it"
    )]
    Undetermined(usize),
    /// The arm as it is does not reach it near there.
    #[error("the arm as it is does not reach it: {0}")]
    Missed(String),
    /// The wrist would flip.
    #[error("joint 5 would change its sign, and with it the configuration that the point says")]
    Flipped,
    /// Nothing can be worked out.
    #[error(transparent)]
    Wrong(#[from] CompensateError),
}

impl Controlled<'_> {
    /// Moves one point; `before` is then where the program is behind it.
    ///
    /// # Errors
    /// [`Unmoved`]; `before` is as it was then.
    pub fn moved(
        &self,
        placed: &Placed<'_>,
        language: Language,
        text: &[u8],
        before: &mut Before,
    ) -> Result<Moved, Unmoved> {
        let point = placed.point;
        let convention = language.convention();
        let (nominal, old) = match &point.values {
            Values::Joints(cells) => {
                let q = si(cells);
                let flange = self.flange(&q)?;
                (q, flange)
            }
            Values::Pose(cells) => {
                let pose = notation::pose(convention, &si(cells)).ok_or(Unmoved::Unreached)?;
                let flange = placed.frame * pose * self.tool(placed, &self.nominal).inverse();
                (self.nominal(placed, &flange, before)?, flange)
            }
        };
        let after = Before { sides: sides(before, &nominal), q: Some(nominal.clone()) };
        let at = Situation {
            load: self.load,
            direction: before.q.is_some().then(|| after.sides.clone()),
            warming: None,
            before: before.q.clone(),
        };
        // The point of the tool that the program means, held by the arm as it is.
        let tool = self.tool(placed, &self.nominal);
        let goal = old * tool * self.tool(placed, &self.real).inverse() * self.real.arm.tool;
        let found = reach(self.real, &target(&goal), &at, Some(&nominal), &self.search)?;
        let far = found.q.iter().zip(&nominal).any(|(a, b)| (a - b).abs() > LARGEST_CORRECTION);
        match &found.ended {
            Ended::Reached if !far => {}
            Ended::Reached => {
                return Err(Unmoved::Missed("not with this configuration".to_owned()));
            }
            Ended::Nearest(joints) if joints.is_empty() => {
                return Err(Unmoved::Missed("it is out of its reach".to_owned()));
            }
            Ended::Nearest(joints) => {
                let names: Vec<String> = joints.iter().map(|joint| format!("q{joint}")).collect();
                return Err(Unmoved::Missed(format!("{} at its limit", names.join(", "))));
            }
            Ended::Unstable => return Err(Unmoved::Missed("it would buckle".to_owned())),
        }
        let new = self.flange(&found.q)?;
        let [from, to] = [old, new].map(|flange| flange * tool);
        let by = [
            (to.translation.vector - from.translation.vector).norm(),
            to.rotation.angle_to(&from.rotation),
        ];
        let (cells, numbers) = match &point.values {
            Values::Joints(cells) => (cells, found.q.clone()),
            Values::Pose(cells) => {
                let pose = placed.frame.inverse() * to;
                (cells, notation::numbers(convention, &pose, &si(cells)))
            }
        };
        let each = cells.iter().zip(numbers);
        let mut changes: Vec<Change> = each.filter_map(|(cell, x)| cell.change(text, x)).collect();
        changes.extend(configured(&point.configuration, &nominal, &found.q)?);
        *before = after;
        Ok(Moved { nominal, q: found.q, by, changes })
    }

    /// The tool of a point on an arm's flange.
    fn tool(&self, placed: &Placed<'_>, of: &Whole<'_>) -> Isometry3<f64> {
        placed.tool.unwrap_or(of.arm.tool)
    }

    /// The flange of the nominal arm.
    fn flange(&self, q: &[f64]) -> Result<Isometry3<f64>, Unmoved> {
        let unloaded = Situation::under(Vector6::zeros());
        let at = self.nominal.at(q, &unloaded);
        let (state, base) = at.map_err(|_| Unmoved::Wrong(CompensateError::Unstable))?;
        Ok(base * state.tool * self.nominal.arm.tool.inverse())
    }

    /// The joint values of the nominal arm at a pose of its flange.
    fn nominal(
        &self,
        placed: &Placed<'_>,
        flange: &Isometry3<f64>,
        before: &Before,
    ) -> Result<Vec<f64>, Unmoved> {
        let point = placed.point;
        let goal = flange * self.nominal.arm.tool;
        let from = point.near.as_ref().or(before.q.as_ref());
        let mut branches = (self.inverse)(&goal);
        if branches.is_empty() {
            let unloaded = Situation::under(Vector6::zeros());
            let start = from.map(Vec::as_slice);
            let found = reach(self.nominal, &target(&goal), &unloaded, start, &self.search)?;
            branches.extend((found.ended == Ended::Reached).then_some(found.q));
        }
        let all: Vec<Vec<f64>> = branches.iter().flat_map(|q| self.turned(q)).collect();
        if all.is_empty() {
            return Err(Unmoved::Unreached);
        }
        let fits = |q: &Vec<f64>| point.configuration.fits(q);
        let mut fitting: Vec<Vec<f64>> = all.into_iter().filter(fits).collect();
        // Branches meet where the arm is singular.
        fitting.dedup_by(|a, b| a.iter().zip(b).all(|(a, b)| (*a - *b).abs() < EDGE));
        match from {
            None if fitting.len() > 1 => return Err(Unmoved::Undetermined(fitting.len())),
            Some(from) => {
                let far = |q: &[f64]| q.iter().zip(from).map(|(a, b)| (a - b).powi(2)).sum::<f64>();
                fitting.sort_by(|a, b| far(a).total_cmp(&far(b)));
            }
            None => {}
        }
        fitting.into_iter().next().ok_or(Unmoved::NoSuchConfiguration)
    }

    /// The same joint values, and those whole turns away that the limits allow.
    fn turned(&self, q: &[f64]) -> Vec<Vec<f64>> {
        let mut all = vec![Vec::new()];
        for (q, joint) in q.iter().zip(&self.nominal.arm.joints) {
            let turns = match joint.limits {
                Some([low, high]) if joint.motion == Motion::Revolute => {
                    let first = ((low - q) / TAU).ceil() as i32;
                    first..=((high - q) / TAU).floor() as i32
                }
                _ => 0..=0,
            };
            // Some turns beyond the limits by rounding.
            let turns: Vec<i32> = if turns.is_empty() { vec![0] } else { turns.collect() };
            let longer = |head: &Vec<f64>, turns: i32| {
                let mut head = head.clone();
                head.push(q + f64::from(turns) * TAU);
                head
            };
            all = all.iter().flat_map(|h| turns.iter().map(move |t| longer(h, *t))).collect();
        }
        all
    }
}

fn target(pose: &Isometry3<f64>) -> Target {
    Target { position: pose.translation.vector, rotation: Some(pose.rotation) }
}

/// From which side each joint comes to rest: the straight way from the point before.
fn sides(before: &Before, q: &[f64]) -> Vec<i8> {
    let side = |k: usize| {
        let by = before.q.as_ref().map_or(0.0, |from| q[k] - from[k]);
        match by.abs() > MOVES {
            true if by > 0.0 => 1,
            true => -1,
            false => before.sides.get(k).copied().unwrap_or(0),
        }
    };
    (0..q.len()).map(side).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn joints_come_from_where_they_were() {
        let before = Before { q: Some(vec![0.0, 1.0, 2.0]), sides: vec![1, 1, -1] };
        assert_eq!(sides(&before, &[0.5, 0.5, 2.0]), [1, -1, -1]);
        assert_eq!(sides(&Before::default(), &[0.5, 0.5, 2.0]), [0, 0, 0]);
    }
}
