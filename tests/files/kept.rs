//! What a file says reaches what is made of it, key by key.

use crate::bad_vehicles;
use creepage::files::{EffectsFile, Inputs, ModelFile, Run, VehiclesFile};
use creepage::formula::Symbol;
use creepage::mechanism::{Printed, Regimes};
use creepage::{effects, model};
use sha2::{Digest, Sha256};
use std::path::Path;

/// Reads a text as a file of a name.
fn reads<T>(name: &str, text: &str, read: impl FnOnce(&Path) -> T) -> T {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    std::fs::write(&path, text).unwrap();
    read(&path)
}

const EFFECT: &str = "\
[[effect]]
id = \"my-slip\"
where = \"traverse constraint\"
says = \"it slides\"
source = \"a note of mine\"
needs = [\"yaw_rate\", \"wheel_rate\"]
limit = \"q -> 0\"
[effect.parameters.q]
unit = \"m*s\"
range = [-10.0, 10.0]
size = 0.03
start = [0.1, -0.1]
[effect.parameters.tau]
unit = \"s\"
range = [1e-3, 100.0]
size = 1.0
start = [0.5]
positive = true
[effect.states.u]
unit = \"m/s\"
rate = \"(q*phi'^2 - u)/tau\"
[effect.changes]
v_t = \"it - u\"
";

#[test]
fn an_effect_is_what_its_file_says() {
    let file = reads("effects.toml", EFFECT, EffectsFile::read).unwrap();
    let [own] = &file.effects[..] else { panic!("one effect") };
    let effect = &own.effect;
    assert_eq!((effect.id.as_str(), effect.place.as_str()), ("my-slip", "traverse constraint"));
    assert_eq!((effect.says.as_str(), effect.source.as_str()), ("it slides", "a note of mine"));
    assert_eq!((effect.limit.as_deref(), effect.per_trailer), (Some("q -> 0"), false));
    assert_eq!(effect.needs, ["yaw_rate", "wheel_rate"]);
    let [q, tau] = ["q", "tau"].map(|name| &effect.parameters[name]);
    assert_eq!((q.unit.as_str(), q.range, q.size, q.positive), ("m*s", [-10.0, 10.0], 0.03, false));
    assert_eq!((q.start.as_slice(), tau.start.as_slice(), tau.positive), (&[0.1, -0.1][..], &[0.5][..], true));
    assert_eq!(effect.states["u"].unit, "m/s");
    let origin = effect.origin.as_ref().unwrap();
    assert_eq!((origin.text.as_str(), &origin.sha256), (EFFECT, &format!("{:x}", Sha256::digest(EFFECT))));
}

/// What is left out has its usual value.
#[test]
fn an_effect_may_say_less() {
    let drop = ["source = \"a note of mine\"\n", "limit = \"q -> 0\"\n", "needs = [\"yaw_rate\", \"wheel_rate\"]\n"];
    let text = drop.iter().fold(EFFECT.to_string(), |text, line| text.replace(line, ""));
    let file = reads("effects.toml", &text.replace("start = [0.1, -0.1]\n", ""), EffectsFile::read).unwrap();
    let effect = &file.effects[0].effect;
    assert_eq!((effect.source.as_str(), &effect.limit, effect.needs.len()), ("the user's own", &None, 0));
    assert_eq!(effect.parameters["q"].start, [0.0]);
}

/// Names that would be mistaken for something else in a formula are refused, as are those that say nothing.
#[test]
fn names_of_effects_are_symbols() {
    for name in ["9q", "q-q", "q q", "q__q", "q_", "_q", "sin", "it", "trailer", "ä"] {
        let text = EFFECT.replace("parameters.tau]", &format!("parameters.\"{name}\"]"));
        let error = reads("effects.toml", &text, EffectsFile::read).unwrap_err().to_string();
        assert!(error.contains(&format!(":13:20: \"{name}\" cannot name a parameter")), "{name}: {error}");
    }
    let idle = EFFECT.replace("rate = \"(q*phi'^2 - u)/tau\"", "rate = \"(phi'^2 - u)/tau\"");
    let error = reads("effects.toml", &idle, EffectsFile::read).unwrap_err().to_string();
    assert!(error.contains("q has no say in what the effect changes"), "{error}");
}

fn model_of(vehicle: &str, rest: &str) -> ModelFile {
    let text = format!("vehicle = \"{vehicle}\"\n[parameters]\n{rest}");
    reads("model.toml", &text, |path| ModelFile::read(path, &model::known(effects::all()))).unwrap()
}

#[test]
fn a_model_knows_its_bytes() {
    let text = "vehicle = \"unicycle\"\n[parameters]\nwheel_radius = 0.5\n";
    let file = model_of("unicycle", "wheel_radius = 0.5\n");
    assert_eq!((file.sha256, file.vehicle.as_str()), (format!("{:x}", Sha256::digest(text)), "unicycle"));
}

const DRIVE: &str = "time,wheel_rate,yaw_rate\n0,1,0.5\n1,2,0.25\n";

/// A pose in a log of inputs is where the simulation starts; a part of one is none.
#[test]
fn inputs_bring_a_pose_where_it_is_whole() {
    let model = model_of("unicycle", "wheel_radius = 0.5\n");
    let read = |text: &str| reads("drive.csv", text, |path| Inputs::read(path, &model)).unwrap();
    let plain = read(DRIVE);
    assert_eq!((plain.pose, plain.columns), (None, vec![vec![1.0, 2.0], vec![0.5, 0.25]]));
    assert_eq!(
        (plain.time.as_slice(), plain.roles),
        (&[0.0, 1.0][..], vec!["wheel_rate".to_string(), "yaw_rate".into()])
    );
    let places = read("time,wheel_rate,yaw_rate,x,y\n0,1,0.5,3,4\n1,2,0.25,5,6\n");
    assert_eq!((places.pose, places.columns.len()), (None, 2));
    let pose = read("time,wheel_rate,yaw_rate,x,y,heading\n0,1,0.5,3,4,0.7\n1,2,0.25,5,6,0.8\n").pose.unwrap();
    assert_eq!((pose.x, pose.y, pose.heading, pose.trailer_headings.len()), (3.0, 4.0, 0.7, 0));
}

/// A row needs its time and its inputs: poses further on may be missing or contradict each other.
#[test]
fn inputs_are_kept_where_a_pose_is_missing() {
    let model = model_of("unicycle", "wheel_radius = 0.5\n");
    let read = |rows: &str| {
        let text = format!("time,wheel_rate,yaw_rate,x,y,heading\n{rows}");
        reads("drive.csv", &text, |path| Inputs::read(path, &model)).unwrap()
    };
    let rest = "1,2,0.25,,NaN,\n2,3,0,inf,6,0.8\n2,3,0,9,6,0.8\n";
    let whole = read(&format!("0,1,0.5,3,4,0.7\n{rest}"));
    assert_eq!((whole.time, &whole.columns[0]), (vec![0.0, 1.0, 2.0], &vec![1.0, 2.0, 3.0]));
    assert_eq!(whole.pose.map(|p| [p.x, p.y, p.heading]), Some([3.0, 4.0, 0.7]));
    assert_eq!(whole.warnings, ["1 of 4 rows is left out (repeated row: 1)"]);
    // Of the first row alone: not of the next one, and not where two rows of its time contradict each other.
    for first in ["0,1,0.5,3,,0.7\n", "0,1,0.5,3,4,0.7\n0,1,0.5,3,5,0.7\n"] {
        let part = read(&format!("{first}{rest}"));
        assert_eq!((part.pose, part.time.len()), (None, 3), "{first}");
        assert!(part.warnings[1].contains("it begins at the origin"), "{:?}", part.warnings);
    }
    let twice = read(&format!("0,1,0.5,3,4,0.7\n0,1,0.5,3,,0.7\n{rest}"));
    assert_eq!(twice.pose.map(|p| p.y), Some(4.0));
}

/// What is sorted or left out is told with its reason, and the pose is that of the first row in time.
#[test]
fn inputs_say_what_was_sorted_and_left_out() {
    let model = model_of("unicycle", "wheel_radius = 0.5\n");
    let text =
        "time,wheel_rate,yaw_rate,x,y,heading\n1,2,0,8,8,8\n0,1,0.5,3,4,0.7\n2,,0,,,\n3,4,inf,,,\n4,1,0,,,\n4,2,0,,,\n";
    let inputs = reads("drive.csv", text, |path| Inputs::read(path, &model)).unwrap();
    assert_eq!((inputs.time, inputs.pose.map(|p| p.x)), (vec![0.0, 1.0], Some(3.0)));
    let why = "blank or NaN cell in column \"wheel_rate\": 1, infinite value in column \"yaw_rate\": 1, \
               repeated time with conflicting values: 2";
    let sorted = "rows were out of order (1 steps back in time) and have been sorted".to_string();
    assert_eq!(inputs.warnings, [sorted, format!("4 of 6 rows are left out ({why})")]);
    assert_eq!(inputs.sha256, format!("{:x}", Sha256::digest(text)));
}

/// Trailers start as they were logged; in line with the tractor where they were not.
#[test]
fn inputs_bring_the_headings_of_trailers() {
    let model = |columns: &str| {
        let rest = format!("tractor = \"unicycle\"\nwheel_radius = 0.5\ntrailer_lengths = [1.0, 1.0]\n{columns}");
        model_of("n-trailer", &rest)
    };
    let [unseen, seen] = ["", "[columns]\ntrailer_headings = [\"heading_1\", \"heading_2\"]\n"].map(model);
    assert_eq!((unseen.trailers(), seen.trailers()), (2, 2));
    let read = |model, text: &str| reads("drive.csv", text, |path| Inputs::read(path, model)).unwrap();
    let header = "time,wheel_rate,yaw_rate,x,y,heading";
    let plain = read(&unseen, &format!("{header}\n0,1,0.5,3,4,0.7\n1,2,0.25,5,6,0.8\n"));
    assert_eq!(plain.pose.unwrap().trailer_headings, [0.7, 0.7]);
    let logged =
        read(&seen, &format!("{header},heading_1,heading_2\n0,1,0.5,3,4,0.7,0.6,0.5\n1,2,0.25,5,6,0.8,0.7,0.6\n"));
    assert_eq!(logged.pose.unwrap().trailer_headings, [0.6, 0.5]);
}

/// What stands in a pipe can be read once, and is.
#[cfg(unix)]
#[test]
fn a_pipe_is_read_once() {
    let model = model_of("unicycle", "wheel_radius = 0.5\n");
    let folder = tempfile::tempdir().unwrap();
    let pipe = folder.path().join("log.csv");
    assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    let to = pipe.clone();
    let writer = std::thread::spawn(move || {
        let text = "time,wheel_rate,yaw_rate,x,y,heading\n0,1,0.5,3,4,0.7\n1,2,0.25,5,6,0.8\n";
        std::fs::write(to, text)
    });
    let (sender, read) = std::sync::mpsc::channel();
    std::thread::spawn(move || sender.send(Run::read(&pipe, &model).map(|run| run.x).map_err(|e| e.to_string())));
    let found = read.recv_timeout(std::time::Duration::from_secs(60)).expect("the pipe was opened twice");
    assert_eq!(found, Ok(vec![3.0, 5.0]));
    writer.join().unwrap().unwrap();
}

/// A byte order mark tells the encoding, whatever is written in it.
#[test]
fn other_encodings_are_named() {
    for mark in [[0xff, 0xfe], [0xfe, 0xff]] {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("model.toml");
        std::fs::write(&path, [mark, [0x2d, 0x4e]].concat()).unwrap();
        let error = creepage::files::read_text(&path).unwrap_err().to_string();
        assert!(error.contains("is UTF-16, not UTF-8; save it again as UTF-8"), "{error}");
    }
}

/// A formula may be written with escapes; what is wrong with it is told where it stands in the file.
#[test]
fn places_in_formulas_count_what_is_written() {
    for (written, column) in
        [("it + q*)", 15), ("it + \\u0071*)", 20), ("it + \\U00000071*)", 24), ("it + \\x71*)", 18)]
    {
        let text = EFFECT.replace("\"it - u\"", &format!("\"{written}\""));
        let line = EFFECT.lines().position(|l| l.starts_with("v_t")).unwrap() + 1;
        let error = reads("effects.toml", &text, EffectsFile::read).unwrap_err().to_string();
        assert!(error.contains(&format!("effects.toml:{line}:{column}: ")), "{written}: {error}");
    }
}

/// Keys of trailers belong to vehicles that have some, and a start is given whole.
#[test]
fn keys_without_a_meaning_are_refused() {
    let read = |rest: &str| {
        let text = format!("vehicle = \"unicycle\"\n[parameters]\nwheel_radius = 0.5\n{rest}");
        reads("model.toml", &text, |path| ModelFile::read(path, &model::known(effects::all())))
    };
    let start = "[initial]\nx = 0.0\ny = 0.0\nheading = 0.0\n";
    assert!(read(start).is_ok());
    for (rest, why) in [
        ("[columns]\ntrailer_headings = [\"a\"]".to_string(), "unknown key \"trailer_headings\""),
        (format!("{start}trailer_headings = [0.0]"), "unknown key \"trailer_headings\""),
        (start.replace("x = 0.0\n", ""), "key \"x\" in [initial] is missing"),
    ] {
        let error = read(&rest).unwrap_err().to_string();
        assert!(error.contains(why), "{rest}: {error}");
    }
}

/// Whole numbers may be written in any radix, and be larger than a machine's.
#[test]
fn whole_numbers_are_read_in_any_radix() {
    for (written, value) in [("16", 16.0), ("0x10", 16.0), ("0b101", 5.0), ("0o17", 15.0), ("1_000", 1000.0)] {
        assert_eq!(model_of("unicycle", &format!("wheel_radius = {written}\n")).parameters["wheel_radius"], value);
    }
}

/// A type of constraint of a user's own is what its table says, slots and all.
#[test]
fn a_type_of_constraint_is_what_its_file_says() {
    let table = "type = { id = \"cable\", letter = \"C\", form = \"pays' - (1 - e)*drum*turns'\", creep = \"slip of the rope\", \
                 meaning = \"the rope follows the drum\", source = \"a note of mine\", latex = \"\\\\dot p\", gives = \"turns'\", \
                 singular = \"drum\", printed = \"row\", regimes = \"rotation\", slots = [{ name = \"drum\", meaning = \"its radius\", \
                 unit = \"m\", latex = \"R\" }, { name = \"turns'\", optional = true }] }";
    let plain = "type = { id = \"cable\", letter = \"C\", form = \"pays' - (1 - e)*drum*turns'\", creep = \"slip of the rope\" }";
    let kind = |line: &str| {
        assert!(bad_vehicles::ROPE.contains(plain));
        let text = bad_vehicles::ROPE.replace(plain, line);
        let file = reads("vehicles.toml", &text, VehiclesFile::read).unwrap();
        file.vehicles[0].vehicle.constraints[0].form.kind().clone()
    };
    let full = kind(table);
    assert_eq!((full.id.as_str(), full.letter, full.meaning.as_str()), ("cable", 'C', "the rope follows the drum"));
    assert_eq!((full.source.as_str(), full.latex.as_deref()), ("a note of mine", Some("\\dot p")));
    assert_eq!(full.creep, "slip of the rope");
    assert_eq!((full.gives, full.singular), (Some(Symbol::new("turns'")), Some(Symbol::new("drum"))));
    assert_eq!((full.printed, full.regimes), (Printed::Row, Regimes::Rotation));
    let slots: Vec<_> = full.slots.iter().map(|s| (s.name.to_string(), s.meaning.as_str(), s.optional)).collect();
    assert_eq!(slots, [("drum".into(), "its radius", false), ("turns'".into(), "", true), ("pays'".into(), "", false)]);
    assert_eq!((full.slots[0].unit.as_deref(), full.slots[0].latex.as_deref()), (Some("m"), Some("R")));
    let bare = kind(plain);
    assert_eq!((bare.source.as_str(), bare.latex, bare.gives, bare.singular), ("", None, None, None));
    assert_eq!((bare.printed, bare.regimes), (Printed::Form, Regimes::None));
    for (bad, why) in [
        (plain.replace("\"C\"", "\"CC\""), "letter must be one capital letter"),
        (plain.replace("\"C\"", "\"c\""), "letter must be one capital letter"),
        (plain.replace("\"C\"", "\"R\""), "R is the letter of the type"),
        (table.replace("\"turns'\", optional", "\"drum\", optional"), "the slot drum is named twice"),
        (table.replace("gives = \"turns'\"", "gives = \"turn\""), "the form has no slot \"turn\""),
    ] {
        let text = bad_vehicles::ROPE.replace(plain, &bad);
        let error = reads("vehicles.toml", &text, VehiclesFile::read).unwrap_err().to_string();
        assert!(error.contains(why), "{bad}: {error}");
    }
}

/// A measured log, the model and a specification are not written over by what is made of them.
#[test]
fn an_output_that_is_an_input_is_refused() {
    let dir = tempfile::tempdir().unwrap();
    let dir = dir.path();
    let model = "vehicle = \"unicycle\"\n[parameters]\nwheel_radius = 0.5\n";
    let log = "time,wheel_rate,yaw_rate\n0,1,0\n1,1,0\n2,1,0\n";
    let spec = "model = \"model.toml\"\nduration = 2.0\nevery = 1.0\n[inputs]\nlog = \"in.csv\"\n\
                wheel_rate = \"log.wheel_rate\"\nyaw_rate = \"0\"\n[grid]\nwheel_radius = [0.4, 0.5]\n";
    let files = [("model.toml", model), ("in.csv", log), ("sweep.toml", spec)];
    files.iter().for_each(|(name, text)| std::fs::write(dir.join(name), text).unwrap());
    std::fs::create_dir(dir.join("sub")).unwrap();
    let said = |arguments: &[&str]| {
        let output =
            std::process::Command::new(env!("CARGO_BIN_EXE_creepage")).current_dir(dir).args(arguments).output();
        let output = output.unwrap();
        (output.status.code(), String::from_utf8(output.stderr).unwrap())
    };
    for out in ["in.csv", "model.toml", "sub/../in.csv"] {
        let (code, text) = said(&["simulate", "model.toml", "--inputs", "in.csv", "--out", out]);
        assert!(code == Some(2) && text.contains("would be overwritten"), "{out}: {text}");
    }
    for out in ["in.csv", "model.toml", "sweep.toml"] {
        let (code, text) = said(&["sweep", "sweep.toml", "--out", out]);
        assert!(code == Some(2) && text.contains("would be overwritten"), "{out}: {text}");
    }
    for (name, text) in files {
        assert_eq!(std::fs::read_to_string(dir.join(name)).unwrap(), text);
    }
    assert_eq!(said(&["simulate", "model.toml", "--inputs", "in.csv", "--out", "out.csv"]).0, Some(0));
    assert_eq!(said(&["sweep", "sweep.toml", "--out", "table.csv"]).0, Some(0));
}
