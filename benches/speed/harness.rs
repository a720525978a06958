//! What criterion measures here: processor time, and the ratio of two pieces of work done side by side.

use criterion::measurement::{Measurement, ValueFormatter};
use criterion::{BenchmarkId, Criterion, Throughput};
use rustix::time::{ClockId, clock_gettime};
use std::time::Duration;

/// What is measured.
enum Measured {
    /// Processor time that this process has used, s: others on the machine do not count, as they do by the wall clock.
    Time,
    /// How many times longer one of two pieces of work takes than the other, see [`ratio`].
    Ratio,
}

/// Seconds of processor time that this process has used.
pub fn processor_time() -> f64 {
    let t = clock_gettime(ClockId::ProcessCPUTime);
    t.tv_sec as f64 + t.tv_nsec as f64 * 1e-9
}

fn time_of(runs: u64, work: &mut dyn FnMut()) -> f64 {
    let start = processor_time();
    (0..runs).for_each(|_| work());
    processor_time() - start
}

/// How many times longer `ours` takes than `theirs`, times the number of runs, as criterion wants values that grow with them.
///
/// Half of the runs of the first, all of the second, and the other half of the first: a speed that drifts evenly drops out,
/// and what changes between samples is in both times.
fn ratio(runs: u64, ours: &mut dyn FnMut(), theirs: &mut dyn FnMut()) -> f64 {
    let before = time_of(runs / 2, ours);
    let yardstick = time_of(runs, theirs);
    let after = time_of(runs - runs / 2, ours);
    runs as f64 * (before + after) / yardstick
}

impl Measurement for Measured {
    type Intermediate = f64;
    type Value = f64;

    fn start(&self) -> f64 {
        processor_time()
    }
    fn end(&self, start: f64) -> f64 {
        match self {
            Self::Time => processor_time() - start,
            Self::Ratio => unreachable!("one clock cannot tell a ratio: `iter_custom` does"),
        }
    }
    fn add(&self, a: &f64, b: &f64) -> f64 {
        a + b
    }
    fn zero(&self) -> f64 {
        0.0
    }
    fn to_f64(&self, value: &f64) -> f64 {
        *value
    }
    fn formatter(&self) -> &dyn ValueFormatter {
        self
    }
}

impl ValueFormatter for Measured {
    fn scale_values(&self, typical: f64, values: &mut [f64]) -> &'static str {
        if matches!(self, Self::Ratio) {
            return self.scale_for_machines(values);
        }
        let scales = [(1.0, "s"), (1e-3, "ms"), (1e-6, "µs"), (1e-9, "ns")];
        let (size, unit) = scales.into_iter().find(|(size, _)| typical >= *size).unwrap_or((1e-9, "ns"));
        values.iter_mut().for_each(|v| *v /= size);
        unit
    }
    /// Time for each element instead of elements a second.
    fn scale_throughputs(&self, typical: f64, each: &Throughput, values: &mut [f64]) -> &'static str {
        let (Self::Time, Throughput::Elements(n)) = (self, each) else { return self.scale_values(typical, values) };
        values.iter_mut().for_each(|v| *v *= 1e9 / *n as f64);
        "ns each"
    }
    fn scale_for_machines(&self, _: &mut [f64]) -> &'static str {
        match self {
            Self::Time => "s",
            Self::Ratio => "times",
        }
    }
}

/// Two criterions, one for each thing that is measured.
pub struct Harness {
    times: Criterion<Measured>,
    ratios: Criterion<Measured>,
}

impl Harness {
    /// As the command line says; a benchmark takes about three seconds unless it says otherwise.
    pub fn new() -> Self {
        let configured = |of| {
            let short = Criterion::default().with_measurement(of).sample_size(50);
            short
                .warm_up_time(Duration::from_millis(500))
                .measurement_time(Duration::from_millis(2500))
                .configure_from_args()
        };
        Self { times: configured(Measured::Time), ratios: configured(Measured::Ratio) }
    }

    /// Times work and yardstick, `units` of either a run, and their ratio side by side.
    pub fn compare(
        &mut self,
        work: &str,
        yardstick: &str,
        units: usize,
        mut ours: impl FnMut(),
        mut theirs: impl FnMut(),
    ) {
        let mut group = self.times.benchmark_group(work);
        group.throughput(Throughput::Elements(units as u64));
        group.bench_function("creepage", |b| b.iter(&mut ours));
        group.bench_function(yardstick, |b| b.iter(&mut theirs));
        group.finish();
        let mut group = self.ratios.benchmark_group(work);
        group.bench_function("ratio", |b| b.iter_custom(|runs| ratio(runs, &mut ours, &mut theirs)));
        group.finish();
    }

    /// Times one of several sizes of a piece of work, `units` of it a run.
    pub fn size(&mut self, work: &str, size: usize, units: usize, mut run: impl FnMut()) {
        let mut group = self.times.benchmark_group(work);
        group.throughput(Throughput::Elements(units as u64));
        group.bench_function(BenchmarkId::from_parameter(size), |b| b.iter(&mut run));
        group.finish();
    }

    /// Writes the summaries of what was measured.
    pub fn finish(self) {
        self.times.final_summary();
        self.ratios.final_summary();
    }
}
