//! A module: the arm's outputs, and functions of one's own beside them, with one posture for all.

use std::path::PathBuf;

use super::formulas::Formulas;
use super::function::Function;
use super::mistake::Refused;
use crate::derive::Program;
use crate::emit::{
    CFiles, COptions, CudaOptions, NotWritten, RustOptions, c_with, cuda_with, python_with,
    rust_with,
};
use crate::out_dir::{BuildError, write_to_out_dir};
use crate::robot::{CLOSED_FORM, ELBOW_ANGLE, GIVES, INVERSE_KINEMATICS, Output, Robot};
use crate::term::Mistake;

/// An arm's module with functions of one's own.
pub struct Module<'r> {
    robot: &'r Robot,
    functions: Vec<Function>,
}

impl<'r> Module<'r> {
    /// The module of an arm: so far its outputs, as its robot file asks for them.
    pub fn new(robot: &'r Robot) -> Self {
        Module { robot, functions: Vec::new() }
    }

    /// Adds a function: see [`Function::new`].
    ///
    /// # Errors
    /// [`Refused`], also where the module has an item of this name.
    pub fn function(
        mut self,
        name: &str,
        sentence: &str,
        formulas: impl Fn(&Formulas<'_>),
    ) -> Result<Self, Refused> {
        let known = Output::EACH.iter().any(|output| output.name() == name)
            || [INVERSE_KINEMATICS, CLOSED_FORM, ELBOW_ANGLE, GIVES].contains(&name)
            || self.functions.iter().any(|function| function.name() == name);
        if known {
            let text = "found the name of another function of the module, expected a new one";
            let mistakes = vec![Mistake { at: None, text: text.to_owned() }];
            return Err(Refused { function: name.to_owned(), mistakes });
        }
        self.functions.push(Function::new(self.robot, name, sentence, formulas)?);
        Ok(self)
    }

    /// The functions that were added.
    pub fn functions(&self) -> &[Function] {
        &self.functions
    }

    fn programs(&self) -> Vec<&Program> {
        self.functions.iter().map(|function| &function.program).collect()
    }

    /// The items of the module, like [`rust`](crate::emit::rust).
    pub fn rust(&self, options: &RustOptions) -> String {
        rust_with(self.robot, &self.programs(), options)
    }

    /// Both files in C, like [`c`](crate::emit::c).
    ///
    /// # Errors
    /// [`NotWritten`] where a cell of the table is no number.
    pub fn c(&self, options: &COptions) -> Result<CFiles, NotWritten> {
        c_with(self.robot, &self.programs(), options)
    }

    /// The module in Python, like [`python`](crate::emit::python).
    pub fn python(&self) -> String {
        python_with(self.robot, &self.programs())
    }

    /// The file in CUDA C, like [`cuda`](crate::emit::cuda).
    ///
    /// # Errors
    /// [`NotWritten`] where a cell of the table is no number.
    pub fn cuda(&self, options: &CudaOptions) -> Result<String, NotWritten> {
        cuda_with(self.robot, &self.programs(), options)
    }

    /// Writes the Rust text to `OUT_DIR` as `<name>.rs`; in the crate
    /// `pub mod arm { include!(concat!(env!("OUT_DIR"), "/<name>.rs")); }`.
    ///
    /// # Errors
    /// [`BuildError`] where the file cannot be written, or `OUT_DIR` is not set.
    pub fn to_out_dir(&self, name: &str, options: &RustOptions) -> Result<PathBuf, BuildError> {
        write_to_out_dir(name, &self.rust(options))
    }
}
