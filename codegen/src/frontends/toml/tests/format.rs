//! What the format can say.

use num_rational::Ratio;

use super::*;
use crate::robot::{Angle, Convention, Frame, Motion, Quantity};

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
    for (list, told) in [
        ("[]", "1:11 an array of no outputs | leave `outputs` out for all of them"),
        ("\"pose\"", "1:11 a string stands where an array of outputs is expected"),
        ("[1]", "1:12 a number stands where a string is expected"),
    ] {
        assert_eq!(errors(&file(list)), [told]);
    }
    let misspelt = errors(&file("[\"pose\", \"jacobain\"]"));
    assert_eq!(misspelt, ["1:20 `jacobain` is no output | did you mean `jacobian`?"]);
}

#[test]
fn frames_are_on_joints_and_outputs_are_asked_for_at_them() {
    let frame = |joint: &str| {
        format!("[[frame]]\nname = \"elbow\"\njoint = {joint}\ntranslation = [\"50 mm\", 0, 0]\n")
    };
    let file =
        |list: &str| format!("outputs = {list}\n{HEAD}{JOINT}name = \"pan\"\n{}", frame("1"));
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
    let refused = |joint: &str| errors(&format!("{HEAD}{JOINT}name = \"pan\"\n{}", frame(joint)));
    let known = "is no joint of this arm";
    assert_eq!(
        refused("2"),
        [format!("8:9 joint 2 {known} | its joints are 1 to 1, or their names")]
    );
    assert_eq!(refused("-1"), [format!("8:9 `-1` {known} | known here: pan")]);
    assert_eq!(refused("\"pam\""), [format!("8:9 `pam` {known} | did you mean `pan`?")]);
    assert_eq!(
        errors(&file("[\"pose at elbwo\"]")),
        ["1:12 `elbwo` is no frame of this robot | did you mean `elbow`?"]
    );
}

#[test]
fn a_rounded_angle_is_a_warning() {
    let text = format!("{HEAD}{JOINT}alpha = 1.5708\n[tool]\nrotation = [0, 0, -1.570796327]\n");
    let (robot, warnings) = Robot::from_toml(&text, "arm.toml").unwrap();
    assert_eq!(robot.joints[0].alpha, Angle::Radians(Number::from_decimal("1.5708").unwrap()));
    let shown: Vec<_> =
        warnings.iter().map(|w| format!("{}:{} {}", w.line, w.column, w.message)).collect();
    assert_eq!(
        shown,
        [
            "5:9 1.5708 looks like a rounded pi/2: write pi/2",
            "7:19 -1.570796327 looks like a rounded -pi/2: write -pi/2"
        ]
    );
    // A limit may be rounded; degrees without their unit are doubted there too.
    read(&format!("{HEAD}{JOINT}limits = [-3.1416, 3.1416]\n"));
    let degrees = format!("{HEAD}{JOINT}limits = [-180, 180]\n");
    let (_, warnings) = Robot::from_toml(&degrees, "arm.toml").unwrap();
    assert_eq!(warnings[0].message, "-180 radians is 28.6 turns: for degrees write -180 deg");
    assert_eq!(warnings.len(), 1);
    let exact = read(&format!("{HEAD}{JOINT}alpha = 1.5707963267948966\n"));
    assert_eq!(exact.joints[0].alpha, Angle::Pi(Ratio::new(1, 2)));
}

/// Degrees, millimetres, a key that is misspelt in each row: one habit is told once, where it first stands.
#[test]
fn a_habit_is_told_once() {
    let warned = |rows: &str| {
        let (_, warnings) = Robot::from_toml(&format!("{HEAD}{rows}"), "arm.toml").unwrap();
        let shown = warnings.iter().map(|w| {
            format!("{}:{} {} | {}", w.line, w.column, w.message, w.help.as_deref().unwrap_or(""))
        });
        shown.collect::<Vec<_>>()
    };
    let row = format!("{JOINT}alpha = 90\nlimits = [-180, 180]\n");
    assert_eq!(
        warned(&row.repeat(3)),
        [
            "5:9 90 radians is 14.3 turns: for degrees write 90 deg | if radians are meant, write 90 rad; \
             the same stands in lines 6, 9, 10, 13 and 14"
        ]
    );
    let row = format!("{JOINT}a = 350\nd = \"0.5 m\"\ncom = [100, 0, 0]\nmass = 3\n");
    assert_eq!(
        warned(&row.repeat(2)),
        [
            "5:5 the lengths of this arm add up to 900 m, more than any has: for millimetres write 350 mm | \
             a length without a unit is in metres; if these are, write 350 m"
        ]
    );
    assert_eq!(warned(&format!("{JOINT}a = \"350 m\"\nd = -60\n")), [""; 0]);
    assert_eq!(
        errors(&format!("{HEAD}{}", format!("{JOINT}alhpa = 0\n").repeat(2))),
        ["5:1 unknown key `alhpa` in [[joint]] | did you mean `alpha`?; the same stands in line 8"]
    );
    assert_eq!(
        errors(&format!("{HEAD}{JOINT}d = -1e308\na = \"1e60 mm\"\n")),
        [
            "5:5 `-1e308` is longer than any arm | mend the exponent",
            "6:5 `1e60 mm` is longer than any arm | mend the exponent"
        ]
    );
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
    let message = |section: &str| {
        let found = refused(&beam(section)).errors;
        assert_eq!(found.len(), 1, "{found:?}");
        found[0].message.clone()
    };
    assert_eq!(
        message("{ shape = \"tube\", outer_diameter = 0.1, inner_diameter = 0.2 }"),
        "a tube of outer diameter 0.1 m and inner diameter 0.2 m: the outer one must be above the \
         inner one, and neither below zero"
    );
    assert_eq!(
        message("{ shape = \"box\", outer = [0.1, 0.1], inner = [0.05, 0.2] }"),
        "a box's sides must be above zero, and each inner side below its outer side"
    );
    assert_eq!(message("{ shape = \"tube\" }"), "`outer_diameter` is missing in a tube's section");
    assert_eq!(message("{ shape = \"box\" }"), "`outer` is missing in a box's section");
    assert_eq!(
        message("{ shape = \"tube\", outer_diameter = \"D\" }"),
        "`D` stands where a number is expected"
    );
    assert_eq!(message("{ shape = \"beam\" }"), "`beam` stands where one of tube, box is expected");
    assert_eq!(
        message("{ shpae = \"tube\", area = 1, iy = 1, iz = 1, j = 1 }"),
        "unknown key `shpae` in section"
    );
    assert_eq!(message("{ area = 1, iy = 1, iz = 1 }"), "`j` is missing in section");
    assert_eq!(message("3"), "a number stands where the table section is expected");
    assert_eq!(
        message("{ shape = \"box\", outer = [0.1] }"),
        "an array of 1 where [b, h] (along the beam's y, along its z) is expected"
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
