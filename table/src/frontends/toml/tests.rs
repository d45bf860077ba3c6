//! What the format can say; what is refused, `tests/text/mistakes.rs` shows.

use num_rational::Ratio;

use crate::number::Number;
use crate::robot::{Angle, Convention, Frame, Motion, Output, Quantity, Robot, Value};

const HEAD: &str = "name = \"arm\"\nconvention = \"standard\"\n";
const JOINT: &str = "[[joint]]\ntype = \"revolute\"\n";

fn number(text: &str) -> Value {
    Value::Number(Number::from_decimal(text).unwrap())
}

fn read(text: &str) -> Robot {
    let (robot, warnings) = Robot::from_toml(text, "arm.toml").unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(warnings, []);
    robot
}

#[test]
fn the_whole_format_is_read() {
    let robot = read(
        r#"
        name = "KUKA KR 240-2"
        convention = "modified"
        gravity = [0.0, "g", -9.80665]

        [[joint]]
        type = "revolute"
        theta = 0.0
        d = 0.0
        a = "24 in"
        alpha = "-pi/2"
        stiffness = 3.8e6
        mass = "120 kg"
        com = [0.3, 0, "100 mm"]
        limits = ["-150 deg", 2.6]
        source = "Dumas et al. 2011, Table 2"

        [joint.beam]
        youngs_modulus = "69 GPa"
        shear_modulus = 26e9
        section = { shape = "tube", outer_diameter = 0.2, inner_diameter = "180 mm" }
        density = 2700.0
        shear_coefficient = 0.53

        [[joint]]
        type = "prismatic"
        d = "300 mm"
        stiffness = "k2"
        limits = [0, "1 m"]

        [joint.beam]
        youngs_modulus = "E2"
        shear_modulus = "G2"
        section = { area = "A2", iy = "5.2e6 mm^4", iz = "I2", j = 1e-6 }

        [tool]
        translation = [0.0, "t", 0.1]
        rotation = [0.0, 0.0, "90°"]

        [[marker]]
        name = "smr1"
        translation = [0.0, 0.1, "20 mm"]

        [[marker]]
        name = "smr2"
        "#,
    );
    assert_eq!((robot.name.as_str(), robot.convention), ("KUKA KR 240-2", Convention::Modified));
    assert_eq!(robot.gravity, [Value::ZERO, Value::Symbol("g".into()), number("-9.80665")]);
    let first = &robot.joints[0];
    assert_eq!((first.name.as_str(), first.motion), ("joint 1", Motion::Revolute));
    assert_eq!(first.a, number("0.6096"));
    assert_eq!(first.alpha, Angle::Pi(Ratio::new(-1, 2)));
    assert_eq!(first.stiffness, Some(number("3.8e6")));
    assert_eq!(first.mass, Some(number("120")));
    assert_eq!(first.com, [number("0.3"), Value::ZERO, number("0.1")]);
    assert_eq!(first.limits, Some([-150_f64.to_radians(), 2.6]));
    assert_eq!(first.source.as_deref(), Some("Dumas et al. 2011, Table 2"));
    let beam = first.beam.as_ref().unwrap();
    assert_eq!(beam.youngs_modulus, number("69e9"));
    assert_eq!(beam.density, Some(number("2700")));
    assert_eq!(beam.shear_coefficient, Some(number("0.53")));
    let second = &robot.joints[1];
    assert_eq!((second.motion, second.d.clone()), (Motion::Prismatic, number("0.3")));
    assert_eq!(second.limits, Some([0.0, 1.0]));
    assert_eq!(second.beam.as_ref().unwrap().section.iy, number("5.2e-6"));
    assert_eq!(robot.tool.rotation[2], Angle::Pi(Ratio::new(1, 2)));
    assert_eq!(robot.markers[0].translation.as_ref().unwrap()[2], number("0.02"));
    assert_eq!(robot.markers[1].translation, None);
    let symbols: Vec<_> = robot.symbols().into_iter().map(|s| s.name).collect();
    assert_eq!(symbols, ["g", "k2", "E2", "G2", "A2", "I2", "t"]);
    // The tube's constants are rounded doubles, which read back as the decimals that print them.
    let again = read(&robot.to_toml());
    assert_eq!((again.to_toml(), again.symbols()), (robot.to_toml(), robot.symbols()));
    assert_eq!(again.joints[1], robot.joints[1]);
    let area = |robot: &Robot| robot.joints[0].beam.as_ref()?.section.area.number();
    assert_eq!(area(&again).map(Number::to_f64), area(&robot).map(Number::to_f64));
}

