//! Effects that move frames and joints, against the textbook's kinematics of an arm whose table or
//! readings are changed by hand. The arm is rigid: all agree to rounding.

use nalgebra::{Isometry3, Rotation3, Translation3, UnitQuaternion, Vector3};
use stiffarm_gap::measurement::Row;
use stiffarm_kernels::generic::Convention;

use crate::arms::{
    EXACT, POSE, frames, isometry, measured, one, plant, reading, rows, same_pose, spatial,
};

const BOTH: [Convention; 2] = [Convention::Standard, Convention::Modified];
const Q: [f64; 5] = [0.7, -0.5, 0.2, 1.1, -0.4];

/// A few roundings of lengths of about a metre.
const ROUNDING: f64 = 1e-14;

fn with(joint: usize, change: f64) -> [f64; 5] {
    let mut q = Q;
    q[joint - 1] += change;
    q
}

fn shifted(x: [f64; 3], r: [f64; 3]) -> Isometry3<f64> {
    Isometry3::new(x.into(), r.into())
}

#[test]
fn readings_are_not_where_the_joints_are() {
    for convention in BOTH {
        let arm = spatial(convention);
        let mut here = reading(&Q, [0.0; 6]);
        here.direction = Some(vec![1, -1, 1, 0, -1]);
        let cases: [(&str, [f64; 5]); 9] = [
            ("joint_offset@joint 2=1mrad", with(2, 1e-3)),
            ("joint_offset@joint 3=1mm", with(3, 1e-3)),
            ("joint_ratio@joint 4=0.1%", with(4, 1e-3 * Q[3])),
            ("backlash@joint 2=0.4mrad", with(2, 0.2e-3)),
            ("backlash@joint 1=0.4mrad", with(1, -0.2e-3)),
            ("backlash@joint 4=0.4mrad", Q),
            ("backlash@joint 3=0.4mm", with(3, -0.2e-3)),
            ("joint_coupling@joint 5:joint 2=1%,joint 4=-2%", with(5, 0.01 * -0.5 - 0.02 * 1.1)),
            (
                "transmission_error@joint 1:cos 2=1mrad,sin 7=-0.5mrad",
                with(1, 1e-3 * (1.4_f64).cos() - 0.5e-3 * (4.9_f64).sin()),
            ),
        ];
        for (text, q) in cases {
            same_pose(&one(&arm, &[text], here.clone()), &arm.pose(&q), ROUNDING);
        }
    }
}

#[test]
fn a_joint_lags_behind_its_last_move() {
    let arm = spatial(Convention::Standard);
    let design = rows(POSE, vec![reading(&with(2, -0.3), [0.0; 6]), reading(&Q, [0.0; 6])]);
    let found = measured(&arm, &["settling_lag@joint 2=1%"], &design);
    same_pose(&found[0], &arm.pose(&with(2, -0.3)), ROUNDING);
    same_pose(&found[1], &arm.pose(&with(2, -0.003)), ROUNDING);
}

#[test]
fn a_joint_turns_as_it_warms_up() {
    let arm = spatial(Convention::Standard);
    let warm = |by: f64| Row { temperature: Some(21.0 + by), ..reading(&Q, [0.0; 6]) };
    let design = rows(POSE, vec![warm(0.0), warm(8.0)]);
    let truths = ["joint_warming@joint 2=20 urad/K", "joint_warming@joint 3=-5 um/K"];
    let found = measured(&arm, &truths, &design);
    same_pose(&found[0], &arm.pose(&Q), ROUNDING);
    let mut q = with(2, 1.6e-4);
    q[2] -= 4e-5;
    same_pose(&found[1], &arm.pose(&q), ROUNDING);
}

/// Every joint follows a cubic, on which the plant's readings between the rows lie.
#[test]
fn what_is_measured_is_older_than_its_reading() {
    let arm = spatial(Convention::Standard);
    let at = |t: f64| Q.map(|q| q + (0.2 + 0.1 * q) * t - 0.3 * t * t + 0.1 * q * t.powi(3));
    let row = |k: i32| {
        let time = 0.08 * f64::from(k);
        Row { time: Some(time), ..reading(&at(time), [0.0; 6]) }
    };
    let design = rows(POSE, (0..20).map(row).collect());
    for delay in [0.05, 0.2, -0.11] {
        let found = measured(&arm, &[&format!("latency={delay}")], &design);
        for (k, found) in found.iter().enumerate().take(16).skip(4) {
            same_pose(found, &arm.pose(&at(0.08 * k as f64 - delay)), 10.0 * ROUNDING);
        }
    }
    // Poses at rest have no delay.
    let rested = rows(POSE, [0, 500].map(row).to_vec());
    let found = measured(&arm, &["latency=0.2"], &rested);
    assert_eq!(found, measured(&arm, &[], &rested));
}

