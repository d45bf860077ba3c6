//! What the benches of growth have in common: each size in a process of its own, for its memory to
//! be its own; the compiler on a generated text; figures with logarithmic axes.

pub mod alone;
pub mod chart;
pub mod compiler;

/// The arm whose batches and diagnoses are timed: KUKA KR 240-2.
#[allow(missing_docs, clippy::all, reason = "generated, and checked where it is generated")]
pub mod kuka_kr240 {
    include!(concat!(env!("OUT_DIR"), "/kuka_kr240.rs"));
}

/// Its robot file.
pub const ROBOT: &str = include_str!("../../../robots/arms/kuka_kr240.toml");
