//! Steering that forces do not move: several angles, given as they are or by their rates, and what cannot be given so.

use creepage::dynamics::{Dynamics, Masses, Start, simulate_dynamics};
use creepage::extensions::vehicles_with_own;
use creepage::formula::Expr;
use creepage::model::Model;
use creepage::motion::{Formulas, Integrator, Method, Table};
use creepage::vehicles::Vehicle;

/// Steered in front and behind, its angles defined by these formulas of the inputs of that name.
fn steered(front: &str, rear: &str) -> Vehicle {
    let input = |name: &str| format!("[vehicle.inputs.{name}]\nunit = \"rad\"\nmeaning = \"as logged\"\n");
    let inputs: String = ["front_angle", "rear_angle"]
        .into_iter()
        .filter(|name| front.contains(name) || rear.contains(name))
        .map(input)
        .collect();
    let text = format!(
        "[[vehicle]]\nid = \"both-ends\"\ntitle = \"steered at both ends\"\n\
         [vehicle.parameters.wheelbase]\nunit = \"m\"\nmeaning = \"between the axles\"\n\
         [vehicle.parameters.trail]\nunit = \"m\"\nmeaning = \"of the rear wheel\"\n\
         [vehicle.parameters.wheel_radius]\nunit = \"m\"\nmeaning = \"of the front wheel\"\n\
         [vehicle.inputs.wheel_rate]\nunit = \"rad/s\"\nmeaning = \"of the front wheel\"\n{inputs}\
         [vehicle.define]\n\
         L = {{ formula = \"wheelbase\", unit = \"m\", meaning = \"wheelbase\" }}\n\
         r = {{ formula = \"wheel_radius\", unit = \"m\", meaning = \"radius\" }}\n\
         \"theta'\" = {{ formula = \"wheel_rate\", unit = \"rad/s\", meaning = \"rate\" }}\n\
         d_r = {{ formula = \"trail\", unit = \"m\", meaning = \"trail\" }}\n\
         delta = {{ formula = \"{front}\", unit = \"rad\", meaning = \"front angle\" }}\n\
         beta = {{ formula = \"{rear}\", unit = \"rad\", meaning = \"rear angle\" }}\n\
         [[vehicle.wheels]]\nname = \"front\"\nforward = \"L\"\nsteering = \"delta\"\nradius = \"r\"\n\
         rate = \"theta'\"\nrotation_creep = \"e_rc\"\ntraverse_creep = \"e_f\"\n\
         [[vehicle.wheels]]\nname = \"rear\"\nsteering = \"beta\"\ntraverse_creep = \"e_tc\"\n"
    );
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("mine.toml");
    std::fs::write(&path, text).unwrap();
    let all = vehicles_with_own(&path).unwrap();
    all.into_iter().find(|v| v.id == "both-ends").unwrap()
}

fn dynamics(vehicle: &Vehicle) -> Dynamics {
    let model = Model::of(vehicle, &[("wheelbase", 2.0), ("trail", 0.3), ("wheel_radius", 0.4)]).unwrap();
    let masses = Masses {
        mass: 3.0,
        inertia: 1.5,
        mass_offset: 0.8,
        wheels: [("theta'".into(), 0.1)].into(),
        ..Masses::default()
    };
    Dynamics::new(&model, &masses).unwrap().driven_by(&["force", "yaw_torque"]).unwrap()
}

fn run(d: &Dynamics, formulas: &[&str], angle: f64, by: &Integrator) -> creepage::Result<Table> {
    let parsed: Vec<Expr> = formulas.iter().map(|f| Expr::parse(f).unwrap()).collect();
    let start = Start { pose: vec![0.0; 3], speed: 1.0, steering_angle: angle, ..Start::default() };
    simulate_dynamics(d, &Formulas::new(&parsed, &[]).unwrap(), &[0.0, 2.0], &start, by)
}

fn last(table: &Table, name: &str) -> f64 {
    *table.column(name).unwrap_or_else(|| panic!("no {name} in {:?}", table.names)).last().unwrap()
}

fn same(one: &Table, two: &Table) {
    for name in ["x", "y", "heading", "speed", "yaw_rate", "input_power"] {
        let (a, b) = (last(one, name), last(two, name));
        assert!((a - b).abs() < 1e-7, "{name}: {a} {b}");
    }
}

fn methods() -> [(Integrator, Option<f64>); 2] {
    [(Integrator::default(), None), (Integrator { method: Method::Radau5, ..Integrator::default() }, Some(200.0))]
}

