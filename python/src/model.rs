//! A model file at hand.

use crate::errors::raised;
use pyo3::prelude::*;
use std::path::PathBuf;

/// A vehicle with its parameters, the columns of its logs, and the effects that it may miss.
#[pyclass(frozen, module = "creepage._creepage")]
pub struct Model(pub creepage::Model);

#[pymethods]
impl Model {
    /// Reads a model file, with files of the user's own vehicles and effects beside the catalogues.
    #[staticmethod]
    #[pyo3(signature = (path, vehicles=None, effects=None))]
    fn read(py: Python, path: PathBuf, vehicles: Option<PathBuf>, effects: Option<PathBuf>) -> PyResult<Self> {
        let read = py.detach(|| creepage::Model::read_with(path, vehicles.as_deref(), effects.as_deref()));
        read.map(Self).map_err(|e| raised(py, &e))
    }

    /// The model that the text of a model file describes.
    #[staticmethod]
    fn parse(py: Python, text: &str) -> PyResult<Self> {
        creepage::Model::parse(text).map(Self).map_err(|e| raised(py, &e))
    }

    /// A vehicle of the catalogue with its parameters in SI units.
    #[staticmethod]
    fn of_vehicle(py: Python, vehicle: &str, parameters: Vec<(String, f64)>) -> PyResult<Self> {
        let parameters: Vec<(&str, f64)> = parameters.iter().map(|(name, value)| (name.as_str(), *value)).collect();
        creepage::Model::new(vehicle, &parameters).map(Self).map_err(|e| raised(py, &e))
    }

    /// Id of the vehicle.
    #[getter]
    fn vehicle(&self) -> &str {
        self.0.vehicle()
    }

    /// The text of the model file.
    #[getter]
    fn text(&self) -> &str {
        self.0.text()
    }

    /// Writes the model file, whole or not at all.
    fn write(&self, py: Python, path: PathBuf) -> PyResult<()> {
        self.0.write(path).map_err(|e| raised(py, &e))
    }
}
