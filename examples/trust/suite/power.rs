//! What the data of a case can tell, computed from the simulator alone.
//!
//! The noise-free log changes with an effect's amplitude by a vector; in units of the noise, and outside what
//! another start of every stretch would do, its squared length is the χ² that the effect makes. Outside what a
//! rival can do as well, it is the χ² that tells the effect from the rival.

use super::basis::Basis;
use super::class;
use super::make::Target;
use super::secret;
use crate::simulator::{Hidden, Log, Noise, Outliers, Scenario, Vehicle};
use nalgebra::DVector;

/// χ² an effect has to make to count as visible: 14 standard deviations.
pub const VISIBLE: f64 = 200.0;
/// χ² that has to tell it from every rival.
pub const APART: f64 = 40.0;
/// Rows per second that are enough for smooth motion, Hz; each counts for several of the log.
const THINNED: f64 = 4.0;
/// Steps of the integration that are short enough for how a log changes, s: of order six, they are off by less than 10⁻¹⁰.
const COARSE: f64 = 0.05;
/// Share of a run that is fitted.
pub const FITTED: f64 = 0.75;

/// How well a case's data show one hidden effect.
#[derive(Clone, Debug)]
pub struct Power {
    /// χ² of the effect against none.
    pub visible: f64,
    /// Every rival with the χ² that tells the effect from it, the nearest first.
    pub rivals: Vec<(Target, f64)>,
}

impl Power {
    /// Whether the data show the effect and tell it from every rival.
    pub fn determined(&self) -> bool {
        self.visible >= VISIBLE && self.rivals.first().is_none_or(|(_, apart)| *apart >= APART)
    }

    /// Whether the data cannot be expected to tell the effect from that one.
    pub fn excuses(&self, rival: Target) -> bool {
        self.rivals.iter().any(|(t, apart)| class::same(*t, rival) && *apart < APART)
    }
}

/// The power of a scenario's data to show each of its hidden effects, among the targets of its make.
pub fn powers(scenario: &Scenario, targets: &[Target]) -> Vec<Power> {
    let clean = Clean::of(scenario);
    let truth = clean.log(&scenario.hidden);
    let base = clean.values(&truth);
    let moved = |hidden: &[Hidden]| clean.values(&clean.log(hidden)) - &base;
    // The hidden effects' own directions, for their whole size.
    let own: Vec<DVector<f64>> = (0..scenario.hidden.len())
        .map(|i| {
            let mut hidden = scenario.hidden.clone();
            let mut grown = |by: f64| {
                hidden[i] = secret::amplified(&scenario.hidden[i], 1.0 + by);
                moved(&hidden)
            };
            // What is not linear in so small a step cancels: it would tell an effect from one that does the same.
            (grown(GROWN) - grown(-GROWN)) / (2.0 * GROWN)
        })
        .collect();
    let hides = |t: &Target| scenario.hidden.iter().any(|h| class::same(*t, secret::target(h)));
    let felt = |t: Target| {
        let by = |p: Hidden| moved(&[&scenario.hidden[..], &[p]].concat());
        let both_ways = |(probe, mirrored): (Hidden, Option<Hidden>)| match mirrored {
            Some(other) => (by(probe) - by(other)) / 2.0,
            None => by(probe),
        };
        secret::probes(t).into_iter().map(both_ways).collect::<Vec<_>>()
    };
    let rivals: Vec<(Target, Vec<DVector<f64>>)> =
        targets.iter().filter(|t| !hides(t)).map(|t| (*t, felt(*t))).collect();
    let starts = clean.starts(&truth);
    (0..own.len())
        .map(|i| {
            let others = own.iter().enumerate().filter(|(k, _)| *k != i).map(|(_, v)| v);
            let basis = others.fold(starts.clone(), Basis::with);
            power(&own[i], secret::target(&scenario.hidden[i]), &basis, &rivals)
        })
        .collect()
}

/// Share by which a hidden effect is enlarged to see in what direction it acts.
const GROWN: f64 = 5e-4;

