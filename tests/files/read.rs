//! Model files and logs that are good, or good enough.

use crate::bad_inputs::{CSV, MODEL};
use crate::known;
use creepage::files::{EffectEntry, InputTiming, ModelFile, Run, write_whole};
use proptest::prelude::*;
use std::f64::consts::TAU;

fn model(text: &str) -> ModelFile {
    ModelFile::parse(text, "model.toml", &known::known()).unwrap_or_else(|e| panic!("{e}\n{text}"))
}

fn run(model: &ModelFile, csv: impl AsRef<[u8]>) -> Run {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("run.csv");
    write_whole(&path, csv.as_ref()).unwrap();
    Run::read(path, model).unwrap_or_else(|e| panic!("{e}"))
}

const WHOLE: &str = r#"
vehicle = "n-trailer" # two trailers
input_timing = "interval-mean"
[parameters]
tractor = "unicycle"
wheel_radius = 1
trailer_lengths = [3, 2.5]
[columns]
time = " t "
speed = "v"
trailer_headings = ["a", "b"]
[sensor]
lever_arm = [0.5, -0.25]
[initial]
x = 1
y = 2
heading = 3
[noise]
position = 0.01
[[effects]]
id = "rotation-creep"
e_rc = 0.125
[[effects]]
trailer = 2
id = "trailer-traverse-creep"
e_tc = -0.5
"#;

#[test]
fn a_whole_model_file_is_read() {
    let model = model(WHOLE);
    assert_eq!((model.vehicle.as_str(), model.tractor.as_deref()), ("n-trailer", Some("unicycle")));
    assert_eq!(model.input_timing, InputTiming::IntervalMean);
    assert_eq!(model.parameters, [("wheel_radius".to_string(), 1.0)].into());
    assert_eq!((model.trailer_lengths, model.hitch_offsets), (vec![3.0, 2.5], vec![0.0, 0.0]));
    assert_eq!((model.columns.time.as_str(), model.columns.x.as_str(), &model.columns.heading), ("t", "x", &None));
    let inputs: Vec<_> = model.columns.inputs.iter().map(|i| (i.role.as_str(), i.column.as_str())).collect();
    assert_eq!(inputs, [("speed", "v"), ("yaw_rate", "yaw_rate")]);
    assert_eq!((model.sensor.lever_arm, model.sensor.heading_offset), ([0.5, -0.25], 0.0));
    let initial = model.initial.unwrap();
    assert_eq!((initial.x, initial.y, initial.heading, initial.trailer_headings), (1.0, 2.0, 3.0, vec![3.0, 3.0]));
    assert_eq!((model.noise.position, model.noise.heading), (Some(0.01), None));
    assert_eq!((model.effects[0].line, model.effects[1].line, model.effects[1].trailer), (20, 23, Some(2)));
    assert_eq!(model.effects[1].parameters["e_tc"], -0.5);
}

#[test]
fn what_is_left_out_has_its_default() {
    let model =
        model("vehicle = \"n-trailer\"\nparameters = { wheel_radius = 1, wheelbase = 2, trailer_lengths = [3] }");
    assert_eq!((model.tractor.as_deref(), model.input_timing), (Some("car"), InputTiming::Sample));
    assert!(model.initial.is_none() && model.effects.is_empty() && model.columns.trailer_headings.is_empty());
    assert_eq!((model.columns.time, model.columns.inputs[1].column.as_str()), ("time".into(), "steering_angle"));
}

#[test]
fn offsets_may_be_negative_and_optional_parameters_absent() {
    let sleigh = model("vehicle = \"sleigh\"\n[parameters]\nmass = 1\ninertia = 1\nmass_offset = -0.5\n");
    assert_eq!(sleigh.parameters["mass_offset"], -0.5);
    let car = "vehicle = \"four-wheel-car\"\n[parameters]\nwheel_radius = 1\nwheelbase = 2\n";
    assert_eq!(model(car).parameters.len(), 2);
    assert_eq!(model(&format!("{car}track_width = 1.5\n")).parameters["track_width"], 1.5);
}

#[test]
fn marks_and_windows_lines_change_nothing() {
    let windows = |text: &str| format!("\u{feff}{}", text.replace('\n', "\r\n"));
    let (plain, other) = (model(MODEL), model(&windows(MODEL)));
    assert_eq!((&plain.columns, &plain.parameters), (&other.columns, &other.parameters));
    let csv = std::str::from_utf8(CSV).unwrap();
    let (a, b) = (run(&plain, csv), run(&other, windows(csv)));
    assert_eq!((a.time, a.heading, a.inputs), (b.time, b.heading, b.inputs));
}

#[test]
fn a_header_may_be_quoted_and_spaced() {
    let run = run(
        &model(MODEL),
        "\"t\", x ,\"y\",note, phi, \"speed\" ,yaw_rate\n 0 ,\"1\",2,\"a,\nb\",3,4,5\n1,1,2,,3,4,5\n",
    );
    assert_eq!((run.time, run.x, run.roles), (vec![0.0, 1.0], vec![1.0, 1.0], vec!["speed".into(), "yaw_rate".into()]));
    assert_eq!(run.inputs, [[4.0, 4.0], [5.0, 5.0]]);
}

#[test]
fn a_log_may_have_no_heading() {
    let text = MODEL.replace("heading = \"phi\"\n", "");
    assert_eq!(run(&model(&text), CSV).heading, None);
    let csv = std::str::from_utf8(CSV).unwrap().replace("phi", "heading");
    assert_eq!(run(&model(&text), csv).heading, Some(vec![0.0; 3]));
}

