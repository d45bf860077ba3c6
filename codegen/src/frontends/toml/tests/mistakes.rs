//! What is refused, where, and in which words.

use super::*;

#[test]
fn missing_keys_are_named() {
    assert_eq!(
        errors(""),
        [
            "1:1 `name` is missing in a robot file | write name = \"…\"",
            "1:1 `convention` is missing in a robot file | \
             write convention = \"standard\" or \"modified\"",
            "1:1 a robot has at least one joint | write one [[joint]] table per row, base to tip"
        ]
    );
    assert_eq!(
        errors(&format!("{HEAD}[[joint]]\nd = 1\n")),
        ["3:1 `type` is missing in [[joint]] | write type = \"revolute\" or \"prismatic\""]
    );
    assert_eq!(
        joint_errors("d = 1\nbeam = {}"),
        [
            "6:8 `youngs_modulus` is missing in [joint.beam] | \
             for example youngs_modulus = \"69 GPa\"",
            "6:8 `shear_modulus` is missing in [joint.beam] | \
             for example shear_modulus = \"26 GPa\"",
            "6:8 `section` is missing in [joint.beam] | write section = { shape = \"tube\", … }, \
             { shape = \"box\", … } or { area = …, iy = …, iz = …, j = … }"
        ]
    );
    assert_eq!(
        errors(&format!("{HEAD}{JOINT}[[marker]]\n")),
        ["5:1 `name` is missing in [[marker]] | write name = \"…\""]
    );
}

#[test]
fn unknown_keys_are_one_mistake_each() {
    assert_eq!(
        errors(&format!("nmae = \"arm\"\nconvention = \"standard\"\n{JOINT}")),
        ["1:1 unknown key `nmae` in a robot file | did you mean `name`?"]
    );
    assert_eq!(
        joint_errors("Alpha = 0\ncolour = \"red\""),
        [
            "5:1 unknown key `Alpha` in [[joint]] | did you mean `alpha`?",
            "6:1 unknown key `colour` in [[joint]] | known here: type, name, theta, d, a, alpha, beta, \
             stiffness, mass, com, inertia, gear, rotor_inertia, coulomb, viscous, limits, source, beam"
        ]
    );
    assert_eq!(
        errors(&format!("{HEAD}[[joints]]\ntype = \"revolute\"\n")),
        ["3:3 unknown key `joints` in a robot file | did you mean `joint`?"]
    );
    assert_eq!(
        errors(&format!("{HEAD}{JOINT}[tool]\ntranslate = [0, 0, 0]\n")),
        ["6:1 unknown key `translate` in [tool] | did you mean `translation`?"]
    );
}

#[test]
fn wrong_kinds_of_value() {
    assert_eq!(
        joint_errors("a = true\nalpha = [1]\nsource = 3\nmass = 0x10\nd = nan\ncom = [1, 2]"),
        [
            "5:5 a truth value stands where a length (e.g. `350 mm`) is expected",
            "6:9 an array stands where an angle (e.g. `90 deg`) is expected",
            "7:10 a number stands where a string is expected",
            "8:8 a decimal number is expected here",
            "9:5 `nan` is not a finite number",
            "10:7 an array of 2 where [x, y, z] is expected",
        ]
    );
    assert_eq!(
        errors(&format!("{HEAD}joint = 3\ntool = \"x\"\nmarker = 1979-05-27\n")),
        [
            "3:9 a number stands where [[joint]] tables are expected | \
             write [[joint]] with two brackets, once for each",
            "4:8 a string stands where the table [tool] is expected",
            "5:10 a date stands where [[marker]] tables are expected | \
             write [[marker]] with two brackets, once for each"
        ]
    );
    assert_eq!(
        errors(&format!("name = 1\nconvention = \"Standard\"\n{JOINT}")),
        [
            "1:8 a number stands where a string is expected",
            "2:14 `Standard` stands where one of standard, modified is expected | \
             did you mean `standard`?"
        ]
    );
    assert_eq!(
        errors(&format!("{HEAD}[[joint]]\ntype = \"screw\"\nstiffness = \"3 kg\"\n")),
        ["4:8 `screw` stands where one of revolute, prismatic is expected | \
             known here: revolute, prismatic"]
    );
    assert_eq!(
        errors(&format!("gravity = 9.81\n{HEAD}{JOINT}beam = 3\nlimits = 1\n")),
        [
            "1:11 a number stands where [x, y, z] is expected",
            "6:8 a number stands where the table [joint.beam] is expected",
            "7:10 a number stands where [lower, upper] is expected"
        ]
    );
}

