//! `creepage export`: parameters read back, and code compiled and run against `simulate`.

use crate::program::{creepage, stderr};
use serde_json::Value;
use std::fmt::Write;
use std::path::Path;
use std::process::Command;
use tempfile::TempDir;

const DRIVE: &str = "vehicle = \"differential-drive\"\n[parameters]\nwheel_radius = 0.06\ntrack_width = 0.32\n";
const CAR: &str = "vehicle = \"car\"\n[parameters]\nwheel_radius = 0.3\nwheelbase = 2.6\n";

fn effect(id: &str, values: &[(&str, f64)]) -> String {
    let values: String = values.iter().map(|(name, v)| format!("{name} = {v:?}\n")).collect();
    format!("[[effects]]\nid = \"{id}\"\n{values}")
}

fn folder(model: &str) -> TempDir {
    let dir = tempfile::tempdir().unwrap();
    std::fs::write(dir.path().join("model.toml"), model).unwrap();
    dir
}

/// What is written, what is said beside, and the exit code.
fn exported(model: &str, target: &str, more: &[&str]) -> (String, String, Option<i32>) {
    let dir = folder(model);
    let output = creepage(dir.path(), &[&["export", "model.toml", "--as", target], more].concat());
    (String::from_utf8(output.stdout.clone()).unwrap(), stderr(&output), output.status.code())
}

/// The value of a line `name: value`.
fn line(text: &str, name: &str) -> f64 {
    let found = text.lines().find_map(|l| l.trim().strip_prefix(&format!("{name}: ")));
    found.unwrap_or_else(|| panic!("no {name} in {text}")).parse().unwrap()
}

#[test]
fn a_controller_gets_its_numbers() {
    let creeps = [
        effect("track-width", &[("scale", 0.035)]),
        effect("wheel-radius-mismatch", &[("scale", -0.01)]),
        effect("rotation-creep", &[("e_rc", 0.02)]),
    ];
    let model = format!("{DRIVE}{}", creeps.concat());
    let (yaml, said, code) = exported(&model, "ros2-diff-drive", &[]);
    assert_eq!((code, said.as_str()), (Some(0), ""));
    assert_eq!((line(&yaml, "wheel_separation"), line(&yaml, "wheel_radius")), (0.32, 0.06));
    let multipliers = ["wheel_separation", "left_wheel_radius", "right_wheel_radius"];
    let found = multipliers.map(|name| line(&yaml, &format!("{name}_multiplier")));
    for (found, wanted) in found.into_iter().zip([1.035, 0.99 * 0.98, 0.98]) {
        assert!((found - wanted).abs() < 1e-15, "{found} {wanted}");
    }
    let java = exported(&model, "wpilib", &[]).0;
    assert!(java.contains("public static final double kTrackwidthMeters = 0.3312;"), "{java}");
    let json: Value = serde_json::from_str(&exported(&model, "json", &[]).0).unwrap();
    assert_eq!(json["corrections"]["wheel_separation_multiplier"], 1.035);
}

/// A VESC turns a wanted speed into a motor's, and a wanted angle into a servo's: commanded so, the vehicle does what is wanted.
#[test]
fn a_vesc_does_what_is_wanted() {
    let car = [
        effect("wheel-radius", &[("scale", 0.05)]),
        effect("steering-gain", &[("scale", 0.1)]),
        effect("steering-offset", &[("offset", 0.02)]),
        effect("wheelbase", &[("scale", -0.02)]),
    ];
    let model = format!("{CAR}{}", car.concat());
    let given = [
        "--speed-to-erpm-gain",
        "4000",
        "--steering-angle-to-servo-gain=-1.2",
        "--steering-angle-to-servo-offset",
        "0.53",
    ];
    let (yaml, said, code) = exported(&model, "vesc", &given);
    assert_eq!((code, said.as_str()), (Some(0), ""), "{said}");
    let of = |name: &str| line(&yaml, name);
    // The vehicle drives 1.05 times what the old gain says, and steers to 1.1·δ + 0.02.
    assert!((of("speed_to_erpm_gain") * 1.05 - 4000.0).abs() < 1e-9);
    for wanted in [-0.3, 0.0, 0.2] {
        let servo = of("steering_angle_to_servo_gain") * wanted + of("steering_angle_to_servo_offset");
        let logged = (servo - 0.53) / -1.2;
        assert!((1.1 * logged + 0.02 - wanted).abs() < 1e-12, "{wanted} {logged}");
    }
    assert!((of("wheelbase") - 2.6 * 0.98).abs() < 1e-12);
    // Gains that are not given stand as factors.
    assert!(exported(&model, "vesc", &[]).0.contains("# speed_to_erpm_gain: the one you have, times"));
    let ros = exported(&model, "ros2-steering", &[]);
    assert_eq!(ros.2, Some(3));
    assert!(
        (line(&ros.0, "wheelbase") - 2.548).abs() < 1e-12 && ros.0.contains("put it into the steering joint"),
        "{ros:?}"
    );
}

