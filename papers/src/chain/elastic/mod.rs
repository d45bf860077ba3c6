//! Joint springs and bending links as the errors of a chain: the wrench recursion of Bicchi &
//! Melchiorri (eqs. 16-19) for any table, in space.
//!
//! Behind row i stands `E_i = E_joint E_link` in the standard convention, where the joint's spring
//! gives way before the link bends, and `E_link E_joint` in the modified one, where joint i turns
//! beyond beam i. In the paper's notation a standard row is `K_i = K_kin K_joint K_flex = K(A_i(q_i
//! + k_c τ_i)) K(D_i)`.
//!
//! The paper's printed elements are corrected here: `p_kin` and `K_joint` are those of a standard
//! row, `A(q)⁻¹ A(q + k_c τ)`, which the printed `[−a (1 − cos D), a sin D, 0]` is for α = 0 only;
//! the flexibility of eq. 5 has `L/EA`, `L/GJ` and `L/EJ` on its diagonal.
//!
//! What is left out: the links' own weights, the coupling of bending with torsion, shear in the
//! foreshortening. Bending is small in each single link, while the frames turn as far as they like.

mod arm;
mod dead;
mod link;
mod row;

pub use arm::{ElasticArm, Loaded, Posture};

/// The axes in which a link's wrench is put into its flexibility.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Axes {
    /// Of the displaced tip, as in the paper: no iteration, and the better one for a small load
    /// that turns with the tip (rotation error φ²/30 of a cantilever with tip slope φ, not
    /// −7φ²/15).
    #[default]
    Deformed,
    /// Of the undisplaced tip, as in linear beam theory; the link's displacement is a fixed point.
    Undeformed,
}

/// What is taken of the links' elasticity.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Elasticity {
    /// Axes of the links' wrenches.
    pub axes: Axes,
    /// Whether a bent link's chord gets shorter, by half the integral of its squared slope. Without
    /// it a link's tip error is about 0.4 φ of its deflection, with it about 0.2 φ² or less.
    pub foreshortening: bool,
}
