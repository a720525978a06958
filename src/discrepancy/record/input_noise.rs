//! What was added to the inputs before they were logged: ticks of an encoder, few digits, a gyroscope's noise.
//!
//! | kind | its error |
//! |---|---|
//! | counted | the *integral* is off by what is missing to the next tick: errors of neighbouring means cancel |
//! | rounded | each value is off by what is missing to the next step, as long as the signal stays within it |
//! | white | each row by itself |
//!
//! Noise like it is that of the same logger whose ticks and steps lie elsewhere: the signal is the smoothed one.

use super::level_crossings::between_steps;
use super::local_polynomial;
use super::quantisation::{root_mean_square, staircase_step, step_above, tick_of};
use super::rauch_tung_striebel::smoothed;
use crate::motion::{Signals, Timing, running_integral};
use crate::numerics::usual_step;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::StandardNormal;
use std::sync::OnceLock;

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
/// White noise less than this share of an input, root mean square, is none: so little is not told from its own course.
const LEAST: f64 = 0.001;
/// Steps are told from less than that.
const LEAST_STEP: f64 = 0.0005;
/// Of white noise the differences from the neighbours' cubic are correlated by −0.8 from row to row.
const WHITE: f64 = -0.6;

impl InputNoise {
    /// The noise that columns of inputs show.
    pub fn of(time: &[f64], columns: &[Vec<f64>], timings: &[Timing]) -> Self {
        let of = |(column, timing): (&Vec<f64>, &Timing)| of_column(time, column, *timing);
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

impl ChannelNoise {
    /// The signal of a column without its noise; of what is counted the integral.
    fn smoothed(self, time: &[f64], column: &[f64]) -> Vec<f64> {
        match self {
            Self::None => vec![0.0; column.len()],
            Self::White(std) => smoothed(time, column, std * std),
            Self::Rounded(step) => between_steps(time, column, step),
            Self::Counted(tick) => smoothed(time, &running_integral(time, column), tick * tick / 12.0),
        }
    }

    /// What a smoother changes of a column.
    fn smoothing(self, time: &[f64], column: &[f64], smooth: &[f64]) -> Vec<f64> {
        let less = |rough: &[f64]| smooth.iter().zip(rough).map(|(s, r)| s - r).collect::<Vec<f64>>();
        match self {
            Self::None => vec![0.0; column.len()],
            Self::White(_) | Self::Rounded(_) => less(column),
            Self::Counted(_) => means(time, &less(&running_integral(time, column))),
        }
    }

    /// An error for each row: that of the smoothed signal where ticks and steps lie elsewhere, by a phase of their distance.
    fn drawn(self, time: &[f64], smooth: &[f64], phase: f64, random: &mut ChaCha8Rng) -> Vec<f64> {
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
fn means(time: &[f64], integral: &[f64]) -> Vec<f64> {
    let mean = |i: usize| if i == 0 { 0.0 } else { (integral[i] - integral[i - 1]) / (time[i] - time[i - 1]) };
    (0..integral.len()).map(mean).collect()
}

fn of_column(time: &[f64], column: &[f64], timing: Timing) -> ChannelNoise {
    let tick = (timing == Timing::IntervalMean).then(|| tick_of(time, column)).flatten();
    if let Some(tick) = tick {
        return ChannelNoise::Counted(tick);
    }
    // Means of a counter whose stamps are not the times of counting lie on no grid, though a part of them may.
    let is_sampled = timing == Timing::Sample;
    if let Some(step) = step_above(column, LEAST_STEP, is_sampled) {
        return ChannelNoise::Rounded(step);
    }
    match local_polynomial::noise(time, column) {
        Some(std) if std > LEAST * root_mean_square(column) && is_white(time, column) => ChannelNoise::White(std),
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
        let time = time();
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
        let time = time();
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
        let (time, exact) = (time(), time().iter().map(|t| wave(*t)).collect::<Vec<f64>>());
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
