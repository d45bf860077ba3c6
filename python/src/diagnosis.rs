//! A diagnosis that Python holds.

use std::any::TypeId;
use std::collections::HashMap;
use std::path::PathBuf;

use nalgebra::Vector6;
use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyTuple};
use stiffarm_cli::host::Host;
use stiffarm_cli::{Catalogues, Format, Predicted, PredictedLog, RobotArgs, Settings, TOP};
use stiffarm_gap::diagnose::Prediction;
use stiffarm_gap::log::model::{Explained, JointRows};

use crate::own::Own;
use crate::work::{error, wait};

/// What a diagnosis found.
#[pyclass(frozen, module = "stiffarm._native")]
pub struct Found {
    found: Box<dyn stiffarm_cli::Found>,
    /// Effects of one's own that it was asked for.
    own: Vec<Own>,
}

#[pymethods]
impl Found {
    /// The diagnosis in JSON, as the command line writes it.
    fn json(&self, py: Python<'_>) -> PyResult<String> {
        let text = py.detach(|| self.found.json());
        text.map_err(|failure| error(py, &failure))
    }

    /// The page in HTML.
    fn page(&self, py: Python<'_>) -> PyResult<String> {
        let page = py.detach(|| self.found.page());
        page.map_err(|failure| error(py, &failure))
    }

    /// The certificate, a PDF.
    fn certificate<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let sheet = py.detach(|| self.found.certificate().map(|document| document.pdf()));
        sheet.map(|bytes| PyBytes::new(py, &bytes)).map_err(|failure| error(py, &failure))
    }

    /// As it stands on a screen.
    fn text(&self, py: Python<'_>) -> PyResult<String> {
        let text = py.detach(|| self.found.text(TOP));
        text.map_err(|failure| error(py, &failure))
    }

    /// The robot file with what was found; None of a log of currents.
    fn corrected(&self, py: Python<'_>) -> Option<String> {
        py.detach(|| self.found.corrected().ok())
    }

    /// What has to be known of any file of the corrected arm, a sentence each.
    fn caveats(&self, py: Python<'_>) -> Vec<String> {
        py.detach(|| self.found.caveats())
    }

    /// The corrected arm as a URDF or an MJCF, and a sentence on what it has no place for.
    fn exported(&self, py: Python<'_>, mjcf: bool) -> PyResult<(String, Option<String>)> {
        let format = if mjcf { Format::Mjcf } else { Format::Urdf };
        let text = py.detach(|| self.found.exported(format));
        text.map_err(|failure| error(py, &failure))
    }

    /// Measured minus predicted of other data, before and after, and whether a row is judged: (m, 6) and (m,) of rows at
    /// rest. Of a log (m, n) each, and with them its times and runs, (m,), what was measured, joint values and rates, (m, n),
    /// and what `diagnose --check` writes, in JSON.
    fn predict<'py>(
        slf: &Bound<'py, Self>,
        paths: Vec<PathBuf>,
        files: HashMap<String, Vec<u8>>,
        hear: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyTuple>> {
        let (py, found) = (slf.py(), slf.clone().unbind());
        let host = Host::new(Vec::new(), files);
        let work = move |host: &Host| host.run(|| found.get().found.predict(&paths, host));
        let predicted = wait(py, &host, hear, |_, _| {}, work);
        slf.get().own.iter().try_for_each(Own::raised)?;
        match predicted? {
            Predicted::Rows(rows) => at_rest(py, &rows),
            Predicted::Log(log) => in_motion(py, &log),
        }
    }
}

fn at_rest<'py>(py: Python<'py>, rows: &Prediction) -> PyResult<Bound<'py, PyTuple>> {
    let table = |gaps: &[Vector6<f64>]| {
        let flat: Vec<f64> = gaps.iter().flat_map(|gap| gap.iter().copied()).collect();
        PyArray1::from_vec(py, flat).reshape([gaps.len(), 6])
    };
    let inside = PyArray1::from_slice(py, &rows.inside);
    (table(&rows.before)?, table(&rows.after)?, inside).into_pyobject(py)
}

