//! The way in which a set of outputs costs least: in which frame of the chain it is worked out, and
//! whether twists are worked out run by run.

use stiffarm_kernels::Output;

use super::chain::{Chain, lay_out};
use super::outputs::derived;
use super::own::Held;
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

/// The way in which an output costs least.
pub(super) fn best(robot: &Robot, output: Output) -> Way {
    best_ways(robot, &[&[output]], Passes::ALL)[0]
}

/// Derives each of several sets of outputs in the way in which it costs least.
pub fn derive_each(robot: &Robot, sets: &[Vec<Output>]) -> Vec<Program> {
    let slices: Vec<&[Output]> = sets.iter().map(Vec::as_slice).collect();
    let ways = best_ways(robot, &slices, Passes::ALL);
    sets.iter().zip(ways).map(|(outputs, way)| derive_by(robot, outputs, way)).collect()
}

/// Derives `outputs` with the working frame at boundary `cut`, twists from the axes of the frames.
pub fn derive_in(robot: &Robot, outputs: &[Output], cut: usize) -> Program {
    derive_by(robot, outputs, Way { cut, ..Way::PLAIN })
}

/// One way to work things out: in which frame, and twists run by run or not.
#[derive(Clone, Copy)]
pub(crate) struct Way {
    cut: usize,
    passes: Passes,
}

impl Way {
    /// In base axes, twists from the axes of the frames, derivatives of torques from their graph.
    pub const PLAIN: Way =
        Way { cut: 0, passes: Passes { runs: false, bodies: false, ..Passes::ALL } };

    /// The same with derivatives of torques in closed form.
    pub fn by_bodies(self) -> Way {
        Way { passes: Passes { bodies: true, ..self.passes }, ..self }
    }

    /// Boundary of the working frame.
    pub fn cut(self) -> usize {
        self.cut
    }

    /// The arm laid out in this way.
    pub fn lay_out(self, robot: &Robot) -> Chain<'_> {
        lay_out(robot, self.cut, self.passes)
    }
}

/// The cheapest way for each set.
fn best_ways(robot: &Robot, sets: &[&[Output]], passes: Passes) -> Vec<Way> {
    let mut ways = best_frames(robot, sets, passes);
    for (set, way) in sets.iter().zip(&mut ways) {
        let by_motion = |output: &Output| output.is_of_motion() && output.is_on_request();
        let cost = |way| derive_by(robot, set, way).ops().cost();
        if passes.bodies && set.iter().any(by_motion) && cost(way.by_bodies()) < cost(*way) {
            *way = way.by_bodies();
        }
    }
    ways
}

/// The frame in which each set costs least: every one is laid out once, with all outputs in it. A long derivative is
/// worked out where what is differentiated costs least.
fn best_frames(robot: &Robot, sets: &[&[Output]], passes: Passes) -> Vec<Way> {
    let like = |set: &&[Output]| set.iter().map(|output| output.worked_out_like()).collect();
    let sets: Vec<Vec<Output>> = sets.iter().map(like).collect();
    // What every link has worked out in its own axes costs the same wherever the chain is laid out from.
    let own: Vec<bool> =
        sets.iter().map(|set| set.iter().all(|output| output.is_of_motion())).collect();
    let framed = sets.iter().zip(&own).filter(|(_, own)| !**own);
    let mut wanted: Vec<Output> = framed.flat_map(|(set, _)| set.iter().copied()).collect();
    wanted.sort_unstable();
    wanted.dedup();
    if wanted.is_empty() {
        return vec![Way::PLAIN; sets.len()];
    }
    cheapest(robot, sets.len(), passes, |way| {
        let laid_out = derive_by(robot, &wanted, way);
        let free = laid_out.graph.parameter_only();
        let cost = |(set, own): (&Vec<Output>, &bool)| match own {
            true => 0,
            false => laid_out.graph.count_without(&free, &laid_out.roots_of(set)).cost(),
        };
        sets.iter().zip(&own).map(cost).collect()
    })
}

/// The cheapest way for each of `sets` functions, whose `costs` are asked for all of them way by way: every frame,
/// and run by run only those that are then the cheapest of some function.
pub(crate) fn cheapest(
    robot: &Robot,
    sets: usize,
    passes: Passes,
    costs: impl Fn(Way) -> Vec<u32>,
) -> Vec<Way> {
    let cuts = if passes.frame { Chain::cuts(robot) } else { vec![0] };
    let stride = if robot.dof() <= EXHAUSTIVE { 1 } else { cuts.len().div_ceil(4) };
    let passes = Passes { bodies: false, ..passes };
    let plain = Passes { runs: false, ..passes };
    let mut best = vec![(u32::MAX, Way { cut: 0, passes: plain }); sets];
    // The first of equals stays: the frame nearest the base. Run by run is for the functions whose frame it is
    // already, so that a function's way does not depend on the others.
    let attempt = |best: &mut [(u32, Way)], way: Way| {
        for (best, cost) in best.iter_mut().zip(costs(way)) {
            if cost < best.0 && (!way.passes.runs || way.cut == best.1.cut) {
                *best = (cost, way);
            }
        }
    };
    cuts.into_iter().step_by(stride).for_each(|cut| attempt(&mut best, Way { cut, passes: plain }));
    if passes.runs {
        let mut cuts: Vec<usize> = best.iter().map(|(_, way)| way.cut).collect();
        cuts.sort_unstable();
        cuts.dedup();
        cuts.into_iter().for_each(|cut| attempt(&mut best, Way { cut, passes }));
    }
    best.into_iter().map(|(_, way)| way).collect()
}

fn derive_by(robot: &Robot, outputs: &[Output], way: Way) -> Program {
    let mut chain = way.lay_out(robot);
    let mut solves = Vec::new();
    let mut blocks = Vec::new();
    for &output in outputs {
        let derived = derived(&mut chain, output);
        solves.extend(derived.solve);
        blocks.push(Block { held: Held::Output(output), entries: derived.entries });
    }
    let readings = Readings::of(robot);
    let (cut, dof) = (way.cut, robot.dof());
    Program { graph: chain.g, blocks, solves, cut, dof, readings, own: None }
}