#[test]
fn defaults() {
    let robot = read(&format!("{HEAD}{JOINT}"));
    let joint = &robot.joints[0];
    assert!(joint.theta.is_zero() && joint.alpha.is_zero());
    assert!(joint.d.is_zero() && joint.a.is_zero());
    assert_eq!((&joint.stiffness, &joint.mass, &joint.limits), (&None, &None, &None));
    assert_eq!(robot.gravity, [Value::ZERO, Value::ZERO, number("-9.80665")]);
    assert_eq!(robot.tool, Frame::default());
}

#[test]
fn a_joint_may_say_that_it_is_rigid() {
    let robot = read(
        "name = \"R\"\nconvention = \"standard\"\n[[joint]]\ntype = \"revolute\"\nstiffness = \"rigid\"\n",
    );
    assert_eq!(robot.joints[0].stiffness, None);
    assert!(robot.symbols().is_empty());
}

/// What is generated of a table without moments of inertia where nothing is asked for.
fn at_rest() -> Vec<Output> {
    let all = Output::EACH.into_iter();
    all.filter(|output| !output.is_on_request() && !output.is_of_motion()).collect()
}

#[test]
fn outputs_are_named_once_each() {
    let file = |list: &str| format!("outputs = {list}\n{HEAD}{JOINT}");
    let robot = read(&file("[\"jacobian\", \"pose\", \"jacobian\"]"));
    assert_eq!(robot.generated(), [Output::Pose, Output::Jacobian]);
    assert!(robot.to_toml().contains("\noutputs = [\"pose\", \"jacobian\"]\n"));
    assert_eq!(read(&robot.to_toml()).generated(), robot.generated());
    let all = read(&format!("{HEAD}{JOINT}"));
    assert_eq!(all.generated(), at_rest());
    assert!(!all.to_toml().contains("outputs"));
}

#[test]
fn frames_are_on_joints_and_outputs_are_asked_for_at_them() {
    let frame = "[[frame]]\nname = \"elbow\"\njoint = 1\ntranslation = [\"50 mm\", 0, 0]\n";
    let file = |list: &str| format!("outputs = {list}\n{HEAD}{JOINT}name = \"pan\"\n{frame}");
    let robot = read(&file("[\"jacobian at elbow\", \"pose at elbow\", \"pose at elbow\"]"));
    assert_eq!((robot.frames[0].row, robot.frames[0].name.as_str()), (0, "elbow"));
    assert_eq!(robot.frames[0].frame.translation[0], number("0.05"));
    assert_eq!(robot.places(), [("elbow", vec![Output::Pose, Output::Jacobian])]);
    assert_eq!(robot.generated(), at_rest());
    assert_eq!(robot.asked(), ["pose at elbow", "jacobian at elbow"]);
    let again = read(&robot.to_toml());
    assert_eq!((&again.frames, again.places()), (&robot.frames, robot.places()));
    assert_eq!(
        read(&file("[\"pose\"]").replace("joint = 1", "joint = \"pan\"")).frames,
        robot.frames
    );
}

/// Numbers that are doubted are used as they are written.
#[test]
fn a_doubted_angle_is_kept() {
    let alpha = |cell: &str| {
        let text = format!("{HEAD}{JOINT}alpha = {cell}\n");
        Robot::from_toml(&text, "arm.toml").unwrap().0.joints[0].alpha.clone()
    };
    let radians = |text: &str| Angle::Radians(Number::from_decimal(text).unwrap());
    assert_eq!(alpha("1.5708"), radians("1.5708"));
    assert_eq!(alpha("-90"), radians("-90"));
    assert_eq!(alpha("1.5707963267948966"), Angle::Pi(Ratio::new(1, 2)));
}

