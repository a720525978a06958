//! `creepage fleet map` and `creepage fleet join`: what robots share, which differ, and rows that are kept.

use crate::program::{creepage, stderr};
use crate::simulator::{Hidden, Noise, Profile, Scenario, Signal, Timing, Tractor};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::StandardNormal;
use serde_json::Value;
use std::collections::BTreeMap;
use std::f64::consts::{FRAC_PI_2, TAU};
use std::fs;
use std::path::Path;

fn bundled() -> String {
    format!("{}/examples/fleet/fleet.csv", env!("CARGO_MANIFEST_DIR"))
}

fn done(folder: &Path, arguments: &[&str]) {
    let output = creepage(folder, arguments);
    assert_eq!(output.status.code(), Some(0), "{arguments:?}: {}", stderr(&output));
}

fn report(folder: &Path) -> Value {
    serde_json::from_str(&fs::read_to_string(folder.join("fleet.json")).unwrap()).unwrap()
}

/// Every file below a folder.
fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut found = BTreeMap::new();
    for entry in fs::read_dir(folder).unwrap().map(Result::unwrap) {
        let name = entry.file_name().into_string().unwrap();
        match entry.path().is_dir() {
            true => found.extend(files(&entry.path()).into_iter().map(|(n, b)| (format!("{name}/{n}"), b))),
            false => drop(found.insert(name, fs::read(entry.path()).unwrap())),
        }
    }
    found
}

fn names<'v>(list: &'v Value, key: &str) -> Vec<&'v str> {
    list.as_array().unwrap().iter().map(|v| v[key].as_str().unwrap()).collect()
}

#[test]
fn the_bundled_fleet_has_one_worn_tyre_and_every_robot_gets_its_model() {
    let dir = tempfile::tempdir().unwrap();
    done(dir.path(), &["fleet", "map", &bundled(), "--out", "rows"]);
    done(dir.path(), &["fleet", "join", "rows", "--out", "fleet"]);
    let found = report(&dir.path().join("fleet"));
    assert_eq!(names(&found["effects"], "effect"), ["track-width", "wheel-radius-mismatch"]);
    assert_eq!(names(&found["odd_robots"], "robot"), ["robot03"]);
    assert_eq!(found["odd_robots"][0]["effect"], "wheel-radius-mismatch");
    assert!((found["odd_robots"][0]["value"].as_f64().unwrap() - 0.045).abs() < 1e-4);
    for none in ["odd_runs", "own_effects", "warnings"] {
        assert_eq!(found[none].as_array().unwrap().len(), 0, "{none}");
    }
    let mean = &found["effects"][0]["parameters"]["scale"];
    let [low, high] = [0, 1].map(|i| mean["mean"]["interval"][i].as_f64().unwrap());
    assert!(low < 0.03 && 0.03 < high && high - low < 0.02, "{mean}");
    let worn = &found["per_robot"][2];
    assert!(worn["mend"][1].as_str().unwrap().starts_with("left_wheel_radius_multiplier: 1.0449"), "{worn}");
    // Its model drives, and what it is told to mend stands in the file for its controller.
    let robots = dir.path().join("fleet/robots");
    let yaml = fs::read_to_string(robots.join("robot03.yaml")).unwrap();
    assert!(yaml.contains(worn["mend"][1].as_str().unwrap()));
    let log = bundled().replace("fleet.csv", "robot03-1.csv");
    done(&robots, &["simulate", "robot03.toml", "--inputs", &log, "--out", "path.csv"]);
    let page = fs::read_to_string(dir.path().join("fleet/fleet.html")).unwrap();
    assert!(page.contains("robot03 differs from the others") && page.matches("<svg").count() == 2);
    let table = fs::read_to_string(dir.path().join("fleet/fleet.csv")).unwrap();
    assert_eq!(table.lines().count(), 1 + 8 * 2);
}

