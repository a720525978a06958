//! Vehicles with forces against laws that their derivation does not contain: Newton and Euler by hand, conserved momenta,
//! symmetry, and the ideal motion that the kinematics gives.

use creepage::dynamics::{Dynamics, Masses, Start, TrailerMass, simulate_dynamics};
use creepage::formula::Expr;
use creepage::model::{Model, Trailer};
use creepage::motion::{Formulas, Integrator, Method, Table};
use creepage::vehicles;

fn inputs(formulas: &[&str]) -> Formulas {
    let parsed: Vec<Expr> = formulas.iter().map(|f| Expr::parse(f).unwrap()).collect();
    Formulas::new(&parsed, &[]).unwrap()
}

fn stiff() -> Integrator {
    Integrator { method: Method::Radau5, ..Integrator::default() }
}

fn start(speed: f64, trailers: usize) -> Start {
    Start { pose: vec![0.0; 3 + trailers], speed, ..Start::default() }
}

fn last(table: &Table, name: &str) -> f64 {
    *table.column(name).unwrap_or_else(|| panic!("no {name} in {:?}", table.names)).last().unwrap()
}

const CAR: [(&str, f64); 2] = [("wheel_radius", 0.3), ("wheelbase", 2.0)];

fn car(laws: &[(&str, &str, &[f64])]) -> Dynamics {
    let masses = Masses {
        mass: 8.0,
        inertia: 6.0,
        mass_offset: 0.9,
        wheels: [("theta'".into(), 0.2)].into(),
        ..Masses::default()
    };
    let car = Dynamics::new(&Model::new("car", &CAR).unwrap(), &masses).unwrap().driven_by(&["wheel_torque"]).unwrap();
    laws.iter().fold(car, |car, (contact, law, values)| car.with_law(contact, law, values).unwrap())
}

/// Newton and Euler for the car in its own frame, by hand: u, w of the rear axle, yaw rate, wheel rate.
fn by_hand([u, w, yaw, spin]: [f64; 4], delta: f64, torque: f64, b: [f64; 3]) -> [f64; 4] {
    let (m, inertia, a, r, wheelbase, wheel) = (8.0, 6.0, 0.9, 0.3, 2.0, 0.2);
    let (sin, cos) = delta.sin_cos();
    let drive = -b[0] * (u - r * spin);
    let rear = -b[1] * w;
    let front = -b[2] * (-u * sin + (w + wheelbase * yaw) * cos);
    let yaw_rate = (-a * rear + (wheelbase - a) * front * cos) / inertia;
    let forward = (drive - front * sin) / m + yaw * (w + a * yaw);
    let sideways = (rear + front * cos) / m - yaw * u - a * yaw_rate;
    [forward, sideways, yaw_rate, (torque - r * drive) / wheel]
}

#[test]
fn the_viscous_car_obeys_newton_and_euler() {
    let b = [40.0, 25.0, 30.0];
    let laws: Vec<(&str, &str, &[f64])> = vec![
        ("rear-axle-rolling", "viscous", &b[..1]),
        ("rear-axle-direction", "viscous", &b[1..2]),
        ("front-axle-direction", "viscous", &b[2..]),
    ];
    let begin = Start { lateral_speed: Some(0.3), yaw_rate: Some(-0.4), ..start(1.5, 0) };
    let drive = inputs(&["1 + sin(3*t)", "0.3*cos(2*t)"]);
    let table = simulate_dynamics(&car(&laws), &drive, &[0.0, 2.0], &begin, &stiff()).unwrap();
    let f = |t: f64, y: &[f64], dy: &mut [f64]| {
        let now = [y[0], y[1], y[2], y[3]];
        dy.copy_from_slice(&by_hand(now, 0.3 * (2.0 * t).cos(), 1.0 + (3.0 * t).sin(), b));
    };
    let spin = 1.5 / 0.3;
    let said = Integrator::default().solve(f, 0.0, &[1.5, 0.3, -0.4, spin], &[2.0]).unwrap().remove(0);
    for (name, said) in ["speed", "lateral_speed", "yaw_rate", "wheel_rate"].into_iter().zip(said) {
        assert!((last(&table, name) - said).abs() < 1e-7, "{name}: {} {said}", last(&table, name));
    }
}

