//! Campaigns: the plant at rest on its design, and how large an effect's error is in multiples of the
//! noise.

use nalgebra::{DMatrix, DVector, UnitQuaternion, Vector3, Vector6};
use stiffarm_kernels::generic::Arm;

use super::report::{Case, Named, Residual, Verdict};
use super::run::{self, Planted, known_to};
use super::{Campaign, Kind, Plan, WithholdError, exact};
use crate::diagnose::{Diagnosis, Nuisance, Options, diagnose};
use crate::effects::{Catalogue, Draw, Effect, Place};
use crate::infer::Basis;
use crate::measurement::{Measurements, Row};
use crate::plant::{PlantError, Truth, blurred};
use crate::report::Finding;
use crate::rng::{Rng, seed_of};
use crate::whole::Whole;

/// An effect of usual size that does no more than this, in multiples of the noise, does not show:
/// it would have to be thousands of times as large.
const FAINT: f64 = 1e-3;

/// Everything that cases share.
pub(super) struct Bench<'a> {
    pub(super) plan: &'a Plan<'a>,
    pub(super) own: &'a Campaign<'a>,
    /// What the arm of the file shows, without noise.
    pub(super) nominal: Measurements,
    /// What unknown frames and the unknown constants of the bench could do to the whitened gap, and which of that is
    /// decided.
    unknowns: (DMatrix<f64>, Basis),
}

