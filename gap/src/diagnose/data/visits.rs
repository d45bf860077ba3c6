//! Visits, and what is measured again: at one visit, and when the arm comes back.

use std::collections::HashMap;

use super::outliers::ordinary;
use crate::constants::UNCHANGED;
use crate::measurement::{Measurements, Near, Row};

/// What of the rows belongs together.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Visits {
    /// The visit of each row: rows of one pose under one load that follow each other are one, for the
    /// arm did not move between them.
    pub(crate) of_row: Vec<usize>,
    /// What each row repeats: rows of one pose with one load, marker and direction of approach, of which one
    /// thing is read.
    pub(crate) repeats: Vec<usize>,
}

impl Visits {
    pub(crate) fn of(data: &Measurements) -> Self {
        let part = |row: &Row, from: usize| row.wrench.fixed_rows::<3>(from).into_owned();
        let ordinary = ordinary(data);
        let largest = [0, 3].map(|from| {
            let rows = data.rows.iter().zip(&ordinary).filter(|(_, is)| **is);
            rows.map(|(row, _)| part(row, from).norm()).fold(f64::MIN_POSITIVE, f64::max)
        });
        let mut loads = Near::new(UNCHANGED);
        let (mut sets, mut of_row, mut repeats) = (HashMap::new(), Vec::new(), Vec::new());
        let mut last = None;
        for row in &data.rows {
            let load: Vec<f64> =
                row.wrench.iter().enumerate().map(|(k, f)| f / largest[k / 3]).collect();
            let here = (row.group, loads.kind(&load));
            let visit = of_row.last().map_or(0, |visit| visit + usize::from(last != Some(here)));
            of_row.push(visit);
            last = Some(here);
            let next = sets.len();
            let aim = row.aim.as_deref().map(|aim| (aim.seen, aim.name.as_str()));
            let key = (here, row.marker.as_deref(), row.direction.as_deref(), aim);
            repeats.push(*sets.entry(key).or_insert(next));
        }
        Self { of_row, repeats }
    }

    /// Number of visits.
    pub(crate) fn count(&self) -> usize {
        self.of_row.last().map_or(0, |last| last + 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixture::table;
    use crate::measurement::Kind;
    use nalgebra::Vector6;

    #[test]
    fn rows_of_one_stay_are_one_visit_and_rows_of_one_kind_repeats() {
        let row = |group, force: f64, side: i8| Row {
            group,
            wrench: Vector6::new(force, 0.0, 0.0, 0.0, 0.0, 0.0),
            direction: Some(vec![side]),
            ..Row::new(1, vec![0.0])
        };
        // Two readings at one pose, another pose, the first again by a load that is read anew, then
        // under another load, then from the other side.
        let rows = [
            row(0, 100.0, 1),
            row(0, 100.1, 1),
            row(1, 100.0, 1),
            row(0, 99.8, 1),
            row(0, 50.0, 1),
            row(1, 50.0, 1),
            row(0, 100.0, -1),
        ];
        let visits = Visits::of(&table(rows.to_vec(), Kind::Pose { orientation: false }));
        assert_eq!(visits.of_row, [0, 0, 1, 2, 3, 4, 5]);
        assert_eq!(visits.repeats, [0, 0, 1, 0, 2, 3, 4]);
        assert_eq!(visits.count(), 6);
    }
}