/// An axis of the table is tilted by as much as it wobbles there: about x by `alpha` of a modified row.
#[test]
fn an_axis_wobbles_twice_in_a_turn() {
    let arm = spatial(Convention::Modified);
    let (sine, cosine) = (2.0 * Q[1]).sin_cos();
    let tilt = 1e-3 * cosine - 2e-3 * sine;
    let mut changed = arm.clone();
    // Rx(alpha) Tx(a) is Tx(a) Rx(alpha): the tilt stands behind both.
    changed.joints[1].alpha += tilt;
    let found =
        one(&arm, &["bearing_wobble@joint 2:cos_x=1mrad,sin_x=-2mrad"], reading(&Q, [0.0; 6]));
    same_pose(&found, &changed.pose(&Q), ROUNDING);
    // About y: what is behind the joint turns about the joint's own y.
    let text = "bearing_wobble@joint 1:cos_y=1mrad,sin_y=2mrad";
    let arm = spatial(Convention::Standard);
    let found = one(&arm, &[text], reading(&Q, [0.0; 6]));
    let (sine, cosine) = (2.0 * Q[0]).sin_cos();
    let turn = shifted([0.0; 3], [0.0, 1e-3 * cosine + 2e-3 * sine, 0.0]);
    same_pose(&found, &(turn * arm.pose(&Q)), ROUNDING);
}

#[test]
fn rows_of_the_table_are_off() {
    for convention in BOTH {
        let arm = spatial(convention);
        let mut changed = arm.clone();
        changed.joints[0].d += 1e-3;
        changed.joints[0].a -= 2e-3;
        changed.joints[0].alpha += 3e-3;
        let text = "link_geometry@link 1:d=1mm,a=-2mm,alpha=3mrad";
        let found = one(&arm, &[text], reading(&Q, [0.0; 6]));
        same_pose(&found, &changed.pose(&Q), ROUNDING);
        // Between parallel axes a tilt takes the place of d.
        let mut changed = arm.clone();
        changed.joints[1].a -= 2e-3;
        changed.joints[1].alpha += 3e-3;
        changed.joints[1].beta -= 4e-3;
        let text = "link_geometry@link 2:a=-2mm,alpha=3mrad,beta=-4mrad";
        let found = one(&arm, &[text], reading(&Q, [0.0; 6]));
        same_pose(&found, &changed.pose(&Q), ROUNDING);
        let mut changed = arm.clone();
        changed.joints[2].theta += 1e-3;
        changed.joints[2].a -= 2e-3;
        let text = "link_geometry@link 3:theta=1mrad,a=-2mm";
        let found = one(&arm, &[text], reading(&Q, [0.0; 6]));
        same_pose(&found, &changed.pose(&Q), ROUNDING);
    }
}

/// The arm up to row 2, Hayati's turn, and the rest of the arm.
#[test]
fn parallel_axes_have_a_fifth_number() {
    let tilt = Isometry3::from_parts(
        Translation3::identity(),
        UnitQuaternion::from_axis_angle(&Vector3::y_axis(), 2e-3),
    );
    for convention in BOTH {
        let arm = spatial(convention);
        let truth = "link_geometry@link 2:beta=2mrad";
        let found = one(&arm, &[truth], reading(&Q, [0.0; 6]));
        let mut near = arm.clone();
        near.tool = Isometry3::identity();
        let mut far = arm.clone();
        let split = if convention == Convention::Standard { 2 } else { 1 };
        near.joints.truncate(split);
        far.joints.drain(..split);
        // Alpha of row 2 is 0, so that what comes directly after Rx(alpha) begins the row.
        let expected = near.pose(&Q[..split]) * tilt * far.pose(&Q[split..]);
        same_pose(&found, &expected, ROUNDING);
    }
}

#[test]
fn frames_stand_elsewhere() {
    let arm = spatial(Convention::Modified);
    let pose = arm.pose(&Q);
    let text = "x=1mm,y=-2mm,z=3mm,rx=1mrad,ry=2mrad,rz=-3mrad";
    let small = shifted([1e-3, -2e-3, 3e-3], [1e-3, 2e-3, -3e-3]);
    let at = reading(&Q, [0.0; 6]);
    let base = one(&arm, &[&format!("base_frame@base:{text}")], at.clone());
    same_pose(&base, &(small * pose), ROUNDING);
    let tool = one(&arm, &[&format!("tool_frame@tool:{text}")], at.clone());
    same_pose(&tool, &(pose * small), ROUNDING);
    let (far, other) = (shifted([5.0, -2.0, 1.0], [0.4, 1.0, -2.0]), shifted([0.1; 3], [0.7; 3]));
    let unknown = plant(&arm, &[]).with_frames(frames(far, other));
    let data = unknown.measure(&rows(POSE, vec![at.clone()]), EXACT, 0).unwrap();
    same_pose(&data.rows[0].measured, &(far * pose * other), 10.0 * ROUNDING);
    let mut marked = at;
    marked.offset = Some([0.1, 0.2, -0.1]);
    let found = one(&arm, &[], marked);
    same_pose(&found, &(pose * Translation3::new(0.1, 0.2, -0.1)), ROUNDING);
}

