//! What tests of this layer begin with: a unicycle with effects, what it logs, a fit of it.

use super::estimation::fit::Fit;
use super::record::run_record::Record;
use crate::discrepancy::estimation::noise_model::{NoiseModel, Start};
use crate::effects::{Applied, all, named};
use crate::files::ModelFile;
use crate::model::{Equations, Model, known};
use crate::motion::{StateSensitivity, Stepper, Timing};
use nalgebra::DMatrix;

/// Effects that are free: of one value, of two, and of one again.
pub const KNOWN: [(&str, &[f64]); 3] =
    [("traction-creep", &[0.3]), ("relaxation-length", &[0.1, 0.8]), ("traverse-creep", &[-0.05])];

/// The rates, of the wheel and of the yaw, of a drive that weaves, faster and slower.
pub const WEAVING: [&dyn Fn(f64) -> f64; 2] = [&|t| 2.0 + (0.7 * t).sin(), &|t| 0.6 * (0.4 * t).cos()];

/// The file of a unicycle, and what else it says.
pub fn unicycle_file(more: &str) -> ModelFile {
    let text = format!("vehicle = \"unicycle\"\n[parameters]\nwheel_radius = 1.0\n{more}");
    ModelFile::parse(&text, "model.toml", &known(all())).unwrap()
}

/// An effect of the library at one place, whatever its values.
pub fn applied(id: &str) -> Applied {
    let effect = named(id).unwrap();
    Applied::new(effect, None, vec![1.0; effect.parameters.len()])
}

/// A unicycle with effects that are free.
pub fn unicycle(known: &[(&str, &[f64])]) -> Model {
    let with = |model: Model, (id, values): &(&str, &[f64])| {
        model.with_effect(Applied::new(named(id).unwrap(), None, values.to_vec()).freed())
    };
    known.iter().fold(Model::new("unicycle", &[("wheel_radius", 0.5)]).unwrap(), with)
}

/// The noise of a vehicle with so many trailers, of the variances of the sensor and of the jumps.
pub fn noise_of<const N: usize>(trailers: usize, sensor: [f64; N], jumps: &[f64]) -> NoiseModel {
    let start = |variance: f64| Start { variance, is_measured: true, is_known: false };
    let mut noise = NoiseModel::starting(trailers, sensor.map(start));
    noise.process_mut().iter_mut().zip(jumps).for_each(|(c, v)| c.variance = *v);
    noise
}

/// A fit that came to the values of a model; nothing else is said of it.
pub fn fit_of(model: Model) -> Fit {
    let p = model.free_values();
    Fit {
        information: DMatrix::identity(p.len(), p.len()),
        model,
        p,
        covariance: None,
        scopes_vary: false,
        between_runs: None,
        of_runs: vec![],
        runs: 1,
        variances: noise_of(0, [1e-6; 2], &[1e-6; 3]),
        deviance: 0.0,
        window_states: vec![],
        sample_size: 1000.0,
        unexplained: vec![0.0; 3],
        residual_correlation_time: 1.0,
        value_correlation_times: vec![],
        noise_correlation_time: 1.0,
        initial_state_dof: 0.0,
    }
}

/// Times of 40 s at 50 Hz.
pub fn at_50_hz() -> Vec<f64> {
    (0..2000).map(|i| 0.02 * f64::from(i)).collect()
}

/// A signal that goes up and down.
pub fn wave(t: f64) -> f64 {
    4.0 + 1.5 * (1.3 * t).sin()
}

/// The equations of such a unicycle, and the values of its effects.
pub fn equations(known: &[(&str, &[f64])]) -> (Equations, Vec<f64>) {
    let model = unicycle(known);
    (model.free_equations().unwrap(), model.free_values())
}

/// What such a vehicle logs at some times that begins as told.
pub fn logged(
    (equations, p): (&Equations, &[f64]),
    time: Vec<f64>,
    inputs: [&dyn Fn(f64) -> f64; 2],
    begin: &[f64],
    noise: f64,
) -> Record {
    let inputs = inputs.map(|f| time.iter().map(|t| f(*t)).collect::<Vec<f64>>());
    let mut record = Record::new("run", time, vec![vec![]; 3], true, &inputs, Timing::Sample);
    let signals = record.signals.clone();
    let mut stepper = Stepper::new(equations, &signals, p);
    let mut arc = StateSensitivity { z: begin.to_vec(), s: vec![] };
    for i in 0..record.time.len() {
        let y = stepper.outputs(&arc.z);
        let noise = |c: usize| noise * ((i * i) as f64 + c as f64).sin();
        (0..3).for_each(|c| record.columns[c].push(y[c] + noise(c)));
        if i + 1 < record.time.len() {
            stepper.advance(&mut arc, record.time[i], record.time[i + 1]);
        }
    }
    record
}
