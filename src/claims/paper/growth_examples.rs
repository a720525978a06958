//! Vehicles and trains with the configurations at which their growth vectors, integrals and ranks are looked at, exactly.

use crate::claims::count_check::compare;
use crate::claims::counted::Counted;
use crate::claims::proved::Proved;
use crate::claims::{Outcome, Sampling, Statement};
use crate::formula::{Exact, Scalar, Symbol};
use crate::mechanism::{Mechanism, Point};
use crate::model::mechanism;
use crate::vehicles;
use crate::vehicles::Vehicle;
use std::collections::BTreeMap;
use std::sync::{Arc, LazyLock, Mutex};

#[derive(serde::Deserialize)]
struct Descriptions {
    vehicle: Vec<Vehicle>,
}

/// Vehicles described for the table; a malformed description would leave it empty, and every claim on it open.
static DESCRIBED: LazyLock<Vec<Vehicle>> = LazyLock::new(|| {
    toml::from_str::<Descriptions>(include_str!("descriptions.toml")).map(|d| d.vehicle).unwrap_or_default()
});

pub(crate) fn described(id: &str) -> Option<&'static Vehicle> {
    vehicles::named(id).or_else(|| DESCRIBED.iter().find(|v| v.id == id))
}

fn toward(x: i64, y: i64) -> Exact {
    Exact::direction(x.into(), y.into())
}

/// Lengths and angles at which the vehicles are looked at: no two alike, every sine rational.
fn general() -> Point {
    let lengths = [
        ("r", 1, 2),
        ("r_1", 1, 2),
        ("r_2", 1, 2),
        ("a", 3, 2),
        ("L", 2, 1),
        ("l_c", 1, 1),
        ("d_c", 1, 4),
        ("r_c", 1, 5),
    ];
    let at = lengths.iter().fold(Point::default(), |p, (name, n, d)| p.with(*name, Exact::ratio(*n, *d)));
    let at = at.with("b", Exact::ratio(3, 1)).with("w", Exact::ratio(3, 2)).with("h", Exact::ratio(2, 7));
    let at = at
        .with("R", Exact::ratio(1, 3))
        .with("mu_1", toward(4, 3))
        .with("mu_2", toward(-5, 12))
        .with("mu_3", toward(8, -15));
    let at = at.with("delta_r", toward(15, 8));
    at.with("phi", toward(4, 3)).with("gamma", toward(12, 5)).with("delta", toward(12, 5))
}

/// Where both front wheels of the Ackermann car have rational sines: cot δ is the mean of 4/3 and 12/5.
fn ackermann() -> Point {
    general().with("delta", toward(28, 15)).with("L", Exact::ratio(15, 8)).with("a", Exact::ratio(2, 1))
}

/// Trailers on the axles, each at an angle behind the one ahead.
fn hung(at: Point, angles: &[Exact]) -> Point {
    hung_by(at, angles, &[])
}

/// The same with the lengths of the first bars; the others are 1 long.
fn hung_by(at: Point, angles: &[Exact], bars: &[Exact]) -> Point {
    let mut heading = at.value(&"phi".into());
    let one = Exact::ratio(1, 1);
    angles.iter().enumerate().fold(at, |p, (i, angle)| {
        heading = heading.sub(angle);
        let name = |stem: &str| Symbol::new(&format!("{stem}_{}", i + 1));
        let bar = bars.get(i).unwrap_or(&one).clone();
        p.with(name("phi"), heading.clone()).with(name("d"), bar).with(name("c"), Exact::ratio(0, 1))
    })
}

/// A train of three trailers by the angles of its first two hitches, in states between the regular and the
/// perpendicular one. Jean's second angle has the tangent sin(π/2)·d_1/d_2: 3/4, whose sine is a rational number.
fn state(name: &str) -> Option<Vec<Exact>> {
    let (across, any, other) = (toward(0, 1), toward(12, 5), toward(15, 8));
    let (second, mirrored) = (toward(4, 3), toward(4, -3));
    let [first, next] = match name {
        "state_first" => [across, any],
        "state_next" => [any, across],
        "state_second" => [second, across],
        "state_mirrored" => [mirrored, across],
        "state_both" => [across.clone(), across],
        "state_regular" => [any, other],
        _ => return None,
    };
    Some(vec![first, next, toward(3, 4)])
}

