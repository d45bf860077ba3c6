//! Programs of one's own for build scripts: formulas on an arm's frames, printed beside the arm's outputs.
mod formulas;
mod function;
mod geometry;
mod mistake;
mod module;
mod term;

pub use crate::derive::{OwnInput, Quantity, Size};
pub use formulas::{Entries, Formulas};
pub use function::Function;
pub use geometry::{Frame, Point, Vector, quaternion, roll_pitch_yaw};
pub use mistake::Refused;
pub use module::Module;
pub use term::Term;
