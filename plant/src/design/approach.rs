//! From which side each joint came to rest.

use super::{Design, Shape};
use crate::measurement::Row;
use crate::rng::{Rng, Stream};

/// Fills in the directions. A joint that does not move keeps its side; before the first row, chance
/// decides.
pub(super) fn fill(design: &Design, rows: &mut [Row]) {
    let mut rng = Rng::new(design.seed, Stream::Approach);
    let joints = rows.first().map_or(0, |row| row.q.len());
    let mut sides: Vec<i8> = (0..joints).map(|_| if rng.sign() > 0.0 { 1 } else { -1 }).collect();
    let mut before: Option<Vec<f64>> = None;
    for row in rows {
        for (j, side) in sides.iter_mut().enumerate() {
            let moved = before.as_ref().map_or(0.0, |b| row.q[j] - b[j]);
            if design.shape == Shape::OneSided || moved > 0.0 {
                *side = 1;
            } else if moved < 0.0 {
                *side = -1;
            }
        }
        row.direction = Some(sides.clone());
        before = Some(row.q.clone());
    }
}
