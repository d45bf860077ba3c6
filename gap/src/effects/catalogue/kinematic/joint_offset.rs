use crate::effects::prelude::*;

/// A constant error of a joint's reading: `q + offset` is true.
#[derive(Clone, Copy, Debug)]
pub struct JointOffset;

const AT_REST: &Facts = &Facts {
    identifier: "joint_offset",
    reality: "The zero of the joint is off.",
    signature: "The same turn of the joint at every load, moment and direction.",
    confused_with: "`base_frame` (joint 1), `tool_frame` (the last joint), and neighbours whose \
        axes are parallel as long as these move little.",
    separated_by: "Poses in which the joint itself and the next one cover their ranges.",
    formula: "q → q + offset",
    parameters: &[Parameter::free("offset", Quantity::Angle).usually(0.02)],
    moves: Moves::Joint,
    idle: "the joint does not move what was measured",
    group: Some(Group::Constant),
    is_geometry: true,
    ..Facts::NONE
};

impl Law for JointOffset {
    fn facts(&self) -> &'static Facts {
        AT_REST
    }
}

impl AtRest for JointOffset {
    fn moves_by(&self, _: &Row, _: &Moment, _: Spot, each: &mut dyn FnMut(f64)) {
        each(1.0);
    }

    fn sentence(&self, told: &Told<'_>) -> String {
        format!("the zero of {} is off by {}", told.place, told.sized(told.first()))
    }
}

/// The zero of a joint is off: the links ask for what they ask at another angle.
#[derive(Clone, Copy, Debug)]
pub struct JointOffsetInMotion;

const TORQUE: &Facts = &Facts {
    identifier: "joint_offset",
    reality: "The zero of the joint is off: its column is not the robot file's angle.",
    signature: "From the joint on all links weigh as at another angle.",
    confused_with: "`gravity_direction`; moments of links, exactly so at a last joint and where the axis is upright.",
    separated_by: "The joints before it, moved far; a mark on the joint.",
    formula: "τ(q) → τ(q + offset)",
    parameters: &[Parameter::free("offset", Quantity::Angle)],
    bends: true,
    is_geometry: true,
    ..Facts::TORQUE
};

impl JointOffsetInMotion {
    /// What the rigid links ask more of all joints, at fine samples.
    fn asks(scene: &LogScene<'_>, joint: usize, offset: f64) -> Vec<Vec<f64>> {
        let none = || vec![0.0; scene.signals.t.len()];
        let less = [none(), none(), vec![-1.0; scene.signals.t.len()]];
        let mut asks = scene.when_moved(joint, offset, &less);
        asks.iter_mut().flatten().for_each(|x| *x *= offset);
        asks
    }
}

impl Law for JointOffsetInMotion {
    fn facts(&self) -> &'static Facts {
        TORQUE
    }
}

impl InMotion for JointOffsetInMotion {
    fn columns(&self, scene: &LogScene<'_>, spot: Spot, values: &[f64]) -> Vec<Column> {
        let mut more = Self::asks(scene, spot.row(), values[0] + SMALL_MOVE);
        if values[0] != 0.0 {
            let is = Self::asks(scene, spot.row(), values[0]);
            more.iter_mut().flatten().zip(is.iter().flatten()).for_each(|(more, is)| *more -= is);
        }
        more.iter_mut().flatten().for_each(|x| *x /= SMALL_MOVE);
        vec![scene.of_all(&more)]
    }

    fn value(&self, scene: &LogScene<'_>, spot: Spot, values: &[f64]) -> Column {
        scene.of_all(&Self::asks(scene, spot.row(), values[0]))
    }

    fn is_of_loads(&self) -> bool {
        true
    }

    fn write(&self, file: &mut RobotFile<'_>, spot: Spot, values: &[f64]) -> Option<String> {
        AtRest::write(&JointOffset, file, spot, values)
    }
}
