//! Section 2: rotation creep of a disk, equations (3)–(13).

use super::domain::{disk_coefficient, undefined_exactly_where};
use super::finite;
use crate::claims::generated::{Generated, any_drive, vehicles as vehicles_drawn};
use crate::claims::{
    Claim, Correction, DerivedFormulas, Domain, Fault, Outcome, Sampling, Statement, Status, Verdict, at_points, prove,
};
use crate::formula::{Expr, Symbol};
use crate::mechanism::Part;
use crate::model::mechanism;
use crate::vehicles;
use crate::vehicles::Vehicle;
use std::sync::LazyLock;

const CHAPTER: &str = "02-rotation-creep";
const FORMS: &str = "src/mechanism/contact.rs";

/// The disk with the velocity of the particle of its rim that touches the ground.
fn disk() -> DerivedFormulas {
    // The particle that was at the bottom u radians of rolling ago: its place relative to the line.
    let rim = Expr::parse("x - r*sin(u)").unwrap_or_else(|_| Expr::int(0));
    let by_u = rim.derivative(&"u".into()).substitute(&|s| (s.as_str() == "u").then(|| Expr::int(0)));
    let by_x = rim.derivative(&"x".into());
    let velocity = &(&by_x * &Expr::sym("v_l")) + &(&by_u * &Expr::sym("theta'"));
    DerivedFormulas::of("disk").with("v_A", velocity).with_text("f_R", "-b_R*v_A").with_text("omega", "theta'")
}

fn on_disk(s: &Statement, _: &Sampling) -> Outcome {
    static DERIVED: LazyLock<DerivedFormulas> = LazyLock::new(disk);
    prove(&DERIVED, s)
}

pub(crate) fn claims() -> Vec<Claim> {
    [kinematics(), finite::claims(), other_coefficients(), friction(), generic_form()].concat()
}

fn kinematics() -> Vec<Claim> {
    let ideal = |s: &Statement, _: &Sampling| prove(&disk().with_text("e_rc", "0"), s);
    vec![
        Claim::new("eq-3", Status::Proved, "an ideally rolling disk travels as it turns: v_l − r·ω = 0")
            .at("section 2, (3)")
            .about(&[3])
            .under("no creep")
            .chapter(CHAPTER)
            .code(&[FORMS, "src/vehicles/catalogue.toml"])
            .tests(&["tests/mechanism/forms.rs", "tests/mechanism/motion.rs"])
            .proof("the row of the disk without creep", &[("v_l - r*theta'", "0"), ("v_A", "0")], ideal)
            .sabotaged_by(&[&[("v_l + r*theta'", "0")], &[("v_A", "theta'")], &[("v_l - theta'/r", "0")]]),
        Claim::new("eq-4", Status::Proved, "the contact of a creeping disk moves with v_A = v_l − r·ω = −r·ω·e_rc")
            .at("section 2, (4); errata E6")
            .about(&[4])
            .remark("The paper writes v_i for the ideal and for the real velocity; in (4) it is the real one, v_l.")
            .chapter(CHAPTER)
            .code(&[FORMS])
            .tests(&["tests/mechanism/forms.rs"])
            .proof(
                "velocity of the particle of the rim that touches the ground",
                &[("v_A", "v_l - r*omega"), ("v_A", "-r*omega*e_rc")],
                on_disk,
            ),
        Claim::new("E6", Status::Corrected, "(3) and (4) mean the same v_i")
            .at("section 2, (3)–(4); errata E6")
            .corrects(Correction::FalseAsPrinted)
            .about(&[3, 4])
            .remark("With the ideal v_i = r·ω of (3) put into (4), the velocity v_A would vanish whatever the creep.")
            .chapter(CHAPTER)
            .code(&[FORMS])
            .refutation(
                "v_A from the ideal velocity",
                &[("v_A", "r*omega - r*omega")],
                &[("v_A", "v_l - r*omega")],
                on_disk,
            )
            .proof("v_A from the real velocity", &[("v_A", "v_l - r*omega")], on_disk),
        Claim::new("eq-8", Status::Proved, "e_rc = 1 − v_l/(r·ω)")
            .at("section 2, (8)")
            .about(&[8])
            .under("r·ω ≠ 0")
            .chapter(CHAPTER)
            .code(&[FORMS, "src/mechanism/regime.rs"])
            .tests(&["tests/mechanism/forms.rs", "tests/formula/creep.rs"])
            .proof(
                "the row solved for its coefficient, and for the speed",
                &[("e_rc", "1 - v_l/(r*theta')"), ("v_l", "r*theta'*(1 - e_rc)")],
                on_disk,
            ),
        Claim::new("E7", Status::Corrected, "the coefficient (8) is undefined for the disk at rest alone, v_l = ω = 0")
            .at("section 2, below (8); errata E7")
            .corrects(Correction::LacksHypothesis)
            .about(&[8])
            .remark(
                "It is undefined exactly where r·ω = 0: a locked wheel that slides, ω = 0 and v_l ≠ 0, has no \
                 coefficient either.",
            )
            .chapter(CHAPTER)
            .code(&[FORMS, "src/mechanism/solve.rs"])
            .tests(&["tests/formula/creep.rs", "tests/mechanism/regime.rs"])
            .refutation(
                "the derived motion solved for its coefficient, only the disk at rest left out",
                &[("e_rc", "v_l^2 + omega^2")],
                &[("e_rc", "r*omega")],
                |s, _| undefined_exactly_where(&disk_coefficient(), s),
            )
            .proof("left out where r·ω vanishes", &[("e_rc", "r*omega")], |s, _| {
                undefined_exactly_where(&disk_coefficient(), s)
            })
            .sabotaged_by(&[&[("e_rc", "v_l")], &[("e_rc", "omega")], &[("e_rc", "v_l*omega*r")]])
            .on_domains(),
    ]
}

