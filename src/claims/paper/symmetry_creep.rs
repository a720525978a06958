//! Section 4, last paragraph: creep of constraints that are symmetries, by the drag of air.

use super::symmetry::{all_of, base, hopping, turn, within};
use crate::claims::simulated::undefined;
use crate::claims::{
    Claim, Correction, DerivedFormulas, Domain, Fault, Outcome, Sampling, Statement, Status, at_points, near, prove,
    proving, value_said,
};
use crate::connection::{Connection, Drag, Path};
use crate::formula::{Expr, Symbol};
use std::f64::consts::TAU;

const DRAG: &str = "src/connection/drag.rs";
/// Drag on the body and on the leg.
const AIR: &str = "c_b*psi'^2/2 + c_l*(psi' + theta')^2/2";
/// Drag that grows with the square of the leg's length.
const ON_THE_LEG: &str = "c_b*psi'^2/2 + c_l*(l + d)^2*(psi' + theta')^2/2";
const TESTS: [&str; 1] = ["tests/symmetry/drag.rs"];

pub(crate) fn claims() -> Vec<Claim> {
    vec![memory(), no_memory(), coefficient(), creep(), recovery()]
}

fn drag(dissipation: &str) -> Option<Drag> {
    let (momentum, _) = hopping()?;
    Drag::of(&momentum, &super::blade::formula(dissipation), &turn()).ok()
}

fn force(dissipation: &str) -> Expr {
    drag(dissipation).map(|d| d.force.expr()).unwrap_or_default()
}

fn memory() -> Claim {
    let found = drag(AIR).and_then(|d| d.memory(&["l".into()])).unwrap_or_default();
    let rate = move |s: &Statement, _: &Sampling| {
        let Some(said) = s.said_of("K") else { return Outcome::Undefined("nothing is said of K".into()) };
        let by = |q: &str| &said.derivative(&q.into()) * &Expr::sym(Symbol::new(q).rate());
        let rate = ["psi", "theta", "l"].iter().fold(Expr::int(0), |sum, q| &sum + &by(q));
        prove(&DerivedFormulas::default(), &Statement::of([(force(AIR), rate)]))
    };
    base(
        "drag-memory",
        Status::Proved,
        "with drag c_b on the body and c_l on the leg p + c_b·ψ + c_l·(ψ + θ) is conserved: the momentum is what has been moved",
    )
    .under("c_b, c_l constant; drag proportional to velocities, ṗ = −c_b·ψ̇ − c_l·(ψ̇ + θ̇)")
    .code(&[DRAG])
    .tests(&TESTS)
    .proof(
        "the moment of the drag, from its dissipation function along the turn; the integral that is found",
        &[("force", "c_b*psi' + c_l*(psi' + theta')"), ("memory", "c_b*psi + c_l*(psi + theta)")],
        proving(DerivedFormulas::default().with("force", force(AIR)).with("memory", found)),
    )
    .proof("its rate along every motion is the drag", &[("K", "c_b*psi + c_l*(psi + theta)")], rate)
}

/// Position and momentum after the loop of the paper's hopper, and what is left when the leg is held.
fn after(dissipation: &str, c_b: f64, c_l: f64) -> Result<[f64; 2], Fault> {
    let path = Path::new(&[("l", "1/2 + 3/10*cos(t)"), ("theta", "4/5*sin(t)")], [0.0, TAU]);
    let values = [("I", 1.0), ("m", 0.4), ("d", 0.6), ("c_b", c_b), ("c_l", c_l)];
    let drag = drag(dissipation).ok_or_else(|| Fault::Undefined("the hopper has no drag".into()))?;
    path.and_then(|path| drag.after(&path, [0.0, 0.0], &values)).map_err(|e| undefined(&e))
}

/// Where the body comes to rest with the leg held at l = 4/5, from the state after a loop: ψ̇ = p/(I + M), ṗ = −k·ψ̇.
fn rest([psi, p]: [f64; 2], k: f64) -> f64 {
    psi + p / k
}

fn no_memory() -> Claim {
    let form = drag(ON_THE_LEG).map(|d| d.force).unwrap_or_default();
    let slope = |rate: &str, by: &str| form.coefficient(&rate.into()).derivative(&by.into());
    let curl = &slope("theta'", "l") - &slope("l'", "theta");
    base(
        "drag-without-memory",
        Status::Sampled,
        "drag that grows with (l + d)² has no such integral, and the body does not come back: ψ → −0.3368",
    )
    .under("I = 1, m = 2/5, d = 3/5, the loop of `hopper-phase`, c_b = 1/10, c_l = 1/20; then the leg is held")
    .remark("The paper prints no number; this one is for the two constants named.")
    .code(&[DRAG])
    .tests(&TESTS)
    .proof(
        "the drag is no rate of a function: its curl is not zero",
        &[("curl", "2*c_l*(l + d)")],
        proving(DerivedFormulas::default().with("curl", curl)),
    )
    .sample("where the body comes to rest", &[("rest", "-0.3368")], |s, _| {
        let said = s.number("rest").unwrap_or(f64::NAN);
        let found = after(ON_THE_LEG, 0.1, 0.05).map(|end| rest(end, 0.1 + 0.05 * 1.4 * 1.4));
        all_of([found.and_then(|psi| within("rest", psi, said, 5e-5))])
    })
}

