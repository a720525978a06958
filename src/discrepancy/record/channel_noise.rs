//! What was added to one input before it was logged, by its ticks, its steps or its spread.
//!
//! | kind | its error |
//! |---|---|
//! | counted | the *integral* is off by what is missing to the next tick: errors of neighbouring means cancel |
//! | rounded | each value is off by what is missing to the next step, as long as the signal stays within it |
//! | white | each row by itself |

use super::level_crossings::between_steps;
use super::local_polynomial;
use super::quantisation::{root_mean_square, step_above, tick_of};
use super::rauch_tung_striebel::smoothed;
use crate::motion::{Timing, running_integral};
use rand::Rng;
use rand_chacha::ChaCha8Rng;
use rand_distr::StandardNormal;

/// The noise of one input.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum ChannelNoise {
    /// Nothing that shows.
    None,
    /// The distance between two ticks, in units of the input times seconds.
    Counted(f64),
    /// A value's step.
    Rounded(f64),
    /// The deviation of each row.
    White(f64),
}

/// White noise less than this share of an input, root mean square, is none: so little is not told from its own course.
const LEAST: f64 = 0.001;
/// Steps are told from less than that.
const LEAST_STEP: f64 = 0.0005;
/// Of white noise the differences from the neighbours' cubic are correlated by −0.8 from row to row.
const WHITE: f64 = -0.6;

impl ChannelNoise {
    /// The noise that a column of an input shows.
    pub fn of(time: &[f64], column: &[f64], timing: Timing) -> Self {
        let tick = (timing == Timing::IntervalMean).then(|| tick_of(time, column)).flatten();
        if let Some(tick) = tick {
            return Self::Counted(tick);
        }
        // Means of a counter whose stamps are not the times of counting lie on no grid, though a part of them may.
        let is_sampled = timing == Timing::Sample;
        if let Some(step) = step_above(column, LEAST_STEP, is_sampled) {
            return Self::Rounded(step);
        }
        match local_polynomial::noise(time, column) {
            Some(std) if std > LEAST * root_mean_square(column) && is_white(time, column) => Self::White(std),
            _ => Self::None,
        }
    }

    /// The signal of a column without its noise; of what is counted the integral.
    pub fn smoothed(self, time: &[f64], column: &[f64]) -> Vec<f64> {
        match self {
            Self::None => vec![0.0; column.len()],
            Self::White(std) => smoothed(time, column, std * std),
            Self::Rounded(step) => between_steps(time, column, step),
            Self::Counted(tick) => smoothed(time, &running_integral(time, column), tick * tick / 12.0),
        }
    }

    /// What a smoother changes of a column.
    pub fn smoothing(self, time: &[f64], column: &[f64], smooth: &[f64]) -> Vec<f64> {
        let less = |rough: &[f64]| smooth.iter().zip(rough).map(|(s, r)| s - r).collect::<Vec<f64>>();
        match self {
            Self::None => vec![0.0; column.len()],
            Self::White(_) | Self::Rounded(_) => less(column),
            Self::Counted(_) => means(time, &less(&running_integral(time, column))),
        }
    }

    /// An error for each row: that of the smoothed signal where ticks and steps lie elsewhere, by a phase of their distance.
    pub fn drawn(self, time: &[f64], smooth: &[f64], phase: f64, random: &mut ChaCha8Rng) -> Vec<f64> {
        let missing = |step: f64| {
            let to_next = |s: &f64| {
                let steps = s / step + phase;
                step * (steps.round() - steps)
            };
            smooth.iter().map(to_next).collect::<Vec<f64>>()
        };
        match self {
            Self::None => vec![0.0; smooth.len()],
            Self::White(std) => smooth.iter().map(|_| std * random.sample::<f64, _>(StandardNormal)).collect(),
            Self::Rounded(step) => missing(step),
            Self::Counted(tick) => means(time, &missing(tick)),
        }
    }
}

