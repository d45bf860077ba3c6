//! Joint stiffnesses from displacements under known loads: [`measured`] fits a measurement file,
//! whatever it measures, with weights, links and foundation; a joint that the file does not show is
//! named with the [`Pull`](pull::Pull) that would show it.
//!
//! Units are SI; twists and wrenches stand at the tool origin in base axes.

pub mod measured;
pub mod pull;
