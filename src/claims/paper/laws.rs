//! Section 1 and (18): the equations of the laws of contact.

use crate::claims::{Claim, Correction, DerivedFormulas, Domain, Sampling, Statement, Status, at_points, proving};
use crate::dynamics::laws;
use crate::formula::{Expr, Symbol};

const CHAPTER: &str = "10-viscous";
const LAWS: &str = "src/model/forces/law.rs";
const TESTS: &str = "tests/dynamics/laws.rs";

pub(crate) fn claims() -> Vec<Claim> {
    vec![growth(), elastic(), two_laws()]
}

/// The force of a law of the program, or the rate of its state, with formulas for its names.
pub(super) fn law(id: &str, part: fn(&crate::dynamics::Law) -> Option<Expr>, names: &[(&str, &str)]) -> Expr {
    let found = laws().iter().find(|l| l.id == id).and_then(part).unwrap_or_default();
    found.substitute(&|s: &Symbol| {
        let named = names.iter().find(|(name, _)| *name == s.as_str());
        named.and_then(|(_, formula)| Expr::parse(formula).ok())
    })
}

fn force(id: &str, names: &[(&str, &str)]) -> Expr {
    law(id, |l| Some(l.force.clone()), names)
}

fn growth() -> Claim {
    let names = [("slip", "0"), ("speed", "v"), ("deflection", "x_c"), ("relaxation_length", "1/k_g")];
    let rate = law("elastic", |l| l.rate.clone(), &names);
    let derived = DerivedFormulas::default().with("x_c'", rate).with_text("printed", "-k_g*v*x_c");
    let points: &[(&str, Domain)] = &[("k_g", Domain::Positive), ("v", Domain::Positive), ("x_c", Domain::Nonzero)];
    let check = move |s: &Statement, sampling: &Sampling| at_points(&derived, s, points, sampling);
    Claim::new("E13", Status::Corrected, "k_g of (1) is a growth parameter")
        .at("section 1, (1); errata E13")
        .corrects(Correction::ContestedReading)
        .about(&[1])
        .under("v > 0, k_g > 0")
        .remark(
            "ẋ_c = −k_g·v·x_c with k_g > 0 lets every deflection fade: by e over each length 1/k_g. k_g is a decay for \
             each metre, 1/k_g the relaxation length of a tyre.",
        )
        .chapter(CHAPTER)
        .code(&[LAWS])
        .tests(&[TESTS])
        .refutation("a deflection grows", &[("sign(x_c'*x_c)", "1")], &[("sign(x_c'*x_c)", "-1")], check.clone())
        .sample(
            "the elastic law without slip is (1), and a deflection loses its share k_g for each metre",
            &[("x_c'", "-k_g*v*x_c"), ("printed", "x_c'"), ("x_c'/v", "-k_g*x_c")],
            check,
        )
}

fn elastic() -> Claim {
    let printed = || {
        DerivedFormulas::default()
            .with_text("f", "-k_r*theta_c")
            .with_text("theta_c", "x_c'/v")
            .with_text("f_twice", "-k_r*x_c'/(2*v)")
    };
    let program = [("stiffness", "k_r"), ("relaxation_length", "1/k_g"), ("deflection", "x_c")];
    let with_growth = printed().with_text("x_c'", "-k_g*v*x_c").with("f_program", force("elastic", &program));
    Claim::new("E14", Status::Corrected, "(2) explains a viscous creep, f proportional to the traverse velocity")
        .at("section 1, (1)–(2); errata E14")
        .corrects(Correction::ContestedReading)
        .about(&[1, 2])
        .under("small creep angles, θ_c = ẋ_c/v")
        .remark(
            "With (1) the force of (2) is k_r·k_g·x_c: a spring, in which no speed is left. At the same ẋ_c and twice \
             the speed v the force of (2) is half as large, that of a viscous law the same.",
        )
        .chapter(CHAPTER)
        .code(&[LAWS])
        .tests(&[TESTS])
        .refutation(
            "the same traverse velocity gives the same force at twice the speed",
            &[("f_twice", "f")],
            &[("f_twice", "f/2")],
            proving(printed()),
        )
        .proof(
            "(1) put into (2), and the program's elastic law",
            &[("f", "k_r*k_g*x_c"), ("f_program", "k_r*k_g*x_c")],
            proving(with_growth),
        )
}

fn two_laws() -> Claim {
    let at = |speed: &'static str| [("stiffness", "k_r"), ("slip", "v_t"), ("speed", speed)];
    let viscous = [("coefficient", "b_T"), ("slip", "v_t")];
    let derived = DerivedFormulas::default()
        .with("rocard", force("rocard", &at("v")))
        .with("rocard_twice", force("rocard", &at("2*v")))
        .with("viscous", force("viscous", &viscous))
        .with_text("b_T", "k_r/v");
    let points: &[(&str, Domain)] = &[("k_r", Domain::Positive), ("v", Domain::Positive), ("v_t", Domain::Nonzero)];
    let check = move |s: &Statement, sampling: &Sampling| at_points(&derived, s, points, sampling);
    Claim::new("E15", Status::Corrected, "Rocard's law (2) and the viscous law (18) describe the same friction")
        .at("(2) and (18); errata E15")
        .corrects(Correction::ContestedReading)
        .about(&[2, 18, 19])
        .under("v = v_l > 0")
        .remark(
            "They agree at one speed, for b_T = k_r/v. Rocard's law gives e_tc = −f/k_r, the viscous one e_tc = \
             −f/(b_T·v_l): twice as fast, the same force makes half the creep of the one and as much of the other. The \
             law has to be chosen.",
        )
        .chapter(CHAPTER)
        .code(&[LAWS])
        .tests(&[TESTS])
        .refutation(
            "with b_T fitted at one speed they agree at twice that speed",
            &[("rocard_twice", "viscous")],
            &[("rocard_twice", "viscous/2")],
            check.clone(),
        )
        .sample("b_T for which they agree", &[("rocard", "viscous"), ("rocard/(-v_t)", "k_r/v")], check)
}
