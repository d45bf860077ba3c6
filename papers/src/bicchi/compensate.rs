//! The search for the joint values.

use nalgebra::{DVector, Matrix6xX, Vector6};

use super::newton::Linear;
use super::{ForceError, Weights, law};
use crate::chain::ChainError;
use crate::chain::Load;
use crate::chain::elastic::{ElasticArm, Loaded};

/// Below this part of the largest, a singular value of `P^½ G` counts as zero in the reported rank.
const RANK: f64 = 1e-8;

/// What is wanted of the arm.
#[derive(Clone, Copy, Debug)]
pub struct Task<'a> {
    /// The arm and what gives way in it.
    pub arm: ElasticArm<'a>,
    /// What acts on the tool.
    pub load: Load,
    /// w_d: what is wanted in the base, base axes, about its origin, N and N·m.
    pub target: Vector6<f64>,
    /// P.
    pub weights: Weights,
}

/// Which derivative of the wrench by the joint values.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Gradient {
    /// All deformations follow the joints.
    #[default]
    Exact,
    /// The paper's: the deformations stay while the joints turn.
    Frozen,
}

/// How the joints are moved.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Method {
    /// Damped least squares: each step lowers V or is taken back and shortened.
    #[default]
    LevenbergMarquardt,
    /// Undamped least squares, without directions whose singular value is below `truncation` times
    /// the largest. In the plane G has rank 2 at most, and nearly 1 where the arm is straight: with
    /// `truncation` 0 what only rounding makes of the rest may drive the method away.
    GaussNewton {
        /// Relative to the largest singular value.
        truncation: f64,
    },
    /// The paper's law, eqs. 14 and 15: `limit` is the largest element of `S Gᵀ P e` (N²/rad), none
    /// for S = I. It converges slowly near singular postures, and its number of steps there
    /// depends on details.
    GradientLaw {
        /// What S limits the elements to.
        limit: Option<f64>,
    },
}

/// When to stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stop {
    /// V that is small enough, N².
    pub value: f64,
    /// Most steps.
    pub steps: usize,
}

impl Default for Stop {
    /// The paper's V ≤ 1e-6, and at most 1000 steps.
    fn default() -> Self {
        Self { value: 1e-6, steps: 1000 }
    }
}

/// Why the search ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ended {
    /// V is as small as was asked.
    Reached,
    /// No small motion of the joints lowers V further: what remains cannot be reached from here.
    Stationary,
    /// The steps were used up.
    Steps,
    /// The method ran away to values that are not finite.
    Diverged,
}

/// What the search found.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// Joint values, rad (m if prismatic): the set-points to command.
    pub q: Vec<f64>,
    /// e = w_d − w there, base axes, N and N·m: what remains.
    pub error: Vector6<f64>,
    /// V there, N².
    pub value: f64,
    /// e at the joint values to start from.
    pub initial_error: Vector6<f64>,
    /// V there, N².
    pub initial_value: f64,
    /// Steps taken.
    pub steps: usize,
    /// Components of the wrench that the joints move independently at the found values.
    pub rank: usize,
    /// Why the search ended.
    pub ended: Ended,
}

/// One posture of the search.
struct Point {
    q: DVector<f64>,
    loaded: Loaded,
    error: Vector6<f64>,
    value: f64,
}

impl Task<'_> {
    fn at(&self, q: DVector<f64>) -> Result<Point, ChainError> {
        let loaded = self.arm.settle(q.as_slice(), &self.load)?;
        let error = self.target - loaded.base_wrench();
        let value = self.weights.value(&error);
        Ok(Point { q, loaded, error, value })
    }

    /// e = w_d − w at the joint values `q` (eq. 8), base axes, N and N·m.
    ///
    /// # Errors
    /// Those of [`ElasticArm::settle`].
    pub fn error(&self, q: &[f64]) -> Result<Vector6<f64>, ChainError> {
        Ok(self.at(DVector::from_column_slice(q))?.error)
    }
}

impl Point {
    fn gradient(&self, gradient: Gradient) -> Result<Matrix6xX<f64>, ChainError> {
        let g = match gradient {
            Gradient::Exact => self.loaded.wrench_jacobian()?,
            Gradient::Frozen => self.loaded.frozen_wrench_jacobian(),
        };
        if g.iter().all(|entry| entry.is_finite()) {
            Ok(g)
        } else {
            Err(ChainError::NotFinite { what: "an element of the wrench's derivative" })
        }
    }

    /// Gᵀ P e as small as rounding makes it.
    fn is_stationary(&self, linear: &Linear) -> bool {
        let residual = (2.0 * self.value).sqrt();
        linear.gradient().norm() <= 1e-13 * linear.largest() * residual
    }
}

