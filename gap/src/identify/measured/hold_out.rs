//! How large the gap is by the robot file, and on poses that the fit has not seen.

use nalgebra::Vector6;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

use super::fit::{FITTED, Fitted, step};
use super::regress::Sheet;
use super::{MeasuredError, Question};
use crate::random::uniform;

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
#[derive(Clone, Debug, PartialEq)]
pub struct Gap {
    /// By the robot file as it is.
    pub before: Spread,
    /// By what the other poses identify.
    pub held_out: Spread,
    /// Measured minus simulated of each row, before and held out, m and rad; of poses less the mean
    /// over the loads of the pose. 0 where a component is not measured.
    pub rows: [Vec<Vector6<f64>>; 2],
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
    let mask = Vector6::from_iterator(data.kind.components().map(f64::from));
    let fold = shuffled(poses, folds, question.seed);
    let mut gaps = [(); 2].map(|()| vec![Vector6::zeros(); data.rows.len()]);
    for held in 0..folds {
        done(FITTED + (1.0 - FITTED) * held as f64 / folds as f64);
        let (out, rest): (Vec<usize>, Vec<usize>) =
            (0..data.rows.len()).partition(|&k| fold[data.rows[k].group] == held);
        let start = sheet.start();
        let mut x = fitted.x.clone();
        for _ in 0..STEPS {
            x = step(sheet, &rest, x, &fitted.choice.found, &fitted.noise)?.0;
        }
        for (gaps, x) in gaps.iter_mut().zip([&start, &x]) {
            for (&row, line) in out.iter().zip(sheet.lines(&out, x)?) {
                gaps[row] = line.gap.component_mul(&mask);
            }
        }
    }
    let [before, held_out] = gaps.each_ref().map(|gaps| spread(gaps));
    Ok(Gap { before, held_out, rows: gaps, folds })
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

fn spread(gaps: &[Vector6<f64>]) -> Spread {
    let size = |gap: &Vector6<f64>, first: usize| gap.fixed_rows::<3>(first).norm_squared();
    let mean =
        |first: usize| gaps.iter().map(|g| size(g, first)).sum::<f64>() / gaps.len().max(1) as f64;
    Spread {
        position_rms: mean(0).sqrt(),
        position_max: gaps.iter().map(|g| size(g, 0).sqrt()).fold(0.0, f64::max),
        rotation_rms: mean(3).sqrt(),
    }
}
