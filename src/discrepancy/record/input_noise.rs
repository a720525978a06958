//! What was added to the inputs before they were logged: ticks of an encoder, few digits, a gyroscope's noise.
//!
//! | kind | its error |
//! |---|---|
//! | counted | the *integral* is off by itself at every row, by step²/12 where it is rounded: errors of neighbouring means cancel |
//! | rounded | each value is rounded: off by step²/12 for as long as the value stays |
//! | white | each row by itself |
//!
//! Means over the time between rows are what counts give; samples are rounded or noisy by themselves.

use super::local_polynomial;
use super::quantisation::step_of;
use crate::motion::{Signals, Timing};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::StandardNormal;

/// The noise of one input.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum ChannelNoise {
    /// Nothing that shows.
    None,
    /// The deviation of a count at each row, over the time between rows, in units of the input.
    Counted(f64),
    /// A value's step.
    Rounded(f64),
    /// The deviation of each row.
    White(f64),
}

/// The noise of all inputs of a run.
#[derive(Clone, Debug)]
pub(crate) struct InputNoise {
    time: Vec<f64>,
    timings: Vec<Timing>,
    channels: Vec<ChannelNoise>,
    /// Whether a rounded value is another than the row before.
    changes: Vec<Vec<bool>>,
}

/// Noise less than this share of an input, root mean square, is none.
const LEAST: f64 = 0.01;
/// Of white noise the differences from the neighbours' cubic are correlated by −0.8 from row to row.
const WHITE: f64 = -0.6;

impl InputNoise {
    /// The noise that columns of inputs show.
    pub fn of(time: &[f64], columns: &[Vec<f64>], timings: &[Timing]) -> Self {
        let channels = columns.iter().zip(timings).map(|(c, timing)| of_column(time, c, *timing)).collect();
        let changes = columns.iter().map(|c| (0..c.len()).map(|i| i == 0 || c[i] != c[i - 1]).collect()).collect();
        Self { time: time.to_vec(), timings: timings.to_vec(), channels, changes }
    }

    /// Whether any input shows noise.
    pub fn is_there(&self) -> bool {
        self.channels.iter().any(|c| *c != ChannelNoise::None)
    }

    /// Signals of noise like it, and nothing else.
    pub fn drawn(&self, seed: u64) -> Signals {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let columns: Vec<Vec<f64>> =
            self.channels.iter().zip(&self.changes).map(|(c, changes)| c.drawn(changes, &mut random)).collect();
        Signals::mixed(&self.time, &columns, &self.timings)
    }
}

impl ChannelNoise {
    /// An error for each row, which is another value than the one before or not.
    fn drawn(self, changes: &[bool], random: &mut ChaCha8Rng) -> Vec<f64> {
        let mut last = 0.0;
        let mut next = |changed: &bool| match self {
            Self::None => 0.0,
            Self::White(std) => std * normal(random),
            Self::Counted(std) => {
                let here = std * normal(random);
                here - std::mem::replace(&mut last, here)
            }
            Self::Rounded(step) => {
                if *changed {
                    last = step * (random.random::<f64>() - 0.5);
                }
                last
            }
        };
        changes.iter().map(&mut next).collect()
    }
}

fn normal(random: &mut ChaCha8Rng) -> f64 {
    random.sample(StandardNormal)
}

fn of_column(time: &[f64], column: &[f64], timing: Timing) -> ChannelNoise {
    let is_mean = timing == Timing::IntervalMean;
    if let Some(step) = step_of(column) {
        return if is_mean { ChannelNoise::Counted(step / 12.0_f64.sqrt()) } else { ChannelNoise::Rounded(step) };
    }
    let size = (column.iter().map(|u| u * u).sum::<f64>() / column.len().max(1) as f64).sqrt();
    match local_polynomial::noise(time, column) {
        Some(std) if std > LEAST * size && is_white(time, column) => match is_mean {
            true => ChannelNoise::Counted(std / 2.0_f64.sqrt()),
            false => ChannelNoise::White(std),
        },
        _ => ChannelNoise::None,
    }
}

