//! What is imported against the URDF itself, evaluated by plain 4×4 matrices that share nothing
//! with the import, and the weights by virtual work.

use core::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};
use core::fmt::Write as _;

use proptest::prelude::*;
use stiffarm::kernels::generic::Arm;
use stiffarm_codegen::robot::Robot;
use stiffarm_codegen::robot::urdf::{Chain, Frame, Refusal, Row, Table, read, robot_file};

type Matrix = [[f64; 4]; 4];

fn product(a: &Matrix, b: &Matrix) -> Matrix {
    let cell = |r: usize, c: usize| (0..4).map(|k| a[r][k] * b[k][c]).sum();
    core::array::from_fn(|r| core::array::from_fn(|c| cell(r, c)))
}

/// Rodrigues' formula.
fn turn(axis: [f64; 3], angle: f64) -> Matrix {
    let length = axis.iter().map(|x| x * x).sum::<f64>().sqrt();
    let [x, y, z] = axis.map(|a| a / length);
    let (s, c) = angle.sin_cos();
    let v = 1.0 - c;
    [
        [c + x * x * v, x * y * v - z * s, x * z * v + y * s, 0.0],
        [y * x * v + z * s, c + y * y * v, y * z * v - x * s, 0.0],
        [z * x * v - y * s, z * y * v + x * s, c + z * z * v, 0.0],
        [0.0, 0.0, 0.0, 1.0],
    ]
}

fn shift([x, y, z]: [f64; 3]) -> Matrix {
    [[1.0, 0.0, 0.0, x], [0.0, 1.0, 0.0, y], [0.0, 0.0, 1.0, z], [0.0, 0.0, 0.0, 1.0]]
}

/// One joint of a random chain.
#[derive(Clone, Debug)]
struct Joint {
    kind: &'static str,
    xyz: [f64; 3],
    rpy: [f64; 3],
    axis: [f64; 3],
    mass: f64,
    com: [f64; 3],
}

impl Joint {
    fn origin(&self) -> Matrix {
        let [r, p, y] = self.rpy;
        let turns = [turn([0.0, 0.0, 1.0], y), turn([0.0, 1.0, 0.0], p), turn([1.0, 0.0, 0.0], r)];
        turns.iter().fold(shift(self.xyz), |whole, next| product(&whole, next))
    }

    fn moves(&self) -> bool {
        self.kind != "fixed"
    }

    fn moved(&self, q: f64) -> Matrix {
        let length = self.axis.iter().map(|x| x * x).sum::<f64>().sqrt();
        match self.kind {
            "prismatic" => shift(self.axis.map(|a| q * a / length)),
            "fixed" => shift([0.0; 3]),
            _ => turn(self.axis, q),
        }
    }
}

fn urdf(joints: &[Joint]) -> String {
    let mut text = "<robot name=\"random\">\n<link name=\"l0\"/>\n".to_owned();
    for (k, joint) in joints.iter().enumerate() {
        let words = |v: [f64; 3]| v.map(|x| format!("{x:?}")).join(" ");
        let (parent, child) = (format!("l{k}"), format!("l{}", k + 1));
        let Joint { kind, xyz, rpy, axis, mass, com } = joint;
        writeln!(
            text,
            "<link name=\"{child}\"><inertial><origin xyz=\"{}\"/><mass value=\"{mass:?}\"/>\
             <inertia ixx=\"1\" ixy=\"0\" ixz=\"0\" iyy=\"1\" iyz=\"0\" izz=\"1\"/></inertial>\
             </link>\n<joint name=\"j{k}\" type=\"{kind}\"><origin xyz=\"{}\" rpy=\"{}\"/>\
             <parent link=\"{parent}\"/><child link=\"{child}\"/><axis xyz=\"{}\"/>\
             <limit lower=\"-1.5\" upper=\"1.25\" effort=\"1\" velocity=\"1\"/></joint>",
            words(*com),
            words(*xyz),
            words(*rpy),
            words(*axis),
        )
        .unwrap();
    }
    text + "</robot>\n"
}

/// By way of the text of the robot file, as a user has it.
fn imported(text: &str) -> (Chain, Table, Robot, Arm) {
    let urdf = read(text, false).unwrap();
    let chain = Chain::new(&urdf.robot, None, None).unwrap();
    let table = Table::new(&chain);
    let toml = robot_file(&chain, &table).to_toml();
    let (robot, warnings) = Robot::from_toml(&toml, "imported").unwrap();
    assert!(warnings.is_empty(), "{toml}");
    let arm = stiffarm_gap::robot::arm(&robot).unwrap();
    (chain, table, robot, arm)
}

