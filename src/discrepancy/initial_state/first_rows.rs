//! The rows of a log soon after one, which show how states that no sensor sees began.

use crate::discrepancy::record::local_polynomial;
use crate::discrepancy::record::run_record::Record;
use crate::model::Equations;
use crate::motion::{LaneStates, LaneStepper, Stepper, initial_hidden};
use nalgebra::DVector;

/// What is looked at of the poses, s.
const SOON: f64 = 3.0;
/// With fewer rows nothing is said.
const FEWEST: usize = 8;

/// How many beginnings are tried side by side.
const LANES: usize = 8;

/// Rows soon after one, as what a model gives there is compared with them.
pub(crate) struct Rows<'a> {
    equations: &'a Equations,
    pub p: &'a [f64],
    record: &'a Record,
    first: usize,
    last: usize,
    /// Of each column.
    noise: Vec<f64>,
}

impl<'a> Rows<'a> {
    /// The rows up to a hole or some seconds later; `None` where too few are left to say anything.
    pub fn of(equations: &'a Equations, p: &'a [f64], record: &'a Record, row: usize) -> Option<Self> {
        let time = &record.time;
        let gap = record.gap();
        let joined = |i: &usize| time[*i] - time[*i - 1] <= gap && time[*i] - time[row] <= SOON;
        let last = (row + 1..record.rows.end).take_while(joined).last()?;
        if last - row < FEWEST {
            return None;
        }
        let rows = row..last + 1;
        let noise = |c: &Vec<f64>| local_polynomial::noise(&time[rows.clone()], &c[rows.clone()]).map(|n| n.max(1e-9));
        let noise = record.columns.iter().map(noise).collect::<Option<Vec<f64>>>()?;
        Some(Self { equations, p, record, first: row, last, noise })
    }

    /// How large the equilibria of the hidden states are under the inputs.
    pub fn sizes(&self) -> Vec<f64> {
        let (n, m) = (self.equations.n(), self.equations.visible);
        let mut stepper = Stepper::new(self.equations, &self.record.signals, self.p);
        let mut sizes = vec![0.0_f64; n - m];
        for i in (self.first..=self.last).step_by(((self.last - self.first) / 8).max(1)) {
            let u = stepper.inputs(self.record.time[i]).to_vec();
            let rest = initial_hidden(self.equations, self.p, &u, &self.record.measured(i));
            sizes.iter_mut().zip(rest).for_each(|(a, h)| *a = a.max(h.abs()));
        }
        sizes
    }

