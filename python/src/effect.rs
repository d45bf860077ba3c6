//! An effect of one's own: a Python function for how a joint or a frame is moved, differentiated numerically.

use std::panic::resume_unwind;
use std::sync::{Mutex, OnceLock, PoisonError};

use nalgebra::{Matrix6xX, Vector6};
use numpy::PyArray1;
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use stiffarm_gap::effects::{Carrier, Catalogue, Parameter, Place, Quantity, Scene, Spot, Told};
use stiffarm_gap::measurement::Row;
use stiffarm_gap::simulate::{Actual, Moment, Site};
use stiffarm_kernels::generic::Arm;

use crate::work::Raised;

/// What an effect sees of a row.
#[pyclass(frozen, get_all, module = "stiffarm._native")]
pub struct Reading {
    /// Joint readings (n,), rad (m).
    q: Py<PyArray1<f64>>,
    /// Wrench on the tool (6,), N and N·m, base axes, at the tool origin.
    wrench: Py<PyArray1<f64>>,
    /// From which side each joint came to rest, -1, 0, 1; None without columns.
    direction: Option<Vec<i8>>,
    /// Temperature minus that of the first row, K.
    warming: f64,
    /// Seconds from the start; None without a column.
    time: Option<f64>,
    /// Number of the row, from 0.
    index: usize,
    /// The joint or link that is asked of, from 1; 0 of base and tool.
    number: usize,
}

/// An effect of one's own.
#[pyclass(frozen, module = "stiffarm._native")]
pub struct Effect {
    name: String,
    place: String,
    parameters: Vec<(String, String)>,
    change: Py<PyAny>,
    made: OnceLock<&'static Own>,
}

/// The same for the catalogue, where it lives as long as the program.
struct Own {
    name: &'static str,
    at: At,
    parameters: Vec<Parameter>,
    change: Py<PyAny>,
    raised: Mutex<Option<PyErr>>,
}

/// What is moved.
#[derive(Clone, Copy, PartialEq, Eq)]
enum At {
    Joint,
    Link,
    Base,
    Tool,
}

#[pymethods]
impl Effect {
    /// `place`: joint, link, base or tool; `parameters`: names and SI units; `change(reading, values)`: rad (m) of a
    /// joint, else a displacement of six, zero where all values are.
    #[new]
    fn new(
        name: String,
        place: String,
        parameters: Vec<(String, String)>,
        change: Py<PyAny>,
        py: Python<'_>,
    ) -> PyResult<Effect> {
        if !change.bind(py).is_callable() {
            return Err(PyTypeError::new_err("change: expected a function of a row and of values"));
        }
        at(&place)?;
        if parameters.is_empty() {
            return Err(PyValueError::new_err("parameters: found none, expected at least one"));
        }
        parameters.iter().try_for_each(|(_, unit)| quantity(unit).map(|_| ()))?;
        Ok(Effect { name, place, parameters, change, made: OnceLock::new() })
    }
}

impl Effect {
    /// The catalogue with the effect in it.
    ///
    /// # Errors
    /// `ValueError` if the catalogue has one of that name.
    pub fn join(this: &Bound<'_, Effect>, catalogue: Catalogue) -> PyResult<Catalogue> {
        let effect = this.get();
        if catalogue.named(&effect.name).is_some() {
            let name = &effect.name;
            return Err(PyValueError::new_err(format!(
                "found two effects called `{name}`, expected one"
            )));
        }
        if let Some(own) = effect.made.get() {
            return Ok(catalogue.with(*own));
        }
        let parameters = effect.parameters.iter().map(|(name, unit)| {
            let key: &'static str = Box::leak(name.clone().into_boxed_str());
            Ok(Parameter::free(key, quantity(unit)?))
        });
        let own = Own {
            name: Box::leak(effect.name.clone().into_boxed_str()),
            at: at(&effect.place)?,
            parameters: parameters.collect::<PyResult<_>>()?,
            change: effect.change.clone_ref(this.py()),
            raised: Mutex::new(None),
        };
        // Findings name their effects as long as there are any; each is made once.
        Ok(catalogue.with(*effect.made.get_or_init(|| Box::leak(Box::new(own)))))
    }

    /// What the function raised, if it did.
    ///
    /// # Errors
    /// Just that.
    pub fn raised(&self) -> PyResult<()> {
        let raised = |own: &&Own| own.raised.lock().unwrap_or_else(PoisonError::into_inner).take();
        self.made.get().and_then(raised).map_or(Ok(()), Err)
    }
}

fn at(place: &str) -> PyResult<At> {
    match place {
        "joint" => Ok(At::Joint),
        "link" => Ok(At::Link),
        "base" => Ok(At::Base),
        "tool" => Ok(At::Tool),
        other => Err(PyValueError::new_err(format!(
            "place: found `{other}`, expected one of joint, link, base, tool"
        ))),
    }
}

