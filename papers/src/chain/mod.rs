//! One chain with an error at every place (Jweeg & Al-Khafaji 2012, eq. 20):
//!
//! ```text
//! T = E_0 · A_1(q_1) E_1 · A_2(q_2) E_2 · … · A_n(q_n) E_n · T_tool E_tool
//! ```
//!
//! Each `E_i` is a small [`Displacement`] that the nominal model leaves out. Loads come *down* the
//! chain from the tip to the base ([`wrenches`]), displacements go *up* it ([`Chain`]); where an
//! error depends on the load, [`settle`] does both in one walk (Bicchi & Melchiorri, eqs. 16-19).
//!
//! # Definitions
//!
//! * SI units and radians. A twist or displacement is `[dx dy dz drx dry drz]`, a wrench
//!   `[fx fy fz mx my mz]`.
//! * The arm's frames are those of `stiffarm_kernels::generic`. The places count from 0: place 0 is
//!   the base, place i behind row i of the table, place n + 1 the tool ([`places`]).
//! * `E_i` is expressed in the axes of nominal frame i, as that frame stands on the displaced chain
//!   before it; the *displaced* frame i is the one behind `E_i`. The rotation of `E_i` is about the
//!   displaced origin.
//! * A wrench "in a frame" has that frame's axes and the moment about its origin, and is what acts
//!   *on* the arm from beyond the frame.
//!
//! # What stands on it
//!
//! * [`elastic`]: joint springs and links as beams, of any table: the wrench recursion of Bicchi &
//!   Melchiorri with all its derivatives; [`Load`]s that turn with the tool or stay with the base.
//! * [`crate::jweeg`]: the displacements, the two-link arm, the study of the difference and the
//!   measured deflections of Jweeg & Al-Khafaji.

pub(crate) mod displacement;
pub mod elastic;
mod load;
mod product;
mod settle;
pub(crate) mod transport;

pub use displacement::rate;
pub use load::Load;
pub use product::{Chain, carry, places, steps};
pub use settle::{Response, Settled, settle};
pub use stiffarm_gap::displacement::Displacement;
pub use transport::{turning, twist_matrix, wrench_in, wrench_matrix, wrenches};

/// Why a chain could not be evaluated.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ChainError {
    /// As many joint values are needed as the arm has joints.
    #[error("found {found} joint values, expected {expected}: one for each joint of the arm")]
    JointValues {
        /// Joints of the arm.
        expected: usize,
        /// Values given.
        found: usize,
    },
    /// As many errors are needed as the chain has places.
    #[error(
        "found {found} displacements, expected {expected}: one for the base, one for each row of \
         the table and one for the tool"
    )]
    Places {
        /// Places of the chain.
        expected: usize,
        /// Displacements given.
        found: usize,
    },
    /// A number that is infinite or not a number.
    #[error("{what} is not a finite number")]
    NotFinite {
        /// Which number.
        what: &'static str,
    },
    /// A link bends so far that no displacement balances its load.
    #[error("the link of row {row} finds no rest under its load: it is far outside small bending")]
    Link {
        /// Row of the table, from 1.
        row: usize,
    },
    /// No posture was found in which a load fixed in the base balances.
    #[error(
        "found no rest of the arm under a load that stays fixed in the base frame: the load may \
         buckle the arm"
    )]
    Load,
}
