//! Both creeps of a wheel from 1000 samples of its motion: by the library, and by hand.

use super::wheel;
use creepage::discrepancy::estimation::rate_regression::{RateFit, RateSamples};

pub const SAMPLES: usize = 1000;
const R: f64 = 0.5;
const TRUTH: [f64; 2] = [0.1, 0.2];
/// m/s
const NOISE: f64 = 0.01;
/// The largest change of all residuals together that is rounding, as a share of the rates.
const SETTLED: f64 = 1e-12;

/// Heading, rate of the wheel, measured x′ and y′ of a sample.
pub fn sample(i: usize) -> [f64; 4] {
    let t = 0.02 * i as f64;
    let (phi, u) = (0.3 * t + 0.4 * (0.7 * t).sin(), 2.0 + 0.5 * t.cos());
    let forward = (1.0 - TRUTH[0]) * R * u;
    let left = TRUTH[1] * forward;
    let noise = |k: usize| NOISE * (((i * 7919 + k * 104_729) % 1999) as f64 / 999.0 - 1.0);
    let (s, c) = phi.sin_cos();
    [phi, u, forward * c - left * s + noise(0), forward * s + left * c + noise(1)]
}

/// The library's side, compiled beforehand.
pub struct Library {
    fit: RateFit,
    samples: RateSamples,
}

impl Library {
    pub fn new() -> Self {
        let rows: Vec<[f64; 4]> = (0..SAMPLES).map(sample).collect();
        let column = |k: usize| rows.iter().map(|row| row[k]).collect::<Vec<f64>>();
        let none = vec![0.0; SAMPLES];
        let samples = RateSamples {
            states: vec![none.clone(), none.clone(), column(0)],
            inputs: vec![column(1), none],
            rates: vec![column(2), column(3), vec![f64::NAN; SAMPLES]],
            deviations: vec![1.0; 3],
        };
        Self { fit: RateFit::of(&wheel::free_model()).unwrap(), samples }
    }

    /// e_rc and e_tc.
    pub fn run(&self) -> Vec<f64> {
        self.fit.to(&self.samples).unwrap().p
    }
}

/// Gauss and Newton's steps by hand, one sample after another, to the same end.
pub fn by_hand(rows: &[[f64; 4]]) -> [f64; 2] {
    let mut e = [0.0; 2];
    loop {
        let (mut g, mut h, mut measured) = ([0.0; 2], [0.0; 3], 0.0);
        for [phi, u, x, y] in rows {
            let (s, c) = phi.sin_cos();
            let v = R * u;
            let forward = (1.0 - e[0]) * v;
            let left = e[1] * forward;
            let r = [forward * c - left * s - x, forward * s + left * c - y];
            let by_rc = [-v * (c - e[1] * s), -v * (s + e[1] * c)];
            let by_tc = [-forward * s, forward * c];
            for k in 0..2 {
                g[0] += by_rc[k] * r[k];
                g[1] += by_tc[k] * r[k];
                h[0] += by_rc[k] * by_rc[k];
                h[1] += by_rc[k] * by_tc[k];
                h[2] += by_tc[k] * by_tc[k];
            }
            measured += x * x + y * y;
        }
        let d = h[0] * h[2] - h[1] * h[1];
        let step = [-(h[2] * g[0] - h[1] * g[1]) / d, -(h[0] * g[1] - h[1] * g[0]) / d];
        let change = step[0] * (h[0] * step[0] + 2.0 * h[1] * step[1]) + h[2] * step[1] * step[1];
        (e[0], e[1]) = (e[0] + step[0], e[1] + step[1]);
        if change <= SETTLED * SETTLED * measured {
            return e;
        }
    }
}
