//! The jobs on a model and its runs as calls: discover, check, describe, simulate.

use super::discovery::Discovery;
use super::model::Model;
use super::options::Options;
use crate::describe::{Description, GivenPoint};
use crate::discrepancy::calibration::calibrate::calibrate;
use crate::discrepancy::calibration::targets::Target;
use crate::discrepancy::calibration_report::Calibration;
use crate::discrepancy::check::check_aligned;
use crate::discrepancy::discover::discover_aligned;
use crate::discrepancy::identifiability::{Check, Checked};
use crate::discrepancy::request::Request;
use crate::error::Result;
use crate::files::Run;
use crate::formula::Symbol;
use crate::model::Model as VehicleModel;
use crate::motion::{Integrator, Signals, Table, simulate_model};
use crate::progress::unheard;

/// Finds where a model and measured runs disagree, names the missing effect, and adds it to the model.
///
/// ```
/// use creepage::{Model, Run};
/// let model = Model::read("examples/runs/cornering/model.toml")?;
/// let runs = Run::read_all(["examples/runs/cornering/eights.csv", "examples/runs/cornering/rosette.csv"], &model)?;
/// let found = creepage::discover(&model, &runs)?;
/// assert!(found.report.summary.starts_with("In turns the robot slides outwards: 8."));
/// assert!(found.model.text().contains("cornering-creep"));
/// # Ok::<(), creepage::Error>(())
/// ```
///
/// # Errors
/// When runs log different inputs, or the constraints of the model do not determine its motion.
pub fn discover(model: &Model, runs: &[Run]) -> Result<Discovery> {
    discover_with(model, runs, &Options::default())
}

/// As [`discover`](crate::discover), with [`Options`] of one's own: runs held out, horizons, effects, a listener.
///
/// ```
/// use creepage::{Model, Options, Run};
/// let model = Model::read("examples/runs/cornering/model.toml")?;
/// let eights = Run::read("examples/runs/cornering/eights.csv", &model)?;
/// let bay = Run::read("examples/runs/cornering/bay_held_out.csv", &model)?;
/// let options = Options { held_out: vec![bay], horizons: vec![5.0], ..Options::default() };
/// let found = creepage::discover_with(&model, &[eights], &options)?;
/// let gap = found.report.gap[0].held_out.unwrap();
/// assert!(gap.position_rms_after < 0.1 * gap.position_rms_before);
/// # Ok::<(), creepage::Error>(())
/// ```
///
/// # Errors
/// As [`discover`](crate::discover); when an effect of the options is unknown, or their listener stops the work.
pub fn discover_with(model: &Model, runs: &[Run], options: &Options) -> Result<Discovery> {
    VehicleModel::check_motion(&model.file)?;
    let library = options.effects_of(model)?;
    let request = Request {
        file: &model.file,
        runs,
        held_out: &options.held_out,
        library: &library,
        horizons: &options.horizons,
        seed: options.seed,
    };
    let found = discover_aligned(&request, options.clock_offset, options.progress)?;
    let patched = model.rewritten(&found.patched(&model.file))?;
    Ok(Discovery { report: found.report, model: patched, pictures: found.pictures })
}

/// Says before any fit what runs can tell of a model: which effects would be seen, which would not be told apart.
///
/// ```
/// use creepage::{Model, Run};
/// let model = Model::read("examples/runs/cornering/model.toml")?;
/// let told = creepage::check(&model, &[Run::read("examples/runs/cornering/eights.csv", &model)?])?;
/// assert!(told.effects.iter().any(|e| e.id == "cornering-creep"));
/// # Ok::<(), creepage::Error>(())
/// ```
///
/// # Errors
/// As [`discover`](crate::discover).
pub fn check(model: &Model, runs: &[Run]) -> Result<Check> {
    check_with(model, runs, &Options::default())
}

/// As [`check`](crate::check), with effects, a clock offset and a listener of one's own.
///
/// ```
/// use creepage::{Model, Options, Run};
/// let model = Model::read("examples/runs/cornering/model.toml")?;
/// let runs = [Run::read("examples/runs/cornering/eights.csv", &model)?];
/// let options = Options { effects: Some(vec!["cornering-creep".into()]), ..Options::default() };
/// assert_eq!(creepage::check_with(&model, &runs, &options)?.effects.len(), 1);
/// # Ok::<(), creepage::Error>(())
/// ```
///
/// # Errors
/// As [`discover_with`](crate::discover_with).
pub fn check_with(model: &Model, runs: &[Run], options: &Options) -> Result<Check> {
    VehicleModel::check_motion(&model.file)?;
    let library = options.effects_of(model)?;
    let of = Checked { file: &model.file, runs, library: &library };
    check_aligned(&of, options.clock_offset, options.progress)
}

