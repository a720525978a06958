//! What was added to the inputs before they were logged: ticks of an encoder, few digits, a gyroscope's noise.
//!
//! Noise like it is that of the same logger whose ticks and steps lie elsewhere: the signal is the smoothed one.

use super::channel_noise::ChannelNoise;
use super::quantisation::staircase_step;
use crate::motion::{Signals, Timing};
use crate::numerics::usual_step;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::sync::OnceLock;

/// The noise of all inputs of a run; empty where none shows any.
#[derive(Clone, Debug, Default)]
pub(crate) struct InputNoise {
    time: Vec<f64>,
    columns: Vec<Vec<f64>>,
    timings: Vec<Timing>,
    channels: Vec<ChannelNoise>,
    /// The steps of inputs that are commands or rounded, which their values alone do not tell.
    suspected: Vec<Option<f64>>,
    /// The signals without their noise, of what is counted the integral.
    smooth: OnceLock<Vec<Vec<f64>>>,
}

/// Phases of ticks and steps that are drawn together, in equal distances: an error that lasts, of any size up to half of a
/// step, has the mean square of all phases in four of them to 6 % (Cochran, Sampling Techniques, ch. 8).
pub(crate) const PHASES: u64 = 4;

impl InputNoise {
    /// The noise that columns of inputs show.
    pub fn of(time: &[f64], columns: &[Vec<f64>], timings: &[Timing]) -> Self {
        let of = |(column, timing): (&Vec<f64>, &Timing)| ChannelNoise::of(time, column, *timing);
        let channels: Vec<ChannelNoise> = columns.iter().zip(timings).map(of).collect();
        let may_be_rounded = |(column, channel): (&Vec<f64>, &ChannelNoise)| {
            (*channel == ChannelNoise::None).then(|| staircase_step(column)).flatten()
        };
        let suspected: Vec<Option<f64>> = columns.iter().zip(&channels).map(may_be_rounded).collect();
        if channels.iter().all(|c| *c == ChannelNoise::None) && suspected.iter().all(Option::is_none) {
            return Self::default();
        }
        let (time, columns, timings) = (time.to_vec(), columns.to_vec(), timings.to_vec());
        Self { time, columns, timings, channels, suspected, smooth: OnceLock::new() }
    }

    /// The same where every input that may be rounded is.
    pub fn of_rounded(&self) -> Self {
        let of = |(channel, step): (&ChannelNoise, &Option<f64>)| step.map_or(*channel, ChannelNoise::Rounded);
        let channels = self.channels.iter().zip(&self.suspected).map(of).collect();
        Self { channels, suspected: vec![None; self.suspected.len()], smooth: OnceLock::new(), ..self.clone() }
    }

    /// The steps of inputs that may be rounded.
    pub fn suspected(&self) -> &[Option<f64>] {
        &self.suspected
    }

    /// The same where the noise of means of inputs that are counted is that of counts, whatever their ticks are.
    ///
    /// The means of a counter are noise, and not its ticks, where the stamps of the rows are not the times of counting.
    pub fn counting(&self, is_counted: &[bool]) -> Self {
        let interval = usual_step(&self.time).unwrap_or(0.0);
        let of = |((channel, timing), counted): ((&ChannelNoise, &Timing), &bool)| match (channel, timing, counted) {
            (ChannelNoise::White(std), Timing::IntervalMean, true) => {
                ChannelNoise::Counted(6.0_f64.sqrt() * std * interval)
            }
            _ => *channel,
        };
        let channels = self.channels.iter().zip(&self.timings).zip(is_counted).map(of).collect();
        Self { channels, smooth: OnceLock::new(), ..self.clone() }
    }

    /// Whether any input shows noise.
    pub fn is_there(&self) -> bool {
        self.channels.iter().any(|c| *c != ChannelNoise::None)
    }

    /// Whether any of it differs from row to row, so that a mean over the rows around has less: steps of a slow signal do not.
    pub fn averages_out(&self) -> bool {
        self.channels.iter().any(|c| matches!(c, ChannelNoise::Counted(_) | ChannelNoise::White(_)))
    }

    /// What a smoother takes away from the inputs as noise, the other way round.
    pub fn smoothing(&self) -> Signals {
        self.signals(|channel, column, smooth| channel.smoothing(&self.time, column, smooth))
    }

    /// Signals of noise like it, and nothing else: one of the draws of a seed, each [`PHASES`] of them a systematic sample of
    /// where ticks and steps lie.
    pub fn drawn(&self, seed: u64, draw: u64) -> Signals {
        let stream = |of: u64| {
            let mut random = ChaCha8Rng::seed_from_u64(seed);
            random.set_stream(of);
            random
        };
        let (mut first, mut random) = (stream(2 * (draw / PHASES)), stream(2 * draw + 1));
        self.signals(|channel, _, smooth| {
            let phase = first.random::<f64>() + (draw % PHASES) as f64 / PHASES as f64;
            channel.drawn(&self.time, smooth, phase, &mut random)
        })
    }

