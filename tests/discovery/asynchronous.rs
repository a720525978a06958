//! Inputs and poses in files of their own: their clocks are found, with honest deviations, and no effect hides in them.

use crate::simulator::{Hidden, Log, Noise, Profile, Scenario, Signal, Timing, Tractor};
use creepage::discrepancy::check::check_aligned;
use creepage::discrepancy::discover::discover_aligned;
use creepage::discrepancy::identifiability::Checked;
use creepage::discrepancy::report::{Report, RunClock, Verdict};
use creepage::discrepancy::request::Request;
use creepage::files::{ModelFile, Run};
use creepage::progress::unheard;
use creepage::{effects, model};
use std::path::Path;
use std::process::Command;

/// Where the clock of the inputs stands: t = τ·(1 + drift) + offset.
#[derive(Clone, Copy)]
struct Skew {
    offset: f64,
    drift: f64,
}

const SKEW: Skew = Skew { offset: 0.3, drift: 1e-4 };

fn drive(tractor: Tractor, hidden: Vec<Hidden>, seed: u64) -> Scenario {
    Scenario { hidden, duration: 60.0, noise: Noise::MOCAP, ..Scenario::new(tractor, seed) }
}

/// Some columns of a log as CSV, its first one by another clock.
fn csv(log: &Log, wanted: impl Fn(usize) -> bool, clock: impl Fn(f64) -> f64) -> String {
    let columns: Vec<usize> = (1..log.columns.len()).filter(|c| wanted(*c)).collect();
    let mut text = format!("t,{}\n", columns.iter().map(|c| log.columns[*c].as_str()).collect::<Vec<_>>().join(","));
    for row in &log.rows {
        let cells: Vec<String> = columns.iter().map(|c| format!("{}", row[*c])).collect();
        text += &format!("{},{}\n", clock(row[0]), cells.join(","));
    }
    text
}

/// The same drive logged twice: inputs at 50 Hz by their own clock, poses at 12 Hz with jitter.
fn write(folder: &Path, name: &str, scenario: &Scenario, skew: Skew) {
    let inputs = Scenario { rate: 50.0, jitter: 0.2, ..scenario.clone() }.run();
    let poses = Scenario { rate: 12.0, jitter: 0.4, seed: scenario.seed + 1000, ..scenario.clone() }.run();
    let first = inputs.columns.len() - 2;
    let own = |t: f64| (t - skew.offset) / (1.0 + skew.drift);
    std::fs::write(folder.join(format!("{name}.csv")), csv(&inputs, |c| c >= first, own)).unwrap();
    std::fs::write(folder.join(format!("{name}_poses.csv")), csv(&poses, |c| c < first, |t| t)).unwrap();
    std::fs::write(folder.join("model.toml"), scenario.model_toml()).unwrap();
}

fn read(folder: &Path, name: &str) -> (ModelFile, Run) {
    let file = ModelFile::read(folder.join("model.toml"), &model::known(effects::all())).unwrap();
    let poses = folder.join(format!("{name}_poses.csv"));
    let run = Run::read_apart(folder.join(format!("{name}.csv")), poses, &file).unwrap();
    (file, run)
}

fn report(scenario: &Scenario, skew: Skew) -> Report {
    let folder = tempfile::tempdir().unwrap();
    write(folder.path(), "run", scenario, skew);
    let (file, run) = read(folder.path(), "run");
    let runs = [run];
    let request =
        Request { file: &file, runs: &runs, held_out: &[], library: effects::all(), horizons: &[1.0], seed: 3 };
    discover_aligned(&request, None, &unheard).unwrap().report
}

/// The clock as `check` finds it, which is quicker than discovering; no effect is asked about.
fn clock(scenario: &Scenario, skew: Skew) -> RunClock {
    let folder = tempfile::tempdir().unwrap();
    write(folder.path(), "run", scenario, skew);
    let (file, run) = read(folder.path(), "run");
    let of = Checked { file: &file, runs: &[run], library: &[] };
    let mut found = check_aligned(&of, None, &unheard).unwrap();
    assert_eq!(found.data.clocks.len(), 1, "{}", found.summary);
    found.data.clocks.remove(0)
}

/// How far offset and drift are from the truth, in their own deviations.
fn errors(found: &RunClock, skew: Skew) -> [f64; 2] {
    let truth = [skew.offset + skew.drift * found.at_s, skew.drift];
    let of = |e: &creepage::discrepancy::report::Estimate, truth: f64| (e.value - truth) / e.std.unwrap();
    [of(&found.offset_s, truth[0]), of(&found.drift, truth[1])]
}

