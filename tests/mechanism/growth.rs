//! Growth vectors, ranks and integrals of the vehicles of the table, in exact arithmetic.

use crate::support::described::*;
use creepage::formula::{Exact, Expr, Symbol};
use creepage::mechanism::{Mechanism, Point, Rolling, Row};

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
        assert!(found.counts_agree() && found.growth.is_final, "{}", entry.name);
    }
}

/// Degree of nonholonomy of the car with n trailers: regular, and all perpendicular (Jean 1996).
const DEGREES: [(usize, usize); 6] = [(2, 2), (3, 3), (4, 5), (5, 8), (6, 13), (7, 21)];

#[test]
fn trains_have_the_degrees_of_jean() {
    for (n, (straight, bent)) in DEGREES.iter().enumerate() {
        let growth = |betas: &[Exact]| of(AXLE, n).growth(&at_angles(betas), n + 3, 22).unwrap();
        let found = growth(&regular(n));
        let all: Vec<usize> = (2..=n + 3).collect();
        assert_eq!((found.degree_of_nonholonomy, &found.dimensions), (*straight, &all), "{n} regular");
        assert!(found.is_final);
        // Longer trains take minutes.
        if n <= 3 {
            let found = growth(&vec![right_angle(); n]);
            assert_eq!((found.degree_of_nonholonomy, found.dimensions.last()), (*bent, Some(&(n + 3))), "{n} bent");
            assert!(found.is_final);
        }
    }
}

#[test]
fn the_last_angle_does_not_matter() {
    // Jean: the angle of the last trailer never makes a configuration singular, the others only by right angles.
    let [zero, right, some] = [Exact::ratio(0, 1), right_angle(), toward(4, 3)];
    let degree = |betas: &[Exact]| of(AXLE, betas.len()).growth(&at_angles(betas), betas.len() + 3, 9).unwrap();
    for last in [&zero, &right, &some, &toward(0, -1)] {
        assert_eq!(degree(&[zero.clone(), last.clone()]).degree_of_nonholonomy, 4, "{last}");
        assert_eq!(degree(&[some.clone(), last.clone()]).degree_of_nonholonomy, 4, "{last}");
        assert_eq!(degree(&[right.clone(), last.clone()]).degree_of_nonholonomy, 5, "{last}");
    }
}

/// The reference next to the repository, where there is one.
fn reference(file: &str) -> Option<String> {
    let place = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/reference");
    std::fs::read_to_string(place.join(file)).ok()
}

#[test]
fn the_numbers_here_are_those_of_the_reference() {
    if let Some(text) = reference("growth_table.json") {
        let table: serde_json::Map<String, serde_json::Value> = serde_json::from_str(&text).unwrap();
        assert_eq!(table.len(), TABLE.len());
        for entry in &TABLE {
            let row = &table[entry.name];
            let number = |key: &str| row[key].as_u64().map(|v| v as usize);
            assert_eq!(row["growth"], serde_json::json!(entry.growth), "{}", entry.name);
            assert_eq!(number("n"), Some(entry.n), "{}", entry.name);
            assert_eq!(number("codim"), Some(entry.holonomic + entry.nonholonomic), "{}", entry.name);
            assert_eq!(number("holonomic"), Some(entry.holonomic), "{}", entry.name);
            assert_eq!(number("nonholonomic"), Some(entry.nonholonomic), "{}", entry.name);
        }
    }
    if let Some(text) = reference("jean_ntrailer_degree.csv") {
        let lines = text.lines().filter(|l| l.starts_with(|c: char| c.is_ascii_digit()));
        let rows = lines.map(|l| l.split(',').map(|v| v.parse::<usize>().unwrap()).collect::<Vec<_>>());
        for (row, degrees) in rows.zip(DEGREES) {
            assert_eq!((row[1], row[2], row[3]), (degrees.0, degrees.1, row[0] + 3));
        }
    }
}

#[test]
fn integrals_are_found_and_written_with_their_parameters() {
    let formulas = |name: &str| {
        let (mechanism, at) = example(name);
        mechanism.integrals(&at).iter().map(|i| i.formula.to_string()).collect::<Vec<_>>()
    };
    assert_eq!(formulas("two-wheel diff drive (26)(27)(28)"), ["r*theta_1 - r*theta_2 - a*phi"]);
    assert_eq!(formulas("four-wheel Ackermann (8 coords)"), ["R*theta_1 - R*theta_2 - a*phi"]);
    let three = ["phi", "theta_1 - theta_2", "theta_1 - theta_3"];
    assert_eq!(formulas("synchro-drive 3 wheels (7 coords)"), three);
    assert_eq!(formulas("synchro-drive 4 wheels (8 coords)")[3..], ["theta_1 - theta_4"]);
    let skid = formulas("4 fixed wheels (skid steer), ideal");
    assert_eq!(skid[..4], ["phi", "theta_1 - theta_2", "theta_1 - theta_3", "theta_1 - theta_4"]);
    assert_eq!(skid[4..], ["x*sin(phi) - y*cos(phi)", "x - r*theta_1*cos(phi)"]);
    assert_eq!(formulas("kinematic car (x,y,phi,delta)"), [""; 0]);
}

