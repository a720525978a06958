//! `creepage init`, `creepage check`, completions and manual pages.

use crate::program::creepage;
use crate::simulator::{Hidden, Noise, Profile, Scenario, Signal, Tractor};
use creepage::discrepancy::check::check;
use creepage::discrepancy::estimation::fit::Effort;
use creepage::discrepancy::estimation::problem::Problem;
use creepage::discrepancy::identifiability::{Check, Checked, Seen, Standing};
use creepage::discrepancy::record::run_record::Record;
use creepage::effects::Applied;
use creepage::files::{ModelFile, Run};
use creepage::model::{self, Model};
use creepage::progress::unheard;
use creepage::scaffold::{Starter, Wanted};
use creepage::{effects, vehicles};

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

fn example(path: &str) -> String {
    format!("{}/examples/runs/{path}", env!("CARGO_MANIFEST_DIR"))
}

fn parsed(starter: &Starter) -> ModelFile {
    ModelFile::parse(&starter.text, "model.toml", &model::known(effects::all())).unwrap()
}

#[test]
fn a_file_to_begin_with_is_valid_for_every_vehicle() {
    for vehicle in vehicles::all() {
        let starter = Starter::new(&Wanted { vehicle: vehicle.id.clone(), ..Wanted::default() }).unwrap();
        let file = parsed(&starter);
        Model::from_file(&file, effects::all(), &[]).unwrap();
        // A log still to be written has columns that are called what they hold: none is left for the user to name.
        for input in vehicle.inputs.iter().filter(|(_, q)| q.instead.is_none()).map(|(name, _)| name) {
            assert!(starter.text.contains(&format!("\n{input} = \"{input}\"")), "{}: {input}", vehicle.id);
        }
        for (name, p) in vehicle.parameters.iter() {
            assert_eq!(file.parameters.contains_key(name), !p.optional, "{}: {name}", vehicle.id);
            assert!(starter.text.contains(&p.meaning) && starter.text.contains(&format!("# {}; ", p.unit)), "{name}");
        }
        if vehicle.pulls() {
            let tractor = Some(vehicle.id.clone());
            let train = Wanted { vehicle: "n-trailer".into(), tractor, trailers: Some(2), ..Wanted::default() };
            let file = parsed(&Starter::new(&train).unwrap());
            assert_eq!((file.trailer_lengths.len(), file.tractor.as_deref()), (2, Some(vehicle.id.as_str())));
            Model::check_motion(&file).unwrap();
        }
    }
}

#[test]
fn columns_are_found_whatever_they_are_called() {
    let odd =
        ["Time [s]", "gt_x", "gt_y", "gt \"yaw\"\\", "wheelRateLeft", "wheelRateRight", "acc_x", "odom_x", "\u{7}"];
    let log = Some(("odd.csv".to_string(), odd.map(String::from).to_vec()));
    let starter = Starter::new(&Wanted { vehicle: "differential-drive".into(), log, ..Wanted::default() }).unwrap();
    let columns = parsed(&starter).columns;
    assert_eq!((columns.time.as_str(), columns.x.as_str(), columns.heading.as_deref()), (odd[0], odd[1], Some(odd[3])));
    assert_eq!((starter.missing.len(), columns.inputs[0].column.as_str()), (0, odd[4]));
    let log = Some(("bare.csv".to_string(), vec!["a".to_string(), "b".to_string()]));
    let starter = Starter::new(&Wanted { vehicle: "car".into(), log, ..Wanted::default() }).unwrap();
    parsed(&starter);
    assert_eq!(starter.missing, ["time", "x", "y", "steering_angle", "wheel_rate"]);
    let file = |name: &str, columns: &[&str]| Some((name.to_string(), columns.iter().map(|c| c.to_string()).collect()));
    let starter = Starter::new(&Wanted {
        vehicle: "unicycle".into(),
        log: file("in.csv", &["Time", "speed", "gyro_z"]),
        truth: file("pose.csv", &["stamp", "px", "py", "theta"]),
        ..Wanted::default()
    });
    let starter = starter.unwrap();
    let columns = parsed(&starter).columns;
    assert_eq!((columns.time.as_str(), columns.truth_time.as_deref()), ("Time", Some("stamp")));
    assert_eq!((columns.y.as_str(), columns.heading.as_deref(), starter.missing.len()), ("py", Some("theta"), 0));
}

