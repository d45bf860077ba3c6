//! What gives under load.

mod base_compliance;
mod bearing_compliance;
mod geometric_stiffness;
mod joint_compliance;
mod joint_hardening;
mod link_compliance;
mod loaded_backlash;
mod soft_zone;

pub use base_compliance::BaseCompliance;
pub use bearing_compliance::BearingCompliance;
pub use geometric_stiffness::GeometricStiffness;
pub use joint_compliance::{JointCompliance, JointElasticity, ServoDroop};
pub use joint_hardening::JointHardening;
pub use link_compliance::LinkCompliance;
pub use loaded_backlash::LoadedBacklash;
pub use soft_zone::SoftZone;
