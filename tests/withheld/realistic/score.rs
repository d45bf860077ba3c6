//! The sum over many arms, and what is to be reached.

use core::fmt;

use serde::Serialize;
use stiffarm_gap::gap::percentile;
use stiffarm_study::withhold::Rate;

use super::case::{Case, Shrink};
use crate::goals::{Goal, missed};

/// A gap of this many times the noise's own counts as closed.
pub const CLOSED: f64 = 1.2;

/// The written arm leaves what was announced, to this part.
const SAME: f64 = 0.05;

/// All figures.
#[derive(Clone, Debug, Serialize)]
pub struct Score {
    pub arms: usize,
    pub failed: usize,
    pub goals: Vec<Goal>,
    /// Truths that are named as their twins.
    pub twins: usize,
    /// Of [`Case::again`] the least, the median and the largest.
    pub again: [[f64; 3]; 3],
    /// Of the diagnoses, s: median and longest.
    pub seconds: [f64; 2],
}

impl Score {
    pub fn of(cases: &[Case]) -> Score {
        let truths = || cases.iter().flat_map(|c| &c.truths);
        let plain = || cases.iter().filter(|c| c.truths.is_empty());
        let inside = |s: &Shrink| (s.ci95[0]..=s.ci95[1]).contains(&s.realised);
        let again: Vec<[f64; 3]> = cases.iter().filter_map(|c| c.again).collect();
        let same = |[_, checked, written]: &&[f64; 3]| {
            [checked, written].iter().all(|ratio| (**ratio - 1.0).abs() <= SAME)
        };
        let quantiles = |mut values: Vec<f64>| {
            values.sort_by(f64::total_cmp);
            [0.0, 0.5, 1.0].map(|part| percentile(&values, part))
        };
        let [_, median, longest] = quantiles(cases.iter().map(|c| c.seconds).collect());
        let rates = [
            ("named", [0.95, 1.0], Rate::of(truths().map(|t| t.named))),
            ("in the set", [0.98, 1.0], Rate::of(truths().map(|t| t.in_set))),
            ("first one true", [0.97, 1.0], Rate::of(cases.iter().filter_map(|c| c.first))),
            ("spurious, an arm", [0.0, 0.1], {
                Rate::count(cases.iter().map(|c| c.spurious).sum(), cases.len())
            }),
            ("alarms on geometry", [0.0, 0.05], Rate::of(plain().map(|c| c.spurious > 0))),
            ("at the floor", [0.95, 1.0], Rate::of(cases.iter().map(|c| c.over_floor() <= CLOSED))),
            ("intervals cover", [0.90, 0.98], {
                Rate::of(truths().flat_map(|t| t.covered.iter().copied()))
            }),
            ("shrink as predicted", [0.90, 1.0], {
                Rate::of(cases.iter().filter_map(|c| c.shrink.as_ref()).map(inside))
            }),
            ("the same again", [1.0, 1.0], {
                Rate::count(again.iter().filter(same).count(), cases.len())
            }),
        ];
        Score {
            arms: cases.len(),
            failed: cases.iter().filter(|c| c.error.is_some()).count(),
            goals: rates.map(|(what, wanted, rate)| Goal::new(what, wanted, rate)).to_vec(),
            twins: truths().filter(|t| t.as_twin).count(),
            again: [0, 1, 2].map(|k| quantiles(again.iter().map(|ratios| ratios[k]).collect())),
            seconds: [median, longest],
        }
    }

    /// Goals that are missed; what there is nothing to judge by is.
    pub fn missed(&self) -> Vec<&'static str> {
        missed(&self.goals)
    }
}

impl fmt::Display for Score {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{} arms, {} without a diagnosis", self.arms, self.failed)?;
        self.goals.iter().try_for_each(|goal| writeln!(f, "{goal}"))?;
        writeln!(f, "{:>20} {} of the named", "as their twins", self.twins)?;
        for (what, [least, median, most]) in
            ["held out", "checked", "written"].iter().zip(self.again)
        {
            writeln!(f, "{what:>20} {least:.3} {median:.3} {most:.3} of what is announced")?;
        }
        let [median, longest] = self.seconds;
        writeln!(f, "{:>20} {median:>7.1} s in the middle, {longest:.1} s at most", "time")
    }
}

/// One line: the truths (`+` named, `=` as its twin, `~` in the set, `-` neither), what else was found, the gap.
impl fmt::Display for Case {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let sight = if self.orientation { "6D" } else { "3D" };
        let loads = if self.loads { "loads" } else { "none" };
        write!(f, "{:>4} {:<10} {sight} {loads:<5}", self.seed, self.robot)?;
        let (over, out) = (self.over_floor(), self.left_out);
        write!(f, " {over:>5.2} of the floor {out:>3} out {:>6.1} s ", self.seconds)?;
        for truth in &self.truths {
            let mark = match (truth.named, truth.in_set) {
                (true, _) if truth.as_twin => '=',
                (true, _) => '+',
                (_, true) => '~',
                _ => '-',
            };
            write!(f, " {mark}{}@{} {:.1}", truth.what.effect, truth.what.place, truth.ratio)?;
        }
        for found in self.found.iter().filter(|f| f.physical && !self.is_true(f)) {
            write!(f, " !{}@{}", found.what.effect, found.what.place)?;
        }
        if let Some([_, checked, written]) = self.again {
            write!(f, " again {checked:.3} {written:.3}")?;
        }
        if let Some(error) = &self.error {
            write!(f, " {error}")?;
        }
        Ok(())
    }
}
