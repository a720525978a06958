//! The vehicles that claims are tried on: their wheels differ, they can move, and the rows know it.

use crate::met::Met;
use crate::support::{Outcome, check};
use creepage::claims::generated::{
    Drive, Facing, Generated, Moving, Placed, any_drive, loose_vehicles, moving, vehicles,
};
use creepage::claims::written;
use creepage::formula::{BigRational, Exact, Fun, Scalar, Symbol};
use creepage::mechanism::{Constraint, Mechanism, Point};
use proptest::prelude::*;
use std::collections::BTreeSet;

fn rolling_and_fixed(vehicle: &Generated) -> (Vec<Placed>, Vec<Exact>) {
    let wheels = vehicle.wheels().unwrap_or_default();
    let heading = |w: &Placed| match &w.facing {
        Facing::Fixed(heading) => Some(heading.clone()),
        _ => None,
    };
    let headings = wheels.iter().filter_map(heading).collect();
    (wheels, headings)
}

fn number(v: &Exact) -> BigRational {
    v.as_rational().cloned().unwrap_or_else(|| panic!("{v} is no number"))
}

fn cos_and_sin(angle: &Exact) -> [BigRational; 2] {
    [Fun::Cos, Fun::Sin].map(|f| number(&Exact::call(f, angle)))
}

#[test]
fn wheels_of_one_vehicle_have_different_radii_and_headings() {
    let met = Met::default();
    check(300, vehicles(any_drive(), 3, 0), |vehicle| {
        let (wheels, headings) = rolling_and_fixed(&vehicle);
        let at = vehicle.point();
        let radii: Vec<Exact> = wheels.iter().filter_map(|w| w.radius.clone()).collect();
        let different: BTreeSet<String> = radii.iter().map(ToString::to_string).collect();
        prop_assert_eq!(different.len(), radii.len());
        // Of the wheels of an axle the direction is the axle's.
        let directed = wheels.iter().filter(|w| w.k <= 3 && w.directed).count();
        let axles = if matches!(vehicle.drive, Drive::Unicycle | Drive::Differential) { 1 } else { 2 };
        prop_assert!(wheels.is_empty() || directed == axles, "{}", directed);
        for wheel in wheels.iter().filter(|w| w.radius.is_some()) {
            let known = at.value(&Symbol::new(&format!("r_{}", wheel.k)));
            prop_assert!(known.equals(wheel.radius.as_ref().unwrap()), "{}", wheel);
        }
        let towards: BTreeSet<_> = headings.iter().map(cos_and_sin).collect();
        let one = BigRational::from(1);
        prop_assert!(towards.iter().all(|[cos, sin]| cos * cos + sin * sin == one));
        met.note("two radii", radii.len() > 1);
        met.note("five radii", radii.len() > 4);
        met.note("two headings", towards.len() > 1);
        met.note("four headings", towards.len() > 3);
        met.note("none along the body", !headings.is_empty() && towards.iter().all(|[_, sin]| !sin.is_zero()));
        met.note("backwards", towards.iter().any(|[c, s]| towards.contains(&[-c, -s])));
        met.note("castor", wheels.iter().any(|w| matches!(w.facing, Facing::Castor)));
        Ok(())
    });
    met.at_least(&[("two radii", 200), ("five radii", 20), ("two headings", 150), ("four headings", 10)]);
    met.at_least(&[("none along the body", 150), ("backwards", 60), ("castor", 60)]);
}

/// What an ideal vehicle has besides turning wheels: the pose, and the steering angle.
fn freedoms(vehicle: &Generated, mechanism: &Mechanism) -> usize {
    let steered = matches!(vehicle.drive, Drive::Car | Drive::Tricycle);
    mechanism.coordinates.len() - mechanism.rank(&vehicle.point()).unwrap() - usize::from(steered)
}

#[test]
fn made_around_a_motion_they_have_one() {
    let met = Met::default();
    check(200, vehicles(any_drive(), 3, 2), |vehicle| {
        if vehicle.wheels().is_none() {
            met.note("none", true);
            return Ok(());
        }
        let (_, headings) = rolling_and_fixed(&vehicle);
        let lines: BTreeSet<_> =
            headings.iter().map(|h| number(&Exact::call(Fun::Sin, &h.sub(&headings[0])))).collect();
        let found = freedoms(&vehicle, &vehicle.mechanism());
        let most = if matches!(vehicle.drive, Drive::Unicycle | Drive::Differential) { 2 } else { 1 };
        prop_assert!((1..=most).contains(&found), "{}", found);
        met.note("circles", lines.len() > 1);
        met.note("two freedoms", found == 2);
        met.note("straight or circling for want of freedom", most == 2 && found == 1);
        met.note("straight for want of freedom", most == 2 && found == 1 && lines.len() == 1);
        Ok(())
    });
    met.at_least(&[("circles", 60), ("two freedoms", 20), ("straight or circling for want of freedom", 20)]);
    met.at_least(&[("straight for want of freedom", 4)]);
    assert!(met.0.borrow().get("none").is_none_or(|n| *n < 40), "{:?}", met.0);
}

