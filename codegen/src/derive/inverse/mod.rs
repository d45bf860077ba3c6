//! The inverse kinematics in closed form: every branch, by subproblems of one angle each (Paden and Kahan; Elias and
//! Wen), folded with the table's exact zeros.
//!
//! The arm is `T = Z_1 L_1 Z_2 … L_5 Z_6` between the base and the last axis: `Z_i` turns by θ_i about z and moves by d_i
//! along it, `L_i` moves by a_i along x and turns by α_i about it, in both conventions. Each angle is a unit vector
//! (cos θ, sin θ) until it is returned, so that nothing but the returned angles needs an arctangent.
//!
//! Each later angle is worked out from the values that the earlier ones have, roundings and all: an angle that the pose
//! barely determines is wrong alone, and the pose that the angles give is not.

/// A function of the number of joints, for those that a closed form may have.
macro_rules! by_joints {
    ($dof:expr, $of:ident($($given:expr),*)) => {
        match $dof {
            2 => $of::<2>($($given),*),
            3 => $of::<3>($($given),*),
            4 => $of::<4>($($given),*),
            5 => $of::<5>($($given),*),
            7 => $of::<7>($($given),*),
            _ => $of::<6>($($given),*),
        }
    };
}

mod any;
mod displacement;
mod elbow;
mod gives;
mod layout;
mod one_slide;
mod parallel;
mod pieper;
mod plane;
mod point;
mod position;
mod sliding;
mod steps;
mod subproblem;
mod term;
mod wrist;

pub use any::{AnyArm, Branch as AnyBranch, any_arm};
pub use elbow::elbow_angle;
pub use gives::gives;
use layout::{Layout, Value};
pub use steps::{AsItIs, steps};
use term::{Sheet, Term};

use super::own::{Held, Own, OwnInput, Quantity, Size};
use super::program::{Block, Program};
use super::readings::Readings;
use crate::expr::{Expr, Graph, Symbol};
use crate::robot::{
    CLOSED_FORM, ClosedForm, ELBOW_ANGLE, Family, INVERSE_KINEMATICS, Motion, Robot,
};

/// Where the joints of one branch stand, and how far its pose is from what was asked: m, and the length between unit vectors.
struct Branch<'g> {
    joints: Vec<Value<'g>>,
    distance: Term<'g>,
    tilt: Term<'g>,
}

impl<'g> Branch<'g> {
    /// Where joints stand, which miss the target by what they do.
    fn missed(arm: &Layout<'g>, joints: Vec<Value<'g>>) -> Branch<'g> {
        let (distance, tilt) = arm.missed(&joints);
        Branch { joints, distance, tilt }
    }
}

/// A result of a function of the inverse.
fn quantity(name: &str, unit: &str, sentence: String, size: Size) -> Quantity {
    Quantity { name: name.to_owned(), unit: unit.to_owned(), sentence, size }
}

