//! What a joint's drive is besides the links: friction, rotor, springs, ripple.
//!
//! Friction is dry: a joint that slides is braked by what its speed, load and time say, and one that stands
//! is held by whatever it takes up to that ([`super::stick`]). What is planted to build up over a distance
//! is a bristle that bends as the joint moves (Dahl 1968): `z' = (v − |v| z)/distance`, the torque `size · z`.

use super::truth::MotionTruth;
use stiffarm_kernels::generic;

/// The numbers of one drive.
#[derive(Clone, Debug, Default)]
pub(super) struct Drive {
    pub(super) rotor: f64,
    coulomb: f64,
    /// More where the joint rises, less where it falls.
    asymmetry: f64,
    viscous: f64,
    /// Part of Coulomb and viscous friction that comes with every second.
    warming: f64,
    root: f64,
    /// Torques, and the speeds at which they have gone.
    stribeck: Vec<[f64; 2]>,
    /// Parts of the friction that bristles have, and how far they bend.
    presliding: Vec<[f64; 2]>,
    load: f64,
    /// Cosine and sine of the joint's value.
    counterbalance: [f64; 2],
    /// Cosine and sine of so many times the joint's value.
    ripples: Vec<[f64; 3]>,
    /// What the link turns against the motor, per torque.
    pub(super) compliance: f64,
    /// By how much more the joint is turned than its encoder reads.
    pub(super) zero: f64,
    pub(super) offset: f64,
    pub(super) scale: f64,
    pub(super) saturation: f64,
}

/// What a drive remembers.
#[derive(Clone, Debug)]
pub(super) struct Memory {
    /// Which way it moved last: −1, 0 before it moves, 1.
    pub(super) way: f64,
    /// Each from −1 to 1.
    bristles: Vec<f64>,
}

/// What friction depends on beside what it remembers.
#[derive(Clone, Copy)]
pub(super) struct Sliding {
    pub(super) rate: f64,
    /// What the links ask of the joint.
    pub(super) load: f64,
    /// Since the run's start, s.
    pub(super) time: f64,
}

impl Drive {
    /// Of a robot file.
    pub(super) fn of(joint: &generic::Joint) -> Drive {
        let drive = &joint.drive;
        Drive {
            rotor: drive.gear * drive.gear * drive.rotor_inertia,
            coulomb: drive.coulomb,
            viscous: drive.viscous,
            ..Drive::default()
        }
    }

    /// With Coulomb friction alone.
    pub(super) fn braked(coulomb: f64) -> Drive {
        Drive { coulomb, ..Drive::default() }
    }

    /// With an effect of a torque log; those of a servo are none of the drive's.
    pub(super) fn put(&mut self, truth: &MotionTruth) {
        let size = truth.values[0];
        match truth.law.name {
            "coulomb_friction" => self.coulomb += size,
            "viscous_friction" => self.viscous += size,
            "friction_curve" => self.root += size,
            "stribeck" => self.stribeck.push([size, truth.value("speed")]),
            "presliding" => self.presliding.push([size, truth.value("distance")]),
            "load_friction" => self.load += size,
            "torque_saturation" => self.saturation += size,
            "asymmetric_friction" => self.asymmetry += size,
            "torque_offset" => self.offset += size,
            "torque_scale" => self.scale += size,
            "rotor_inertia" => self.rotor += size,
            "counterbalance" => {
                self.counterbalance[0] += size;
                self.counterbalance[1] += truth.value("sin");
            }
            "torque_ripple" => {
                self.ripples.push(["cos", "sin", "order"].map(|name| truth.value(name)));
            }
            "joint_elasticity" => self.compliance += size,
            "joint_offset" => self.zero += size,
            "warm_up" => self.warming += size / 60.0,
            _ => {}
        }
    }

    /// Why there is no such drive, in words.
    pub(super) fn fault(&self) -> Option<String> {
        let bristles: f64 = self.presliding.iter().map(|[size, _]| size).sum();
        let least = self.coulomb - self.asymmetry.abs() - bristles;
        (least < 0.0).then(|| {
            format!(
                "its Coulomb friction is {} N·m, and {} N·m of it are to build up by and by or to be there one \
                 way alone: make these smaller, or give it `coulomb`",
                self.coulomb,
                self.coulomb - least
            )
        })
    }

    /// Dry friction where it slides backwards, and forwards; where it stands it is between them.
    pub(super) fn dry(&self, at: Sliding) -> [f64; 2] {
        let speed = at.rate.abs();
        let stribeck = |[size, over]: &[f64; 2]| size * (-(speed / over).powi(2)).exp();
        let level = self.warm(at) * self.coulomb
            + self.root * speed.sqrt()
            + self.load * at.load.abs()
            + self.stribeck.iter().map(stribeck).sum::<f64>()
            - self.presliding.iter().map(|[size, _]| size).sum::<f64>();
        [(self.asymmetry - level).min(0.0), (self.asymmetry + level).max(0.0)]
    }

    /// What else brakes it: bristles, and what goes with its rate.
    pub(super) fn smooth(&self, at: Sliding, memory: &Memory) -> f64 {
        let bent = self.presliding.iter().zip(&memory.bristles).map(|([size, _], z)| size * z);
        bent.sum::<f64>() + self.warm(at) * self.viscous * at.rate
    }

    fn warm(&self, at: Sliding) -> f64 {
        1.0 + self.warming * at.time
    }

    /// What else the joint is held by.
    pub(super) fn springs(&self, q: f64) -> f64 {
        let [cos, sin] = self.counterbalance;
        let ripple =
            |[cos, sin, order]: &[f64; 3]| cos * (order * q).cos() + sin * (order * q).sin();
        cos * q.cos() + sin * q.sin() + self.ripples.iter().map(ripple).sum::<f64>()
    }

    pub(super) fn told(&self, torque: f64) -> f64 {
        (1.0 + self.scale) * torque * (1.0 + self.saturation * torque.abs()) + self.offset
    }

    /// The torque of which so much is told: what a drive gives that is asked for it.
    pub(super) fn given(&self, told: f64) -> f64 {
        let linear = (told - self.offset) / (1.0 + self.scale);
        let root = (1.0 + 4.0 * self.saturation * linear.abs()).max(0.0).sqrt();
        2.0 * linear / (1.0 + root)
    }
}

impl Memory {
    /// Of a drive that begins at this rate.
    pub(super) fn of(drive: &Drive, rate: f64) -> Memory {
        let way = if rate == 0.0 { 0.0 } else { rate.signum() };
        Memory { way, bristles: vec![way; drive.presliding.len()] }
    }

    /// Goes on by a step at an even rate: bristles bend, exactly.
    pub(super) fn bend(&mut self, drive: &Drive, rate: f64, step: f64) {
        if rate == 0.0 {
            return;
        }
        self.way = rate.signum();
        for (z, [_, over]) in self.bristles.iter_mut().zip(&drive.presliding) {
            *z = self.way + (*z - self.way) * (-rate.abs() * step / over).exp();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixture::geared;

    #[test]
    fn what_a_drive_is_told_gives_what_was_asked_for() {
        let arm = geared();
        let mut drive = Drive::default();
        for text in [
            "torque_scale@joint 2=0.1",
            "torque_offset@joint 2=2",
            "torque_saturation@joint 2=1e-3",
        ] {
            drive.put(&MotionTruth::parse(text, &arm, 1).unwrap());
        }
        for torque in [-80.0, -1.0, 0.0, 3.0, 60.0] {
            assert!((drive.given(drive.told(torque)) - torque).abs() < 1e-12 * 80.0);
        }
    }
}
