//! The sum over many arms, and what is to be reached.

use core::fmt;

use serde::Serialize;
use stiffarm_gap::gap::percentile;

use super::case::Case;

/// Goals: from, to.
const NAMED: [f64; 2] = [0.95, 1.0];
const IN_SET: [f64; 2] = [0.98, 1.0];
const FIRST: [f64; 2] = [0.97, 1.0];
const SPURIOUS: [f64; 2] = [0.0, 0.1];
const ALARMS: [f64; 2] = [0.0, 0.05];
const AT_FLOOR: [f64; 2] = [0.95, 1.0];
const COVERED: [f64; 2] = [0.90, 0.98];
const SHRINK: [f64; 2] = [0.90, 1.0];
const AGAIN: [f64; 2] = [1.0, 1.0];

/// A gap of this many times the noise's own counts as closed.
pub const CLOSED: f64 = 1.2;

/// The written arm leaves what was announced, to this part.
const SAME: f64 = 0.05;

/// One figure and its goal.
#[derive(Clone, Debug, Serialize)]
pub struct Figure {
    pub what: &'static str,
    pub hits: usize,
    pub of: usize,
    /// From, to; of the quotient.
    pub wanted: [f64; 2],
}

/// All figures.
#[derive(Clone, Debug, Serialize)]
pub struct Score {
    pub arms: usize,
    pub failed: usize,
    pub figures: Vec<Figure>,
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
        let first: Vec<bool> = cases.iter().filter_map(|c| c.first).collect();
        let covered: Vec<bool> = truths().flat_map(|t| t.covered.iter().copied()).collect();
        let shrinks = || cases.iter().filter_map(|c| c.shrink.as_ref());
        let inside = shrinks().filter(|s| (s.ci95[0]..=s.ci95[1]).contains(&s.realised)).count();
        let yes = |list: &[bool]| list.iter().filter(|y| **y).count();
        let figure = |what, hits, of, wanted| Figure { what, hits, of, wanted };
        let again: Vec<[f64; 3]> = cases.iter().filter_map(|c| c.again).collect();
        let same = |[_, checked, written]: &&[f64; 3]| {
            [checked, written].iter().all(|ratio| (**ratio - 1.0).abs() <= SAME)
        };
        let quantiles = |mut values: Vec<f64>| {
            values.sort_by(f64::total_cmp);
            [0.0, 0.5, 1.0].map(|part| percentile(&values, part))
        };
        let [_, median, longest] = quantiles(cases.iter().map(|c| c.seconds).collect());
        let spurious = cases.iter().map(|c| c.spurious).sum();
        let alarms = plain().filter(|c| c.spurious > 0).count();
        let closed = cases.iter().filter(|c| c.over_floor() <= CLOSED).count();
        Score {
            arms: cases.len(),
            failed: cases.iter().filter(|c| c.error.is_some()).count(),
            figures: vec![
                figure("named", truths().filter(|t| t.named).count(), truths().count(), NAMED),
                figure(
                    "in the set",
                    truths().filter(|t| t.in_set).count(),
                    truths().count(),
                    IN_SET,
                ),
                figure("first one true", yes(&first), first.len(), FIRST),
                figure("spurious, an arm", spurious, cases.len(), SPURIOUS),
                figure("alarms on geometry", alarms, plain().count(), ALARMS),
                figure("at the floor", closed, cases.len(), AT_FLOOR),
                figure("intervals cover", yes(&covered), covered.len(), COVERED),
                figure("shrink as predicted", inside, shrinks().count(), SHRINK),
                figure("the same again", again.iter().filter(same).count(), cases.len(), AGAIN),
            ],
            twins: truths().filter(|t| t.as_twin).count(),
            again: [0, 1, 2].map(|k| quantiles(again.iter().map(|ratios| ratios[k]).collect())),
            seconds: [median, longest],
        }
    }

    /// Goals that are missed; what there is nothing to judge by is.
    pub fn missed(&self) -> Vec<&'static str> {
        self.figures.iter().filter(|f| !f.met()).map(|f| f.what).collect()
    }
}

impl Figure {
    fn rate(&self) -> f64 {
        self.hits as f64 / self.of as f64
    }

    fn met(&self) -> bool {
        (self.wanted[0]..=self.wanted[1]).contains(&self.rate())
    }
}

impl fmt::Display for Score {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{} arms, {} without a diagnosis", self.arms, self.failed)?;
        for figure in &self.figures {
            let Figure { what, hits, of, wanted: [from, to] } = figure;
            let (rate, met) = (figure.rate(), if figure.met() { "" } else { "   missed" });
            writeln!(f, "{what:>20} {rate:>7.3} {hits:>4} of {of:<4} wanted {from} to {to}{met}")?;
        }
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
