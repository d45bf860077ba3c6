//! Units of measure, exactly: each is a rational multiple of SI, times a power of π for degrees.

use num_rational::Ratio;

use super::dimension::{Dimension, Powers, describe};
use super::lexeme::{Kind, Lexeme, extent, show};
use super::problem::{Place, Problem};
use super::suggest::closest;
use crate::number::Number;

/// A unit expression such as `N*m/rad`, reduced.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Unit {
    /// How many SI units one of these is, without its power of π.
    pub scale: Number,
    /// The power of π in the scale: 1 for a degree.
    pub pi: i32,
    /// Exponents of length, mass, time, angle.
    pub powers: Powers,
    /// The power of `lb`, which many write for a force.
    pounds: i32,
}

/// Name, numerator and denominator of the scale, power of π in the scale, powers.
type Row = (&'static str, i128, i128, i32, Powers);

const LENGTH: Powers = [1, 0, 0, 0];
const MASS: Powers = [0, 1, 0, 0];
const TIME: Powers = [0, 0, 1, 0];
const ANGLE: Powers = [0, 0, 0, 1];
const FORCE: Powers = [1, 1, -2, 0];
const TORQUE: Powers = [2, 1, -2, 0];
const PRESSURE: Powers = [-1, 1, -2, 0];

/// A pound-force is 0.45359237 kg × 9.80665 m/s², exactly: this many 1e-13 N.
const LBF: i128 = 44_482_216_152_605;
const E13: i128 = 10_000_000_000_000;

const UNITS: &[Row] = &[
    ("m", 1, 1, 0, LENGTH),
    ("cm", 1, 100, 0, LENGTH),
    ("mm", 1, 1000, 0, LENGTH),
    ("um", 1, 1_000_000, 0, LENGTH),
    ("in", 254, 10_000, 0, LENGTH),
    ("ft", 3048, 10_000, 0, LENGTH),
    ("kg", 1, 1, 0, MASS),
    ("g", 1, 1000, 0, MASS),
    ("lb", 45_359_237, 100_000_000, 0, MASS),
    ("s", 1, 1, 0, TIME),
    ("ms", 1, 1000, 0, TIME),
    ("rad", 1, 1, 0, ANGLE),
    ("mrad", 1, 1000, 0, ANGLE),
    ("urad", 1, 1_000_000, 0, ANGLE),
    ("deg", 1, 180, 1, ANGLE),
    ("arcmin", 1, 10_800, 1, ANGLE),
    ("arcsec", 1, 648_000, 1, ANGLE),
    ("N", 1, 1, 0, FORCE),
    ("kN", 1000, 1, 0, FORCE),
    ("lbf", LBF, E13, 0, FORCE),
    ("kip", 1000 * LBF, E13, 0, FORCE),
    ("kgf", 980_665, 100_000, 0, FORCE),
    ("Nm", 1, 1, 0, TORQUE),
    ("kNm", 1000, 1, 0, TORQUE),
    ("Nmm", 1, 1000, 0, TORQUE),
    ("Pa", 1, 1, 0, PRESSURE),
    ("kPa", 1000, 1, 0, PRESSURE),
    ("MPa", 1_000_000, 1, 0, PRESSURE),
    ("GPa", 1_000_000_000, 1, 0, PRESSURE),
    // psi = lbf / (0.0254 m)²
    ("psi", LBF, 64_516 * 100_000, 0, PRESSURE),
    ("ksi", 1000 * LBF, 64_516 * 100_000, 0, PRESSURE),
    ("Mpsi", 1_000_000 * LBF, 64_516 * 100_000, 0, PRESSURE),
];

/// Exponents beyond this are a slip of the pen; the bound also keeps the scale within its type.
const LARGEST_EXPONENT: i32 = 6;

impl Unit {
    /// No unit at all.
    pub const NONE: Unit = Unit { scale: Number::ONE, pi: 0, powers: [0; 4], pounds: 0 };
    /// The radian.
    pub const RADIAN: Unit = Unit { powers: ANGLE, ..Unit::NONE };

    fn times(self, row: &Row, exponent: i32) -> Unit {
        let (name, numerator, denominator, pi, powers) = *row;
        let ratio = Number::Exact(Ratio::new(numerator, denominator));
        let factor = if exponent < 0 { ratio.recip().unwrap_or(Number::ONE) } else { ratio };
        let scale = (0..exponent.abs()).fold(self.scale, |scale, _| scale * factor);
        let power = |i: usize| self.powers[i] + powers[i] * exponent;
        Unit {
            scale,
            pi: self.pi + pi * exponent,
            powers: [power(0), power(1), power(2), power(3)],
            pounds: self.pounds + if name == "lb" { exponent } else { 0 },
        }
    }

    /// The quantity in SI units.
    pub fn to_si(self, number: Number) -> Number {
        let scaled = number * self.scale;
        match self.pi {
            0 => scaled,
            _ => scaled * Number::Rounded(libm::pow(core::f64::consts::PI, f64::from(self.pi))),
        }
    }

    /// Whether the same expression with `lbf` for `lb` would measure this quantity.
    fn means_pound_force(self, expected: Dimension) -> bool {
        let [length, mass, time, angle] = self.powers;
        self.pounds != 0
            && expected.fits([length + self.pounds, mass, time - 2 * self.pounds, angle])
    }
}

/// Reads `name ['^' integer] { ('*' | '/' | nothing) name ['^' integer] }`.
///
/// # Errors
/// An unknown unit (with the nearest known one), a missing or unexpected word, a wild exponent.
pub(crate) fn expression<L: Place>(words: &[Lexeme<L>]) -> Result<Unit, Problem<L>> {
    let mut unit = Unit::NONE;
    let mut sign = 1;
    let mut rest = words;
    while let Some((word, after)) = rest.split_first() {
        let Some(name) = word.name() else {
            return Err(unexpected(word));
        };
        let row = UNITS.iter().find(|row| row.0 == name).ok_or_else(|| unknown(name, word))?;
        let (exponent, after) = exponent(after)?;
        unit = unit.times(row, sign * exponent);
        (sign, rest) = match after.split_first() {
            None => return Ok(unit),
            Some((next, after)) if next.is('*') => (1, after),
            Some((next, after)) if next.is('/') => (-1, after),
            // `N m/rad`: a space multiplies.
            Some((next, _)) if next.name().is_some() => (1, after),
            Some((next, _)) => return Err(unexpected(next)),
        };
        if rest.is_empty() {
            let last = words.last().map_or_else(|| word.at.clone(), |w| w.at.clone());
            return Err(Problem::new(last, "a unit is expected after this sign"));
        }
    }
    Ok(unit)
}

/// An optional `^ [-] integer`; 1 if there is none.
fn exponent<L: Place>(words: &[Lexeme<L>]) -> Result<(i32, &[Lexeme<L>]), Problem<L>> {
    let Some((caret, after)) = words.split_first().filter(|(w, _)| w.is('^')) else {
        return Ok((1, words));
    };
    let (sign, after) = match after.split_first() {
        Some((minus, after)) if minus.is('-') => (-1, after),
        _ => (1, after),
    };
    let problem = |at: L| {
        let message = format!("a whole exponent of at most {LARGEST_EXPONENT} is expected here");
        Problem::new(at, message).help("for example `mm^4`")
    };
    match after.split_first() {
        Some((Lexeme { kind: Kind::Number(digits), at }, after)) => match digits.parse::<i32>() {
            Ok(power) if (1..=LARGEST_EXPONENT).contains(&power) => Ok((sign * power, after)),
            _ => Err(problem(at.clone())),
        },
        Some((word, _)) => Err(problem(word.at.clone())),
        None => Err(problem(caret.at.clone())),
    }
}

fn unknown<L: Place>(name: &str, word: &Lexeme<L>) -> Problem<L> {
    let problem = Problem::new(word.at.clone(), format!("unknown unit `{name}`"));
    match closest(name, UNITS.iter().map(|row| row.0)) {
        Some(near) => problem.help(format!("did you mean `{near}`?")),
        None => problem.help("units are written like `mm`, `deg`, `kg/m^3` or `N*m/rad`"),
    }
}

/// A word that has no place in a number with a unit.
pub(crate) fn unexpected<L: Place>(word: &Lexeme<L>) -> Problem<L> {
    let shown = show(core::slice::from_ref(word));
    let problem = Problem::new(word.at.clone(), format!("unexpected `{shown}`"));
    match shown.as_str() {
        "," => problem.help("a decimal point is written `.`"),
        quoted if quoted.starts_with('"') => problem.help("write the cell without quotes"),
        _ => problem,
    }
}

/// Checks that a unit measures what a cell holds; `cell` is the whole cell, for the message.
///
/// # Errors
/// Names the dimension found and the one expected, with an example.
pub(crate) fn check<L: Place>(
    unit: Unit,
    expected: Dimension,
    cell: &[Lexeme<L>],
    at: L,
) -> Result<(), Problem<L>> {
    if expected.fits(unit.powers) {
        return Ok(());
    }
    let at = extent(cell).unwrap_or(at);
    if unit.means_pound_force(expected) {
        return Err(Problem::new(at, "`lb` is a mass or a force: write `lbf` for the force"));
    }
    let (found, example) = (describe(unit.powers), expected.example());
    let message =
        format!("`{}` is {found}; {expected} is expected here (e.g. `{example}`)", show(cell));
    Err(Problem::new(at, message))
}

#[cfg(test)]
mod tests {
    use super::super::lexeme::lex;
    use super::*;

    fn read(text: &str) -> Result<Unit, Problem<core::ops::Range<usize>>> {
        expression(&lex(text, |r| r))
    }

    fn si(number: &str, unit: &str) -> f64 {
        read(unit).unwrap().to_si(Number::from_decimal(number).unwrap()).to_f64()
    }

    #[test]
    fn conversions_are_exact() {
        let exact =
            |n: &str, unit: &str| read(unit).unwrap().to_si(Number::from_decimal(n).unwrap());
        assert_eq!(exact("24", "in"), Number::ratio(6096, 10_000));
        assert_eq!(exact("350", "mm"), Number::ratio(35, 100));
        assert_eq!(exact("1", "lbf"), Number::from_decimal("4.4482216152605").unwrap());
        assert_eq!(exact("7.85", "g/cm^3"), Number::integer(7850));
        assert_eq!(exact("1", "in^4").to_f64(), 4.162_314_256e-7);
        assert_eq!(exact("3", "N/um"), Number::integer(3_000_000));
    }

    #[test]
    fn conversions_of_papers() {
        assert!((si("10e6", "psi") - 6.894_757_293_168_36e10).abs() < 1e-3);
        assert!((si("2.1e5", "in*lbf/rad") - 23_726.814_095_995).abs() < 1e-6);
        assert!((si("1", "N*m/arcmin") - 3_437.746_770_784_94).abs() < 1e-9);
        assert!((si("0.1", "lb/in^3") - 2_767.990_471_020_31).abs() < 1e-9);
        assert!((si("1", "kip/in^2") - si("1", "ksi")).abs() < 1e-8);
        assert_eq!(si("5", "kNm"), 5000.0);
    }

    #[test]
    fn ways_of_writing_a_unit() {
        for text in ["N*m/rad", "N·m/rad", "N m/rad", "N*m*rad^-1", "N·m·rad⁻¹", "Nm/rad"] {
            assert_eq!(read(text), read("N*m/rad"), "{text}");
        }
        assert_eq!(read("m/s/s"), read("m/s²"));
    }

    #[test]
    fn mistakes_have_places_and_messages() {
        let cases = [
            ("furlong", 0..7, "unknown unit `furlong`"),
            ("N*", 1..2, "a unit is expected after this sign"),
            ("N/2", 2..3, "unexpected `2`"),
            ("m^", 1..2, "a whole exponent of at most 6 is expected here"),
            ("m^99", 2..4, "a whole exponent of at most 6 is expected here"),
            ("m^x", 2..3, "a whole exponent of at most 6 is expected here"),
            ("m)", 1..2, "unexpected `)`"),
        ];
        for (text, at, message) in cases {
            let problem = read(text).unwrap_err();
            assert_eq!((problem.at, problem.message.as_str()), (at, message), "{text}");
        }
        assert_eq!(read("MPA").unwrap_err().help.unwrap(), "did you mean `MPa`?");
        assert_eq!(read("gpa").unwrap_err().help.unwrap(), "did you mean `GPa`?");
        assert_eq!(read("degs").unwrap_err().help.unwrap(), "did you mean `deg`?");
    }
}
