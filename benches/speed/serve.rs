//! Batches on demand, for a script that times other programs in turn with this one.

use super::harness::processor_time;
use super::{CREEPS, MANY, jacobian, rates, trailers, wheel};
use creepage::formula::Isa;
use creepage::motion::Ensemble;
use std::hint::black_box;
use std::io::BufRead;

/// Seconds of a batch.
const BATCH: f64 = 0.2;

/// Seconds a unit, over at least a batch.
fn timed(units: usize, mut run: impl FnMut()) -> f64 {
    let (start, mut count) = (processor_time(), 0);
    loop {
        (0..8).for_each(|_| run());
        count += 8 * units;
        let spent = processor_time() - start;
        if spent >= BATCH {
            return spent / count as f64;
        }
    }
}

fn sweep(e: &Ensemble, cases: &[[f64; 2]]) -> f64 {
    let given: Vec<&[f64]> = cases.iter().map(|c| c.as_slice()).collect();
    let plan = e.plan(|i| cases[i].to_vec(), cases.len()).unwrap();
    timed(cases.len(), || drop(black_box(e.run(&plan, &given).unwrap())))
}

/// Answers each line, the name of some work, with seconds a unit of it.
pub fn serve() {
    let (one, train) = (wheel::Single::new(CREEPS), trailers::Single::new());
    let (wheels, trains) = (wheel::ensemble(), trailers::ensemble());
    let creeps: Vec<[f64; 2]> = (0..MANY).map(|i| wheel::creeps(i, MANY)).collect();
    let cases: Vec<[f64; 2]> = (0..MANY).map(|i| trailers::case(i, MANY)).collect();
    let mut jacobian = jacobian::compiled(jacobian::TRAILERS);
    let fit = rates::Library::new();
    for line in std::io::stdin().lock().lines() {
        let answer = match line.unwrap().as_str() {
            "wheel" => timed(1, || drop(black_box(one.run(black_box(CREEPS))))),
            "train" => timed(1, || drop(black_box(train.run(black_box([0.5, 0.3]))))),
            "fit" => timed(1, || drop(black_box(fit.run()))),
            "wheels" => sweep(&wheels, &creeps),
            "trains" => sweep(&trains, &cases),
            "jacobian" => timed(100 * jacobian::LANES, || {
                for _ in 0..100 {
                    jacobian.lanes.run(&mut jacobian.memory, Isa::best());
                    black_box(&jacobian.memory);
                }
            }),
            other => panic!("no work is called {other:?}"),
        };
        println!("{answer:e}");
    }
}
