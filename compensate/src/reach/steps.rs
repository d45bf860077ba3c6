//! The steps from one start.

use core::f64::consts::TAU;

use nalgebra::{DMatrix, DVector, Isometry3, Matrix6xX, Vector6};
use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::Arm;

use super::{Search, Target};
use crate::whole::{Situation, Whole};

/// Most steps from one start.
const MOST_STEPS: usize = 100;

/// Largest change of a joint in a step, rad (or m over the arm's length): beyond, the slope says
/// nothing.
const LONGEST: f64 = 0.5;

/// A step that lowers what is missed by less than this part of it ends the search.
const LEAST_FALL: f64 = 1e-9;

/// Bounds of the damping.
const DAMPING: [f64; 2] = [1e-12, 1e6];

/// A joint so near to its limit stands at it, rad or m.
const AT_LIMIT: f64 = 1e-9;

/// An arm in a situation, and a target.
pub(super) struct Task<'a> {
    whole: Whole<'a>,
    situation: &'a Situation,
    pub(super) target: Target,
    translation: f64,
    rotation: f64,
    /// Makes translations comparable to rotations, m.
    length: f64,
}

/// Some set-points and what the loaded tool misses there.
pub(super) struct Point {
    pub(super) q: Vec<f64>,
    pub(super) error: Vector6<f64>,
    /// Of the error, translations in units of the length.
    pub(super) size: f64,
    tool: Isometry3<f64>,
    jacobian: Matrix6xX<f64>,
}