/// The tip in the base frame by the URDF, and its links' potential energy over g.
fn by_hand(joints: &[Joint], q: &[f64]) -> (Matrix, f64) {
    let mut values = q.iter();
    let mut frame = shift([0.0; 3]);
    let (mut height, mut moving) = (0.0, false);
    for joint in joints {
        frame = product(&frame, &joint.origin());
        if joint.moves() {
            frame = product(&frame, &joint.moved(*values.next().unwrap()));
            moving = true;
        }
        if moving {
            height += joint.mass * product(&frame, &shift(joint.com))[2][3];
        }
    }
    (frame, height)
}

fn worst(arm: &Arm, joints: &[Joint], q: &[f64]) -> f64 {
    let ours = arm.pose(q).to_homogeneous();
    let ours: Matrix = core::array::from_fn(|r| core::array::from_fn(|c| ours[(r, c)]));
    let (theirs, _) = by_hand(joints, q);
    let off = |r: usize, c: usize| (ours[r][c] - theirs[r][c]).abs();
    (0..4).flat_map(|r| (0..4).map(move |c| off(r, c))).fold(0.0, f64::max)
}

/// Right angles as files have them, with all digits and rounded.
#[allow(clippy::approx_constant, reason = "roundings are what is read")]
const RIGHT: [f64; 5] = [0.0, 1.570796326794897, -1.5708, 3.14159, 0.785398];

/// The multiple of π that one of them stands for.
fn meant(x: f64) -> f64 {
    let near = |multiple: &f64| RIGHT.contains(&x) && (x - multiple).abs() < 1e-5;
    [0.0, FRAC_PI_2, -FRAC_PI_2, PI, FRAC_PI_4].into_iter().find(near).unwrap_or(x)
}

/// How a joint is placed: each of the special cases that a table has trouble with.
fn joint() -> impl Strategy<Value = Joint> {
    let any = -1.0..1.0_f64;
    let free = [any.clone(), any.clone(), any.clone()];
    let right = prop::sample::select(RIGHT.to_vec());
    let rpy = prop_oneof![
        3 => free.clone().prop_map(|v: [f64; 3]| v.map(|x| 3.0 * x)),
        3 => [right.clone(), right.clone(), right],
        2 => Just([0.0; 3]),
    ];
    let xyz = prop_oneof![
        3 => free.clone(),
        2 => Just([0.0; 3]),
        2 => any.clone().prop_map(|x| [0.0, 0.0, x]),
        2 => any.clone().prop_map(|x| [x, 0.0, 0.0]),
    ];
    let axis = prop_oneof![
        2 => free.clone().prop_filter("a direction", |v| v.iter().any(|x| x.abs() > 0.2)),
        2 => Just([0.0, 0.0, 1.0]),
        1 => Just([0.0, 0.0, -1.0]),
        1 => Just([0.0, 1.0, 0.0]),
        1 => Just([1.0, 0.0, 0.0]),
    ];
    let kinds = vec!["revolute", "revolute", "continuous", "prismatic", "fixed"];
    (prop::sample::select(kinds), xyz, rpy, axis, 0.0..10.0_f64, free)
        .prop_map(|(kind, xyz, rpy, axis, mass, com)| Joint { kind, xyz, rpy, axis, mass, com })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    /// Rounded angles are read as multiples of π by both sides.
    #[test]
    fn any_chain_stands_where_the_urdf_says(
        mut joints in prop::collection::vec(joint(), 1..9),
        seeds in prop::collection::vec(-1.5..1.25_f64, 9),
    ) {
        prop_assume!(joints.iter().any(Joint::moves));
        let text = urdf(&joints);
        let (_, table, robot, arm) = imported(&text);
        for joint in &mut joints {
            joint.rpy = joint.rpy.map(meant);
        }
        // No normal is farther away than twice the arm is long, of at most sixteen joints of 1.8 m.
        prop_assert!(table.rows.iter().all(|row| row.d.abs() < 120.0 && row.a.abs() < 120.0));
        let far = table.rows.iter().map(|row| row.d.abs() + row.a.abs()).sum::<f64>();
        let n = arm.dof();
        prop_assert_eq!(robot.dof(), joints.iter().filter(|j| j.moves()).count());
        for k in 0..4 {
            let q: Vec<f64> = (0..n).map(|j| seeds[(j + k) % 9]).collect();
            let off = worst(&arm, &joints, &q);
            prop_assert!(off <= 3e-14 * n as f64 * (1.0 + far) + 1e-11, "{} {}", off, far);
            // The weights' torques are the slopes of their energy.
            let torque = arm.weight_torque(&q);
            for j in 0..n {
                let h = 1e-5;
                let at = |side: f64| {
                    let mut q = q.clone();
                    q[j] += side * h;
                    -9.80665 * by_hand(&joints, &q).1
                };
                let slope = (at(1.0) - at(-1.0)) / (2.0 * h);
                let off = (torque[j] - slope).abs();
                prop_assert!(off < 1e-5 * (1.0 + far), "{} {}", torque[j], slope);
            }
        }
    }
}