/// Almost without friction nothing holds the chain but its hitches: momentum and angular momentum stay, and the inertia
/// of the bodies is all there is.
#[test]
fn hitches_keep_the_momenta() {
    let trailers = [Trailer { length: 1.2, hitch: 0.4 }, Trailer { length: 0.8, hitch: -0.1 }];
    let model = Model::new("car", &CAR).unwrap().with_trailers(&trailers);
    let weights = [
        TrailerMass { mass: 3.0, inertia: 0.7, mass_offset: 0.2 },
        TrailerMass { mass: 2.0, inertia: 0.5, mass_offset: -0.1 },
    ];
    let masses = Masses {
        mass: 5.0,
        inertia: 2.0,
        mass_offset: 0.6,
        wheels: [("theta'".into(), 0.1)].into(),
        trailers: weights.to_vec(),
        ..Masses::default()
    };
    let chain = Dynamics::new(&model, &masses).unwrap().with_laws("viscous", &[1e-12]).unwrap();
    let begin = Start {
        pose: vec![0.3, -0.2, 0.4, 0.9, -0.3],
        speed: 1.0,
        lateral_speed: Some(0.5),
        yaw_rate: Some(0.8),
        ..Start::default()
    };
    let times: Vec<f64> = (0..=200).map(|i| f64::from(i) * 0.01).collect();
    let table = simulate_dynamics(&chain, &inputs(&["0.1"]), &times, &begin, &stiff()).unwrap();
    // Places of the three centres of mass from the pose alone.
    let column = |name: &str| table.column(name).unwrap();
    let along = |h: f64, d: f64| [d * h.cos(), d * h.sin()];
    let centres = |i: usize| -> Vec<[f64; 3]> {
        let (mut p, mut h) = ([column("x")[i], column("y")[i]], column("heading")[i]);
        let mut found = vec![[p[0] + along(h, 0.6)[0], p[1] + along(h, 0.6)[1], h]];
        for (k, t) in trailers.iter().enumerate() {
            p = [p[0] - along(h, t.hitch)[0], p[1] - along(h, t.hitch)[1]];
            h = column(&format!("trailer_heading_{}", k + 1))[i];
            p = [p[0] - along(h, t.length)[0], p[1] - along(h, t.length)[1]];
            let offset = along(h, weights[k].mass_offset);
            found.push([p[0] + offset[0], p[1] + offset[1], h]);
        }
        found
    };
    let bodies = [(5.0, 2.0), (3.0, 0.7), (2.0, 0.5)];
    let momenta = |i: usize| {
        let (before, at, after) = (centres(i - 1), centres(i), centres(i + 1));
        let mut sum = [0.0; 3];
        for (k, (mass, inertia)) in bodies.iter().enumerate() {
            let rate = |c: usize| (after[k][c] - before[k][c]) / 0.02;
            let (vx, vy) = (rate(0), rate(1));
            sum[0] += mass * vx;
            sum[1] += mass * vy;
            sum[2] += mass * (at[k][0] * vy - at[k][1] * vx) + inertia * rate(2);
        }
        sum
    };
    let first = momenta(1);
    for i in [50, 120, 199] {
        for (now, then) in momenta(i).into_iter().zip(first) {
            assert!((now - then).abs() < 2e-3 * (1.0 + then.abs()), "{i}: {now} {then}");
        }
    }
    let energy = table.column("energy").unwrap();
    assert!(energy.iter().all(|e| (e - energy[0]).abs() < 1e-8 * energy[0]));
}

