//! A pose that a low-pass filter smoothed before it was logged: the filter is told, and no creep in its place.

use crate::read_back::read_back;
use crate::simulator::{Hidden, Noise, Scenario, Tractor};
use creepage::discrepancy::discover::discover;
use creepage::discrepancy::discovery::Discovery;
use creepage::discrepancy::report::Verdict;
use creepage::discrepancy::request::Request;
use creepage::effects;
use creepage::files::{ModelFile, PoseFilter, Run};
use creepage::progress::unheard;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::StandardNormal;

/// Noise of what is logged, m and rad: it is added behind the filter. Before it the noise is ten times as large, and must leave
/// to be seen what the filter does to the corners.
const NOISE: f64 = 5e-4;
/// Rows a second, Hz.
const RATE: f64 = 25.0;

/// The exact response of τ·ż + z = w to a signal that is straight between its rows.
fn filtered(time: &[f64], w: &[f64], time_constant: f64) -> Vec<f64> {
    let mut z = w[0];
    let mut next = |i: usize| {
        if i > 0 {
            let dt = time[i] - time[i - 1];
            let (kept, slope) = ((-dt / time_constant).exp(), (w[i] - w[i - 1]) / dt);
            // Of a ramp the filter is late by its time constant.
            z = kept * (z - w[i - 1] + slope * time_constant) + w[i] - slope * time_constant;
        }
        z
    };
    (0..w.len()).map(&mut next).collect()
}

/// A run whose pose is smoothed, with noise behind the filter.
fn smoothed(scenario: &Scenario, time_constant: f64) -> (ModelFile, Run) {
    let (file, mut run) = read_back(&scenario.model_toml(), &scenario.run().to_csv(9));
    let mut random = ChaCha8Rng::seed_from_u64(scenario.seed);
    let time = run.time.clone();
    let mut smooth = |column: &mut Vec<f64>| {
        *column = filtered(&time, column, time_constant);
        column.iter_mut().for_each(|z| *z += NOISE * random.sample::<f64, _>(StandardNormal));
    };
    smooth(&mut run.x);
    smooth(&mut run.y);
    run.heading.iter_mut().for_each(smooth);
    (file, run)
}

/// How late a filter makes a slow motion, s: of rows that are much closer than that its two forms are nearly one.
fn late(filter: PoseFilter) -> f64 {
    match filter {
        PoseFilter::Continuous(time_constant) => time_constant,
        PoseFilter::OfRows(share) => (1.0 - share) / share / RATE,
    }
}

fn drive(tractor: Tractor, hidden: Vec<Hidden>, seed: u64) -> Scenario {
    let noise = Noise { position: 0.0, heading: 0.0 };
    Scenario { hidden, noise, rate: RATE, duration: 60.0, ..Scenario::new(tractor, seed) }
}

fn discovered(file: &ModelFile, run: &Run) -> Discovery {
    let runs = std::slice::from_ref(run);
    let request = Request { file, runs, held_out: &[], library: effects::all(), horizons: &[1.0, 5.0], seed: 5 };
    discover(&request, &unheard).unwrap()
}

/// Without the filter such runs had a delay and beside it creeps and laws that cut the corners.
#[test]
fn a_filter_is_told_with_its_time_constant_and_the_line_that_undoes_it() {
    for (tractor, seed) in [(Tractor::Unicycle, 1), (Tractor::DifferentialDrive, 2), (Tractor::Car, 3)] {
        let scenario = drive(tractor, vec![], seed);
        let (file, run) = smoothed(&scenario, 0.3);
        let discovery = discovered(&file, &run);
        let report = &discovery.report;
        assert_eq!(report.verdict, Verdict::NoMissingEffect, "{tractor:?}: {}", report.summary);
        assert!(report.summary.contains("low-pass filter"), "{}", report.summary);
        let found = discovery.pose_filter.unwrap();
        assert!((late(found) - 0.3).abs() < 0.005, "{tractor:?}: {found:?}");
        let finding = report.data.findings.iter().find(|f| f.id == "pose-filter").unwrap();
        assert!(finding.mend.as_ref().unwrap().starts_with("[sensor]\npose_"), "{finding:?}");
        // The patched model undoes the filter as it reads, and nothing is left to find.
        let (patched, read) = read_back(&discovery.patched(&file), &scenario.run().to_csv(9));
        assert_eq!((patched.sensor.pose_filter, read.time.len()), (Some(found), run.time.len() - 1));
        let again = discovered(&patched, &run.before_pose_filter(found));
        assert_eq!(again.report.verdict, Verdict::NoMissingEffect, "{tractor:?}: {}", again.report.summary);
        assert_eq!(again.pose_filter, None);
    }
}

/// Of rows that are smoothed one by one the share of the new pose is told.
#[test]
fn exponential_smoothing_is_told_by_its_share() {
    let scenario = drive(Tractor::Unicycle, vec![], 5);
    let (file, mut run) = read_back(&scenario.model_toml(), &scenario.run().to_csv(9));
    let mut random = ChaCha8Rng::seed_from_u64(5);
    let mut smooth = |column: &mut Vec<f64>| {
        for i in 1..column.len() {
            column[i] = 0.2 * column[i] + 0.8 * column[i - 1];
        }
        column.iter_mut().for_each(|z| *z += NOISE * random.sample::<f64, _>(StandardNormal));
    };
    smooth(&mut run.x);
    smooth(&mut run.y);
    run.heading.iter_mut().for_each(smooth);
    let discovery = discovered(&file, &run);
    let found = discovery.pose_filter;
    assert!(matches!(found, Some(PoseFilter::OfRows(share)) if (share - 0.2).abs() < 0.005), "{found:?}");
    let mend = discovery.report.data.findings[0].mend.as_ref().unwrap();
    assert!(mend.starts_with("[sensor]\npose_smoothing = 0."), "{mend}");
}

/// What is late and creeps is no filter, and a pose that is only late is none.
#[test]
fn a_delay_is_no_filter() {
    let late = Hidden::InputDelay { delay: 0.2 };
    for hidden in [vec![late], vec![late, Hidden::TrackWidth { scale: 0.04 }]] {
        let named = hidden.len();
        let scenario = Scenario { noise: Noise::MOCAP, ..drive(Tractor::DifferentialDrive, hidden, 4) };
        let (file, run) = read_back(&scenario.model_toml(), &scenario.run().to_csv(9));
        let discovery = discovered(&file, &run);
        assert_eq!(
            (discovery.pose_filter, discovery.report.effects.len()),
            (None, named),
            "{}",
            discovery.report.summary
        );
    }
}
