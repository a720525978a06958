//! The holonomic and the nonholonomic part: growth vectors, integrals, degrees of nonholonomy, in exact arithmetic.

use crate::claims::{Claim, DerivedFormulas, Outcome, Sampling, Statement, Status, proving};
use crate::formula::{Exact, Expr, Node, Scalar, Symbol};
use crate::mechanism::{Mechanism, Nonholonomy, Point};
use crate::model::mechanism;
use crate::vehicles;
use crate::vehicles::Vehicle;
use std::collections::BTreeMap;
use std::sync::{Arc, LazyLock, Mutex};

const CHAPTER: &str = "05a-holonomy";
const GROWTH: &str = "src/mechanism/growth_vector.rs";
const INTEGRALS: &str = "src/mechanism/integrals.rs";

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
    let mut heading = at.value(&"phi".into());
    angles.iter().enumerate().fold(at, |p, (i, angle)| {
        heading = heading.sub(angle);
        let name = |stem: &str| Symbol::new(&format!("{stem}_{}", i + 1));
        p.with(name("phi"), heading.clone()).with(name("d"), Exact::ratio(1, 1)).with(name("c"), Exact::ratio(0, 1))
    })
}

fn regular(n: usize) -> Vec<Exact> {
    [toward(3, 4), toward(12, -5), toward(4, 3), toward(15, 8), toward(12, 5)][..n.min(5)].to_vec()
}

/// What is looked at, by a name: a vehicle, or `regular_N`, `perpendicular_N`, `with_wheel_N`, `steered_N` for trains.
fn example(name: &str) -> Option<(Mechanism, Point)> {
    let train =
        |id: &str, angles: Vec<Exact>| Some((mechanism(described(id)?, angles.len()), hung(general(), &angles)));
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
pub(super) struct Found(Arc<Mutex<BTreeMap<String, Option<Nonholonomy>>>>);

impl Found {
    fn of(&self, name: &str) -> Option<Nonholonomy> {
        let known = || self.0.lock().ok()?.get(name).cloned();
        if let Some(found) = known() {
            return found;
        }
        let found = example(name).and_then(|(mechanism, at)| mechanism.nonholonomy(&at, 9).ok());
        if let Ok(mut all) = self.0.lock() {
            all.insert(name.to_string(), found.clone());
        }
        found
    }

    /// A number of an example, such as `ackermann.rank`; a growth vector is written as digits, 2357.
    fn number(&self, name: &Symbol) -> Option<i64> {
        let (example, quantity) = name.as_str().rsplit_once('.')?;
        if let Some(number) = realised(example, quantity) {
            return Some(number);
        }
        let found = self.of(example)?;
        // A count that brackets and integrals do not agree on is no proof.
        if !(found.growth.is_final && found.counts_agree()) {
            return None;
        }
        let digits = |d: &[usize]| d.iter().fold(0, |n, d| 10 * n + *d as i64);
        Some(match quantity {
            "coordinates" => found.growth.coordinates.len() as i64,
            "rank" => found.growth.rank as i64,
            "growth" => digits(&found.growth.dimensions),
            "degree" => found.growth.degree_of_nonholonomy as i64,
            "holonomic" => found.holonomic as i64,
            "nonholonomic" => found.nonholonomic as i64,
            _ => return None,
        })
    }

    /// The check of statements about numbers of examples.
    pub(super) fn checking(&self) -> impl Fn(&Statement, &Sampling) -> Outcome + Send + Sync + 'static {
        let found = self.clone();
        move |statement, _| found.check(statement)
    }

    /// Compares the numbers of examples with what is said of them.
    fn check(&self, statement: &Statement) -> Outcome {
        Outcome::all(statement.in_question().iter().map(|equation| {
            let Node::Sym(name) = equation.left.node() else {
                return Outcome::Undefined(format!("{} is no number of an example", equation.left));
            };
            let Some(found) = self.number(name) else { return Outcome::Undefined(format!("{name} is not known")) };
            match equation.right.tidy().as_number() == Expr::int(found).as_number() {
                true => Outcome::PROVED,
                false => Outcome::failure(format!("{name} is {found}, the statement says {}", equation.right)),
            }
        }))
    }
}

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

