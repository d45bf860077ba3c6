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
mod place;
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
use super::{Functions, functions};
use crate::derive::Program;
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
    rust_with(robot, &[], options)
}

/// The same with functions of one's own.
pub(crate) fn rust_with(robot: &Robot, own: &[&Program], options: &RustOptions) -> String {
    let mut constants = Constants::default();
    let symbolic = !robot.symbols().is_empty();
    let all = functions(robot);
    let (tool, places) = all.split_at(1);
    let of_tool = tool.iter().flat_map(|of| &of.programs).chain(own.iter().copied());
    let programs = of_tool.chain(places.iter().flat_map(|of| &of.programs));
    let plans: Vec<Plan> = programs.map(|p| Plan::new(p, &mut constants)).collect();
    let stage = Stage::of(robot);
    let style = Rust { fused: options.fused, constants: "constants" };
    let mut posture = Posture::default();
    let needs: Vec<Needs> = plans.iter().map(|plan| posture.admit(plan, &style)).collect();
    if posture.fields().is_empty() {
        // Of an arm that no joint value enters: a struct of numbers has to hold one.
        posture.admit_plain(Plain::Joint(0));
    }

    let mut text = table::header(robot, own.is_empty(), options);
    if symbolic {
        text.push_str(&table::parameters(robot, &constants));
    }
    text.push_str(&posture::module(&posture, &needs, (&stage, &style), robot));
    let mut each = plans.iter().zip(&needs);
    let mut printed = |of: &Functions, own: usize, depth: usize| {
        let mut text = String::new();
        for (plan, needs) in each.by_ref().take(of.programs.len() + own) {
            let (posture, stage, style) = (&posture, &stage, &style);
            let function = Function { plan, needs, posture, symbolic, stage, style, depth };
            text.push_str(&function.text(robot, options));
        }
        text + &interface::interface(robot, &posture, &stage, of, depth)
    };
    tool.iter().for_each(|of| text.push_str(&printed(of, own.len(), 0)));
    if !places.is_empty() {
        text.push_str(&place::module(robot, options, (places, &stage), |of, depth| {
            printed(of, 0, depth)
        }));
    }
    text
}
