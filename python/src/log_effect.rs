//! An effect of one's own on a joint in motion: a Python function for how a log's rows change, differentiated
//! numerically.

use std::sync::OnceLock;

use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use stiffarm_gap::effects::{Facts, InMotion, Law, Parameter, Quantity, Spot};
use stiffarm_gap::log::Domain;
use stiffarm_gap::log::effects::Catalogue;
use stiffarm_gap::log::scene::{Column, Scene};

use crate::arrays::numbers;
use crate::own::{Function, checked, kept, twice};

/// The part of a number by which it is changed to differentiate: central differences leave out its square, 1e-10, and
/// lose an eps of it, 1e-11, by rounding.
const STEP: f64 = 1e-5;

/// The part of itself by which what should be in proportion may differ: the rounding of a function in single
/// precision, 6e-8, over the few terms that are compared.
const IN_PROPORTION: f64 = 1e-6;

/// What an effect sees of a stretch of a log: m samples at even steps, low-passed.
#[pyclass(frozen, get_all, module = "stiffarm._native")]
pub struct Samples {
    /// s, since the run's first sample, (m,).
    t: Py<PyArray1<f64>>,
    /// Joint values (m, n), rad (m).
    q: Py<PyArray2<f64>>,
    /// Their rates (m, n).
    qd: Py<PyArray2<f64>>,
    /// Their accelerations (m, n).
    qdd: Py<PyArray2<f64>>,
    /// What rigid links ask of the joints by a simple fit (m, n), N·m (N, A); zero of position rows.
    load: Py<PyArray2<f64>>,
    /// The joint that is asked of, from 1.
    number: usize,
}

/// An effect of one's own on joints in motion.
#[pyclass(frozen, module = "stiffarm._native")]
pub struct LogEffect {
    /// What findings call it.
    #[pyo3(get)]
    name: String,
    domain: Domain,
    parameters: Vec<(String, String)>,
    change: Py<PyAny>,
    about: Vec<Vec<f64>>,
    made: OnceLock<&'static Own>,
}

/// The same for the catalogue, where it lives as long as the program.
struct Own {
    function: Function,
    facts: Facts,
    /// Values about which it is sought; none where it is in proportion to them.
    about: Vec<Vec<f64>>,
}

#[pymethods]
impl LogEffect {
    /// `rows`: torque or position; `parameters`: names and units; `change(samples, values)`: (m,), how what drives the
    /// joint, or where it is, changes, zero where all values are; `about`: values about which it is sought, if it is
    /// not in proportion to them.
    #[new]
    #[pyo3(signature = (name, rows, parameters, change, about=Vec::new()))]
    fn new(
        name: String,
        rows: &str,
        parameters: Vec<(String, String)>,
        change: Py<PyAny>,
        about: Vec<Vec<f64>>,
        py: Python<'_>,
    ) -> PyResult<LogEffect> {
        checked(change.bind(py), &parameters)?;
        let domain = match rows {
            "torque" => Domain::Torque,
            "position" => Domain::Position,
            other => {
                let message = format!("rows: found `{other}`, expected torque or position");
                return Err(PyValueError::new_err(message));
            }
        };
        let count = parameters.len();
        let fits =
            |values: &Vec<f64>| values.len() == count && values.iter().all(|x| x.is_finite());
        if let Some(wrong) = about.iter().find(|values| !fits(values)) {
            let message = format!("about: found {wrong:?}, expected {count} finite numbers");
            return Err(PyValueError::new_err(message));
        }
        Ok(LogEffect { name, domain, parameters, change, about, made: OnceLock::new() })
    }
}

impl LogEffect {
    /// The catalogue with the effect in it.
    pub fn join(&self, py: Python<'_>, catalogue: Catalogue) -> PyResult<Catalogue> {
        if catalogue.named(&self.name).is_some() {
            return Err(twice(&self.name));
        }
        // Each is made once.
        let own = self.made.get_or_init(|| {
            let function = Function::new(py, &self.name, &self.change);
            let parameters = self.parameters.iter();
            let parameters: Vec<Parameter> = parameters
                .map(|(name, unit)| Parameter::free(kept(name), Quantity::In(kept(unit))))
                .collect();
            let facts = Facts {
                identifier: function.name,
                reality: "An effect of one's own.",
                separated_by: "Motion in which its own function differs from the others.",
                parameters: Box::leak(parameters.into_boxed_slice()),
                rows: Some(self.domain),
                bends: !self.about.is_empty(),
                ..Facts::NONE
            };
            Box::leak(Box::new(Own { function, facts, about: self.about.clone() }))
        });
        Ok(catalogue.with(*own))
    }

    /// What the function raised, if it did.
    pub fn raised(&self) -> PyResult<()> {
        self.made.get().map_or(Ok(()), |own| own.function.raised())
    }
}

impl Samples {
    fn of(py: Python<'_>, scene: &Scene<'_>, joint: usize) -> PyResult<Samples> {
        let signals = scene.signals;
        let (count, n) = (signals.t.len(), signals.joints());
        let table = |of: &[Vec<f64>]| -> PyResult<Py<PyArray2<f64>>> {
            let at = |k: usize, joint: usize| of.get(joint).map_or(0.0, |rows| rows[k]);
            let flat = (0..count).flat_map(|k| (0..n).map(move |joint| (k, joint)));
            let flat: Vec<f64> = flat.map(|(k, joint)| at(k, joint)).collect();
            Ok(PyArray1::from_vec(py, flat).reshape([count, n])?.unbind())
        };
        Ok(Samples {
            t: PyArray1::from_slice(py, &signals.t).unbind(),
            q: table(&signals.q)?,
            qd: table(&signals.qd)?,
            qdd: table(&signals.qdd)?,
            load: table(&scene.loads.rigid)?,
            number: joint + 1,
        })
    }
}

