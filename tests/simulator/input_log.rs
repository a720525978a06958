//! How inputs reach the log: in ticks of an encoder, in steps of a converter, with the noise of a gyroscope.

use super::vehicle::Channel;
use rand::Rng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

/// What a logger makes of the inputs; exact where all is zero.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct InputLog {
    /// The angle between two ticks of a wheel's encoder, rad; wheels are counted where it is above zero.
    pub tick: f64,
    /// The step of what is no wheel, in its own unit.
    pub step: f64,
    /// The deviation of the noise of what is no wheel, in its own unit.
    pub noise: f64,
}

/// The two logged inputs, row after row.
pub struct InputLogger<'a> {
    channels: &'a [Channel; 2],
    log: InputLog,
    /// The angle of each wheel since the beginning, and the counts that were logged of it.
    angles: [f64; 2],
    counts: [f64; 2],
}

impl<'a> InputLogger<'a> {
    /// Before the first row; encoders stand anywhere between two ticks.
    pub fn new(channels: &'a [Channel; 2], log: InputLog, random: &mut ChaCha8Rng) -> Self {
        let angles = [(); 2].map(|()| log.tick * random.random::<f64>());
        Self { channels, log, angles, counts: [0.0; 2] }
    }

    /// The values of a row: samples at its time, or means since the row before.
    pub fn row(&mut self, [before, t]: [f64; 2], means: bool, random: &mut ChaCha8Rng) -> [f64; 2] {
        [0, 1].map(|k| {
            let signal = &self.channels[k].signal;
            let exact = if means { signal.mean(before, t) } else { signal.value(t) };
            let is_wheel = self.channels[k].role.starts_with("wheel_rate");
            if is_wheel && self.log.tick > 0.0 {
                self.angles[k] += signal.mean(before, t) * (t - before);
                let counts = (self.angles[k] / self.log.tick).floor();
                let ticks = counts - self.counts[k];
                self.counts[k] = counts;
                return ticks * self.log.tick / (t - before);
            }
            if is_wheel {
                return exact;
            }
            let noise: f64 = StandardNormal.sample(random);
            let value = exact + self.log.noise * noise;
            if self.log.step > 0.0 { self.log.step * (value / self.log.step).round() } else { value }
        })
    }
}
