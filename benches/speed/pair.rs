//! Two pieces of work timed side by side.

use std::time::{Duration, Instant};

/// How long a batch of either runs.
const BATCH: Duration = Duration::from_millis(8);
/// Batches of each, in turn.
const BATCHES: usize = 25;

/// A comparison: what was compared, and the median ratio of the times of neighbouring batches.
pub struct Pair {
    pub work: &'static str,
    pub yardstick: &'static str,
    /// Seconds a unit of work, median.
    pub ours: f64,
    pub theirs: f64,
    pub ratio: f64,
    /// The ratios' quartiles.
    pub spread: [f64; 2],
}

/// Seconds of one run, and how many runs fill a batch.
fn calibrate(f: &mut dyn FnMut()) -> usize {
    let mut runs = 1;
    loop {
        let start = Instant::now();
        (0..runs).for_each(|_| f());
        if start.elapsed() >= BATCH / 2 || runs > 1 << 30 {
            return runs;
        }
        runs *= 2;
    }
}

fn batch(f: &mut dyn FnMut(), runs: usize) -> f64 {
    let start = Instant::now();
    (0..runs).for_each(|_| f());
    start.elapsed().as_secs_f64() / runs as f64
}

fn quantile(values: &mut [f64], q: f64) -> f64 {
    values.sort_by(f64::total_cmp);
    values[((values.len() - 1) as f64 * q).round() as usize]
}

/// Times both in turn, `units` of work a run. The machine's speed drifts; neighbours share it.
pub fn pair(
    work: &'static str,
    yardstick: &'static str,
    units: usize,
    mut ours: impl FnMut(),
    mut theirs: impl FnMut(),
) -> Pair {
    let runs = [calibrate(&mut ours), calibrate(&mut theirs)];
    let (mut a, mut b, mut ratios) = (vec![], vec![], vec![]);
    for _ in 0..BATCHES {
        let (x, y) = (batch(&mut ours, runs[0]), batch(&mut theirs, runs[1]));
        a.push(x / units as f64);
        b.push(y / units as f64);
        ratios.push(x / y);
    }
    Pair {
        work,
        yardstick,
        ours: quantile(&mut a, 0.5),
        theirs: quantile(&mut b, 0.5),
        ratio: quantile(&mut ratios, 0.5),
        spread: [quantile(&mut ratios, 0.25), quantile(&mut ratios, 0.75)],
    }
}

impl Pair {
    /// A row of a table.
    pub fn row(&self) -> String {
        let time = |s: f64| match s {
            s if s >= 1e-3 => format!("{:.3} ms", s * 1e3),
            s if s >= 1e-6 => format!("{:.3} µs", s * 1e6),
            s => format!("{:.1} ns", s * 1e9),
        };
        let [low, high] = self.spread;
        let (ours, theirs) = (time(self.ours), time(self.theirs));
        format!("| {} | {} | {ours} | {theirs} | {:.2} ({low:.2}–{high:.2}) |", self.work, self.yardstick, self.ratio)
    }
}
