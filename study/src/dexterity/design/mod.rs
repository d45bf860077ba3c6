//! A plan of tests: which postures and loads say most about the springs (or about springs and
//! zeros together) before anything is measured.
//!
//! Postures are drawn within the joint limits. The less dexterous half is left out (`1/κ_F` of
//! [`super::inverse_condition`]), and of the rest those in which leaving K_C out would cost most
//! ([`super::influence`]). Of these postures, each with one of the loads, those are chosen whose
//! regressors `B` make `det Σ BᵀB` largest: D-optimality, by adding one test after the other and
//! then exchanging as long as that helps (Fedorov). Two effects are told apart by T-optimality
//! (`separate`).

mod bench;
mod candidates;
mod exchange;
#[cfg(test)]
mod plans;
mod separate;
mod suspect;
#[cfg(test)]
mod tests;
mod trial;

pub use separate::{DEVIATIONS, Told};
pub use suspect::{Number, Suspect, SuspectError};

use nalgebra::Vector6;

use super::DexterityError;
use crate::effects::Known;
use crate::instrument;
use crate::whole::Whole;
use candidates::{Block, Pool};
use exchange::{Aim, Choices};
use separate::Apart;

/// What the tests are for.
#[derive(Clone, Debug, PartialEq)]
pub enum Purpose {
    /// The joints' compliances, from displacements under a load.
    Identify,
    /// Zeros and compliances of the joints, from poses: each posture without a load and under one.
    Diagnose,
    /// To tell two effects apart: from displacements if both show in them, else from poses.
    Separate([Suspect; 2]),
}

/// What to plan.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// How many postures.
    pub count: usize,
    /// What for.
    pub purpose: Purpose,
    /// What is fitted along when two effects are told apart: frames that are not known.
    pub along: Vec<Suspect>,
    /// The loads to choose from, base axes at the tool origin.
    pub loads: Vec<Vector6<f64>>,
    /// Standard deviation of a measured coordinate, m.
    pub noise_position: f64,
    /// Standard deviation of a component of a measured rotation, rad; none if rotations are not
    /// measured.
    pub noise_rotation: Option<f64>,
    /// What is read of a bench in place of a position; none without a bench. Its constants are co-estimated.
    pub bench: Vec<Station>,
    /// Plates below which no joint of the arm is.
    pub plates: Vec<instrument::Plane>,
    /// Of the postures drawn.
    pub seed: u64,
}

/// What is read of a bench, where it is roughly.
#[derive(Clone, Debug, PartialEq)]
pub enum Station {
    /// A point or a plane.
    Thing(instrument::Aim),
    /// A board before a camera.
    Board(instrument::Look),
}

/// One test.
#[derive(Clone, Debug, PartialEq)]
pub struct Planned {
    /// Joint values, rad or m.
    pub q: Vec<f64>,
    /// Base axes at the tool origin.
    pub wrench: Vector6<f64>,
    /// From which side each joint is to come to rest, −1 or 1, if that matters.
    pub direction: Option<Vec<i8>>,
    /// The number of the thing of the plan's bench that is read.
    pub thing: Option<usize>,
    /// `1/κ_F(J_N)`.
    pub inverse_condition: f64,
    /// ν_p, the largest under any of the loads.
    pub nu_p: f64,
}

/// What the tests will say of one number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Expected {
    /// From 1.
    pub joint: usize,
    /// Standard deviation of the joint's compliance, rad/(N·m) or m/N; none if no test shows it.
    pub compliance: Option<f64>,
    /// Standard deviation of the joint's zero, rad or m; none if that is not asked for or no test
    /// shows it.
    pub zero: Option<f64>,
}

/// A plan.
#[derive(Clone, Debug, PartialEq)]
pub struct Design {
    /// In the order in which they were chosen.
    pub tests: Vec<Planned>,
    /// Whether displacements are to be measured, loaded minus unloaded; else poses, each posture
    /// without a load and under one.
    pub displacements: bool,
    /// Of springs (and zeros): one for each joint; none where two effects are told apart.
    pub expected: Vec<Expected>,
    /// Of the two effects that are told apart.
    pub told: Vec<Told>,
    /// L of the condition numbers, m.
    pub length: f64,
    /// How many times as many tests drawn at random from the same postures and loads would say as
    /// much: the ratio of the determinants, per unknown.
    pub efficiency: f64,
}

