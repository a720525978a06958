//! Two pieces of work timed side by side.

use rustix::time::{ClockId, clock_gettime};

/// How long a batch of either runs, s.
const BATCH: f64 = 8e-3;
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

/// Seconds of processor time that this process has used: others on the machine do not count.
pub fn processor_time() -> f64 {
    let t = clock_gettime(ClockId::ProcessCPUTime);
    t.tv_sec as f64 + t.tv_nsec as f64 * 1e-9
}

/// How many runs fill a batch.
fn calibrate(f: &mut dyn FnMut()) -> usize {
    let mut runs = 1;
    while batch(f, runs) * (runs as f64) < BATCH / 2.0 && runs < 1 << 30 {
        runs *= 2;
    }
    runs
}

/// Seconds a run.
fn batch(f: &mut dyn FnMut(), runs: usize) -> f64 {
    let start = processor_time();
    (0..runs).for_each(|_| f());
    (processor_time() - start) / runs as f64
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
