//! A rounded signal between its steps, by interpolation of its level crossings.
//!
//! Where a rounded value changes, the signal crosses the middle between the two values; that is all a slow one tells.
//!
//! | symbol | meaning |
//! |---|---|
//! | s | a step |
//! | τ | the time that a signal usually takes from one level to the next |
//! | ℓ, u | the length of a stretch between crossings, and the time from the nearer of them |
//! | s·u·(ℓ − u)/(ℓ·τ) | how far a signal goes beyond a level that it crosses back, as fast as it usually does; ½·s at most |

use super::local_polynomial::median;

/// Stretches that come back, at least, of a wave.
const FEWEST_WAVES: usize = 3;

/// A time and the level that is crossed then.
type Crossing = (f64, f64);

/// The signal at each row: on the lines through its crossings, beyond the first and the last of them as it was logged.
///
/// In a stretch whose ends cross the same level from within it the signal was beyond that level, on the side that was logged.
pub(crate) fn between_steps(time: &[f64], rounded: &[f64], step: f64) -> Vec<f64> {
    let changes = (1..rounded.len()).filter(|i| rounded[*i] != rounded[i - 1]);
    let crossing = |i: usize| (0.5 * (time[i - 1] + time[i]), 0.5 * (rounded[i - 1] + rounded[i]));
    let crossings: Vec<Crossing> = changes.map(crossing).collect();
    let pace = Pace::of(&crossings, step);
    let mut found = rounded.to_vec();
    let mut next = 0;
    for (i, value) in found.iter_mut().enumerate() {
        while crossings.get(next).is_some_and(|(t, _)| *t <= time[i]) {
            next += 1;
        }
        *value = match (next.checked_sub(1).map(|k| crossings[k]), crossings.get(next)) {
            (Some((t0, from)), Some((t1, to))) if is_same(from, *to, step) => {
                from + (rounded[i] - from).signum() * step * pace.bow(time[i] - t0, t1 - t0)
            }
            (Some((t0, from)), Some((t1, to))) => from + (time[i] - t0) / (t1 - t0) * (to - from),
            (Some((t, from)), None) => from + (rounded[i] - from) * pace.settled(time[i] - t),
            (None, Some((t, to))) => to + (rounded[i] - to) * pace.settled(t - time[i]),
            (None, None) => rounded[i],
        };
    }
    found
}

/// How fast a signal is.
struct Pace {
    /// The time that it takes from one level to the next.
    usual: f64,
    /// Whether it is a wave of about a step's height, that mostly comes back to the level it left.
    is_wave: bool,
}

impl Pace {
    /// By the time between crossings of neighbouring levels, in the middle; of a wave by half of the time until it comes back, if
    /// that is less.
    fn of(crossings: &[Crossing], step: f64) -> Self {
        let is_back = |w: &&[Crossing]| is_same(w[0].1, w[1].1, step);
        let (back, across): (Vec<_>, Vec<_>) = crossings.windows(2).partition(is_back);
        let is_wave = back.len() >= FEWEST_WAVES && back.len() > across.len();
        let middle = |stretches: &[&[Crossing]]| {
            median(&mut stretches.iter().map(|w| w[1].0 - w[0].0).collect::<Vec<f64>>()).unwrap_or(f64::INFINITY)
        };
        let (back, across) = (middle(&back), middle(&across));
        let usual = match (is_wave, across.is_finite()) {
            (true, _) => across.min(0.5 * back),
            (false, true) => across,
            (false, false) => back,
        };
        Self { usual, is_wave }
    }

    /// How far a signal is beyond a level, in steps, so long after it crossed it, of the time until it crosses it back.
    fn bow(&self, u: f64, length: f64) -> f64 {
        match self.is_wave && length > 2.0 * self.usual {
            true => 0.5 * self.settled(u.min(length - u)),
            false => (length / self.usual).min(2.0) * (u / length) * (1.0 - u / length),
        }
    }

    /// How much of the half step from a crossing to the value that was logged a wave has gone after some time. Of another signal
    /// nothing is known beyond its crossings.
    fn settled(&self, u: f64) -> f64 {
        if self.is_wave { 1.0 - (1.0 - (u / self.usual).min(1.0)).powi(2) } else { 1.0 }
    }
}

fn is_same(from: f64, to: f64, step: f64) -> bool {
    (to - from).abs() < 0.5 * step
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A line comes back but for its ends, a slow wave to a small part of the step; a stretch that comes back is a bow of a
    /// quarter of a step.
    #[test]
    fn a_slow_signal_comes_back() {
        let time: Vec<f64> = (0..4000).map(|i| 0.01 * f64::from(i)).collect();
        let most = |signal: &dyn Fn(f64) -> f64, within: std::ops::Range<usize>| {
            let rounded: Vec<f64> = time.iter().map(|t| (signal(*t) / 0.1).round() * 0.1).collect();
            let found = between_steps(&time, &rounded, 0.1);
            within.map(|i| (found[i] - signal(time[i])).abs()).fold(0.0, f64::max)
        };
        assert!(most(&|t| 0.037 * t, 200..3800) < 1e-3);
        assert!(most(&|t| (0.4 * t).sin(), 200..3800) < 0.06);
        let bow = between_steps(&[0.0, 1.0, 2.0, 3.0, 4.0], &[0.0, 1.0, 1.0, 1.0, 0.0], 1.0);
        assert_eq!(bow, [0.0, 0.5 + 5.0 / 36.0, 0.75, 0.5 + 5.0 / 36.0, 0.0]);
        // A wave of about a step's height is followed, though most of it is within a step.
        let wave = |t: f64| 0.2 + 0.07 * (0.9 * t).sin() + 0.04 * (2.3 * t).cos();
        let rounded: Vec<f64> = time.iter().map(|t| (wave(*t) / 0.1).round() * 0.1).collect();
        let found = between_steps(&time, &rounded, 0.1);
        let off = |of: &[f64]| of.iter().zip(&time).map(|(v, t)| (v - wave(*t)).powi(2)).sum::<f64>();
        assert!(off(&found) < 0.5 * off(&rounded), "{} {}", off(&found), off(&rounded));
        // Never changed it is what was logged.
        assert_eq!(between_steps(&[0.0, 1.0], &[0.3, 0.3], 0.1), [0.3, 0.3]);
    }
}