#[test]
fn what_a_target_cannot_say_is_said() {
    let slides = effect("cornering-creep", &[("mass_over_bT", 0.11)]);
    let part = "[[effects]]\nid = \"track-width\"\nscale = 0.1\nscope = { from = 3.0 }\n";
    let tracked = effect("lever-arm", &[("a", 0.1), ("b", -0.05)]);
    let (yaml, said, code) = exported(&format!("{DRIVE}{slides}{part}{tracked}"), "ros2-diff-drive", &[]);
    assert_eq!(code, Some(3));
    for effect in ["cornering-creep: mass_over_bT = 0.11", "track-width: scale = 0.1, from 3"] {
        assert!(yaml.contains(&format!("# no place here for {effect}")) && said.contains(effect), "{yaml}\n{said}");
    }
    assert_eq!(line(&yaml, "wheel_separation_multiplier"), 1.0);
    assert!(yaml.contains("static_transform_publisher --x 0.1 --y -0.05"), "{yaml}");
    let (_, said, code) = exported(CAR, "ros2-diff-drive", &[]);
    assert!(code == Some(2) && said.contains("the model is a car"), "{said}");
    let (code, said, _) = exported(&format!("{DRIVE}{part}"), "python", &[]);
    assert!(code.contains("# left out: track-width") && said.contains("track-width"), "{code}");
}

/// A model, constant values for its inputs, and as many seconds.
struct Drive<'a> {
    model: String,
    inputs: Vec<(&'a str, f64)>,
}

const SECONDS: f64 = 1.0;
const STEPS: usize = 4000;

fn drives() -> Vec<Drive<'static>> {
    let robot = [
        effect("track-width", &[("scale", 0.035)]),
        effect("unequal-rotation-creep", &[("e_left", 0.02), ("e_right", -0.01)]),
        effect("cornering-creep", &[("mass_over_bT", 0.11)]),
    ];
    let car = [
        effect("understeer", &[("gradient", 0.02)]),
        effect("steering-offset", &[("offset", 0.01)]),
        effect("saturating-creep", &[("c", 0.03), ("limit", 0.2)]),
        effect("side-slope", &[("rate", 0.05), ("direction", 0.7)]),
    ];
    let train = "vehicle = \"n-trailer\"\ntractor = \"unicycle\"\n[parameters]\nwheel_radius = 0.5\n\
                 trailer_lengths = [1.2, 0.8]\nhitch_offsets = [0.1, 0.0]\n";
    let creeps = format!("{}trailer = 2\n", effect("trailer-traverse-creep", &[("e_tc", 0.1)]));
    vec![
        Drive {
            model: format!("{DRIVE}{}", robot.concat()),
            inputs: vec![("wheel_rate_left", 9.0), ("wheel_rate_right", 12.5)],
        },
        Drive { model: format!("{CAR}{}", car.concat()), inputs: vec![("wheel_rate", 11.0), ("steering_angle", 0.21)] },
        Drive { model: format!("{train}{creeps}"), inputs: vec![("wheel_rate", 2.0), ("yaw_rate", 0.4)] },
    ]
}

