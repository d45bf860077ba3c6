//! When a row was measured: the move before it, the warmth, the time.

use std::sync::Arc;

use super::stream::Stream;
use crate::measurement::Measurements;

/// What the order of the rows, and the columns `temperature` and `time`, say of one row.
#[derive(Clone, Debug, PartialEq)]
pub struct Moment {
    /// Number of the row, from 0.
    pub index: usize,
    /// Readings minus those of the row before, n, rad (m if prismatic); 0 at the first row.
    pub last_move: Vec<f64>,
    /// Temperature minus that of the first row, K; 0 without the column.
    pub warming: f64,
    /// Time since the first row, s; without the column, the number of the row.
    pub clock: f64,
    /// The readings of all rows over this time, where they are a stream.
    pub stream: Option<Arc<Stream>>,
}

impl Moment {
    /// Of a row by itself, at the beginning.
    pub fn at_rest(last_move: Vec<f64>, warming: f64) -> Moment {
        Moment { index: 0, last_move, warming, clock: 0.0, stream: None }
    }
}

/// One for each row.
pub fn moments(data: &Measurements) -> Vec<Moment> {
    let first = data.rows.first();
    let start = |of: fn(&crate::measurement::Row) -> Option<f64>| first.and_then(of);
    let (t0, k0) = (start(|r| r.time), start(|r| r.temperature));
    let stream = Stream::of(&data.rows).map(Arc::new);
    let mut before: Option<&Vec<f64>> = None;
    let mut moments = Vec::with_capacity(data.rows.len());
    for (index, row) in data.rows.iter().enumerate() {
        let last = before.unwrap_or(&row.q);
        moments.push(Moment {
            index,
            last_move: row.q.iter().zip(last).map(|(now, then)| now - then).collect(),
            warming: row.temperature.zip(k0).map_or(0.0, |(now, first)| now - first),
            clock: row.time.zip(t0).map_or(index as f64, |(now, first)| now - first),
            stream: stream.clone(),
        });
        before = Some(&row.q);
    }
    moments
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixture::{row, table};
    use crate::measurement::Kind;
    use nalgebra::Vector6;

    #[test]
    fn moves_warmth_and_time_count_from_the_first_row() {
        let mut rows = vec![row(&[0.1], Vector6::zeros()), row(&[0.4], Vector6::zeros())];
        rows[0].temperature = Some(20.0);
        rows[1].temperature = Some(21.5);
        let data = table(rows, Kind::Pose { orientation: false });
        let moments = moments(&data);
        assert_eq!(moments[0].last_move, [0.0]);
        assert!((moments[1].last_move[0] - 0.3).abs() < 1e-15);
        assert_eq!((moments[0].warming, moments[1].warming), (0.0, 1.5));
        assert_eq!((moments[1].clock, moments[1].index), (1.0, 1));
    }
}