impl Own {
    /// What the function gives at all fine samples for each of some values.
    fn changes(&self, scene: &Scene<'_>, joint: usize, each: &[Vec<f64>]) -> Vec<Vec<f64>> {
        self.function.ask(|py, change| {
            let samples = Bound::new(py, Samples::of(py, scene, joint)?)?;
            let of = |values: &Vec<f64>| {
                let found = change.call1((&samples, PyArray1::from_slice(py, values)))?;
                let rows = numbers(self.function.name, &found)?.0.to_vec()?;
                self.function.finite(&rows, scene.signals.t.len())?;
                Ok(rows)
            };
            each.iter().map(of).collect()
        })
    }

    /// By how much a number is changed to differentiate about some values.
    fn step(&self, values: &[f64], k: usize) -> f64 {
        if self.about.is_empty() {
            return 1.0;
        }
        let typical = self.about.iter().map(|about| about[k].abs()).fold(0.0, f64::max);
        let size = [values[k].abs(), typical].into_iter().find(|size| *size > 0.0);
        STEP * size.unwrap_or(1.0)
    }

    /// Whether a number is about where it was sought: within twice of what was given, where something was. Beyond, steps
    /// along straight lines have led astray.
    fn is_near(&self, k: usize, value: f64) -> bool {
        let given = || self.about.iter().map(|about| about[k]);
        if given().all(|x| x == 0.0) {
            return true;
        }
        let (low, high) = given()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
        let wider = |end: f64, outwards: bool| if outwards { 2.0 * end } else { 0.5 * end };
        (wider(low, low < 0.0)..=wider(high, high > 0.0)).contains(&value)
    }

    /// Differences by each number about some values, at all fine samples.
    fn slopes(&self, scene: &Scene<'_>, joint: usize, values: &[f64]) -> Vec<Vec<f64>> {
        let count = self.facts.parameters.len();
        let from = if self.about.is_empty() { vec![0.0; count] } else { values.to_vec() };
        let steps: Vec<f64> = (0..count).map(|k| self.step(&from, k)).collect();
        let moved = |k: usize, by: f64| {
            let mut values = from.clone();
            values[k] += by;
            values
        };
        let mut asked: Vec<Vec<f64>> =
            (0..count).flat_map(|k| [moved(k, steps[k]), moved(k, -steps[k])]).collect();
        let doubled: Vec<f64> = steps.iter().map(|step| 2.0 * step).collect();
        if self.about.is_empty() {
            asked.push(doubled.clone());
        }
        let rows = self.changes(scene, joint, &asked);
        let slopes: Vec<Vec<f64>> = (0..count)
            .map(|k| {
                let pairs = rows[2 * k].iter().zip(&rows[2 * k + 1]);
                pairs.map(|(ahead, behind)| (ahead - behind) / (2.0 * steps[k])).collect()
            })
            .collect();
        if self.about.is_empty() {
            self.function.ask(|_, _| self.in_proportion(&slopes, &doubled, &rows[2 * count]));
        }
        slopes
    }

    /// Refuses what is not in proportion to its numbers: where these are `values` it is to be `rows`.
    fn in_proportion(&self, slopes: &[Vec<f64>], values: &[f64], rows: &[f64]) -> PyResult<()> {
        let sum = |k: usize| slopes.iter().zip(values).map(|(slope, x)| slope[k] * x).sum::<f64>();
        let size = |k: usize| {
            let parts = slopes.iter().zip(values).map(|(slope, x)| (slope[k] * x).abs());
            parts.sum::<f64>().max(rows[k].abs())
        };
        let off = (0..rows.len()).map(|k| (sum(k) - rows[k]).abs()).fold(0.0, f64::max);
        let most = (0..rows.len()).map(size).fold(0.0, f64::max);
        if off <= IN_PROPORTION * most {
            return Ok(());
        }
        Err(PyValueError::new_err(format!(
            "{}: found a change that is not in proportion to its numbers, or not zero where they are: give about=[…], \
             values about which they are sought",
            self.function.name
        )))
    }
}

impl Law for Own {
    fn facts(&self) -> &Facts {
        &self.facts
    }
}

impl InMotion for Own {
    fn columns(&self, scene: &Scene<'_>, spot: Spot, values: &[f64]) -> Vec<Column> {
        let joint = spot.row();
        let slopes = self.slopes(scene, joint, values);
        slopes.iter().map(|slope| scene.column(joint, |k| slope[k])).collect()
    }

    fn value(&self, scene: &Scene<'_>, spot: Spot, values: &[f64]) -> Column {
        let joint = spot.row();
        let rows = self.changes(scene, joint, &[values.to_vec()]);
        scene.column(joint, |k| rows[0][k])
    }

    fn is_feasible(&self, values: &[f64]) -> bool {
        values.iter().enumerate().all(|(k, value)| self.is_near(k, *value))
    }

    fn probes(&self, _: &Scene<'_>, _: Spot) -> Vec<Vec<f64>> {
        match self.bends() {
            true => self.about.clone(),
            false => vec![vec![0.0; self.facts.parameters.len()]],
        }
    }
}
