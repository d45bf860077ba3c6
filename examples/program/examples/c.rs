//! The same functions as C99, `kr240.h` and `kr240.c` in a folder:
//!
//! ```text
//! cargo run -p stiffarm-program --example c -- firmware
//! ```

use std::error::Error;
use std::path::Path;

use stiffarm_codegen::emit::{COptions, Precision, Sines};
use stiffarm_codegen::program::Module;
use stiffarm_codegen::robot::Robot;

#[path = "../formulas.rs"]
mod formulas;

fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args().nth(1).ok_or("usage: c FOLDER")?;
    let table = concat!(env!("CARGO_MANIFEST_DIR"), "/../../robots/arms/kuka_kr240.toml");
    let (robot, _) = Robot::table_from_toml(&std::fs::read_to_string(table)?, table)?;
    let files = Module::new(&robot)
        .function("hand_eye", "Reprojection error of a camera on the tool", formulas::hand_eye)?
        .function("clearance", "Distance of the tool's corner from a plane", formulas::clearance)?
        .function(
            "height",
            "Height of the tool on a vehicle that rolls and pitches",
            formulas::height,
        )?
        .c(&COptions {
            name: "kr240".into(),
            precision: Precision::F64,
            sines: Sines::Polynomial,
        })?;
    std::fs::write(Path::new(&folder).join("kr240.h"), files.header)?;
    std::fs::write(Path::new(&folder).join("kr240.c"), files.source)?;
    Ok(())
}
