//! Section 4: the single wheel, equations (22)–(25) and the Proposition.

use super::domain::defined_everywhere;
use super::single_body::determinant;
use crate::claims::simulated::{TURN, WHEEL, driven, model, undefined};
use crate::claims::{
    Claim, Correction, DerivedFormulas, Outcome, Sampling, Statement, Status, near, prove, value_said,
};
use crate::model::mechanism;
use crate::vehicles;
use proptest::prelude::*;
use std::sync::LazyLock;

const CHAPTER: &str = "04-single-wheel";
const BUILD: &str = "src/model/build.rs";

/// The wheel: its motion, its two rows without creep, the determinant of (v_l, v_t) by (e_rc, e_tc).
pub(crate) fn wheel() -> DerivedFormulas {
    let derived = DerivedFormulas::of("unicycle");
    let det = determinant(&derived, &["v_l", "v_t"], &["e_rc", "e_tc"]);
    let x_rate = derived.formula("x'").map(|e| e.derivative(&"phi".into())).unwrap_or_default();
    derived.with("det", det).with("x_by_phi", x_rate)
}

/// The rows of the wheel without creep, with the rates left free.
fn ideal_rows() -> DerivedFormulas {
    let rows = vehicles::named("unicycle").map(|v| mechanism(v, 0).ideal_rows()).unwrap_or_default();
    let names = ["rolling", "direction"];
    rows.iter().zip(names).fold(DerivedFormulas::default(), |m, (row, name)| m.with(name, row.expr()))
}

fn on_wheel(s: &Statement, _: &Sampling) -> Outcome {
    static DERIVED: LazyLock<DerivedFormulas> = LazyLock::new(wheel);
    prove(&DERIVED, s)
}

fn on_rows(s: &Statement, _: &Sampling) -> Outcome {
    static DERIVED: LazyLock<DerivedFormulas> = LazyLock::new(ideal_rows);
    prove(&DERIVED, s)
}

pub(crate) fn claims() -> Vec<Claim> {
    [equations(), proposition(), similarity()].concat()
}

fn equations() -> Vec<Claim> {
    let base = |id: &str, n: u8, says: &str| {
        Claim::new(id, Status::Proved, says)
            .at(&format!("section 4, ({n})"))
            .about(&[n])
            .chapter(CHAPTER)
            .code(&["src/vehicles/catalogue.toml", "src/mechanism/contact.rs", BUILD])
            .tests(&["tests/mechanism/motion.rs", "tests/motion/kinematics.rs"])
    };
    vec![
        base("eq-22", 22, "the wheel rolls: ẋ·cos φ + ẏ·sin φ − r·θ̇ = 0").under("no creep").proof(
            "the derived rolling row",
            &[("rolling", "x'*cos(phi) + y'*sin(phi) - r*theta'")],
            on_rows,
        ),
        base("eq-23", 23, "the wheel does not slide: ẋ·sin φ − ẏ·cos φ = 0").under("no creep").proof(
            "the derived direction row",
            &[("direction", "x'*sin(phi) - y'*cos(phi)")],
            on_rows,
        ),
        base("eq-24", 24, "forward velocity of the creeping wheel: v_l = r·ω_r·(1 − e_rc)").proof(
            "the rows solved for the motion",
            &[("v_l", "r*theta'*(1 - e_rc)")],
            on_wheel,
        ),
        base("eq-25", 25, "lateral velocity of the creeping wheel: v_t = r·ω_r·(1 − e_rc)·e_tc").proof(
            "the rows solved for the motion, and the velocity of the ground",
            &[
                ("v_t", "r*theta'*(1 - e_rc)*e_tc"),
                ("x'", "v_l*cos(phi) - v_t*sin(phi)"),
                ("y'", "v_l*sin(phi) + v_t*cos(phi)"),
            ],
            on_wheel,
        ),
        Claim::new("E10", Status::Corrected, "the motion follows from the sensed ω_r and the coefficients")
            .at("section 4, above (24); errata E10")
            .corrects(Correction::LacksHypothesis)
            .about(&[24, 25])
            .under("the heading or its rate is sensed too")
            .remark("(22) and (23) leave two freedoms, rolling and turning; the heading must be known as well.")
            .chapter(CHAPTER)
            .code(&[BUILD])
            .refutation(
                "the velocity does not ask for the heading",
                &[("x_by_phi", "0")],
                &[("x_by_phi", "-y'")],
                on_wheel,
            )
            .proof("how it does", &[("x_by_phi", "-y'")], on_wheel),
    ]
}

