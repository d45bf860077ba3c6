//! Found numbers in the units that people use.

use stiffarm_gap::report::{Finding, Parameter};

use super::Screen;
use crate::terminal::text::short;

/// A unit of the screen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Size<'a> {
    pub name: &'a str,
    /// What one of it is in SI.
    pub si: f64,
}

/// Below this a thousandth of the unit is shown.
const SMALL: f64 = 2e-4;

const HOUR: f64 = 3600.0;

impl<'a> Size<'a> {
    /// The unit for numbers up to `most`; one that is not known here stays as it is.
    pub fn of(unit: &'a str, most: f64) -> Size<'a> {
        let size = |name, si| Size { name, si };
        let by = |small, large| if most < SMALL { size(small, 1e-6) } else { size(large, 1e-3) };
        match unit {
            "m" => by("µm", "mm"),
            "rad" => by("µrad", "mrad"),
            "rad/rad" => by("µrad/rad", "mrad/rad"),
            "rad/(N·m)" => by("µrad/(N·m)", "mrad/(N·m)"),
            "m/N" => by("µm/N", "mm/N"),
            "rad/m" => by("µrad/m", "mrad/m"),
            "m/rad" => by("µm/rad", "mm/rad"),
            "m/row" => by("µm/row", "mm/row"),
            "rad/row" => by("µrad/row", "mrad/row"),
            "m/s" => size("µm/h", 1e-6 / HOUR),
            "rad/s" => size("µrad/h", 1e-6 / HOUR),
            "rad/K" => by("µrad/K", "mrad/K"),
            "m/K" => by("µm/K", "mm/K"),
            "s" => size("ms", 1e-3),
            "1/K" => size("ppm/K", 1e-6),
            "1" if most < 1e-3 => size("ppm", 1e-6),
            "1" => size("%", 1e-2),
            "rows" => size("", 1.0),
            other => size(other, 1.0),
        }
    }

    /// A number in SI.
    pub fn number(self, si: f64) -> String {
        short(si / self.si)
    }

    /// A number in SI, with the unit.
    pub fn with_unit(self, si: f64) -> String {
        let space = if self.name.is_empty() { "" } else { " " };
        format!("{}{space}{}", self.number(si), self.name)
    }
}

impl Screen<'_> {
    /// The unit for all numbers of a finding that have the unit of `p`.
    pub(super) fn size<'a>(&self, finding: &Finding, p: &'a Parameter) -> Size<'a> {
        let alike = finding.parameters.iter().filter(|other| other.unit == p.unit);
        let most = alike.map(|other| other.value.abs()).fold(0.0, f64::max);
        self.unit(finding, &p.unit, most)
    }

    /// The unit for numbers up to `most`, inches where the file has them.
    pub(super) fn unit<'a>(&self, finding: &Finding, unit: &'a str, most: f64) -> Size<'a> {
        match unit {
            "m" => {
                let shown = self.length(most, most);
                Size { name: shown.name, si: shown.size }
            }
            other => {
                let shown = self.effect(finding).map_or(other, |effect| effect.shown_in(other));
                Size::of(shown, most)
            }
        }
    }
}