/// Plans tests for an arm, effects of its file and all; `done` is told the part of the work that is done, from 0 to 1.
///
/// # Errors
/// [`DexterityError::Setting`] without tests or loads; [`DexterityError::Unlimited`] if a prismatic
/// joint has no limits; [`DexterityError::AllSingular`]; [`DexterityError::Unstable`] if the arm
/// buckles under every load in every posture drawn; of two effects [`DexterityError::Idle`] if no
/// test shows one, and [`DexterityError::Alike`] if none tells them apart.
pub fn design<'a>(
    whole: impl Into<Whole<'a>>,
    plan: &Plan,
    done: &dyn Fn(f64),
) -> Result<Design, DexterityError> {
    check(plan)?;
    let Whole { arm, known } = whole.into();
    // What happened in one session does not happen in another.
    let known: Vec<Known> = known.iter().filter(|one| one.session.is_none()).cloned().collect();
    let whole = Whole { arm, known: &known };
    let pool = candidates::draw(whole, plan)?;
    if let Purpose::Separate(pair) = &plan.purpose {
        return apart(whole, plan, pair, &pool, done);
    }
    let zeros = plan.purpose == Purpose::Diagnose;
    let blocks = candidates::blocks(whole, plan, &pool.postures, zeros)?;
    let n = arm.dof();
    let unknowns = if zeros { 2 * n } else { n };
    let places = plan.constants(plan.bench.len()).start;
    let mut kinds: Vec<usize> = (0..unknowns).map(|c| c / n).collect();
    kinds.extend((0..places).map(|_| 2));
    let choices = Choices::new(&blocks, &kinds, &Aim::All);
    let chosen = choices.choose(plan.count, done);
    let deviations = choices.deviations(&chosen);
    let expected = (0..n).map(|j| Expected {
        joint: j + 1,
        compliance: deviations[j],
        zero: if zeros { deviations[n + j] } else { None },
    });
    Ok(Design {
        tests: tests(plan, &pool, &blocks, &chosen),
        displacements: !zeros,
        expected: expected.collect(),
        told: Vec::new(),
        length: pool.length,
        efficiency: choices.efficiency(&chosen, plan.seed),
    })
}

/// The same to tell two effects apart.
fn apart(
    whole: Whole<'_>,
    plan: &Plan,
    pair: &[Suspect; 2],
    pool: &Pool,
    done: &dyn Fn(f64),
) -> Result<Design, DexterityError> {
    let apart = Apart::new(whole, plan, pair, &pool.postures)?;
    let both = [apart.columns(0), apart.columns(1)];
    let aim = Aim::Apart([&both[0], &both[1]]);
    let choices = Choices::new(&apart.blocks, &apart.kinds(), &aim);
    let chosen = choices.choose(plan.count, done);
    let told = apart.told(plan, pair, &chosen);
    if told.iter().all(|t| t.numbers.iter().all(|(_, deviation)| deviation.is_none())) {
        let [first, second] = [&told[0].effect, &told[1].effect].map(Clone::clone);
        return Err(DexterityError::Alike { first, second });
    }
    Ok(Design {
        tests: tests(plan, pool, &apart.blocks, &chosen),
        displacements: apart.displacements,
        expected: Vec::new(),
        told,
        length: pool.length,
        efficiency: choices.efficiency(&chosen, plan.seed),
    })
}

fn tests(plan: &Plan, pool: &Pool, blocks: &[Block], chosen: &[usize]) -> Vec<Planned> {
    let each = chosen.iter().map(|&k| {
        let (posture, block) = (&pool.postures[blocks[k].posture], &blocks[k]);
        Planned {
            q: posture.q.clone(),
            wrench: plan.loads[block.load],
            direction: block.direction.clone(),
            thing: posture.thing,
            inverse_condition: posture.inverse_condition,
            nu_p: posture.nu_p,
        }
    });
    each.collect()
}

impl Plan {
    /// Among the constants of all things of the bench those of one; of one beyond them, where they end.
    fn constants(&self, thing: usize) -> core::ops::Range<usize> {
        let first = self.bench[..thing].iter().map(Station::constants).sum();
        first..first + self.bench.get(thing).map_or(0, Station::constants)
    }

    /// Standard deviation of each number of a reading.
    fn noises(&self) -> Vec<f64> {
        let mut noises = vec![self.noise_position; 3];
        noises.extend(self.noise_rotation.iter().flat_map(|rotation| [*rotation; 3]));
        noises
    }
}

fn check(plan: &Plan) -> Result<(), DexterityError> {
    let setting = |what, found, expected| Err(DexterityError::Setting { what, found, expected });
    if !plan.bench.is_empty() && plan.purpose != Purpose::Diagnose {
        return setting(
            "the number of things of a bench",
            plan.bench.len() as f64,
            "none but for a diagnosis",
        );
    }
    if !(1..=1000).contains(&plan.count) {
        return setting("the number of tests", plan.count as f64, "1 to 1000");
    }
    if plan.loads.iter().all(|load| *load == Vector6::zeros()) {
        return setting("the number of loads", 0.0, "at least one that is not zero");
    }
    if let Some(wrong) = plan.loads.iter().flat_map(|l| l.iter()).find(|x| !x.is_finite()) {
        return setting("a load", *wrong, "a finite number");
    }
    let noises = [Some(plan.noise_position), plan.noise_rotation];
    match noises.into_iter().flatten().find(|sd| !(sd.is_finite() && *sd > 0.0)) {
        Some(wrong) => setting("a noise", wrong, "a positive number"),
        None => Ok(()),
    }
}