fn proposition() -> Vec<Claim> {
    let creeping = |s: &Statement, _: &Sampling| prove(&wheel().with_text("e_rc", "1"), s);
    let printed = [("e_rc", "1 - v_l/(r*omega)"), ("e_tc", "v_t/v_l")];
    let rows = [("rolling", "v_l - r*omega*(1 - e_rc)"), ("direction", "v_t - e_tc*v_l")];
    vec![
        Claim::new("proposition", Status::Corrected, "the pseudo-violated motion of the wheel is realised by type RT")
            .at("section 4, Proposition; corrected theorem (a)")
            .corrects(Correction::LacksHypothesis)
            .about(&[22, 23, 24, 25])
            .under("r·ω_r ≠ 0 and v_l ≠ 0; the yaw rate is measured")
            .remark(
                "For fixed r·ω ≠ 0 the map (e_rc, e_tc) → (v_l, v_t) is one-to-one and analytic from e_rc ≠ 1 onto \
                 v_l ≠ 0; its determinant vanishes on e_rc = 1. A locked wheel and a pure side slide have no \
                 coefficients; the rows with coefficients given are defined for them too.",
            )
            .chapter("04a-one-wheel")
            .code(&[BUILD, "src/mechanism/realisation.rs"])
            .tests(&["tests/mechanism/motion.rs", "tests/mechanism/growth.rs"])
            .refutation("every motion has coefficients", &printed, &rows, |s, _| defined_everywhere(s))
            .proof(
                "determinant, and the inverse on both sides",
                &[("det", "-(r*theta')^2*(1 - e_rc)"), ("1 - v_l/(r*theta')", "e_rc"), ("v_t/v_l", "e_tc")],
                on_wheel,
            )
            .proof("any twist (U, W) to coefficients and back to motion", &[("v_l", "U"), ("v_t", "W")], inverse)
            .sabotaged_by(&[&[("v_l", "W"), ("v_t", "W")], &[("v_l", "U"), ("v_t", "-W")]])
            .confirmation(
                "constant twists through the simulator: the pose is that of the screw motion",
                &printed,
                round_trip,
            ),
        Claim::new("E9", Status::Corrected, "(24) and (25) reach every velocity of the contact")
            .at("section 4, (24)–(25); errata E9")
            .corrects(Correction::LacksHypothesis)
            .about(&[24, 25])
            .remark(
                "A wheel that spins on the spot, e_rc = 1, is given v_t = 0 whatever e_tc; it may slide all the same.",
            )
            .chapter("04a-one-wheel")
            .code(&[BUILD])
            .refutation("any lateral velocity v at e_rc = 1", &[("v_t", "v")], &[("v_t", "0*v")], creeping)
            .proof("determinant −(r·ω)²·(1 − e_rc)", &[("det", "-(r*theta')^2*(1 - e_rc)")], on_wheel),
    ]
}

/// Any twist (U, W), put into (8) and (17), and the coefficients into the derived motion.
fn inverse(s: &Statement, _: &Sampling) -> Outcome {
    prove(&DerivedFormulas::of("unicycle").with_text("e_rc", "1 - U/(r*theta')").with_text("e_tc", "W/U"), s)
}

