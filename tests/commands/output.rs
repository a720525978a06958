//! What commands write, on the screen and into files, as a person has read and accepted it.

use crate::digits::in_four_digits;
use crate::reviewed::reviewed;
use std::path::Path;
use std::process::Command;
use tempfile::TempDir;

/// Rows of a long table that are shown.
const ROWS: usize = 12;

/// Runs commands one after the other in a folder with these files and the examples, and has what they say and write
/// reviewed.
#[track_caller]
fn session(name: &str, files: &[(&str, &str)], commands: &[&str]) {
    let folder = TempDir::new().unwrap();
    std::os::unix::fs::symlink(concat!(env!("CARGO_MANIFEST_DIR"), "/examples"), folder.path().join("examples"))
        .unwrap();
    for (file, text) in files {
        std::fs::write(folder.path().join(file), text).unwrap();
    }
    let mut text = String::new();
    for line in commands {
        let before = listed(folder.path());
        let words = line.split(' ').filter(|w| !w.is_empty());
        let made = Command::new(env!("CARGO_BIN_EXE_creepage")).current_dir(&folder).args(words).output().unwrap();
        let said = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
        text += &format!("$ creepage {line}\n{}{}", said(made.stdout), said(made.stderr));
        if !made.status.success() {
            text += &format!("exit code {:?}\n", made.status.code());
        }
        for file in listed(folder.path()).into_iter().filter(|f| !before.contains(f)) {
            let written = std::fs::read_to_string(folder.path().join(&file)).unwrap();
            text += &format!("-- {file} --\n{}", shown(&file, &written));
        }
        text.push('\n');
    }
    reviewed(&format!("commands-{name}"), &in_four_digits(&text));
}

/// The files of a folder and of those in it, in order; not the examples.
fn listed(folder: &Path) -> Vec<String> {
    let mut found = vec![];
    for entry in std::fs::read_dir(folder).unwrap().map(Result::unwrap) {
        let name = entry.file_name().into_string().unwrap();
        match entry.file_type().unwrap() {
            kind if kind.is_dir() => found.extend(listed(&entry.path()).iter().map(|inner| format!("{name}/{inner}"))),
            kind if kind.is_file() => found.push(name),
            _ => {}
        }
    }
    found.sort();
    found
}

/// A table with its head, some of its rows and its end; a drawing without its style, one element a line.
fn shown(file: &str, text: &str) -> String {
    if let Some((_, drawing)) = text.split_once("</style>").filter(|_| file.ends_with(".svg")) {
        return drawing.replace("><", ">\n<");
    }
    let lines: Vec<&str> = text.lines().collect();
    if !file.ends_with(".csv") || lines.len() <= 2 * ROWS {
        return text.to_string();
    }
    let stride = lines.len() / ROWS;
    let kept = (0..lines.len()).filter(|i| *i == 0 || i % stride == 1 || i + 1 == lines.len());
    kept.map(|i| format!("{}\n", lines[i])).collect::<String>() + &format!("… of {} lines\n", lines.len())
}

#[test]
fn files_to_begin_with() {
    session(
        "init",
        &[("odd.csv", "stamp,pos_x [m],pos_y [m],yaw,v,steer,odo\n0,0,0,0,1,0.1,0\n0.1,0.1,0,0,1,0.1,0.1\n")],
        &[
            "init differential-drive --out a.toml",
            "init car --from odd.csv --out b.toml",
            "init n-trailer --tractor tricycle --trailers 2 --out c.toml",
            "init unicycle --from examples/runs/cornering/eights.csv --out d.toml",
            "init differential-drive --from examples/runs/clocks/inputs.csv --truth examples/runs/clocks/poses.csv --out e.toml",
            "init articulated-bus --vehicles examples/bus/bus.toml --out f.toml",
            "init skid-steer --out a.toml",
        ],
    );
}

/// A train that brakes and backs, its hitches off the axles.
const TRAIN: &str = r#"vehicle = "n-trailer"
[parameters]
tractor = "car"
wheel_radius = 0.5
wheelbase = 3.8
trailer_lengths = [4.0, 5.5]
hitch_offsets = [0.6, 0.0]
[initial]
x = 1.0
y = -2.0
heading = 0.4
trailer_headings = [0.3, 0.1]
[[effects]]
id = "understeer"
gradient = 0.004
[[effects]]
id = "trailer-traverse-creep"
trailer = 2
e_tc = 0.05
[[effects]]
id = "input-delay"
delay = 0.15
[sensor]
lever_arm = [0.5, 0.25]
heading_offset = 0.02
"#;

/// Its inputs: rows that are not evenly spaced.
fn inputs() -> String {
    let row = |i: i32| {
        let t = 0.1 * f64::from(i) + if i % 3 == 1 { 0.02 } else { 0.0 };
        format!("{t},{},{}\n", 6.0 * (0.4 * t).cos(), 0.2 * (0.7 * t).sin())
    };
    "time,wheel_rate,steering_angle\n".to_string() + &(0..80).map(row).collect::<String>()
}

