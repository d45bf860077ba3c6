//! What the columns of a log hold, and the units that may stand in brackets behind their names.

use stiffarm_kernels::Motion;

use crate::measurement::{Dimension, Unit};

/// What a column holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Quantity {
    Time,
    /// A joint's value differentiated so many times by time, 0 to 2.
    Motion(Motion, usize),
    /// What drives a joint: a moment, of a prismatic one a force.
    Drive(Motion),
    Current,
    Temperature,
    Force,
    Moment,
}

/// SI value = factor · value + offset.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Scale {
    pub factor: f64,
    pub offset: f64,
}

impl Scale {
    pub(super) const SI: Scale = Scale { factor: 1.0, offset: 0.0 };

    pub(super) fn to_si(self, value: f64) -> f64 {
        self.factor * value + self.offset
    }
}

/// How a rate and an acceleration end.
const PER: [&[&str]; 3] = [&[""], &["/s"], &["/s^2", "/s²", "/s2"]];

impl Quantity {
    /// What a unit of this quantity is in SI; `None` if it is none.
    pub(super) fn scale(self, unit: &str) -> Option<Scale> {
        let (dimension, order) = match self {
            Quantity::Time => (Dimension::Time, 0),
            Quantity::Motion(Motion::Revolute, order) => (Dimension::Angle, order),
            Quantity::Motion(Motion::Prismatic, order) => (Dimension::Length, order),
            Quantity::Drive(Motion::Revolute) | Quantity::Moment => (Dimension::Moment, 0),
            Quantity::Drive(Motion::Prismatic) | Quantity::Force => (Dimension::Force, 0),
            Quantity::Temperature => (Dimension::Temperature, 0),
            Quantity::Current => {
                let factor = [("A", 1.0), ("mA", 1e-3)].into_iter().find(|(name, _)| *name == unit);
                return factor.map(|(_, factor)| Scale { factor, offset: 0.0 });
            }
        };
        let small = [("ms", 1e-3), ("us", 1e-6), ("ns", 1e-9)];
        if let (Dimension::Time, Some((_, factor))) =
            (dimension, small.into_iter().find(|(name, _)| *name == unit))
        {
            return Some(Scale { factor, offset: 0.0 });
        }
        let base = PER[order].iter().find_map(|end| unit.strip_suffix(end))?;
        let unit = Unit::named(&base.replace('*', "·")).filter(|u| u.dimension == dimension)?;
        Some(Scale { factor: unit.factor, offset: unit.offset })
    }

    /// Units that it may have, for messages.
    pub(super) fn units(self) -> &'static str {
        match self {
            Quantity::Time => "s, ms, us, ns",
            Quantity::Motion(Motion::Revolute, 0) => "rad, deg, mrad",
            Quantity::Motion(Motion::Revolute, 1) => "rad/s, deg/s, mrad/s",
            Quantity::Motion(Motion::Revolute, _) => "rad/s^2, deg/s^2, mrad/s^2",
            Quantity::Motion(Motion::Prismatic, 0) => "m, mm, um, in",
            Quantity::Motion(Motion::Prismatic, 1) => "m/s, mm/s, um/s, in/s",
            Quantity::Motion(Motion::Prismatic, _) => "m/s^2, mm/s^2, um/s^2, in/s^2",
            Quantity::Drive(Motion::Revolute) | Quantity::Moment => "N*m, Nmm",
            Quantity::Drive(Motion::Prismatic) | Quantity::Force => "N, kN, lbf, kgf",
            Quantity::Current => "A, mA",
            Quantity::Temperature => "degC, K",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_are_told_in_si() {
        let of = |quantity: Quantity, unit: &str| quantity.scale(unit).map(|s| s.to_si(2.0));
        let turn = |order| Quantity::Motion(Motion::Revolute, order);
        assert_eq!(of(turn(0), "deg"), Some(2.0 * core::f64::consts::PI / 180.0));
        assert_eq!(of(turn(1), "mrad/s"), Some(2e-3));
        assert_eq!(of(turn(2), "rad/s^2"), Some(2.0));
        assert_eq!(of(Quantity::Motion(Motion::Prismatic, 1), "mm/s"), Some(2e-3));
        assert_eq!(of(Quantity::Drive(Motion::Revolute), "N*m"), Some(2.0));
        assert_eq!(of(Quantity::Current, "mA"), Some(2e-3));
        assert_eq!(of(Quantity::Temperature, "K"), Some(2.0 - 273.15));
        assert_eq!(of(Quantity::Time, "ms"), Some(2e-3));
        for (quantity, unit) in
            [(turn(1), "rad"), (turn(0), "mm"), (Quantity::Drive(Motion::Prismatic), "N*m")]
        {
            assert_eq!(of(quantity, unit), None, "{unit}");
        }
    }

    /// What messages offer is taken.
    #[test]
    fn every_unit_that_is_offered_is_known() {
        let motions = [Motion::Revolute, Motion::Prismatic];
        let all = motions.into_iter().flat_map(|m| {
            let orders = (0..3).map(move |order| Quantity::Motion(m, order));
            orders.chain([Quantity::Drive(m)])
        });
        let others = [Quantity::Time, Quantity::Current, Quantity::Temperature];
        for quantity in all.chain(others).chain([Quantity::Force, Quantity::Moment]) {
            for unit in quantity.units().split(", ") {
                assert!(quantity.scale(unit).is_some(), "{quantity:?} in {unit}");
            }
        }
    }
}