#[test]
fn a_body_that_turns_about_a_wheel_stays_on_its_circle() {
    // The wheel at the left is steered out of the line of the axle: it stands still, and the body turns about it.
    let text =
        format!("{AXLE}[[wheels]]\nname = \"left\"\nleft = \"b\"\nsteering = \"delta\"\ntraverse_creep = \"e\"\n");
    let found = of(&steered(&text), 0).nonholonomy(&general().with("b", Exact::ratio(3, 2)), 5).unwrap();
    let formulas: Vec<String> = found.integrals.iter().map(|i| i.formula.to_string()).collect();
    assert_eq!(formulas, ["y + b*cos(phi)", "x - b*sin(phi)"]);
    assert_eq!((found.growth.dimensions.as_slice(), found.counts_agree()), (&[2][..], true));
}

#[test]
fn an_integral_with_the_square_of_a_parameter_is_found() {
    // Radii that are products: b^2·theta_1 − b·k·theta_2 − a·phi.
    let text = TWO_WHEEL.replacen("radius = \"r\"", "radius = \"r_1\"", 1);
    let product = |s: &Symbol| match s.as_str() {
        "r_1" => Some(Expr::parse("b^2").unwrap()),
        "r" => Some(Expr::parse("b*k").unwrap()),
        _ => None,
    };
    let at = general().with("b", Exact::ratio(2, 3)).with("k", Exact::ratio(5, 4));
    let found = of(&text, 0).substitute(&product).integrals(&at);
    assert_eq!(found.len(), 1);
    assert_eq!(found[0].formula.to_string(), "b*b*theta_1 - b*k*theta_2 - a*phi");
    // A root of a parameter is no product: the factors are those of the point.
    let root = |s: &Symbol| (s.as_str() == "r_1").then(|| Expr::parse("sqrt(b)").unwrap());
    let at = general().with("b", Exact::ratio(4, 9));
    let found = of(&text, 0).substitute(&root).integrals(&at);
    assert_eq!(found.iter().map(|i| i.formula.to_string()).collect::<Vec<_>>(), ["4*theta_1 - 3*theta_2 - 9*phi"]);
}

#[test]
fn a_mounting_angle_enters_an_integral_by_its_value() {
    // Wheels askew by alpha, cos = 4/5, roll: r·theta_1 − r·theta_2 − a·cos(alpha)·phi with r = 1/2, a = 3/2.
    let wheels = TWO_WHEEL.replace("radius = \"r\"", "steering = \"alpha\"\nradius = \"r\"");
    let text = format!("{wheels}[define.alpha]\nformula = \"mount\"\nunit = \"rad\"\nmeaning = \"\"\n");
    let robot = of(&text, 0);
    assert_eq!(robot.coordinates.len(), 5);
    let found = robot.nonholonomy(&general().with("alpha", toward(4, 3)), 6).unwrap();
    assert_eq!((found.growth.dimensions.as_slice(), found.counts_agree()), (&[2, 3, 4][..], true));
    assert_eq!(found.integrals[0].formula.to_string(), "5*theta_1 - 5*theta_2 - 12*phi");
}

#[test]
fn points_that_say_nothing_are_refused() {
    let wheel = of(SINGLE_WHEEL, 0);
    let error = wheel.growth(&lengths().with("phi", toward(1, 1)), 4, 6).unwrap_err();
    assert!(error.to_string().contains("has no exact value at this point"), "{error}");
    assert!(wheel.growth(&Point::default(), 4, 6).is_err() && wheel.rank(&Point::default()).is_err());
    // Synchro-drive with all wheels along the line of their places: the yaw is free here and nowhere near.
    let line = format!("{}{}", wheels_at(&[("L", "0"), ("-L", "0")], Some("psi")), measured(&["psi"]));
    let turned = |psi: Exact| of(&line, 0).growth(&general().with("psi", psi), 4, 6);
    let error = turned(toward(0, 1)).unwrap_err();
    assert!(error.to_string().contains("fewer at this point than near it"), "{error}");
    assert!(turned(toward(4, 3)).is_ok());
}

#[test]
fn without_the_integral_the_end_is_not_proved() {
    let (robot, at) = example("two-wheel diff drive (26)(27)(28)");
    let growth = robot.growth(&at, 5, 5).unwrap();
    assert_eq!((growth.dimensions.as_slice(), growth.is_final), (&[2, 3, 4][..], false));
    // Brackets are too short to show all: the vector is cut where the search stopped.
    let growth = of(AXLE, 3).growth(&at_angles(&regular(3)), 6, 4).unwrap();
    assert_eq!((growth.dimensions.as_slice(), growth.is_final), (&[2, 3, 4, 5][..], false));
}

