//! The parameters that a table leaves symbolic: listing them, and giving them numbers.

use super::field::{Field, Slot};
use super::fields::{BEAM, JOINT, ROBOT, SECTION};
use crate::robot::{Angle, Dimension, Motion, Robot, Value, decimal};

/// A parameter that stays symbolic.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Symbol {
    /// Its name, as the table spells it.
    pub name: String,
    /// What it measures; [`Dimension::unit`] is its SI unit.
    pub dimension: Dimension,
}

/// A cell of the model that may be a parameter.
enum Cell<'m> {
    Value(&'m mut Value),
    Angle(&'m mut Angle),
}

impl Cell<'_> {
    fn symbol(&self) -> Option<&str> {
        match self {
            Cell::Value(Value::Symbol(name)) | Cell::Angle(Angle::Symbol(name)) => Some(name),
            _ => None,
        }
    }
}

impl Robot {
    /// The symbolic parameters, each once, in order of first appearance: gravity, the joints row by
    /// row (theta, d, a, alpha, beta, stiffness, mass, com, inertia, drive, beam), the tool.
    pub fn symbols(&self) -> Vec<Symbol> {
        let mut found: Vec<Symbol> = Vec::new();
        visit(ROBOT, &mut self.clone(), None, &mut |cell, dimension| {
            if let Some(name) = cell.symbol()
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
        visit(ROBOT, &mut robot, None, &mut |cell, _| {
            let Some(name) = cell.symbol().map(str::to_owned) else { return };
            let given = value(&name);
            match (cell, given.and_then(decimal::of_double), given.and_then(Angle::from_radians)) {
                (Cell::Value(value), Some(number), _) => *value = Value::Number(number),
                (Cell::Angle(angle), _, Some(radians)) => *angle = radians,
                _ if missing.contains(&name) => {}
                _ => missing.push(name),
            }
        });
        if missing.is_empty() { Ok(robot) } else { Err(missing) }
    }
}

/// Visits the cells of a table that may be parameters, with what they measure.
fn visit<T>(
    fields: &[Field<T>],
    of: &mut T,
    motion: Option<Motion>,
    visitor: &mut dyn FnMut(Cell<'_>, Dimension),
) {
    for field in fields.iter().filter(|field| field.number.is_none()) {
        let mut values = |cells: &mut [Value]| {
            if let Some(dimension) = field.dimension(motion) {
                cells.iter_mut().for_each(|cell| visitor(Cell::Value(cell), dimension));
            }
        };
        match (field.slot)(of) {
            Slot::Angle(angle) => visitor(Cell::Angle(angle), Dimension::Angle),
            Slot::Value(value) => values(core::slice::from_mut(value)),
            Slot::Maybe(value) => values(value.as_mut_slice()),
            Slot::Vector(vector) => values(vector),
            Slot::Tensor(Some(tensor)) => values(tensor),
            Slot::Section(section) => visit(SECTION, section, motion, visitor),
            Slot::Beam(Some(beam)) => visit(BEAM, beam, motion, visitor),
            Slot::Frame(frame, fields, _) => visit(fields, frame, motion, visitor),
            Slot::Joints(joints) => joints.iter_mut().for_each(|joint| {
                let motion = Some(joint.motion);
                visit(JOINT, joint, motion, visitor);
            }),
            _ => {}
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
