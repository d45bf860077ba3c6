//! Functions of one's own beside an arm's outputs, for build scripts: a camera's reprojection, a second tool, a cost.
//!
//! A function is written down once, as formulas on the arm's frames and on inputs of one's own, and becomes Rust and C
//! in the arm's module: straight-line text, `no_std`, for every kind of number, with the arm's posture, its operations
//! counted, its inputs and results documented with their units.
//!
//! ```
//! use stiffarm_codegen::emit::RustOptions;
//! use stiffarm_codegen::program::Module;
//! use stiffarm_codegen::robot::Robot;
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let table = r#"
//!     name = "elbow"
//!     convention = "standard"
//!     joint = [{ type = "revolute", a = 0.6 }, { type = "revolute", a = 0.45 }]
//! "#;
//! let (robot, _) = Robot::from_toml(table, "elbow.toml")?;
//! let module = Module::new(&robot).function("reach", "How far the tool is from a point", |f| {
//!     let target = f.base().point(f.vector("target", "m", "the point, base axes"));
//!     let reach = f.lever(f.tool().origin(), target).norm();
//!     f.result("distance", "m", "Distance of the tool's origin from the point", reach);
//!     f.result("slope", "m/rad", "Its change by each joint", f.gradient(reach, &f.joints()));
//! })?;
//! let text = module.rust(&RustOptions::default());
//! assert!(text.contains("pub fn reach<S: Scalar>(q: &[S; 2], target: &[S; 3]) -> reach::Reach<S>"));
//! # Ok(())
//! # }
//! ```
//!
//! In `build.rs` [`read_robot`](crate::read_robot) reads the robot file and [`Module::to_out_dir`] writes the text;
//! `examples/program` is a package that does, with a hand-eye residual and a distance to a plane.
//!
//! * **Vectors are not numbers.** A [`Vector`] or a [`Point`] stands in no axes; its components in a [`Frame`] are
//!   [`Term`]s. So the whole function is worked out in the frame of the chain in which it costs least, as the arm's
//!   outputs are: the formulas are asked once for each.
//! * **Derivatives** ([`Formulas::derivatives`]) are those of the graph, by inputs, joint values, or [variations](
//!   Formulas::variation), forwards or backwards, whichever is shorter. Of a frame's place, however it is written, the
//!   six that count are those by the variations of [`Frame::displaced`].
//! * **Shared** is what two results have in common, and zero is zero: an input that does not enter costs nothing.
//! * There is no `atan2` and no branch, in which kernels would not be straight lines: an angle enters as an input, its
//!   sine and cosine are taken by the kernels' own polynomial, and an error of rotation is told by axes (their cross
//!   products), not by angles. A divisor, or the length of a vector under a derivative, must not be zero where the
//!   function is called: what depends on it is then not finite, and the generated documentation says so.

mod entries;
mod formulas;
mod function;
mod geometry;
mod mistake;
mod module;

pub use crate::derive::{OwnInput, Quantity, Size};
pub use crate::term::Term;
pub use entries::Entries;
pub use formulas::Formulas;
pub use function::Function;
pub use geometry::{Frame, Point, Vector, quaternion, roll_pitch_yaw};
pub use mistake::Refused;
pub use module::Module;
