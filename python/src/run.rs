//! A measured run at hand.

use crate::errors::raised;
use crate::model::Model;
use numpy::{PyArray1, ToPyArray};
use pyo3::prelude::*;
use std::collections::BTreeMap;
use std::path::PathBuf;

/// Times, measured poses and inputs, row by row.
#[pyclass(frozen, module = "creepage._creepage")]
pub struct Run(pub creepage::Run);

#[pymethods]
impl Run {
    /// Reads a log by the columns of a model; with `truth` the poses are those of a file of their own.
    #[staticmethod]
    #[pyo3(signature = (path, model, truth=None))]
    fn read(py: Python, path: PathBuf, model: &Model, truth: Option<PathBuf>) -> PyResult<Self> {
        let read = py.detach(|| match &truth {
            Some(truth) => creepage::Run::read_apart(&path, truth, model.0.as_ref()),
            None => creepage::Run::read(&path, &model.0),
        });
        read.map(Self).map_err(|e| raised(py, &e))
    }

    /// A log that is at hand as CSV.
    #[staticmethod]
    fn parse(py: Python, name: &str, text: &str, model: &Model) -> PyResult<Self> {
        py.detach(|| creepage::Run::parse(name, text, model.0.as_ref())).map(Self).map_err(|e| raised(py, &e))
    }

    /// Inputs and poses logged apart, each with its name, and with its text where it is at hand as CSV.
    #[staticmethod]
    fn apart(
        py: Python,
        inputs: (String, Option<String>),
        truth: (String, Option<String>),
        model: &Model,
    ) -> PyResult<Self> {
        let both = [&inputs, &truth].map(|(name, text)| (name.as_str(), text.as_deref()));
        py.detach(|| creepage::Run::parse_apart(both, model.0.as_ref())).map(Self).map_err(|e| raised(py, &e))
    }

    /// Name of the file, without its folder.
    #[getter]
    fn name(&self) -> &str {
        &self.0.name
    }

    /// Strictly increasing times of the poses, s.
    #[getter]
    fn time<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.0.time.to_pyarray(py)
    }

    /// Measured positions along x, m.
    #[getter]
    fn x<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.0.x.to_pyarray(py)
    }

    /// Measured positions along y, m.
    #[getter]
    fn y<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.0.y.to_pyarray(py)
    }

    /// Measured headings, rad, without jumps; None where no sensor measures one.
    #[getter]
    fn heading<'py>(&self, py: Python<'py>) -> Option<Bound<'py, PyArray1<f64>>> {
        self.0.heading.as_ref().map(|h| h.to_pyarray(py))
    }

    /// Measured absolute headings of the trailers, rad.
    #[getter]
    fn trailer_headings<'py>(&self, py: Python<'py>) -> Vec<Bound<'py, PyArray1<f64>>> {
        self.0.trailer_headings.iter().map(|h| h.to_pyarray(py)).collect()
    }

    /// The inputs by their roles, in the order of the log.
    #[getter]
    fn inputs<'py>(&self, py: Python<'py>) -> Vec<(String, Bound<'py, PyArray1<f64>>)> {
        let each = self.0.roles.iter().zip(&self.0.inputs);
        each.map(|(role, column)| (role.clone(), column.to_pyarray(py))).collect()
    }

    /// The times of the inputs, s: those of the poses where both were logged together.
    #[getter]
    fn input_time<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.0.input_time().to_pyarray(py)
    }

    /// What a user should know of the file.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.0.warnings.clone()
    }

    /// How many rows were left out for each reason.
    #[getter]
    fn why_dropped(&self) -> BTreeMap<String, usize> {
        self.0.why_dropped.clone()
    }
}
