//! Section 3: traverse creep of a sleigh, equations (14)–(21), and the form without singularity.

use super::domain::{defined_everywhere, undefined_exactly_where};
use super::finite;
use crate::claims::{Claim, Domain, Machine, Outcome, Sampling, Statement, Status, at_points, prove};
use crate::formula::{Expr, Symbol};
use crate::mechanism::{Direction, Form, Row, solve};
use crate::model::mechanism;
use crate::vehicles;

const CHAPTER: &str = "03-traverse-creep";
const REGULAR: &str = "03b-singularity-free";
const FORMS: &str = "src/mechanism/constraint.rs";

/// The sleigh's one constraint, type T.
fn direction() -> Option<Direction> {
    let sleigh = mechanism(vehicles::named("sleigh")?, 0);
    sleigh.constraints.into_iter().find_map(|c| match c.form {
        Form::T(t) => Some(t),
        Form::R(_) => None,
    })
}

fn formula(text: &str) -> Expr {
    Expr::parse(text).unwrap_or_else(|_| Expr::int(0))
}

/// Velocities of the sleigh in the world, its row g with creep and without, s, p and σ, and derivatives of all.
fn sleigh() -> Machine {
    let velocities = Machine::default()
        .with_text("x'", "v_l*cos(phi) - v_t*sin(phi)")
        .with_text("y'", "v_l*sin(phi) + v_t*cos(phi)");
    let Some(t) = direction() else { return velocities };
    let creep = Symbol::from("e_tc");
    // The row of the program is e·v_l − v_t; the paper's (14) has the other sign.
    let g = &(&t.s * &t.q1.expr()) - &(&t.p * &t.q3.expr());
    let ideal = g.substitute(&|s| (*s == creep).then(|| Expr::int(0)));
    let by = |e: &Expr, name: &str| e.derivative(&name.into());
    velocities
        .with("g_phi", by(&g, "phi"))
        .with("g_e", by(&g, "e_tc"))
        .with("s_phi", by(&t.s, "phi"))
        .with("p_phi", by(&t.p, "phi"))
        .with("s_e", by(&t.s, "e_tc"))
        .with("p_e", by(&t.p, "e_tc"))
        .with("sigma_phi", by(&t.sigma(), "phi"))
        .with("sigma_e", by(&t.sigma(), "e_tc"))
        .with("sigma", t.sigma())
        .with("s", t.s)
        .with("p", t.p)
        .with("ideal", ideal)
        .with("g", g)
}

/// The row with x' and y' left free.
fn row() -> Machine {
    let machine = sleigh();
    let keep = ["g", "g_phi", "g_e", "ideal", "s", "p", "sigma", "s_phi", "p_phi", "s_e", "p_e"];
    keep.iter().fold(Machine::default(), |m, name| match machine.formula(name) {
        Some(f) => m.with(name, f.clone()),
        None => m,
    })
}

fn on_sleigh(s: &Statement, _: &Sampling) -> Outcome {
    prove(&sleigh(), s)
}

fn on_row(s: &Statement, _: &Sampling) -> Outcome {
    prove(&row(), s)
}

pub(super) fn claims() -> Vec<Claim> {
    [velocities(), coefficient(), signs(), friction(), intrinsic(), regular(), group()].concat()
}

