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

pub use choice::{Choice, choose};
pub use solve::{identify, normal_equations};
pub use stiffness::cartesian_stiffness;
pub use system::System;
pub use validate::validate;
pub use weighting::Weighting;

use nalgebra::Vector6;
use stiffarm_kernels::Unstable;

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
    /// Joints that the tests leave open, from 1.
    #[error("the tests do not determine joint {0:?}: load them in other directions")]
    Open(Vec<usize>),
    /// Three points that span no frame.
    #[error("the three points lie on a line: they give no orientation")]
    Collinear,
    /// A load too large for the arm.
    #[error(transparent)]
    Unstable(#[from] Unstable),
}
