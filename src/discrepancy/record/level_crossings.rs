//! A rounded signal between its steps, by linear interpolation of its level crossings.
//!
//! Where a rounded value changes, the signal crosses the middle between the two values; that is all a slow one tells.

/// The signal at each row: on the lines through its crossings, beyond the first and the last of them as it was logged.
///
/// In a stretch whose ends cross the same level from within it, the signal was beyond that level by an unknown part of a
/// step, on the side that was logged: a quarter of a step is halfway.
pub(crate) fn between_steps(time: &[f64], rounded: &[f64], step: f64) -> Vec<f64> {
    let changes = (1..rounded.len()).filter(|i| rounded[*i] != rounded[i - 1]);
    let crossing = |i: usize| (0.5 * (time[i - 1] + time[i]), 0.5 * (rounded[i - 1] + rounded[i]));
    let crossings: Vec<(f64, f64)> = changes.map(crossing).collect();
    let mut found = rounded.to_vec();
    let mut next = 0;
    for (i, value) in found.iter_mut().enumerate() {
        while crossings.get(next).is_some_and(|(t, _)| *t <= time[i]) {
            next += 1;
        }
        let (Some((t0, from)), Some((t1, to))) = (next.checked_sub(1).map(|k| crossings[k]), crossings.get(next))
        else {
            continue;
        };
        let share = (time[i] - t0) / (t1 - t0);
        let line = from + share * (to - from);
        // A parabola over the stretch has its top halfway; its mean is two thirds of that.
        let beyond = if (to - from).abs() < 0.5 * step {
            (rounded[i] - from).signum() * step * share * (1.0 - share)
        } else {
            0.0
        };
        *value = line + beyond;
    }
    found
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
        // Never changed it is what was logged.
        assert_eq!(between_steps(&[0.0, 1.0], &[0.3, 0.3], 0.1), [0.3, 0.3]);
    }
}
