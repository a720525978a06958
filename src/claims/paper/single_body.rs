//! Section 4: vehicles with a single body, equations (26)–(28), what the first theorem says of them.

use crate::claims::{Claim, Correction, DerivedFormulas, Outcome, Sampling, Statement, Status, prove, proving};
use crate::formula::{Expr, Symbol};
use crate::mechanism::{Heading, Velocity, integral_proof};
use crate::model::mechanism;
use crate::vehicles;
use std::sync::LazyLock;

const CHAPTER: &str = "05-single-body";
const BUILD: &str = "src/model/build.rs";
const CONSTRAINTS: &str = "src/model/constraints.rs";

/// The determinant of velocities by as many coefficients.
pub(super) fn determinant(derived: &DerivedFormulas, velocities: &[&str], coefficients: &[&str]) -> Expr {
    let by_all = |velocity: &&str| {
        let velocity = derived.written_out(velocity);
        coefficients.iter().map(|e| velocity.derivative(&Symbol::from(*e))).collect()
    };
    let matrix: Vec<Vec<Expr>> = velocities.iter().map(by_all).collect();
    integral_proof::determinant(&matrix)
}

/// Two driven wheels, right 1 and left 2, with the velocities of their contacts on the ground.
pub(crate) fn two_wheels() -> DerivedFormulas {
    let derived = DerivedFormulas::of("differential-drive")
        .with_text("r_1", "r")
        .with_text("r_2", "r")
        .with_text("v_A1", "-r*theta_1'*e_rc_1")
        .with_text("v_A2", "-r*theta_2'*e_rc_2")
        .with_text("radius", "v_l/phi'");
    let det = determinant(&derived, &["v_l", "v_t", "phi'"], &["e_rc_1", "e_rc_2", "e_tc"]);
    derived.with("det", det)
}

fn on_two_wheels(s: &Statement, _: &Sampling) -> Outcome {
    static DERIVED: LazyLock<DerivedFormulas> = LazyLock::new(two_wheels);
    prove(&DERIVED, s)
}

/// Half the sum and the difference of the two rolling rows, and the direction row, without creep.
fn two_wheel_rows() -> DerivedFormulas {
    let Some(vehicle) = vehicles::named("differential-drive") else { return DerivedFormulas::default() };
    let one_radius = |s: &Symbol| matches!(s.as_str(), "r_1" | "r_2").then(|| Expr::sym("r"));
    let rows: Vec<Expr> =
        mechanism(vehicle, 0).ideal_rows().iter().map(|row| row.expr().substitute(&one_radius)).collect();
    let [right, left, direction] = rows.as_slice() else { return DerivedFormulas::default() };
    DerivedFormulas::default()
        .with("mean", &(right + left) / &Expr::int(2))
        .with("difference", left - right)
        .with("direction", direction.clone())
}

fn on_rows(s: &Statement, _: &Sampling) -> Outcome {
    static DERIVED: LazyLock<DerivedFormulas> = LazyLock::new(two_wheel_rows);
    prove(&DERIVED, s)
}

/// Rear driven and front steered.
fn car() -> DerivedFormulas {
    let derived = DerivedFormulas::of("car");
    let det = determinant(&derived, &["v_l", "v_t", "phi'"], &["e_rc", "e_tc", "e_f"]);
    let yaw = derived.written_out("phi'");
    let ideal = |e: Expr| e.substitute(&|s| matches!(s.as_str(), "e_rc" | "e_tc" | "e_f").then(Expr::default));
    let by = |e: &str| ideal(yaw.derivative(&e.into()));
    derived.with("det", det).with("yaw_by_f", by("e_f")).with("yaw_by_r", by("e_tc"))
}

pub(crate) fn claims() -> Vec<Claim> {
    [equations(), slips(), corrected_theorem(), reference_point()].concat()
}

fn equations() -> Vec<Claim> {
    let base = |id: &str, n: u8, says: &str| {
        Claim::new(id, Status::Proved, says)
            .at(&format!("section 4, ({n})"))
            .about(&[n])
            .under("no creep; wheel 1 is the right one, a the full track, equal radii")
            .chapter(CHAPTER)
            .code(&[CONSTRAINTS, "src/vehicles/catalogue.toml"])
            .tests(&["tests/mechanism/motion.rs", "tests/mechanism/growth.rs"])
    };
    vec![
        base("eq-26", 26, "the two-wheeler moves with the mean of its wheels: ẋ·cos φ + ẏ·sin φ − r·(θ̇₁ + θ̇₂)/2 = 0")
            .proof(
                "half the sum of the derived rolling rows",
                &[("mean", "x'*cos(phi) + y'*sin(phi) - r*(theta_1' + theta_2')/2")],
                on_rows,
            ),
        base("eq-27", 27, "the two-wheeler does not slide: ẋ·sin φ − ẏ·cos φ = 0").proof(
            "the derived direction row of the axle",
            &[("direction", "x'*sin(phi) - y'*cos(phi)")],
            on_rows,
        ),
        base(
            "eq-28",
            28,
            "the two-wheeler turns with the difference of its wheels: r·(θ₁ − θ₂) − a·φ = 0, an integral",
        )
        .proof(
            "the difference of the derived rolling rows is its rate",
            &[("difference", "r*(theta_1' - theta_2') - a*phi'")],
            on_rows,
        ),
    ]
}

