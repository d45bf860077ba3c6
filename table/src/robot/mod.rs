//! The model: what a robot file or an inline table says, with the grammar of its cells, in SI units and exact angles.
//!
//! What fields there are is told in `schema`, what a [`Robot`] is read from in `frontends`: the same mistake has the same
//! message in a robot file ([`Robot::from_toml`]) and in the macro's table (`parse_tokens`, feature `macro`).

pub(crate) mod angle;
pub mod beyond;
mod closed_form;
pub(crate) mod decimal;
mod diagnostic;
mod dimension;
mod families;
pub(crate) mod frames;
pub(crate) mod inertia;
pub(crate) mod lexeme;
mod model;
pub(crate) mod names;
mod nearest;
mod payload;
pub mod pi;
pub mod problem;
pub(crate) mod quantity;
mod search;
mod section;
mod sliding;
pub(crate) mod space;
pub(crate) mod suggest;
pub(crate) mod units;

#[cfg(feature = "macro")]
pub use crate::frontends::tokens::{
    File, Invocation, Outline, Rejected, Source, SpannedError, parse_tokens,
};
#[cfg(feature = "urdf")]
pub use crate::frontends::urdf;
pub use crate::schema::Symbol;
pub use closed_form::{ClosedForm, Family, Position, Redundancy};
pub use diagnostic::{FileError, Located, Warning};
pub use dimension::Dimension;
pub use frames::{Asked, Refused, Wanted};
pub use frames::{CLOSED_FORM, ELBOW_ANGLE, GIVES, INVERSE_KINEMATICS};
pub use model::{
    Angle, At, Beam, Convention, Drive, Effect, Entry, Frame, Joint, Marker, Motion, NamedFrame,
    Output, Payload, Quantity, Robot, Section, Spot, Value,
};
pub use names::is_keyword;
pub use nearest::{DEFLECTION, STEPPED};
pub use sliding::Sliding;
#[cfg(feature = "macro")]
pub use suggest::closest;
