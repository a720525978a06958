//! Whole answers as a person has read and accepted them: everything `discover` and `check` say of drives off the beaten
//! track, and one of every kind of verdict.

use crate::reviewed::reviewed;
use crate::rounded::rounded;
use crate::simulator::{Hidden, Mounting, Noise, Profile, Scenario, Signal, Timing, Tractor, Vehicle};
use creepage::discrepancy::check::check;
use creepage::discrepancy::discover::discover;
use creepage::discrepancy::discovery::Discovery;
use creepage::discrepancy::identifiability::Checked;
use creepage::discrepancy::rendering::check_text::check_text;
use creepage::discrepancy::rendering::html::html;
use creepage::discrepancy::rendering::summary::summary_text;
use creepage::discrepancy::report::Pictures;
use creepage::discrepancy::request::Request;
use creepage::effects;
use creepage::files::{ModelFile, Run};
use creepage::model;
use creepage::progress::unheard;
use std::fmt::Write as _;

/// Runs as their user has them.
struct Drive {
    model: String,
    fitted: Vec<String>,
    held_out: Vec<String>,
    horizons: Vec<f64>,
}

impl Drive {
    fn of(scenario: &Scenario) -> Self {
        Self { model: scenario.model_toml(), fitted: vec![csv(scenario)], held_out: vec![], horizons: vec![] }
    }

    /// Another run of the same vehicle, to fit.
    fn and(mut self, scenario: &Scenario) -> Self {
        self.fitted.push(csv(scenario));
        self
    }

    /// Another run of the same vehicle, to judge.
    fn held_out(mut self, scenario: &Scenario) -> Self {
        self.held_out.push(csv(scenario));
        self
    }

    fn at(mut self, horizons: &[f64]) -> Self {
        self.horizons = horizons.to_vec();
        self
    }

    fn read(&self) -> (ModelFile, [Vec<Run>; 2]) {
        let file = ModelFile::parse(&self.model, "model.toml", &model::known(effects::all())).unwrap();
        let runs = |kind: &str, all: &[String]| -> Vec<Run> {
            let run = |(i, text): (usize, &String)| Run::parse(&format!("{kind}-{i}.csv"), text, &file).unwrap();
            all.iter().enumerate().map(run).collect()
        };
        let both = [runs("run", &self.fitted), runs("judged", &self.held_out)];
        (file, both)
    }

    fn discovered(&self) -> (ModelFile, Discovery) {
        let (file, [runs, held_out]) = self.read();
        let (library, horizons) = (effects::all(), &self.horizons[..]);
        let request = Request { file: &file, runs: &runs, held_out: &held_out, library, horizons, seed: 3 };
        let found = discover(&request, &unheard).unwrap();
        (file, found)
    }

    /// The report, its summary, what its pictures show and what the model file gains.
    #[track_caller]
    fn discover(&self, name: &str) -> Discovery {
        let (file, found) = self.discovered();
        let mut json = serde_json::to_value(&found.report).unwrap();
        json.as_object_mut().unwrap().remove("provenance");
        rounded(&mut json);
        let mut text = format!("{json:#}\n\n{}\n\n", summary_text(&found.report));
        drawn(&found.pictures, &mut text);
        let added: Vec<&str> = found.added.iter().map(|e| e.id.as_str()).collect();
        writeln!(text, "added: {}", added.join(", ")).unwrap();
        let patched = found.patched(&file);
        assert!(ModelFile::parse(&patched, "patched.toml", &model::known(effects::all())).is_ok(), "{patched}");
        reviewed(&format!("answer-{name}"), &text);
        found
    }

    /// What `check` says of the fitted runs.
    #[track_caller]
    fn check(&self, name: &str) {
        let (file, [runs, _]) = self.read();
        let answer = check(&Checked { file: &file, runs: &runs, library: effects::all() }, &unheard).unwrap();
        let mut json = serde_json::to_value(&answer).unwrap();
        rounded(&mut json);
        reviewed(&format!("check-{name}"), &format!("{json:#}\n\n{}", check_text(&answer)));
    }
}

fn csv(scenario: &Scenario) -> String {
    scenario.run().to_csv(9)
}