/// With ideal contacts the wheels' rates and the steering drive the kinematic model along the same path.
#[test]
fn ideal_contacts_give_the_kinematic_motion() {
    let trailers = [Trailer { length: 1.5, hitch: 0.3 }];
    #[allow(clippy::type_complexity)]
    let cases: [(&str, &[(&str, f64)], &[&str], &[&str]); 4] = [
        ("unicycle", &[("wheel_radius", 0.4)], &["wheel_torque", "yaw_torque"], &["2 + sin(t)", "cos(2*t)"]),
        (
            "differential-drive",
            &[("wheel_radius", 0.2), ("track_width", 0.6)],
            &["wheel_torque_left", "wheel_torque_right"],
            &["0.8", "0.6 + 0.3*sin(2*t)"],
        ),
        ("car", &CAR, &["wheel_torque"], &["2 + t", "0.3*sin(t)"]),
        ("tricycle", &CAR, &["wheel_torque"], &["2 + t", "0.3*sin(t)"]),
    ];
    let times: Vec<f64> = (0..=300).map(|i| f64::from(i) * 0.01).collect();
    for (vehicle, parameters, forces, drive) in cases {
        let model = Model::new(vehicle, parameters).unwrap().with_trailers(&trailers);
        let masses = Masses {
            mass: 4.0,
            inertia: 2.0,
            mass_offset: 0.3,
            trailers: vec![TrailerMass { mass: 1.0, inertia: 0.4, mass_offset: 0.1 }],
            ..Masses::default()
        };
        let forced = Dynamics::new(&model, &masses).unwrap().driven_by(forces).unwrap();
        let table = simulate_dynamics(&forced, &inputs(drive), &times, &start(0.5, 1), &Integrator::default()).unwrap();
        let columns: Vec<Vec<f64>> = model.inputs.iter().map(|i| table.column(i).unwrap().to_vec()).collect();
        let signals = creepage::motion::Signals::new(&times, &columns, creepage::motion::Timing::Sample);
        let said =
            creepage::motion::simulate_model(&model, &signals, &times, &[0.0; 4], &Integrator::default()).unwrap();
        for name in ["x", "y", "heading", "trailer_heading_1", "speed"] {
            let (found, said) = (last(&table, name), last(&said, name));
            assert!((found - said).abs() < 1e-6, "{vehicle} {name}: {found} {said}");
        }
        let (energy, power) = (table.column("energy").unwrap(), table.column("input_power").unwrap());
        let work: f64 = power.windows(2).map(|w| (w[0] + w[1]) * 0.005).sum();
        assert!((energy[300] - energy[0] - work).abs() < 1e-3 * work.abs(), "{vehicle}: {work}");
    }
}

/// Every vehicle of the catalogue: with viscous contacts it moves, loses what friction takes, and tends to its ideal
/// motion where that exists, castors and wheels that say the same twice included.
#[test]
fn every_vehicle_tends_to_its_ideal_motion() {
    let times: Vec<f64> = (0..=20).map(|i| f64::from(i) * 0.05).collect();
    // A body in the air has no contacts.
    for vehicle in vehicles::all().iter().filter(|v| v.coordinates.is_empty()) {
        let model = Model::sample(vehicle).unwrap();
        let wheels = vehicle.wheels.iter().filter_map(|w| w.rate.clone()).map(|rate| (rate, 0.1)).collect();
        let castors = vehicle.wheels.iter().filter_map(|w| w.steering.clone()).map(|angle| (angle, 0.05)).collect();
        let masses = Masses { mass: 2.0, inertia: 1.0, mass_offset: 0.2, wheels, castors, ..Masses::default() };
        let forced = Dynamics::new(&model, &masses).unwrap().driven_by(&["force"]).unwrap();
        let channels = forced.inputs().len();
        let drive: Vec<&str> = ["1 + t", "0.2*sin(t)", "0.2*sin(t)"][..channels].to_vec();
        let run = |d: &Dynamics, by: &Integrator| simulate_dynamics(d, &inputs(&drive), &times, &start(0.7, 0), by);
        let ideal = run(&forced, &Integrator::default()).unwrap_or_else(|e| panic!("{}: {e}", vehicle.id));
        let gap = |b: f64| {
            let free = forced.clone().with_laws("viscous", &[b]).unwrap();
            let free = run(&free, &stiff()).unwrap_or_else(|e| panic!("{}: {e}", vehicle.id));
            assert!(free.column("friction_power").unwrap().iter().all(|p| *p <= 1e-12), "{}", vehicle.id);
            ["x", "y", "heading", "speed"].iter().map(|n| (last(&free, n) - last(&ideal, n)).abs()).fold(0.0, f64::max)
        };
        let (wide, narrow) = (gap(1e4), gap(1e5));
        println!("{}: {wide:e} {narrow:e}", vehicle.id);
        // Nothing slips where nothing pulls at the contact.
        assert!(wide < 1e-9 || (wide / narrow - 10.0).abs() < 0.5, "{}: {wide:e} {narrow:e}", vehicle.id);
        assert!(wide < 0.01, "{}: {wide:e}", vehicle.id);
    }
}

