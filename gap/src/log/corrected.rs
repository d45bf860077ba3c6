//! The robot file with what a log has shown put into it.
//!
//! Friction and rotors go into the rows' own entries, the rigid links' numbers as bodies that have them, and what no
//! entry holds into `[[effect]]` tables, which a later diagnosis of a log takes as known.

use nalgebra::{DMatrix, DVector};
use stiffarm_kernels::generic::Arm;
use stiffarm_table::robot::Robot;

use super::bodies::{bodies, moments};
use super::known;
use super::model::Model;
use super::read::{Log, TorqueSide};
use super::report::LogDiagnosis;
use super::rigid::Base;
use super::scene::Domain;
use crate::effects::{RobotFile, significant};
use crate::robot::{self, RobotError};
use crate::signal::Signals;

/// Samples of a log by which the links' numbers are weighed.
const SAMPLES: usize = 3000;

/// A robot with what was found in it.
#[derive(Clone, Debug, PartialEq)]
pub struct Corrected {
    /// The robot.
    pub robot: Robot,
    /// Of each finding, in their order, the entries that hold it.
    pub entries: Vec<String>,
    /// By how much the torques of the bodies differ from those of the numbers that were fitted, as a part of
    /// the joints' spread, mean; `None` of position rows, which tell nothing of the links.
    pub bodies: Option<f64>,
}

/// Why nothing can be written.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Unwritable {
    /// The table has cells that are no numbers.
    #[error(transparent)]
    Robot(#[from] RobotError),
    /// A log of currents.
    #[error(
        "found currents alone, expected torques: a robot file is in newton-metres, and a log of currents tells \
         no newton-metres per ampere; give tau1 … with the motors' constants"
    )]
    Currents,
}

/// The robot that a log was diagnosed with, or the same as a campaign has corrected it, with what was found put
/// into it.
///
/// # Errors
/// [`Unwritable`]: the log tells no newton-metres.
pub fn corrected(
    robot: &Robot,
    arm: &Arm,
    log: &Log,
    found: &LogDiagnosis,
    model: &Model,
) -> Result<Corrected, Unwritable> {
    if model.side == Some(TorqueSide::Current) {
        return Err(Unwritable::Currents);
    }
    let mut file = RobotFile::new(robot, arm);
    // Behind the gear nothing of what the drive's entries hold is felt.
    let has_drive = model.side != Some(TorqueSide::Link);
    let mut tables = robot.effects.clone();
    let mut entries = Vec::new();
    for term in &model.terms {
        let written = has_drive.then(|| term.effect.write(&mut file, term.spot, &term.values));
        let links = term.effect.carried(arm, term.spot).map(|carried| match carried.run {
            None => "mass, com and inertia".to_owned(),
            Some(_) => "nothing: it is of one run".to_owned(),
        });
        entries.push(links.or(written.flatten()).unwrap_or_else(|| {
            tables.push(known::table(term));
            "an [[effect]]".to_owned()
        }));
    }
    let mut robot = file.finish(&[]);
    robot.effects = tables;
    robot.torque_side = match model.side {
        None => robot.torque_side,
        side => TorqueSide::ALL.iter().find(|(_, s)| Some(*s) == side).map(|(name, _)| *name),
    };
    let bodies = match model.rows {
        Domain::Torque => Some(put_bodies(&mut robot, arm, log, found, model)?),
        Domain::Position => None,
    };
    Ok(Corrected { robot, entries, bodies })
}

/// Puts bodies into the rows that ask for the torques that were fitted; how much these differ.
fn put_bodies(
    robot: &mut Robot,
    arm: &Arm,
    log: &Log,
    found: &LogDiagnosis,
    model: &Model,
) -> Result<f64, Unwritable> {
    let log = &*model.readings.mended(log);
    let signals = Signals::of(log, model.drive, Some(model.band));
    let n = arm.dof();
    let count = signals.t.len();
    let every = count.div_ceil(SAMPLES).max(1);
    let at = |of: &[Vec<f64>], k: usize| of.iter().map(|x| x[k]).collect::<Vec<f64>>();
    let rows: Vec<DMatrix<f64>> = (0..count)
        .step_by(every)
        .map(|k| {
            let motion = [&signals.q, &signals.qd, &signals.qdd].map(|of| at(of, k));
            arm.torque_regressor(&motion[0], &motion[1], &motion[2])
        })
        .collect();
    // As many rows as the log has independent numbers, each told in what is left of its joint.
    let share = found.evidence.effective / (rows.len() * n) as f64;
    let mut weight = DMatrix::zeros(10 * n, 10 * n);
    for sample in &rows {
        let mut told = sample.clone();
        for (mut row, gap) in told.row_iter_mut().zip(&found.gap) {
            // A joint that is left out tells nothing.
            row *= if gap.after > 0.0 { 1.0 / gap.after } else { 0.0 };
        }
        weight.gemm_tr(share, &told, &told, 1.0);
    }
    let wanted = links(arm, model);
    // What the log does not tell stays near to the file that it is put into.
    let bodies = bodies(&robot::arm(robot)?, &wanted, &weight);
    let off = DVector::from_vec(moments(&bodies)) - DVector::from_column_slice(&wanted);
    let mut differ = vec![0.0; n];
    for sample in &rows {
        let torques = sample * &off;
        differ.iter_mut().zip(torques.iter()).for_each(|(sum, torque)| *sum += torque * torque);
    }
    for (joint, body) in robot.joints.iter_mut().zip(&bodies) {
        joint.mass = Some(significant(body.mass));
        joint.com = body.com.map(significant);
        joint.inertia = Some(body.inertia.map(significant));
    }
    let parts = differ.iter().zip(&found.gap);
    Ok(parts.map(|(sum, gap)| (sum / rows.len() as f64).sqrt() / gap.size).sum::<f64>() / n as f64)
}

/// Numbers of all links that ask what the model's do, with what was found of links.
fn links(arm: &Arm, model: &Model) -> Vec<f64> {
    let base = Base::of(arm);
    let mut values = model.rigid.clone();
    for term in &model.terms {
        let Some(carried) = term.effect.carried(arm, term.spot) else { continue };
        if carried.run.is_some() {
            continue;
        }
        for (numbers, value) in carried.numbers.iter().zip(&term.values) {
            for (row, sum) in values.iter_mut().enumerate() {
                let part = numbers.iter().enumerate();
                let part = part.map(|(k, x)| base.mix[(row, 10 * carried.link + k)] * x);
                *sum += value * part.sum::<f64>();
            }
        }
    }
    base.numbers(&values)
}