#[test]
fn paths() {
    let mean = TRAIN.replace("[parameters]", "input_timing = \"interval-mean\"\n[parameters]");
    session(
        "simulate",
        &[("train.toml", TRAIN), ("mean.toml", &mean), ("in.csv", &inputs())],
        &[
            "simulate train.toml --inputs in.csv --out train.csv",
            "simulate mean.toml --inputs in.csv --out mean.csv --rtol 1e-6 --atol 1e-6",
            "simulate examples/runs/pair/model.toml --inputs examples/runs/pair/eights.csv --out pair.csv",
            "simulate examples/dynamics/car.toml --inputs examples/dynamics/drive.csv --out car.csv",
            "simulate examples/dynamics/sleigh.toml --inputs examples/dynamics/times.csv --out sleigh.csv",
        ],
    );
}

/// Trailers, a log and formulas, a row each half second, samples of three kinds.
const SWEEP: &str = r#"model = "train.toml"
duration = 4.0
every = 0.5
[inputs]
log = "in.csv"
wheel_rate = "share*log.wheel_rate"
steering_angle = "log.steering_angle + bias*sin(t)"
[constants]
bias = 0.01
[grid]
share = [0.5, 1.0]
understeer.gradient = { from = 0.0, to = 0.008, count = 3 }
[sample]
count = 2
seed = 5
[sample.of]
wheelbase = { normal = [3.8, 0.05] }
initial.x = { uniform = [-1.0, 1.0] }
"#;

#[test]
fn sweeps() {
    let every = SWEEP.replace("every = 0.5", "");
    session(
        "sweep",
        &[("train.toml", TRAIN), ("in.csv", &inputs()), ("sweep.toml", SWEEP), ("last.toml", &every)],
        &[
            "sweep sweep.toml --out all.csv",
            "sweep last.toml --out last.csv",
            "sweep last.toml --out second.csv --shard 2/2",
            "sweep examples/sweeps/wheels.toml --out wheels.csv",
        ],
    );
}

#[test]
fn descriptions() {
    let creeping = "vehicle = \"unicycle\"\n[parameters]\nwheel_radius = 0.3\n[[effects]]\nid = \"rotation-creep\"\ne_rc = 0.25\n\
                    [[effects]]\nid = \"traverse-creep\"\ne_tc = -0.05\n";
    let hopper = "vehicle = \"hopper\"\n[parameters]\nbody_inertia = 2.0\nleg_mass = 0.5\nleg_offset = 0.1\n";
    session(
        "describe",
        &[("creeping.toml", creeping), ("train.toml", TRAIN), ("hopper.toml", hopper)],
        &[
            "describe creeping.toml --rotation-limits=-0.2,0.2 --traverse-limits=-0.1,0.1",
            "describe train.toml",
            "describe hopper.toml",
            "describe examples/bus/model.toml",
            "describe examples/dynamics/sleigh.toml",
        ],
    );
}

/// The schematic figures with both creeps of the other sign, and what else "conservative" may mean.
#[test]
fn drawings() {
    session(
        "figures",
        &[],
        &[
            "figures fig1 fig2 fig3 fig4 fig5 fig6 --e-rc=-0.3 --e-tc=-0.2 --out negative",
            "figures fig1 fig2 fig5 --e-rc 0 --e-tc 0 --out zero",
            "figures fig7 --reading B --out reading",
            "figures fig7 fig5 --reading C1 --e-tc 0.4 --out other",
        ],
    );
}

/// Figures as PDF and PNG where the program has the feature; where it has not, a message that says how to get it.
#[test]
fn drawings_as_pdf_and_png() {
    let folder = TempDir::new().unwrap();
    let asked = |form: &str| {
        let arguments = ["figures", "fig1", "fig7", "--format", form, "--out", "out"];
        Command::new(env!("CARGO_BIN_EXE_creepage")).args(arguments).current_dir(folder.path()).output().unwrap()
    };
    for (form, magic) in [("pdf", &b"%PDF-"[..]), ("png", b"\x89PNG\r\n")] {
        let output = asked(form);
        if cfg!(feature = "drawings") {
            assert!(output.status.success(), "{output:?}");
            let read = |name: &str| std::fs::read(folder.path().join("out").join(name)).unwrap();
            for figure in ["fig1", "fig7"] {
                let drawn = read(&format!("{figure}.{form}"));
                // A sheet with nothing on it would be smaller.
                assert!(drawn.starts_with(magic) && drawn.len() > 8_000, "{figure}.{form}: {} bytes", drawn.len());
            }
            assert!(!folder.path().join("out/fig1.svg").exists() && !read("fig1.csv").is_empty());
        } else {
            assert_eq!(output.status.code(), Some(2), "{output:?}");
            let said = String::from_utf8_lossy(&output.stderr);
            assert!(said.contains("--features drawings") && !folder.path().join("out").exists(), "{said}");
        }
    }
}
