//! The equations in quasi-velocities against those of Lagrange with multipliers, at states drawn at random.

use creepage::dynamics::{Dynamics, Masses, TrailerMass};
use creepage::effects::{self, Applied, Effect};
use creepage::model::{Model, Trailer};
use creepage::vehicles;
use proptest::prelude::*;

/// A vehicle with all its masses, its steering and one number for each thing that moves.
struct Case {
    dynamics: Dynamics,
    numbers: Vec<f64>,
}

fn forces_of(vehicle: &str) -> &'static [&'static str] {
    match vehicle {
        "disk" => &["wheel_torque", "force"],
        "sleigh" => &["force", "lateral_force", "yaw_torque"],
        "unicycle" | "car" | "tricycle" => &["wheel_torque", "lateral_force", "yaw_torque"],
        "differential-drive" => &["wheel_torque_left", "wheel_torque_right", "force"],
        _ => &["force"],
    }
}

/// Laws by the number of the contact: ideal, viscous, Rocard's, elastic.
fn with_laws(dynamics: Dynamics, pattern: usize) -> Dynamics {
    let names: Vec<String> = dynamics.contacts.iter().map(|c| c.name.clone()).collect();
    names.iter().enumerate().fold(dynamics, |d, (i, name)| match (pattern, i % 3) {
        (0, _) | (2, 0) => d,
        (1, _) | (2, 1) => d.with_law(name, "viscous", &[7.0 + i as f64]).unwrap(),
        (2, _) | (3, 0) => d.with_law(name, "elastic", &[20.0 + i as f64, 0.4]).unwrap(),
        _ => d.with_law(name, "rocard", &[15.0 + i as f64]).unwrap(),
    })
}

fn case(vehicle: usize, trailers: usize, pattern: usize, numbers: Vec<f64>) -> Option<Case> {
    let vehicle = &vehicles::all()[vehicle];
    if !vehicle.coordinates.is_empty() || !vehicle.trailers.is_empty() {
        return None;
    }
    let trailers = if vehicle.pulls() { trailers } else { 0 };
    let train: Vec<Trailer> = (0..trailers).map(|i| Trailer { length: 1.1 + 0.3 * i as f64, hitch: 0.2 }).collect();
    let model = Model::sample(vehicle).ok()?.with_trailers(&train);
    let rates = vehicle.wheels.iter().filter_map(|w| w.rate.clone());
    let castors = vehicle.wheels.iter().filter_map(|w| w.steering.clone()).filter(|s| vehicle.is_free(s));
    let masses = Masses {
        mass: 3.0 + numbers[0],
        inertia: 1.5 + numbers[1],
        mass_offset: 0.4 * numbers[2],
        wheels: rates.enumerate().map(|(i, r)| (r, 0.3 + 0.1 * i as f64)).collect(),
        castors: castors.map(|a| (a, 0.2)).collect(),
        trailers: (0..trailers)
            .map(|i| TrailerMass { mass: 1.0 + i as f64, inertia: 0.6, mass_offset: 0.3 * numbers[3] })
            .collect(),
    };
    let dynamics = Dynamics::new(&model, &masses).ok()?.driven_by(forces_of(&vehicle.id)).ok()?;
    Some(Case { dynamics: with_laws(dynamics, pattern), numbers })
}

impl Case {
    /// The largest difference between the two, and how large what is compared is; `None` where the vehicle is refused.
    fn compared(&self) -> Option<(f64, f64)> {
        let model = self.dynamics.model().ok()?;
        self.dynamics.compile().ok()?;
        let states = model.equations(&[]).unwrap().states;
        let number = |i: usize| self.numbers[i % self.numbers.len()];
        // A speed ahead, for laws that are undefined at rest.
        let ahead = |i: usize| if states[i].as_str() == "body.u" { 1.5 } else { 0.0 };
        let state = |i: usize| 0.4 * number(i + 4) + 0.1 + ahead(i);
        let pairs = self.dynamics.both_formulations(state, |i| 0.3 * number(i + 9), |i| 0.2 * number(i + 13)).unwrap();
        assert_eq!(pairs.len(), states.len());
        let mut worst = (0.0_f64, 0.0_f64);
        for (name, rate, other) in pairs {
            assert!(rate.is_finite() && other.is_finite(), "{name}: {rate} {other}");
            worst = (worst.0.max((rate - other).abs()), worst.1.max(other.abs()));
        }
        Some(worst)
    }
}

