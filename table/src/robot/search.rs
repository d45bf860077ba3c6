//! Arms whose inverse kinematics is a search: their axes in numbers, and whether it finds every solution of theirs.

use core::f64::consts::PI;

use stiffarm_kernels::{Axes, Pose, nearest_branch};

use super::closed_form::{ClosedForm, Family, Redundancy};
use super::model::{Convention, Motion, Robot, Value};
use super::space::Frame;

/// Postures at which a search is tried, and how many of them it may fail to find again. Of axes in general position all are
/// found; where some meet or are parallel it depends on which joint is in the middle of the equations: of a spherical wrist
/// one in ten is missed, of the wrists of a Fanuc CRX and a Kinova Jaco one in 500 of the best joint.
const POSTURES: [usize; 2] = [256, 2];

impl Robot {
    /// A search that finds as many solutions as the arm has, where its joints turn and its cells are numbers.
    ///
    /// # Errors
    /// Why there is none, where six axes have been tried.
    pub(super) fn searched(&self) -> Result<ClosedForm, Option<String>> {
        let turns = self.joints.iter().all(|joint| joint.motion == Motion::Revolute);
        let given = match (self.dof(), self.redundancy) {
            (6, None) => None,
            (7, None) => Some(6),
            (7, Some(Redundancy::Joint(joint))) => Some(joint),
            _ => return Err(None),
        };
        if !turns || !self.symbols().is_empty() {
            return Err(None);
        }
        let missed = |third: usize| match given {
            None => missed::<6>(self, (None, third)),
            given => missed::<7>(self, (given, third)),
        };
        // The second joint in the middle is the best of most arms.
        let [all, most] = POSTURES;
        match [1, 2, 3, 4, 5, 0].into_iter().find(|third| missed(*third) <= most) {
            Some(third) => {
                Ok(ClosedForm { given, reversed: false, family: Family::Search { third } })
            }
            None => Err(Some(format!("a search misses more than {most} of {all} postures"))),
        }
    }

    /// Its axes with the joint values at zero, base axes; symbols count as zero, and joints beyond as many as it has stand on
    /// the tool.
    pub fn axes<const N: usize>(&self) -> Axes<N> {
        let length = |x: f64| Frame::moved([x, 0.0, 0.0]);
        let placed = |frame: &super::Frame| Frame {
            origin: frame.translation.each_ref().map(Value::or_zero),
            ..Frame::by_rotation(frame.rotation.each_ref().map(super::Angle::or_zero))
        };
        let mut at = placed(&self.base);
        let mut lines = Vec::with_capacity(N);
        for row in &self.joints {
            let tilt = Frame::turned([0.0, 1.0, 0.0], row.beta.or_zero());
            let twist = Frame::turned([1.0, 0.0, 0.0], row.alpha.or_zero()).then(&tilt);
            let shift = Frame::moved([0.0, 0.0, row.d.or_zero()]);
            let turn = Frame::turned([0.0, 0.0, 1.0], row.theta.or_zero()).then(&shift);
            if self.convention == Convention::Modified {
                at = at.then(&twist).then(&length(row.a.or_zero()));
            }
            lines.push([at.axes[2], at.origin]);
            at = at.then(&turn);
            if self.convention == Convention::Standard {
                at = at.then(&length(row.a.or_zero())).then(&twist);
            }
        }
        let Frame { axes, origin } = at.then(&placed(&self.tool));
        // Rounding of a right angle's cosine.
        let clean = |v: [f64; 3]| v.map(|x| if x.abs() < 1e-15 { 0.0 } else { x });
        let line = |k: usize| lines.get(k).copied().unwrap_or([axes[2], origin]).map(clean);
        let home = Pose { rotation: axes.map(clean), position: clean(origin) };
        Axes { lines: core::array::from_fn(line), home }
    }
}

/// How many postures a search does not find again, at most one more than it may.
fn missed<const N: usize>(robot: &Robot, (given, third): (Option<usize>, usize)) -> usize {
    let axes = robot.axes::<N>();
    let roots = [2.0, 3.0, 5.0, 7.0, 11.0, 13.0, 29.0].map(f64::sqrt);
    let missed = |k: &usize| {
        // Multiples of irrational numbers fill the space evenly.
        let q: [f64; N] = core::array::from_fn(|joint| {
            PI * (2.0 * (*k as f64 * roots[joint % roots.len()]).fract() - 1.0)
        });
        let solutions = axes.search(&axes.pose(&q), &q, (given, third));
        let again = nearest_branch(solutions.reached(1e-6, 1e-6), &q, &[None; N]);
        again.is_none_or(|again| again.q.iter().zip(&q).any(|(a, b)| (a - b).abs() > 1e-4))
    };
    let [all, most] = POSTURES;
    (1..=all).filter(missed).take(most + 1).count()
}
