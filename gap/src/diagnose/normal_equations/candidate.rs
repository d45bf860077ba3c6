//! What may be added to the explanation.

use nalgebra::Matrix6xX;

use super::probe::{About, Probe};
use crate::diagnose::data::Problem;
use crate::diagnose::fit::Fitted;
use crate::diagnose::prior::Prior;
use crate::effects::{
    Carrier, Effect, Forms, JOINT_SPRING, Parameter, Place, Quantity, Scene, Spot,
};
use crate::infer::{Usual, constants::LOOSE};

/// An effect at a spot, or a probe: some numbers and what they do to the tool.
#[derive(Clone)]
pub(crate) struct Candidate {
    pub(crate) source: Source,
    /// Number of parameters.
    pub(crate) size: usize,
    pub(crate) usual: Usual,
}

/// Where a candidate's block comes from.
#[derive(Clone)]
pub(crate) enum Source {
    Effect { effect: &'static dyn Effect, spot: Spot },
    Probe(Probe),
}

/// Inverse of the standard deviation to which a value is held of which this is usual.
fn loosely(usual: f64) -> f64 {
    1.0 / (LOOSE * usual)
}

impl Candidate {
    /// What is usual of one of its numbers.
    pub(super) fn set_usual(&mut self, number: usize, usual: f64) {
        self.usual.held[number] = loosely(usual);
    }

    /// Every form of the effects at every place.
    pub(crate) fn all(problem: &Problem<'_>, effects: &[&'static dyn Effect]) -> Vec<Candidate> {
        let mut all = Vec::new();
        for &effect in effects {
            if effect.excluded(problem.data).is_some() {
                continue;
            }
            for place in effect.places(problem.arm) {
                let forms = effect.forms(problem.arm, place, problem.data);
                for &form in &forms {
                    all.push(Candidate::of(problem, effect, Spot { place, form }, forms.len()));
                }
            }
        }
        all
    }

    /// Every place with everything on which its displacement may depend.
    pub(crate) fn probes(problem: &Problem<'_>) -> Vec<Candidate> {
        let n = problem.arm.dof();
        let data = problem.data;
        let mut probes = Vec::new();
        let mut add = |place, about, size| {
            probes.push(Candidate::probe(Probe { place, about }, size));
        };
        let directed = data.rows.iter().any(|r| r.direction.is_some());
        for joint in 0..n {
            let place = Place::Joint(joint + 1);
            add(place, About::Reading(joint), 6);
            if n > 1 {
                add(place, About::Others(joint), n - 1);
            }
            add(place, About::Load, 3);
            add(place, About::Move(joint), 3);
            if directed {
                add(place, About::Direction(joint), 3);
            }
            add(Place::Link(joint + 1), About::Constant, 6);
            add(Place::Link(joint + 1), About::Load, 6);
        }
        for place in [Place::Base, Place::Tool] {
            add(place, About::Constant, 6);
            add(place, About::Load, 6);
            add(place, About::Time, 6);
            if data.rows.iter().any(|r| r.temperature.is_some()) {
                add(place, About::Temperature, 6);
            }
        }
        probes
    }

    pub(crate) fn of(
        problem: &Problem<'_>,
        effect: &'static dyn Effect,
        spot: Spot,
        forms: usize,
    ) -> Candidate {
        let mut parameters = effect.parameters(problem.arm, spot);
        for p in &mut parameters {
            p.usual = Prior::usual(&problem.priors, effect, p);
        }
        let held = |p: &Parameter| match (effect.is_tolerated(), p.quantity) {
            (false, _) => loosely(p.usual),
            (true, Quantity::Angle) => 1.0 / problem.tolerance[1],
            (true, _) => 1.0 / problem.tolerance[0],
        };
        let usual = Usual {
            least: parameters.iter().map(|p| p.least).collect(),
            held: parameters.iter().map(held).collect(),
            multiplicity: forms * effect.places(problem.arm).len() * effect.odds(),
        };
        Candidate { source: Source::Effect { effect, spot }, size: parameters.len(), usual }
    }

    /// As a part of a model, with such values; `None` of a probe.
    pub(crate) fn fitted(&self, spot: Spot, values: Vec<f64>) -> Option<Fitted> {
        let (effect, _) = self.effect()?;
        Some(Fitted { effect, spot, values, usual: self.usual.clone(), margin: 0.0 })
    }

