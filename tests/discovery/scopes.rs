//! What holds in part, moves with time or acts on one input is found with its scope; nothing is where nothing does.

use crate::noisy_run::noisy_run;
use creepage::{Model, Report, Run};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

const UNICYCLE: &str = "vehicle = \"unicycle\"\n[parameters]\nwheel_radius = 0.1\n";
const DRIVE: &str = "vehicle = \"differential-drive\"\n[parameters]\nwheel_radius = 0.1\ntrack_width = 0.4\n";
const CAR: &str = "vehicle = \"car\"\n[parameters]\nwheel_radius = 0.3\nwheelbase = 2.5\n";

/// Times, and inputs by their roles.
type Driven = (Vec<f64>, [(&'static str, Vec<f64>); 2]);

/// The inputs of a drive of 80 s at 20 Hz that goes forward and backward, speeds up and slows down, and turns both ways.
fn inputs(turning: &'static str, by: f64, wheel: f64) -> Driven {
    let time: Vec<f64> = (0..1600).map(|i| 0.05 * f64::from(i)).collect();
    let of = |f: &dyn Fn(f64) -> f64| time.iter().map(|t| f(*t)).collect::<Vec<f64>>();
    let rate = of(&|t| wheel * (0.4 + (0.21 * t).sin() + 0.3 * (0.57 * t).cos()));
    let turn = of(&|t| by * ((0.37 * t).sin() + 0.4 * (0.83 * t + 1.0).sin()));
    (time, [("wheel_rate", rate), (turning, turn)])
}

/// The rates of two wheels with the speed of one in their middle, and its yaw rate.
fn wheels((time, [(_, rate), (_, turn)]): Driven) -> Driven {
    let one = |side: f64| rate.iter().zip(&turn).map(|(r, w)| r + side * 2.0 * w).collect::<Vec<f64>>();
    (time, [("wheel_rate_left", one(-1.0)), ("wheel_rate_right", one(1.0))])
}

/// A run of a model that includes what is hidden, with noise.
fn driven(head: &str, hidden: &str, noise: f64, seed: u64) -> Run {
    let (time, inputs) = match head {
        CAR => inputs("steering_angle", 0.25, 4.0),
        DRIVE => wheels(inputs("yaw_rate", 0.5, 8.0)),
        _ => inputs("yaw_rate", 0.5, 8.0),
    };
    let truth = Model::parse(&format!("{head}{hidden}")).unwrap();
    noisy_run(&truth, time, inputs.to_vec(), noise, seed)
}

fn answer(head: &str, hidden: &str, seed: u64) -> (Report, String) {
    let run = driven(head, hidden, 2e-3, seed);
    let found = creepage::discover(&Model::parse(head).unwrap(), &[run]).unwrap();
    (found.report, found.model.text().to_string())
}

fn effect(id: &str, rest: &str) -> String {
    format!("[[effects]]\nid = \"{id}\"\n{rest}\n")
}

#[test]
fn what_begins_at_a_time_is_named_with_its_beginning() {
    let (report, patched) = answer(UNICYCLE, &effect("rotation-creep", "e_rc = 0.05\nscope = { from = 31.4 }"), 3);
    let [one] = &report.effects[..] else { panic!("{}", report.summary) };
    let from = one.scope.as_ref().and_then(|s| s.from).unwrap();
    assert!(one.id == "rotation-creep" && (from - 31.4).abs() < 0.3, "{}", report.summary);
    assert!((one.parameters["e_rc"].value - 0.05).abs() < 0.001, "{:?}", one.parameters);
    assert!(patched.contains("scope = { from = "), "{patched}");
    // The patched model is a model again, and explains the run.
    let run = driven(UNICYCLE, &effect("rotation-creep", "e_rc = 0.05\nscope = { from = 31.4 }"), 0.0, 3);
    let table = creepage::simulate(&Model::parse(&patched).unwrap(), &run).unwrap();
    let off = table.column("x").unwrap().iter().zip(&run.x).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(off < 0.02, "{off}");
}

/// A slope has no direction where it has no steepness, and a creep no limit where there is none: both are sought in part
/// all the same, and are not taken for the drift and the creep that imitate them.
#[test]
fn what_means_nothing_at_zero_may_begin_as_well() {
    let cases = [
        (UNICYCLE, "side-slope", "rate = 0.06\ndirection = 0.7"),
        (UNICYCLE, "grade", "rate = 0.06\ndirection = -1.9"),
        (CAR, "saturating-creep", "c = 0.15\nlimit = 0.1"),
    ];
    for (head, id, values) in cases {
        let hidden = effect(id, &format!("{values}\nscope = {{ from = 24.3, until = 52.3 }}"));
        let (report, _) = answer(head, &hidden, 6);
        let [one] = &report.effects[..] else { panic!("{id}: {}", report.summary) };
        let scope = one.scope.as_ref().unwrap();
        let [from, until] = [scope.from, scope.until].map(Option::unwrap);
        assert!(one.id == id && (from - 24.3).abs() < 0.3 && (until - 52.3).abs() < 0.3, "{}", report.summary);
        for line in values.lines() {
            let (name, value) = line.split_once(" = ").unwrap();
            let (found, value) = (&one.parameters[name], value.parse::<f64>().unwrap());
            assert!((found.value - value).abs() < 4.0 * found.std.unwrap(), "{id} {name}: {found:?}");
        }
    }
}

/// What has a state of its own is sought in part as well, by a share of what it does.
#[test]
fn what_builds_up_or_lags_may_begin_as_well() {
    let cases = [
        (UNICYCLE, "traction-creep", "", "mass_over_bR", 0.15),
        (UNICYCLE, "cornering-creep", "", "mass_over_bT", 0.15),
        (CAR, "relaxation-length", "e_tc = 0.03\n", "length", 0.8),
        (CAR, "input-lag", "input = \"steering_angle\"\n", "time_constant", 0.3),
        (CAR, "input-backlash", "input = \"steering_angle\"\n", "width", 0.04),
    ];
    for (head, id, more, name, value) in cases {
        let hidden = effect(id, &format!("{more}{name} = {value}\nscope = {{ from = 24.3, until = 52.3 }}"));
        let (report, _) = answer(head, &hidden, 6);
        let [one] = &report.effects[..] else { panic!("{id}: {}", report.summary) };
        let scope = one.scope.as_ref().unwrap_or_else(|| panic!("{id}: {}", report.summary));
        let [from, until] = [scope.from, scope.until].map(Option::unwrap);
        assert!(one.id == id && (from - 24.3).abs() < 0.5 && (until - 52.3).abs() < 0.5, "{}", report.summary);
        let found = &one.parameters[name];
        assert!((found.value - value).abs() < 0.02 * value, "{id} {name}: {found:?}");
    }
}

/// A small effect that holds in part is taken for noise, which hides it: it is seen at the noise that there is without it.
#[test]
fn a_small_part_is_not_lost_in_the_noise_that_it_makes() {
    for seed in [6, 8, 11] {
        let hidden = effect("steering-gain", "scale = 0.01\nscope = { from = 31.4 }");
        let run = driven(CAR, &hidden, 5e-3, seed);
        let report = creepage::discover(&Model::parse(CAR).unwrap(), &[run]).unwrap().report;
        let [one] = &report.effects[..] else { panic!("{seed}: {}", report.summary) };
        let from = one.scope.as_ref().and_then(|s| s.from).unwrap();
        // About 24 s and 31 s the vehicle turns back, and hardly moves.
        assert!((23.0..32.0).contains(&from), "{}", report.summary);
        let rivals: Vec<&str> = one.indistinguishable_from.iter().map(|r| r.id.as_str()).collect();
        let is_told = one.id == "steering-gain" || rivals.contains(&"steering-gain");
        assert!(is_told && report.remains.is_none(), "{}: {rivals:?}", report.summary);
    }
}

/// An edge is found to less than a row where the sensor is that precise, so that the interval of the value holds it, and
/// nothing is left that a place would explain better.
#[test]
fn an_edge_is_found_to_less_than_a_row() {
    let run = driven(UNICYCLE, &effect("rotation-creep", "e_rc = 0.05\nscope = { from = 31.413 }"), 1e-4, 7);
    let report = creepage::discover(&Model::parse(UNICYCLE).unwrap(), &[run]).unwrap().report;
    let [one] = &report.effects[..] else { panic!("{}", report.summary) };
    let from = one.scope.as_ref().and_then(|s| s.from).unwrap();
    let creep = &one.parameters["e_rc"];
    assert!((from - 31.413).abs() < 0.005 && report.remains.is_none(), "{}", report.summary);
    assert!((creep.value - 0.05).abs() < 3.0 * creep.std.unwrap(), "{creep:?}");
}

/// About 25.4 s the vehicle stops turning left and begins to turn right: what changes its yaw from a little before on turns it,
/// in all, as much as what begins a little after. Both are looked at.
#[test]
fn a_beginning_is_told_from_its_image_beyond_a_turn() {
    for from in [25.21, 25.57] {
        let hidden = effect("yaw-rate-scale", &format!("scale = -0.056\nscope = {{ from = {from} }}"));
        let run = driven(UNICYCLE, &hidden, 1e-4, 9);
        let report = creepage::discover(&Model::parse(UNICYCLE).unwrap(), &[run]).unwrap().report;
        let [one] = &report.effects[..] else { panic!("{}", report.summary) };
        let found = one.scope.as_ref().and_then(|s| s.from).unwrap();
        assert!(one.id == "yaw-rate-scale" && (found - from).abs() < 0.02, "{from}: {}", report.summary);
        assert!(report.remains.is_none(), "{}", report.summary);
    }
}

/// Where no heading is measured, and the vehicle hardly turns, the headings of a model without the slope take its slip angle for
/// theirs, and the linear screen sees a drift alone: the slope is fitted in full within the times of the drift.
#[test]
fn a_slope_that_headings_hide_is_named_with_its_times() {
    let times = "scope = { from = 30.85, until = 49.73 }";
    let time: Vec<f64> = (0..1600).map(|i| 0.05 * f64::from(i)).collect();
    let side = |sign: f64| {
        let rate = |t: &f64| 5.0 + (0.31 * t).sin() + sign * (0.5 * (0.53 * t).sin() + 0.2 * (1.1 * t).cos());
        time.iter().map(rate).collect::<Vec<f64>>()
    };
    let inputs = [("wheel_rate_left", side(-1.0)), ("wheel_rate_right", side(1.0))];
    for (rate, direction) in [(0.12, 1.2), (0.12, -1.0)] {
        let hidden = effect("side-slope", &format!("rate = {rate}\ndirection = {direction}\n{times}"));
        let truth = Model::parse(&format!("{DRIVE}{hidden}")).unwrap();
        let run = Run { heading: None, ..noisy_run(&truth, time.clone(), inputs.to_vec(), 1e-4, 8) };
        let report = creepage::discover(&Model::parse(DRIVE).unwrap(), &[run]).unwrap().report;
        let [one] = &report.effects[..] else { panic!("{rate}: {}", report.summary) };
        let scope = one.scope.as_ref().unwrap();
        let [from, until] = [scope.from, scope.until].map(|t| t.unwrap_or(f64::NAN));
        assert!(one.id == "side-slope" && report.remains.is_none(), "{}", report.summary);
        assert!((from - 30.85).abs() < 0.05 && (until - 49.73).abs() < 0.05, "{}", report.summary);
        let found = &one.parameters["rate"];
        assert!((found.value - rate).abs() < 4.0 * found.std.unwrap(), "{found:?}");
    }
}

/// What cannot be told from an effect is listed for the time in which that holds: on one circle an angle and a gain are one.
#[test]
fn rivals_of_what_begins_are_those_that_begin_with_it() {
    let time: Vec<f64> = (0..1200).map(|i| 0.05 * f64::from(i)).collect();
    let inputs = [("wheel_rate", vec![5.0; 1200]), ("steering_angle", vec![0.2; 1200])];
    let truth = Model::parse(&format!("{CAR}{}", effect("steering-offset", "offset = 0.03\nscope = { from = 22.0 }")));
    let run = noisy_run(&truth.unwrap(), time, inputs.to_vec(), 2e-3, 8);
    let report = creepage::discover(&Model::parse(CAR).unwrap(), &[run]).unwrap().report;
    let [one] = &report.effects[..] else { panic!("{}", report.summary) };
    let rivals: Vec<&str> = one.indistinguishable_from.iter().map(|r| r.id.as_str()).collect();
    let told = |id: &str| one.id == id || rivals.contains(&id);
    assert!(one.scope.is_some() && told("steering-offset") && told("steering-gain"), "{}: {rivals:?}", report.summary);
}

#[test]
fn what_holds_in_reverse_alone_is_named_so() {
    let (report, _) = answer(CAR, &effect("steering-offset", "offset = 0.03\nscope = { regime = \"reverse\" }"), 4);
    let [one] = &report.effects[..] else { panic!("{}", report.summary) };
    let regime = one.scope.as_ref().and_then(|s| s.regime.clone());
    assert_eq!((one.id.as_str(), regime.as_deref()), ("steering-offset", Some("reverse")), "{}", report.summary);
}

#[test]
fn what_moves_with_time_is_named_with_its_course() {
    let bias = "bias = 0.002\ncourse = { kind = \"linear\", per_s = 0.0005 }";
    let (report, _) = answer(UNICYCLE, &effect("yaw-rate-bias", bias), 5);
    let [one] = &report.effects[..] else { panic!("{}", report.summary) };
    let course = one.parameters["bias"].course.clone().unwrap();
    assert!(one.id == "yaw-rate-bias" && (course.per_s.unwrap() - 5e-4).abs() < 3e-5, "{}: {course:?}", report.summary);
}

/// Runs of one clock in which it moves alike share their course; where it moves to either side they do not.
#[test]
fn runs_of_one_clock_share_a_course() {
    let runs = |rates: [f64; 2]| {
        let one = |(rate, seed): (f64, u64)| {
            let bias = format!("bias = 0.002\ncourse = {{ kind = \"linear\", per_s = {rate:?} }}");
            driven(UNICYCLE, &effect("yaw-rate-bias", &bias), 2e-3, seed)
        };
        let runs = [one((rates[0], 21)), one((rates[1], 22))];
        creepage::discover(&Model::parse(UNICYCLE).unwrap(), &runs).unwrap().report
    };
    let courses = |report: &Report| {
        let all = report.effects.iter().flat_map(|e| e.parameters.values());
        all.filter_map(|p| p.course.as_ref()?.per_s).collect::<Vec<f64>>()
    };
    let alike = runs([5e-4, 5e-4]);
    let [per_s] = courses(&alike)[..] else { panic!("{}", alike.summary) };
    assert!((per_s - 5e-4).abs() < 3e-5, "{}: {per_s}", alike.summary);
    let apart = runs([5e-4, -5e-4]);
    assert!(courses(&apart).is_empty(), "{}", apart.summary);
}

/// A drive whose gyroscope has a bias that begins somewhere and walks.
fn walking(begin: f64, per_sqrt_s: f64, seed: u64) -> Run {
    let mut run = driven(UNICYCLE, "", 2e-3, 31);
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let rate = run.roles.iter().position(|r| r == "yaw_rate").unwrap();
    let mut bias = begin;
    for value in &mut run.inputs[rate] {
        *value -= bias;
        bias += per_sqrt_s * 0.05_f64.sqrt() * (0..12).map(|_| random.random_range(-0.5..0.5)).sum::<f64>();
    }
    run
}

/// A bias with a deviation of 0.0004 rad/s over a second, 0.0036 rad/s over the run; and two that walk about zero, one of them
/// further from one window to the next than a window tells.
#[test]
fn a_bias_that_walks_is_named_with_its_walk() {
    for (begin, per_sqrt_s, seed) in [(0.02, 4e-4, 32), (0.0, 1e-3, 33), (0.0, 4e-3, 34)] {
        let run = walking(begin, per_sqrt_s, seed);
        let found = creepage::discover(&Model::parse(UNICYCLE).unwrap(), &[run]).unwrap();
        let [one] = &found.report.effects[..] else { panic!("{}", found.report.summary) };
        let course = one.parameters["bias"].course.clone().unwrap();
        let walk = course.per_sqrt_s.unwrap();
        assert_eq!(
            (one.id.as_str(), course.kind.as_str()),
            ("yaw-rate-bias", "random-walk"),
            "{}",
            found.report.summary
        );
        assert!((0.5 * per_sqrt_s..2.0 * per_sqrt_s).contains(&walk), "{course:?}");
        assert!(course.std.is_some_and(|std| std < walk), "{course:?}");
        let text = found.model.text();
        assert!(text.contains("course = { kind = \"random-walk\", parameter = \"bias\", per_sqrt_s = "), "{text}");
        assert!(Model::parse(text).is_ok());
    }
}

/// What comes and goes is no constant creep of half the size: the times in between are cut out of a longer one.
#[test]
fn what_comes_and_goes_is_named_with_its_intervals() {
    let intervals = "intervals = [[0.0, 9.5], [19.0, 28.5], [38.0, 47.5], [57.0, 66.5], [76.0, 85.5]]";
    let (report, _) = answer(CAR, &effect("rotation-creep", &format!("e_rc = 0.07\nscope = {{ {intervals} }}")), 9);
    let [one] = &report.effects[..] else { panic!("{}", report.summary) };
    let found = one.scope.as_ref().map(|s| s.intervals.clone()).unwrap_or_default();
    let edges: Vec<f64> = found.into_iter().flatten().filter(|t| t.is_finite()).collect();
    // Of the last one three seconds are fitted.
    let truth = [9.5, 19.0, 28.5, 38.0, 47.5, 57.0];
    let is_true = |(e, t): (&f64, f64)| (e - t).abs() < 0.3;
    assert!(edges.len() >= 5 && edges.iter().zip(truth).all(is_true), "{}: {edges:?}", report.summary);
    assert!((one.parameters["e_rc"].value - 0.07).abs() < 0.002, "{:?}", one.parameters);
}

/// A speed that is held between short ramps: what is there while it grows lasts for seconds in all.
#[test]
fn what_holds_on_short_ramps_is_named_with_what_the_vehicle_does() {
    let time: Vec<f64> = (0..1600).map(|i| 0.05 * f64::from(i)).collect();
    let ramp = |t: f64| (t / 1.2).clamp(0.0, 1.0);
    let held = |t: f64| {
        3.0 + 5.0 * (0..10).map(|k| ramp(t - 8.0 * f64::from(k)) - ramp(t - 4.0 - 8.0 * f64::from(k))).sum::<f64>()
    };
    let rate: Vec<f64> = time.iter().map(|t| held(*t)).collect();
    let turn: Vec<f64> = time.iter().map(|t| 0.5 * (0.37 * t).sin()).collect();
    let hidden = effect("rotation-creep", "e_rc = 0.1\nscope = { where = \"sign(v_0)*v_0' - 0.05 > 0\" }");
    let truth = Model::parse(&format!("{UNICYCLE}{hidden}")).unwrap();
    let run = noisy_run(&truth, time, vec![("wheel_rate", rate), ("yaw_rate", turn)], 1e-3, 10);
    let report = creepage::discover(&Model::parse(UNICYCLE).unwrap(), &[run]).unwrap().report;
    let [one] = &report.effects[..] else { panic!("{}", report.summary) };
    let formula = one.scope.as_ref().and_then(|s| s.positive.clone());
    assert!(
        one.id == "rotation-creep" && formula.is_some_and(|f| f.starts_with("sign(v_0)*v_0'")),
        "{}",
        report.summary
    );
    assert!((one.parameters["e_rc"].value - 0.1).abs() < 0.01, "{:?}", one.parameters);
}

/// The play of a steering that is small beside its angles is named, and no delay of a share of a row beside it.
#[test]
fn small_play_is_named_alone() {
    let (report, _) = answer(CAR, &effect("input-backlash", "input = \"steering_angle\"\nwidth = 0.008"), 11);
    let [one] = &report.effects[..] else { panic!("{}", report.summary) };
    assert_eq!((one.id.as_str(), one.on.as_deref()), ("input-backlash", Some("steering_angle")), "{}", report.summary);
    assert!((one.parameters["width"].value - 0.008).abs() < 4e-4, "{:?}", one.parameters);
}

#[test]
fn one_input_that_is_late_limited_or_dead_is_named_with_its_input() {
    for (head, id, rest, input) in [
        (UNICYCLE, "input-delay", "delay = -0.3", "yaw_rate"),
        (UNICYCLE, "input-lag", "time_constant = 0.4", "yaw_rate"),
        (DRIVE, "input-lag", "time_constant = 0.3", "wheel_rate_left"),
        (CAR, "input-saturation", "limit = 0.2", "steering_angle"),
        (CAR, "input-dead-band", "width = 0.03", "steering_angle"),
    ] {
        let (report, _) = answer(head, &effect(id, &format!("input = \"{input}\"\n{rest}")), 6);
        let [one] = &report.effects[..] else { panic!("{id}: {}", report.summary) };
        assert_eq!((one.id.as_str(), one.on.as_deref()), (id, Some(input)), "{}", report.summary);
        let (name, value) = rest.split_once(" = ").unwrap();
        let value: f64 = value.parse().unwrap();
        assert!((one.parameters[name].value - value).abs() < 0.05 * value.abs(), "{id}: {:?}", one.parameters);
    }
}

/// What always holds has no scope, and nothing has none.
#[test]
fn what_always_holds_has_no_scope() {
    for seed in 0..6 {
        let (nothing, _) = answer(if seed % 2 == 0 { UNICYCLE } else { CAR }, "", 100 + seed);
        assert!(nothing.effects.is_empty(), "{}", nothing.summary);
        let (creep, _) = answer(UNICYCLE, &effect("rotation-creep", "e_rc = 0.05"), 200 + seed);
        let [one] = &creep.effects[..] else { panic!("{}", creep.summary) };
        assert!(one.scope.is_none() && one.on.is_none(), "{}", creep.summary);
    }
}

/// A bias from 3.3 s on turns the vehicle by b·(t − 3.3), to the accuracy of the integration.
#[test]
fn a_gate_opens_at_its_time() {
    let hidden = effect("yaw-rate-bias", "bias = 0.02\nscope = { intervals = [[3.3, 7.77], [20.0, 21.0]] }");
    let with = driven(UNICYCLE, &hidden, 0.0, 1);
    let without = driven(UNICYCLE, "", 0.0, 1);
    let headings = with.heading.unwrap().into_iter().zip(without.heading.unwrap());
    for (t, (a, b)) in with.time.iter().zip(headings) {
        let open = (t.min(7.77) - 3.3).max(0.0) + (t.min(21.0) - 20.0).max(0.0);
        assert!((a - b - 0.02 * open).abs() < 1e-9, "{t}: {}", a - b);
    }
}
