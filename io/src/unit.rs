//! The units that stand in a file: one table for headers, options and other programs' spellings.

use core::f64::consts::PI;
use core::fmt;

use super::mistake::Fault;
use super::nearest::{did_you_mean, nearest};

/// What kind of quantity a column holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Dimension {
    /// Metres.
    Length,
    /// Radians.
    Angle,
    /// Newtons.
    Force,
    /// Newton-metres.
    Moment,
    /// Degrees Celsius.
    Temperature,
    /// Seconds.
    Time,
    /// Kilograms.
    Mass,
    /// Amperes.
    Current,
    /// Metres per second.
    Speed,
    /// Radians per second.
    AngularSpeed,
    /// Metres per second squared.
    Acceleration,
    /// Radians per second squared.
    AngularAcceleration,
    /// Pixels of a picture.
    Pixels,
}

/// One unit: `SI value = factor · value + offset`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unit {
    /// As it stands in the brackets of a header.
    pub name: &'static str,
    /// The kind of quantity it measures.
    pub dimension: Dimension,
    /// SI units per unit.
    pub factor: f64,
    /// Added after the factor; zero except for kelvin, which are kept in degrees Celsius.
    pub offset: f64,
}

const fn unit(name: &'static str, dimension: Dimension, factor: f64) -> Unit {
    Unit { name, dimension, factor, offset: 0.0 }
}

const DEGREE: f64 = PI / 180.0;

/// An inch, m.
pub const INCH: f64 = 0.0254;

/// A pound-force, N.
pub const POUND: f64 = 4.448_221_615_260_5;

/// Every unit; of each quantity the SI unit first.
const UNITS: [Unit; 42] = [
    unit("m", Dimension::Length, 1.0),
    unit("mm", Dimension::Length, 1e-3),
    unit("um", Dimension::Length, 1e-6),
    unit("in", Dimension::Length, INCH),
    unit("rad", Dimension::Angle, 1.0),
    unit("deg", Dimension::Angle, DEGREE),
    unit("mrad", Dimension::Angle, 1e-3),
    unit("N", Dimension::Force, 1.0),
    unit("kN", Dimension::Force, 1e3),
    unit("lbf", Dimension::Force, POUND),
    unit("kgf", Dimension::Force, 9.806_65),
    unit("Nm", Dimension::Moment, 1.0),
    unit("Nmm", Dimension::Moment, 1e-3),
    unit("degC", Dimension::Temperature, 1.0),
    Unit { offset: -273.15, ..unit("K", Dimension::Temperature, 1.0) },
    unit("s", Dimension::Time, 1.0),
    unit("ms", Dimension::Time, 1e-3),
    unit("us", Dimension::Time, 1e-6),
    unit("ns", Dimension::Time, 1e-9),
    unit("min", Dimension::Time, 60.0),
    unit("h", Dimension::Time, 3600.0),
    unit("d", Dimension::Time, 86_400.0),
    unit("kg", Dimension::Mass, 1.0),
    unit("g", Dimension::Mass, 1e-3),
    unit("lb", Dimension::Mass, 0.453_592_37),
    unit("A", Dimension::Current, 1.0),
    unit("mA", Dimension::Current, 1e-3),
    unit("m/s", Dimension::Speed, 1.0),
    unit("mm/s", Dimension::Speed, 1e-3),
    unit("um/s", Dimension::Speed, 1e-6),
    unit("in/s", Dimension::Speed, INCH),
    unit("rad/s", Dimension::AngularSpeed, 1.0),
    unit("deg/s", Dimension::AngularSpeed, DEGREE),
    unit("mrad/s", Dimension::AngularSpeed, 1e-3),
    unit("m/s^2", Dimension::Acceleration, 1.0),
    unit("mm/s^2", Dimension::Acceleration, 1e-3),
    unit("um/s^2", Dimension::Acceleration, 1e-6),
    unit("in/s^2", Dimension::Acceleration, INCH),
    unit("rad/s^2", Dimension::AngularAcceleration, 1.0),
    unit("deg/s^2", Dimension::AngularAcceleration, DEGREE),
    unit("mrad/s^2", Dimension::AngularAcceleration, 1e-3),
    unit("px", Dimension::Pixels, 1.0),
];

