//! What the library costs, each figure a ratio to a yardstick timed side by side with it in this process.
//!
//! `cargo bench --manifest-path benches/Cargo.toml` measures, a word behind `--` what it is about; `-- check` only holds the
//! yardsticks' results against the library's, and `-- serve` answers benches/peers/run.py, which makes the tables. Criterion
//! times one thing after another by the wall clock; a shared machine's speed drifts by more than the ratios differ, so it is
//! given processor time and ratios of neighbours to measure.
#![allow(clippy::needless_range_loop)] // loops over lanes are written out, so that they become vectors

mod adaptive;
mod by_hand;
mod cases;
mod growth;
mod harness;
mod jacobian;
mod rates;
mod serve;
#[path = "../../src/motion/integrators/tableau.rs"]
#[allow(dead_code)]
#[allow(unused_imports)]
mod tableau;
mod trailers;
#[allow(unsafe_code, clippy::excessive_precision)] // vector instructions by hand
mod vector;
mod wheel;

const MANY: usize = 4096;
const CREEPS: [f64; 2] = [0.1, 0.2];

fn main() {
    cases::check();
    match std::env::args().nth(1).as_deref() {
        Some("check") => {}
        Some("serve") => serve::serve(),
        _ => {
            let mut harness = harness::Harness::new();
            by_hand::all(&mut harness);
            growth::all(&mut harness);
            harness.finish();
        }
    }
}
