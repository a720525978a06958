//! Every file format and every command, fed with damaged files: no panic, no hang, little memory, one message.
//!
//! A few seconds on every commit. For longer, and for one target alone:
//!
//!     FUZZ_SECONDS=600 cargo test --release --test fuzzed simulate -- --nocapture
//!
//! `FUZZ_SEED` begins elsewhere. The targets of `fuzz/` put the same to libFuzzer, which looks for new paths by itself.

#[path = "support/slips.rs"]
mod slips;
#[path = "support/targets.rs"]
mod targets;

use peak_alloc::PeakAlloc;
use proptest::prelude::*;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};
use slips::{damage, slip};
use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{LazyLock, Mutex, mpsc};
use std::time::{Duration, Instant};
use targets::{TARGETS, Target};

#[global_allocator]
static MEMORY: PeakAlloc = PeakAlloc;

/// Memory is measured of the whole process, so one target runs at a time.
static ALONE: Mutex<()> = Mutex::new(());

/// The most memory that a small file may take, in bytes.
const MAX_MEMORY: usize = 256 << 20;
/// The most time of the processor that it may take: by the clock, a machine busy with other things takes any time.
const MAX_PROCESSOR_TIME: Duration = Duration::from_secs(60);

/// Cases of one target when no time is given.
fn cases(name: &str) -> u32 {
    match name {
        "relatives" => 10,
        "list_effects" | "verify" => 30,
        "describe" | "discover" | "dynamics" | "own_model" | "simulate" | "sweep" | "vehicles" => 100,
        _ => 1000,
    }
}

fn environment(name: &str) -> Option<u64> {
    std::env::var(name).ok().map(|v| v.parse().unwrap_or_else(|_| panic!("{name}={v} is not a whole number")))
}

/// Damaged seeds, and pieces of one seed in another.
fn damaged(target: &Target) -> impl Strategy<Value = Vec<u8>> + use<> {
    let seeds = prop::sample::select((target.seeds)());
    let piece = (any::<prop::sample::Index>(), any::<prop::sample::Index>(), any::<prop::sample::Index>());
    let joined = (seeds.clone(), seeds, prop::option::weighted(0.2, piece)).prop_map(|(mut a, b, piece)| {
        if let Some((at, from, length)) = piece {
            let (at, from) = (at.index(a.len()), from.index(b.len()));
            let to = from + length.index((b.len() - from).min(200));
            a.splice(at..at, b[from..to].iter().copied());
        }
        a
    });
    let edge = prop::sample::select(vec![
        "1e-300", "1e300", "-1e300", "5e-324", "1e-9", "3600", "1e17", "0", "-0.0", "1e-160", "1.7e308", "0.1",
    ]);
    let edges = prop::collection::vec((any::<prop::sample::Index>(), edge), 0..3);
    let slips = prop::collection::vec(slip(), 0..5);
    (joined, edges, slips).prop_map(|(mut bytes, edges, slips)| {
        edges.iter().for_each(|(place, value)| replace_number(&mut bytes, place, value));
        damage(&bytes, &slips)
    })
}

/// Puts another number in the place of one.
fn replace_number(bytes: &mut Vec<u8>, place: &prop::sample::Index, by: &str) {
    let part = |b: u8| b.is_ascii_digit() || b".-".contains(&b);
    let starts = (0..bytes.len()).filter(|&i| bytes[i].is_ascii_digit() && (i == 0 || !part(bytes[i - 1])));
    let starts: Vec<usize> = starts.collect();
    if let Some(&at) = (!starts.is_empty()).then(|| place.get(&starts)) {
        let length = bytes[at..].iter().take_while(|b| part(**b)).count();
        bytes.splice(at..at + length, by.bytes());
    }
}

/// Time of the processor this process has taken; of the clock where the system does not tell.
fn spent() -> Duration {
    static BEGIN: LazyLock<Instant> = LazyLock::new(Instant::now);
    let stat = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    // Behind the name in parentheses: the 14th and 15th of all fields, in hundredths of a second.
    let fields: Vec<i64> = stat.rsplit(')').next().unwrap_or("").split(' ').filter_map(|f| f.parse().ok()).collect();
    fields
        .get(10)
        .zip(fields.get(11))
        .map_or(BEGIN.elapsed(), |(user, system)| Duration::from_millis(10 * (user + system).unsigned_abs()))
}

/// Runs what is asked for; ends the process where an input takes too long, since nothing else could.
fn watched<T>(input: &[u8], run: impl FnOnce() -> T) -> T {
    let (done, over) = mpsc::channel::<()>();
    let copy = input.to_vec();
    let begin = spent();
    std::thread::spawn(move || {
        while over.recv_timeout(Duration::from_secs(1)) == Err(mpsc::RecvTimeoutError::Timeout) {
            if spent() < begin + MAX_PROCESSOR_TIME {
                continue;
            }
            let kept = std::env::temp_dir().join("creepage-slow-input");
            drop(std::fs::write(&kept, &copy));
            eprintln!("an input takes more than {MAX_PROCESSOR_TIME:?}; it is in {}", kept.display());
            std::process::exit(101);
        }
    });
    let value = run();
    drop(done);
    value
}

