//! What the derivation may do to save operations; each can be switched off, to see what it buys.

/// The passes of the derivation. The result is the same up to rounding with any of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Passes {
    /// Works in the frame of the chain in which the outputs cost least, not in the base's.
    pub frame: bool,
    /// Sums the angles of parallel joints before their sine and cosine are taken.
    pub sums: bool,
    /// Tries to work twists out in the joints' own frames and to turn them inwards, run of parallel
    /// joints by run; taken where it costs less.
    pub runs: bool,
    /// Adds up the parts of the compliance that joints with one axis have in common.
    pub parallel: bool,
    /// Tries to derive how torques change by values and rates in closed form, by what each joint carries as one
    /// body, and not from the graph of the torques; taken where it costs less.
    pub bodies: bool,
}

impl Passes {
    /// Everything.
    pub const ALL: Passes =
        Passes { frame: true, sums: true, runs: true, parallel: true, bodies: true };
    /// Nothing: base axes, one angle per joint, every translation turned by itself.
    pub const NONE: Passes =
        Passes { frame: false, sums: false, runs: false, parallel: false, bodies: false };
}

impl Default for Passes {
    fn default() -> Self {
        Passes::ALL
    }
}
