//! A cell that is an angle: `pi/2`, `-90 deg`, plain radians, or a parameter's name.

use core::f64::consts::PI;

use super::decimal;
use super::dimension::Dimension;
use super::lexeme::{Kind, Lexeme, extent, show};
use super::model::Angle;
use super::pi::{exact_multiple, multiple, rounded_multiple, spell, spelled_out};
use super::problem::{Place, Problem};
use super::quantity::{number, refuse_expression, refuse_sum, sign, symbol};
use super::units::{Unit, check, expression, unexpected};
use crate::number::Number;

/// An angle, and a doubt about it: a rounded multiple of π, or degrees without their unit.
pub(crate) type Doubted<L> = (Angle, Option<Problem<L>>);

/// The doubt that matters for a joint limit: degrees without their unit. A rounded π does no harm.
pub(crate) fn limit_doubt<L>((angle, doubt): Doubted<L>) -> Doubted<L> {
    let many_turns = angle.radians().is_some_and(|x| x.abs() > 4.0 * PI);
    (angle, doubt.filter(|_| many_turns))
}

/// Reads an angle; `at` is the cell's place.
///
/// Grammar: `[-] factor { ('*' | '/' | nothing) factor } [unit]`, a factor being a number or `pi`;
/// or a single name, which is a parameter.
///
/// # Errors
/// An empty cell, a unit of another dimension, a sum or other expression, π squared or below the
/// line, a division by zero.
pub(crate) fn read<L: Place>(words: &[Lexeme<L>], at: &L) -> Result<Doubted<L>, Problem<L>> {
    refuse_sum(words)?;
    if let [word] = words
        && let Some(name) = word.name().filter(|name| *name != "pi")
    {
        return Ok((Angle::Symbol(symbol(name, word)?), None));
    }
    let (negative, rest) = sign(words);
    let product = product(words, rest, at)?;
    let number = if negative { -product.number } else { product.number };
    let whole = extent(words).unwrap_or_else(|| at.clone());
    if !product.unit_given && product.pi == 0 {
        return Ok(plain_radians(number, rest, whole));
    }
    if product.unit.pi + product.pi > 1 {
        let message = format!("`{}` has a factor pi too many", show(words));
        return Err(Problem::new(whole, message).help("write `90 deg` or `pi/2`"));
    }
    let scaled = number * product.unit.scale;
    if !(scaled.to_f64() * PI).is_finite() {
        return Err(Problem::new(whole, format!("`{}` is too large", show(words))));
    }
    match (scaled, product.unit.pi + product.pi) {
        (Number::Exact(r), 1) => Ok((multiple(r), None)),
        (x, 1) => Ok((Angle::Radians(x * Number::Rounded(PI)), None)),
        (x, _) if product.unit == Unit::RADIAN => Ok(plain_radians_in_unit(x, rest, whole)),
        (x, _) => Ok((recognised(x), None)),
    }
}

/// Factors multiplied out: `number · π^pi`, times a unit.
struct Product {
    number: Number,
    pi: i32,
    unit: Unit,
    unit_given: bool,
}

fn product<L: Place>(
    cell: &[Lexeme<L>],
    words: &[Lexeme<L>],
    at: &L,
) -> Result<Product, Problem<L>> {
    let missing = |at: &L| {
        let message = "an angle is expected here (e.g. `pi/2`, `90 deg`, `0.5`)";
        Problem::new(at.clone(), message)
    };
    let mut found = Product { number: Number::ONE, pi: 0, unit: Unit::NONE, unit_given: false };
    let mut rest = words;
    let mut divide = false;
    loop {
        let (word, after) = rest
            .split_first()
            .ok_or_else(|| missing(&cell.last().map_or_else(|| at.clone(), |w| w.at.clone())))?;
        match &word.kind {
            Kind::Number(text) => {
                let mut factor = number(text, &word.at)?;
                if divide {
                    let zero = || Problem::new(word.at.clone(), "a division by zero");
                    factor = decimal::recip(factor).ok_or_else(zero)?;
                }
                found.number = found.number * factor;
            }
            Kind::Name(name) if name == "pi" && !divide => found.pi += 1,
            Kind::Name(name) if name == "pi" => {
                return Err(Problem::new(word.at.clone(), "`pi` cannot be divided by"));
            }
            Kind::Name(_) => return Err(refuse_expression(cell, at)),
            _ => return Err(unexpected(word)),
        }
        (divide, rest) = match after.split_first() {
            None => return Ok(found),
            Some((next, after)) if next.is('*') => (false, after),
            Some((next, after)) if next.is('/') => (true, after),
            Some((next, _)) if next.name() == Some("pi") => (false, after),
            Some((next, _)) if next.name().is_some() => {
                found.unit = expression(after)?;
                found.unit_given = true;
                check(found.unit, Dimension::Angle, cell, at.clone())?;
                return Ok(found);
            }
            Some((next, _)) => return Err(unexpected(next)),
        };
    }
}

