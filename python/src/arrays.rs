//! NumPy's arrays in and out: what is read without a copy where it lies well, and where results go.

use numpy::ndarray::{ArrayView, ArrayViewD, Dimension, IxDyn, ShapeBuilder, ShapeError};
use numpy::{
    PyArrayDescrMethods, PyArrayDyn, PyArrayMethods, PyReadonlyArrayDyn, PyReadwriteArrayDyn,
    PyUntypedArray, PyUntypedArrayMethods, ToPyArray,
};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::intern;
use pyo3::prelude::*;
use stiffarm_kernels::{Form, Output, Side};

/// Numbers of a result for which no memory is asked: 8 by 8.
const SMALL: usize = 64;

/// Doubles in a row, whatever array-like they come from.
pub type Numbers<'py> = Bound<'py, PyArrayDyn<f64>>;

/// The numbers of an argument, and whether they are an array of numpy.float32; an array of doubles that lies pose
/// after pose is not copied.
pub fn numbers<'py>(name: &str, given: &Bound<'py, PyAny>) -> PyResult<(Numbers<'py>, bool)> {
    if let Ok(array) = given.cast::<PyArrayDyn<f64>>()
        && array.is_c_contiguous()
    {
        return Ok((array.clone(), false));
    }
    let py = given.py();
    let numpy = py.import(intern!(py, "numpy"))?;
    let array = numpy.call_method1(intern!(py, "asarray"), (given,))?;
    let found = array.cast::<PyUntypedArray>()?.dtype();
    let (kind, single) = (found.kind(), found.kind() == b'f' && found.itemsize() == 4);
    if !b"iuf".contains(&kind) {
        let dtype = array.getattr(intern!(py, "dtype"))?;
        return Err(PyTypeError::new_err(format!("{name}: found {dtype}, expected real numbers")));
    }
    let doubles = numpy.call_method1(intern!(py, "ascontiguousarray"), (array, "f8"))?;
    Ok((doubles.cast_into::<PyArrayDyn<f64>>()?, single))
}

/// What stands in an array, as long as it is worked with: of one pose a copy, which takes less time than NumPy's book of
/// who reads what.
pub enum Values<'py> {
    Copied(Vec<f64>),
    Read(PyReadonlyArrayDyn<'py, f64>),
}

impl<'py> Values<'py> {
    pub fn of(array: &Numbers<'py>) -> PyResult<Values<'py>> {
        Ok(match array.ndim() {
            1 => Values::Copied(array.to_vec()?),
            _ => Values::Read(array.try_readonly()?),
        })
    }

    pub fn numbers(&self) -> PyResult<&[f64]> {
        Ok(match self {
            Values::Copied(values) => values,
            Values::Read(array) => array.as_slice()?,
        })
    }
}

/// The dimensions before the last, which is to be `size`.
pub fn lead(name: &str, array: &Numbers<'_>, size: usize) -> PyResult<Vec<usize>> {
    match array.shape() {
        [lead @ .., last] if *last == size => Ok(lead.to_vec()),
        found => Err(PyValueError::new_err(format!(
            "{name}: found the shape {}, expected ({size},) or (batch, {size})",
            shape(found)
        ))),
    }
}

/// As Python writes it.
pub fn shape(dimensions: &[usize]) -> String {
    let each: Vec<String> = dimensions.iter().map(usize::to_string).collect();
    let comma = if dimensions.len() == 1 { "," } else { "" };
    format!("({}{comma})", each.join(", "))
}

/// How an output's block becomes an array: dimensions of one pose as kernels write them, column after column, and
/// whether the last two change places for Python, where rows come first.
pub struct Shape {
    written: IxDyn,
    swapped: bool,
    /// Blocks of twelve numbers become homogeneous matrices of sixteen.
    homogeneous: bool,
}

impl Shape {
    /// Of an output of an arm of `n` joints.
    pub fn of(output: Output, n: usize) -> Shape {
        let (rows, columns) = output.shape(n);
        let plain = |written: &[usize]| Shape {
            written: IxDyn(written),
            swapped: false,
            homogeneous: false,
        };
        match output.form() {
            Form::Vector if rows == 1 => plain(&[]),
            Form::Vector => plain(&[rows]),
            Form::Matrix => Shape { swapped: true, ..plain(&[columns, rows]) },
            Form::Stack => {
                let each = output.columns().each().count(n);
                Shape { swapped: true, ..plain(&[columns / each, each, rows]) }
            }
            Form::Pose => Shape { homogeneous: true, ..plain(&[4, 4]) },
            Form::Poses => Shape { homogeneous: true, ..plain(&[columns / 4, 4, 4]) },
        }
    }

