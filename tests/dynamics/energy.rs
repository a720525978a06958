//! Energy: kept by ideal contacts, lost to friction, gained from the inputs; and motions that do not depend on where they
//! are seen from.

use creepage::dynamics::{Dynamics, Masses, Start, TrailerMass, simulate_dynamics};
use creepage::formula::Expr;
use creepage::model::{Model, Trailer};
use creepage::motion::{Formulas, Integrator, Method, Table};

fn train() -> Dynamics {
    let model = Model::new("differential-drive", &[("wheel_radius", 0.2), ("track_width", 0.6)]).unwrap();
    let model = model.with_trailers(&[Trailer { length: 0.8, hitch: 0.2 }, Trailer { length: 0.6, hitch: 0.0 }]);
    let trailer = TrailerMass { mass: 1.5, inertia: 0.3, mass_offset: 0.1 };
    let masses = Masses {
        mass: 3.0,
        inertia: 0.8,
        mass_offset: 0.1,
        wheels: [("theta_1'".into(), 0.02), ("theta_2'".into(), 0.02)].into(),
        trailers: vec![trailer; 2],
        ..Masses::default()
    };
    let forces = ["wheel_torque_left", "wheel_torque_right"];
    Dynamics::new(&model, &masses).unwrap().driven_by(&forces).unwrap()
}

fn run(d: &Dynamics, torques: [&str; 2], place: [f64; 3], mirror: f64) -> Table {
    let [x, y, turn] = place;
    let pose = vec![x, y, turn + mirror * 0.3, turn + mirror * 0.1, turn - mirror * 0.2];
    let start = Start { pose, speed: 0.8, ..Start::default() };
    let method = if d.has_friction() { Method::Radau5 } else { Method::Dop853 };
    let formulas: Vec<Expr> = torques.iter().map(|t| Expr::parse(t).unwrap()).collect();
    let times: Vec<f64> = (0..=400).map(|i| f64::from(i) * 0.005).collect();
    let by = Integrator { method, ..Integrator::default() };
    simulate_dynamics(d, &Formulas::new(&formulas, &[]).unwrap(), &times, &start, &by).unwrap()
}

#[test]
fn without_inputs_ideal_contacts_keep_the_energy() {
    let table = run(&train(), ["0", "0"], [0.0; 3], 1.0);
    let energy = table.column("energy").unwrap();
    assert!(energy[0] > 0.5 && energy.iter().all(|e| (e - energy[0]).abs() < 1e-8), "{} {}", energy[0], energy[400]);
    for name in table.names.iter().filter(|n| n.starts_with("slip.")) {
        assert!(table.column(name).unwrap().iter().all(|s| s.abs() < 1e-8), "{name}");
    }
}

#[test]
fn what_the_inputs_give_and_friction_takes_is_what_changes() {
    for d in [train(), train().with_laws("viscous", &[8.0]).unwrap()] {
        let table = run(&d, ["0.3 + 0.2*sin(3*t)", "0.4"], [0.0; 3], 1.0);
        let column = |name: &str| table.column(name).unwrap();
        let power: Vec<f64> = column("input_power").iter().zip(column("friction_power")).map(|(a, b)| a + b).collect();
        let weight = |i: usize| if i == 0 || i == 400 { 1.0 } else { 2.0 + 2.0 * (i % 2) as f64 };
        let work: f64 = power.iter().enumerate().map(|(i, p)| weight(i) * p * 0.005 / 3.0).sum();
        let gained = column("energy")[400] - column("energy")[0];
        assert!((gained - work).abs() < 1e-7, "{gained} {work}");
        assert!(column("friction_power").iter().all(|p| *p <= 1e-12));
    }
}

/// The same from another place, and seen in a mirror.
#[test]
fn the_motion_does_not_depend_on_where_it_is_seen_from() {
    let d = train().with_laws("viscous", &[15.0]).unwrap();
    let torques = ["0.3 + 0.2*sin(3*t)", "0.4"];
    let here = run(&d, torques, [0.0; 3], 1.0);
    let there = run(&d, torques, [2.0, -1.0, 0.7], 1.0);
    let mirrored = run(&d, [torques[1], torques[0]], [0.0; 3], -1.0);
    let last = |t: &Table, name: &str| *t.column(name).unwrap().last().unwrap();
    let (sin, cos) = 0.7f64.sin_cos();
    let (x, y) = (last(&here, "x"), last(&here, "y"));
    assert!((last(&there, "x") - (2.0 + x * cos - y * sin)).abs() < 1e-8);
    assert!((last(&there, "y") - (-1.0 + x * sin + y * cos)).abs() < 1e-8);
    for (name, sign) in [("x", 1.0), ("y", -1.0), ("heading", -1.0), ("trailer_heading_2", -1.0), ("speed", 1.0)] {
        assert!((last(&mirrored, name) - sign * last(&here, name)).abs() < 1e-8, "{name}");
    }
    assert!((last(&there, "trailer_heading_1") - last(&here, "trailer_heading_1") - 0.7).abs() < 1e-8);
}
