//! Arms as they are built: every entry of the table off by up to 0.5 mm or 0.5 mrad.

use std::error::Error;

use stiffarm_codegen::emit::{RustOptions, rust};
use stiffarm_codegen::number::Number;
use stiffarm_codegen::robot::{Angle, Robot, Value, Wanted};
use stiffarm_draws::Draws;

const OFF: f64 = 5e-4;

fn main() -> Result<(), Box<dyn Error>> {
    let out = std::env::var("OUT_DIR")?;
    for name in ["kuka_kr240", "irb120", "puma560", "ur10"] {
        let file = format!("../../../robots/arms/{name}.toml");
        println!("cargo::rerun-if-changed={file}");
        let mut robot = Robot::for_kernels(&std::fs::read_to_string(&file)?, &file)?.0;
        let mut draws = Draws::new(7);
        let mut off = |at: f64| Number::rounded(at + OFF * draws.unit());
        for joint in &mut robot.joints {
            for length in [&mut joint.a, &mut joint.d] {
                *length = Value::Number(off(length.number().ok_or("a number")?.to_f64()));
            }
            for angle in [&mut joint.theta, &mut joint.alpha, &mut joint.beta] {
                *angle = Angle::Radians(off(angle.radians().ok_or("a number")?));
            }
        }
        for output in ["pose", "jacobian", "inverse_kinematics"] {
            let wanted = Wanted::read(output).map_err(|no| no.message)?;
            robot.want(&wanted).map_err(|no| no.message)?;
        }
        let options = RustOptions { kernels: "::stiffarm::kernels".to_owned(), fused: false };
        std::fs::write(format!("{out}/{name}_built.rs"), rust(&robot, &options))?;
    }
    Ok(())
}
