//! A share of cases with its exact binomial interval.

use serde::Serialize;
use statrs::distribution::{Beta, ContinuousCDF};

/// `k` of `n` cases.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Share {
    /// Cases that count.
    pub k: u64,
    /// All cases.
    pub n: u64,
}

impl Share {
    /// Counts one more case.
    pub fn count(&mut self, counts: bool) {
        self.k += u64::from(counts);
        self.n += 1;
    }

    /// k/n; NaN of no case.
    pub fn value(&self) -> f64 {
        self.k as f64 / self.n as f64
    }

    /// The 95 % interval of Clopper and Pearson: the probabilities under which neither so few nor so many cases
    /// would be rarer than 1 in 40.
    pub fn interval(&self) -> [f64; 2] {
        let (k, n) = (self.k as f64, self.n as f64);
        let quantile = |a: f64, b: f64, p: f64| Beta::new(a, b).map_or(f64::NAN, |d| d.inverse_cdf(p));
        let low = if self.k == 0 { 0.0 } else { quantile(k, n - k + 1.0, 0.025) };
        let high = if self.k == self.n { 1.0 } else { quantile(k + 1.0, n - k, 0.975) };
        [low, high]
    }

    /// `k of n, p % [low, high]`.
    pub fn text(&self) -> String {
        if self.n == 0 {
            return "none".into();
        }
        let [low, high] = self.interval().map(|p| 100.0 * p);
        format!("{} of {}: {:.1} % [{low:.1}, {high:.1}]", self.k, self.n, 100.0 * self.value())
    }
}
