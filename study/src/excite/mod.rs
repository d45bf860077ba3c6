//! Motions that say most: finite Fourier series within limits, chosen before anything is logged.
//!
//! What an effect does to the log of a motion is asked of the plant that [moves](crate::plant::motion),
//! and of it only what no other masses of the links could do counts. With many effects the determinant of
//! their products is made largest (D-optimality): the volume that noise leaves to their numbers. With two
//! the smaller of what stands apart from the other (T-optimality). The search begins with the best of
//! some motions of chance, and varies one joint after the other as long as that helps.

mod basis;
mod columns;
#[cfg(test)]
mod tests;

use stiffarm_kernels::generic::Arm;

pub use basis::{Basis, norm};
use columns::{Columns, Suspects};

use crate::effects::Spot;
use crate::infer::middle;
use crate::plant::course::{Fourier, Limits};
use crate::plant::motion::{Law, Logged, MotionError};
use crate::rng::{Rng, Stream};

/// Motions of chance that the search begins with.
const DRAWN: usize = 24;

/// By how much of their own the terms of a joint are varied at first.
const VARIED: f64 = 0.5;

/// A variation that helps is followed by larger ones, and so the other way: one in five is to help
/// (Rechenberg 1973).
const LARGER: f64 = 1.5;
/// See [`LARGER`].
const SMALLER: f64 = 0.903;

/// What to look for.
#[derive(Clone, Debug, PartialEq)]
pub enum Purpose {
    /// All numbers of these.
    All(Vec<(&'static Law, Spot)>),
    /// Two that are to be told from each other.
    Apart([(&'static Law, Spot); 2]),
}

/// What to plan.
pub struct Plan<'a> {
    /// The robot.
    pub arm: &'a Arm,
    /// That are held.
    pub limits: &'a Limits,
    /// What will be logged.
    pub logged: Logged,
    /// What for.
    pub purpose: Purpose,
    /// Of the motion, s.
    pub period: f64,
    /// Of the series.
    pub harmonics: usize,
    /// Variations that are tried.
    pub tries: usize,
    /// Decides everything.
    pub seed: u64,
}

/// A number of an effect, as a motion tells it.
#[derive(Clone, Debug, PartialEq)]
pub struct Told {
    /// The effect.
    pub effect: &'static str,
    /// Where.
    pub spot: Spot,
    /// The number.
    pub number: &'static str,
    /// How many times as wide its interval would be after a motion of chance.
    pub narrower: f64,
}

/// A motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Excitation {
    /// Once through.
    pub course: Fourier,
    /// Of each number that some motion shows.
    pub told: Vec<Told>,
    /// Numbers that no motion that was tried shows.
    pub hidden: Vec<(&'static str, Spot, &'static str)>,
    /// The criterion, and its median over the motions of chance: the natural logarithm of the
    /// determinant, or the squared distance of two effects per row.
    pub value: f64,
    /// See `value`.
    pub of_chance: f64,
    /// How many times as long a motion of chance would have to be to say as much.
    pub efficiency: f64,
}

/// Why there is no motion.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ExciteError {
    /// The plant cannot be moved.
    #[error(transparent)]
    Motion(#[from] MotionError),
    /// Nothing to look for shows in any motion.
    #[error("no motion that was tried shows {what}: other masses of the links do the same")]
    Hidden {
        /// All of them.
        what: String,
    },
    /// A setting that is none.
    #[error("found {found} as {what}, expected {expected}")]
    Setting {
        /// Which.
        what: &'static str,
        /// As given.
        found: f64,
        /// What it must be.
        expected: &'static str,
    },
}

/// Plans a motion; `done` is told the part of the work that is done, from 0 to 1.
///
/// # Errors
/// [`ExciteError`].
pub fn excite(plan: &Plan<'_>, done: &dyn Fn(f64)) -> Result<Excitation, ExciteError> {
    check(plan)?;
    let mut rng = Rng::new(plan.seed, Stream::Poses);
    let mut drawn = Vec::new();
    let all = (DRAWN + plan.tries) as f64;
    let mut suspects = Suspects::of(plan);
    for k in 0..DRAWN {
        let course = Fourier::draw(plan.limits, plan.period, plan.harmonics, &mut rng);
        drawn.push((Columns::of(plan, &suspects, &course)?, course));
        done((k + 1) as f64 / all);
    }
    // What hardly any motion shows is no aim.
    let hidden = suspects.split(drawn.iter().map(|(columns, _)| columns));
    if suspects.numbers.is_empty()
        || matches!(plan.purpose, Purpose::Apart(_)) && !hidden.is_empty()
    {
        let what = hidden.iter().map(|(effect, spot, _)| format!("{effect} at {spot}"));
        let mut what: Vec<String> = what.collect();
        what.dedup();
        return Err(ExciteError::Hidden { what: what.join(", ") });
    }
    let mut of_chance = Vec::new();
    let mut best: Option<(f64, Columns, Fourier)> = None;
    for (mut columns, course) in drawn {
        columns.keep(&suspects);
        let value = columns.value(plan);
        of_chance.push((value, columns.deviations()));
        if best.as_ref().is_none_or(|(most, ..)| value > *most) {
            best = Some((value, columns, course));
        }
    }
    let Some((mut value, mut columns, mut course)) = best else {
        return Err(ExciteError::Hidden { what: "anything".to_owned() });
    };
    let mut size = VARIED;
    for k in 0..plan.tries {
        let other = course.varied(plan.limits, size, &mut rng);
        let found = Columns::of(plan, &suspects, &other)?;
        let as_good = found.value(plan);
        if as_good > value {
            (value, columns, course) = (as_good, found, other);
            size = (size * LARGER).min(1.0);
        } else {
            size *= SMALLER;
        }
        done((DRAWN + k + 1) as f64 / all);
    }
    let usual = middle(of_chance.iter().map(|(value, _)| *value)).unwrap_or(f64::NAN);
    let deviations = columns.deviations();
    let told = suspects.numbers.iter().enumerate().map(|(k, number)| Told {
        effect: number.law.name,
        spot: number.spot,
        number: number.name,
        narrower: middle(of_chance.iter().map(|(_, sd)| sd[k])).unwrap_or(f64::NAN) / deviations[k],
    });
    let efficiency = match plan.purpose {
        Purpose::All(_) => ((value - usual) / suspects.numbers.len() as f64).exp(),
        Purpose::Apart(_) => value / usual,
    };
    let told = told.collect();
    Ok(Excitation { course, told, hidden, value, of_chance: usual, efficiency })
}

fn check(plan: &Plan<'_>) -> Result<(), ExciteError> {
    let setting = |what, found, expected| Err(ExciteError::Setting { what, found, expected });
    if !(plan.period > 0.0 && plan.period.is_finite()) {
        return setting("the period", plan.period, "a positive time");
    }
    if !(3..=100).contains(&plan.harmonics) {
        // Two conditions at the ends leave nothing of fewer.
        return setting("the number of harmonics", plan.harmonics as f64, "3 to 100");
    }
    Ok(())
}
