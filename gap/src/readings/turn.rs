//! Orientations of any convention into rotation vectors.

use nalgebra::{Quaternion, UnitQuaternion, Vector3};

use super::columns::{Column, Columns};
use super::map::{Convention, Map};
use crate::io::{Fault, ReadError};

/// The columns of an orientation, in the order of its convention.
#[derive(Clone, Debug)]
pub(super) struct Turn {
    pub convention: Convention,
    pub columns: Vec<Column>,
}

impl Convention {
    fn numbers(self) -> usize {
        if self == Convention::Quaternion { 4 } else { 3 }
    }

    /// In words, with the order of its numbers.
    pub(super) fn words(self) -> &'static str {
        match self {
            Convention::RotationVector => "a rotation vector",
            Convention::Abc => "Rz(a) Ry(b) Rx(c)",
            Convention::Rpy => "Rz(yaw) Ry(pitch) Rx(roll)",
            Convention::Zyz => "Rz(a) Ry(b) Rz(c)",
            Convention::Quaternion => "a quaternion w, x, y, z",
        }
    }

    /// The rotation vector of its numbers, rad; `None` of a quaternion of no length.
    pub(super) fn rotation(self, n: &[f64]) -> Option<Vector3<f64>> {
        let about = |axis: Vector3<f64>, angle: f64| UnitQuaternion::new(axis * angle);
        let [x, y, z] = [Vector3::x(), Vector3::y(), Vector3::z()];
        let turned = match self {
            Convention::RotationVector => return Some(Vector3::new(n[0], n[1], n[2])),
            Convention::Abc => about(z, n[0]) * about(y, n[1]) * about(x, n[2]),
            Convention::Rpy => about(z, n[2]) * about(y, n[1]) * about(x, n[0]),
            Convention::Zyz => about(z, n[0]) * about(y, n[1]) * about(z, n[2]),
            Convention::Quaternion => {
                let length = n.iter().fold(0.0_f64, |a, b| a.hypot(*b));
                let q = Quaternion::new(n[0], n[1], n[2], n[3]);
                return (length > 0.0 && length.is_finite())
                    .then(|| UnitQuaternion::from_quaternion(q).scaled_axis());
            }
        };
        Some(turned.scaled_axis())
    }
}

impl Turn {
    /// The orientation of a table; `None` where it has none, or a rotation vector already.
    ///
    /// # Errors
    /// [`ReadError`]: some of its numbers are missing, or there are several.
    pub(super) fn of(file: &str, columns: &Columns, map: &Map) -> Result<Option<Turn>, ReadError> {
        let wrong = |found: String, expected| Err(Fault::new(found, expected, "").of(file));
        let vector: Vec<Column> = ["rx", "ry", "rz"]
            .into_iter()
            .filter_map(|name| columns.ours.iter().find(|(ours, _)| ours == name))
            .map(|(_, column)| column.clone())
            .collect();
        let mut others = columns.orientation.clone();
        others.sort_by_key(|(_, k, _)| *k);
        let named = others.first().map(|(convention, ..)| *convention);
        let several = others.iter().any(|(c, ..)| Some(*c) != named);
        if several || !(others.is_empty() || vector.is_empty()) {
            let one = "one: leave the others to no name of an orientation";
            return wrong("two orientations".to_owned(), one);
        }
        // Columns called rx, ry, rz may hold three angles of another convention.
        let Some(convention) =
            map.orientation.or(named).filter(|c| *c != Convention::RotationVector)
        else {
            return Ok(None);
        };
        let columns: Vec<Column> = match others.is_empty() {
            true => vector,
            false => others.into_iter().map(|(_, _, column)| column).collect(),
        };
        if columns.is_empty() {
            return wrong("no orientation".to_owned(), "the one that the map speaks of");
        }
        if columns.len() != convention.numbers() {
            let headers: Vec<&str> = columns.iter().map(|c| c.header.as_str()).collect();
            let found = format!("of an orientation {}", headers.join(", "));
            return wrong(found, "three angles, or the four numbers of a quaternion");
        }
        Ok(Some(Turn { convention, columns }))
    }
}