/// Three digits.
fn short(x: f64) -> String {
    if x.abs() < 1e-12 { "0".into() } else { format!("{x:.2e}") }
}

/// What the pictures show: the curves of the gap in full, of others how many points they have and where they end.
fn drawn(pictures: &Pictures, text: &mut String) {
    let ends = |points: &[[f64; 2]]| {
        let end = |p: Option<&[f64; 2]>| p.map_or("nowhere".into(), |p| format!("({}, {})", short(p[0]), short(p[1])));
        format!("{} points from {} to {}", points.len(), end(points.first()), end(points.last()))
    };
    for p in &pictures.paths {
        writeln!(text, "path {}{}: {}", p.run, if p.held_out { ", held out" } else { "" }, ends(&p.measured)).unwrap();
        for (what, pieces) in [("before", &p.before), ("after", &p.after)] {
            pieces.iter().for_each(|piece| writeln!(text, "  {what}: {}", ends(piece)).unwrap());
        }
    }
    let gap = &pictures.gap;
    for (i, h) in gap.horizon.iter().enumerate() {
        let [before, after, floor] = [&gap.before, &gap.after, &gap.floor].map(|c| short(c[i]));
        writeln!(text, "gap after {} s: {before}, {after}, {floor}", short(*h)).unwrap();
    }
    for r in &pictures.residuals {
        let rms = |v: &[f64]| short((v.iter().map(|x| x * x).sum::<f64>() / v.len() as f64).sqrt());
        let [from, to] = [r.time.first(), r.time.last()].map(|t| t.map_or("none".into(), |t| short(*t)));
        writeln!(
            text,
            "residual {} of {}: {} times from {from} to {to} s, {} {} before, {} after, noise {}",
            r.constraint,
            r.run,
            r.time.len(),
            rms(&r.before),
            r.unit,
            rms(&r.after),
            short(r.noise)
        )
        .unwrap();
    }
    for c in &pictures.candidates {
        let mark = if c.chosen { ", chosen" } else { "" };
        let rival = if c.rival { ", rival" } else { "" };
        writeln!(text, "candidate {}: {}{mark}{rival}", c.id, short(c.delta_bic)).unwrap();
    }
    pictures.equations.iter().for_each(|(name, equation)| writeln!(text, "{name}: {equation}").unwrap());
}

/// A short drive before motion capture, at 20 Hz.
fn drive(vehicle: impl Into<Vehicle>, hidden: &[Hidden], seed: u64) -> Scenario {
    let usual = Scenario::new(vehicle, seed);
    Scenario { hidden: hidden.to_vec(), duration: 30.0, rate: 20.0, noise: Noise::MOCAP, ..usual }
}

/// The drive with a speed and a turn of its own.
fn with(scenario: Scenario, speed: Signal, turn: Signal) -> Scenario {
    Scenario { profile: Profile { speed, turn }, ..scenario }
}

/// One circle tells a scale of the gyro from a bias only by its noise, and a lever arm from a creep not at all.
#[test]
fn one_circle() {
    let s = drive(Tractor::Unicycle, &[Hidden::YawRateScale { scale: 0.05 }], 1);
    let drive = Drive::of(&with(s, Signal::constant(0.8), Signal::constant(0.5)));
    drive.discover("one-circle");
    drive.check("one-circle");
}

/// A log as they come.
#[test]
fn a_rough_log() {
    let hidden = [Hidden::WheelRadiusMismatch { scale: 0.03 }];
    let rough = |seed| drive(Tractor::DifferentialDrive, &hidden, seed).roughly_logged();
    let drive = Drive::of(&rough(2)).held_out(&rough(3)).at(&[2.0, 0.5, 10.0, 40.0]);
    drive.discover("rough-log");
    drive.check("rough-log");
}

/// Satellites see a mast that does not stand on the axle, and no heading; a logged speed instead of a wheel's rate.
#[test]
fn a_mast_without_a_heading() {
    let s = Scenario {
        logs_heading: false,
        logs_speed: true,
        mounting: Mounting { lever_arm: [0.2, -0.1], heading_offset: 0.0 },
        noise: Noise::RTK,
        duration: 50.0,
        ..drive(Tractor::Unicycle, &[Hidden::YawRateBias { bias: 0.03 }], 4)
    };
    let drive = Drive::of(&s);
    drive.discover("mast");
    drive.check("mast");
}

