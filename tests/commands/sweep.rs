//! The command `sweep`: the same bytes whatever stops it, splits it or runs it.

use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::time::Duration;
use tempfile::TempDir;

const MODEL: &str = "\
vehicle = \"unicycle\"
[parameters]
wheel_radius = 0.5
[[effects]]
id = \"rotation-creep\"
e_rc = 0.0
";

const SPEC: &str = "\
model = \"model.toml\"
duration = 3.0
[inputs]
wheel_rate = \"u_0 + sin(t)\"
yaw_rate = \"w\"
[constants]
w = 0.7
[grid]
u_0 = [1.0, 2.0]
rotation-creep.e_rc = { from = -0.1, to = 0.1, count = 5 }
[sample]
count = 7
seed = 3
[sample.of]
initial.heading = { uniform = [-3.0, 3.0] }
wheel_radius = { normal = [0.5, 0.01] }
";

fn folder(spec: &str) -> TempDir {
    let dir = tempfile::tempdir().unwrap();
    std::fs::write(dir.path().join("model.toml"), MODEL).unwrap();
    std::fs::write(dir.path().join("spec.toml"), spec).unwrap();
    dir
}

fn command(dir: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_creepage"));
    command.current_dir(dir).args(["sweep", "spec.toml"]).args(arguments);
    command
}

fn run(dir: &Path, arguments: &[&str]) -> Output {
    command(dir, arguments).output().unwrap()
}