/// The disk with Wong's slips, driven and braked, and the roll-slide number.
fn others() -> DerivedFormulas {
    let derived = disk().with_text("i_s", "1 - v_l/(r*omega)").with_text("rho_s", "r*omega/v_l");
    derived.with_text("i_b", "1 - r*omega/v_l")
}

/// The roll-slide number at any speed and rate.
fn roll_slide() -> DerivedFormulas {
    DerivedFormulas::default().with_text("rho_s", "r*omega/v_l")
}

fn on_others(s: &Statement, _: &Sampling) -> Outcome {
    static DERIVED: LazyLock<DerivedFormulas> = LazyLock::new(others);
    prove(&DERIVED, s)
}

fn other_coefficients() -> Vec<Claim> {
    vec![
        Claim::new("E4", Status::Corrected, "e_rc = 1 − e_s, with e_s the slip of a driven wheel by Wong")
            .at("section 2, remark, (9); errata E4")
            .corrects(Correction::ContestedReading)
            .about(&[9])
            .under("i = 1 − V/(r·ω) for a driven wheel; for a braked one i_b = 1 − r·ω/V")
            .remark(
                "Wong's slip is the coefficient itself, e_rc = i; (9) would make ideal rolling a slip of 1. It holds \
                 only at 1/2, or if e_s stands for V/(r·ω), the reciprocal of the roll-slide number.",
            )
            .chapter(CHAPTER)
            .code(&["src/mechanism/regime.rs"])
            .refutation("(9) with Wong's slip", &[("e_rc", "1 - i_s")], &[("e_rc", "i_s")], on_others)
            .proof(
                "driven and braked wheels, and the reading under which (9) is right",
                &[("e_rc", "i_s"), ("e_rc", "-i_b/(1 - i_b)"), ("e_rc", "1 - 1/rho_s")],
                on_others,
            ),
        Claim::new("eq-10", Status::Proved, "e_rc = 1 − 1/ρ_s with the roll-slide number ρ_s = r·ω/v_l")
            .at("section 2, remark, (10); errata E5")
            .about(&[10])
            .under("v_l ≠ 0 and r·ω ≠ 0")
            .remark("Right if ρ_s = r·ω/v_l; the paper does not say so, nor that v_l ≠ 0 is needed.")
            .chapter(CHAPTER)
            .code(&["src/mechanism/regime.rs"])
            .proof("from (8)", &[("e_rc", "1 - 1/rho_s"), ("rho_s*(1 - e_rc)", "1")], on_others),
        Claim::new("E5", Status::Corrected, "the roll-slide number of (10) is there whenever the coefficient is")
            .at("section 2, remark, (10); errata E5")
            .corrects(Correction::ContestedReading)
            .about(&[10])
            .remark("It needs v_l ≠ 0: a wheel that spins on the spot has e_rc = 1, which no roll-slide number gives.")
            .chapter(CHAPTER)
            .code(&[FORMS])
            .refutation(
                "ρ_s = r·ω/v_l, only the wheel that does not turn left out",
                &[("rho_s", "r*omega")],
                &[("rho_s", "v_l")],
                |s, _| undefined_exactly_where(&roll_slide(), s),
            )
            .proof("left out where v_l vanishes", &[("rho_s", "v_l")], |s, _| undefined_exactly_where(&roll_slide(), s))
            .sabotaged_by(&[&[("rho_s", "omega")], &[("rho_s", "v_l*omega")]])
            .on_domains(),
    ]
}

