//! What criterion measures here: processor time, and the ratio of two pieces of work done side by side.

use criterion::measurement::{Measurement, ValueFormatter};
use criterion::{BenchmarkId, Criterion, Throughput};
use rustix::time::{ClockId, clock_gettime};
use std::time::Duration;

/// Processor time that this process has used: others on the machine do not count, as they do by the wall clock.
pub struct ProcessorTime;

/// How many times longer one of two pieces of work takes than the other.
///
/// A sample is half of the runs of the first, all of the second, and the other half of the first: a speed that drifts
/// evenly drops out, and what changes between samples is in both times.
pub struct Ratio;

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

impl Ratio {
    /// The ratio times the number of runs, as criterion wants values that grow with them.
    fn of(runs: u64, ours: &mut dyn FnMut(), theirs: &mut dyn FnMut()) -> f64 {
        let before = time_of(runs / 2, ours);
        let yardstick = time_of(runs, theirs);
        let after = time_of(runs - runs / 2, ours);
        runs as f64 * (before + after) / yardstick
    }
}

impl Measurement for ProcessorTime {
    type Intermediate = f64;
    type Value = f64;

    fn start(&self) -> f64 {
        processor_time()
    }
    fn end(&self, start: f64) -> f64 {
        processor_time() - start
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

impl ValueFormatter for ProcessorTime {
    fn scale_values(&self, typical: f64, values: &mut [f64]) -> &'static str {
        let scales = [(1.0, "s"), (1e-3, "ms"), (1e-6, "µs"), (1e-9, "ns")];
        let (size, unit) = scales.into_iter().find(|(size, _)| typical >= *size).unwrap_or((1e-9, "ns"));
        values.iter_mut().for_each(|v| *v /= size);
        unit
    }
    /// Time for each element instead of elements a second.
    fn scale_throughputs(&self, typical: f64, each: &Throughput, values: &mut [f64]) -> &'static str {
        let Throughput::Elements(n) = each else { return self.scale_values(typical, values) };
        values.iter_mut().for_each(|v| *v *= 1e9 / *n as f64);
        "ns each"
    }
    fn scale_for_machines(&self, _: &mut [f64]) -> &'static str {
        "s"
    }
}

impl Measurement for Ratio {
    type Intermediate = ();
    type Value = f64;

    fn start(&self) {}
    /// Ratios are measured by the benchmark itself ([`Harness::compare`]): one clock cannot.
    fn end(&self, (): ()) -> f64 {
        unreachable!("a ratio is measured by `iter_custom`")
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

impl ValueFormatter for Ratio {
    fn scale_values(&self, _: f64, _: &mut [f64]) -> &'static str {
        "times"
    }
    fn scale_throughputs(&self, _: f64, _: &Throughput, _: &mut [f64]) -> &'static str {
        "times"
    }
    fn scale_for_machines(&self, _: &mut [f64]) -> &'static str {
        "times"
    }
}

/// Two criterions, one for each thing that is measured.
pub struct Harness {
    times: Criterion<ProcessorTime>,
    ratios: Criterion<Ratio>,
}

impl Harness {
    /// As the command line says; a benchmark takes about three seconds unless it says otherwise.
    pub fn new() -> Self {
        fn configured<M: Measurement + 'static>(of: M) -> Criterion<M> {
            let short = Criterion::default().with_measurement(of).sample_size(50);
            short
                .warm_up_time(Duration::from_millis(500))
                .measurement_time(Duration::from_millis(2500))
                .configure_from_args()
        }
        Self { times: configured(ProcessorTime), ratios: configured(Ratio) }
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
        let ratio =
            |b: &mut criterion::Bencher<'_, Ratio>| b.iter_custom(|runs| Ratio::of(runs, &mut ours, &mut theirs));
        group.bench_function("ratio", ratio);
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
