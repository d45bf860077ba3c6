//! Writes the pose of a KUKA KR 240-2 to `OUT_DIR`, with functions of its own.

use stiffarm_codegen::emit::RustOptions;
use stiffarm_codegen::robot::Output;
use stiffarm_codegen::{BuildError, read_robot};

mod module;

fn main() -> Result<(), BuildError> {
    println!("cargo::rerun-if-changed=module.rs");
    println!("cargo::rerun-if-changed=formulas.rs");
    let mut robot = read_robot("../../robots/arms/kuka_kr240.toml")?;
    robot.outputs = vec![Output::Pose];
    let options = RustOptions { kernels: "::stiffarm_kernels".to_owned(), fused: false };
    module::of(&robot)?.to_out_dir("kr240", &options)?;
    Ok(())
}
