//! The kernels of the arm whose batches are timed.

use std::error::Error;
use std::path::Path;

use stiffarm_codegen::emit::{RustOptions, rust};
use stiffarm_codegen::robot::Robot;

const FILE: &str = "../../robots/arms/kuka_kr240.toml";

fn main() -> Result<(), Box<dyn Error>> {
    println!("cargo::rerun-if-changed={FILE}");
    let (robot, _) = Robot::from_toml(&std::fs::read_to_string(FILE)?, FILE)?;
    let options = RustOptions { kernels: "::stiffarm_kernels".to_owned(), fused: false };
    let target = Path::new(&std::env::var("OUT_DIR")?).join("kuka_kr240.rs");
    Ok(std::fs::write(target, rust(&robot, &options))?)
}