fn good(dir: &Path, arguments: &[&str]) -> String {
    let output = run(dir, arguments);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

fn refused(dir: &Path, arguments: &[&str]) -> String {
    let output = run(dir, arguments);
    let message = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{message}");
    assert!(!message.contains("panicked"), "{message}");
    message
}

fn bytes(dir: &Path, name: &str) -> Vec<u8> {
    std::fs::read(dir.join(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
}

fn names(dir: &Path) -> Vec<String> {
    let mut names: Vec<String> =
        std::fs::read_dir(dir).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

#[test]
fn a_table_has_a_row_for_each_case_in_the_order_of_the_grid() {
    let dir = folder(SPEC);
    let said = good(dir.path(), &["--out", "all.csv"]);
    assert_eq!(said, "70 cases are in all.csv\n");
    let text = String::from_utf8(bytes(dir.path(), "all.csv")).unwrap();
    let mut lines = text.lines();
    assert_eq!(
        lines.next().unwrap(),
        "case,u_0,rotation-creep.e_rc,initial.heading,wheel_radius,time,x,y,heading,speed,lateral_speed,yaw_rate,error,status"
    );
    let rows: Vec<Vec<&str>> = lines.map(|l| l.split(',').collect()).collect();
    assert_eq!(rows.len(), 70);
    for (i, row) in rows.iter().enumerate() {
        let value = |c: usize| row[c].parse::<f64>().unwrap();
        assert_eq!((row[0], row[13]), (i.to_string().as_str(), "ok"));
        assert_eq!(value(1), if i < 35 { 1.0 } else { 2.0 });
        assert!((value(2) + 0.1 - 0.05 * ((i / 7) % 5) as f64).abs() < 1e-15);
        // The motion is known: the heading turns at w, and the speed is r·(u_0 + sin t)·(1 − e).
        assert!((value(8) - value(3) - 2.1).abs() < 1e-10 && value(12) <= 1e-10);
        let speed = value(4) * (value(1) + 3f64.sin()) * (1.0 - value(2));
        assert!((value(9) - speed).abs() < 1e-12);
    }
    let drawn = |c: usize| rows.iter().map(|r| r[c]).collect::<std::collections::BTreeSet<_>>().len();
    assert_eq!((drawn(3), drawn(4)), (70, 70), "every draw is its own");
    assert_eq!(names(dir.path()), ["all.csv", "model.toml", "spec.toml"]);
}

#[test]
fn threads_and_parts_change_no_byte() {
    for spec in [SPEC.to_string(), format!("every = 0.5\n{SPEC}")] {
        let dir = folder(&spec);
        good(dir.path(), &["--out", "all.csv", "--threads", "1"]);
        good(dir.path(), &["--out", "two.csv", "--threads", "2"]);
        let all = bytes(dir.path(), "all.csv");
        assert!(all == bytes(dir.path(), "two.csv"));
        let parts = ["a.csv", "b.csv", "c.csv"];
        for (i, part) in parts.iter().enumerate() {
            good(dir.path(), &["--out", part, "--shard", &format!("{}/3", i + 1), "--threads", "2"]);
        }
        assert!(all == parts.iter().flat_map(|p| bytes(dir.path(), p)).collect::<Vec<u8>>());
        good(dir.path(), &[&["--out", "joined.csv", "--join"], &parts[..]].concat());
        assert!(all == bytes(dir.path(), "joined.csv"));
        for wrong in [&["a.csv", "c.csv"][..], &["a.csv", "b.csv"], &["b.csv", "a.csv", "c.csv"], &["spec.toml"]] {
            let message = refused(dir.path(), &[&["--out", "wrong.csv", "--join"], wrong].concat());
            assert!(message.contains("is not a part in its place"), "{message}");
            assert!(!dir.path().join("wrong.csv").exists());
        }
        // A part that was cut off in the middle of a line.
        let cut = bytes(dir.path(), "c.csv");
        std::fs::write(dir.path().join("c.csv"), &cut[..cut.len() - 3]).unwrap();
        refused(dir.path(), &[&["--out", "wrong.csv", "--join"], &parts[..]].concat());
    }
}

/// Enough cases that a run can be killed on its way.
fn long() -> String {
    SPEC.replace("count = 7", "count = 4000").replace("duration", "every = 0.5\nduration")
}

/// Cases that the note beside the journal says are done.
fn noted(dir: &Path) -> usize {
    let text = std::fs::read_to_string(dir.join("all.csv.partial.json")).unwrap_or_default();
    let state: serde_json::Value = serde_json::from_str(&text).unwrap_or_default();
    state["cases"].as_u64().unwrap_or(0) as usize
}

/// Starts a sweep and kills it as soon as it has noted more cases than before, or a little later; whether it was in time.
fn killed(dir: &Path, later: Duration) -> bool {
    let before = noted(dir);
    let mut child = command(dir, &["--out", "all.csv", "--threads", "1"]).stdout(Stdio::null()).spawn().unwrap();
    while noted(dir) <= before && child.try_wait().unwrap().is_none() {
        std::thread::sleep(Duration::from_millis(2));
    }
    std::thread::sleep(later);
    // SIGKILL: nothing is tidied up.
    child.kill().unwrap();
    child.wait().unwrap();
    !dir.join("all.csv").exists()
}

#[test]
fn killed_at_any_moment_it_goes_on_to_the_same_bytes() {
    let (dir, undisturbed) = (folder(&long()), folder(&long()));
    let stopped = [0, 3, 41].into_iter().take_while(|later| killed(dir.path(), Duration::from_millis(*later))).count();
    assert!(stopped > 0, "the sweep is over before it can be killed");
    // The last one may have been over before it was killed: then it has gone on where an earlier one was stopped.
    if stopped == 3 {
        let said = good(dir.path(), &["--out", "all.csv", "--threads", "2"]);
        assert!(said.contains("of them from a run that was stopped"), "{said}");
    }
    good(undisturbed.path(), &["--out", "all.csv"]);
    assert!(bytes(dir.path(), "all.csv") == bytes(undisturbed.path(), "all.csv"));
    assert_eq!(names(dir.path()), ["all.csv", "model.toml", "spec.toml"]);
}

#[test]
fn what_was_done_for_another_sweep_or_damaged_is_not_used() {
    let undisturbed = folder(&long());
    good(undisturbed.path(), &["--out", "all.csv"]);
    let (dir, other) = (folder(&long()), long().replace("seed = 3", "seed = 4"));
    let (partial, note) = (dir.path().join("all.csv.partial"), dir.path().join("all.csv.partial.json"));
    for damage in ["another sweep", "another row", "no note", "fewer rows"] {
        let first = if damage == "another sweep" { other.clone() } else { long() };
        std::fs::write(dir.path().join("spec.toml"), first).unwrap();
        assert!(killed(dir.path(), Duration::ZERO), "killed too late for {damage}");
        let mut rows = std::fs::read(&partial).unwrap();
        match damage {
            "another row" => rows[300] ^= 1,
            "no note" => std::fs::write(&note, "{").unwrap(),
            "fewer rows" => rows.truncate(200),
            _ => {}
        }
        std::fs::write(&partial, rows).unwrap();
        std::fs::write(dir.path().join("spec.toml"), long()).unwrap();
        let said = good(dir.path(), &["--out", "all.csv"]);
        assert!(!said.contains("stopped"), "{damage}: {said}");
        assert!(bytes(dir.path(), "all.csv") == bytes(undisturbed.path(), "all.csv"), "{damage}");
        std::fs::remove_file(dir.path().join("all.csv")).unwrap();
    }
}

#[test]
fn what_a_file_gets_wrong_is_told_with_its_place() {
    for (change, by, place) in [
        ("u_0 = [1.0, 2.0]", "u_9 = [1.0, 2.0]", "spec.toml:9:1: nothing is called \"u_9\""),
        ("u_0 + sin(t)", "u_0 + sin(q)", "spec.toml:4:25: q has no value"),
        ("u_0 + sin(t)", "u_0 + sin(", "spec.toml:4:2"),
        ("wheel_rate =", "wheel_rat =", "spec.toml:3:1: the input wheel_rate or speed has no formula"),
        ("count = 5", "count = 0", "spec.toml:10:"),
        ("to = 0.1", "to = 2000.0", "out of range"),
        ("wheel_radius = {", "t = {", "spec.toml:16:1: nothing is called \"t\""),
        (
            "\nrotation-creep.e_rc = { from = -0.1, to = 0.1, count = 5 }",
            "\ninitial.x = [0.0]\nsensor.x = [1]",
            "sensor.x",
        ),
        (
            "wheel_radius = { normal = [0.5, 0.01] }",
            "wheel_radius = { uniform = [0.0, 1.0] }",
            "wheel_radius = 0.0 is out",
        ),
        ("duration = 3.0", "durations = 3.0", "spec.toml:2:1: unknown key \"durations\""),
        ("duration = 3.0", "", "spec.toml:1:1: key \"duration\" is missing"),
        ("duration = 3.0", "duration = -3.0", "spec.toml:2:12: duration"),
        (
            "uniform = [-3.0, 3.0]",
            "log_uniform = [0.0, 3.0]",
            "spec.toml:15:35: log_uniform [0.0, 3.0] has a bound that is not positive",
        ),
        ("uniform", "triangle", "spec.toml:15:21: \"triangle\" is no distribution"),
        ("[-3.0, 3.0]", "[3.0, -3.0]", "begins above its end"),
        ("model.toml", "models.toml", "spec.toml:1:9: no file is at \"models.toml\""),
        ("count = 7", "count = 1000000000000000000", "there are more than 10^15 cases"),
        (
            "duration = 3.0",
            "duration = 3.0\nevery = 1e-9",
            "spec.toml:3:1: every = 1e-9 gives more than a million rows",
        ),
        ("normal = [0.5, 0.01]", "uniform = [-1.0, 0.5]", "spec.toml:16:1: wheel_radius = -1.0 is out of range"),
        ("u_0 = [1.0, 2.0]", "wheel_radius = [0.4]\nu_0 = [1.0]", "stands under [grid] and [sample.of]"),
        (
            "duration = 3.0",
            "start = 1e308\nduration = 1e308",
            "spec.toml:3:1: duration = 1e308 leads beyond all numbers",
        ),
        ("duration = 3.0", "start = 1e17\nduration = 3.0", "spec.toml:3:1: duration = 3.0 is lost in rounding"),
        (
            "duration = 3.0",
            "start = 1e17\nevery = 1\nduration = 100.0",
            "spec.toml:3:1: every = 1.0 is lost in rounding beside times of 1",
        ),
        ("w = 0.7", "t = 0.7", "spec.toml:7:1: t is the time and cannot be a constant"),
        ("w = 0.7", "w = 0.7\nwheel_radius = 1", "spec.toml:8:1: the constant wheel_radius is a quantity of the model"),
        ("w = 0.7", "w = 0.7\nu_0 = 1", "spec.toml:8:1: the constant u_0 is varied as well"),
        (
            "initial.heading",
            "w = { uniform = [0, 1] }\ninitial.heading",
            "spec.toml:7:1: the constant w is varied as well",
        ),
        ("u_0 = [", "u_0 = [1]\n\"rotation-creep.e_rc\" = [", "spec.toml:11:16: rotation-creep.e_rc is named twice"),
        (
            "initial.heading",
            "\"initial.heading\" = { uniform = [0.0, 1.0] }\ninitial.heading",
            "spec.toml:16:9: initial.heading is named twice",
        ),
    ] {
        let changed = SPEC.replacen(change, by, 1);
        assert_ne!(changed, SPEC, "{change}");
        let dir = folder(&changed);
        let message = refused(dir.path(), &["--out", "all.csv"]);
        assert!(message.contains(place), "{by}: {place:?} is not in {message:?}");
        assert_eq!(names(dir.path()), ["model.toml", "spec.toml"], "{by} left something behind");
    }
    let dir = folder(SPEC);
    for shard in ["0/3", "4/3", "1", "1/0", "-1/2", "a/b"] {
        assert!(refused(dir.path(), &["--out", "all.csv", "--shard", shard]).contains("I/N"), "{shard}");
    }
    assert!(refused(dir.path(), &["--out", "no/all.csv"]).contains("its folder does not exist"));
    assert!(refused(dir.path(), &["--out", "."]).contains("is a folder"));
    if cfg!(not(feature = "parquet")) {
        assert!(refused(dir.path(), &["--out", "all.parquet"]).contains("--features parquet"));
    }
    assert_eq!(names(dir.path()), ["model.toml", "spec.toml"]);
}

/// A vehicle of one's own with a section behind a joint: the last row of a case is what `simulate` ends with.
#[test]
fn a_vehicle_of_a_file_moves_as_by_simulate() {
    const BUS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/bus");
    let model = "vehicle = \"articulated-bus\"\n[parameters]\nwheel_radius = 0.478\nwheelbase = 5.9\njoint_offset = 1.65\n\
                 rear_length = 5.1\n[initial]\nx = 0\ny = 0\nheading = 0.1\ntrailer_headings = [0.4]\n";
    let spec = "model = \"model.toml\"\nduration = 6.0\n[inputs]\nwheel_rate = \"5.0\"\nsteering_angle = \"s\"\n[grid]\n\
                s = [0.0, 0.2]\nwheelbase = [5.9, 5.0]\n";
    let dir = folder(spec);
    let write = |name: &str, text: &str| std::fs::write(dir.path().join(name), text).unwrap();
    write("model.toml", model);
    assert!(refused(dir.path(), &["--out", "all.csv"]).contains("unknown vehicle \"articulated-bus\""));
    write("model.toml", &format!("vehicles = \"{BUS}/bus.toml\"\n{model}"));
    good(dir.path(), &["--out", "all.csv"]);
    let named = bytes(dir.path(), "all.csv");
    write("model.toml", model);
    write("spec.toml", &format!("vehicles = \"{BUS}/bus.toml\"\n{spec}"));
    good(dir.path(), &["--out", "all.csv"]);
    assert_eq!(bytes(dir.path(), "all.csv"), named);
    let of_case = |i: usize| -> Vec<f64> {
        let text = String::from_utf8(named.clone()).unwrap();
        let row = text.lines().nth(i + 1).unwrap().split(',').take(8).map(|v| v.parse().unwrap()).collect::<Vec<f64>>();
        row[4..8].to_vec()
    };
    for (case, s) in [(0, "0.0"), (2, "0.2")] {
        write("in.csv", &format!("time,wheel_rate,steering_angle\n0,5,{s}\n6,5,{s}\n"));
        let mut command = Command::new(env!("CARGO_BIN_EXE_creepage"));
        command.current_dir(dir.path()).args(["simulate", "model.toml", "--inputs", "in.csv", "--out", "path.csv"]);
        let output = command.args(["--vehicles", &format!("{BUS}/bus.toml")]).output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let path = String::from_utf8(bytes(dir.path(), "path.csv")).unwrap();
        let end: Vec<f64> = path.lines().last().unwrap().split(',').map(|v| v.parse().unwrap()).collect();
        let apart = of_case(case).iter().zip(&end[1..5]).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(apart < 1e-8 && end[4] != end[3], "{apart} {end:?} {:?}", of_case(case));
    }
    assert_ne!(of_case(2), of_case(3), "the wheelbase matters");
}

/// The trailers of the file come behind those that are a part of the tractor, and it counts its own.
#[test]
fn trailers_behind_a_section_of_the_tractor_vary() {
    const BUS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/bus/bus.toml");
    let spec =
        "model = \"model.toml\"\nduration = 6.0\n[inputs]\nwheel_rate = \"5.0\"\nsteering_angle = \"0.2\"\n[grid]\n";
    let dir = folder(spec);
    let write = |name: &str, text: &str| std::fs::write(dir.path().join(name), text).unwrap();
    let last = |spec: &str, [length, hitch]: [f64; 2]| -> Vec<f64> {
        let model = format!(
            "vehicles = \"{BUS}\"\nvehicle = \"n-trailer\"\ntractor = \"articulated-bus\"\n[parameters]\nwheel_radius = 0.478\n\
             wheelbase = 5.9\njoint_offset = 1.65\nrear_length = 5.1\ntrailer_lengths = [{length}]\n\
             hitch_offsets = [{hitch}]\n"
        );
        write("model.toml", &model);
        write("spec.toml", spec);
        good(dir.path(), &["--out", "all.csv"]);
        let text = String::from_utf8(bytes(dir.path(), "all.csv")).unwrap();
        let column = text.lines().next().unwrap().split(',').position(|n| n == "trailer_heading_2").unwrap();
        text.lines().skip(1).map(|l| l.split(',').nth(column).unwrap().parse().unwrap()).collect()
    };
    for (name, values) in [("trailer_lengths.1", [3.0, 5.0]), ("hitch_offsets.1", [0.0, 1.0])] {
        let varied = last(&format!("{spec}{name} = {values:?}\n"), [4.0, 0.5]);
        let of = |v: f64| if name == "hitch_offsets.1" { [4.0, v] } else { [v, 0.5] };
        for (v, found) in values.into_iter().zip(&varied) {
            let alone = last(&format!("{spec}initial.x = [0.0]\n"), of(v))[0];
            assert!((alone - found).abs() < 1e-9, "{name} = {v}: {found} and not {alone}");
        }
        assert!((varied[0] - varied[1]).abs() > 1e-3, "{name}: {varied:?}");
    }
}

/// Equal ratios are equally likely.
#[test]
fn draws_lie_within_their_bounds_and_as_often_as_they_say() {
    let drawn = |from: &str| {
        let dir = folder(&SPEC.replace("count = 7", "count = 40").replace("uniform = [-3.0, 3.0]", from));
        good(dir.path(), &["--out", "all.csv"]);
        let text = String::from_utf8(bytes(dir.path(), "all.csv")).unwrap();
        let value = |l: &str| l.split(',').nth(3).unwrap().parse::<f64>().unwrap();
        text.lines().skip(1).map(value).collect::<Vec<f64>>()
    };
    let share = |values: &[f64], most: f64| values.iter().filter(|v| **v < most).count() as f64 / values.len() as f64;
    for (from, [least, most], quarters) in [
        ("uniform = [1.0, 5.0]", [1.0, 5.0], [2.0, 3.0, 4.0]),
        ("log_uniform = [0.01, 100.0]", [0.01, 100.0], [0.1, 1.0, 10.0]),
        ("normal = [3.0, 2.0]", [-9.0, 15.0], [1.651, 3.0, 4.349]),
    ] {
        let values = drawn(from);
        assert_eq!(values.len(), 400);
        assert!(values.iter().all(|v| (least..most).contains(v)), "{from}");
        for (k, quarter) in quarters.into_iter().enumerate() {
            let wanted = 0.25 * (k + 1) as f64;
            // Four standard deviations of a share of 400.
            assert!((share(&values, quarter) - wanted).abs() < 0.1, "{from}: {quarter} {}", share(&values, quarter));
        }
    }
}

/// Where a log drives, it says how long, too.
#[test]
fn a_log_gives_inputs_start_and_duration() {
    let spec = "model = \"model.toml\"\n[inputs]\nlog = \"in.csv\"\nyaw_rate = \"log.yaw_rate + w\"\n[constants]\n\
                w = 0.1\n[grid]\nwheel_radius = [0.5, 0.4]\n";
    let dir = folder(spec);
    let write = |name: &str, text: &str| std::fs::write(dir.path().join(name), text).unwrap();
    write("in.csv", "time,wheel_rate,yaw_rate\n2,1,0.2\n3.5,1,0.2\n5,1,0.2\n");
    good(dir.path(), &["--out", "all.csv"]);
    let end = |row: usize| -> Vec<f64> {
        let text = String::from_utf8(bytes(dir.path(), "all.csv")).unwrap();
        text.lines().nth(row).unwrap().split(',').take(6).map(|v| v.parse().unwrap()).collect()
    };
    // case, wheel_radius, time, x, y, heading: three seconds at 0.3 rad/s.
    for (row, radius) in [(1, 0.5), (2, 0.4)] {
        let found = end(row);
        assert_eq!((found[1], found[2]), (radius, 5.0));
        let [x, y] = [0.9f64.sin(), 1.0 - 0.9f64.cos()].map(|v| v * radius / 0.3);
        assert!((found[3] - x).abs() < 1e-9 && (found[4] - y).abs() < 1e-9 && (found[5] - 0.9).abs() < 1e-9);
    }
    write("spec.toml", &format!("start = 4.0\n{spec}"));
    good(dir.path(), &["--out", "all.csv"]);
    assert!((end(1)[2] - 5.0).abs() < 1e-12 && (end(1)[5] - 0.3).abs() < 1e-9, "{:?}", end(1));
    for (from, to, says) in [
        ("[inputs]", "start = 5.0\n[inputs]", "key \"duration\" is missing"),
        ("[inputs]", "start = 6.0\n[inputs]", "key \"duration\" is missing"),
        ("log.yaw_rate", "log.yaw", "log.yaw has no value"),
        ("yaw_rate =", "steering_angle =", "the model has no input \"steering_angle\" here"),
    ] {
        write("spec.toml", &spec.replace(from, to));
        let message = refused(dir.path(), &["--out", "no.csv"]);
        assert!(message.contains(says), "{says}: {message}");
    }
}

#[test]
fn a_train_begins_straight_unless_its_headings_vary() {
    let dir = folder(
        "model = \"model.toml\"\nduration = 1.0\n[inputs]\nwheel_rate = \"1\"\nsteering_angle = \"0\"\n[grid]\n\
         initial.trailer_headings.2 = [0.0, 0.5]\n",
    );
    let model = "vehicle = \"n-trailer\"\ntractor = \"car\"\n[parameters]\nwheel_radius = 0.3\nwheelbase = 2.0\n\
                 trailer_lengths = [1.0, 1.0]\nhitch_offsets = [0.0, 0.0]\n";
    std::fs::write(dir.path().join("model.toml"), model).unwrap();
    good(dir.path(), &["--out", "all.csv"]);
    let text = String::from_utf8(bytes(dir.path(), "all.csv")).unwrap();
    let header: Vec<&str> = text.lines().next().unwrap().split(',').collect();
    let of = |row: usize, name: &str| -> f64 {
        let column = header.iter().position(|h| *h == name).unwrap_or_else(|| panic!("{name}: {header:?}"));
        text.lines().nth(row).unwrap().split(',').nth(column).unwrap().parse().unwrap()
    };
    assert_eq!([of(1, "trailer_heading_1"), of(1, "trailer_heading_2"), of(2, "trailer_heading_1")], [0.0; 3]);
    assert!(of(2, "trailer_heading_2") > 0.3 && of(2, "trailer_heading_2") < 0.5);
}

/// A part that lost its end is no part, and neither are all parts but one.
#[test]
fn what_is_cut_off_is_not_joined() {
    let dir = folder(&format!("every = 0.5\n{SPEC}"));
    for i in ["1", "2"] {
        good(dir.path(), &["--out", &format!("{i}.csv"), "--shard", &format!("{i}/2")]);
    }
    let whole = String::from_utf8(bytes(dir.path(), "2.csv")).unwrap();
    let lines = whole.lines().count();
    for kept in [lines - 1, lines - 6, lines - 7, lines - 8, 0] {
        let cut: String = whole.lines().take(kept).map(|l| format!("{l}\n")).collect();
        std::fs::write(dir.path().join("cut.csv"), cut).unwrap();
        let message = refused(dir.path(), &["--out", "all.csv", "--join", "1.csv", "cut.csv"]);
        assert!(message.contains("is not a part in its place"), "{kept}: {message}");
    }
    std::fs::write(dir.path().join("cut.csv"), whole.trim_end()).unwrap();
    refused(dir.path(), &["--out", "all.csv", "--join", "1.csv", "cut.csv"]);
    assert!(refused(dir.path(), &["--out", "all.csv", "--join", "1.csv"]).contains("case 35 of 70 was to follow"));
    assert!(!dir.path().join("all.csv").exists());
    good(dir.path(), &["--out", "all.csv", "--join", "1.csv", "2.csv"]);
}

/// A table has the rights of any new file, or those of the file it replaces, however it comes about.
#[cfg(unix)]
#[test]
fn tables_have_the_rights_of_other_files() {
    use std::os::unix::fs::PermissionsExt;
    let dir = folder(SPEC);
    let mode = |name: &str| std::fs::metadata(dir.path().join(name)).unwrap().permissions().mode() & 0o777;
    let endings = if cfg!(feature = "parquet") { &["csv", "parquet"][..] } else { &["csv"] };
    for ending in endings {
        let [all, joined] = ["all", "joined"].map(|name| format!("{name}.{ending}"));
        good(dir.path(), &["--out", &all]);
        good(dir.path(), &["--out", &joined, "--join", &all]);
        assert_eq!([mode(&all), mode(&joined)], [mode("spec.toml"); 2]);
        for name in [&all, &joined] {
            std::fs::set_permissions(dir.path().join(name), std::fs::Permissions::from_mode(0o640)).unwrap();
        }
        good(dir.path(), &["--out", &joined, "--join", &all]);
        good(dir.path(), &["--out", &all]);
        assert_eq!([mode(&all), mode(&joined)], [0o640; 2]);
    }
}

/// A link may lead to another disk: everything is made where it leads, and nothing stays beside it.
#[cfg(unix)]
#[test]
fn a_link_is_followed_before_anything_is_made() {
    let (dir, there) = (folder(SPEC), elsewhere());
    let (link, real) = (dir.path().join("all.csv"), there.path().join("real.csv"));
    std::fs::write(&real, "old").unwrap();
    std::os::unix::fs::symlink(&real, &link).unwrap();
    good(dir.path(), &["--out", "all.csv"]);
    let table = std::fs::read(&real).unwrap();
    assert!(table.len() > 1000 && std::fs::symlink_metadata(&link).unwrap().is_symlink());
    std::fs::copy(&real, dir.path().join("part.csv")).unwrap();
    std::fs::write(&real, "old").unwrap();
    good(dir.path(), &["--out", "all.csv", "--join", "part.csv"]);
    assert!(std::fs::read(&real).unwrap() == table);
    assert_eq!(names(dir.path()), ["all.csv", "model.toml", "part.csv", "spec.toml"]);
    assert_eq!(names(there.path()), ["real.csv"]);
}

/// A folder on another disk where there is one.
#[cfg(unix)]
fn elsewhere() -> TempDir {
    tempfile::tempdir_in("/dev/shm").or_else(|_| tempfile::tempdir()).unwrap()
}

#[test]
fn an_undefined_case_is_blank_and_counted() {
    let dir = folder(&SPEC.replace("u_0 + sin(t)", "sqrt(u_0 - 0.5*t)"));
    let said = good(dir.path(), &["--out", "all.csv"]);
    assert_eq!(said, "70 cases, 35 undefined are in all.csv\n");
    let text = String::from_utf8(bytes(dir.path(), "all.csv")).unwrap();
    assert!(text.lines().nth(1).unwrap().ends_with(",,,,,,,,,undefined"), "{}", text.lines().nth(1).unwrap());
}

#[cfg(feature = "parquet")]
#[test]
fn parquet_holds_the_same_and_its_parts_join_to_the_same_bytes() {
    let dir = folder(&format!("every = 0.5\n{SPEC}"));
    good(dir.path(), &["--out", "all.parquet", "--threads", "2"]);
    for i in ["1", "2"] {
        good(dir.path(), &["--out", &format!("{i}.parquet"), "--shard", &format!("{i}/2")]);
    }
    good(dir.path(), &["--out", "joined.parquet", "--join", "1.parquet", "2.parquet"]);
    assert!(bytes(dir.path(), "all.parquet") == bytes(dir.path(), "joined.parquet"));
    let message = refused(dir.path(), &["--out", "wrong.parquet", "--join", "2.parquet", "1.parquet"]);
    assert!(message.contains("is not a part in its place"), "{message}");
    let mut expected = names(dir.path());
    expected.retain(|n| !n.ends_with(".parquet"));
    assert_eq!(expected, ["model.toml", "spec.toml"]);
}

const CAR_OF_FORCES: &str = "\
vehicle = \"car\"
[parameters]
wheel_radius = 0.3
wheelbase = 2.6
[dynamics]
mass = 1200.0
inertia = 1500.0
mass_offset = 1.2
wheel_inertia = 2.0
inputs = [\"wheel_torque\"]
[dynamics.friction]
rolling = { law = \"viscous\", coefficient = 20000.0 }
direction = { law = \"elastic\", stiffness = 60000.0, relaxation_length = 0.4 }
front-axle-direction = { law = \"rocard\", stiffness = 80000.0 }
[initial]
x = 0.0
y = 0.0
heading = 0.0
speed = 8.0
";

const PUSHED: &str = "\
model = \"model.toml\"
duration = 4.0
error = 1e-9
[inputs]
wheel_torque = \"200*sin(t)\"
steering_angle = \"0.1*sin(0.7*t)\"
[grid]
body.mass = [1200.0, 1500.0]
start.body.u = [8.0, 5.0]
";

/// Forces move the cases of a sweep as they move the vehicle of `simulate`; masses, contacts and first speeds may vary.
#[test]
fn a_sweep_knows_forces() {
    let dir = folder(PUSHED);
    std::fs::write(dir.path().join("model.toml"), CAR_OF_FORCES).unwrap();
    good(dir.path(), &["--out", "table.csv"]);
    let table = std::fs::read_to_string(dir.path().join("table.csv")).unwrap();
    let rows: Vec<Vec<&str>> = table.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!(&rows[0][..6], ["case", "body.mass", "start.body.u", "time", "x", "y"]);
    assert_eq!(rows.len(), 5);
    let mut log = String::from("time,wheel_torque,steering_angle\n");
    for i in 0..=400 {
        let t = 0.01 * f64::from(i);
        log += &format!("{t:.2},{:?},{:?}\n", 200.0 * t.sin(), 0.1 * (0.7 * t).sin());
    }
    std::fs::write(dir.path().join("log.csv"), log).unwrap();
    for (row, (mass, speed)) in rows[1..].iter().zip([(1200.0, 8.0), (1200.0, 5.0), (1500.0, 8.0), (1500.0, 5.0)]) {
        let model = CAR_OF_FORCES.replace("mass = 1200.0", &format!("mass = {mass:?}"));
        let model = model.replace("speed = 8.0", &format!("speed = {speed:?}"));
        std::fs::write(dir.path().join("one.toml"), model).unwrap();
        let one = Command::new(env!("CARGO_BIN_EXE_creepage"))
            .current_dir(dir.path())
            .args(["simulate", "one.toml", "--inputs", "log.csv", "--out", "path.csv"])
            .output()
            .unwrap();
        assert!(one.status.success(), "{}", String::from_utf8_lossy(&one.stderr));
        let path = std::fs::read_to_string(dir.path().join("path.csv")).unwrap();
        let last: Vec<f64> = path.lines().last().unwrap().split(',').map(|v| v.parse().unwrap()).collect();
        assert_eq!(row.last(), Some(&"ok"));
        for (k, there) in last[1..4].iter().enumerate() {
            let here: f64 = row[4 + k].parse().unwrap();
            assert!((here - there).abs() < 1e-6 * (1.0 + there.abs()), "{mass} {speed}: {here} {there}");
        }
    }
}
