//! The kinds of quantity that a robot's table holds.

use core::fmt;

use super::model::Motion;

/// Exponents of length, mass, time and angle.
pub(crate) type Powers = [i32; 4];

/// What kind of quantity a cell, and so a symbolic parameter, holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Dimension {
    /// `d`, `a`, a centre of mass, a tool's translation: m.
    Length,
    /// `theta`, `alpha`: rad.
    Angle,
    /// A link's mass: kg.
    Mass,
    /// Gravity: m/s².
    Acceleration,
    /// Stiffness of a revolute joint: N·m/rad.
    AngularStiffness,
    /// Stiffness of a prismatic joint: N/m.
    LinearStiffness,
    /// An elastic modulus: Pa.
    Pressure,
    /// A cross-section's area: m².
    Area,
    /// A cross-section's second moment or torsion constant: m⁴.
    SecondMoment,
    /// A material's density: kg/m³.
    Density,
    /// A moment of inertia: kg·m².
    Inertia,
    /// A torque: N·m.
    Torque,
    /// A force: N.
    Force,
    /// Viscous friction of a revolute joint: N·m·s/rad.
    AngularDamping,
    /// Viscous friction of a prismatic joint: N·s/m.
    LinearDamping,
    /// The gear of a prismatic joint: rad/m.
    TurnPerLength,
    /// A pure number, such as a shear coefficient.
    Ratio,
}

impl Dimension {
    /// What the stiffness of a joint is measured as.
    pub fn stiffness(motion: Motion) -> Dimension {
        match motion {
            Motion::Revolute => Dimension::AngularStiffness,
            Motion::Prismatic => Dimension::LinearStiffness,
        }
    }

    /// What the load on a joint, and so its dry friction, is measured as.
    pub fn load(motion: Motion) -> Dimension {
        match motion {
            Motion::Revolute => Dimension::Torque,
            Motion::Prismatic => Dimension::Force,
        }
    }

    /// What the viscous friction of a joint is measured as.
    pub fn damping(motion: Motion) -> Dimension {
        match motion {
            Motion::Revolute => Dimension::AngularDamping,
            Motion::Prismatic => Dimension::LinearDamping,
        }
    }

    /// What the gear of a joint is measured as.
    pub fn gear(motion: Motion) -> Dimension {
        match motion {
            Motion::Revolute => Dimension::Ratio,
            Motion::Prismatic => Dimension::TurnPerLength,
        }
    }

    /// What the travel of a joint is measured as.
    pub(crate) fn displacement(motion: Motion) -> Dimension {
        match motion {
            Motion::Revolute => Dimension::Angle,
            Motion::Prismatic => Dimension::Length,
        }
    }

    /// The SI unit in which the table keeps the quantity; empty for a pure number.
    pub fn unit(self) -> &'static str {
        match self {
            Dimension::Length => "m",
            Dimension::Angle => "rad",
            Dimension::Mass => "kg",
            Dimension::Acceleration => "m/s²",
            Dimension::AngularStiffness => "N·m/rad",
            Dimension::LinearStiffness => "N/m",
            Dimension::Pressure => "Pa",
            Dimension::Area => "m²",
            Dimension::SecondMoment => "m⁴",
            Dimension::Density => "kg/m³",
            Dimension::Inertia => "kg·m²",
            Dimension::Torque => "N·m",
            Dimension::Force => "N",
            Dimension::AngularDamping => "N·m·s/rad",
            Dimension::LinearDamping => "N·s/m",
            Dimension::TurnPerLength => "rad/m",
            Dimension::Ratio => "",
        }
    }

    pub(crate) fn powers(self) -> Powers {
        match self {
            Dimension::Length => [1, 0, 0, 0],
            Dimension::Angle => [0, 0, 0, 1],
            Dimension::Mass => [0, 1, 0, 0],
            Dimension::Acceleration => [1, 0, -2, 0],
            Dimension::AngularStiffness => [2, 1, -2, -1],
            Dimension::LinearStiffness => [0, 1, -2, 0],
            Dimension::Pressure => [-1, 1, -2, 0],
            Dimension::Area => [2, 0, 0, 0],
            Dimension::SecondMoment => [4, 0, 0, 0],
            Dimension::Density => [-3, 1, 0, 0],
            Dimension::Inertia => [2, 1, 0, 0],
            Dimension::Torque => TORQUE,
            Dimension::Force => [1, 1, -2, 0],
            Dimension::AngularDamping => [2, 1, -1, -1],
            Dimension::LinearDamping => [0, 1, -1, 0],
            Dimension::TurnPerLength => [-1, 0, 0, 1],
            Dimension::Ratio => [0; 4],
        }
    }

    /// Whether a unit of these powers measures this quantity. Per radian may be left out: a torque stands
    /// for a torque per radian.
    pub(crate) fn fits(self, powers: Powers) -> bool {
        let [length, mass, time, angle] = self.powers();
        self.powers() == powers || (angle < 0 && powers == [length, mass, time, 0])
    }

    pub(crate) fn example(self) -> &'static str {
        match self {
            Dimension::Length => "350 mm",
            Dimension::Angle => "90 deg",
            Dimension::Mass => "120 kg",
            Dimension::Acceleration => "9.80665 m/s^2",
            Dimension::AngularStiffness => "3.8e6 N*m/rad",
            Dimension::LinearStiffness => "2e7 N/m",
            Dimension::Pressure => "69 GPa",
            Dimension::Area => "24 cm^2",
            Dimension::SecondMoment => "5.2e6 mm^4",
            Dimension::Density => "2700 kg/m^3",
            Dimension::Inertia => "0.35 kg*m^2",
            Dimension::Torque => "12 N*m",
            Dimension::Force => "80 N",
            Dimension::AngularDamping => "5 N*m*s/rad",
            Dimension::LinearDamping => "300 N*s/m",
            Dimension::TurnPerLength => "628 rad/m",
            Dimension::Ratio => "0.85",
        }
    }
}

