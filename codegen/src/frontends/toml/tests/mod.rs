//! Every sentence of the robot file's format, and every mistake in it.

mod format;
mod mistakes;

use crate::number::Number;
use crate::robot::{FileError, Located, Output, Robot, Value};

const HEAD: &str = "name = \"arm\"\nconvention = \"standard\"\n";
const JOINT: &str = "[[joint]]\ntype = \"revolute\"\n";

pub(super) fn number(text: &str) -> Value {
    Value::Number(Number::from_decimal(text).unwrap())
}

pub(super) fn read(text: &str) -> Robot {
    let (robot, warnings) = Robot::from_toml(text, "arm.toml").unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(warnings, []);
    robot
}

pub(super) fn refused(text: &str) -> FileError {
    Robot::from_toml(text, "arm.toml").expect_err(text)
}

/// `line:column message` of each error, with `| help` where there is one.
pub(super) fn errors(text: &str) -> Vec<String> {
    let shown = |e: &Located| {
        let help = e.help.as_ref().map(|help| format!(" | {help}")).unwrap_or_default();
        format!("{}:{} {}{help}", e.line, e.column, e.message)
    };
    refused(text).errors.iter().map(shown).collect()
}

/// The errors of a revolute joint with these lines, which begin in line 5.
pub(super) fn joint_errors(lines: &str) -> Vec<String> {
    errors(&format!("{HEAD}{JOINT}{lines}\n"))
}
