//! Numbers in the units that people use: inches and pounds where the data have them.

use stiffarm_gap::Measurements;
use stiffarm_gap::gap::Statistics;
use stiffarm_gap::instrument::View;
use stiffarm_gap::io::{INCH, POUND};
use stiffarm_gap::measurement::Row;

use crate::text::{decimals, fixed, short};

/// Below this a thousandth of the unit is shown.
const SMALL: f64 = 2e-4;

const HOUR: f64 = 3600.0;

/// A unit in which numbers are shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unit<'a> {
    /// As it stands behind a number.
    pub name: &'a str,
    /// Its size in SI.
    pub si: f64,
    /// Digits behind the point; `None` for three significant digits.
    pub decimals: Option<usize>,
}

impl<'a> Unit<'a> {
    fn new(name: &'a str, si: f64) -> Unit<'a> {
        Unit { name, si, decimals: None }
    }

    /// The unit for numbers up to `most`; one that is not known here stays as it is.
    pub fn of(unit: &'a str, most: f64) -> Unit<'a> {
        let by = |small, large| match most < SMALL {
            true => Unit::new(small, 1e-6),
            false => Unit::new(large, 1e-3),
        };
        match unit {
            "m" if most >= 2.0 => Unit::new("m", 1.0),
            "m" => by("µm", "mm"),
            "rad" => by("µrad", "mrad"),
            "rad/rad" => by("µrad/rad", "mrad/rad"),
            "rad/(N·m)" => by("µrad/(N·m)", "mrad/(N·m)"),
            "m/N" => by("µm/N", "mm/N"),
            "rad/m" => by("µrad/m", "mrad/m"),
            "m/rad" => by("µm/rad", "mm/rad"),
            "m/row" => by("µm/row", "mm/row"),
            "rad/row" => by("µrad/row", "mrad/row"),
            "m/s" => Unit::new("µm/h", 1e-6 / HOUR),
            "rad/s" => Unit::new("µrad/h", 1e-6 / HOUR),
            "rad/K" => by("µrad/K", "mrad/K"),
            "m/K" => by("µm/K", "mm/K"),
            "s" => Unit::new("ms", 1e-3),
            "1/K" => Unit::new("ppm/K", 1e-6),
            "1" if most < 1e-3 => Unit::new("ppm", 1e-6),
            "1" => Unit::new("%", 1e-2),
            "rows" => Unit::new("", 1.0),
            other => Unit::new(other, 1.0),
        }
    }

    /// The same with two significant digits of `least`, three behind the point at most, for all numbers.
    fn down_to(self, least: f64) -> Unit<'a> {
        Unit { decimals: Some(decimals(least / self.si, 2).min(3)), ..self }
    }

    /// A number in SI as one of this unit, without its name.
    pub fn number(self, si: f64) -> String {
        self.decimals.map_or_else(|| short(si / self.si), |digits| fixed(si / self.si, digits))
    }

    /// A number in SI, with the unit.
    pub fn with_unit(self, si: f64) -> String {
        let space = if self.name.is_empty() { "" } else { " " };
        format!("{}{space}{}", self.number(si), self.name)
    }

    /// From one to the other.
    pub fn change(self, from: f64, to: f64) -> String {
        format!("{} → {}", self.number(from), self.with_unit(to))
    }

    /// A number with its 95 % interval: three digits, or as many as the interval says something about.
    pub fn interval(self, value: f64, [low, high]: [f64; 2]) -> String {
        let (shown, half) = (value.abs() / self.si, (high - low).abs() / (2.0 * self.si));
        let plain = (1e-3..1e4).contains(&shown.max(half));
        let told = [(shown, 3), (half, 2)].into_iter().filter(|(x, _)| *x > 0.0);
        let digits = told.map(|(x, digits)| decimals(x, digits)).min().unwrap_or(0);
        let number = |x: f64| match plain {
            true => fixed(x / self.si, digits),
            false => short(x / self.si),
        };
        format!("{} {} [{} to {}]", number(value), self.name, number(low), number(high))
            .replace("  ", " ")
    }
}

/// Of which units some data are.
#[derive(Clone, Copy, Debug)]
pub struct Units {
    inches: bool,
    /// Whether loads are in pounds, or lengths in inches.
    pub pounds: bool,
    /// Whether positions are measured; else rotations are what is judged.
    pub positions: bool,
    /// Pixels in a radian, where a camera's are all that is measured.
    pub pixels: Option<f64>,
}

impl Units {
    /// By the units in which the file has its cells.
    pub fn of(data: &Measurements) -> Units {
        let mut all = data.wrench_in.iter().chain(&data.measured_in).flatten();
        let mut lengths = data.measured_in[..3].iter().flatten();
        Units {
            inches: lengths.any(|unit| unit.name == "in"),
            pounds: all.any(|unit| unit.name == "lbf" || unit.name == "in"),
            positions: data.kind.components()[..3].contains(&true),
            pixels: pixels(data),
        }
    }

