//! The paper's arms, and random numbers.

use std::collections::HashMap;

use nalgebra::{Vector3, Vector6};
use stiffarm_draws::Draws;
use stiffarm_kernels::generic::{Arm, Beam, Joint};

/// Links that bend, in any one system of units.
#[derive(Clone, Copy, Debug)]
pub struct Links<const N: usize> {
    pub lengths: [f64; N],
    /// E I.
    pub rigidity: [f64; N],
    /// Per unit length.
    pub weights: [f64; N],
    /// P: the weight at the end-effector.
    pub load: f64,
}

impl<const N: usize> Links<N> {
    pub fn drawn(random: &mut Draws) -> Self {
        Links {
            lengths: random.array(2.0, 30.0),
            rigidity: random.array(1e5, 5e7),
            weights: random.array(0.0, 0.3),
            load: random.between(0.5, 10.0),
        }
    }

    /// The values of the paper's symbols; each link by the name of its length and its number.
    pub fn values(&self, names: [(&str, usize); N], q: &[f64]) -> HashMap<String, f64> {
        let mut values = HashMap::from([("P".to_owned(), self.load)]);
        for (k, (length, number)) in names.into_iter().enumerate() {
            values.insert(length.to_owned(), self.lengths[k]);
            values.insert(format!("E{number}"), self.rigidity[k]);
            values.insert(format!("I{number}"), 1.0);
            values.insert(format!("W{number}"), self.weights[k]);
        }
        let angles = q.iter().enumerate().map(|(k, q)| (format!("theta{}", k + 1), *q));
        values.extend(angles);
        values
    }
}

/// So large that a link does not stretch (the paper neglects it).
const AREA: f64 = 1e15;

/// 10e6 psi, and 3.8e6 psi, which is usual for aluminium.
const YOUNG: f64 = 10e6;
const SHEAR: f64 = 3.8e6;

/// Table IV: a2, a3, a4, d6, in.
pub const ELBOW: [f64; 4] = [24.0, 24.0, 10.0, 3.5];

/// A round tube of 2.0 in outside and 1.8 in inside.
pub const TUBE: f64 = std::f64::consts::PI * (16.0 - 10.4976) / 64.0;

/// A row; its weight per inch is density × area × gravity, which is 1.
fn row(a: f64, alpha: f64, d: f64, section: Option<(f64, f64)>) -> Joint {
    let beam = section.map(|(rigidity, weight)| Beam {
        youngs_modulus: YOUNG,
        shear_modulus: SHEAR,
        area: AREA,
        iy: rigidity / YOUNG,
        iz: rigidity / YOUNG,
        j: 2.0 * rigidity / YOUNG,
        density: weight / AREA,
        shear_coefficient: None,
    });
    Joint { d, a, alpha: alpha.to_radians(), beam, ..Joint::default() }
}

fn arm(joints: Vec<Joint>, gravity: Vector3<f64>) -> Arm {
    Arm { name: "Lin, Chiang & Cui".to_owned(), joints, gravity, ..Arm::default() }
}

/// The planar arm of two links.
pub fn planar(links: &Links<2>) -> Arm {
    let of =
        |k: usize| row(links.lengths[k], 0.0, 0.0, Some((links.rigidity[k], links.weights[k])));
    arm(vec![of(0), of(1)], -Vector3::y())
}

/// The table of the elbow manipulator.
pub fn elbow(links: &Links<4>) -> Arm {
    let [a2, a3, a4, d6] = links.lengths;
    let section = |k: usize| Some((links.rigidity[k], links.weights[k]));
    let rows = vec![
        row(0.0, 90.0, 0.0, None),
        row(a2, 0.0, 0.0, section(0)),
        row(a3, 0.0, 0.0, section(1)),
        row(a4, -90.0, 0.0, section(2)),
        row(0.0, 90.0, 0.0, None),
        row(0.0, 0.0, d6, section(3)),
    ];
    arm(rows, -Vector3::z())
}

/// Table IV under 5 lb, with links of `weight` lb/in (which the paper does not print).
pub fn printed_elbow(weight: f64) -> Links<4> {
    Links { lengths: ELBOW, rigidity: [YOUNG * TUBE; 4], weights: [weight; 4], load: 5.0 }
}

/// A weight of `p` along an axis of the base, downwards.
pub fn weight(axis: usize, p: f64) -> Vector6<f64> {
    let mut load = Vector6::zeros();
    load[axis] = -p;
    load
}

/// A stream for each seed.
pub fn draws(seed: u64) -> Draws {
    let mut draws = Draws::from_state(seed);
    draws.part();
    draws
}
