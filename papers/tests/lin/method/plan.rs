//! The ten steps of Lin, Chiang & Cui: all inverse solutions, the deflection at each, the one that
//! bends least, and its correction.

use nalgebra::{Isometry3, Vector3, Vector6};
use stiffarm_kernels::generic::Arm;

use super::{
    CompensateError, Correction, InverseError, ParallelElbow, Solution, correction, deflections,
    orientation_jacobian,
};

/// Which deflection the configurations are compared by.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Model {
    /// Joint springs and links with the loaded geometry: `Arm::deflection_with_gravity`.
    #[default]
    Whole,
    /// YC: the links exactly, the joints rigid.
    Castigliano,
    /// YTD = YT + YD: the paper's steps 2 to 6. It counts slopes of the links more than once.
    TimoshenkoTotal,
}

/// What of the deflection has to be small.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Measure {
    /// The length of the tool's displacement.
    #[default]
    Translation,
    /// Its part along a direction in base axes, such as the vertical: the paper's choice.
    Along(Vector3<f64>),
}

impl Measure {
    fn of(&self, deflection: &Vector6<f64>) -> f64 {
        let translation: Vector3<f64> = deflection.fixed_rows::<3>(0).into_owned();
        match self {
            Self::Translation => translation.norm(),
            Self::Along(direction) => translation.dot(direction).abs() / direction.norm(),
        }
    }
}

/// One configuration of the arm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Candidate {
    /// Its joint values.
    pub solution: Solution,
    /// The tool's deflection there, base axes.
    pub deflection: Vector6<f64>,
    /// The measure of it.
    pub size: f64,
}

/// What the ten steps found.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// The configuration that bends least: the first of the candidates.
    pub chosen: Candidate,
    /// All configurations, the one that bends least first.
    pub candidates: Vec<Candidate>,
    /// Add_1 to Add_6 of the chosen one: its joint values less these compensate its deflection.
    pub add: Correction,
}

/// The deflection of the tool by one model, base axes.
fn deflection(
    arm: &Arm,
    q: &[f64],
    load: &Vector6<f64>,
    model: Model,
) -> Result<Vector6<f64>, CompensateError> {
    if model == Model::Whole {
        return Ok(arm.deflection_with_gravity(q, load)?);
    }
    let all = deflections(arm, q, load)?;
    Ok(match model {
        Model::TimoshenkoTotal => all.timoshenko_total(),
        Model::Whole | Model::Castigliano => all.castigliano,
    })
}

/// Steps 1 to 10 for an elbow manipulator: of all joint values that put the unloaded tool at
/// `target` those with the smallest deflection under `load` (base axes, at the tool origin) and the
/// weights, and their correction. The deflections are compared by `model` and `measure`. Joint limits
/// are not regarded.
///
/// # Errors
/// [`InverseError`] if the arm is of another kind or the target out of reach;
/// [`CompensateError::Unstable`].
pub fn plan(
    arm: &Arm,
    target: &Isometry3<f64>,
    load: &Vector6<f64>,
    model: Model,
    measure: Measure,
) -> Result<Plan, CompensateError> {
    let inverses = ParallelElbow::new(arm)?.solve(target)?;
    let candidate = |solution: &Solution| {
        let deflection = deflection(arm, &solution.q, load, model)?;
        Ok(Candidate { solution: *solution, deflection, size: measure.of(&deflection) })
    };
    let mut candidates: Vec<Candidate> =
        inverses.solutions.iter().map(candidate).collect::<Result<_, CompensateError>>()?;
    candidates.sort_by(|a, b| a.size.total_cmp(&b.size));
    let Some(&chosen) = candidates.first() else {
        return Err(InverseError::Unreachable { missing: inverses.missing }.into());
    };
    let q = &chosen.solution.q;
    let seen = orientation_jacobian(&arm.pose(q)).tr_mul(&chosen.deflection);
    let add = correction(arm, q, &seen);
    Ok(Plan { chosen, candidates, add })
}