    /// Lengths between two sizes: thousandths of an inch where the file has inches.
    pub fn length(self, sizes: [f64; 2]) -> Unit<'static> {
        let [least, most] = ordered(sizes);
        let unit = if self.inches { Unit::new("mil", 1e-3 * INCH) } else { Unit::of("m", most) };
        unit.down_to(least)
    }

    /// Angles between two sizes.
    pub fn angle(self, sizes: [f64; 2]) -> Unit<'static> {
        let [least, most] = ordered(sizes);
        let unit = self.pixels.map(|pixels| Unit::new("px", 1.0 / pixels));
        unit.unwrap_or(Unit::of("rad", most)).down_to(least)
    }

    /// What is judged, between two sizes: lengths, or angles where no position is measured.
    pub fn main(self, sizes: [f64; 2]) -> Unit<'static> {
        if self.positions { self.length(sizes) } else { self.angle(sizes) }
    }

    /// What is judged.
    pub fn error(self) -> &'static str {
        match self {
            Units { positions: true, .. } => "position error",
            Units { pixels: Some(_), .. } => "error in the picture",
            _ => "rotation error",
        }
    }

    /// Its size, rms, m (rad without positions).
    pub fn judged(self, sizes: &Statistics) -> f64 {
        if self.positions { sizes.position_rms } else { sizes.rotation_rms }
    }

    /// A parameter in SI, as large as `most`.
    pub fn parameter<'a>(self, unit: &'a str, most: f64) -> Unit<'a> {
        match unit {
            "m" => Unit { decimals: None, ..self.length([most, most]) },
            other => Unit::of(other, most),
        }
    }
}

/// Pixels in a radian of the one camera that has measured everything.
fn pixels(data: &Measurements) -> Option<f64> {
    let of_row = |row: &Row| match row.view(data.kind)? {
        View::Camera { lens, .. } => Some(lens.focus),
        _ => None,
    };
    let first = data.rows.first().and_then(of_row)?;
    data.rows.iter().all(|row| of_row(row) == Some(first)).then_some(first)
}

fn ordered([a, b]: [f64; 2]) -> [f64; 2] {
    [a.min(b), a.max(b)]
}

/// Stiffness and compliance of a joint in pounds and inches.
pub fn imperial(revolute: bool) -> [Unit<'static>; 2] {
    let (names, si) = match revolute {
        true => (["in·lbf/rad", "rad/(in·lbf)"], POUND * INCH),
        false => (["lbf/in", "in/lbf"], POUND / INCH),
    };
    [Unit::new(names[0], si), Unit::new(names[1], 1.0 / si)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_shown_in_units_of_their_size() {
        assert_eq!(Unit::of("m", 1.5e-4).with_unit(1.234e-4), "123 µm");
        assert_eq!(Unit::of("m", 1e-3).down_to(3.4e-5).change(1e-3, 3.4e-5), "1.000 → 0.034 mm");
        assert_eq!(Unit::of("1", 0.02).interval(0.02, [0.018, 0.022]), "2.00 % [1.80 to 2.20]");
        let undecided = Unit::of("rad", 0.295).interval(-4e-12, [-0.295, 0.295]);
        assert_eq!(undecided, "0 mrad [−295 to 295]");
        assert_eq!(Unit::of("rows", 3.0).interval(3.0, [2.0, 4.0]), "3.0 [2.0 to 4.0]");
        let stiffness = imperial(true)[0].interval(2.42e4, [2.25e4, 2.61e4]);
        assert_eq!(stiffness, "2.14e5 in·lbf/rad [1.99e5 to 2.31e5]");
    }
}