    pub(crate) fn probe(probe: Probe, size: usize) -> Candidate {
        let (least, held) = (vec![f64::NEG_INFINITY; size], vec![0.0; size]);
        let usual = Usual { least, held, multiplicity: 1 };
        Candidate { source: Source::Probe(probe), size, usual }
    }

    pub(crate) fn block(&self, scene: &Scene<'_>) -> Matrix6xX<f64> {
        match &self.source {
            Source::Effect { effect, spot } => effect.block(scene, *spot),
            Source::Probe(probe) => probe.block(scene),
        }
    }

    /// What it moves, if that is one thing.
    pub(crate) fn carrier(&self) -> Option<Carrier> {
        match &self.source {
            Source::Effect { effect, spot } => effect.carrier(*spot),
            Source::Probe(probe) => probe.carrier(),
        }
    }

    pub(crate) fn place(&self) -> Place {
        match &self.source {
            Source::Effect { spot, .. } => spot.place,
            Source::Probe(probe) => probe.place,
        }
    }

    /// The effect and its spot; `None` of a probe.
    pub(crate) fn effect(&self) -> Option<(&'static dyn Effect, Spot)> {
        match &self.source {
            Source::Effect { effect, spot, .. } => Some((*effect, *spot)),
            Source::Probe(_) => None,
        }
    }

    /// Whether it is the spring of a joint (from 0).
    pub(super) fn is_spring_of(&self, joint: usize) -> bool {
        self.effect() == Some((JOINT_SPRING, Spot::at(Place::Joint(joint + 1))))
    }

    /// Whether it is told by the order in which rows were measured.
    pub(crate) fn follows_time(&self) -> bool {
        self.effect().is_some_and(|(effect, _)| effect.depends().follows_time())
    }

    /// Whether its forms are the orders of a periodic error.
    pub(crate) fn forms_are_orders(&self) -> bool {
        self.effect().is_some_and(|(e, _)| matches!(e.forms_are(), Forms::Orders { .. }))
    }

    /// Whether it is told from some effects of a model: no effect is there twice, and orders of a periodic error
    /// at one joint are told apart by how far they are from each other, `resolved` for each joint.
    pub(crate) fn is_apart<'f>(
        &self,
        resolved: &[f64],
        others: impl IntoIterator<Item = &'f Fitted>,
    ) -> bool {
        let Some((effect, spot)) = self.effect() else { return true };
        let is_near = |other: &Fitted| {
            let apart = other.spot.form.abs_diff(spot.form) as f64;
            other.effect == effect
                && other.spot.place == spot.place
                && (apart == 0.0 || self.forms_are_orders() && apart < resolved[spot.row()])
        };
        !others.into_iter().any(is_near)
    }

    /// Whether both are the same effect at the same place, in whatever form.
    pub(crate) fn is_same(&self, other: &Candidate) -> bool {
        match (self.effect(), other.effect()) {
            (Some((a, at)), Some((b, there))) => {
                a.identifier() == b.identifier() && at.place == there.place
            }
            _ => false,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnose::options::Options;
    use crate::effects::CATALOGUE;
    use crate::fixture::{rigid, row, table};
    use crate::measurement::Kind;
    use nalgebra::Vector6;

    /// Over 2.24 rad orders 9 and 11 are one and the same, 9 and 12 are not.
    #[test]
    fn orders_are_apart_by_what_the_range_of_their_joint_resolves() {
        let (arm, kind) = (rigid(), Kind::Pose { orientation: false });
        let data = table(vec![row(&[0.1, 0.2, 0.3], Vector6::zeros())], kind);
        let problem = Problem::new(&arm, &data, &Options::default()).unwrap();
        let of = |name: &str, joint: usize, form: usize| {
            let effect = CATALOGUE.into_iter().find(|e| e.identifier() == name).unwrap();
            let spot = Spot { place: Place::Joint(joint), form };
            (Candidate::of(&problem, effect, spot, 1), spot)
        };
        let order = |joint, form| of("transmission_error", joint, form);
        let resolved = [std::f64::consts::TAU / 2.24; 3];
        let (known, spot) = order(1, 9);
        let known = known.fitted(spot, vec![0.0; 2]).unwrap();
        let is_apart = |(other, _): (Candidate, Spot)| other.is_apart(&resolved, [&known]);
        assert!(!is_apart(order(1, 9)) && !is_apart(order(1, 11)) && !is_apart(order(1, 7)));
        assert!(is_apart(order(1, 12)) && is_apart(order(1, 6)) && is_apart(order(2, 9)));
        assert!(is_apart(of("backlash", 1, 0)));
    }
}
