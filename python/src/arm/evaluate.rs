//! An output at one pose or many.

use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use stiffarm_kernels::batch::{self, Wrenches};
use stiffarm_kernels::{Input, Output, Side};

use super::{Arm, single};
use crate::arrays::{Numbers, Shape, Values, lead, numbers, shape};
use crate::engine::Poses;
use crate::work::Unstable;

/// Fewer poses than this take less time than it takes to hand over the interpreter.
const FEW: usize = 4;

/// What may be said of every output.
pub struct Beside<'a, 'py> {
    /// Where the result is to be.
    pub out: Option<&'a Bound<'py, PyAny>>,
    /// From which side each joint came to rest, (n,).
    pub sides: Option<&'a Bound<'py, PyAny>>,
    /// K.
    pub warming: Option<f64>,
    /// The frame or marker that is told of in the tool's place.
    pub at: Option<String>,
}

impl Arm {
    /// An output: `inputs` are the arrays that it takes of the joints.
    pub fn tell<'py>(
        &self,
        py: Python<'py>,
        output: Output,
        inputs: &[&Bound<'py, PyAny>],
        wrench: Option<&Bound<'py, PyAny>>,
        Beside { out, sides, warming, at }: Beside<'_, 'py>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let (asked, n) = (self.asked(output, at)?, self.dof());
        let given = self.given_beside(py, sides, warming)?;
        let (rows, columns) = output.shape(n);
        if let Some((states, wrench)) = single::read(output, n, inputs, wrench) {
            let wrenches = Wrenches::One(&wrench);
            let poses = Poses { count: 1, states: &states, wrenches, given: &given };
            return Shape::of(output, n).fill(py, (&[], rows * columns), out, false, |block| {
                let done = self.engines.evaluate(&asked, poses, block);
                Ok(done.err().map(|unstable| refused(py, output, &unstable)))
            });
        }
        let joints = output.inputs().iter().filter(|input| input.side() == Side::Joints);
        let mut all: Vec<(Vec<usize>, Numbers<'py>)> = Vec::with_capacity(4);
        let mut single = true;
        for (input, array) in joints.zip(inputs) {
            let (array, of_single) = numbers(input.name(), array)?;
            single &= of_single;
            all.push((lead(input.name(), &array, n)?, array));
        }
        if all.len() * n != output.state(n) || inputs.len() != all.len() {
            let expected = output.state(n) / n;
            let name = output.name();
            return Err(PyTypeError::new_err(format!(
                "{name}: found {} arrays of the joints, expected {expected}",
                inputs.len()
            )));
        }
        let wrench = match (wrench, output.takes(Input::Wrench)) {
            (Some(wrench), true) => {
                let (wrench, _) = numbers("wrench", wrench)?;
                Some((lead("wrench", &wrench, 6)?, wrench))
            }
            (None, true) => return Err(PyTypeError::new_err("wrench: found none, expected (6,)")),
            (_, false) => None,
        };
        let dimensions = self::common(all.iter().chain(&wrench).map(|(lead, _)| lead))?;
        let count: usize = dimensions.iter().product();
        let read = all.iter().map(|(_, array)| Values::of(array)).collect::<PyResult<Vec<_>>>()?;
        let parts = read.iter().map(Values::numbers).collect::<PyResult<Vec<&[f64]>>>()?;
        let whole = matches!(parts[..], [one] if one.len() == count * n);
        let joined = if whole { Vec::new() } else { join(&parts, count, n) };
        let states = if whole { parts[0] } else { &joined[..] };
        let per_pose = states.len() / count.max(1);
        let is_batch = !dimensions.is_empty();
        let missing = if is_batch { missing(states, per_pose) } else { Vec::new() };
        let filled = filled(states, per_pose, &missing);
        let states = if missing.is_empty() { states } else { &filled[..] };
        let loads = wrench.as_ref().map(|(_, array)| Values::of(array)).transpose()?;
        let loads = loads.as_ref().map(Values::numbers).transpose()?;
        let none = [0.0; 6];
        let wrenches = match loads {
            None => Wrenches::One(&none),
            Some(loads) => match <&[f64; 6]>::try_from(loads) {
                Ok(one) => Wrenches::One(one),
                Err(_) => Wrenches::Each(loads),
            },
        };
        let poses = Poses { count, states, wrenches, given: &given };
        let finite = || {
            all_finite(states).map_err(|at| (at, "the joints' values", states.len()))?;
            let loads = loads.unwrap_or_default();
            all_finite(loads).map_err(|at| (at, "wrench", loads.len()))
        };
        let place = (&dimensions[..], rows * columns);
        Shape::of(output, n).fill(py, place, out, single, |blocks| {
            let mut work = || match finite() {
                Ok(()) => {
                    let done = self.engines.evaluate(&asked, poses, blocks);
                    for pose in &missing {
                        blocks[pose * rows * columns..][..rows * columns].fill(f64::NAN);
                    }
                    Ok(done)
                }
                Err(wrong) => Err(wrong),
            };
            match if count > FEW { py.detach(work) } else { work() } {
                Ok(Ok(())) => Ok(None),
                Ok(Err(unstable)) => Ok(Some(refused(py, output, &unstable))),
                Err((at, what, length)) => Err(PyValueError::new_err(format!(
                    "{what}: found a value that is not finite, at pose {} (from 0), expected numbers",
                    at / (length / count.max(1)).max(1)
                ))),
            }
        })
    }
}

/// The one shape of a batch among those given; what has none is the same at every pose.
fn common<'a>(leads: impl Iterator<Item = &'a Vec<usize>>) -> PyResult<Vec<usize>> {
    let mut found: Vec<usize> = Vec::new();
    for lead in leads.filter(|lead| !lead.is_empty()) {
        if !found.is_empty() && found != *lead {
            let (first, other) = (shape(&found), shape(lead));
            let text = format!("found batches of the shapes {first} and {other}, expected one");
            return Err(PyValueError::new_err(text));
        }
        found.clone_from(lead);
    }
    Ok(found)
}

