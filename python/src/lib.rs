//! The native half of the package `creepage` for Python: arguments in, strings and arrays out. What users see is the typed
//! package `python/creepage`.

mod errors;
mod export;
mod jobs;
mod model;
mod run;
mod work;

use pyo3::prelude::*;

/// The native half of the package.
#[pymodule(gil_used = false)]
mod _creepage {
    use pyo3::prelude::*;

    #[pymodule_init]
    fn init(module: &Bound<PyModule>) -> PyResult<()> {
        super::errors::declare(module.py())
    }

    #[pymodule_export]
    use super::errors::{InputError, RunError};
    #[pymodule_export]
    use super::export::export;
    #[pymodule_export]
    use super::jobs::{
        check, describe, discover, effects, fit, join_sweep, main, simulate, simulate_many, sweep, verify,
    };
    #[pymodule_export]
    use super::model::Model;
    #[pymodule_export]
    use super::run::Run;
}
