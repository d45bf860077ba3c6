//! What computes an arm's outputs: its compiled kernels, C that was compiled for it, the textbook, or, of a
//! corrected arm, the graph that kernels are printed from. All write the same blocks.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError};

use rayon::prelude::*;
use stiffarm_codegen::derive::{Given, Program, derive, derive_at};
use stiffarm_codegen::robot::{Asked, Refused, Robot};
use stiffarm_kernels::Output;
use stiffarm_kernels::batch::{self, Layout, Wrenches};
use stiffarm_kernels::generic;

use crate::compiled::Library;

/// Poses that one task works through.
const RUN: usize = 256;

/// Everything that may compute.
pub struct Engines {
    robot: Robot,
    table: generic::Arm,
    built_in: Option<&'static stiffarm_robots::Arm>,
    library: OnceLock<Library>,
    graphs: Mutex<HashMap<Key, Arc<Program>>>,
}

/// An output and the frame or marker that it is told of, if it is not the tool.
type Key = (Output, Option<String>);

/// Which of them does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Engine {
    Kernels,
    Compiled,
    Textbook,
    Graph,
}

impl Engine {
    /// Its name for users.
    pub fn name(self) -> &'static str {
        match self {
            Engine::Kernels => "kernels",
            Engine::Compiled => "c",
            Engine::Textbook => "textbook",
            Engine::Graph => "graph",
        }
    }
}

/// States and loads of many poses.
#[derive(Clone, Copy)]
pub struct Poses<'a> {
    pub count: usize,
    pub states: &'a [f64],
    pub wrenches: Wrenches<'a, f64>,
    pub given: &'a Given,
}

impl<'a> Poses<'a> {
    /// From pose `first` on, `count` of them.
    pub fn part(self, first: usize, count: usize) -> Poses<'a> {
        let size = self.states.len() / self.count.max(1);
        let states = &self.states[first * size..(first + count) * size];
        let wrenches = match self.wrenches {
            Wrenches::Each(each) => Wrenches::Each(&each[6 * first..6 * (first + count)]),
            one => one,
        };
        Poses { count, states, wrenches, ..self }
    }

    /// State and load of each.
    fn each(self) -> impl Iterator<Item = (&'a [f64], [f64; 6])> {
        let size = self.states.len() / self.count.max(1);
        (0..self.count).map(move |k| {
            let wrench = match self.wrenches {
                Wrenches::One(wrench) => *wrench,
                Wrenches::Each(each) => core::array::from_fn(|at| each[6 * k + at]),
            };
            (&self.states[k * size..(k + 1) * size], wrench)
        })
    }
}

impl Engines {
    /// Of a robot as kernels are made of it, and its table as the textbook has it.
    pub fn new(
        robot: Robot,
        table: generic::Arm,
        built_in: Option<&'static stiffarm_robots::Arm>,
    ) -> Engines {
        Engines {
            robot,
            table,
            built_in,
            library: OnceLock::new(),
            graphs: Mutex::new(HashMap::new()),
        }
    }

    /// The robot as kernels are made of it.
    pub fn robot(&self) -> &Robot {
        &self.robot
    }

    /// The table as the textbook has it.
    pub fn table(&self) -> &generic::Arm {
        &self.table
    }

    /// What computes an output.
    pub fn of(&self, asked: &Asked) -> Engine {
        let tool = asked.at.is_none();
        let has = |known: &[Output]| known.contains(&asked.output);
        match (&self.library.get(), self.built_in) {
            (Some(library), _) if library.has(asked) => Engine::Compiled,
            (_, Some(arm)) if tool && has(arm.kernels.outputs()) => Engine::Kernels,
            _ if tool && self.robot.effects.is_empty() => Engine::Textbook,
            _ => Engine::Graph,
        }
    }

    /// What is asked for, if the arm has it.
    ///
    /// # Errors
    /// [`Refused`]: a frame or marker that there is not, or an output that cannot be told there.
    pub fn asked(&self, output: Output, at: Option<String>) -> Result<Asked, Refused> {
        let asked = Asked { output, at };
        if let Some(at) = asked.at.as_deref().filter(|_| !self.graphs().contains_key(&key(&asked)))
        {
            self.robot.clone().ask(&asked)?;
            let program = derive_at(&self.robot, at, output).ok_or_else(|| Refused {
                message: format!("nothing can be told of `{at}`: its place is no number"),
                help: "give it numbers".to_owned(),
            })?;
            self.graphs().insert(key(&asked), Arc::new(program));
        }
        Ok(asked)
    }

