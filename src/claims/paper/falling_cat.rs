//! Section 4, last paragraph: a falling cat of two halves, turned by the holonomy of its bend.

use super::symmetry::{all_of, base, within};
use crate::claims::simulated::undefined;
use crate::claims::{Claim, DerivedFormulas, Outcome, Status, near, proving, value_said};
use crate::connection::{Axis, Matrix, Path, RotationConnection, turned};
use crate::formula::{Expr, Symbol};
use std::f64::consts::TAU;

const ROTATION: &str = "src/connection/rotation.rs";

pub(crate) fn claims() -> Vec<Claim> {
    vec![cat(), cat_loop()]
}

/// Bent by γ towards τ, without twist.
fn bent() -> Matrix {
    let [gamma, tau] = ["gamma", "tau"].map(Expr::sym);
    turned(&[(Axis::Z, tau.clone()), (Axis::Y, gamma), (Axis::Z, -&tau)])
}

/// Two halves with moments a, a, c of either.
fn halves(moments: [&str; 3]) -> RotationConnection {
    let half = moments.map(|m| Expr::parse(m).unwrap_or_default());
    RotationConnection::of_two_bodies(&half, &half, &bent(), &["gamma".into(), "tau".into()])
}

fn cat() -> Claim {
    let cat = halves(["a", "a", "c"]);
    // On the plane tau = 0 every direction of bending is met: the cat has no preferred one.
    let ahead = |e: &Expr| e.substitute(&|s| (s.as_str() == "tau").then(|| Expr::int(0)));
    let derived = ["x", "y", "z"].iter().enumerate().fold(DerivedFormulas::default(), |m, (k, axis)| {
        m.with(&format!("bend_{axis}"), ahead(&cat.form[0][k])).with(&format!("round_{axis}"), ahead(&cat.form[1][k]))
    });
    let curve = cat.curvature(0, 1)[2].derivative(&"gamma".into());
    let small = DerivedFormulas::default().with("curvature_z", curve).with_text("gamma", "0").with_text("tau", "0");
    base(
        "falling-cat",
        Status::Proved,
        "two axisymmetric halves without twist, J·ω + Q·J·Qᵀ·(ω + ω_Q) = 0: a falling cat turns by going round with its bend",
    )
    .under("equal halves with moments a, a, c; bent by γ towards τ, here at τ = 0; angular momentum zero")
    .code(&[ROTATION, "src/connection/space.rs"])
    .tests(&["tests/symmetry/cat.rs"])
    .proof(
        "local form in the frame of the first half, bending and going round",
        &[
            ("bend_x", "0"),
            ("bend_y", "-1/2"),
            ("bend_z", "0"),
            ("round_x", "(1/2 + (c - a)*(1 - cos(gamma))/(2*(a*(1 - cos(gamma)) + c*(1 + cos(gamma)))))*sin(gamma)"),
            ("round_y", "0"),
            (
                "round_z",
                "(c - a)*(1 - cos(gamma))*(1 + cos(gamma))/(2*(a*(1 - cos(gamma)) + c*(1 + cos(gamma)))) - (1 - cos(gamma))/2",
            ),
        ],
        proving(derived),
    )
    .proof(
        "the slope of the curvature where the bend begins: a small loop turns the cat by (1/4 − a/(2c))·π·γ², −7/4·π·γ² for c = a/4",
        &[("curvature_z", "1/4 - a/(2*c)")],
        proving(small),
    )
}

fn cat_loop() -> Claim {
    base("falling-cat-loop", Status::Sampled, "once round with the bend γ turns the cat by −5.4848·γ² about its axis at γ = 0.05 and by 3.0196 in all at γ = 1")
        .under("J = diag(1, 1, 1/4)")
        .code(&[ROTATION])
        .tests(&["tests/symmetry/cat.rs"])
        .sample(
            "orientation integrated along the loop",
            &[("about_z", "-5.4848"), ("angle", "3.0196")],
            |s, _| {
                let cat = halves(["1", "1", "1/4"]);
                let turned = |gamma: f64| {
                    let path = Path::new(&[("gamma", "g"), ("tau", "t")], [0.0, TAU]);
                    path.and_then(|path| cat.holonomy(&path, &[("g", gamma)]))
                };
                let (Ok(small), Ok(large)) = (turned(0.05), turned(1.0)) else {
                    return Outcome::Undefined("the cat cannot be turned".into());
                };
                let said = |name: &str| s.number(name).unwrap_or(f64::NAN);
                all_of([
                    within("about_z", small.vector()[2] / 0.0025, said("about_z"), 5e-5),
                    within("angle", large.angle(), said("angle"), 5e-5),
                ])
            },
        )
        .sample(
            "the same as one turn about a fixed axis, because going round repeats itself in a frame that goes round too",
            &[("angle", "2*pi*(1 - sqrt(w_x^2 + (1 + w_z)^2))")],
            |s, sampling| {
                let cat = halves(["a", "a", "c"]);
                let bodies = (0.1..1.2f64, 0.5..2.0f64, 0.2..1.0f64);
                let show = |(g, a, c): &(f64, f64, f64)| vec![("gamma, a, c".into(), format!("{g}, {a}, {c}"))];
                sampling.at_most(4).cases(bodies, show, |(gamma, a, c)| {
                    let values = [("g", *gamma), ("a", *a), ("c", *c)];
                    let path = Path::new(&[("gamma", "g"), ("tau", "t")], [0.0, TAU]);
                    let found = path.and_then(|path| cat.holonomy(&path, &values)).map_err(|e| undefined(&e))?;
                    let at_start = |name: &Symbol| match name.as_str() {
                        "gamma" => *gamma,
                        "a" => *a,
                        "c" => *c,
                        _ => 0.0,
                    };
                    let w = |k: usize| cat.form[1][k].eval(&at_start);
                    let at = |name: &str| match name {
                        "pi" => Some(std::f64::consts::PI),
                        "w_x" => w(0),
                        "w_z" => w(2),
                        _ => None,
                    };
                    near("angle", found.angle(), value_said(s, "angle", &at)?, 1e-10)
                })
            },
        )
        .sabotaged_by(&[
            &[("angle", "2*pi*(1 + sqrt(w_x^2 + (1 + w_z)^2))")],
            &[("angle", "2*pi*(1 - sqrt(w_x^2 + (1 - w_z)^2))")],
            &[("angle", "2*pi*(1 - sqrt(w_x^2 - (1 + w_z)^2))")],
            &[("angle", "2*pi*(1 - sqrt((1 + w_z)^2))")],
            &[("angle", "pi*(1 - sqrt(w_x^2 + (1 + w_z)^2))")],
        ])
}