#[test]
fn a_mistake_within_a_string_has_its_own_place() {
    assert_eq!(
        joint_errors("a = \"350 furlong\"\nalpha = \"90 degs\"\nd = \"t2 + 1\"\nmass = '3 mm'"),
        [
            "5:10 unknown unit `furlong` | \
             units are written like `mm`, `deg`, `kg/m^3` or `N*m/rad`",
            "6:13 unknown unit `degs` | did you mean `deg`?",
            "7:9 `t2 + 1` is a sum: a cell holds one number or one parameter | \
             work the sum out, or take the constant into the parameter",
            "8:9 `3 mm` is a length; a mass is expected here (e.g. `120 kg`)",
        ]
    );
    assert_eq!(
        joint_errors("theta = \"t2 + pi/2\""),
        ["5:13 `t2 + pi/2` is a sum: a cell holds one number or one parameter | \
             work the sum out, or take the constant into the parameter"]
    );
}

#[test]
fn what_must_be_a_number() {
    assert_eq!(
        joint_errors(
            "limits = [\"lo\", 1]\n[tool]\nrotation = [0, 0, \"r\"]\n\
             [[marker]]\nname = \"m\"\ntranslation = [0, 0, \"z\"]"
        ),
        [
            "5:11 `lo` stands where a number is expected | joint limits are numbers",
            "7:19 `r` stands where a number is expected | a frame's rotation cannot stay symbolic",
            "10:22 `z` stands where a number is expected | \
             leave the place out where a marker's place is unknown"
        ]
    );
}

#[test]
fn what_is_no_toml() {
    assert_eq!(
        joint_errors("alpha = pi/2\na = 350 kg\na = 1"),
        [
            "5:9 `pi/2` stands without quotes | write \"pi/2\"",
            "6:5 `350 kg` stands without quotes | write \"350 kg\"",
            "6:5 `350 kg` is a mass; a length is expected here (e.g. `350 mm`)",
            "7:1 duplicate key `a`",
        ]
    );
    let broken = joint_errors("com = [1, 2\nmass = 3");
    assert_eq!(broken.len(), 1, "{broken:?}");
    assert!(broken[0].starts_with("6:1 this is no TOML: "), "{broken:?}");
}

#[test]
fn what_lies_beyond_the_table_is_pointed_at() {
    let at = |text: &str| errors(&format!("{HEAD}{JOINT}{text}"));
    assert_eq!(
        at("[[effect]]\nplace = 2\ncos = [1]\nsin = nan\n"),
        [
            "5:1 `id` is missing in [[effect]] | write id = \"backlash\", or another effect of \
             `docs/gap.md`",
            "6:9 a number stands where a string is expected | write place = \"joint 2\", \"link 3\", \
             \"base\", \"tool\", \"arm\"",
            "7:7 a number in SI units, or a string with a number and its unit, is expected | \
             the same stands in line 8",
        ]
    );
    assert_eq!(at("effect = 1\n").len(), 1);
    assert_eq!(
        at("[base]\ntranslation = [\"x\", 0, 0]\n"),
        ["6:16 `x` stands where a number is expected | where the base stands cannot stay symbolic"]
    );
    assert_eq!(
        at("[[payload]]\nname = \"a\"\nmass = -1\n[[payload]]\nname = \"a\"\n"),
        [
            "7:8 the mass is -1.0: it must not be below zero",
            "8:1 `mass` is missing in [[payload]] | write mass = 5.0",
            "9:8 two payloads are called `a`",
        ]
    );
}