/// Values, rates, … of each pose behind each other.
fn join(parts: &[&[f64]], count: usize, n: usize) -> Vec<f64> {
    let mut states = Vec::with_capacity(count * n * parts.len());
    for pose in 0..count {
        for part in parts {
            let at = if part.len() == n { 0 } else { pose * n };
            states.extend_from_slice(&part[at..at + n]);
        }
    }
    states
}

/// The poses, from 0, whose values are missing: one of them is not a number.
fn missing(states: &[f64], per_pose: usize) -> Vec<usize> {
    if per_pose == 0 || !states.iter().fold(false, |bad, x| bad | x.is_nan()) {
        return Vec::new();
    }
    let poses = states.chunks(per_pose).enumerate();
    poses.filter(|(_, pose)| pose.iter().any(|x| x.is_nan())).map(|(k, _)| k).collect()
}

/// The same with the first pose that is there, else zeros, in place of those that are missing.
fn filled(states: &[f64], per_pose: usize, missing: &[usize]) -> Vec<f64> {
    if missing.is_empty() {
        return Vec::new();
    }
    let first =
        states.chunks(per_pose).enumerate().find(|(k, _)| missing.binary_search(k).is_err());
    let pose = first.map_or(vec![0.0; per_pose], |(_, pose)| pose.to_vec());
    let mut all = states.to_vec();
    missing.iter().for_each(|k| all[k * per_pose..][..per_pose].copy_from_slice(&pose));
    all
}

/// Where the first number is that is not finite.
fn all_finite(numbers: &[f64]) -> Result<(), usize> {
    // Without a way out of the loop it runs in lanes.
    if !numbers.iter().fold(false, |bad, x| bad | !x.is_finite()) {
        return Ok(());
    }
    Err(numbers.iter().position(|x| !x.is_finite()).unwrap_or(0))
}

fn refused(py: Python<'_>, output: Output, error: &batch::Error) -> PyErr {
    let raised = Unstable::new_err(match (output, error) {
        (Output::ForwardDynamics, batch::Error::Unstable { first, count }) => format!(
            "a joint moves no mass at {count} of the poses, the first being number {first} (from 0): the mass matrix is \
             not positive definite"
        ),
        _ => error.to_string(),
    });
    if let batch::Error::Unstable { first, count } = error {
        let value = raised.value(py);
        let set = value.setattr("first", first).and_then(|()| value.setattr("count", count));
        if let Err(other) = set {
            return other;
        }
    }
    raised
}