fn quantity(unit: &str) -> PyResult<Quantity> {
    let found = Quantity::ALL.iter().copied().find(|quantity| quantity.unit() == unit);
    found.ok_or_else(|| {
        let known: Vec<&str> = Quantity::ALL.iter().map(|quantity| quantity.unit()).collect();
        let known = known.join(", ");
        PyValueError::new_err(format!(
            "parameters: found the unit `{unit}`, expected one of {known}"
        ))
    })
}

impl Own {
    /// How a joint (one number), or a frame (six), is moved.
    fn moved(&self, row: &Row, when: &Moment, spot: Spot, values: &[f64]) -> Vec<f64> {
        let called = Python::attach(|py| -> PyResult<Vec<f64>> {
            let number = match spot.place {
                Place::Joint(number) | Place::Link(number) => number,
                _ => 0,
            };
            let reading = Reading {
                q: PyArray1::from_slice(py, &row.q).unbind(),
                wrench: PyArray1::from_slice(py, row.wrench.as_slice()).unbind(),
                direction: row.direction.clone(),
                warming: when.warming,
                time: row.time,
                index: when.index,
                number,
            };
            let found = self.change.bind(py).call1((reading, PyArray1::from_slice(py, values)))?;
            let numbers = match self.at {
                At::Joint => vec![found.extract::<f64>()?],
                _ => found.try_iter()?.map(|x| x?.extract()).collect::<PyResult<Vec<f64>>>()?,
            };
            let expected = if self.at == At::Joint { 1 } else { 6 };
            if numbers.len() != expected || !numbers.iter().all(|x| x.is_finite()) {
                return Err(PyValueError::new_err(format!(
                    "{}: found {numbers:?}, expected {expected} finite numbers",
                    self.name
                )));
            }
            Ok(numbers)
        });
        called.unwrap_or_else(|error| {
            let mut raised = self.raised.lock().unwrap_or_else(PoisonError::into_inner);
            raised.get_or_insert(error);
            drop(raised);
            resume_unwind(Box::new(Raised))
        })
    }

    /// Its differences by each parameter about no effect, over a step of what is typical of it: exact of what is
    /// linear, and of second order else.
    fn slopes(&self, scene: &Scene<'_>, spot: Spot) -> impl Iterator<Item = Vec<f64>> {
        self.parameters.iter().enumerate().map(move |(k, parameter)| {
            let step = parameter.quantity.typical();
            let [ahead, behind] = [step, -step].map(|step| {
                let mut values = vec![0.0; self.parameters.len()];
                values[k] = step;
                self.moved(scene.row, scene.when, spot, &values)
            });
            ahead.iter().zip(behind).map(|(a, b)| (a - b) / (2.0 * step)).collect()
        })
    }

    fn site(&self, spot: Spot) -> Site {
        match self.at {
            At::Joint => Site::Joint(spot.row()),
            At::Link => Site::Link(spot.row()),
            At::Base => Site::Base,
            At::Tool => Site::Tool,
        }
    }
}

impl stiffarm_gap::effects::Effect for Own {
    fn identifier(&self) -> &'static str {
        self.name
    }

    fn places(&self, arm: &Arm) -> Vec<Place> {
        match self.at {
            At::Joint => (1..=arm.dof()).map(Place::Joint).collect(),
            At::Link => (1..=arm.dof()).map(Place::Link).collect(),
            At::Base => vec![Place::Base],
            At::Tool => vec![Place::Tool],
        }
    }

    fn parameters(&self, _: &Arm, _: Spot) -> Vec<Parameter> {
        self.parameters.clone()
    }

    fn alter(&self, actual: &mut Actual<'_>, row: &Row, when: &Moment, spot: Spot, values: &[f64]) {
        let moved = self.moved(row, when, spot, values);
        match self.at {
            At::Joint => actual.turn(spot.row(), moved[0]),
            _ => *actual.fixed_at(self.site(spot)) += Vector6::from_column_slice(&moved),
        }
    }

    fn carrier(&self, spot: Spot) -> Option<Carrier> {
        (self.at == At::Joint).then(|| Carrier::Joint(spot.row()))
    }

    fn motions(&self, scene: &Scene<'_>, spot: Spot, motions: &mut Vec<f64>) {
        if self.at == At::Joint {
            motions.extend(self.slopes(scene, spot).flatten());
        }
    }

    fn block(&self, scene: &Scene<'_>, spot: Spot) -> Matrix6xX<f64> {
        if self.at == At::Joint {
            let motions: Vec<f64> = self.slopes(scene, spot).flatten().collect();
            return scene.moved(self.carrier(spot), &motions);
        }
        let slopes: Vec<_> =
            self.slopes(scene, spot).map(|slope| Vector6::from_column_slice(&slope)).collect();
        scene.carried(self.site(spot), &slopes)
    }

    fn idle(&self) -> &'static str {
        "its function is zero at every row"
    }

    fn sentence(&self, told: &Told<'_>) -> String {
        format!("{} at {}", self.name.replace('_', " "), told.place)
    }
}
