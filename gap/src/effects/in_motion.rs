//! How an effect acts on an arm in motion.

use stiffarm_kernels::generic::{Arm, Drive};

use super::{Law, Parameter, RobotFile, Spot};
use crate::log::TorqueSide;
use crate::log::pace::Pace;
use crate::log::scene::{Column, Domain, Scene};

/// What a link carries beyond what is known of it.
pub struct Carried {
    /// The link, from 0.
    pub link: usize,
    /// The run in which it does; `None` is all.
    pub run: Option<usize>,
    /// Ten numbers of the link, in its frame, per unit of each of the effect's.
    pub numbers: Vec<[f64; 10]>,
}

/// An effect of reality on a moving arm: what it changes of a log's rows.
pub trait InMotion: Law {
    /// Its parameters; all zero is no effect. Currents stand in place of torques where they drive.
    fn parameters(&self) -> &'static [Parameter] {
        self.facts().parameters
    }

    /// The parameter that a robot file's key is a multiple of, and how many times.
    fn number(&self, key: &str) -> Option<(&'static Parameter, f64)> {
        self.parameters().iter().find(|parameter| parameter.key == key).map(|it| (it, 1.0))
    }

    /// Its change of the rows per unit of each parameter, where they have these values.
    fn columns(&self, scene: &Scene<'_>, spot: Spot, values: &[f64]) -> Vec<Column>;

    /// The rows that it is seen in.
    fn domain(&self) -> Domain {
        self.facts().rows.unwrap_or(Domain::Torque)
    }

    /// Where on this arm it may act.
    fn spots(&self, scene: &Scene<'_>) -> Vec<Spot> {
        self.facts().at.places(scene.arm).into_iter().map(Spot::at).collect()
    }

    /// Its change of the rows where they have these values, if that is not in proportion to them: it
    /// [`InMotion::bends`].
    fn value(&self, _: &Scene<'_>, _: Spot, _: &[f64]) -> Column {
        Column::default()
    }

    /// Whether its change of the rows is not in proportion to its parameters.
    fn bends(&self) -> bool {
        self.facts().bends
    }

    /// Values about which its own are sought.
    fn probes(&self, _: &Scene<'_>, _: Spot) -> Vec<Vec<f64>> {
        vec![vec![0.0; self.parameters().len()]]
    }

    /// What it changes of the rigid links' numbers, if that is all that it does: it has no columns of its
    /// own then.
    fn carried(&self, _: &Arm, _: Spot) -> Option<Carried> {
        None
    }

    /// Whether a thing of this kind may have such values, those of the robot file among them.
    fn is_feasible(&self, values: &[f64]) -> bool {
        self.parameters().iter().zip(values).all(|(parameter, value)| *value >= parameter.least)
    }

    /// Whether its columns are made of what rigid links ask: with better links they are others.
    fn is_of_loads(&self) -> bool {
        false
    }

    /// The effect that must stand at the same place before: what this one adds to.
    fn beside(&self) -> Option<&'static str> {
        self.facts().beside
    }

    /// Effects that each of its joints has of its own on any such arm, large or small: they stand beside it even
    /// where the log does not tell them from zero, and it does not take their part.
    fn along(&self) -> &'static [&'static str] {
        &[]
    }

    /// What the robot file's table has of its first parameter at a spot, where that is in torques of this side: its own
    /// is beyond that, and their sum is what [`InMotion::is_feasible`] is asked of.
    fn file_value(&self, _: &Arm, _: Option<TorqueSide>, _: Spot) -> f64 {
        0.0
    }

    /// Whether the robot file has it at a spot, and it is in the torques: what adds to it may be there.
    fn in_file(&self, scene: &Scene<'_>, spot: Spot) -> bool {
        self.file_value(scene.arm, scene.side, spot) > 0.0
    }

    /// Why this log cannot show it; `None` if it may.
    fn excluded(&self, _: &Scene<'_>) -> Option<String> {
        None
    }

    /// Why a log is too slow for it at a spot, where these values are `found`; `None` if it is not.
    fn too_slow(&self, _: &Pace<'_>, _: Spot, _found: Option<&[f64]>) -> Option<String> {
        None
    }

    /// Adds its values at a spot to the file's own entries, and names them; `None` if these hold no such
    /// thing: it stands in an `[[effect]]` table then. Torques only: currents have no entries.
    fn write(&self, _: &mut RobotFile<'_>, _: Spot, _: &[f64]) -> Option<String> {
        None
    }
}

/// What a row's drive has of something, where it is in torques of this side.
pub fn of_drive(
    arm: &Arm,
    side: Option<TorqueSide>,
    spot: Spot,
    of: impl Fn(&Drive) -> f64,
) -> f64 {
    if side.is_some_and(TorqueSide::is_driven) { of(&arm.joints[spot.row()].drive) } else { 0.0 }
}

/// Why a motor's own cannot be seen; `None` where the torque is the motor's.
pub fn behind_the_gear(scene: &Scene<'_>) -> Option<String> {
    let link = scene.side == Some(TorqueSide::Link);
    link.then(|| "the torque is measured behind the gear, where no motor is felt".to_owned())
}

/// Why nothing can be told by the robot file's masses; `None` where it has some and torques are N·m.
pub fn weightless(scene: &Scene<'_>) -> Option<String> {
    if scene.arm.joints.iter().all(|joint| joint.mass == 0.0) {
        return Some("the robot file has no mass: give its rows `mass` and `com`".to_owned());
    }
    (scene.side == Some(TorqueSide::Current))
        .then(|| "a current tells no weight: its newton-metres per ampere are unknown".to_owned())
}
