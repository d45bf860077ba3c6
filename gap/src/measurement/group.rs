//! Which rows are one pose.

use std::collections::HashMap;

use super::Row;

/// Readings that agree to this are the same pose, rad or m.
const SAME: f64 = 1e-9;

/// Numbers the poses in the order in which they first appear; returns how many there are.
///
/// With a `pose` column its ids decide. Without one, rows with the same readings are one pose, even
/// if other poses were measured between them. Rows of two sessions are never one pose.
pub(crate) fn assign(rows: &mut [Row]) -> usize {
    #[derive(PartialEq, Eq, Hash)]
    enum Key {
        Id(String),
        Readings(Vec<i64>),
    }
    let mut seen = HashMap::new();
    for row in rows {
        let of = row.session.clone();
        let key = match &row.pose {
            Some(id) => Key::Id(id.clone()),
            // A conversion out of range saturates.
            None => Key::Readings(row.q.iter().map(|q| (q / SAME).round() as i64).collect()),
        };
        let next = seen.len();
        row.group = *seen.entry((of, key)).or_insert(next);
    }
    seen.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(q: &[f64], pose: Option<&str>) -> Row {
        let pose = pose.map(str::to_owned);
        Row { pose, ..Row::new(1, q.to_vec()) }
    }

    fn groups(mut rows: Vec<Row>) -> (usize, Vec<usize>) {
        let poses = assign(&mut rows);
        (poses, rows.iter().map(|r| r.group).collect())
    }

    #[test]
    fn equal_readings_are_one_pose() {
        let rows = vec![
            row(&[0.1, 0.2], None),
            row(&[0.1, 0.3], None),
            row(&[0.1 + 1e-13, 0.2], None),
            row(&[0.1 + 1e-6, 0.2], None),
        ];
        assert_eq!(groups(rows), (3, vec![0, 1, 0, 2]));
    }

    #[test]
    fn the_pose_column_decides() {
        let rows =
            vec![row(&[0.1], Some("a")), row(&[0.1], Some("b")), row(&[0.1000001], Some("a"))];
        assert_eq!(groups(rows), (2, vec![0, 1, 0]));
    }

    #[test]
    fn a_pose_is_of_one_session() {
        let of =
            |session: &str, pose| Row { session: Some(session.to_owned()), ..row(&[0.1], pose) };
        let named = vec![of("a", Some("1")), of("a", Some("1")), of("b", Some("1"))];
        assert_eq!(groups(named), (2, vec![0, 0, 1]));
        assert_eq!(groups(vec![of("a", None), of("b", None), of("b", None)]), (2, vec![0, 1, 1]));
    }
}
