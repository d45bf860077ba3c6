//! A plant: the real arm with chosen effects, to be measured by a diagnosis that is not told.
//!
//! It shares with the diagnosis the robot file's table, the rows that are to be measured, and names,
//! places and parameters of the effects; nothing else. Its transforms are its own 4×4 products, every effect
//! is a true transform or number at its place, and equilibrium is found on the deformed arm from
//! the work that the loads do in each displacement, not by passing wrenches down the chain.
//!
//! ```text
//! T = E_base · B · Π_i [ P_i · D_i · M_i(q_i) · S_i · L_i ] · T_tool · E_tool
//! ```
//!
//! `E_base` stands between measuring frame and base; `B` is the foundation, `D_i` and `L_i` joint
//! and link, which yield to what loads them. A row `i` is `Rz Tz Tx Rx` (standard: joint first) or
//! `Rx Tx Rz Tz` (modified: joint and beam in between).

mod assemble;
mod balance;
mod campaign;
mod chain;
mod late;
mod law;
mod laws;
mod noise;
mod notation;
mod observe;
mod reading;
mod reality;
mod seated;
mod transform;
mod truth;

pub mod course;
pub mod design;
#[cfg(test)]
#[path = "../../gap/src/fixture.rs"]
#[allow(dead_code, reason = "the arms of gap's tests, of which few are needed here")]
mod fixture;
pub mod motion;

#[cfg(test)]
use stiffarm_gap::robot;
use stiffarm_gap::{effects, instrument, io, log, measurement, rng};
use stiffarm_kernels::generic::Arm;

pub use crate::io::{number, quoted};
pub use crate::measurement::csv;
pub use campaign::{Campaign, Instrument, Scatter};
pub use laws::{effects, has_law};
pub use noise::Noise;
pub use notation::TruthError;
pub use observe::Frames;
pub use truth::Truth;

use crate::effects::Known;
use crate::measurement::{Measurements, Row};
use crate::rng::{Rng, Stream};
use observe::{InOrder, Shown};
use reality::Reality;

/// Why a plant cannot be made or measured.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum PlantError {
    /// A truth that this arm cannot have.
    #[error(transparent)]
    Truth(#[from] TruthError),
    /// The truths together come to something that cannot be.
    #[error("{arm}: {fault}")]
    Total {
        /// The arm's name.
        arm: String,
        /// Which total, and what is expected.
        fault: String,
    },
    /// The rows are those of another robot.
    #[error(
        "{file}: found readings of {found} joints, expected {expected} as the robot has: read the \
         file for this robot"
    )]
    Joints {
        /// What the rows are called.
        file: String,
        /// Readings of a row.
        found: usize,
        /// Joints of the arm.
        expected: usize,
    },
    /// The arm buckles.
    #[error(
        "{file}: line {line}: the arm with these effects is not in stable equilibrium under this \
         row's load and its weight: make the load or the effect smaller"
    )]
    Unstable {
        /// What the rows are called.
        file: String,
        /// The row's line.
        line: u64,
    },
    /// The ball is not in its socket.
    #[error(
        "{file}: line {line}: no small move of the joints brings the ball into its socket: the arm is stretched \
         there: bend it, or plan other postures (--seed)"
    )]
    Unseated {
        /// What the rows are called.
        file: String,
        /// The row's line.
        line: u64,
    },
}

/// The real arm.
#[derive(Clone, Debug)]
pub struct Plant {
    nominal: Reality,
    reality: Reality,
    /// Of each session in order; further ones are measured as the last.
    frames: Vec<Frames>,
    first_order_sim: bool,
}

impl Plant {
    /// The robot of the file with these truths; none is the robot of the file.
    ///
    /// # Errors
    /// [`PlantError::Truth`] for a truth that this arm cannot have, [`PlantError::Total`] if
    /// compliances, masses or flexibilities become negative.
    pub fn new(arm: &Arm, truths: &[Truth]) -> Result<Plant, PlantError> {
        Plant::beyond(arm, &[], truths)
    }

    /// The same where the robot file has effects of its own.
    ///
    /// # Errors
    /// As [`Plant::new`].
    pub fn beyond(arm: &Arm, known: &[Known], truths: &[Truth]) -> Result<Plant, PlantError> {
        for truth in truths {
            truth.check(arm).map_err(|fault| TruthError { text: truth.to_string(), fault })?;
        }
        let real = |truths: &[Truth]| {
            Reality::new(arm, truths)
                .map_err(|fault| PlantError::Total { arm: arm.name.clone(), fault })
        };
        let known: Vec<Truth> = known.iter().map(|known| Truth::known(known, arm)).collect();
        let (nominal, reality) = (real(&known)?, real(&[&known, truths].concat())?);
        let first_order_sim = reality.geometric != 0.0;
        Ok(Plant { nominal, reality, frames: vec![Frames::default()], first_order_sim })
    }

