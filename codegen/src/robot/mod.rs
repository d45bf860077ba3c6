//! The table: units, exact angles, TOML and token parsing, validation, into one [`Robot`].

mod model;

pub use model::{Angle, Beam, Convention, Joint, Marker, Motion, Robot, Section, Tool, Value};
