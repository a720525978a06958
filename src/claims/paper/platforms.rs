//! Section 4 beyond its vehicles: both axles steered, tracks, Ackermann's angles, wheels with rollers.

use super::growth_examples::Found;
use super::single_body::determinant;
use crate::claims::{Claim, DerivedFormulas, Status, proving};

const BODY: &str = "05b-corrected-single-body";
const CATALOGUE: &str = "src/vehicles/catalogue.toml";
const TESTS: [&str; 2] = ["tests/mechanism/vehicles.rs", "tests/describe/structure.rs"];

pub(crate) fn claims() -> Vec<Claim> {
    vec![growth(), both_axles(), tracks(), ackermann(), mecanum()]
}

fn base(id: &str, says: &str, at: &str) -> Claim {
    Claim::new(id, Status::Proved, says).at(at).chapter(BODY).tests(&TESTS)
}

fn growth() -> Claim {
    base(
        "growth-platforms",
        "growth vectors and signatures of vehicles that the paper does not have",
        "corrected theorem (b), table",
    )
    .under("one general configuration each; the wheels of omni and mecanum each with its own coefficient, measured")
    .chapter("05a-holonomy")
    .code(&["src/mechanism/growth_vector.rs", "src/mechanism/realisation.rs", "src/claims/paper/descriptions.toml"])
    .proof(
        "brackets, integrals and ranks, exactly; a vector (3, 5, 6) is written 356",
        &[
            ("four_wheel_steering.growth", "356"),
            ("four_wheel_steering.holonomic", "0"),
            ("four_wheel_steering.rolling", "1"),
            ("four_wheel_steering.directed", "2"),
            ("tracked.growth", "234"),
            ("tracked.holonomic", "1"),
            ("tracked.rolling", "2"),
            ("tracked.directed", "1"),
            ("omni.growth", "35"),
            ("omni.holonomic", "1"),
            ("omni.nonholonomic", "2"),
            ("omni.rolling", "3"),
            ("omni.directed", "0"),
            ("mecanum_wheels.growth", "35"),
            ("mecanum_wheels.holonomic", "2"),
            ("mecanum_wheels.nonholonomic", "2"),
            ("mecanum_wheels.rolling", "3"),
            ("mecanum_wheels.directed", "0"),
            ("mecanum_wheels.sets", "4"),
        ],
        Found::default().checking(),
    )
}

fn both_axles() -> Claim {
    let derived = DerivedFormulas::of("four-wheel-steering");
    let det = determinant(&derived, &["v_l", "v_t", "phi'"], &["e_rc", "e_tc", "e_f"]);
    base(
        "four-wheel-steering-RT2",
        "a car with both axles steered and one drive angle is realised by RT²",
        "corrected theorem (b)3",
    )
    .under("ω ≠ 0, e_r ≠ 1, cos δ ≠ 0, 1 − e_f·tan δ ≠ 0, cos δ_r ≠ e_t·sin δ_r")
    .code(&["src/model/body.rs", CATALOGUE])
    .proof(
        "motion, and determinant of (v_l, v_t, φ̇) by (e_r, e_t, e_f)",
        &[
            ("v_l", "r*theta'*(1 - e_rc)*(cos(delta_r) - e_tc*sin(delta_r))"),
            ("v_t", "r*theta'*(1 - e_rc)*(sin(delta_r) + e_tc*cos(delta_r))"),
            ("phi'", "(v_l*(tan(delta) + e_f)/(1 - e_f*tan(delta)) - v_t)/L"),
            (
                "det",
                "-r^3*theta'^3*(1 - e_rc)^2*(cos(delta_r) - e_tc*sin(delta_r))/(L*cos(delta)^2*(1 - e_f*tan(delta))^2)",
            ),
        ],
        proving(derived.with("det", det)),
    )
}

