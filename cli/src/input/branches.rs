//! Every branch of an arm's inverse kinematics, as the kernels of its robot file have it.

use nalgebra::{Isometry3, Vector6};
use stiffarm_codegen::derive::{AsItIs, Given};
use stiffarm_codegen::robot::Refused;
use stiffarm_gap::compensate::reach::Target;
use stiffarm_gap::whole::Situation;
use stiffarm_kernels::{Pose, Solution, Solutions};

use super::source::Source;
use crate::terminal::failure::Failure;

/// What a branch may miss a pose by to be one that reaches it, m and rad.
pub const WITHIN: f64 = 1e-6;

/// An arm that has a closed form, or is near one that has.
pub struct Branches {
    arm: AsItIs,
    /// Limits of the joints, rad.
    pub limits: [Option<[f64; 2]>; 6],
    /// The base in the world.
    base: Isometry3<f64>,
}

impl Branches {
    /// Those of a robot file.
    ///
    /// # Errors
    /// [`Failure`]: an effect of which no kernel can be made, or no closed form near the table.
    pub fn new(source: &Source, weighs: bool) -> Result<Branches, Failure> {
        let mut robot = source.for_kernels()?;
        if !weighs {
            robot.gravity = Default::default();
        }
        let refused = |Refused { message, help }| Failure::with_help(message, help);
        let form = robot.nearest_closed_form().map_err(refused)?;
        let limits =
            core::array::from_fn(|joint| robot.joints.get(joint).and_then(|joint| joint.limits));
        let base = source.arm()?.base;
        Ok(Branches { arm: AsItIs::new(&robot, form, Given::default()), limits, base })
    }

    /// Those of a robot file that has some.
    pub fn of(source: &Source) -> Option<Branches> {
        Branches::new(source, true).ok()
    }

    /// Every branch at a pose, those of the loaded arm where a wrench is given; joints that are free stay at `near`.
    pub fn at(
        &self,
        pose: &Isometry3<f64>,
        near: &[f64; 6],
        (wrench, given): (Option<&Vector6<f64>>, &Given),
    ) -> Solutions<f64, 6, 8> {
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
        self.arm.with(given).solutions(&pose, near, wrench.as_ref())
    }

    /// The branches of a loaded arm that reach a target within the limits; none where any orientation will do.
    pub fn set_points(&self, target: &Target, at: &Situation) -> Vec<Vec<f64>> {
        let Some(rotation) = target.rotation else { return Vec::new() };
        let pose = Isometry3::from_parts(target.position.into(), rotation);
        let sides = at.direction.iter().flatten().map(|side| f64::from(*side)).collect();
        let given = Given { sides, warming: at.warming.unwrap_or_default() };
        let near = [0.0; 6];
        let found = self.at(&pose, &near, (Some(&at.load), &given));
        // Near enough for the search to end there: what bends beside the joints is of first order here.
        let reached = found.reached(1e-2, 1e-2);
        let within = |branch: Solution<f64, 6>| branch.turned(&near, &self.limits);
        reached.filter_map(within).map(|branch| branch.q.to_vec()).collect()
    }
}