/// Whether what a column's rows differ by from the cubic through their neighbours looks like white noise.
fn is_white(time: &[f64], column: &[f64]) -> bool {
    let error = |i: usize| {
        let others = [i - 2, i - 1, i + 1, i + 2];
        let lagrange = others.map(|j| {
            let factors = others.iter().filter(|k| **k != j).map(|k| (time[i] - time[*k]) / (time[j] - time[*k]));
            factors.product::<f64>()
        });
        column[i] - others.iter().zip(lagrange).map(|(j, l)| l * column[*j]).sum::<f64>()
    };
    let errors: Vec<f64> = (2..column.len().saturating_sub(2)).map(error).collect();
    let products: f64 = errors.windows(2).map(|w| w[0] * w[1]).sum();
    let squares: f64 = errors.iter().map(|e| e * e).sum();
    squares > 0.0 && products / squares < WHITE
}

#[cfg(test)]
mod tests {
    use super::*;

    fn time() -> Vec<f64> {
        (0..2000).map(|i| 0.02 * f64::from(i)).collect()
    }

    fn wave(t: f64) -> f64 {
        4.0 + 1.5 * (1.3 * t).sin()
    }

    fn kind(f: impl Fn(f64) -> f64, timing: Timing) -> ChannelNoise {
        let column: Vec<f64> = time().iter().map(|t| f(*t)).collect();
        of_column(&time(), &column, timing)
    }

    #[test]
    fn noise_is_told_by_its_steps_and_by_its_timing() {
        let rounded = |t: f64| (wave(t) / 0.3).round() * 0.3;
        assert!(matches!(kind(rounded, Timing::Sample), ChannelNoise::Rounded(step) if (step - 0.3).abs() < 1e-9));
        let counted = kind(rounded, Timing::IntervalMean);
        assert!(matches!(counted, ChannelNoise::Counted(std) if (std - 0.3 / 12.0_f64.sqrt()).abs() < 1e-9));
        let noisy = |t: f64| wave(t) + 0.1 * (1e4 * t * t).sin();
        assert!(matches!(kind(noisy, Timing::Sample), ChannelNoise::White(std) if (0.04..0.12).contains(&std)));
        assert_eq!(kind(wave, Timing::Sample), ChannelNoise::None);
    }

    /// The sum of what is counted stays where it is, that of white noise walks.
    #[test]
    fn what_is_counted_cancels() {
        let changes = vec![true; 20_000];
        let way = |noise: ChannelNoise| {
            let drawn = noise.drawn(&changes, &mut ChaCha8Rng::seed_from_u64(1));
            let rms = (drawn.iter().map(|e| e * e).sum::<f64>() / drawn.len() as f64).sqrt();
            let sums = drawn.iter().scan(0.0, |sum, e| {
                *sum += e;
                Some(*sum)
            });
            (rms, sums.map(f64::abs).fold(0.0, f64::max))
        };
        let (rms, most) = way(ChannelNoise::Counted(0.5));
        assert!((rms / 0.5 / 2.0_f64.sqrt() - 1.0).abs() < 0.02 && most < 3.0, "{rms} {most}");
        let (rms, most) = way(ChannelNoise::White(0.5));
        assert!((rms / 0.5 - 1.0).abs() < 0.02 && most > 10.0, "{rms} {most}");
        let held = ChannelNoise::Rounded(0.2).drawn(&[true, false, false, true], &mut ChaCha8Rng::seed_from_u64(1));
        assert!(held[0] == held[1] && held[1] == held[2] && held[2] != held[3] && held.iter().all(|e| e.abs() <= 0.1));
        assert_eq!(ChannelNoise::None.drawn(&[true; 3], &mut ChaCha8Rng::seed_from_u64(1)), [0.0; 3]);
    }
}
