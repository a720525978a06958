//! Beyond section 8: creep dynamics, the motion under forces in the quasi-velocities of the ideal contacts.

use crate::claims::generated_forced::{Pushed, pushed};
use crate::claims::simulated::undefined;
use crate::claims::with_forces::{all_by, ideal, lettered, machine_of};
use crate::claims::{Claim, DerivedFormulas, Statement, Status, Verdict, near, proving, value_said};
use crate::dynamics::Dynamics;
use crate::error::{Error, Result};
use crate::formula::Graph;

pub(super) const CHAPTER: &str = "10a-creep-dynamics";

pub(crate) fn claims() -> Vec<Claim> {
    vec![quasi_velocities()]
}

/// Letters for the names of the program.
const LETTERS: [(&str, &str); 9] = [
    ("stated.body.mass", "m"),
    ("stated.body.inertia", "I"),
    ("stated.body.mass_offset", "a"),
    ("stated.theta.inertia", "J"),
    ("stated.contact_1.coefficient", "b"),
    ("body.u", "u"),
    ("body.w", "w"),
    ("body.omega", "omega"),
    ("wheel_radius", "r"),
];

/// The accelerations of some quasi-velocities with everything written out; what is zero of it is gone.
fn accelerations(dynamics: &Dynamics, of: &[(&str, &str)]) -> Result<DerivedFormulas> {
    let mut graph = Graph::default();
    dynamics.model()?.definitions()?.insert_into(&mut graph)?;
    let mut found = DerivedFormulas::default();
    for (letter, name) in of {
        let rate = graph.definition(&(*name).into());
        let rate = rate.ok_or_else(|| Error::run(format!("nothing defines {name}")))?;
        found = found.with(letter, lettered(&graph.expr(rate), &LETTERS));
    }
    Ok(found)
}

const SLEIGH: [(&str, &str); 2] = [("u'", "body.u'"), ("omega'", "body.omega'")];
const SLIDING: [(&str, &str); 3] = [("u'", "body.u'"), ("w'", "body.w'"), ("omega'", "body.omega'")];

fn quasi_velocities() -> Claim {
    let sleigh = machine_of(|| accelerations(&ideal("sleigh", 0, &[])?, &SLEIGH));
    let sliding = machine_of(|| accelerations(&all_by("viscous", &[1.0], "sleigh", 0, &[])?, &SLIDING));
    let pushed_sleigh = machine_of(|| accelerations(&ideal("sleigh", 0, &["force", "yaw_torque"])?, &SLEIGH));
    let disk = machine_of(|| accelerations(&ideal("disk", 0, &["wheel_torque"])?, &[("u'", "body.u'")]));
    Claim::new("quasi-velocities", Status::Sampled, "the motion under forces in the rates that ideal contacts leave free")
        .at("section 8: \"the development of creep dynamics is underway\"; (11), (18), (22)-(23)")
        .about(&[11, 18, 22, 23])
        .under("rigid bodies on a level plane; contacts ideal or with a law of force")
        .remark(
            "With the ideal contacts solved for the rates that they bind, Kane's equations in the axes of the bodies are \
             as many as the vehicle has free rates, their mass matrix is positive definite, and the heading is in none of \
             them. They have the accelerations of Lagrange's equations with multipliers, which the program derives by \
             itself.",
        )
        .chapter(CHAPTER)
        .code(&["src/model/forces/quasi_velocities.rs", "src/model/forces/lowering.rs", "src/model/forces/kinetic_energy.rs", "src/model/forces/ldl_factors.rs"])
        .tests(&["tests/dynamics/lowered.rs"])
        .proof(
            "Caplygin's sleigh",
            &[("u'", "a*omega^2"), ("omega'", "-m*a*u*omega/(I + m*a^2)")],
            proving(sleigh),
        )
        .proof(
            "the sleigh, pushed and turned",
            &[("u'", "force/m + a*omega^2"), ("omega'", "(yaw_torque - m*a*u*omega)/(I + m*a^2)")],
            proving(pushed_sleigh),
        )
        .proof(
            "the sleigh on a viscous blade",
            &[
                ("u'", "w*omega + a*omega^2"),
                ("w'", "-b*w/m - u*omega - a^2*b*w/I"),
                ("omega'", "a*b*w/I"),
            ],
            proving(sliding),
        )
        .proof("the disk, driven", &[("u'", "r*wheel_torque/(m*r^2 + J)")], proving(disk))
        .sample(
            "generated vehicles with trailers, ideal or sliding, at their start: accelerations of both",
            &[("acceleration", "lagrange")],
            |s, sampling| sampling.cases(pushed(), Pushed::shown, |p| alike(s, p)),
        )
}

/// Largest difference between the accelerations in quasi-velocities and those of Lagrange's equations.
fn alike(s: &Statement, p: &Pushed) -> Verdict {
    for friction in [None, Some(p.friction())] {
        let dynamics = p.dynamics(friction).map_err(|e| undefined(&e))?;
        let state = |i: usize| 0.3 + 0.2 * (1.7 * i as f64).sin();
        let pairs = dynamics.both_formulations(state, |i| 0.2 + 0.1 * i as f64, |i| 0.3 - 0.1 * i as f64);
        for (name, found, other) in pairs.map_err(|e| undefined(&e))? {
            let at = |name: &str| (name == "lagrange").then_some(other);
            near(name.as_str(), found, value_said(s, "acceleration", &at)?, 1e-8)?;
        }
    }
    Ok(())
}
