//! The derived equations against what a textbook has for the same system.

use creepage::dynamics::{Dynamics, Masses, TrailerMass};
use creepage::formula::{Expr, Symbol, identical};
use creepage::model::{Model, Trailer};
use creepage::vehicles::named;

fn is(found: &Expr, said: &str) {
    assert_eq!(identical(found, &Expr::parse(said).unwrap()), Some(true), "{found} is not {said}");
}

#[test]
fn the_disk() {
    let model = Model::new("disk", &[("wheel_radius", 0.5)]).unwrap();
    let disk = Dynamics::new(&model, &Masses::default()).unwrap().driven_by(&["force", "wheel_torque"]).unwrap();
    let f = disk.with_laws("viscous", &[1.0]).unwrap().formulas().unwrap();
    for (i, row) in [["body.mass", "0"], ["0", "theta.inertia"]].iter().enumerate() {
        row.iter().enumerate().for_each(|(k, said)| is(&f.mass[i][k], said));
        is(&f.bias[i], "0");
    }
    is(&f.slips[0], "s' - r*theta'");
    is(&f.force[0], "force - contact_1.coefficient*(s' - r*theta')");
    is(&f.force[1], "wheel_torque + r*contact_1.coefficient*(s' - r*theta')");
}

#[test]
fn a_body_with_its_centre_of_mass_ahead() {
    let model = Model::new("unicycle", &[("wheel_radius", 0.5)]).unwrap();
    let f = Dynamics::new(&model, &Masses::default()).unwrap().formulas().unwrap();
    let (m, a) = ("body.mass", "body.mass_offset");
    is(&f.mass[0][2], &format!("-{m}*{a}*sin(phi)"));
    is(&f.mass[1][2], &format!("{m}*{a}*cos(phi)"));
    is(&f.mass[2][2], &format!("body.inertia + {m}*{a}^2"));
    is(&f.mass[3][3], "theta.inertia");
    is(&f.bias[0], &format!("-{m}*{a}*cos(phi)*phi'^2"));
    is(&f.bias[1], &format!("-{m}*{a}*sin(phi)*phi'^2"));
    is(&f.bias[2], "0");
    assert_eq!(f.forces.iter().map(ToString::to_string).collect::<Vec<_>>(), ["contact_1.force", "contact_2.force"]);
}

/// A trailer is a double pendulum laid flat: its share of the mass matrix is known.
#[test]
fn a_trailer_couples_as_a_double_pendulum_does() {
    let model = Model::new("unicycle", &[("wheel_radius", 0.5)]).unwrap();
    let model = model.with_trailers(&[Trailer { length: 1.0, hitch: 0.5 }]);
    let masses = Masses { trailers: vec![TrailerMass::default()], ..Masses::default() };
    let f = Dynamics::new(&model, &masses).unwrap().formulas().unwrap();
    let place = |name: &str| f.coordinates.iter().position(|q| q.as_str() == name).unwrap();
    let (phi, own) = (place("phi"), place("phi_1"));
    let (m, d) = ("trailer_1.mass", "(d_1 - trailer_1.mass_offset)");
    is(&f.mass[own][own], &format!("trailer_1.inertia + {m}*{d}^2"));
    is(&f.mass[phi][own], &format!("{m}*c_1*{d}*cos(phi - phi_1)"));
    is(&f.mass[phi][phi], "body.inertia + body.mass*body.mass_offset^2 + trailer_1.mass*c_1^2");
    is(&f.bias[own], &format!("-{m}*c_1*{d}*sin(phi - phi_1)*phi'^2"));
}

/// M is symmetric, and Ṁ − 2h's matrix is skew: q̇·(Ṁ·q̇ − 2·h) = 0, the form of every Lagrangian system.
#[test]
fn mass_and_bias_belong_together() {
    let model = Model::new("car", &[("wheel_radius", 0.3), ("wheelbase", 2.0)]).unwrap();
    let model = model.with_trailers(&[Trailer { length: 1.0, hitch: 0.5 }]);
    let masses = Masses { trailers: vec![TrailerMass::default()], ..Masses::default() };
    let car = Dynamics::new(&model, &masses).unwrap();
    let f = car.formulas().unwrap();
    let n = f.coordinates.len();
    let rate = |i: usize| Expr::sym(f.coordinates[i].rate());
    let sum = |parts: Vec<Expr>| parts.iter().fold(Expr::int(0), |s, e| &s + e);
    for i in 0..n {
        (0..i).for_each(|k| assert_eq!(identical(&f.mass[i][k], &f.mass[k][i]), Some(true)));
    }
    let mut carried = Vec::new();
    for i in 0..n {
        for k in 0..n {
            let along = sum((0..n).map(|j| &f.mass[i][k].derivative(&f.coordinates[j]) * &rate(j)).collect());
            carried.push(&(&along * &rate(i)) * &rate(k));
        }
    }
    let twice = sum((0..n).map(|i| &(&Expr::int(2) * &f.bias[i]) * &rate(i)).collect());
    assert_eq!(identical(&sum(carried), &twice), Some(true));
    // T is a quadratic form with the matrix M.
    let form = sum((0..n * n).map(|c| &(&f.mass[c / n][c % n] * &rate(c / n)) * &rate(c % n)).collect());
    assert_eq!(identical(&(&form / &Expr::int(2)), &car.energy()), Some(true));
}

/// A castor turns with the body and about its own axis; both count.
#[test]
fn a_castor_has_the_energy_of_its_whole_turning() {
    let sizes = ["wheel_radius", "track_width", "castor_offset", "castor_trail", "castor_wheel_radius"];
    let model = Model::new("differential-drive-castor", &sizes.map(|name| (name, 0.5))).unwrap();
    let energy = Dynamics::new(&model, &Masses::default()).unwrap().energy();
    let at = |turning: f64| {
        let value = |s: &Symbol| match s.as_str() {
            "phi'" => 1.0,
            "gamma'" => turning,
            "gamma.inertia" => 5.0,
            _ => 0.0,
        };
        energy.eval(&value).unwrap()
    };
    assert_eq!([at(1.0), at(0.0), at(-1.0)], [10.0, 2.5, 0.0]);
}

/// One motor on two wheels: its torque is shared, and what it delivers is the mean of what it turns.
#[test]
fn wheels_of_one_motor_share_its_torque() {
    let mut vehicle = named("differential-drive").unwrap().clone();
    let right = vehicle.define[&Symbol::new("theta_1'")].formula.clone();
    vehicle.define.get_mut(&Symbol::new("theta_2'")).unwrap().formula = right;
    let model = Model::of(&vehicle, &[("wheel_radius", 0.5), ("track_width", 0.4)]).unwrap();
    let shared = Dynamics::new(&model, &Masses::default()).unwrap().driven_by(&["wheel_torque_right"]).unwrap();
    is(&shared.input_power(), "wheel_torque_right*(theta_1' + theta_2')/2");
    assert!(shared.driven_by(&["wheel_torque_left"]).is_err());
}
