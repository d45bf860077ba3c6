//! How many tests, and how exact (Dumas et al., sections 5.1-5.2, Fig. 7 and Table 2).

use stiffarm_kernels::generic::Arm;

use super::rig::{Errors, PoseFit, Rig, carry_out};
use super::{IdentifyError, Test, Weighting, identify};
use stiffarm_gap::gap::percentile;
use stiffarm_gap::rng::{Rng, Stream};

/// Stiffnesses from many sets of equally many tests.
#[derive(Clone, Debug, PartialEq)]
pub struct Spread {
    /// Tests in a set.
    pub tests: usize,
    /// Sets that determined every joint with a positive compliance.
    pub solved: usize,
    /// Sets drawn.
    pub sets: usize,
    /// Of each joint the 16 %, 50 % and 84 % quantiles of the stiffness over the solved sets; none
    /// if no set was solved.
    pub stiffness: Option<Vec<[f64; 3]>>,
}

impl Spread {
    /// Of each joint half of the distance of the outer quantiles, as a part of the middle one.
    pub fn half_widths(&self) -> Option<Vec<f64>> {
        let all = self.stiffness.as_ref()?;
        Some(all.iter().map(|[low, middle, high]| (high - low) / (2.0 * middle)).collect())
    }
}

/// Fig. 7: for each number in `counts`, `sets` random sets of that many of the tests, none twice in
/// a set. A number above that of the tests counts as that of the tests.
///
/// # Errors
/// As [`identify`], but for joints that a set leaves open: such a set counts as not solved.
pub fn number_of_tests(
    arm: &Arm,
    tests: &[Test],
    by: &Weighting,
    counts: &[usize],
    sets: usize,
    seed: u64,
) -> Result<Vec<Spread>, IdentifyError> {
    let mut rng = Rng::new(seed, Stream::Starts);
    let mut spreads = Vec::with_capacity(counts.len());
    for &count in counts {
        let count = count.min(tests.len());
        let mut solved: Vec<Vec<f64>> = Vec::new();
        for _ in 0..sets {
            let set = subset(tests, count, &mut rng);
            match identify(arm, &set, by) {
                Ok(found) => solved.extend(found.stiffnesses()),
                Err(IdentifyError::Open(_)) => {}
                Err(other) => return Err(other),
            }
        }
        let of_joint = |j: usize| {
            let mut values: Vec<f64> = solved.iter().map(|all| all[j]).collect();
            values.sort_by(f64::total_cmp);
            [0.16, 0.5, 0.84].map(|part| percentile(&values, part))
        };
        let stiffness = (!solved.is_empty()).then(|| (0..arm.dof()).map(of_joint).collect());
        spreads.push(Spread { tests: count, solved: solved.len(), sets, stiffness });
    }
    Ok(spreads)
}

fn subset(tests: &[Test], count: usize, rng: &mut Rng) -> Vec<Test> {
    let mut order: Vec<usize> = (0..tests.len()).collect();
    for k in 0..count {
        let left = order.len() - k;
        let pick = k + rng.below(left);
        order.swap(k, pick);
    }
    order[..count].iter().map(|&k| tests[k].clone()).collect()
}

/// The error of one joint's stiffness over repeated experiments.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StiffnessError {
    /// From 1.
    pub joint: usize,
    /// As it is, N·m/rad.
    pub stiffness: f64,
    /// Mean of what was identified less what it is, as a part of it.
    pub bias: f64,
    /// Standard deviation of what was identified, as a part of it.
    pub deviation: f64,
}

/// What is repeated.
#[derive(Clone, Copy, Debug)]
pub struct Repeat<'a> {
    /// The experiment.
    pub rig: &'a Rig,
    /// Its errors, standard deviations.
    pub errors: Errors,
    /// From reflectors to displacement.
    pub fit: PoseFit,
    /// How often.
    pub draws: usize,
    /// Of the errors.
    pub seed: u64,
}

/// Table 2: the planned tests carried out again and again on `arm`, which has the true stiffnesses,
/// each time with other errors, and identified. Experiments that give a compliance that is not
/// positive are left out.
///
/// # Errors
/// As [`identify`] and [`carry_out`].
pub fn measurement_errors(
    arm: &Arm,
    plan: &[Test],
    by: &Weighting,
    repeat: &Repeat<'_>,
) -> Result<Vec<StiffnessError>, IdentifyError> {
    let mut all: Vec<Vec<f64>> = Vec::new();
    for draw in 0..repeat.draws {
        let seed = repeat.seed.wrapping_add(draw as u64);
        let tests = carry_out(arm, repeat.rig, plan, repeat.errors, repeat.fit, seed)?;
        all.extend(identify(arm, &tests, by)?.stiffnesses());
    }
    let count = all.len() as f64;
    let of_joint = |j: usize| {
        let stiffness = 1.0 / arm.joints[j].compliance;
        let mean = all.iter().map(|k| k[j]).sum::<f64>() / count;
        let square = all.iter().map(|k| (k[j] - mean).powi(2)).sum::<f64>() / (count - 1.0);
        StiffnessError {
            joint: j + 1,
            stiffness,
            bias: mean / stiffness - 1.0,
            deviation: square.sqrt() / stiffness,
        }
    };
    Ok((0..arm.dof()).map(of_joint).collect())
}
