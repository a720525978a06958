//! Section 4, simulation: with forces the energy is what friction leaves of it.

use crate::claims::generated_forced::{Pushed, pushed};
use crate::claims::simulated::undefined;
use crate::claims::with_forces::{along_motion, ideal, lettered, machine_of, residuals, viscous};
use crate::claims::{Claim, Correction, DerivedFormulas, Statement, Status, Verdict, near, proving, value_said};
use crate::dynamics::Dynamics;
use crate::error::Result;
use crate::formula::Expr;

const CHAPTER: &str = "10-viscous";

pub(crate) fn claims() -> Vec<Claim> {
    vec![energy_falls()]
}

/// Letters of the paper for one wheel, and of contacts by number for others.
const WHEEL: [(&str, &str); 6] = [
    ("contact_1.coefficient", "b_R"),
    ("contact_2.coefficient", "b_T"),
    ("wheel_torque", "tau"),
    ("body.mass", "m"),
    ("body.inertia", "I"),
    ("theta.inertia", "J"),
];

/// dE/dt along every motion that the derived equations allow, and the slips.
///
/// q̈ is free in it: what the equations make zero is taken off, multiplied with q̇, so that it holds whatever they are
/// solved for.
fn energy_rate(dynamics: &Dynamics, letters: &[(&str, &str)], slips: &[&str]) -> Result<DerivedFormulas> {
    let f = dynamics.formulas()?;
    let rate = along_motion(&dynamics.energy(), &dynamics.mechanism.coordinates);
    let work = residuals(&f).into_iter().zip(&f.coordinates);
    let work = work.map(|(residual, q)| &Expr::sym(q.rate()) * &residual).fold(Expr::int(0), |sum, e| &sum + &e);
    let derived = DerivedFormulas::default().with("E'", lettered(&(&rate - &work), letters));
    let named = slips.iter().zip(&f.slips);
    Ok(named.fold(derived, |m, (name, slip)| m.with(name, lettered(slip, letters))))
}

fn of(
    vehicle: &'static str,
    trailers: usize,
    forces: &[&str],
    letters: &[(&str, &str)],
    slips: &[&str],
) -> DerivedFormulas {
    machine_of(|| energy_rate(&viscous(vehicle, trailers, forces)?, letters, slips))
}

/// Contacts by number.
const NUMBERED: [(&str, &str); 5] = [
    ("contact_1.coefficient", "b_1"),
    ("contact_2.coefficient", "b_2"),
    ("contact_3.coefficient", "b_3"),
    ("contact_4.coefficient", "b_4"),
    ("wheel_torque", "tau"),
];
const SLIPS: [&str; 4] = ["slip_1", "slip_2", "slip_3", "slip_4"];

fn energy_falls() -> Claim {
    let wheel = of("unicycle", 0, &[], &WHEEL, &["v_A", "v_t"]);
    let driven = of("unicycle", 0, &["wheel_torque"], &WHEEL, &["v_A", "v_t"]);
    let sleigh = of("sleigh", 0, &[], &[("contact_1.coefficient", "b_T")], &["v_t"]);
    let disk = of("disk", 0, &["force", "wheel_torque"], &[WHEEL[0], WHEEL[2], ("force", "F")], &["v_A"]);
    // In few numbers: mass and inertia do not matter, and nothing pushes.
    let still = ["F", "tau", "s''", "theta''"].map(|name| (name, "0"));
    let slipping = still.iter().chain(&[("m", "1"), ("J", "1")]).fold(disk.clone(), |m, (n, v)| m.with_text(n, v));
    let robot = of("differential-drive", 0, &[], &NUMBERED, &SLIPS);
    let car = of("car", 1, &["wheel_torque"], &NUMBERED, &SLIPS);
    let rolling = machine_of(|| {
        let names = [("contact_1.force", "lambda_1"), ("contact_2.force", "lambda_2")];
        energy_rate(&ideal("unicycle", 0, &[])?, &names, &["v_A", "v_t"])
    });
    Claim::new("E22", Status::Corrected, "m·v² + I·ω_z² + J·ω² stays constant while the vehicle creeps")
        .at("section 4, simulation; (11), (18); errata E22")
        .corrects(Correction::FalseAsPrinted)
        .about(&[11, 18])
        .under("friction of (11) and (18), rigid bodies on a level plane; no forces but those named")
        .remark(
            "With the friction that makes it creep the kinetic energy falls by b_R·v_A² + b_T·v_t² each second. The rule \
             of the simulation can only be a way to choose comparable rates. Ideal contacts do no work, so that \
             without creep the sum is constant, as the paper says.",
        )
        .chapter(CHAPTER)
        .code(&["src/dynamics/derive.rs", "src/model/forces/bodies.rs", "src/model/forces/contact.rs"])
        .tests(&["tests/dynamics/energy.rs"])
        .refutation("a disk that slips", &[("E'", "0")], &[("E'", "-b_R*v_A^2")], proving(slipping))
        .proof("one wheel", &[("E'", "-b_R*v_A^2 - b_T*v_t^2")], proving(wheel))
        .proof("one wheel driven by a torque", &[("E'", "tau*theta' - b_R*v_A^2 - b_T*v_t^2")], proving(driven))
        .proof("the sleigh, mass ahead of the blade", &[("E'", "-b_T*v_t^2")], proving(sleigh))
        .proof("the disk, pushed and driven", &[("E'", "F*s' + tau*theta' - b_R*v_A^2")], proving(disk))
        .proof(
            "two driven wheels on an axle",
            &[("E'", "-b_1*slip_1^2 - b_2*slip_2^2 - b_3*slip_3^2")],
            proving(robot),
        )
        .proof(
            "a car with a trailer",
            &[("E'", "tau*theta' - b_1*slip_1^2 - b_2*slip_2^2 - b_3*slip_3^2 - b_4*slip_4^2")],
            proving(car),
        )
        .proof(
            "one wheel, ideal: forces times slips, and the slips are zero",
            &[("E'", "lambda_1*v_A + lambda_2*v_t")],
            proving(rolling),
        )
        .sample(
            "generated vehicles, simulated: energy at the end, less that at the start",
            &[("gained", "work + friction")],
            |s, sampling| sampling.one_in(10).cases(pushed(), Pushed::shown, |p| balance(s, p)),
        )
}

fn balance(s: &Statement, p: &Pushed) -> Verdict {
    let run = p.energies().map_err(|e| undefined(&e))?;
    let at = |name: &str| match name {
        "work" => Some(run.work),
        "friction" => Some(run.friction),
        _ => None,
    };
    near("the energy gained", run.gained, value_said(s, "gained", &at)?, 1e-6)
}
