//! What gives in an arm at rest: the set-point of a joint is where its link stands, less what its spring gives there.

use super::quantity;
use crate::derive::own::{Held, Own, Size};
use crate::derive::program::{Block, Program};
use crate::derive::readings::Readings;
use crate::derive::{outputs, ways};
use crate::robot::{DEFLECTION, GIVES, Robot};

/// What the joints give, and what of the tool's place everything else does, at the posture in which the arm is at rest under
/// a wrench and its weights.
pub fn gives(robot: &Robot) -> Program {
    let way = ways::best(robot, DEFLECTION);
    let mut chain = way.lay_out(robot);
    let [joints, tool] = outputs::gives(&mut chain);
    let springs = "What each joint's spring gives, with its hardening and what friction winds up";
    let rest = "Displacement of the tool by links, bearings and the base, to first order";
    let results = [
        (quantity("joints", "rad", springs.to_owned(), Size::Vector(robot.dof())), joints),
        (quantity("tool", "m, rad", rest.to_owned(), Size::Vector(6)), tool),
    ];
    let blocks =
        results.map(|(quantity, entries)| Block { held: Held::Own(quantity), entries }).to_vec();
    Program {
        graph: chain.g,
        blocks,
        solves: Vec::new(),
        cut: way.cut(),
        dof: robot.dof(),
        readings: Readings::of(robot),
        own: Some(Own {
            name: GIVES.to_owned(),
            sentence: "What gives in the arm under the wrench and its weights, at the posture in which it is at rest"
                .to_owned(),
            inputs: Vec::new(),
            finite: true,
        }),
    }
}