fn velocities() -> Vec<Claim> {
    vec![
        Claim::new("eq-14", Status::Proved, "the ideal sleigh moves along its blade: ẋ·sin φ − ẏ·cos φ = 0")
            .at("section 3, (14)")
            .about(&[14])
            .under("no creep")
            .chapter(CHAPTER)
            .code(&[FORMS])
            .tests(&["tests/mechanism_forms.rs"])
            .proof("the derived row without creep", &[("ideal", "x'*sin(phi) - y'*cos(phi)")], on_row),
        Claim::new("E1", Status::Corrected, "the lateral velocity, positive to the left, is v_t = −ẋ·sin φ + ẏ·cos φ")
            .at("section 3, above (15); errata E1")
            .about(&[14, 17])
            .remark(
                "Section 3 defines v_t with the opposite sign, against its own (16), (21), the words left and right, \
                 and section 4.",
            )
            .chapter(CHAPTER)
            .code(&["src/model/build.rs", FORMS])
            .tests(&["tests/mechanism_motion.rs"])
            .refutation(
                "section 3 against the ẋ and ẏ of section 4",
                &[("v_t", "x'*sin(phi) - y'*cos(phi)")],
                &[("v_t", "-x'*sin(phi) + y'*cos(phi)")],
                on_sleigh,
            )
            .proof(
                "inverse of section 4",
                &[("v_t", "-x'*sin(phi) + y'*cos(phi)"), ("v_l", "x'*cos(phi) + y'*sin(phi)")],
                on_sleigh,
            ),
    ]
}

fn coefficient() -> Vec<Claim> {
    let angle = || Machine::default().with_text("phi_tc", "atan(v_t/v_l)").with_text("e_tc", "v_t/v_l");
    let slip = |s: &Statement, sampling: &Sampling| {
        let machine = Machine::default()
            .with_text("v_l", "v*(1 - t^2)/(1 + t^2)")
            .with_text("v_t", "v*2*t/(1 + t^2)")
            .with_text("theta_c", "asin(v_t/v)");
        at_points(&machine, s, &[("v", Domain::Positive), ("t", Domain::Creep)], sampling)
    };
    // Speeds whose quotient has a rational arcsine.
    let forward = |s: &Statement, sampling: &Sampling| {
        let machine = Machine::default().with_text("v_t", "v_l*2*t/(1 + t^2)").with_text("theta_l", "asin(v_t/v_l)");
        at_points(&machine, s, &[("v_l", Domain::Positive), ("t", Domain::Creep)], sampling)
    };
    vec![
        Claim::new("eq-15", Status::Proved, "the angle of traverse creep: φ_tc = arctan(v_t/v_l), tan φ_tc = e_tc")
            .at("section 3, (15), (17)")
            .about(&[15, 17])
            .under("v_l ≠ 0")
            .remark("With left positive it is minus the slip angle that ground-vehicle texts count from the course to the wheel.")
            .chapter(CHAPTER)
            .code(&[FORMS, "src/mechanism/regime.rs"])
            .proof("tangent of the angle", &[("tan(phi_tc)", "v_t/v_l"), ("tan(phi_tc)", "e_tc")], move |s, _| {
                prove(&angle(), s)
            }),
        Claim::new("E12", Status::Corrected, "arctan(v_t/v_l) is the creep angle sin⁻¹(ẋ_c/v) of the introduction")
            .at("section 1 and (15); errata E12")
            .about(&[1, 15])
            .under("v is the whole speed |ṙ| and v_l > 0")
            .remark(
                "The paper does not say which speed v is, and prints sin⁻¹ẋ_c/v for sin⁻¹(ẋ_c/v). With v = v_l the \
                 two angles differ by e³/2 to lowest order.",
            )
            .chapter(CHAPTER)
            .code(&["src/mechanism/regime.rs"])
            .refutation("with v = v_l", &[("theta_l", "atan(v_t/v_l)")], &[("theta_l", "2*atan(t)")], forward)
            .sample(
                "with v = |ṙ|, speeds on rational points of the circle",
                &[("theta_c", "atan(v_t/v_l)")],
                slip,
            ),
        Claim::new("eq-16", Status::Sampled, "e_tc is the limit of η/ξ, the displacement in the moving system")
            .at("section 3, (16)")
            .about(&[16, 17])
            .under("the wheel moves along its heading: v_l ≠ 0")
            .chapter(CHAPTER)
            .code(&["src/motion/trajectory.rs"])
            .tests(&["tests/motion_sensitivity.rs"])
            .sample(
                "finite motions of wheels held by a viscous contact, in ever shorter times",
                &[("limit", "v_t/v_l"), ("order", "1")],
                finite::traverse_limit,
            ),
        Claim::new("traverse-pair", Status::Sampled, "with constant e_tc and heading (ξ, η) is a traverse pair: η = e_tc·ξ")
            .at("section 3, below (17)")
            .about(&[16])
            .under("constant e_tc; constant heading for finite displacements, any heading for (v_l, v_t)")
            .chapter(CHAPTER)
            .code(&["src/motion/trajectory.rs"])
            .sample("displacements of simulated wheels", &[("eta", "e_tc*xi")], finite::traverse_pair),
        Claim::new("eq-17", Status::Proved, "e_tc = v_t/v_l, and the row of the sleigh is e_tc·v_l − v_t = 0")
            .at("section 3, (17)")
            .about(&[17])
            .under("v_l ≠ 0 for the quotient; the row needs nothing")
            .chapter(CHAPTER)
            .code(&[FORMS])
            .tests(&["tests/mechanism_forms.rs"])
            .proof("the derived row in the velocities of the body", &[("g", "e_tc*v_l - v_t")], on_sleigh),
        Claim::new("E8", Status::Corrected, "the coefficient (17) is undefined exactly where v_l = 0")
            .at("section 3, below (17); errata E8")
            .about(&[17])
            .remark(
                "The paper leaves out the static and the purely orienting sleigh; a pure slide to the side, v_l = 0 \
                 and v_t ≠ 0, has no coefficient either.",
            )
            .chapter(CHAPTER)
            .code(&["src/mechanism/regime.rs"])
            .refutation(
                "only the sleigh that does not travel is left out",
                &[("v_t/v_l", "v_l^2 + v_t^2")],
                &[("v_t/v_l", "v_l")],
                |s, _| undefined_exactly_where(s),
            )
            .proof("left out where v_l vanishes", &[("v_t/v_l", "v_l")], |s, _| undefined_exactly_where(s))
            .sabotaged_by(&[&[("v_t/v_l", "v_t")], &[("v_t/v_l", "v_l*v_t")]]),
    ]
}

