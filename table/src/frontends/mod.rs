//! What a robot is read from: a robot file, the macro's tokens, a URDF.

#[cfg(all(test, feature = "macro"))]
mod fuzz;
#[cfg(feature = "macro")]
pub(crate) mod tokens;
mod toml;
#[cfg(feature = "urdf")]
pub mod urdf;
