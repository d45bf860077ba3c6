//! Readings as a function of time, where the rows are a stream of them and not poses at rest.

use crate::constants::LONGEST_STEP;
use crate::measurement::Row;

/// Fewer rows have no rate that a cubic could follow.
const LEAST: usize = 4;

/// Joint readings over time, a cubic from one row to the next (Hermite's, with the slopes of the
/// parabola through a row and its neighbours): of the third order in the time between rows.
#[derive(Clone, Debug, PartialEq)]
pub struct Stream {
    /// Since the first row, increasing, s.
    times: Vec<f64>,
    /// Of each time, n, rad (m if prismatic).
    readings: Vec<Vec<f64>>,
}

/// Whether rows are a stream: each has a time, none is earlier than the one before, and half of them
/// follow within a second.
pub fn is_stream(rows: &[Row]) -> bool {
    let step = |pair: &[Row]| Some(pair[1].time? - pair[0].time?);
    let close = rows.windows(2).try_fold([0, 0], |[close, later], pair| {
        let step = step(pair).filter(|step| *step >= 0.0)?;
        let is_later = step > 0.0;
        Some([close + usize::from(is_later && step <= LONGEST_STEP), later + usize::from(is_later)])
    });
    close.is_some_and(|[close, later]| later + 1 >= LEAST && 2 * close >= later)
}

impl Stream {
    /// The readings of rows that are a stream; of rows with one time, the first's.
    pub fn of(rows: &[Row]) -> Option<Stream> {
        if !is_stream(rows) {
            return None;
        }
        let start = rows.first()?.time?;
        let mut stream = Stream { times: Vec::new(), readings: Vec::new() };
        for row in rows {
            let time = row.time? - start;
            if stream.times.last().is_none_or(|last| time > *last) {
                stream.times.push(time);
                stream.readings.push(row.q.clone());
            }
        }
        Some(stream)
    }

    /// How far the joints move from a time to another, n, rad (m if prismatic).
    pub fn moved(&self, from: f64, to: f64) -> Vec<f64> {
        let [from, to] = [from, to].map(|time| self.at(time));
        from.iter().zip(&to).map(|((from, _), (to, _))| to - from).collect()
    }

    /// How fast the joints move at a time, n, rad/s (m/s).
    pub fn rates(&self, time: f64) -> Vec<f64> {
        self.at(time).into_iter().map(|(_, rate)| rate).collect()
    }

    /// Reading and rate of each joint; before the first and after the last row they go on evenly.
    fn at(&self, time: f64) -> Vec<(f64, f64)> {
        let last = self.times.len() - 1;
        let end = if time < 0.0 { Some(0) } else { (time > self.times[last]).then_some(last) };
        let joints = 0..self.readings[0].len();
        if let Some(end) = end {
            let beyond = time - self.times[end];
            let one = |joint: usize| {
                let slope = self.slope(end, joint);
                (self.readings[end][joint] + slope * beyond, slope)
            };
            return joints.map(one).collect();
        }
        let k = self.times.partition_point(|then| *then <= time).clamp(1, last) - 1;
        let span = self.times[k + 1] - self.times[k];
        let s = (time - self.times[k]) / span;
        let one = |joint: usize| {
            let (from, to) = (self.readings[k][joint], self.readings[k + 1][joint]);
            let slopes = [self.slope(k, joint), self.slope(k + 1, joint)];
            // By powers of s: from + s (a + s (b + s c)).
            let a = span * slopes[0];
            let c = a + span * slopes[1] - 2.0 * (to - from);
            let b = to - from - a - c;
            (from + s * (a + s * (b + s * c)), (a + s * (2.0 * b + s * 3.0 * c)) / span)
        };
        joints.map(one).collect()
    }

    /// Of the parabola through a row and its neighbours, at the row; at the ends of the chord.
    fn slope(&self, k: usize, joint: usize) -> f64 {
        let chord = |k: usize| {
            let span = self.times[k + 1] - self.times[k];
            (span, (self.readings[k + 1][joint] - self.readings[k][joint]) / span)
        };
        let last = self.times.len() - 1;
        if k == 0 || k == last {
            return chord(k.min(last - 1)).1;
        }
        let ((before, slope_before), (behind, slope_behind)) = (chord(k - 1), chord(k));
        (behind * slope_before + before * slope_behind) / (before + behind)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rows(times: &[f64], reading: fn(f64) -> f64) -> Vec<Row> {
        let row = |t: &f64| Row { time: Some(*t), ..Row::new(2, vec![reading(*t)]) };
        times.iter().map(row).collect()
    }

    #[test]
    fn poses_at_rest_are_no_stream() {
        let still = |_: f64| 0.0;
        assert!(is_stream(&rows(&[0.0, 0.1, 0.1, 0.2, 0.3], still)));
        assert!(!is_stream(&rows(&[0.0, 30.0, 60.0, 60.5, 90.0], still)));
        assert!(!is_stream(&rows(&[0.0, 0.1, 0.05, 0.2, 0.3], still)));
        assert!(!is_stream(&rows(&[0.0, 0.1, 0.2], still)));
        assert!(!is_stream(&[0, 1, 2, 3, 4].map(|k| Row::new(k, vec![0.0]))));
    }

    /// A parabola is its own cubic, at uneven times too; an end goes on along its chord.
    #[test]
    fn a_parabola_is_followed() {
        let reading = |t: f64| 0.3 + 0.5 * t - 0.8 * t * t;
        let stream = Stream::of(&rows(&[2.0, 2.2, 2.5, 2.6, 2.6, 3.0], reading)).unwrap();
        for time in [0.2_f64, 0.31, 0.5, 0.55] {
            let moved = stream.moved(0.2, time)[0];
            assert!((moved - (reading(2.0 + time) - reading(2.2))).abs() < 1e-14);
            let rate = 0.5 - 1.6 * (2.0 + time);
            assert!((stream.rates(time)[0] - rate).abs() < 1e-13);
        }
        let chord = (reading(3.0) - reading(2.6)) / 0.4;
        assert!((stream.moved(1.0, 1.3)[0] - 0.3 * chord).abs() < 1e-14);
    }
}
