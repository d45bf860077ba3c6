//! The table: units, exact angles, TOML and token parsing, validation, into one [`Robot`].
//!
//! A robot file ([`Robot::from_toml`]) and the macro's inline table (`parse_tokens`, feature `macro`) are read
//! into one draft whose cells know their places, cell by cell with the same words and the same
//! grammar, and one validator makes the [`Robot`]: the same mistake has the same message in both.
//! With the feature `urdf` a [`Robot`] can be made of a URDF.

mod angle;
pub mod beyond;
mod decimal;
mod diagnostic;
mod dimension;
mod draft;
mod frames;
#[cfg(all(test, feature = "macro"))]
mod fuzz;
mod inertia;
mod lexeme;
mod model;
mod names;
mod payload;
mod pi;
mod problem;
mod quantity;
mod section;
mod space;
mod suggest;
mod symbols;
#[cfg(feature = "macro")]
mod tokens;
mod toml;
mod units;
#[cfg(feature = "urdf")]
pub mod urdf;
mod validate;

pub use diagnostic::{FileError, Located, Warning};
pub use dimension::Dimension;
pub use frames::{Asked, Refused};
pub use model::{
    Angle, At, Beam, Convention, Drive, Effect, Entry, Frame, Joint, Marker, Motion, NamedFrame,
    Output, Payload, Quantity, Robot, Section, Spot, Value,
};
pub(crate) use names::is_keyword;
#[cfg(feature = "macro")]
pub(crate) use suggest::closest;
pub use symbols::Symbol;
#[cfg(feature = "macro")]
pub use tokens::{File, Invocation, Outline, Rejected, Source, SpannedError, parse_tokens};