#[test]
fn nothing_is_named_where_nothing_hides_but_clocks() {
    for (tractor, seed) in [(Tractor::Unicycle, 21), (Tractor::DifferentialDrive, 22), (Tractor::Car, 23)] {
        let found = report(&drive(tractor, vec![], seed), SKEW);
        let named: Vec<&str> = found.effects.iter().map(|e| e.id.as_str()).collect();
        assert_eq!((found.verdict, named), (Verdict::NoMissingEffect, vec![]), "{}", found.summary);
        let clock = &found.data.clocks[0];
        let [offset, drift] = errors(clock, SKEW);
        assert!(offset.abs() < 4.0 && drift.abs() < 4.0, "{offset} {drift} {clock:?}");
        assert!(clock.offset_s.std.unwrap() < 3e-3 && clock.drift.std.unwrap() < 1e-4, "{clock:?}");
        assert!(clock.correlation > 0.95 && clock.other_offset_s.is_none(), "{clock:?}");
    }
}

#[test]
fn what_hides_is_named_beside_the_clocks() {
    let cases = [
        (Hidden::CorneringCreep { mass_over_bt: 0.1 }, "cornering-creep", 31),
        (Hidden::TractionCreep { mass_over_br: 0.12 }, "traction-creep", 32),
        (Hidden::YawRateScale { scale: 0.03 }, "yaw-rate-scale", 33),
    ];
    for (hidden, id, seed) in cases {
        let found = report(&drive(Tractor::Unicycle, vec![hidden], seed), SKEW);
        let named: Vec<&str> = found.effects.iter().map(|e| e.id.as_str()).collect();
        assert_eq!((found.verdict, named), (Verdict::MissingEffect, vec![id]), "{}", found.summary);
        let [offset, drift] = errors(&found.data.clocks[0], SKEW);
        let clock = &found.data.clocks[0];
        assert!(offset.abs() < 4.0 && drift.abs() < 4.0, "{id}: {offset} {drift} {clock:?}");
        // Once the effect is named, nothing unexplained is left to blur the clocks.
        assert!(clock.offset_s.std.unwrap() < 6e-4 && clock.drift.std.unwrap() < 3e-5, "{id}: {clock:?}");
    }
}

/// Σz² of ten standard normal numbers lies between 1.48 and 29.6 but once in 500 times.
#[test]
fn deviations_of_clocks_are_honest() {
    let all: Vec<[f64; 2]> = (0..5)
        .map(|i| {
            let tractor = if i % 2 == 0 { Tractor::Unicycle } else { Tractor::DifferentialDrive };
            let timing = if i % 3 == 0 { Timing::IntervalMean } else { Timing::Sample };
            let scenario = Scenario { timing, ..drive(tractor, vec![], 40 + i) };
            errors(&clock(&scenario, SKEW), SKEW)
        })
        .collect();
    let sum: f64 = all.iter().flatten().map(|z| z * z).sum();
    assert!((1.48..29.6).contains(&sum), "{sum}: {all:?}");
}

#[test]
fn clocks_far_apart_are_found() {
    for skew in [
        Skew { offset: 1.7e9, drift: 0.0 },
        Skew { offset: -37.25, drift: 0.0187 },
        Skew { offset: 4.0, drift: -0.0123 },
    ] {
        let found = clock(&drive(Tractor::Unicycle, vec![], 61), skew);
        let [offset, drift] = errors(&found, skew);
        assert!(offset.abs() < 5.0 && drift.abs() < 5.0, "{offset} {drift} {found:?}");
    }
}

/// The recorder of the poses was begun late and ended late: three fifths of each file are common.
#[test]
fn files_that_overlap_in_part_are_enough() {
    let folder = tempfile::tempdir().unwrap();
    let skew = Skew { offset: 0.8, drift: 0.0 };
    write(folder.path(), "run", &Scenario { duration: 84.0, ..drive(Tractor::Unicycle, vec![], 61) }, skew);
    let only = |name: &str, wanted: &dyn Fn(f64) -> bool| {
        let path = folder.path().join(name);
        let text = std::fs::read_to_string(&path).unwrap();
        let time = |line: &&str| line.split(',').next().unwrap().parse().ok();
        let kept: Vec<&str> = text.lines().filter(|line| time(line).is_none_or(wanted)).collect();
        std::fs::write(&path, kept.join("\n")).unwrap();
    };
    only("run.csv", &|t| t < 60.0);
    only("run_poses.csv", &|t| t > 24.0);
    let (file, run) = read(folder.path(), "run");
    let runs = [run];
    let request = Request { file: &file, runs: &runs, held_out: &[], library: effects::all(), horizons: &[], seed: 0 };
    let report = discover_aligned(&request, None, &unheard).unwrap().report;
    let clock = &report.data.clocks[0];
    let [offset, _] = errors(clock, skew);
    assert!(offset.abs() < 5.0 && clock.other_offset_s.is_none(), "{offset} {clock:?}");
}

