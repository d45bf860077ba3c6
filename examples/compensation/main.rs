//! From a tracker's file to a loop that compensates: the robot file that `stiffarm diagnose` wrote, compiled, commands
//! the arm that was measured. README has the commands.
//!
//! ```text
//! cargo run -p stiffarm --example compensation
//! ```
//!
//! The arm is a KUKA KR 240-2 with 150 kg on its tool. What it really does is known here, for it is simulated, and the
//! loop does not see it: joint 3 is softer than the file says, the gear of joint 2 errs, joint 6 turns with joint 5,
//! joint 1 has play.

use nalgebra::{Vector3, Vector6};
use stiffarm::kernels::{Pose, SetPoints, Unstable};
use stiffarm_gap::effects::{Catalogue, Known};
use stiffarm_gap::whole::{Situation, Whole};

stiffarm::robot! {
    /// As its maker has it.
    pub mod nominal from "docs/workbench/arm.toml";
    outputs: pose, jacobian, deflection_with_gravity, inverse_kinematics;
}
stiffarm::robot! {
    /// As a tracker has seen it: what `diagnose --write-robot` wrote.
    pub mod better from "examples/compensation/better.toml";
    outputs: pose, jacobian, deflection_with_gravity, inverse_kinematics;
}

/// What the arm does, told to nobody.
const TRUTH: &str = r#"
[[effect]]
id = "transmission_error"
place = "joint 2"
order = 1
cos = "0.25 mrad"
sin = "0.1 mrad"
[[effect]]
id = "joint_coupling"
place = "joint 6"
joint = 5
ratio = "800 ppm"
[[effect]]
id = "joint_compliance"
place = "joint 3"
compliance = "0.2 urad/Nm"
[[effect]]
id = "backlash"
place = "joint 1"
width = "0.4 mrad"
"#;

/// 150 kg at the tool, N.
const LOAD: [f64; 6] = [0.0, 0.0, -1471.0, 0.0, 0.0, 0.0];
/// Every joint comes from below.
const SIDES: [i8; 6] = [1; 6];

/// The set-point for a target, of those near where the path is: one call of the arm.
fn commanded<A: SetPoints<6, 8, f64>>(arm: &A, near: &[f64; 6], target: &Pose<f64>) -> [f64; 6] {
    arm.set_point(target, near, &LOAD, (1e-9, 1e-9)).expect("the path is in reach").q
}

fn main() -> Result<(), Unstable> {
    let file = include_str!("../../docs/workbench/arm.toml").to_owned() + TRUTH;
    let (file, _) =
        stiffarm_codegen::robot::Robot::from_toml(&file, "arm.toml").expect("a robot file");
    let table = stiffarm_gap::robot::arm(&file).expect("a table of numbers");
    let known = Known::all(&file, &table, &Catalogue::default()).expect("effects of the catalogue");
    let real = Whole { arm: &table, known: &known };
    let at = Situation { direction: Some(SIDES.to_vec()), ..Situation::under(Vector6::from(LOAD)) };

    let better = better::Robot { sides: SIDES.map(f64::from) };
    let (mut before, mut after): (f64, f64) = (0.0, 0.0);
    for k in 0..24 {
        let turn = f64::from(k) * core::f64::consts::TAU / 24.0;
        let on_path = [
            0.5 * turn.sin(),
            1.1 + 0.2 * turn.cos(),
            -1.3,
            0.4,
            0.9 + 0.3 * turn.sin(),
            -0.6 * turn.cos(),
        ];
        let target = nominal::pose(&on_path);
        let goal = Vector3::from(target.position);
        let miss = |q: [f64; 6]| {
            let (state, _) = real.at(&q, &at)?;
            Ok((state.tool.translation.vector - goal).norm())
        };
        before = before.max(miss(commanded(&nominal::Robot, &on_path, &target))?);
        after = after.max(miss(commanded(&better, &on_path, &target))?);
    }
    println!(
        "{}, 24 targets, at most {:.3} mm off by its maker's file, {:.3} mm by the corrected one",
        nominal::NAME,
        1e3 * before,
        1e3 * after
    );
    // What the diagnosis left of its own data is 0.035 mm, noise of 0.02 mm in each coordinate.
    assert!(before > 3e-4 && after < 3e-5, "{before} {after}");
    Ok(())
}
