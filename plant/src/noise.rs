//! The instrument's noise.

/// Standard deviations of the instrument.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Noise {
    /// Of each measured coordinate, m.
    pub position: f64,
    /// Of each component of a measured rotation, rad.
    pub rotation: f64,
}