#[test]
fn what_is_carried_is_there_and_told_in_numbers() {
    let load = "[[payload]]\nname = \"gripper\"\nmass = 1\n";
    let with =
        |joint: &str, load: &str| errors(&format!("carries = \"gripper\"\n{HEAD}{joint}{load}"));
    assert_eq!(
        with(JOINT, ""),
        ["1:11 `gripper` is no payload of this robot | the robot has no [[payload]]"]
    );
    assert_eq!(
        with(JOINT, &load.replace("gripper", "griper")),
        ["1:11 `gripper` is no payload of this robot | did you mean `griper`?"]
    );
    assert_eq!(
        with(&format!("{JOINT}mass = \"m\"\n"), load),
        ["1:11 `gripper` cannot be carried: a parameter stands in the tool or the last link | \
          write numbers there: what is carried is added to the last link"]
    );
    assert_eq!(
        with(JOINT, &format!("{load}inertia = [3, 0, 0, 1, 0, \"x\"]\n")),
        [
            "9:27 `x` stands where a number is expected | a payload is weighed, not chosen: write numbers"
        ]
    );
    assert_eq!(
        with(JOINT, &format!("{load}inertia = [3, 0, 0, 1, 0, 1]\n")),
        [
            "9:11 the principal moments of inertia are 1, 1 and 3: no body has one that is larger than the sum of the \
          others | `inertia` is [xx, xy, xz, yy, yz, zz] about the centre of mass, in the tool's axes"
        ]
    );
}

#[test]
fn a_text_is_one_line() {
    let help = "write the text on one line, without it";
    for (text, line, column) in [
        ("name = \"a\\nfn b() {}\"\n", 5, 8),
        ("source = \"a\\u0007\"\n", 5, 10),
        ("[[marker]]\nname = \"m\\r\"\n", 6, 8),
        ("[[effect]]\nid = \"a\"\nplace = \"b\\u2028\\n\"\n", 7, 9),
    ] {
        let found = errors(&format!("{HEAD}{JOINT}{text}"));
        let place = format!("{line}:{column} the control character ");
        assert!(found[0].starts_with(&place) && found[0].ends_with(help), "{found:?}");
    }
    assert_eq!(errors(&format!("name = \"a\\nb\"\nconvention = \"standard\"\n{JOINT}")).len(), 1);
}

#[test]
fn kernels_are_of_what_posture_and_load_decide() {
    let errors = |effect: &str| {
        let text = format!("{HEAD}{JOINT}[[effect]]\n{effect}\n");
        let read = Robot::for_kernels(&text, "arm.toml");
        let each = |e: crate::robot::Located| format!("{}:{} {}", e.line, e.column, e.message);
        read.err().map(|e| e.errors.into_iter().map(each).collect::<Vec<_>>()).unwrap_or_default()
    };
    for (effect, message) in [
        (
            "id = \"settling_lag\"\nplace = \"joint 1\"",
            "5:1 no kernel is made of the settling lag at joint 1: it depends on the move before, which a \
             set-point does not tell",
        ),
        (
            "id = \"joint_coupling\"\nplace = \"joints 5 + 6\"\nviscous = 0.6\ncoulomb = 1.9",
            "5:1 no kernel is made of the joint coupling at joints 5 + 6: it is of the arm in motion, of which rows \
             hold `coulomb`, `viscous`, `rotor_inertia` and bodies",
        ),
        ("id = \"backlsh\"\nplace = \"joint 1\"", "6:6 unknown effect `backlsh`"),
        ("id = \"backlash\"\nplace = \"joint 2\"", "7:9 `joint 2` is no place of backlash"),
        (
            "id = \"backlash\"\nplace = \"joint 1\"\nwith = 1e-4",
            "8:8 unknown number `with` of backlash at joint 1",
        ),
        (
            "id = \"backlash\"\nplace = \"joint 1\"\nwidth = \"1 mm\"",
            "8:9 `1 mm` is no number and its unit: rad, mrad, urad, deg",
        ),
        (
            "id = \"backlash\"\nplace = \"joint 1\"\nwidth = -1e-4",
            "8:9 `width` is -1e-4: below 0 it is not physical",
        ),
        (
            "id = \"transmission_error\"\nplace = \"joint 1\"\norder = 0",
            "8:9 `order` of transmission_error: an order of 1 to 1000 is expected",
        ),
        (
            "id = \"joint_coupling\"\nplace = \"joint 1\"\njoint = 1",
            "8:9 `joint` of joint_coupling: another joint, 1 to 1, is expected",
        ),
    ] {
        assert_eq!(errors(effect), [message], "{effect}");
    }
    assert_eq!(errors("id = \"backlash\"\nplace = \"joint 1\"\nwidth = \"0.1 mrad\""), [""; 0]);
    let symbolic =
        format!("{HEAD}{JOINT}a = \"a1\"\n[[effect]]\nid = \"backlash\"\nplace = \"joint 1\"\n");
    let error = Robot::for_kernels(&symbolic, "arm.toml").expect_err("a symbol");
    assert_eq!((error.errors[0].line, error.errors.len()), (6, 1));
}