/// Moves the joints from `start` until the wrench in the base is the wanted one, or as near to it
/// as the arm gets.
///
/// # Errors
/// [`ForceError::NotFinite`]; [`ForceError::Start`] if the arm has no rest at `start`;
/// [`ForceError::Step`] if a method that does not look where it steps leaves all rest. A target
/// that cannot be reached is not an error: [`Outcome::ended`] says so.
pub fn compensate(
    task: &Task<'_>,
    start: &[f64],
    method: Method,
    gradient: Gradient,
    stop: Stop,
) -> Result<Outcome, ForceError> {
    if !task.target.iter().all(|value| value.is_finite()) {
        return Err(ForceError::NotFinite { what: "a component of the wanted wrench" });
    }
    let first = task.at(DVector::from_column_slice(start)).map_err(ForceError::Start)?;
    let (initial_error, initial_value) = (first.error, first.value);
    let (point, steps, ended) = match method {
        _ if start.is_empty() => {
            let reached = first.value <= stop.value;
            (first, 0, if reached { Ended::Reached } else { Ended::Stationary })
        }
        Method::LevenbergMarquardt => damped(task, first, gradient, stop)?,
        Method::GaussNewton { truncation } => undamped(task, first, gradient, stop, |g, point| {
            Some(Linear::new(g, &task.weights, &point.error).gauss_newton(truncation))
        })?,
        Method::GradientLaw { limit } => undamped(task, first, gradient, stop, |g, point| {
            law::step(g, &task.weights, &point.error, limit)
        })?,
    };
    let rank = match point.gradient(Gradient::Exact) {
        Ok(g) if g.ncols() > 0 => Linear::new(&g, &task.weights, &point.error).rank(RANK),
        _ => 0,
    };
    Ok(Outcome {
        q: point.q.as_slice().to_vec(),
        error: point.error,
        value: point.value,
        initial_error,
        initial_value,
        steps,
        rank,
        ended,
    })
}

type Search = (Point, usize, Ended);

/// Steps that are taken as they come.
fn undamped(
    task: &Task<'_>,
    mut point: Point,
    gradient: Gradient,
    stop: Stop,
    step: impl Fn(&Matrix6xX<f64>, &Point) -> Option<DVector<f64>>,
) -> Result<Search, ForceError> {
    for taken in 0..stop.steps {
        if point.value <= stop.value {
            return Ok((point, taken, Ended::Reached));
        }
        let failed = |source| ForceError::Step { step: taken + 1, source };
        let g = point.gradient(gradient).map_err(failed)?;
        if point.is_stationary(&Linear::new(&g, &task.weights, &point.error)) {
            return Ok((point, taken, Ended::Stationary));
        }
        let Some(change) = step(&g, &point) else {
            return Ok((point, taken, Ended::Stationary));
        };
        let q = &point.q + change;
        if !q.iter().all(|value| value.is_finite()) {
            return Ok((point, taken, Ended::Diverged));
        }
        point = task.at(q).map_err(failed)?;
        if !point.value.is_finite() {
            return Ok((point, taken + 1, Ended::Diverged));
        }
    }
    let ended = if point.value <= stop.value { Ended::Reached } else { Ended::Steps };
    Ok((point, stop.steps, ended))
}

/// Levenberg and Marquardt's method with Nielsen's choice of the damping.
fn damped(
    task: &Task<'_>,
    mut point: Point,
    gradient: Gradient,
    stop: Stop,
) -> Result<Search, ForceError> {
    let mut mu = None;
    let mut growth = 2.0;
    let mut taken = 0;
    while point.value > stop.value {
        if taken == stop.steps {
            return Ok((point, taken, Ended::Steps));
        }
        let failed = |source| ForceError::Step { step: taken + 1, source };
        let g = point.gradient(gradient).map_err(failed)?;
        let linear = Linear::new(&g, &task.weights, &point.error);
        if point.is_stationary(&linear) {
            return Ok((point, taken, Ended::Stationary));
        }
        let mut damping = mu.unwrap_or(FIRST_DAMPING * linear.largest().powi(2));
        loop {
            let step = linear.damped(damping);
            let size = 1.0 + point.q.amax();
            if step.amax() <= 4.0 * f64::EPSILON * size {
                return Ok((point, taken, Ended::Stationary));
            }
            let trial = task.at(&point.q + &step).ok().filter(|next| next.value < point.value);
            if let Some(next) = trial {
                let ratio = (point.value - next.value) / linear.predicted(&step, damping);
                let fall = 1.0 - next.value / point.value;
                damping *= (1.0 - (2.0 * ratio - 1.0).powi(3)).max(1.0 / 3.0);
                growth = 2.0;
                point = next;
                taken += 1;
                if fall < LEAST_FALL && point.value > stop.value {
                    return Ok((point, taken, Ended::Stationary));
                }
                break;
            }
            damping *= growth;
            growth *= 2.0;
        }
        mu = Some(damping);
    }
    Ok((point, taken, Ended::Reached))
}

/// The first damping relative to the square of the largest singular value.
const FIRST_DAMPING: f64 = 1e-6;

/// A step that lowers V by less than this part of it ends the search.
const LEAST_FALL: f64 = 1e-10;
