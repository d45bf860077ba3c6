//! The functions beside the arm's own, for whichever language.

use stiffarm_codegen::program::{Module, Refused};
use stiffarm_codegen::robot::Robot;

#[path = "formulas.rs"]
pub mod formulas;

/// The module of an arm with them.
pub fn of(robot: &Robot) -> Result<Module<'_>, Refused> {
    Module::new(robot)
        .function("hand_eye", "Reprojection error of a camera on the tool", formulas::hand_eye)?
        .function("clearance", "Distance of the tool's corner from a plane", formulas::clearance)?
        .function(
            "height",
            "Height of the tool on a vehicle that rolls and pitches",
            formulas::height,
        )
}
