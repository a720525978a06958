//! Theory, Jacobians of the constraints: first and second derivatives by dual numbers against what each contact does.

use crate::claims::generated::{Contact, Moving, moving};
use crate::claims::{Claim, Fault, Statement, Status, Verdict, near, value_said};
use crate::formula::{Exact, Symbol};
use crate::mechanism::{Constraint, DualJacobian, Point};

pub(crate) fn claims() -> Vec<Claim> {
    vec![jacobian()]
}

fn jacobian() -> Claim {
    Claim::new(
        "jacobian-dual",
        Status::Sampled,
        "the derivatives of every row by dual numbers: ∂g/∂e is r·θ̇ of type R and the speed along the contact of type T, \
         ∂²g/∂e² = 0, and the gradient by the rates times the rates is g",
    )
    .at("theory, Jacobians of types R and T")
    .about(&[13, 21])
    .under("any contact of any generated vehicle in any motion, creeping as it may")
    .remark(
        "The dual numbers are those of the crate num-dual, pushed through the row itself; no rule of differentiation is used. \
         What the contact does comes from places and rates alone.",
    )
    .chapter("03b-singularity-free")
    .code(&["src/mechanism/dual_jacobian.rs", "src/formula/dual.rs"])
    .tests(&["tests/formula/derivatives.rs"])
    .sample(
        "contacts of generated vehicles with trailers",
        &[
            ("R.g", "along - r*(1 - e)*rate"),
            ("R.by_e", "r*rate"),
            ("T.g", "e*along - across"),
            ("T.by_e", "along"),
            ("by_e_twice", "0"),
        ],
        |s, sampling| sampling.one_in(2).cases(moving(2, 2), Moving::shown, |m| contacts_agree(s, m)),
    )
}

fn contacts_agree(s: &Statement, motion: &Moving) -> Verdict {
    let (mechanism, at) = (motion.vehicle.mechanism(), motion.vehicle.point());
    for (k, contact) in motion.contacts().iter().enumerate() {
        // A coefficient for each contact, none of them zero.
        let e = 0.3 - 0.07 * k as f64;
        let rolling = contact.rolls.as_ref().map(|(_, _, name)| ("R", name));
        let directed = contact.directed.as_ref().map(|name| ("T", name));
        for (kind, name) in [rolling, directed].into_iter().flatten() {
            let constraint = mechanism.constraints.iter().find(|c| c.creep == *name);
            let constraint = constraint.ok_or_else(|| Fault::Undefined(format!("no row has {name}")))?;
            agrees(s, kind, &derived(constraint, &mechanism.coordinates, motion, &at, e)?, contact, e)?;
        }
    }
    Ok(())
}

fn derived(
    constraint: &Constraint,
    coordinates: &[Symbol],
    motion: &Moving,
    at: &Point,
    e: f64,
) -> Result<DualJacobian, Fault> {
    let number = |v: Exact| Some(v.to_f64()).filter(|v| v.is_finite());
    let value = |name: &Symbol| match name == &constraint.creep {
        true => Some(e),
        false => motion.rate(name).and_then(number).or_else(|| number(at.value(name))),
    };
    DualJacobian::of(constraint, coordinates, &value).map_err(|e| Fault::Undefined(e.to_string()))
}

fn agrees(s: &Statement, kind: &str, found: &DualJacobian, contact: &Contact, e: f64) -> Verdict {
    let at = |name: &str| match (name, &contact.rolls) {
        ("along", _) => Some(contact.along.to_f64()),
        ("across", _) => Some(contact.across.to_f64()),
        ("e", _) => Some(e),
        ("r", Some((radius, ..))) => Some(radius.to_f64()),
        ("rate", Some((_, rate, _))) => Some(rate.to_f64()),
        _ => None,
    };
    let n = found.variables.len();
    let by_e = found.gradient[n - 1];
    let rates = (n - 1) / 2..n - 1;
    // g is linear in the rates: the value of the row is its gradient by them times them.
    let along_rates: f64 = rates.map(|i| found.gradient[i] * found.point[i]).sum();
    near("the gradient times the rates", along_rates, found.value, 1e-12)?;
    near(&format!("{kind}.g"), found.value, value_said(s, &format!("{kind}.g"), &at)?, 1e-11)?;
    near(&format!("{kind}.by_e"), by_e, value_said(s, &format!("{kind}.by_e"), &at)?, 1e-11)?;
    near("by_e_twice", found.hessian[(n - 1, n - 1)], value_said(s, "by_e_twice", &at)?, 1e-11)
}
