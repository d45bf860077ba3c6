//! Every sentence of the macro's input, and every mistake in it.

mod head;
mod table;

use super::{Invocation, Rejected, Source, parse_tokens};
use crate::number::Number;
use crate::robot::{Robot, Value};

pub(super) fn parse(text: &str) -> Result<Invocation, Box<Rejected>> {
    parse_tokens(text.parse().expect("these are tokens"))
}

/// `line:column message` of each error, with `| help` where there is one.
pub(super) fn errors(text: &str) -> Vec<String> {
    let Err(rejected) = parse(text) else { panic!("accepted: {text}") };
    let shown = rejected.errors.iter().map(|e| {
        let help = e.help.as_ref().map(|help| format!(" | {help}")).unwrap_or_default();
        let place = e.span.start();
        format!("{}:{} {}{help}", place.line, place.column + 1, e.message)
    });
    shown.collect()
}

pub(super) fn read(text: &str) -> Robot {
    match parse(text) {
        Ok(Invocation { source: Source::Table(robot), .. }) => *robot,
        Ok(_) => panic!("a file"),
        Err(_) => panic!("{:?}", errors(text)),
    }
}

/// The errors of a table behind a head of two lines: the header stands in line 3.
pub(super) fn table_errors(table: &str) -> Vec<String> {
    errors(&format!("mod arm;\nconvention: modified_dh;\n{table}"))
}

pub(super) fn table(table: &str) -> Robot {
    read(&format!("mod arm;\nconvention: modified_dh;\n{table}"))
}

pub(super) fn number(text: &str) -> Value {
    Value::Number(Number::from_decimal(text).unwrap())
}