fn recognised(number: Number) -> Angle {
    exact_multiple(number.to_f64()).map_or(Angle::Radians(number), Angle::Pi)
}

/// A number without a unit: radians, as every table has it. Doubted if it looks like degrees.
fn plain_radians<L: Place>(number: Number, words: &[Lexeme<L>], whole: L) -> Doubted<L> {
    let x = number.to_f64();
    let (angle, doubt) = plain_radians_in_unit(number, words, whole.clone());
    if doubt.is_none() && matches!(angle, Angle::Radians(_)) && x.abs() > 4.0 * PI {
        let turns = x.abs() / (2.0 * PI);
        let sign = if number.is_negative() { "-" } else { "" };
        let shown = format!("{sign}{}", show(words));
        let message = format!("{shown} radians is {turns:.1} turns: for degrees write {shown} deg");
        let doubt = Problem::new(whole, message);
        let doubt = doubt.help(format!("if radians are meant, write {shown} rad"));
        return (angle, Some(doubt.cause("degrees")));
    }
    (angle, doubt)
}

/// A number of radians; doubted if its digits are those of a rounded multiple of π.
fn plain_radians_in_unit<L: Place>(number: Number, words: &[Lexeme<L>], whole: L) -> Doubted<L> {
    let angle = recognised(number);
    let doubt = match (&angle, words.first().map(|w| &w.kind), words.get(1)) {
        (Angle::Radians(_), Some(Kind::Number(literal)), next)
            if next.is_none_or(|w| w.name().is_some()) =>
        {
            rounded_multiple(literal).map(|r| {
                let sign = if number.is_negative() { "-" } else { "" };
                let r = if number.is_negative() { -r } else { r };
                let pi = spell(r);
                let message = format!("{sign}{literal} looks like a rounded {pi}: write {pi}");
                let doubt = Problem::new(whole, message);
                match spelled_out(literal) {
                    Some(longer) => doubt.help(format!(
                        "if {sign}{literal} is meant to the last digit, write {sign}{longer}"
                    )),
                    None => doubt,
                }
            })
        }
        _ => None,
    };
    (angle, doubt)
}

#[cfg(test)]
mod tests {
    use num_rational::Ratio;

    use super::super::lexeme::lex;
    use super::*;

    fn cell(text: &str) -> Result<Doubted<core::ops::Range<usize>>, String> {
        read(&lex(text, |r| r), &(0..text.len())).map_err(|p| p.message)
    }

    fn pi(n: i64, d: i64) -> Angle {
        Angle::Pi(Ratio::new(n, d))
    }

    #[test]
    fn multiples_of_pi_are_exact() {
        let cases = [
            ("pi/2", pi(1, 2)),
            ("-pi/2", pi(-1, 2)),
            ("2*pi/3", pi(2, 3)),
            ("3pi/4", pi(3, 4)),
            ("pi*3/4", pi(3, 4)),
            ("0.5 pi", pi(1, 2)),
            ("pi/7", pi(1, 7)),
            ("-90 deg", pi(-1, 2)),
            ("90°", pi(1, 2)),
            ("37.3 deg", pi(373, 1800)),
            ("30 arcmin", pi(1, 360)),
            ("180/4 deg", pi(1, 4)),
            ("0", pi(0, 1)),
            ("0 deg", pi(0, 1)),
            ("pi rad", pi(1, 1)),
            ("1.5707963267948966", pi(1, 2)),
            ("-2.0943951023931953", pi(-2, 3)),
            ("1570.7963267948966 mrad", pi(1, 2)),
        ];
        for (text, angle) in cases {
            assert_eq!(cell(text), Ok((angle, None)), "{text}");
        }
    }

    #[test]
    fn other_angles_are_radians_and_names_are_parameters() {
        let radians = |n| Angle::Radians(Number::from_decimal(n).unwrap());
        assert_eq!(cell("0.5"), Ok((radians("0.5"), None)));
        assert_eq!(cell("-1.2 rad"), Ok((radians("-1.2"), None)));
        assert_eq!(cell("500 mrad"), Ok((radians("0.5"), None)));
        assert_eq!(cell("t2"), Ok((Angle::Symbol("t2".into()), None)));
    }
}