    /// The same plant, measured in frames that nobody knows.
    pub fn with_frames(self, frames: Frames) -> Plant {
        Plant { frames: vec![frames], ..self }
    }

    /// The same of several sessions, each with a base of its own beyond the frames'.
    pub fn with_sessions(self, frames: &Frames, bases: Vec<nalgebra::Isometry3<f64>>) -> Plant {
        let each = bases.into_iter().map(|base| Frames { base, ..frames.clone() });
        Plant { frames: std::iter::once(frames.clone()).chain(each).collect(), ..self }
    }

    /// The same plant; what is measured has `sim_` columns of first order in the load, as far as
    /// the truths do not say otherwise. With `geometric_stiffness` they are there in any case.
    pub fn with_first_order_sim(mut self) -> Plant {
        if self.reality.geometric == 0.0 {
            self.reality.geometric = 1.0;
        }
        self.first_order_sim = true;
        self
    }

    /// Measures every row of a design; what it holds as measured or simulated is replaced.
    ///
    /// The noise of a row depends on the seed and its number, not on the truths.
    ///
    /// # Errors
    /// [`PlantError::Joints`] for the rows of another robot, [`PlantError::Unstable`] for a load
    /// that the arm does not carry.
    pub fn measure(
        &self,
        design: &Measurements,
        noise: Noise,
        seed: u64,
    ) -> Result<Measurements, PlantError> {
        Ok(blurred(&self.exact(design)?, noise, seed))
    }

    /// The same without noise.
    ///
    /// # Errors
    /// As [`Plant::measure`].
    pub fn exact(&self, design: &Measurements) -> Result<Measurements, PlantError> {
        let components = design.kind.components();
        let mut measured = design.clone();
        measured.sim_given = components.map(|measured| measured && self.first_order_sim);
        let (mut sessions, mut session) = (design.sessions(), (1, 0));
        let (mut following, mut frames) = (self.frames.iter(), &self.frames[0]);
        for (k, row) in measured.rows.iter_mut().enumerate() {
            if k == session.1 {
                let rows = sessions.next().map_or(0, <[Row]>::len);
                session = (k + 1, k + rows);
                frames = following.next().unwrap_or(frames);
            }
            let at = InOrder { row: &design.rows[k], number: k + 1, all: &design.rows, session };
            self.same_joints(design, at.row)?;
            let shown = self.shown(&self.reality, frames, design, at)?;
            row.measured = only(shown.vector(), components);
            row.sim = None;
            if self.first_order_sim {
                let exact = self.shown(&self.nominal, &Frames::default(), design, at)?;
                let first = self.nominal.first_order(at, design.kind);
                let sim = exact.towards(&first, self.reality.geometric);
                row.sim = Some(Box::new(only(sim.vector(), components)));
            }
        }
        Ok(measured)
    }

    fn same_joints(&self, design: &Measurements, row: &Row) -> Result<(), PlantError> {
        let (found, expected) = (row.q.len(), self.reality.joints.len());
        if found == expected {
            return Ok(());
        }
        Err(PlantError::Joints { file: design.file.clone(), found, expected })
    }

    fn shown(
        &self,
        reality: &Reality,
        frames: &Frames,
        design: &Measurements,
        at: InOrder<'_>,
    ) -> Result<Shown, PlantError> {
        reality
            .shown(at, design.kind, frames)
            .map_err(|_| PlantError::Unstable { file: design.file.clone(), line: at.row.line })
    }
}

/// Measurements with noise added. Of a rotation of which only some components are measured, those
/// are what is disturbed.
pub fn blurred(exact: &Measurements, noise: Noise, seed: u64) -> Measurements {
    let mut rng = Rng::new(seed, Stream::Noise);
    let components = exact.kind.components();
    let mut measured = exact.clone();
    for row in &mut measured.rows {
        let whole = Shown::of(&row.measured).noisy(noise, &mut rng);
        row.measured = only(whole.vector(), components);
    }
    measured
}

/// 0 where nothing is measured.
fn only(mut vector: nalgebra::Vector6<f64>, components: [bool; 6]) -> nalgebra::Vector6<f64> {
    for k in (0..6).filter(|k| !components[*k]) {
        vector[k] = 0.0;
    }
    vector
}

#[cfg(test)]
mod tests;