/// The states at the beginning and at the end, as `simulate` has them.
fn simulated(folder: &Path, drive: &Drive) -> [Vec<f64>; 2] {
    let names: Vec<&str> = drive.inputs.iter().map(|(n, _)| *n).collect();
    let values: Vec<String> = drive.inputs.iter().map(|(_, v)| v.to_string()).collect();
    let rows: String = (0..=10).map(|i| format!("{},{}\n", f64::from(i) / 10.0 * SECONDS, values.join(","))).collect();
    std::fs::write(folder.join("in.csv"), format!("time,{}\n{rows}", names.join(","))).unwrap();
    let arguments =
        ["simulate", "model.toml", "--inputs", "in.csv", "--out", "path.csv", "--rtol", "1e-13", "--atol", "1e-14"];
    let output = creepage(folder, &arguments);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let text = std::fs::read_to_string(folder.join("path.csv")).unwrap();
    let header: Vec<&str> = text.lines().next().unwrap().split(',').collect();
    let is_state = |name: &str| !["time", "speed", "lateral_speed", "yaw_rate"].contains(&name);
    let row = |line: &str| -> Vec<f64> {
        header.iter().zip(line.split(',')).filter(|(name, _)| is_state(name)).map(|(_, v)| v.parse().unwrap()).collect()
    };
    [row(text.lines().nth(1).unwrap()), row(text.lines().last().unwrap())]
}

/// A program around exported code that prints the state at the end and the Jacobian of its first step.
fn program(language: &str, start: &[f64], inputs: &[f64]) -> String {
    let list = |v: &[f64]| v.iter().map(|v| format!("{v:?}")).collect::<Vec<_>>().join(", ");
    let (z, u, dt) = (list(start), list(inputs), SECONDS / STEPS as f64);
    match language {
        "python" => format!(
            "\nz, u = [{z}], [{u}]\n_, first = step(z, u, 0.1)\nfor _ in range({STEPS}):\n    z, _ = step(z, u, {dt})\n\
             print(*(repr(float(v)) for v in z))\nfor row in first:\n    print(*(repr(float(v)) for v in row))\n"
        ),
        "rust" => format!(
            "fn main() {{\n    let (mut z, u) = ([{z}], [{u}]);\n    let first = step(&z, &u, 0.1).1;\n    for _ in 0..{STEPS} {{ z = step(&z, &u, {dt}).0; }}\n    \
             for row in [&z[..]].into_iter().chain(first.iter().map(|r| &r[..])) {{\n        \
             println!(\"{{}}\", row.iter().map(|v| format!(\"{{v:?}}\")).collect::<Vec<_>>().join(\" \"));\n    }}\n}}\n"
        ),
        _ => format!(
            "#include <stdio.h>\nint main(void) {{\n    double z[] = {{{z}}}, first[] = {{{z}}}, u[] = {{{u}}};\n    \
             double f[CREEPAGE_N][CREEPAGE_N + CREEPAGE_M], other[CREEPAGE_N][CREEPAGE_N + CREEPAGE_M];\n    \
             creepage_step(first, u, 0.1, f);\n    for (int i = 0; i < {STEPS}; i++) creepage_step(z, u, {dt}, other);\n    \
             for (int i = 0; i < CREEPAGE_N; i++) printf(\"%.17g \", z[i]);\n    printf(\"\\n\");\n    \
             for (int i = 0; i < CREEPAGE_N; i++) {{ for (int j = 0; j < CREEPAGE_N + CREEPAGE_M; j++) printf(\"%.17g \", f[i][j]); printf(\"\\n\"); }}\n    \
             (void)creepage_covariance; (void)creepage_parameter_names; return 0;\n}}\n"
        ),
    }
}

