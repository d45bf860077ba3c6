//! A diagnosis that Python holds.

use std::collections::HashMap;

use nalgebra::Vector6;
use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use stiffarm_cli::inside::Host;
use stiffarm_cli::{Campaign, Format, diagnose_inside};
use stiffarm_gap::effects::Catalogue;

use crate::effect::Effect;
use crate::work::{error, wait};

/// What a diagnosis found.
#[pyclass(frozen, module = "stiffarm._native")]
pub struct Found(stiffarm_cli::Found);

/// Gaps of rows before and after, and whether a row is within what was diagnosed.
type Predicted<'py> =
    (Bound<'py, PyArray2<f64>>, Bound<'py, PyArray2<f64>>, Bound<'py, PyArray1<bool>>);

#[pymethods]
impl Found {
    /// The diagnosis in JSON, as the command line writes it.
    fn json(&self, py: Python<'_>) -> PyResult<String> {
        let text = py.detach(|| self.0.json());
        text.map_err(|failure| error(py, &failure))
    }

    /// The page in HTML.
    fn page(&self, py: Python<'_>) -> PyResult<String> {
        let page = py.detach(|| self.0.page());
        page.map_err(|failure| error(py, &failure))
    }

    /// As it stands on a screen.
    fn text(&self, py: Python<'_>) -> String {
        py.detach(|| self.0.text())
    }

    /// The robot file with what was found; None of a log of currents.
    fn corrected(&self, py: Python<'_>) -> Option<String> {
        py.detach(|| self.0.corrected().ok())
    }

    /// The corrected arm as a URDF or an MJCF, and a sentence on what it has no place for.
    fn exported(&self, py: Python<'_>, mjcf: bool) -> PyResult<(String, Option<String>)> {
        let format = if mjcf { Format::Mjcf } else { Format::Urdf };
        let text = py.detach(|| self.0.exported(format));
        text.map_err(|failure| error(py, &failure))
    }

    /// Measured minus predicted of other rows, (m, 6), before and after; and whether each row lies within what was
    /// diagnosed, (m,). None of a log.
    fn predict<'py>(
        &self,
        py: Python<'py>,
        name: &str,
        bytes: &[u8],
    ) -> PyResult<Option<Predicted<'py>>> {
        let Some(found) = self.campaign() else { return Ok(None) };
        let predicted = py.detach(|| found.predict(name, bytes));
        let predicted = predicted.map_err(|failure| error(py, &failure))?;
        let rows = |gaps: &[Vector6<f64>]| {
            let flat: Vec<f64> = gaps.iter().flat_map(|gap| gap.iter().copied()).collect();
            PyArray1::from_vec(py, flat).reshape([gaps.len(), 6])
        };
        let inside = PyArray1::from_vec(py, predicted.inside);
        Ok(Some((rows(&predicted.before)?, rows(&predicted.after)?, inside)))
    }
}

impl Found {
    fn campaign(&self) -> Option<&Campaign> {
        match &self.0 {
            stiffarm_cli::Found::Campaign(found) => Some(found),
            stiffarm_cli::Found::Motion(_) | stiffarm_cli::Found::Together(_) => None,
        }
    }
}

/// Diagnoses as the words say, the first of which is `diagnose`, with effects of one's own.
#[pyfunction]
pub fn diagnose(
    py: Python<'_>,
    words: Vec<String>,
    files: HashMap<String, Vec<u8>>,
    own: Vec<Py<Effect>>,
    hear: &Bound<'_, PyAny>,
) -> PyResult<Found> {
    let host = Host::new(words, files);
    let mut catalogue = Catalogue::default();
    for effect in &own {
        catalogue = Effect::join(effect.bind(py), catalogue)?;
    }
    let found = wait(py, &host, hear, |_, _| {}, move |host| diagnose_inside(host, catalogue));
    // What an effect raised is why there is no diagnosis, whatever it looked like from outside.
    own.iter().try_for_each(|effect| effect.get().raised())?;
    found.map(Found)
}
