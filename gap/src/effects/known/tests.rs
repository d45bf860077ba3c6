//! What an `[[effect]]` may say, and what it may not.

use stiffarm_table::robot::Robot;

use super::*;

fn read(lines: &str) -> Result<Vec<Known>, Vec<KnownError>> {
    let joint = "[[joint]]\ntype = \"revolute\"\na = 0.5\nalpha = \"pi/2\"\n";
    let text = format!(
        "name = \"x\"\nconvention = \"standard\"\n{joint}{joint}{joint}[[effect]]\n{lines}\n"
    );
    let robot = Robot::from_toml(&text, "x.toml").unwrap_or_else(|e| panic!("{e}")).0;
    Known::all(&robot, &crate::robot::arm(&robot).unwrap(), &Catalogue::default())
}

#[track_caller]
fn one(lines: &str) -> Known {
    let mut known = read(lines).unwrap_or_else(|e| panic!("{e:?}"));
    assert_eq!(known.len(), 1);
    known.remove(0)
}

/// Line, message and advice of the only mistake.
#[track_caller]
fn wrong(lines: &str) -> (usize, String, String) {
    let error = read(lines).unwrap_err().remove(0);
    (error.at.line, error.message, error.help.unwrap_or_default())
}

#[test]
fn numbers_have_units_or_are_in_si() {
    let wave = one(
        "id = \"transmission_error\"\nplace = \"joint 2\"\norder = 2\ncos = \"0.1 mrad\"\nsin = -5e-5",
    );
    assert_eq!((wave.spot.place, wave.spot.form), (Place::Joint(2), 2));
    assert_eq!(wave.values, [1e-4, -5e-5]);
    let coupling =
        one("id = \"joint_coupling\"\nplace = \"joint 3\"\njoint = 1\nratio = \"200 ppm\"");
    assert_eq!((coupling.spot.form, coupling.values), (0, vec![200.0 * 1e-6]));
    let slip =
        one("id = \"slip\"\nplace = \"base\"\nafter = 40\nsession = \"run.csv\"\nx = \"1 mm\"");
    assert_eq!((slip.spot.form, slip.session.as_deref()), (40, Some("run.csv")));
    assert_eq!(slip.values, [1e-3, 0.0, 0.0, 0.0, 0.0, 0.0]);
}

#[test]
fn what_it_cannot_mean_is_said_at_its_place() {
    let at = |line: usize, message: &str, help: &str| (line, message.to_owned(), help.to_owned());
    assert_eq!(
        wrong("id = \"backlsh\"\nplace = \"joint 2\""),
        at(16, "unknown effect `backlsh`", "did you mean `backlash`?")
    );
    assert_eq!(
        wrong("id = \"backlash\"\nplace = \"joint 7\""),
        at(17, "`joint 7` is no place of backlash", "did you mean `joint 1`?")
    );
    assert_eq!(
        wrong("id = \"backlash\"\nplace = \"joint 2\"\nwidht = 1e-3"),
        at(18, "unknown number `widht` of backlash at joint 2", "did you mean `width`?")
    );
    let (line, message, help) = wrong("id = \"backlash\"\nplace = \"joint 2\"\nwidth = \"1 mm\"");
    assert_eq!((line, help.as_str()), (18, "a number without a unit is in rad"));
    assert_eq!(message, "`1 mm` is no number and its unit: rad, mrad, urad, deg");
    let (line, message, _) = wrong("id = \"backlash\"\nplace = \"joint 2\"\nwidth = -1e-3");
    assert_eq!((line, message.as_str()), (18, "`width` is -0.001: below 0e0 it is not physical"));
    for (lines, line, message) in [
        (
            "place = \"joint 2\"\ncos = 1e-3",
            15,
            "`order` of transmission_error is missing: an order of 1 to 1000",
        ),
        (
            "place = \"joint 2\"\norder = 0.5",
            18,
            "`order` of transmission_error is not an order of 1 to 1000",
        ),
    ] {
        let (at, said, help) = wrong(&format!("id = \"transmission_error\"\n{lines}"));
        assert_eq!((at, said.as_str(), help.as_str()), (line, message, "write order = 1"));
    }
    for joint in ["2", "4", "0"] {
        let (line, message, _) =
            wrong(&format!("id = \"joint_coupling\"\nplace = \"joint 2\"\njoint = {joint}"));
        assert_eq!(
            (line, message.as_str()),
            (18, "`joint` of joint_coupling is not another joint, 1 to 3")
        );
    }
    let (line, message, _) = wrong("id = \"drift\"\nplace = \"base\"\nsession = 3");
    assert_eq!((line, message.as_str()), (18, "a number stands where a file's name is expected"));
    // A session is for what happens in one.
    assert_eq!(wrong("id = \"backlash\"\nplace = \"joint 2\"\nsession = \"a\"").0, 18);
}
