//! `creepage export`

use super::output::print;
use super::runs::not_an_input;
use super::user_catalogues::UserCatalogues;
use clap::{Args, ValueEnum};
use creepage::export::{Code, Exported, Gains, Language, Target, patched_description};
use creepage::files::{ModelFile, read_text, write_whole};
use creepage::{Error, Result};
use serde_json::Value;
use std::path::{Path, PathBuf};

/// Write a model's findings as what a robot reads
#[derive(Args)]
#[command(after_help = "\
Examples:
  creepage export report/model.patched.toml --as ros2-diff-drive
  creepage export report/model.patched.toml --as vesc --speed-to-erpm-gain 4614 --steering-angle-to-servo-gain=-1.2135 \\
    --steering-angle-to-servo-offset 0.5304
  creepage export report/model.patched.toml --as urdf --urdf robot.urdf --tracked marker --out robot.calibrated.urdf
  creepage export report/model.patched.toml --as c --covariance report/report.json --out model_step.h

What the target has no place for stands in a comment of it and on standard error; the exit code is then 3. Code has a step of
the model with its Jacobian and needs no library.")]
pub struct Arguments {
    /// The model, with its effects
    #[arg(value_name = "MODEL.toml")]
    model: PathBuf,
    /// What to write
    #[arg(long = "as", value_enum, value_name = "TARGET")]
    target: Choice,
    /// Where it goes; standard output when left out
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Of code: the report or the answer of `fit --format json` whose covariance goes with it
    #[arg(long, value_name = "REPORT.json")]
    covariance: Option<PathBuf>,
    /// Of urdf: the robot's description
    #[arg(long, value_name = "ROBOT.urdf", required_if_eq("target", "urdf"))]
    urdf: Option<PathBuf>,
    /// Of urdf: the link of the tracked frame, whose joint gets its place
    #[arg(long, value_name = "LINK")]
    tracked: Option<String>,
    /// Of vesc: the gain that the driver has
    #[arg(long, value_name = "GAIN", allow_negative_numbers = true, value_parser = number)]
    speed_to_erpm_gain: Option<f64>,
    /// Of vesc: the gain that the driver has
    #[arg(long, value_name = "GAIN", allow_negative_numbers = true, value_parser = number)]
    steering_angle_to_servo_gain: Option<f64>,
    /// Of vesc: the offset that the driver has
    #[arg(long, value_name = "OFFSET", allow_negative_numbers = true, value_parser = number)]
    steering_angle_to_servo_offset: Option<f64>,
    #[command(flatten)]
    own: UserCatalogues,
}

fn number(text: &str) -> std::result::Result<f64, String> {
    text.parse::<f64>().ok().filter(|v| v.is_finite()).ok_or_else(|| "it is a number".into())
}

#[derive(Clone, Copy, ValueEnum)]
enum Choice {
    /// diff_drive_controller: separation, radii and their multipliers
    Ros2DiffDrive,
    /// steering controllers: wheelbase, tracks, radii
    Ros2Steering,
    /// gains and offsets of speed and servo
    Vesc,
    /// constants for WPILib's kinematics
    Wpilib,
    /// the description given by --urdf with corrected radii, wheel joints and tracked frame
    Urdf,
    /// parameters, corrections and effects for programs
    Json,
    /// a step with its Jacobian in C99
    C,
    /// the same in C++11
    Cpp,
    /// the same in Python 3
    Python,
    /// the same in Rust
    Rust,
}

/// Carries out the command.
pub fn run(arguments: &Arguments, quiet: bool) -> Result<()> {
    if let Some(out) = &arguments.out {
        let inputs: Vec<&Path> = [Some(&arguments.model), arguments.covariance.as_ref(), arguments.urdf.as_ref()]
            .into_iter()
            .flatten()
            .map(PathBuf::as_path)
            .collect();
        not_an_input(out, &inputs)?;
    }
    let (file, library) = &arguments.own.read(&arguments.model)?;
    file.no_forces("export")?;
    let gains = Gains {
        speed_to_erpm: arguments.speed_to_erpm_gain,
        angle_to_servo: arguments.steering_angle_to_servo_gain,
        servo_offset: arguments.steering_angle_to_servo_offset,
    };
    let found = match arguments.target {
        Choice::Ros2DiffDrive => Target::Ros2DiffDrive.export(file, gains),
        Choice::Ros2Steering => Target::Ros2Steering.export(file, gains),
        Choice::Vesc => Target::Vesc.export(file, gains),
        Choice::Wpilib => Target::Wpilib.export(file, gains),
        Choice::Urdf => {
            let urdf = arguments.urdf.as_deref().ok_or_else(|| Error::input("--urdf is missing"))?;
            patched_description(file, urdf, arguments.tracked.as_deref())
        }
        Choice::Json => Target::Json.export(file, gains),
        Choice::C => code(arguments, file, library, Language::C),
        Choice::Cpp => code(arguments, file, library, Language::Cpp),
        Choice::Python => code(arguments, file, library, Language::Python),
        Choice::Rust => code(arguments, file, library, Language::Rust),
    }?;
    match &arguments.out {
        Some(out) => write_whole(out, found.text.as_bytes())?,
        None if quiet => {}
        None => print(&found.text)?,
    }
    match found.unsaid.is_empty() {
        true => Ok(()),
        false => Err(Error::verdict(format!("this target has no place for {}", found.unsaid.join("; ")))),
    }
}

fn code(
    arguments: &Arguments,
    file: &ModelFile,
    library: &[creepage::effects::Effect],
    language: Language,
) -> Result<Exported> {
    let code = Code::of_file(file, library)?;
    match &arguments.covariance {
        Some(path) => {
            let (names, matrix) = covariance(path)?;
            Ok(code.with_covariance(names, matrix).export(language))
        }
        None => Ok(code.export(language)),
    }
}

/// Names and rows of the covariance of a report.
pub fn covariance(path: &Path) -> Result<(Vec<String>, Vec<Vec<f64>>)> {
    let unreadable =
        |why: String| Error::input(why).at_file(path).help("give a report.json, or the answer of `fit --format json`");
    let text = read_text(path).map_err(|e| unreadable(format!("cannot be read: {}", e.message())))?;
    let whole: Value = serde_json::from_str(&text).map_err(|e| unreadable(format!("is no JSON: {e}")))?;
    let found: Option<creepage::report::Covariance> = serde_json::from_value(whole["covariance"].clone()).ok();
    let square = |c: &creepage::report::Covariance| {
        c.matrix.len() == c.names.len() && c.matrix.iter().all(|r| r.len() == c.names.len())
    };
    let found = found.filter(square).ok_or_else(|| unreadable("has no covariance".into()))?;
    Ok((found.names, found.matrix))
}
