//! What an arm with chosen effects shows an instrument without noise.

use nalgebra::{Isometry3, Vector6};
use stiffarm_kernels::Unstable;
use stiffarm_kernels::generic::Arm;

use crate::effects::Known;
use crate::measurement::{Measurements, Row};
use crate::plant::{Frames, Plant, PlantError, Truth, has_law};
use crate::simulate::{Actual, Moment, Sim, moments};
use crate::whole::Whole;

/// A design as an arm, and what its file says beyond the table, show it with these truths, in frames
/// that nobody knows if there are any.
///
/// The plant measures what it has laws for. An effect of one's own it does not know: a case with one
/// is measured by the effects' exact models, in the simulation that the diagnosis walks, and tests
/// how well they are told apart, not whether they are right.
///
/// # Errors
/// [`PlantError`]: a truth that the arm cannot have, or a load that it does not carry.
pub fn exact<'a>(
    whole: impl Into<Whole<'a>>,
    truths: &[Truth],
    frames: Option<&Frames>,
    design: &Measurements,
) -> Result<Measurements, PlantError> {
    let Whole { arm, known } = whole.into();
    let known: Vec<Known> = known.iter().filter(|known| known.is_there(design)).cloned().collect();
    let frames = frames.cloned().unwrap_or_default();
    let effects = truths.iter().map(|truth| truth.effect).chain(known.iter().map(|k| k.effect));
    if effects.into_iter().all(has_law) {
        return Plant::beyond(arm, &known, truths)?.with_frames(frames).exact(design);
    }
    let mut placed = arm.clone();
    placed.tool *= frames.tool;
    // What cannot be with a design that has no other simulator's predictions is what such a simulator
    // lacks: its predictions are then part of what is shown.
    let (lacking, real): (Vec<&Truth>, Vec<&Truth>) =
        truths.iter().partition(|truth| truth.effect.excluded(design).is_some());
    let mut measured = design.clone();
    if !lacking.is_empty() {
        measured.sim_given = design.kind.components();
    }
    for (row, when) in measured.rows.iter_mut().zip(moments(design)) {
        let unstable =
            |_: Unstable| PlantError::Unstable { file: design.file.clone(), line: row.line };
        let shown = |arm: &Arm, base: Isometry3<f64>, truths: &[&Truth], sign: f64| {
            let [x, y, z] = row.offset.unwrap_or_default();
            let marker = Isometry3::translation(x, y, z);
            let sim = Sim::of(design.kind, marker, None, |loaded| {
                let load = if loaded { row.wrench } else { Vector6::zeros() };
                let mut actual = Actual::new(arm, &row.q, &load);
                actual.base = base * arm.base;
                known.iter().for_each(|known| known.alter(&mut actual, row, &when));
                truths.iter().for_each(|truth| put(truth, &mut actual, row, &when, sign));
                actual
            })?;
            let sim = sim.seen_by(row.view(design.kind));
            let mask = Vector6::from_iterator(design.kind.components().map(f64::from));
            Ok(sim.reading().vector().component_mul(&mask))
        };
        let reading = shown(&placed, frames.base, &real, 1.0).map_err(unstable)?;
        let sim = shown(arm, Isometry3::identity(), &lacking, -1.0).map_err(unstable)?;
        (row.measured, row.sim) = (reading, (!lacking.is_empty()).then(|| Box::new(sim)));
    }
    Ok(measured)
}

fn put(truth: &Truth, actual: &mut Actual<'_>, row: &Row, when: &Moment, sign: f64) {
    for (spot, values) in truth.spots(&actual.arm) {
        let values: Vec<f64> = values.into_iter().map(|value| sign * value).collect();
        truth.effect.alter(actual, row, when, spot, &values);
    }
}
