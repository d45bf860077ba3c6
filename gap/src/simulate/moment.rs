//! When a row was measured: the session, the move before it, the warmth, the time.

use std::sync::Arc;

use super::stream::Stream;
use crate::measurement::{Measurements, Row};

/// What the order of the rows, and the columns `temperature` and `time`, say of one row.
#[derive(Clone, Debug, PartialEq)]
pub struct Moment {
    /// Number of the row, from 0.
    pub index: usize,
    /// That of the first row of its session.
    pub first: usize,
    /// Readings minus those of the row before, n, rad (m if prismatic); 0 at the first row of a session, and
    /// where that row is of the same pose: the arm did not move, and what differs is noise.
    pub last_move: Vec<f64>,
    /// Temperature minus that of the first row of all, K; 0 without the column.
    pub warming: f64,
    /// Time since the first row of the session, s; without the column, the rows since then.
    pub clock: f64,
    /// The readings of the session's rows over this time, where they are a stream.
    pub stream: Option<Arc<Stream>>,
}

impl Moment {
    /// Of a row by itself, at the beginning.
    pub fn at_rest(last_move: Vec<f64>, warming: f64) -> Moment {
        Moment { index: 0, first: 0, last_move, warming, clock: 0.0, stream: None }
    }
}

/// The moments of all rows, each made when it is asked for: of very many rows they would be a good
/// part of the memory.
#[derive(Clone, Debug)]
pub struct Moments<'d> {
    rows: &'d [Row],
    /// Of each session its first row, and its readings over time where they are a stream.
    sessions: Vec<(usize, Option<Arc<Stream>>)>,
}

impl<'d> Moments<'d> {
    /// Of measurements.
    pub fn of(data: &'d Measurements) -> Moments<'d> {
        let mut first = 0;
        let each = data.sessions().map(|rows| {
            let session = (first, Stream::of(rows).map(Arc::new));
            first += rows.len();
            session
        });
        Moments { sessions: each.collect(), rows: &data.rows }
    }

    /// Of one row.
    ///
    /// # Panics
    /// Where there is no such row.
    pub fn at(&self, index: usize) -> Moment {
        let (row, cold) = (&self.rows[index], self.rows[0].temperature);
        let session = self.sessions.partition_point(|(first, _)| *first <= index) - 1;
        let (first, stream) = &self.sessions[session];
        let before = &self.rows[index.saturating_sub(1).max(*first)];
        let start = self.rows[*first].time;
        let rests = stream.is_none() && before.group == row.group;
        let moved = |(now, then): (&f64, &f64)| if rests { 0.0 } else { now - then };
        Moment {
            index,
            first: *first,
            last_move: row.q.iter().zip(&before.q).map(moved).collect(),
            warming: row.temperature.zip(cold).map_or(0.0, |(now, first)| now - first),
            clock: row.time.zip(start).map_or((index - first) as f64, |(now, then)| now - then),
            stream: stream.clone(),
        }
    }
}

/// One for each row.
pub fn moments(data: &Measurements) -> Vec<Moment> {
    let moments = Moments::of(data);
    (0..data.rows.len()).map(|row| moments.at(row)).collect()
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
        rows[1].group = 1;
        rows[0].temperature = Some(20.0);
        rows[1].temperature = Some(21.5);
        let data = table(rows, Kind::Pose { orientation: false });
        let moments = moments(&data);
        assert_eq!(moments[0].last_move, [0.0]);
        assert!((moments[1].last_move[0] - 0.3).abs() < 1e-15);
        assert_eq!((moments[0].warming, moments[1].warming), (0.0, 1.5));
        assert_eq!((moments[1].clock, moments[1].index), (1.0, 1));
    }

    #[test]
    fn time_and_moves_begin_anew_with_a_session_and_warmth_does_not() {
        let of = |session: &str, q: f64, time: f64| Row {
            group: (10.0 * q) as usize,
            session: Some(session.to_owned()),
            time: Some(time),
            temperature: Some(20.0 + q),
            ..row(&[q], Vector6::zeros())
        };
        let rows = vec![of("a", 0.1, 5.0), of("a", 0.4, 7.0), of("b", 0.8, 1.0), of("b", 0.9, 4.0)];
        let moments = moments(&table(rows, Kind::Pose { orientation: false }));
        let clocks: Vec<f64> = moments.iter().map(|m| m.clock).collect();
        assert_eq!(clocks, [0.0, 2.0, 0.0, 3.0]);
        assert_eq!((moments[2].last_move[0], moments[2].first, moments[3].index), (0.0, 2, 3));
        assert!((moments[3].last_move[0] - 0.1).abs() < 1e-15);
        assert!((moments[2].warming - 0.7).abs() < 1e-14);
    }

    /// A ball that is put into its socket again at one posture: the joints' differences are no moves.
    #[test]
    fn within_a_pose_nothing_moves() {
        let of = |q, group| Row { group, ..row(&[q], Vector6::zeros()) };
        let rows = vec![of(0.1, 0), of(0.8, 1), of(0.8 - 1e-4, 1), of(0.1 + 1e-4, 0)];
        let data = table(rows, Kind::Pose { orientation: false });
        let moves: Vec<f64> = moments(&data).iter().map(|m| m.last_move[0]).collect();
        assert_eq!(moves, [0.0, 0.8 - 0.1, 0.0, 0.1 + 1e-4 - (0.8 - 1e-4)]);
    }
}
