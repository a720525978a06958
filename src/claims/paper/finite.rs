//! Finite motions and their limits, (5)–(7) and (15)–(16), on simulated runs of the single wheel.

use super::domain::{disk_coefficient, undefined_exactly_where};
use crate::claims::simulated::{Creep, driven, model, undefined};
use crate::claims::{
    Claim, Correction, DerivedFormulas, Fault, Outcome, Sampling, Statement, Status, Verdict, near, proving, value_said,
};
use crate::error::Result;
use proptest::prelude::*;

const CHAPTER: &str = "02-rotation-creep";

pub(crate) fn claims() -> Vec<Claim> {
    vec![
        Claim::new("eq-5", Status::Sampled, "the angle of rotation creep θ_rc = θ − θ₁ with d = r·θ₁")
            .at("section 2, (5)–(6), the rotational pair (d, θ)")
            .about(&[5, 6])
            .under("constant e_rc; any wheel rate")
            .chapter(CHAPTER)
            .code(&["src/motion/trajectory.rs"])
            .tests(&["tests/motion/kinematics.rs"])
            .sample(
                "displacements of simulated disks: (d, θ) is proportional, a rotational pair",
                &[("d", "r*theta*(1 - e_rc)"), ("theta_rc", "theta*e_rc")],
                rotational_pair,
            ),
        Claim::new("eq-7", Status::Sampled, "e_rc is the limit of θ_rc/θ for θ → 0, also when it changes on the way")
            .at("section 2, (7)")
            .about(&[7])
            .under("the disk turns: ω ≠ 0")
            .chapter(CHAPTER)
            .code(&["src/motion/trajectory.rs"])
            .tests(&["tests/motion/sensitivity.rs"])
            .sample(
                "finite motions of disks driven through a viscous contact, in ever shorter times: the quotient tends \
                 to the coefficient with the first power of the time",
                &[("limit", "1 - v_l/(r*omega)"), ("order", "1")],
                rotation_limit,
            ),
        from_rest(),
    ]
}

/// Constant accelerations from rest: v_l = a·t and ω = g·t.
fn from_rest() -> Claim {
    let rest = DerivedFormulas::default().with_text("d", "a*t^2/2").with_text("theta", "g*t^2/2");
    Claim::new("start-from-rest", Status::Corrected, "the definitions (7) and (8) are equivalent")
        .at("section 2, (7)–(8); also (16)–(17)")
        .corrects(Correction::LacksHypothesis)
        .about(&[7, 8, 16, 17])
        .under("ω ≠ 0, resp. v_l ≠ 0; then they are")
        .remark(
            "At a start from rest the limits exist, 1 − a/(r·g) for accelerations a of the disk and g of its rolling, \
             while the quotients of velocities are 0/0. This is none of the numbered errata.",
        )
        .chapter(CHAPTER)
        .code(&["src/mechanism/regime/rotation.rs"])
        .refutation(
            "the coefficient of velocities is there whenever the limit is, that is for r·g ≠ 0",
            &[("e_rc", "r*g")],
            &[("e_rc", "r*g*t")],
            |s, _| undefined_exactly_where(&disk_coefficient().with_text("v_l", "a*t").with_text("omega", "g*t"), s),
        )
        .on_domains()
        .proof(
            "θ_rc/θ is the same for all t, and so is its limit",
            &[("(theta - d/r)/theta", "1 - a/(r*g)")],
            proving(rest),
        )
}

/// A case: radius, creep, constants of the drive, duration.
type Case = (f64, f64, Vec<f64>, f64);

fn cases() -> impl Strategy<Value = Case> {
    (0.1..1.0f64, -0.3..0.3f64, prop::collection::vec(-1.0..1.0f64, 4), 0.5..3.0f64)
}

fn shown((r, e, c, t): &Case) -> Vec<(String, String)> {
    let mut shown = vec![("r".into(), r.to_string()), ("e".into(), e.to_string()), ("t".into(), t.to_string())];
    shown.extend(c.iter().enumerate().map(|(i, v)| (format!("c_{i}"), v.to_string())));
    shown
}

/// θ(t) = (3 + c_0)·t + c_1/2·sin(2t), and its rate, which is never below 1.
fn angle(c: &[f64], t: f64) -> f64 {
    (3.0 + c[0]) * t + c[1] / 2.0 * (2.0 * t).sin()
}
const RATE: &str = "3 + c_0 + c_1*cos(2*t)";

fn rate(c: &[f64], t: f64) -> f64 {
    3.0 + c[0] + c[1] * (2.0 * t).cos()
}

/// The wheel at given times, heading rate as a formula; states are x, y, phi and those of the effect.
fn wheel(r: f64, effect: Creep, yaw_rate: &str, c: &[f64], start: &[f64], times: &[f64]) -> Result<Vec<Vec<f64>>> {
    let wheel = model("unicycle", &[("wheel_radius", r)], &[], &[effect])?;
    driven(&wheel, &[("wheel_rate", RATE), ("yaw_rate", yaw_rate)], c, start, times)
}

/// (d, θ) of a wheel with constant rotation creep.
pub(crate) fn rotational_pair(s: &Statement, sampling: &Sampling) -> Outcome {
    sampling.one_in(4).cases(cases(), shown, |(r, e, c, t)| {
        let path = wheel(*r, ("rotation-creep", None, vec![*e]), "0", c, &[0.0; 3], &[0.0, *t]);
        let d = path.map_err(|e| undefined(&e))?[1][0];
        let theta = angle(c, *t);
        let at = |name: &str| match name {
            "r" => Some(*r),
            "theta" => Some(theta),
            "e_rc" => Some(*e),
            _ => None,
        };
        near("d", d, value_said(s, "d", &at)?, 1e-9)?;
        near("theta_rc", theta - d / r, value_said(s, "theta_rc", &at)?, 1e-9)
    })
}

