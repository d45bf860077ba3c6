//! Free-form displacements at one place: what tells where a gap lies, and on what it depends, when
//! no effect of the catalogue explains it.

use nalgebra::{Matrix6xX, Vector6};

use crate::effects::{Carrier, Place, Scene};
use crate::simulate::Site;

/// On what a displacement depends.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) enum About {
    /// Nothing: the same in every row.
    Constant,
    /// The joint's own angle or length.
    Reading(usize),
    /// The other joints' readings.
    Others(usize),
    /// The load at the place.
    Load,
    /// The direction of approach of a joint.
    Direction(usize),
    /// The last move of a joint.
    Move(usize),
    /// Time, or the order of the rows.
    Time,
    /// Temperature.
    Temperature,
}

/// A displacement of one place as a smooth function of one thing.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Probe {
    pub(crate) place: Place,
    pub(crate) about: About,
}

impl Probe {
    /// What it moves, if that is a joint.
    pub(crate) fn carrier(&self) -> Option<Carrier> {
        match self.place {
            Place::Joint(number) => Some(Carrier::Joint(number - 1)),
            _ => None,
        }
    }

    pub(crate) fn block(&self, scene: &Scene<'_>) -> Matrix6xX<f64> {
        let units: [Vector6<f64>; 6] = std::array::from_fn(|k| Vector6::ith(k, 1.0));
        let site = match self.place {
            Place::Link(number) => Site::Link(number - 1),
            Place::Joint(number) => Site::Joint(number - 1),
            Place::Tool => Site::Tool,
            _ => Site::Base,
        };
        let whole = |part: f64| scene.carried(site, &units) * part;
        if let Some(carrier) = self.carrier() {
            let mut motions = Vec::new();
            self.motions(scene, &mut motions);
            return scene.moved(Some(carrier), &motions);
        }
        match self.about {
            About::Load => {
                let load = scene.state.load(site);
                let own: [Vector6<f64>; 6] = std::array::from_fn(|k| Vector6::ith(k, load[k]));
                scene.carried(site, &own)
            }
            About::Time => whole(scene.when.clock),
            About::Temperature => whole(scene.when.warming),
            _ => whole(1.0),
        }
    }

    /// How far it moves its joint, per unit of each of its numbers.
    pub(crate) fn motions(&self, scene: &Scene<'_>, motions: &mut Vec<f64>) {
        let q = &scene.row.q;
        let torque = scene.state.torque[self.place.row()];
        match self.about {
            About::Reading(j) => motions
                .extend((1..=3).flat_map(|k| <[f64; 2]>::from((f64::from(k) * q[j]).sin_cos()))),
            About::Others(j) => motions.extend((0..q.len()).filter(|k| *k != j).map(|k| q[k])),
            About::Direction(j) => {
                let s = scene.direction(j);
                motions.extend([s, s * torque.abs(), s * torque]);
            }
            About::Move(j) => {
                let moved = scene.when.last_move[j];
                let way = if moved == 0.0 { 0.0 } else { moved.signum() };
                motions.extend([moved, moved.abs(), way]);
            }
            _ => motions.extend([torque, torque * torque.abs(), torque.powi(3)]),
        }
    }
}

impl About {
    /// As it is reported.
    pub(crate) fn name(self) -> String {
        match self {
            About::Constant => "nothing: it is the same in every row".to_owned(),
            About::Reading(j) => format!("q{}", j + 1),
            About::Others(j) => format!("the joints other than {}", j + 1),
            About::Load => "load".to_owned(),
            About::Direction(j) => format!("s{}", j + 1),
            About::Move(j) => format!("last move of joint {}", j + 1),
            About::Time => "time".to_owned(),
            About::Temperature => "temperature".to_owned(),
        }
    }
}
