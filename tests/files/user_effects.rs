//! A user's own effects: refused with a place and advice, or as good as the library's.

use crate::bad_effects::{BAD_FILES, GOOD};
use crate::bad_formulas::BAD_FORMULAS;
use crate::models::OWN_EFFECTS;
use crate::program::{creepage, stderr};
use crate::simulator::{Hidden, Noise, Scenario, Tractor};
use crate::slips;
use creepage::describe::{self, Description};
use creepage::effects::{Applied, Effect};
use creepage::extensions::with_own;
use creepage::model::Model;
use creepage::motion::{Integrator, Signals, Table, Timing, simulate_model};
use proptest::prelude::*;
use rand::SeedableRng;
use rand_distr::Distribution;
use serde_json::Value;
use std::path::Path;

/// The library with a file of this text, or the message without the name of the file.
fn library(text: &[u8]) -> Result<Vec<Effect>, String> {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("mine.toml");
    std::fs::write(&path, text).unwrap();
    with_own(&path).map_err(|e| {
        assert_eq!(e.exit_code(), 2, "{e}");
        let message = e.to_string();
        message.strip_prefix(&format!("{}:", path.display())).unwrap_or_else(|| panic!("{message}")).to_string()
    })
}

/// Whether a message is the expected one, where "…" stands for the rest of its line.
fn is_expected(message: &str, expect: &str) -> bool {
    match expect.split_once('…') {
        Some((start, "")) => message.starts_with(start),
        _ => message == expect,
    }
}