fn in_motion<'py>(py: Python<'py>, log: &PredictedLog) -> PyResult<Bound<'py, PyTuple>> {
    let Explained { t, run, joints } = &log.explained;
    let numbers = |of: &dyn Fn(&JointRows, usize) -> f64| table(py, log, of);
    let json = log.json().map_err(|failure| error(py, &failure))?;
    let measured = numbers(&|joint, row| joint.measured[row])?;
    let motion = (numbers(&|joint, row| joint.q[row])?, numbers(&|joint, row| joint.qd[row])?);
    let left = (numbers(&JointRows::without)?, numbers(&JointRows::left)?);
    let counts = (0..t.len()).flat_map(|row| joints.iter().map(move |joint| joint.counts[row]));
    let counts = PyArray1::from_iter(py, counts).reshape([t.len(), joints.len()])?;
    let (t, run) = (PyArray1::from_slice(py, t), PyArray1::from_slice(py, run));
    (left.0, left.1, counts, t, run, measured, motion.0, motion.1, json).into_pyobject(py)
}

/// A number of each row and joint.
fn table<'py>(
    py: Python<'py>,
    log: &PredictedLog,
    of: &dyn Fn(&JointRows, usize) -> f64,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let Explained { t, joints, .. } = &log.explained;
    let flat = (0..t.len()).flat_map(|row| joints.iter().map(move |joint| of(joint, row)));
    PyArray1::from_vec(py, flat.collect()).reshape([t.len(), joints.len()])
}

/// Diagnoses the files `data` of a robot with numbers for its symbolic parameters, as the `settings` (JSON) choose, with
/// effects of one's own.
#[pyfunction]
pub fn diagnose(
    py: Python<'_>,
    named: (String, Vec<String>),
    data: Vec<String>,
    settings: &str,
    files: HashMap<String, Vec<u8>>,
    own: Vec<Own>,
    hear: &Bound<'_, PyAny>,
) -> PyResult<Found> {
    let (robot, set) = named;
    let settings = Settings::from_json(settings).map_err(|failure| error(py, &failure))?;
    // As the command line would be told the same.
    let mut words = vec!["diagnose".to_owned(), robot.clone()];
    words.extend(data.iter().cloned().chain(settings.words()));
    words.extend(set.iter().map(|one| format!("--set={one}")));
    let host = Host::new(words, files);
    let mut catalogues = Catalogues::default();
    for effect in &own {
        catalogues = effect.join(py, catalogues)?;
    }
    let robot = RobotArgs::named(&robot).set(set);
    let data: Vec<PathBuf> = data.into_iter().map(PathBuf::from).collect();
    let work = move |host: &Host| {
        host.run(|| stiffarm_cli::diagnose(&robot, &data, &settings, catalogues, host))
    };
    let found = wait(py, &host, hear, |_, _| {}, work);
    // What an effect raised is why there is no diagnosis, whatever it looked like from outside.
    own.iter().try_for_each(Own::raised)?;
    Ok(Found { found: found?, own })
}

/// Each setting of a diagnosis: its name, its type in Python, and what it is about.
#[pyfunction]
pub fn settings() -> Vec<(String, String, String)> {
    let each = Settings::arguments().into_iter().map(|option| {
        let usual = Settings::usual(&option);
        let value = option.get_value_names().map(|names| names.concat()).unwrap_or_default();
        let kind = option.get_value_parser().type_id();
        let kind = match &*value {
            _ if usual == "[]" || option.get_value_delimiter().is_some() => "Sequence[str]",
            "LENGTH" | "ANGLE" | "FREQUENCY" => "Quantity",
            "LENGTH,ANGLE" => "Union[str, tuple[Quantity, Quantity]]",
            _ if !option.get_action().takes_values() => "bool",
            _ if kind == TypeId::of::<usize>() || kind == TypeId::of::<u64>() => "int",
            _ if kind == TypeId::of::<f64>() => "float",
            _ if kind == TypeId::of::<PathBuf>() => "Path",
            _ => "str",
        };
        let kind = if usual == "null" { format!("Optional[{kind}]") } else { kind.to_owned() };
        let about = option.get_help().map(ToString::to_string).unwrap_or_default();
        (option.get_id().to_string(), kind, about)
    });
    each.collect()
}
