use nalgebra::Isometry3;

use super::*;
use crate::fixture::{arm, kr240};
use stiffarm_plant::design::{Design, Shape};
use stiffarm_plant::{Frames, Noise, Plant, Truth};

const POSE: Kind = Kind::Pose { orientation: true };
const MOVED: Kind = Kind::Displacement { components: [true; 6] };

fn design(arm: &Arm, shape: Shape, kind: Kind) -> Measurements {
    Design { shape, poses: 12, repeats: 1, payload: 10.0, kind, seed: 3 }.rows(arm)
}

fn campaign(arm: &Arm, shape: Shape, kind: Kind, truths: &[&str]) -> Measurements {
    let truths: Vec<Truth> = truths.iter().map(|t| Truth::parse(t, arm).unwrap()).collect();
    let noise = Noise { position: 5e-5, rotation: 1e-4 };
    Plant::new(arm, &truths).unwrap().measure(&design(arm, shape, kind), noise, 1).unwrap()
}

fn kuka() -> Arm {
    kr240([0.1, 0.0, 0.2])
}

#[track_caller]
fn only(doubts: &[String], said: &[&str]) {
    assert_eq!(doubts.len(), 1, "{doubts:#?}");
    assert!(said.iter().all(|said| doubts[0].contains(said)), "{doubts:?}");
}

#[test]
fn campaigns_as_they_are_raise_no_doubt() {
    let ur5 = include_str!("../../../robots/arms/ur5.toml");
    let puma = include_str!("../../../robots/arms/puma560.toml");
    let bad = ["joint_offset@joint 2=5 mrad", "tool_frame:x=3mm", "base_frame:x=5mm,rz=3mrad"];
    for arm in [kuka(), arm(ur5), arm(puma)] {
        for shape in Shape::ALL {
            for (kind, truths) in [(POSE, &[][..]), (POSE, &bad[..]), (MOVED, &[][..])] {
                let data = campaign(&arm, shape, kind, truths);
                assert_eq!(doubts(&arm, &data, &[]), [""; 0], "{} {shape:?}", arm.name);
            }
        }
    }
}

#[test]
fn a_plan_raises_no_doubt_of_what_is_not_measured() {
    let arm = kuka();
    let plan = design(&arm, Shape::Payload, POSE);
    assert_eq!(doubts(&arm, &plan, &Nuisance::ALL), [""; 0]);
}

#[test]
fn readings_in_degrees_are_noticed() {
    let arm = kuka();
    let mut data = campaign(&arm, Shape::Payload, POSE, &[]);
    for row in &mut data.rows {
        row.q.iter_mut().for_each(|q| *q = q.to_degrees());
    }
    only(&doubts(&arm, &data, &[]), &["rad", "in most rows: are they in degrees? write q1[deg]"]);
}

#[test]
fn another_arms_readings_are_no_degrees() {
    let arm = kuka();
    let mut data = campaign(&arm, Shape::Payload, POSE, &[]);
    for row in &mut data.rows {
        row.q[1] = -2.0;
    }
    only(&doubts(&arm, &data, &[]), &["q2 reaches 2 rad", "another robot's file"]);
}

#[test]
fn lengths_in_millimetres_are_noticed() {
    let arm = kuka();
    for (kind, name) in [(POSE, "write x[mm]"), (MOVED, "write dx[mm]")] {
        let mut data = campaign(&arm, Shape::Force, kind, &[]);
        // Of a displacement only the loaded rows are moved.
        data.rows.retain(|row| row.wrench.norm() > 0.0);
        for row in &mut data.rows {
            row.wrench *= 50.0;
            let millimetres = match kind {
                POSE => 1e3 * translation(row),
                _ => 1e3 * translation(row).normalize() * 0.7e-3,
            };
            row.measured.fixed_rows_mut::<3>(0).copy_from(&millimetres);
        }
        only(&doubts(&arm, &data, &[]), &["is it millimetres?", name]);
    }
}

#[test]
fn what_is_doubted_is_told_however_large() {
    let arm = kuka();
    let mut data = campaign(&arm, Shape::Payload, POSE, &[]);
    for row in &mut data.rows {
        (row.measured[0], row.wrench[1]) = (1e300, -1e300);
    }
    let doubts = doubts(&arm, &data, &[]);
    assert!(doubts[0].contains("the tool is 1.00e300 m away"), "{doubts:#?}");
    assert!(doubts[1].contains("a load of 1.00e300 N"), "{doubts:#?}");
}

fn translation(row: &Row) -> Vector3<f64> {
    row.measured.fixed_rows::<3>(0).into_owned()
}

#[test]
fn rotations_in_degrees_are_noticed() {
    let arm = kuka();
    let mut data = campaign(&arm, Shape::Payload, POSE, &[]);
    for row in &mut data.rows {
        for k in 3..6 {
            row.measured[k] = row.measured[k].to_degrees();
        }
    }
    only(&doubts(&arm, &data, &[]), &["are they in degrees? write rx[deg]"]);
}

