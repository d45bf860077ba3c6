//! What is to be reached.

use core::fmt;

use statrs::distribution::{Binomial, DiscreteCDF};
use stiffarm_gap::withhold::logs::LogReport;
use stiffarm_gap::withhold::{Kind, Rate, Report};

/// Rates over several reports, each with its goal.
pub struct Goals {
    pub cases: usize,
    goals: Vec<Goal>,
    /// Mean over the cases with one effect; at most 2.
    mean_set_size: Option<f64>,
}

struct Goal {
    what: &'static str,
    rate: Rate,
    /// From, to.
    wanted: [f64; 2],
}

impl Goal {
    /// If so asked, by more than chance does in one of forty runs.
    fn is_missed(&self, beyond_chance: bool) -> bool {
        let Goal { rate, wanted: [from, to], .. } = *self;
        if !beyond_chance {
            return !rate.rate.is_some_and(|r| (from..=to).contains(&r));
        }
        let misses = rate.of - rate.hits;
        at_most(rate.hits, rate.of, from) < CHANCE || at_most(misses, rate.of, 1.0 - to) < CHANCE
    }
}

fn goal(what: &'static str, wanted: [f64; 2], rate: Rate) -> Goal {
    Goal { what, rate, wanted }
}

impl Goals {
    pub fn of(reports: &[Report]) -> Goals {
        let pooled = |rate: fn(&Report) -> Rate| Rate::pooled(reports.iter().map(rate));
        let sizes = reports.iter().flat_map(|r| &r.cases).filter(|c| c.kind == Kind::Single);
        let sizes: Vec<f64> = sizes
            .filter_map(|c| c.verdict.as_ref()?.sets.first().map(|s| s.len() as f64))
            .collect();
        let mean = sizes.iter().sum::<f64>() / sizes.len() as f64;
        Goals {
            cases: reports.iter().map(|r| r.cases.len()).sum(),
            goals: vec![
                goal("false alarms", [0.0, 0.05], pooled(|r| r.false_alarms)),
                goal("named first", [0.90, 1.0], pooled(|r| r.single.first_named)),
                goal("in the set", [0.98, 1.0], pooled(|r| r.single.in_set)),
                goal("both of a pair", [0.85, 1.0], pooled(|r| r.pairs.both_in_sets)),
                goal("unknown flagged", [0.95, 1.0], pooled(|r| r.removed.flagged_of_open)),
                goal("at its joint", [0.80, 1.0], pooled(|r| r.removed.right_joint)),
                goal("gap closed", [0.90, 1.0], pooled(|r| r.after.within_1_2_of_noise)),
                goal(
                    "shrink as predicted",
                    [0.90, 0.99],
                    pooled(|r| r.shrink.map_or_else(Rate::default, |s| s.inside)),
                ),
            ],
            mean_set_size: (!sizes.is_empty()).then_some(mean),
        }
    }

    /// Of joint logs.
    pub fn of_logs(reports: &[LogReport]) -> Goals {
        let pooled = |rate: fn(&LogReport) -> Rate| Rate::pooled(reports.iter().map(rate));
        Goals {
            cases: reports.iter().map(|r| r.cases.len()).sum(),
            goals: vec![
                goal("false alarms", [0.0, 0.05], pooled(|r| r.false_alarms)),
                goal("named first", [0.90, 1.0], pooled(|r| r.single.first_named)),
                goal("in the set", [0.97, 1.0], pooled(|r| r.single.in_set)),
                goal("unknown flagged", [0.90, 1.0], pooled(|r| r.removed_flagged_of_open)),
            ],
            mean_set_size: None,
        }
    }

    /// Goals that are missed.
    pub fn missed(&self) -> Vec<String> {
        self.missed_by(false)
    }

    /// Goals that a rate misses by more than chance does in one of forty runs.
    pub fn missed_beyond_chance(&self) -> Vec<String> {
        self.missed_by(true)
    }

    fn missed_by(&self, beyond_chance: bool) -> Vec<String> {
        let missed = |goal: &&Goal| goal.is_missed(beyond_chance);
        let rates = self.goals.iter().filter(missed).map(|g| g.what);
        let sets = self.mean_set_size.filter(|size| *size > 2.0).map(|_| "mean set size");
        rates.chain(sets).map(str::to_owned).collect()
    }
}

/// One of forty runs.
const CHANCE: f64 = 1.0 / 40.0;

/// The chance of no more than so many hits of `of`, each with chance `rate`.
fn at_most(hits: usize, of: usize, rate: f64) -> f64 {
    Binomial::new(rate, of as u64).expect("a chance").cdf(hits as u64)
}

impl fmt::Display for Goals {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{} cases", self.cases)?;
        for Goal { what, rate, wanted: [from, to] } in &self.goals {
            let percent = rate.rate.map_or_else(String::new, |r| format!("{:.1} %", 100.0 * r));
            let (hits, of) = (rate.hits, rate.of);
            writeln!(f, "{what:>20} {percent:>8} {hits:>4} of {of:<4} wanted {from} to {to}")?;
        }
        let size = self.mean_set_size.map_or_else(String::new, |s| format!("{s:.2}"));
        writeln!(f, "{:>20} {size:>8}              wanted at most 2", "mean set size")
    }
}
