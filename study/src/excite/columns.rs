//! What effects do to the log of one motion, beyond what other masses could do.

use nalgebra::{DMatrix, DVector};

use super::basis::{Basis, norm};
use super::{Plan, Purpose};
use crate::effects::{Place, Spot};
use crate::plant::course::{Course, Fourier, State};
use crate::plant::motion::{
    Law, Logged, MotionError, MotionTruth, MovingPlant, Recording, Stage, links,
};

/// Samples per period of the highest harmonic.
const SAMPLES: f64 = 8.0;

/// The size at which an effect is asked what it does: small, for most are in proportion to theirs, and
/// so much above rounding that nine digits are left.
const SIZE: f64 = 1e-6;

/// A number of which this part or less is beyond other masses in every motion is not shown.
const SHOWN: f64 = 1e-3;

/// A number of an effect.
pub(super) struct Number {
    pub(super) law: &'static Law,
    pub(super) spot: Spot,
    pub(super) name: &'static str,
    /// Of all of the effect's, with this one small.
    values: Vec<f64>,
    /// Which of the two effects it is of.
    of: usize,
}

/// All numbers that are looked for.
pub(super) struct Suspects {
    pub(super) numbers: Vec<Number>,
    /// Which of those asked first they are.
    kept: Vec<usize>,
}

/// What a unit of each number does in a motion, each joint in its own size.
pub(super) struct Columns {
    beyond: Vec<Vec<f64>>,
    whole: Vec<f64>,
    of: Vec<usize>,
}

impl Suspects {
    pub(super) fn of(plan: &Plan<'_>) -> Suspects {
        let wanted: &[(&'static Law, Spot)] = match &plan.purpose {
            Purpose::All(wanted) => wanted,
            Purpose::Apart(pair) => pair,
        };
        let numbers = wanted.iter().enumerate().flat_map(|(of, (law, spot))| {
            let own = law.numbers.iter().enumerate().filter(|(_, (name, _))| !law.is_form(name));
            own.map(move |(k, (name, _))| {
                let fastest = match spot.place {
                    Place::Joint(joint) | Place::Pair(joint, ..) => plan.limits.rate[joint - 1],
                    _ => 1.0,
                };
                let mut values: Vec<f64> =
                    law.numbers.iter().map(|(name, _)| form(name, fastest)).collect();
                values[k] = SIZE;
                Number { law, spot: *spot, name, values, of }
            })
        });
        let numbers: Vec<Number> = numbers.collect();
        Suspects { kept: (0..numbers.len()).collect(), numbers }
    }

    /// Leaves out what no motion shows, and tells it.
    pub(super) fn split<'c>(
        &mut self,
        motions: impl Iterator<Item = &'c Columns>,
    ) -> Vec<(&'static str, Spot, &'static str)> {
        let mut most = vec![0.0_f64; self.numbers.len()];
        for columns in motions {
            for (k, most) in most.iter_mut().enumerate() {
                let part = norm(&columns.beyond[k]) / columns.whole[k];
                // Of a number that does nothing at all there is no part.
                *most = most.max(if part.is_nan() { 0.0 } else { part });
            }
        }
        let mut hidden = Vec::new();
        let shown: Vec<bool> = most.iter().map(|part| *part > SHOWN).collect();
        self.kept.retain(|k| shown[*k]);
        let mut place = 0..;
        self.numbers.retain(|number| {
            let is_shown = place.next().is_some_and(|k: usize| shown[k]);
            if !is_shown {
                hidden.push((number.law.name, number.spot, number.name));
            }
            is_shown
        });
        hidden
    }
}

/// Forms that effects usually have; other numbers are none.
fn form(name: &str, fastest: f64) -> f64 {
    match name {
        "speed" => 0.05 * fastest,
        "distance" => 0.01,
        "order" => 100.0,
        _ => 0.0,
    }
}

