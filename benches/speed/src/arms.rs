//! The generated arms, plain and fused, and their tables for the textbook.

use nalgebra::{Isometry3, Matrix3, UnitQuaternion, Vector3};
use stiffarm_codegen::robot::{self, Robot, Value};
use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::{Arm, Drive, Joint};

pub use stiffarm_bench_arms::*;

/// The robot files, in the order of the benches.
pub const FILES: [(&str, &str); 5] = [
    ("planar_2r", include_str!("../../arms/planar_2r.toml")),
    ("ur10", include_str!("../../../robots/arms/ur10.toml")),
    ("kuka_kr240", include_str!("../../../robots/arms/kuka_kr240.toml")),
    ("iiwa14", include_str!("../../../robots/arms/iiwa14.toml")),
    ("panda", include_str!("../../../robots/arms/panda.toml")),
];

/// The textbook's arm, every joint with a spring, as the generated ones have it. Their tables have
/// turning joints and numbers only.
///
/// # Panics
/// If `id` is none of [`FILES`].
pub fn textbook(id: &str) -> Arm {
    let (id, text) = FILES.iter().find(|(known, _)| *known == id).expect("one of the arms");
    let (robot, _) = Robot::from_toml(text, id).expect("a valid file");
    let number = |value: &Value| match value {
        Value::Number(n) => n.to_f64(),
        Value::Symbol(name) => panic!("{id}: {name} has no number"),
    };
    let inertia = |joint: &robot::Joint| {
        let entries = joint.inertia.as_ref().map(|entries| entries.each_ref().map(number));
        let [xx, xy, xz, yy, yz, zz] = entries.unwrap_or_default();
        Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz)
    };
    let joint = |joint: &robot::Joint| Joint {
        motion: Motion::Revolute,
        theta: joint.theta.radians().expect("a number"),
        d: number(&joint.d),
        a: number(&joint.a),
        alpha: joint.alpha.radians().expect("a number"),
        beta: joint.beta.radians().expect("a number"),
        compliance: 1.0 / joint.stiffness.as_ref().map_or(1e5, number),
        mass: joint.mass.as_ref().map_or(0.0, number),
        com: Vector3::from(joint.com.each_ref().map(number)),
        inertia: inertia(joint),
        drive: Drive::default(),
        limits: None,
        beam: None,
    };
    Arm {
        base: Isometry3::identity(),
        name: robot.name.clone(),
        convention: robot.convention,
        joints: robot.joints.iter().map(joint).collect(),
        tool: Isometry3::from_parts(
            Vector3::from(robot.tool.translation.each_ref().map(number)).into(),
            UnitQuaternion::identity(),
        ),
        tool_rotation_vector: Vector3::zeros(),
        gravity: Vector3::from(robot.gravity.each_ref().map(number)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use stiffarm_draws::Draws;
    use stiffarm_kernels::Kernels;

    fn check(id: &str, kernels: [&dyn Kernels<f64>; 2]) {
        let arm = textbook(id);
        let mut draws = Draws::new(2);
        for (q, w) in draws.postures::<21>(100).iter().zip(draws.loads(100)) {
            for &output in kernels[0].outputs() {
                let q = &q[..output.state(arm.dof())];
                let expected = arm.evaluate(output, q, &w).expect("the arm is stable");
                let scale = expected.iter().fold(1e-6f64, |m, x| m.max(x.abs()));
                for kernels in kernels {
                    let mut got = vec![0.0; expected.len()];
                    kernels.evaluate(output, q, &w, &mut got).expect("the arm is stable");
                    for (a, b) in got.iter().zip(&expected) {
                        assert!((a - b).abs() <= 1e-12 * scale, "{id} {}: {a} {b}", output.name());
                    }
                }
            }
        }
    }

    #[test]
    fn both_texts_agree_with_the_textbook() {
        check("planar_2r", [&planar_2r::plain::Robot, &planar_2r::fused::Robot]);
        check("ur10", [&ur10::plain::Robot, &ur10::fused::Robot]);
        check("kuka_kr240", [&kuka_kr240::plain::Robot, &kuka_kr240::fused::Robot]);
        check("iiwa14", [&iiwa14::plain::Robot, &iiwa14::fused::Robot]);
        check("panda", [&panda::plain::Robot, &panda::fused::Robot]);
    }
}
