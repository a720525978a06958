//! The measured path beside the one that the inputs reckon.

use crate::discrepancy::record::local_polynomial;
use crate::files::Run;

/// Two paths at the same times.
#[derive(Clone, Copy)]
pub(super) struct PathPair<'a> {
    /// The run whose pose is measured.
    pub run: &'a Run,
    /// x, y and heading as reckoned.
    pub reckoned: &'a [Vec<f64>; 3],
}

/// A motion from one row to another.
#[derive(Clone, Copy, Debug)]
pub(super) struct Moved {
    /// Its length, m.
    pub way: f64,
    /// Its turn, rad; none where no heading is measured.
    pub turn: Option<f64>,
}

impl PathPair<'_> {
    /// What was measured between two rows.
    pub fn measured(self, from: usize, to: usize) -> Moved {
        let Run { x, y, heading, .. } = self.run;
        Moved { way: (x[to] - x[from]).hypot(y[to] - y[from]), turn: heading.as_ref().map(|h| h[to] - h[from]) }
    }

    /// What the inputs reckon between them.
    pub fn reckoned(self, from: usize, to: usize) -> Moved {
        let [x, y, heading] = self.reckoned;
        let turn = self.run.heading.as_ref().map(|_| heading[to] - heading[from]);
        Moved { way: (x[to] - x[from]).hypot(y[to] - y[from]), turn }
    }

    /// How far the measured motion lies from the reckoned one, m, without a heading by its length alone; and how far their
    /// turns are apart, rad.
    pub fn apart(self, from: usize, to: usize) -> [f64; 2] {
        let (run, [x, y, heading]) = (self.run, self.reckoned);
        let measured = [run.x[to] - run.x[from], run.y[to] - run.y[from]];
        let reckoned = [x[to] - x[from], y[to] - y[from]];
        match &run.heading {
            Some(h) => {
                let (sin, cos) = (h[from] - heading[from]).sin_cos();
                let turned = [cos * reckoned[0] - sin * reckoned[1], sin * reckoned[0] + cos * reckoned[1]];
                let turn = (h[to] - h[from]) - (heading[to] - heading[from]);
                [(measured[0] - turned[0]).hypot(measured[1] - turned[1]), turn.abs()]
            }
            None => [(measured[0].hypot(measured[1]) - reckoned[0].hypot(reckoned[1])).abs(), 0.0],
        }
    }

    /// Standard deviations of the measured position, m, and heading, rad.
    pub fn noise(self) -> [f64; 2] {
        let of = |column: &[f64]| local_polynomial::noise(&self.run.time, column).unwrap_or(0.0);
        [of(&self.run.x).max(of(&self.run.y)), self.run.heading.as_deref().map_or(0.0, of)]
    }

    /// Rows of windows of some seconds, one behind the other, none across a hole.
    pub fn windows(self, seconds: f64) -> Vec<(usize, usize)> {
        let time = &self.run.time;
        let (mut found, mut start) = (vec![], 0);
        for i in 1..time.len() {
            let lasts = time[i] - time[start];
            if lasts >= seconds {
                if lasts < 1.5 * seconds {
                    found.push((start, i));
                }
                start = i;
            }
        }
        found
    }
}
