//! Time and temperature of a session.

use super::rounded;
use crate::measurement::Row;
use crate::rng::{Rng, Stream};

/// Seconds from one row to the next, give or take a third.
const PACE: f64 = 30.0;

/// What the arm warms up by in the end, K.
const WARMTH: f64 = 15.0;

/// Fills in time and temperature: the arm warms up with a time constant of a third of the session,
/// and the room sways by half a kelvin, so that temperature is not a function of time alone.
pub(super) fn fill(seed: u64, rows: &mut [Row]) {
    let mut rng = Rng::new(seed, Stream::Climate);
    let constant = (rows.len() as f64 * PACE / 3.0).max(PACE);
    let mut time = 0.0;
    for row in rows {
        let warm = WARMTH * (1.0 - (-time / constant).exp());
        row.time = Some(rounded(time, 1e1));
        row.temperature = Some(rounded(20.0 + warm + rng.between(-0.5, 0.5), 1e2));
        time += PACE * rng.between(2.0 / 3.0, 4.0 / 3.0);
    }
}
