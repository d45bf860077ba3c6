//! Where the joints were a little before or after a row: the polynomial through the rows around it.

use crate::measurement::Row;

/// Between rows that are farther apart, s, the arm has come to rest.
const PAUSE: f64 = 1.0;

/// The readings at `time` (s, as the rows have it); none unless rows around it have times close by.
///
/// Of the third order, by Neville's scheme; outside of all rows the arm goes on evenly.
pub(super) fn readings_at(rows: &[Row], time: f64) -> Option<Vec<f64>> {
    let mut known: Vec<(f64, &[f64])> = Vec::with_capacity(4);
    let ends = [rows.first()?.time?, rows.last()?.time?];
    let wanted = if (ends[0]..=ends[1]).contains(&time) { 4 } else { 2 };
    let behind = rows.partition_point(|row| row.time.is_some_and(|then| then <= time));
    let (mut before, mut after) = (rows[..behind].iter().rev(), rows[behind..].iter());
    // From both sides in turn, so that as many stand on either where there are as many.
    let mut misses = 0;
    while known.len() < wanted && misses < 2 {
        misses = 0;
        for mut side in [&mut before as &mut dyn Iterator<Item = &Row>, &mut after] {
            let is_new = |row: &&Row| row.time.is_some_and(|t| known.iter().all(|k| k.0 != t));
            let next = Iterator::find(&mut side, is_new);
            match next.and_then(|row| Some((row.time?, row.q.as_slice()))) {
                Some(row) => known.push(row),
                None => misses += 1,
            }
        }
    }
    // The first two are those on either side, or the last two of an end.
    let [one, other, ..] = known[..] else { return None };
    if (one.0 - other.0).abs() > PAUSE {
        return None;
    }
    let one = |joint: usize| {
        let mut values: Vec<f64> = known.iter().map(|(_, q)| q[joint]).collect();
        for level in 1..known.len() {
            for k in 0..known.len() - level {
                let (a, b) = (known[k].0, known[k + level].0);
                values[k] = ((b - time) * values[k] + (time - a) * values[k + 1]) / (b - a);
            }
        }
        values[0]
    };
    Some((0..rows[0].q.len()).map(one).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cubic_is_followed_and_a_pause_is_none() {
        let reading = |t: f64| 0.1 - 0.4 * t + 0.7 * t * t - 0.2 * t.powi(3);
        let times = [0.0, 0.2, 0.5, 0.5, 0.6, 0.9, 40.0, 80.0];
        let row = |t: f64| Row { time: Some(t), ..Row::new(2, vec![reading(t)]) };
        let rows = times.map(row);
        for time in [0.21, 0.3, 0.55, 0.58] {
            let found = readings_at(&rows, time).expect("rows around it")[0];
            assert!((found - reading(time)).abs() < 1e-14, "{time}: {found}");
        }
        let chord = (reading(0.2) - reading(0.0)) / 0.2;
        let found = readings_at(&rows, -0.1).expect("rows behind it")[0];
        assert!((found - (reading(0.0) - 0.1 * chord)).abs() < 1e-14);
        assert_eq!(readings_at(&rows, 60.0), None);
        assert_eq!(readings_at(&[Row::new(2, vec![0.0])], 0.0), None);
    }
}