/// A mechanism of rows with given coefficients, such as no vehicle has.
fn made_of(coordinates: &[&str], rows: &[&[(&str, &str)]]) -> Mechanism {
    let constraint = |(k, terms): (usize, &&[(&str, &str)])| {
        let mut pi = Row::default();
        terms.iter().for_each(|(rate, c)| pi.add(*rate, &Expr::parse(c).unwrap()));
        let rolling = Rolling { pi, sigma: Expr::int(0), rate: "none'".into() };
        rolling.constraint(&format!("row {k}"), &Symbol::new(&format!("e_{k}")))
    };
    Mechanism {
        coordinates: coordinates.iter().map(|q| Symbol::from(*q)).collect(),
        constraints: rows.iter().enumerate().map(constraint).collect(),
    }
}

#[test]
fn the_fields_are_those_the_constraints_leave() {
    // d[(z + u)(1 + v)] = 0 is integrable; with any sign wrong it is not.
    let surface = made_of(&["z", "u", "v"], &[&[("z'", "1 + v"), ("u'", "1 + v"), ("v'", "z + u")]]);
    let at = ["z", "u", "v"].iter().zip(2..).fold(Point::default(), |p, (q, k)| p.with(*q, Exact::ratio(k, 3)));
    let growth = surface.growth(&at, 3, 5).unwrap();
    assert_eq!((growth.dimensions.as_slice(), growth.is_final), (&[2][..], false));
    // Martinet: z' = u^2·v' grows one bracket later on u = 0.
    let martinet = made_of(&["z", "u", "v"], &[&[("z'", "1"), ("v'", "-u^2")]]);
    let on = |u: i64| martinet.growth(&at.clone().with("u", Exact::ratio(u, 2)), 3, 5).unwrap().dimensions;
    assert_eq!((on(0), on(1)), (vec![2, 2, 3], vec![2, 3]));
}

#[test]
fn an_integral_has_products_of_two_parameters_where_it_needs_them() {
    let geared = made_of(&["x", "y"], &[&[("x'", "g*r"), ("y'", "-b")]]);
    let at = ["g", "r", "b"].iter().zip(2..).fold(Point::default(), |p, (s, k)| p.with(*s, Exact::ratio(k, 7)));
    let found: Vec<String> = geared.integrals(&at).iter().map(|i| i.formula.to_string()).collect();
    assert_eq!(found, ["g*r*x - b*y"]);
}

#[test]
fn an_integral_that_is_not_found_is_a_disagreement() {
    // z·exp(-u) is constant and none of the functions tried; a motion of one dimension is integrable all the same.
    let grown = made_of(&["z", "u"], &[&[("z'", "1"), ("u'", "-z")]]);
    let at = ["z", "u"].iter().fold(Point::default(), |p, q| p.with(*q, Exact::ratio(2, 3)));
    let found = grown.nonholonomy(&at, 4).unwrap();
    assert_eq!((found.holonomic, found.integrals.len(), found.counts_agree()), (1, 0, false));
}

#[test]
fn a_rank_that_changes_is_noticed_in_both_ways() {
    let with = |c: &str| made_of(&["z", "u", "w"], &[&[("z'", "1")], &[("w'", c)]]);
    let at = |u: Exact| Point::default().with("z", Exact::ratio(1, 1)).with("w", Exact::ratio(1, 1)).with("u", u);
    // Flat at the point: short series do not see it, other points do.
    let flat = with("u^6");
    assert!(flat.growth(&at(Exact::ratio(0, 1)), 3, 2).is_err());
    assert_eq!(flat.growth(&at(Exact::ratio(1, 2)), 3, 2).unwrap().dimensions, [1]);
    // Without exact values elsewhere: the series see it.
    let root = with("sqrt(1 + u^3 + u) - 1");
    assert!(root.growth(&at(Exact::ratio(0, 1)), 3, 3).is_err());
}

#[test]
fn samples_where_the_rank_drops_are_left_out() {
    // The row vanishes at about half of the u that are drawn, numbers p/q with q below 12.
    let zeros = (1..6)
        .flat_map(|q: i64| (1..60).map(move |p| (p, q)))
        .filter(|(p, q)| (2..=*q).all(|d| p % d > 0 || q % d > 0));
    let zeros: Vec<String> = zeros.map(|(p, q)| format!("({q}*u - {p})")).collect();
    let rows = made_of(&["z", "u"], &[&[("z'", &zeros.join("*"))]]);
    let found = rows.integrals(&Point::default());
    assert_eq!(found.iter().map(|i| i.formula.to_string()).collect::<Vec<_>>(), ["z"]);
}