    /// The array that a user sees, made of what `fill` writes: the blocks of all poses, one after the other. Single
    /// precision, asked for or that of `out`, is what doubles are rounded to.
    ///
    /// `place` are the dimensions of the batch and the numbers of a block. What `fill` returns is raised when what it
    /// wrote is in place.
    ///
    /// # Errors
    /// `TypeError` and `ValueError` of an `out` that does not fit, and those of `fill`, of which nothing is written.
    pub fn fill<'py>(
        &self,
        py: Python<'py>,
        place: (&[usize], usize),
        out: Option<&Bound<'py, PyAny>>,
        single: bool,
        fill: impl FnOnce(&mut [f64]) -> PyResult<Option<PyErr>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let rounded = out.filter(|out| !out.is_instance_of::<PyArrayDyn<f64>>());
        let rounded = rounded.and_then(|out| out.cast::<PyArrayDyn<f32>>().ok());
        if let Some(array) = rounded {
            fits(array.shape(), &self.seen(place.0))?;
        }
        let (doubles, raised) = self.doubles(py, place, out.filter(|_| rounded.is_none()), fill)?;
        let found = match (out, rounded) {
            (Some(out), Some(_)) => {
                let numpy = py.import(intern!(py, "numpy"))?;
                numpy.call_method1(intern!(py, "copyto"), (out, doubles))?;
                out.clone()
            }
            (None, _) if single => doubles.call_method1(intern!(py, "astype"), ("f4",))?,
            _ => doubles.into_any(),
        };
        raised.map_or(Ok(found), Err)
    }

    /// The dimensions that a user sees.
    fn seen(&self, lead: &[usize]) -> Vec<usize> {
        let mut seen = [lead, self.written.slice()].concat();
        if let (true, [.., a, b]) = (self.swapped, &mut seen[..]) {
            std::mem::swap(a, b);
        }
        seen
    }

    fn doubles<'py>(
        &self,
        py: Python<'py>,
        (lead, size): (&[usize], usize),
        out: Option<&Bound<'py, PyAny>>,
        fill: impl FnOnce(&mut [f64]) -> PyResult<Option<PyErr>>,
    ) -> PyResult<(Numbers<'py>, Option<PyErr>)> {
        if lead.is_empty() && !(self.swapped && self.written.ndim() > 2) {
            return Ok((self.one(py, size, out, fill)?, None));
        }
        let written = [lead, self.written.slice()].concat();
        let mut axes: Vec<usize> = (0..written.len()).collect();
        if self.swapped {
            axes.swap(written.len() - 1, written.len() - 2);
        }
        let array = match out {
            None => {
                let array = PyArrayDyn::<f64>::zeros(py, written, false);
                if self.swapped { array.permute(Some(axes.clone()))? } else { array }
            }
            Some(out) => ours(out, &self.seen(lead))?,
        };
        let as_written = if self.swapped { array.permute(Some(axes))? } else { array.clone() };
        let mut target = writable(&as_written)?;
        // A slice lies in Fortran's order, too.
        let raised = match target.as_slice_mut() {
            Ok(slice) if !self.homogeneous && as_written.is_c_contiguous() => fill(slice)?,
            _ => {
                let poses: usize = lead.iter().product();
                let mut blocks = vec![0.0; poses * size];
                let raised = fill(&mut blocks)?;
                if self.homogeneous {
                    blocks = homogeneous(&blocks);
                }
                // NumPy's strides of nothing are none that ndarray takes.
                if poses > 0 {
                    let view = ArrayViewD::from_shape(IxDyn(as_written.shape()), &blocks);
                    let view = view.map_err(|error| PyValueError::new_err(error.to_string()))?;
                    target.as_array_mut().assign(&view);
                }
                raised
            }
        };
        drop(target);
        Ok((array, raised))
    }

    /// Of one pose, where a call costs more than what it computes: nothing is made but the result.
    fn one<'py>(
        &self,
        py: Python<'py>,
        size: usize,
        out: Option<&Bound<'py, PyAny>>,
        fill: impl FnOnce(&mut [f64]) -> PyResult<Option<PyErr>>,
    ) -> PyResult<Numbers<'py>> {
        let (mut small, mut large) = ([0.0; SMALL], Vec::new());
        let block = match small.get_mut(..size) {
            Some(block) => block,
            None => {
                large.resize(size, 0.0);
                &mut large
            }
        };
        if let Some(raised) = fill(block)? {
            return Err(raised);
        }
        let matrices = if self.homogeneous { homogeneous(block) } else { Vec::new() };
        let block = if self.homogeneous { &matrices } else { &*block };
        match *self.written.slice() {
            [rows] => placed(py, ArrayView::from_shape(rows, block), out),
            // A matrix that is written column by column lies in Fortran's order.
            [first, second] => {
                let seen = if self.swapped { (second, first) } else { (first, second) };
                placed(py, ArrayView::from_shape(seen.set_f(self.swapped), block), out)
            }
            _ => placed(py, ArrayView::from_shape(self.written.clone(), block), out),
        }
    }
}

