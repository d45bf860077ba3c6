//! The same functions as C99, `kr240.h` and `kr240.c` in a folder:
//!
//! ```text
//! cargo run -p stiffarm-program --example c -- firmware
//! ```

use std::error::Error;
use std::path::Path;

use stiffarm_codegen::emit::{COptions, Precision, Sines};
use stiffarm_codegen::robot::Robot;

#[path = "../module.rs"]
mod module;

fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args().nth(1).ok_or("usage: c FOLDER")?;
    let table = concat!(env!("CARGO_MANIFEST_DIR"), "/../../robots/arms/kuka_kr240.toml");
    let (robot, _) = Robot::for_kernels(&std::fs::read_to_string(table)?, table)?;
    let options =
        COptions { name: "kr240".into(), precision: Precision::F64, sines: Sines::Polynomial };
    let files = module::of(&robot)?.c(&options)?;
    std::fs::write(Path::new(&folder).join("kr240.h"), files.header)?;
    std::fs::write(Path::new(&folder).join("kr240.c"), files.source)?;
    Ok(())
}