impl fmt::Display for Dimension {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Dimension::Length => "a length",
            Dimension::Angle => "an angle",
            Dimension::Mass => "a mass",
            Dimension::Acceleration => "an acceleration",
            Dimension::AngularStiffness => "a torque per angle",
            Dimension::LinearStiffness => "a force per length",
            Dimension::Pressure => "a pressure",
            Dimension::Area => "an area",
            Dimension::SecondMoment => "a second moment of area",
            Dimension::Density => "a density",
            Dimension::Inertia => "a moment of inertia",
            Dimension::Torque => "a torque",
            Dimension::Force => "a force",
            Dimension::AngularDamping => "a torque per angular speed",
            Dimension::LinearDamping => "a force per speed",
            Dimension::TurnPerLength => "an angle per length",
            Dimension::Ratio => "a pure number",
        })
    }
}

const ALL: [Dimension; 17] = [
    Dimension::Length,
    Dimension::Angle,
    Dimension::Mass,
    Dimension::Acceleration,
    Dimension::AngularStiffness,
    Dimension::LinearStiffness,
    Dimension::Pressure,
    Dimension::Area,
    Dimension::SecondMoment,
    Dimension::Density,
    Dimension::Inertia,
    Dimension::Torque,
    Dimension::Force,
    Dimension::AngularDamping,
    Dimension::LinearDamping,
    Dimension::TurnPerLength,
    Dimension::Ratio,
];

const TORQUE: Powers = [2, 1, -2, 0];

/// What a unit of these powers measures, in words: `a mass`, `a quantity in kg·m/s`.
pub(crate) fn describe(powers: Powers) -> String {
    if let Some(dimension) = ALL.iter().find(|d| d.powers() == powers) {
        return dimension.to_string();
    }
    match powers {
        [0, 0, 1, 0] => "a time".to_owned(),
        [1, 0, -1, 0] => "a speed".to_owned(),
        [3, 0, 0, 0] => "a volume".to_owned(),
        _ => {
            let factors: Vec<String> = ["m", "kg", "s", "rad"]
                .iter()
                .zip(powers)
                .filter(|(_, p)| *p != 0)
                .map(|(unit, p)| if p == 1 { (*unit).to_owned() } else { format!("{unit}^{p}") })
                .collect();
            format!("a quantity in {}", factors.join("*"))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_are_described() {
        assert_eq!(describe([0, 1, 0, 0]), "a mass");
        assert_eq!(describe([1, 1, -2, 0]), "a force");
        assert_eq!(describe([1, 0, -3, 0]), "a quantity in m*s^-3");
        for dimension in ALL {
            assert_eq!(describe(dimension.powers()), dimension.to_string());
        }
    }

    #[test]
    fn a_torque_serves_as_a_torsional_stiffness_only() {
        assert!(Dimension::AngularStiffness.fits(TORQUE));
        assert!(!Dimension::LinearStiffness.fits(TORQUE));
        assert!(Dimension::Length.fits([1, 0, 0, 0]));
    }
}
