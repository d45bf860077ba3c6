//! What computes a robot's outputs: its compiled kernels, or the derived graph itself.

use stiffarm_codegen::derive::{Output as Derived, Program, derive};
use stiffarm_kernels::{Error, Kernels, Output, Unstable};

use super::source::Source;

/// The implementation that is generated from the table.
pub enum Model {
    /// Kernels of the collection.
    Compiled(&'static (dyn Kernels<f64> + Sync)),
    /// One graph per output, each as it would be printed.
    Graph(Vec<(Output, Program)>),
}

impl Model {
    /// For these outputs.
    pub fn new(source: &Source, outputs: &[Output]) -> Model {
        match source.compiled {
            Some(arm) => Model::Compiled(arm.kernels),
            None => {
                let program = |o: &Output| (*o, derive(&source.robot, &[derived(*o)]));
                Model::Graph(outputs.iter().map(program).collect())
            }
        }
    }

    /// What it is, in words.
    pub fn name(&self) -> &'static str {
        match self {
            Model::Compiled(_) => "compiled kernels",
            Model::Graph(_) => "derived graph",
        }
    }

    /// An output as one column-major block. It must be one that the model was made for.
    ///
    /// # Errors
    /// [`Unstable`] where a deflection has no stable equilibrium.
    pub fn evaluate(&self, output: Output, q: &[f64], w: &[f64; 6]) -> Result<Vec<f64>, Unstable> {
        match self {
            Model::Compiled(kernels) => {
                let (rows, columns) = output.shape(kernels.dof());
                let mut out = vec![0.0; rows * columns];
                match kernels.evaluate(output, q, w, &mut out) {
                    Ok(()) => Ok(out),
                    Err(Error::Unstable | Error::Length) => Err(Unstable),
                }
            }
            Model::Graph(programs) => {
                let program = programs.iter().find(|(o, _)| *o == output).map(|(_, p)| p);
                let blocks = program.map(|p| p.evaluate(q, w, |_| f64::NAN)).transpose();
                let blocks = blocks.map_err(|_| Unstable)?.unwrap_or_default();
                Ok(blocks.into_iter().next().unwrap_or_default())
            }
        }
    }
}

/// The generator's name of an output: the two lists stand in the same order, by test.
pub fn derived(output: Output) -> Derived {
    let names = Output::EACH.iter().position(|o| *o == output);
    Derived::EACH[names.unwrap_or(0)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_two_lists_of_outputs_agree() {
        for output in Output::EACH {
            assert_eq!(derived(output).name(), output.name());
            assert_eq!(derived(output).shape(5), output.shape(5));
        }
    }
}