/// What stands for a role makes up for it, and nothing else does.
#[test]
fn what_is_missing_is_what_no_column_makes_up_for() {
    let starter = |vehicle: &str, columns: &[&str]| {
        let log = Some(("log.csv".to_string(), columns.iter().map(|c| c.to_string()).collect()));
        Starter::new(&Wanted { vehicle: vehicle.into(), log, ..Wanted::default() }).unwrap()
    };
    assert_eq!(starter("car", &["time", "x", "y", "steer"]).missing, ["wheel_rate"]);
    assert_eq!(starter("unicycle", &["time", "x", "v", "gyro_z"]).missing, ["y"]);
    assert_eq!(starter("unicycle", &["time", "x", "y", "gyro_z"]).missing, ["wheel_rate"]);
    assert!(starter("unicycle", &["time", "x", "y", "wheel_rate", "gyro_z"]).missing.is_empty());
    assert!(starter("car", &["time", "x", "y", "steer", "wheel_rate"]).missing.is_empty());
    assert_eq!(starter("car", &["time", "x", "y", "v"]).missing, ["steering_angle"]);
    assert_eq!(starter("differential-drive", &["time", "x", "y", "left"]).missing, ["wheel_rate_right"]);
    assert_eq!(starter("unicycle", &["time", "x", "y", "v"]).missing, ["yaw_rate"]);
    // A header of any length is shown up to a point.
    let wide = |n: usize| (0..n).map(|i| format!("c{i}")).collect::<Vec<_>>();
    let text = |n: usize| starter("car", &wide(n).iter().map(String::as_str).collect::<Vec<_>>()).text;
    assert!(text(40).contains("c38, c39\n") && !text(40).contains("in all"));
    assert!(text(41).contains("c38, c39, … (41 in all)\n") && text(50).contains("c39, … (50 in all)\n"));
}

#[test]
fn a_file_to_begin_with_has_trailers_up_to_a_bound() {
    let train = |n| Starter::new(&Wanted { vehicle: "n-trailer".into(), trailers: Some(n), ..Wanted::default() });
    assert_eq!(parsed(&train(100).unwrap()).trailer_lengths.len(), 100);
    for n in [101, 1000] {
        assert!(train(n).unwrap_err().to_string().contains("too many to begin with"));
    }
    let none = train(0).unwrap();
    assert!(none.text.contains("trailer_lengths = []") || !none.text.contains("trailer_lengths"), "{}", none.text);
}