impl<'a> Bench<'a> {
    pub(super) fn new(
        plan: &'a Plan<'a>,
        own: &'a Campaign<'a>,
    ) -> Result<Bench<'a>, WithholdError> {
        let components = own.design.kind.components();
        for (what, range, noise) in
            [("position", 0..3, own.noise.position), ("rotation", 3..6, own.noise.rotation)]
        {
            if noise <= 0.0 && range.into_iter().any(|k| components[k]) {
                return Err(WithholdError::NoNoise { what });
            }
        }
        let nominal = exact(own.whole(plan.arm), &[], own.frames.as_ref(), own.design)?;
        let none = DMatrix::zeros(0, 0);
        let mut bench = Bench { plan, own, nominal, unknowns: (none.clone(), Basis::new(&none)) };
        bench.unknowns = bench.what_unknowns_do()?;
        Ok(bench)
    }

    /// What an instrument without noise shows of these truths.
    pub(super) fn exact(&self, truths: &[Truth]) -> Result<Measurements, PlantError> {
        let whole = self.own.whole(self.plan.arm);
        exact(whole, truths, self.own.frames.as_ref(), self.own.design)
    }

    fn plant_at(
        &self,
        effect: &'static dyn Effect,
        place: Place,
        wanted: f64,
        rng: &mut Rng,
    ) -> Option<(Truth, f64)> {
        let (arm, design) = (self.plan.arm, self.own.design);
        let values = effect.draw(&mut Draw::new(arm, place, design, rng));
        let mut truth = Truth { effect, place, values };
        let mut multiple = self.multiple(&truth)?;
        if effect.has_one_size() {
            return (multiple >= wanted).then_some((truth, multiple));
        }
        // Most gaps are proportional to the size, a cubic one and its torque are not.
        for _ in 0..4 {
            if multiple.is_nan() || multiple < FAINT {
                return None;
            }
            let off = wanted / multiple;
            if (off - 1.0).abs() < 0.02 {
                break;
            }
            truth = resized(&truth, arm, off)?;
            multiple = self.multiple(&truth)?;
        }
        let close = (multiple / wanted - 1.0).abs() < 0.1;
        close.then_some((truth, multiple))
    }

    /// Root mean square of a truth's gap over all measured components, each in its noise, after
    /// unknown frames and the bench have been fitted; `None` if the arm does not carry it.
    fn multiple(&self, truth: &Truth) -> Option<f64> {
        let mut gap = self.whitened(&self.exact(core::slice::from_ref(truth)).ok()?);
        let (columns, basis) = &self.unknowns;
        if columns.ncols() > 0 {
            gap -= columns * basis.solve(&columns.tr_mul(&gap));
        }
        Some(gap.norm() / (gap.len() as f64).sqrt())
    }

    /// The gap that it shows, each number in its noise.
    pub(super) fn whitened(&self, exact: &Measurements) -> DVector<f64> {
        let (components, noise) = (exact.kind.components(), self.own.noise);
        let mut gap = Vec::new();
        for (row, nominal) in exact.rows.iter().zip(&self.nominal.rows) {
            let predicted = row.sim.as_deref().unwrap_or(&nominal.measured);
            let off = difference(&row.measured, predicted, components);
            for k in (0..6).filter(|k| components[*k]) {
                gap.push(off[k] / if k < 3 { noise.position } else { noise.rotation });
            }
        }
        gap.extend(self.apart(exact));
        DVector::from_vec(gap)
    }

    /// The plan's options of the diagnosis, as the case has them.
    fn options(&self, seed: u64, case: &Case) -> Options {
        let (components, noise) = (self.own.design.kind.components(), self.own.noise);
        let given = |size: f64, range: &[bool]| Some(size).filter(|_| range.contains(&true));
        let options = self.own.options.clone();
        let known = options.catalogue.identifiers().into_iter();
        Options {
            seed,
            noise_position: given(noise.position, &components[..3]),
            noise_rotation: given(noise.rotation, &components[3..]),
            effects: known_to(case, known, self.own.options.effects.as_ref()),
            ..options
        }
    }

    /// The gap that is left in multiples of the noise: in position, or in rotation where no position
    /// is measured.
    fn in_noise(&self, found: &Diagnosis) -> f64 {
        let (components, noise) = (self.own.design.kind.components(), self.own.noise);
        let count = |of: &[bool]| (of.iter().filter(|is| **is).count() as f64).sqrt();
        if components[..3].contains(&true) {
            found.gap.after.position_rms / (count(&components[..3]) * noise.position)
        } else {
            found.gap.after.rotation_rms / (count(&components[3..]) * noise.rotation)
        }
    }

    /// How far the gap really shrinks at poses that the diagnosis has never met: 1 − rms after /
    /// rms before, over all fresh sessions.
    fn realised(&self, truths: &[Truth], seed: u64, found: &Diagnosis) -> Option<f64> {
        let predict = self.own.predict?;
        let whole = self.own.whole(self.plan.arm);
        let (mut before, mut after) = (0.0, 0.0);
        for (k, fresh) in self.own.fresh.iter().enumerate() {
            let shown = |truths: &[Truth]| exact(whole, truths, None, fresh).ok();
            let measured = blurred(&shown(truths)?, self.own.noise, seed_of(seed, k));
            let nominal = shown(&[])?.rows.into_iter().map(|row| row.measured);
            before += squares(&measured, nominal);
            after += squares(&measured, predict(found, fresh)?.into_iter());
        }
        (before > 0.0).then(|| 1.0 - (after / before).sqrt())
    }
}