fn signs() -> Vec<Claim> {
    let machine = || {
        Machine::default()
            .with_text("e_tc", "v_t/v_l")
            .with_text("e_rc", "1 - v_l/(r*omega)")
            .with_text("v_A", "v_l - r*omega")
    };
    vec![
        Claim::new(
            "E11",
            Status::Corrected,
            "the sign of a coefficient is relative to travel: e_tc with v_l·v_t, e_rc with −v_A·ω",
        )
        .at("sections 2 and 3, left-creep, backward-creep; errata E11")
        .under("v_l ≠ 0, resp. ω ≠ 0")
        .remark(
            "Left-creep and backward-creep are the signs of e_tc and e_rc only for v_l > 0 and ω > 0. With v_l² \
                 and (r·ω)² positive the equations below are equalities of signs.",
        )
        .chapter(CHAPTER)
        .code(&["src/mechanism/regime.rs"])
        .refutation(
            "to the left exactly for positive e_tc",
            &[("sign(v_t)", "sign(e_tc)")],
            &[("sign(v_l*v_t)", "sign(e_tc)")],
            move |s, sampling| {
                let names = [("v_l", Domain::Nonzero), ("v_t", Domain::Nonzero)];
                at_points(&machine(), s, &names, sampling)
            },
        )
        .proof(
            "coefficient times a square",
            &[("e_tc*v_l^2", "v_l*v_t"), ("e_rc*(r*omega)^2", "-v_A*r*omega")],
            move |s, _| prove(&machine(), s),
        ),
    ]
}

