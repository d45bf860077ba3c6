//! The other way: what a robot file's table is as a chain of joints that turn about their own z.

use super::angle::roll_pitch_yaw;
use super::chain::{Chain, Step};
use super::masses::Lump;
use crate::robot::space::Frame;
use crate::robot::{self, Angle, Convention, Joint, Robot, Value};

impl Chain {
    /// The chain of a robot whose cells are numbers; `None` if one is a symbol.
    ///
    /// A row of the modified convention is one fixed transform and a joint at its end. Of a standard
    /// row `Tx(a) Rx(alpha) Ry(beta)` stand behind the joint, and before the next.
    pub fn from_robot(robot: &Robot) -> Option<Chain> {
        let mut steps = Vec::new();
        let base = fixed(&robot.base)?;
        let mut end = base;
        for joint in &robot.joints {
            let turn = roll_pitch_yaw([0.0, 0.0, joint.theta.radians()?]);
            let along_z = turn.then(&Frame::moved([0.0, 0.0, number(&joint.d)?]));
            let twist = roll_pitch_yaw([joint.alpha.radians()?, 0.0, 0.0]);
            let tilt = twist.then(&roll_pitch_yaw([0.0, joint.beta.radians()?, 0.0]));
            let length = Frame::moved([number(&joint.a)?, 0.0, 0.0]);
            let com = numbers(&joint.com)?;
            let (before, behind) = match robot.convention {
                Convention::Modified => (tilt.then(&length).then(&along_z), Frame::IDENTITY),
                Convention::Standard => (along_z, length.then(&tilt)),
            };
            let mass = joint.mass.as_ref().map_or(Some(0.0), number)?;
            let tensor = match &joint.inertia {
                Some(entries) => numbers(entries)?,
                None => [0.0; 6],
            };
            let lump = Lump::spread(mass, &behind.then(&Frame::moved(com)), tensor);
            steps.push(step(joint, end.then(&before), lump)?);
            end = behind;
        }
        let tool = fixed(&robot.tool)?;
        // The table tells gravity in the base's axes, the chain in those of the world.
        let turned = Frame { origin: [0.0; 3], ..base };
        Some(Chain {
            name: robot.name.clone(),
            base: "base".to_owned(),
            tip: "tool".to_owned(),
            steps,
            end: end.then(&tool),
            gravity: turned.point(numbers(&robot.gravity)?),
            remarks: Vec::new(),
        })
    }
}

fn fixed(frame: &robot::Frame) -> Option<Frame> {
    Some(Frame {
        origin: numbers(&frame.translation)?,
        ..Frame::by_rotation(angles(&frame.rotation)?)
    })
}

fn step(joint: &Joint, before: Frame, lump: Lump) -> Option<Step> {
    let friction = |value: &Option<Value>| value.as_ref().map_or(Some(0.0), number);
    Some(Step {
        name: joint.name.clone(),
        motion: joint.motion,
        before,
        axis: [0.0, 0.0, 1.0],
        limits: joint.limits,
        lump,
        friction: [friction(&joint.drive.viscous)?, friction(&joint.drive.coulomb)?],
    })
}

fn number(value: &Value) -> Option<f64> {
    value.number().map(crate::number::Number::to_f64)
}

fn numbers<const N: usize>(values: &[Value; N]) -> Option<[f64; N]> {
    let mut found = [0.0; N];
    for (found, value) in found.iter_mut().zip(values) {
        *found = number(value)?;
    }
    Some(found)
}

fn angles([x, y, z]: &[Angle; 3]) -> Option<[f64; 3]> {
    Some([x.radians()?, y.radians()?, z.radians()?])
}
