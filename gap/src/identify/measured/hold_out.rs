//! How large the gap is by the robot file, and on poses that the fit has not seen.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

use super::fit::{FITTED, Fitted, step};
use super::regress::{Line, Sheet};
use super::{MeasuredError, Question};
use crate::identify::random::uniform;

/// By default each pose is held out in turn up to so many poses.
const FOLDS: usize = 10;

/// From the fit to all rows to the fit without some: the first step does what is linear, the second
/// what it leaves.
const STEPS: usize = 2;

/// Sizes of some gaps.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Spread {
    /// Root mean square of the distances, m; of the measured components.
    pub position_rms: f64,
    /// Largest distance, m.
    pub position_max: f64,
    /// Root mean square of the rotations, rad.
    pub rotation_rms: f64,
}

/// Before and after.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gap {
    /// By the robot file as it is.
    pub before: Spread,
    /// By what the other poses identify.
    pub held_out: Spread,
    /// How many folds.
    pub folds: usize,
}

/// Holds each fold of poses out in turn.
pub(super) fn gap(
    sheet: &Sheet<'_>,
    fitted: &Fitted,
    question: &Question,
    done: &dyn Fn(f64),
) -> Result<Gap, MeasuredError> {
    let (data, poses) = (sheet.data, sheet.data.poses);
    let folds = question.folds.unwrap_or_else(|| poses.min(FOLDS));
    if !(2..=poses).contains(&folds) {
        let file = data.file.clone();
        return Err(MeasuredError::Folds { file, found: folds, poses });
    }
    let fold = shuffled(poses, folds, question.seed);
    let (mut before, mut after) = (Vec::new(), Vec::new());
    for held in 0..folds {
        done(FITTED + (1.0 - FITTED) * held as f64 / folds as f64);
        let (out, rest): (Vec<usize>, Vec<usize>) =
            (0..data.rows.len()).partition(|&k| fold[data.rows[k].group] == held);
        let start = sheet.start();
        let mut x = fitted.x.clone();
        for _ in 0..STEPS {
            x = step(sheet, &rest, x, &fitted.choice.found, &fitted.noise)?.0;
        }
        before.extend(sheet.lines(&out, &start)?);
        after.extend(sheet.lines(&out, &x)?);
    }
    let components = data.kind.components();
    Ok(Gap { before: spread(&before, components), held_out: spread(&after, components), folds })
}

/// The fold of each pose.
fn shuffled(poses: usize, folds: usize, seed: u64) -> Vec<usize> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut fold: Vec<usize> = (0..poses).map(|k| k % folds).collect();
    for k in (1..poses).rev() {
        fold.swap(k, ((uniform(&mut random) * (k + 1) as f64) as usize).min(k));
    }
    fold
}

fn spread(lines: &[Line], components: [bool; 6]) -> Spread {
    let size = |line: &Line, first: usize| {
        let each = (first..first + 3).filter(|&k| components[k]);
        each.map(|k| line.gap[k].powi(2)).sum::<f64>()
    };
    let mean = |first: usize| {
        lines.iter().map(|line| size(line, first)).sum::<f64>() / lines.len().max(1) as f64
    };
    Spread {
        position_rms: mean(0).sqrt(),
        position_max: lines.iter().map(|line| size(line, 0).sqrt()).fold(0.0, f64::max),
        rotation_rms: mean(3).sqrt(),
    }
}