/// Values speak beside names: a column that never changes is no heading, stamps and angles tell their units.
#[test]
fn init_looks_at_values() {
    let begun = |vehicle: &str, header: &str, row: &dyn Fn(i64) -> String| {
        let rows = (0..100).map(|i| row(i).split(',').map(str::to_string).collect()).collect();
        let log = Some(("log.csv".to_string(), header.split(',').map(str::to_string).collect()));
        let starter = Starter::new(&Wanted { vehicle: vehicle.into(), log, rows, ..Wanted::default() }).unwrap();
        parsed(&starter);
        starter
    };
    let found = |starter: &Starter, role: &str| starter.found.iter().find(|(r, _)| r == role).map(|(_, c)| c.clone());
    let one = |text: &str| Some(text.to_string());
    let starter = begun("unicycle", "stamp,x,y,yaw,theta,v,gyro_z", &|i| {
        format!(
            "{},{i},0,0.0,{},1,0",
            1_700_000_000_000_000_000 + 20_000_000 * i,
            (i as f64 * 7.0 + 180.0) % 360.0 - 180.0
        )
    });
    assert_eq!(found(&starter, "time"), one("{ column = \"stamp\", unit = \"ns\" }"));
    assert_eq!(found(&starter, "heading"), one("{ column = \"theta\", unit = \"deg\" }"), "yaw never changes");
    let starter = begun("differential-drive", "t,x,y,left,right", &|i| format!("{i},{i},0,{},{}", 30 * i, 31 * i));
    assert_eq!(found(&starter, "wheel_rate_left"), one("{ ticks = \"left\", ticks_per_turn = 1000 }"), "counts");
    assert!(starter.placeholders.contains(&"ticks_per_turn".to_string()));
    let starter = begun("differential-drive", "time,x,y,left_wheel_position,right_wheel_position", &|i| {
        format!("{i},{i},0,{},{}", 0.3 * i as f64, 0.31 * i as f64)
    });
    assert_eq!(found(&starter, "wheel_rate_right"), one("{ angle = \"right_wheel_position\" }"));
    let starter = begun("differential-drive", "time,x_mm,y_mm,left_rpm,right_rpm", &|i| format!("{i},{i},0,60,61"));
    assert_eq!(found(&starter, "x"), one("{ column = \"x_mm\", unit = \"mm\" }"));
    assert_eq!(found(&starter, "wheel_rate_left"), one("{ column = \"left_rpm\", unit = \"rpm\" }"));
    let starter = begun("unicycle", "q.x,q.y,q.z,q.w,sec,nanosec,lat,lon", &|i| format!("0,0,0,1,{i},0,52.1,13.4"));
    assert_eq!(found(&starter, "heading"), one("{ quaternion = \"q\" }"));
    assert_eq!(found(&starter, "time"), one("[\"sec\", \"nanosec\"]"));
    assert_eq!(found(&starter, "position"), one("{ latitude = \"lat\", longitude = \"lon\" }"));
    assert_eq!(starter.missing, ["wheel_rate", "yaw_rate"]);
}

