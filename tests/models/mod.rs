//! Models for the tests: every vehicle with and without trailers, random ones, and their motion at an instant.
#![allow(dead_code)] // every test binary uses its own part

use creepage::effects::{self, Applied, Effect};
use creepage::formula::{Expr, Symbol};
use creepage::model::{Model, Trailer};
use creepage::vehicles;
use proptest::prelude::*;
use std::collections::BTreeMap;
use std::sync::LazyLock;

pub type Values = BTreeMap<Symbol, f64>;

/// A vehicle of the catalogue, parameters given in the order of their names.
pub fn vehicle(id: &str, values: &[f64]) -> Model {
    let names = vehicles::named(id).unwrap().parameters.keys();
    let given: Vec<(&str, f64)> = names.zip(values.iter().cycle()).map(|(n, v)| (n.as_str(), *v)).collect();
    Model::new(id, &given).unwrap()
}

/// Vehicles whose constraints do not determine their motion, and those that pull no trailers.
pub const STILL: [&str; 2] = ["sleigh", "skid-steer"];
pub const ALONE: [&str; 4] = ["disk", "sleigh", "hopper", "skid-steer"];

fn of_catalogue(keep: impl Fn(&str) -> bool) -> Vec<Model> {
    vehicles::all().iter().filter(|v| keep(&v.id)).map(|v| vehicle(&v.id, &[0.7, 0.3, 2.1])).collect()
}

/// Every vehicle of the catalogue that moves, alone and with two trailers, the second one off-axle.
pub fn machines() -> Vec<Model> {
    let train = [Trailer { length: 3.0, hitch: 0.0 }, Trailer { length: 2.5, hitch: 0.4 }];
    let moving = of_catalogue(|id| !STILL.contains(&id)).into_iter();
    let both = |m: Model| match ALONE.contains(&m.vehicle.id.as_str()) {
        true => vec![m],
        false => vec![m.clone(), m.with_trailers(&train)],
    };
    moving.flat_map(both).collect()
}

/// Every vehicle of the catalogue that can only be described.
pub fn still() -> Vec<Model> {
    of_catalogue(|id| STILL.contains(&id))
}

static LIBRARY: LazyLock<Vec<Effect>> = LazyLock::new(|| creepage::extensions::with_own(OWN_EFFECTS).unwrap());

/// The example of a user's own effects: the laws of effects hold for them, too.
pub const OWN_EFFECTS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/effects/my_effects.toml");

/// The effects of the catalogue and of the example.
pub fn library() -> &'static [Effect] {
    &LIBRARY
}

/// A model with each effect of the library that applies to it.
pub fn with_each_effect(m: &Model) -> Vec<(Model, &'static Effect, Option<usize>)> {
    m.applicable(library()).into_iter().map(|(e, t)| (m.clone(), e, t)).collect()
}

/// Every machine with each effect that applies to it.
pub fn machines_with_effects() -> Vec<(Model, &'static Effect, Option<usize>)> {
    machines().iter().flat_map(with_each_effect).collect()
}

/// An effect of the library with its values in the order of their names.
pub fn effect(id: &str, trailer: Option<usize>, values: &[f64]) -> Applied {
    Applied::new(effects::named(id).unwrap(), trailer, values.to_vec())
}

/// The models of every vehicle that came later, as a person has read them in text alone.
pub fn reviewed_as_text() -> Vec<(&'static str, Model)> {
    let castor = [
        ("wheel_radius", 0.1),
        ("track_width", 0.4),
        ("castor_offset", -0.3),
        ("castor_trail", 0.04),
        ("castor_wheel_radius", 0.03),
    ];
    let sleigh = [("mass", 2.0), ("inertia", 0.5), ("mass_offset", 0.1)];
    let skid = [("wheel_radius", 0.1), ("track_width", 0.5), ("wheelbase", 0.4)];
    let tracked =
        [("wheel_radius", 0.1), ("track_width", 0.8), ("icr_forward_offset", 0.05), ("icr_left_offset", -0.02)];
    let model = |id: &'static str, p: &[(&str, f64)]| (id, Model::new(id, p).unwrap());
    vec![
        model("disk", &[("wheel_radius", 0.3)]),
        model("tricycle", &[("wheel_radius", 0.2), ("wheelbase", 1.1)]),
        model("four-wheel-car", &[("wheel_radius", 0.3), ("wheelbase", 2.6), ("track_width", 1.5)]),
        model("sleigh", &sleigh),
        model("differential-drive-castor", &castor),
        model("synchro-drive", &[("wheel_radius", 0.1)]),
        model("skid-steer", &skid),
        model("four-wheel-steering", &[("wheel_radius", 0.3), ("wheelbase", 2.6)]),
        model("tracked", &tracked),
        model("mecanum", &[("wheel_radius", 0.05), ("track_width", 0.4), ("wheelbase", 0.3)]),
    ]
}