#[test]
fn these_joints_are_sound() {
    let disc = "mass = 1\ninertia = [0.1, 0, 0, 0.2, 0, 0.3]";
    let rod = "mass = 1\ninertia = [0.2, 0, 0, 0.2, 0, 0]";
    let backlash = "[[effect]]\nid = \"backlash\"\nplace = \"joint 1\"\nwidth = \"0.1 mrad\"";
    for lines in [
        "mass = 0\ncom = [1, 0, 0]",
        "d = \"x\"\na = \"x\"\nmass = 1\ncom = [\"x\", 0, 0]",
        "a = \"L1\"\nd = \"d_1\"\ntheta = \"tE\"",
        "mass = 1\ninertia = [0.3, 0.01, 0, 0.4, 0, 0.2]",
        disc,
        rod,
        "d = \"d1\"\nbeam = { youngs_modulus = 1, shear_modulus = 1, section = { area = 1, iy = 1, iz = 1, j = 1 } }",
        "a = \"350 m\"\nd = -60",
        "alpha = \"90 rad\"",
        backlash,
    ] {
        let (_, warnings) = Robot::for_kernels(&format!("{HEAD}{JOINT}{lines}\n"), "arm.toml")
            .unwrap_or_else(|e| panic!("{e}"));
        assert_eq!(warnings, [], "{lines}");
    }
}

#[test]
fn sections() {
    let beam = |section: &str| {
        format!(
            "{HEAD}{JOINT}a = 1\nbeam = {{ youngs_modulus = 1, shear_modulus = 1, \
             section = {section} }}\n"
        )
    };
    let of = |section: &str| read(&beam(section)).joints[0].beam.clone().unwrap().section;
    let solid = of("{ shape = \"box\", outer = [0.2, 0.1] }");
    assert_eq!(solid.iz, Value::Number(Number::ratio(8, 120_000)));
    assert_eq!(of("{ shape = \"box\", outer = [0.2, 0.1], inner = [0, 0] }"), solid);
    let hollow = of("{ shape = \"box\", outer = [0.2, 0.1], inner = [0.19, \"90 mm\"] }");
    assert_eq!(hollow.area, number("0.0029"));
    assert_eq!(
        of("{ shape = \"tube\", outer_diameter = 1 }").area,
        Value::Number(Number::Rounded(core::f64::consts::FRAC_PI_4))
    );
}

#[test]
fn numbers_survive_writing() {
    let text = format!(
        "{HEAD}{JOINT}a = 0.123456789\nd = 1e-20\ntheta = \"37.3 deg\"\n\
         stiffness = 1e300\nmass = 69e9\nlimits = [\"-pi/2\", 1.5]\nname = \"a \\\"b\\\" é\"\n"
    );
    let robot = read(&text);
    assert_eq!(read(&robot.to_toml()), robot);
    assert_eq!(robot.joints[0].name, "a \"b\" é");
}

const BEYOND: &str = "[base]\ntranslation = [\"1 m\", -0.5, 0]\nrotation = [0, 0, \"pi/2\"]\n\
    [[effect]]\nid = \"transmission_error\"\nplace = \"joint 1\"\norder = 2\n\
    cos = \"0.10 mrad\"\nsin = -5e-5\n[[payload]]\nname = \"5kg\"\nmass = 5\ncom = [0, 0, \"60 mm\"]\n\
    inertia = [0.02, 0, 0, 0.02, 0, 0.01]\n";

#[test]
fn what_lies_beyond_the_table_is_read_and_written() {
    let robot = read(&format!("{HEAD}{JOINT}beta = \"0.1 deg\"\n{BEYOND}"));
    assert_eq!(robot.joints[0].beta.radians().unwrap(), 0.1_f64.to_radians());
    assert_eq!(robot.base.translation, [number("1"), number("-0.5"), Value::ZERO]);
    let effect = &robot.effects[0];
    assert_eq!(
        (effect.id.value.as_str(), effect.place.value.as_str()),
        ("transmission_error", "joint 1")
    );
    let numbers: Vec<_> =
        effect.numbers.iter().map(|n| (n.key.as_str(), &n.value, n.at.line)).collect();
    let text = Quantity::Text("0.10 mrad".to_owned());
    let expected =
        [("order", &Quantity::Si(2.0), 12), ("cos", &text, 13), ("sin", &Quantity::Si(-5e-5), 14)];
    assert_eq!(numbers, expected);
    assert_eq!((robot.payloads[0].name.as_str(), &robot.payloads[0].mass), ("5kg", &number("5")));
    let written = robot.to_toml();
    assert_eq!(read(&written), robot, "{written}");
    assert_eq!(read(&written).to_toml(), written);
}
