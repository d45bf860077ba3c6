//! Cells without a number that cost no other joint its rows.
//!
//! What a joint's drive, its temperature or a signal that no fit reads lacks in a row is interpolated from the samples
//! before and behind. Where what drives the joint is missing for longer than [`GAP`] steps, that joint's rows are left out:
//! a [`Hole`]. A joint value belongs to the motion of all joints: a row that lacks one is damaged.

use core::ops::Range;

use super::{Lacking, MOST_NAMED, Signal};
use crate::io::listed;

/// Steps beyond which nothing is interpolated.
pub const GAP: f64 = 5.0;

/// Samples in which what drives a joint says nothing of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Hole {
    /// Torque or current.
    pub signal: Signal,
    /// From 0.
    pub joint: usize,
    /// Of the run.
    pub samples: Range<usize>,
}

/// Interpolates what is not a number, by straight lines over the times `t`; beyond the first and the last number these
/// stand, zero where there is none. Where that is longer than [`GAP`] steps of `period`.
pub(super) fn fill(t: &[f64], x: &mut [f64], period: f64) -> Vec<Range<usize>> {
    let mut long = Vec::new();
    let mut from = 0;
    while let Some(start) = x[from..].iter().position(|x| x.is_nan()).map(|k| from + k) {
        let end = x[start..].iter().position(|x| !x.is_nan()).map_or(x.len(), |k| start + k);
        let (before, behind) = (start.checked_sub(1), (end < x.len()).then_some(end));
        let ends = [before.or(behind), behind.or(before)].map(|k| k.map(|k| (t[k], x[k])));
        for k in start..end {
            x[k] = match ends {
                [Some((from, a)), Some((to, b))] if to > from => {
                    a + (b - a) * (t[k] - from) / (to - from)
                }
                [Some((_, there)), _] => there,
                [None, _] => 0.0,
            };
        }
        let lasts = match (before, behind) {
            (Some(before), Some(behind)) => t[behind] - t[before],
            _ => f64::INFINITY,
        };
        if lasts > GAP * period {
            long.push(start..end);
        }
        from = end;
    }
    long
}

/// What is to be said of such cells.
pub(super) fn remark(all: &[Lacking]) -> Option<String> {
    let first = all.first()?;
    let name = |one: &Lacking| format!("{} in {} rows", one.name, one.rows);
    let named: Vec<String> = all.iter().map(name).collect();
    Some(format!(
        "{}: no number for {}, first in {} {} (found `{}`): short gaps are interpolated; in long ones of what drives a \
         joint its rows are left out, and no other joint's",
        first.file,
        listed(&named, MOST_NAMED),
        first.row,
        first.line,
        first.found,
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gaps_are_interpolated_in_time_and_long_ones_are_told() {
        let nan = f64::NAN;
        let t = [0.0, 1.0, 2.5, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0];
        let mut x = [1.0, nan, nan, 4.0, nan, nan, nan, nan, nan, 10.0, nan];
        assert_eq!(fill(&t, &mut x, 1.0), [4..9, 10..11]);
        assert_eq!(x, [1.0, 2.0, 3.5, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0, 10.0]);
        let mut none = [nan; 3];
        let all = fill(&t[..3], &mut none, 1.0);
        assert_eq!((all.len(), &all[0], none), (1, &(0..3), [0.0; 3]));
    }
}
