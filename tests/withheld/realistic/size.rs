//! How large an effect is: what it does at the rows, and what is left of that beside all ordinary
//! calibration.

use nalgebra::{DMatrix, DVector};
use stiffarm_gap::effects::{BaseFrame, Effect, JointOffset, LinkGeometry, Place, ToolFrame};
use stiffarm_gap::gap::row_gap;
use stiffarm_gap::measurement::Measurements;
use stiffarm_gap::simulate::Reading;
use stiffarm_kernels::generic::Arm;
use stiffarm_plant::{Frames, Noise, Plant, Truth};

/// A small change of a frame or a row, m or rad: its columns are differences of the plant.
const STEP: f64 = 1e-5;

/// A column of which less is left beside the others is one of them: the plant's digits over the
/// step's.
const SAME: f64 = 1e-7;

/// An arm on its rows as it is designed.
pub struct Bench<'a> {
    arm: &'a Arm,
    design: &'a Measurements,
    frames: &'a Frames,
    scale: Noise,
    nominal: Measurements,
    /// Orthonormal: what frames, offsets and rows of the table do, in units of the noise.
    ordinary: DMatrix<f64>,
}

/// The truth of every frame, offset and row of the table, each by itself.
pub fn ordinary(arm: &Arm) -> Vec<(&'static dyn Effect, Place, String)> {
    const ALL: [&dyn Effect; 4] = [&BaseFrame, &ToolFrame, &JointOffset, &LinkGeometry];
    let mut all = Vec::new();
    for effect in ALL {
        for place in effect.places(arm) {
            let numbers = effect.numbers(arm, place).into_iter();
            all.extend(numbers.map(|number| (effect, place, number.name.into_owned())));
        }
    }
    all
}

impl<'a> Bench<'a> {
    pub fn new(
        arm: &'a Arm,
        design: &'a Measurements,
        frames: &'a Frames,
        scale: Noise,
    ) -> Bench<'a> {
        let nominal = exact(arm, design, frames, &[]).expect("the arm as it is designed");
        let empty = DMatrix::zeros(0, 0);
        let mut bench = Bench { arm, design, frames, scale, nominal, ordinary: empty };
        let columns: Vec<DVector<f64>> = ordinary(arm)
            .into_iter()
            .map(|(effect, place, name)| {
                let truth = Truth { effect, place, values: vec![(name, STEP)] };
                bench.signal(&truth).expect("a small change") / STEP
            })
            .collect();
        bench.ordinary = orthonormal(columns[0].len(), &columns);
        bench
    }

    /// What an effect does, in units of the noise; `None` if the arm does not carry it.
    pub fn signal(&self, truth: &Truth) -> Option<DVector<f64>> {
        let with = exact(self.arm, self.design, self.frames, core::slice::from_ref(truth))?;
        let measured = self.design.kind.components();
        let rows = with.rows.iter().zip(&self.nominal.rows);
        let numbers = rows.flat_map(|(with, without)| {
            let off = row_gap(self.design, with, &Reading::from_vector(&without.measured));
            let Noise { position, rotation } = self.scale;
            let white = move |k: usize| off[k] / if k < 3 { position } else { rotation };
            (0..6).filter(|k| measured[*k]).map(white).collect::<Vec<_>>()
        });
        Some(DVector::from_vec(numbers.collect()))
    }

    /// Root mean square over rows of the distance by which an effect moves the tool, in multiples
    /// of that of the instrument's scale: the size of an effect as one says it.
    pub fn ratio(&self, signal: &DVector<f64>) -> f64 {
        let each = signal.len() / self.design.rows.len();
        let squares = signal.iter().enumerate().filter(|(k, _)| k % each < 3).map(|(_, x)| x * x);
        (squares.sum::<f64>() / (3 * self.design.rows.len()) as f64).sqrt()
    }

    /// Root of the sum of squares, in units of the noise, of what frames, offsets, rows and the
    /// other effects leave of a signal: what the best analyst could find it by.
    pub fn evidence(&self, signal: &DVector<f64>, others: &[&DVector<f64>]) -> f64 {
        let beside =
            |signal: &DVector<f64>| signal - &self.ordinary * (self.ordinary.tr_mul(signal));
        let others: Vec<DVector<f64>> = others.iter().map(|other| beside(other)).collect();
        let others = orthonormal(signal.len(), &others);
        let own = beside(signal);
        (&own - &others * others.tr_mul(&own)).norm()
    }
}

/// What a noiseless instrument shows; `None` if the arm does not carry the truths.
pub fn exact(
    arm: &Arm,
    design: &Measurements,
    frames: &Frames,
    truths: &[Truth],
) -> Option<Measurements> {
    Plant::new(arm, truths).ok()?.with_frames(frames.clone()).exact(design).ok()
}

/// A basis of what the columns span (Gram and Schmidt, twice over), each of so many rows.
fn orthonormal(rows: usize, columns: &[DVector<f64>]) -> DMatrix<f64> {
    let mut basis: Vec<DVector<f64>> = Vec::new();
    for column in columns {
        let mut left = column.clone();
        for own in basis.iter().chain(&basis) {
            left -= own * own.dot(&left);
        }
        if left.norm() > SAME * column.norm() {
            basis.push(left.normalize());
        }
    }
    if basis.is_empty() { DMatrix::zeros(rows, 0) } else { DMatrix::from_columns(&basis) }
}
