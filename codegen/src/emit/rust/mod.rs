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
mod statements;
mod style;
mod table;

pub use flexible::flexible_rust;

use self::function::Function;
use self::style::Rust;
use crate::derive::Program;
use crate::ir::{Group, Module};
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
    let module = Module::new(robot, own, options.fused);
    let style = Rust { fused: options.fused, constants: "constants" };
    let mut text = table::header(&module, own.is_empty(), options);
    if module.is_symbolic() {
        text.push_str(&table::parameters(robot, &module.constants));
    }
    text.push_str(&posture::module(&module, &style));
    let printed = |group: &Group, depth: usize| {
        let each = group.functions.iter();
        let functions = each.map(|of| Function { of, module: &module, style: &style, depth });
        let text: String = functions.map(|function| function.text(options)).collect();
        text + &interface::interface(&module, group, depth)
    };
    let (tool, places) = module.groups.split_at(1);
    text.extend(tool.iter().map(|group| printed(group, 0)));
    if !places.is_empty() {
        text.push_str(&place::module(&module, options, places, printed));
    }
    text
}
