//! The paper's arms, and random numbers.

use nalgebra::{Isometry3, Vector3, Vector6};
use stiffarm_draws::Draws;
use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::{Arm, Beam, Convention, Joint};
use stiffarm_papers::lin::{ElbowLinks, TwoLink};

/// So large that a link does not stretch (the paper neglects it).
const AREA: f64 = 1e15;

/// 10e6 psi, and 3.8e6 psi, which is usual for aluminium.
const YOUNG: f64 = 10e6;
const SHEAR: f64 = 3.8e6;

/// Distributed weights of the planar arm in lb/in. The paper does not print them; with these Table
/// I comes back to the printed digits and Table II to one unit of the last.
pub const WEIGHTS: [f64; 2] = [0.2245, 0.0987];

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
    Joint {
        motion: Motion::Revolute,
        theta: 0.0,
        d,
        a,
        alpha: alpha.to_radians(),
        beta: 0.0,
        compliance: 0.0,
        mass: 0.0,
        com: Vector3::zeros(),
        limits: None,
        beam,
    }
}

fn arm(joints: Vec<Joint>, gravity: Vector3<f64>) -> Arm {
    Arm {
        name: "Lin, Chiang & Cui".to_owned(),
        convention: Convention::Standard,
        joints,
        base: Isometry3::identity(),
        tool: Isometry3::identity(),
        tool_rotation_vector: Vector3::zeros(),
        gravity,
    }
}

/// The data of Tables II and III.
pub fn two_link(weights: [f64; 2], load: f64) -> TwoLink {
    let rigidity = [YOUNG * 1.920, YOUNG * 0.289];
    TwoLink { lengths: [24.0, 24.0], rigidity, weights, load }
}

/// The same arm as a table.
pub fn planar(links: &TwoLink) -> Arm {
    let of =
        |k: usize| row(links.lengths[k], 0.0, 0.0, Some((links.rigidity[k], links.weights[k])));
    arm(vec![of(0), of(1)], -Vector3::y())
}

/// The table of the elbow manipulator.
pub fn elbow(links: &ElbowLinks) -> Arm {
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
pub fn printed_elbow(weight: f64) -> ElbowLinks {
    ElbowLinks { lengths: ELBOW, rigidity: [YOUNG * TUBE; 4], weights: [weight; 4], load: 5.0 }
}

/// A weight of `p` along an axis of the base, downwards.
pub fn weight(axis: usize, p: f64) -> Vector6<f64> {
    let mut load = Vector6::zeros();
    load[axis] = -p;
    load
}

/// Random links.
pub trait Links {
    fn elbow(&mut self) -> ElbowLinks;
    fn two_link(&mut self) -> TwoLink;
}

impl Links for Draws {
    fn elbow(&mut self) -> ElbowLinks {
        ElbowLinks {
            lengths: self.array(2.0, 30.0),
            rigidity: self.array(1e5, 5e7),
            weights: self.array(0.0, 0.3),
            load: self.between(0.5, 10.0),
        }
    }

    fn two_link(&mut self) -> TwoLink {
        TwoLink {
            lengths: self.array(2.0, 30.0),
            rigidity: self.array(1e5, 5e7),
            weights: self.array(0.0, 0.3),
            load: self.between(0.5, 10.0),
        }
    }
}

/// A stream for each seed.
pub fn draws(seed: u64) -> Draws {
    let mut draws = Draws::from_state(seed);
    draws.part();
    draws
}

pub fn near(found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance, "{found} is not {expected} ± {tolerance}");
}
