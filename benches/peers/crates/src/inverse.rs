//! All branches of an IRB 120's inverse kinematics by rs-opw-kinematics (Brandstötter, Angerer & Hofbaur 2014) beside
//! stiffarm's: each one's solutions by its own forward kinematics, then timed by turns.

use rs_opw_kinematics::kinematic_traits::{Kinematics, Pose};
use rs_opw_kinematics::kinematics_impl::OPWKinematics;
use rs_opw_kinematics::parameters::opw_kinematics::Parameters;
use stiffarm::kernels::Inverse;

use super::{ROUNDS, processor_time, spread};

stiffarm::robot! {
    /// A spherical wrist behind two parallel axes.
    pub mod irb120 from "../../../robots/arms/irb120.toml";
    outputs: pose, inverse_kinematics;
}

const POSES: usize = 2048;

/// A whole turn is none.
fn apart(a: &[f64; 6], b: &[f64; 6]) -> f64 {
    let turn = core::f64::consts::TAU;
    let each = a.iter().zip(b).map(|(a, b)| (a - b - ((a - b) / turn).round() * turn).abs());
    each.fold(0.0, f64::max)
}

pub fn compete() {
    let parameters = Parameters {
        a1: 0.0,
        a2: -0.07,
        b: 0.0,
        c1: 0.29,
        c2: 0.27,
        c3: 0.302,
        c4: 0.072,
        offsets: [0.0, 0.0, -core::f64::consts::FRAC_PI_2, 0.0, 0.0, 0.0],
        ..Parameters::new()
    };
    let peer = OPWKinematics::new(parameters);
    let mut state = 1_u64;
    let mut angle = || {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        6.0 * ((state >> 11) as f64 / (1_u64 << 53) as f64) - 3.0
    };
    let postures: Vec<[f64; 6]> = (0..POSES).map(|_| core::array::from_fn(|_| angle())).collect();
    let ours: Vec<_> = postures.iter().map(irb120::pose).collect();
    let theirs: Vec<Pose> = postures.iter().map(|q| peer.forward(q)).collect();
    let (mut count, mut of_peer) = (0, 0);
    for ((q, our), their) in postures.iter().zip(&ours).zip(&theirs) {
        let at = their.translation;
        let off = [at.x, at.y, at.z].into_iter().zip(our.position).map(|(a, b)| (a - b).abs());
        assert!(off.fold(0.0, f64::max) < 1e-9, "the two arms are one");
        let found = irb120::Robot.inverse_kinematics(our, q);
        let reached: Vec<[f64; 6]> = found.reached(1e-9, 1e-9).map(|branch| branch.q).collect();
        let solutions = peer.inverse(their);
        count += reached.len();
        of_peer += solutions.len();
        // Each branch of the one is one of the other.
        for q in &solutions {
            assert!(reached.iter().any(|known| apart(known, q) < 1e-4), "{q:?} {reached:?}");
        }
    }
    let mut times = [const { Vec::new() }; 2];
    for round in 0..=ROUNDS {
        let start = processor_time();
        for (pose, near) in ours.iter().zip(&postures) {
            std::hint::black_box(irb120::Robot.inverse_kinematics(pose, near));
        }
        let between = processor_time();
        for pose in &theirs {
            std::hint::black_box(peer.inverse(pose));
        }
        let end = processor_time();
        // The first round warms up.
        if round > 0 {
            times[0].push((between - start) / POSES as f64);
            times[1].push((end - between) / POSES as f64);
        }
    }
    let ratios: Vec<f64> = times[1].iter().zip(&times[0]).map(|(a, b)| a / b).collect();
    let (least, middle, most) = spread(&ratios);
    println!(
        "irb120 inverse_kinematics: stiffarm-rust {:.1}, rs-opw-kinematics {:.1} ({least:.2} {middle:.2} {most:.2}); \
         branches a pose {:.2}, {:.2}",
        spread(&times[0]).1,
        spread(&times[1]).1,
        count as f64 / POSES as f64,
        of_peer as f64 / POSES as f64,
    );
}
