//! Sentences of the paper that print no formula: what causes creep, what feedback repairs, what Fig. 7 is said to show.

use super::laws::law;
use super::viscous::disk_machine;
use crate::claims::with_forces::machine_of;
use crate::claims::{Claim, Correction, DerivedFormulas, Domain, Sampling, Statement, Status, at_points, proving};
use crate::formula::Expr;

pub(crate) fn claims() -> Vec<Claim> {
    vec![flexibility(), accelerating(), circle(), feedback()]
}

fn flexibility() -> Claim {
    let names = [("slip", "v_t"), ("speed", "v"), ("deflection", "x_c"), ("relaxation_length", "1/k_g")];
    let rate = law("elastic", |l| l.rate.clone(), &names);
    let stiffness = [("stiffness", "k_r"), ("relaxation_length", "1/k_g"), ("deflection", "x_c")];
    // The deflection at which a steady force f is carried.
    let derived = DerivedFormulas::default()
        .with("rest", rate)
        .with("force", law("elastic", |l| Some(l.force.clone()), &stiffness))
        .with_text("x_c", "f/(k_r*k_g)")
        .with_text("v_t", "e_tc*v")
        .with_text("e_tc", "-f/k_r");
    let points: &[(&str, Domain)] =
        &[("k_r", Domain::Positive), ("k_g", Domain::Positive), ("v", Domain::Positive), ("f", Domain::Nonzero)];
    Claim::new(
        "flexibility",
        Status::Sampled,
        "a flexible contact creeps under a steady force: e_tc = −f/k_r, in proportion to the force and to its softness 1/k_r",
    )
    .at("section 1: the system flexibilities affect the constraints in an elastic manner; remarks of sections 2 and 3, Figs. 3 and 5: torsion and bending as causes")
    .under("v > 0; the elastic law, a spring that the rolling contact carries away, when its deflection no longer changes")
    .remark("The stiffer, the less creep; what rolls does not return what it deflected, so that even an elastic cause displaces the vehicle for good. The torsion of Fig. 3 and the bending of Fig. 5 are such softness; the shape of a wheel under them is drawn, and the paper prints no equation of it.")
    .chapter("10-viscous")
    .code(&["src/model/forces/law.rs"])
    .tests(&["tests/dynamics/laws.rs"])
    .sample(
        "the force of the spring, and that its deflection stays where the contact slides with e_tc·v",
        &[("force", "f"), ("rest", "0"), ("v_t", "-f/k_r*v")],
        move |s, sampling| at_points(&derived, s, points, sampling),
    )
}

/// A disk from rest: the slip that a steady force or torque ends in, and the acceleration then.
fn driven_disk(force: &str, torque: &str) -> DerivedFormulas {
    machine_of(disk_machine)
        .with_text("F", force)
        .with_text("tau", torque)
        .with_text("v_A", "(F/m - r*tau/J)/(b*(1/m + r^2/J))")
}

fn accelerating() -> Claim {
    let points: &'static [(&str, Domain)] = &[
        ("m", Domain::Positive),
        ("J", Domain::Positive),
        ("r", Domain::Positive),
        ("b", Domain::Positive),
        ("p", Domain::Positive),
        ("v", Domain::Any),
    ];
    let asked = |disk: DerivedFormulas| move |s: &Statement, sampling: &Sampling| at_points(&disk, s, points, sampling);
    let (pushed, driven) = (asked(driven_disk("p", "0")), asked(driven_disk("0", "p")));
    Claim::new("accelerating", Status::Corrected, "backward-creep takes place at the acceleration stage")
        .at("section 2: \"this often takes place at the acceleration stage\"")
        .corrects(Correction::LacksHypothesis)
        .under("driven by a torque at the wheel; viscous friction, from rest, when the slip no longer changes")
        .remark(
            "A disk that is pushed at its centre accelerates in forward-creep: friction has to spin it up. The paper says often, \
             and for driven wheels it is always; braking turns both round.",
        )
        .chapter("02-rotation-creep")
        .code(&["src/dynamics/derive.rs"])
        .tests(&["tests/dynamics/derived.rs"])
        .refutation("a pushed disk: the contact moves backward while it accelerates", &[("sign(v_A*v')", "-1")], &[("sign(v_A*v')", "1")], pushed)
        .sample("a disk driven by a torque: it does", &[("sign(v_A*v')", "-1")], driven)
}

