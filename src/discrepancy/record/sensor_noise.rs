//! What the sensor adds to the rows of a log.

use super::run_record::Record;
use rand::Rng;
use rand_chacha::ChaCha8Rng;
use rand_distr::StandardNormal;

/// The noise of measured columns.
#[derive(Clone, Debug, PartialEq)]
pub struct Noise {
    /// Variance of each component of the measurement noise, as outputs name them.
    pub variance: Vec<f64>,
    /// How many rows in a row are alike, at least 1: the integrated correlation (1 + ρ)/(1 − ρ) where each row keeps the
    /// share ρ of the one before.
    pub correlation_time: f64,
}

impl Noise {
    /// The measured columns with noise added.
    pub(crate) fn added_to(&self, record: &Record, rng: &mut ChaCha8Rng) -> Vec<Vec<f64>> {
        let kept = (self.correlation_time - 1.0) / (self.correlation_time + 1.0);
        let fresh = (1.0 - kept * kept).sqrt();
        let mut noisy = record.columns.clone();
        for channel in record.channels() {
            let sigma = self.variance[channel.noise].sqrt();
            let mut last: Option<f64> = None;
            for (i, y) in noisy[channel.column].iter_mut().enumerate() {
                let drawn: f64 = rng.sample(StandardNormal);
                let noise = last.map_or(drawn, |last| kept * last + fresh * drawn);
                *y += sigma * record.weights.deviation(channel.column, i) * noise;
                last = Some(noise);
            }
        }
        noisy
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::Timing;
    use rand::SeedableRng;

    /// Each channel by its own deviation; neighbours alike by (τ − 1)/(τ + 1), and of white noise not at all.
    #[test]
    fn noise_has_its_deviation_and_its_colour() {
        let n = 40_000;
        let time: Vec<f64> = (0..n).map(|i| 0.01 * f64::from(i)).collect();
        let zero = vec![0.0; time.len()];
        let record = Record::new("", time.clone(), vec![zero.clone(); 3], true, &[zero], Timing::Sample);
        for (correlation_time, kept) in [(1.0, 0.0), (3.0, 0.5), (9.0, 0.8)] {
            let noise = Noise { variance: vec![0.04, 0.25], correlation_time };
            let noisy = noise.added_to(&record, &mut ChaCha8Rng::seed_from_u64(5));
            for (column, std) in noisy.iter().zip([0.2, 0.2, 0.5]) {
                let moment = |lag: usize| {
                    let pairs = column.iter().zip(column.iter().skip(lag));
                    pairs.map(|(a, b)| a * b).sum::<f64>() / f64::from(n)
                };
                assert!(
                    (moment(0).sqrt() / std - 1.0).abs() < 0.05,
                    "{correlation_time}: {} for {std}",
                    moment(0).sqrt()
                );
                assert!((moment(1) / moment(0) - kept).abs() < 0.02, "{correlation_time}: {}", moment(1) / moment(0));
            }
        }
    }
}