fn with(d: &Dynamics, law: Option<f64>) -> Dynamics {
    law.map_or(d.clone(), |b| d.clone().with_laws("viscous", &[b]).unwrap())
}

#[test]
fn each_of_two_angles_follows_its_own_rate() {
    let by_angle = dynamics(&steered("front_angle", "rear_angle"));
    let by_rate = by_angle.clone().steered_by_rate();
    assert_eq!(by_rate.inputs(), ["force", "yaw_torque", "front_rate", "rear_rate"]);
    for (by, law) in methods() {
        let angles = ["1 + t", "0.3", "0.1 + 0.3*sin(t)", "0.1 - 0.2*t"];
        let one = run(&with(&by_angle, law), &angles, 0.0, &by).unwrap();
        let two = run(&with(&by_rate, law), &["1 + t", "0.3", "0.3*cos(t)", "-0.2"], 0.1, &by).unwrap();
        same(&one, &two);
        assert!(last(&one, "heading") > 0.1);
        for name in ["front_angle", "rear_angle"] {
            assert!((last(&one, name) - last(&two, name)).abs() < 1e-9, "{name}");
        }
    }
}

#[test]
fn one_rate_turns_all_that_it_steers() {
    let by_angle = dynamics(&steered("front_angle", "front_angle"));
    let by_rate = by_angle.clone().steered_by_rate();
    assert_eq!(by_rate.inputs(), ["force", "yaw_torque", "front_rate"]);
    for (by, law) in methods() {
        let one = run(&with(&by_angle, law), &["0.5", "0", "0.1 + 0.3*sin(t)"], 0.0, &by).unwrap();
        let two = run(&with(&by_rate, law), &["0.5", "0", "0.3*cos(t)"], 0.1, &by).unwrap();
        same(&one, &two);
        // Both wheels alike: it moves aside and does not turn.
        assert!(last(&one, "heading").abs() < 1e-7 || law.is_some());
        assert!(last(&one, "y") > 0.1);
    }
}

#[test]
fn an_angle_that_is_a_formula_is_given_itself() {
    let own = dynamics(&steered("front_angle", "rear_angle"));
    let tied = dynamics(&steered("front_angle", "-front_angle/2"));
    for (by, law) in methods() {
        let one = run(&with(&own, law), &["0.5", "0", "0.3*sin(t)", "-0.15*sin(t)"], 0.0, &by).unwrap();
        let two = run(&with(&tied, law), &["0.5", "0", "0.3*sin(t)"], 0.0, &by).unwrap();
        same(&one, &two);
    }
    let error = run(&tied.steered_by_rate(), &["0", "0", "0"], 0.0, &Integrator::default()).unwrap_err();
    assert_eq!(error.exit_code(), 2);
    assert!(error.to_string().contains("cannot be given by its rate"), "{error}");
}

/// The contact behind the axis is moved by the steering's own acceleration, which nobody gives.
#[test]
fn a_contact_swung_by_its_steering_needs_a_law() {
    let mut vehicle = steered("front_angle", "rear_angle");
    vehicle.wheels[1].trail = Expr::sym("d_r");
    let swung = dynamics(&vehicle);
    let still = ["0.5", "0", "0.1", "0.1"];
    let error = run(&swung, &still, 0.0, &Integrator::default()).unwrap_err();
    assert_eq!(error.exit_code(), 2);
    assert!(error.to_string().contains("rear-direction is swung by the steering"), "{error}");
    assert!(!swung.has_friction());
    let one = swung.clone().with_law("rear-direction", "viscous", &[50.0]).unwrap();
    assert!(one.has_friction());
    run(&one, &still, 0.0, &Integrator { method: Method::Radau5, ..Integrator::default() }).unwrap();
    // The law of another contact is no help.
    let other = swung.with_law("front-direction", "viscous", &[50.0]).unwrap();
    assert!(other.has_friction() && run(&other, &still, 0.0, &Integrator::default()).is_err());
}

/// Forces come before the steering among the inputs; each does its own work.
#[test]
fn the_inputs_power_is_force_times_speed_and_torque_times_turning() {
    let d = dynamics(&steered("front_angle", "rear_angle"));
    let table = run(&d, &["2", "3", "0.2", "0"], 0.0, &Integrator::default()).unwrap();
    let power = 2.0 * last(&table, "speed") + 3.0 * last(&table, "yaw_rate");
    assert!((last(&table, "input_power") - power).abs() < 1e-9);
    let [energy, work] = ["energy", "input_power"].map(|n| table.column(n).unwrap());
    assert!(energy[1] > energy[0] && work[0] > 0.0);
}

