//! Truths that add to what a robot file can say, against the arm whose file says it.

use nalgebra::{Isometry3, Vector3, Vector6};
use stiffarm_kernels::generic::{Arm, Beam, Convention};

use crate::arms::{POSE, arm, beam, loaded, measured, one, reading, row, rows};

const BOTH: [Convention; 2] = [Convention::Standard, Convention::Modified];
const Q: [f64; 5] = [0.7, -0.5, 0.2, 1.1, -0.4];
const WRENCH: [f64; 6] = [90.0, -60.0, -250.0, 12.0, -8.0, 20.0];

#[track_caller]
fn same(a: &Vector6<f64>, b: &Vector6<f64>, tolerance: f64) {
    let error = (a - b).amax();
    assert!(error < tolerance, "{error:e}");
}

fn against(arm: &Arm, truth: &str, file: &Arm) {
    let nominal = one(arm, &[], reading(&Q, WRENCH));
    let found = one(arm, &[truth], reading(&Q, WRENCH));
    let expected = one(file, &[], reading(&Q, WRENCH));
    assert!((nominal - found).amax() > 1e-6, "{truth} shows nothing");
    same(&found, &expected, 1e-12);
}

#[test]
fn springs_add_up() {
    for convention in BOTH {
        let arm = loaded(convention);
        let mut file = arm.clone();
        file.joints[1].compliance += 3e-7;
        against(&arm, "joint_compliance@joint 2=3e-7", &file);
        let mut file = arm.clone();
        file.joints[2].compliance += 3e-7;
        against(&arm, "joint_compliance@joint 3=0.3 um/N", &file);
    }
}

#[test]
fn masses_add_up() {
    for convention in BOTH {
        let arm = loaded(convention);
        let mut file = arm.clone();
        file.joints[3].mass += 5.0;
        against(&arm, "link_weight@link 4=5kg", &file);
    }
    // Without a mass of its own: at the middle of the chord.
    let mut arm = loaded(Convention::Standard);
    arm.joints[1].mass = 0.0;
    let mut file = arm.clone();
    file.joints[1].mass = 5.0;
    // Chord of row 2 in its own frame: a along x; d along z, seen through Rx(alpha), alpha 0.
    file.joints[1].com = Vector3::new(-0.35, 0.0, -0.025);
    against(&arm, "link_weight@link 2=5kg", &file);
}

#[test]
fn masses_are_elsewhere() {
    for convention in BOTH {
        let arm = loaded(convention);
        let mut file = arm.clone();
        file.joints[3].com += Vector3::new(0.05, -0.02, 0.03);
        against(&arm, "link_com@link 4:x=50mm,y=-20mm,z=30mm", &file);
    }
}

/// A base that is not level: the weights, and a load that hangs, pull elsewhere; what a load cell
/// measured does not.
#[test]
fn gravity_is_tilted() {
    let text = "gravity_tilt:x=4mrad,y=-7mrad";
    let turn = nalgebra::Rotation3::new(Vector3::new(4e-3, -7e-3, 0.0));
    for convention in BOTH {
        let arm = loaded(convention);
        let mut file = arm.clone();
        file.gravity = turn * arm.gravity;
        against(&arm, text, &file);
        // 30 kg, beside the tool and as high.
        let (at, weight) = (Vector3::new(0.11, -0.06, 0.0), 30.0 * arm.gravity);
        let load = |force: Vector3<f64>| {
            let moment = at.cross(&force);
            reading(&Q, [force.x, force.y, force.z, moment.x, moment.y, moment.z])
        };
        let found = one(&arm, &[text], load(weight));
        same(&found, &one(&file, &[], load(turn * weight)), 1e-12);
        assert!((found - one(&file, &[], load(weight))).amax() > 1e-6);
    }
}

#[test]
fn links_bend_like_beams_of_the_file() {
    for convention in BOTH {
        let mut arm = loaded(convention);
        let (bending, torsion) = (2e-7, 3e-7);
        let mut file = arm.clone();
        for link in [2, 4] {
            let beam = file.joints[link - 1].beam.as_mut().unwrap();
            *beam = softer(beam, bending, torsion);
            let truth = format!("link_compliance@link {link}:bending={bending},torsion={torsion}");
            against(&arm, &truth, &file);
            arm = file.clone();
        }
    }
}

/// The beam with so much more of 1/EI and 1/GJ.
fn softer(beam: &Beam, bending: f64, torsion: f64) -> Beam {
    let less = |modulus: f64, moment: f64, more: f64| 1.0 / (1.0 / (modulus * moment) + more);
    Beam {
        iy: less(beam.youngs_modulus, beam.iy, bending) / beam.youngs_modulus,
        iz: less(beam.youngs_modulus, beam.iz, bending) / beam.youngs_modulus,
        j: less(beam.shear_modulus, beam.j, torsion) / beam.shear_modulus,
        ..beam.clone()
    }
}

#[test]
fn loads_are_not_what_the_columns_say() {
    let arm = loaded(Convention::Standard);
    let scaled = one(&arm, &["wrench_scale=10%"], reading(&Q, WRENCH));
    let expected = one(&arm, &[], reading(&Q, WRENCH.map(|w| 1.1 * w)));
    same(&scaled, &expected, 1e-13);
    // A force beside the tool's origin is a force at a tool's origin beside it.
    let beside = Vector3::new(0.04, -0.03, 0.1);
    let mut moved = arm.clone();
    moved.tool *= Isometry3::translation(beside.x, beside.y, beside.z);
    let found = one(&arm, &["payload_com:x=0.04,y=-0.03,z=0.1"], reading(&Q, WRENCH));
    let mut seen = reading(&Q, WRENCH);
    seen.offset = Some([-beside.x, -beside.y, -beside.z]);
    same(&found, &one(&moved, &[], seen), 1e-12);
}

/// A planar arm written in either convention: its first link is row 1 of the one, row 2 of the
/// other.
#[test]
fn both_conventions_are_one_arm() {
    let half = core::f64::consts::FRAC_PI_2;
    let mut standard =
        arm(Convention::Standard, vec![row(0.0, 0.0, 0.8, 0.0), row(0.0, 0.0, 0.5, half)]);
    let mut modified =
        arm(Convention::Modified, vec![row(0.0, 0.0, 0.0, 0.0), row(0.0, 0.0, 0.8, 0.0)]);
    standard.joints[0].beam = Some(beam());
    modified.joints[1].beam = Some(beam());
    for arm in [&mut standard, &mut modified] {
        for joint in &mut arm.joints {
            joint.compliance = 2e-6;
        }
        arm.gravity = Vector3::new(0.0, -9.80665, -3.0);
    }
    modified.tool = Isometry3::new(Vector3::new(0.5, 0.0, 0.0), Vector3::new(half, 0.0, 0.0));
    let design = rows(
        POSE,
        vec![reading(&[0.4, 0.9], WRENCH), reading(&[-1.2, 2.0], [0.0, 300.0, 0.0, 0.0, 9.0, 0.0])],
    );
    let bends = ["link_compliance@link 1=1e-7", "link_compliance@link 2=1e-7"];
    let one = measured(&standard, &[bends[0]], &design);
    let other = measured(&modified, &[bends[1]], &design);
    let without = measured(&standard, &[], &design);
    for k in 0..2 {
        assert!((one[k] - without[k]).amax() > 1e-6);
        same(&one[k], &other[k], 1e-13);
    }
}
