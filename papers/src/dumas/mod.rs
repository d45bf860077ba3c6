//! Joint stiffnesses from displacements under known loads (Dumas, Caro, Cherif, Garnier, Furet:
//! *Joint stiffness identification of industrial serial robots*, Robotica 2011, sections 2 to 5).
//!
//! The displacement of the tool is linear in the joints' compliances: `A x = δd` for one [`Test`]
//! (eqs. 20-21), `B x = c` for all of them (eqs. 22-24).
//!
//! * [`identify`] solves it with the instrument's noise as [`Weighting`], columns scaled; the paper's
//!   [`normal_equations`] (eq. 26) are there to compare. A joint that the tests do not show is refused.
//! * [`cartesian_stiffness`]: K_X of eq. 10.
//! * [`zones`] compares parts of a map of dexterity, and [`choose`] picks test postures from it.
//! * [`points`]: the displacement from three points before and after (eqs. 27-30).
//! * [`validate()`]: prediction of tests that were not used (Figs. 9-12).
//! * [`rig`] simulates the experiment, and [`study`] repeats it: number of tests (Fig. 7) and
//!   measurement errors (Table 2).
//! * [`links`]: the part of the displacement that is the links' and not the joints'.
//!
//! Units are SI; twists and wrenches stand at the tool origin in base axes.

mod choice;
pub mod links;
pub mod points;
pub mod rig;
mod solve;
mod stiffness;
pub mod study;
mod system;
mod validate;
mod weighting;
pub mod zones;

pub use choice::{Choice, TestPosture, choose};
pub use solve::{Identified, identify, normal_equations};
pub use stiffness::{NoStiffness, cartesian_stiffness};
pub use system::System;
pub use validate::{Checked, Validation, validate};
pub use weighting::Weighting;

use nalgebra::Vector6;
use stiffarm_kernels::Unstable;
use stiffarm_kernels::generic::Arm;

/// One loading of the arm.
#[derive(Clone, Debug, PartialEq)]
pub struct Test {
    /// Joint readings, rad or m, n.
    pub q: Vec<f64>,
    /// The load that was added, N and N·m.
    pub wrench: Vector6<f64>,
    /// What it moved the tool by, m and (small) rad.
    pub displacement: Vector6<f64>,
}

/// Why nothing could be identified.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum IdentifyError {
    /// No tests.
    #[error("found no tests, expected at least one")]
    NoTests,
    /// A test with the wrong number of joint values.
    #[error("test {test} has {found} joint values, expected {expected}")]
    Posture {
        /// From 1.
        test: usize,
        /// In the test.
        found: usize,
        /// Of the arm.
        expected: usize,
    },
    /// A number that is infinite or not a number.
    #[error("test {test} holds a number that is not finite, or too large to compute with")]
    NotFinite {
        /// From 1.
        test: usize,
    },
    /// A setting outside its range.
    #[error("found {found} as {what}, expected {expected}")]
    Setting {
        /// Which setting.
        what: &'static str,
        /// As given.
        found: f64,
        /// What it must be.
        expected: &'static str,
    },
    /// Joints that the tests leave open, from 1.
    #[error("the tests do not determine joint {}: load them in other directions", listing(.0))]
    Open(Vec<usize>),
    /// Three points that span no frame.
    #[error("the three points lie on a line: they give no orientation")]
    Collinear,
    /// A load too large for the arm.
    #[error(transparent)]
    Unstable(#[from] Unstable),
}

fn listing(joints: &[usize]) -> String {
    joints.iter().map(usize::to_string).collect::<Vec<_>>().join(", ")
}

fn check(arm: &Arm, tests: &[Test]) -> Result<(), IdentifyError> {
    if tests.is_empty() {
        return Err(IdentifyError::NoTests);
    }
    for (k, test) in tests.iter().enumerate() {
        if test.q.len() != arm.dof() {
            let (found, expected) = (test.q.len(), arm.dof());
            return Err(IdentifyError::Posture { test: k + 1, found, expected });
        }
        let numbers = test.q.iter().chain(test.wrench.iter()).chain(test.displacement.iter());
        if !numbers.into_iter().all(|x| x.is_finite()) {
            return Err(IdentifyError::NotFinite { test: k + 1 });
        }
    }
    Ok(())
}
