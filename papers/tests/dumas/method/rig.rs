//! The experiment of the paper, simulated: a mass on a chain, a spring balance, a laser tracker and
//! three reflectors (Dumas et al., section 4).
//!
//! The arm deflects exactly (equilibrium in the loaded geometry, [`stiffarm_gap::simulate`]), not by the
//! linear model that is fitted. What the paper does not print (postures, directions, lever, base of
//! the reflectors) is a setting here.

use nalgebra::{Point3, Vector3, Vector6};
use stiffarm_kernels::generic::Arm;

use super::points::{gram_schmidt, kabsch};
use super::zones::{Zone, table_1};
use super::{IdentifyError, Test};
use stiffarm_gap::rng::{Rng, Stream};
use stiffarm_gap::simulate::equilibrium;

/// How tests are drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct Rig {
    /// Zones of the two joints below, drawn from in turn.
    pub zones: Vec<Zone>,
    /// The two joints of the zones, from 0.
    pub joints: [usize; 2],
    /// Ranges of other joints, from 0, rad or m; those not named stand at 0.
    pub others: Vec<(usize, [f64; 2])>,
    /// Joints among them that take either sign.
    pub either_sign: Vec<usize>,
    /// Sizes of the force, N.
    pub force: [f64; 2],
    /// The force comes in steps of this size above its least, N.
    pub force_step: f64,
    /// Angle of the chain from the vertical, rad, to any side.
    pub tilt: [f64; 2],
    /// Largest distance of the chain's end from the tool origin, m.
    pub lever: f64,
    /// Legs of the right-angled triangle of the reflectors about the tool origin, m.
    pub side: f64,
}

impl Rig {
    /// 1000 to 2500 N in steps of 250 N at up to 0.5 m, reflectors 0.25 m apart, in the zones of
    /// Table 1, the wrist free. Only the steps, the largest force and moment and the zones are
    /// printed; a chain that hangs at up to 45° to the vertical is assumed, without which k₁ does
    /// not show.
    pub fn dumas() -> Rig {
        let degrees = |low: f64, high: f64| [low.to_radians(), high.to_radians()];
        Rig {
            zones: table_1().into(),
            joints: [1, 2],
            others: vec![
                (0, degrees(-90.0, 90.0)),
                (3, degrees(-90.0, 90.0)),
                (4, degrees(30.0, 90.0)),
                (5, degrees(-90.0, 90.0)),
            ],
            either_sign: vec![4],
            force: [1000.0, 2500.0],
            force_step: 250.0,
            tilt: degrees(0.0, 45.0),
            lever: 0.5,
            side: 0.25,
        }
    }

    /// `count` tests as they are planned: joint readings and wrenches, the displacements 0.
    pub fn plan(&self, arm: &Arm, count: usize, seed: u64) -> Vec<Test> {
        let mut rng = Rng::new(seed, Stream::Starts);
        let draw = |k: usize| {
            let zone = &self.zones[k % self.zones.len()];
            let q = self.posture(arm, zone, &mut rng);
            Test { q, wrench: self.wrench(&mut rng), displacement: Vector6::zeros() }
        };
        (0..count).map(draw).collect()
    }

    fn posture(&self, arm: &Arm, zone: &Zone, rng: &mut Rng) -> Vec<f64> {
        let mut q = vec![0.0; arm.dof()];
        q[self.joints[0]] = rng.within(zone.first);
        q[self.joints[1]] = rng.within(zone.second);
        for (joint, range) in &self.others {
            q[*joint] = rng.within(*range);
        }
        for joint in self.either_sign.iter().filter(|joint| **joint < arm.dof()) {
            q[*joint] *= rng.sign();
        }
        q
    }

    fn wrench(&self, rng: &mut Rng) -> Vector6<f64> {
        let mut size = rng.within(self.force);
        if self.force_step > 0.0 {
            size = self.force[0]
                + ((size - self.force[0]) / self.force_step).round() * self.force_step;
        }
        let (tilt, round) = (rng.within(self.tilt), rng.within([0.0, core::f64::consts::TAU]));
        let side = Vector3::new(round.cos(), round.sin(), 0.0);
        let force = size * (tilt.sin() * side - tilt.cos() * Vector3::z());
        // Evenly in a ball.
        let radius = self.lever * rng.unit().cbrt();
        let direction = rng.normal3();
        let lever = direction * (radius / direction.norm().max(f64::MIN_POSITIVE));
        let moment = lever.cross(&force);
        Vector6::new(force.x, force.y, force.z, moment.x, moment.y, moment.z)
    }

    /// The reflectors in the tool frame, m.
    pub fn reflectors(&self) -> [Vector3<f64>; 3] {
        let s = self.side;
        [Vector3::zeros(), Vector3::new(s, 0.0, 0.0), Vector3::new(0.0, s, 0.0)]
    }
}

/// Standard deviations of what is read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Errors {
    /// One coordinate of one reflector, before and after, m.
    pub point: f64,
    /// The spring balance, N.
    pub balance: f64,
    /// Each joint, rad.
    pub encoder: f64,
}

impl Errors {
    /// None.
    pub const NONE: Errors = Errors { point: 0.0, balance: 0.0, encoder: 0.0 };

    /// As the paper lists them: 0.03 mm, 0.1 kg, 0.01°. It does not say of what these are the
    /// bounds; as three standard deviations they are [`Errors::scaled`] by a third.
    pub fn quoted() -> Errors {
        Errors { point: 0.03e-3, balance: 0.1 * 9.80665, encoder: 0.01_f64.to_radians() }
    }

    /// All of them times `factor`.
    pub fn scaled(self, factor: f64) -> Errors {
        Errors {
            point: self.point * factor,
            balance: self.balance * factor,
            encoder: self.encoder * factor,
        }
    }
}

/// How the displacement is got from the reflectors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PoseFit {
    /// [`gram_schmidt`], as the paper does.
    GramSchmidt,
    /// [`kabsch`].
    Kabsch,
}

/// The planned tests carried out on `arm`, which has the true stiffnesses: the arm stands and is
/// loaded with errors of encoder and balance that nobody knows, and the reflectors are read with
/// the tracker's.
///
/// # Errors
/// [`IdentifyError::Unstable`], [`IdentifyError::Collinear`].
pub fn carry_out(
    arm: &Arm,
    rig: &Rig,
    plan: &[Test],
    errors: Errors,
    fit: PoseFit,
    seed: u64,
) -> Result<Vec<Test>, IdentifyError> {
    let mut rng = Rng::new(seed, Stream::Starts);
    let mut tests = Vec::with_capacity(plan.len());
    for planned in plan {
        let q: Vec<f64> = planned.q.iter().map(|q| q + errors.encoder * rng.normal()).collect();
        let force = planned.wrench.fixed_rows::<3>(0).norm();
        let part = if force > 0.0 { errors.balance * rng.normal() / force } else { 0.0 };
        let loaded = equilibrium(arm, &q, &(planned.wrench * (1.0 + part)))?.tool;
        let unloaded = equilibrium(arm, &q, &Vector6::zeros())?.tool;
        let mut read = |tool: &nalgebra::Isometry3<f64>| {
            rig.reflectors().map(|p| (tool * Point3::from(p)).coords + errors.point * rng.normal3())
        };
        let (before, after) = (read(&unloaded), read(&loaded));
        let displacement = match fit {
            PoseFit::GramSchmidt => gram_schmidt(&before, &after)?,
            PoseFit::Kabsch => kabsch(&before, &after)?,
        };
        tests.push(Test { displacement, ..planned.clone() });
    }
    Ok(tests)
}
