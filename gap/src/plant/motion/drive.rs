//! What a joint's drive is besides the links: friction with a memory, rotor, springs, ripple.
//!
//! Friction is a bristle that bends as the joint begins to move and slides when it is bent all the way
//! (Dahl 1968; LuGre without its damping, Canudas de Wit et al. 1995): `z' = (v − |v| z)/travel`, the
//! torque `level(v) · z`. A joint at rest keeps its bristle, and so whatever torque holds it.

use super::truth::MotionTruth;
use stiffarm_kernels::generic;

/// How far a bristle bends where nothing is said of it, rad or m: less than an encoder tells. One of a tenth of
/// a milliradian takes some ten milliseconds to bend behind a reversal, and is found in a log.
const SHORT: f64 = 1e-5;

/// A bristle is no stiffer than a step can follow: it turns what moves in it through this angle in one.
const TURN: f64 = 0.3;

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
    /// Parts of the friction that a bristle longer than usual has, and how long it is.
    presliding: Vec<[f64; 2]>,
    load: f64,
    /// Cosine and sine of the joint's value.
    counterbalance: [f64; 2],
    /// Cosine and sine of so many times the joint's value.
    ripples: Vec<[f64; 3]>,
    /// What the link turns against the motor, per torque.
    pub(super) compliance: f64,
    pub(super) offset: f64,
    pub(super) scale: f64,
    pub(super) saturation: f64,
}

/// The bristles of one drive: each from −1 to 1.
#[derive(Clone, Debug, Default)]
pub(super) struct Bristles {
    short: f64,
    long: Vec<f64>,
}

/// What friction depends on beside its bristles.
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
            "warm_up" => self.warming += size / 60.0,
            _ => {}
        }
    }

    /// Torque against the motion.
    pub(super) fn friction(&self, at: Sliding, bristles: &Bristles) -> f64 {
        let speed = at.rate.abs();
        let stribeck = |[size, over]: &[f64; 2]| size * (-(speed / over).powi(2)).exp();
        let warm = 1.0 + self.warming * at.time;
        let level = warm * self.coulomb
            + self.asymmetry * bristles.short.signum()
            + self.root * speed.sqrt()
            + self.load * at.load.abs()
            + self.stribeck.iter().map(stribeck).sum::<f64>();
        // Of the whole level the long bristles carry their parts.
        let late = |([size, _], z): (&[f64; 2], &f64)| size * (z - bristles.short);
        level * bristles.short
            + self.presliding.iter().zip(&bristles.long).map(late).sum::<f64>()
            + warm * self.viscous * at.rate
    }

    /// What else the joint is held by.
    pub(super) fn springs(&self, q: f64) -> f64 {
        let [cos, sin] = self.counterbalance;
        let ripple =
            |[cos, sin, order]: &[f64; 3]| cos * (order * q).cos() + sin * (order * q).sin();
        cos * q.cos() + sin * q.sin() + self.ripples.iter().map(ripple).sum::<f64>()
    }

    /// What is told of a torque.
    pub(super) fn told(&self, torque: f64) -> f64 {
        (1.0 + self.scale) * torque * (1.0 + self.saturation * torque.abs()) + self.offset
    }

    /// How far the usual bristle bends in front of an inertia, at steps of so long.
    pub(super) fn travel(&self, inertia: f64, step: f64) -> f64 {
        SHORT.max(self.coulomb * (step / TURN).powi(2) / inertia)
    }
}

impl Bristles {
    /// Of a drive whose joint begins to move that way.
    pub(super) fn of(drive: &Drive, way: f64) -> Bristles {
        Bristles { short: way, long: vec![way; drive.presliding.len()] }
    }

    /// After a step at an even rate, exactly.
    pub(super) fn bend(&mut self, drive: &Drive, travel: f64, rate: f64, step: f64) {
        if rate == 0.0 {
            return;
        }
        let towards = |z: f64, over: f64| {
            let end = rate.signum();
            end + (z - end) * (-rate.abs() * step / over).exp()
        };
        self.short = towards(self.short, travel);
        for (z, [_, over]) in self.long.iter_mut().zip(&drive.presliding) {
            *z = towards(*z, *over);
        }
    }
}