#[test]
fn a_rate_of_steering_moves_the_angle() {
    let masses = Masses { mass: 3.0, inertia: 1.0, wheels: [("theta'".into(), 0.1)].into(), ..Masses::default() };
    let model = Model::new("car", &CAR).unwrap();
    let by_angle = Dynamics::new(&model, &masses).unwrap().driven_by(&["wheel_torque"]).unwrap();
    let by_rate = by_angle.clone().steered_by_rate();
    assert_eq!(by_rate.inputs(), ["wheel_torque", "steering_rate"]);
    for (by, law) in [(Integrator::default(), None), (stiff(), Some(1e4))] {
        let with = |d: &Dynamics| law.map_or(d.clone(), |b| d.clone().with_laws("viscous", &[b]).unwrap());
        let one =
            simulate_dynamics(&with(&by_angle), &inputs(&["1", "0.1 + 0.3*sin(t)"]), &[0.0, 2.0], &start(1.0, 0), &by);
        let begin = Start { steering_angle: 0.1, ..start(1.0, 0) };
        let two = simulate_dynamics(&with(&by_rate), &inputs(&["1", "0.3*cos(t)"]), &[0.0, 2.0], &begin, &by);
        let (one, two) = (one.unwrap(), two.unwrap());
        for name in ["x", "y", "heading", "steering_angle", "wheel_rate"] {
            assert!(
                (last(&one, name) - last(&two, name)).abs() < 1e-7,
                "{name}: {} {}",
                last(&one, name),
                last(&two, name)
            );
        }
    }
}

#[test]
fn what_cannot_move_is_an_error() {
    let model = Model::new("unicycle", &[("wheel_radius", 0.5)]).unwrap();
    let weightless = Dynamics::new(&model, &Masses { mass: 1.0, inertia: 1.0, ..Masses::default() }).unwrap();
    let viscous = weightless.clone().with_laws("viscous", &[10.0]).unwrap();
    let run = |d: &Dynamics, s: &Start| simulate_dynamics(d, &inputs(&[]), &[0.0, 1.0], s, &stiff());
    let error = run(&viscous, &start(1.0, 0)).unwrap_err().to_string();
    assert!(error.contains("how theta accelerates") && error.contains("moment of inertia"), "{error}");
    assert!(run(&weightless, &start(1.0, 0)).is_ok());
    let skids = Start { lateral_speed: Some(0.2), ..start(1.0, 0) };
    let error = run(&weightless, &skids).unwrap_err().to_string();
    assert!(error.contains("wheel-direction slip by 0.2"), "{error}");
    let rocard = weightless.clone().with_law("wheel-direction", "rocard", &[10.0]).unwrap();
    let error = run(&rocard, &start(0.0, 0)).unwrap_err().to_string();
    assert!(error.contains("undefined at the start") && error.contains("elastic"), "{error}");
    for (contact, law, values) in
        [("wheel-rolling", "sticky", &[1.0][..]), ("axle", "viscous", &[1.0]), ("wheel-rolling", "viscous", &[])]
    {
        assert_eq!(weightless.clone().with_law(contact, law, values).unwrap_err().exit_code(), 2);
    }
    assert!(weightless.clone().driven_by(&["wind"]).unwrap_err().to_string().contains("yaw_torque"));
}

/// The pose that is given is the sensor's, wherever on the body it sits and however it is turned.
#[test]
fn a_motion_begins_where_the_sensor_is_said_to_be() {
    let mut model = Model::new("car", &CAR).unwrap();
    model.sensor.lever_arm = [0.7, -0.3];
    model.sensor.heading_offset = 0.2;
    let masses = Masses { mass: 8.0, inertia: 6.0, wheels: [("theta'".into(), 0.2)].into(), ..Masses::default() };
    let car = Dynamics::new(&model, &masses).unwrap().driven_by(&["wheel_torque"]).unwrap();
    let begin = Start { pose: vec![4.0, -1.5, 0.9], speed: 1.0, ..Start::default() };
    let table = simulate_dynamics(&car, &inputs(&["0.1", "0.2"]), &[0.0, 0.1], &begin, &Integrator::default()).unwrap();
    let [x, y, heading] = ["x", "y", "heading"].map(|name| table.column(name).unwrap()[0]);
    assert!((x - 4.0).abs() < 1e-12 && (y + 1.5).abs() < 1e-12 && (heading - 0.9).abs() < 1e-12, "{x} {y} {heading}");
}
