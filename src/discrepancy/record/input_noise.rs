//! What was added to the inputs before they were logged: ticks of an encoder, few digits, a gyroscope's noise.
//!
//! | kind | its error |
//! |---|---|
//! | counted | the *integral* is rounded to whole steps: errors of neighbouring rows cancel, and the way is off by step²/12 |
//! | rounded | each value is rounded: off by step²/12 for as long as the value stays |
//! | white | each row by itself |

use super::local_polynomial;
use crate::discrepancy::preprocessing::quantisation::step_of;
use crate::motion::{Signals, Timing};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::StandardNormal;

/// The noise of one input.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum ChannelNoise {
    /// Nothing that shows.
    None,
    /// A count's step, in units of the input.
    Counted(f64),
    /// A value's step.
    Rounded(f64),
    /// A standard deviation.
    White(f64),
}

/// The noise of all inputs of a run.
#[derive(Clone, Debug)]
pub(crate) struct InputNoise {
    time: Vec<f64>,
    timing: Timing,
    channels: Vec<ChannelNoise>,
    /// Whether a rounded value is another than the row before.
    changes: Vec<Vec<bool>>,
}

/// Noise less than this share of an input, root mean square, is none.
const LEAST: f64 = 0.01;
/// Rows that a value stays on average from which on it is taken to be rounded, and not counted.
const STAYS: f64 = 4.0;
/// Of white noise the differences from the neighbours' cubic are correlated by −0.8 from row to row.
const WHITE: f64 = -0.6;

impl InputNoise {
    /// The noise that columns of inputs show.
    pub fn of(time: &[f64], columns: &[Vec<f64>], timing: Timing) -> Self {
        let channels = columns.iter().map(|c| of_column(time, c)).collect();
        let changes = columns.iter().map(|c| (0..c.len()).map(|i| i == 0 || c[i] != c[i - 1]).collect()).collect();
        Self { time: time.to_vec(), timing, channels, changes }
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
        Signals::new(&self.time, &columns, self.timing)
    }
}

impl ChannelNoise {
    fn drawn(self, changes: &[bool], random: &mut ChaCha8Rng) -> Vec<f64> {
        let uniform = |step: f64, random: &mut ChaCha8Rng| step * (random.random::<f64>() - 0.5);
        match self {
            Self::None => vec![0.0; changes.len()],
            Self::White(std) => changes.iter().map(|_| std * random.sample::<f64, _>(StandardNormal)).collect(),
            Self::Counted(step) => {
                let mut last = 0.0;
                let mut next = |_: &bool| {
                    let here = uniform(step, random);
                    let error = here - last;
                    last = here;
                    error
                };
                changes.iter().map(&mut next).collect()
            }
            Self::Rounded(step) => {
                let mut here = 0.0;
                let mut next = |changed: &bool| {
                    if *changed {
                        here = uniform(step, random);
                    }
                    here
                };
                changes.iter().map(&mut next).collect()
            }
        }
    }
}

fn of_column(time: &[f64], column: &[f64]) -> ChannelNoise {
    if let Some(step) = step_of(column) {
        let changes = column.windows(2).filter(|w| w[0] != w[1]).count();
        let stays = column.len() as f64 / changes.max(1) as f64;
        return if stays < STAYS { ChannelNoise::Counted(step) } else { ChannelNoise::Rounded(step) };
    }
    let size = (column.iter().map(|u| u * u).sum::<f64>() / column.len().max(1) as f64).sqrt();
    match local_polynomial::noise(time, column) {
        Some(std) if std > LEAST * size && is_white(time, column) => ChannelNoise::White(std),
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
