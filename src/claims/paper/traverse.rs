//! Section 3: traverse creep of a sleigh, equations (14)–(19).

use super::blade::{on_row, on_sleigh, sleigh};
use super::domain::{solved_for, undefined_exactly_where};
use super::finite;
use crate::claims::{Claim, Correction, DerivedFormulas, Domain, Sampling, Statement, Status, at_points, prove};
use crate::formula::Expr;

const CHAPTER: &str = "03-traverse-creep";
const FORMS: &str = "src/mechanism/contact.rs";

pub(crate) fn claims() -> Vec<Claim> {
    [velocities(), coefficient(), signs(), friction()].concat()
}

fn velocities() -> Vec<Claim> {
    vec![
        Claim::new("eq-14", Status::Proved, "the ideal sleigh moves along its blade: ẋ·sin φ − ẏ·cos φ = 0")
            .at("section 3, (14)")
            .about(&[14])
            .under("no creep")
            .chapter(CHAPTER)
            .code(&[FORMS])
            .tests(&["tests/mechanism/forms.rs"])
            .proof("the derived row without creep", &[("ideal", "x'*sin(phi) - y'*cos(phi)")], on_row),
        Claim::new("E1", Status::Corrected, "the lateral velocity is v_t = ẋ·sin φ − ẏ·cos φ")
            .at("section 3, above (15); errata E1")
            .corrects(Correction::FalseAsPrinted)
            .about(&[14, 17])
            .remark(
                "Positive to the left it is −ẋ·sin φ + ẏ·cos φ: section 3 has the opposite sign, against its own (16), \
                 (21), the words left and right, and section 4.",
            )
            .chapter(CHAPTER)
            .code(&["src/model/build.rs", FORMS])
            .tests(&["tests/mechanism/motion.rs"])
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
    let angle = || DerivedFormulas::default().with_text("phi_tc", "atan(v_t/v_l)").with_text("e_tc", "v_t/v_l");
    let slip = |s: &Statement, sampling: &Sampling| {
        let derived = DerivedFormulas::default()
            .with_text("v_l", "v*(1 - t^2)/(1 + t^2)")
            .with_text("v_t", "v*2*t/(1 + t^2)")
            .with_text("theta_c", "asin(v_t/v)");
        at_points(&derived, s, &[("v", Domain::Positive), ("t", Domain::Creep)], sampling)
    };
    // Speeds whose quotient has a rational arcsine.
    let forward = |s: &Statement, sampling: &Sampling| {
        let derived =
            DerivedFormulas::default().with_text("v_t", "v_l*2*t/(1 + t^2)").with_text("theta_l", "asin(v_t/v_l)");
        at_points(&derived, s, &[("v_l", Domain::Positive), ("t", Domain::Creep)], sampling)
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
            .corrects(Correction::ContestedReading)
            .about(&[1, 15])
            .under("v is the whole speed |ṙ| and v_l > 0")
            .remark(
                "The paper does not say which speed v is, and prints sin⁻¹ẋ_c/v for sin⁻¹(ẋ_c/v). With v = v_l the \
                 two angles differ by e³/2 to lowest order.",
            )
            .chapter(CHAPTER)
            .code(&["src/mechanism/regime.rs"])
            .refutation("with v = v_l, at v_t = v_l·2t/(1 + t²)", &[("theta_l", "atan(v_t/v_l)")], &[("theta_l", "2*atan(t)")], forward)
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
            .tests(&["tests/motion/sensitivity.rs"])
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
            .tests(&["tests/mechanism/forms.rs"])
            .proof("the derived row in the velocities of the body", &[("g", "e_tc*v_l - v_t")], on_sleigh),
        Claim::new("E8", Status::Corrected, "the coefficient (17) is undefined for the sleigh that stands or turns on the spot alone")
            .at("section 3, below (17); errata E8")
            .corrects(Correction::LacksHypothesis)
            .about(&[17])
            .remark(
                "It is undefined exactly where v_l = 0: a pure slide to the side, v_l = 0 and v_t ≠ 0, has no \
                 coefficient either.",
            )
            .chapter(CHAPTER)
            .code(&[FORMS])
            .tests(&["tests/mechanism/regime.rs"])
            .refutation(
                "the derived row solved for its coefficient, only the sleigh that does not travel left out",
                &[("e_tc", "v_l^2 + v_t^2")],
                &[("e_tc", "v_l")],
                |s, _| undefined_exactly_where(&solved(), s),
            )
            .proof("left out where v_l vanishes", &[("e_tc", "v_l")], |s, _| undefined_exactly_where(&solved(), s))
            .sabotaged_by(&[&[("e_tc", "v_t")], &[("e_tc", "v_l*v_t")]])
            .on_domains(),
    ]
}

/// The derived row of the sleigh solved for its coefficient.
fn solved() -> DerivedFormulas {
    let row = sleigh().written_out("g");
    DerivedFormulas::default().with("e_tc", solved_for("e_tc", &row, &Expr::int(0)))
}

fn signs() -> Vec<Claim> {
    let derived = || {
        DerivedFormulas::default()
            .with_text("e_tc", "v_t/v_l")
            .with_text("e_rc", "1 - v_l/(r*omega)")
            .with_text("v_A", "v_l - r*omega")
    };
    vec![
        Claim::new(
            "E11",
            Status::Corrected,
            "a positive e_tc is a creep to the left, and a positive e_rc one backward",
        )
        .at("sections 2 and 3, left-creep, backward-creep; errata E11")
        .corrects(Correction::FalseAsPrinted)
        .under("v_l ≠ 0, resp. ω ≠ 0")
        .remark(
            "Only for v_l > 0, resp. ω > 0: signs are relative to travel, that of e_tc is that of v_l·v_t, that of e_rc \
                 that of −v_A·ω. With v_l² and (r·ω)² positive the equations below are equalities of signs.",
        )
        .chapter(CHAPTER)
        .code(&["src/mechanism/regime.rs"])
        .refutation(
            "to the left exactly for positive e_tc",
            &[("sign(v_t)", "sign(e_tc)")],
            &[("sign(v_l*v_t)", "sign(e_tc)")],
            move |s, sampling| {
                let names = [("v_l", Domain::Nonzero), ("v_t", Domain::Nonzero)];
                at_points(&derived(), s, &names, sampling)
            },
        )
        .proof(
            "coefficient times a square",
            &[("e_tc*v_l^2", "v_l*v_t"), ("e_rc*(r*omega)^2", "-v_A*r*omega")],
            move |s, _| prove(&derived(), s),
        ),
    ]
}

fn friction() -> Vec<Claim> {
    let derived = || sleigh().with_text("f_T", "-b_T*v_t").with_text("v_t", "e_tc*v_l");
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
        .tests(&["tests/discovery/simulator_laws.rs"])
        .proof(
            "power of the friction",
            &[("f_T*v_t", "-b_T*v_t^2"), ("f_T*v_t", "-b_T*(e_tc*v_l)^2")],
            move |s, _| prove(&derived(), s),
        ),
        Claim::new("eq-19", Status::Proved, "e_tc = −f_T/(b_T·v_l)")
            .at("section 3, (19)")
            .about(&[19])
            .under("b_T·v_l ≠ 0")
            .chapter(CHAPTER)
            .code(&["src/effects/catalogue.toml"])
            .tests(&["tests/discovery/simulator_laws.rs"])
            .proof("(17) and (18)", &[("e_tc", "-f_T/(b_T*v_l)")], move |s, _| prove(&derived(), s)),
    ]
}
