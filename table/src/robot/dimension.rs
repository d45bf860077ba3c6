//! The kinds of quantity that a robot's table holds.

use core::fmt;

use super::model::Motion;

/// Exponents of length, mass, time and angle.
pub(crate) type Powers = [i32; 4];

/// The kinds, one to a line: the SI unit in which the table keeps the quantity, its exponents, an example, and what it is
/// in words.
macro_rules! dimensions {
    ($($(#[$doc:meta])* $name:ident: $unit:literal, $powers:expr, $example:literal, $words:literal;)*) => {
        /// What kind of quantity a cell, and so a symbolic parameter, holds.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub enum Dimension {
            $($(#[$doc])* $name,)*
        }

        const ALL: &[Dimension] = &[$(Dimension::$name),*];

        impl Dimension {
            /// Unit, exponents, example, words.
            fn row(self) -> (&'static str, Powers, &'static str, &'static str) {
                match self {
                    $(Dimension::$name => ($unit, $powers, $example, $words),)*
                }
            }
        }
    };
}

dimensions! {
    /// `d`, `a`, a centre of mass, a tool's translation: m.
    Length: "m", [1, 0, 0, 0], "350 mm", "a length";
    /// `theta`, `alpha`: rad.
    Angle: "rad", [0, 0, 0, 1], "90 deg", "an angle";
    /// A link's mass: kg.
    Mass: "kg", [0, 1, 0, 0], "120 kg", "a mass";
    /// Gravity: m/s².
    Acceleration: "m/s²", [1, 0, -2, 0], "9.80665 m/s^2", "an acceleration";
    /// Stiffness of a revolute joint: N·m/rad.
    AngularStiffness: "N·m/rad", [2, 1, -2, -1], "3.8e6 N*m/rad", "a torque per angle";
    /// Stiffness of a prismatic joint: N/m.
    LinearStiffness: "N/m", [0, 1, -2, 0], "2e7 N/m", "a force per length";
    /// An elastic modulus: Pa.
    Pressure: "Pa", [-1, 1, -2, 0], "69 GPa", "a pressure";
    /// A cross-section's area: m².
    Area: "m²", [2, 0, 0, 0], "24 cm^2", "an area";
    /// A cross-section's second moment or torsion constant: m⁴.
    SecondMoment: "m⁴", [4, 0, 0, 0], "5.2e6 mm^4", "a second moment of area";
    /// A material's density: kg/m³.
    Density: "kg/m³", [-3, 1, 0, 0], "2700 kg/m^3", "a density";
    /// A moment of inertia: kg·m².
    Inertia: "kg·m²", [2, 1, 0, 0], "0.35 kg*m^2", "a moment of inertia";
    /// A torque: N·m.
    Torque: "N·m", TORQUE, "12 N*m", "a torque";
    /// A force: N.
    Force: "N", [1, 1, -2, 0], "80 N", "a force";
    /// Viscous friction of a revolute joint: N·m·s/rad.
    AngularDamping: "N·m·s/rad", [2, 1, -1, -1], "5 N*m*s/rad", "a torque per angular speed";
    /// Viscous friction of a prismatic joint: N·s/m.
    LinearDamping: "N·s/m", [0, 1, -1, 0], "300 N*s/m", "a force per speed";
    /// The gear of a prismatic joint: rad/m.
    TurnPerLength: "rad/m", [-1, 0, 0, 1], "628 rad/m", "an angle per length";
    /// A pure number, such as a shear coefficient.
    Ratio: "", [0; 4], "0.85", "a pure number";
}

impl Dimension {
    /// Of a joint that turns the one, of a joint that slides the other.
    fn by(motion: Motion, [revolute, prismatic]: [Dimension; 2]) -> Dimension {
        match motion {
            Motion::Revolute => revolute,
            Motion::Prismatic => prismatic,
        }
    }

    /// What the stiffness of a joint is measured as.
    pub fn stiffness(motion: Motion) -> Dimension {
        Dimension::by(motion, [Dimension::AngularStiffness, Dimension::LinearStiffness])
    }

    /// What the load on a joint, and so its dry friction, is measured as.
    pub fn load(motion: Motion) -> Dimension {
        Dimension::by(motion, [Dimension::Torque, Dimension::Force])
    }

    /// What the viscous friction of a joint is measured as.
    pub fn damping(motion: Motion) -> Dimension {
        Dimension::by(motion, [Dimension::AngularDamping, Dimension::LinearDamping])
    }

    /// What the gear of a joint is measured as.
    pub fn gear(motion: Motion) -> Dimension {
        Dimension::by(motion, [Dimension::Ratio, Dimension::TurnPerLength])
    }

    /// What the travel of a joint is measured as.
    pub(crate) fn displacement(motion: Motion) -> Dimension {
        Dimension::by(motion, [Dimension::Angle, Dimension::Length])
    }

    /// The SI unit in which the table keeps the quantity; empty for a pure number.
    pub fn unit(self) -> &'static str {
        self.row().0
    }

    pub(crate) fn powers(self) -> Powers {
        self.row().1
    }

    /// Whether a unit of these powers measures this quantity. Per radian may be left out: a torque stands
    /// for a torque per radian.
    pub(crate) fn fits(self, powers: Powers) -> bool {
        let [length, mass, time, angle] = self.powers();
        self.powers() == powers || (angle < 0 && powers == [length, mass, time, 0])
    }

    pub(crate) fn example(self) -> &'static str {
        self.row().2
    }
}

impl fmt::Display for Dimension {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.row().3)
    }
}

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
