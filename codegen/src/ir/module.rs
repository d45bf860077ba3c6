//! All that is generated of a robot, for whichever language.

use stiffarm_kernels::Output;

use super::constants::Constants;
use super::function::Function;
use super::posture::{Plain, Posture};
use super::readings::Readings;
use crate::derive::{Program, derive_at, derive_each, elbow_angle, gives, inverse};
use crate::robot::{Family, Robot};

/// The functions of a robot and what they share.
pub(crate) struct Module<'r> {
    pub robot: &'r Robot,
    /// What stands between readings and joint values.
    pub readings: Readings,
    /// What of the joint values the functions need.
    pub posture: Posture,
    /// What of the symbolic parameters they need.
    pub constants: Constants,
    /// The tool's functions and one's own, then those of each place at which some are asked for.
    pub groups: Vec<Group>,
}

/// Functions of the tool, or of a frame or marker by its name.
pub(crate) struct Group {
    pub place: Option<String>,
    /// The outputs that have a function of their own.
    pub outputs: Vec<Output>,
    pub functions: Vec<Function>,
}

impl<'r> Module<'r> {
    /// The arm's outputs as it asks for them, and functions of one's own; `fused` are products taken into sums.
    pub fn new(robot: &'r Robot, own: &[&Program], fused: bool) -> Self {
        let outputs = robot.generated();
        let programs = derive_each(robot, &sets(&outputs)).into_iter();
        let form = robot.inverse_kinematics.filter(|form| !form.is_search());
        let inverse = form.map(|form| inverse(robot, form));
        let elbow = form.filter(|form| form.family == Family::ElbowAngle);
        let elbow = elbow.map(|form| elbow_angle(robot, form));
        let gives = robot.has_set_points().then(|| gives(robot));
        let own = own.iter().map(|program| (*program).clone());
        let programs = programs.chain(inverse).chain(elbow).chain(gives).chain(own).collect();
        let tool: (_, _, Vec<Program>) = (None, outputs, programs);
        let places = robot.places().into_iter().map(|(place, outputs)| {
            let at = |output: &Output| derive_at(robot, place, *output);
            let programs = outputs.iter().filter_map(at).collect();
            (Some(place.to_owned()), outputs, programs)
        });
        let (mut constants, mut posture) = (Constants::default(), Posture::default());
        let groups = core::iter::once(tool).chain(places).map(|(place, outputs, programs)| {
            let functions = programs.into_iter().map(|program| {
                let mut function = Function::new(program, &mut constants, fused);
                let (angles, plain) = (&function.angles, &function.plain);
                (function.posture, function.reads) = posture.admit(angles, plain);
                function.place.clone_from(&place);
                function
            });
            let functions = functions.collect();
            Group { place, outputs, functions }
        });
        let groups = groups.collect();
        if posture.fields().is_empty() {
            // Of an arm that no joint value enters: a struct of numbers has to hold one.
            posture.admit_plain(Plain::Joint(0));
        }
        Module { robot, readings: Readings::of(robot), posture, constants, groups }
    }

    /// Every function, the tool's first.
    pub fn functions(&self) -> impl Iterator<Item = &Function> {
        self.groups.iter().flat_map(|group| &group.functions)
    }

    /// Whether the table has symbolic parameters.
    pub fn is_symbolic(&self) -> bool {
        !self.robot.symbols().is_empty()
    }
}

/// What the functions of a module compute: each of `outputs` by itself, and `all` what can be had together.
fn sets(outputs: &[Output]) -> Vec<Vec<Output>> {
    let together: Vec<Output> = outputs.iter().copied().filter(|o| o.is_fused()).collect();
    let singles = outputs.iter().map(|output| vec![*output]);
    singles.chain((together.len() > 1).then_some(together)).collect()
}