impl run::Bench for Bench<'_> {
    type Effect = &'static dyn Effect;
    type Truth = Truth;

    /// Of every twenty cases five are without an effect, nine with one, three with two, and three
    /// with one that the diagnosis does not know.
    const TURNS: [Kind; 20] = {
        use Kind::{None as N, Pair as P, Removed as R, Single as S};
        [S, N, S, R, S, P, S, N, S, N, S, R, S, P, N, S, R, P, S, N]
    };

    fn effects(&self) -> Vec<&'static dyn Effect> {
        let moves_frames = |effect: &dyn Effect| Nuisance::of(effect).is_some();
        let hides = self.own.frames.is_some();
        let all = self.own.effects.iter().copied();
        all.filter(|effect| !(hides && moves_frames(*effect))).collect()
    }

    fn identifier(effect: &'static dyn Effect) -> &'static str {
        effect.identifier()
    }

    fn plant(
        &self,
        effect: &'static dyn Effect,
        multiple: f64,
        rng: &mut Rng,
    ) -> Option<Planted<Truth>> {
        let mut places = effect.places(self.plan.arm);
        rng.shuffle(&mut places);
        let (truth, multiple) =
            places.into_iter().find_map(|place| self.plant_at(effect, place, multiple, rng))?;
        let label = Named::new(effect.identifier(), &truth.place);
        Some(Planted { truth, label, multiple })
    }

    fn judge(&self, truths: &[Truth], seed: u64, case: &mut Case) -> Result<(), WithholdError> {
        let data = blurred(&self.exact(truths)?, self.own.noise, seed);
        match diagnose(self.plan.arm, &data, &self.options(seed, case)) {
            Ok(found) => {
                case.after = Some(self.in_noise(&found));
                if case.kind == Kind::Single && found.findings.len() == 1 {
                    case.realised = self.realised(truths, seed, &found);
                }
                case.verdict = Some(Verdict::of(&found));
            }
            Err(error) => case.error = Some(error.to_string()),
        }
        Ok(())
    }
}

impl Verdict {
    /// Of a diagnosis.
    pub fn of(found: &Diagnosis) -> Verdict {
        let shrink = match found.findings.as_slice() {
            [only] => only.held_out.shrink().map(|held| {
                let [low, high] = held.shrink_ci95;
                [held.shrink, low, high]
            }),
            _ => None,
        };
        Verdict {
            sets: found.findings.iter().map(Named::set).collect(),
            unexplained: found.unexplained.present,
            unexplained_places: found.unexplained.places.iter().map(|s| s.place.clone()).collect(),
            residual: Residual::Campaign {
                after_position: found.gap.after.position_rms,
                after_rotation: found.gap.after.rotation_rms,
                shrink,
            },
        }
    }
}

/// The truth with a size so many times as large; `None` beyond what an arm can have.
pub fn resized(truth: &Truth, arm: &Arm, factor: f64) -> Option<Truth> {
    let mut resized = truth.clone();
    for (name, value) in &mut resized.values {
        // What is searched for has no size.
        if let (Some(_), parameter) = truth.effect.number(arm, truth.place, name)? {
            *value *= factor;
            if value.abs() > parameter.quantity.largest() {
                return None;
            }
        }
    }
    Some(resized)
}

/// The prediction of a plant that has the findings, with the values that were found: what they mean
/// by the definition of the effects, whatever the diagnosis itself makes of them.
pub fn with_findings<'a>(
    whole: impl Into<Whole<'a>>,
    catalogue: &'a Catalogue,
) -> impl Fn(&Diagnosis, &Measurements) -> Option<Vec<Vector6<f64>>> + Sync + 'a {
    let whole = whole.into();
    let truth = |finding: &Finding| {
        let effect = catalogue.named(&finding.effect)?;
        let place = finding.place.parse().ok()?;
        let values = finding.parameters.iter().filter(|p| p.value != 0.0);
        let values = values.map(|p| (p.name.to_string(), p.value)).collect();
        Some(Truth { effect, place, values })
    };
    move |found, design| {
        let truths: Option<Vec<Truth>> = found.findings.iter().map(truth).collect();
        let exact = exact(whole, &truths?, None, design).ok()?;
        Some(exact.rows.into_iter().map(|row| row.measured).collect())
    }
}

/// Sum of squares over rows of measured less predicted: in position, or in rotation where no
/// position is measured.
fn squares(measured: &Measurements, predicted: impl Iterator<Item = Vector6<f64>>) -> f64 {
    let components = measured.kind.components();
    let range = if components[..3].contains(&true) { 0..3 } else { 3..6 };
    let square = |(row, expected): (&Row, Vector6<f64>)| -> f64 {
        let off = difference(&row.measured, &expected, components);
        range.clone().filter(|k| components[*k]).map(|k| off[k] * off[k]).sum()
    };
    measured.rows.iter().zip(predicted).map(square).sum()
}

/// Measured less predicted; of whole rotations the rotation vector between them.
fn difference(
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