/// The means over the time between rows whose sums are an integral.
pub(super) fn means(time: &[f64], integral: &[f64]) -> Vec<f64> {
    let mean = |i: usize| if i == 0 { 0.0 } else { (integral[i] - integral[i - 1]) / (time[i] - time[i - 1]) };
    (0..integral.len()).map(mean).collect()
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
    use crate::discrepancy::fixtures::{at_50_hz, wave};
    use rand::SeedableRng;

    fn kind(f: impl Fn(f64) -> f64, timing: Timing) -> ChannelNoise {
        let column: Vec<f64> = at_50_hz().iter().map(|t| f(*t)).collect();
        ChannelNoise::of(&at_50_hz(), &column, timing)
    }

    #[test]
    fn noise_is_told_by_its_steps_and_by_its_timing() {
        let rounded = |t: f64| (wave(t) / 0.3).round() * 0.3;
        for timing in [Timing::Sample, Timing::IntervalMean] {
            assert!(matches!(kind(rounded, timing), ChannelNoise::Rounded(step) if (step - 0.3).abs() < 1e-9));
        }
        let angle = |t: f64| ((4.0 * t - 1.5 / 1.3 * (1.3 * t).cos()) / 0.006).floor() * 0.006;
        let counted = |t: f64| (angle(t) - angle(t - 0.02)) / 0.02;
        let found = kind(counted, Timing::IntervalMean);
        assert!(matches!(found, ChannelNoise::Counted(tick) if (tick / 0.006 - 1.0).abs() < 1e-6), "{found:?}");
        for timing in [Timing::Sample, Timing::IntervalMean] {
            let noisy = |t: f64| wave(t) + 0.1 * (1e4 * t * t).sin();
            assert!(matches!(kind(noisy, timing), ChannelNoise::White(std) if (0.04..0.12).contains(&std)));
            assert_eq!(kind(wave, timing), ChannelNoise::None);
        }
    }

    /// Noise like that of a logger is as large as its own, and cancels where its own does.
    #[test]
    fn noise_like_it_is_as_large_and_cancels_as_it_does() {
        let time = at_50_hz();
        let exact: Vec<f64> = time.iter().map(|t| wave(*t)).collect();
        let rms = |of: &[f64]| (of.iter().map(|e| e * e).sum::<f64>() / of.len() as f64).sqrt();
        let sizes = |noise: ChannelNoise, error: &dyn Fn(&[f64]) -> Vec<f64>| {
            let column: Vec<f64> = exact.iter().zip(error(&exact)).map(|(s, e)| s + e).collect();
            let smooth = noise.smoothed(&time, &column);
            let of = |e: &[f64]| [rms(e), rms(&running_integral(&time, e))];
            let mut random = ChaCha8Rng::seed_from_u64(1);
            let drawn = [(); 40].map(|()| of(&noise.drawn(&time, &smooth, random.random(), &mut random)));
            // Root mean square over the phases of the grid.
            let over = |of: &[[f64; 2]], k: usize| rms(&of.iter().map(|e| e[k]).collect::<Vec<f64>>());
            let shifted = |by: f64| error(&exact.iter().map(|s| s + by).collect::<Vec<f64>>());
            let own: Vec<[f64; 2]> = (0..40).map(|k| of(&shifted(0.3 / 40.0 * f64::from(k)))).collect();
            [[over(&own, 0), over(&own, 1)], [over(&drawn, 0), over(&drawn, 1)]]
        };
        let rounding = |s: &[f64]| s.iter().map(|s| (s / 0.3).round() * 0.3 - s).collect::<Vec<f64>>();
        let counting = |s: &[f64]| {
            let angle = running_integral(&time, s);
            means(&time, &angle.iter().map(|a| (a / 0.05).round() * 0.05 - a).collect::<Vec<f64>>())
        };
        let agree = |noise: ChannelNoise, error: &dyn Fn(&[f64]) -> Vec<f64>| {
            let [[of_rows, of_sums], [drawn, drawn_sums]] = sizes(noise, error);
            assert!((drawn / of_rows - 1.0).abs() < 0.1, "{noise:?}: {of_rows} {drawn}");
            // What a signal does beyond its last crossing hangs on it alone.
            assert!((0.5..2.0).contains(&(drawn_sums / of_sums)), "{noise:?}: {of_sums} {drawn_sums}");
        };
        agree(ChannelNoise::Rounded(0.3), &rounding);
        agree(ChannelNoise::Counted(0.05), &counting);
        assert_eq!(
            ChannelNoise::None.drawn(&time, &exact, 0.5, &mut ChaCha8Rng::seed_from_u64(1)),
            vec![0.0; time.len()]
        );
    }
}
