//! A run whose inputs and poses are files of their own: nothing of either is lost, whichever poses are taken.

use creepage::files::{Clock, ModelFile, Run};
use creepage::{effects, model};
use sha2::{Digest, Sha256};

const MODEL: &str = "\
vehicle = \"n-trailer\"
[parameters]
tractor = \"unicycle\"
wheel_radius = 1.0
trailer_lengths = [1.0]
[columns]
trailer_headings = [\"heading_1\"]
";

fn model() -> ModelFile {
    ModelFile::parse(MODEL, "model.toml", &model::known(effects::all())).unwrap()
}

/// Inputs every tenth of a second, poses between them; one row of each has a blank cell.
fn texts() -> [String; 2] {
    let time = |i: i32| 100.0 + 0.1 * f64::from(i);
    let input = |i: i32| format!("{},{},{}\n", time(i), if i == 7 { String::new() } else { i.to_string() }, 2 * i);
    let pose = |i: i32| {
        let x = if i == 4 { String::new() } else { format!("{}", 10 + i) };
        format!("{},{x},{},{},{}\n", time(i) + 0.05, 20 + i, 0.1 * f64::from(i), 0.2 * f64::from(i))
    };
    [
        format!("time,wheel_rate,yaw_rate\n{}", (0..20).map(input).collect::<String>()),
        format!("time,x,y,heading,heading_1\n{}", (0..16).map(pose).collect::<String>()),
    ]
}

fn read() -> Run {
    let folder = tempfile::tempdir().unwrap();
    let [inputs, poses] = ["in.csv", "poses.csv"].map(|name| folder.path().join(name));
    let [driven, seen] = texts();
    std::fs::write(&inputs, driven).unwrap();
    std::fs::write(&poses, seen).unwrap();
    Run::read_apart(&inputs, &poses, &model()).unwrap()
}

#[test]
fn both_files_are_told_apart() {
    let run = read();
    let hash = |text: &str| format!("{:x}", Sha256::digest(text.as_bytes()));
    let apart = run.apart.as_ref().unwrap();
    assert_eq!([run.sha256.clone(), apart.truth_sha256.clone()], texts().map(|t| hash(&t)));
    assert_eq!((run.time.len(), apart.time.len(), apart.one_clock), (15, 19, false));
    assert_eq!(run.roles, ["wheel_rate", "yaw_rate"]);
    assert_eq!((run.inputs[0][6], run.inputs[0][7], run.inputs[1][7]), (6.0, 8.0, 16.0));
    let blank = |column: &str| (format!("blank or NaN cell in column \"{column}\""), 1);
    assert_eq!(run.why_dropped, [blank("wheel_rate"), blank("x")].into());
    assert_eq!(run.rows_dropped, 2);
}

/// Every column is cut alike, the headings of trailers among them.
#[test]
fn the_beginning_is_a_share_of_the_time() {
    let run = read();
    // From 100.05 to 101.55 s, without 100.45: up to 100.65 and up to the end.
    for (share, rows) in [(0.41, 6), (1.0, 15), (0.0, 1)] {
        let begun = run.beginning(share);
        let heading = begun.heading.as_ref().unwrap();
        let lengths = [&begun.time, &begun.x, &begun.y, heading, &begun.trailer_headings[0]].map(Vec::len);
        assert_eq!(lengths, [rows; 5], "{share}");
        assert_eq!((&begun.inputs, begun.rows_dropped), (&run.inputs, 2), "{share}");
    }
}

/// Poses that have inputs around them stay, and nothing is said of poses that were not left out.
#[test]
fn aligned_runs_keep_what_has_inputs() {
    let run = read();
    let same = run.aligned(&Clock { offset: 0.0, drift: 0.0, at: 0.0 });
    assert_eq!((same.time.as_slice(), &same.why_dropped), (run.time.as_slice(), &run.why_dropped));
    let later = run.aligned(&Clock { offset: 0.2, drift: 0.0, at: 0.0 });
    assert_eq!((later.time.len(), later.trailer_headings[0].len(), later.rows_dropped), (13, 13, 4));
    assert!((later.trailer_headings[0][0] - 0.4).abs() < 1e-12, "{:?}", later.trailer_headings);
}
