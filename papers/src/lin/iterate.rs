//! Joint values at which the loaded arm stands where the unloaded one should (steps 9 and 10 of
//! Lin, Chiang & Cui, repeated until nothing is left).

use nalgebra::{DVector, Isometry3, Translation3, UnitQuaternion, Vector3, Vector6};
use stiffarm_kernels::generic::Arm;

use super::correction::{Correction, scale};
use super::{CompensateError, Damping, correction, finite, orientation_jacobian};
use crate::chain::elastic::{ElasticArm, Elasticity};
use crate::chain::{Displacement, Load, steps};

/// How the loaded arm's pose is computed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Forward {
    /// The textbook's deflection under the load and all weights, with joint springs and links, to
    /// first order in the links' bending: `Arm::deflection_with_gravity`.
    #[default]
    Linear,
    /// The chain at rest in its displaced posture, under a load that keeps its direction in the
    /// base. The links' weights are left out.
    Equilibrium(Elasticity),
}

/// What is good enough.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// How the loaded pose is computed.
    pub forward: Forward,
    /// How the differential Jacobian is inverted.
    pub damping: Damping,
    /// The largest distance from the target, in the arm's unit of length.
    pub translation: f64,
    /// The largest angle from the target, rad.
    pub rotation: f64,
    /// Most corrections.
    pub iterations: usize,
}

impl Default for Options {
    /// 1e-9 m and 1e-9 rad, at most 50 corrections.
    fn default() -> Self {
        Self {
            forward: Forward::default(),
            damping: Damping::default(),
            translation: 1e-9,
            rotation: 1e-9,
            iterations: 50,
        }
    }
}

/// Why the corrections ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ended {
    /// The loaded tool is as near to the target as was asked.
    Reached,
    /// No correction brings it nearer: the joints cannot do what remains.
    Stationary,
    /// The corrections were used up.
    Iterations,
}

/// What compensation found.
#[derive(Clone, Debug, PartialEq)]
pub struct Compensation {
    /// Joint values to command.
    pub q: Vec<f64>,
    /// `q` minus the joint values it began with.
    pub corrections: Vec<f64>,
    /// What the loaded arm missed without correction: translation and rotation vector from the
    /// loaded tool to the target, base axes.
    pub initial_error: Vector6<f64>,
    /// The same at `q`: what remains.
    pub error: Vector6<f64>,
    /// Corrections made.
    pub iterations: usize,
    /// Least [`Correction::conditioning`] on the way; 1 if there was no correction.
    pub conditioning: f64,
    /// How many corrections were damped.
    pub damped: usize,
    /// Why the corrections ended.
    pub ended: Ended,
}

/// The loaded tool in the base frame. `load` is in base axes at the tool origin.
///
/// # Errors
/// As [`steps`]; [`CompensateError::NotFinite`]; [`CompensateError::Unstable`], or a
/// [`ChainError`](crate::chain::ChainError) of an arm that finds no rest.
pub fn loaded_pose(
    arm: &Arm,
    q: &[f64],
    load: &Vector6<f64>,
    forward: Forward,
) -> Result<Isometry3<f64>, CompensateError> {
    steps(arm, q)?;
    finite("a component of the load", load)?;
    match forward {
        Forward::Equilibrium(elasticity) => {
            Ok(ElasticArm::new(arm, elasticity).settle(q, &Load::Dead(*load))?.pose())
        }
        Forward::Linear => {
            let bent = arm.deflection_with_gravity(q, load);
            let bent = Displacement::new(&bent.map_err(|_| CompensateError::Unstable)?);
            let pose = arm.pose(q);
            Ok(Isometry3::from_parts(
                Translation3::from(pose.translation.vector + bent.translation),
                UnitQuaternion::from_scaled_axis(bent.rotation) * pose.rotation,
            ))
        }
    }
}

/// The arm, its load and where it should stand.
struct Task<'a> {
    arm: &'a Arm,
    target: &'a Isometry3<f64>,
    load: &'a Vector6<f64>,
    options: &'a Options,
    /// What makes translations comparable to rotations.
    length: f64,
}

struct Point {
    q: DVector<f64>,
    pose: Isometry3<f64>,
    error: Displacement,
    size: f64,
}

impl Task<'_> {
    fn at(&self, q: DVector<f64>) -> Result<Point, CompensateError> {
        let pose = loaded_pose(self.arm, q.as_slice(), self.load, self.options.forward)?;
        let error = Displacement {
            translation: self.target.translation.vector - pose.translation.vector,
            rotation: (self.target.rotation * pose.rotation.inverse()).scaled_axis(),
        };
        let size = (error.translation.norm() / self.length).hypot(error.rotation.norm());
        Ok(Point { q, pose, error, size })
    }

    fn reached(&self, point: &Point) -> bool {
        let near = |v: &Vector3<f64>, limit: f64| v.norm() <= limit;
        near(&point.error.translation, self.options.translation)
            && near(&point.error.rotation, self.options.rotation)
    }

    fn correction(&self, point: &Point) -> Result<Correction, CompensateError> {
        let seen = orientation_jacobian(&point.pose).tr_mul(&point.error.vector());
        correction(self.arm, point.q.as_slice(), &seen, self.options.damping)
    }

    /// The whole correction or, where that does not bring the tool nearer, a part of it.
    fn nearer(&self, point: &Point, joints: &DVector<f64>) -> Option<Point> {
        let parts = [1.0, 0.5, 0.25, 0.125, 0.0625, 1e-2, 1e-3];
        let mut tried = parts.iter().filter_map(|part| self.at(&point.q + joints * *part).ok());
        tried.find(|next| next.size < point.size)
    }
}

/// Corrects the joint values `start` until the arm under `load` (base axes, at the tool origin) and
/// its weights stands at `target`, or as near as its joints bring it.
///
/// Each correction is `J''⁻¹` of what the loaded tool misses. Six joints away from singular
/// postures leave nothing; what fewer joints, or a singular posture, leave is reported.
///
/// # Errors
/// Those of [`loaded_pose`] at `start`, and of [`correction`].
pub fn compensate(
    arm: &Arm,
    start: &[f64],
    target: &Isometry3<f64>,
    load: &Vector6<f64>,
    options: &Options,
) -> Result<Compensation, CompensateError> {
    finite("an element of the target pose", &target.to_homogeneous())?;
    let length = scale(arm, options.damping)?;
    let task = Task { arm, target, load, options, length };
    let first = DVector::from_column_slice(start);
    let mut point = task.at(first.clone())?;
    let initial_error = point.error.vector();
    let (mut iterations, mut conditioning, mut damped) = (0, 1.0_f64, 0);
    let ended = loop {
        if task.reached(&point) {
            break Ended::Reached;
        }
        if iterations == options.iterations {
            break Ended::Iterations;
        }
        let step = task.correction(&point)?;
        let Some(next) = task.nearer(&point, &step.joints) else { break Ended::Stationary };
        conditioning = conditioning.min(step.conditioning);
        damped += usize::from(step.damped);
        iterations += 1;
        let fall = 1.0 - next.size / point.size;
        point = next;
        if fall < LEAST_FALL && !task.reached(&point) {
            break Ended::Stationary;
        }
    };
    Ok(Compensation {
        corrections: (&point.q - &first).as_slice().to_vec(),
        q: point.q.as_slice().to_vec(),
        initial_error,
        error: point.error.vector(),
        iterations,
        conditioning,
        damped,
        ended,
    })
}

/// A correction that lowers the error by less than this part of it ends the search.
const LEAST_FALL: f64 = 1e-6;
