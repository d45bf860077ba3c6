//! What arms of fewer than six joints do at poses that they cannot have.

use nalgebra::{UnitQuaternion, Vector3};
use stiffarm_codegen::robot::{Angle, Convention, Family, Value};
use stiffarm_draws::Draws;

use super::arms::{Arm, OTHERS, random};

/// The tool on the last axis, at a distance from the last frame.
fn on_axis(arm: &Arm) -> Arm {
    let mut robot = arm.robot.clone();
    let [_, _, z] = &arm.robot.tool.translation;
    robot.tool.translation = [Value::ZERO, Value::ZERO, z.clone()];
    if let (Convention::Standard, Some(last)) = (robot.convention, robot.joints.last_mut()) {
        (last.a, last.alpha) = (Value::ZERO, Angle::ZERO);
    }
    Arm::new(&robot)
}

/// Fewer joints than six bring the tool's origin to a pose that they cannot have, and as much of its orientation as they can: a
/// turn about any axis is missed by no more than it is.
#[test]
fn positions_come_first() {
    let mut draws = Draws::new(6);
    for family in OTHERS {
        let arm = random(family, &mut draws);
        let arm = match arm.form.family {
            Family::Wrist { behind: 0, .. } | Family::ThreeParallel { behind: 0, .. } => arm,
            Family::Wrist { behind: 1, .. } | Family::ThreeParallel { behind: 1, .. } => {
                on_axis(&arm)
            }
            _ => continue,
        };
        let plane = arm.robot.dof() == 3
            && matches!(arm.form.family, Family::ThreeParallel { before: false, .. })
            || family.0 == "three parallel, the last a roll";
        let (mut met, mut near) = (0, 0);
        for _ in 0..200 {
            let q = arm.posture(&mut draws);
            let mut pose = arm.pose(&q);
            let turn = 0.02;
            let by = Vector3::from(draws.array::<3>(-1.0, 1.0)).normalize() * turn;
            pose.rotation = UnitQuaternion::from_scaled_axis(by) * pose.rotation;
            let branches = arm.branches(&pose, &q);
            let nearest = branches.iter().min_by(|a, b| a.tilt.total_cmp(&b.tilt));
            let nearest = nearest.expect("a branch");
            met += usize::from(nearest.distance < 1e-9);
            near += usize::from(nearest.tilt < 1.5 * turn);
        }
        // The others are at the end of their reach. Of a plane's arms the roll lifts the tool.
        println!("{}: {met} met, {near} near of 200", family.0);
        assert!(plane || met > 160, "{}: {met}", family.0);
        assert!(near > 120, "{}: {near}", family.0);
    }
}
