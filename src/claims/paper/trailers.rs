//! Section 4: a car with N trailers; corrected theorem (c).

use super::domain::undefined_exactly_where;
use super::single_body::determinant;
use crate::claims::{Claim, DerivedFormulas, Outcome, Status, prove, proving};
use crate::formula::{Expr, Symbol};
use crate::vehicles;
use crate::vehicles::{Definition, Section, Wheel};

const CHAPTER: &str = "06-trailers";
const BUILD: &str = "src/model/build.rs";

/// A wheel with trailers; creeps free, v_t = e_0·v_l of the tractor.
fn train(n: usize) -> DerivedFormulas {
    DerivedFormulas::train("unicycle", n).with_text("e_tc", "e_0")
}

/// Hitches on the axles.
fn on_axle(n: usize) -> DerivedFormulas {
    (1..=n).fold(train(n), |m, i| m.with_text(&format!("c_{i}"), "0"))
}

/// Creeps by their angles, e_i = tan α_i, hitches on the axles; V_i and χ_i as in the theory.
pub(super) fn courses(n: usize) -> DerivedFormulas {
    let derived = on_axle(n).with_text("e_0", "tan(alpha_0)").with_text("chi_0", "phi + alpha_0");
    let derived = derived.with_text("V_0", "v_l/cos(alpha_0)");
    (1..=n).fold(derived, |m, i| {
        m.with_text(&format!("e_tc_{i}"), &format!("tan(alpha_{i})"))
            .with_text(&format!("chi_{i}"), &format!("phi_{i} + alpha_{i}"))
            .with_text(&format!("V_{i}"), &format!("v_{i}/cos(alpha_{i})"))
    })
}

/// Axle n behind another without creep, whatever speed and yaw rate the one ahead has.
fn ideal_step(n: usize) -> DerivedFormulas {
    let [speed, lateral, rate] = match n {
        1 => ["v_l", "v_t", "phi'"].map(String::from),
        _ => [format!("v_{}", n - 1), format!("vt_{}", n - 1), format!("phi_{}'", n - 1)],
    };
    on_axle(n).with_text(&format!("e_tc_{n}"), "0").freeing(&[&speed, &rate]).with_text(&lateral, "0")
}

/// A wheel with one trailer that has a rolling wheel of its own, and derivatives by the coefficient of that wheel.
fn rolling_trailer() -> DerivedFormulas {
    let Some(wheel) = vehicles::named("unicycle") else { return DerivedFormulas::default() };
    let mut vehicle = wheel.clone();
    let named = |name: &str, unit: &str, meaning: &str| Definition {
        formula: Expr::sym(name),
        unit: unit.into(),
        meaning: meaning.into(),
    };
    vehicle.define.insert("r_w".into(), named("trailer_wheel_radius", "m", "radius of the trailer's wheel"));
    vehicle.trailers.push(Section { name: "trailer".into(), length: Expr::sym("bar"), ..Section::default() });
    vehicle.wheels.push(Wheel {
        name: "trailer's wheel".into(),
        on: Some("trailer".into()),
        radius: Some("r_w".into()),
        rate: Some("theta_w'".into()),
        rotation_creep: Some("e_w".into()),
        ..Wheel::default()
    });
    let derived = DerivedFormulas::of_vehicle(&vehicle, 0);
    let by = |name: &str| derived.written_out(name).derivative(&"e_w".into());
    let (speed, yaw) = (by("v_1"), by("phi_1'"));
    derived.with("speed_by_e", speed).with("yaw_by_e", yaw)
}

/// Derivatives of a train's rates by the coefficients of its axles.
fn by_own_coefficient() -> DerivedFormulas {
    let own = |n: usize, ahead: &[&str], of: &str| {
        let step = train(n).freeing(ahead);
        step.written_out(of).derivative(&Symbol::new(&format!("e_tc_{n}")))
    };
    let second = &["v_1", "vt_1", "phi_1'"];
    // The axle ahead as it is, with all that is ahead of it.
    let ahead = |of: &str| train(3).written_out(of).derivative(&"e_tc_3".into());
    // What is said of v_1, v_2, v_3 speaks of the speeds, whatever they are made of.
    train(3)
        .with("first_by_own", own(1, &["v_l", "v_t"], "phi_1'"))
        .with("second_by_own", own(2, second, "phi_2'"))
        .with("third_by_own", own(3, &["v_2", "vt_2", "phi_2'"], "phi_3'"))
        .with("speed_by_own", own(2, second, "v_2"))
        .with("ahead_by_last", ahead("phi_2'"))
        .with("speed_ahead_by_last", ahead("v_2"))
}

