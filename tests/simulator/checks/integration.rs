//! The integrator alone.

use super::near;
use crate::simulator::{Scenario, Tractor, Vehicle, advance};

#[test]
fn gauss_is_of_order_six_on_a_problem_with_explicit_time() {
    // y' = y·cos t, y = exp(sin t)
    let error = |steps: f64| {
        let rates = |t: f64, y: &[f64]| vec![y[0] * t.cos()];
        let end = advance(&rates, vec![1.0], 0.0, 3.0, 3.0 / steps);
        (end[0] - 3f64.sin().exp()).abs()
    };
    let order = (error(6.0) / error(12.0)).log2();
    assert!((5.6..6.6).contains(&order), "order {order}");
}

#[test]
fn gauss_undoes_itself_backwards() {
    let rates = |t: f64, y: &[f64]| vec![y[1], -y[0] * (1.0 + 0.3 * t.sin())];
    let there = advance(&rates, vec![1.0, 0.2], 0.0, 5.0, 0.25);
    let back = advance(&rates, there, 5.0, 0.0, 0.25);
    near(back[0], 1.0, 1e-13);
    near(back[1], 0.2, 1e-13);
}

/// What a coarse step is used for needs no more.
#[test]
fn a_coarse_step_is_off_by_nothing_that_counts() {
    let train = |tractor| Vehicle::NTrailer { tractor, lengths: vec![1.2, 0.9], hitch_offsets: vec![0.2, 0.0] };
    for seed in 0..4 {
        for tractor in [Tractor::Unicycle, Tractor::DifferentialDrive, Tractor::Car] {
            let fine = Scenario { rate: 4.0, lead_in: 6.0, ..Scenario::new(train(tractor), seed) };
            let coarse = Scenario { step: 0.05, ..fine.clone() };
            for (a, b) in fine.run().rows.iter().flatten().zip(coarse.run().rows.iter().flatten()) {
                near(*a, *b, 1e-10);
            }
        }
    }
}
