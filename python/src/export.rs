//! A model's findings as what a robot reads.

use crate::errors::raised;
use crate::model::Model;
use creepage::export::{Code, Gains, Language, Target};
use pyo3::prelude::*;

/// The text of a target, and the effects that it has no place for.
#[pyfunction]
pub fn export(py: Python, model: &Model, target: &str) -> PyResult<(String, Vec<String>)> {
    let written = py.detach(|| {
        let (file, library) = model.0.clone().into_parts();
        file.no_forces("export")?;
        let parameters = |target: Target| target.export(&file, Gains::default());
        let code = |language| Ok(Code::of_file(&file, &library)?.export(language));
        match target {
            "ros2" => Target::of_ros2(&file),
            "ros2-diff-drive" => parameters(Target::Ros2DiffDrive),
            "ros2-steering" => parameters(Target::Ros2Steering),
            "wpilib" => parameters(Target::Wpilib),
            "vesc" => parameters(Target::Vesc),
            "json" => parameters(Target::Json),
            "c" => code(Language::C),
            "cpp" => code(Language::Cpp),
            "python" => code(Language::Python),
            "rust" => code(Language::Rust),
            _ => Err(creepage::Error::input(format!("\"{target}\" is no target"))
                .help("ros2, ros2-diff-drive, ros2-steering, wpilib, vesc, json, c, cpp, python or rust")),
        }
    });
    written.map(|w| (w.text, w.unsaid)).map_err(|e| raised(py, &e))
}
