//! The Rauch–Tung–Striebel smoother of a noisy signal whose slope walks at random (Rauch, Tung & Striebel, 1965).
//!
//! The state is the signal and its slope, x = (s, ṡ), the slope a Wiener process of intensity q:
//!
//! | symbol | formula | meaning |
//! |---|---|---|
//! | F | \[1 Δt; 0 1\] | transition over Δt |
//! | Q | q·\[Δt³/3 Δt²/2; Δt²/2 Δt\] | variance that the transition adds |
//! | y | s + e, var e = R | what was measured |
//!
//! q maximises the likelihood of the innovations; R is known. The start is known to nobody.

use nalgebra::{Matrix2, Vector2};

/// Ratios of q·Δt³ to R, powers of ten, between which the intensity is sought.
const INTENSITIES: (i32, i32) = (-9, 9);
/// The variance of the start, in units of the spread of what was measured.
const UNKNOWN: f64 = 1e4;

/// The signal at each time from all that was measured of it with a variance.
pub(crate) fn smoothed(time: &[f64], measured: &[f64], variance: f64) -> Vec<f64> {
    let steps: Vec<f64> = time.windows(2).map(|w| w[1] - w[0]).collect();
    let usual = steps.iter().sum::<f64>() / steps.len().max(1) as f64;
    if measured.len() < 4 || usual <= 0.0 || variance <= 0.0 {
        return measured.to_vec();
    }
    let intensity = |power: f64| 10.0_f64.powf(power) * variance / usual.powi(3);
    let likelihood = |power: f64| Filter::run(&steps, measured, variance, intensity(power)).log_likelihood;
    let best = |powers: &mut dyn Iterator<Item = f64>| {
        let each = powers.map(|power| (power, likelihood(power)));
        each.max_by(|a, b| a.1.total_cmp(&b.1)).map_or(0.0, |(power, _)| power)
    };
    let coarse = best(&mut (INTENSITIES.0..=INTENSITIES.1).map(f64::from));
    let fine = best(&mut (-4..=4).map(|k| coarse + 0.2 * f64::from(k)));
    Filter::run(&steps, measured, variance, intensity(fine)).back(&steps)
}

/// The Kalman filter's pass forwards.
struct Filter {
    /// The state and its variance before and after each measurement.
    predicted: Vec<(Vector2<f64>, Matrix2<f64>)>,
    updated: Vec<(Vector2<f64>, Matrix2<f64>)>,
    log_likelihood: f64,
}

impl Filter {
    fn run(steps: &[f64], measured: &[f64], variance: f64, intensity: f64) -> Self {
        let mean = measured.iter().sum::<f64>() / measured.len() as f64;
        let spread = variance + measured.iter().map(|y| (y - mean).powi(2)).sum::<f64>() / measured.len() as f64;
        let slopes = spread / steps[0].powi(2);
        let mut state = Vector2::new(measured[0], 0.0);
        let mut covariance = UNKNOWN * Matrix2::new(spread, 0.0, 0.0, slopes);
        let mut found = Self { predicted: vec![], updated: vec![], log_likelihood: 0.0 };
        for (i, y) in measured.iter().enumerate() {
            if i > 0 {
                let f = transition(steps[i - 1]);
                state = f * state;
                covariance = f * covariance * f.transpose() + added(steps[i - 1], intensity);
            }
            found.predicted.push((state, covariance));
            let innovation = y - state[0];
            let expected = covariance[(0, 0)] + variance;
            let gain = covariance.column(0) / expected;
            state += gain * innovation;
            covariance -= gain * covariance.row(0);
            found.updated.push((state, covariance));
            // The first two tell the start alone.
            if i > 1 {
                found.log_likelihood -= 0.5 * (expected.ln() + innovation * innovation / expected);
            }
        }
        found
    }

    /// The pass backwards.
    fn back(&self, steps: &[f64]) -> Vec<f64> {
        let Some((mut later, _)) = self.updated.last().copied() else { return vec![] };
        let mut signal = vec![later[0]; self.updated.len()];
        for i in (0..steps.len()).rev() {
            let (state, covariance) = self.updated[i];
            let (predicted, before) = self.predicted[i + 1];
            if let Some(inverse) = before.try_inverse() {
                later = state + covariance * transition(steps[i]).transpose() * inverse * (later - predicted);
            } else {
                later = state;
            }
            signal[i] = later[0];
        }
        signal
    }
}

fn transition(dt: f64) -> Matrix2<f64> {
    Matrix2::new(1.0, dt, 0.0, 1.0)
}

fn added(dt: f64, intensity: f64) -> Matrix2<f64> {
    let (cubic, square) = (dt.powi(3) / 3.0, dt.powi(2) / 2.0);
    intensity * Matrix2::new(cubic, square, square, dt)
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::{Rng, SeedableRng};
    use rand_chacha::ChaCha8Rng;
    use rand_distr::StandardNormal;

    fn rms(a: &[f64], b: &[f64]) -> f64 {
        (a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>() / a.len() as f64).sqrt()
    }

    /// A slow signal loses most of its noise, a fast one keeps its course, a line becomes the line of least squares.
    #[test]
    fn noise_goes_and_the_signal_stays() {
        let mut random = ChaCha8Rng::seed_from_u64(3);
        let time: Vec<f64> = (0..2000).map(|i| 0.02 * f64::from(i)).collect();
        for (rate, share) in [(0.0, 0.1), (0.7, 0.35), (30.0, 1.0)] {
            let exact: Vec<f64> = time.iter().map(|t| 0.3 * t + (rate * t).sin()).collect();
            let noisy: Vec<f64> = exact.iter().map(|s| s + 0.05 * random.sample::<f64, _>(StandardNormal)).collect();
            let found = rms(&smoothed(&time, &noisy, 0.05 * 0.05), &exact);
            assert!(found < share * 0.05, "{rate}: {found}");
        }
    }

    /// With two neighbours each, and the weights of the closed form for a constant slope.
    #[test]
    fn without_a_walk_it_is_the_line_of_least_squares() {
        let (time, measured) = ([0.0, 1.0, 2.0, 3.0], [0.0, 1.5, 1.5, 3.0]);
        let line = Filter::run(&[1.0; 3], &measured, 1.0, 1e-12).back(&[1.0; 3]);
        let expected = time.map(|t| 0.15 + 0.9 * t);
        assert!(line.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-3), "{line:?}");
        // Fewer than four are left as they are, and so is what has no noise.
        assert_eq!(smoothed(&time[..3], &measured[..3], 1.0), measured[..3]);
        assert_eq!(smoothed(&time, &measured, 0.0), measured);
    }
}