fn tracks() -> Claim {
    let derived = DerivedFormulas::of("tracked").with_text("r_1", "r").with_text("r_2", "r");
    let det = determinant(&derived, &["v_l", "v_t", "phi'"], &["e_rc_1", "e_rc_2", "e_tc"]);
    base("tracked-R2T", "two tracks with instantaneous centres of rotation are realised by R²T", "corrected theorem (b)2")
        .under("θ̇₁, θ̇₂ ≠ 0 and v_l ≠ 0; track 1 is the right one")
        .remark(
            "The kinematics of Martínez, Mandow and others (2005): the tracks roll at b + a/2 and b − a/2 to the left, and the \
             vehicle's own centre, where it has a direction, lies h ahead.",
        )
        .code(&["src/model/body.rs", CATALOGUE])
        .proof(
            "motion, and determinant of (v_l, v_t, φ̇) by (e₁, e₂, e_t)",
            &[
                ("v_l", "r*((b + a/2)*theta_1'*(1 - e_rc_1) - (b - a/2)*theta_2'*(1 - e_rc_2))/a"),
                ("phi'", "r*(theta_1'*(1 - e_rc_1) - theta_2'*(1 - e_rc_2))/a"),
                ("v_t", "e_tc*v_l - h*phi'"),
                ("det", "r^2*theta_1'*theta_2'*v_l/a"),
            ],
            proving(derived.with("det", det)),
        )
}

fn ackermann() -> Claim {
    let derived = DerivedFormulas::of("four-wheel-car");
    let ideal = derived.clone().with_text("e_f", "0").with_text("e_tc", "0");
    base(
        "ackermann-angles",
        "the two front wheels of a car have angles of their own, and creep only where their axle does",
        "errata E19",
    )
    .under("cos δ ≠ 0, the centre of turning outside the track; w the full track")
    .code(&["src/model/body.rs", "src/model/constraints.rs", CATALOGUE])
    .proof(
        "cotangents differ by the track over the wheelbase; the rear wheels turn with the yaw rate",
        &[
            ("cot(delta_fr) - cot(delta)", "w/(2*L)"),
            ("cot(delta) - cot(delta_fl)", "w/(2*L)"),
            ("theta_1'", "theta' + w*phi'/(2*r*(1 - e_rc))"),
            ("theta_2'", "theta' - w*phi'/(2*r*(1 - e_rc))"),
        ],
        proving(derived),
    )
    .proof(
        "coefficients of the front wheels where the axles do not creep",
        &[("e_fr", "0"), ("e_fl", "0")],
        proving(ideal),
    )
}

fn mecanum() -> Claim {
    let wheel = |sign: [i32; 4]| {
        let names = ["front_left", "front_right", "rear_left", "rear_right"];
        let terms = sign.iter().zip(names).map(|(s, n)| format!("({s})*wheel_rate_{n}"));
        terms.collect::<Vec<_>>().join(" + ")
    };
    let [all, across, about] = [[1, 1, 1, 1], [-1, 1, 1, -1], [-1, 1, -1, 1]].map(wheel);
    let (ahead, sideways) = (format!("r*(1 - e_rc)*({all})/4"), format!("r*(1 - e_rc)*({across})/4"));
    let yaw = format!("r*(1 - e_rc)*({about})/(2*(a + b))");
    base("mecanum-least-squares", "four wheels with rollers at 45° move the body by least squares", "corrected theorem (b)")
        .under("rollers at ±45° in the usual order; one coefficient for the four wheels; a the track, b the distance of the axles")
        .remark(
            "A Swedish wheel rolls along the axis of its roller alone (Campion, Bastin and d'Andréa-Novel 1996; Lynch and Park \
             2017, chapter 13): v + w·tan γ = r(1 − e)·θ̇. Four rows for three velocities: rates that do not fit together skid \
             against each other, and the nearest ones that do are the pseudoinverse.",
        )
        .code(&["src/mechanism/contact.rs", CATALOGUE])
        .proof(
            "the derived motion is the pseudoinverse of the four rows",
            &[("v_l", ahead.as_str()), ("v_t", sideways.as_str()), ("phi'", yaw.as_str())],
            proving(DerivedFormulas::of("mecanum")),
        )
}
