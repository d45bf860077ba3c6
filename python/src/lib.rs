//! The extension module `stiffarm._native`: arms on NumPy's arrays, and the commands of stiffarm run inside
//! Python. What users see of it is in `stiffarm/`.
#![deny(unsafe_code)]

mod arm;
mod arrays;
mod compiled;
mod diagnosis;
mod effect;
mod engine;
mod inverse;
mod log_effect;
mod own;
mod work;

use pyo3::prelude::*;

#[pymodule]
mod _native {
    #[pymodule_export]
    use super::arm::{Arm, Row, outputs, robots};
    #[pymodule_export]
    use super::diagnosis::{Found, diagnose, settings};
    #[pymodule_export]
    use super::effect::{Effect, Reading};
    #[pymodule_export]
    use super::log_effect::{LogEffect, Samples};
    #[pymodule_export]
    use super::work::{Error, Unstable, run};

    #[pymodule_export]
    const VERSION: &str = env!("CARGO_PKG_VERSION");
}
