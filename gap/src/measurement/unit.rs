//! The units that a column's header may carry, and what each is in SI.

use std::fmt;

/// What kind of quantity a column holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
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

const fn unit(name: &'static str, dimension: Dimension, factor: f64, offset: f64) -> Unit {
    Unit { name, dimension, factor, offset }
}

/// Every unit of the format.
pub const UNITS: [Unit; 16] = [
    unit("m", Dimension::Length, 1.0, 0.0),
    unit("mm", Dimension::Length, 1e-3, 0.0),
    unit("um", Dimension::Length, 1e-6, 0.0),
    unit("in", Dimension::Length, 0.0254, 0.0),
    unit("rad", Dimension::Angle, 1.0, 0.0),
    unit("deg", Dimension::Angle, core::f64::consts::PI / 180.0, 0.0),
    unit("mrad", Dimension::Angle, 1e-3, 0.0),
    unit("N", Dimension::Force, 1.0, 0.0),
    unit("kN", Dimension::Force, 1e3, 0.0),
    unit("lbf", Dimension::Force, 4.448_221_615_260_5, 0.0),
    unit("kgf", Dimension::Force, 9.806_65, 0.0),
    unit("Nm", Dimension::Moment, 1.0, 0.0),
    unit("Nmm", Dimension::Moment, 1e-3, 0.0),
    unit("degC", Dimension::Temperature, 1.0, 0.0),
    unit("K", Dimension::Temperature, 1.0, -273.15),
    unit("s", Dimension::Time, 1.0, 0.0),
];

impl Unit {
    /// The unit of that name, or of its sign (`µm`, `°`, `N·m`); names are case-sensitive.
    pub fn named(name: &str) -> Option<Unit> {
        let name = match name {
            // The micro sign and the Greek letter.
            "\u{b5}m" | "\u{3bc}m" => "um",
            "°" => "deg",
            "°C" => "degC",
            "N·m" => "Nm",
            "N·mm" => "Nmm",
            name => name,
        };
        UNITS.into_iter().find(|u| u.name == name)
    }

    /// A number of this unit in SI (temperatures in degrees Celsius).
    pub fn to_si(self, value: f64) -> f64 {
        self.factor * value + self.offset
    }
}

impl Dimension {
    /// The unit of a column whose header gives none.
    pub fn si(self) -> Unit {
        let (name, offset) = match self {
            Dimension::Length => ("m", 0.0),
            Dimension::Angle => ("rad", 0.0),
            Dimension::Force => ("N", 0.0),
            Dimension::Moment => ("Nm", 0.0),
            Dimension::Temperature => ("degC", 0.0),
            Dimension::Time => ("s", 0.0),
        };
        unit(name, self, 1.0, offset)
    }

    /// The names of its units, as an error message lists them: `m, mm, um, in`.
    pub fn units(self) -> String {
        let names: Vec<_> = UNITS.iter().filter(|u| u.dimension == self).map(|u| u.name).collect();
        names.join(", ")
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
        })
    }
}

/// The known unit most like `found`, if one is near.
pub(crate) fn nearest_unit(found: &str) -> Option<&'static str> {
    nearest(found, UNITS.iter().map(|u| u.name))
}

/// The candidate most like `found`: equal but for case, or within one edit (two if it is long).
pub(crate) fn nearest<'a>(
    found: &str,
    candidates: impl IntoIterator<Item = &'a str>,
) -> Option<&'a str> {
    let long = found.chars().count();
    let reach = if long >= 6 { 2 } else { 1 };
    candidates
        .into_iter()
        // An edit changes a length by one at most: nothing is compared in vain with a name of megabytes.
        .filter(|c| c.chars().count().abs_diff(long) <= reach)
        .filter_map(|c| {
            let distance = if c.eq_ignore_ascii_case(found) {
                0
            } else {
                strsim::damerau_levenshtein(found, c)
            };
            // Two short names that share no letter are no misspelling of each other.
            let related = distance == 0 || distance < long.max(c.len());
            (distance <= reach && related).then_some((distance, c))
        })
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, c)| c)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn converts_to_si() {
        let si = |name: &str, value| Unit::named(name).map(|u| u.to_si(value));
        assert_eq!(si("in", 10.0), Some(0.254));
        assert_eq!(si("deg", 180.0), Some(core::f64::consts::PI));
        assert_eq!(si("kgf", 1.0), Some(9.80665));
        assert_eq!(si("lbf", 1.0), Some(4.4482216152605));
        assert_eq!(si("K", 293.15), Some(20.0));
        assert_eq!(si("inch", 1.0), None);
        for (sign, name) in
            [("µm", "um"), ("μm", "um"), ("°", "deg"), ("°C", "degC"), ("N·m", "Nm")]
        {
            assert_eq!(
                (si(sign, 3.0), Unit::named(sign).is_some()),
                (si(name, 3.0), true),
                "{sign}"
            );
        }
    }

    #[test]
    fn every_dimension_has_its_si_unit_in_the_table() {
        for u in UNITS {
            let si = u.dimension.si();
            assert_eq!(Unit::named(si.name), Some(si));
        }
        assert_eq!(Dimension::Length.units(), "m, mm, um, in");
    }

    #[test]
    fn suggests_only_near_names() {
        assert_eq!(nearest_unit("Deg"), Some("deg"));
        assert_eq!(nearest_unit("degs"), Some("deg"));
        assert_eq!(nearest_unit("furlong"), None);
        assert_eq!(nearest_unit("x"), None);
    }
}