/// Rows of numbers that a program prints; `None` where its compiler is not installed.
fn ran(folder: &Path, language: &str, code: &str) -> Option<Vec<Vec<f64>>> {
    let (file, compiler): (&str, &[&str]) = match language {
        "c" => ("step.c", &["cc", "-std=c99", "-O1", "-Wall", "-Wextra", "-Werror", "-o", "step", "step.c", "-lm"]),
        "cpp" => (
            "step.cpp",
            &[
                "c++",
                "-std=c++11",
                "-O1",
                "-Wall",
                "-Wextra",
                "-Werror",
                "-Wno-unused-function",
                "-o",
                "step",
                "step.cpp",
            ],
        ),
        "rust" => ("step.rs", &["rustc", "--edition", "2021", "-O", "-o", "step", "step.rs"]),
        _ => ("step.py", &["python3", "--version"]),
    };
    std::fs::write(folder.join(file), code).unwrap();
    let built = Command::new(compiler[0]).args(&compiler[1..]).current_dir(folder).output().ok()?;
    assert!(built.status.success(), "{language}: {}\n{code}", String::from_utf8_lossy(&built.stderr));
    let mut run = match language {
        "python" => Command::new("python3"),
        _ => Command::new(folder.join("step")),
    };
    if language == "python" {
        run.arg(file);
    }
    let output = run.current_dir(folder).output().unwrap();
    assert!(output.status.success(), "{language}: {}", String::from_utf8_lossy(&output.stderr));
    let text = String::from_utf8(output.stdout).unwrap();
    Some(text.lines().map(|l| l.split_whitespace().map(|v| v.parse().unwrap()).collect()).collect())
}

/// Values in the order in which the code says it takes its inputs.
fn in_order(folder: &Path, drive: &Drive) -> Vec<f64> {
    let code = String::from_utf8(creepage(folder, &["export", "model.toml", "--as", "c"]).stdout).unwrap();
    let line = code.lines().find_map(|l| l.strip_prefix("// Inputs u: ")).unwrap();
    let names = line.split(';').next().unwrap().split(", ");
    names.map(|name| drive.inputs.iter().find(|(n, _)| *n == name).unwrap().1).collect()
}

#[test]
fn exported_code_moves_as_simulate_does() {
    let mut ran_at_all = String::new();
    for drive in drives() {
        let dir = folder(&drive.model);
        let [start, end] = simulated(dir.path(), &drive);
        let inputs = in_order(dir.path(), &drive);
        let mut first: Option<Vec<Vec<f64>>> = None;
        for language in ["rust", "c", "cpp", "python"] {
            let output = creepage(dir.path(), &["export", "model.toml", "--as", language]);
            assert_eq!(output.status.code(), Some(0), "{language}: {}", stderr(&output));
            let mut code = String::from_utf8(output.stdout).unwrap();
            code += &program(language, &start, &inputs);
            let Some(found) = ran(dir.path(), language, &code) else {
                println!("{language}: no compiler here");
                continue;
            };
            let _ = write!(ran_at_all, "{language} ");
            for (found, wanted) in found[0].iter().zip(&end) {
                assert!(
                    (found - wanted).abs() < 1e-12 * (1.0 + wanted.abs()),
                    "{language}: {found} {wanted}\n{}",
                    drive.model
                );
            }
            // All languages say the same, and the same as differences of the step do.
            let reference = first.get_or_insert_with(|| found.clone());
            for (row, wanted) in found.iter().zip(reference.iter()) {
                assert!(row.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 1e-12 * (1.0 + b.abs())), "{language}");
            }
        }
        differences(dir.path(), &start, &inputs, &first.unwrap()[1..]);
    }
    assert!(ran_at_all.contains("rust"), "{ran_at_all}");
}

