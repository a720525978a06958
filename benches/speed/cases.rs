//! The cases of the benchmarks, and that yardsticks and library do the same work on them.

use super::{CREEPS, MANY, jacobian, rates, trailers, wheel};
use creepage::formula::Isa;
use creepage::motion::Ensemble;

/// The largest difference of two results.
fn difference(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// Steps of order 8, by hand, whose error is at most 1e-10 on these cases.
fn fewest<const N: usize>(exact: &[[f64; N]], run: impl Fn(usize, &mut [[f64; N]])) -> usize {
    let mut out = vec![[0.0; N]; exact.len()];
    let good = |steps: &usize| {
        run(*steps, &mut out);
        exact.iter().zip(&out).all(|(a, b)| difference(a, b) <= 1e-10)
    };
    (4..200).find(good).expect("some number of steps is enough")
}

/// Wheels of many creeps, and the steps that they need by hand.
pub fn wheel_cases() -> (Vec<[f64; 2]>, usize) {
    let cases: Vec<[f64; 2]> = (0..MANY).map(|i| wheel::creeps(i, MANY)).collect();
    let exact: Vec<[f64; 3]> = cases.iter().step_by(16).map(|e| exact_wheel(*e)).collect();
    let some: Vec<[f64; 2]> = cases.iter().step_by(16).copied().collect();
    let steps = fewest(&exact, |steps, out| wheel::limit(&some, steps, out));
    (cases, steps)
}

fn exact_wheel([e_rc, e_tc]: [f64; 2]) -> [f64; 3] {
    let p = creepage::energy_rule::fig7_case(e_rc, e_tc, creepage::energy_rule::Reading::A).unwrap();
    [p.x, p.y, p.phi]
}

fn exact_trailers(case: [f64; 2]) -> [f64; trailers::N] {
    let mut out = vec![[0.0; trailers::N]; 16];
    trailers::limit(&[case; 16], 400, &mut out);
    out[0]
}

/// Trains of many lengths, and the steps that they need by hand.
pub fn trailer_cases() -> (Vec<[f64; 2]>, usize) {
    let cases: Vec<[f64; 2]> = (0..MANY).map(|i| trailers::case(i, MANY)).collect();
    let some: Vec<[f64; 2]> = cases.iter().step_by(16).copied().collect();
    let exact: Vec<[f64; trailers::N]> = some.iter().map(|c| exact_trailers(*c)).collect();
    let steps = fewest(&exact, |steps, out| trailers::limit(&some, steps, out));
    (cases, steps)
}

/// That yardsticks and library do the same work.
pub fn check() {
    let single = wheel::Single::new(CREEPS).run(CREEPS);
    assert!(difference(&single, &exact_wheel(CREEPS)) < 1e-9 && difference(&single, &wheel::by_hand(CREEPS)) < 1e-9);
    let case = trailers::case(5, MANY);
    let (single, exact) = (trailers::Single::new().run(case), exact_trailers(case));
    assert!(difference(&single, &exact) < 1e-8 && difference(&single, &trailers::by_hand(case)) < 1e-8);
    let cases: Vec<[f64; 2]> = (0..64).map(|i| wheel::creeps(i, 64)).collect();
    let found = all(&wheel::ensemble(), &cases);
    assert!(cases.iter().zip(&found).all(|(e, z)| difference(&z[..3], &exact_wheel(*e)) < 1e-10));
    let cases: Vec<[f64; 2]> = (0..64).map(|i| trailers::case(i, 64)).collect();
    let found = all(&trailers::ensemble(), &cases);
    assert!(cases.iter().zip(&found).all(|(c, z)| difference(&z[..trailers::N], &exact_trailers(*c)) < 1e-10));
    check_jacobian();
    let rows: Vec<[f64; 4]> = (0..rates::SAMPLES).map(rates::sample).collect();
    let (ours, theirs) = (rates::Library::new().run(), rates::by_hand(&rows));
    assert!(difference(&ours, &theirs) < 1e-10 && difference(&ours, &[0.1, 0.2]) < 1e-3, "{ours:?} and {theirs:?}");
}

fn check_jacobian() {
    let mut ours = jacobian::compiled(jacobian::TRAILERS);
    assert_eq!((ours.rows, ours.coordinates), (12, 14));
    ours.lanes.run(&mut ours.memory, Isa::best());
    let mut theirs = jacobian::ByHand::new(&headings());
    theirs.run();
    for (k, (row, column)) in ours.places.iter().enumerate() {
        let value = ours.lanes.output(&ours.memory, k)[0];
        let heading = |c: usize| headings().iter().position(|h| *h == c);
        let found = match (row, *column) {
            // The rolling row: cos φ·x′ + sin φ·y′ − r·θ′.
            (0, 2) => Some(theirs.rolling[0]),
            (0, c) if c >= 14 => continue,
            (i, c) if c < 14 => heading(c).map(|j| theirs.by_phi[i - 1][j][0]),
            (i, 14) => Some(theirs.sine[i - 1][0]),
            (i, 15) => Some(-theirs.cosine[i - 1][0]),
            (i, c) => heading(c - 14).map(|j| theirs.by_rate[i - 1][j][0]),
        };
        let found = found.unwrap_or_else(|| panic!("no yardstick for row {row}, column {column}"));
        assert!((value - found).abs() < 1e-12, "row {row}, column {column}: {value} and {found}");
    }
    let _ = jacobian::RADIUS;
}

/// The places of the headings among x, y, phi, theta, phi_1 ….
pub fn headings() -> Vec<usize> {
    std::iter::once(2).chain(4..14).collect()
}

fn all(e: &Ensemble, cases: &[[f64; 2]]) -> Vec<Vec<f64>> {
    let given: Vec<&[f64]> = cases.iter().map(|c| c.as_slice()).collect();
    let plan = e.plan(|i| cases[i].to_vec(), cases.len()).unwrap();
    let found = e.run(&plan, &given).unwrap();
    found.into_iter().map(|c| c.values).collect()
}