/// The hypothesis of the theorems is needed: a wheel whose axle misses the centre of turning leaves no ideal motion
/// near which coefficients could act.
#[test]
fn a_loose_wheel_leaves_no_ideal_motion_and_no_realisation_near_one() {
    let met = Met::default();
    check(150, loose_vehicles(any_drive(), 3, 0), |vehicle| {
        if vehicle.wheels().is_none() {
            return Ok(());
        }
        let mechanism = vehicle.mechanism();
        let realised = mechanism.realisation(&vehicle.measured(false), &vehicle.point());
        let held = freedoms(&vehicle, &mechanism) == 0;
        prop_assert!(!held || realised.is_err(), "{:?}", realised);
        met.note("held", held);
        met.note("moves", !held);
        let castor = |w: &Placed| matches!(w.facing, Facing::Castor);
        met.note("castor", vehicle.wheels().unwrap_or_default().iter().any(castor));
        Ok(())
    });
    met.at_least(&[("held", 40), ("moves", 20), ("castor", 10)]);
}

/// The coefficients of a row at a point without creep.
fn row_at(c: &Constraint, at: &Point, rate: &str) -> BigRational {
    let coefficient = c.ideal_row().coefficient(&rate.into());
    number(&coefficient.eval(&|s: &Symbol| at.value(s)).unwrap())
}

/// −r of the wheel itself stands before its rate; a velocity along the wheel, and no other, fulfils its direction.
fn knows_its_wheel(c: &Constraint, wheel: &Placed, at: &Point) -> Outcome {
    let Facing::Fixed(heading) = &wheel.facing else { return Ok(()) };
    let [cos, sin] = cos_and_sin(&at.value(&"phi".into()).add(heading));
    let [x, y] = ["x'", "y'"].map(|rate| row_at(c, at, rate));
    match c.form.gives() {
        Some(rate) => {
            let before = row_at(c, at, rate.as_str());
            prop_assert_eq!(before, -number(wheel.radius.as_ref().unwrap()));
            prop_assert_eq!((x, y), (cos, sin));
        }
        None => {
            prop_assert!((&x * &cos + &y * &sin).is_zero());
            prop_assert!(!(y * cos - x * sin).is_zero());
        }
    }
    Ok(())
}

#[test]
fn rows_have_the_radius_and_the_heading_of_their_wheel() {
    check(100, loose_vehicles(any_drive(), 4, 0), |vehicle| {
        let (at, wheels) = (vehicle.point(), vehicle.wheels().unwrap_or_default());
        for c in vehicle.mechanism().constraints {
            let wheel = wheels.iter().find(|w| c.name.starts_with(&format!("{},", w.name)));
            knows_its_wheel(&c, wheel.unwrap(), &at)?;
        }
        Ok(())
    });
}

/// What a constraint's row makes of a motion.
fn row_of(c: &Constraint, motion: &Moving, at: &Point) -> Exact {
    let term = |(rate, coefficient): (&Symbol, &creepage::formula::Expr)| {
        let value = coefficient.eval(&|s: &Symbol| at.value(s)).unwrap_or_else(|| Exact::ratio(0, 0));
        value.mul(&motion.rate(rate).unwrap_or_else(|| Exact::ratio(0, 0)))
    };
    c.ideal_row().terms().iter().map(|(rate, c)| term((rate, c))).fold(Exact::ratio(0, 1), |sum, v| sum.add(&v))
}

/// The rows come from the description, the contacts from places and rates alone.
#[test]
fn rows_say_how_each_contact_moves() {
    let met = Met::default();
    check(25, moving(2, 2), |motion| {
        let (at, mechanism) = (motion.vehicle.point(), motion.vehicle.mechanism());
        let contacts = motion.contacts();
        for c in &mechanism.constraints {
            let found = row_of(c, &motion, &at);
            let contact = contacts.iter().find(|x| match c.letter() {
                'R' => x.rolls.as_ref().is_some_and(|r| r.2 == c.creep),
                _ => x.directed.as_ref() == Some(&c.creep),
            });
            let contact = contact.unwrap_or_else(|| panic!("no contact has {}", c.creep));
            let wanted = match (c.letter(), &contact.rolls) {
                ('R', Some((r, rate, _))) => contact.along.sub(&r.mul(rate)),
                _ => contact.across.neg(),
            };
            prop_assert!(found.equals(&wanted), "{}: {} {}", c.name, found, wanted);
            met.note(if c.letter() == 'R' { "rolls" } else { "directed" }, true);
        }
        let coefficients = contacts.iter().map(|c| usize::from(c.rolls.is_some()) + usize::from(c.directed.is_some()));
        if motion.vehicle.wheels().is_some() {
            prop_assert_eq!(coefficients.sum::<usize>(), mechanism.constraints.len());
        }
        Ok(())
    });
    met.at_least(&[("rolls", 40), ("directed", 60)]);
}

