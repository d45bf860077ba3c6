//! Every output of the kernels as a function of columns: `pose(robot, q1, …, qn)`, `deflection(robot, q1, …, qn,
//! fx, fy, fz, mx, my, mz)`.
//!
//! The numbers of a batch of rows go through the kernels in lanes, from the engine's columns into the column
//! that it gets back. A value is the output's block, column after column. It is null where an argument is null
//! or not finite, and where the arm has no stable equilibrium under its load.

use std::sync::Arc;

use arrow::array::{Array, ArrayRef, AsArray, FixedSizeListArray, Float64Array};
use arrow::buffer::NullBuffer;
use arrow::compute::cast;
use arrow::datatypes::{DataType, Field, Float64Type};
use datafusion::common::{Result, exec_err, plan_err};
use datafusion::logical_expr::{
    ColumnarValue, ScalarFunctionArgs, ScalarUDF, ScalarUDFImpl, Signature, Volatility,
};
use stiffarm_kernels::{Input, Output};

use crate::arms::Arms;

/// An output as a function.
#[derive(Debug, PartialEq, Eq, Hash)]
struct Function {
    output: Output,
    arms: Arc<Arms>,
    signature: Signature,
}

/// All of them.
pub fn functions(arms: &Arc<Arms>) -> Vec<ScalarUDF> {
    let function = |output| {
        let signature = Signature::user_defined(Volatility::Stable);
        ScalarUDF::from(Function { output, arms: Arc::clone(arms), signature })
    };
    Output::EACH.into_iter().map(function).collect()
}

impl Function {
    /// What it is given behind the robot.
    fn wanted(&self) -> String {
        let each = self.output.inputs().iter().map(|input| match input {
            Input::Joints => "q1, …, qn",
            Input::Rates => "qd1, …, qdn",
            Input::Accelerations => "qdd1, …, qddn",
            Input::Torques => "tau1, …, taun",
            _ => "fx, fy, fz, mx, my, mz",
        });
        each.collect::<Vec<_>>().join(", ")
    }

    /// The number of joints of which this many numbers are.
    fn dof(&self, numbers: usize) -> Result<usize> {
        let loads = if self.output.takes(Input::Wrench) { 6 } else { 0 };
        let each = self.output.state(1);
        match numbers.checked_sub(loads) {
            Some(of_joints) if of_joints > 0 && of_joints.is_multiple_of(each) => {
                Ok(of_joints / each)
            }
            _ => plan_err!(
                "{}: found {numbers} numbers behind the robot, expected {}",
                self.output.name(),
                self.wanted()
            ),
        }
    }

    /// Writes the rows `from..to`, which are of one robot, into `out`.
    fn write(
        &self,
        robot: &str,
        columns: &[&[f64]],
        (from, to): (usize, usize),
        out: &mut [f64],
    ) -> Result<()> {
        let name = self.output.name();
        let arm = match self.arms.arm(robot) {
            Ok(arm) => arm,
            Err(said) => return exec_err!("{name}: {said}"),
        };
        let dof = self.dof(columns.len())?;
        if arm.dof() != dof {
            return exec_err!(
                "{name}: found {dof} joints for {}, which has {}: expected {}",
                arm.name(),
                arm.dof(),
                self.wanted()
            );
        }
        let rows: Vec<&[f64]> = columns.iter().map(|column| &column[from..to]).collect();
        let (q, wrench) = rows.split_at(self.output.state(dof));
        arm.evaluate(self.output, q, wrench, out).or_else(|said| exec_err!("{said}"))
    }
}

impl ScalarUDFImpl for Function {
    fn name(&self) -> &str {
        self.output.name()
    }

    fn signature(&self) -> &Signature {
        &self.signature
    }

    fn coerce_types(&self, given: &[DataType]) -> Result<Vec<DataType>> {
        self.dof(given.len().saturating_sub(1))?;
        let mut wanted = vec![DataType::Float64; given.len()];
        wanted[0] = DataType::Utf8;
        Ok(wanted)
    }

    fn return_type(&self, given: &[DataType]) -> Result<DataType> {
        let dof = self.dof(given.len().saturating_sub(1))?;
        Ok(DataType::FixedSizeList(item(), entries(self.output, dof) as i32))
    }

    fn invoke_with_args(&self, args: ScalarFunctionArgs) -> Result<ColumnarValue> {
        let rows = args.number_rows;
        let robots = Robots::new(&args.args[0], rows)?;
        // What is a column of doubles already is not copied.
        let columns = args.args[1..].iter().map(|argument| {
            let array = argument.to_array(rows)?;
            Ok(cast(&array, &DataType::Float64)?)
        });
        let columns: Vec<ArrayRef> = columns.collect::<Result<_>>()?;
        let columns: Vec<&Float64Array> =
            columns.iter().map(|column| column.as_primitive::<Float64Type>()).collect();
        let values: Vec<&[f64]> = columns.iter().map(|column| &column.values()[..]).collect();
        let entries = entries(self.output, self.dof(columns.len())?);
        let mut out = vec![f64::NAN; rows * entries];
        for (robot, from, to) in robots.runs(rows) {
            if let Some(robot) = robot {
                let out = &mut out[from * entries..to * entries];
                self.write(robot, &values, (from, to), out)?;
            }
        }
        let nulls = columns.iter().map(|column| column.nulls());
        let given = nulls.fold(None, |all, nulls| NullBuffer::union(all.as_ref(), nulls));
        let finite = |block: &[f64]| !block.iter().fold(false, |bad, x| bad | !x.is_finite());
        let known: NullBuffer = out.chunks_exact(entries).map(finite).collect::<Vec<_>>().into();
        let known = NullBuffer::union(given.as_ref(), Some(&known));
        let out = Arc::new(Float64Array::from(out));
        let list = FixedSizeListArray::try_new(item(), entries as i32, out, known)?;
        Ok(ColumnarValue::Array(Arc::new(list)))
    }
}

fn item() -> Arc<Field> {
    Arc::new(Field::new_list_field(DataType::Float64, true))
}

fn entries(output: Output, dof: usize) -> usize {
    let (rows, columns) = output.shape(dof);
    rows * columns
}

/// The robot of each row.
enum Robots {
    One(Option<String>),
    Each(ArrayRef),
}

impl Robots {
    fn new(given: &ColumnarValue, rows: usize) -> Result<Robots> {
        Ok(match given {
            ColumnarValue::Scalar(scalar) => {
                Robots::One(scalar.try_as_str().flatten().map(str::to_owned))
            }
            array @ ColumnarValue::Array(_) => {
                Robots::Each(cast(&array.to_array(rows)?, &DataType::Utf8)?)
            }
        })
    }

    /// Runs of rows of one robot: from which row to before which.
    fn runs(&self, rows: usize) -> Vec<(Option<&str>, usize, usize)> {
        let names = match self {
            Robots::One(name) => return vec![(name.as_deref(), 0, rows)],
            Robots::Each(names) => names.as_string::<i32>(),
        };
        let mut runs: Vec<(Option<&str>, usize, usize)> = Vec::new();
        for (row, name) in names.iter().enumerate() {
            match runs.last_mut() {
                Some((last, _, to)) if *last == name => *to = row + 1,
                _ => runs.push((name, row, row + 1)),
            }
        }
        runs
    }
}
