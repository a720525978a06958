//! The library beside code written by hand.

use super::cases::{headings, trailer_cases, wheel_cases};
use super::harness::Harness;
use super::{CREEPS, MANY, jacobian, rates, trailers, vector, wheel};
use creepage::formula::Isa;
use creepage::motion::Ensemble;
use std::hint::black_box;

/// Every comparison.
pub fn all(harness: &mut Harness) {
    [single, sweep, trailers_single, trailers_sweep, jacobians, fit].into_iter().for_each(|compare| compare(harness));
}

fn single(harness: &mut Harness) {
    let wheel = wheel::Single::new(CREEPS);
    let ours = || drop(black_box(wheel.run(black_box(CREEPS))));
    harness.compare("one wheel, library call", "scalar loop by hand", 1, ours, || {
        black_box(wheel::by_hand(black_box(CREEPS)));
    });
}

fn trailers_single(harness: &mut Harness) {
    let (train, case) = (trailers::Single::new(), trailers::case(5, MANY));
    let ours = || drop(black_box(train.run(black_box(case))));
    harness.compare("ten trailers, library call", "scalar loop by hand", 1, ours, || {
        black_box(trailers::by_hand(black_box(case)));
    });
}

fn sweep(harness: &mut Harness) {
    many(harness, "wheels, many at once", &wheel::ensemble(), wheel_cases(), wheel::limit);
}

fn trailers_sweep(harness: &mut Harness) {
    many(harness, "ten trailers, many at once", &trailers::ensemble(), trailer_cases(), trailers::limit);
}

/// An ensemble of cases beside a loop over vectors, in the fewest steps that are exact enough.
fn many<const N: usize>(
    harness: &mut Harness,
    work: &str,
    e: &Ensemble,
    (cases, steps): (Vec<[f64; 2]>, usize),
    limit: impl Fn(&[[f64; 2]], usize, &mut [[f64; N]]),
) {
    let given: Vec<&[f64]> = cases.iter().map(|c| c.as_slice()).collect();
    let plan = e.plan(|i| cases[i].to_vec(), MANY).unwrap();
    eprintln!("{work}: {steps} steps by hand, {plan:?}");
    let mut out = vec![[0.0; N]; MANY];
    let ours = || drop(black_box(e.run(&plan, &given).unwrap()));
    harness.compare(work, "vectors by hand, no check of the error", MANY, ours, || {
        limit(&cases, steps, black_box(&mut out));
    });
}

fn jacobians(harness: &mut Harness) {
    let mut ours = jacobian::compiled(jacobian::TRAILERS);
    let mut theirs = [jacobian::ByHand::new(&headings()), jacobian::ByHand::new(&headings())];
    let work = || {
        ours.lanes.run(&mut ours.memory, Isa::best());
        black_box(&ours.memory);
    };
    harness.compare("Jacobian of ten trailers, in blocks", "vectors by hand", jacobian::LANES, work, || {
        for block in &mut theirs {
            vector::widest(
                #[inline(always)]
                || block.run(),
            );
            black_box(&block.by_phi);
        }
    });
}

fn fit(harness: &mut Harness) {
    let (ours, rows) = (rates::Library::new(), (0..rates::SAMPLES).map(rates::sample).collect::<Vec<_>>());
    let work = || drop(black_box(black_box(&ours).run()));
    harness.compare("fit of e_rc and e_tc to 1000 samples", "Gauss–Newton by hand, scalar", 1, work, || {
        black_box(rates::by_hand(black_box(&rows)));
    });
}