/// A planar elbow: everything about it is known.
fn elbow(first: &str) -> String {
    format!(
        r#"<robot name="elbow"><link name="base"/><link name="upper"/><link name="fore"/>
        <link name="hand"/>
        <joint name="shoulder" type="revolute"><origin {first}/><parent link="base"/>
        <child link="upper"/><axis xyz="0 0 1"/>
        <limit lower="-3.14159" upper="1.5" effort="1" velocity="1"/></joint>
        <joint name="elbow" type="continuous"><origin xyz="0.5 0 0"/><parent link="upper"/>
        <child link="fore"/><axis xyz="0 0 1"/></joint>
        <joint name="wrist" type="fixed"><origin xyz="0.4 0 0" rpy="0 1.5708 0"/>
        <parent link="fore"/><child link="hand"/></joint></robot>"#
    )
}

#[test]
fn a_simple_arm_has_a_simple_table() {
    let (_, table, robot, _) = imported(&elbow(r#"xyz="0 0 0.3" rpy="0 0 0""#));
    assert_eq!(table.base, Frame::IDENTITY);
    let text = robot.to_toml();
    for line in ["d = 0.3", "a = 0.5", "rotation = [0.0, \"pi/2\", 0.0]", "limits = [\"-pi\", 1.5]"]
    {
        assert!(text.contains(line), "no `{line}` in\n{text}");
    }
    assert_eq!(robot.joints[1].limits, None);
    assert!(text.contains("translation = [0.4, 0.0, 0.0]"), "{text}");
}

#[test]
fn what_the_first_row_cannot_hold_is_the_base() {
    let (_, table, _, arm) = imported(&elbow(r#"xyz="0 0.2 0.3" rpy="0 1.0 0""#));
    // The point of the axis that is nearest to the origin, and the axis itself.
    let [s, c] = [1_f64.sin(), 1_f64.cos()];
    let foot = [-0.3 * c * s, 0.2, 0.3 - 0.3 * c * c];
    let near = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-15);
    assert!(near(table.base.origin, foot), "{:?}", table.base);
    assert!(near(table.base.axes[2], [s, 0.0, c]), "{:?}", table.base);
    assert!((arm.base.translation.x - foot[0]).abs() < 1e-12);
    assert_eq!(table.rows[0], Row { d: table.rows[0].d, ..Row::default() });
}

/// An arm whose shoulder, elbow and wrist are parallel but for what calibration found: its table is the
/// nominal one but for that.
#[test]
fn axes_that_are_parallel_but_for_an_error_have_beta() {
    let joint = |xyz: [f64; 3], rpy: [f64; 3]| Joint {
        kind: "revolute",
        xyz,
        rpy,
        axis: [0.0, 0.0, 1.0],
        mass: 1.0,
        com: [0.1, 0.0, 0.0],
    };
    let joints = [
        joint([1e-4, 2e-4, 0.3], [3e-4, -2e-4, 0.1]),
        joint([0.1, 0.0, 0.0], [FRAC_PI_2, 2e-4, 0.0]),
        joint([0.6, 1e-4, 0.0], [-3e-4, 2e-4, 1e-3]),
        joint([0.5, 0.0, 0.1], [1e-4, -3e-4, 0.0]),
        joint([0.1, 0.0, 0.0], [PI + 2e-4, 1e-4, 0.0]),
    ];
    let (_, table, robot, arm) = imported(&urdf(&joints));
    for row in &table.rows {
        assert!(row.d.abs() < 0.35 && row.theta.abs() < 0.2, "{:?}", table.rows);
    }
    assert!(table.rows[2].beta != 0.0 && table.rows[3].beta != 0.0, "{:?}", table.rows);
    assert!(robot.to_toml().contains("[base]") && robot.to_toml().contains("beta = "));
    for k in 0..4 {
        let q: Vec<f64> = (0..5).map(|j| (0.7 * f64::from(k) + f64::from(j)).sin()).collect();
        assert!(worst(&arm, &joints, &q) < 1e-11);
    }
}

fn refusal(text: &str, base: Option<&str>, tip: Option<&str>) -> Refusal {
    match read(text, false) {
        Err(refusal) => refusal,
        Ok(urdf) => Chain::new(&urdf.robot, base, tip).unwrap_err(),
    }
}

#[test]
fn what_is_no_serial_chain_is_refused() {
    let good = elbow("");
    let cases = [
        (good.replace("continuous", "floating"), "joint `elbow` is floating"),
        (good.replace("continuous", "planar"), "joint `elbow` is planar"),
        (
            good.replace("<axis xyz=\"0 0 1\"/></joint>", "<mimic joint=\"shoulder\"/></joint>"),
            "joint `elbow` follows joint `shoulder`",
        ),
        (good.replace("xyz=\"0.5 0 0\"", "xyz=\"0.5 zero 0 0\""), "found `0.5 zero 0 0`"),
        (good.replace("xyz=\"0.5 0 0\"", "xyz=\"0.5 nan 0\""), "found `0.5 nan 0`"),
        (good.replace("axis xyz=\"0 0 1\"", "axis xyz=\"0 0 0\""), "has no direction"),
        (good.replace("child link=\"fore\"", "child link=\"four\""), "its child is `four`"),
        (good.replace("link name=\"fore\"", "link name=\"hand\""), "two links are called `hand`"),
        (good.replace("name=\"elbow\"", "name=\"wrist\""), "two joints are called `wrist`"),
        (good.replace("</robot>", ""), "this is no XML"),
        (good.replace("type=\"continuous\"", "type=\"turning\""), "this is no URDF"),
        ("<sdf/>".to_owned(), "found the element <sdf>"),
        (good.replace("rpy=\"0 1.5708 0\"", "quat_xyzw=\"0 0 0 1\""), "found quat_xyzw"),
        (
            good.replace("<link name=\"base\"/>", "<link name=\"base\"/><link name=\"b\"/>"),
            "2 root",
        ),
        (
            good.replace(
                "</robot>",
                "<joint name=\"back\" type=\"fixed\"><parent link=\"hand\"/>\
                                      <child link=\"base\"/></joint></robot>",
            ),
            "closes a loop",
        ),
    ];
    for (text, expected) in cases {
        let found = refusal(&text, None, None).message;
        assert!(found.contains(expected), "no `{expected}` in `{found}`");
    }
    let found = refusal(&good, Some("fore"), None).message;
    assert!(found.contains("nothing moves between link `fore` and link `hand`"), "{found}");
    let found = refusal(&good, Some("hand"), Some("upper")).message;
    assert!(found.contains("link `upper` does not hang on link `hand`"), "{found}");
    let found = refusal(&good, None, Some("finger"));
    assert!(found.help.unwrap().contains("base, upper, fore, hand"));
}

#[test]
fn branches_need_a_tip() {
    let branched = elbow("").replace(
        "</robot>",
        "<link name=\"camera\"/><joint name=\"mount\" type=\"fixed\"><parent link=\"upper\"/>\
         <child link=\"camera\"/></joint></robot>",
    );
    let found = refusal(&branched, None, None);
    assert!(found.help.unwrap().ends_with("--tip: hand (2 moving), camera (1 moving)"));
    let urdf = read(&branched, false).unwrap();
    assert_eq!(Chain::new(&urdf.robot, None, Some("camera")).unwrap().steps.len(), 1);
}

#[test]
fn gravity_is_down_in_the_root() {
    let hung = elbow("").replace(
        "<link name=\"base\"/>",
        "<link name=\"ceiling\"/><joint name=\"hang\" type=\"fixed\"><origin rpy=\"3.14159 0 0\"/>\
         <parent link=\"ceiling\"/><child link=\"base\"/></joint><link name=\"base\"/>",
    );
    let urdf = read(&hung, false).unwrap();
    let chain = Chain::new(&urdf.robot, Some("base"), None).unwrap();
    assert_eq!(chain.gravity[2], 9.80665);
    let whole = Chain::new(&urdf.robot, None, None).unwrap();
    assert_eq!(whole.gravity[2], -9.80665);
}
