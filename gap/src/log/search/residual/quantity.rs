//! On what a residual may depend: rows sorted by a quantity into parts of equally many.

use nalgebra::Vector3;
use stiffarm_kernels::generic::Arm;

use super::super::dictionary::{Dictionary, Mixed};
use super::super::fit::Fitted;
use crate::log::scene::Domain;
use crate::parallel;

/// Parts into which a quantity is divided.
pub(super) const PARTS: usize = 8;

/// On what a residual may depend: of the joint itself, or of another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Of {
    Angle(usize),
    Speed(usize),
    Acceleration(usize),
    Load,
    /// What would hang on the joint if the weights of the robot file pulled along an axis of the base: that goes with
    /// several angles at once, and with each of them alone perhaps not.
    Weight(usize),
    Time,
    /// What brakes has the sign of the motion: a residual with that sign may depend on the speed's size, the load's, or
    /// the time.
    BrakingSpeed,
    BrakingLoad,
    BrakingTime,
    /// On the joint's angle or speed, as finely as the rows tell: a pattern that comes often within a part has no mean
    /// in it.
    FineAngle,
    FineSpeed,
    /// On nothing: it is there all the time.
    Mean,
}

impl Of {
    /// Everything that the residual of a joint may depend on.
    fn all(joints: usize) -> impl Iterator<Item = Of> {
        let each = (0..joints).flat_map(|k| [Of::Angle(k), Of::Speed(k), Of::Acceleration(k)]);
        let braking = [Of::BrakingSpeed, Of::BrakingLoad, Of::BrakingTime];
        let fine = [Of::FineAngle, Of::FineSpeed];
        let weights = (0..3).map(Of::Weight);
        let own = [Of::Mean, Of::Load, Of::Time].into_iter().chain(braking).chain(fine);
        own.chain(each).chain(weights)
    }

    /// Of a joint.
    pub(super) fn named(self, joint: usize) -> String {
        let of = |name: &str, k: usize| match k == joint {
            true => name.to_owned(),
            false => format!("{name} of joint {}", k + 1),
        };
        match self {
            Of::Angle(k) => of("angle", k),
            Of::Speed(k) => of("speed", k),
            Of::Acceleration(k) => of("acceleration", k),
            Of::Load => "load".to_owned(),
            Of::Weight(axis) => format!("weights along the base's {}", ["x", "y", "z"][axis]),
            Of::Time => "time".to_owned(),
            Of::BrakingSpeed => "speed, against the motion".to_owned(),
            Of::BrakingLoad => "load, against the motion".to_owned(),
            Of::BrakingTime => "time, against the motion".to_owned(),
            Of::FineAngle => "angle, finely".to_owned(),
            Of::FineSpeed => "speed, finely".to_owned(),
            Of::Mean => "mean".to_owned(),
        }
    }

    /// Whether neighbours are held against each other, and not parts.
    pub(super) fn is_fine(self) -> bool {
        matches!(self, Of::FineAngle | Of::FineSpeed)
    }
}

/// A joint's rows of the sample that count, sorted by what they are asked for.
pub(super) struct Parts {
    pub(super) joint: usize,
    pub(super) of: Of,
    /// Equally many rows each, in the quantity's order, or all in one of a mean and of neighbours: their place in the
    /// sample, and the sign that what is left has there.
    pub(super) rows: Vec<Vec<(usize, f64)>>,
}

/// The rows of the sample: what a residual may depend on.
struct Rows {
    q: Vec<Vec<f64>>,
    qd: Vec<Vec<f64>>,
    qdd: Vec<Vec<f64>>,
    t: Vec<f64>,
    /// What each joint carries.
    loads: Vec<Vec<f64>>,
    /// What it would carry if weights pulled along the base's axes.
    weights: [Vec<Vec<f64>>; 3],
}

