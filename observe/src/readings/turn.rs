//! The columns of an orientation, in the order of its convention.

use super::columns::{Column, Columns};
use super::map::Map;
use super::sheet::Table;
use crate::io::{Convention, Fault, ReadError};

/// The columns of an orientation, in the order of its convention.
#[derive(Clone, Debug)]
pub(super) struct Turn {
    pub convention: Convention,
    pub columns: Vec<Column>,
}

impl Turn {
    /// The orientation of a table; `None` where it has none, or a rotation vector already.
    ///
    /// # Errors
    /// [`ReadError`]: some of its numbers are missing, or there are several.
    pub(super) fn of(
        table: &Table<'_>,
        columns: &Columns,
        map: &Map,
    ) -> Result<Option<Turn>, ReadError> {
        let wrong =
            |found: String, expected: &str| Err(Fault::new(found, expected, "").of(table.file));
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
            let one = "one: `ignore` the others in a map";
            return wrong("two orientations".to_owned(), one);
        }
        // Columns called rx, ry, rz may hold three angles of another convention.
        let said = map.orientation.or(table.orientation);
        let Some(convention) = said.or(named).filter(|c| *c != Convention::RotationVector) else {
            return Ok(None);
        };
        let mut columns: Vec<Column> = match others.is_empty() {
            true => vector,
            false => others.into_iter().map(|(_, _, column)| column).collect(),
        };
        if columns.is_empty() {
            return wrong("no orientation".to_owned(), "the one that `orientation` speaks of");
        }
        if columns.len() != convention.numbers() {
            let headers: Vec<&str> = columns.iter().map(|c| c.header.as_str()).collect();
            let found = format!("of an orientation {}", headers.join(", "));
            return wrong(found, &format!("its {} numbers", convention.numbers()));
        }
        // A column that has the name of an axis is the angle about it, whichever turn comes first.
        let by_name = named.is_none() || named == Some(Convention::RPY);
        if let (true, Ok(of_axes)) = (by_name, <[Column; 3]>::try_from(columns.clone())) {
            columns = convention.ordered(of_axes).to_vec();
        }
        Ok(Some(Turn { convention, columns }))
    }
}
