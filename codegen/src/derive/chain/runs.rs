//! Twists worked out where they are sparsest: in the frame in which a run of parallel joints begins.
//!
//! There a joint's axis is ±z, so its twist is the lever turned by a quarter, and the lever is that of
//! the next run, turned inwards, plus the translations of the run. Twists are then turned inwards frame by
//! frame. Products of sines and cosines of different runs are never formed, and `c (c x + s y) +
//! s (s x − c y)`, which is x again, never comes about.

use super::layout::{ByRun, Chain};
use super::lever::{Levers, Point};
use super::place::{Place, Step};
use crate::expr::{Expr, Graph, Turn, Twist, Vec3};

/// Consecutive steps whose z axes are parallel, with the places between them in the axes of the first.
struct Run {
    /// Boundary at which it begins.
    start: usize,
    /// Orientations at the boundaries `start..=end`.
    places: Vec<Place>,
    /// The turn about x that ends it.
    last: Turn,
}

/// Works the twists out run by run.
pub fn by_run(chain: &mut Chain) -> ByRun {
    let runs = runs(chain);
    let mut twists: Vec<Option<Twist>> = vec![None; chain.dof()];
    let mut tip = chain.tool_lengths();
    for at in (0..runs.len()).rev() {
        if at + 1 < runs.len() {
            tip = turned_x(&mut chain.g, &runs[at].last, tip);
        }
        tip = levers(chain, &runs[at], tip, &mut twists);
    }
    before(chain, tip, &mut twists);
    // Inwards, the outermost first.
    for pair in runs.windows(2).rev() {
        let joints: Vec<usize> = (0..chain.dof()).map(|row| chain.joint_step(row)).collect();
        for (step, twist) in joints.into_iter().zip(&mut twists) {
            if step >= pair[1].start {
                *twist = twist.map(|(v, w)| {
                    (inwards(&mut chain.g, &pair[0], v), inwards(&mut chain.g, &pair[0], w))
                });
            }
        }
    }
    ByRun { twists: twists.into_iter().flatten().collect(), tip }
}

/// Sets the twists of the joints before the working frame, seen from there; `tip` is the tool's origin.
fn before(chain: &mut Chain, tip: Vec3, twists: &mut [Option<Twist>]) {
    let inside = Levers::inside(chain, chain.cut, tip);
    for (row, twist) in twists.iter_mut().enumerate() {
        let step = chain.joint_step(row);
        if step < chain.cut {
            let (z, turns) = (chain.z(step), chain.revolute(row));
            *twist = Some(inside.twist(&mut chain.g, Point::Step(step), z, turns));
        }
    }
}

/// The runs from the working frame outwards.
fn runs(chain: &mut Chain) -> Vec<Run> {
    let steps = chain.steps().to_vec();
    let begin = |start| Run { start, places: vec![Place::base()], last: Turn::ZERO };
    let mut runs = Vec::new();
    let mut run = begin(chain.cut);
    for (s, step) in steps.iter().enumerate().skip(chain.cut) {
        match step {
            Step::RotateX(turn) if !turn.is_zero() && !turn.is_half_turn() => {
                run.last = turn.clone();
                runs.push(core::mem::replace(&mut run, begin(s + 1)));
            }
            _ => {
                let next = run.places[s - run.start].after(&mut chain.g, step);
                run.places.push(next.at_once(&mut chain.g, !chain.passes.sums));
            }
        }
    }
    runs.push(run);
    runs
}

/// Sets the twists of a run's joints, in the axes in which the run begins, and returns the tool's origin
/// from there; `tip` is that origin from the run's end, in the axes at its end.
fn levers(chain: &mut Chain, run: &Run, tip: Vec3, twists: &mut [Option<Twist>]) -> Vec3 {
    let (mut sum, mut pending) = ([Expr::ZERO; 3], tip);
    for offset in (0..run.places.len() - 1).rev() {
        let s = run.start + offset;
        let step = chain.steps()[s].clone();
        let here = &run.places[offset];
        match step {
            Step::TranslateZ(length) => pending[2] = chain.g.add(pending[2], length),
            Step::TranslateX(length) => pending[0] = chain.g.add(pending[0], length),
            Step::RotateX(turn) | Step::RotateZ(turn) if turn.is_zero() => {}
            Step::RotateX(_) | Step::RotateZ(_) => {
                let turned = run.places[offset + 1].turned(&mut chain.g, pending);
                sum = chain.g.add3(sum, turned);
                pending = [Expr::ZERO; 3];
            }
        }
        let Some(row) = (0..chain.dof()).find(|row| chain.joint_step(*row) == s) else { continue };
        let z = here.axes[2];
        twists[row] = Some(match chain.revolute(row) {
            true => {
                chain.g.name3(sum, &format!("r{}", row + 1));
                (chain.g.cross3(z, sum), z)
            }
            false => (z, [Expr::ZERO; 3]),
        });
    }
    chain.g.add3(sum, pending)
}

/// A vector in the axes behind a turn about x, in those before it.
fn turned_x(g: &mut Graph, turn: &Turn, [x, y, z]: Vec3) -> Vec3 {
    let turn = turn.sin_cos(g);
    let [y, z] = g.turn2(turn, [y, z]);
    [x, y, z]
}

/// A vector in the axes in which the run after `run` begins, in those in which `run` begins.
fn inwards(g: &mut Graph, run: &Run, v: Vec3) -> Vec3 {
    let turned = turned_x(g, &run.last, v);
    run.places[run.places.len() - 1].turned(g, turned)
}