/// A Jacobian against central differences, by the Rust code once more.
fn differences(folder: &Path, start: &[f64], inputs: &[f64], jacobian: &[Vec<f64>]) {
    let whole: Vec<f64> = start.iter().chain(inputs).copied().collect();
    let output = creepage(folder, &["export", "model.toml", "--as", "rust"]);
    let code = String::from_utf8(output.stdout).unwrap();
    let n = start.len();
    let mut calls = String::new();
    for j in 0..whole.len() {
        for side in [-1e-5, 1e-5] {
            let mut at = whole.clone();
            at[j] += side;
            let (z, u) = at.split_at(n);
            let joined = r#".0.map(|v| v.to_string()).join(" ")"#;
            let _ = writeln!(calls, "    println!(\"{{}}\", step(&{z:?}, &{u:?}, 0.1){joined});");
        }
    }
    let text = format!("{code}fn main() {{\n{calls}}}\n");
    let rows = ran(folder, "rust", &text).unwrap();
    for j in 0..whole.len() {
        for i in 0..n {
            let slope = (rows[2 * j + 1][i] - rows[2 * j][i]) / 2e-5;
            assert!((slope - jacobian[i][j]).abs() < 1e-7 * (1.0 + slope.abs()), "{i} {j}: {slope} {}", jacobian[i][j]);
        }
    }
}

#[test]
fn the_covariance_of_a_fit_goes_with_the_code() {
    let dir = folder(&format!("{DRIVE}{}", effect("track-width", &[("scale", 0.035)])));
    std::fs::write(
        dir.path().join("fit.json"),
        r#"{"covariance": {"names": ["track-width scale"], "matrix": [[4e-6]]}}"#,
    )
    .unwrap();
    let with = |file: &str| creepage(dir.path(), &["export", "model.toml", "--as", "python", "--covariance", file]);
    let output = with("fit.json");
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.contains("PARAMETER_NAMES = [\"track-width scale\"]\nCOVARIANCE = [[4e-6]]"), "{text}");
    std::fs::write(dir.path().join("none.json"), "{}").unwrap();
    for (file, says) in
        [("none.json", "has no covariance"), ("nowhere.json", "cannot be read"), ("model.toml", "is no JSON")]
    {
        let output = with(file);
        assert_eq!(output.status.code(), Some(2));
        assert!(stderr(&output).contains(says), "{}", stderr(&output));
    }
}

/// A program around exported code that prints the inputs for a motion, then what the observer makes of measured poses.
fn on_board(language: &str, twist: &[f64], start: &[f64], inputs: &[f64], poses: &[Vec<f64>]) -> String {
    let list = |v: &[f64]| v.iter().map(|v| format!("{v:?}")).collect::<Vec<_>>().join(", ");
    let (t, z, u) = (list(twist), list(start), list(inputs));
    let guess = list(&vec![0.5; inputs.len()]);
    let (n, k) = (start.len(), poses[0].len());
    let rows = |open: &str, close: &str| {
        poses.iter().map(|p| format!("{open}{}{close}", list(p))).collect::<Vec<_>>().join(", ")
    };
    match language {
        "python" => format!(
            "\nz, u = [{z}], [{u}]\np = [[0.04*(i == j) for j in range(N)] for i in range(N)]\nprint(*inverse([{t}], z, [{guess}]))\n\
             for pose in [{}]:\n    z, p = observer(z, p, u, pose, 0.1)\nprint(*z)\n\
             for row in p:\n    print(*row)\n",
            rows("[", "]")
        ),
        "rust" => format!(
            "fn main() {{\n    let (mut z, u) = ([{z}], [{u}]);\n    let mut p = [[0.0; N]; N];\n    \
             for i in 0..N {{ p[i][i] = 0.04; }}\n    let show = |row: &[f64]| println!(\"{{}}\", row.iter().map(|v| format!(\"{{v:?}}\")).collect::<Vec<_>>().join(\" \"));\n    \
             show(&inverse(&[{t}], &z, &[{guess}]).unwrap());\n    \
             for pose in [{}] {{ observer(&mut z, &mut p, &u, &pose, 0.1); }}\n    show(&z);\n    p.iter().for_each(|r| show(r));\n}}\n",
            rows("[", "]")
        ),
        _ => format!(
            "#include <stdio.h>\nint main(void) {{\n    double z[] = {{{z}}}, u[] = {{{u}}}, guess[] = {{{guess}}}, p[{n}][{n}] = {{{{0}}}};\n    \
             const double twist[] = {{{t}}}, poses[][{k}] = {{{}}};\n    \
             for (int i = 0; i < {n}; i++) p[i][i] = 0.04;\n    if (!creepage_inverse(twist, z, guess)) return 1;\n    \
             for (int i = 0; i < CREEPAGE_M; i++) printf(\"%.17g \", guess[i]);\n    printf(\"\\n\");\n    \
             for (int i = 0; i < {}; i++) creepage_observer(z, p, u, poses[i], 0.1);\n    \
             for (int i = 0; i < {n}; i++) printf(\"%.17g \", z[i]);\n    printf(\"\\n\");\n    \
             for (int i = 0; i < {n}; i++) {{ for (int j = 0; j < {n}; j++) printf(\"%.17g \", p[i][j]); printf(\"\\n\"); }}\n    \
             (void)creepage_covariance; (void)creepage_parameter_names; return 0;\n}}\n",
            rows("{", "}"),
            poses.len()
        ),
    }
}

