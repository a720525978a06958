//! Section 4: a car with N trailers; corrected theorem (c).

use super::domain::undefined_exactly_where;
use crate::claims::simulated::{driven, model, undefined};
use crate::claims::{Claim, DerivedFormulas, Outcome, Sampling, Statement, Status, near, prove, proving, value_said};
use crate::model::Trailer;

const CHAPTER: &str = "06-trailers";
const BUILD: &str = "src/model/build.rs";

/// A wheel with trailers; creeps free, v_t = e_0·v_l of the tractor.
fn train(n: usize) -> DerivedFormulas {
    DerivedFormulas::train("unicycle", n).with_text("e_tc", "e_0")
}

/// Hitches on the axles.
fn on_axle(n: usize) -> DerivedFormulas {
    (1..=n).fold(train(n), |m, i| m.with_text(&format!("c_{i}"), "0"))
}

/// Creeps by their angles, e_i = tan α_i, hitches on the axles; V_i and χ_i as in the theory.
fn courses(n: usize) -> DerivedFormulas {
    let derived = on_axle(n).with_text("e_0", "tan(alpha_0)").with_text("chi_0", "phi + alpha_0");
    let derived = derived.with_text("V_0", "v_l/cos(alpha_0)");
    (1..=n).fold(derived, |m, i| {
        m.with_text(&format!("e_tc_{i}"), &format!("tan(alpha_{i})"))
            .with_text(&format!("chi_{i}"), &format!("phi_{i} + alpha_{i}"))
            .with_text(&format!("V_{i}"), &format!("v_{i}/cos(alpha_{i})"))
    })
}

pub(crate) fn claims() -> Vec<Claim> {
    [recursion(), towing()].concat()
}

fn base(id: &str, says: &str, place: &str) -> Claim {
    Claim::new(id, Status::Proved, says)
        .at(place)
        .chapter(CHAPTER)
        .code(&[BUILD])
        .tests(&["tests/motion/kinematics.rs"])
}