fn regular(n: usize) -> Vec<Exact> {
    [toward(3, 4), toward(12, -5), toward(4, 3), toward(15, 8), toward(12, 5)][..n.min(5)].to_vec()
}

/// What is looked at, by a name: a vehicle, or `regular_N`, `perpendicular_N`, `with_wheel_N`, `steered_N` for trains.
fn example(name: &str) -> Option<(Mechanism, Point)> {
    let train =
        |id: &str, angles: Vec<Exact>| Some((mechanism(described(id)?, angles.len()), hung(general(), &angles)));
    if let Some(angles) = state(name) {
        let bars = [Exact::ratio(3, 4), Exact::ratio(1, 1)];
        return Some((mechanism(described("axle")?, 3), hung_by(general(), &angles, &bars)));
    }
    let across = toward(0, 1);
    let along = Exact::ratio(0, 1);
    if let Some((kind, n)) = name.rsplit_once('_').and_then(|(kind, n)| Some((kind, n.parse::<usize>().ok()?))) {
        match kind {
            "regular" => return train("axle", regular(n)),
            "perpendicular" => return train("axle", vec![across; n]),
            "with_wheel" => return train("unicycle", regular(n)),
            "steered" => return train("car", regular(n)),
            // A vehicle whose name ends in a number.
            _ => {}
        }
    }
    match name {
        "first_perpendicular" => train("axle", vec![across, along]),
        "last_perpendicular" => train("axle", vec![along, across]),
        "ackermann" => Some((mechanism(described(name)?, 0), ackermann())),
        _ => Some((mechanism(described(&name.replace('_', "-"))?, 0), general())),
    }
}

/// What was found for the examples, each looked at once for all statements.
#[derive(Clone, Default)]
pub(super) struct Found(Arc<Mutex<BTreeMap<String, Option<Arc<Counted>>>>>);

impl Found {
    pub(super) fn of(&self, name: &str) -> Option<Arc<Counted>> {
        let known = || self.0.lock().ok()?.get(name).cloned();
        if let Some(found) = known() {
            return found;
        }
        let found = example(name).and_then(|(mechanism, at)| Counted::of(name, mechanism, at, 9)).map(Arc::new);
        if let Ok(mut all) = self.0.lock() {
            all.insert(name.to_string(), found.clone());
        }
        found
    }

    /// A number of an example, such as `ackermann.rank`, and what proves it.
    fn number(&self, name: &Symbol) -> Option<(i64, Proved)> {
        let (example, quantity) = name.as_str().rsplit_once('.')?;
        if let Some(number) = realised(example, quantity) {
            return Some((number, Proved::WithoutTheorem(SIGNATURES)));
        }
        let counted = self.of(example)?;
        Some((counted.number(quantity)?, Proved::Growth(counted)))
    }

    /// The check of statements about numbers of examples.
    pub(super) fn checking(&self) -> impl Fn(&Statement, &Sampling) -> Outcome + Send + Sync + 'static {
        let found = self.clone();
        move |statement, _| compare(statement, |name| found.number(name))
    }
}

/// Why a signature has no theorem.
const SIGNATURES: &str = "a signature is found among all sets of rows, by the rank of each";

/// A number of the signature of an example whose wheels are measured: coefficients of type R, others, smallest sets.
fn realised(name: &str, quantity: &str) -> Option<i64> {
    if !["rolling", "directed", "sets"].contains(&quantity) {
        return None;
    }
    let (mechanism, at) = example(name)?;
    let turned = |q: &&Symbol| q.as_str().starts_with("theta");
    let measured: Vec<Symbol> = mechanism.coordinates.iter().filter(turned).map(Symbol::rate).collect();
    let found = mechanism.realisation(&measured, &at).ok()?;
    let (rolling, directed) = found.counts();
    let count = match quantity {
        "rolling" => rolling,
        "directed" => directed,
        _ => found.sets.len(),
    };
    i64::try_from(count).ok()
}
