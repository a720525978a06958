//! Poses that come more seldom than inputs: what is done to a vehicle between two of them happens all the same.

use crate::simulator::{Hidden, Noise, Profile, Scenario, Signal, Timing, Tractor};
use creepage::discrepancy::discover::discover;
use creepage::discrepancy::discover::discover_aligned;
use creepage::discrepancy::report::{Report, Verdict};
use creepage::discrepancy::request::Request;
use creepage::effects;
use creepage::files::{ModelFile, Run};
use creepage::model;
use creepage::progress::unheard;

fn file_of(scenario: &Scenario) -> ModelFile {
    ModelFile::parse(&scenario.model_toml(), "model.toml", &model::known(effects::all())).unwrap()
}

fn request<'a>(file: &'a ModelFile, runs: &'a [Run]) -> Request<'a> {
    Request { file, runs, held_out: &[], library: effects::all(), horizons: &[5.0], seed: 1 }
}

/// A gyro that vibrates at 10 Hz, logged a hundred times a second; the poses come ten times a second.
#[test]
fn what_happens_between_poses_is_followed() {
    let usual = Scenario { noise: Noise::MOCAP, duration: 40.0, rate: 100.0, ..Scenario::new(Tractor::Unicycle, 7) };
    let turn = usual.profile.turn.clone() + Signal::wave(0.8, 0.103, 0.4);
    let scenario = Scenario { profile: Profile { turn, ..usual.profile.clone() }, ..usual };
    let file = file_of(&scenario);
    let log = scenario.run();
    let header = log.columns.join(",");
    let first = log.columns.len() - 2;
    let lines = |rows: &dyn Fn(usize) -> bool, keep: &dyn Fn(usize) -> bool| {
        let kept: Vec<usize> = (0..log.columns.len()).filter(|c| keep(*c)).collect();
        let mut text = kept.iter().map(|c| log.columns[*c].clone()).collect::<Vec<_>>().join(",") + "\n";
        for (_, row) in log.rows.iter().enumerate().filter(|(i, _)| rows(*i)) {
            text += &(kept.iter().map(|c| row[*c].to_string()).collect::<Vec<_>>().join(",") + "\n");
        }
        text
    };
    assert!(header.ends_with(&log.columns[first..].join(",")));
    let folder = tempfile::tempdir().unwrap();
    let (inputs, poses) = (folder.path().join("inputs.csv"), folder.path().join("poses.csv"));
    std::fs::write(&inputs, lines(&|_| true, &|c| c == 0 || c >= first)).unwrap();
    // Off the rows of the inputs, as a clock of its own would be, and between them.
    std::fs::write(&poses, lines(&|i| i % 10 == 3, &|c| c < first)).unwrap();
    let run = Run::read_apart(&inputs, &poses, &file).unwrap();
    let report = discover_aligned(&request(&file, &[run]), None, &unheard).unwrap().report;
    assert_eq!(report.verdict, Verdict::NoMissingEffect, "{}", report.summary);
    let offset = &report.data.clocks[0].offset_s;
    assert!(offset.value.abs() < 4.0 * offset.std.unwrap(), "{offset:?}");
    near_the_floor(&report);
}

#[track_caller]
fn near_the_floor(report: &Report) {
    let gap = &report.gap[0];
    let ratio = gap.held_out.as_ref().unwrap().position_rms_after / gap.noise_floor.position_rms;
    assert!(ratio < 2.0, "{ratio}");
}

/// A merged log: encoders in every row, a pose in every third, the other cells blank.
#[test]
fn a_row_without_a_pose_has_inputs() {
    for (hidden, named) in [(vec![], vec![]), (vec![Hidden::TrackWidth { scale: 0.04 }], vec!["track-width"])] {
        let usual = Scenario::new(Tractor::DifferentialDrive, 9);
        let scenario = Scenario { hidden, noise: Noise::MOCAP, duration: 40.0, rate: 50.0, ..usual };
        let scenario = Scenario { timing: Timing::IntervalMean, ..scenario };
        let file = file_of(&scenario);
        let text = scenario.run().to_csv(9);
        let blank = |(i, line): (usize, &str)| {
            let mut cells: Vec<&str> = line.split(',').collect();
            if i > 0 && i % 3 != 1 {
                cells[1..4].iter_mut().for_each(|cell| *cell = "");
            }
            cells.join(",")
        };
        let text = text.lines().enumerate().map(blank).collect::<Vec<_>>().join("\n");
        let run = Run::parse("run.csv", &text, &file).unwrap();
        assert_eq!((run.time.len(), run.inputs[0].len()), (667, 2001));
        assert_eq!(run.why_dropped.values().sum::<usize>(), 1334, "{:?}", run.why_dropped);
        let report = discover(&request(&file, &[run]), &unheard).unwrap().report;
        let ids: Vec<&str> = report.effects.iter().map(|e| e.id.as_str()).collect();
        assert_eq!(ids, named, "{}", report.summary);
        near_the_floor(&report);
    }
}