fn recursion() -> Vec<Claim> {
    const PLACE: &str = "section 4, second theorem; corrected theorem (c)";
    vec![
        base("trailer-recursion", "each axle follows from the one ahead: v_i, v_t,i and θ̇_i with hitch offsets and creep", PLACE)
.under("d_i ≠ 0; any N: each step is shown for whatever the axle ahead does")
        .proof(
            "the first axle behind the tractor, with h = v_t − c·θ̇ of the hitch",
            &[
                ("v_1", "v_l*cos(phi - phi_1) - (v_t - c_1*phi')*sin(phi - phi_1)"),
                ("vt_1", "e_tc_1*v_1"),
                ("d_1*phi_1'", "v_l*sin(phi - phi_1) + (v_t - c_1*phi')*cos(phi - phi_1) - e_tc_1*v_1"),
            ],
            proving(train(1).freeing(&["v_l", "v_t"])),
        )
        .proof(
            "an axle behind an axle",
            &[
                ("v_2", "v_1*cos(phi_1 - phi_2) - (vt_1 - c_2*phi_1')*sin(phi_1 - phi_2)"),
                ("vt_2", "e_tc_2*v_2"),
                ("d_2*phi_2'", "v_1*sin(phi_1 - phi_2) + (vt_1 - c_2*phi_1')*cos(phi_1 - phi_2) - e_tc_2*v_2"),
            ],
            proving(train(2).freeing(&["v_1", "vt_1", "phi_1'"])),
        )
        .proof(
            "and the next",
            &[
                ("v_3", "v_2*cos(phi_2 - phi_3) - (vt_2 - c_3*phi_2')*sin(phi_2 - phi_3)"),
                ("d_3*phi_3'", "v_2*sin(phi_2 - phi_3) + (vt_2 - c_3*phi_2')*cos(phi_2 - phi_3) - e_tc_3*v_3"),
            ],
            proving(train(3).freeing(&["v_2", "vt_2", "phi_2'"])),
        ),
        base("trailers-on-axle", "with hitches on the axles only the angles between bodies and the creeps of both axles enter", PLACE)
            .under("c_i = 0")
            .proof(
                "two trailers",
                &[
                    ("v_1", "v_l*(cos(phi - phi_1) - e_0*sin(phi - phi_1))"),
                    ("d_1*phi_1'", "v_l*((1 + e_tc_1*e_0)*sin(phi - phi_1) + (e_0 - e_tc_1)*cos(phi - phi_1))"),
                    ("v_2", "v_1*(cos(phi_1 - phi_2) - e_tc_1*sin(phi_1 - phi_2))"),
                    ("d_2*phi_2'", "v_1*((1 + e_tc_2*e_tc_1)*sin(phi_1 - phi_2) + (e_tc_1 - e_tc_2)*cos(phi_1 - phi_2))"),
                ],
                proving(on_axle(2)),
            ),
        base("trailers-in-courses", "in courses χ_i = θ_i + arctan e_i each creeping bar turns as an ideal one of length d_i·cos α_i that is drawn with V_(i−1)", PLACE)
            .under("c_i = 0, e_i = tan α_i")
            .remark("The speed passed on is V_(i−1)·cos(χ_(i−1) − θ_i)/cos α_i and not that of an ideal train: for several trailers the hitches move sideways by d_i·sin α_i as well.")
            .proof(
                "turning of the course, speed along it",
                &[
                    ("d_1*cos(alpha_1)*phi_1'", "V_0*sin(chi_0 - chi_1)"),
                    ("d_2*cos(alpha_2)*phi_2'", "V_1*sin(chi_1 - chi_2)"),
                    ("v_1", "V_0*cos(chi_0 - phi_1)"),
                    ("v_2", "V_1*cos(chi_1 - phi_2)"),
                ],
                proving(courses(2)),
            ),
        base("trailer-speeds", "the speeds of trailers are determined, no rotation creep of theirs enters: v_N = v_l·Π cos β_i without creep", PLACE)
            .under("c_i = 0, no traverse creep")
            .proof(
                "product of cosines for three trailers",
                &[("v_3", "v_l*cos(phi - phi_1)*cos(phi_1 - phi_2)*cos(phi_2 - phi_3)")],
                |s, _| {
                    let ideal = ["e_0", "e_tc_1", "e_tc_2", "e_tc_3"].iter().fold(on_axle(3), |m, e| m.with_text(e, "0"));
                    prove(&ideal, s)
                },
            ),
        base("trailer-breaks", "a trailer across its hitch has no coefficient: e_i is undefined exactly where v_i = 0", PLACE)
            .under("at β = ±π/2 without creep ahead a trailer may only slide sideways, which type T does not express")
            .proof("quotient of its velocities", &[("vt_1/v_1", "v_1")], |s, _| {
                undefined_exactly_where(&DerivedFormulas::default(), s)
            })
            .sabotaged_by(&[&[("vt_1/v_1", "vt_1")], &[("vt_1/v_1", "v_1*vt_1")]])
            .on_domains()
            .proof(
                "forward speed at right angles",
                &[("v_1", "-e_0*v_l")],
                |s, _| {
                    // φ − φ_1 = π/2: the cosine of it is 0 and the sine 1.
                    prove(&on_axle(1).with_text("phi", "phi_1 + 2*atan(1)"), s)
                },
            ),
    ]
}

fn towing() -> Vec<Claim> {
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
        base("towing-equilibrium", "a trailer towed straight settles at β* = α₁ − α₀", PLACE)
            .under("as for straight towing, v_l > 0")
            .proof("its heading does not turn there", &[("phi_1'", "0")], |s, _| {
                prove(&courses(1).with_text("phi'", "0").with_text("phi_1", "phi + alpha_0 - alpha_1"), s)
            })
            .sabotaged_by(&[&[("phi_1'", "1")], &[("phi_1'", "v_l/d_1")]]),
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