#[test]
fn frames_jump_and_creep() {
    let arm = spatial(Convention::Standard);
    let pose = arm.pose(&Q);
    let timed = |k: usize| {
        let mut row = reading(&Q, [0.0; 6]);
        row.time = Some(100.0 + 20.0 * k as f64);
        row
    };
    let design = rows(POSE, (0..4).map(timed).collect());
    let slip = shifted([0.3e-3, 0.0, 0.0], [0.0, 0.0, 1e-3]);
    let base = measured(&arm, &["slip@base:after=2,x=0.3mm,rz=1mrad"], &design);
    let tool = measured(&arm, &["slip@tool:after=2,x=0.3mm,rz=1mrad"], &design);
    let drift = measured(&arm, &["drift:y=1um/s,rx=2urad/s"], &design);
    for k in 0..4 {
        let jump = if k >= 2 { slip } else { Isometry3::identity() };
        same_pose(&base[k], &(jump * pose), ROUNDING);
        same_pose(&tool[k], &(pose * jump), ROUNDING);
        let seconds = 20.0 * k as f64;
        let crept = shifted([0.0, 1e-6 * seconds, 0.0], [2e-6 * seconds, 0.0, 0.0]);
        same_pose(&drift[k], &(crept * pose), ROUNDING);
    }
    // Without time, rows are counted.
    let untimed = rows(POSE, vec![reading(&Q, [0.0; 6]); 3]);
    let drift = measured(&arm, &["drift:y=1um/row"], &untimed);
    same_pose(&drift[2], &(shifted([0.0, 2e-6, 0.0], [0.0; 3]) * pose), ROUNDING);
}

#[test]
fn lengths_grow_and_scales_are_off() {
    for convention in BOTH {
        let arm = spatial(convention);
        let mut grown = arm.clone();
        let factor = 1.0 + 12e-6 * 10.0;
        for joint in &mut grown.joints {
            joint.a *= factor;
            joint.d *= factor;
        }
        grown.tool.translation.vector *= factor;
        let mut q = Q;
        q[2] *= factor;
        let warm = |temperature: f64| {
            let mut row = reading(&Q, [0.0; 6]);
            row.temperature = Some(temperature);
            row
        };
        let design = rows(POSE, vec![warm(21.0), warm(31.0)]);
        let found = measured(&arm, &["thermal_growth=12ppm/K"], &design);
        same_pose(&found[0], &arm.pose(&Q), ROUNDING);
        same_pose(&found[1], &grown.pose(&q), ROUNDING);
        // A target on the tool that nobody knows grows with it.
        let mount = Isometry3::translation(0.05, -0.08, 0.03);
        grown.tool = arm.tool * mount;
        grown.tool.translation.vector *= factor;
        let plant = plant(&arm, &["thermal_growth=12ppm/K"]);
        let mounted = plant.with_frames(frames(Isometry3::identity(), mount));
        let found = mounted.measure(&design, EXACT, 0).unwrap();
        same_pose(&found.rows[1].measured, &grown.pose(&q), ROUNDING);
        let scaled = one(&arm, &["instrument_scale=50ppm"], reading(&Q, [0.0; 6]));
        let mut expected = arm.pose(&Q);
        expected.translation.vector *= 1.0 + 50e-6;
        same_pose(&scaled, &expected, ROUNDING);
    }
}

/// Two truths at once are both there, whichever is named first.
#[test]
fn truths_act_together() {
    let arm = spatial(Convention::Standard);
    let both = ["joint_offset@joint 1=1mrad", "tool_frame:z=1mm"];
    let turned = [both[1], both[0]];
    let at = reading(&Q, [0.0; 6]);
    assert_eq!(one(&arm, &both, at.clone()), one(&arm, &turned, at.clone()));
    let expected = arm.pose(&with(1, 1e-3)) * Translation3::new(0.0, 0.0, 1e-3);
    same_pose(&one(&arm, &both, at), &expected, ROUNDING);
    let turn = isometry(&one(&arm, &both, reading(&[0.0; 5], [0.0; 6])));
    assert!(Rotation3::from(turn.rotation).angle() > 0.1);
}