#[test]
fn people_are_shown_every_wheel_trailer_and_rate() {
    let met = Met::default();
    check(40, moving(2, 2), |motion| {
        let vehicle = &motion.vehicle;
        let (at, wheels) = (vehicle.point(), vehicle.wheels().unwrap_or_default());
        let mut wanted = vec![("drive".to_string(), format!("{:?}", vehicle.drive).to_lowercase())];
        for w in wheels.iter().filter(|w| w.radius.is_some()) {
            let [forward, left] = w.place.each_ref().map(written);
            let place = format!("radius {} at ({forward}, {left})", written(w.radius.as_ref().unwrap()));
            let text = match &w.facing {
                Facing::Fixed(heading) if heading.as_rational().is_none() => {
                    met.note("facing", true);
                    format!("{place} facing {}", written(heading))
                }
                _ => place,
            };
            prop_assert_eq!(&w.to_string(), &text);
            wanted.push((w.name.clone(), text));
        }
        for i in 1..=vehicle.trailers() {
            let [d, c] = ["d", "c"].map(|s| written(&at.value(&Symbol::new(&format!("{s}_{i}")))));
            wanted.push((format!("trailer {i}"), format!("(d {d}, c {c})")));
        }
        prop_assert_eq!(&vehicle.shown(), &wanted);
        let all = motion.shown();
        prop_assert_eq!(&all[..wanted.len()], &wanted[..]);
        let names: Vec<&str> = all[wanted.len()..].iter().map(|(n, _)| n.as_str()).collect();
        prop_assert_eq!(&names[..3], &["v_l", "v_t", "phi'"]);
        prop_assert!(names.contains(&"delta'"));
        for (name, value) in all[wanted.len() + 2..].iter() {
            prop_assert_eq!(motion.rate(&Symbol::new(name)).map(|v| written(&v)), Some(value.clone()));
        }
        met.note("trailers", vehicle.trailers() > 1);
        met.note("bare", wheels.iter().any(|w| w.radius.is_none()));
        Ok(())
    });
    met.at_least(&[("facing", 20), ("trailers", 4), ("bare", 2)]);
}

/// The last angle of a configuration and the last rate of a motion: those before are drawn before.
#[test]
fn every_angle_and_every_rate_is_drawn() {
    let met = Met::default();
    check(300, moving(1, 1), |motion| {
        let wheels = motion.vehicle.wheels().unwrap_or_default();
        if motion.vehicle.trailers() == 1 && wheels.iter().any(|w| w.k > 10) {
            let last = Symbol::from("phi_1");
            prop_assert!(motion.rate(&last.rate()).is_some());
            met.note("turned", motion.vehicle.point().value(&last).as_rational().is_none());
            met.note("most wheels", motion.vehicle.drive == Drive::Differential);
        }
        Ok(())
    });
    met.at_least(&[("turned", 20), ("most wheels", 2)]);
}

/// A realisation is looked for where there is one; where there may be none it is not.
#[test]
fn a_regular_vehicle_is_realised() {
    let met = Met::default();
    check(40, vehicles(any_drive(), 1, 3), |vehicle| {
        let found = vehicle.mechanism().realisation(&vehicle.measured(true), &vehicle.point());
        prop_assert!(!vehicle.is_regular() || found.is_ok(), "{:?}", found);
        met.note("regular", vehicle.is_regular());
        Ok(())
    });
    met.at_least(&[("regular", 25)]);
}

#[test]
fn what_is_measured_names_driven_wheels_castors_and_yaw() {
    check(30, vehicles(any_drive(), 2, 0), |vehicle| {
        let names = |yaw| vehicle.measured(yaw).iter().map(ToString::to_string).collect::<BTreeSet<_>>();
        let driven: &[&str] = match vehicle.drive {
            Drive::Unicycle | Drive::Car => &["theta_1'"],
            Drive::Tricycle => &["theta_2'"],
            Drive::Differential | Drive::Splayed => &["theta_1'", "theta_2'"],
        };
        let wheels = vehicle.wheels().unwrap_or_default();
        let further = wheels.iter().filter(|w| w.k > 10).map(|w| format!("gamma_{}'", w.k));
        let mut wanted: BTreeSet<String> = driven.iter().map(ToString::to_string).chain(further).collect();
        wanted.insert("delta'".into());
        let yaw = || "phi'".to_string();
        let with_yaw: BTreeSet<String> = wanted.iter().cloned().chain([yaw()]).collect();
        if !wheels.is_empty() {
            prop_assert_eq!(names(true), with_yaw.clone());
            prop_assert_eq!(names(false), if vehicle.drive == Drive::Unicycle { with_yaw } else { wanted });
        }
        Ok(())
    });
}