#[test]
fn a_load_that_no_arm_bears_is_noticed() {
    let springs = kuka();
    let mut rigid = springs.clone();
    rigid.joints.iter_mut().for_each(|joint| joint.compliance = 0.0);
    for (arm, words) in [(&springs, "would turn by"), (&rigid, "as stiff as any arm's is, would")] {
        let mut data = campaign(arm, Shape::Payload, POSE, &[]);
        data.rows[7].wrench = Vector6::new(0.0, 0.0, -1e9, 0.0, 0.0, 0.0);
        let line = format!("line {}: a load of 1.00e9 N and 0 N·m", data.rows[7].line);
        only(&doubts(arm, &data, &[]), &[&line, words, "no arm bears it"]);
        // A load is told in the base's axes, wherever the base stands.
        let said = loads(arm, &data, 3.0);
        let turned = Isometry3::new(Vector3::new(1.0, 2.0, 3.0), Vector3::new(1.0, -0.5, 0.3));
        assert_eq!(loads(&Arm { base: turned, ..arm.clone() }, &data, 3.0), said);
        // What an arm of three metres may well carry.
        data.rows[7].wrench[2] = -5e3;
        assert_eq!(doubts(arm, &data, &[]), [""; 0]);
    }
}

#[test]
fn a_forgotten_frame_is_noticed() {
    let arm = kuka();
    let design = design(&arm, Shape::Payload, POSE);
    let noise = Noise { position: 5e-5, rotation: 1e-4 };
    let base = Plant::new(&arm, &[]).unwrap().with_frames(Frames::unknown(5));
    let both = base.measure(&design, noise, 1).unwrap();
    only(&doubts(&arm, &both, &[]), &["rigid motion of", "--nuisance base_frame"]);
    assert_eq!(doubts(&arm, &both, &Nuisance::ALL), [""; 0]);
    let tool = Isometry3::translation(0.0, 0.25, 0.1);
    let mut tooled = arm.clone();
    tooled.tool *= tool;
    let data = campaign(&tooled, Shape::Payload, POSE, &[]);
    let said = doubts(&arm, &data, &[]);
    only(&said, &["a rigid motion of tool frame explains 9", "--nuisance tool_frame"]);
    assert_eq!(doubts(&arm, &data, &[Nuisance::ToolFrame]), [""; 0]);
    // Of another arm's measurements no frame makes sense.
    let mut other = arm.clone();
    other.joints[2].a *= 0.5;
    let data = campaign(&other, Shape::Payload, POSE, &[]);
    assert_eq!(doubts(&arm, &data, &[]), [""; 0]);
}

/// A base that turns about the first axis, and a zero of that joint, are one to a tracker: the zero is the finding.
#[test]
fn a_zero_is_no_frame_that_stands_elsewhere() {
    let arm = kuka();
    for joint in 1..=arm.dof() {
        let zero = format!("joint_offset@joint {joint}=100 mrad");
        let data = campaign(&arm, Shape::Payload, POSE, &[&zero]);
        assert!(frames::displaced(&arm, &data, &[], &[]).is_none(), "{zero}");
    }
    let data = campaign(&arm, Shape::Payload, POSE, &["base_frame:x=100mm,rz=100mrad"]);
    let found = frames::displaced(&arm, &data, &[], &[]).unwrap();
    let [(Nuisance::BaseFrame, moved, turned)] = found.frames[..] else { panic!("{found:?}") };
    // To rounding and noise of 0.05 mm.
    assert!((moved - 0.1).abs() < 2e-4 && (turned - 0.1).abs() < 1e-4, "{found:?}");
}

/// Whatever frames base and tool stand in, angles of a controller are no rotation vector.
#[test]
fn turns_that_say_they_are_rotation_vectors_are_noticed() {
    let arm = kuka();
    let frames = ["base_frame:rz=300mrad,rx=200mrad,x=1mm", "tool_frame:rx=400mrad"];
    let data = campaign(&arm, Shape::Payload, POSE, &frames);
    assert_eq!(orientation::orientations(&arm, &data), None);
    // By hand: Rz(c) Ry(b) Rx(a) has these angles.
    let turned = |row: &mut Row| {
        let vector = row.measured.fixed_rows::<3>(3).into_owned();
        let m = nalgebra::Rotation3::new(vector);
        let turns = [m[(2, 1)].atan2(m[(2, 2)]), (-m[(2, 0)]).asin(), m[(1, 0)].atan2(m[(0, 0)])];
        row.measured.fixed_rows_mut::<3>(3).copy_from_slice(&turns);
    };
    let mut as_turns = data.clone();
    as_turns.rows.iter_mut().for_each(turned);
    let doubt = orientation::orientations(&arm, &as_turns).into_iter().collect::<Vec<_>>();
    only(&doubt, &["read as Rz(rz) Ry(ry) Rx(rx) by", "write `# orientation = "]);
    let mut other = data;
    other.rows.iter_mut().enumerate().for_each(|(k, row)| row.measured[3] += k as f64);
    let doubt = orientation::orientations(&arm, &other).into_iter().collect::<Vec<_>>();
    only(&doubt, &["no order of three turns explains it"]);
}