/// Where the leg moves, a coefficient says as much as the momentum.
fn coefficient() -> Claim {
    let hopper = DerivedFormulas::of("hopper");
    let by_e = hopper.written_out("psi'").derivative(&"e_sc".into());
    base(
        "similar-coefficients",
        Status::Proved,
        "where the leg turns, a coefficient of creep describes the violation, p = e·m·(l + d)²·θ̇, as those of wheels do",
    )
    .under("θ̇ ≠ 0, m > 0, l + d ≠ 0; as a description of one motion, not as a law")
    .code(&["src/mechanism/constraint_types.toml", "src/mechanism/momentum.rs"])
    .tests(&["tests/symmetry/hopper.rs"])
    .proof(
        "from the coefficient to the motion and back; its slope is not zero where the leg turns",
        &[
            ("1 + (I + m*(l + d)^2)*psi'/(m*(l + d)^2*theta')", "e_sc"),
            ("(I + m*(l + d)^2)*psi' + m*(l + d)^2*theta'", "e_sc*m*(l + d)^2*theta'"),
            ("by_e", "m*(l + d)^2*theta'/(I + m*(l + d)^2)"),
        ],
        proving(hopper.with("by_e", by_e)),
    )
}

/// A momentum under drag, with where the motion began, and the coefficient it gives; M is m·(l + d)².
fn creeping() -> DerivedFormulas {
    let memory = drag(AIR).and_then(|d| d.memory(&["l".into()])).unwrap_or_default();
    let began = memory.substitute(&|s| match s.as_str() {
        "psi" => Some(Expr::sym("psi_0")),
        "theta" => Some(Expr::sym("theta_0")),
        _ => None,
    });
    DerivedFormulas::default()
        .with("p", &began - &memory)
        .with_text("e", "p/(M*theta')")
        .with("p_other", -&memory)
        .with_text("e_other", "p_other/(M*theta')")
}

fn creep() -> Claim {
    // One state is enough for a counterexample, ψ = θ = 0.
    let state = || creeping().with_text("psi", "0").with_text("theta", "0");
    let resting = state().with_text("theta'", "0");
    let names = ["psi_0", "theta_0", "c_b", "c_l", "M"].map(|n| (n, Domain::Positive));
    let at_rest = move |s: &Statement, sampling: &Sampling| at_points(&resting, s, &names, sampling);
    // As drag grows the motion is that in which it has nothing to take away.
    let slow = crate::mechanism::solve::together(
        &drag(AIR).map(|d| d.force).into_iter().collect::<Vec<_>>(),
        &["psi'".into()],
    );
    let slow = slow.and_then(|s| s.into_iter().next()).map(|s| s.1).unwrap_or_default();
    let viscous = DerivedFormulas::default().with("limit", slow);
    base("E25", Status::Corrected, "\"similar coefficients of creep can also be defined\" for symmetry constraints, by the viscous dissipation in air")
        .at("section 4, last paragraph; errata E25")
        .corrects(Correction::FalseAsPrinted)
        .about(&[20])
        .under("hopper in flight, drag with constants c_b, c_l > 0 or none")
        .remark(
            "The limit is the opposite one: the constraint is recovered as drag vanishes, not as a viscosity grows. The \
             violation is a memory integral, p = −c_b·(ψ − ψ₀) − c_l·(ψ + θ − ψ₀ − θ₀), and e = p/(M·θ̇), M = m·(l + d)², no \
             constitutive coefficient: it differs between motions through the same state, and has no value at θ̇ = 0.",
        )
        .code(&[DRAG])
        .tests(&TESTS)
        .refutation(
            "a coefficient e(q, q̇): two motions through the same state that began elsewhere have the same",
            &[("e - e_other", "0")],
            &[("e - e_other", "(c_b*psi_0 + c_l*(psi_0 + theta_0))/(M*theta')")],
            proving(state()),
        )
        .refutation(
            "a coefficient that gives the momentum in every state: not where the leg stands",
            &[("p", "e*(M*theta')")],
            &[("p - p_other", "c_b*psi_0 + c_l*(psi_0 + theta_0)")],
            at_rest,
        )
        .refutation(
            "the constraint recovered as the viscosity grows: then body and leg are still to the air on the average",
            &[("limit", "-M/(I + M)*theta'")],
            &[("limit", "-c_l/(c_b + c_l)*theta'")],
            proving(viscous),
        )
        .proof(
            "the violation is a memory",
            &[("p", "-c_b*(psi - psi_0) - c_l*(psi + theta - psi_0 - theta_0)")],
            proving(creeping()),
        )
        .sample(
            "error after one loop for c_b = c, c_l = c/2, c = 1/10, 1/100, …: it falls with c, by these factors",
            &[("first", "8.3108"), ("second", "9.8067"), ("third", "9.9804")],
            orders,
        )
}