/// The five models whose descriptions a person has read.
pub fn reviewed() -> Vec<(&'static str, Model)> {
    let car = Model::new("car", &[("wheel_radius", 0.3), ("wheelbase", 2.6)]).unwrap();
    let train = [Trailer { length: 3.0, hitch: 0.0 }, Trailer { length: 2.5, hitch: 0.4 }];
    let patched = [
        effect("rotation-creep", None, &[0.03]),
        effect("wheelbase", None, &[0.02]),
        effect("cornering-creep", None, &[0.11]),
        effect("front-traverse-creep", None, &[-0.015]),
        effect("steering-gain", None, &[0.04]),
        effect("drift", None, &[0.1, -0.2]),
    ];
    vec![
        ("unicycle", Model::new("unicycle", &[("wheel_radius", 0.5)]).unwrap()),
        (
            "differential-drive",
            Model::new("differential-drive", &[("wheel_radius", 0.1), ("track_width", 0.5)]).unwrap(),
        ),
        ("car", car.clone()),
        ("n-trailer", car.clone().with_trailers(&train)),
        ("patched-car", patched.into_iter().fold(car, Model::with_effect)),
    ]
}

/// A random machine of up to ten trailers with creep in every coefficient, and numbers to make instants from.
#[derive(Clone, Debug)]
pub struct Random {
    pub model: Model,
    pub numbers: Vec<f64>,
}

/// Random machines that move; every second hitch is on the axle.
pub fn random() -> impl Strategy<Value = Random> {
    random_of(|id| !STILL.contains(&id))
}

/// Random machines, those that can only be described among them.
pub fn random_described() -> impl Strategy<Value = Random> {
    random_of(|_| true)
}

fn random_of(keep: impl Fn(&str) -> bool) -> impl Strategy<Value = Random> {
    let trailer = (0.5..4.0f64, prop_oneof![Just(0.0), -1.0..1.0f64]);
    let trailers = prop::collection::vec(trailer.prop_map(|(length, hitch)| Trailer { length, hitch }), 0..=10);
    let ids = vehicles::all().iter().map(|v| v.id.clone()).filter(|id| keep(id));
    let id = prop::sample::select(ids.collect::<Vec<_>>());
    let numbers = prop::collection::vec(-1.0..1.0f64, 40);
    (id, prop::array::uniform3(0.2..3.0f64), trailers, numbers).prop_map(|(id, parameters, trailers, numbers)| {
        let trailers = if ALONE.contains(&id.as_str()) { vec![] } else { trailers };
        let model = vehicle(&id, &parameters).with_trailers(&trailers);
        Random { model: creeping(&model, &numbers), numbers }
    })
}

/// The model with creep in every coefficient.
pub fn creeping(model: &Model, numbers: &[f64]) -> Model {
    const CREEPS: [&str; 4] =
        ["unequal-rotation-creep", "traverse-creep", "front-traverse-creep", "trailer-traverse-creep"];
    let mut found = model.applicable(effects::all());
    let unequal = found.iter().any(|(e, _)| e.id == CREEPS[0]);
    found.retain(|(e, _)| CREEPS.contains(&e.id.as_str()) || (e.id == "rotation-creep" && !unequal));
    let mut next = numbers.iter().cycle().map(|x| 0.3 * x);
    let applied = found.into_iter().map(|(e, t)| Applied::new(e, t, next.by_ref().take(e.parameters.len()).collect()));
    applied.fold(model.clone(), Model::with_effect)
}

/// States and inputs of an instant, from numbers within −1 … 1.
pub fn situation(model: &Model, numbers: &[f64]) -> Values {
    let mut next = numbers.iter().rev().cycle();
    let mut number = || next.next().copied().unwrap_or(0.0);
    let inputs: Vec<Symbol> = model.inputs.iter().map(|i| Symbol::new(i)).collect();
    let mut values = Values::new();
    for s in model.states() {
        values.insert(s, 3.2 * number());
    }
    for s in inputs {
        let size = if s.as_str().starts_with("steering_angle") { 0.9 } else { 4.0 };
        values.insert(s, size * number());
    }
    // The angle of a castor is no state: nothing depends on it.
    let angles = model.vehicle.wheels.iter().filter_map(|w| w.steering.clone());
    for s in angles.filter(|s| model.vehicle.is_free(s)) {
        values.insert(s, 3.2 * number());
    }
    values
}

/// Every definition of the model in a situation.
pub fn instant(model: &Model, situation: &Values) -> Values {
    let mut values = model.values();
    values.extend(situation.clone());
    for (name, formula) in model.definitions().unwrap().sorted().unwrap() {
        let value = formula.eval(&at(&values)).unwrap_or(f64::NAN);
        values.insert(name.clone(), value);
    }
    values
}

/// The values as a reading of names; an unknown name is undefined.
pub fn at(values: &Values) -> impl Fn(&Symbol) -> f64 + '_ {
    |s| values.get(s).copied().unwrap_or(f64::NAN)
}

/// The value of a formula.
#[track_caller]
pub fn value(e: &Expr, values: &Values) -> f64 {
    e.eval(&at(values)).unwrap_or_else(|| panic!("{e} is undefined"))
}

/// Values for every name in the model's formulas, related in no way.
pub fn anywhere(model: &Model, numbers: &[f64]) -> Values {
    let mut names: Vec<Symbol> = model.row_definitions().unwrap().iter().map(|(n, _)| n.clone()).collect();
    names.extend(model.coordinates().iter().flat_map(|q| [q.clone(), q.rate()]));
    names.into_iter().zip(numbers.iter().cycle()).enumerate().map(|(k, (n, x))| (n, x + 0.01 * k as f64)).collect()
}