/// Fits just these effects to runs: values, deviations and covariance, and no selection.
///
/// An effect on one of several inputs or trailers is named `ID@INPUT` or `ID@TRAILER`. Priors and bounds are those of the
/// model's `[[effects]]`.
///
/// ```
/// use creepage::{Model, Run};
/// let model = Model::read("examples/runs/cornering/model.toml")?;
/// let runs = [Run::read("examples/runs/cornering/eights.csv", &model)?];
/// let fitted = creepage::fit(&model, &runs, &["cornering-creep", "lever-arm"])?;
/// let slide = &fitted.effects[0].parameters["mass_over_bT"];
/// assert!((slide.value - 0.11).abs() < 4.0 * slide.std.unwrap());
/// assert_eq!(fitted.covariance.unwrap().names, ["cornering-creep mass_over_bT", "lever-arm a", "lever-arm b"]);
/// # Ok::<(), creepage::Error>(())
/// ```
///
/// # Errors
/// As [`discover`](crate::discover), and when a name does not mean one effect of the vehicle.
pub fn fit(model: &Model, runs: &[Run], effects: &[&str]) -> Result<Calibration> {
    VehicleModel::check_motion(&model.file)?;
    let targets: Vec<Target> = effects.iter().map(|text| text.parse()).collect::<Result<_>>()?;
    let (file, library) = (&model.file, &model.library[..]);
    let request = Request { file, runs, held_out: &[], library, horizons: &[], seed: 0 };
    Ok(calibrate(&request, &targets, None, &unheard)?.calibration)
}

/// The constraints of a model with equations, Jacobians, growth vector and RT signature.
///
/// ```
/// let car = creepage::Model::new("car", &[("wheel_radius", 0.3), ("wheelbase", 2.6)])?;
/// assert!(creepage::describe::text(&creepage::describe(&car)?).contains("growth"));
/// # Ok::<(), creepage::Error>(())
/// ```
///
/// # Errors
/// When an effect of the model does not apply to its vehicle.
pub fn describe(model: &Model) -> Result<Description> {
    Description::of(&VehicleModel::of_file(&model.file, &model.library)?)
}

/// As [`describe`](crate::describe()), of what is measured and at a point.
///
/// `measured` are rates that are measured beside those that the logged inputs give: the signature hangs on them. At a point the
/// first and second derivatives of every constraint are given as numbers, by dual numbers.
///
/// ```
/// let car = creepage::Model::new("car", &[("wheel_radius", 0.3), ("wheelbase", 2.6)])?;
/// let at = creepage::describe_with(&car, &["phi'".into()], Some(&"phi=0.3,x'=1".parse()?))?;
/// assert!(creepage::describe::text(&at).contains("dg/d(phi) = 0.95"));
/// // With its yaw rate measured a car is RT, else RT².
/// assert_eq!(at.structure.realisation.unwrap().signature.to_string(), "R T");
/// # Ok::<(), creepage::Error>(())
/// ```
///
/// # Errors
/// As [`describe`](crate::describe()), and when the model has no such rate, or the point names what no constraint has.
pub fn describe_with(model: &Model, measured: &[Symbol], at: Option<&GivenPoint>) -> Result<Description> {
    let vehicle = VehicleModel::of_file(&model.file, &model.library)?;
    let description = Description::of_measuring(&vehicle, measured)?;
    match at {
        Some(point) => description.with_derivatives_at(&vehicle, point),
        None => Ok(description),
    }
}

/// The motion of a model over the inputs of a run, from the first pose of the run, at the times of its poses.
///
/// ```
/// use creepage::{Model, Run};
/// let model = Model::read("examples/runs/cornering/model.toml")?;
/// let run = Run::read("examples/runs/cornering/eights.csv", &model)?;
/// let table = creepage::simulate(&model, &run)?;
/// assert_eq!(table.rows(), run.time.len());
/// # Ok::<(), creepage::Error>(())
/// ```
///
/// # Errors
/// When the motion cannot be integrated.
pub fn simulate(model: &Model, run: &Run) -> Result<Table> {
    let vehicle = VehicleModel::from_file(&model.file, &model.library, &run.roles)?;
    let signals = Signals::of_run(run, model.file.input_timing);
    let integrator = Integrator::default().for_friction(model.file.has_friction());
    simulate_model(&vehicle, &signals, &run.time, &start(model, &vehicle, run), &integrator)
}

/// The first pose of a run, trailers that are not measured in line, then the speeds that forces change.
pub(super) fn start(model: &Model, vehicle: &VehicleModel, run: &Run) -> Vec<f64> {
    let heading = run.heading.as_ref().map_or(0.0, |h| h[0]);
    let measured = run.trailer_headings.iter().map(|h| h[0]);
    let trailers = measured.chain(std::iter::repeat(heading)).take(vehicle.trailer_count());
    let pose = [run.x[0], run.y[0], heading].into_iter().chain(trailers);
    pose.chain(vehicle.speeds_at_start(model.file.dynamics.as_ref())).collect()
}
