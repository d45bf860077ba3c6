//! What a diagnosis promises at postures that were not measured: how large the gap is there, and
//! how much of it stays because the numbers that were found are uncertain.

use nalgebra::Vector6;

use super::explanation::Explanation;
use crate::diagnose::data::Problem;
use crate::diagnose::options::DiagnoseError;
use crate::measurement::{Kind, Measurements, Row};

/// The gap to be expected at a posture, measured as the diagnosed data was: root mean squares, m;
/// of the rotation, rad, where no position is measured; of the whole position where distances are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Expected {
    /// How far the findings move the reading.
    pub moved: f64,
    /// What their uncertainty leaves of that.
    pub uncertain: f64,
    /// What no finding explains: the noise, and whatever else is left on the diagnosed data.
    pub noise: f64,
}

impl Expected {
    /// The gap without the findings.
    pub fn before(self) -> f64 {
        self.moved.hypot(self.after())
    }

    /// The gap with them.
    pub fn after(self) -> f64 {
        self.uncertain.hypot(self.noise)
    }

    /// `1 − after/before`.
    pub fn shrink(self) -> f64 {
        let before = self.before();
        if before > 0.0 { 1.0 - self.after() / before } else { 0.0 }
    }
}

impl Explanation {
    /// At a posture under a load: the findings' whole shift, and to first order their uncertainty.
    /// Nothing is known there of what depends on time, temperature, the last move, or the direction
    /// of approach.
    ///
    /// # Errors
    /// [`DiagnoseError::Unstable`] and others of the posture.
    pub fn expected(&self, q: &[f64], wrench: &Vector6<f64>) -> Result<Expected, DiagnoseError> {
        let row = Row { wrench: *wrench, ..Row::new(0, q.to_vec()) };
        let kind = match self.kind {
            Kind::Distance | Kind::Bench { .. } => Kind::Pose { orientation: false },
            kind => kind,
        };
        let data = Measurements::new("the posture", kind, vec![row]);
        let problem = Problem::new(&self.nominal, &data, &self.options())?;
        let [before, after] = self.without_bench();
        let (without, with) = (before.predict(&problem, None)?, after.predict(&problem, None)?);
        let first = if problem.measures_position() { 0 } else { 3 };
        let shift = (without.gaps[0] - with.gaps[0]).component_mul(&problem.mask);
        let sim = after.state(&problem, &with, 0)?;
        let block = after.change(&problem, &sim, 0, |s| after.block(&problem, 0, s));
        let mut left = block * &self.spread.root;
        for mut column in left.column_iter_mut() {
            column.component_mul_assign(&problem.mask);
        }
        Ok(Expected {
            moved: shift.fixed_rows::<3>(first).norm(),
            uncertain: left.fixed_rows::<3>(first).norm(),
            noise: self.spread.left.fixed_rows::<3>(first).sum().sqrt(),
        })
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector6;

    use crate::diagnose::{Options, diagnose_with};
    use crate::measurement::Kind;
    use stiffarm_plant::design::{Design, Shape};
    use stiffarm_plant::{Noise, Plant, Truth};

    /// Over many measurements of one arm the distance of the corrected model from the arm is the
    /// promised one on average, at postures near and far; the arm itself is another program's.
    #[test]
    fn the_promise_is_kept_on_average() {
        let arm = crate::fixture::springy();
        let truth = Truth::parse("joint_compliance@joint 2=4e-6", &arm).unwrap();
        let plant = Plant::new(&arm, std::slice::from_ref(&truth)).unwrap();
        let load = Vector6::new(40.0, -30.0, -150.0, 0.0, 0.0, 0.0);
        let postures = [[0.3, 0.4, -0.9], [-1.2, 1.1, 0.5], [2.0, -0.3, 1.4]];
        let rows: Vec<_> = postures.iter().map(|q| crate::fixture::row(q, load)).collect();
        let there = crate::fixture::table(rows, Kind::Pose { orientation: false });
        let real: Vec<Vector6<f64>> =
            plant.exact(&there).unwrap().rows.iter().map(|r| r.measured).collect();
        let draws = 60;
        let (mut squares, mut promised) = ([0.0; 3], [0.0; 3]);
        for seed in 0..draws {
            let design = Design {
                shape: Shape::Force,
                poses: 8,
                repeats: 1,
                payload: 15.0,
                kind: Kind::Pose { orientation: false },
                seed,
            };
            let noise = Noise { position: 2e-4, rotation: 0.0 };
            let data = plant.measure(&design.rows(&arm), noise, seed).unwrap();
            let options = Options {
                effects: Some(vec!["joint_compliance".to_owned()]),
                noise_position: Some(2e-4),
                ..Options::default()
            };
            let found = diagnose_with(&arm, &data, &options, &|_| {}).unwrap();
            assert_eq!(found.diagnosis.findings.len(), 1, "seed {seed}");
            let model = found.explanation;
            let mut actual = arm.clone();
            actual.joints[1].compliance += model.found()[0].values[0];
            for (k, q) in postures.iter().enumerate() {
                let expected = model.expected(q, &load).unwrap();
                let tool = crate::simulate::equilibrium(&actual, q, &load).unwrap().tool;
                let off = tool.translation.vector - real[k].fixed_rows::<3>(0);
                squares[k] += off.norm_squared() / f64::from(draws as u32);
                promised[k] += expected.uncertain.powi(2) / f64::from(draws as u32);
                assert!((expected.noise / (2e-4 * 3f64.sqrt()) - 1.0).abs() < 0.3, "{expected:?}");
                let nominal = crate::simulate::equilibrium(&arm, q, &load).unwrap().tool;
                let gap = (nominal.translation.vector - real[k].fixed_rows::<3>(0)).norm();
                assert!(
                    (expected.moved - gap).abs() < 5.0 * expected.uncertain,
                    "{expected:?} {gap}"
                );
                let before = (expected.moved.powi(2) + expected.after().powi(2)).sqrt();
                let shrink = 1.0 - expected.after() / before;
                assert!((expected.shrink() - shrink).abs() < 1e-14);
            }
        }
        for (actual, promised) in squares.iter().zip(promised) {
            // A mean of 60 squares of one normal number is within 4 of its deviations, √(2/60).
            assert!((actual / promised - 1.0).abs() < 4.0 * (2.0 / 60.0_f64).sqrt());
        }
    }
}
