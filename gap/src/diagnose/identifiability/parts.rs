//! Plain facts of the gap: which part of it goes with what, and how large it is where.

use crate::diagnose::normal_equations::{Candidate, Kept};
use crate::diagnose::report::{Part, Slice};
use crate::diagnose::search::{Explained, Search};
use crate::effects::Group;
use crate::gap::rms;
use crate::infer::constants::NUMBERS_EACH;
use crate::measurement::Row;
use nalgebra::Vector6;

/// Slices along one thing.
const SLICES: usize = 4;

impl Search<'_, '_> {
    /// Shares of the gap's mean square, held out, each beside those before it. Empty where the
    /// data are too few for all their columns.
    pub(crate) fn parts(&self, now: &Explained) -> Vec<Part> {
        let of_part = |group: Group| -> Vec<Candidate> {
            let is_it = |c: &&Candidate| {
                c.effect().is_some_and(|(effect, spot)| {
                    effect.group() == Some(group) && self.whole_of(effect, spot).is_none()
                })
            };
            self.candidates.iter().filter(is_it).cloned().collect()
        };
        let each = Group::ALL.map(of_part);
        let sizes = each.each_ref().map(|part| part.iter().map(|c| c.size).sum::<usize>());
        if self.problem.numbers() < NUMBERS_EACH * sizes.iter().sum::<usize>() {
            return Vec::new();
        }
        let gathered = self.gather(now, &each.concat(), &[]);
        let left = |along: usize| {
            let kept = Kept { along, ..Kept::default() };
            let screen = self.screen_of(now, &gathered, kept, &[]);
            screen.held_out(&screen.trained(), None).white
        };
        let whole = left(0);
        if whole <= 0.0 {
            return Vec::new();
        }
        let (mut parts, mut last, mut along) = (Vec::new(), whole, 0);
        for (group, columns) in Group::ALL.into_iter().zip(sizes) {
            along += columns;
            let left = left(along).min(last);
            parts.push(Part { part: group.name().into(), share: (last - left) / whole });
            last = left;
        }
        parts.push(Part {
            part: "none of these".into(),
            share: last / whole.max(f64::MIN_POSITIVE),
        });
        parts
    }

    /// Size of the gap before and after in slices of each joint's range, of load, direction and
    /// time.
    pub(crate) fn slices(&self, before: &[Vector6<f64>], after: &[Vector6<f64>]) -> Vec<Slice> {
        let [before, after] = [before, after].map(|gaps| {
            let sizes = self.problem.kept(gaps).map(|gap| self.problem.size(gap));
            sizes.collect::<Vec<f64>>()
        });
        let rows: Vec<&Row> = self.problem.kept_rows().collect();
        let mut slices = Vec::new();
        let mut add = |of: String, values: Vec<f64>| {
            slices.extend(cut(&of, &values, &before, &after));
        };
        for joint in 0..self.problem.arm.dof() {
            add(format!("q{}", joint + 1), rows.iter().map(|r| r.q[joint]).collect());
        }
        let force = |r: &&Row| r.wrench.fixed_rows::<3>(0).norm();
        add("load".to_owned(), rows.iter().map(force).collect());
        for joint in 0..self.problem.arm.dof() {
            let directions: Option<Vec<f64>> =
                rows.iter().map(|r| r.direction.as_ref().map(|d| f64::from(d[joint]))).collect();
            if let Some(directions) = directions {
                add(format!("s{}", joint + 1), directions);
            }
        }
        let moments = &self.problem.moments;
        let clocks: Vec<f64> =
            (0..self.problem.fits.len()).map(|row| moments.at(row).clock).collect();
        add("time".to_owned(), self.problem.kept(&clocks).copied().collect());
        slices
    }
}

/// Rows in order of a value, cut into slices of about as many rows; equal values stay together.
fn cut(of: &str, values: &[f64], before: &[f64], after: &[f64]) -> Vec<Slice> {
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|a, b| values[*a].total_cmp(&values[*b]));
    let mut slices = Vec::new();
    let mut from = 0;
    for slice in 1..=SLICES {
        let mut to = (order.len() * slice / SLICES).max(from);
        while to > 0 && to < order.len() && values[order[to]] == values[order[to - 1]] {
            to += 1;
        }
        if to == from {
            continue;
        }
        let rows = &order[from..to];
        let pick = |of: &[f64]| rms(&rows.iter().map(|r| of[*r]).collect::<Vec<_>>());
        slices.push(Slice {
            of: of.to_owned(),
            from: values[rows[0]],
            to: values[rows[rows.len() - 1]],
            rows: rows.len(),
            before: pick(before),
            after: pick(after),
        });
        from = to;
    }
    // Everything in one slice says nothing.
    if slices.len() < 2 { Vec::new() } else { slices }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_values_stay_in_one_slice() {
        let values = [0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 3.0, 3.0];
        let sizes = [1.0; 8];
        let slices = cut("load", &values, &sizes, &sizes);
        let spans: Vec<_> = slices.iter().map(|s| (s.from, s.to, s.rows)).collect();
        assert_eq!(spans, [(0.0, 0.0, 3), (1.0, 1.0, 2), (2.0, 2.0, 1), (3.0, 3.0, 2)]);
        assert!(cut("time", &[1.0; 4], &[1.0; 4], &[1.0; 4]).is_empty());
    }
}
