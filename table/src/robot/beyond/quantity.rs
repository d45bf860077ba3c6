//! What the numbers of an effect are, and the units in which they may be written.

use crate::robot::Motion;

/// A unit and what it is in SI.
type Named = (&'static str, f64);

const DEGREE: f64 = core::f64::consts::PI / 180.0;

const LENGTHS: [Named; 4] = [("m", 1.0), ("mm", 1e-3), ("um", 1e-6), ("in", 0.0254)];
const ANGLES: [Named; 4] = [("rad", 1.0), ("mrad", 1e-3), ("urad", 1e-6), ("deg", DEGREE)];
const MOMENTS: [Named; 4] = [("N*m", 1.0), ("Nm", 1.0), ("Nmm", 1e-3), ("kNm", 1e3)];
const FORCES: [Named; 3] = [("N", 1.0), ("kN", 1e3), ("lbf", 4.448_221_615_260_5)];
const TIMES: [Named; 4] = [("s", 1.0), ("min", 60.0), ("h", 3600.0), ("row", 1.0)];
const SECONDS: [Named; 2] = [("s", 1.0), ("ms", 1e-3)];
const MASSES: [Named; 3] = [("kg", 1.0), ("g", 1e-3), ("lb", 0.453_592_37)];
const PARTS: [Named; 4] = [("", 1.0), ("1", 1.0), ("%", 1e-2), ("ppm", 1e-6)];
const KELVINS: [Named; 2] = [("K", 1.0), ("degC", 1.0)];
const NUMBER: [Named; 2] = [("", 1.0), ("1", 1.0)];
const ROWS: [Named; 2] = [("", 1.0), ("rows", 1.0)];
const TURNS: [Named; 2] = [("", 1.0), ("perturn", 1.0)];
const NONE: [Named; 0] = [];
const ANY: f64 = f64::INFINITY;
const AREAS: [Named; 4] = [("N*m^2", 1.0), ("Nm^2", 1.0), ("Nm2", 1.0), ("kN*m^2", 1e3)];

/// Everything about a kind of number.
struct Kind {
    unit: &'static str,
    /// Units above and below the stroke, and the power of the latter.
    above: &'static [Named],
    below: &'static [Named],
    power: i32,
    /// About what arms of a metre or two have; the proportions of an effect's parameters.
    typical: f64,
    /// Beyond this no arm is still the arm of its file.
    largest: f64,
}

/// The kinds, one to a line: SI unit; units above and below the stroke with the latter's power; what
/// is typical of it, and the largest.
macro_rules! quantities {
    ($($(#[$more:meta])* $name:ident: $unit:literal; $above:ident / $below:ident^$power:literal; $typical:literal, $largest:expr)*) => {
        /// The kind of a parameter.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Quantity {
            $(#[doc = concat!("In ", $unit, ".")] $(#[$more])* $name,)*
            /// In a unit of its own, of which no other is read.
            In(&'static str),
        }

        impl Quantity {
            /// Those that have units of several sizes.
            pub const ALL: &[Quantity] = &[$(Quantity::$name),*];

            fn kind(self) -> Kind {
                let (unit, above, below, power, typical, largest) = match self {
                    $(Quantity::$name => {
                        ($unit, &$above[..], &$below[..], $power, $typical, $largest)
                    })*
                    Quantity::In(unit) => (unit, &NONE[..], &NONE[..], 0, 1.0, ANY),
                };
                Kind { unit, above, below, power, typical, largest }
            }
        }
    };
}

quantities! {
    Length: "m"; LENGTHS / NONE^0; 3e-4, 0.05
    Angle: "rad"; ANGLES / NONE^0; 3e-4, 0.05
    Moment: "N·m"; MOMENTS / NONE^0; 100.0, ANY
    AnglePerMoment: "rad/(N·m)"; ANGLES / MOMENTS^1; 1e-6, ANY
    LengthPerForce: "m/N"; LENGTHS / FORCES^1; 1e-7, ANY
    AnglePerMomentCubed: "rad/(N·m)³"; ANGLES / MOMENTS^3; 1e-10, ANY
    LengthPerForceCubed: "m/N³"; LENGTHS / FORCES^3; 1e-12, ANY
    /// One over EI or GJ.
    Flexibility: "1/(N·m²)"; NUMBER / AREAS^1; 1e-6, ANY
    Mass: "kg"; MASSES / NONE^0; 1.0, 100.0
    Ratio: "1"; PARTS / NONE^0; 1e-2, 0.5
    AnglePerLength: "rad/m"; ANGLES / LENGTHS^1; 1e-2, 0.5
    LengthPerAngle: "m/rad"; LENGTHS / ANGLES^1; 1e-2, 0.5
    PerKelvin: "1/K"; PARTS / KELVINS^1; 12e-6, 1e-3
    AnglePerKelvin: "rad/K"; ANGLES / KELVINS^1; 2e-5, 1e-2
    LengthPerKelvin: "m/K"; LENGTHS / KELVINS^1; 2e-5, 1e-2
    Time: "s"; SECONDS / NONE^0; 1e-2, 10.0
    /// By the row where the rows have no time.
    LengthRate: "m/s"; LENGTHS / TIMES^1; 3e-4, ANY
    /// By the row where the rows have no time.
    AngleRate: "rad/s"; ANGLES / TIMES^1; 3e-4, ANY
    /// Periods in a turn.
    PerTurn: "per turn"; TURNS / NONE^0; 100.0, ANY
    /// The number of a row, from 1.
    Row: "rows"; ROWS / NONE^0; 1.0, ANY
}

impl Quantity {
    /// The SI unit, as it is printed.
    pub fn unit(self) -> &'static str {
        self.kind().unit
    }

    /// About what arms of a metre or two have; the proportions of an effect's parameters.
    pub fn typical(self) -> f64 {
        self.kind().typical
    }

    /// Beyond this no arm is still the arm of its file.
    pub fn largest(self) -> f64 {
        self.kind().largest
    }

    /// The SI unit with rows that have a time, or that have none: what happens by the second happens
    /// by the row then.
    pub fn unit_by(self, timed: bool) -> &'static str {
        match self {
            Quantity::LengthRate if !timed => "m/row",
            Quantity::AngleRate if !timed => "rad/row",
            _ => self.unit(),
        }
    }

    /// The same of a turn where the joint is revolute, of a shift where it is prismatic.
    pub fn of(motion: Motion, [revolute, prismatic]: [Quantity; 2]) -> Quantity {
        match motion {
            Motion::Revolute => revolute,
            Motion::Prismatic => prismatic,
        }
    }

    /// The units that may be written, as a message lists them.
    pub fn units(self) -> String {
        let Kind { above, below, power, .. } = self.kind();
        let names = |list: &[Named]| {
            let names: Vec<&str> =
                list.iter().map(|(name, _)| *name).filter(|n| !n.is_empty()).collect();
            names.join(", ")
        };
        match (below.is_empty(), power) {
            (true, _) if self == Quantity::Row => "no unit: the number of a row".to_owned(),
            (true, _) => names(above),
            (false, 3) => {
                format!("one of {} over the cube of one of {}", names(above), names(below))
            }
            (false, _) => format!("one of {} over one of {}", names(above), names(below)),
        }
    }

    /// What one `unit` is in SI; `None` if it is no unit of this quantity.
    fn factor(self, unit: &str) -> Option<f64> {
        let Kind { above, below, power, .. } = self.kind();
        let find =
            |list: &[Named], name: &str| list.iter().find(|(n, _)| *n == name).map(|(_, f)| *f);
        if below.is_empty() {
            return find(above, unit);
        }
        let (numerator, denominator) = unit.split_once('/')?;
        let denominator = match power {
            3 => denominator.strip_suffix("^3")?,
            _ => denominator,
        };
        let bare = denominator.strip_prefix('(').and_then(|d| d.strip_suffix(')'));
        Some(find(above, numerator)? / find(below, bare.unwrap_or(denominator))?.powi(power))
    }

    /// A number with its unit, `0.3 mrad`, in SI. A number alone is in SI already.
    pub fn read(self, text: &str) -> Option<f64> {
        let text = text.trim();
        // The longest beginning that is a number: the `e` of `1e-7` belongs to it.
        let ends = (1..=text.len()).rev().filter(|end| text.is_char_boundary(*end));
        let (number, unit) = ends
            .filter_map(|end| {
                let (head, tail) = text.split_at(end);
                let digits = head.bytes().any(|b| b.is_ascii_digit());
                head.parse::<f64>().ok().filter(|x| digits && x.is_finite()).map(|x| (x, tail))
            })
            .next()?;
        let plain = normal(unit);
        let factor = if plain.is_empty() { 1.0 } else { self.factor(&plain)? };
        let value = number * factor;
        let row = value >= 1.0 && value.fract() == 0.0 && value < 1e9;
        (value.is_finite() && (self != Quantity::Row || row)).then_some(value)
    }
}

/// A unit as the tables above have it: no spaces, `*` between factors, `^` before powers.
fn normal(unit: &str) -> String {
    let mut text = String::new();
    for c in unit.chars().filter(|c| !c.is_whitespace()) {
        match c {
            '·' => text.push('*'),
            'µ' | 'μ' => text.push('u'),
            '²' => text.push_str("^2"),
            '³' => text.push_str("^3"),
            other => text.push(other),
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_are_read() {
        let cases = [
            (Quantity::Angle, "0.3 mrad", 0.3e-3),
            (Quantity::Angle, "-2e-4", -2e-4),
            (Quantity::Angle, "180deg", core::f64::consts::PI),
            (Quantity::Length, "30um", 30.0 * 1e-6),
            (Quantity::Length, "30 µm", 30.0 * 1e-6),
            (Quantity::AnglePerMoment, "1.5e-7 rad/(N·m)", 1.5e-7),
            (Quantity::AnglePerMoment, "1 urad/Nm", 1e-6),
            (Quantity::AnglePerMomentCubed, "-2e-13 rad/(N·m)³", -2e-13),
            (Quantity::LengthPerForceCubed, "1 um/N^3", 1e-6),
            (Quantity::LengthPerForce, "2 um/kN", 2.0 * (1e-6 / 1e3)),
            (Quantity::Flexibility, "3e-7 1/(N·m²)", 3e-7),
            (Quantity::Mass, "250 g", 0.25),
            (Quantity::Ratio, "2 %", 0.02),
            (Quantity::PerKelvin, "12 ppm/K", 12.0 * (1e-6 / 1.0)),
            (Quantity::LengthRate, "1 um/row", 1e-6),
            (Quantity::AnglePerKelvin, "20 urad/K", 20.0 * (1e-6 / 1.0)),
            (Quantity::Time, "8 ms", 8.0 * 1e-3),
            (Quantity::Row, "40", 40.0),
        ];
        for (quantity, text, expected) in cases {
            assert_eq!(quantity.read(text), Some(expected), "{text}");
        }
    }

    #[test]
    fn what_is_no_number_of_its_kind_is_not_read() {
        let cases = [
            (Quantity::Angle, "0.3 mm"),
            (Quantity::Angle, "mrad"),
            (Quantity::Angle, "nan"),
            (Quantity::Angle, "1e999"),
            (Quantity::Angle, ""),
            (Quantity::AnglePerMoment, "1e-7 rad"),
            (Quantity::AnglePerMomentCubed, "1e-7 rad/Nm"),
            (Quantity::Row, "1.5"),
            (Quantity::Row, "0"),
            (Quantity::Ratio, "1 m"),
        ];
        for (quantity, text) in cases {
            assert_eq!(quantity.read(text), None, "{text}");
        }
    }

    #[test]
    fn every_si_unit_is_one() {
        for quantity in Quantity::ALL {
            assert_eq!(quantity.read(&format!("3 {}", quantity.unit())), Some(3.0));
            assert!(!quantity.units().is_empty());
        }
    }
}