/// Determinants of (v_l, v_t, φ̇_1, …) by (e_rc, e_0, e_1, …).
fn train_determinants() -> DerivedFormulas {
    (1..=2).fold(train(2), |m, n| {
        let (velocities, coefficients) = (["v_l", "v_t", "phi_1'", "phi_2'"], ["e_rc", "e_0", "e_tc_1", "e_tc_2"]);
        m.with(&format!("det_{n}"), determinant(&train(n), &velocities[..n + 2], &coefficients[..n + 2]))
    })
}

pub(super) fn base(id: &str, says: &str, place: &str) -> Claim {
    Claim::new(id, Status::Proved, says)
        .at(place)
        .chapter(CHAPTER)
        .code(&[BUILD])
        .tests(&["tests/motion/kinematics.rs"])
}

pub(crate) fn claims() -> Vec<Claim> {
    const PLACE: &str = "section 4, second theorem; corrected theorem (c)";
    vec![
        base("trailer-recursion", "each axle follows from the one ahead: v_i, v_t,i and θ̇_i with hitch offsets and creep", PLACE)
            .under("d_i ≠ 0; any N: each step is shown for whatever the axle ahead does")
        .proof(
            "the first axle behind the tractor, with h = v_t − c·θ̇ of the hitch",
            &[
                ("v_1", "v_l*cos(phi - phi_1) - (v_t - c_1*phi')*sin(phi - phi_1)"),
                ("vt_1", "e_tc_1*v_1"),
                ("d_1*phi_1'", "v_l*sin(phi - phi_1) + (v_t - c_1*phi')*cos(phi - phi_1) - e_tc_1*v_1"),
            ],
            proving(train(1).freeing(&["v_l", "v_t"])),
        )
        .proof(
            "an axle behind an axle",
            &[
                ("v_2", "v_1*cos(phi_1 - phi_2) - (vt_1 - c_2*phi_1')*sin(phi_1 - phi_2)"),
                ("vt_2", "e_tc_2*v_2"),
                ("d_2*phi_2'", "v_1*sin(phi_1 - phi_2) + (vt_1 - c_2*phi_1')*cos(phi_1 - phi_2) - e_tc_2*v_2"),
            ],
            proving(train(2).freeing(&["v_1", "vt_1", "phi_1'"])),
        )
        .proof(
            "and the next",
            &[
                ("v_3", "v_2*cos(phi_2 - phi_3) - (vt_2 - c_3*phi_2')*sin(phi_2 - phi_3)"),
                ("d_3*phi_3'", "v_2*sin(phi_2 - phi_3) + (vt_2 - c_3*phi_2')*cos(phi_2 - phi_3) - e_tc_3*v_3"),
            ],
            proving(train(3).freeing(&["v_2", "vt_2", "phi_2'"])),
        ),
        base("trailer-adds-one-T", "whatever drives ahead, one trailer more takes one coefficient more, of type T: no rate ahead depends on e_N, and ∂φ̇_N/∂e_N = −v_N/d_N. So det_N = det_0·Π(−v_i/d_i), and behind a wheel RT, a differential drive R²T and a car RT² the types are RT^(N+1), R²T^(N+1) and RT^(N+2) for all N", PLACE)
            .under("hitch angles not measured; v_i ≠ 0 and d_i ≠ 0; by induction: each step is shown for whatever the axle ahead does, and the tractors are `proposition`, `differential-drive-R2T` and `car-RT2`")
            .remark("The matrix of derivatives of (the tractor's velocities, φ̇_1, …, φ̇_N) by (its coefficients, e_1, …, e_N) is triangular by blocks. Fewer coefficients cannot do: φ̇_N is free whatever the rates ahead are.")
            .proof(
                "yaw rate and speed of the last axle by its own coefficient; rates of the axle ahead by it",
                &[
                    ("first_by_own", "-v_1/d_1"),
                    ("second_by_own", "-v_2/d_2"),
                    ("third_by_own", "-v_3/d_3"),
                    ("speed_by_own", "0"),
                    ("ahead_by_last", "0"),
                    ("speed_ahead_by_last", "0"),
                ],
                proving(by_own_coefficient()),
            )
            .proof(
                "determinants with one and two trailers behind a wheel, written out",
                &[
                    ("det_1", "-(r*theta')^2*(1 - e_rc)*(-v_1/d_1)"),
                    ("det_2", "-(r*theta')^2*(1 - e_rc)*(-v_1/d_1)*(-v_2/d_2)"),
                ],
                proving(train_determinants()),
            ),
        base("trailers-on-axle", "with hitches on the axles only the angles between bodies and the creeps of both axles enter", PLACE)
            .under("c_i = 0")
            .proof(
                "two trailers",
                &[
                    ("v_1", "v_l*(cos(phi - phi_1) - e_0*sin(phi - phi_1))"),
                    ("d_1*phi_1'", "v_l*((1 + e_tc_1*e_0)*sin(phi - phi_1) + (e_0 - e_tc_1)*cos(phi - phi_1))"),
                    ("v_2", "v_1*(cos(phi_1 - phi_2) - e_tc_1*sin(phi_1 - phi_2))"),
                    ("d_2*phi_2'", "v_1*((1 + e_tc_2*e_tc_1)*sin(phi_1 - phi_2) + (e_tc_1 - e_tc_2)*cos(phi_1 - phi_2))"),
                ],
                proving(on_axle(2)),
            ),
        base("trailers-in-courses", "in courses χ_i = θ_i + arctan e_i each creeping bar turns as an ideal one of length d_i·cos α_i that is drawn with V_(i−1)", PLACE)
            .under("c_i = 0, e_i = tan α_i")
            .remark("The speed passed on is V_(i−1)·cos(χ_(i−1) − θ_i)/cos α_i and not that of an ideal train: for several trailers the hitches move sideways by d_i·sin α_i as well.")
            .proof(
                "turning of the course, speed along it",
                &[
                    ("d_1*cos(alpha_1)*phi_1'", "V_0*sin(chi_0 - chi_1)"),
                    ("d_2*cos(alpha_2)*phi_2'", "V_1*sin(chi_1 - chi_2)"),
                    ("v_1", "V_0*cos(chi_0 - phi_1)"),
                    ("v_2", "V_1*cos(chi_1 - phi_2)"),
                ],
                proving(courses(2)),
            ),
        base("trailer-speeds", "the speed of a trailer follows from the axle ahead: v_i = v_(i−1)·cos β_i without creep, so v_N = v_l·Π cos β_i; the rolling of a wheel of its own enters nothing but that wheel's rate", PLACE)
            .under("c_i = 0, no traverse creep; any N, by one step after another")
            .proof(
                "one step, whatever the axle ahead does: from the first, the second and the third trailer",
                &[("v_1", "v_l*cos(phi - phi_1)"), ("v_2", "v_1*cos(phi_1 - phi_2)"), ("v_3", "v_2*cos(phi_2 - phi_3)")],
                |s, _| Outcome::all(s.each().map(|(i, step)| prove(&ideal_step(i + 1), &step))),
            )
            .proof(
                "product of cosines for three trailers",
                &[("v_3", "v_l*cos(phi - phi_1)*cos(phi_1 - phi_2)*cos(phi_2 - phi_3)")],
                |s, _| {
                    let ideal = ["e_0", "e_tc_1", "e_tc_2", "e_tc_3"].iter().fold(on_axle(3), |m, e| m.with_text(e, "0"));
                    prove(&ideal, s)
                },
            )
            .proof(
                "a trailer with a wheel that rolls and slips: derivatives of speed and yaw rate by that wheel's coefficient, and the rate of the wheel",
                &[("speed_by_e", "0"), ("yaw_by_e", "0"), ("theta_w'*r_w*(1 - e_w)", "v_1")],
                proving(rolling_trailer()),
            ),
        base("trailer-breaks", "a trailer across its hitch has no coefficient: e_i is undefined exactly where v_i = 0", PLACE)
            .under("at β = ±π/2 without creep ahead a trailer may only slide sideways, which type T does not express")
            .proof("quotient of its velocities", &[("vt_1/v_1", "v_1")], |s, _| {
                undefined_exactly_where(&DerivedFormulas::default(), s)
            })
            .sabotaged_by(&[&[("vt_1/v_1", "vt_1")], &[("vt_1/v_1", "v_1*vt_1")]])
            .on_domains()
            .proof(
                "forward speed at right angles",
                &[("v_1", "-e_0*v_l")],
                |s, _| {
                    // φ − φ_1 = π/2: the cosine of it is 0 and the sine 1.
                    prove(&on_axle(1).with_text("phi", "phi_1 + 2*atan(1)"), s)
                },
            ),
    ]
}