fn slips() -> Vec<Claim> {
    let equal = |s: &Statement, _: &Sampling| prove(&two_wheels().with_text("e_rc_1", "e").with_text("e_rc_2", "e"), s);
    let equal_slip = |s: &Statement, _: &Sampling| {
        let derived = two_wheels()
            .with_text("e_rc_1", "e*(theta_1' + theta_2')/(2*theta_1')")
            .with_text("e_rc_2", "e*(theta_1' + theta_2')/(2*theta_2')");
        prove(&derived, s)
    };
    vec![
        Claim::new("E16", Status::Corrected, "(28) stays exact while (26) creeps with e_rc")
            .at("section 4, below (28); errata E16")
            .corrects(Correction::FalseAsPrinted)
            .part_of("theorem-single-body")
            .about(&[26, 28])
            .remark(
                "With equal coefficients the yaw rate creeps too, by 1 − e. (28) stays exact when the slip *velocities* \
                 of the contacts are equal; then e_i = e·(θ̇₁ + θ̇₂)/(2·θ̇_i).",
            )
            .chapter(CHAPTER)
            .code(&[BUILD])
            .tests(&["tests/motion/kinematics.rs"])
            .refutation(
                "equal coefficients on both wheels",
                &[("a*phi'", "r*(theta_1' - theta_2')")],
                &[("a*phi'", "r*(1 - e)*(theta_1' - theta_2')")],
                equal,
            )
            .proof("equal coefficients", &[("a*phi'", "r*(1 - e)*(theta_1' - theta_2')")], equal)
            .proof(
                "equal slip velocities: (28) and (26) with e",
                &[("a*phi'", "r*(theta_1' - theta_2')"), ("v_l", "r*(1 - e)*(theta_1' + theta_2')/2")],
                equal_slip,
            )
            .proof(
                "(28) is off by exactly the difference of the slip velocities",
                &[("a*phi' - r*(theta_1' - theta_2')", "v_A1 - v_A2")],
                on_two_wheels,
            ),
        Claim::new("E17", Status::Corrected, "a two-wheeler with unequal creep turns as (28) says")
            .at("section 4, first theorem; errata E17")
            .corrects(Correction::FalseAsPrinted)
            .part_of("theorem-single-body")
            .about(&[28])
            .remark(
                "The counterexample in six numbers. Others, θ̇₁ = θ̇₂ = 4 with e = (0.02, 0.05), r = 1/2, a = 1, \
                 give a yaw rate of 3/50 and a circle of radius 193/6 where (28) says straight ahead.",
            )
            .chapter(CHAPTER)
            .code(&[BUILD])
            .refutation(
                "yaw rate from (28)",
                &[("phi'", "r*(theta_1' - theta_2')/a")],
                &[("phi'", "r*(theta_1'*(1 - e_rc_1) - theta_2'*(1 - e_rc_2))/a")],
                on_two_wheels,
            )
            .proof(
                "yaw rate with the creep of each wheel",
                &[("phi'", "r*(theta_1'*(1 - e_rc_1) - theta_2'*(1 - e_rc_2))/a")],
                on_two_wheels,
            )
            .proof("the numbers of the remark", &[("phi'", "3/50"), ("radius", "193/6")], |s, _| {
                let numbers = [("r", "1/2"), ("a", "1"), ("theta_1'", "4"), ("theta_2'", "4"), ("e_rc_1", "1/50"), ("e_rc_2", "1/20")];
                prove(&numbers.iter().fold(two_wheels(), |m, (name, v)| m.with_text(name, v)), s)
            }),
    ]
}