/// A new array of these numbers, or that of a user, in which they are put.
fn placed<'py, D: Dimension>(
    py: Python<'py>,
    view: Result<ArrayView<'_, f64, D>, ShapeError>,
    out: Option<&Bound<'py, PyAny>>,
) -> PyResult<Numbers<'py>> {
    let view = view.map_err(|error| PyValueError::new_err(error.to_string()))?;
    let Some(out) = out else {
        return Ok(view.to_pyarray(py).to_dyn().clone());
    };
    let array = ours(out, view.shape())?;
    let mut target = writable(&array)?;
    let alike = array.is_c_contiguous() == view.is_standard_layout();
    if let (true, Some(numbers), Ok(slice)) =
        (alike, view.as_slice_memory_order(), target.as_slice_mut())
    {
        slice.copy_from_slice(numbers);
    } else {
        target.as_array_mut().assign(&view);
    }
    Ok(array)
}

/// The array that a user wants the result in.
fn ours<'py>(out: &Bound<'py, PyAny>, expected: &[usize]) -> PyResult<Numbers<'py>> {
    let array = out
        .cast::<PyArrayDyn<f64>>()
        .map_err(|_| PyTypeError::new_err("out: expected an array of numpy.float64 or float32"))?;
    fits(array.shape(), expected)?;
    Ok(array.clone())
}

fn writable<'py>(array: &Numbers<'py>) -> PyResult<PyReadwriteArrayDyn<'py, f64>> {
    array.try_readwrite().map_err(|_| {
        PyValueError::new_err("out: found an array that cannot be written to, or is being read")
    })
}

fn fits(found: &[usize], expected: &[usize]) -> PyResult<()> {
    if found == expected {
        return Ok(());
    }
    let (found, expected) = (shape(found), shape(expected));
    Err(PyValueError::new_err(format!("out: found the shape {found}, expected {expected}")))
}

/// Columns x, y, z, origin of three numbers each as matrices of four rows, row by row.
fn homogeneous(blocks: &[f64]) -> Vec<f64> {
    let matrix = |block: &[f64]| -> [f64; 16] {
        core::array::from_fn(|at| match (at / 4, at % 4) {
            (3, 3) => 1.0,
            (3, _) => 0.0,
            (row, column) => block[3 * column + row],
        })
    };
    let mut matrices = Vec::with_capacity(blocks.len() / 12 * 16);
    blocks.chunks_exact(12).for_each(|block| matrices.extend_from_slice(&matrix(block)));
    matrices
}

/// Shape and units of an output's result at one pose, in words.
pub fn described(output: Output) -> String {
    let side = |side: Side| match side {
        Side::Twist | Side::Wrench => "6",
        Side::Joints => "n",
        Side::Axes => "3",
        Side::Entries => "4 n + 6",
        Side::Moments => "10 n",
        _ => "4",
    };
    let (rows, columns) = (side(output.rows()), output.columns());
    let shape = match output.form() {
        Form::Vector if output.rows() == Side::One => "()".to_owned(),
        Form::Vector => format!("({rows},)"),
        Form::Stack => format!("(n, {rows}, {})", side(columns.each())),
        Form::Pose => "(4, 4)".to_owned(),
        Form::Poses => "(n, 4, 4)".to_owned(),
        _ => format!("({rows}, {})", side(columns)),
    };
    format!("{shape}; {}", output.units().join(", "))
}