#[test]
fn files_of_two_drives_do_not_fit() {
    let folder = tempfile::tempdir().unwrap();
    write(folder.path(), "a", &drive(Tractor::Unicycle, vec![], 71), SKEW);
    write(folder.path(), "b", &drive(Tractor::Unicycle, vec![], 72), SKEW);
    let file = ModelFile::read(folder.path().join("model.toml"), &model::known(effects::all())).unwrap();
    let run = Run::read_apart(folder.path().join("a.csv"), folder.path().join("b_poses.csv"), &file).unwrap();
    let runs = [run];
    let request = Request { file: &file, runs: &runs, held_out: &[], library: effects::all(), horizons: &[], seed: 0 };
    let report = discover_aligned(&request, None, &unheard).unwrap().report;
    assert_eq!(report.verdict, Verdict::UnusableData, "{}", report.summary);
}

/// The same bend again and again: every offset by a whole number of bends does as well, and that is said.
#[test]
fn a_drive_that_repeats_itself_leaves_its_clock_open() {
    let bend = 12.0;
    let profile = Profile { speed: Signal::constant(0.8), turn: Signal::wave(0.6, bend, 0.3) };
    let found = report(&Scenario { profile, ..drive(Tractor::Unicycle, vec![], 62) }, SKEW);
    let clock = &found.data.clocks[0];
    let bends = (clock.other_offset_s.unwrap() - clock.offset_s.value) / bend;
    assert!(bends.round() != 0.0 && (bends - bends.round()).abs() < 0.02, "{clock:?}");
    let doubt = "fits nearly as well as";
    assert!(found.data.warnings.iter().any(|w| w.contains(doubt)), "{:?}", found.data.warnings);
}

#[test]
fn runs_in_one_file_and_in_two_do_not_mix() {
    let folder = tempfile::tempdir().unwrap();
    let scenario = drive(Tractor::Unicycle, vec![], 74);
    write(folder.path(), "a", &scenario, SKEW);
    let (file, apart) = read(folder.path(), "a");
    let whole = Run::parse("whole.csv", &scenario.run().to_csv(9), &file).unwrap();
    let runs = [apart, whole];
    let request = Request { file: &file, runs: &runs, held_out: &[], library: effects::all(), horizons: &[], seed: 0 };
    let Err(refused) = discover_aligned(&request, None, &unheard) else { panic!("accepted") };
    let refused = refused.to_string();
    assert!(refused.starts_with("whole.csv: has its poses in itself") && refused.contains("--truth"), "{refused}");
}

/// Times in nanoseconds would be a file of years: an answer, and no memory for it.
#[test]
fn times_that_are_no_seconds_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    write(folder.path(), "a", &drive(Tractor::Unicycle, vec![], 73), SKEW);
    let (file, mut run) = read(folder.path(), "a");
    run.time.iter_mut().for_each(|t| *t *= 1e9);
    let of = Checked { file: &file, runs: &[run], library: effects::all() };
    let found = check_aligned(&of, None, &unheard).unwrap();
    assert!(found.summary.contains("is its time in seconds?"), "{}", found.summary);
}

fn creepage(folder: &Path, arguments: &str) -> (Option<i32>, String, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_creepage"))
        .current_dir(folder)
        .args(arguments.split_whitespace())
        .output()
        .unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (output.status.code(), text(output.stdout), text(output.stderr))
}