/// Every vehicle of the catalogue that forces may drive, with every kind of contact and up to two trailers.
#[test]
fn every_vehicle_has_the_same_accelerations() {
    let numbers: Vec<f64> = (0..23).map(|i| (1.3 * f64::from(i)).sin()).collect();
    let mut compared = std::collections::BTreeSet::new();
    for (v, vehicle) in vehicles::all().iter().enumerate() {
        for (trailers, pattern) in (0..3).flat_map(|t| (0..4).map(move |p| (t, p))) {
            let Some(case) = case(v, trailers, pattern, numbers.clone()) else { continue };
            let Some((off, size)) = case.compared() else { continue };
            assert!(off < 1e-10 * (1.0 + size), "{} {trailers} {pattern}: {off} of {size}", vehicle.id);
            compared.insert((vehicle.id.clone(), pattern));
        }
    }
    let of = |pattern: usize| compared.iter().filter(|(_, p)| *p == pattern).count();
    assert!(of(0) >= 6 && of(1) >= 10 && of(2) >= 6 && of(3) >= 10, "{compared:?}");
}

proptest! {
    #[test]
    fn drawn_states_have_the_same_accelerations(
        vehicle in 0..vehicles::all().len(),
        trailers in 0..4_usize,
        pattern in 0..4_usize,
        numbers in prop::collection::vec(-1.0..1.0f64, 23),
    ) {
        if let Some((off, size)) = case(vehicle, trailers, pattern, numbers).and_then(|case| case.compared()) {
            prop_assert!(off < 1e-9 * (1.0 + size), "{off} of {size}");
        }
    }
}

/// What an effect of plausible size changes of the rates at many states of some vehicles, as one long vector.
fn changed(effect: &Effect, models: &[Model]) -> Vec<f64> {
    let mut found = Vec::new();
    for model in models {
        let bare = model.equations(&[]).unwrap();
        let trailer = effect.per_trailer.then_some(1);
        let applies = !model.applicable(std::slice::from_ref(effect)).is_empty();
        let sizes = effect.parameters.values().map(|p| p.start.last().copied().filter(|s| *s != 0.0).unwrap_or(p.size));
        let applied = Applied::new(effect, trailer, sizes.collect());
        let with = if applies { model.clone().with_effect(applied).equations(&[]).unwrap() } else { bare.clone() };
        for k in 0..30 {
            let at = |i: usize| (2.3 * f64::from(k) + 1.7 * i as f64).sin();
            let mut z: Vec<f64> = (0..bare.n()).map(at).collect();
            z[bare.poses] += 1.5;
            let u: Vec<f64> = (0..bare.inputs.len()).map(|i| 0.3 * at(i + 50)).collect();
            let rates = |e: &creepage::model::Equations| {
                let mut rates = vec![0.0; e.n()];
                e.rates(&mut e.workspace(&[]), &z, &u, &mut rates);
                rates
            };
            found.extend(rates(&with).iter().zip(rates(&bare)).map(|(a, b)| a - b));
        }
    }
    found
}

/// Every effect of forces changes the motion of a robot or of a train, and no two change it alike.
#[test]
fn effects_of_forces_are_told_from_one_another() {
    let robot = Model::new("differential-drive", &[("wheel_radius", 0.1), ("track_width", 0.5)]).unwrap();
    let wheels = [("theta_1'".into(), 0.05), ("theta_2'".into(), 0.05)].into();
    let masses = Masses { mass: 20.0, inertia: 1.0, mass_offset: 0.1, wheels, ..Masses::default() };
    let robot =
        Dynamics::new(&robot, &masses).unwrap().driven_by(&["wheel_torque_left", "wheel_torque_right"]).unwrap();
    let robot = robot.with_laws("viscous", &[200.0]).unwrap().model().unwrap();
    let car = Model::new("car", &[("wheel_radius", 0.3), ("wheelbase", 2.6)]).unwrap();
    let car = car.with_trailers(&[Trailer { length: 2.0, hitch: 0.3 }]);
    let trailers = vec![TrailerMass { mass: 5.0, inertia: 6.0, mass_offset: 0.2 }];
    let wheels = [("theta'".into(), 0.2)].into();
    let masses = Masses { mass: 12.0, inertia: 15.0, mass_offset: 1.2, wheels, trailers, ..Masses::default() };
    let car = Dynamics::new(&car, &masses).unwrap().driven_by(&["wheel_torque"]).unwrap();
    let models = [robot, car.with_laws("viscous", &[40.0]).unwrap().model().unwrap()];
    let places = ["mass", "drive", "force on the body", "contact force"];
    let all: Vec<&Effect> = effects::all().iter().filter(|e| places.contains(&e.place.as_str())).collect();
    assert_eq!(all.len(), 23);
    let changes: Vec<Vec<f64>> = all.iter().map(|e| changed(e, &models)).collect();
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    for (i, (a, own)) in changes.iter().zip(&all).enumerate() {
        assert!(a.iter().all(|v| v.is_finite()) && dot(a, a) > 0.0, "{} changes nothing", own.id);
        for (b, other) in changes[..i].iter().zip(&all) {
            let alike = dot(a, b).abs() / (dot(a, a) * dot(b, b)).sqrt();
            assert!(alike < 0.9999, "{} and {} are alike: {alike}", own.id, other.id);
        }
    }
}
