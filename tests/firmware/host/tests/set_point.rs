//! The control loop's set-point against a full compensation: the equilibrium of the loaded arm,
//! solved by iteration with the textbook's pose and Jacobian, which share no code with the kernels.

use nalgebra::{Isometry3, Vector3, Vector6};
use stiffarm_firmware_arms::Real;
use stiffarm_firmware_arms::draw::draw;
use stiffarm_firmware_arms::robots::ur5_springs::{DH, N, Robot};
use stiffarm_firmware_arms::set_point::{Reading, Refusal, STIFFNESS, correct};
use stiffarm_firmware_arms::source::{BROKEN, CENTRE, PERIODS, WEIGHT, run, target};
use stiffarm_kernels::generic::Arm;
use textbook::textbook;

mod textbook;

fn arm() -> Arm {
    textbook(&Robot, include_str!("../../arms/ur5_springs.toml"))
}

/// Where the links rest when the motors hold `held` under a load that depends on the tool's pose.
fn rest(arm: &Arm, held: &[f64; N], load: impl Fn(&Isometry3<f64>) -> Vector6<f64>) -> [f64; N] {
    let mut q = *held;
    for _ in 0..100 {
        let torque = arm.joint_torque(&q, &load(&arm.pose(&q)));
        let next = core::array::from_fn(|j| held[j] + arm.joints[j].compliance * torque[j]);
        let moved = (0..N).map(|j| f64::abs(next[j] - q[j])).fold(0.0, f64::max);
        q = next;
        if moved < 1e-15 {
            return q;
        }
    }
    panic!("no equilibrium within a hundred iterations: {held:?}");
}

/// The payload's wrench, for a tool with this pose.
fn payload(pose: &Isometry3<f64>) -> Vector6<f64> {
    let force = Vector3::new(0.0, 0.0, -f64::from(WEIGHT));
    let centre = pose.rotation * Vector3::from(CENTRE.map(|mm| f64::from(mm) / 1000.0));
    let moment = centre.cross(&force);
    Vector6::new(force.x, force.y, force.z, moment.x, moment.y, moment.z)
}

#[test]
fn the_loop_s_stiffnesses_are_the_table_s() {
    let of_the_table = DH.map(|row| row.stiffness.parse::<f64>().expect("a number"));
    assert_eq!(of_the_table, STIFFNESS);
}

/// Position by which the tool misses its target, m: with the loop's set-points at most, and with
/// the targets as set-points at least.
fn misses<S: Real>(to_f64: fn(S) -> f64) -> (f64, f64) {
    let arm = arm();
    let (mut corrected, mut uncorrected) = (0.0f64, f64::INFINITY);
    let mut refused = Vec::new();
    let mut period = 0;
    run::<S>(|target, _, result| {
        let target = target.map(to_f64);
        match result {
            Ok(correction) => {
                let wanted = arm.pose(&target).translation.vector;
                let miss = |held: &[f64; N]| {
                    (arm.pose(&rest(&arm, held, payload)).translation.vector - wanted).norm()
                };
                corrected = corrected.max(miss(&correction.set_point.map(to_f64)));
                uncorrected = uncorrected.min(miss(&target));
            }
            Err(refusal) => {
                assert_eq!(*refusal, Refusal::NotFinite);
                refused.push(period);
            }
        }
        period += 1;
    });
    assert_eq!((period, refused), (PERIODS, BROKEN.to_vec()));
    (corrected, uncorrected)
}

/// The set-point is that of a full compensation: nothing is left but rounding. In f32 the six
/// angles, below 4 rad, round by 2^-23 at most (their targets are as they are), in the reach of 1
/// m.
#[test]
fn the_loaded_tool_stands_at_its_target() {
    let (corrected, uncorrected) = misses::<f64>(|x| x);
    assert!(corrected < 1e-14, "{corrected:e} m");
    assert!(uncorrected > 2e-4, "{uncorrected:e} m: there is nothing to correct");
    let (corrected, _) = misses::<f32>(f64::from);
    assert!(corrected < 6.0 * 2f64.powi(-23), "{corrected:e} m");
}

/// The deflection is of first order in the springs' give: half the load, a quarter of its error.
#[test]
fn the_deflection_is_wrong_in_second_order() {
    let arm = arm();
    let mut ratios = Vec::new();
    for k in 5..200 {
        let (q, mut wrench) = draw::<f64, N>(k);
        if k % 25 == 4 {
            continue;
        }
        let error = |wrench: &[f64; 6]| {
            let reading = Reading { encoders: q, wrench: *wrench };
            let told = correct(&reading, &q).expect("a load that the arm bears").deflection;
            let here = arm.pose(&q);
            let force = here.rotation * Vector3::new(wrench[0], wrench[1], wrench[2]);
            let moment = here.rotation * Vector3::new(wrench[3], wrench[4], wrench[5]);
            let load = Vector6::new(force.x, force.y, force.z, moment.x, moment.y, moment.z);
            let there = arm.pose(&rest(&arm, &q, |_| load));
            let moved = there.translation.vector - here.translation.vector;
            let turned = (there.rotation * here.rotation.inverse()).scaled_axis();
            let actual = [moved.x, moved.y, moved.z, turned.x, turned.y, turned.z];
            (0..6).map(|i| (told[i] - actual[i]).powi(2)).sum::<f64>().sqrt()
        };
        let whole = error(&wrench);
        wrench = wrench.map(|x| 0.5 * x);
        ratios.push(whole / error(&wrench));
    }
    ratios.sort_by(f64::total_cmp);
    let [lowest, highest] = [ratios[0], ratios[ratios.len() - 1]];
    assert!(3.8 < lowest && highest < 4.2, "{lowest} to {highest}");
}

#[test]
fn what_is_not_finite_is_refused() {
    let good = Reading { encoders: target::<f32>(0), wrench: [1.0, -2.0, 30.0, 0.1, 0.2, 0.3] };
    assert!(correct(&good, &good.encoders).is_ok());
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        for k in 0..6 {
            let mut reading = good;
            reading.encoders[k] = bad;
            assert_eq!(correct(&reading, &good.encoders), Err(Refusal::NotFinite));
            assert_eq!(correct(&good, &reading.encoders), Err(Refusal::NotFinite));
            reading = good;
            reading.wrench[k] = bad;
            assert_eq!(correct(&reading, &good.encoders), Err(Refusal::NotFinite));
        }
    }
    let mut heavy = good;
    heavy.wrench = [0.0, 1e9, -1e9, 0.0, 0.0, 0.0];
    assert_eq!(correct(&heavy, &good.encoders), Err(Refusal::Unstable));
}
