//! A trailer that is towed straight ahead; corrected theorem (c).

use super::trailers::{base, courses};
use crate::claims::simulated::{driven, model, undefined};
use crate::claims::{Claim, DerivedFormulas, Outcome, Sampling, Statement, near, prove, proving, value_said};
use crate::formula::Expr;
use crate::model::Trailer;

/// The slope of γ̇ by γ at the course at rest and at the opposite one; γ = φ − φ_1 + α_0 − α_1.
fn slopes() -> DerivedFormulas {
    let towed = courses(1).with_text("phi'", "0");
    // γ̇ = −φ̇_1 and dγ = −dφ_1.
    let slope = towed.written_out("phi_1'").derivative(&"phi_1".into());
    let at = |course: &str| {
        let place = Expr::parse(course).unwrap_or_default();
        slope.substitute(&|s| (s.as_str() == "phi_1").then(|| place.clone()))
    };
    courses(1)
        .with("slope_there", at("phi + alpha_0 - alpha_1"))
        .with("slope_opposite", at("phi + alpha_0 - alpha_1 + 2*(2*atan(1))"))
}

pub(crate) fn claims() -> Vec<Claim> {
    const PLACE: &str = "corrected theorem (c), straight towing";
    let straight = || courses(1).with_text("phi'", "0").with_text("gamma", "phi - phi_1 + alpha_0 - alpha_1");
    vec![
        base(
            "straight-towing",
            "towed straight ahead the angle decays as tan(γ/2) = tan(γ₀/2)·e^(−k·t), k = v_l/(d·cos α₀·cos α₁)",
            PLACE,
        )
        .under("constant creep, constant heading of the tractor, hitch on the axle, one trailer")
        .proof(
            "γ = β + α₀ − α₁ obeys γ̇ = −k·sin γ",
            &[("-phi_1'", "-v_l/(d_1*cos(alpha_0)*cos(alpha_1))*sin(gamma)")],
            move |s, _| prove(&straight(), s),
        )
        .proof("so that T = tan(γ/2) obeys Ṫ = −k·T", &[("(1 + T^2)/2*gamma'", "-k*T")], |s, _| {
            prove(&DerivedFormulas::default().with_text("gamma'", "-k*2*T/(1 + T^2)"), s)
        })
        .confirmation(
            "simulated towing against the closed form",
            &[("T", "T_0*exp(-v*t/(d*cos(a_0)*cos(a_1)))")],
            simulated_towing,
        ),
        base("towing-equilibrium", "a trailer towed straight settles at β* = α₁ − α₀: its heading does not turn there, and what is off decays with k = v_l/(d·cos α₀·cos α₁) > 0; from the opposite course, γ = π, it turns away", PLACE)
            .under("as for straight towing, v_l > 0")
            .remark("Pushed, v_l < 0, the two places change their parts. By `straight-towing` every course but γ = π ends at β*, for tan(γ/2) decays.")
            .proof("its heading does not turn there", &[("phi_1'", "0")], |s, _| {
                prove(&courses(1).with_text("phi'", "0").with_text("phi_1", "phi + alpha_0 - alpha_1"), s)
            })
            .sabotaged_by(&[&[("phi_1'", "1")], &[("phi_1'", "v_l/d_1")]])
            .proof(
                "the slope of γ̇ by γ there, and at the opposite course; k by its factors",
                &[
                    ("slope_there", "-v_l/(d_1*cos(alpha_0)*cos(alpha_1))"),
                    ("slope_opposite", "v_l/(d_1*cos(alpha_0)*cos(alpha_1))"),
                ],
                proving(slopes()),
            )
            .proof("(T²)' with Ṫ = −k·T: the distance falls wherever k > 0", &[("2*T*T'", "-2*k*T^2")], |s, _| {
                prove(&DerivedFormulas::default().with_text("T'", "-k*T"), s)
            }),
    ]
}

fn simulated_towing(s: &Statement, sampling: &Sampling) -> Outcome {
    let cases = (-0.3..0.3f64, -0.3..0.3f64, -2.0..2.0f64, 0.5..4.0f64, 0.3..4.0f64, 0.5..2.0f64);
    let show = |c: &(f64, f64, f64, f64, f64, f64)| {
        let names = ["e_0", "e_1", "beta", "d", "t", "v"];
        names.iter().zip([c.0, c.1, c.2, c.3, c.4, c.5]).map(|(n, v)| (n.to_string(), v.to_string())).collect()
    };
    sampling.one_in(4).cases(cases, show, |&(e_0, e_1, beta, d, t, v)| {
        let creeps = [("traverse-creep", None, vec![e_0]), ("trailer-traverse-creep", Some(1), vec![e_1])];
        let train = model("unicycle", &[("wheel_radius", 0.5)], &[Trailer { length: d, hitch: 0.0 }], &creeps);
        let inputs = [("wheel_rate", "2*c_0"), ("yaw_rate", "0")];
        let train = train.map_err(|e| undefined(&e))?;
        let path = driven(&train, &inputs, &[v], &[0.0, 0.0, 0.4, 0.4 - beta], &[0.0, t]).map_err(|e| undefined(&e))?;
        let (a_0, a_1) = (e_0.atan(), e_1.atan());
        let half_tangent = |beta: f64| ((beta + a_0 - a_1) / 2.0).tan();
        let at = |name: &str| match name {
            "T_0" => Some(half_tangent(beta)),
            "v" => Some(v),
            "t" => Some(t),
            "d" => Some(d),
            "a_0" => Some(a_0),
            "a_1" => Some(a_1),
            _ => None,
        };
        near("T", half_tangent(0.4 - path[1][3]), value_said(s, "T", &at)?, 1e-8)
    })
}
