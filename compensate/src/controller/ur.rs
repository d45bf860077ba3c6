//! Universal Robots: `calibration.conf` of the controller, and the kinematics file of the ROS package `ur_description`.
//!
//! `calibration.conf` holds what the arm's table has more than that of its model: `delta_theta`, `delta_a`, `delta_d`,
//! `delta_alpha` in `[mounting]`, rad and m, of rows of the standard convention. Beside them stand numbers of the joints'
//! electronics (`joint_checksum`, `joint_raw_offset`, …), which only the robot's own file has. The model's table stands in
//! `[DH]` of `urcontrol.conf`: `a`, `d`, `alpha`, m and rad.
//!
//! The kinematics file holds the place of each axis before the last one turns: `x y z`, m, and `roll pitch yaw`, rad.

use std::ops::Range;

use nalgebra::{Isometry3, Vector3};
use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::{Arm, Convention, Joint};

use super::{ControllerError, axes, tilt, told};
use crate::program::{Change, edited};

/// Puts a number of a row.
type Set = fn(&mut Joint, f64);

/// The table of a model, as `urcontrol.conf` of its controller has it.
///
/// # Errors
/// [`ControllerError`]: a list that is missing, or that is not six numbers.
pub fn model(file: &[u8]) -> Result<Arm, ControllerError> {
    let start = section(file, b"[DH]").ok_or_else(|| {
        ControllerError::Missing("[DH]".to_owned(), "the urcontrol.conf of this robot")
    })?;
    let mut joints = vec![Joint::default(); LINKS.len()];
    let entries: [(&str, Set); 3] = [
        ("a", |joint, number| joint.a = number),
        ("d", |joint, number| joint.d = number),
        ("alpha", |joint, number| joint.alpha = number),
    ];
    for (name, set) in entries {
        let span = value(&file[start.clone()], name).ok_or_else(|| {
            let expected = "the table in [DH] of this robot's urcontrol.conf";
            ControllerError::Missing(format!("{name} = [...]"), expected)
        })?;
        let at = start.start + span.start;
        let text = String::from_utf8_lossy(&file[at..start.start + span.end]);
        let cells = text.trim_matches(['[', ']']).split(',').map(|cell| cell.trim().parse::<f64>());
        let numbers: Vec<f64> = cells.filter_map(Result::ok).filter(|x| x.is_finite()).collect();
        if numbers.len() != LINKS.len() || text.split(',').count() != LINKS.len() {
            return Err(ControllerError::Entry {
                line: 1 + file[..at].iter().filter(|byte| **byte == b'\n').count(),
                found: text.into_owned(),
                expected: "[six numbers of m or rad]",
            });
        }
        joints.iter_mut().zip(numbers).for_each(|(joint, number)| set(joint, number));
    }
    Ok(Arm {
        name: "the model of urcontrol.conf".to_owned(),
        convention: Convention::Standard,
        joints,
        base: Isometry3::identity(),
        tool: Isometry3::identity(),
        tool_rotation_vector: Vector3::zeros(),
        gravity: Vector3::zeros(),
    })
}

/// The lines of a section, behind its head.
fn section(file: &[u8], head: &[u8]) -> Option<Range<usize>> {
    let (mut start, mut at) = (None, 0);
    for line in file.split_inclusive(|byte| *byte == b'\n') {
        match start {
            None if line.trim_ascii() == head => start = Some(at + line.len()),
            Some(start) if line.starts_with(b"[") => return Some(start..at),
            _ => {}
        }
        at += line.len();
    }
    start.map(|start| start..at)
}

/// Links in the kinematics file, base to tip.
const LINKS: [&str; 6] = ["shoulder", "upper_arm", "forearm", "wrist_1", "wrist_2", "wrist_3"];

/// An entry of a row.
type Entry = fn(&Joint) -> f64;

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
    for (place, link) in axes(real).0.iter().zip(LINKS) {
        text.push_str(&format!("  {link}:\n"));
        for (name, value) in ["x", "y", "z", "roll", "pitch", "yaw"].iter().zip(told(place)) {
            text.push_str(&format!("    {name}: {value:?}\n"));
        }
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

#[cfg(test)]
mod tests {
    use super::*;

    const MODEL: &str = "[Hardware]\na = [9]\n\n[DH]\na = [0.0, -0.425, -0.3922, 0.0, 0.0, 0.0]\n\
        d = [0.1625, 0.0, 0.0, 0.1333, 0.0997, 0.0996] # m\nalpha = [1.5, 0, 0, 1.5, -1.5, 0]\n\
        q_home_offset = [0, 0, 0, 0, 0, 0]\n\n[Link]\nd = [7]\n";

    #[test]
    fn the_model_is_that_of_its_section() {
        let arm = model(MODEL.as_bytes()).unwrap();
        let of = |entry: Entry| arm.joints.iter().map(entry).collect::<Vec<f64>>();
        assert_eq!(of(|joint| joint.a), [0.0, -0.425, -0.3922, 0.0, 0.0, 0.0]);
        assert_eq!(of(|joint| joint.d), [0.1625, 0.0, 0.0, 0.1333, 0.0997, 0.0996]);
        assert_eq!(of(|joint| joint.alpha)[3..], [1.5, -1.5, 0.0]);
        // Its deltas from itself are none.
        let none = calibration(None, &arm, &arm).unwrap();
        assert_eq!(none.iter().filter(|byte| (b'1'..=b'9').contains(byte)).count(), 0);
    }

    #[test]
    fn a_wrong_model_is_told() {
        let refused = |from: &str, to: &str| {
            model(MODEL.replace(from, to).as_bytes()).unwrap_err().to_string()
        };
        assert_eq!(
            refused("[DH]", "[HD]"),
            "found no `[DH]`, expected the urcontrol.conf of this robot"
        );
        assert_eq!(
            refused("alpha =", "beta ="),
            "found no `alpha = [...]`, expected the table in [DH] of this robot's urcontrol.conf"
        );
        for wrong in ["0.1333, x, 0.0996]", "0.1333, 0.0997]", "0.1333, nan, 0.0996]"] {
            let told = refused("0.1333, 0.0997, 0.0996]", wrong);
            assert!(told.starts_with("line 6: found `[0.1625, 0.0, 0.0, 0.1333"), "{told}");
            assert!(told.ends_with("expected [six numbers of m or rad]"), "{told}");
        }
    }
}
