//! Growth vectors, ranks and integrals of the vehicles of the table, in exact arithmetic.

mod support;

use creepage::formula::Exact;
use creepage::mechanism::{Mechanism, Point};
use support::described::*;

/// A row of the table: coordinates, growth vector, holonomic and nonholonomic constraints.
struct Entry {
    name: &'static str,
    n: usize,
    growth: &'static [usize],
    holonomic: usize,
    nonholonomic: usize,
}

const fn entry(name: &'static str, n: usize, growth: &'static [usize], holonomic: usize, nonholonomic: usize) -> Entry {
    Entry { name, n, growth, holonomic, nonholonomic }
}

/// The table, as computed once by a computer algebra system.
const TABLE: [Entry; 26] = [
    entry("single wheel (x,y,phi,th) (22)(23)", 4, &[2, 3, 4], 0, 2),
    entry("two-wheel diff drive (26)(27)(28)", 5, &[2, 3, 4], 1, 2),
    entry("three-wheel: diff drive + castor (7 coords)", 7, &[2, 3, 5, 6], 1, 4),
    entry("three-wheel: front-steered tricycle (7 coords)", 7, &[2, 3, 5, 6], 1, 4),
    entry("four-wheel Ackermann (8 coords)", 8, &[2, 3, 5, 7], 1, 5),
    entry("synchro-drive 3 wheels (7 coords)", 7, &[2, 3, 4], 3, 2),
    entry("synchro-drive 4 wheels (8 coords)", 8, &[2, 3, 4], 4, 2),
    entry("4 fixed wheels (skid steer), ideal", 7, &[1], 6, 0),
    entry("kinematic car (x,y,phi,delta)", 4, &[2, 3, 4], 0, 2),
    entry("kinematic car + one drive angle (x,y,phi,th,delta)", 5, &[2, 3, 4, 5], 0, 3),
    entry("N=0 trailers regular", 3, &[2, 3], 0, 1),
    entry("N=0 trailers all b_i=pi/2", 3, &[2, 3], 0, 1),
    entry("N=1 trailers regular", 4, &[2, 3, 4], 0, 2),
    entry("N=1 trailers all b_i=pi/2", 4, &[2, 3, 4], 0, 2),
    entry("N=2 trailers regular", 5, &[2, 3, 4, 5], 0, 3),
    entry("N=2 trailers all b_i=pi/2", 5, &[2, 3, 4, 4, 5], 0, 3),
    entry("N=3 trailers regular", 6, &[2, 3, 4, 5, 6], 0, 4),
    entry("N=3 trailers all b_i=pi/2", 6, &[2, 3, 4, 4, 5, 5, 5, 6], 0, 4),
    entry("N=2 b1=pi/2 b2=0", 5, &[2, 3, 4, 4, 5], 0, 3),
    entry("N=2 b1=0 b2=pi/2", 5, &[2, 3, 4, 5], 0, 3),
    entry("N=0 trailers + theta (paper 4+N coords)", 4, &[2, 3, 4], 0, 2),
    entry("front-steered car + theta + N=0 trailers", 5, &[2, 3, 4, 5], 0, 3),
    entry("N=1 trailers + theta (paper 4+N coords)", 5, &[2, 3, 5], 0, 3),
    entry("front-steered car + theta + N=1 trailers", 6, &[2, 3, 4, 5, 6], 0, 4),
    entry("N=2 trailers + theta (paper 4+N coords)", 6, &[2, 3, 5, 6], 0, 4),
    entry("front-steered car + theta + N=2 trailers", 7, &[2, 3, 4, 5, 7], 0, 5),
];

fn steered(wheels: &str) -> String {
    format!("{wheels}{}", measured(&["delta"]))
}

fn right_angle() -> Exact {
    toward(0, 1)
}

/// N trailers at general angles, or all perpendicular.
fn at_angles(betas: &[Exact]) -> Point {
    trailers(general(), &headings(&toward(4, 3), betas))
}

/// General angles of trailers with small components.
fn regular(count: usize) -> Vec<Exact> {
    let betas = [toward(3, 4), toward(12, -5), toward(4, 3), toward(15, 8), toward(12, 5)];
    betas[..count].to_vec()
}

/// The vehicle and the point of an entry.
fn example(name: &str) -> (Mechanism, Point) {
    let car = || steered(&format!("{SINGLE_WHEEL}{FRONT_AXLE}"));
    let synchro = |places: &[(&str, &str)]| format!("{}{}", wheels_at(places, Some("psi")), measured(&["psi"]));
    let count = |name: &str| ["N=0", "N=1", "N=2", "N=3"].iter().position(|n| name.contains(n));
    if let Some(n) = count(name) {
        let betas = match name {
            "N=2 b1=pi/2 b2=0" => vec![right_angle(), Exact::ratio(0, 1)],
            "N=2 b1=0 b2=pi/2" => vec![Exact::ratio(0, 1), right_angle()],
            _ if name.contains("all b_i=pi/2") => vec![right_angle(); n],
            _ => regular(n),
        };
        let text = match name {
            _ if name.starts_with("front-steered") => car(),
            _ if name.contains("theta") => SINGLE_WHEEL.to_string(),
            _ => AXLE.to_string(),
        };
        return (of(&text, n), at_angles(&betas));
    }
    match name.split([' ', ':']).next() {
        Some("single") => (of(SINGLE_WHEEL, 0), general()),
        Some("two-wheel") => (of(TWO_WHEEL, 0), general()),
        Some("three-wheel") if name.contains("castor") => (of(&format!("{TWO_WHEEL}{CASTOR}"), 0), general()),
        Some("three-wheel") => (of(&steered(&format!("{FRONT_STEERED}{REAR_WHEELS}")), 0), general()),
        Some("four-wheel") => (of(&steered(&format!("{REAR_WHEELS}{ACKERMANN_FRONT}")), 0), ackermann()),
        Some("synchro-drive") if name.contains("3 wheels") => {
            (of(&synchro(&[("L", "0"), ("-L", "a"), ("-L", "-a")]), 0), general())
        }
        Some("synchro-drive") => (of(&synchro(&SKID_PLACES), 0), general()),
        Some("4") => (of(&wheels_at(&SKID_PLACES, None), 0), general()),
        Some("kinematic") if name.contains("drive angle") => (of(&car(), 0), general()),
        Some("kinematic") => (of(&steered(&format!("{AXLE}{FRONT_AXLE}")), 0), general()),
        _ => panic!("{name} is not described"),
    }
}

#[test]
fn every_entry_of_the_table_comes_out() {
    for entry in &TABLE {
        let (mechanism, at) = example(entry.name);
        let start = std::time::Instant::now();
        let found = mechanism.nonholonomy(&at, 9).unwrap_or_else(|e| panic!("{}: {e}", entry.name));
        println!("{:?} {}: {:?} {:?}", start.elapsed(), entry.name, found.growth, found.integrals);
        let rank = entry.holonomic + entry.nonholonomic;
        assert_eq!(mechanism.coordinates.len(), entry.n, "{}", entry.name);
        assert_eq!(found.growth.dimensions, entry.growth, "{}", entry.name);
        assert_eq!((found.growth.rank, mechanism.rank(&at).unwrap()), (rank, rank), "{}", entry.name);
        assert_eq!((found.holonomic, found.nonholonomic), (entry.holonomic, entry.nonholonomic), "{}", entry.name);
        assert!(found.is_proved() && found.growth.is_final, "{}", entry.name);
    }
}
