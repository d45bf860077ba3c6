//! Named frames and markers: an arm whose tool is there.
//!
//! What lies beyond a frame neither moves it nor bears what loads it. So the arm ends with the frame's link, and
//! what it says by joint is zero for the joints beyond.

use stiffarm_kernels::Output;

use super::chain::frame_rotation;
use super::program::{Block, Program};
use super::readings::Readings;
use super::ways::derive;
use crate::expr::Expr;
use crate::number::Number;
use crate::robot::{Frame, Robot, Value};

/// Derives an output of a place that [`Robot::places`] lists, by itself, for all joints of the arm; `None` of a
/// place that there is not, or that has no numbers.
pub fn derive_at(robot: &Robot, place: &str, output: Output) -> Option<Program> {
    let ending = ending_at(robot, place)?;
    let n = robot.dof();
    let mut program = derive(&ending, &[output]);
    let padded = program.blocks.iter().map(|block| padded(block, ending.dof(), n));
    program.blocks = padded.collect();
    (program.dof, program.readings) = (n, Readings::of(robot));
    Some(program)
}

/// The arm whose tool is at a named frame or a marker, and which ends there.
pub fn ending_at(robot: &Robot, place: &str) -> Option<Robot> {
    let mut ending = robot.clone();
    (ending.frames, ending.markers) = (Vec::new(), Vec::new());
    (ending.outputs, ending.at) = (Vec::new(), Vec::new());
    // A wrench there is no load on the tool.
    (ending.beyond.wrench_scale, ending.beyond.load_point) = Default::default();
    match robot.frames.iter().find(|named| named.name == place) {
        Some(named) => {
            ending.joints.truncate(named.row + 1);
            ending.beyond.truncate(named.row + 1);
            ending.tool = named.frame.clone();
        }
        None => {
            let marker = robot.markers.iter().find(|marker| marker.name == place)?;
            ending.tool.translation = on_tool(&robot.tool, marker.translation.as_ref()?)?;
        }
    }
    Some(ending)
}

/// A point told from the tool, told from the frame that the tool is fixed in.
fn on_tool(tool: &Frame, point: &[Value; 3]) -> Option<[Value; 3]> {
    let axes = frame_rotation(tool);
    let mut sum = [Number::ZERO; 3];
    for row in 0..3 {
        sum[row] = tool.translation[row].number()?;
        for (axis, along) in axes.iter().zip(point) {
            sum[row] = sum[row] + axis[row] * along.number()?;
        }
    }
    Some(sum.map(Value::Number))
}

/// The block of an arm of `from` joints as that of one of `to`.
fn padded(block: &Block, from: usize, to: usize) -> Block {
    let held = &block.held;
    let ((rows, _), (more, columns)) = (held.shape(from), held.shape(to));
    let mut entries = Vec::with_capacity(more * columns);
    for column in block.entries.chunks(rows) {
        entries.extend_from_slice(column);
        entries.resize(entries.len() + more - rows, Expr::ZERO);
    }
    entries.resize(more * columns, Expr::ZERO);
    Block { held: held.clone(), entries }
}