fn friction() -> Vec<Claim> {
    vec![
        Claim::new(
            "eq-11",
            Status::Proved,
            "a viscous contact, f_R = −b_R·v_A, takes the power b_R·v_A² out of the motion",
        )
        .at("section 2, (11)")
        .about(&[11])
        .chapter(CHAPTER)
        .code(&["src/effects/catalogue.toml"])
        .tests(&["tests/discovery/simulator_laws.rs"])
        .proof(
            "power of the friction on the contact, never positive for b_R > 0",
            &[("f_R*v_A", "-b_R*v_A^2"), ("f_R*v_A", "-b_R*(r*omega*e_rc)^2")],
            on_disk,
        ),
        Claim::new("eq-12", Status::Proved, "e_rc = f_R/(b_R·r·ω), and with it v_l = (1 − e_rc)·r·ω")
            .at("section 2, (12)")
            .about(&[12])
            .under("b_R·r·ω ≠ 0")
            .chapter(CHAPTER)
            .code(&["src/effects/catalogue.toml"])
            .tests(&["tests/discovery/simulator_laws.rs"])
            .proof(
                "friction, coefficient and speed in a circle",
                &[("e_rc", "f_R/(b_R*r*omega)"), ("v_l", "r*omega - f_R/b_R"), ("v_l", "(1 - e_rc)*r*omega")],
                on_disk,
            ),
        Claim::new("remark-displacement", Status::Proved, "(3) is integrable: d − r·θ = 0 has the rate v_l − r·ω")
            .at("section 2, remark, below (12)")
            .about(&[3])
            .under("constant radius and creep")
            .chapter(CHAPTER)
            .code(&["src/mechanism/integrals.rs"])
            .tests(&["tests/mechanism/growth.rs"])
            .proof(
                "the differential of x − r·(1 − e_rc)·θ along the motion",
                &[("v_l - r*(1 - e_rc)*theta'", "0")],
                on_disk,
            )
            .sabotaged_by(&[&[("v_l - r*theta'", "0")], &[("v_l - r*(1 + e_rc)*theta'", "0")]]),
    ]
}