#[test]
fn shards_threads_and_interruptions_give_the_same_bytes() {
    let dir = tempfile::tempdir().unwrap();
    done(dir.path(), &["fleet", "map", &bundled(), "--out", "rows"]);
    done(dir.path(), &["fleet", "join", "rows", "--out", "fleet"]);
    for shard in ["3/3", "1/3", "2/3"] {
        done(dir.path(), &["fleet", "map", &bundled(), "--out", "parts", "--shard", shard, "--threads", "1"]);
    }
    done(dir.path(), &["fleet", "join", "parts", "--out", "joined", "--threads", "1"]);
    assert!(files(&dir.path().join("rows")) == files(&dir.path().join("parts")));
    assert!(files(&dir.path().join("fleet")) == files(&dir.path().join("joined")));
    // A row that is lost, one that is cut short, and one of other data are made anew; all others are kept.
    let row = |robot: &str| dir.path().join(format!("parts/discovered/{robot}.json"));
    fs::remove_file(row("robot02")).unwrap();
    fs::write(row("robot04"), "{\"identity\": \"").unwrap();
    let text = fs::read_to_string(row("robot05")).unwrap();
    fs::write(row("robot05"), text.replacen("\"identity\": \"", "\"identity\": \"0", 1)).unwrap();
    let output = creepage(dir.path(), &["fleet", "map", &bundled(), "--out", "parts"]);
    assert!(String::from_utf8_lossy(&output.stdout).starts_with("rows of 8 robots, 5 of them from an earlier map"));
    assert!(files(&dir.path().join("rows")) == files(&dir.path().join("parts")));
}