#[test]
fn runs_are_paired_in_order_and_held_out_ones_have_clocks_too() {
    let folder = tempfile::tempdir().unwrap();
    let hidden = vec![Hidden::TrackWidth { scale: 0.04 }];
    let a = drive(Tractor::DifferentialDrive, hidden.clone(), 81);
    let b = Scenario { profile: drive(Tractor::DifferentialDrive, vec![], 82).profile, ..a.clone() };
    write(folder.path(), "a", &a, SKEW);
    write(folder.path(), "b", &b, Skew { offset: -5.0, drift: 0.0 });
    let all = "discover a.csv --truth a_poses.csv --held-out b.csv --held-out-truth b_poses.csv --model model.toml";
    let (code, screen, errors) = creepage(folder.path(), all);
    assert_eq!((code, errors.as_str()), (Some(0), ""));
    assert!(screen.contains("track-width") && screen.contains("clock of a.csv"), "{screen}");
    let text = std::fs::read_to_string(folder.path().join("report/report.json")).unwrap();
    let report: Report = serde_json::from_str(&text).unwrap();
    let clocks: Vec<(&str, bool)> = report.data.clocks.iter().map(|c| (c.run.as_str(), c.held_out)).collect();
    assert_eq!(clocks, [("a.csv", false), ("b.csv", true)]);
    assert!((report.data.clocks[1].offset_s.value + 5.0).abs() < 0.01, "{:?}", report.data.clocks[1]);
    let held_out = report.gap[0].held_out.unwrap();
    assert!(held_out.position_rms_after < 1.5 * report.gap[0].noise_floor.position_rms, "{:?}", report.gap[0]);
    assert_eq!(report.provenance.inputs_sha256.len(), 5);
    for (arguments, says) in [
        ("discover a.csv b.csv --truth a_poses.csv --model model.toml", "1 file under --truth for 2 runs"),
        ("discover a.csv --held-out b.csv --truth a_poses.csv --model model.toml", "without --held-out-truth"),
        ("discover a.csv --held-out b.csv --held-out-truth b_poses.csv --model model.toml", "without --truth"),
        ("discover a.csv b.csv --truth a_poses.csv a_poses.csv --model model.toml", "named twice"),
        ("check a.csv --truth a_poses.csv b_poses.csv --model model.toml", "2 files under --truth for 1 run"),
        ("discover a.csv --truth b.csv --model model.toml", "is missing"),
        ("discover a_poses.csv --truth a_poses.csv --model model.toml", "is missing"),
        ("discover a.csv --clock-offset 1 --model model.toml", "--truth"),
    ] {
        let (code, _, errors) = creepage(folder.path(), arguments);
        assert!(code == Some(2) && errors.contains(says), "{arguments}: {errors}");
    }
}

#[test]
fn the_poses_may_call_their_time_otherwise() {
    let folder = tempfile::tempdir().unwrap();
    write(folder.path(), "a", &drive(Tractor::Unicycle, vec![], 91), SKEW);
    let poses = folder.path().join("a_poses.csv");
    let text = std::fs::read_to_string(&poses).unwrap();
    std::fs::write(&poses, text.replacen("t,", "stamp,", 1)).unwrap();
    let model = folder.path().join("model.toml");
    let text = std::fs::read_to_string(&model).unwrap();
    std::fs::write(&model, text.replace("[columns]\n", "[columns]\ntruth_time = \"stamp\"\n")).unwrap();
    let (_, run) = read(folder.path(), "a");
    assert!(run.time.len() > 700 && run.apart.unwrap().time.len() > 2900);
}

/// The real run before its clocks were aligned is answered as the aligned ones are: the track is 1 % wider.
#[test]
fn the_unaligned_run_is_answered_with_its_clock() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data/real/optiodom");
    let run = folder.join("unaligned_circular_231220200121_run01.csv");
    if !run.exists() {
        eprintln!("skipped: {} is not there", run.display());
        return;
    }
    let file = ModelFile::read(folder.join("model.toml"), &model::known(effects::all())).unwrap();
    let runs = [Run::read_apart(&run, &run, &file).unwrap()];
    let request =
        Request { file: &file, runs: &runs, held_out: &[], library: effects::all(), horizons: &[30.0], seed: 0 };
    let report = discover_aligned(&request, None, &unheard).unwrap().report;
    assert_eq!(report.verdict, Verdict::MissingEffect, "{}", report.summary);
    // On a single circle the track and wheels of unequal radius look alike: whichever is named, the other is listed.
    let class = ["track-width", "wheel-radius-mismatch"];
    let named = report.effects.iter().find(|e| class.contains(&e.id.as_str()));
    let named = named.unwrap_or_else(|| panic!("{}", report.summary));
    let beside = named.indistinguishable_from.iter().any(|r| class.contains(&r.id.as_str()));
    assert!(
        beside || (named.id == "track-width" && (named.parameters["scale"].value - 0.01).abs() < 0.006),
        "{named:?}"
    );
    let clock = &report.data.clocks[0];
    assert!(clock.offset_s.value.abs() < 0.3 && clock.drift.value.abs() < 5e-3, "{clock:?}");
    // There is one run, and it is fitted; nothing is held out.
    let gap = report.gap[0].fit.unwrap();
    assert!(gap.position_rms_after < 0.5 * gap.position_rms_before, "{gap:?}");
}

