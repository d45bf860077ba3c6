//! Friction and play.

mod asymmetric_friction;
mod backlash;
mod coulomb_friction;
mod friction_curve;
mod friction_hysteresis;
mod load_friction;
mod presliding;
mod stribeck;
mod viscous_friction;
mod warm_up;

pub use asymmetric_friction::AsymmetricFriction;
pub use backlash::{Backlash, BacklashInMotion};
pub use coulomb_friction::CoulombFriction;
pub use friction_curve::FrictionCurve;
pub use friction_hysteresis::FrictionHysteresis;
pub use load_friction::LoadFriction;
pub use presliding::Presliding;
pub use stribeck::Stribeck;
pub use viscous_friction::ViscousFriction;
pub use warm_up::WarmUp;