/// Speed ahead, to the left and turning in the end, as `simulate` has them under inputs that are held for a while.
fn moves(folder: &Path, names: &[&str], inputs: &[f64]) -> [f64; 3] {
    let values: Vec<String> = inputs.iter().map(|v| format!("{v:?}")).collect();
    let rows: String = (0..=30).map(|i| format!("{i},{}\n", values.join(","))).collect();
    std::fs::write(folder.join("held.csv"), format!("time,{}\n{rows}", names.join(","))).unwrap();
    let output = creepage(folder, &["simulate", "model.toml", "--inputs", "held.csv", "--out", "held-path.csv"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let text = std::fs::read_to_string(folder.join("held-path.csv")).unwrap();
    let header: Vec<&str> = text.lines().next().unwrap().split(',').collect();
    let last: Vec<&str> = text.lines().last().unwrap().split(',').collect();
    ["speed", "lateral_speed", "yaw_rate"].map(|name| {
        let at = header.iter().position(|h| *h == name).unwrap();
        last[at].parse().unwrap()
    })
}

/// Observer and inverse kinematics in every language: the inputs move the vehicle as wanted, hidden slides at rest; the observer
/// comes from a wrong state to the true one; all languages say the same.
#[test]
fn exported_observers_come_to_the_state_and_inverses_to_the_inputs() {
    let robot = [
        effect("track-width", &[("scale", 0.035)]),
        effect("cornering-creep", &[("mass_over_bT", 0.11)]),
        effect("lever-arm", &[("a", 0.1), ("b", -0.02)]),
    ];
    let car = [effect("understeer", &[("gradient", 0.02)]), effect("steering-offset", &[("offset", 0.01)])];
    let mecanum = "vehicle = \"mecanum\"\n[parameters]\nwheel_radius = 0.05\nwheelbase = 0.3\ntrack_width = 0.3\n";
    let slips = effect("rotation-creep", &[("e_rc", 0.06)]);
    let cases = [
        (format!("{DRIVE}{}", robot.concat()), vec![0.8, -0.6], [0.1, -0.02]),
        (format!("{CAR}{}", car.concat()), vec![1.5, 0.25], [0.0; 2]),
        (format!("{mecanum}{slips}"), vec![0.3, -0.2, 0.4], [0.0; 2]),
    ];
    for (model, twist, [a, b]) in cases {
        let dir = folder(&model);
        let code = String::from_utf8(creepage(dir.path(), &["export", "model.toml", "--as", "c"]).stdout).unwrap();
        let names_of = |head: &str| -> Vec<String> {
            let line = code.lines().find_map(|l| l.strip_prefix(head)).unwrap_or_else(|| panic!("{code}"));
            let names = line.split(['.', ';']).next().unwrap().split(", ");
            names.map(String::from).collect()
        };
        let (states, inputs) = (names_of("// State z: "), names_of("// Inputs u: "));
        let names: Vec<&str> = inputs.iter().map(String::as_str).collect();
        let held: Vec<f64> = (0..inputs.len()).map(|i| 0.25 - 0.1 * i as f64).collect();
        let drive = Drive { model: model.clone(), inputs: names.iter().copied().zip(held.iter().copied()).collect() };
        let truth = measured_poses(dir.path(), &drive);
        // Half a metre off and askew.
        let start: Vec<f64> = (0..states.len()).map(|i| if i < 3 { [0.4, -0.3, 0.2][i] } else { 0.0 }).collect();
        let mut first: Option<Vec<Vec<f64>>> = None;
        for language in ["rust", "c", "cpp", "python"] {
            let output = creepage(dir.path(), &["export", "model.toml", "--as", language]);
            let mut text = String::from_utf8(output.stdout).unwrap();
            text += &on_board(language, &twist, &start, &held, &truth);
            let Some(found) = ran(dir.path(), language, &text) else { continue };
            let reference = first.get_or_insert_with(|| found.clone());
            for (row, wanted) in found.iter().zip(reference.iter()) {
                assert!(
                    row.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 1e-9 * (1.0 + b.abs())),
                    "{language}: {row:?} {wanted:?}"
                );
            }
        }
        let found = first.unwrap();
        let moved = moves(dir.path(), &names, &found[0]);
        let wanted = if twist.len() == 3 { [twist[0], twist[1], twist[2]] } else { [twist[0], moved[1], twist[1]] };
        assert!((0..3).all(|i| (moved[i] - wanted[i]).abs() < 1e-6), "{model}{moved:?} {wanted:?}");
        // The variances have shrunk, and the state is the true one.
        let end = truth.last().unwrap();
        let (s, c) = end[2].sin_cos();
        let reference_point = [end[0] - a * c + b * s, end[1] - a * s - b * c];
        let off = (found[1][0] - reference_point[0]).hypot(found[1][1] - reference_point[1]);
        assert!(off < 0.01 && (found[1][2] - end[2]).abs() < 0.01, "{model}{:?} {end:?}", found[1]);
        assert!(found[2][0] < 1e-3 && found[3][1] < 1e-3);
    }
}

/// What is measured at every tenth of a second of a drive, the beginning left out.
fn measured_poses(folder: &Path, drive: &Drive) -> Vec<Vec<f64>> {
    simulated(folder, drive);
    let text = std::fs::read_to_string(folder.join("path.csv")).unwrap();
    let row = |line: &str| line.split(',').skip(1).take(3).map(|v| v.parse().unwrap()).collect();
    text.lines().skip(2).map(row).collect()
}

/// No inputs turn a car that stands, whatever the search begins from, and the inputs stay.
#[test]
fn inputs_for_what_a_vehicle_cannot_do_are_not_given() {
    let dir = folder(CAR);
    let bodies = [
        (
            "python",
            "\nprint(int(inverse([0.0, 0.3], [0.0]*N, [0.5, 0.5]) is None), int(inverse([1.0, 0.3], [0.0]*N, [0.5, 0.5]) is None))\n",
        ),
        (
            "rust",
            "fn main() {\n    let none = |v: f64| inverse(&[v, 0.3], &[0.0; N], &[0.5; M]).is_none() as u8;\n    println!(\"{} {}\", none(0.0), none(1.0));\n}\n",
        ),
        (
            "c",
            "#include <stdio.h>\nint main(void) {\n    const double stands[] = {0.0, 0.3}, drives[] = {1.0, 0.3}, z[CREEPAGE_N] = {0};\n    double a[] = {0.5, 0.5}, b[] = {0.5, 0.5};\n    const int none = !creepage_inverse(stands, z, a) && a[0] == 0.5 && a[1] == 0.5;\n    printf(\"%d %d\\n\", none, !creepage_inverse(drives, z, b));\n    (void)creepage_covariance; (void)creepage_parameter_names; return 0;\n}\n",
        ),
    ];
    for (language, body) in bodies {
        let output = creepage(dir.path(), &["export", "model.toml", "--as", language]);
        let text = String::from_utf8(output.stdout).unwrap() + body;
        let Some(found) = ran(dir.path(), language, &text) else { continue };
        assert_eq!(found, [[1.0, 0.0]], "{language}");
    }
}