/// Nothing measures the heading of a vehicle that slides outwards.
#[test]
fn a_slide_without_a_heading() {
    let s = Scenario {
        logs_heading: false,
        duration: 40.0,
        ..drive(Tractor::Unicycle, &[Hidden::CorneringCreep { mass_over_bt: 0.12 }], 26)
    };
    Drive::of(&s).discover("slide-without-heading");
}

/// Of two trailers the second one is longer than its drawing says.
#[test]
fn a_train() {
    let train = |seed| {
        let vehicle =
            Vehicle::NTrailer { tractor: Tractor::Car, lengths: vec![3.0, 2.5], hitch_offsets: vec![0.4, 0.0] };
        drive(vehicle, &[Hidden::TrailerLength { trailer: 2, scale: 0.1 }], seed)
    };
    let drive = Drive::of(&train(5)).held_out(&train(6)).at(&[1.0, 4.0]);
    drive.discover("train");
    drive.check("train");
}

/// Two effects, two runs and a third one to judge them on.
#[test]
fn two_effects_of_a_car() {
    let car = |seed| {
        let hidden = [Hidden::SteeringOffset { offset: 0.02 }, Hidden::Understeer { gradient: 0.004 }];
        drive(Tractor::FourWheelCar, &hidden, seed)
    };
    let drive = Drive::of(&car(7)).and(&car(8)).held_out(&car(9));
    let found = drive.discover("two-effects");
    page("two-effects", &found);
    drive.check("two-effects");
}

/// A law that no effect of the library has.
#[test]
fn a_law_without_a_name() {
    let s = |seed| Scenario { duration: 60.0, ..drive(Tractor::Unicycle, &[Hidden::YawSquareSlip { q: 0.13 }], seed) };
    let found = Drive::of(&s(10)).held_out(&s(11)).discover("without-a-name");
    page("without-a-name", &found);
}

/// Effects with states of their own: a tyre that runs in, a wheel that pulls, and a delay beside it.
#[test]
fn effects_with_states() {
    let tyre = drive(Tractor::Unicycle, &[Hidden::RelaxationLength { length: 0.6, e_tc: 0.08 }], 12);
    Drive::of(&tyre).discover("relaxation");
    let hidden = [Hidden::TractionCreep { mass_over_br: 0.15 }, Hidden::InputDelay { delay: 0.06 }];
    Drive::of(&drive(Tractor::Unicycle, &hidden, 13)).discover("traction-and-delay");
}

/// Forwards and back again on a floor that is carried along.
#[test]
fn forwards_and_back() {
    let s = drive(Tractor::DifferentialDrive, &[Hidden::Drift { vx: 0.03, vy: -0.02 }], 14);
    let drive = Drive::of(&with(s, Signal::wave(0.6, 15.0, 0.3), Signal::wave(0.8, 9.0, 1.0)));
    drive.discover("forwards-and-back");
    drive.check("forwards-and-back");
}

/// A tricycle straight ahead at one speed: hardly anything can be told.
#[test]
fn straight_ahead() {
    let s = drive(Tractor::Tricycle, &[], 15);
    let drive = Drive::of(&with(s, Signal::constant(1.5), Signal::constant(0.0)));
    let found = drive.discover("straight-ahead");
    page("straight-ahead", &found);
    drive.check("straight-ahead");
}

/// Nothing is missing; satellites, a long horizon.
#[test]
fn nothing_missing() {
    let s = |seed| Scenario { noise: Noise::RTK, duration: 80.0, ..drive(Tractor::Car, &[], seed) };
    let drive = Drive::of(&s(16)).and(&s(17)).held_out(&s(18)).at(&[1.0, 20.0]);
    let found = drive.discover("nothing-missing");
    page("nothing-missing", &found);
}

