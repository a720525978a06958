//! A run of a model over given inputs, as a sensor with noise measures it.

use creepage::{Model, Pose, Run};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// The run from the origin, with noise of that deviation on place and heading.
pub fn noisy_run(truth: &Model, time: Vec<f64>, inputs: Vec<(&str, Vec<f64>)>, noise: f64, seed: u64) -> Run {
    let zero = || vec![0.0; time.len()];
    let still = Pose { x: zero(), y: zero(), heading: Some(zero()), ..Pose::default() };
    let table = creepage::simulate(truth, &Run::new(time.clone(), still, inputs.clone()).unwrap()).unwrap();
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut of = |name: &str| {
        let spread = |v: &f64| v + noise * (0..12).map(|_| random.random_range(-0.5..0.5)).sum::<f64>();
        table.column(name).unwrap().iter().map(spread).collect::<Vec<f64>>()
    };
    let pose = Pose { x: of("x"), y: of("y"), heading: Some(of("heading")), ..Pose::default() };
    Run::new(time, pose, inputs).unwrap()
}
