//! Section 3: the intrinsic form (20)–(21), the form without singularity, its derivatives and its group.

use super::blade::{formula, on_row, on_sleigh, row};
use super::domain::defined_everywhere;
use crate::claims::{Claim, Correction, DerivedFormulas, Status, prove};
use crate::formula::{Expr, Symbol};
use crate::mechanism::{Row, solve};

const CHAPTER: &str = "03-traverse-creep";
const REGULAR: &str = "03b-singularity-free";
const FORMS: &str = "src/mechanism/contact.rs";

pub(crate) fn claims() -> Vec<Claim> {
    [intrinsic(), regular(), group()].concat()
}

fn intrinsic() -> Vec<Claim> {
    let swapped = || {
        // (17) with the v_t of section 3: e·(ẋ cos φ + ẏ sin φ) = ẋ sin φ − ẏ cos φ, solved for ẋ with ẏ = 1.
        let mut row = Row::default();
        row.add("x'", &formula("e_tc*cos(phi) - sin(phi)"));
        row.add("y'", &formula("e_tc*sin(phi) + cos(phi)"));
        let solved = solve::together(&[row], &["x'".into()]).unwrap_or_default();
        let quotient = solved.first().map_or_else(|| Expr::int(0), |(_, e)| e / &Expr::sym("y'"));
        row_machine("sigma_3", quotient)
    };
    vec![
        Claim::new("eq-20", Status::Proved, "the ideal direction constraint is q̇₁ − σ(q₂)·q̇₃ = 0 with σ = q₂ = cot φ")
            .at("section 3, (20)")
            .about(&[20])
            .under("sin φ ≠ 0")
            .chapter(CHAPTER)
            .code(&[FORMS])
            .tests(&["tests/formula/creep.rs"])
            .proof(
                "σ without creep, and the row divided by sin φ",
                &[("sigma", "cot(phi)"), ("g/sin(phi)", "x' - cot(phi)*y'")],
                |s, _| {
                    let ideal = |e: &Expr| e.substitute(&|s| (s.as_str() == "e_tc").then(|| Expr::int(0)));
                    let derived = row();
                    let of = |name: &str| derived.formula(name).map_or_else(|| Expr::int(0), ideal);
                    prove(&DerivedFormulas::default().with("sigma", of("sigma")).with("g", of("g")), s)
                },
            ),
        Claim::new(
            "eq-21",
            Status::Proved,
            "the creeping direction constraint: σ = (cot φ − e)/(1 + e·cot φ) = cot(φ + arctan e)",
        )
        .at("section 3, (21); errata E2")
        .about(&[21])
        .under("sin φ ≠ 0 and sin φ + e·cos φ ≠ 0")
        .remark("(21) follows from (17) with the v_t of section 4; creep turns the course by arctan e.")
        .chapter(CHAPTER)
        .code(&[FORMS])
        .tests(&["tests/formula/creep.rs", "tests/mechanism/forms.rs"])
        .proof(
            "σ of the derived form, its closed form, and the row",
            &[
                ("sigma", "(cot(phi) - e_tc)/(1 + e_tc*cot(phi))"),
                ("sigma", "cot(phi + atan(e_tc))"),
                ("g/s", "x' - (cot(phi) - e_tc)/(1 + e_tc*cot(phi))*y'"),
            ],
            on_row,
        ),
        Claim::new("E2", Status::Corrected, "(21) follows \"from (17)\" as section 3 writes v_t")
            .at("section 3, (21); errata E2")
            .corrects(Correction::FalseAsPrinted)
            .about(&[17, 21])
            .remark("With the sign of section 3 one gets (cot φ + e)/(1 − e·cot φ); the error is in v_t, not in (21).")
            .chapter(CHAPTER)
            .code(&[FORMS])
            .refutation(
                "σ from the v_t of section 3",
                &[("sigma_3", "(cot(phi) - e_tc)/(1 + e_tc*cot(phi))")],
                &[("sigma_3", "(cot(phi) + e_tc)/(1 - e_tc*cot(phi))")],
                move |s, _| prove(&swapped(), s),
            )
            .proof("σ from the v_t of section 4", &[("sigma", "(cot(phi) - e_tc)/(1 + e_tc*cot(phi))")], on_row),
        Claim::new("E3", Status::Corrected, "(20) and (21) describe the constraint in every configuration")
            .at("section 3, (20)–(21); errata E3")
            .corrects(Correction::LacksHypothesis)
            .about(&[20, 21])
            .remark(
                "cot φ is no coordinate at φ = k·π, where the paper's own simulation starts, and σ is undefined where \
                 the course is along x. The pair (s, p) is defined and does not vanish, s² + p² = 1 + e².",
            )
            .chapter(REGULAR)
            .code(&[FORMS])
            .tests(&["tests/mechanism/forms.rs", "tests/formula/creep.rs"])
            .refutation(
                "σ has a value everywhere",
                &[("sigma", "(cot(phi) - e_tc)/(1 + e_tc*cot(phi))")],
                &[("g", "(sin(phi) + e_tc*cos(phi))*x' - (cos(phi) - e_tc*sin(phi))*y'")],
                |s, _| defined_everywhere(s),
            )
            .proof(
                "the pair is regular, and the row is the same where (21) is defined",
                &[("s^2 + p^2", "1 + e_tc^2"), ("g", "s*(x' - sigma*y')")],
                on_row,
            ),
    ]
}