    /// Takes C that was compiled of this robot, once it gives what is given without it.
    pub fn take(&self, library: Library) -> Result<(), String> {
        library.agrees(self)?;
        // Another thread's is the same.
        let _ = self.library.set(library);
        Ok(())
    }

    /// Writes the blocks of all poses.
    pub fn evaluate(
        &self,
        asked: &Asked,
        poses: Poses<'_>,
        out: &mut [f64],
    ) -> Result<(), batch::Error> {
        self.by(self.of(asked), asked, poses, out)
    }

    /// The same by one of the engines.
    pub(crate) fn by(
        &self,
        engine: Engine,
        asked: &Asked,
        poses: Poses<'_>,
        out: &mut [f64],
    ) -> Result<(), batch::Error> {
        let output = asked.output;
        match (engine, self.built_in, self.library.get()) {
            (Engine::Kernels, Some(arm), _) => {
                let (states, wrenches) = (poses.states, poses.wrenches);
                if let (1, Some((state, wrench))) = (poses.count, poses.each().next()) {
                    let done = arm.kernels.evaluate(output, state, &wrench, out);
                    return done.map_err(|_| batch::Error::Unstable { first: 0, count: 1 });
                }
                arm.batched.evaluate_batch(output, Layout::Poses, states, wrenches, out)
            }
            (Engine::Compiled, _, Some(library)) => {
                in_runs(poses, out, |poses, out| library.evaluate(asked, poses, out))
            }
            (Engine::Graph, ..) => {
                let program = self.graph(asked);
                in_runs(poses, out, |poses, out| {
                    one_by_one(poses, out, |state, wrench| {
                        let known = |_: &str| f64::NAN;
                        let blocks = program.evaluate_given(state, wrench, known, poses.given);
                        blocks.ok()?.into_iter().next()
                    })
                })
            }
            _ => in_runs(poses, out, |poses, out| {
                one_by_one(poses, out, |state, wrench| {
                    self.table.evaluate(output, state, wrench).ok()
                })
            }),
        }
    }

    fn graph(&self, asked: &Asked) -> Arc<Program> {
        // What is told of a place was derived when it was asked for.
        let made = || Arc::new(derive(&self.robot, &[asked.output]));
        Arc::clone(self.graphs().entry(key(asked)).or_insert_with(made))
    }

    fn graphs(&self) -> MutexGuard<'_, HashMap<Key, Arc<Program>>> {
        self.graphs.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

fn key(asked: &Asked) -> Key {
    (asked.output, asked.at.clone())
}

/// Poses without a stable equilibrium: the first, and how many.
pub type Unstable = Option<(usize, usize)>;

/// Each pose by itself.
fn one_by_one(
    poses: Poses<'_>,
    out: &mut [f64],
    block: impl Fn(&[f64], &[f64; 6]) -> Option<Vec<f64>>,
) -> Unstable {
    let size = out.len() / poses.count.max(1);
    let mut unstable: Unstable = None;
    for (k, (state, wrench)) in poses.each().enumerate() {
        match block(state, &wrench) {
            Some(block) => out[k * size..(k + 1) * size].copy_from_slice(&block),
            None => unstable = Some(unstable.map_or((k, 1), |(first, count)| (first, count + 1))),
        }
    }
    unstable
}

/// In runs, on all cores where there are several.
fn in_runs(
    poses: Poses<'_>,
    out: &mut [f64],
    run: impl Fn(Poses<'_>, &mut [f64]) -> Unstable + Sync,
) -> Result<(), batch::Error> {
    let size = (out.len() / poses.count.max(1)).max(1);
    let here = |(k, out): (usize, &mut [f64])| {
        let first = k * RUN;
        let unstable = run(poses.part(first, out.len() / size), out);
        unstable.map(|(at, count)| (first + at, count))
    };
    let runs: Vec<Unstable> = if poses.count <= RUN {
        out.chunks_mut(RUN * size).enumerate().map(here).collect()
    } else {
        out.par_chunks_mut(RUN * size).enumerate().map(here).collect()
    };
    let both = |a: (usize, usize), b: (usize, usize)| (a.0.min(b.0), a.1 + b.1);
    match runs.into_iter().flatten().reduce(both) {
        Some((first, count)) => Err(batch::Error::Unstable { first, count }),
        None => Ok(()),
    }
}
