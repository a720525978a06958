//! Numbers that others have certified or published: curves fitted, equations integrated, a car driven.

mod curve;
mod nist;
mod orbits;
mod published;
#[allow(clippy::excessive_precision)] // as published
mod single_track;

use curve::{Problem, digits, fit};

/// Digits of the parameters that must agree with the 11 certified.
const DIGITS: f64 = 10.0;
/// Digits of their standard deviations and of the sum of squares: normal equations lose some.
const DIGITS_OF_SPREAD: f64 = 6.0;

/// Fits from both starts; whether both arrive at the certified values.
fn solved(problem: &Problem) -> bool {
    let each = problem.starts.each_ref().map(|start| {
        let found = fit(problem, start);
        let b = digits(&found.b, &problem.certified);
        let (sd, ss) = (digits(&found.deviations, &problem.deviations), digits(&[found.squares], &[problem.squares]));
        println!("{:10} b {b:5.2}  deviations {sd:5.2}  squares {ss:5.2}  steps {}", problem.name, found.steps);
        // Residuals of 1e-13 of the data, as those of Lanczos1, are the rounding of the data themselves.
        let exact = problem.squares < 1e-20;
        b >= DIGITS && (exact || sd.min(ss) >= DIGITS_OF_SPREAD)
    });
    each == [true, true]
}

#[test]
fn the_problems_of_nist_are_solved_from_both_starts() {
    let Some(folder) = nist::folder() else {
        println!("skipped: no folder nist_strd, see NIST_STRD");
        return;
    };
    let missed: Vec<&str> = nist::MODELS
        .iter()
        .filter(|(name, model)| !solved(&nist::read(&folder, name, model)))
        .map(|(name, _)| *name)
        .collect();
    assert!(missed.is_empty(), "{missed:?}");
}

#[test]
fn published_problems_are_solved_from_both_starts() {
    let missed: Vec<String> = published::problems().iter().filter(|p| !solved(p)).map(|p| p.name.clone()).collect();
    assert!(missed.is_empty(), "{missed:?}");
}
