//! Effects of one's own: what those at rest and those in motion share, a function of the user's.

use std::panic::resume_unwind;
use std::sync::{Mutex, PoisonError};

use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use stiffarm_cli::Catalogues;

use crate::effect::Effect;
use crate::log_effect::LogEffect;
use crate::work::Raised;

/// An effect of one's own.
#[derive(FromPyObject)]
pub enum Own {
    /// Of measurements at rest.
    AtRest(Py<Effect>),
    /// Of joint logs.
    InMotion(Py<LogEffect>),
}

impl Own {
    /// The catalogues with the effect in one of them.
    pub fn join(&self, py: Python<'_>, catalogues: Catalogues) -> PyResult<Catalogues> {
        let Catalogues { at_rest, in_motion } = catalogues;
        Ok(match self {
            Own::AtRest(effect) => {
                Catalogues { at_rest: effect.get().join(py, at_rest)?, in_motion }
            }
            Own::InMotion(effect) => {
                Catalogues { at_rest, in_motion: effect.get().join(py, in_motion)? }
            }
        })
    }

    /// What its function raised, if it did.
    pub fn raised(&self) -> PyResult<()> {
        match self {
            Own::AtRest(effect) => effect.get().raised(),
            Own::InMotion(effect) => effect.get().raised(),
        }
    }
}

/// The function of an effect.
pub struct Function {
    /// What findings call the effect.
    pub name: &'static str,
    change: Py<PyAny>,
    raised: Mutex<Option<PyErr>>,
}

impl Function {
    /// One that lives as long as the program: findings name their effects as long as there are any.
    pub fn new(py: Python<'_>, name: &str, change: &Py<PyAny>) -> Function {
        Function { name: kept(name), change: change.clone_ref(py), raised: Mutex::new(None) }
    }

    /// Calls it. What it raises is kept, and the work is left.
    pub fn ask<T>(&self, work: impl FnOnce(Python<'_>, &Bound<'_, PyAny>) -> PyResult<T>) -> T {
        Python::attach(|py| work(py, self.change.bind(py))).unwrap_or_else(|error| {
            let mut raised = self.raised.lock().unwrap_or_else(PoisonError::into_inner);
            raised.get_or_insert(error);
            drop(raised);
            resume_unwind(Box::new(Raised))
        })
    }

    /// Refuses what are not as many finite numbers.
    pub fn finite(&self, found: &[f64], expected: usize) -> PyResult<()> {
        let finite = found.iter().filter(|x| x.is_finite()).count();
        if (found.len(), finite) == (expected, expected) {
            return Ok(());
        }
        let (name, all) = (self.name, found.len());
        Err(PyValueError::new_err(format!(
            "{name}: found {all} numbers, {finite} of them finite, expected {expected} finite ones"
        )))
    }

    /// What it raised, if it did.
    pub fn raised(&self) -> PyResult<()> {
        self.raised.lock().unwrap_or_else(PoisonError::into_inner).take().map_or(Ok(()), Err)
    }
}

/// A text as long as the program lives.
pub fn kept(text: &str) -> &'static str {
    Box::leak(text.to_owned().into_boxed_str())
}

/// Refuses what is no function, and an effect without numbers.
pub fn checked(change: &Bound<'_, PyAny>, parameters: &[(String, String)]) -> PyResult<()> {
    if !change.is_callable() {
        return Err(PyTypeError::new_err("change: expected a function"));
    }
    if parameters.is_empty() {
        return Err(PyValueError::new_err("parameters: found none, expected at least one"));
    }
    Ok(())
}

/// The exception of a catalogue that has an effect of this name.
pub fn twice(name: &str) -> PyErr {
    PyValueError::new_err(format!("found two effects called `{name}`, expected one"))
}
