//! What the equations of motion cost where a table leaves no number at zero: ten full ones for every link.

use stiffarm_codegen::derive::{Output, derive};
use stiffarm_codegen::number::Number;
use stiffarm_codegen::robot::{Robot, Value};

/// Stäubli's RX-90 as Khalil & Kleinfinger have it, modified convention: an elbow and a spherical wrist.
const RX90: &str = r#"
    name = "RX-90"
    convention = "modified"
    joint = [
        { type = "revolute" },
        { type = "revolute", alpha = "pi/2" },
        { type = "revolute", a = 0.45 },
        { type = "revolute", alpha = "-pi/2", d = 0.45 },
        { type = "revolute", alpha = "pi/2" },
        { type = "revolute", alpha = "-pi/2" },
    ]
"#;

/// The table with a body for every link, of which no number is zero or another's.
fn with_bodies(text: &str) -> Robot {
    let (mut robot, _) = Robot::from_toml(text, "arm.toml").expect("a sound table");
    let mut next = 0;
    let mut number = |scale: i128| {
        next += 1;
        // A prime in the denominator: no sum of them is zero by chance.
        Value::Number(Number::ratio(scale * (37 + next * next % 101), 10_007))
    };
    for joint in &mut robot.joints {
        joint.mass = Some(number(900));
        joint.com = [20, -30, 10].map(&mut number);
        let [x, y, z] = [100, 120, 90].map(&mut number);
        let [xy, xz, yz] = [7, -5, 11].map(&mut number);
        joint.inertia = Some([x, xy, xz, y, yz, z]);
    }
    robot
}

#[test]
fn full_bodies_cost_so_many_operations() {
    let ur10 = include_str!("../../robots/arms/ur10.toml");
    let kr240 = include_str!("../../robots/arms/kuka_kr240.toml");
    let panda = include_str!("../../robots/arms/panda.toml");
    for (name, text, expected) in
        [("UR10", ur10, 479), ("KR 240-2", kr240, 493), ("RX-90", RX90, 462), ("Panda", panda, 576)]
    {
        let ops = derive(&with_bodies(text), &[Output::InverseDynamics]).ops();
        assert_eq!((ops.flops(), ops.div), (expected, 0), "{name}: {ops:?}");
    }
}