fn circle() -> Claim {
    // B is ρ to the left of the blade; ρ = v_l/ω_z stays.
    let derived = DerivedFormulas::of("unicycle")
        .with_text("e_tc", "e")
        .with_text("rho", "v_l/phi'")
        .with_text("x_B'", "x' - rho*cos(phi)*phi'")
        .with_text("y_B'", "y' - rho*sin(phi)*phi'");
    let ideal = derived.clone().with_text("e_tc", "0");
    Claim::new("circle-about-B", Status::Proved, "the ideal sleigh moves along a circle about B, v_l/ω_z to its left; with creep B itself moves sideways with v_t")
        .at("section 3, Fig. 4: the dashed circle with the centre at B and the radius v_l/ω_z")
        .under("v_l/ω_z constant and ω_z ≠ 0")
        .chapter("03-traverse-creep")
        .code(&["src/model/build.rs", "src/figures/fig4.rs"])
        .tests(&["tests/mechanism/motion.rs"])
        .proof("velocity of B without creep", &[("x_B'", "0"), ("y_B'", "0")], proving(ideal))
        .proof("velocity of B with creep", &[("x_B'", "-e*v_l*sin(phi)"), ("y_B'", "e*v_l*cos(phi)")], proving(derived))
}

/// A wheel whose point P, l ahead of its axle, is seen and led along the line y = 0 with the speed V: the commanded velocity
/// of P is (V + k·ε_x, k·ε_y), turned into rates by the ideal model.
fn led() -> DerivedFormulas {
    DerivedFormulas::of("unicycle")
        .with_text("u_x", "V + k*eps_x")
        .with_text("u_y", "k*eps_y")
        .with_text("theta'", "(u_x*cos(phi) + u_y*sin(phi))/r")
        .with_text("phi'", "(u_y*cos(phi) - u_x*sin(phi))/l")
        .with_text("eps_x'", "V - (x' - l*sin(phi)*phi')")
        .with_text("eps_y'", "-(y' + l*cos(phi)*phi')")
}

fn feedback() -> Claim {
    let ideal = led().with_text("e_rc", "0").with_text("e_tc", "0");
    let rest = ideal.clone().with_text("eps_x", "0").with_text("eps_y", "0");
    let resting = led()
        .with_text("e_tc", "-tan(phi)")
        .with_text("eps_x", "V/k*(1/((1 - e_rc)*(1 + e_tc^2)) - 1)")
        .with_text("eps_y", "-V/k*e_tc/((1 - e_rc)*(1 + e_tc^2))");
    let blind = DerivedFormulas::of("unicycle").with_text("theta'", "V/r").with_text("phi", "0");
    let by_phi = rest.written_out("phi'").derivative(&"phi".into());
    let slope = by_phi.substitute(&|s| (s.as_str() == "phi").then(|| Expr::int(0)));
    Claim::new(
        "vision-feedback",
        Status::Proved,
        "feedback from where the robot is seen compensates creep up to a steady offset, V/k times the creep; from actuator signals alone the miss grows without end, by |κ − 1|·V each second",
    )
    .at("section 1: \"this mismatch can be compensated through visual feedback\"; section 4: \"a mobile robot with only actuator signals will incur considerable motion mismatch\"")
    .under("a point l ahead of the axle is led along a line at the speed V by u = V + k·ε on the ideal model; constant coefficients, e_rc < 1; the state at rest attracts for small creep, as its slopes −k, −k, −V/l at no creep are negative")
    .remark("A gain of 1/s and a speed of 1 m/s leave 0.1 m of offset for e_tc = 0.1, which only the model with creep removes; the heading stays off by arctan e_tc whatever the gain.")
    .chapter("09-planning")
    .code(&["src/model/build.rs"])
    .tests(&["tests/mechanism/motion.rs"])
    .proof(
        "without creep every error decays with the gain, and the heading turns into the line",
        &[("eps_x'", "-k*eps_x"), ("eps_y'", "-k*eps_y")],
        proving(ideal),
    )
    .proof("the slope of φ̇ by φ without creep on the line", &[("slope", "-V/l")], proving(DerivedFormulas::default().with("slope", slope)))
    .proof("with creep, the state at rest, φ = −arctan e_tc: the errors stay, and the robot moves with V along the line", &[("eps_x'", "0"), ("eps_y'", "0"), ("phi'", "0")], proving(resting))
    .sabotaged_by(&[&[("eps_x'", "V")], &[("eps_y'", "k*eps_y")], &[("phi'", "V/l")]])
    .proof(
        "from actuator signals alone: the miss each second, along and across",
        &[("x' - V", "-e_rc*V"), ("y'", "(1 - e_rc)*e_tc*V")],
        proving(blind),
    )
}