impl Rows {
    fn of(dict: &Dictionary<'_>, fit: &Fitted) -> Rows {
        let signals = dict.case.signals;
        let at = |fine: &Vec<f64>| -> Vec<f64> {
            let kept = signals.kept(fine);
            dict.rows.iter().map(|row| kept[*row]).collect()
        };
        let joints = |of: &[Vec<f64>]| -> Vec<Vec<f64>> { of.iter().map(at).collect() };
        let q = joints(&signals.q);
        let loads = match dict.case.kind.0 {
            Domain::Torque => asked(dict, fit),
            Domain::Position => weights(dict.case.arm, &q),
        };
        let arm = dict.case.arm;
        let weights = [Vector3::x(), Vector3::y(), Vector3::z()].map(|axis| {
            let gravity = axis * arm.gravity.norm();
            weights(&Arm { gravity, ..arm.clone() }, &q)
        });
        let (qd, qdd, t) = (joints(&signals.qd), joints(&signals.qdd), at(&signals.t));
        Rows { q, qd, qdd, t, loads, weights }
    }

    fn sign(&self, joint: usize, of: Of, k: usize) -> f64 {
        match of {
            Of::BrakingSpeed | Of::BrakingLoad | Of::BrakingTime => self.qd[joint][k].signum(),
            _ => 1.0,
        }
    }

    fn value(&self, joint: usize, of: Of, k: usize) -> f64 {
        match of {
            Of::Angle(of) => self.q[of][k],
            Of::FineAngle => self.q[joint][k],
            Of::FineSpeed => self.qd[joint][k],
            Of::Speed(of) => self.qd[of][k],
            Of::Acceleration(of) => self.qdd[of][k],
            Of::Load => self.loads[joint][k],
            Of::Weight(axis) => self.weights[axis][joint][k],
            Of::Time | Of::BrakingTime => self.t[k],
            Of::BrakingSpeed => self.qd[joint][k].abs(),
            Of::BrakingLoad => self.loads[joint][k].abs(),
            Of::Mean => 0.0,
        }
    }
}

/// What a fit asks of each joint.
fn asked(dict: &Dictionary<'_>, fit: &Fitted) -> Vec<Vec<f64>> {
    let (mut columns, mut values) = fit.bordered();
    // The target less what is left of it.
    columns.push(Mixed::one(dict.target));
    values.push(1.0);
    let asked = dict.sampled(&columns, &values).into_iter();
    asked.map(|rows| rows.into_iter().map(Option::unwrap_or_default).collect()).collect()
}

/// What the weights of the robot file do to each joint: a servo holds them by its error.
fn weights(arm: &Arm, q: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let rows = q.first().map_or(0, Vec::len);
    let mut weights = vec![Vec::with_capacity(rows); q.len()];
    for k in 0..rows {
        let posture: Vec<f64> = q.iter().map(|q| q[k]).collect();
        let torques = arm.weight_torque(&posture);
        weights.iter_mut().zip(torques.iter()).for_each(|(of, x)| of.push(*x));
    }
    weights
}

/// Of each joint all quantities that change over its rows; `left` has holes where a row does not count.
pub(super) fn all(dict: &Dictionary<'_>, fit: &Fitted, left: &[Vec<Option<f64>>]) -> Vec<Parts> {
    let rows = Rows::of(dict, fit);
    let sorted = |(joint, of): (usize, Of)| {
        let counts = (0..left[joint].len()).filter(|k| left[joint][*k].is_some());
        let mut sorted: Vec<(f64, usize)> = counts.map(|k| (rows.value(joint, of, k), k)).collect();
        sorted.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (first, last) = (sorted.first()?.0, sorted.last()?.0);
        let parts = if of == Of::Mean || of.is_fine() { 1 } else { PARTS };
        // What is the same everywhere would be sorted by its place in the log.
        if sorted.len() < PARTS || (first == last && of != Of::Mean) {
            return None;
        }
        let edge = |part: usize| sorted.len() * part / parts;
        let row = |(_, k): &(f64, usize)| (*k, rows.sign(joint, of, *k));
        let part = |part| sorted[edge(part)..edge(part + 1)].iter().map(row).collect();
        Some(Parts { joint, of, rows: (0..parts).map(part).collect() })
    };
    let joints = left.len();
    let asked = (0..joints).flat_map(|joint| Of::all(joints).map(move |of| (joint, of)));
    let sorted = parallel::each(&asked.collect::<Vec<_>>(), &|asked| sorted(*asked));
    sorted.into_iter().flatten().collect()
}