fn row_machine(name: &str, e: Expr) -> DerivedFormulas {
    DerivedFormulas::default().with(name, e)
}

fn regular() -> Vec<Claim> {
    let by_alpha = || {
        let e = formula("tan(alpha)");
        let turned = |s: &Symbol| (s.as_str() == "e_tc").then(|| e.clone());
        let g = row().formula("g").map_or_else(|| Expr::int(0), |g| g.substitute(&turned));
        DerivedFormulas::default().with("g", g)
    };
    vec![
        Claim::new(
            "singularity-free",
            Status::Proved,
            "(sin φ + e·cos φ)·ẋ − (cos φ − e·sin φ)·ẏ = e·v_l − v_t, regular everywhere",
        )
        .at("theory, singularity-free form of (21)")
        .about(&[21])
        .chapter(REGULAR)
        .code(&[FORMS])
        .tests(&["tests/mechanism/forms.rs"])
        .proof(
            "the row, its length, and its angle form with e = tan α",
            &[("g", "(sin(phi) + e_tc*cos(phi))*x' - (cos(phi) - e_tc*sin(phi))*y'"), ("s^2 + p^2", "1 + e_tc^2")],
            on_row,
        )
        .proof(
            "angle form: the direction turned by α = arctan e",
            &[("g*cos(alpha)", "x'*sin(phi + alpha) - y'*cos(phi + alpha)")],
            move |s, _| prove(&by_alpha(), s),
        ),
        Claim::new("jacobian-T", Status::Proved, "derivatives of the type T row: ∂g/∂φ = v_l + e·v_t, ∂g/∂e = v_l")
            .at("theory, Jacobians of type T")
            .about(&[21])
            .chapter(REGULAR)
            .code(&["src/formula/derive.rs", FORMS])
            .tests(&["tests/formula/derivatives.rs"])
            .proof("in the velocities of the body", &[("g_phi", "v_l + e_tc*v_t"), ("g_e", "v_l")], on_sleigh)
            .proof(
                "of the pair (s, p)",
                &[
                    ("s_phi", "cos(phi) - e_tc*sin(phi)"),
                    ("p_phi", "-sin(phi) - e_tc*cos(phi)"),
                    ("s_e", "cos(phi)"),
                    ("p_e", "-sin(phi)"),
                ],
                on_row,
            ),
        Claim::new(
            "jacobian-sigma",
            Status::Proved,
            "derivatives of σ: ∂σ/∂φ = −(1 + e²)/(sin φ + e·cos φ)², ∂σ/∂e = −1/(sin φ + e·cos φ)²",
        )
        .at("theory, derivatives of (21)")
        .about(&[21])
        .under("sin φ + e·cos φ ≠ 0")
        .chapter(REGULAR)
        .code(&["src/formula/derive.rs"])
        .tests(&["tests/formula/derivatives.rs"])
        .proof(
            "in φ",
            &[
                ("sigma_phi", "-(1 + e_tc^2)/(sin(phi) + e_tc*cos(phi))^2"),
                ("sigma_e", "-1/(sin(phi) + e_tc*cos(phi))^2"),
            ],
            on_sleigh,
        )
        .proof(
            "in q₂ = cot φ",
            &[("by_q", "(1 + e^2)/(1 + e*q)^2"), ("by_e", "-(1 + q^2)/(1 + e*q)^2")],
            |s, _| {
                let sigma = formula("(q - e)/(1 + e*q)");
                let by = |name: &str| sigma.derivative(&name.into());
                prove(&DerivedFormulas::default().with("by_q", by("q")).with("by_e", by("e")), s)
            },
        ),
    ]
}

fn group() -> Vec<Claim> {
    let twice = || {
        DerivedFormulas::default()
            .with_text("once", "(q - e_1)/(1 + e_1*q)")
            .with_text("twice", "(once - e_2)/(1 + e_2*once)")
            .with_text("inverse", "(once + e_1)/(1 - e_1*once)")
    };
    vec![
        Claim::new(
            "group-law",
            Status::Proved,
            "creep upon creep is creep: σ(σ(q, e₁), e₂) = σ(q, (e₁ + e₂)/(1 − e₁·e₂))",
        )
        .at("theory, group law of σ")
        .about(&[21])
        .under("1 − e₁·e₂ ≠ 0")
        .chapter(REGULAR)
        .code(&[FORMS])
        .tests(&["tests/formula/creep.rs"])
        .proof(
            "composition, inverse, and addition of angles",
            &[
                ("twice", "(q - (e_1 + e_2)/(1 - e_1*e_2))/(1 + q*(e_1 + e_2)/(1 - e_1*e_2))"),
                ("inverse", "q"),
                ("tan(atan(e_1) + atan(e_2))", "(e_1 + e_2)/(1 - e_1*e_2)"),
            ],
            move |s, _| prove(&twice(), s),
        ),
    ]
}
