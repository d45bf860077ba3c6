//! The Rust printer: one module of const-size functions per robot.
//!
//! The text is made once and is the same for the macro, the command and the build script: the macro
//! parses it, the others write it down.

mod body;
mod doc;
mod flexible;
mod function;
mod inputs;
mod interface;
mod module;
mod posture;
mod shapes;
mod style;
mod table;

pub use flexible::flexible_rust;

use self::function::Function;
use self::style::Rust;
use super::constants::Constants;
use super::plan::Plan;
use super::posture::{Needs, Plain, Posture};
use super::readings::Stage;
use super::sets;
use crate::derive::derive_each;
use crate::robot::Robot;

/// What is a matter of the text and not of the robot.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RustOptions {
    /// Path of the kernels crate in the user's code.
    pub kernels: String,
    /// Products fused into sums (`S::mul_add`): one rounding less in most sums, so faster where the target
    /// has the instruction, and not the same bits everywhere. `f64` and `f32` fuse only under the
    /// kernels' feature `fma` and on a target that has the instruction.
    pub fused: bool,
}

impl Default for RustOptions {
    fn default() -> Self {
        RustOptions { kernels: "::stiffarm::kernels".to_string(), fused: false }
    }
}

/// What the items of a module begin with in a file of its own (`pub mod arm;`), whose text is to stay as
/// it was generated: rustfmt leaves it alone, and so do the lints of the crate that it stands in. Attributes
/// like these may stand nowhere else: not where the text is included, nor after an item.
pub const FILE_HEAD: &str = "\
// Neither formatted nor linted: it is to stay as the table has it.
#![cfg_attr(rustfmt, rustfmt_skip)]
#![allow(clippy::all, clippy::cargo, clippy::nursery, clippy::pedantic, clippy::restriction)]
";

/// The items of a robot's module, ready to stand between the braces of a `mod`, to be included there, or,
/// after [`FILE_HEAD`], to stand in a file of its own. The same table always gives the same bytes.
pub fn rust(robot: &Robot, options: &RustOptions) -> String {
    let mut constants = Constants::default();
    let symbolic = !robot.symbols().is_empty();
    let outputs = robot.generated();
    let sets = sets(&outputs);
    let programs = derive_each(robot, &sets);
    let plans: Vec<Plan> = programs.iter().map(|p| Plan::new(p, &mut constants)).collect();
    let stage = Stage::of(robot);
    let style = Rust { fused: options.fused, constants: "constants" };
    let mut posture = Posture::default();
    let needs: Vec<Needs> = plans.iter().map(|plan| posture.admit(plan, &style)).collect();
    if posture.fields().is_empty() {
        // Of an arm that no joint value enters: a struct of numbers has to hold one.
        posture.admit_plain(Plain::Joint(0));
    }

    let mut text = table::header(robot, options);
    if symbolic {
        text.push_str(&table::parameters(robot, &constants));
    }
    text.push_str(&posture::module(&posture, &needs, (&stage, &style), robot.dof()));
    for ((outputs, plan), needs) in sets.iter().zip(&plans).zip(&needs) {
        let function = Function {
            plan,
            outputs,
            needs,
            posture: &posture,
            symbolic,
            stage: &stage,
            style: &style,
        };
        text.push_str(&function.text(robot, options));
    }
    text.push_str(&interface::interface(robot, &posture, &stage, &outputs));
    text
}