/// The branches of the inverse kinematics, in an order that is stable along a path: shoulder, elbow, wrist as the bits of
/// their number, from the highest. `form` is the arm's [closed form](Robot::closed_form), or that of the
/// [nearest table](Robot::nearest_closed_form): it is then only where the arm's own inverse begins, and called so.
pub fn inverse(robot: &Robot, form: ClosedForm) -> Program {
    let exact = robot.is_as_its_table() && robot.closed_form().is_ok();
    let sheet = Sheet::new(Graph::new());
    let arm = &Layout::new(&sheet, &robot.nearest(form), form);
    let branches: Vec<Branch> = match form.family {
        Family::Wrist { position, behind } => {
            let positions = position::positions(arm, position, behind).into_iter();
            match behind {
                3 => positions.flat_map(|at| wrist::wrists(arm, at)).collect(),
                _ => positions.map(|at| wrist::short(arm, at, behind)).collect(),
            }
        }
        Family::ThreeParallel { behind: 2, .. } => parallel::branches(arm),
        Family::ThreeParallel { before, behind, lift } => {
            plane::branches(arm, before, behind, lift)
        }
        Family::TwoParallel => plane::two(arm),
        Family::ElbowAngle => {
            elbow::branches(arm, sheet.symbol(Symbol::Own { input: 1, entry: 0 }))
        }
        // Its solutions are searched for when the program runs.
        Family::Search { .. } => Vec::new(),
    };
    let (n, count) = (robot.dof(), branches.len());
    let q = branches.iter().flat_map(|branch| arm.joint_values(&branch.joints));
    let q = q.map(|value| value.e).collect();
    let each = Size::Vector(count);
    let distances = branches.iter().map(|branch| branch.distance.e).collect();
    let tilts = branches.iter().map(|branch| branch.tilt.e).collect();
    let slides = robot.joints.iter().any(|joint| joint.motion == Motion::Prismatic);
    let unit = if slides { "rad (prismatic joint: m)" } else { "rad" };
    let reached = "How far the tool's origin is from the target's: zero but for rounding where the branch reaches it";
    let results: [(Quantity, Vec<Expr>); 3] = [
        (quantity("q", unit, bits(form), Size::Matrix { rows: n, columns: count }), q),
        (quantity("distance", "m", reached.to_owned(), each), distances),
        (quantity("tilt", "1", tilt(form), each), tilts),
    ];
    let blocks =
        results.map(|(quantity, entries)| Block { held: Held::Own(quantity), entries }).to_vec();
    Program {
        graph: sheet.graph.into_inner(),
        blocks,
        solves: Vec::new(),
        cut: 0,
        dof: robot.dof(),
        readings: Readings::of(robot),
        own: Some(Own {
            name: if exact { INVERSE_KINEMATICS } else { CLOSED_FORM }.to_owned(),
            sentence: format!(
                "Every branch of the inverse kinematics{}: {}. {}Where the target leaves a joint free, it stays at `q`; \
                 where a branch does not reach the target, it is stretched or folded towards it",
                if exact {
                    ""
                } else {
                    ", as joint values by the nearest table that has a closed form"
                },
                form.sentence(),
                given(form)
            ),
            inputs: inputs(form),
            finite: true,
        }),
    }
}

/// What the inverse is a function of, beside readings.
fn inputs(form: ClosedForm) -> Vec<OwnInput> {
    let input = |name: &str, unit: &str, sentence: &str, size| OwnInput {
        name: name.to_owned(),
        unit: unit.to_owned(),
        sentence: sentence.to_owned(),
        size,
    };
    let pose = "pose of the tool, base axes: its axes x, y, z, its origin";
    let elbow = "angle of the elbow about the line from shoulder to wrist";
    let mut inputs = vec![input("target", "m (axes: 1)", pose, Some(12))];
    inputs.extend(
        (form.family == Family::ElbowAngle).then(|| input(ELBOW_ANGLE, "rad", elbow, None)),
    );
    inputs
}

/// What the numbers of the branches mean.
fn bits(form: ClosedForm) -> String {
    let start = "Joint values, a column for each branch";
    match form.bits()[..] {
        [] => "Joint values, of the one branch".to_owned(),
        [one] => format!("{start}: its number is that of the {one}"),
        [first, second] => {
            format!("{start}: {first} and {second} are the bits of its number, from the highest")
        }
        _ => format!(
            "{start}: shoulder, elbow and wrist are the bits of its number, from the highest"
        ),
    }
}

/// What the tilt of a branch is.
fn tilt(form: ClosedForm) -> String {
    let what = match form.is_of_six() {
        true => "How far the last axis is from the target's, as the length between unit vectors",
        false => {
            "How far the tool's axes are turned from the target's, twice the sine of half the angle"
        }
    };
    format!("{what}: zero but for rounding where the branch reaches it")
}

/// What of `q` every branch keeps.
fn given(form: ClosedForm) -> String {
    match form.given {
        Some(joint) => {
            format!("Joint {} has the value that it has in `q`, in every branch. ", joint + 1)
        }
        None => String::new(),
    }
}