fn generic_form() -> Vec<Claim> {
    vec![
        Claim::new(
            "eq-13",
            Status::Proved,
            "every rolling constraint is of the form π̇ − σ(e_rc)·q̇ = 0 with σ = r·(1 − e_rc)",
        )
        .at("section 2, remark, (13)")
        .about(&[13])
        .under("the vehicles of the catalogue, each with all lengths and angles free; generated ones beside them")
        .chapter(CHAPTER)
        .code(&[FORMS])
        .tests(&["tests/mechanism/forms.rs", "tests/describe/formulas.rs"])
        .proof("all rolling rows of the catalogue against the form", &[("sigma", "r*(1 - e)")], type_r)
        .confirmation(
            "all rolling rows of generated vehicles with up to three more wheels and three trailers",
            &[("sigma", "r*(1 - e)")],
            |s, sampling| {
                sampling
                    .one_in(4)
                    .cases(vehicles_drawn(any_drive(), 3, 3), Generated::shown, |drawn| on_drawn(drawn, s))
            },
        )
        .proof("its derivatives", &[("by_e", "r*theta'"), ("by_rate", "-r*(1 - e_rc)")], |s, _| {
            let row = Expr::parse("v_l - r*(1 - e_rc)*theta'").unwrap_or_else(|_| Expr::int(0));
            let by = |name: &str| row.derivative(&name.into());
            prove(&DerivedFormulas::default().with("by_e", by("e_rc")).with("by_rate", by("theta'")), s)
        }),
        Claim::new("eq-8-round-trip", Status::Sampled, "velocities to coefficient and back, at any rational numbers")
            .at("section 2, (8)")
            .about(&[8])
            .under("r·ω ≠ 0")
            .chapter(CHAPTER)
            .code(&[FORMS])
            .sample("exact values through the derived motion", &[("1 - v_l/(r*theta')", "e_rc")], |s, sampling| {
                let names = [("r", Domain::Positive), ("theta'", Domain::Nonzero), ("e_rc", Domain::Any)];
                at_points(&DerivedFormulas::of("disk"), s, &names, sampling)
            }),
    ]
}

/// Every rolling constraint of the catalogue: its σ is what the statement says, its row is π̇ − σ·q̇.
fn type_r(s: &Statement, _: &Sampling) -> Outcome {
    Outcome::all(vehicles::all().iter().flat_map(|v| rolling_rows(v, 0, s)))
}

/// The same of a generated vehicle; wheels that cannot stand as they were drawn make none.
fn on_drawn(drawn: &Generated, s: &Statement) -> Verdict {
    let rows = rolling_rows(&drawn.vehicle(), drawn.trailers(), s);
    if rows.is_empty() {
        return Err(Fault::Outside);
    }
    match Outcome::all(rows) {
        Outcome::Holds { .. } => Ok(()),
        Outcome::Fails(found) => Err(Fault::False(found.says)),
        Outcome::Undefined(why) => Err(Fault::Undefined(why)),
    }
}

/// What becomes of each rolling constraint of one vehicle.
fn rolling_rows(v: &Vehicle, trailers: usize, s: &Statement) -> Vec<Outcome> {
    let Some(sigma) = s.said_of("sigma") else {
        return vec![Outcome::Undefined("nothing is said of sigma".into())];
    };
    let rolls = |creep: &Symbol| v.wheels.iter().find(|w| w.rotation_creep.as_ref() == Some(creep));
    let radius = |creep: &Symbol| rolls(creep).and_then(|w| w.radius.clone());
    let rows = mechanism(v, trailers).constraints.into_iter().filter_map(|c| Some((radius(&c.creep)?, c)));
    let found = rows.filter_map(|(radius, c)| {
        let slot = |name: &str| c.form.slot(name).map(Part::expr);
        let (pi, rolling, rate) = (slot("pi'")?, slot("sigma")?, slot("q'")?);
        let said = sigma.substitute(&|s| match s.as_str() {
            "r" => Some(Expr::sym(radius.clone())),
            "e" => Some(Expr::sym(c.creep.clone())),
            _ => None,
        });
        let form = &pi - &(&said * &rate);
        let derived = DerivedFormulas::default().with("sigma", rolling).with("row", c.row().expr());
        let rows = [(Expr::sym("sigma"), said), (Expr::sym("row"), form)];
        Some(prove(&derived, &Statement::of(rows)))
    });
    found.collect()
}
