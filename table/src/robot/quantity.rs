//! A cell that is no angle: a number with an optional unit, or a parameter's name.

use super::decimal;
use super::dimension::Dimension;
use super::lexeme::{Kind, Lexeme, extent, show, sum_sign};
use super::model::Value;
use super::problem::{Place, Problem};
use super::units::{Unit, check, expression, unexpected};
use crate::number::Number;

/// Reads a cell that holds `expected`; `at` is the cell's place.
///
/// A number without a unit is SI. A single name is a parameter that stays symbolic.
///
/// # Errors
/// An empty cell, a unit of another dimension, a sum or other expression, a number that no double
/// can hold.
pub(crate) fn read<L: Place>(
    words: &[Lexeme<L>],
    expected: Dimension,
    at: &L,
) -> Result<Value, Problem<L>> {
    refuse_sum(words)?;
    if let [word] = words
        && let Some(name) = word.name()
    {
        return symbol(name, word).map(Value::Symbol);
    }
    let (negative, rest) = sign(words);
    let Some((first, units)) = rest.split_first() else {
        let message = format!("{expected} is expected here (e.g. `{}`)", expected.example());
        return Err(Problem::new(at.clone(), message));
    };
    let number = match &first.kind {
        Kind::Number(text) => number(text, &first.at)?,
        Kind::Name(_) => return Err(refuse_expression(words, at)),
        _ => return Err(unexpected(first)),
    };
    let unit = match units {
        [] => Unit::NONE,
        [Lexeme { kind: Kind::Sign('*' | '/'), .. }, ..] => {
            return Err(refuse_expression(words, at));
        }
        _ => expression(units)?,
    };
    if !units.is_empty() {
        check(unit, expected, words, at.clone())?;
    }
    let value = unit.to_si(number);
    if !value.to_f64().is_finite() {
        return Err(Problem::new(at.clone(), format!("`{}` is too large", show(words))));
    }
    Ok(Value::Number(if negative { -value } else { value }))
}

/// Whether a minus stands first, and what follows the sign.
pub(crate) fn sign<L>(words: &[Lexeme<L>]) -> (bool, &[Lexeme<L>]) {
    match words.split_first() {
        Some((first, rest)) if first.is('-') => (true, rest),
        Some((first, rest)) if first.is('+') => (false, rest),
        _ => (false, words),
    }
}

/// An unsigned decimal literal.
pub(crate) fn number<L: Place>(text: &str, at: &L) -> Result<Number, Problem<L>> {
    let large = || Problem::new(at.clone(), format!("`{text}` is too large"));
    decimal::read(text).ok_or_else(large)
}

/// The name of a parameter; `pi` is none.
pub(crate) fn symbol<L: Place>(name: &str, word: &Lexeme<L>) -> Result<String, Problem<L>> {
    match name {
        "pi" => Err(Problem::new(word.at.clone(), "`pi` is an angle, and no angle belongs here")),
        "nan" | "NaN" | "inf" | "infinity" => {
            Err(Problem::new(word.at.clone(), format!("`{name}` is not a finite number")))
        }
        _ => Ok(name.to_owned()),
    }
}

/// A sum has no place in a cell, with a parameter in it or without.
pub(crate) fn refuse_sum<L: Place>(words: &[Lexeme<L>]) -> Result<(), Problem<L>> {
    let Some(at) = sum_sign(words) else { return Ok(()) };
    let message = format!("`{}` is a sum: a cell holds one number or one parameter", show(words));
    Err(Problem::new(at, message).help("work the sum out, or take the constant into the parameter"))
}

/// A parameter stands alone: the model keeps its name, not a formula.
pub(crate) fn refuse_expression<L: Place>(words: &[Lexeme<L>], at: &L) -> Problem<L> {
    let at = extent(words).unwrap_or_else(|| at.clone());
    let message =
        format!("`{}` is an expression: a cell holds one number or one parameter", show(words));
    Problem::new(at, message)
        .help("work it out, or take the sign and the factors into the parameter")
}

#[cfg(test)]
mod tests {
    use super::super::lexeme::lex;
    use super::*;

    fn cell(text: &str, expected: Dimension) -> Result<Value, String> {
        read(&lex(text, |r| r), expected, &(0..text.len())).map_err(|p| p.message)
    }

    fn value(text: &str) -> Value {
        Value::Number(Number::from_decimal(text).unwrap())
    }

    #[test]
    fn numbers_units_and_parameters() {
        assert_eq!(cell("350 mm", Dimension::Length), Ok(value("0.35")));
        assert_eq!(cell("-24in", Dimension::Length), Ok(value("-0.6096")));
        assert_eq!(cell("+0.35", Dimension::Length), Ok(value("0.35")));
        assert_eq!(cell("a2", Dimension::Length), Ok(Value::Symbol("a2".into())));
        assert_eq!(cell("0.85", Dimension::Ratio), Ok(value("0.85")));
        assert_eq!(cell("3.8e6 N*m", Dimension::AngularStiffness), Ok(value("3.8e6")));
        assert_eq!(cell("12 lb", Dimension::Mass), Ok(value("5.44310844")));
        assert_eq!(cell("0e999", Dimension::Length), Ok(Value::ZERO));
    }
}
