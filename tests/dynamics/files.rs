//! `[dynamics]` in model files, and `creepage simulate` on it.

use creepage::dynamics::{Dynamics, known};
use creepage::files::ModelFile;
use std::path::Path;
use std::process::{Command, Output};

const SLEIGH: &str = "vehicle = \"sleigh\"
[parameters]
mass = 1.0
inertia = 0.5
mass_offset = 0.3
";
const CAR: &str = "vehicle = \"car\"
[parameters]
wheel_radius = 0.3
wheelbase = 2.6
";
const TRAIN: &str = "vehicle = \"n-trailer\"
tractor = \"differential-drive\"
[parameters]
wheel_radius = 0.2
track_width = 0.6
trailer_lengths = [1.0, 0.8]
";

fn parse(text: &str) -> creepage::Result<Dynamics> {
    Dynamics::from_file(&ModelFile::parse(text, "model.toml", &known(creepage::effects::all()))?)
}

/// A model file that cannot be used, and what must be said of it.
const BAD: &[(&str, &str, &[&str])] = &[
    (CAR, "[dynamics]\ninertia = 1.0\n", &["model.toml:5:1: key \"mass\" in [dynamics] is missing", "kg"]),
    (CAR, "[dynamics]\nmass = -1.0\ninertia = 1.0\n", &["model.toml:6:8: mass = -1.0 is out of range"]),
    (CAR, "[dynamics]\nmas = 1.0\n", &["model.toml:6:1: unknown key \"mas\" in [dynamics]", "did you mean \"mass\"?"]),
    (SLEIGH, "[dynamics]\nmass = 2.0\n", &["model.toml:7:1: unknown key \"mass\" in [dynamics]"]),
    (
        CAR,
        "[dynamics]\nmass = 1.0\ninertia = 1.0\ninputs = [\"wheel_torqe\"]\n",
        &["model.toml:8:11: unknown input \"wheel_torqe\"", "did you mean \"wheel_torque\"?"],
    ),
    (
        CAR,
        "[dynamics]\nmass = 1.0\ninertia = 1.0\ninputs = [\"force\", \"force\"]\n",
        &["model.toml:8:20: the input \"force\" is listed twice"],
    ),
    (
        CAR,
        "[dynamics]\nmass = 1.0\ninertia = 1.0\nwheel_inertia = -0.1\n",
        &["model.toml:8:17: wheel_inertia = -0.1 is out of range"],
    ),
    (
        CAR,
        "[dynamics]\nmass = 1.0\ninertia = 1.0\nwheel_inertia = { front-axle = 0.1 }\n",
        &["unknown key \"front-axle\" in wheel_inertia", "rear-axle"],
    ),
    (
        CAR,
        "[dynamics]\nmass = 1.0\ninertia = 1.0\n[dynamics.friction]\nrear-axle = { law = \"viscous\", coefficient = 1.0 }\n",
        &["model.toml:9:1: unknown key \"rear-axle\"", "rear-axle-rolling"],
    ),
    (
        CAR,
        "[dynamics]\nmass = 1.0\ninertia = 1.0\n[dynamics.friction]\nrolling = { law = \"viscos\", coefficient = 1.0 }\n",
        &["model.toml:9:19: unknown law of contact \"viscos\"", "did you mean \"viscous\"?"],
    ),
    (
        CAR,
        "[dynamics]\nmass = 1.0\ninertia = 1.0\n[dynamics.friction]\nrolling = { law = \"viscous\" }\n",
        &["key \"coefficient\" in [dynamics.friction.rolling] is missing", "N*s/m"],
    ),
    (
        CAR,
        "[dynamics]\nmass = 1.0\ninertia = 1.0\n[dynamics.friction]\nrolling = { law = \"viscous\", coefficient = 0 }\n",
        &["coefficient = 0.0 is out of range", "greater than zero"],
    ),
    (
        CAR,
        "[dynamics]\nmass = 1.0\ninertia = 1.0\n[dynamics.friction]\nrolling = 5.0\n",
        &["rolling must be a law of contact", "law = \"viscous\""],
    ),
    (
        CAR,
        "[initial]\nx = 0\ny = 0\nheading = 0\nspeed = 1.0\n",
        &["model.toml:9:1: unknown key \"speed\" in [initial]"],
    ),
    (
        CAR,
        "[dynamics]\nmass = 1.0\ninertia = 1.0\n[initial]\nx = 0\ny = 0\nheading = 0\nsteering_angle = 0.1\n",
        &["model.toml:12:1: steering_angle is an input"],
    ),
    (
        TRAIN,
        "[dynamics]\nmass = 1.0\ninertia = 1.0\ntrailer_masses = [1.0]\ntrailer_inertias = [1.0, 1.0]\n",
        &["trailer_masses has 1 elements, but 2 are needed"],
    ),
    (TRAIN, "[dynamics]\nmass = 1.0\ninertia = 1.0\n", &["key \"trailer_masses\" in [dynamics] is missing"]),
    (
        CAR,
        "[dynamics]\nmass = 1.0\ninertia = 1.0\n[[effects]]\nid = \"rotation-creep\"\ne_rc = 0.1\n",
        &["model.toml:8:1: the effect rotation-creep has no place beside [dynamics]"],
    ),
    (CAR, "[columns]\nwheel_torque = \"tau\"\n", &["model.toml:6:1: unknown key \"wheel_torque\" in [columns]"]),
];