impl Columns {
    pub(super) fn of(
        plan: &Plan<'_>,
        suspects: &Suspects,
        course: &Fourier,
    ) -> Result<Columns, MotionError> {
        let rate = SAMPLES * plan.harmonics as f64 / plan.period;
        let recording = Recording { rate, ..Recording::default() };
        let payload = None;
        let stage = Stage { course, payload };
        let told = |truths: &[MotionTruth]| {
            MovingPlant::new(plan.arm, truths, plan.logged, recording).exact(0, &stage)
        };
        let nominal = told(&[])?;
        let sizes: Vec<f64> = match plan.logged {
            // Noise grows with what a joint's sensor is made for: with the torques at rest, whatever the motion.
            Logged::Torque(_) => ranges(plan),
            Logged::Position => vec![1.0; plan.arm.dof()],
        };
        let rows = nominal[0].len();
        let flat = |of: &[Vec<f64>]| -> Vec<f64> {
            (0..rows)
                .flat_map(|k| of.iter().zip(&sizes).map(move |(joint, size)| joint[k] / size))
                .collect()
        };
        let nominal = flat(&nominal);
        let basis = match plan.logged {
            Logged::Position => Basis::default(),
            Logged::Torque(_) => {
                let states: Vec<State> = (0..rows).map(|k| course.at(k as f64 / rate)).collect();
                let mut columns = links::span(plan.arm, &states);
                for column in &mut columns {
                    column.iter_mut().enumerate().for_each(|(k, x)| *x /= sizes[k % sizes.len()]);
                }
                Basis::of(columns)
            }
        };
        let mut columns = Columns { beyond: Vec::new(), whole: Vec::new(), of: Vec::new() };
        for Number { law, spot, values, of, .. } in &suspects.numbers {
            let truth = MotionTruth { law, spot: *spot, values: values.clone() };
            let mut change = flat(&told(&[truth])?);
            change.iter_mut().zip(&nominal).for_each(|(c, n)| *c = (*c - n) / SIZE);
            columns.whole.push(norm(&change));
            columns.beyond.push(basis.beyond(change));
            columns.of.push(*of);
        }
        Ok(columns)
    }

    /// Leaves out what the suspects leave out.
    pub(super) fn keep(&mut self, suspects: &Suspects) {
        self.beyond = suspects.kept.iter().map(|k| self.beyond[*k].clone()).collect();
        self.whole = suspects.kept.iter().map(|k| self.whole[*k]).collect();
        self.of = suspects.kept.iter().map(|k| self.of[*k]).collect();
    }

    #[cfg(test)]
    pub(super) fn beyond_of(&self, number: usize) -> Vec<f64> {
        self.beyond[number].clone()
    }

    /// The criterion.
    pub(super) fn value(&self, plan: &Plan<'_>) -> f64 {
        if let Purpose::All(_) = plan.purpose {
            // ln det of the products: twice the sum of what each adds to those before it.
            let mut basis = Basis::default();
            let mut added = |column: &Vec<f64>| 2.0 * basis.add(column.clone(), 0.0).ln();
            return self.beyond.iter().map(&mut added).sum();
        }
        let apart = |one: usize| {
            let of = |which: usize| {
                self.beyond.iter().zip(&self.of).filter(move |(_, of)| **of == which)
            };
            let others = of(1 - one).map(|(column, _)| column.clone()).collect();
            let basis = Basis::of(others);
            // The least that any of its forms stands apart.
            let left: Vec<DVector<f64>> = of(one)
                .map(|(column, _)| DVector::from_vec(basis.beyond(column.clone())))
                .collect();
            let left = DMatrix::from_columns(&left);
            left.tr_mul(&left).symmetric_eigenvalues().min() / left.nrows() as f64
        };
        apart(0).min(apart(1))
    }

    /// Standard deviations of all numbers for noise of one size on every row.
    pub(super) fn deviations(&self) -> Vec<f64> {
        let columns: Vec<DVector<f64>> =
            self.beyond.iter().map(|column| DVector::from_column_slice(column)).collect();
        let all = DMatrix::from_columns(&columns);
        // Units of their own: each column is made one long before the products are inverted.
        let lengths: Vec<f64> = all.column_iter().map(|c| c.norm()).collect();
        let products = all.tr_mul(&all);
        let scaled = DMatrix::from_fn(products.nrows(), products.ncols(), |i, j| {
            products[(i, j)] / (lengths[i] * lengths[j])
        });
        let inverse = scaled.clone().cholesky().map(|factors| factors.inverse());
        (0..lengths.len())
            .map(|k| inverse.as_ref().map_or(f64::INFINITY, |i| i[(k, k)].sqrt() / lengths[k]))
            .collect()
    }
}

/// The torque of each joint where the arm weighs most on it, of postures all over its ranges, with its
/// Coulomb friction; of joints that carry nothing a hundredth of the largest.
fn ranges(plan: &Plan<'_>) -> Vec<f64> {
    let n = plan.arm.dof();
    let mut most = vec![0.0_f64; n];
    for k in 0..64 {
        let q: Vec<f64> = (0..n)
            .map(|j| {
                let [low, high] = plan.limits.position[j];
                // Multiples of roots of primes fill the ranges evenly.
                let part = (f64::from(k)
                    * [2.0_f64, 3.0, 5.0, 7.0, 11.0, 13.0, 17.0][j % 7].sqrt())
                .fract();
                low + part * (high - low)
            })
            .collect();
        let weights = plan.arm.weight_torque(&q);
        most.iter_mut().zip(weights.iter()).for_each(|(m, w)| *m = m.max(w.abs()));
    }
    most.iter_mut().zip(&plan.arm.joints).for_each(|(m, joint)| *m += joint.drive.coulomb);
    let largest = most.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
    most.into_iter().map(|m| m.max(0.01 * largest)).collect()
}