/// An effect that the user knows, then both, the second one as half of what it is; noise that is given.
#[test]
fn effects_of_the_model() {
    let hidden = [Hidden::RotationCreep { e_rc: 0.05 }, Hidden::CorneringCreep { mass_over_bt: 0.1 }];
    let mut drive = Drive::of(&drive(Tractor::Unicycle, &hidden, 19));
    drive.model +=
        "\n[noise]\nposition = 0.002\nheading = 0.002\n\n[[effects]]\nid = \"rotation-creep\"\ne_rc = 0.05\n";
    drive.discover("known-effect");
    drive.model += "\n[[effects]]\nid = \"cornering-creep\"\nmass_over_bT = 0.05\n";
    drive.discover("restated-effect");
    drive.check("restated-effect");
}

/// Too short, standing, a wheel radius in other units, a slope that lets go.
#[test]
fn data_that_cannot_answer() {
    let short = Scenario { duration: 3.0, ..drive(Tractor::Unicycle, &[], 20) };
    Drive::of(&short).discover("too-short");
    Drive::of(&short).check("too-short");
    let standing = with(drive(Tractor::Unicycle, &[], 21), Signal::constant(0.0), Signal::constant(0.0));
    Drive::of(&standing).discover("standing");
    Drive::of(&standing).check("standing");
    let mut centimetres = Drive::of(&drive(Tractor::Car, &[], 22));
    centimetres.model = centimetres.model.replace("wheel_radius = 0.", "wheel_radius = ");
    centimetres.discover("other-units");
    centimetres.check("other-units");
    let straight = with(drive(Tractor::Unicycle, &[], 23), Signal::constant(1.0), Signal::wave(0.1, 7.0, 0.0));
    let mut log = straight.run();
    let (sin, cos) = log.truth[200].heading.sin_cos();
    for row in &mut log.rows {
        let slid = 0.8 * (row[0] - 10.0).clamp(0.0, 4.0);
        row[1] -= slid * sin;
        row[2] += slid * cos;
    }
    let mut sliding = Drive::of(&straight);
    sliding.fitted = vec![log.to_csv(9)];
    sliding.discover("sliding");
}

/// Inputs of another drive; inputs whose clock runs three percent slow against that of the poses in the same file.
#[test]
fn inputs_that_do_not_belong_to_the_poses() {
    let s = Scenario { rate: 100.0, duration: 62.0, ..drive(Tractor::DifferentialDrive, &[], 24) };
    let (log, other) = (
        s.run(),
        Scenario { seed: 25, profile: drive(Tractor::DifferentialDrive, &[], 25).profile, ..s.clone() }.run(),
    );
    let poses = log.columns.len() - 2;
    let joined = |inputs: &dyn Fn(usize) -> Vec<f64>| {
        let row = |k: usize| [&log.rows[10 * k][..poses], &inputs(k)].concat();
        let cells = |k: usize| row(k).iter().map(f64::to_string).collect::<Vec<_>>().join(",");
        let rows: Vec<String> = (0..600).map(cells).collect();
        let mut drive = Drive::of(&drive(Tractor::DifferentialDrive, &[], 24));
        drive.fitted = vec![format!("{}\n{}\n", log.columns.join(","), rows.join("\n"))];
        drive
    };
    joined(&|k| other.rows[10 * k][poses..].to_vec()).discover("other-inputs");
    joined(&|k| log.rows[(10.3 * k as f64) as usize][poses..].to_vec()).discover("two-clocks");
}

/// Runs enough to be compared with each other.
#[test]
fn five_runs() {
    let run = |seed| Scenario {
        duration: 20.0,
        ..drive(
            Tractor::DifferentialDrive,
            &[Hidden::TrackWidth { scale: 0.03 }, Hidden::InputDelay { delay: 0.04 }],
            seed,
        )
    };
    let first = Drive::of(&run(30)).held_out(&run(35));
    let all = (31..35).fold(first, |drive, seed| drive.and(&run(seed)));
    let found = all.discover("five-runs");
    page("five-runs", &found);
    all.check("five-runs");
    // Exactly as many as are compared with each other.
    let four = (37..40).fold(Drive::of(&run(36)), |drive, seed| drive.and(&run(seed)));
    four.check("four-runs");
}

