//! The parameters that a table leaves symbolic: listing them, and giving them numbers.

use super::decimal;
use super::dimension::Dimension;
use super::model::{Angle, Drive, Joint, Robot, Value};

/// A parameter that stays symbolic.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Symbol {
    /// Its name, as the table spells it.
    pub name: String,
    /// What it measures; [`Dimension::unit`] is its SI unit.
    pub dimension: Dimension,
}

/// A cell that may be a parameter.
pub(crate) trait Symbolic {
    /// The parameter's name.
    fn symbol(&self) -> Option<&str>;
}

impl Symbolic for Value {
    fn symbol(&self) -> Option<&str> {
        match self {
            Value::Symbol(name) => Some(name),
            Value::Number(_) => None,
        }
    }
}

impl Symbolic for Angle {
    fn symbol(&self) -> Option<&str> {
        match self {
            Angle::Symbol(name) => Some(name),
            Angle::Pi(_) | Angle::Radians(_) => None,
        }
    }
}

/// A cell of the model that may be a parameter.
enum Slot<'a> {
    Value(&'a mut Value),
    Angle(&'a mut Angle),
}

impl Slot<'_> {
    fn symbol(&self) -> Option<&str> {
        match self {
            Slot::Value(value) => value.symbol(),
            Slot::Angle(angle) => angle.symbol(),
        }
    }
}

type Visit<'v> = &'v mut dyn FnMut(Slot<'_>, Dimension);

fn values<'a>(
    visit: Visit<'_>,
    dimension: Dimension,
    cells: impl IntoIterator<Item = &'a mut Value>,
) {
    cells.into_iter().for_each(|cell| visit(Slot::Value(cell), dimension));
}

impl Robot {
    /// The symbolic parameters, each once, in order of first appearance: gravity, the joints row by
    /// row (theta, d, a, alpha, beta, stiffness, mass, com, inertia, drive, beam), the tool.
    pub fn symbols(&self) -> Vec<Symbol> {
        let mut found: Vec<Symbol> = Vec::new();
        self.clone().each_slot(&mut |slot, dimension| {
            if let Some(name) = slot.symbol()
                && found.iter().all(|known| known.name != name)
            {
                found.push(Symbol { name: name.to_owned(), dimension });
            }
        });
        found
    }

    /// The robot with a number (in SI units) for every symbolic parameter. An angle that is the
    /// nearest double to a multiple kπ/n (n ≤ 12) becomes that multiple.
    ///
    /// # Errors
    /// The names of the parameters for which `value` gives nothing, or nothing finite.
    pub fn with_parameters(
        &self,
        value: impl Fn(&str) -> Option<f64>,
    ) -> Result<Robot, Vec<String>> {
        let mut robot = self.clone();
        let mut missing: Vec<String> = Vec::new();
        robot.each_slot(&mut |slot, _| {
            let Some(name) = slot.symbol().map(str::to_owned) else { return };
            let given = value(&name);
            match (slot, given.and_then(decimal::of_double), given.and_then(Angle::from_radians)) {
                (Slot::Value(value), Some(number), _) => *value = Value::Number(number),
                (Slot::Angle(angle), _, Some(radians)) => *angle = radians,
                _ if missing.contains(&name) => {}
                _ => missing.push(name),
            }
        });
        if missing.is_empty() { Ok(robot) } else { Err(missing) }
    }

    fn each_slot(&mut self, visit: Visit<'_>) {
        values(visit, Dimension::Acceleration, &mut self.gravity);
        for joint in &mut self.joints {
            joint.each_slot(visit);
        }
        values(visit, Dimension::Length, &mut self.tool.translation);
    }
}

impl Joint {
    fn each_slot(&mut self, visit: Visit<'_>) {
        visit(Slot::Angle(&mut self.theta), Dimension::Angle);
        values(visit, Dimension::Length, [&mut self.d, &mut self.a]);
        visit(Slot::Angle(&mut self.alpha), Dimension::Angle);
        visit(Slot::Angle(&mut self.beta), Dimension::Angle);
        values(visit, Dimension::stiffness(self.motion), &mut self.stiffness);
        values(visit, Dimension::Mass, &mut self.mass);
        values(visit, Dimension::Length, &mut self.com);
        values(visit, Dimension::Inertia, self.inertia.iter_mut().flatten());
        let Drive { gear, rotor_inertia, coulomb, viscous } = &mut self.drive;
        values(visit, Dimension::gear(self.motion), gear);
        values(visit, Dimension::Inertia, rotor_inertia);
        values(visit, Dimension::load(self.motion), coulomb);
        values(visit, Dimension::damping(self.motion), viscous);
        if let Some(beam) = &mut self.beam {
            let moduli = [&mut beam.youngs_modulus, &mut beam.shear_modulus];
            values(visit, Dimension::Pressure, moduli);
            let section = &mut beam.section;
            values(visit, Dimension::Area, [&mut section.area]);
            let moments = [&mut section.iy, &mut section.iz, &mut section.j];
            values(visit, Dimension::SecondMoment, moments);
            values(visit, Dimension::Density, &mut beam.density);
            values(visit, Dimension::Ratio, &mut beam.shear_coefficient);
        }
    }
}

#[cfg(test)]
mod tests {
    use num_rational::Ratio;

    use super::*;
    use crate::number::Number;

    const TEXT: &str = r#"
        name = "x"
        convention = "modified"
        [[joint]]
        type = "prismatic"
        theta = "t"
        d = "L1"
        a = "a2"
        stiffness = "k"
        mass = "m"
        com = ["a2", 0, 0]
        [joint.beam]
        youngs_modulus = "E"
        shear_modulus = "G"
        section = { area = "A", iy = "I", iz = "I", j = "J" }
        shear_coefficient = "kappa"
        [tool]
        translation = [0, 0, "z"]
    "#;

    #[test]
    fn symbols_stand_in_order_with_their_dimensions() {
        let robot = Robot::from_toml(TEXT, "x").unwrap().0;
        let found: Vec<_> =
            robot.symbols().into_iter().map(|s| (s.name, s.dimension.unit())).collect();
        let expected = [
            ("t", "rad"),
            ("L1", "m"),
            ("a2", "m"),
            ("k", "N/m"),
            ("m", "kg"),
            ("E", "Pa"),
            ("G", "Pa"),
            ("A", "m²"),
            ("I", "m⁴"),
            ("J", "m⁴"),
            ("kappa", ""),
            ("z", "m"),
        ];
        assert_eq!(found, expected.map(|(name, unit)| (name.to_owned(), unit)));
    }

    #[test]
    fn parameters_are_replaced_by_numbers() {
        let robot = Robot::from_toml(TEXT, "x").unwrap().0;
        let full = robot
            .with_parameters(|name| {
                Some(if name == "t" { core::f64::consts::PI / 3.0 } else { 0.1 })
            })
            .unwrap();
        assert_eq!(full.symbols(), []);
        assert_eq!(full.joints[0].theta, Angle::Pi(Ratio::new(1, 3)));
        assert_eq!(full.joints[0].com[0], Value::Number(Number::ratio(1, 10)));
    }

    #[test]
    fn missing_parameters_are_named_once() {
        let robot = Robot::from_toml(TEXT, "x").unwrap().0;
        let given = |name: &str| match name {
            "a2" | "I" => None,
            "t" => Some(f64::NAN),
            _ => Some(1.0),
        };
        assert_eq!(robot.with_parameters(given), Err(vec!["t".into(), "a2".into(), "I".into()]));
    }
}