/// Signs that stand for letters: `µ` (as the micro sign and as the Greek letter), `°`, `N·m`, `N*m`.
const SIGNS: [(&str, &str); 8] = [
    ("\u{b5}", "u"),
    ("\u{3bc}", "u"),
    ("°C", "degC"),
    ("°", "deg"),
    ("·", ""),
    ("*", ""),
    ("s²", "s^2"),
    ("/s2", "/s^2"),
];

/// What other programs write out, in small letters.
const WORDS: [(&str, &[&str]); 11] = [
    ("deg", &["degree", "degrees", "grad", "deg"]),
    ("rad", &["radian", "radians", "rad"]),
    ("m", &["meter", "metre", "meters", "metres"]),
    ("mm", &["mm"]),
    ("in", &["inch", "inches"]),
    ("s", &["sec", "second", "seconds", "sekunden"]),
    ("min", &["minute", "minutes", "minuten"]),
    ("h", &["hour", "hours", "stunden"]),
    ("d", &["day", "days", "tage"]),
    ("degC", &["c", "celsius", "deg c"]),
    ("kg", &["kg"]),
];

/// A number as a person writes it, in SI: plain, or with its unit behind it (`30deg`, `3e-05 m`); `None` of
/// what is none, is not finite, or has the unit of another quantity.
pub fn quantity(text: &str, dimension: Option<Dimension>) -> Option<f64> {
    let text = text.trim();
    let of_unit = || {
        let number = text.trim_end_matches(|c: char| !c.is_ascii_digit() && c != '.');
        let unit = Unit::named(text[number.len()..].trim_start())?;
        Some(unit.to_si(plain(number)?)).filter(|_| Some(unit.dimension) == dimension)
    };
    plain(text).or_else(of_unit).filter(|x| x.is_finite())
}

/// A number in digits; `inf` and `nan` are none.
pub fn plain(text: &str) -> Option<f64> {
    let digits = text.bytes().any(|b| b.is_ascii_digit());
    text.parse().ok().filter(|x: &f64| digits && x.is_finite())
}

impl Unit {
    /// The unit of that name; names are case-sensitive, and signs (`µm`, `°`, `N·m`) are names.
    pub fn named(name: &str) -> Option<Unit> {
        let plain = |name: &str| {
            let spell = |text: String, (sign, letters): &(&str, &str)| text.replace(sign, letters);
            SIGNS.iter().fold(name.to_owned(), spell)
        };
        let known = |name: &str| UNITS.into_iter().find(|u| u.name == name);
        known(name).or_else(|| known(&plain(name)))
    }

    /// The unit that another program may mean by a text, in brackets or not, whatever the case where it
    /// is clear.
    pub fn spelled(text: &str) -> Option<Unit> {
        let text = text.trim().trim_matches(['[', ']', '(', ')']);
        let small = text.to_lowercase();
        let word = WORDS.iter().find(|(_, words)| words.contains(&small.as_str()));
        let unit = Unit::named(word.map_or(text, |(name, _)| name));
        // A is an axis, not an ampere.
        unit.filter(|unit| unit.dimension != Dimension::Current)
    }

    /// A number of this unit in SI (temperatures in degrees Celsius).
    pub fn to_si(self, value: f64) -> f64 {
        self.factor * value + self.offset
    }
}

impl Dimension {
    /// Whether a quantity of this kind loads an arm or warms it.
    pub fn acts(self) -> bool {
        matches!(
            self,
            Dimension::Mass | Dimension::Force | Dimension::Moment | Dimension::Temperature
        )
    }

    fn all(self) -> impl Iterator<Item = Unit> {
        UNITS.into_iter().filter(move |unit| unit.dimension == self)
    }

    /// The unit of a column whose header gives none.
    pub fn si(self) -> Unit {
        self.all().next().unwrap_or(unit("", self, 1.0))
    }