#[test]
fn every_bad_section_is_explained() {
    let mut failures = Vec::new();
    for (top, bottom, parts) in BAD {
        let message = match parse(&format!("{top}{bottom}")) {
            Ok(_) => "accepted".to_string(),
            Err(e) if e.exit_code() == 2 => e.to_string(),
            Err(e) => format!("exit code {}: {e}", e.exit_code()),
        };
        let missing: Vec<_> = parts.iter().filter(|p| !message.contains(**p)).collect();
        if !missing.is_empty() || message.lines().count() != 1 {
            failures.push(format!("{bottom}{message}\n   lacks {missing:?}"));
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn a_law_of_a_contact_stands_before_that_of_its_kind() {
    let text = format!(
        "{TRAIN}[dynamics]\nmass = 3.0\ninertia = 1.0\ntrailer_masses = [1, 1]\ntrailer_inertias = [0.1, 0.1]\n\
         wheel_inertia = {{ right-wheel = 0.1 }}\ninputs = [\"wheel_torque_left\"]\n\
         [dynamics.friction]\ntrailer-2-direction = {{ law = \"ideal\" }}\naxle-direction = {{ law = \"rocard\", stiffness = 9.0 }}\n\
         direction = {{ law = \"viscous\", coefficient = 7.0 }}\n"
    );
    let dynamics = parse(&text).unwrap();
    let laws: Vec<_> = dynamics
        .contacts
        .iter()
        .map(|c| (c.name.as_str(), c.law.as_ref().map(|l| (l.0.id.as_str(), l.1[0]))))
        .collect();
    let said = [
        ("right-wheel-rolling", None),
        ("left-wheel-rolling", None),
        ("axle-direction", Some(("rocard", 9.0))),
        ("trailer-1-direction", Some(("viscous", 7.0))),
        ("trailer-2-direction", None),
    ];
    assert_eq!(laws, said);
    assert_eq!(dynamics.inputs(), ["wheel_torque_left"]);
}

fn creepage(dir: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_creepage")).current_dir(dir).args(arguments).output().unwrap()
}

fn simulated(model: &str, inputs: &str) -> std::result::Result<Vec<Vec<String>>, String> {
    let dir = tempfile::tempdir().unwrap();
    std::fs::write(dir.path().join("model.toml"), model).unwrap();
    std::fs::write(dir.path().join("in.csv"), inputs).unwrap();
    let output = creepage(dir.path(), &["simulate", "model.toml", "--inputs", "in.csv", "--out", "out.csv", "--quiet"]);
    let stderr = String::from_utf8(output.stderr).unwrap();
    if output.status.code() != Some(0) {
        assert!(!dir.path().join("out.csv").exists() && !stderr.contains("panicked"), "{stderr}");
        return Err(stderr);
    }
    let text = std::fs::read_to_string(dir.path().join("out.csv")).unwrap();
    Ok(text.lines().map(|l| l.split(',').map(str::to_string).collect()).collect())
}

fn last(table: &[Vec<String>], name: &str) -> f64 {
    let at = table[0].iter().position(|n| n == name).unwrap_or_else(|| panic!("no {name} in {:?}", table[0]));
    table[table.len() - 1][at].parse().unwrap()
}

const PUSHED: &str = "[initial]\nx = 1.0\ny = 0.0\nheading = 0.0\nspeed = 0.5\nyaw_rate = 1.2\n";

#[test]
fn a_sleigh_runs_without_inputs_ideal_and_with_friction() {
    let inputs = "time\n0\n1\n2\n4\n";
    let ideal = simulated(&format!("{SLEIGH}[dynamics]\n{PUSHED}"), inputs).unwrap();
    assert_eq!(ideal.len(), 5);
    // u = C·tanh(a·m·C/M·t + τ₀) with M = I + m·a².
    let (m, a, mm): (f64, f64, f64) = (1.0, 0.3, 0.59);
    let c = ((m * 0.25 + mm * 1.44) / m).sqrt();
    let said = c * (a * m * c / mm * 4.0 + (0.5 / c).atanh()).tanh();
    assert!((last(&ideal, "speed") - said).abs() < 1e-8);
    let friction = "[dynamics.friction]\ndirection = { law = \"viscous\", coefficient = 1e6 }\n";
    let free = simulated(&format!("{SLEIGH}[dynamics]\n{friction}{PUSHED}"), inputs).unwrap();
    let gap = (last(&free, "speed") - said).abs();
    assert!(gap > 1e-8 && gap < 1e-6, "{gap:e}");
    let without =
        simulated(&format!("{SLEIGH}{}", "[initial]\nx = 1.0\ny = 0.0\nheading = 0.0\n"), inputs).unwrap_err();
    assert!(without.contains("use unicycle"), "{without}");
}

#[test]
fn a_car_is_driven_by_a_torque() {
    let model = format!(
        "{CAR}[columns]\nwheel_torque = \"tau\"\n[dynamics]\nmass = 1000\ninertia = 1400\nmass_offset = 1.2\nwheel_inertia = 1\n\
         inputs = [\"wheel_torque\"]\n[dynamics.friction]\nrolling = {{ law = \"viscous\", coefficient = 2e4 }}\n\
         direction = {{ law = \"elastic\", stiffness = 6e4, relaxation_length = 0.4 }}\n"
    );
    let rows: String = (0..=40).map(|i| format!("{},{},{}\n", f64::from(i) * 0.1, 300, 0.05)).collect();
    let table = simulated(&model, &format!("time,tau,steering_angle\n{rows}")).unwrap();
    assert!(last(&table, "speed") > 3.0 && last(&table, "heading") > 0.02);
    // Drive slip: the force that accelerates it over b.
    let slip = last(&table, "slip.rear-axle-rolling");
    assert!((slip + last(&table, "force.rear-axle-rolling") / 2e4).abs() < 1e-9 && slip < -0.03, "{slip}");
    let weightless = simulated(&model.replace("wheel_inertia = 1\n", ""), &format!("time,tau,steering_angle\n{rows}"));
    let weightless = weightless.unwrap_err();
    assert!(weightless.contains("model.toml:7:1: nothing says how theta accelerates"), "{weightless}");
    let missing = simulated(&model, "time,steering_angle\n0,0\n1,0\n").unwrap_err();
    assert!(missing.contains("column \"tau\" for wheel_torque is missing"), "{missing}");
}

/// A column in amperes with the motor constant for its scale drives as one in newton metres.
#[test]
fn a_current_is_a_torque_in_another_unit() {
    let car = format!("{CAR}[dynamics]\nmass = 1000.0\ninertia = 1500.0\ninputs = [\"wheel_torque\"]\n");
    let torque = simulated(&car, "time,wheel_torque,steering_angle\n0,60,0.1\n2,120,0.1\n").unwrap();
    let by_current = format!(
        "{car}[columns]\nwheel_torque = {{ column = \"amps\", scale = 12.0 }}\nsteering_angle = {{ column = \"steer\", unit = \"deg\" }}\n"
    );
    let steer = 0.1_f64.to_degrees();
    let current = simulated(&by_current, &format!("time,amps,steer\n0,5,{steer}\n2,10,{steer}\n")).unwrap();
    assert_eq!(torque[0], current[0]);
    for name in ["x", "y", "heading", "speed"] {
        assert!(
            (last(&torque, name) - last(&current, name)).abs() < 1e-9 * (1.0 + last(&torque, name).abs()),
            "{name}"
        );
    }
    assert!(last(&torque, "speed") > 0.5);
    let bad = simulated(&by_current.replace("scale = 12.0", "unit = \"A\""), "time,amps,steer\n0,5,0\n").unwrap_err();
    assert!(bad.contains("give scale = "), "{bad}");
}

/// A vehicle whose constraints do not determine its motion moves by forces.
#[test]
fn a_skid_steer_turns_by_skidding() {
    let vehicle = creepage::vehicles::named("skid-steer").unwrap();
    let parameters: String = vehicle.parameters.keys().map(|p| format!("{p} = 0.4\n")).collect();
    let roles =
        &ModelFile::parse(&format!("vehicle = \"skid-steer\"\n[parameters]\n{parameters}"), "m", &known(&[])).unwrap();
    assert!(roles.dynamics.is_none());
    let model = format!(
        "vehicle = \"skid-steer\"\n[parameters]\n{parameters}[dynamics]\nmass = 20\ninertia = 2\nwheel_inertia = 0.1\n\
         inputs = [\"yaw_torque\"]\n[dynamics.friction]\nrolling = {{ law = \"viscous\", coefficient = 100 }}\n\
         direction = {{ law = \"viscous\", coefficient = 100 }}\n"
    );
    let table = simulated(&model, "time,yaw_torque\n0,5\n1,5\n2,5\n").unwrap();
    assert!(last(&table, "yaw_rate") > 0.01 && last(&table, "friction_power") < 0.0);
}

/// Without `[dynamics]` the kinematic simulation is what it was: columns and numbers.
#[test]
fn a_model_without_forces_is_simulated_as_before() {
    let table = simulated(
        "vehicle = \"unicycle\"\n[parameters]\nwheel_radius = 0.5\n",
        "time,wheel_rate,yaw_rate\n0,2,0\n1,2,0\n",
    )
    .unwrap();
    assert_eq!(table[0], ["time", "x", "y", "heading", "speed", "lateral_speed", "yaw_rate"]);
    assert!((last(&table, "x") - 1.0).abs() < 1e-12);
}

/// Of a section that is a part of the vehicle no masses are known, and the trailers behind it hang on them.
#[test]
fn no_forces_are_known_for_a_vehicle_of_sections() {
    let vehicles = creepage::extensions::vehicles_with_own("examples/bus/bus.toml").unwrap();
    let known = creepage::dynamics::known_on(&vehicles, &[]);
    let lengths = "wheel_radius = 0.478\nwheelbase = 5.9\njoint_offset = 1.65\nrear_length = 5.1\n";
    let forces = "[dynamics]\nmass = 1.0\ninertia = 1.0\n";
    for (vehicle, trailers, line) in [
        ("vehicle = \"articulated-bus\"\n", "", 7),
        ("vehicle = \"n-trailer\"\ntractor = \"articulated-bus\"\n", "trailer_lengths = [3.0]\n", 9),
    ] {
        let text = format!("{vehicle}[parameters]\n{lengths}{trailers}{forces}");
        let error = ModelFile::parse(&text, "model.toml", &known).unwrap_err().to_string();
        let place = format!("model.toml:{line}:1: [dynamics] has no place here: no forces are known for");
        assert!(error.starts_with(&place) && error.contains("\"articulated-bus\""), "{error}");
    }
    let bus = vehicles.iter().find(|v| v.id == "articulated-bus").unwrap();
    let lengths = [("wheel_radius", 0.478), ("wheelbase", 5.9), ("joint_offset", 1.65), ("rear_length", 5.1)];
    let bus = creepage::model::Model::of(bus, &lengths).unwrap();
    let error = Dynamics::new(&bus, &creepage::dynamics::Masses::default()).unwrap_err().to_string();
    assert!(error.contains("which has sections of its own"), "{error}");
}

/// The library simulates a model with forces along a run, one by one and many at once.
#[test]
fn many_motions_under_forces_are_those_of_one() {
    let example = |name: &str| format!("{}/examples/dynamics/robot.{name}", env!("CARGO_MANIFEST_DIR"));
    let model = creepage::Model::read(example("toml")).unwrap();
    let run = creepage::Run::read(example("csv"), &model).unwrap();
    let one = creepage::simulate(&model, &run).unwrap();
    let many = creepage::simulate_many(&model, &run, &[("body.mass", vec![18.232, 25.0])]).unwrap();
    let last = many.rows - 1;
    for (k, column) in one.columns[1..4].iter().enumerate() {
        let [alike, heavier] = [0, 1].map(|case| many.cases[case].row(last)[k]);
        assert!((alike - column[last]).abs() < 1e-6, "{alike} {}", column[last]);
        assert!((heavier - column[last]).abs() > 1e-3, "{heavier}");
    }
}