/// (ξ, η) of a wheel with constant traverse creep and constant heading.
pub(crate) fn traverse_pair(s: &Statement, sampling: &Sampling) -> Outcome {
    sampling.one_in(4).cases(cases(), shown, |(r, e, c, t)| {
        let heading = c[2];
        let path = wheel(*r, ("traverse-creep", None, vec![*e]), "0", c, &[0.0, 0.0, heading], &[0.0, *t]);
        let path = path.map_err(|e| undefined(&e))?;
        let (xi, eta) = moving_frame(&path[0], &path[1]);
        let at = |name: &str| match name {
            "xi" => Some(xi),
            "e_tc" => Some(*e),
            _ => None,
        };
        near("eta", eta, value_said(s, "eta", &at)?, 1e-9)
    })
}

/// The displacement from one state to another in the moving system of the first.
fn moving_frame(from: &[f64], to: &[f64]) -> (f64, f64) {
    let (dx, dy, (sin, cos)) = (to[0] - from[0], to[1] - from[1], from[2].sin_cos());
    (cos * dx + sin * dy, -sin * dx + cos * dy)
}

/// Shares of a second over which a quotient is taken, each half of the one before.
const SPANS: [f64; 3] = [4e-4, 2e-4, 1e-4];

/// θ_rc/θ over shorter and shorter times, of a wheel that pushes through a viscous contact.
pub(crate) fn rotation_limit(s: &Statement, sampling: &Sampling) -> Outcome {
    sampling.one_in(4).cases(cases(), shown, |(r, e, c, t)| {
        let effect = ("traction-creep", None, vec![0.05 + e.abs()]);
        let mut times = vec![0.0, *t];
        times.extend(SPANS.iter().rev().map(|h| t + h));
        let path = wheel(*r, effect, "0", c, &[0.0, 0.0, 0.0, 0.5], &times).map_err(|e| undefined(&e))?;
        let (v, omega) = (path[1][3], rate(c, *t));
        let quotient = |k: usize| {
            let theta = angle(c, t + SPANS[SPANS.len() - 1 - k]) - angle(c, *t);
            let d = path[2 + k][0] - path[1][0];
            (theta - d / r) / theta
        };
        let at = |name: &str| match name {
            "v_l" => Some(v),
            "r" => Some(*r),
            "omega" => Some(omega),
            _ => None,
        };
        tends([quotient(2), quotient(1), quotient(0)], value_said(s, "limit", &at)?, s)
    })
}

/// η/ξ over shorter and shorter times, of a wheel held sideways by a viscous contact.
pub(crate) fn traverse_limit(s: &Statement, sampling: &Sampling) -> Outcome {
    sampling.one_in(4).cases(cases(), shown, |(r, e, c, t)| {
        let effect = ("cornering-creep", None, vec![0.05 + e.abs()]);
        let mut times = vec![0.0, *t];
        times.extend(SPANS.iter().rev().map(|h| t + h));
        let path =
            wheel(*r, effect, "1 + c_2*sin(3*t)", c, &[0.0, 0.0, 0.3, 0.1], &times).map_err(|e| undefined(&e))?;
        let (v_l, v_t) = (r * rate(c, *t), path[1][3]);
        let quotient = |k: usize| {
            let (xi, eta) = moving_frame(&path[1], &path[2 + k]);
            eta / xi
        };
        let at = |name: &str| match name {
            "v_l" => Some(v_l),
            "v_t" => Some(v_t),
            _ => None,
        };
        tends([quotient(2), quotient(1), quotient(0)], value_said(s, "limit", &at)?, s)
    })
}

/// Whether quotients over times that are halved tend to a limit with the order that the statement says.
fn tends(q: [f64; 3], limit: f64, s: &Statement) -> Verdict {
    let order = ((q[0] - q[1]) / (q[1] - q[2])).abs().log2();
    // What is left of the first order is taken out; the second order of these times stays.
    near("the limit", 2.0 * q[2] - q[1], limit, 1e-4)?;
    // Where the first order happens to be small the order cannot be read off.
    if (q[0] - q[1]).abs() < 1e-6 || (q[0] - 3.0 * q[1] + 2.0 * q[2]).abs() > 0.05 * (q[0] - q[1]).abs() {
        return Err(Fault::Outside);
    }
    let said = s.number("order").unwrap_or(f64::NAN);
    near("the order", order, said, 0.1)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is made of quotients 1 + a·h + b·h² over the times 4, 2, 1.
    fn told(a: f64, b: f64) -> Verdict {
        let s = Statement::parse(&[("order", "1")]).unwrap();
        tends([4.0, 2.0, 1.0].map(|h| 1.0 + a * h + b * h * h), 1.0, &s)
    }

    #[test]
    fn an_order_is_read_off_where_it_shows() {
        assert!(told(1e-3, 0.0).is_ok() && told(-1e-3, 1e-6).is_ok());
        assert!(matches!(told(1e-7, 0.0), Err(Fault::Outside)));
        assert!(matches!(told(1e-4, 5e-6), Err(Fault::Outside)));
        assert!(matches!(told(0.0, 0.01), Err(Fault::False(_))));
    }

    #[test]
    fn the_bounds_of_what_shows_belong_to_it() {
        let s = Statement::parse(&[("order", "1")]).unwrap();
        assert!(tends([1e-6, 0.0, -5e-7], -1e-6, &s).is_ok());
        assert!(tends([20.0, 0.0, -9.5], -19.0, &s).is_ok());
    }
}
