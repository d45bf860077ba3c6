//! Whose axes loads and gravity are told in, as far as the data say so.

use nalgebra::Isometry3;

use super::forward::{Explained, Search};
use crate::constants::LARGE_ANGLE;
use crate::diagnose::fit::{Axes, Model, prior_penalty, refit_below, squares};
use crate::diagnose::options::DiagnoseError;
use crate::infer::constants::DISTINGUISHABLE;
use crate::infer::{Observations, costs};

impl Search<'_, '_> {
    /// The same with loads and gravity in the measuring frame's axes, if the data are rather those of it than of the
    /// arm's. A tilt of gravity that was found is then not needed.
    pub(crate) fn with_loads_as_measured(
        &self,
        now: &Explained,
    ) -> Result<Option<Model>, DiagnoseError> {
        let (problem, model) = (self.problem, &now.fit.model);
        let lean = |base: &Isometry3<f64>| {
            let own = &problem.arm.gravity;
            own.angle(&Axes::Measuring.gravity(base, own))
        };
        let turned = model.bases.iter().any(|base| base.rotation.angle() > 0.0);
        let leans = turned && model.bases.iter().all(|base| lean(base) <= LARGE_ANGLE);
        if model.axes == Axes::Measuring || !leans || problem.nominal.is_some() || self.stopped() {
            return Ok(None);
        }
        let (left, scale) = (self.left(now), self.scale(now));
        let variance = scale.variance(left, model.parameters(problem));
        let tilt = model.found.iter().position(|found| found.effect.tilts_gravity());
        let cost = tilt.map_or(0.0, |k| costs(self, now, variance)[k]);
        let mut other = model.clone();
        other.axes = Axes::Measuring;
        other.found.retain(|found| !found.effect.tilts_gravity());
        let below = left + variance * (cost - DISTINGUISHABLE);
        let fit = refit_below(problem, other, None, &now.weights, below);
        let fit = match fit {
            // A frame that lies on its side lets the arm fall.
            Err(DiagnoseError::Unstable { .. }) => return Ok(None),
            fit => fit?,
        };
        let left = squares(problem, &fit.predicted.gaps, &now.weights)
            + prior_penalty(problem, &fit.model);
        Ok((left < below).then_some(fit.model))
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Isometry3, Rotation3, Vector3, Vector6};
    use stiffarm_kernels::generic::Arm;

    use crate::diagnose::{Diagnosed, Nuisance, Options, diagnose_with};
    use crate::fixture::springy;
    use crate::measurement::{Kind, Measurements};
    use stiffarm_plant::design::{Design, Shape};
    use stiffarm_plant::{Noise, Plant};

    /// An arm whose base leans in the measuring frame.
    const LEANS: [f64; 3] = [0.03, -0.02, 0.8];

    fn turned(turn: &Rotation3<f64>, w: &Vector6<f64>) -> Vector6<f64> {
        let [force, moment] = [0, 3].map(|k| turn * w.fixed_rows::<3>(k));
        Vector6::new(force.x, force.y, force.z, moment.x, moment.y, moment.z)
    }

    /// What a tracker sees of it under the loads of `rows`, which are told in its axes, or in the arm's.
    fn measured(rows: &Measurements, as_measured: bool, seed: u64) -> Measurements {
        let turn = Rotation3::new(Vector3::from(LEANS));
        let mut arm =
            Arm { base: Isometry3::from_parts(Vector3::z().into(), turn.into()), ..springy() };
        let mut own = rows.clone();
        if as_measured {
            arm.gravity = turn.inverse() * arm.gravity;
            own.rows.iter_mut().for_each(|row| row.wrench = turned(&turn.inverse(), &row.wrench));
        }
        let plant = Plant::new(&arm, &[]).unwrap();
        let noise = Noise { position: 2e-5, rotation: 2e-5 };
        let mut seen = plant.measure(&own, noise, seed).unwrap();
        seen.rows.iter_mut().zip(&rows.rows).for_each(|(row, told)| row.wrench = told.wrench);
        seen
    }

    fn found(as_measured: bool, seed: u64) -> Diagnosed {
        let kind = Kind::Pose { orientation: true };
        let design =
            Design { shape: Shape::Force, poses: 40, repeats: 1, payload: 20.0, kind, seed };
        let rows = design.rows(&springy());
        let nuisances = vec![Nuisance::BaseFrame];
        let options = Options { nuisances, ..Options::default() };
        let data = measured(&rows, as_measured, seed);
        diagnose_with(&springy(), &data, &options, &|_| {}).unwrap()
    }

    #[test]
    fn the_data_say_whose_axes_loads_and_gravity_are_told_in() {
        for seed in 0..6 {
            for as_measured in [false, true] {
                let Diagnosed { diagnosis, explanation, .. } = found(as_measured, seed);
                assert_eq!(diagnosis.hangs_as_measured, as_measured, "seed {seed}");
                assert!(diagnosis.findings.is_empty(), "seed {seed}: {:?}", diagnosis.findings);
                let lean = Rotation3::new(Vector3::from(LEANS)).inverse() * -Vector3::z();
                let down = if as_measured { lean } else { -Vector3::z() };
                let off = explanation.arm().gravity.normalize() - down;
                assert!(off.norm() < 1e-3, "seed {seed}: {off}");
            }
        }
    }
}
