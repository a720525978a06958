//! Errors of the library as exceptions that carry file, line, column and advice.

use creepage::{Error, ErrorKind};
use pyo3::exceptions::{PyKeyboardInterrupt, PyRuntimeError, PyValueError};
use pyo3::prelude::*;

pyo3::create_exception!(
    creepage,
    InputError,
    PyValueError,
    "Wrong usage or unusable input: `file`, `line`, `column`, `help`."
);
pyo3::create_exception!(
    creepage,
    RunError,
    PyRuntimeError,
    "Work that failed although its input was good: `file`, `line`, `column`, `help`."
);

/// What both carry; None in what Python itself raises.
const ATTRIBUTES: [&str; 4] = ["file", "line", "column", "help"];

/// Gives both exceptions their attributes.
pub fn declare(py: Python) -> PyResult<()> {
    for class in [py.get_type::<InputError>(), py.get_type::<RunError>()] {
        ATTRIBUTES.iter().try_for_each(|name| class.setattr(*name, py.None()))?;
    }
    Ok(())
}

/// An error of the library as an exception.
pub fn raised(py: Python, error: &Error) -> PyErr {
    let text = error.to_string();
    let raised = match error.kind() {
        ErrorKind::Input => InputError::new_err(text),
        ErrorKind::Stopped => return PyKeyboardInterrupt::new_err(text),
        ErrorKind::Run | ErrorKind::Verdict => RunError::new_err(text),
    };
    let value = raised.value(py);
    let (line, column) = error.place().unzip();
    let file = error.file().map(|path| path.to_string_lossy().into_owned());
    // An exception of one's own class takes attributes.
    let _ = value.setattr("file", file);
    let _ = value.setattr("line", line);
    let _ = value.setattr("column", column);
    let _ = value.setattr("help", error.advice());
    raised
}
