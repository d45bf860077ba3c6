//! The functions of named frames and markers: modules of their own, which share the posture.

use stiffarm_kernels::Form;

use super::super::cells;
use super::RustOptions;
use super::table::{self, listed};
use crate::emit::lines::Lines;
use crate::ir::{Group, Module};
use crate::robot::Robot;

/// The module `at`, with a module for each of `places`, whose items `printed` writes.
pub(super) fn module(
    module: &Module,
    options: &RustOptions,
    places: &[Group],
    printed: impl Fn(&Group, usize) -> String,
) -> String {
    let mut out = Lines::at(0);
    out.blank();
    out.doc("The arm at its named frames and markers; the posture is the arm's.");
    out.within("pub mod at {", "}", |out| {
        for (k, of) in places.iter().enumerate() {
            if k > 0 {
                out.blank();
            }
            let place = of.place.as_deref().unwrap_or_default();
            docs(out, module.robot, place);
            out.within(&format!("pub mod {place} {{"), "}", |out| {
                imports(out, module, options, of);
                out.text.push_str(&printed(of, out.depth));
            });
        }
    });
    out.finish()
}

/// Where the place is.
fn docs(out: &mut Lines, robot: &Robot, place: &str) {
    let place_is = match robot.frames.iter().find(|named| named.name == place) {
        Some(named) => {
            let joint = &robot.joints[named.row].name;
            format!(
                "the frame {}, in frame {}, that of {joint}. \
                 Joints beyond it do not enter.",
                cells::place(&named.frame),
                named.row + 1
            )
        }
        None => "the marker on the tool, in the tool's axes.".to_owned(),
    };
    out.doc(&format!(
        "The arm whose tool is `{place}`: what is said of the tool here is of {place_is}"
    ));
}

/// What the items of the module need.
fn imports(out: &mut Lines, module: &Module, options: &RustOptions, of: &Group) {
    let uses = [
        (true, "Arm DhRow Error Kernels Output Scalar fill has"),
        (of.outputs.iter().any(|o| o.form() == Form::Pose), "Pose"),
        (of.outputs.iter().any(|o| o.is_fallible()), "Unstable"),
    ];
    table::imports(out, options, &uses);
    let symbolic = if module.is_symbolic() { "Constants, Parameters, " } else { "" };
    let joints = if module.readings.moves { ", joints" } else { "" };
    out.code(&format!("use super::super::{{DH, N, NAME, {symbolic}Posture{joints}}};"));
    out.blank();
    listed(out, &of.outputs);
}
