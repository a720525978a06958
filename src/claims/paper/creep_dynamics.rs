//! Beyond section 8: creep dynamics, the motion under forces in the quasi-velocities of the ideal contacts.

use crate::claims::generated_forced::{Pushed, pushed};
use crate::claims::simulated::undefined;
use crate::claims::with_forces::{all_by, ideal, lettered, machine_of};
use crate::claims::{Claim, DerivedFormulas, Statement, Status, Verdict, near, proving, value_said};
use crate::dynamics::Dynamics;
use crate::error::{Error, Result};
use crate::formula::{Graph, Symbol};

const CHAPTER: &str = "10a-creep-dynamics";

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
        .code(&["src/model/forces/quasi_velocities.rs", "src/model/forces/lowering.rs", "src/model/forces/ldl_factors.rs"])
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
        let pairs = both(&p.dynamics(friction).map_err(|e| undefined(&e))?).map_err(|e| undefined(&e))?;
        for (name, found, other) in pairs {
            let at = |name: &str| (name == "lagrange").then_some(other);
            near(&name, found, value_said(s, "acceleration", &at)?, 1e-8)?;
        }
    }
    Ok(())
}

/// Accelerations by both ways at a state with every free rate different.
fn both(dynamics: &Dynamics) -> Result<Vec<(String, f64, f64)>> {
    let model = dynamics.model()?;
    let (system, equations) = (dynamics.compile()?, model.equations(&[])?);
    let z: Vec<f64> = (0..equations.n()).map(|i| 0.3 + 0.2 * (1.7 * i as f64).sin()).collect();
    let u: Vec<f64> = (0..equations.inputs.len()).map(|i| 0.2 + 0.1 * i as f64).collect();
    let mut rates = vec![0.0; equations.n()];
    equations.rates(&mut equations.workspace(&[]), &z, &u, &mut rates);
    let given = |s: &Symbol| {
        let of = |names: &[Symbol], values: &[f64]| names.iter().position(|n| n == s).map(|i| values[i]);
        of(&equations.states, &z).or_else(|| of(&equations.inputs, &u)).or_else(|| model.values().get(s).copied())
    };
    let values = model.definitions()?.evaluate(&given)?;
    let value = |s: &str| values.get(&s.into()).copied().or_else(|| given(&s.into())).unwrap_or(0.0);
    let there: Vec<f64> =
        system.states.iter().map(|s| if s.as_str() == "s'" { value("v_l") } else { value(s.as_str()) }).collect();
    let logged = &u[..equations.logged()];
    let slope_of =
        |i: usize| equations.inputs.iter().position(|n| *n == equations.inputs[i].rate()).map_or(0.0, |k| u[k]);
    let slopes: Vec<f64> = (0..logged.len()).map(slope_of).collect();
    let said = system.rates(&there, logged, &slopes);
    let of = |s: &str| system.states.iter().position(|n| n.as_str() == s).map(|i| said[i]);
    let ((sin, cos), yaw) = (value("phi").sin_cos(), value("phi'"));
    let along = || Some(of("x'")? * cos + of("y'")? * sin + yaw * value("v_t"));
    let across = || Some(of("y'")? * cos - of("x'")? * sin - yaw * value("v_l"));
    let mut found = Vec::new();
    for (name, rate) in equations.states.iter().zip(&rates) {
        let other = match name.as_str() {
            "body.u" => of("s'").or_else(along),
            "body.w" => across(),
            "body.omega" => of("phi'"),
            other => match other.strip_suffix(".omega") {
                Some(turns) => of(&format!("{}'", turns.replace("trailer_", "phi_"))),
                None => continue,
            },
        };
        let other = other.ok_or_else(|| Error::run(format!("the other equations have no {name}")))?;
        found.push((name.to_string(), *rate, other));
    }
    Ok(found)
}