/// The delay of the model file is one with the offset of the clocks: the file is read, and the offset has it.
#[test]
fn a_delay_of_the_model_file_goes_into_the_clock() {
    let folder = tempfile::tempdir().unwrap();
    write(folder.path(), "run", &drive(Tractor::Unicycle, vec![], 21), SKEW);
    let path = folder.path().join("model.toml");
    let text = std::fs::read_to_string(&path).unwrap() + "[[effects]]\nid = \"input-delay\"\ndelay = 0.02\n";
    std::fs::write(&path, text).unwrap();
    let (file, run) = read(folder.path(), "run");
    let of = Checked { file: &file, runs: std::slice::from_ref(&run), library: effects::all() };
    let checked = check_aligned(&of, None, &unheard).unwrap();
    let asked: Vec<&str> = checked.effects.iter().map(|e| e.id.as_str()).collect();
    assert!(asked.len() > 5 && !asked.contains(&"input-delay"), "an offset of the clock is no effect: {asked:?}");
    let [offset, _] = errors(&checked.data.clocks[0], SKEW);
    assert!(offset.abs() < 4.0, "{offset}");
    assert!(
        checked.data.findings.iter().any(|f| f.says.contains("input-delay is left out")),
        "{:?}",
        checked.data.findings
    );
    let request =
        Request { file: &file, runs: &[run], held_out: &[], library: effects::all(), horizons: &[1.0], seed: 3 };
    let report = discover_aligned(&request, None, &unheard).unwrap().report;
    assert_eq!(report.verdict, Verdict::NoMissingEffect, "{}", report.summary);
    assert!(report.data.warnings.iter().any(|w| w.contains("input-delay is left out")), "{:?}", report.data.warnings);
}

/// The last quarter of what both files have is held out, though the poses go on for as long again.
#[test]
fn held_out_poses_say_nothing_of_the_clock() {
    let found = |spoilt: f64| {
        let folder = tempfile::tempdir().unwrap();
        let scenario = drive(Tractor::Unicycle, vec![], 25);
        write(folder.path(), "run", &scenario, SKEW);
        // Inputs of the first half alone.
        let path = folder.path().join("run.csv");
        let text = std::fs::read_to_string(&path).unwrap();
        let kept: Vec<&str> = text.lines().take(1 + 30 * 50).collect();
        std::fs::write(&path, kept.join("\n")).unwrap();
        let (file, mut run) = read(folder.path(), "run");
        let from = SKEW.offset + 0.76 * 30.0;
        let held_out = run.time.iter().zip(&mut run.x).filter(|(t, _)| **t > from);
        held_out.enumerate().for_each(|(i, (_, x))| *x += spoilt * if i % 2 == 0 { 1.0 } else { -1.0 });
        let runs = [run];
        let request =
            Request { file: &file, runs: &runs, held_out: &[], library: effects::all(), horizons: &[1.0], seed: 3 };
        discover_aligned(&request, None, &unheard).unwrap().report.data.clocks.remove(0)
    };
    let (clean, spoilt) = (found(0.0), found(0.01));
    assert_eq!((clean.offset_s, clean.drift, clean.at_s), (spoilt.offset_s, spoilt.drift, spoilt.at_s));
}

#[test]
fn two_short_files_are_too_short_and_not_of_two_drives() {
    let folder = tempfile::tempdir().unwrap();
    let scenario = Scenario { duration: 7.0, ..drive(Tractor::Unicycle, vec![], 26) };
    write(folder.path(), "run", &scenario, SKEW);
    let (file, run) = read(folder.path(), "run");
    let runs = [run];
    let request = Request { file: &file, runs: &runs, held_out: &[], library: effects::all(), horizons: &[], seed: 3 };
    let report = discover_aligned(&request, None, &unheard).unwrap().report;
    assert_eq!(report.verdict, Verdict::NotIdentifiable, "{}", report.summary);
    assert!(report.summary.contains("too short"), "{}", report.summary);
}