/// A law of turns to one side only; a creep of a steered and driven wheel that grows with its speed: of the body's speed
/// it is one of v² and, as the wheel's way is longer in a turn, one of the yaw rate.
#[test]
fn more_laws_without_a_name() {
    let left = |seed| drive(Tractor::Unicycle, &[Hidden::LeftTurnSlip { q: 0.12 }], seed);
    (42..45).fold(Drive::of(&left(41)), |drive, seed| drive.and(&left(seed))).discover("left-turns");
    let spun = |seed| drive(Tractor::Tricycle, &[Hidden::SpeedRotationCreep { per_speed: 0.04 }], seed);
    Drive::of(&spun(49)).and(&spun(50)).discover("speed-creep");
}

/// Inputs that are means over the intervals; a slope.
#[test]
fn means_over_intervals() {
    let hidden = [Hidden::SideSlope { rate: 0.03, direction: 0.7 }];
    let s = |seed| Scenario {
        timing: Timing::IntervalMean,
        rate: 5.0,
        duration: 60.0,
        ..drive(Tractor::Unicycle, &hidden, seed)
    };
    let drive = Drive::of(&s(51)).held_out(&s(52)).at(&[0.2, 3.0]);
    drive.discover("means");
    drive.check("means");
}

/// A sensor that is turned and sits elsewhere than its user believes; only relatives of it can be told.
#[test]
fn a_sensor_in_the_wrong_place() {
    let hidden = [Hidden::HeadingMisalignment { offset: 0.05 }, Hidden::LeverArm { a: 0.12, b: 0.04 }];
    let s = |seed| drive(Tractor::Tricycle, &hidden, seed);
    let drive = Drive::of(&s(53)).and(&s(54));
    drive.discover("wrong-place");
    drive.check("wrong-place");
}

/// The trailer creeps and is hitched elsewhere; only positions of the tractor have a heading beside them.
#[test]
fn a_trailer_that_creeps() {
    let behind = |hidden: &[Hidden], seed| {
        let vehicle =
            Vehicle::NTrailer { tractor: Tractor::DifferentialDrive, lengths: vec![1.2], hitch_offsets: vec![0.25] };
        drive(vehicle, hidden, seed)
    };
    let creep =
        [Hidden::TrailerTraverseCreep { trailer: 1, e_tc: 0.06 }, Hidden::HitchOffset { trailer: 1, offset: 0.05 }];
    let drive = Drive::of(&behind(&creep, 55)).and(&behind(&creep, 56));
    drive.discover("trailer-creep");
    drive.check("trailer-creep");
}

/// Straight runs and a curved one: what the curved one tells, the straight ones do not contradict.
#[test]
fn drives_that_are_not_alike() {
    let hidden = [Hidden::TrackWidth { scale: 0.04 }];
    let s = |seed, turn| with(drive(Tractor::DifferentialDrive, &hidden, seed), Signal::constant(0.7), turn);
    let straight = |seed| s(seed, Signal::constant(0.0));
    let mixed = Drive::of(&straight(57)).and(&straight(58)).and(&s(59, Signal::wave(0.9, 12.0, 0.2)));
    mixed.discover("not-alike");
    mixed.check("not-alike");
}

/// The page without its style, one element a line, long paths thinned.
#[track_caller]
fn page(name: &str, found: &Discovery) {
    let text = html(&found.report, &found.pictures);
    let (head, rest) = text.split_once("<style>").unwrap();
    let (_, body) = rest.split_once("</style>").unwrap();
    // The script is a file, and the numbers for it are those that are drawn.
    let scripts = body.split("<script").map(|part| part.split_once("</script>").map_or(part, |(_, after)| after));
    let body = scripts.collect::<Vec<_>>().join("<script/>");
    let thinned = |line: &str| match line.split_once(" d=\"") {
        Some((before, after)) if after.matches('L').count() > 20 => {
            let (path, after) = after.split_once('"').unwrap();
            let points: Vec<&str> = path.split('L').collect();
            let kept: Vec<&str> = points.iter().step_by(points.len() / 10).copied().collect();
            format!("{before} d=\"{} of {}\"{after}", kept.join("L"), points.len())
        }
        _ => line.to_string(),
    };
    let lines: Vec<String> = format!("{head}{body}").replace("><", ">\n<").lines().map(thinned).collect();
    reviewed(&format!("page-{name}"), &lines.join("\n"));
}