#[test]
fn every_bad_file_is_explained_at_its_place() {
    // Effects on one definition act in the order of the library, a user's own last.
    assert!(library(GOOD.as_bytes()).unwrap().is_sorted_by(|a, b| a.order < b.order));
    let mut failures = Vec::new();
    for case in BAD_FILES.iter().chain(BAD_FORMULAS) {
        let text = case.edits.iter().fold(GOOD.to_string(), |text, (from, to)| {
            assert!(text.contains(from), "{}", case.name);
            text.replacen(from, to, 1)
        });
        match library(text.as_bytes()) {
            Ok(_) => failures.push(format!("{}: accepted", case.name)),
            Err(message) if is_expected(&message, case.expect) => {}
            Err(message) => failures.push(format!("{}: {message}", case.name)),
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

/// A file of effects on the same definition, each with this change of it.
fn stacked(effects: usize, change: &str) -> String {
    let one = |i: usize| {
        format!(
            "[[effect]]\nid = \"stacked-{i}\"\nwhere = \"a\"\nsays = \"b\"\n[effect.parameters.c]\nunit = \"1\"\n\
             range = [-1, 1]\nsize = 0.1\n[effect.changes]\nv_t = \"{change}\"\n"
        )
    };
    (0..effects).map(one).collect()
}

/// Each way in which short formulas become large together: by nesting, by size, by powers.
#[test]
fn effects_that_grow_beyond_all_bounds_are_refused() {
    let nested = format!("it{}", "+c*v_l".repeat(65));
    let long = "it + c*(it - it + it)";
    let powers = "it + c*it*(it/v_l)^15";
    for (effects, change) in [(6, nested.as_str()), (8, long), (3, powers)] {
        let refused = library(stacked(effects, change).as_bytes()).unwrap_err();
        let expect = "with all effects together the formula of v_t grows beyond all bounds on unicycle";
        assert!(refused.contains(expect), "{change}: {refused}");
    }
}

#[test]
fn a_range_of_exactly_one_turn_is_a_whole_turn() {
    let turn = "periodic = true\nunit = \"rad\"\nrange = [-3.141592653589793, 3.141592653589793]";
    let text = GOOD.replacen("unit = \"m*s\"\nrange = [-10.0, 10.0]", turn, 1).replacen("q*phi'^2", "0.1*q*phi'", 1);
    let refused = library(text.as_bytes()).err();
    assert!(refused.is_none_or(|why| !why.contains("a whole turn")));
}

#[test]
fn files_that_are_no_text_are_refused() {
    assert_eq!(library(b"").unwrap_err(), " is empty; check that this is the file you meant");
    assert!(library(b"\x7fELF\0\0").unwrap_err().contains("is a binary file"));
    let long = format!("{GOOD}{}", "# \n".repeat(100_000));
    let why = " is larger than 256 KiB; check that this is the file of effects you meant";
    assert_eq!(library(long.as_bytes()).unwrap_err(), why);
    let many: String = (0..51).map(|i| GOOD.replace("my-slip", &format!("slip-n{i}"))).collect();
    assert_eq!(library(many.as_bytes()).unwrap_err(), "1:1: effect has 51 entries; give at most 50");
}

#[test]
fn every_command_refuses_a_bad_file_and_writes_nothing() {
    let dir = tempfile::tempdir().unwrap();
    let model = "vehicle = \"unicycle\"\n[parameters]\nwheel_radius = 0.5\n";
    std::fs::write(dir.path().join("model.toml"), model).unwrap();
    std::fs::write(dir.path().join("run.csv"), "time,x,y,heading,wheel_rate,yaw_rate\n0,0,0,0,1,0\n1,1,0,0,1,0\n")
        .unwrap();
    std::fs::write(dir.path().join("bad.toml"), GOOD.replace("it - u", "it - ")).unwrap();
    for arguments in [
        &["discover", "run.csv", "--model", "model.toml", "--out", "report"][..],
        &["simulate", "model.toml", "--inputs", "run.csv", "--out", "out.csv"],
        &["describe", "model.toml"],
        &["effects"],
    ] {
        let output = creepage(dir.path(), &[arguments, &["--effects", "bad.toml"]].concat());
        let expect = "creepage: bad.toml:20:12: expected a number, a name or \"(\", found the end\n  it -\n      ^\n";
        assert_eq!((output.status.code(), stderr(&output).as_str()), (Some(2), expect), "{arguments:?}");
        assert!(output.stdout.is_empty());
    }
    assert!(!dir.path().join("report").exists() && !dir.path().join("out.csv").exists());
}

/// A log to find an effect in, and the model that lacks it.
fn files(dir: &Path, scenario: &Scenario) {
    std::fs::write(dir.join("model.toml"), scenario.model_toml()).unwrap();
    scenario.run().write_csv(dir.join("run.csv")).unwrap();
}

/// What `discover` writes with the example's effects.
fn report(dir: &Path, model: &str, out: &str) -> Value {
    let arguments = ["discover", "run.csv", "--model", model, "--out", out, "--effects", OWN_EFFECTS];
    let output = creepage(dir, &arguments);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    serde_json::from_slice(&std::fs::read(dir.join(out).join("report.json")).unwrap()).unwrap()
}

/// Demands that one effect is named with one of its values near the truth, and nothing with the patched model.
fn found_and_mended(dir: &Path, id: &str, parameter: &str, truth: f64) {
    let first = report(dir, "model.toml", "report");
    assert_eq!(
        (&first["verdict"], first["effects"].as_array().unwrap().len()),
        (&"missing-effect".into(), 1),
        "{first:#}"
    );
    assert_eq!(first["effects"][0]["id"], id, "{first:#}");
    let value = first["effects"][0]["parameters"][parameter]["value"].as_f64().unwrap();
    assert!((value - truth).abs() < 0.05 * truth.abs(), "{parameter} = {value}, in truth {truth}");
    let hash = first["provenance"]["inputs_sha256"][OWN_EFFECTS].as_str().unwrap();
    assert!(hash.len() == 64 && hash.chars().all(|c| c.is_ascii_hexdigit()));
    let again = report(dir, "report/model.patched.toml", "again");
    assert_eq!(again["verdict"], "no-missing-effect", "{again:#}");
}

#[test]
fn an_effect_of_the_users_own_is_found_by_every_command() {
    let dir = tempfile::tempdir().unwrap();
    let hidden = vec![Hidden::YawSquareSlip { q: 0.12 }];
    files(
        dir.path(),
        &Scenario { hidden, duration: 40.0, noise: Noise::MOCAP, ..Scenario::new(Tractor::Unicycle, 11) },
    );
    found_and_mended(dir.path(), "yaw-slip", "q", 0.12);
    let patched = "report/model.patched.toml";
    let text = std::fs::read_to_string(dir.path().join(patched)).unwrap();
    let note = format!(
        "# \"yaw-slip\" is defined in {OWN_EFFECTS}: wherever this model is used, add --effects {OWN_EFFECTS}\n[[effects]]\nid = \"yaw-slip\"\nq = "
    );
    assert!(text.contains(&note), "{text}");
    let own = ["--effects", OWN_EFFECTS];
    let describe = creepage(dir.path(), &[&["describe", patched][..], &own].concat());
    let said = String::from_utf8(describe.stdout.clone()).unwrap();
    assert!(describe.status.success() && said.contains("yaw_slip.q*phi'*abs(phi')"), "{said}");
    let simulate = ["simulate", patched, "--inputs", "run.csv", "--out", "out.csv"];
    assert_eq!(creepage(dir.path(), &[&simulate[..], &own].concat()).status.code(), Some(0));
    let list = creepage(dir.path(), &[&["effects"][..], &own].concat());
    assert!(String::from_utf8(list.stdout).unwrap().contains("\n## yaw-slip\n"));
    // Without the file the patched model says what it lacks.
    for arguments in [&["describe", patched][..], &simulate, &["discover", "run.csv", "--model", patched]] {
        let output = creepage(dir.path(), arguments);
        let expect = ": unknown effect \"yaw-slip\"; if it is your own, give its file with --effects; ";
        assert!(output.status.code() == Some(2) && stderr(&output).contains(expect), "{}", stderr(&output));
    }
}

fn own(id: &str) -> Effect {
    with_own(OWN_EFFECTS).unwrap().into_iter().find(|e| e.id == id).unwrap()
}

fn unicycle(id: &str, values: &[f64]) -> Model {
    let bare = Model::new("unicycle", &[("wheel_radius", 0.1)]).unwrap();
    bare.with_effect(Applied::new(&own(id), None, values.to_vec()))
}

/// Forty seconds of a drive that turns to both sides at changing speed.
fn driven(model: &Model, start: &[f64; 3]) -> (Table, [Vec<f64>; 2]) {
    let times: Vec<f64> = (0..1000).map(|i| 0.04 * f64::from(i)).collect();
    let wheel: Vec<f64> = times.iter().map(|t| 10.0 + 4.0 * (0.9 * t).sin()).collect();
    let yaw: Vec<f64> = times.iter().map(|t| 0.9 * (0.5 * t).cos() + 0.4 * (0.23 * t).sin()).collect();
    let inputs = Signals::new(&times, &[wheel.clone(), yaw.clone()], Timing::Sample);
    (simulate_model(model, &inputs, &times, start, &Integrator::default()).unwrap(), [wheel, yaw])
}

#[test]
fn an_effect_with_a_state_is_found_in_its_own_simulation() {
    let dir = tempfile::tempdir().unwrap();
    // In the order of their names: k, tau.
    let (table, [wheel, yaw]) = driven(&unicycle("warm-creep", &[0.08, 1.5]), &[0.0; 3]);
    let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(5);
    let noise = rand_distr::Normal::new(0.0, 0.001).unwrap();
    let mut csv = String::from("time,x,y,heading,wheel_rate,yaw_rate\n");
    for i in 0..table.rows() {
        let mut at = |k: usize| table.columns[k][i] + noise.sample(&mut random);
        let pose = [at(1), at(2), at(3)];
        csv += &format!("{},{},{},{},{},{}\n", table.columns[0][i], pose[0], pose[1], pose[2], wheel[i], yaw[i]);
    }
    std::fs::write(dir.path().join("run.csv"), csv).unwrap();
    std::fs::write(dir.path().join("model.toml"), "vehicle = \"unicycle\"\n[parameters]\nwheel_radius = 0.1\n")
        .unwrap();
    found_and_mended(dir.path(), "warm-creep", "k", 0.08);
}

#[test]
fn a_rigid_motion_of_the_plane_moves_the_path_and_changes_nothing_else() {
    let (turn, shift) = (1.1_f64, [12.0, -7.0]);
    for (id, values) in [("yaw-slip", &[0.3][..]), ("warm-creep", &[0.2, 1.5])] {
        let model = unicycle(id, values);
        let (here, _) = driven(&model, &[1.0, 2.0, 0.4]);
        let moved =
            |x: f64, y: f64| [turn.cos() * x - turn.sin() * y + shift[0], turn.sin() * x + turn.cos() * y + shift[1]];
        let [x, y] = moved(1.0, 2.0);
        let (there, _) = driven(&model, &[x, y, 0.4 + turn]);
        for i in 0..here.rows() {
            let [x, y] = moved(here.columns[1][i], here.columns[2][i]);
            let far = (there.columns[1][i] - x).abs().max((there.columns[2][i] - y).abs());
            assert!(far < 1e-7 && (there.columns[3][i] - here.columns[3][i] - turn).abs() < 1e-9, "{id}: {far}");
        }
        assert_eq!(here.names, there.names);
    }
}

#[test]
fn the_effects_of_the_catalogue_pass_the_checks_of_a_users_own() {
    let mut passed = 0;
    for block in include_str!("../../src/effects/catalogue.toml").split("[[effect]]").skip(1) {
        // A user's own acts on no single input or sensor, and is sought.
        if block.contains("unsought = true")
            || block.contains("per_input = true")
            || block.contains("per_quantity = true")
            || block.contains("input_optional = true")
        {
            continue;
        }
        let own = block.replacen("id = \"", "id = \"my-", 1);
        match library(format!("[[effect]]{own}").as_bytes()) {
            Ok(_) => passed += 1,
            // The catalogue calls some parameters as a vehicle calls a coefficient: e_rc, e_tc, a.
            Err(message) => assert!(message.contains(" is also a name of the vehicle "), "{message}\n{block}"),
        }
    }
    assert!(passed >= 15, "{passed}");
}

#[test]
fn a_model_in_which_effects_close_a_circle_is_refused_at_its_line() {
    let dir = tempfile::tempdir().unwrap();
    let effect = |id: &str, change: &str| {
        format!(
            "[[effect]]\nid = \"{id}\"\nwhere = \"a\"\nsays = \"b\"\n[effect.parameters.k]\nunit = \"1\"\nrange = [-1, 1]\nsize = 0.1\n[effect.changes]\n{change}\n"
        )
    };
    let mine = effect("one", "v_t = \"it + k*v_l\"") + &effect("two", "v_l = \"it + k*abs(v_t)\"");
    std::fs::write(dir.path().join("mine.toml"), mine).unwrap();
    let model = "vehicle = \"unicycle\"\n[parameters]\nwheel_radius = 0.1\n[[effects]]\nid = \"one\"\nk = 0.1\n[[effects]]\nid = \"two\"\nk = 0.1\n";
    std::fs::write(dir.path().join("model.toml"), model).unwrap();
    let output = creepage(dir.path(), &["describe", "model.toml", "--effects", "mine.toml"]);
    let message = stderr(&output);
    assert_eq!(output.status.code(), Some(2), "{message}");
    let start = "creepage: model.toml:7:1: the formulas of ";
    assert!(
        message.starts_with(start) && message.contains("use each other in a circle; remove the entry"),
        "{message}"
    );
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, cases: 150, ..Default::default() })]

    #[test]
    fn random_bytes_never_panic(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        prop_assert!(library(&bytes).is_err());
    }

    #[test]
    fn damaged_files_are_refused_or_can_be_used(slips in prop::collection::vec(slips::slip(), 1..5)) {
        if let Ok(library) = library(&slips::damage(GOOD.as_bytes(), &slips)) {
            let own = library.last().unwrap();
            let model = Model::new("unicycle", &[("wheel_radius", 0.1)]).unwrap();
            for (e, t) in model.applicable(std::slice::from_ref(own)) {
                for start in e.starts() {
                    let applied = Applied::new(e, t, start).freed();
                    let patched = model.clone().with_effect(applied.clone());
                    prop_assert!(patched.equations(&applied.parameters()).is_ok());
                    prop_assert!(!describe::latex(&Description::of(&patched).unwrap()).is_empty());
                }
            }
        }
    }
}