fn friction() -> Vec<Claim> {
    let machine = || sleigh().with_text("f_T", "-b_T*v_t").with_text("v_t", "e_tc*v_l");
    vec![
        Claim::new(
            "eq-18",
            Status::Proved,
            "a viscous contact, f_T = −b_T·v_t, takes the power b_T·v_t² out of the motion",
        )
        .at("section 3, (18)")
        .about(&[18])
        .chapter(CHAPTER)
        .code(&["src/effects/catalogue.toml"])
        .tests(&["tests/simulator_laws.rs"])
        .proof(
            "power of the friction",
            &[("f_T*v_t", "-b_T*v_t^2"), ("f_T*v_t", "-b_T*(e_tc*v_l)^2")],
            move |s, _| prove(&machine(), s),
        ),
        Claim::new("eq-19", Status::Proved, "e_tc = −f_T/(b_T·v_l)")
            .at("section 3, (19)")
            .about(&[19])
            .under("b_T·v_l ≠ 0")
            .chapter(CHAPTER)
            .code(&["src/effects/catalogue.toml"])
            .tests(&["tests/simulator_laws.rs"])
            .proof("(17) and (18)", &[("e_tc", "-f_T/(b_T*v_l)")], move |s, _| prove(&machine(), s)),
    ]
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
            .tests(&["tests/formula_creep.rs"])
            .proof(
                "σ without creep, and the row divided by sin φ",
                &[("sigma", "cot(phi)"), ("g/sin(phi)", "x' - cot(phi)*y'")],
                |s, _| {
                    let ideal = |e: &Expr| e.substitute(&|s| (s.as_str() == "e_tc").then(|| Expr::int(0)));
                    let machine = row();
                    let of = |name: &str| machine.formula(name).map_or_else(|| Expr::int(0), ideal);
                    prove(&Machine::default().with("sigma", of("sigma")).with("g", of("g")), s)
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
        .tests(&["tests/formula_creep.rs", "tests/mechanism_forms.rs"])
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
            .about(&[20, 21])
            .remark(
                "cot φ is no coordinate at φ = k·π, where the paper's own simulation starts, and σ is undefined where \
                 the course is along x. The pair (s, p) is defined and does not vanish, s² + p² = 1 + e².",
            )
            .chapter(REGULAR)
            .code(&[FORMS])
            .tests(&["tests/mechanism_forms.rs", "tests/formula_creep.rs"])
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

fn row_machine(name: &str, e: Expr) -> Machine {
    Machine::default().with(name, e)
}

fn regular() -> Vec<Claim> {
    let by_alpha = || {
        let e = formula("tan(alpha)");
        let turned = |s: &Symbol| (s.as_str() == "e_tc").then(|| e.clone());
        let g = row().formula("g").map_or_else(|| Expr::int(0), |g| g.substitute(&turned));
        Machine::default().with("g", g)
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
        .tests(&["tests/mechanism_forms.rs"])
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
            .tests(&["tests/formula_derivatives.rs"])
            .proof(
                "in the velocities of the body",
                &[("g_phi", "v_l + e_tc*v_t"), ("g_e", "v_l")],
                on_sleigh_derivatives,
            )
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
        .tests(&["tests/formula_derivatives.rs"])
        .proof(
            "in φ",
            &[
                ("sigma_phi", "-(1 + e_tc^2)/(sin(phi) + e_tc*cos(phi))^2"),
                ("sigma_e", "-1/(sin(phi) + e_tc*cos(phi))^2"),
            ],
            |s, _| prove(&sleigh(), s),
        )
        .proof(
            "in q₂ = cot φ",
            &[("by_q", "(1 + e^2)/(1 + e*q)^2"), ("by_e", "-(1 + q^2)/(1 + e*q)^2")],
            |s, _| {
                let sigma = formula("(q - e)/(1 + e*q)");
                let by = |name: &str| sigma.derivative(&name.into());
                prove(&Machine::default().with("by_q", by("q")).with("by_e", by("e")), s)
            },
        ),
    ]
}

/// The derivatives of the row were taken with ẋ and ẏ held; only then are these put in.
fn on_sleigh_derivatives(s: &Statement, _: &Sampling) -> Outcome {
    prove(&sleigh(), s)
}

fn group() -> Vec<Claim> {
    let twice = || {
        Machine::default()
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
        .tests(&["tests/formula_creep.rs"])
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
