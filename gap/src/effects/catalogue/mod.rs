//! The effects that stiffarm knows, one file each.

mod backlash;
mod base_compliance;
mod base_frame;
mod bearing_compliance;
mod bearing_wobble;
mod counterbalance;
mod drift;
mod friction_hysteresis;
mod geometric_stiffness;
mod geometry;
mod gravity_tilt;
mod instrument_scale;
mod joint_compliance;
mod joint_coupling;
mod joint_hardening;
mod joint_offset;
mod joint_ratio;
mod joint_warming;
mod latency;
mod link_com;
mod link_compliance;
mod link_geometry;
mod link_weight;
mod loaded_backlash;
mod payload_com;
mod settling_lag;
mod slip;
mod soft_zone;
mod thermal_growth;
mod tool_frame;
mod transmission_error;
mod wrench_scale;

use super::Effect;

pub use backlash::Backlash;
pub use base_compliance::BaseCompliance;
pub use base_frame::BaseFrame;
pub use bearing_compliance::BearingCompliance;
pub use bearing_wobble::BearingWobble;
pub use counterbalance::Counterbalance;
pub use drift::Drift;
pub use friction_hysteresis::FrictionHysteresis;
pub use geometric_stiffness::GeometricStiffness;
pub use geometry::Geometry;
pub use gravity_tilt::GravityTilt;
pub use instrument_scale::InstrumentScale;
pub use joint_compliance::JointCompliance;
pub use joint_coupling::JointCoupling;
pub use joint_hardening::JointHardening;
pub use joint_offset::JointOffset;
pub use joint_ratio::JointRatio;
pub use joint_warming::JointWarming;
pub use latency::Latency;
pub use link_com::LinkCom;
pub use link_compliance::LinkCompliance;
pub use link_geometry::LinkGeometry;
pub use link_weight::LinkWeight;
pub use loaded_backlash::LoadedBacklash;
pub use payload_com::PayloadCom;
pub use settling_lag::SettlingLag;
pub use slip::Slip;
pub use soft_zone::SoftZone;
pub use thermal_growth::ThermalGrowth;
pub use tool_frame::ToolFrame;
pub use transmission_error::TransmissionError;
pub use wrench_scale::WrenchScale;

/// Every effect, in the order in which equally good explanations are preferred.
pub const CATALOGUE: [&dyn Effect; 32] = [
    &JointOffset,
    &JointCompliance,
    &Backlash,
    &JointRatio,
    &SettlingLag,
    &Latency,
    &FrictionHysteresis,
    &JointHardening,
    &LoadedBacklash,
    &SoftZone,
    &TransmissionError,
    &Counterbalance,
    &JointCoupling,
    &LinkCompliance,
    &BearingCompliance,
    &LinkWeight,
    &WrenchScale,
    &PayloadCom,
    &LinkCom,
    &GravityTilt,
    &BaseCompliance,
    &ThermalGrowth,
    &JointWarming,
    &InstrumentScale,
    &BearingWobble,
    &LinkGeometry,
    &Geometry,
    &BaseFrame,
    &ToolFrame,
    &Slip,
    &Drift,
    &GeometricStiffness,
];

/// The one that adds to the spring of a joint.
pub(crate) const JOINT_SPRING: &dyn Effect = &JointCompliance;

/// The effects that a diagnosis tries: those that stiffarm knows, and one's own.
#[derive(Clone, Debug, PartialEq)]
pub struct Catalogue(Vec<&'static dyn Effect>);

impl Default for Catalogue {
    /// [`CATALOGUE`].
    fn default() -> Self {
        Catalogue(CATALOGUE.to_vec())
    }
}

impl Catalogue {
    /// With one more, which of equally good explanations is preferred last. One that is made at run
    /// time lives as long as the program: [`Box::leak`].
    ///
    /// # Panics
    /// If there is one with its identifier: findings could not be told apart.
    #[must_use]
    pub fn with(mut self, effect: &'static dyn Effect) -> Self {
        let name = effect.identifier();
        assert!(self.named(name).is_none(), "found two effects called `{name}`, expected one");
        self.0.push(effect);
        self
    }

    /// All of them.
    pub fn iter(&self) -> impl Iterator<Item = &'static dyn Effect> {
        self.0.iter().copied()
    }

    /// By its identifier.
    pub fn named(&self, identifier: &str) -> Option<&'static dyn Effect> {
        self.iter().find(|effect| effect.identifier() == identifier)
    }

    /// All identifiers.
    pub fn identifiers(&self) -> Vec<&'static str> {
        self.iter().map(|effect| effect.identifier()).collect()
    }
}