fn power(own: &DVector<f64>, at: Target, basis: &Basis, rivals: &[(Target, Vec<DVector<f64>>)]) -> Power {
    let mut apart: Vec<(Target, f64)> = rivals
        .iter()
        .filter(|(t, _)| !class::contains(t.0, at.0))
        .map(|(t, felt)| (*t, felt.iter().fold(basis.clone(), Basis::with).outside(own).norm_squared()))
        .collect();
    apart.sort_by(|a, b| a.1.total_cmp(&b.1));
    Power { visible: basis.outside(own).norm_squared(), rivals: apart }
}

/// The fitted part of a scenario, thinned and without noise, with the weight of each kind of value.
struct Clean<'a> {
    scenario: &'a Scenario,
    thinned: Scenario,
    position: f64,
    heading: f64,
}

impl<'a> Clean<'a> {
    fn of(scenario: &'a Scenario) -> Self {
        let thinned = Scenario {
            noise: Noise::default(),
            outliers: Outliers::default(),
            jitter: 0.0,
            dropouts: 0.0,
            wrap_heading: false,
            step: COARSE,
            rate: THINNED,
            duration: FITTED * scenario.duration,
            ..scenario.clone()
        };
        let rows = (scenario.rate * (1.0 - scenario.dropouts) / THINNED).sqrt();
        Clean { scenario, thinned, position: rows / scenario.noise.position, heading: rows / scenario.noise.heading }
    }

    fn log(&self, hidden: &[Hidden]) -> Log {
        Scenario { hidden: hidden.to_vec(), ..self.thinned.clone() }.run()
    }

    /// How many columns are measured: x, y, headings.
    fn measured(&self) -> usize {
        2 + usize::from(self.scenario.logs_heading) + self.scenario.vehicle.trailers()
    }

    fn weight(&self, column: usize) -> f64 {
        if column < 2 { self.position } else { self.heading }
    }

    /// All measured values in units of the noise.
    fn values(&self, log: &Log) -> DVector<f64> {
        let m = self.measured();
        DVector::from_fn(m * log.rows.len(), |i, _| log.rows[i / m][1 + i % m] * self.weight(i % m))
    }

    /// What another pose at the start of each stretch would do.
    fn starts(&self, log: &Log) -> Basis {
        let mut basis = Basis::default();
        let mut ends: Vec<f64> = self.scenario.gaps.iter().map(|gap| gap.0).collect();
        ends.push(f64::INFINITY);
        let mut from = f64::NEG_INFINITY;
        for to in ends {
            let first = log.rows.iter().position(|row| row[0] >= from);
            if let Some(first) = first.filter(|first| log.rows[*first][0] < to) {
                for freedom in 0..3 + self.scenario.vehicle.trailers() {
                    basis = basis.with(&self.freedom(log, first, to, freedom));
                }
            }
            from = to;
        }
        basis
    }

    /// One freedom of a stretch's start: x, y, a turn about its first row, or the bend of a trailer, which the
    /// road straightens.
    fn freedom(&self, log: &Log, first: usize, to: f64, freedom: usize) -> DVector<f64> {
        let m = self.measured();
        let headings = 2..2 + usize::from(self.scenario.logs_heading);
        let [x0, y0] = [log.rows[first][1], log.rows[first][2]];
        let mut road = 0.0;
        let mut out = DVector::zeros(m * log.rows.len());
        for (i, row) in log.rows.iter().enumerate().skip(first).take_while(|(_, row)| row[0] < to) {
            road += log.truth[i].v_l.abs() / THINNED;
            for column in 0..m {
                let by = match (freedom, column) {
                    (0 | 1, _) => f64::from(u8::from(column == freedom)),
                    (2, 0) => y0 - row[2],
                    (2, 1) => row[1] - x0,
                    (2, _) => 1.0,
                    (f, c) if c >= headings.end && c - headings.end == f - 3 => (-road / self.length(f - 3)).exp(),
                    _ => 0.0,
                };
                out[i * m + column] = by * self.weight(column);
            }
        }
        out
    }

    fn length(&self, trailer: usize) -> f64 {
        match &self.scenario.vehicle {
            Vehicle::NTrailer { lengths, .. } => lengths[trailer],
            Vehicle::Alone(_) => f64::INFINITY,
        }
    }
}
