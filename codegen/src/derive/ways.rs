//! The way in which a set of outputs costs least: in which frame of the chain it is worked out, and
//! whether twists are worked out run by run.

use stiffarm_kernels::Output;

use super::chain::{Chain, lay_out};
use super::outputs::derived;
use super::passes::Passes;
use super::program::{Block, Program};
use super::readings::Readings;
use crate::robot::Robot;

/// More joints than this, and only a few working frames are tried.
const EXHAUSTIVE: usize = 8;

/// Derives `outputs` in the way in which they cost least.
pub fn derive(robot: &Robot, outputs: &[Output]) -> Program {
    derive_with(robot, outputs, Passes::ALL)
}

/// The same with some of the passes switched off.
pub fn derive_with(robot: &Robot, outputs: &[Output], passes: Passes) -> Program {
    let way = best_ways(robot, &[outputs], passes)[0];
    derive_by(robot, outputs, way)
}

/// Derives each of several sets of outputs in the way in which it costs least.
pub fn derive_each(robot: &Robot, sets: &[Vec<Output>]) -> Vec<Program> {
    let slices: Vec<&[Output]> = sets.iter().map(Vec::as_slice).collect();
    let ways = best_ways(robot, &slices, Passes::ALL);
    sets.iter().zip(ways).map(|(outputs, way)| derive_by(robot, outputs, way)).collect()
}

/// Derives `outputs` with the working frame at boundary `cut`, twists from the axes of the frames.
pub fn derive_in(robot: &Robot, outputs: &[Output], cut: usize) -> Program {
    derive_by(robot, outputs, Way { cut, passes: Passes { runs: false, ..Passes::ALL } })
}

/// One way to work things out: in which frame, and twists run by run or not.
#[derive(Clone, Copy)]
struct Way {
    cut: usize,
    passes: Passes,
}

/// The cheapest way for each set: every frame is laid out once, with all outputs in it; run by run only
/// those that are then the cheapest of some set.
fn best_ways(robot: &Robot, sets: &[&[Output]], passes: Passes) -> Vec<Way> {
    let cuts = if passes.frame { Chain::cuts(robot) } else { vec![0] };
    let stride = if robot.dof() <= EXHAUSTIVE { 1 } else { cuts.len().div_ceil(4) };
    let plain = Passes { runs: false, ..passes };
    let mut best = vec![(u32::MAX, Way { cut: 0, passes: plain }); sets.len()];
    for cut in cuts.into_iter().step_by(stride) {
        try_way(robot, sets, Way { cut, passes: plain }, &mut best);
    }
    if passes.runs {
        let mut cuts: Vec<usize> = best.iter().map(|(_, way)| way.cut).collect();
        cuts.sort_unstable();
        cuts.dedup();
        for cut in cuts {
            try_way(robot, sets, Way { cut, passes }, &mut best);
        }
    }
    best.into_iter().map(|(_, way)| way).collect()
}

/// Takes a way for the sets that cost less in it. The first of equals stays: the frame nearest the base.
/// Run by run is for the sets whose frame it is already, so that a set's way does not depend on the
/// other sets.
fn try_way(robot: &Robot, sets: &[&[Output]], way: Way, best: &mut [(u32, Way)]) {
    let mut wanted: Vec<Output> = sets.iter().flat_map(|set| set.iter().copied()).collect();
    wanted.sort_unstable();
    wanted.dedup();
    let laid_out = derive_by(robot, &wanted, way);
    let free = laid_out.graph.parameter_only();
    for (set, best) in sets.iter().zip(best) {
        let cost = laid_out.graph.count_without(&free, &laid_out.roots_of(set)).cost();
        if cost < best.0 && (!way.passes.runs || way.cut == best.1.cut) {
            *best = (cost, way);
        }
    }
}

fn derive_by(robot: &Robot, outputs: &[Output], Way { cut, passes }: Way) -> Program {
    let mut chain = lay_out(robot, cut, passes);
    let mut solves = Vec::new();
    let mut blocks = Vec::new();
    for &output in outputs {
        let derived = derived(&mut chain, output);
        solves.extend(derived.solve);
        blocks.push(Block { output, entries: derived.entries });
    }
    let readings = Readings::of(robot);
    Program { graph: chain.g, blocks, solves, cut, dof: robot.dof(), readings }
}
