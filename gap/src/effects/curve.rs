//! An effect that is a function of one thing, as a curve of the report.

/// Over what a joint's motion is a function.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Over {
    /// What load and weight do to it.
    Torque,
    /// Its reading.
    Reading,
    /// From which side it came to rest.
    Direction,
}

/// A joint's motion as a function of one thing.
pub struct Curve<'a> {
    /// Of what.
    pub over: Over,
    /// Whether the motion is in proportion to it: what is measured as a displacement, the difference
    /// of two states, is a function of the difference then.
    pub proportional: bool,
    /// The motion, rad (m if prismatic).
    pub value: Box<dyn Fn(f64) -> f64 + 'a>,
}
