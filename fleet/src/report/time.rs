//! The same arm over time: what changed since its last campaign.

use super::campaigns::Campaign;
use super::numbers::{What, by_arm, of, short};

/// What is another at an arm.
#[derive(Clone, Debug)]
pub struct Change {
    /// The arm.
    pub arm: String,
    /// The two campaigns.
    pub between: [String; 2],
    /// What it is about.
    pub what: What,
    /// What became of it.
    pub kind: Kind,
}

/// What became of a number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// Found now, not then: its value and 95 % interval.
    Came(f64, [f64; 2]),
    /// Found then, not now: the same of then.
    Went(f64, [f64; 2]),
    /// Found both times, and the difference is told from zero.
    Changed {
        /// Then and now.
        values: [f64; 2],
        /// 95 % interval of the difference.
        difference: [f64; 2],
    },
}

/// The changes between the last two campaigns of each arm, and how many numbers were compared.
pub fn changes(campaigns: &[Campaign]) -> (Vec<Change>, usize) {
    let (mut changes, mut compared) = (Vec::new(), 0);
    for (arm, diagnosed) in by_arm(campaigns) {
        let [.., (last, then), (this, now)] = &diagnosed[..] else { continue };
        let (then, now) = (of(&last.robot, then), of(&this.robot, now));
        let change = |what: &What, kind| Change {
            arm: arm.to_owned(),
            between: [last.name.clone(), this.name.clone()],
            what: what.clone(),
            kind,
        };
        for (what, now) in &now {
            let Some(then) = then.get(what) else {
                // A number of it that is nothing is no news.
                if now.value != 0.0 {
                    changes.push(change(what, Kind::Came(now.value, now.ci95)));
                }
                continue;
            };
            compared += 1;
            let half = |[low, high]: [f64; 2]| 0.5 * (high - low);
            let (by, half) = (now.value - then.value, half(then.ci95).hypot(half(now.ci95)));
            if by.abs() > half {
                let (values, difference) = ([then.value, now.value], [by - half, by + half]);
                changes.push(change(what, Kind::Changed { values, difference }));
            }
        }
        let went = then.iter().filter(|(what, of)| of.value != 0.0 && !now.contains_key(what));
        changes.extend(went.map(|(what, then)| change(what, Kind::Went(then.value, then.ci95))));
    }
    (changes, compared)
}

impl Change {
    /// What became of it, in words.
    pub fn said(&self) -> String {
        let unit = &self.what.unit;
        match self.kind {
            Kind::Came(now, [low, high]) => {
                format!("came: {} {unit} [{} to {}]", short(now), short(low), short(high))
            }
            Kind::Went(then, [low, high]) => {
                format!("went: was {} {unit} [{} to {}]", short(then), short(low), short(high))
            }
            Kind::Changed { values: [then, now], difference: [low, high] } => format!(
                "{} → {} {unit}, by {} [{} to {}]",
                short(then),
                short(now),
                short(now - then),
                short(low),
                short(high)
            ),
        }
    }
}