fn fuzz(name: &str) {
    let _alone = ALONE.lock().unwrap_or_else(|e| e.into_inner());
    let target = Target::named(name);
    for seed in (target.seeds)() {
        assert!(seed.len() <= target.longest, "{name}: a seed is cut off");
        target.meets(&seed).unwrap_or_else(|e| panic!("{name}: a seed is refused: {e}"));
    }
    let (begin, time) = (Instant::now(), environment("FUZZ_SECONDS").map(Duration::from_secs));
    let (executions, good) = (AtomicU64::new(0), AtomicU64::new(0));
    let mut slowest = Duration::ZERO;
    let mut most = 0;
    for round in 0.. {
        let seed = environment("FUZZ_SEED").unwrap_or(0).wrapping_mul(1_000_003).wrapping_add(round);
        let seed: Vec<u8> = seed.to_le_bytes().repeat(4);
        let config =
            Config { cases: cases(name), failure_persistence: None, max_shrink_iters: 300, ..Config::default() };
        let mut runner = TestRunner::new_with_rng(config, TestRng::from_seed(RngAlgorithm::ChaCha, &seed));
        let (slow, large) = (Mutex::new(&mut slowest), Mutex::new(&mut most));
        let ran = runner.run(&damaged(target), |bytes| {
            let (start, before) = (Instant::now(), MEMORY.current_usage());
            MEMORY.reset_peak_usage();
            let met = watched(&bytes, || target.meets(&bytes));
            let memory = MEMORY.peak_usage().saturating_sub(before);
            prop_assert!(memory <= MAX_MEMORY, "{memory} bytes of memory for {} bytes of input", bytes.len());
            executions.fetch_add(1, Ordering::Relaxed);
            good.fetch_add(u64::from(met.is_ok()), Ordering::Relaxed);
            let (mut slow, mut large) = (slow.lock().unwrap(), large.lock().unwrap());
            **slow = start.elapsed().max(**slow);
            **large = memory.max(**large);
            Ok(())
        });
        if let Err(e) = ran {
            panic!("{name}: {e}");
        }
        if time.is_none_or(|t| begin.elapsed() >= t) {
            break;
        }
    }
    targets::tidy();
    let (executions, good) = (executions.into_inner(), good.into_inner());
    println!(
        "{name}: {executions} inputs, {good} of them good, in {:.1} s; slowest {:.3} s, most memory {:.1} MB",
        begin.elapsed().as_secs_f64(),
        slowest.as_secs_f64(),
        most as f64 / 1e6
    );
    assert!(good > 0 && good < executions, "{name}: {good} of {executions} inputs are good: nothing is tried");
}

#[test]
fn formula() {
    fuzz("formula");
}

#[test]
fn model() {
    fuzz("model");
}

#[test]
fn effects() {
    fuzz("effects");
}

#[test]
fn claims() {
    fuzz("claims");
}

#[test]
fn run() {
    fuzz("run");
}

#[test]
fn inputs() {
    fuzz("inputs");
}

#[test]
fn describe() {
    fuzz("describe");
}

#[test]
fn simulate() {
    fuzz("simulate");
}

#[test]
fn discover() {
    fuzz("discover");
}

#[test]
fn verify() {
    fuzz("verify");
}

#[test]
fn list_effects() {
    fuzz("list_effects");
}

#[test]
fn vehicles() {
    fuzz("vehicles");
}

#[test]
fn relatives() {
    fuzz("relatives");
}

#[test]
fn own_model() {
    fuzz("own_model");
}

#[test]
fn dynamics() {
    fuzz("dynamics");
}

#[test]
fn sweep() {
    fuzz("sweep");
}

/// A target without a test, or without its file for libFuzzer, would never run.
#[test]
fn every_target_is_run() {
    for target in TARGETS {
        let call = format!("fuzz(\"{}\")", target.name);
        assert!(include_str!("fuzzed.rs").contains(&call), "no test calls {call}");
        // The package for crates.io has no `fuzz`.
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz/fuzz_targets");
        assert!(!folder.is_dir() || folder.join(target.name).with_extension("rs").is_file(), "{}", target.name);
    }
}

/// How many cases there are is known before any of them takes room.
#[test]
fn axes_of_many_values_cost_no_memory() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("sweep.toml");
    let axes: String = (0..8).map(|i| format!("a_{i} = {{ from = 0.0, to = 1.0, count = 10000000 }}\n")).collect();
    std::fs::write(&path, format!("model = \"sweep.toml\"\nduration = 1.0\n[grid]\n{axes}")).unwrap();
    let _alone = ALONE.lock().unwrap_or_else(|e| e.into_inner());
    let before = MEMORY.current_usage();
    MEMORY.reset_peak_usage();
    let error = creepage::files::SweepFile::read(&path).map(drop).unwrap_err();
    let taken = MEMORY.peak_usage() - before;
    assert!(error.to_string().contains("more than 10^15 cases") && taken < 1 << 20, "{error}, {taken} bytes");
}
