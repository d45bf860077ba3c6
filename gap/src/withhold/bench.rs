//! The plant on its design: how large an effect's gap is, in multiples of the noise.

use nalgebra::{DMatrix, DVector, UnitQuaternion, Vector3, Vector6};

use super::draw::resized;
use super::exact;
use super::{Plan, WithholdError};
use crate::diagnose::Nuisance;
use crate::diagnose::fit::Basis;
use crate::effects::{Draw, Effect, Place};
use crate::measurement::Measurements;
use crate::plant::{PlantError, Truth};
use crate::rng::Rng;

/// An effect of usual size that does no more than this, in multiples of the noise, does not show:
/// it would have to be thousands of times as large.
const FAINT: f64 = 1e-3;

/// Everything that cases share.
pub(super) struct Bench<'a> {
    pub(super) plan: &'a Plan<'a>,
    /// What the arm of the file shows, without noise.
    nominal: Measurements,
    /// What unknown frames could do to the whitened gap, and which of that is decided.
    nuisance: Option<(DMatrix<f64>, Basis)>,
}

/// An effect put in, and what it does.
pub(super) struct Planted {
    pub(super) truth: Truth,
    pub(super) multiple: f64,
    pub(super) exact: Measurements,
}

impl<'a> Bench<'a> {
    pub(super) fn new(plan: &'a Plan<'a>) -> Result<Bench<'a>, WithholdError> {
        let components = plan.design.kind.components();
        for (what, range, noise) in
            [("position", 0..3, plan.noise.position), ("rotation", 3..6, plan.noise.rotation)]
        {
            if noise <= 0.0 && range.into_iter().any(|k| components[k]) {
                return Err(WithholdError::NoNoise { what });
            }
        }
        let nominal = exact(plan.whole(), &[], plan.frames.as_ref(), plan.design)?;
        let mut bench = Bench { plan, nominal, nuisance: None };
        if plan.frames.is_some() {
            bench.nuisance = Some(bench.what_frames_do()?);
        }
        Ok(bench)
    }

    /// What an instrument without noise shows of these truths.
    pub(super) fn exact(&self, truths: &[Truth]) -> Result<Measurements, PlantError> {
        exact(self.plan.whole(), truths, self.plan.frames.as_ref(), self.plan.design)
    }

    /// An effect at a place of chance, its gap about `multiple` times the noise. `None` if it does
    /// not show anywhere on this design.
    pub(super) fn plant(
        &self,
        effect: &'static dyn Effect,
        multiple: f64,
        rng: &mut Rng,
    ) -> Option<Planted> {
        let mut places = effect.places(self.plan.arm);
        rng.shuffle(&mut places);
        places.into_iter().find_map(|place| self.plant_at(effect, place, multiple, rng))
    }

    fn plant_at(
        &self,
        effect: &'static dyn Effect,
        place: Place,
        multiple: f64,
        rng: &mut Rng,
    ) -> Option<Planted> {
        let Plan { arm, design, .. } = self.plan;
        let values = effect.draw(&mut Draw::new(arm, place, design, rng));
        let first = Truth { effect, place, values };
        if effect.has_one_size() {
            return self.shown(first).filter(|planted| planted.multiple >= multiple);
        }
        let mut planted = self.shown(first)?;
        // Most gaps are proportional to the size, a cubic one and its torque are not.
        for _ in 0..4 {
            if planted.multiple.is_nan() || planted.multiple < FAINT {
                return None;
            }
            let off = multiple / planted.multiple;
            if (off - 1.0).abs() < 0.02 {
                break;
            }
            planted = self.shown(resized(&planted.truth, arm, off)?)?;
        }
        let close = (planted.multiple / multiple - 1.0).abs() < 0.1;
        close.then_some(planted)
    }

    fn shown(&self, truth: Truth) -> Option<Planted> {
        let exact = self.exact(core::slice::from_ref(&truth)).ok()?;
        let multiple = self.multiple(&exact);
        Some(Planted { truth, multiple, exact })
    }

    /// Root mean square of the gap over all measured components, each in its noise, after unknown
    /// frames have been fitted.
    fn multiple(&self, exact: &Measurements) -> f64 {
        let mut gap = self.whitened(exact);
        if let Some((columns, basis)) = &self.nuisance {
            gap -= columns * basis.solve(&columns.tr_mul(&gap));
        }
        gap.norm() / (gap.len() as f64).sqrt()
    }

    fn whitened(&self, exact: &Measurements) -> DVector<f64> {
        let (components, noise) = (exact.kind.components(), self.plan.noise);
        let mut gap = Vec::new();
        for (row, nominal) in exact.rows.iter().zip(&self.nominal.rows) {
            let predicted = row.sim.as_deref().unwrap_or(&nominal.measured);
            let off = difference(&row.measured, predicted, components);
            for k in (0..6).filter(|k| components[*k]) {
                gap.push(off[k] / if k < 3 { noise.position } else { noise.rotation });
            }
        }
        DVector::from_vec(gap)
    }

    fn what_frames_do(&self) -> Result<(DMatrix<f64>, Basis), PlantError> {
        let mut columns = Vec::new();
        for effect in Nuisance::ALL.map(Nuisance::effect) {
            let places = effect.places(self.plan.arm).into_iter();
            for (place, number) in places
                .flat_map(|p| effect.numbers(self.plan.arm, p).into_iter().map(move |n| (p, n)))
            {
                let values = vec![(number.name.into_owned(), 1e-5)];
                columns.push(self.whitened(&self.exact(&[Truth { effect, place, values }])?));
            }
        }
        let columns = DMatrix::from_columns(&columns);
        let basis = Basis::new(&columns.tr_mul(&columns));
        Ok((columns, basis))
    }
}

/// Measured less predicted; of whole rotations the rotation vector between them.
pub(super) fn difference(
    measured: &Vector6<f64>,
    predicted: &Vector6<f64>,
    components: [bool; 6],
) -> Vector6<f64> {
    let mut off = measured - predicted;
    if components[3..] == [true; 3] {
        // By quaternions: the angle of a matrix is not a number where rounding takes its trace above 3.
        let turn = |v: &Vector6<f64>| UnitQuaternion::new(Vector3::new(v[3], v[4], v[5]));
        let between = (turn(measured) * turn(predicted).inverse()).scaled_axis();
        off.fixed_rows_mut::<3>(3).copy_from(&between);
    }
    off
}
