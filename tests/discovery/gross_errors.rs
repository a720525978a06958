//! Gross errors of a measured position are told from good rows wherever they stand, at the ends of a log and beside its
//! interruptions too.

use crate::read_back::read_back;
use crate::simulator::{Hidden, Log, Noise, Scenario, Tractor};
use creepage::discrepancy::preprocessing::outliers::without_gross_errors;
use creepage::discrepancy::record::run_record::Record;
use creepage::effects;
use creepage::model::Model;

/// A rough log of a vehicle whose model misses something.
fn rough(seed: u64) -> Scenario {
    let hidden = vec![Hidden::WheelRadiusMismatch { scale: 0.03 }];
    let usual = Scenario::new(Tractor::DifferentialDrive, seed);
    Scenario { hidden, duration: 30.0, rate: 20.0, noise: Noise::MOCAP, ..usual }.roughly_logged()
}

/// Whether the measured position of a row is off by more than ten deviations.
fn is_wrong(log: &Log, row: usize) -> bool {
    let (cells, truth) = (&log.rows[row], &log.truth[row]);
    (cells[1] - truth.x).hypot(cells[2] - truth.y) > 10.0 * Noise::MOCAP.position
}

#[test]
fn what_is_wrong_goes_and_what_is_right_stays() {
    let (mut wrong, mut left, mut lost) = (0, vec![], vec![]);
    for seed in 2..30 {
        let scenario = rough(seed);
        let log = scenario.run();
        let (file, run) = read_back(&scenario.model_toml(), &log.to_csv(9));
        let model = Model::from_file(&file, effects::all(), &run.roles).unwrap();
        let (kept, dropped) = without_gross_errors(&Record::of_run(&run, file.input_timing, 0), &model).unwrap();
        assert_eq!((kept.time.len() + dropped, kept.rows.len()), (log.rows.len(), kept.time.len()));
        for row in 0..log.rows.len() {
            let stays = kept.time.iter().any(|t| (t - log.rows[row][0]).abs() < 1e-6);
            wrong += usize::from(is_wrong(&log, row));
            match (is_wrong(&log, row), stays) {
                (true, true) => left.push((seed, row)),
                (false, false) => lost.push((seed, row)),
                _ => {}
            }
        }
    }
    // Beside the very first row, and in a pair of wrong ones, a good row may stand for a wrong one.
    assert!(wrong > 200 && left.len() <= 1 && lost.len() <= 2, "of {wrong}: {left:?} left, {lost:?} lost");
}