/// What is missing is told at once, and a robot's description gives its lengths.
#[test]
fn init_says_what_is_not_complete_and_reads_a_description() {
    let folder = tempfile::tempdir().unwrap();
    let wheel = |side: &str, y: f64| {
        format!(
            "<link name='{side}_wheel'><visual><geometry><cylinder radius='0.033' length='0.02'/></geometry></visual></link>\
             <joint name='{side}' type='continuous'><parent link='base'/><child link='{side}_wheel'/><origin xyz='0 {y} 0'/></joint>"
        )
    };
    let robot = format!("<robot><link name='base'/>{}{}</robot>", wheel("left", 0.08), wheel("right", -0.08));
    std::fs::write(folder.path().join("robot.urdf"), robot).unwrap();
    std::fs::write(folder.path().join("log.csv"), "0,1,2\n1,2,3\n").unwrap();
    let output = creepage(folder.path(), &["init", "differential-drive", "--from", "log.csv", "--urdf", "robot.urdf"]);
    let said = text(&output.stdout);
    assert!(
        said.contains("model.toml is written; not complete: name time, x, y, wheel_rate_left, wheel_rate_right."),
        "{said}"
    );
    assert!(!said.contains("put your values"), "{said}");
    let model = std::fs::read_to_string(folder.path().join("model.toml")).unwrap();
    assert!(model.contains("wheel_radius = 0.033") && model.contains("track_width = 0.16"), "{model}");
    std::fs::write(folder.path().join("robot.urdf"), "<robot><link name='${side}'/></robot>").unwrap();
    let output = creepage(folder.path(), &["init", "differential-drive", "--urdf", "robot.urdf", "--force"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(text(&output.stderr).contains("robot.urdf: has no wheel"), "{}", text(&output.stderr));
}

#[test]
fn init_writes_once_and_reads_its_log() {
    let folder = tempfile::tempdir().unwrap();
    let run = example("cornering/eights.csv");
    let output = creepage(folder.path(), &["init", "unicycle", "--from", &run]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    assert!(text(&output.stdout).contains("next: creepage check"));
    let path = folder.path().join("model.toml");
    let file = ModelFile::read(&path, &model::known(effects::all())).unwrap();
    assert_eq!(Run::read(&run, &file).unwrap().roles, ["wheel_rate", "yaw_rate"]);
    std::fs::write(&path, "mine").unwrap();
    let again = creepage(folder.path(), &["init", "car"]);
    assert_eq!((again.status.code(), std::fs::read_to_string(&path).unwrap().as_str()), (Some(2), "mine"));
    assert!(text(&again.stderr).contains("--force"), "{}", text(&again.stderr));
    assert!(creepage(folder.path(), &["init", "car", "--force"]).status.success());
    assert!(std::fs::read_to_string(&path).unwrap().contains("vehicle = \"car\""));
    for (arguments, says) in [
        (&["init", "unicyle", "--out", "a.toml"][..], "did you mean \"unicycle\"?"),
        (&["init", "diff-drive", "--out", "a.toml"], "did you mean \"differential-drive\"?"),
        (&["init", "car", "--trailers", "2", "--out", "a.toml"], "creepage init n-trailer --tractor car"),
        (&["init", "n-trailer", "--tractor", "disk", "--out", "a.toml"], "unknown tractor \"disk\""),
        (&["init", "car", "--from", "nowhere.csv", "--out", "a.toml"], "no such file"),
    ] {
        let output = creepage(folder.path(), arguments);
        let errors = text(&output.stderr);
        assert!(output.status.code() == Some(2) && errors.contains(says), "{arguments:?}: {errors}");
        assert!(!folder.path().join("a.toml").exists());
    }
}

#[test]
fn init_begins_a_file_for_a_vehicle_of_ones_own() {
    let folder = tempfile::tempdir().unwrap();
    let bus = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/bus/bus.toml");
    std::fs::copy(bus, folder.path().join("mine.toml")).unwrap();
    std::fs::create_dir(folder.path().join("deep")).unwrap();
    for (out, named) in [("bus.toml", "vehicles = \"mine.toml\""), ("deep/bus.toml", "/mine.toml\"")] {
        let output =
            creepage(folder.path(), &["init", "articulated-bus", "--vehicles", "mine.toml", "--out", out, "--quiet"]);
        assert!(output.status.success(), "{}", text(&output.stderr));
        let written = std::fs::read_to_string(folder.path().join(out)).unwrap();
        assert!(written.contains(named) && written.contains("rear_length = 1.0"), "{written}");
        assert!(written.contains("# trailer_headings = [\"phi_1\"]"), "{written}");
        // It is found again without --vehicles.
        let output = creepage(folder.path(), &["describe", out]);
        assert!(text(&output.stdout).starts_with("# articulated-bus"), "{}", text(&output.stderr));
    }
    let output = creepage(folder.path(), &["init", "car", "--vehicles", "mine.toml", "--out", "car.toml", "--quiet"]);
    assert!(
        output.status.success() && !std::fs::read_to_string(folder.path().join("car.toml")).unwrap().contains("mine")
    );
}

#[test]
fn what_knows_no_forces_refuses_them() {
    let folder = tempfile::tempdir().unwrap();
    let model = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/dynamics/car.toml");
    for (command, more) in [
        ("plan", &["--goal", "1,0,0", "--out", "plan.csv"][..]),
        ("track", &["--goal", "1,0,0", "--out", "drives"]),
        ("export", &["--as", "python", "--out", "model.py"]),
    ] {
        let output = creepage(folder.path(), &[&[command, model][..], more].concat());
        let said = text(&output.stderr);
        assert!(output.status.code() == Some(2) && said.contains(":6:1: "), "{said}");
        assert!(said.contains(&format!("{command} knows no forces: [dynamics]")), "{said}");
    }
}

#[test]
fn a_horizon_that_no_run_is_long_enough_for_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let runs = example("nothing/eights.csv");
    let model = example("nothing/model.toml");
    let output = creepage(folder.path(), &["discover", &runs, "--model", &model, "--horizon", "1", "--horizon", "500"]);
    let said = text(&output.stdout);
    assert!(said.contains("data: 1 run, ") && said.contains("the runs are too short for a gap after 500 s"), "{said}");
    assert!(!said.contains("gap after 1 s"), "{said}");
}

#[test]
fn a_wrong_column_name_suggests_the_near_one() {
    let folder = tempfile::tempdir().unwrap();
    let model = std::fs::read_to_string(example("cornering/model.toml")).unwrap();
    std::fs::write(folder.path().join("model.toml"), model.replace("\"theta_dot\"", "\"theta_dt\"")).unwrap();
    let output = creepage(folder.path(), &["check", &example("cornering/eights.csv"), "--model", "model.toml"]);
    let errors = text(&output.stderr);
    assert!(output.status.code() == Some(2) && errors.contains("did you mean \"theta_dot\"?"), "{errors}");
}

/// One drive, read with its model file.
fn driven(scenario: &Scenario) -> (ModelFile, Run) {
    let file = ModelFile::parse(&scenario.model_toml(), "model.toml", &model::known(effects::all())).unwrap();
    let run = Run::parse("run.csv", &scenario.run().to_csv(12), &file).unwrap();
    (file, run)
}

fn checked(file: &ModelFile, runs: &[Run]) -> Check {
    check(&Checked { file, runs, library: effects::all() }, &unheard).unwrap()
}

fn drive(seed: u64) -> Scenario {
    Scenario { duration: 30.0, noise: Noise::MOCAP, ..Scenario::new(Tractor::Unicycle, seed) }
}

/// What is announced is what fits scatter by: one drive, logged with noise again and again.
#[test]
fn announced_deviations_are_those_of_fits() {
    const TIMES: u64 = 24;
    let (file, first) = driven(&drive(5));
    let announced = checked(&file, std::slice::from_ref(&first));
    let effort = Effort { passes: 15, ..Effort::FULL };
    for (id, name) in
        [("rotation-creep", "e_rc"), ("yaw-rate-bias", "bias"), ("input-delay", "delay"), ("lever-arm", "a")]
    {
        let effect = effects::named(id).unwrap();
        let std = announced.effects.iter().find(|e| e.id == id).unwrap().parameters[name].std.unwrap();
        let at = effect.parameters.keys().position(|k| k == name).unwrap();
        let values: Vec<f64> = (0..TIMES)
            .map(|i| {
                let (file, run) =
                    driven(&Scenario { seed: 100 + i, profile: drive(5).profile, start: drive(5).start, ..drive(5) });
                let neutral = vec![0.0; effect.parameters.len()];
                let model = Model::from_file(&file, effects::all(), &run.roles).unwrap();
                let model = model.with_effect(Applied::new(effect, None, neutral).freed());
                let problem = Problem::new(vec![Record::of_run(&run, file.input_timing, 0)], None, None);
                let starts = problem.starts(&model).unwrap();
                problem.fit(&model, &starts, &problem.variances, effort).unwrap().unwrap().p[at]
            })
            .collect();
        // χ² with 24 degrees of freedom lies within 6.4 and 55 but once in 5000 times: a factor of 2 in the deviation
        // would give 6 or 96.
        let sum: f64 = values.iter().map(|v| (v / std).powi(2)).sum();
        assert!((8.0..55.0).contains(&sum), "{id}: {sum}, announced {std}");
    }
}

/// An effect as large as the smallest that is said to be seen is named, one of a tenth of it is not.
#[test]
fn what_is_said_to_be_seen_is_seen() {
    use creepage::discrepancy::selection::select::choose;
    let (file, first) = driven(&drive(5));
    let announced = checked(&file, std::slice::from_ref(&first));
    let smallest =
        announced.effects.iter().find(|e| e.id == "rotation-creep").unwrap().parameters["e_rc"].smallest_seen;
    let names = |e_rc: f64, seed: u64| -> usize {
        let hidden = vec![Hidden::RotationCreep { e_rc }];
        let (file, run) = driven(&Scenario { hidden, seed, ..drive(5) });
        let model = Model::from_file(&file, effects::all(), &run.roles).unwrap();
        let problem = Problem::new(vec![Record::of_run(&run, file.input_timing, 0)], None, None);
        choose(&problem, &model, effects::all(), &unheard).unwrap().unwrap().chosen.len()
    };
    let smallest = smallest.unwrap();
    let large: usize = (0..4).map(|i| names(smallest, 200 + i).min(1)).sum();
    let small: usize = (0..4).map(|i| names(0.1 * smallest, 300 + i).min(1)).sum();
    assert_eq!((large, small), (4, 0), "smallest seen: {smallest}");
}

/// Straight ahead at one speed: what acts in turns is missed, and the advice turns.
#[test]
fn a_dull_drive_is_found_dull_and_advice_mends_it() {
    let profile = Profile { speed: Signal::constant(1.0), turn: Signal::constant(0.0) };
    let (file, run) = driven(&Scenario { profile, ..drive(9) });
    let found = checked(&file, std::slice::from_ref(&run));
    let seen = |id: &str| found.effects.iter().find(|e| e.id == id).unwrap().seen;
    assert_eq!(
        (seen("cornering-creep"), seen("yaw-rate-scale"), seen("rotation-creep")),
        (Seen::No, Seen::No, Seen::Yes)
    );
    assert_eq!(found.verdict, Standing::NotIdentifiable, "{}", found.summary);
    let findings: Vec<&str> = found.data.findings.iter().map(|f| f.id.as_str()).collect();
    assert!(findings.contains(&"no-turns") && findings.contains(&"one-speed"), "{findings:?}");
    let pair = |a: &str, b: &str| {
        found.not_separated.iter().find(|p| p.effects.contains(&a.into()) && p.effects.contains(&b.into()))
    };
    assert_eq!(pair("rotation-creep", "wheel-radius").unwrap().why, "identical");
    let advice = found.next_experiment.as_ref().unwrap();
    assert!(advice.manoeuvre.contains("left") && advice.why.contains("show"), "{advice:?}");
    // Driven as advised, or about so, it shows.
    let (_, lively) = driven(&drive(10));
    let better = checked(&file, &[run, lively]);
    assert!(better.effects.iter().all(|e| e.seen != Seen::No), "{}", better.summary);
    assert_eq!(better.verdict, Standing::Identifiable);
}

#[test]
fn slips_of_units_and_sides_are_noticed() {
    let (file, run) = driven(&drive(12));
    let findings =
        |run: Run| -> Vec<String> { checked(&file, &[run]).data.findings.into_iter().map(|f| f.says).collect() };
    assert_eq!(findings(run.clone()), Vec::<String>::new());
    let scaled = |column: &[f64], by: f64| column.iter().map(|v| v * by).collect::<Vec<f64>>();
    let millimetres = Run { x: scaled(&run.x, 1e3), y: scaled(&run.y, 1e3), ..run.clone() };
    assert!(findings(millimetres).iter().any(|s| s.contains("millimetres")));
    let heading = run.heading.as_ref().map(|h| scaled(h, 180.0 / std::f64::consts::PI));
    assert!(findings(Run { heading, ..run.clone() }).iter().any(|s| s.contains("degrees")));
    let yaw = run.roles.iter().position(|r| r == "yaw_rate").unwrap();
    let mut swapped = run.clone();
    swapped.inputs[yaw] = scaled(&run.inputs[yaw], -1.0);
    assert!(findings(swapped).iter().any(|s| s.contains("wrong sign")));
    let mut gap = run.clone();
    let keep = |column: &mut Vec<f64>| drop(column.drain(200..300));
    keep(&mut gap.time);
    keep(&mut gap.x);
    keep(&mut gap.y);
    gap.heading.iter_mut().for_each(keep);
    gap.inputs.iter_mut().for_each(keep);
    assert!(findings(gap).iter().any(|s| s.contains("interrupted 1 times")));
}

#[test]
fn check_answers_scripts_and_people() {
    let folder = tempfile::tempdir().unwrap();
    let (run, model) = (example("nothing/eights.csv"), example("nothing/model.toml"));
    let json = creepage(folder.path(), &["check", &run, "--model", &model, "--format", "json", "--quiet"]);
    assert!(json.status.success(), "{}", text(&json.stderr));
    let found: Check = serde_json::from_slice(&json.stdout).unwrap();
    assert_eq!((found.schema, found.verdict), (1, Standing::Identifiable), "{}", found.summary);
    let driven = &found.data.runs[0];
    assert!(driven.left > 0.2 && driven.right > 0.2 && driven.left + driven.right <= 1.0, "{driven:?}");
    let rate = (driven.rows - 1) as f64 / driven.duration_s;
    assert!((driven.rate_hz - rate).abs() < 0.01 * rate && driven.longest_gap_s < 1.5 / rate, "{driven:?}");
    assert!(driven.standing == 0.0 && driven.backwards == 0.0 && (driven.way_ratio.unwrap() - 1.0).abs() < 0.01);
    assert!(found.effects.iter().all(|e| e.seen == Seen::Yes && e.parameters.values().any(|p| p.std.is_some())));
    let people = creepage(folder.path(), &["check", &run, "--model", &model]);
    let page = text(&people.stdout);
    assert!(page.starts_with("Identifiable: ") && page.contains("rotation-creep and wheel-radius"), "{page}");
    assert!(
        page.lines().filter(|l| l.starts_with("  ") && !l.contains("note:")).all(|l| l.chars().count() <= 110),
        "{page}"
    );
    let one = creepage(folder.path(), &["check", &run, "--model", &model, "--threads", "1"]);
    assert_eq!(page, text(&one.stdout), "the same for every number of threads");
    let short = std::fs::read_to_string(&run).unwrap().lines().take(60).collect::<Vec<_>>().join("\n");
    std::fs::write(folder.path().join("short.csv"), short).unwrap();
    let output = creepage(folder.path(), &["check", "short.csv", "--model", &model]);
    assert!(
        output.status.success() && text(&output.stdout).starts_with("Not identifiable: "),
        "{}",
        text(&output.stdout)
    );
}

#[test]
fn completions_and_manual_pages_know_every_command() {
    let folder = tempfile::tempdir().unwrap();
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let output = creepage(folder.path(), &["completions", shell]);
        let script = text(&output.stdout);
        assert!(output.status.success() && ["discover", "check", "init"].iter().all(|c| script.contains(c)), "{shell}");
    }
    assert_eq!(creepage(folder.path(), &["completions", "cmd"]).status.code(), Some(2));
    let page = text(&creepage(folder.path(), &["man"]).stdout);
    assert!(page.contains(".TH creepage 1") && page.contains("discover"), "{page}");
    assert!(creepage(folder.path(), &["man", "--out", "man1"]).status.success());
    let page = std::fs::read_to_string(folder.path().join("man1/creepage-discover.1")).unwrap();
    assert!(page.contains("held\\-out") && page.contains("creepage discover INPUTS.csv"), "{page}");
}

#[test]
fn effects_are_told_by_their_ids() {
    let folder = tempfile::tempdir().unwrap();
    let told = |ids: &[&str]| creepage(folder.path(), &[&["effects"], ids].concat());
    let two = text(&told(&["track-width", "input-delay"]).stdout);
    let headings: Vec<&str> = two.lines().filter_map(|line| line.strip_prefix("## ")).collect();
    assert_eq!(headings, ["track-width", "input-delay"]);
    let json = told(&["input-delay", "--format", "json"]);
    let json: serde_json::Value = serde_json::from_slice(&json.stdout).unwrap();
    assert_eq!(json["effects"].as_array().unwrap().len(), 1);
    let unknown = told(&["input-dealy"]);
    assert_eq!(unknown.status.code(), Some(2));
    assert!(text(&unknown.stderr).contains("no effect is called \"input-dealy\""));
}

#[test]
fn effects_of_a_vehicle_are_there_for_scripts() {
    let folder = tempfile::tempdir().unwrap();
    let output = creepage(folder.path(), &["effects", "--vehicle", "car", "--format", "json"]);
    let found: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let offset = found["effects"].as_array().unwrap().iter().find(|e| e["id"] == "rotation-creep").unwrap();
    assert!(offset["relatives"][0].as_str().unwrap().contains("identical to wheel-radius"), "{offset}");
    assert!(offset["equations"][0].as_str().unwrap().contains("e_rc"), "{offset}");
}
