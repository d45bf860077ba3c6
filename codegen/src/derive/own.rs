//! What a function of one's own says of itself: its name, its inputs, its results.

use stiffarm_kernels::Output;

/// A function beside the arm's outputs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Own {
    /// Its name in the generated module.
    pub name: String,
    /// What it computes.
    pub sentence: String,
    /// Its inputs beside the joint values, in the order of arguments.
    pub inputs: Vec<OwnInput>,
    /// Whether it is finite whatever it is given: no divisor and nothing under a root vanishes.
    pub finite: bool,
}

/// An input beside the joint values.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OwnInput {
    /// The argument's name.
    pub name: String,
    /// Its unit, `1` if it has none.
    pub unit: String,
    /// What it is.
    pub sentence: String,
    /// How many numbers; `None` is one by itself.
    pub size: Option<usize>,
}

impl OwnInput {
    /// What generated code calls one of its entries.
    pub fn entry(&self, entry: usize) -> String {
        match self.size {
            None => self.name.clone(),
            Some(_) => format!("{}_{}", self.name, entry + 1),
        }
    }
}

/// A result.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Quantity {
    /// The field's name.
    pub name: String,
    /// Its unit, `1` if it has none.
    pub unit: String,
    /// What it is.
    pub sentence: String,
    /// How its numbers are arranged.
    pub size: Size,
}

/// How the numbers of a result are arranged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Size {
    /// One number.
    Scalar,
    /// So many.
    Vector(usize),
    /// Columns of rows.
    Matrix {
        /// Entries of a column.
        rows: usize,
        /// Columns.
        columns: usize,
    },
}

impl Size {
    /// How many numbers.
    pub fn count(self) -> usize {
        match self {
            Size::Scalar => 1,
            Size::Vector(rows) => rows,
            Size::Matrix { rows, columns } => rows * columns,
        }
    }
}

/// What a block of a program holds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Held {
    /// An output of the arm.
    Output(Output),
    /// A result of a function of one's own.
    Own(Quantity),
}

impl Held {
    /// Its name in generated code.
    pub fn name(&self) -> &str {
        match self {
            Held::Output(output) => output.name(),
            Held::Own(quantity) => &quantity.name,
        }
    }

    /// Rows and columns for an arm of `n` joints.
    pub fn shape(&self, n: usize) -> (usize, usize) {
        match self {
            Held::Output(output) => output.shape(n),
            Held::Own(quantity) => match quantity.size {
                Size::Scalar => (1, 1),
                Size::Vector(rows) => (rows, 1),
                Size::Matrix { rows, columns } => (rows, columns),
            },
        }
    }

    /// The arm's output, if it is one.
    pub fn output(&self) -> Option<Output> {
        match self {
            Held::Output(output) => Some(*output),
            Held::Own(_) => None,
        }
    }
}
