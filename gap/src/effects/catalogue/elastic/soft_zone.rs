//! The form is the torque at which the zone ends, in thousandths of a newton metre.

use crate::effects::prelude::*;

/// Compliance that a joint has more of up to a torque; beyond it, the joint twists no further by it.
#[derive(Clone, Copy, Debug)]
pub struct SoftZone;

/// Steps in a newton metre.
const STEPS: usize = 1000;

/// Torques that are tried at first, as parts of the rows that have less.
const TRIED: [f64; 5] = [0.15, 0.3, 0.45, 0.6, 0.75];

/// Rows whose torques are looked at for it.
const LOOKED_AT: usize = 100;

/// The torque at which a zone ends, N·m.
fn threshold(spot: Spot) -> f64 {
    spot.form as f64 / STEPS as f64
}

/// Sizes of a joint's torque in some of the rows as the robot file has the arm, ascending, N·m.
fn torques(arm: &Arm, joint: usize, data: &Measurements) -> Vec<f64> {
    let every = data.rows.len().div_ceil(LOOKED_AT).max(1);
    let of_row = |row: &Row| Some(equilibrium(arm, &row.q, &row.wrench).ok()?.torque[joint].abs());
    let mut torques: Vec<f64> = data.rows.iter().step_by(every).filter_map(of_row).collect();
    torques.sort_by(f64::total_cmp);
    torques
}

const AT_REST: &Facts = &Facts {
    identifier: "soft_zone",
    reality: "A joint that is softer under small torques than under large ones: the first zone of \
        a strain-wave gear, a belt until its slack is taken up.",
    signature: "A twist in proportion to the torque up to some torque, and no more beyond it.",
    confused_with: "`joint_compliance` if all torques stay below; `loaded_backlash` if all are \
        far beyond; `joint_hardening`, which bends the same curve smoothly.",
    separated_by: "One pose under small, middle and large loads, both signs if it can be.",
    formula: "Δq = compliance · clamp(τ, ±threshold)",
    parameters: &[Parameter::at_least("compliance", Quantity::AnglePerMoment, 0.0)],
    at: At::Revolute,
    moves: Moves::Joint,
    idle: "no load of this data reaches the joint",
    group: Some(Group::Nonlinear),
    ..Facts::NONE
};

impl Law for SoftZone {
    fn facts(&self) -> &'static Facts {
        AT_REST
    }
}

impl AtRest for SoftZone {
    fn forms_are(&self) -> Forms {
        Forms::Searched { key: "threshold", quantity: Quantity::Moment, steps: STEPS }
    }

    /// Torques within those of the data.
    fn forms(&self, arm: &Arm, place: Place, data: &Measurements) -> Vec<usize> {
        let torques = torques(arm, place.row(), data);
        let at = |part: &f64| torques.get((part * torques.len() as f64) as usize);
        let step = |torque: &f64| (torque * STEPS as f64).round();
        let steps = TRIED.iter().filter_map(at).map(step).filter(|s| (1.0..1e9).contains(s));
        let mut forms: Vec<usize> = steps.map(|step| step as usize).collect();
        forms.dedup();
        forms
    }

    fn gives(&self, _: &Row, spot: Spot) -> Option<Gives> {
        let most = threshold(spot);
        Some(Box::new(move |torque| torque.clamp(-most, most)))
    }

    fn sentence(&self, told: &Told<'_>) -> String {
        let [most, size] = ["threshold", "compliance"].map(|name| told.named(name));
        format!("{} twists {size} more up to {most} than beyond", told.place)
    }

    fn curve<'a>(&self, numbers: &'a [ParameterReport]) -> Option<Curve<'a>> {
        let value = |name: &str| Some(numbers.iter().find(|p| p.name == name)?.value);
        let (most, compliance) = (value("threshold")?, value("compliance")?);
        let value = Box::new(move |torque: f64| compliance * torque.clamp(-most, most));
        Some(Curve { over: Over::Torque, proportional: false, value })
    }

    /// Ends at a torque that a third to two thirds of the rows have less of.
    fn draw(&self, from: &mut Draw<'_>) -> Vec<(String, f64)> {
        let torques = torques(from.arm, from.place.row(), from.session);
        let part = from.between(1.0 / 3.0, 2.0 / 3.0);
        let most = torques.get((part * torques.len() as f64) as usize).copied().unwrap_or_default();
        let most = (most * STEPS as f64).round().max(1.0) / STEPS as f64;
        let sizes = from.sizes(&self.parameters(from.arm, Spot::at(from.place)), 1.0);
        core::iter::once(("threshold".to_owned(), most)).chain(sizes).collect()
    }
}
