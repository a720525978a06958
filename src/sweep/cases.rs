//! The values of a case: a point of the grid and a random draw, reproducible from the seed and the case's number.

use super::names::Allowed;
use crate::files::{AxisValues, Distribution, SweepFile};
use rand::Rng;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution as _, StandardNormal};

/// How often a draw that is not allowed is drawn again: a distribution with a hundredth of its mass in the
/// allowed range gives a value all the same.
const MAX_DRAWS: usize = 1000;

/// Cases in their order: the grid, its last axis fastest, and for each point the draws.
///
/// A draw depends on the seed and the number of its case alone, so that any part of a sweep can be made by itself.
#[derive(Clone)]
pub(super) struct Cases {
    grid: Vec<AxisValues>,
    sampled: Vec<(Distribution, Allowed)>,
    count: usize,
    seed: u64,
}

impl Cases {
    pub fn new(file: &SweepFile, allowed: &[Allowed]) -> Self {
        let sampled = file.sampled.iter().zip(allowed).map(|(s, a)| (s.from, *a)).collect();
        let grid = file.grid.iter().map(|a| a.values.clone()).collect();
        Self { grid, sampled, count: file.count, seed: file.seed }
    }

    /// Adds the values of a case: those of the grid, then those drawn.
    pub fn push(&self, case: usize, values: &mut Vec<f64>) {
        let mut point = case / self.count;
        let first = values.len();
        values.resize(first + self.grid.len(), 0.0);
        for (value, axis) in values[first..].iter_mut().zip(&self.grid).rev() {
            *value = axis.at(point % axis.count());
            point /= axis.count();
        }
        if !self.sampled.is_empty() {
            let mut rng = ChaCha8Rng::seed_from_u64(self.seed);
            rng.set_stream(case as u64);
            values.extend(self.sampled.iter().map(|(from, allowed)| draw(*from, *allowed, &mut rng)));
        }
    }
}

/// A value within what is allowed; a normal distribution is cut off there.
fn draw(from: Distribution, allowed: Allowed, rng: &mut ChaCha8Rng) -> f64 {
    let mut once = || match from {
        Distribution::Uniform(a, b) => {
            let s: f64 = rng.random();
            a * (1.0 - s) + b * s
        }
        Distribution::LogUniform(a, b) => {
            let s: f64 = rng.random();
            libm::exp(libm::log(a) * (1.0 - s) + libm::log(b) * s)
        }
        Distribution::Normal(mean, sigma) => {
            let z: f64 = StandardNormal.sample(rng);
            mean + sigma * z
        }
    };
    // A distribution that hardly ever gives an allowed value leaves the case undefined.
    (0..MAX_DRAWS).map(|_| once()).find(|v| allowed.holds(*v)).unwrap_or(f64::NAN)
}
