//! What is looked for, as effects: the springs of the joints are the catalogue's, those of links and
//! foundation are told here.

use core::fmt;

use nalgebra::{Matrix6xX, Vector6};
use stiffarm_kernels::generic::Arm;

use super::Question;
use crate::diagnose::fit::Fitted;
use crate::effects::{
    At, AtRest, Facts, JOINT_SPRING, Law, Parameter, Place, Quantity, Scene, Spot,
};
use crate::infer::Usual;
use crate::measurement::Row;
use crate::simulate::{Actual, Moment, Site};

/// The least flexibility that is simulated, as a multiple of the robot file's.
const STIFFEST: f64 = 1e-6;

/// One number that is looked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Unknown {
    /// The compliance of a joint (from 1), rad/(N·m), or m/N.
    Joint(usize),
    /// The flexibility of the beam of a row (from 1) as a multiple of the robot file's.
    Link(usize),
    /// A compliance of the foundation at the base origin: component 0 to 2 a translation along x,
    /// y, z, m/N; 3 to 5 a rotation about them, rad/(N·m).
    Base(usize),
}

impl Unknown {
    /// All that a question asks for: joints, then links, then the base.
    pub(super) fn all(arm: &Arm, question: &Question) -> Vec<Unknown> {
        let rows = 1..=arm.dof();
        let bends = |row: &usize| question.links && arm.joints[row - 1].beam.is_some();
        let links = rows.clone().filter(bends).map(Unknown::Link);
        let base = (0..6).filter(|_| question.base).map(Unknown::Base);
        rows.map(Unknown::Joint).chain(links).chain(base).collect()
    }

    /// What the robot file has.
    pub(super) fn file(self, arm: &Arm) -> f64 {
        match self {
            Unknown::Joint(joint) => arm.joints[joint - 1].compliance,
            Unknown::Link(_) => 1.0,
            Unknown::Base(_) => 0.0,
        }
    }

    /// The effect that adds to that, by `value`.
    pub(super) fn added(self, arm: &Arm, value: f64) -> Fitted {
        let (effect, spot): (&'static dyn AtRest, Spot) = match self {
            Unknown::Joint(joint) => (JOINT_SPRING, Spot::at(Place::Joint(joint))),
            Unknown::Link(row) => (&LinkFlexibility, Spot::at(Place::Link(row))),
            Unknown::Base(form) => (&Foundation, Spot { place: Place::Base, form }),
        };
        let least = effect.parameters(arm, spot).iter().map(|p| p.least).collect();
        let usual = Usual { least, held: vec![0.0], multiplicity: 1 };
        Fitted { effect, spot, values: vec![value], usual, margin: 0.0 }
    }
}

impl fmt::Display for Unknown {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Unknown::Joint(joint) => write!(f, "joint {joint}"),
            Unknown::Link(row) => write!(f, "link {row}"),
            Unknown::Base(k) => {
                let what = ["along x", "along y", "along z", "about x", "about y", "about z"];
                write!(f, "base {}", what.get(*k).copied().unwrap_or("?"))
            }
        }
    }
}

/// A beam of the robot file is more flexible in all that it does, in proportion.
struct LinkFlexibility;

impl Law for LinkFlexibility {
    fn facts(&self) -> &'static Facts {
        const FACTS: &Facts = &Facts {
            identifier: "link_flexibility",
            at: At::Links,
            idle: "no load of this data reaches the link",
            ..Facts::NONE
        };
        FACTS
    }
}

impl AtRest for LinkFlexibility {
    fn places(&self, arm: &Arm) -> Vec<Place> {
        let bends = |row: &usize| arm.joints[row - 1].beam.is_some();
        (1..=arm.dof()).filter(bends).map(Place::Link).collect()
    }

    fn parameters(&self, _: &Arm, _: Spot) -> Vec<Parameter> {
        vec![Parameter::at_least("flexibility", Quantity::Ratio, STIFFEST - 1.0)]
    }

    fn alter(&self, actual: &mut Actual<'_>, _: &Row, _: &Moment, spot: Spot, values: &[f64]) {
        if let Some(beam) = &mut actual.arm.to_mut().joints[spot.row()].beam {
            beam.youngs_modulus /= 1.0 + values[0];
            beam.shear_modulus /= 1.0 + values[0];
        }
    }

    fn block(&self, scene: &Scene<'_>, spot: Spot) -> Matrix6xX<f64> {
        let modulus = |arm: &Arm| arm.joints[spot.row()].beam.as_ref().map(|b| b.youngs_modulus);
        let stiffer =
            modulus(&scene.actual.arm).zip(modulus(scene.nominal)).map(|(is, was)| is / was);
        let site = Site::Link(spot.row());
        // All that the link gives is in proportion.
        let gives = scene.state.displacement(site) * stiffer.unwrap_or(0.0);
        scene.carried(site, &[gives])
    }
}

/// The foundation gives in one component of what acts on it, each form another.
struct Foundation;

impl Law for Foundation {
    fn facts(&self) -> &'static Facts {
        const FACTS: &Facts = &Facts {
            identifier: "foundation",
            at: At::Base,
            idle: "no load of this data reaches the base",
            ..Facts::NONE
        };
        FACTS
    }
}

impl AtRest for Foundation {
    fn parameters(&self, _: &Arm, spot: Spot) -> Vec<Parameter> {
        let quantity =
            if spot.form < 3 { Quantity::LengthPerForce } else { Quantity::AnglePerMoment };
        vec![Parameter::free("compliance", quantity)]
    }

    fn alter(&self, actual: &mut Actual<'_>, _: &Row, _: &Moment, spot: Spot, values: &[f64]) {
        let (k, compliance) = (spot.form, values[0]);
        let law = move |load: &Vector6<f64>| Vector6::ith(k, compliance * load[k]);
        actual.laws.push((Site::Base, Box::new(law)));
    }

    fn block(&self, scene: &Scene<'_>, spot: Spot) -> Matrix6xX<f64> {
        let load = scene.state.load(Site::Base)[spot.form];
        scene.carried(Site::Base, &[Vector6::ith(spot.form, load)])
    }
}
