//! Universal Robots: `calibration.conf` of the controller, and the kinematics file of the ROS package `ur_description`.
//!
//! `calibration.conf` holds what the arm's table has more than that of its model: `delta_theta`, `delta_a`, `delta_d`,
//! `delta_alpha` in `[mounting]`, rad and m, of rows of the standard convention. Beside them stand numbers of the joints'
//! electronics (`joint_checksum`, `joint_raw_offset`, …), which only the robot's own file has.
//!
//! The kinematics file holds the place of each axis before the last one turns: `x y z`, m, and `roll pitch yaw`, rad.

use std::ops::Range;

use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};
use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::{Arm, Convention, Joint};

use super::ControllerError;
use crate::program::{Change, edited};

/// Links in the kinematics file, base to tip.
const LINKS: [&str; 6] = ["shoulder", "upper_arm", "forearm", "wrist_1", "wrist_2", "wrist_3"];

/// An entry of a row.
type Entry = fn(&Joint) -> f64;

/// Of products of rotations, m and rad.
const ROUNDING: f64 = 1e-15;

/// What differs of a row, by its name in `calibration.conf`.
const DELTAS: [(&str, Entry); 4] = [
    ("delta_theta", |joint| joint.theta),
    ("delta_a", |joint| joint.a),
    ("delta_d", |joint| joint.d),
    ("delta_alpha", |joint| joint.alpha),
];

/// `calibration.conf` of an arm whose model has the table `nominal`: the robot's own file with its four lists
/// replaced, or, without one, the lists alone.
///
/// # Errors
/// [`ControllerError`]: no such arm, or a list that the file lacks.
pub fn calibration(
    own: Option<&[u8]>,
    nominal: &Arm,
    real: &Arm,
) -> Result<Vec<u8>, ControllerError> {
    [nominal, real].into_iter().try_for_each(fits)?;
    let real = &without_beta(real);
    let list = |entry: Entry| {
        let pairs = real.joints.iter().zip(&nominal.joints);
        let each = pairs.map(|(is, was)| format!("{:?}", entry(is) - entry(was)));
        format!("[ {}]", each.collect::<Vec<_>>().join(", "))
    };
    let Some(own) = own else {
        let lines = DELTAS.map(|(name, entry)| format!("{name} = {}\n", list(entry)));
        return Ok(format!("[mounting]\n{}", lines.concat()).into_bytes());
    };
    let changes = DELTAS.map(|(name, entry)| {
        let span = value(own, name).ok_or_else(|| {
            ControllerError::Missing(
                format!("{name} = [...]"),
                "the calibration.conf of this robot",
            )
        })?;
        Ok(Change { span, text: list(entry) })
    });
    let changes: Result<Vec<Change>, ControllerError> = changes.into_iter().collect();
    Ok(edited(own, changes?))
}

/// The same arm up to its last axis by rows without `beta`, as UR's own calibrations are: where two axes are nearly
/// parallel, the foot of their common normal is metres away, and `d` of both rows says so.
///
/// A row's `Tx(a) Rx(alpha) Ry(beta)` is `Rz(t) Tz(d) Tx(a') Rx(alpha') Rz(psi) Tz(h)`, of which the last two are the
/// next row's.
fn without_beta(arm: &Arm) -> Arm {
    let mut arm = arm.clone();
    for k in 0..arm.joints.len().saturating_sub(1) {
        let joint = &mut arm.joints[k];
        if joint.beta == 0.0 {
            continue;
        }
        let m = tilt(joint).to_rotation_matrix();
        // Of the two solutions the one whose t is at most a quarter turn.
        let side = if m[(1, 2)] <= 0.0 { 1.0 } else { -1.0 };
        let t = (side * m[(0, 2)]).atan2(-side * m[(1, 2)]);
        let sine = side * m[(0, 2)].hypot(m[(1, 2)]);
        let psi = (side * m[(2, 0)]).atan2(side * m[(2, 1)]);
        let h = joint.a * t.sin() / sine;
        joint.theta += t;
        joint.d -= h * m[(2, 2)];
        (joint.a, joint.alpha, joint.beta) = (joint.a * t.cos(), sine.atan2(m[(2, 2)]), 0.0);
        arm.joints[k + 1].theta += psi;
        arm.joints[k + 1].d += h;
    }
    arm
}

/// By what a row turns the next axis from its own: `Rx(alpha) Ry(beta)`.
fn tilt(joint: &Joint) -> UnitQuaternion<f64> {
    let turn = |axis, angle| UnitQuaternion::from_axis_angle(&axis, angle);
    turn(Vector3::x_axis(), joint.alpha) * turn(Vector3::y_axis(), joint.beta)
}

/// The list that stands behind a name at the begin of a line.
fn value(text: &[u8], name: &str) -> Option<Range<usize>> {
    let mut start = 0;
    for line in text.split_inclusive(|byte| *byte == b'\n') {
        let at = start;
        start += line.len();
        let Some(rest) = line.trim_ascii_start().strip_prefix(name.as_bytes()) else { continue };
        if !rest.trim_ascii_start().starts_with(b"=") {
            continue;
        }
        let find = |byte: u8| line.iter().position(|b| *b == byte);
        let (open, close) = (find(b'[')?, find(b']')?);
        return (open < close).then_some(at + open..at + close + 1);
    }
    None
}

/// The kinematics file of an arm, `hash` the one of its own file.
///
/// # Errors
/// [`ControllerError`]: no such arm.
pub fn kinematics(real: &Arm, hash: &str) -> Result<String, ControllerError> {
    fits(real)?;
    let mut text = "kinematics:\n".to_owned();
    let mut end = Isometry3::identity();
    for (joint, link) in real.joints.iter().zip(LINKS) {
        let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), joint.theta);
        let axis = turn * Translation3::new(0.0, 0.0, joint.d);
        let place: Isometry3<f64> = end * axis;
        let (roll, pitch, yaw) = place.rotation.euler_angles();
        let origin = place.translation.vector;
        let values = [origin.x, origin.y, origin.z, roll, pitch, yaw];
        let values = values.map(|x| if x.abs() < ROUNDING { 0.0 } else { x });
        text.push_str(&format!("  {link}:\n"));
        for (name, value) in ["x", "y", "z", "roll", "pitch", "yaw"].iter().zip(values) {
            text.push_str(&format!("    {name}: {value:?}\n"));
        }
        end = Translation3::new(joint.a, 0.0, 0.0) * tilt(joint);
    }
    text.push_str(&format!("  hash: {hash}\n"));
    Ok(text)
}

fn fits(arm: &Arm) -> Result<(), ControllerError> {
    let found = arm.joints.len();
    if found != LINKS.len() {
        return Err(ControllerError::Joints { found, expected: LINKS.len() });
    }
    if arm.convention != Convention::Standard {
        return Err(ControllerError::Rows("rows of the modified convention".to_owned()));
    }
    match arm.joints.iter().position(|joint| joint.motion != Motion::Revolute) {
        Some(k) => Err(ControllerError::Rows(format!("a joint {} that slides", k + 1))),
        None => Ok(()),
    }
}