#[test]
fn rows_that_cannot_be_used_are_counted() {
    let csv = "t,x,y,phi,wheel_rate,yaw_rate\n\
        0,0,0,0,1,0\n1,,0,0,1,0\n2,NaN,0,0,1,0\n3,0,0,0,null,0\n4,0,0,-inf,1,0\n4.5,inf,0,0,,0\n\
        5,0,0,0,1,0\n5,0,0,0,1,0\n6,0,0,0,1,0\n6,0,0,0,2,0\n7,0,0,0,1,0\n7,NA,0,0,9,0\n";
    let run = run(&model(MODEL), csv);
    assert_eq!((run.time, run.rows_dropped, run.warnings.len()), (vec![0.0, 5.0, 7.0], 9, 0));
    let expect = [
        ("blank or NaN cell in column \"wheel_rate\"", 1),
        ("blank or NaN cell in column \"x\"", 3),
        ("infinite value in column \"phi\"", 1),
        // The first reason of a row counts.
        ("infinite value in column \"x\"", 1),
        ("repeated row", 1),
        ("repeated time with conflicting values", 2),
    ];
    assert_eq!(run.why_dropped, expect.map(|(why, rows)| (why.to_string(), rows)).into());
}

#[test]
fn rows_out_of_order_are_sorted_with_a_warning() {
    let rows = "2,0,0,0.2,3,0\n0,0,0,0,1,0\n1,0,0,0.1,2,0\n";
    let run = run(&model(MODEL), format!("t,x,y,phi,wheel_rate,yaw_rate\n{rows}"));
    assert_eq!((run.time, &run.inputs[0]), (vec![0.0, 1.0, 2.0], &vec![1.0, 2.0, 3.0]));
    assert_eq!(run.heading.unwrap(), [0.0, 0.1, 0.2]);
    assert_eq!(run.warnings, ["rows were out of order (1 steps back in time) and have been sorted"]);
}

#[test]
fn headings_are_unwrapped_and_inputs_are_not() {
    let text = WHOLE.replace("speed = \"v\"", "speed = \"v\"\nheading = \"h\"");
    let csv = "t,x,y,h,a,b,v,yaw_rate\n0,0,0,3,-3,0,3,0\n1,0,0,,3,1,-3,0\n2,0,0,-3,3,6,-3,0\n";
    let run = run(&model(&text), csv);
    assert_eq!(run.heading.unwrap(), [3.0, TAU - 3.0]);
    assert_eq!(run.trailer_headings, [[-3.0, 3.0 - TAU], [0.0, 6.0 - TAU]]);
    // The row without a heading has inputs all the same.
    assert_eq!(run.inputs[0], [3.0, -3.0, -3.0]);
    assert_eq!((run.time, run.apart.unwrap().time), (vec![0.0, 2.0], vec![0.0, 1.0, 2.0]));
}

fn entries() -> impl Strategy<Value = Vec<EffectEntry>> {
    let value = || prop_oneof![-1.0..=1.0f64, Just(5e-324), Just(-0.0), Just(1.0 / 3.0)];
    let entry = |id: &'static str, trailer, values: Vec<(&'static str, f64)>| EffectEntry {
        id: id.into(),
        trailer,
        parameters: values.into_iter().map(|(name, value)| (name.to_string(), value)).collect(),
        ..EffectEntry::default()
    };
    prop::collection::vec(
        prop_oneof![
            value().prop_map(move |e| entry("rotation-creep", None, vec![("e_rc", e)])),
            (value(), value()).prop_map(move |(a, b)| entry("lever-arm", None, vec![("a", a), ("b", b)])),
            (1..=2usize, value()).prop_map(move |(n, e)| entry("trailer-traverse-creep", Some(n), vec![("e_tc", e)])),
        ],
        0..5,
    )
}

/// The entries a model has after adding: the file's own first, the last word on each target.
fn merged(old: &[EffectEntry], added: &[EffectEntry]) -> Vec<EffectEntry> {
    let last = |entry: &EffectEntry| added.iter().rev().find(|a| a.same_target(entry)).cloned();
    let mut all: Vec<_> = old.iter().map(|e| last(e).unwrap_or_else(|| e.clone())).collect();
    for (i, entry) in added.iter().enumerate() {
        let again = added[i + 1..].iter().any(|later| later.same_target(entry));
        if !again && !old.iter().any(|e| e.same_target(entry)) {
            all.push(entry.clone());
        }
    }
    all.iter_mut().for_each(|entry| entry.line = 0);
    all
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..Default::default() })]
    #[test]
    fn a_patched_file_is_the_same_model_with_the_effects(added in entries(), style in 0..4usize) {
        let inline = WHOLE.split("[[effects]]").next().unwrap().replace(
            "[parameters]",
            "effects = [ # mine\n  {id='lever-arm', b=1, a=0}, # why\n  ]\n[parameters]",
        );
        let text = match style {
            0 => WHOLE.to_string(),
            1 => WHOLE.trim_end().replace('\n', "\r\n"),
            2 => inline,
            _ => inline.replace("{id='lever-arm', b=1, a=0}, # why", ""),
        };
        let before = model(&text);
        let after = model(&before.patched(&added));
        let found: Vec<_> = after.effects.iter().map(|e| EffectEntry { line: 0, ..e.clone() }).collect();
        prop_assert_eq!(found, merged(&before.effects, &added));
        let rest = ModelFile { text: before.text.clone(), sha256: before.sha256.clone(), effects: before.effects.clone(), ..after.clone() };
        prop_assert_eq!(&rest, &before);
        for comment in text.lines().filter(|line| line.contains('#')) {
            prop_assert!(after.text.contains(comment.rsplit('#').next().unwrap()));
        }
    }
}
