//! Exact values for the symbols of a statement: generated, or searched from the simplest on.

use super::Counterexample;
use crate::formula::{Exact, Expr, Symbol};
use proptest::prelude::*;
use proptest::strategy::SBoxedStrategy;
use std::collections::{BTreeMap, BTreeSet};

/// What values a symbol may take.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Domain {
    /// Rationals above zero: lengths, radii, masses.
    Positive,
    /// Rationals other than zero: speeds, rates.
    Nonzero,
    /// Any rational.
    Any,
    /// Rationals between −1 and 1: coefficients of creep.
    Creep,
    /// Rational points of the circle.
    Angle,
}

/// Exact values by name, in the order they were declared.
#[derive(Clone, Debug, PartialEq)]
pub struct Point(Vec<(Symbol, ShownExact)>);

/// An exact value; compared by its printed form, which is unique.
#[derive(Clone, Debug)]
struct ShownExact(Exact);

impl PartialEq for ShownExact {
    fn eq(&self, other: &Self) -> bool {
        self.0.to_string() == other.0.to_string()
    }
}

impl Point {
    /// Values by name.
    pub fn new(values: impl IntoIterator<Item = (Symbol, Exact)>) -> Self {
        Self(values.into_iter().map(|(s, v)| (s, ShownExact(v))).collect())
    }

    /// The value of a name.
    pub fn get(&self, name: &Symbol) -> Option<Exact> {
        self.0.iter().find(|(s, _)| s == name).map(|(_, v)| v.0.clone())
    }

    /// The nearest floating-point value of a name; NaN when there is none.
    pub fn number(&self, name: &str) -> f64 {
        self.get(&name.into()).map_or(f64::NAN, |v| v.to_f64())
    }

    /// Names and values for people: an angle is told by its tangent.
    pub fn shown(&self) -> Vec<(String, String)> {
        self.0.iter().map(|(s, v)| (s.to_string(), written(&v.0))).collect()
    }
}

/// An exact value for people.
pub fn written(v: &Exact) -> String {
    match (v.as_rational(), v.as_direction()) {
        (None, Some((x, y))) => format!("angle of ({x}, {y})"),
        _ => v.to_string(),
    }
}

/// Points with a value for each name, rationals with small numerators and denominators; they shrink towards 1,
/// creeps and angles towards 0.
pub fn points(names: &[(&str, Domain)]) -> SBoxedStrategy<Point> {
    let names: Vec<(Symbol, Domain)> = names.iter().map(|(s, d)| (Symbol::new(s), *d)).collect();
    let values: Vec<SBoxedStrategy<Exact>> = names.iter().map(|(_, d)| value(*d)).collect();
    values.prop_map(move |values| Point::new(names.iter().map(|(s, _)| s.clone()).zip(values))).sboxed()
}

/// Values of a domain.
pub fn value(domain: Domain) -> SBoxedStrategy<Exact> {
    match domain {
        Domain::Positive => (1i64..=24, 1i64..=12).prop_map(|(p, q)| Exact::ratio(p, q)).sboxed(),
        Domain::Nonzero => {
            (any::<bool>(), 1i64..=24, 1i64..=12).prop_map(|(m, p, q)| Exact::ratio(if m { -p } else { p }, q)).sboxed()
        }
        Domain::Any => (-24i64..=24, 1i64..=12).prop_map(|(p, q)| Exact::ratio(p, q)).sboxed(),
        Domain::Creep => (-9i64..=9, 10i64..=20).prop_map(|(p, q)| Exact::ratio(p, q)).sboxed(),
        Domain::Angle => (-12i64..=12, 1i64..=9).prop_map(|(p, q)| Exact::half_tangent(p, q)).sboxed(),
    }
}

/// The simplest point at which a law is false, searched by growing complexity; `None` when the search ends first.
///
/// `differs` says what is found there, and `None` where the law holds or is undefined.
pub fn simplest(
    names: &BTreeMap<Symbol, Domain>,
    differs: impl Fn(&Point) -> Option<String>,
) -> Option<Counterexample> {
    let lists: Vec<Vec<Exact>> = names.values().map(|d| simple_values(*d)).collect();
    // The sum of the indices is the complexity; at most as many points are looked at as one waits for.
    let mut budget = 60_000;
    for total in 0..=24 {
        let mut indices = vec![0; lists.len()];
        if let Some(found) = search(names, &lists, &mut indices, 0, total, &differs, &mut budget) {
            return Some(found);
        }
        if budget == 0 {
            return None;
        }
    }
    None
}

fn search(
    names: &BTreeMap<Symbol, Domain>,
    lists: &[Vec<Exact>],
    indices: &mut Vec<usize>,
    place: usize,
    left: usize,
    differs: &impl Fn(&Point) -> Option<String>,
    budget: &mut u32,
) -> Option<Counterexample> {
    if place == lists.len() {
        if left > 0 || *budget == 0 {
            return None;
        }
        *budget -= 1;
        let values = names.keys().cloned().zip(indices.iter().zip(lists).map(|(i, list)| list[*i].clone()));
        let point = Point::new(values);
        return differs(&point).map(|says| Counterexample { values: point.shown(), says });
    }
    // The last place takes what is left.
    let from = if place + 1 == lists.len() { left } else { 0 };
    for i in from..=left.min(lists[place].len() - 1) {
        indices[place] = i;
        let found = search(names, lists, indices, place + 1, left - i, differs, budget);
        if found.is_some() {
            return found;
        }
    }
    None
}

/// The values of a domain from the simplest on.
fn simple_values(domain: Domain) -> Vec<Exact> {
    let ratios = |list: &[(i64, i64)]| list.iter().map(|(p, q)| Exact::ratio(*p, *q)).collect::<Vec<_>>();
    match domain {
        Domain::Positive => ratios(&[(1, 1), (2, 1), (1, 2), (3, 1), (1, 3), (3, 2), (2, 3)]),
        Domain::Nonzero => ratios(&[(1, 1), (-1, 1), (2, 1), (1, 2), (-2, 1), (3, 1), (1, 3)]),
        Domain::Any => ratios(&[(1, 1), (2, 1), (0, 1), (-1, 1), (1, 2), (-2, 1), (3, 1)]),
        Domain::Creep => ratios(&[(0, 1), (1, 2), (-1, 2), (1, 3), (-1, 3), (2, 3), (1, 4)]),
        Domain::Angle => {
            let halves = [(0, 1), (1, 1), (1, 2), (-1, 1), (-1, 2), (1, 3), (1, 0)];
            halves.iter().map(|(p, q)| Exact::half_tangent(*p, *q)).collect()
        }
    }
}

/// The domain of each symbol by its use and its name: an angle where a sine or the like is taken of it, a length or a
/// mass positive, a creep small, else any rational.
pub fn domains<'a>(formulas: impl IntoIterator<Item = &'a Expr>) -> BTreeMap<Symbol, Domain> {
    let (mut all, mut angles) = (BTreeSet::new(), BTreeSet::new());
    for e in formulas {
        all.extend(e.symbols());
        angles.extend(e.angles());
    }
    let domain = |s: &Symbol| if angles.contains(s) { Domain::Angle } else { by_name(s.as_str()) };
    all.into_iter().map(|s| (s.clone(), domain(&s))).collect()
}

/// What the paper's letters stand for.
fn by_name(name: &str) -> Domain {
    let stem = name.split('_').next().unwrap_or(name);
    match stem {
        "e" => Domain::Creep,
        "r" | "a" | "L" | "d" | "m" | "I" | "J" | "b" => Domain::Positive,
        _ => Domain::Any,
    }
}