#[test]
fn a_robot_without_usable_files_fails_alone_and_a_fleet_without_it_is_joined_on_demand() {
    let dir = tempfile::tempdir().unwrap();
    let folder = bundled().replace("/fleet.csv", "");
    let line = |robot: &str, log: &str| format!("{robot},{folder}/{log},{folder}/model.toml\n");
    let mut manifest = String::from("robot,log,model\n");
    (1..=4).for_each(|i| manifest += &line(&format!("r{i}"), &format!("robot0{i}-1.csv")));
    fs::write(dir.path().join("fleet.csv"), manifest + &line("lost", "none.csv")).unwrap();
    let output = creepage(dir.path(), &["fleet", "map", "fleet.csv", "--out", "rows"]);
    assert_eq!(output.status.code(), Some(2));
    let says = stderr(&output);
    assert!(says.contains("robot lost") && says.contains("none.csv"), "{says}");
    assert_eq!(files(&dir.path().join("rows/discovered")).len(), 4);
    let output = creepage(dir.path(), &["fleet", "join", "rows", "--out", "fleet"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("1 of 5 robots have no row: lost") && !dir.path().join("fleet").exists());
    done(dir.path(), &["fleet", "join", "rows", "--out", "fleet", "--incomplete"]);
    assert!(report(&dir.path().join("fleet"))["warnings"][0].as_str().unwrap().contains("lost"));
    for (arguments, says) in [
        (vec!["fleet", "join", "."], "holds no rows of a fleet"),
        (vec!["fleet", "map", "none.csv", "--out", "rows"], "none.csv"),
        (vec!["fleet", "map", "fleet.csv", "--out", "rows", "--shard", "4/3"], "I/N"),
    ] {
        let output = creepage(dir.path(), &arguments);
        assert!(output.status.code() == Some(2) && stderr(&output).contains(says), "{}", stderr(&output));
    }
}

/// A robot of a fleet on a day, on a floor.
fn drive(seed: u64, hidden: Vec<Hidden>) -> Scenario {
    let phase = seed as f64;
    let period = 9.0 + 3.0 * phase.sin();
    let mut drive = Scenario {
        hidden,
        timing: Timing::IntervalMean,
        noise: Noise::MOCAP,
        duration: 30.0,
        rate: 10.0,
        profile: Profile {
            speed: Signal::constant(0.5) + Signal::wave(0.15, 17.0, phase),
            turn: Signal::constant(0.1) + Signal::wave(1.7 * TAU / period, period, FRAC_PI_2 + phase),
        },
        ..Scenario::new(Tractor::DifferentialDrive, seed)
    };
    drive.parameters.wheel_radius = 0.06;
    drive.parameters.track_width = 0.32;
    drive
}

/// Twelve robots of three runs: a track that is 1 % wider on carpet, a left wheel that wears by 0.02 % a day, one robot whose
/// marker is off its place, and one run with half a turn of its own.
#[test]
fn floors_wear_an_effect_of_one_robot_and_an_odd_run_are_told_apart() {
    let dir = tempfile::tempdir().unwrap();
    let mut manifest = String::from("robot,run,date,log,model,floor\n");
    for robot in 0..12_u64 {
        let own = [0.004, 0.003].map(|size| size * (1.7 * robot as f64 + 0.4 / size).sin());
        for run in 0..3_u64 {
            let (carpet, day) = ((robot + run) % 2 == 1, 10 * run + robot % 5);
            let odd = if (robot, run) == (7, 1) { 0.03 } else { 0.0 };
            let track = 0.03 + own[0] + if carpet { 0.01 } else { 0.0 } + odd;
            let mismatch = own[1] + 2e-4 * day as f64;
            let mut hidden = vec![Hidden::TrackWidth { scale: track }, Hidden::WheelRadiusMismatch { scale: mismatch }];
            if robot == 4 {
                hidden.push(Hidden::LeverArm { a: 0.08, b: 0.03 });
            }
            let scenario = drive(1000 + 10 * robot + run, hidden);
            let log = format!("r{robot}-{run}.csv");
            scenario.run().write_csv(dir.path().join(&log)).unwrap();
            let floor = if carpet { "carpet" } else { "tile" };
            manifest += &format!("r{robot:02},{run},2026-10-{:02},{log},model.toml,{floor}\n", 1 + day);
            fs::write(dir.path().join("model.toml"), scenario.model_toml()).unwrap();
        }
    }
    fs::write(dir.path().join("fleet.csv"), manifest).unwrap();
    done(dir.path(), &["fleet", "map", "fleet.csv", "--out", "rows"]);
    done(dir.path(), &["fleet", "join", "rows", "--out", "fleet"]);
    let found = report(&dir.path().join("fleet"));
    let mut effects = names(&found["effects"], "effect");
    effects.sort_unstable();
    assert_eq!(effects, ["track-width", "wheel-radius-mismatch"], "{found:#}");
    assert_eq!(
        (names(&found["own_effects"], "robot"), names(&found["own_effects"], "effect")),
        (vec!["r04"], vec!["lever-arm"])
    );
    assert_eq!((names(&found["odd_runs"], "robot"), names(&found["odd_runs"], "run")), (vec!["r07"], vec!["1"]));
    assert_eq!(names(&found["odd_robots"], "robot"), Vec::<&str>::new());
    let of = |effect: &str| {
        let all = found["effects"].as_array().unwrap();
        all.iter().find(|e| e["effect"] == effect).unwrap()["parameters"]["scale"]["tags"].as_array().unwrap().clone()
    };
    let near = |tag: &Value, truth: f64| {
        let [value, std] = ["value", "std"].map(|key| tag[key].as_f64().unwrap());
        assert!((value - truth).abs() < 4.0 * std && std < 0.2 * truth.abs(), "{tag}");
    };
    let (track, mismatch) = (of("track-width"), of("wheel-radius-mismatch"));
    assert_eq!((track.len(), mismatch.len()), (1, 1), "{track:?} {mismatch:?}");
    assert_eq!(track[0]["tag"], "floor");
    near(&track[0], if track[0]["level"] == "carpet" { 0.01 } else { -0.01 });
    assert_eq!(mismatch[0]["tag"], "date");
    near(&mismatch[0], 2e-4);
    let own = fs::read_to_string(dir.path().join("fleet/robots/r04.toml")).unwrap();
    assert!(own.contains("lever-arm"));
    // Every run over its date, the robot with the odd run among them; links lead to files.
    for robot in found["per_robot"].as_array().unwrap() {
        let runs = robot["over_time"]["track-width scale"].as_array().unwrap();
        let dates: Vec<&str> = runs.iter().map(|r| r["date"].as_str().unwrap()).collect();
        assert!(runs.len() == 3 && dates.is_sorted(), "{dates:?}");
        let odd = runs.iter().filter(|r| r["is_odd"] == true).count();
        assert_eq!(odd, usize::from(robot["robot"] == "r07"));
    }
    let page = fs::read_to_string(dir.path().join("fleet/fleet.html")).unwrap();
    assert_eq!(page.matches("id=\"over-time-track-width-scale-").count(), 2 * 12, "a title and a description each");
    let links: Vec<&str> = page.split("href=\"robots/").skip(1).map(|l| l.split('"').next().unwrap()).collect();
    assert_eq!(links.len(), 24);
    assert!(links.iter().all(|l| dir.path().join("fleet/robots").join(l).exists()), "{links:?}");
}

/// The table as Parquet has the rows and the numbers of the table as CSV.
#[cfg(feature = "parquet")]
#[test]
fn parquet_holds_what_the_table_holds() {
    use parquet::file::reader::{FileReader, SerializedFileReader};
    use parquet::record::Field;
    let dir = tempfile::tempdir().unwrap();
    done(dir.path(), &["fleet", "map", &bundled(), "--out", "rows"]);
    done(dir.path(), &["fleet", "join", "rows", "--out", "fleet"]);
    let table = fs::read_to_string(dir.path().join("fleet/fleet.csv")).unwrap();
    let file = fs::File::open(dir.path().join("fleet/fleet.parquet")).unwrap();
    let reader = SerializedFileReader::new(file).unwrap();
    let cell = |field: &Field| match field {
        Field::Str(words) => words.clone(),
        Field::Double(v) => format!("{v:?}"),
        Field::Null => String::new(),
        other => panic!("{other:?}"),
    };
    let rows = reader.get_row_iter(None).unwrap().map(Result::unwrap);
    let rows: Vec<String> =
        rows.map(|row| row.get_column_iter().map(|(_, f)| cell(f)).collect::<Vec<_>>().join(",")).collect();
    let expected: Vec<&str> = table.lines().skip(1).collect();
    assert_eq!(rows, expected);
}

const SLEIGH: &str = "\
vehicle = \"sleigh\"
[parameters]
mass = 20.0
inertia = 2.0
mass_offset = 0.2
[dynamics]
inputs = [\"force\", \"yaw_torque\"]
[initial]
x = 0.0
y = 0.0
heading = 0.0
speed = 1.5
";

/// Sleighs that forces move, each heavier than its file says by its own share.
#[test]
fn a_fleet_knows_forces() {
    let dir = tempfile::tempdir().unwrap();
    let at = |name: &str| dir.path().join(name);
    fs::write(at("model.toml"), SLEIGH.split("[initial]").next().unwrap()).unwrap();
    let mut inputs = String::from("time,force,yaw_torque\n");
    for i in 0..=500 {
        let t = 0.04 * f64::from(i);
        inputs += &format!("{t:.2},{:.6},{:.6}\n", 8.0 * (0.7 * t).sin(), 1.5 * (0.45 * t + 1.0).sin());
    }
    fs::write(at("inputs.csv"), &inputs).unwrap();
    let mut manifest = String::from("robot,run,log,model\n");
    for (robot, scale) in [0.05, 0.08, 0.11].into_iter().enumerate() {
        let truth = format!("{SLEIGH}[[effects]]\nid = \"mass\"\nscale = {scale}\n");
        fs::write(at("truth.toml"), truth).unwrap();
        done(dir.path(), &["simulate", "truth.toml", "--inputs", "inputs.csv", "--out", "path.csv"]);
        let mut random = ChaCha8Rng::seed_from_u64(robot as u64);
        let mut noisy = |cell: &str| cell.parse::<f64>().unwrap() + 0.002 * random.sample::<f64, _>(StandardNormal);
        let mut log = String::from("time,force,yaw_torque,x,y,heading\n");
        let path = fs::read_to_string(at("path.csv")).unwrap();
        for (inputs, pose) in inputs.lines().zip(path.lines()).skip(1) {
            let pose: Vec<String> = pose.split(',').skip(1).take(3).map(|c| format!("{:.6}", noisy(c))).collect();
            log += &format!("{inputs},{}\n", pose.join(","));
        }
        fs::write(at(&format!("log_{robot}.csv")), log).unwrap();
        manifest += &format!("sleigh{robot},run1,log_{robot}.csv,model.toml\n");
    }
    fs::write(at("fleet.csv"), manifest).unwrap();
    done(dir.path(), &["fleet", "map", "fleet.csv", "--out", "rows"]);
    done(dir.path(), &["fleet", "join", "rows", "--out", "fleet"]);
    let found = report(&at("fleet"));
    assert_eq!(names(&found["effects"], "effect"), ["mass"]);
    let mean = found["effects"][0]["parameters"]["scale"]["mean"]["value"].as_f64().unwrap();
    assert!((mean - 0.08).abs() < 0.005, "{found:#}");
}