/// A constant twist realised by coefficients, simulated, against the pose of the screw motion.
fn round_trip(s: &Statement, sampling: &Sampling) -> Outcome {
    let twists = (0.1..1.0f64, 0.5..4.0f64, 0.2..3.0f64, -1.0..1.0f64, 0.2..2.0f64, 0.3..3.0f64);
    let show = |t: &(f64, f64, f64, f64, f64, f64)| {
        let names = ["r", "omega", "v_l", "v_t", "yaw_rate", "t"];
        names.iter().zip([t.0, t.1, t.2, t.3, t.4, t.5]).map(|(n, v)| (n.to_string(), v.to_string())).collect()
    };
    sampling.one_in(4).cases(twists, show, |&(r, omega, v_l, v_t, yaw, t)| {
        let at = |name: &str| match name {
            "r" => Some(r),
            "omega" => Some(omega),
            "v_l" => Some(v_l),
            "v_t" => Some(v_t),
            _ => None,
        };
        let (e_rc, e_tc) = (value_said(s, "e_rc", &at)?, value_said(s, "e_tc", &at)?);
        let creeps = [("rotation-creep", None, vec![e_rc]), ("traverse-creep", None, vec![e_tc])];
        let wheel = model("unicycle", &[("wheel_radius", r)], &[], &creeps).map_err(|e| undefined(&e))?;
        let inputs = [("wheel_rate", "c_0"), ("yaw_rate", "c_1")];
        let path = driven(&wheel, &inputs, &[omega, yaw], &[0.0; 3], &[0.0, t]).map_err(|e| undefined(&e))?;
        // (v_l + i·v_t)·(e^{iφ} − 1)/(i·φ̇)
        let (sin, cos) = (yaw * t).sin_cos();
        near("x", path[1][0], (v_l * sin - v_t * (1.0 - cos)) / yaw, 1e-9)?;
        near("y", path[1][1], (v_l * (1.0 - cos) + v_t * sin) / yaw, 1e-9)
    })
}

fn similarity() -> Vec<Claim> {
    let against_ideal = || wheel().with_text("X'", "r*theta'*cos(phi)").with_text("Y'", "r*theta'*sin(phi)");
    vec![
        Claim::new(
            "similarity",
            Status::Proved,
            "the creeping path is the ideal one turned and stretched: z = κ·z_i, κ = (1 − e_rc)·(1 + i·e_tc)",
        )
        .at("theory, Fig. 7 and the ideal limit")
        .about(&[24, 25])
        .under("constant e_rc and e_tc; any inputs")
        .chapter(CHAPTER)
        .code(&["src/motion/trajectory.rs"])
        .tests(&["tests/motion/kinematics.rs"])
        .proof(
            "velocities, X and Y those of the ideal wheel; κ is constant, so the same holds for the paths",
            &[("x'", "(1 - e_rc)*(X' - e_tc*Y')"), ("y'", "(1 - e_rc)*(e_tc*X' + Y')")],
            move |s, _| prove(&against_ideal(), s),
        )
        .confirmation(
            "end points of simulated runs under generated inputs",
            &[("x", "(1 - e_rc)*(X - e_tc*Y)"), ("y", "(1 - e_rc)*(e_tc*X + Y)")],
            simulated_similarity,
        ),
    ]
}

fn simulated_similarity(s: &Statement, sampling: &Sampling) -> Outcome {
    let cases = (-0.5..0.5f64, -0.5..0.5f64, prop::collection::vec(-1.0..1.0f64, 7));
    let show = |(e_rc, e_tc, c): &(f64, f64, Vec<f64>)| {
        let mut shown = vec![("e_rc".to_string(), e_rc.to_string()), ("e_tc".to_string(), e_tc.to_string())];
        shown.extend(c.iter().enumerate().map(|(i, v)| (format!("c_{i}"), v.to_string())));
        shown
    };
    sampling.one_in(4).cases(cases, show, |(e_rc, e_tc, c)| {
        let run = |e_rc: f64, e_tc: f64| {
            let creeps = [("rotation-creep", None, vec![e_rc]), ("traverse-creep", None, vec![e_tc])];
            let wheel = model("unicycle", &[("wheel_radius", 0.5)], &[], &creeps)?;
            driven(&wheel, &[("wheel_rate", WHEEL), ("yaw_rate", TURN)], c, &[0.0; 3], &[0.0, 2.0])
        };
        let ideal = run(0.0, 0.0).map_err(|e| undefined(&e))?;
        let crept = run(*e_rc, *e_tc).map_err(|e| undefined(&e))?;
        let at = |name: &str| match name {
            "X" => Some(ideal[1][0]),
            "Y" => Some(ideal[1][1]),
            "e_rc" => Some(*e_rc),
            "e_tc" => Some(*e_tc),
            _ => None,
        };
        near("x", crept[1][0], value_said(s, "x", &at)?, 1e-9)?;
        near("y", crept[1][1], value_said(s, "y", &at)?, 1e-9)
    })
}