pub(crate) fn claims() -> Vec<Claim> {
    let found = Found::default();
    vec![counts(&found), integral(&found), skid_steer(&found), table(&found), trains(&found), degrees(&found)]
}

fn base(id: &str, status: Status, says: &str) -> Claim {
    Claim::new(id, status, says)
        .chapter(CHAPTER)
        .code(&[GROWTH, INTEGRALS, "src/formula/jet.rs", "src/claims/paper/descriptions.toml"])
        .tests(&["tests/mechanism/growth.rs", "tests/mechanism/growth_laws.rs"])
}

fn counts(found: &Found) -> Claim {
    base("E19", Status::Corrected, "three-wheeled cars have three holonomic constraints, four-wheeled ones four")
        .at("section 4, first theorem; errata E19")
        .under("ideal constraints; 7 and 8 coordinates as the paper has them; one general configuration each")
        .remark(
            "Of the constraints of castor, front-steered and Ackermann vehicles one is holonomic, r·(θ₁ − θ₂) = a·φ. \
             The paper's counts are those of synchro drives.",
        )
        .refutation(
            "the paper's counts",
            &[("differential_drive_castor.holonomic", "3")],
            &[("differential_drive_castor.holonomic", "1")],
            found.checking(),
        )
        .proof(
            "brackets bound the count from above, integrals from below",
            &[
                ("differential_drive_castor.coordinates", "7"),
                ("differential_drive_castor.holonomic", "1"),
                ("differential_drive_castor.nonholonomic", "4"),
                ("tricycle_with_rear_wheels.coordinates", "7"),
                ("tricycle_with_rear_wheels.holonomic", "1"),
                ("tricycle_with_rear_wheels.nonholonomic", "4"),
                ("ackermann.coordinates", "8"),
                ("ackermann.holonomic", "1"),
                ("ackermann.nonholonomic", "5"),
                ("synchro_drive.holonomic", "3"),
                ("synchro_drive_4.holonomic", "4"),
            ],
            found.checking(),
        )
}

/// The integral that the search finds for the two-wheeler.
fn integral(found: &Found) -> Claim {
    let of = |found: &Nonholonomy| found.integrals.first().map(|i| i.formula.clone());
    let integral = found.of("differential-drive").and_then(|f| of(&f)).unwrap_or_default();
    let one_radius = |s: &Symbol| matches!(s.as_str(), "r_1" | "r_2").then(|| Expr::sym("r"));
    base("integral-28", Status::Proved, "the machine finds the integral r·(θ₁ − θ₂) − a·φ of the two-wheeler")
        .at("section 4, (28)")
        .about(&[28])
        .under("no creep; the integral is proved for all configurations and lengths")
        .proof(
            "what the search returns, radii equal",
            &[("integral", "r*(theta_1 - theta_2) - a*phi")],
            proving(DerivedFormulas::default().with("integral", integral.substitute(&one_radius))),
        )
}

fn skid_steer(found: &Found) -> Claim {
    base("E20", Status::Corrected, "all wheeled cars have two nonholonomic constraints")
        .at("section 4, first theorem, \"all wheeled cars\"; errata E20")
        .under("four fixed wheels, each with its rolling and its direction")
        .remark(
            "Skid steering has rank 6 in 7 coordinates: the ideal vehicle drives straight and nothing else, all six \
             constraints are holonomic, and every turn is creep. It is to be left out, or given R·T_front·T_rear.",
        )
        .refutation(
            "two nonholonomic constraints",
            &[("skid_steer.nonholonomic", "2")],
            &[("skid_steer.nonholonomic", "0")],
            found.checking(),
        )
        .proof(
            "no freedom is left but straight driving",
            &[
                ("skid_steer.coordinates", "7"),
                ("skid_steer.rank", "6"),
                ("skid_steer.growth", "1"),
                ("skid_steer.holonomic", "6"),
                ("skid_steer.nonholonomic", "0"),
            ],
            found.checking(),
        )
        .proof(
            "steered wheels kept parallel allow no motion at all but steering",
            &[
                ("parallel_steering.coordinates", "4"),
                ("parallel_steering.rank", "3"),
                ("parallel_steering.holonomic", "3"),
            ],
            found.checking(),
        )
}

