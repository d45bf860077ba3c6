//! The kernels that are timed, generated plain and fused, every joint with a spring.

use std::error::Error;
use std::path::Path;
use std::process::Command;

use stiffarm_codegen::emit::{RustOptions, rust};
use stiffarm_codegen::number::Number;
use stiffarm_codegen::robot::{Robot, Value, Wanted};

const ARMS: [&str; 5] = [
    "planar_2r.toml",
    "../../robots/arms/ur10.toml",
    "../../robots/arms/kuka_kr240.toml",
    "../../robots/arms/iiwa14.toml",
    "../../robots/arms/panda.toml",
];

/// Arms of which the inverse is timed: with a closed form, and near one.
const INVERSES: [&str; 7] = [
    "../../robots/arms/ur10.toml",
    "../../robots/arms/kuka_kr240.toml",
    "../../robots/arms/irb120.toml",
    "../../robots/arms/panda.toml",
    "../../robots/arms/iiwa14.toml",
    "../../tests/data/calibrated_ur10.toml",
    "../../tests/data/calibrated_kuka.toml",
];

fn main() -> Result<(), Box<dyn Error>> {
    let out = std::env::var("OUT_DIR")?;
    let rustc = Command::new(std::env::var("RUSTC")?).arg("--version").output()?;
    let version = String::from_utf8(rustc.stdout)?;
    println!("cargo::rustc-env=STIFFARM_RUSTC={}", version.trim());
    let read = |file: &str| -> Result<_, Box<dyn Error>> {
        println!("cargo::rerun-if-changed={file}");
        let mut robot = Robot::for_kernels(&std::fs::read_to_string(file)?, file)?.0;
        for joint in &mut robot.joints {
            joint.stiffness.get_or_insert(Value::Number(Number::integer(100_000)));
        }
        let name = Path::new(file).file_stem().unwrap_or_default().to_string_lossy();
        Ok((robot, name.into_owned()))
    };
    for file in INVERSES {
        let (mut robot, name) = read(file)?;
        for output in ["pose", "jacobian", "deflection_with_gravity", "inverse_kinematics"] {
            let wanted = Wanted::read(output).map_err(|no| no.message)?;
            robot.want(&wanted).map_err(|no| no.message)?;
        }
        let options = RustOptions { kernels: "::stiffarm_kernels".to_owned(), fused: false };
        let target = Path::new(&out).join(format!("{name}_inverse.rs"));
        std::fs::write(target, rust(&robot, &options))?;
    }
    for file in ARMS {
        let (robot, name) = read(file)?;
        for (way, fused) in [("plain", false), ("fused", true)] {
            let options = RustOptions { kernels: "::stiffarm_kernels".to_owned(), fused };
            let target = Path::new(&out).join(format!("{name}_{way}.rs"));
            std::fs::write(target, rust(&robot, &options))?;
        }
    }
    Ok(())
}