fn corrected_theorem() -> Vec<Claim> {
    vec![
        Claim::new(
            "differential-drive-R2T",
            Status::Proved,
            "a differential drive with creeping wheels is realised by R²T",
        )
        .at("corrected theorem (b)2")
        .about(&[26, 27, 28])
        .under("θ̇₁, θ̇₂ ≠ 0 and v_l ≠ 0")
        .chapter("05b-corrected-single-body")
        .code(&[BUILD, "src/mechanism/realisation.rs"])
        .tests(&["tests/mechanism/growth.rs"])
        .proof(
            "motion, determinant of (v_l, v_t, φ̇) by (e₁, e₂, e_t), and the inverse",
            &[
                ("v_l", "r*(theta_1'*(1 - e_rc_1) + theta_2'*(1 - e_rc_2))/2"),
                ("v_t", "e_tc*v_l"),
                ("det", "r^3*theta_1'*theta_2'*(theta_1' + theta_2' - e_rc_1*theta_1' - e_rc_2*theta_2')/(2*a)"),
                ("1 - (v_l + a*phi'/2)/(r*theta_1')", "e_rc_1"),
                ("1 - (v_l - a*phi'/2)/(r*theta_2')", "e_rc_2"),
            ],
            on_two_wheels,
        ),
        Claim::new("car-RT2", Status::Proved, "a front-steered car with one drive angle is realised by RT²")
            .at("corrected theorem (b)3")
            .under("ω ≠ 0, e_r ≠ 1, cos δ ≠ 0, 1 − e_f·tan δ ≠ 0")
            .chapter("05b-corrected-single-body")
            .code(&[BUILD, "src/mechanism/realisation.rs"])
            .tests(&["tests/mechanism/growth.rs", "tests/mechanism/motion.rs"])
            .proof(
                "yaw rate, determinant of (v_l, v_t, φ̇) by (e_r, e_t, e_f)",
                &[
                    ("v_l", "r*theta'*(1 - e_rc)"),
                    ("phi'", "v_l/L*((tan(delta) + e_f)/(1 - e_f*tan(delta)) - e_tc)"),
                    ("det", "-r^3*theta'^3*(1 - e_rc)^2/(L*cos(delta)^2*(1 - e_f*tan(delta))^2)"),
                ],
                proving(car()),
            ),
        Claim::new(
            "understeer",
            Status::Proved,
            "front creep steers less, rear creep more: φ̇ ≈ (v_l/L)·(tan δ + e_f·sec²δ − e_r)",
        )
        .at("corrected theorem (b)3")
        .under("first order in the creeps; a left turn has e < 0, so the car understeers iff |e_f|·sec²δ > |e_r|")
        .chapter("05b-corrected-single-body")
        .code(&[BUILD, "src/effects/catalogue.toml"])
        .tests(&["tests/mechanism/effects.rs"])
        .proof(
            "derivatives of the yaw rate at the ideal car",
            &[("yaw_by_f", "r*theta'/(L*cos(delta)^2)"), ("yaw_by_r", "-r*theta'/L")],
            proving(car()),
        ),
    ]
}

fn reference_point() -> Vec<Claim> {
    // The velocity of a point h ahead and b to the left of the reference point.
    let point = || {
        let body = Heading::along("phi");
        let there = Velocity::in_body("v_l", "v_t", &body)
            .at_offset(&body, &Expr::sym("h"))
            .at_offset(&body.left(), &Expr::sym("b"));
        let (forward, left) = (there.along(&body).expr(), there.along(&body.left()).expr());
        DerivedFormulas::default().with_text("v_t", "e*v_l").with("e_there", &left / &forward).with("left", left)
    };
    vec![
        Claim::new("E18", Status::Corrected, "a body has one e_tc, and the wheels of an axle share it")
            .at("section 4, first theorem; errata E18")
            .corrects(Correction::ContestedReading)
            .part_of("theorem-single-body")
            .about(&[25])
            .under("v_l ≠ 0, and v_l − b·φ̇ ≠ 0 for a wheel b to the left")
            .remark(
                "The coefficient belongs to a reference point: h ahead it is e + h·φ̇/v_l. The wheels of an axle share \
                 the lateral velocity, and their coefficients differ: with e = 1/20, v_l = 1 and a·φ̇/2 = 1/3 the right \
                 wheel has 3/80 and the left one 3/40.",
            )
            .chapter("05b-corrected-single-body")
            .code(&["src/mechanism/velocity.rs"])
            .tests(&["tests/mechanism/forms.rs"])
            .refutation(
                "the same coefficient everywhere on the body",
                &[("e_there", "e")],
                &[("e_there", "(e*v_l + h*phi')/(v_l - b*phi')")],
                move |s, _| prove(&point(), s),
            )
            .proof(
                "at h ahead and b to the left; the lateral velocity does not depend on b",
                &[("e_there", "(e*v_l + h*phi')/(v_l - b*phi')"), ("left", "e*v_l + h*phi'")],
                move |s, _| prove(&point(), s),
            )
            .proof("the numbers of the remark", &[("right", "3/80"), ("left_wheel", "3/40")], move |s, _| {
                let at = |b: &str| {
                    let numbers = [("e", "1/20"), ("v_l", "1"), ("phi'", "1/3"), ("h", "0"), ("b", b)];
                    numbers.iter().fold(point(), |m, (name, v)| m.with_text(name, v)).written_out("e_there")
                };
                prove(&DerivedFormulas::default().with("right", at("-1")).with("left_wheel", at("1")), s)
            }),
    ]
}