fn table(found: &Found) -> Claim {
    base("growth-table", Status::Proved, "growth vectors of the vehicles of the paper")
        .at("corrected theorem (b), table")
        .about(&[26, 27, 28])
        .under("one general configuration each")
        .proof(
            "iterated brackets of exact power series; a vector (2, 3, 5, 7) is written 2357",
            &[
                ("unicycle.growth", "234"),
                ("unicycle.nonholonomic", "2"),
                ("differential_drive.growth", "234"),
                ("differential_drive.holonomic", "1"),
                ("differential_drive.nonholonomic", "2"),
                ("differential_drive_castor.growth", "2356"),
                ("tricycle_with_rear_wheels.growth", "2356"),
                ("ackermann.growth", "2357"),
                ("synchro_drive.growth", "234"),
                ("synchro_drive.nonholonomic", "2"),
                ("synchro_drive_4.growth", "234"),
                ("kinematic_car.growth", "234"),
                ("kinematic_car.holonomic", "0"),
                ("car.growth", "2345"),
                ("car.nonholonomic", "3"),
            ],
            found.checking(),
        )
}

fn trains(found: &Found) -> Claim {
    base("growth-trailers", Status::Proved, "growth vectors of trains, with and without the angle of a wheel")
        .at("corrected theorem (c), growth")
        .under("hitches on the axles; one general configuration each, bars of length 1")
        .proof(
            "regular, perpendicular, and with the last angle alone at right angles, which does not matter",
            &[
                ("regular_0.growth", "23"),
                ("regular_1.growth", "234"),
                ("regular_2.growth", "2345"),
                ("regular_3.growth", "23456"),
                ("perpendicular_1.growth", "234"),
                ("perpendicular_2.growth", "23445"),
                ("perpendicular_3.growth", "23445556"),
                ("first_perpendicular.growth", "23445"),
                ("last_perpendicular.growth", "2345"),
                ("with_wheel_0.growth", "234"),
                ("with_wheel_1.growth", "235"),
                ("with_wheel_2.growth", "2356"),
                ("steered_0.growth", "2345"),
                ("steered_1.growth", "23456"),
                ("steered_2.growth", "23457"),
            ],
            found.checking(),
        )
}

fn degrees(found: &Found) -> Claim {
    base("jean-degree", Status::Proved, "the degree of nonholonomy of a train is N + 2 where no hitch is perpendicular, and Fibonacci's F(N + 3) where all are")
        .at("corrected theorem (c); Jean 1996")
        .under("hitches on the axles; N ≤ 5, and N ≤ 3 with all hitches perpendicular; one general configuration each, bars of length 1")
        .proof(
            "exact brackets",
            &[
                ("regular_0.degree", "0 + 2"),
                ("regular_1.degree", "1 + 2"),
                ("regular_2.degree", "2 + 2"),
                ("regular_3.degree", "3 + 2"),
                ("regular_4.degree", "4 + 2"),
                ("regular_5.degree", "5 + 2"),
                ("perpendicular_0.degree", "2"),
                ("perpendicular_1.degree", "3"),
                ("perpendicular_2.degree", "5"),
                ("perpendicular_3.degree", "8"),
            ],
            found.checking(),
        )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_count_in_doubt_is_no_number() {
        let found = Found::default();
        let sure = found.of("unicycle").unwrap();
        let disputed = Nonholonomy { holonomic: sure.holonomic + 1, ..sure.clone() };
        let mut unfinished = sure;
        unfinished.growth.is_final = false;
        let all = [("disputed", disputed), ("unfinished", unfinished)];
        found.0.lock().unwrap().extend(all.map(|(name, n)| (name.to_string(), Some(n))));
        let rank = |name: &str| found.number(&Symbol::new(&format!("{name}.rank")));
        assert_eq!([rank("unicycle"), rank("disputed"), rank("unfinished")], [Some(2), None, None]);
    }
}