/// Along the body and to its left, whatever its heading; a slip may be as small as rounding makes it.
#[test]
fn speeds_at_the_start_are_those_of_the_body() {
    let d = with(&dynamics(&steered("front_angle", "rear_angle")), Some(20.0));
    let zero: Vec<Expr> = (0..4).map(|_| Expr::int(0)).collect();
    let zero = Formulas::new(&zero, &[]).unwrap();
    let stiff = Integrator { method: Method::Radau5, ..Integrator::default() };
    let pose = vec![1.0, 2.0, 0.9];
    let start =
        Start { pose: pose.clone(), speed: 1.5, lateral_speed: Some(0.2), yaw_rate: Some(-0.3), ..Start::default() };
    let table = simulate_dynamics(&d, &zero, &[0.0, 0.1], &start, &stiff).unwrap();
    let first = |name: &str| table.column(name).unwrap()[0];
    for (name, value) in [("x", 1.0), ("y", 2.0), ("heading", 0.9), ("speed", 1.5), ("lateral_speed", 0.2)] {
        assert!((first(name) - value).abs() < 1e-12, "{name}: {}", first(name));
    }
    assert!((first("yaw_rate") + 0.3).abs() < 1e-12);
    // What is not given slips as little as can be: the wheel rolls.
    assert!(first("slip.front-rolling").abs() < 1e-9, "{}", first("slip.front-rolling"));
    let fast = Start { pose, speed: 3e6, ..Start::default() };
    let ideal = dynamics(&steered("front_angle", "rear_angle"));
    simulate_dynamics(&ideal, &zero, &[0.0, 1e-6], &fast, &Integrator::default()).unwrap();
}

/// Turning wheels slip where they swing; the rates at the start make up for that, too.
#[test]
fn a_start_while_the_steering_turns_slips_as_little_as_can_be() {
    let mut vehicle = steered("front_angle", "rear_angle");
    vehicle.wheels[1].trail = Expr::sym("d_r");
    let d = with(&dynamics(&vehicle), Some(20.0));
    let stiff = Integrator { method: Method::Radau5, ..Integrator::default() };
    let table = run(&d, &["0", "0", "0.1 + 0.4*t", "0.2 - 0.7*t"], 0.0, &stiff).unwrap();
    let first = |name: &str| table.column(name).unwrap()[0];
    // Three contacts, three rates that are not given: nothing has to slip.
    for contact in ["front-rolling", "front-direction", "rear-direction"] {
        assert!(first(&format!("slip.{contact}")).abs() < 1e-12, "{contact}: {}", first(&format!("slip.{contact}")));
    }
    let held = run(&d, &["0", "0", "0.1", "0.2"], 0.0, &stiff).unwrap();
    assert!((first("lateral_speed") - held.column("lateral_speed").unwrap()[0]).abs() > 0.1);
}

/// On a line the sensor is carried along from where it was, in the direction of the body and not in its own.
#[test]
fn a_disk_is_seen_along_its_line() {
    let mut model = Model::new("disk", &[("wheel_radius", 0.5)]).unwrap();
    model.sensor.lever_arm = [0.3, 0.1];
    model.sensor.heading_offset = 0.2;
    let masses = Masses { mass: 2.0, wheels: [("theta'".into(), 0.25)].into(), ..Masses::default() };
    let disk = Dynamics::new(&model, &masses).unwrap().driven_by(&["wheel_torque"]).unwrap();
    let torque = Formulas::new(&[Expr::parse("1.5").unwrap()], &[]).unwrap();
    let start = Start { pose: vec![1.0, 2.0, 0.9], speed: 0.5, ..Start::default() };
    let table = simulate_dynamics(&disk, &torque, &[0.0, 2.0], &start, &Integrator::default()).unwrap();
    // v' = (τ/r)/(m + J/r²) = 1 m/s²: 3 m in 2 s, along 0.7 rad.
    let expect = [1.0 + 3.0 * 0.7f64.cos(), 2.0 + 3.0 * 0.7f64.sin(), 0.9];
    for (name, value) in ["x", "y", "heading"].into_iter().zip(expect) {
        assert!((last(&table, name) - value).abs() < 1e-9, "{name}: {} {value}", last(&table, name));
    }
    assert_eq!(["x", "y"].map(|name| table.column(name).unwrap()[0]), [1.0, 2.0]);
}
