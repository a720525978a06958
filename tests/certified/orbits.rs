//! Initial value problems with published end values.

use creepage::motion::{Integrator, Method};

/// A problem as it is published: where it begins, how long it lasts, where it ends.
struct Published {
    name: &'static str,
    rhs: fn(&[f64], &mut [f64]),
    begin: Vec<f64>,
    end_time: f64,
    end: Vec<f64>,
    /// How far off the end may be at a tolerance of 1e-13: rounding and tolerance, grown by the problem.
    within: f64,
}

/// Seven stars, the i-th of mass i.
///
/// Source: Hairer, Nørsett and Wanner, *Solving Ordinary Differential Equations I*, II.10; end values of the *Test Set
/// for Initial Value Problem Solvers* (Bari).
fn pleiades(y: &[f64], dy: &mut [f64]) {
    dy[..14].copy_from_slice(&y[14..]);
    for i in 0..7 {
        let (mut along, mut across) = (0.0, 0.0);
        for j in (0..7).filter(|j| *j != i) {
            let (dx, dz) = (y[j] - y[i], y[7 + j] - y[7 + i]);
            let pull = (j + 1) as f64 / (dx * dx + dz * dz).powf(1.5);
            along += pull * dx;
            across += pull * dz;
        }
        (dy[14 + i], dy[21 + i]) = (along, across);
    }
}

/// A satellite between earth and moon that comes back to where it was.
///
/// Source: Hairer, Nørsett and Wanner, II.0, with the period in 28 digits.
fn arenstorf(y: &[f64], dy: &mut [f64]) {
    let mu = 0.012277471;
    let rest = 1.0 - mu;
    let d1 = ((y[0] + mu).powi(2) + y[1] * y[1]).powf(1.5);
    let d2 = ((y[0] - rest).powi(2) + y[1] * y[1]).powf(1.5);
    (dy[0], dy[1]) = (y[2], y[3]);
    dy[2] = y[0] + 2.0 * y[3] - rest * (y[0] + mu) / d1 - mu * (y[0] - rest) / d2;
    dy[3] = y[1] - 2.0 * y[2] - rest * y[1] / d1 - mu * y[1] / d2;
}

/// Euler's rigid body without forces; its period is 4K.
///
/// Source: DETEST B5, Hull, Enright, Fellen and Sedgwick 1972; K in 31 digits from Krogh 1973.
fn rigid_body(y: &[f64], dy: &mut [f64]) {
    dy[0] = y[1] * y[2];
    dy[1] = -y[0] * y[2];
    dy[2] = -0.51 * y[0] * y[1];
}

/// Two bodies on an orbit of eccentricity 0.9: Kepler's equation tells where they are.
///
/// Source: DETEST D5.
fn two_bodies(y: &[f64], dy: &mut [f64]) {
    let r3 = y[0].hypot(y[1]).powi(3);
    (dy[0], dy[1]) = (y[2], y[3]);
    (dy[2], dy[3]) = (-y[0] / r3, -y[1] / r3);
}

/// The place on the orbit of DETEST D5 at a time.
fn kepler(t: f64) -> Vec<f64> {
    let e = 0.9f64;
    let mut u = t;
    for _ in 0..200 {
        u -= (u - e * u.sin() - t) / (1.0 - e * u.cos());
    }
    let (s, w) = ((1.0 - e * e).sqrt(), 1.0 - e * u.cos());
    vec![u.cos() - e, s * u.sin(), -u.sin() / w, s * u.cos() / w]
}

const K: f64 = 1.862_640_802_332_738_6;

fn problems() -> Vec<Published> {
    let stars = [
        3.0, 3.0, -1.0, -3.0, 2.0, -2.0, 2.0, 3.0, -3.0, 2.0, 0.0, 0.0, -4.0, 4.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.75, -1.5,
        0.0, 0.0, 0.0, -1.25, 1.0, 0.0, 0.0,
    ];
    let stars_end = [
        0.3706139143970502,
        3.237284092057233,
        -3.222559032418324,
        0.659709145577531,
        0.3425581707156584,
        1.562172101400631,
        -0.7003092922212495,
        -3.943437585517392,
        -3.27138097397255,
        5.225081843456543,
        -2.59061243497747,
        1.198213693392275,
        -0.2429682344935824,
        1.09144924042898,
        3.417003806314313,
        1.354584501625501,
        -2.590065597810775,
        2.025053734714242,
        -1.155815100160448,
        -0.8072988170223021,
        0.595239635420871,
        -3.74124496123401,
        0.377345968575063,
        0.9386858869551073,
        0.3667922227200571,
        -0.347404635380849,
        2.344915448180937,
        -1.947020434263292,
    ];
    let satellite = [0.994, 0.0, 0.0, -2.001_585_106_379_082_5];
    vec![
        Published {
            name: "Pleiades",
            rhs: pleiades,
            begin: stars.to_vec(),
            end_time: 3.0,
            end: stars_end.to_vec(),
            within: 2e-10,
        },
        Published {
            name: "Arenstorf",
            rhs: arenstorf,
            begin: satellite.to_vec(),
            end_time: 17.065_216_560_157_963,
            end: satellite.to_vec(),
            within: 1e-7,
        },
        Published {
            name: "rigid body",
            rhs: rigid_body,
            begin: vec![0.0, 1.0, 1.0],
            end_time: 4.0 * K,
            end: vec![0.0, 1.0, 1.0],
            within: 5e-12,
        },
        Published {
            name: "two bodies",
            rhs: two_bodies,
            begin: kepler(0.0),
            end_time: 20.0,
            end: kepler(20.0),
            within: 1e-9,
        },
    ]
}

#[test]
fn published_end_values_are_met() {
    for problem in problems() {
        for method in [Method::Dop853, Method::Dopri5] {
            let integrator = Integrator { method, ..Integrator::default() }.with_tolerance(1e-13, 1e-13);
            let rhs = |_: f64, y: &[f64], dy: &mut [f64]| (problem.rhs)(y, dy);
            let end = integrator.solve(rhs, 0.0, &problem.begin, &[problem.end_time]).unwrap().remove(0);
            let off = end.iter().zip(&problem.end).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            println!("{:10} {method:?}: {off:.1e}", problem.name);
            assert!(off <= problem.within, "{} by {method:?}: {off:e}", problem.name);
        }
    }
}