impl<'a> Task<'a> {
    pub(super) fn new(
        whole: Whole<'a>,
        situation: &'a Situation,
        target: Target,
        search: &Search,
    ) -> Task<'a> {
        let arm = whole.arm;
        let reach: f64 = arm.joints.iter().map(|j| j.a.abs() + j.d.abs()).sum();
        let length = (reach + arm.tool.translation.vector.norm()) / 2.0;
        let length = if length > 0.0 { length } else { 1.0 };
        let (translation, rotation) = (search.translation, search.rotation);
        Task { whole, situation, target, translation, rotation, length }
    }

    pub(super) fn arm(&self) -> &'a Arm {
        self.whole.arm
    }

    /// From a tool to the target.
    fn missed(&self, tool: &Isometry3<f64>) -> Vector6<f64> {
        let p = self.target.position - tool.translation.vector;
        let r = self.target.rotation.map(|to| (to * tool.rotation.inverse()).scaled_axis());
        let r = r.unwrap_or_default();
        Vector6::new(p.x, p.y, p.z, r.x, r.y, r.z)
    }

    pub(super) fn at(&self, q: Vec<f64>) -> Option<Point> {
        let (state, base) = self.whole.at(&q, self.situation).ok()?;
        let (tool, mut jacobian) = (base * state.tool, state.jacobian());
        for mut column in jacobian.column_iter_mut() {
            for first in [0, 3] {
                let turned = base.rotation * column.fixed_rows::<3>(first);
                column.fixed_rows_mut::<3>(first).copy_from(&turned);
            }
        }
        let error = self.missed(&tool);
        let size =
            (error.fixed_rows::<3>(0).norm() / self.length).hypot(error.fixed_rows::<3>(3).norm());
        size.is_finite().then_some(Point { q, error, size, tool, jacobian })
    }

    pub(super) fn reached(&self, point: &Point) -> bool {
        point.error.fixed_rows::<3>(0).norm() <= self.translation
            && point.error.fixed_rows::<3>(3).norm() <= self.rotation
    }

    /// How much the springs give: the largest motion of a joint in units of the arm.
    pub(super) fn gives(&self, point: &Point) -> f64 {
        let unloaded = self.arm().pose(&point.q);
        let shift = point.tool.translation.vector - unloaded.translation.vector;
        shift.norm() / self.length + point.tool.rotation.angle_to(&unloaded.rotation)
    }

    /// Each joint that turns, by whole turns, as near to 0 as its limits let it: a random start may
    /// have wound it up.
    pub(super) fn turned_back(&self, mut point: Point) -> Point {
        for (q, joint) in point.q.iter_mut().zip(&self.arm().joints) {
            let back = *q - (*q / TAU).round() * TAU;
            let allowed = joint.limits.is_none_or(|[low, high]| (low..=high).contains(&back));
            if joint.motion == Motion::Revolute && allowed {
                *q = back;
            }
        }
        point
    }

    /// The joints, from 0, that stand at a limit.
    pub(super) fn at_limits(&self, point: &Point) -> Vec<usize> {
        let at = |k: &usize| {
            let near = |[low, high]: [f64; 2]| {
                point.q[*k] - low <= AT_LIMIT || high - point.q[*k] <= AT_LIMIT
            };
            self.arm().joints[*k].limits.is_some_and(near)
        };
        (0..point.q.len()).filter(at).collect()
    }

    /// Where the steps from a start end; none if the arm is not stable there. They go on below the
    /// tolerance to where rounding ends them.
    pub(super) fn settle(&self, start: &[f64]) -> Option<Point> {
        let mut point = self.at(start.to_vec())?;
        let mut damping = 1e-3;
        for _ in 0..MOST_STEPS {
            let (slope, gap) = self.slope(&point);
            let (next, used) = self.step(&point, &slope, &gap, damping);
            let Some(next) = next else { break };
            damping = (used / 10.0).max(DAMPING[0]);
            let fall = 1.0 - next.size / point.size;
            point = next;
            if fall < LEAST_FALL {
                break;
            }
        }
        Some(point)
    }

    /// Per unit of each set-point and what is missed, translations in units of the length.
    fn slope(&self, point: &Point) -> (DMatrix<f64>, DVector<f64>) {
        let rows = if self.target.rotation.is_some() { 6 } else { 3 };
        let unit = |row: usize| if row < 3 { self.length } else { 1.0 };
        let n = self.arm().dof();
        let slope = DMatrix::from_fn(rows, n, |r, c| point.jacobian[(r, c)] / unit(r));
        (slope, DVector::from_fn(rows, |r, _| point.error[r] / unit(r)))
    }

    /// The first step that leads nearer, damped more and more; and the damping that it took.
    fn step(
        &self,
        point: &Point,
        slope: &DMatrix<f64>,
        gap: &DVector<f64>,
        mut damping: f64,
    ) -> (Option<Point>, f64) {
        while damping <= DAMPING[1] {
            let moved = self.moved(point, slope, gap, damping);
            match self.at(moved).filter(|next| next.size < point.size) {
                Some(next) => return (Some(next), damping),
                None => damping *= 10.0,
            }
        }
        (None, damping)
    }

    /// The set-points after a step; joints that would leave their limits stand still.
    fn moved(
        &self,
        point: &Point,
        slope: &DMatrix<f64>,
        gap: &DVector<f64>,
        damping: f64,
    ) -> Vec<f64> {
        let n = self.arm().dof();
        let mut free: Vec<usize> = (0..n).collect();
        loop {
            let columns = slope.select_columns(&free);
            let square = columns.tr_mul(&columns);
            let scale = square.trace().max(f64::MIN_POSITIVE) / free.len().max(1) as f64;
            let damped = square + DMatrix::identity(free.len(), free.len()) * (damping * scale);
            let step = damped.cholesky().map(|root| root.solve(&columns.tr_mul(gap)));
            let Some(step) = step else { return point.q.clone() };
            let longest = step.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
            let part = if longest > LONGEST { LONGEST / longest } else { 1.0 };
            let blocked = |(slot, &k): (usize, &usize)| {
                let (q, change) = (point.q[k], step[slot]);
                self.arm().joints[k].limits.is_some_and(|[low, high]| {
                    change < 0.0 && q - low <= AT_LIMIT || change > 0.0 && high - q <= AT_LIMIT
                })
            };
            let stuck: Vec<usize> =
                free.iter().enumerate().filter(|slot| blocked(*slot)).map(|(_, k)| *k).collect();
            if stuck.is_empty() {
                let mut q = point.q.clone();
                for (slot, &k) in free.iter().enumerate() {
                    q[k] += part * step[slot];
                }
                return super::within(self.arm(), &q);
            }
            free.retain(|k| !stuck.contains(k));
            if free.is_empty() {
                return point.q.clone();
            }
        }
    }
}