    /// What a model with such values that begins with a pose and hidden states misses of each row and column, in units
    /// of the noise; of as many values and beginnings as there are.
    pub fn all_missed<'t>(&self, tries: impl Iterator<Item = (&'t [f64], &'t [f64])>) -> Option<Vec<DVector<f64>>> {
        let tries: Vec<(&[f64], &[f64])> = tries.collect();
        let mut found = Vec::with_capacity(tries.len());
        for some in tries.chunks(LANES) {
            let at = |l: usize| some[l.min(some.len() - 1)];
            let side_by_side =
                self.side_by_side::<LANES>(std::array::from_fn(|l| at(l).0), std::array::from_fn(|l| at(l).1));
            found.extend(side_by_side.into_iter().take(some.len()));
        }
        found.into_iter().collect()
    }

    fn side_by_side<const L: usize>(&self, p: [&[f64]; L], begin: [&[f64]; L]) -> Vec<Option<DVector<f64>>> {
        let mut stepper = LaneStepper::new(self.equations, &self.record.signals, p);
        let LaneStates { mut z, mut s } = LaneStates::of(begin);
        let (time, channels) = (&self.record.time, self.record.channels());
        let mut found = [(); L].map(|()| Vec::with_capacity((self.last - self.first) * channels.len()));
        for i in self.first..self.last {
            stepper.advance(&mut z, &mut s, &[time[i]; L], &[time[i + 1]; L]);
            let y = stepper.outputs_here(&z);
            for channel in &channels {
                let c = channel.column;
                for (found, y) in found.iter_mut().zip(y[channel.output]) {
                    let off = channel.difference(y - self.record.columns[c][i + 1]);
                    found.push(off / (self.noise[c] * self.record.weights.deviation(c, i + 1)));
                }
            }
        }
        let defined = |missed: Vec<f64>| missed.iter().all(|x| x.is_finite()).then(|| DVector::from_vec(missed));
        found.into_iter().map(defined).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrepancy::fixtures::{equations, logged};
    use std::f64::consts::TAU;

    impl Rows<'_> {
        /// One alone.
        fn missed(&self, p: &[f64], begin: &[f64]) -> Option<DVector<f64>> {
            self.side_by_side([p], [begin]).pop()?
        }
    }

    /// Rows every sixteenth of a second, of which sums are exact.
    fn sixteenths(rows: u32) -> Vec<f64> {
        (0..rows).map(|i| f64::from(i) / 16.0).collect()
    }

    const SLIDES: [(&str, &[f64]); 1] = [("relaxation-length", &[0.1, 0.8])];

    fn faster(t: f64) -> f64 {
        1.0 + t
    }

    #[test]
    fn rows_end_at_a_hole_or_seconds_later() {
        let (equations, p) = equations(&SLIDES);
        let record = |hole: f64| {
            let time = sixteenths(100).into_iter().map(|t| if t > 2.0 { t + hole } else { t }).collect();
            logged((&equations, &p), time, [&faster, &|_| 0.3], &[0.0; 4], 1e-4)
        };
        let last = |record: &Record, row: usize| Rows::of(&equations, &p, record, row).map(|rows| rows.last);
        let whole = record(0.0);
        assert_eq!([0, 10, 80, 91].map(|row| last(&whole, row)), [Some(48), Some(58), Some(99), Some(99)]);
        assert_eq!([92, 98, 99].map(|row| last(&whole, row)), [None; 3]);
        // A row after every half second, and nothing for longer: 2 s is row 32.
        assert_eq!(last(&record(0.4375), 0), Some(41));
        let apart = record(0.4376);
        assert_eq!([0, 24, 25, 33].map(|row| last(&apart, row)), [Some(32), Some(32), None, Some(81)]);
        let shorter = Record { rows: 0..20, ..whole };
        assert_eq!([0, 11, 12].map(|row| last(&shorter, row)), [Some(19), Some(19), None]);
    }

    #[test]
    fn a_state_is_as_large_as_its_inputs_make_it() {
        let (equations, p) = equations(&SLIDES);
        // The equilibrium is e_tc·r·φ'.
        for (sign, row, largest) in [(1.0, 0, 0.2), (-1.0, 0, 0.2), (1.0, 16, 0.25)] {
            let log = (&equations, &p[..]);
            let record = logged(log, sixteenths(100), [&|t| sign * faster(t), &|_| 0.3], &[0.0; 4], 1e-4);
            let [size] = Rows::of(&equations, &p, &record, row).unwrap().sizes()[..] else { panic!() };
            assert!((size - largest).abs() < 1e-9, "{sign} {row}: {size}");
        }
        let braking = |t: f64| 4.0 - t;
        let record = logged((&equations, &p), sixteenths(60), [&braking, &|_| 0.3], &[0.0; 4], 1e-4);
        assert!((Rows::of(&equations, &p, &record, 0).unwrap().sizes()[0] - 0.2).abs() < 1e-9);
    }

    /// More tries than there are lanes, of values and of beginnings.
    #[test]
    fn tries_side_by_side_are_those_alone() {
        let (equations, p) = equations(&SLIDES);
        let begin = [0.3, -0.2, 3.0, 0.05];
        let record = logged((&equations, &p), sixteenths(60), [&faster, &|_| 0.3], &begin, 1e-3);
        let rows = Rows::of(&equations, &p, &record, 4).unwrap();
        let at = |i: u32, values: &[f64]| values.iter().map(|v| v + 0.01 * f64::from(i)).collect::<Vec<f64>>();
        let tries: Vec<[Vec<f64>; 2]> = (0..11).map(|i| [at(i, &p), at(11 - i, &begin)]).collect();
        let together = rows.all_missed(tries.iter().map(|[p, z]| (&p[..], &z[..]))).unwrap();
        let alone: Vec<_> = tries.iter().map(|[p, begin]| rows.missed(p, begin).unwrap()).collect();
        assert_eq!(together, alone);
        assert!(alone.windows(2).all(|w| w[0] != w[1]));
        // What is undefined for one is so for all.
        assert!(rows.all_missed([&p[..], &[f64::NAN; 2]].map(|p| (p, &begin[..])).into_iter()).is_none());
    }

    #[test]
    fn what_is_missed_is_told_in_units_of_the_noise() {
        let (equations, p) = equations(&SLIDES);
        let begin = [0.3, -0.2, 3.0, 0.05];
        let mut record = logged((&equations, &p), sixteenths(60), [&faster, &|_| 0.3], &begin, 0.0);
        let missed = |record: &Record, begin: &[f64]| {
            let rows = Rows { noise: vec![0.5, 0.25, 0.125], ..Rows::of(&equations, &p, record, 4).unwrap() };
            rows.missed(&p, begin).unwrap()
        };
        let at = |record: &Record| [record.measured(4), vec![0.05]].concat();
        // Three columns of the rows 5 to 52.
        let one_off = [0, 1, 2].map(|c| {
            let mut off = record.clone();
            off.columns[c].iter_mut().for_each(|y| *y -= 1e-3);
            missed(&off, &[at(&record)[..3].to_vec(), vec![0.0]].concat())
        });
        let exact = missed(&record, &[at(&record)[..3].to_vec(), vec![0.0]].concat());
        assert_eq!(exact.len(), 3 * 48);
        for (c, off) in one_off.iter().enumerate() {
            for (i, (a, b)) in off.iter().zip(exact.iter()).enumerate() {
                let more = if i % 3 == c { 1e-3 / [0.5, 0.25, 0.125][c] } else { 0.0 };
                assert!((a - b - more).abs() < 1e-9, "{c} {i}: {a} {b}");
            }
        }
        // A turn more is no other heading, but another place.
        let mut turned = record.clone();
        turned.columns[2].iter_mut().for_each(|y| *y += TAU);
        assert!((missed(&turned, &at(&record)) - missed(&record, &at(&record))).amax() < 1e-9);
        record.columns[1].iter_mut().for_each(|y| *y += TAU);
        assert!((missed(&record, &at(&turned)).amax() - TAU / 0.25).abs() < 0.1);
    }
}
