//! Arms and rows.

use nalgebra::{Isometry3, Vector3, Vector6};
use stiffarm_gap::Diagnosis;
use stiffarm_gap::instrument::Bench;
use stiffarm_gap::measurement::{Kind, Layout, Measurements, Row};
use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::{Arm, Beam, Convention, Joint};
use stiffarm_plant::{Frames, Noise, Plant, Truth};

pub const POSE: Kind = Kind::Pose { orientation: true };
pub const MOVED: Kind = Kind::Displacement { components: [true; 6] };
pub const EXACT: Noise = Noise { position: 0.0, rotation: 0.0 };

/// A revolute row: theta, d, a, alpha.
pub fn row(theta: f64, d: f64, a: f64, alpha: f64) -> Joint {
    Joint { theta, d, a, alpha, ..Joint::default() }
}

pub fn arm(convention: Convention, joints: Vec<Joint>) -> Arm {
    let gravity = Vector3::new(0.0, 0.0, -9.80665);
    Arm { name: "arm".to_owned(), convention, joints, gravity, ..Arm::default() }
}

/// A box section without symmetry.
pub fn beam() -> Beam {
    Beam {
        youngs_modulus: 70e9,
        shear_modulus: 26e9,
        area: 2e-3,
        iy: 2e-6,
        iz: 5e-6,
        j: 6e-6,
        density: 2700.0,
        shear_coefficient: Some(0.5),
    }
}

/// Five joints in space, one of them prismatic, with twists of all kinds and a tool.
pub fn spatial(convention: Convention) -> Arm {
    let mut joints = vec![
        row(0.1, 0.35, 0.12, 1.2),
        row(-0.4, 0.05, 0.7, 0.0),
        row(0.3, 0.1, 0.08, -1.4),
        row(0.2, 0.15, 0.05, 0.9),
        row(0.0, 0.2, 0.03, 0.5),
    ];
    joints[2].motion = Motion::Prismatic;
    let mut arm = arm(convention, joints);
    arm.tool = Isometry3::new(Vector3::new(0.03, -0.05, 0.12), Vector3::new(0.2, -0.3, 0.5));
    arm.tool_rotation_vector = Vector3::new(0.2, -0.3, 0.5);
    arm
}

/// The same with springs, masses and beams.
pub fn loaded(convention: Convention) -> Arm {
    let mut arm = spatial(convention);
    for (k, joint) in arm.joints.iter_mut().enumerate() {
        joint.compliance = [4e-7, 3e-7, 2e-7, 8e-7, 9e-7][k];
        joint.mass = 9.0 - k as f64;
        joint.com = Vector3::new(-0.05, 0.02, 0.01 * k as f64);
    }
    arm.joints[1].beam = Some(beam());
    arm.joints[3].beam = Some(beam());
    arm
}

/// The same without beams: plant and model then agree to the rounding.
pub fn sprung(convention: Convention) -> Arm {
    let mut arm = loaded(convention);
    arm.joints.iter_mut().for_each(|joint| joint.beam = None);
    arm
}

pub fn reading(q: &[f64], wrench: [f64; 6]) -> Row {
    Row { wrench: wrench.into(), ..Row::new(1, q.to_vec()) }
}

pub fn rows(kind: Kind, rows: Vec<Row>) -> Measurements {
    let rows = (0..).zip(rows);
    let each = rows.map(|(k, row)| Row { line: k as u64 + 2, group: k, ..row });
    Measurements::new("rows", kind, each.collect())
}

pub fn plant(arm: &Arm, truths: &[&str]) -> Plant {
    let read = |text: &&str| Truth::parse(text, arm).expect("a truth of this arm");
    let truths: Vec<Truth> = truths.iter().map(read).collect();
    Plant::new(arm, &truths).expect("a plant")
}

/// What a noiseless instrument reads of each row.
pub fn measured(arm: &Arm, truths: &[&str], design: &Measurements) -> Vec<Vector6<f64>> {
    let data = plant(arm, truths).measure(design, EXACT, 0).expect("a stable arm");
    data.rows.into_iter().map(|row| row.measured).collect()
}

/// Of one row.
pub fn one(arm: &Arm, truths: &[&str], row: Row) -> Vector6<f64> {
    measured(arm, truths, &rows(POSE, vec![row]))[0]
}

pub fn isometry(v: &Vector6<f64>) -> Isometry3<f64> {
    Isometry3::new(Vector3::new(v[0], v[1], v[2]), Vector3::new(v[3], v[4], v[5]))
}

/// Distance and angle between two poses.
pub fn apart(a: &Isometry3<f64>, b: &Isometry3<f64>) -> f64 {
    let between = a.inv_mul(b);
    between.translation.vector.norm().max(between.rotation.scaled_axis().norm())
}

#[track_caller]
pub fn same_pose(measured: &Vector6<f64>, expected: &Isometry3<f64>, tolerance: f64) {
    let error = apart(&isometry(measured), expected);
    assert!(error <= tolerance, "{error:e} apart");
}

pub fn frames(base: Isometry3<f64>, tool: Isometry3<f64>) -> Frames {
    Frames { base, tool }
}

/// What the reader of a file has to know of an arm on a bench.
pub fn layout(arm: &Arm, bench: Bench) -> Layout {
    Layout { bench, ..Layout::new(arm.joints.iter().map(|j| j.motion)) }
}

/// A joint that is softer than the file says, rad/(N·m).
pub const SOFT: &str = "joint_compliance@joint 2=4e-6";

/// It is found, and nothing else.
#[track_caller]
pub fn soft_joint_is_found(d: &Diagnosis) {
    let [finding] = &d.findings[..] else { panic!("{:?}", d.findings) };
    assert_eq!((&*finding.effect, finding.place.as_str()), ("joint_compliance", "joint 2"));
    let [low, high] = finding.parameters[0].ci95;
    assert!((low..=high).contains(&4e-6), "{low:e} {high:e}");
}
