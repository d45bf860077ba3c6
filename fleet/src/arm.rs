//! What computes the outputs of one robot at many poses: compiled kernels in lanes, the textbook of a file's
//! table, or the graph that kernels are printed from where the file holds effects.

use std::collections::HashMap;
use std::fmt;
use std::sync::{Arc, Mutex, PoisonError};

use stiffarm_codegen::derive::{Given, Program, derive};
use stiffarm_codegen::robot::Robot;
use stiffarm_kernels::{Output, batch, generic};

use crate::arms::Named;

/// A robot, ready to compute.
pub struct Arm {
    /// The text of its file; `None` of the collection.
    pub text: Option<String>,
    robot: Robot,
    table: generic::Arm,
    built_in: Option<&'static stiffarm_robots::Arm>,
    graphs: Mutex<HashMap<Output, Arc<Program>>>,
}

impl Arm {
    /// Of a robot as kernels are made of it, and its table as the textbook has it.
    pub fn new(robot: Robot, table: generic::Arm, named: Named) -> Arm {
        let built_in = match named.text {
            None => stiffarm_robots::arm(&named.given),
            Some(_) => None,
        };
        Arm { text: named.text, robot, table, built_in, graphs: Mutex::default() }
    }

    /// Number of joints.
    pub fn dof(&self) -> usize {
        self.robot.dof()
    }

    /// The robot's name.
    pub fn name(&self) -> &str {
        &self.robot.name
    }

    /// Writes `output` at every pose into `out`, pose after pose; of a pose without a stable equilibrium what was
    /// there stays. `q` has a column for each number of the joints, `wrench` the load's six.
    ///
    /// # Errors
    /// A sentence: the output does not exist for this arm.
    pub fn evaluate(
        &self,
        output: Output,
        q: &[&[f64]],
        wrench: &[&[f64]],
        out: &mut [f64],
    ) -> Result<(), String> {
        if let Some(arm) = self.built_in.filter(|arm| arm.kernels.outputs().contains(&output)) {
            return match arm.batched.evaluate_columns(output, q, wrench, out) {
                Ok(()) | Err(batch::Error::Unstable { .. }) => Ok(()),
                Err(error) => Err(format!("{}: {error}", output.name())),
            };
        }
        if self.robot.effects.is_empty() {
            let one =
                |state: &[f64], load: &[f64; 6]| self.table.evaluate(output, state, load).ok();
            each(q, wrench, out, one);
        } else {
            let (program, given) = (self.graph(output), Given::default());
            let unknown = |_: &str| f64::NAN;
            let one = |state: &[f64], load: &[f64; 6]| {
                program.evaluate_given(state, load, unknown, &given).ok()?.into_iter().next()
            };
            each(q, wrench, out, one);
        }
        Ok(())
    }

    fn graph(&self, output: Output) -> Arc<Program> {
        let mut graphs = self.graphs.lock().unwrap_or_else(PoisonError::into_inner);
        let made = || Arc::new(derive(&self.robot, &[output]));
        Arc::clone(graphs.entry(output).or_insert_with(made))
    }
}

/// Each pose by itself.
fn each(
    q: &[&[f64]],
    wrench: &[&[f64]],
    out: &mut [f64],
    one: impl Fn(&[f64], &[f64; 6]) -> Option<Vec<f64>>,
) {
    let poses = q.first().map_or(0, |column| column.len());
    let entries = out.len().checked_div(poses).unwrap_or(0);
    let mut state = vec![0.0; q.len()];
    for (pose, out) in out.chunks_exact_mut(entries.max(1)).enumerate() {
        state.iter_mut().zip(q).for_each(|(x, column)| *x = column[pose]);
        let load = core::array::from_fn(|k| wrench.get(k).map_or(0.0, |column| column[pose]));
        if let Some(block) = one(&state, &load) {
            out.copy_from_slice(&block);
        }
    }
}

impl fmt::Debug for Arm {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Arm({})", self.robot.name)
    }
}