/// Ratios of the errors of the body's angle after one loop, drag falling by tens.
fn orders(s: &Statement, _: &Sampling) -> Outcome {
    let ideal = after(AIR, 0.0, 0.0).map(|end| end[0]);
    let error = |k: i32| {
        let c = 10f64.powi(-k);
        Ok((after(AIR, c, c / 2.0)?[0] - ideal.clone()?).abs())
    };
    all_of(
        ["first", "second", "third"]
            .iter()
            .zip(1..)
            .map(|(name, k)| within(name, error(k)? / error(k + 1)?, s.number(name).unwrap_or(f64::NAN), 5e-5)),
    )
}

fn recovery() -> Claim {
    let held = drag(AIR).map(|d| {
        let still = d.force.without(&|rate| rate.as_str() == "theta'");
        &-&still.coefficient(&"psi'".into()) / &d.momentum.locked
    });
    base(
        "self-recovery",
        Status::Sampled,
        "for any drag c > 0 a closed motion of the leg leaves the body where it was: ψ → 0, so that the limits c → 0 and t → ∞ do not commute",
    )
    .under("c_b + c_l > 0; the leg is back where it began and held")
    .remark("Without drag the body stays turned by the phase of the loop. Chang & Jeon call this damping-induced self-recovery.")
    .code(&[DRAG, "src/connection/abelian.rs"])
    .tests(&TESTS)
    .proof(
        "the rate at which momentum is lost with the leg held, ṗ = rate·p",
        &[("rate", "-(c_b + c_l)/(I + m*(l + d)^2)")],
        proving(DerivedFormulas::default().with("rate", held.unwrap_or_default())),
    )
    .sample(
        "generated loops and drags: where the body is at last, and what the angle is a time t after the leg is held; the same body without drag",
        &[("at_last", "0"), ("later", "psi*exp(-(c_b + c_l)*t/(I + m*(l + d)^2))"), ("without", "phase")],
        |s, sampling| {
            let drags = (0.02..1.0f64, 0.02..1.0f64, 0.1..0.6f64, 0.2..1.2f64, 0.5..4.0f64);
            let show = |v: &(f64, f64, f64, f64, f64)| vec![("c_b, c_l, swings, t".into(), format!("{v:?}"))];
            sampling.at_most(8).cases(drags, show, |case| recovered(s, *case))
        },
    )
}

fn recovered(s: &Statement, (c_b, c_l, a, b, t): (f64, f64, f64, f64, f64)) -> Result<(), Fault> {
    let missing = || Fault::Undefined("the hopper has no drag".into());
    let (drag, (momentum, shape)) = (drag(AIR).ok_or_else(missing)?, hopping().ok_or_else(missing)?);
    let swing = Path::new(&[("l", "4/5 + a*sin(t)"), ("theta", "b*(1 - cos(t)) + b*sin(2*t)")], [0.0, TAU]);
    let swing = swing.map_err(|e| undefined(&e))?;
    let still = |until: f64| Path::new(&[("l", "4/5"), ("theta", "0")], [0.0, until]).map_err(|e| undefined(&e));
    let with =
        |c_b: f64, c_l: f64| [("I", 1.0), ("m", 0.4), ("d", 0.6), ("a", a), ("b", b), ("c_b", c_b), ("c_l", c_l)];
    let values = with(c_b, c_l);
    let run = |path: &Path, start, values: &[(&str, f64)]| drag.after(path, start, values).map_err(|e| undefined(&e));
    let end = run(&swing, [0.0, 0.0], &values)?;
    let inertia = 1.0 + 0.4 * 1.4 * 1.4;
    let later = run(&still(t)?, end, &values)?[0];
    let at_last = run(&still(60.0 * inertia / (c_b + c_l))?, end, &values)?[0];
    let connection = Connection::of(&momentum, &shape).map_err(|e| undefined(&e))?;
    let phase = connection.phase(&swing, &values).map_err(|e| undefined(&e))?;
    let at = |name: &str| match name {
        "psi" => Some(end[0]),
        "t" => Some(t),
        "l" => Some(0.8),
        "phase" => Some(phase),
        _ => values.iter().find(|(n, _)| *n == name).map(|(_, v)| *v),
    };
    within("at_last", at_last, value_said(s, "at_last", &at)?, 1e-10)?;
    near("later", later, value_said(s, "later", &at)?, 1e-10)?;
    near("without", run(&swing, [0.0, 0.0], &with(0.0, 0.0))?[0], value_said(s, "without", &at)?, 1e-10)
}
