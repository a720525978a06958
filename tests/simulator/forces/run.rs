//! A run: a machine driven, and what a logger writes down.

use super::drawn::{Drawn, Make, Wave};
use super::hidden::Secret;
use super::motion::{State, advance};
use super::newton::Inputs;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::StandardNormal;
use std::fmt::Write;

/// Rows this far apart, s.
const STEP: f64 = 0.04;

/// How long, and with what hidden.
#[derive(Clone, Debug)]
pub struct Drive {
    pub make: Make,
    pub seed: u64,
    pub seconds: f64,
    pub secret: Option<Secret>,
    /// Whether a gyro and encoders of the driven wheels are logged, too.
    pub sensors: bool,
}

/// Standard deviation of the gyro and of a wheel's rate, rad/s.
const SENSOR_NOISE: [f64; 2] = [0.01, 0.05];

/// A log with its model file.
pub struct Run {
    pub model: String,
    pub csv: String,
}

impl Drive {
    /// The runs, so many, of one machine.
    pub fn runs(&self, count: u64) -> Vec<Run> {
        let drawn = self.make.drawn(&mut ChaCha8Rng::seed_from_u64(self.seed));
        let mut machine = drawn.machine.clone();
        if let Some(secret) = &self.secret {
            secret.hide(&mut machine);
        }
        let of = |k: u64| {
            let mut random = ChaCha8Rng::seed_from_u64(self.seed.wrapping_mul(1000).wrapping_add(k + 1));
            let csv = self.logged(&drawn, &machine, &mut random);
            let measured = if self.sensors { measured(&drawn) } else { String::new() };
            Run { model: drawn.model.clone() + &measured, csv }
        };
        (0..count).map(of).collect()
    }

    fn logged(&self, drawn: &Drawn, machine: &super::machine::Machine, random: &mut ChaCha8Rng) -> String {
        let waves: Vec<Wave> = drawn.sizes.iter().map(|size| Wave::drawn(random, *size)).collect();
        let inputs = |t: f64| {
            let (u, rate): (Vec<f64>, Vec<f64>) = waves.iter().map(|w| w.at(t)).map(|[u, rate]| (u, rate)).unzip();
            (u, rate)
        };
        let mut state = begun(machine, drawn.speed);
        let (u, rate) = inputs(0.0);
        machine.project(&mut state, &Inputs { u: &u, rate: &rate });
        for (gap, wheel) in state.gap.iter_mut().zip(&machine.wheels) {
            *gap = wheel.input.map_or(0.0, |k| wheel.play * u[k].signum());
        }
        let trailers = machine.solids.len() - 1;
        let mut csv = format!("time,{},x,y,heading", drawn.roles.join(","));
        (1..=trailers).for_each(|i| write!(csv, ",trailer_{i}").unwrap());
        let turning = if self.sensors { driven(drawn) } else { vec![] };
        if self.sensors {
            csv += ",gyro";
            turning.iter().for_each(|(name, _)| write!(csv, ",{name}").unwrap());
        }
        // Of their own, so that the poses are the same without them.
        let mut of_sensors = ChaCha8Rng::seed_from_u64(self.seed);
        csv.push('\n');
        let rows = (self.seconds / STEP).round() as usize;
        for i in 0..=rows {
            let t = STEP * i as f64;
            let [place, angle] = drawn.noise;
            let mut noisy = |value: f64, sigma: f64| value + sigma * random.sample::<f64, _>(StandardNormal);
            write!(csv, "{t:.3}").unwrap();
            inputs(t).0.iter().for_each(|u| write!(csv, ",{u:.9}").unwrap());
            let [x, y] = machine.place(&state, 0);
            write!(csv, ",{:.6},{:.6}", noisy(x, place), noisy(y, place)).unwrap();
            (0..=trailers).for_each(|k| write!(csv, ",{:.6}", noisy(state.place[3 * k + 2], angle)).unwrap());
            let mut read = |value: f64, sigma: f64| value + sigma * of_sensors.sample::<f64, _>(StandardNormal);
            if self.sensors {
                let [of_gyro, of_wheel] = SENSOR_NOISE;
                write!(csv, ",{:.6}", read(state.speed[2], of_gyro)).unwrap();
                let first = state.place.len();
                turning
                    .iter()
                    .for_each(|(_, k)| write!(csv, ",{:.6}", read(state.speed[first + k], of_wheel)).unwrap());
            }
            csv.push('\n');
            advance(machine, &mut state, t, STEP * (i + 1) as f64, &inputs);
        }
        csv
    }
}

/// The rates of the driven wheels by the names that they have as inputs, and which wheels they are.
fn driven(drawn: &Drawn) -> Vec<(String, usize)> {
    let wheels = drawn.machine.wheels.iter().enumerate();
    let named = |(k, wheel): (usize, &super::machine::Wheel)| {
        let role = &drawn.roles[wheel.input?];
        role.contains("wheel_torque").then(|| (role.replace("torque", "rate"), k))
    };
    wheels.filter_map(named).collect()
}

/// What a model file says of the gyro and of the encoders.
fn measured(drawn: &Drawn) -> String {
    let wheels: String = driven(drawn).iter().map(|(name, _)| format!("{name} = \"{name}\"\n")).collect();
    format!("\n[measured]\nyaw_rate = \"gyro\"\n{wheels}")
}

/// Straight ahead at a speed, wheels rolling.
pub fn begun(machine: &super::machine::Machine, speed: f64) -> State {
    let mut place = Vec::new();
    let mut reference = 0.0;
    for (i, solid) in machine.solids.iter().enumerate() {
        if let Some(hitch) = i.checked_sub(1).map(|k| machine.hitches[k]) {
            reference -= hitch.behind + hitch.length;
        }
        place.extend([reference + solid.centre[0], solid.centre[1], 0.0]);
    }
    let moving = machine.solids.iter().flat_map(|_| [speed, 0.0, 0.0]);
    let speeds = moving.chain(machine.wheels.iter().map(|w| speed / w.radius)).collect();
    let none = vec![0.0; machine.wheels.len()];
    State { place, speed: speeds, built: vec![0.0; machine.contacts.len()], gap: none.clone(), taken: none }
}
