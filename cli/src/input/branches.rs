//! Every branch of an arm's inverse kinematics, as the kernels of its robot file have it.

use nalgebra::{Isometry3, Vector6};
use stiffarm_codegen::derive::{AnyArm, AnyBranch, Given, any_arm};
use stiffarm_codegen::robot::{ClosedForm, Refused};
use stiffarm_compensate::reach::Target;
use stiffarm_gap::whole::Situation;
use stiffarm_kernels::Pose;

use super::source::Source;
use crate::terminal::failure::Failure;

/// What a branch may miss a pose by to be one that reaches it, m and rad.
pub const WITHIN: f64 = 1e-6;

/// An arm that has a closed form, or is near one that has.
pub struct Branches {
    arm: Box<dyn AnyArm>,
    /// What makes its closed form.
    pub form: ClosedForm,
    /// The base in the world.
    base: Isometry3<f64>,
}

impl Branches {
    /// Those of a robot file, with this given of seven joints where it is chosen ([`give`](stiffarm_codegen::robot::Robot::give)).
    pub fn new(source: &Source, weighs: bool, given: Option<&str>) -> Result<Branches, Failure> {
        let mut robot = source.for_kernels()?;
        if !weighs {
            robot.gravity = Default::default();
        }
        let refused = |Refused { message, help }| Failure::with_help(message, help);
        given.map_or(Ok(()), |given| robot.give(given)).map_err(refused)?;
        let form = robot.nearest_closed_form().map_err(refused)?;
        Ok(Branches { arm: any_arm(&robot, form), form, base: source.arm()?.base })
    }

    /// Those of a robot file that has some.
    pub fn of(source: &Source) -> Option<Branches> {
        Branches::new(source, true, None).ok()
    }

    /// Every branch at a pose, those of the loaded arm where a wrench is given; joints that are free stay at `near`.
    pub fn at(
        &self,
        pose: &Isometry3<f64>,
        near: &[f64],
        (wrench, given): (Option<&Vector6<f64>>, &Given),
    ) -> Vec<AnyBranch> {
        let rotation = pose.rotation.to_rotation_matrix();
        let column = |k: usize| core::array::from_fn(|row| rotation[(row, k)]);
        let rotation = [column(0), column(1), column(2)];
        let pose = Pose { rotation, position: pose.translation.vector.into() };
        // The kernels know the axes of the world in which the base stands, and no others.
        let wrench = wrench.map(|wrench| {
            let turned = |at| self.base.rotation * wrench.fixed_rows::<3>(at);
            let (force, moment) = (turned(0), turned(3));
            [force.x, force.y, force.z, moment.x, moment.y, moment.z]
        });
        self.arm.branches(given, &pose, near, wrench.as_ref())
    }

    /// The branches of a loaded arm that reach a target within the limits; none where any orientation will do.
    pub fn set_points(&self, target: &Target, at: &Situation) -> Vec<Vec<f64>> {
        let Some(rotation) = target.rotation else { return Vec::new() };
        let pose = Isometry3::from_parts(target.position.into(), rotation);
        let sides = at.direction.iter().flatten().map(|side| f64::from(*side)).collect();
        let given = Given { sides, warming: at.warming.unwrap_or_default(), ..Given::default() };
        let found = self.at(&pose, &[], (Some(&at.load), &given)).into_iter();
        // Near enough for the search to end there: what bends beside the joints is of first order here.
        let reached = found.filter(|b| b.within && b.distance <= 1e-2 && b.tilt <= 1e-2);
        reached.map(|branch| branch.q).collect()
    }
}
