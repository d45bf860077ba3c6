//! Arms so simple that the answer can be written down.

use nalgebra::{Isometry3, Vector3, Vector6};
use stiffarm_kernels::generic::{Arm, Convention};
use stiffarm_plant::PlantError;

use crate::arms::{EXACT, MOVED, POSE, arm, beam, measured, one, plant, reading, row, rows};

/// One link along x, in a vertical plane: gravity is −y.
fn pendulum(length: f64, compliance: f64) -> Arm {
    let mut arm = arm(Convention::Standard, vec![row(0.0, 0.0, length, 0.0)]);
    arm.joints[0].compliance = compliance;
    arm.gravity = Vector3::new(0.0, -9.80665, 0.0);
    arm
}

/// The root of an increasing function, by bisection.
fn root(f: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if f(middle) < 0.0 { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

fn close(a: f64, b: f64) {
    assert!((a - b).abs() < 1e-12, "{a} {b}");
}

/// Rests where the spring's torque is the load's: φ = C·(−F L cos(q + φ) + m).
#[test]
fn a_pendulum_on_a_spring() {
    let (length, compliance, force, moment) = (0.8, 4e-4, 300.0, 40.0);
    let arm = pendulum(length, compliance);
    for q in [-0.9_f64, 0.0, 0.4, 2.0] {
        let torque = |turn: f64| -force * length * (q + turn).cos() + moment;
        let turn = root(|turn| turn - compliance * torque(turn), -1.0, 1.0);
        let found = one(&arm, &[], reading(&[q], [0.0, -force, 0.0, 0.0, 0.0, moment]));
        close(found[0], length * (q + turn).cos());
        close(found[1], length * (q + turn).sin());
        close(found[5], q + turn);
        assert!(turn.abs() > 0.01);
    }
}

#[test]
fn a_joint_that_hardens_and_one_that_winds_up() {
    let (length, compliance, force) = (0.8, 1e-4, 300.0);
    let arm = pendulum(length, compliance);
    let q = 0.3_f64;
    let torque = |turn: f64| -force * length * (q + turn).cos();
    let law = |turn: f64| compliance * torque(turn) - 2e-10 * torque(turn).powi(3);
    let turn = root(|turn| turn - law(turn), -1.0, 1.0);
    let load = [0.0, -force, 0.0, 0.0, 0.0, 0.0];
    let found = one(&arm, &["joint_hardening@joint 1=-2e-10"], reading(&[q], load));
    close(found[5], q + turn);
    for (side, sign) in [(-1_i8, -1.0), (0, 0.0), (1, 1.0)] {
        let law = |turn: f64| compliance * torque(turn) - sign * 3e-6 * torque(turn).abs();
        let turn = root(|turn| turn - law(turn), -1.0, 1.0);
        let mut row = reading(&[q], load);
        row.direction = Some(vec![side]);
        close(one(&arm, &["friction_hysteresis@joint 1=3e-6"], row)[5], q + turn);
    }
}

/// A column on a spring stands up to k/L, and no further.
#[test]
fn a_column_buckles() {
    let arm = pendulum(0.8, 1e-4);
    let critical = 1e4 / 0.8;
    let upright = |force: f64| {
        let up = reading(&[core::f64::consts::FRAC_PI_2], [0.0, -force, 0.0, 0.0, 0.0, 0.0]);
        plant(&arm, &[]).measure(&rows(POSE, vec![up]), EXACT, 0)
    };
    assert!(upright(0.999 * critical).is_ok());
    let error = upright(1.001 * critical).unwrap_err();
    assert_eq!(error, PlantError::Unstable { file: "rows".to_owned(), line: 2 });
}

/// F L³/3EI and F L²/2EI with their own second moments; torsion; and wL⁴/8EI of its own weight.
#[test]
fn a_cantilever_of_a_section_without_symmetry() {
    let (l, b) = (0.9_f64, beam());
    let mut arm = pendulum(l, 0.0);
    arm.joints[0].beam = Some(b.clone());
    let (eiy, eiz) = (b.youngs_modulus * b.iy, b.youngs_modulus * b.iz);
    let shear = 1.0 / (0.5 * b.shear_modulus * b.area);
    let still = one(&arm, &[], reading(&[0.0], [0.0; 6]));
    let w = b.density * b.area * 9.80665;
    close(still[1], -w * (l.powi(4) / (8.0 * eiz) + shear * l * l / 2.0));
    // Of rotations only one at a time is a rotation vector's component.
    close(still[5], -w * l.powi(3) / (6.0 * eiz));
    // Weightless, to see the tip's load alone.
    arm.gravity = Vector3::zeros();
    let up = one(&arm, &[], reading(&[0.0], [0.0, 0.0, 500.0, 0.0, 0.0, 0.0]));
    close(up[2], 500.0 * (l.powi(3) / (3.0 * eiy) + shear * l));
    close(up[4], -500.0 * l.powi(2) / (2.0 * eiy));
    let across = one(&arm, &[], reading(&[0.0], [0.0, 500.0, 0.0, 0.0, 0.0, 0.0]));
    close(across[1], 500.0 * (l.powi(3) / (3.0 * eiz) + shear * l));
    close(across[5], 500.0 * l.powi(2) / (2.0 * eiz));
    let twisted = one(&arm, &[], reading(&[0.0], [0.0, 0.0, 0.0, 70.0, 0.0, 0.0]));
    close(twisted[3], 70.0 * l / (b.shear_modulus * b.j));
    let pulled = one(&arm, &[], reading(&[0.0], [900.0, 0.0, 0.0, 0.0, 0.0, 0.0]));
    close(pulled[0] - l, 900.0 * l / (b.youngs_modulus * b.area));
}

/// The load's moment about the site tilts the bearing; the housing does not turn with the joint.
#[test]
fn a_bearing_tilts() {
    let arm = pendulum(0.8, 0.0);
    let q = 0.6_f64;
    let (force, tilt) = (50.0, [2e-5, 3e-5]);
    let found = one(
        &arm,
        &["bearing_compliance@joint 1:tilt_x=2e-5,tilt_y=3e-5"],
        reading(&[q], [0.0, 0.0, -force, 0.0, 0.0, 0.0]),
    );
    let at = Vector3::new(0.8 * q.cos(), 0.8 * q.sin(), 0.0);
    // r × f for f along −z, small angles: second order is below (2e-5·50·0.8)².
    let moment = at.cross(&Vector3::new(0.0, 0.0, -force));
    let turn = Vector3::new(tilt[0] * moment.x, tilt[1] * moment.y, 0.0);
    let moved = Vector3::new(found[0], found[1], found[2]) - at;
    assert!((moved - turn.cross(&at)).norm() < 2e-6 && moved.norm() > 5e-4, "{moved}");
    // A couple has the same moment wherever the arm goes: exact for one tilt alone.
    let couple = reading(&[0.0], [0.0, 0.0, 0.0, 40.0, 0.0, 0.0]);
    close(one(&arm, &["bearing_compliance@joint 1=2e-5"], couple)[3], 40.0 * 2e-5);
}

#[test]
fn a_foundation_gives_and_rocks() {
    let arm = pendulum(0.8, 0.0);
    let pulled = reading(&[0.0], [60.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    let found = one(&arm, &["base_compliance:give=1e-6"], pulled);
    close(found[0], 0.8 + 60e-6);
    let couple = reading(&[0.0], [0.0, 0.0, 0.0, 0.0, 40.0, 0.0]);
    let found = one(&arm, &["base_compliance:rock_y=2e-5"], couple);
    close(found[2], -0.8 * (40.0 * 2e-5_f64).sin());
    close(found[4], 40.0 * 2e-5);
    // It does not turn about the vertical.
    let couple = reading(&[0.0], [0.0, 0.0, 0.0, 0.0, 0.0, 40.0]);
    let found = one(&arm, &["base_compliance:rock_x=1e-5,rock_y=2e-5,give=1e-6"], couple);
    close(found[5], 0.0);
}

/// Two links under load: the energy's gradient vanishes, found by Newton's method on the two
/// angles.
#[test]
fn two_links_on_two_springs() {
    let (l, c) = ([0.7, 0.5], [3e-4, 5e-4]);
    let mut arm = pendulum(l[0], c[0]);
    arm.joints.push(row(0.0, 0.0, l[1], 0.0));
    arm.joints[1].compliance = c[1];
    arm.joints[0].mass = 12.0;
    arm.joints[0].com = Vector3::new(-0.3, 0.0, 0.0);
    let (q, force) = ([0.4, -1.1], [80.0, -200.0]);
    let (mut a, mut b) = (0.0_f64, 0.0_f64);
    for _ in 0..200 {
        let (s1, c1) = (q[0] + a).sin_cos();
        let (s12, c12) = (q[0] + q[1] + a + b).sin_cos();
        let second = force[1] * l[1] * c12 - force[0] * l[1] * s12;
        let first = force[1] * l[0] * c1 - force[0] * l[0] * s1 + second
            - 12.0 * 9.80665 * (l[0] - 0.3) * c1;
        (a, b) = (c[0] * first, c[1] * second);
    }
    let found = one(&arm, &[], reading(&q, [force[0], force[1], 0.0, 0.0, 0.0, 0.0]));
    let (s1, c1) = (q[0] + a).sin_cos();
    let (s12, c12) = (q[0] + q[1] + a + b).sin_cos();
    close(found[0], l[0] * c1 + l[1] * c12);
    close(found[1], l[0] * s1 + l[1] * s12);
}

/// A displacement is loaded less unloaded: weights, frames and zeros cancel.
#[test]
fn a_displacement_is_a_difference() {
    let mut arm = pendulum(0.8, 1e-5);
    arm.joints[0].mass = 20.0;
    arm.tool = Isometry3::translation(0.1, 0.0, 0.0);
    let loaded = reading(&[0.5], [0.0, -100.0, 0.0, 0.0, 0.0, 0.0]);
    let found = measured(&arm, &[], &rows(MOVED, vec![loaded.clone()]))[0];
    let (with, without) = (one(&arm, &[], loaded), one(&arm, &[], reading(&[0.5], [0.0; 6])));
    let expected: Vector6<f64> = with - without;
    assert!((found - expected).amax() < 1e-13 && found[1] < -1e-4);
}
