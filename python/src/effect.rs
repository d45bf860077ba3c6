//! An effect of one's own: a Python function for how a joint or a frame is moved, differentiated numerically.

use std::sync::OnceLock;

use nalgebra::{Matrix6xX, Vector6};
use numpy::PyArray1;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use stiffarm_gap::effects::{
    At, AtRest, Catalogue, Facts, Law, Moves, Parameter, Place, Quantity, Scene, Spot,
};
use stiffarm_gap::measurement::Row;
use stiffarm_gap::simulate::{Actual, Moment, Site};
use stiffarm_kernels::generic::Arm;

use crate::own::{Function, checked, kept, twice};

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
    /// What findings call it.
    #[pyo3(get)]
    name: String,
    place: String,
    parameters: Vec<(String, String)>,
    change: Py<PyAny>,
    made: OnceLock<&'static Own>,
}

/// The same for the catalogue, where it lives as long as the program.
struct Own {
    function: Function,
    facts: Facts,
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
        checked(change.bind(py), &parameters)?;
        at(&place)?;
        parameters.iter().try_for_each(|(_, unit)| quantity(unit).map(|_| ()))?;
        Ok(Effect { name, place, parameters, change, made: OnceLock::new() })
    }
}

impl Effect {
    /// The catalogue with the effect in it.
    pub fn join(&self, py: Python<'_>, catalogue: Catalogue) -> PyResult<Catalogue> {
        if catalogue.named(&self.name).is_some() {
            return Err(twice(&self.name));
        }
        if let Some(own) = self.made.get() {
            return Ok(catalogue.with(*own));
        }
        let parameters = self
            .parameters
            .iter()
            .map(|(name, unit)| Ok(Parameter::free(kept(name), quantity(unit)?)));
        let parameters: Vec<Parameter> = parameters.collect::<PyResult<_>>()?;
        let function = Function::new(py, &self.name, &self.change);
        let at = at(&self.place)?;
        let facts = Facts {
            identifier: function.name,
            parameters: Box::leak(parameters.into_boxed_slice()),
            at,
            moves: if at == At::Joints { Moves::Joint } else { Moves::Several },
            idle: "its function is zero at every row",
            ..Facts::NONE
        };
        let own = Own { function, facts };
        // Each is made once.
        Ok(catalogue.with(*self.made.get_or_init(|| Box::leak(Box::new(own)))))
    }

    /// What the function raised, if it did.
    pub fn raised(&self) -> PyResult<()> {
        self.made.get().map_or(Ok(()), |own| own.function.raised())
    }
}

fn at(place: &str) -> PyResult<At> {
    match place {
        "joint" => Ok(At::Joints),
        "link" => Ok(At::Links),
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
        self.function.ask(|py, change| {
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
            let found = change.call1((reading, PyArray1::from_slice(py, values)))?;
            let numbers = match self.facts.at {
                At::Joints => vec![found.extract::<f64>()?],
                _ => found.try_iter()?.map(|x| x?.extract()).collect::<PyResult<Vec<f64>>>()?,
            };
            self.function.finite(&numbers, if self.facts.at == At::Joints { 1 } else { 6 })?;
            Ok(numbers)
        })
    }

    /// Its differences by each parameter about no effect, over a step of what is typical of it: exact of what is
    /// linear, and of second order else.
    fn slopes(&self, scene: &Scene<'_>, spot: Spot) -> impl Iterator<Item = Vec<f64>> {
        self.facts.parameters.iter().enumerate().map(move |(k, parameter)| {
            let step = parameter.quantity.typical();
            let [ahead, behind] = [step, -step].map(|step| {
                let mut values = vec![0.0; self.facts.parameters.len()];
                values[k] = step;
                self.moved(scene.row, scene.when, spot, &values)
            });
            ahead.iter().zip(behind).map(|(a, b)| (a - b) / (2.0 * step)).collect()
        })
    }

    fn site(&self, spot: Spot) -> Site {
        match self.facts.at {
            At::Joints => Site::Joint(spot.row()),
            At::Links => Site::Link(spot.row()),
            At::Base => Site::Base,
            _ => Site::Tool,
        }
    }
}

impl Law for Own {
    fn facts(&self) -> &Facts {
        &self.facts
    }
}

impl AtRest for Own {
    /// As they were given, of joints that shift too.
    fn parameters(&self, _: &Arm, _: Spot) -> Vec<Parameter> {
        self.facts.parameters.to_vec()
    }

    fn alter(&self, actual: &mut Actual<'_>, row: &Row, when: &Moment, spot: Spot, values: &[f64]) {
        let moved = self.moved(row, when, spot, values);
        match self.facts.at {
            At::Joints => actual.turn(spot.row(), moved[0]),
            _ => *actual.fixed_at(self.site(spot)) += Vector6::from_column_slice(&moved),
        }
    }

    fn motions(&self, scene: &Scene<'_>, spot: Spot, motions: &mut Vec<f64>) {
        if self.facts.at == At::Joints {
            motions.extend(self.slopes(scene, spot).flatten());
        }
    }

    fn block(&self, scene: &Scene<'_>, spot: Spot) -> Matrix6xX<f64> {
        if self.facts.at == At::Joints {
            let motions: Vec<f64> = self.slopes(scene, spot).flatten().collect();
            return scene.moved(self.carrier(spot), &motions);
        }
        let slopes: Vec<_> =
            self.slopes(scene, spot).map(|slope| Vector6::from_column_slice(&slope)).collect();
        scene.carried(self.site(spot), &slopes)
    }
}
