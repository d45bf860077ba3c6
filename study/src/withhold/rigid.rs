//! What other masses of the links could do to a log: of an effect only the rest is there to be found.

use stiffarm_kernels::generic::Arm;

use crate::excite::Basis;
use crate::plant::course::Course;
use crate::plant::motion::links;

/// Instants of each run at which it is asked.
const INSTANTS: usize = 250;

/// All that other masses could do, in the noise of each joint.
pub(super) struct Rigid {
    /// Instants of each run, s.
    instants: Vec<Vec<f64>>,
    basis: Basis,
    noise: Vec<f64>,
}

impl Rigid {
    /// Of an arm that goes along these courses; `noise` of each joint; `free` if masses may be others.
    pub(super) fn of(arm: &Arm, courses: &[&dyn Course], noise: &[f64], free: bool) -> Rigid {
        let instants: Vec<Vec<f64>> = courses
            .iter()
            .map(|course| {
                let step = course.duration() / INSTANTS as f64;
                (0..INSTANTS).map(|k| (k as f64 + 0.5) * step).collect()
            })
            .collect();
        let states: Vec<_> = courses
            .iter()
            .zip(&instants)
            .flat_map(|(course, instants)| instants.iter().map(|t| course.at(*t)))
            .collect();
        let mut columns = if free { links::span(arm, &states) } else { Vec::new() };
        for column in &mut columns {
            column.iter_mut().enumerate().for_each(|(k, x)| *x /= noise[k % noise.len()]);
        }
        let basis = Basis::of(columns);
        Rigid { instants, basis, noise: noise.to_vec() }
    }

    /// Of changes, one of each run, rows of `step` of each joint, in the noise: the largest joint's root
    /// mean square, before and after other masses have taken what they can.
    pub(super) fn sizes(&self, changes: &[Vec<Vec<f64>>], rate: f64) -> [f64; 2] {
        let joints = self.noise.len();
        let rows = changes.iter().zip(&self.instants).flat_map(|(change, instants)| {
            let at = move |t: &f64| ((t * rate).round() as usize).min(change[0].len() - 1);
            let row = move |k: usize| (0..joints).map(move |j| change[j][k] / self.noise[j]);
            instants.iter().flat_map(move |t| row(at(t)))
        });
        let change: Vec<f64> = rows.collect();
        let left = self.basis.beyond(change.clone());
        [change, left].map(|of| {
            let square = |joint: usize| -> f64 {
                of.iter().skip(joint).step_by(joints).map(|x| x * x).sum()
            };
            let most = (0..joints).map(square).fold(0.0, f64::max);
            (most * joints as f64 / of.len() as f64).sqrt()
        })
    }
}
