//! What computes a robot's outputs: the graph that is derived from its table, as every printer
//! writes it down.

use stiffarm_codegen::derive::{Given, Program, derive};
use stiffarm_codegen::robot::Robot;
use stiffarm_kernels::{Output, Unstable};

/// One graph per output, each as it would be printed.
pub struct Model(Vec<(Output, Program)>);

impl Model {
    pub fn new(robot: &Robot, outputs: &[Output]) -> Model {
        Model(outputs.iter().map(|o| (*o, derive(robot, &[*o]))).collect())
    }

    /// An output as one column-major block. It must be one that the model was made for.
    pub fn evaluate(
        &self,
        output: Output,
        q: &[f64],
        w: &[f64; 6],
        given: &Given,
    ) -> Result<Vec<f64>, Unstable> {
        let program = self.program(output);
        let blocks = program.map(|p| p.evaluate_given(q, w, |_| f64::NAN, given)).transpose();
        Ok(first(blocks?))
    }

    /// The same computed in single precision.
    pub fn single(&self, output: Output, q: &[f64], w: &[f64; 6]) -> Result<Vec<f64>, Unstable> {
        let q: Vec<f32> = q.iter().map(|x| *x as f32).collect();
        let w = w.map(|x| x as f32);
        let blocks = self.program(output).map(|p| p.evaluate(&q, &w, |_| f32::NAN)).transpose();
        Ok(first(blocks?).into_iter().map(f64::from).collect())
    }

    fn program(&self, output: Output) -> Option<&Program> {
        self.0.iter().find(|(o, _)| *o == output).map(|(_, program)| program)
    }
}

fn first<T>(blocks: Option<Vec<Vec<T>>>) -> Vec<T> {
    blocks.and_then(|blocks| blocks.into_iter().next()).unwrap_or_default()
}
