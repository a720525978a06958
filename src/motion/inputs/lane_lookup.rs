//! Signals looked up at several times side by side, each lane with an interval of its own.

use crate::model::Derived;
use crate::motion::Signals;

/// The interval of the log around each of L times, and what the signals are there.
pub(crate) struct Lookup<const L: usize> {
    /// Where the intervals found last begin and end; the outermost reach beyond the log.
    low: [f64; L],
    high: [f64; L],
    knot: [f64; L],
    interval: [usize; L],
    /// Coefficients of each channel.
    pieces: Vec<[[f64; L]; 4]>,
    derived: Vec<Derived>,
    at: [f64; L],
    pub value: Vec<[f64; L]>,
    pub slope: Vec<[f64; L]>,
}

impl<const L: usize> Lookup<L> {
    /// Signals, and what is derived from them behind them.
    pub fn new(signals: &Signals, derived: &[Derived]) -> Self {
        let channels = signals.channels();
        let all = channels + derived.len();
        Self {
            low: [f64::NAN; L],
            high: [f64::NAN; L],
            knot: [0.0; L],
            interval: [0; L],
            pieces: vec![[[0.0; L]; 4]; channels],
            derived: derived.to_vec(),
            at: [f64::NAN; L],
            value: vec![[0.0; L]; all],
            slope: vec![[0.0; L]; all],
        }
    }

    /// Values and slopes at these times.
    #[inline(always)]
    pub fn find(&mut self, signals: &Signals, t: &[f64; L]) {
        let (mut known, mut inside) = (true, true);
        for (l, t) in t.iter().enumerate() {
            known &= *t == self.at[l];
            inside &= self.low[l] <= *t && *t < self.high[l];
        }
        if known {
            return;
        }
        if !inside {
            self.enter(signals, t);
        }
        let (first, last) = signals.ends();
        let (mut s, mut within) = ([0.0; L], [false; L]);
        for l in 0..L {
            within[l] = first <= t[l] && t[l] <= last;
            s[l] = t[l].clamp(first, last) - self.knot[l];
        }
        for ((value, slope), [a, b, d, e]) in self.value.iter_mut().zip(&mut self.slope).zip(&self.pieces) {
            for l in 0..L {
                let s = s[l];
                value[l] = a[l] + s * (b[l] + s * (d[l] + s * e[l]));
                slope[l] = if within[l] { b[l] + s * (2.0 * d[l] + 3.0 * s * e[l]) } else { 0.0 };
            }
        }
        if !self.derived.is_empty() {
            self.derive(t, &s, &within);
        }
        self.at = *t;
    }

    /// What hangs on the log as a whole: the time, and the rates of the channels with their slopes.
    #[inline(never)]
    fn derive(&mut self, t: &[f64; L], s: &[f64; L], within: &[bool; L]) {
        let channels = self.pieces.len();
        for (k, derived) in self.derived.iter().enumerate() {
            let at = channels + k;
            match derived {
                Derived::Time => (self.value[at], self.slope[at]) = (*t, [1.0; L]),
                Derived::Rate(c) => {
                    self.value[at] = self.slope[*c];
                    let [_, _, d, e] = self.pieces[*c];
                    for l in 0..L {
                        self.slope[at][l] = if within[l] { 2.0 * d[l] + 6.0 * s[l] * e[l] } else { 0.0 };
                    }
                }
            }
        }
    }

    /// Looks for the intervals of those times that have left theirs, in the next one first.
    #[inline(never)]
    fn enter(&mut self, signals: &Signals, t: &[f64; L]) {
        for l in 0..L {
            if self.low[l] <= t[l] && t[l] < self.high[l] {
                continue;
            }
            let i = signals.interval_from(self.interval[l] + 1, t[l]);
            [self.low[l], self.high[l]] = signals.reach(i);
            (self.interval[l], self.knot[l]) = (i, signals.knots()[i]);
            for (own, piece) in self.pieces.iter_mut().zip(signals.pieces(i)) {
                (0..4).for_each(|k| own[k][l] = piece[k]);
            }
        }
    }
}
