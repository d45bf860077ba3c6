//! The experiment of section 4, simulated: a mass on a chain, a spring balance, a laser tracker and
//! three reflectors. The arm is at equilibrium in the loaded geometry, and the displacement is that of
//! eqs. 27 to 30. What the paper does not print (postures, directions, lever, base of the
//! reflectors) is assumed.

use std::fmt::Write as _;

use nalgebra::{Isometry3, Point3, Rotation3, UnitQuaternion, Vector3, Vector6};
use stiffarm_gap::identify::measured::{Answer, Question, identify_measured};
use stiffarm_gap::measurement::{Layout, Measurements};
use stiffarm_gap::rng::{Rng, Stream};
use stiffarm_gap::simulate::equilibrium;
use stiffarm_kernels::generic::Arm;

use super::zones::ZONES;

/// Standard deviations of what is read.
#[derive(Clone, Copy)]
pub struct Errors {
    /// One coordinate of one reflector, before and after, m.
    pub point: f64,
    /// The spring balance, N.
    pub balance: f64,
    /// Each joint, rad.
    pub encoder: f64,
}

pub const NONE: Errors = Errors { point: 0.0, balance: 0.0, encoder: 0.0 };

/// As the paper lists them: 0.03 mm, 0.1 kg, 0.01°, each read as a standard deviation.
pub const QUOTED: Errors = Errors { point: 3e-5, balance: 0.980_665, encoder: 1.745_329e-4 };

/// Legs of the right-angled triangle of the reflectors about the tool origin, m.
const SIDE: f64 = 0.25;

/// How the loads hang.
#[derive(Clone, Copy)]
pub struct Rig {
    /// Largest angle of the chain from the vertical, rad, to any side.
    pub tilt: f64,
    /// Largest distance of the chain's end from the tool origin, m.
    pub lever: f64,
}

/// At up to 45° from the vertical, without which k₁ does not show, and 0.5 m from the tool.
pub const RIG: Rig = Rig { tilt: core::f64::consts::FRAC_PI_4, lever: 0.5 };

/// The arm with its tool point 0.15 m beyond the flange, on axis 6.
pub fn with_tool() -> Arm {
    Arm { tool: Isometry3::translation(0.0, 0.0, 0.15), ..super::kr240() }
}

impl Rig {
    /// A posture in the zones of Table 1 and a force of 1000 to 2500 N in steps of 250 N.
    pub fn test(&self, k: usize, rng: &mut Rng) -> ([f64; 6], Vector6<f64>) {
        let mut within = |low: f64, high: f64| rng.within([low.to_radians(), high.to_radians()]);
        let (_, [from, to], [low, high]) = ZONES[k % ZONES.len()];
        let mut q = [within(-90.0, 90.0), within(from, to), within(low, high), 0.0, 0.0, 0.0];
        (q[3], q[4], q[5]) = (within(-90.0, 90.0), within(30.0, 90.0), within(-90.0, 90.0));
        q[4] *= rng.sign();
        let size = 1000.0 + 250.0 * rng.within([0.0, 6.0]).round();
        let (tilt, round) =
            (rng.within([0.0, self.tilt]), rng.within([0.0, core::f64::consts::TAU]));
        let side = Vector3::new(round.cos(), round.sin(), 0.0);
        let force = size * (tilt.sin() * side - tilt.cos() * Vector3::z());
        // Evenly in a ball.
        let lever = rng.normal3().normalize() * (self.lever * rng.unit().cbrt());
        let moment = lever.cross(&force);
        (q, Vector6::new(force.x, force.y, force.z, moment.x, moment.y, moment.z))
    }

    /// `count` tests carried out on `arm`, which has the true stiffnesses, as a measurement file.
    pub fn campaign(&self, arm: &Arm, count: usize, errors: Errors, seed: u64) -> Measurements {
        let mut rng = Rng::new(seed, Stream::Starts);
        let mut text = "q1,q2,q3,q4,q5,q6,fx,fy,fz,mx,my,mz,dx,dy,dz,drx,dry,drz\n".to_owned();
        for k in 0..count {
            let (q, wrench) = self.test(k, &mut rng);
            let actual = q.map(|q| q + errors.encoder * rng.normal());
            let part = errors.balance * rng.normal() / wrench.fixed_rows::<3>(0).norm();
            let at = |load: Vector6<f64>| equilibrium(arm, &actual, &load).unwrap().tool;
            let (unloaded, loaded) = (at(Vector6::zeros()), at(wrench * (1.0 + part)));
            let mut read = |tool: Isometry3<f64>| {
                [[0.0, 0.0], [SIDE, 0.0], [0.0, SIDE]].map(|[x, y]| {
                    (tool * Point3::new(x, y, 0.0)).coords + errors.point * rng.normal3()
                })
            };
            let moved = displacement(read(unloaded), read(loaded));
            let cells = q.iter().chain(&wrench).chain(&moved).map(|x| format!("{x:e}"));
            writeln!(text, "{}", cells.collect::<Vec<_>>().join(",")).unwrap();
        }
        let layout = Layout::new(arm.joints.iter().map(|joint| joint.motion));
        Measurements::from_bytes("campaign.csv", text.as_bytes(), &layout).unwrap()
    }
}

/// `δp = p' − p` of the first point and `δR = R' Rᵀ` of the frames: one axis from the first point to the
/// second, another toward the third (eqs. 27 to 30; δR is the same whichever is called x).
fn displacement(before: [Vector3<f64>; 3], after: [Vector3<f64>; 3]) -> Vector6<f64> {
    let frame = |[origin, along, toward]: [Vector3<f64>; 3]| {
        Rotation3::face_towards(&(along - origin), &(toward - origin))
    };
    let p = after[0] - before[0];
    let turn = frame(after) * frame(before).inverse();
    // By the quaternion: the arc cosine of a rotation matrix loses half the digits of a small angle.
    let r = UnitQuaternion::from_rotation_matrix(&turn).scaled_axis();
    Vector6::new(p.x, p.y, p.z, r.x, r.y, r.z)
}

/// What the tests say of `model`, whose joints count as rigid: √2 σ of a translation and 2σ/s of a
/// rotation are the noise of the three points, at least a micrometre.
pub fn identified(model: &Arm, tests: &Measurements, errors: Errors) -> Answer {
    let mut rigid = model.clone();
    rigid.joints.iter_mut().for_each(|joint| joint.compliance = 0.0);
    let sigma = errors.point.max(1e-6);
    let question = Question {
        noise_position: Some(2f64.sqrt() * sigma),
        noise_rotation: Some(2.0 * sigma / SIDE),
        ..Question::default()
    };
    identify_measured(&rigid, tests, &question, &|_| {}).unwrap()
}

#[test]
fn three_points_give_the_displacement_back() {
    let moved = Isometry3::new(Vector3::new(0.1, -0.2, 0.3), Vector3::new(0.7, -1.1, 0.4));
    let before = [[1.0, 0.5, -0.3], [1.2, 0.6, -0.3], [0.9, 0.7, -0.2]].map(Vector3::from);
    let after =
        before.map(|p| moved.rotation * (p - before[0]) + before[0] + moved.translation.vector);
    let [p, r] = [moved.translation.vector, moved.rotation.scaled_axis()];
    let found = displacement(before, after) - Vector6::new(p.x, p.y, p.z, r.x, r.y, r.z);
    assert!(found.amax() < 1e-14, "{found}");
}
