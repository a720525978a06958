//! The generator of vehicles draws every kind of thing that the theorems are said to hold for.

use crate::met::Met;
use crate::support::check;
use creepage::claims::generated::{
    ConstrainedMotion, Drive, Facing, Generated, Placed, any_drive, loose_vehicles, vehicles,
};
use creepage::formula::{Exact, Fun, Scalar, Symbol};
use proptest::prelude::*;

/// How a fixed wheel faces beside another one: cos of the angle between them.
fn beside(wheel: &Placed, other: &Placed) -> &'static str {
    let (Facing::Fixed(a), Facing::Fixed(b)) = (&wheel.facing, &other.facing) else { return "of no fixed heading" };
    match Exact::call(Fun::Cos, &a.sub(b)).to_f64() {
        c if c > 1.0 - 1e-12 => "facing alike",
        c if c < 1e-12 - 1.0 => "facing backwards",
        _ => "at an angle",
    }
}

fn sign(v: &Exact) -> &'static str {
    match v.to_f64() {
        v if v > 0.0 => "behind",
        v if v < 0.0 => "ahead of",
        _ => "on",
    }
}

fn note_wheels(drawn: &Met, vehicle: &Generated) {
    let Some(wheels) = vehicle.wheels() else { return drawn.note("nowhere to turn about", true) };
    drawn.note(format!("{:?}", vehicle.drive), true);
    let axle = wheels.iter().find(|w| w.name.starts_with("axle")).unwrap_or(&wheels[0]);
    let further: Vec<&Placed> = wheels.iter().filter(|w| w.k > 10).collect();
    drawn.note(format!("{} further wheels", further.len()), true);
    for wheel in further {
        drawn.note(
            match wheel.facing {
                Facing::Castor => "further castor".to_string(),
                Facing::Steered => "further steered wheel".into(),
                Facing::Fixed(_) => format!("further wheel {}", beside(wheel, axle)),
            },
            true,
        );
        drawn.note(if wheel.place[1].to_f64() < 0.0 { "to the right" } else { "to the left" }, true);
    }
    if vehicle.drive == Drive::Differential {
        drawn.note(format!("driven wheels {}", beside(&wheels[1], &wheels[0])), true);
    }
    if let Facing::Fixed(axle) = &wheels[0].facing {
        drawn.note(if axle.to_f64() == 0.0 { "axle across the body" } else { "axle at an angle to the body" }, true);
    }
}

fn note_configuration(drawn: &Met, vehicle: &Generated) {
    let at = vehicle.point();
    let named = |name: &str| at.value(&Symbol::new(name));
    drawn.note(format!("{} trailers", vehicle.trailers()), true);
    for i in 1..=vehicle.trailers() {
        drawn.note(format!("hitch {} the axle", sign(&named(&format!("c_{i}")))), true);
        drawn.note(if named(&format!("phi_{i}")).to_f64() == 0.0 { "trailer along x" } else { "trailer turned" }, true);
        drawn.note(if named(&format!("d_{i}")).to_f64() < 0.5 { "short bar" } else { "long bar" }, true);
    }
    for angle in ["phi", "delta"] {
        drawn.note(format!("{angle} {}", if named(angle).to_f64() == 0.0 { "zero" } else { "turned" }), true);
    }
}

#[test]
fn every_kind_of_vehicle_is_drawn() {
    let drawn = Met::default();
    check(600, vehicles(any_drive(), 3, 10), |vehicle| {
        note_wheels(&drawn, &vehicle);
        note_configuration(&drawn, &vehicle);
        drawn.note(if vehicle.is_regular() { "regular" } else { "singular" }, true);
        Ok(())
    });
    let drives = ["Unicycle", "Differential", "Car", "Tricycle", "Splayed"];
    drawn.at_least(&drives.map(|d| (d, 60)));
    drawn.at_least(&["0", "1", "2", "3"].map(|n| format!("{n} further wheels")).each_ref().map(|n| (n.as_str(), 60)));
    let trains: Vec<String> = (0..=10).map(|n| format!("{n} trailers")).collect();
    drawn.at_least(&trains.iter().map(|n| (n.as_str(), 25)).collect::<Vec<_>>());
    drawn.at_least(&[
        ("hitch behind the axle", 300),
        ("hitch ahead of the axle", 300),
        ("hitch on the axle", 40),
        ("trailer turned", 1000),
        ("short bar", 100),
        ("long bar", 500),
        ("phi turned", 300),
        ("delta turned", 300),
        ("further castor", 80),
        ("further wheel facing alike", 60),
        ("further wheel facing backwards", 30),
        ("further wheel at an angle", 150),
        ("to the left", 200),
        ("to the right", 100),
        ("driven wheels facing alike", 20),
        ("driven wheels facing backwards", 20),
        ("axle at an angle to the body", 300),
        ("regular", 300),
    ]);
}

#[test]
fn vehicles_drive_straight_and_turn() {
    let drawn = Met::default();
    check(300, vehicles(Just(Drive::Splayed), 0, 0), |vehicle| {
        // Splayed wheels have nowhere to turn about where the vehicle drives straight.
        drawn.note(if vehicle.wheels().is_none() { "straight" } else { "turning" }, true);
        Ok(())
    });
    drawn.at_least(&[("straight", 40), ("turning", 120)]);
}

#[test]
fn loose_wheels_stand_anywhere() {
    let drawn = Met::default();
    check(200, loose_vehicles(any_drive(), 3, 0), |vehicle| {
        note_wheels(&drawn, &vehicle);
        Ok(())
    });
    drawn.at_least(&[("further castor", 30), ("further wheel at an angle", 100)]);
}

/// The unicycle by its constraints: x′ = r·θ̇·(1 − e_rc)·(cos φ − e·sin φ), in any configuration.
#[test]
fn constraints_tell_the_motion_of_a_wheel() {
    let drawn = Met::default();
    check(100, vehicles(Just(Drive::Unicycle), 0, 0), |vehicle| {
        let Some(motion) = ConstrainedMotion::of(&vehicle) else { return Ok(()) };
        let wheel = vehicle.wheels().unwrap().remove(0);
        let Facing::Fixed(mounted) = &wheel.facing else { return Ok(()) };
        let psi = vehicle.point().value(&"phi".into()).to_f64() + mounted.to_f64();
        let measured: Vec<f64> = motion.measured().map(|name| if name == "phi" { 0.4 } else { 2.0 }).collect();
        let (e_rc, e) = (0.1, -0.2);
        let q = motion.rates(motion.start(), &measured, &[e_rc, e]).unwrap();
        let along = wheel.radius.unwrap().to_f64() * 2.0 * (1.0 - e_rc);
        let wanted = [along * (psi.cos() - e * psi.sin()), along * (psi.sin() + e * psi.cos())];
        for (name, wanted) in ["x", "y"].iter().zip(wanted) {
            let found = q[motion.place(name).unwrap()];
            prop_assert!((found - wanted).abs() < 1e-12 * (1.0 + along.abs()), "{name}: {found} {wanted}");
        }
        drawn.note("moved", true);
        Ok(())
    });
    drawn.at_least(&[("moved", 90)]);
}