    /// Signals from each channel's noise, its column and its smoothed signal.
    fn signals(&self, mut of: impl FnMut(ChannelNoise, &[f64], &[f64]) -> Vec<f64>) -> Signals {
        let smooth = self.smooth.get_or_init(|| {
            let each = self.channels.iter().zip(&self.columns);
            each.map(|(channel, column)| channel.smoothed(&self.time, column)).collect()
        });
        let each = self.channels.iter().zip(&self.columns).zip(smooth);
        let columns: Vec<Vec<f64>> = each.map(|((channel, column), smooth)| of(*channel, column, smooth)).collect();
        Signals::mixed(&self.time, &columns, &self.timings)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrepancy::fixtures::{at_50_hz, wave};
    use crate::discrepancy::record::channel_noise::means;
    use crate::motion::running_integral;

    /// A signal that stays where it is has one error; the phases of four draws tell its mean square, s²/12, to an eighth.
    #[test]
    fn draws_sample_the_phases_of_steps() {
        let noise = InputNoise {
            time: vec![0.0, 1.0],
            columns: vec![vec![0.7; 2]; 2],
            timings: vec![Timing::Sample; 2],
            channels: vec![ChannelNoise::Rounded(0.3); 2],
            suspected: vec![None; 2],
            smooth: OnceLock::new(),
        };
        let errors = |seed: u64, draw: u64| {
            let (mut value, mut slope) = (vec![0.0; 2], vec![0.0; 2]);
            noise.drawn(seed, draw).at(0.5, &mut value, &mut slope);
            value
        };
        for seed in 0..20 {
            for (channel, first) in [(0, 0), (1, 0), (0, 4)] {
                let squares = (first..first + PHASES).map(|draw| errors(seed, draw)[channel].powi(2));
                let share = squares.sum::<f64>() / PHASES as f64 / (0.3 * 0.3 / 12.0);
                assert!((0.93..1.13).contains(&share), "{seed} {channel} {first}: {share}");
            }
            assert_ne!(errors(seed, 0)[0], errors(seed, 0)[1], "channels have phases of their own");
            assert_ne!(errors(seed, 0), errors(seed, 4));
        }
    }

    /// Of means of a counter noise is that of its counts: neighbours cancel. Of other means, and of samples, it stays.
    #[test]
    fn noise_of_a_counter_is_that_of_its_counts() {
        let time = at_50_hz();
        let column: Vec<f64> = time.iter().map(|t| wave(*t) + 0.1 * (1e4 * t * t).sin()).collect();
        let noise = |timing: Timing, counted: bool| {
            let noise = InputNoise::of(&time, std::slice::from_ref(&column), &[timing]).counting(&[counted]);
            noise.channels[0]
        };
        let ChannelNoise::White(std) = noise(Timing::IntervalMean, false) else { panic!("white") };
        assert_eq!(noise(Timing::Sample, true), ChannelNoise::White(std));
        let ChannelNoise::Counted(tick) = noise(Timing::IntervalMean, true) else { panic!("counted") };
        // Of two neighbouring counts that are each off by tick/√12 the mean is off by √2 as much, over the interval.
        assert!((tick / 12.0_f64.sqrt() * 2.0_f64.sqrt() / 0.02 / std - 1.0).abs() < 1e-9);
    }

    /// What a smoother takes away is most of what the logger added.
    #[test]
    fn smoothing_takes_the_noise_away() {
        let (time, exact) = (at_50_hz(), at_50_hz().iter().map(|t| wave(*t)).collect::<Vec<f64>>());
        let counts: Vec<f64> = running_integral(&time, &exact).iter().map(|a| (a / 0.05).floor() * 0.05).collect();
        let counted = means(&time, &counts);
        let noise = InputNoise::of(&time, std::slice::from_ref(&counted), &[Timing::IntervalMean]);
        assert!(matches!(noise.channels[..], [ChannelNoise::Counted(_)]), "{:?}", noise.channels);
        let channel = noise.channels[0];
        let by = channel.smoothing(&time, &counted, &channel.smoothed(&time, &counted));
        let rms = |e: &dyn Fn(usize) -> f64| (1..time.len()).map(|i| e(i).powi(2)).sum::<f64>().sqrt();
        let (rough, smooth) = (rms(&|i| counted[i] - exact[i]), rms(&|i| counted[i] + by[i] - exact[i]));
        assert!(smooth < 0.2 * rough, "{rough} {smooth}");
    }
}