    /// The names of its units, as an error message lists them: `m, mm, um, in`.
    pub fn units(self) -> String {
        self.all().map(|unit| unit.name).collect::<Vec<_>>().join(", ")
    }

    /// The unit of its own that was `found` in a header, as `read` reads it.
    pub fn unit(self, found: &str, read: fn(&str) -> Option<Unit>) -> Result<Unit, Fault> {
        match read(found) {
            Some(unit) if unit.dimension == self => Ok(unit),
            Some(other) => {
                let found = format!("`{found}`, the unit of {}", other.dimension);
                let help = format!("write one of {}", self.units());
                Err(Fault::new(found, self.to_string(), help))
            }
            None => {
                let near = nearest(found, self.all().map(|unit| unit.name));
                let expected = format!("one of {}{}", self.units(), did_you_mean(near));
                Err(Fault::new(format!("the unknown unit `{found}`"), expected, ""))
            }
        }
    }
}

impl fmt::Display for Dimension {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Dimension::Length => "a length",
            Dimension::Angle => "an angle",
            Dimension::Force => "a force",
            Dimension::Moment => "a moment",
            Dimension::Temperature => "a temperature",
            Dimension::Time => "a time",
            Dimension::Mass => "a mass",
            Dimension::Current => "a current",
            Dimension::Speed => "a speed",
            Dimension::AngularSpeed => "an angular speed",
            Dimension::Acceleration => "an acceleration",
            Dimension::AngularAcceleration => "an angular acceleration",
            Dimension::Pixels => "a place in a picture",
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn converts_to_si() {
        let si = |name: &str, value| Unit::named(name).map(|u| u.to_si(value));
        assert_eq!(si("in", 10.0), Some(0.254));
        assert_eq!(si("deg", 180.0), Some(PI));
        assert_eq!(si("kgf", 1.0), Some(9.80665));
        assert_eq!(si("lbf", 1.0), Some(4.4482216152605));
        assert_eq!(si("K", 293.15), Some(20.0));
        assert_eq!(si("mrad/s", 2.0), Some(2e-3));
        assert_eq!(si("mA", 2.0), Some(2e-3));
        assert_eq!(si("inch", 1.0), None);
        for (sign, name) in [
            ("µm", "um"),
            ("μm", "um"),
            ("°", "deg"),
            ("°C", "degC"),
            ("N·m", "Nm"),
            ("N*m", "Nm"),
            ("°/s²", "deg/s^2"),
            ("mm/s2", "mm/s^2"),
        ] {
            assert!(si(sign, 3.0).is_some() && si(sign, 3.0) == si(name, 3.0), "{sign}");
        }
        for (word, name) in [("Degrees", "deg"), ("[Inch]", "in"), ("C", "degC"), ("KG", "kg")] {
            assert_eq!(Unit::spelled(word), Unit::named(name), "{word}");
        }
    }

    #[test]
    fn every_dimension_has_its_si_unit_in_the_table() {
        for u in UNITS {
            let si = u.dimension.si();
            assert_eq!(Unit::named(si.name), Some(si));
            assert_eq!((si.factor, si.offset), (1.0, 0.0));
        }
        assert_eq!(Dimension::Length.units(), "m, mm, um, in");
    }

    #[test]
    fn a_unit_of_another_quantity_is_no_unit() {
        let wrong = |of: Dimension, found| of.unit(found, Unit::named).unwrap_err().to_string();
        assert!(Dimension::Speed.unit("mm/s", Unit::named).is_ok());
        let told = wrong(Dimension::AngularSpeed, "rad");
        assert_eq!(
            told,
            "found `rad`, the unit of an angle, expected an angular speed: write one of rad/s, deg/s, \
             mrad/s"
        );
        let told = wrong(Dimension::Angle, "degs");
        assert_eq!(
            told,
            "found the unknown unit `degs`, expected one of rad, deg, mrad; did you mean `deg`?"
        );
        assert!(wrong(Dimension::Angle, "furlong").ends_with("mrad"));
    }
}
