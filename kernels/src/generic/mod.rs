//! The textbook: an arm's elastostatics for any number of joints at run time.
//!
//! This is what generated kernels are checked against, so it is written to be read beside the
//! papers and shares nothing with the generator: frames are multiplied out, Jacobian columns are
//! cross products, beams are 6×6 flexibility matrices, and every quantity is evaluated from its
//! definition. Papers are cited by equation:
//!
//! * Dumas, Caro, Cherif, Garnier, Furet: *Joint stiffness identification of industrial serial
//!   robots*, Robotica (2011): Jacobian, K_C, the deflection of compliant joints.
//! * Lin, Chiang, Cui: *An improved method for on-line calculation and compensation of the static
//!   deflection at a robot end-effector*, J. Robotic Systems 8(2) (1991): links as beams.
//! * Bicchi, Melchiorri: *Quasi-static compensation of force errors for flexible manipulators*: the
//!   flexibility matrix of a link in space.
//!
//! # Definitions
//!
//! * Units are SI (or any one consistent system). A twist is `[dx dy dz drx dry drz]`, a wrench
//!   `[fx fy fz mx my mz]`; unless it is said otherwise both stand at the tool origin, in base
//!   axes.
//! * Base axes are those of the world in which the base stands, [`Arm::base`]; its own where that is
//!   the identity.
//! * Frames are numbered 0 (the base) to n. Row i of the table takes frame i−1 to frame i by
//!   `Rz(theta) Tz(d) Tx(a) Rx(alpha) Ry(beta)` in the [standard](Convention::Standard) convention and by
//!   `Rx(alpha) Ry(beta) Tx(a) Rz(theta) Tz(d)` in the [modified](Convention::Modified) one. A revolute
//!   joint's value is added to theta, a prismatic one's to d.
//! * Joint i rotates about, or translates along, z of frame i−1 (standard) or of frame i (modified). Both
//!   conventions fix link i's mass in frame i, and joints 1..=i move it.
//! * The beam of row i runs straight from the origin of frame i−1 to the origin of frame i. In the
//!   standard convention joints 1..=i move it, in the modified one joints 1..=i−1. Its axes and its
//!   flexibility are those of [`Beam`].
//! * What loads a beam's tip is the tool's wrench and, where weights count, everything beyond the
//!   tip: the masses of links i..=n and the beams of rows i+1..=n. Its own weight is spread along
//!   it.
//! * The loaded geometry belongs to the joints' springs: K_C and K_G enter the deflection of the joints and
//!   nothing else. Links are of first order: they bend in the posture as it is, in proportion to the
//!   load. The arm is stable where the joints' `Kθ − K_C` has a positive definite symmetric part.
//!
//! # Panics
//!
//! Every method that takes joint values panics if their number is not [`Arm::dof`].

mod arm;
mod base;
mod beam;
mod by_joints;
mod deflection;
mod dynamics;
mod dynamics_by;
mod evaluate;
mod inverse;
mod jacobian;
mod kinematics;
mod links;
mod parameters;
mod spatial;
mod stiffness;
#[cfg(test)]
mod tests;
mod textbook;
mod weight;

pub use arm::{Arm, Beam, Convention, Drive, Joint};
pub use base::BaseParameter;
