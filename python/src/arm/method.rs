//! What a method of an output is. It is Python's own call of the extension module: one in Python around [`Arm::tell`] would
//! take as long as a Jacobian.

use numpy::PyArray1;
use pyo3::prelude::*;
use stiffarm_kernels::Output;

use super::Arm;
use super::evaluate::Beside;

/// Methods of [`Arm`]: what each is told of the joints, a wrench behind a semicolon, and its output.
macro_rules! methods {
    ($($(#[$about:meta])* $name:ident($($input:ident),+ $(; $wrench:ident)?) $output:ident;)+) => {
        #[pymethods]
        impl Arm {
            $(
                $(#[$about])*
                #[pyo3(signature = ($($input,)+ $($wrench,)? *, out=None, sides=None, warming=None, at=None))]
                #[allow(clippy::too_many_arguments, reason = "they are Python's")]
                fn $name<'py>(
                    &self,
                    py: Python<'py>,
                    $($input: &Bound<'py, PyAny>,)+
                    $($wrench: Option<&Bound<'py, PyAny>>,)?
                    out: Option<&Bound<'py, PyAny>>,
                    sides: Option<&Bound<'py, PyAny>>,
                    warming: Option<f64>,
                    at: Option<String>,
                ) -> PyResult<Bound<'py, PyAny>> {
                    let wrench = None$(.or($wrench))?;
                    let beside = Beside { out, sides, warming, at };
                    self.tell(py, Output::$output, &[$($input),+], wrench, beside)
                }
            )+
        }
    };
}

pub(super) use methods;

#[pymethods]
impl Arm {
    /// Torques that hold the arm at rest under its weight, (n,): `inverse_dynamics` where nothing moves.
    #[pyo3(signature = (q, *, out=None, sides=None, warming=None, at=None))]
    fn gravity<'py>(
        &self,
        py: Python<'py>,
        q: &Bound<'py, PyAny>,
        out: Option<&Bound<'py, PyAny>>,
        sides: Option<&Bound<'py, PyAny>>,
        warming: Option<f64>,
        at: Option<String>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let still = PyArray1::from_slice(py, &vec![0.0; self.dof()]);
        let beside = Beside { out, sides, warming, at };
        self.tell(py, Output::Bias, &[q, still.as_any()], None, beside)
    }
}
