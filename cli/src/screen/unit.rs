//! The units in which a diagnosis is shown: those that people use, inches where the file has them.

use super::Screen;
use crate::terminal::text::{decimals, minus};

pub(super) const INCH: f64 = 0.0254;
pub(super) const POUND: f64 = 4.448_221_615_260_5;

/// A unit to show numbers of one quantity in, all with the same digits behind the point.
#[derive(Clone, Copy)]
pub(super) struct Shown {
    pub(super) name: &'static str,
    pub(super) size: f64,
    pub(super) decimals: usize,
}

impl Shown {
    pub(super) fn number(self, si: f64) -> String {
        minus(format!("{:.*}", self.decimals, si / self.size))
    }

    pub(super) fn with_unit(self, si: f64) -> String {
        format!("{} {}", self.number(si), self.name)
    }
}

impl Screen<'_> {
    /// Translations: thousandths of an inch where the file has inches.
    pub(super) fn length(&self, least: f64, most: f64) -> Shown {
        let inches = self.data.measured_in[..3].iter().flatten().any(|unit| unit.name == "in");
        let (name, size) = match (inches, most) {
            (true, _) => ("mil", 1e-3 * INCH),
            (false, most) if most < 2e-4 => ("µm", 1e-6),
            (false, most) if most < 2.0 => ("mm", 1e-3),
            (false, _) => ("m", 1.0),
        };
        Shown { name, size, decimals: digits(least / size) }
    }

    pub(super) fn angle(&self, least: f64, most: f64) -> Shown {
        let (name, size) = if most < 2e-4 { ("µrad", 1e-6) } else { ("mrad", 1e-3) };
        Shown { name, size, decimals: digits(least / size) }
    }

    /// The unit of what is judged first: translations, or rotations if there are none.
    pub(super) fn main(&self) -> Shown {
        let (before, after) = (&self.found.gap.before, &self.found.gap.after);
        if self.measures(0..3) {
            self.length(before.position_rms.min(after.position_rms), before.position_rms)
        } else {
            self.angle(before.rotation_rms.min(after.rotation_rms), before.rotation_rms)
        }
    }

    pub(super) fn measures(&self, which: std::ops::Range<usize>) -> bool {
        self.data.kind.components()[which].contains(&true)
    }

    pub(super) fn pounds(&self) -> bool {
        let units = self.data.wrench_in.iter().chain(&self.data.measured_in).flatten();
        units.into_iter().any(|unit| unit.name == "lbf" || unit.name == "in")
    }
}

/// Two significant digits of the smallest number that is shown, three at most behind the point.
fn digits(least: f64) -> usize {
    decimals(least, 2).min(3)
}
