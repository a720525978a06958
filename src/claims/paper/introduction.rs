//! Section 1: the pneumatic tyre, equations (1) and (2), as far as kinematics can tell.

use crate::claims::simulated::{driven, model, undefined};
use crate::claims::{Claim, DerivedFormulas, Outcome, Sampling, Statement, Status, near, proving, value_said};
use crate::effects;
use crate::effects::Applied;
use crate::model::Model;

const CHAPTER: &str = "01-introduction";
const EFFECTS: &str = "src/effects/catalogue.toml";

pub(crate) fn claims() -> Vec<Claim> {
    vec![
        Claim::new(
            "eq-1",
            Status::Sampled,
            "(1) is a relaxation over distance: what is left of the creep falls as e^(−k_g·s), at any speed",
        )
        .at("section 1, (1)")
        .about(&[1])
        .under("k_g > 0, constant speed; the effect relaxation-length with the length 1/k_g")
        .chapter(CHAPTER)
        .code(&[EFFECTS])
        .tests(&["tests/mechanism/effects.rs"])
        .sample(
            "simulated wheels whose creep builds up: the deviation from its final value after a way s",
            &[("deviation", "-e_tc*v_l*exp(-k_g*s)")],
            relaxation,
        ),
        Claim::new(
            "eq-2",
            Status::Proved,
            "Rocard's law (2) against the centrifugal force gives v_t = −(m/k_r)·v_l²·φ̇",
        )
        .at("section 1, (2)")
        .about(&[2])
        .under("quasi-static: the lateral friction f = −k_r·θ_c balances m·v_l·φ̇; small angles, θ_c = v_t/v_l")
        .chapter(CHAPTER)
        .code(&[EFFECTS])
        .tests(&["tests/mechanism/effects.rs"])
        .proof(
            "the motion with the effect load-dependent-creep, c = m/k_r",
            &[("m*v_l*phi'", "-k_r*v_t/v_l"), ("v_t", "-m*v_l^2*phi'/k_r")],
            proving(rocard()),
        ),
    ]
}

/// A wheel whose lateral velocity follows its load; without other creep.
fn rocard() -> DerivedFormulas {
    let effect = effects::named("load-dependent-creep").map(|e| Applied::new(e, None, vec![0.1]));
    let wheel = Model::new("unicycle", &[("wheel_radius", 1.0)]).ok();
    let Some((wheel, effect)) = wheel.zip(effect) else { return DerivedFormulas::default() };
    DerivedFormulas::of_model(&wheel.with_effect(effect))
        .with_text("load_dependent_creep.c", "m/k_r")
        .with_text("e_tc", "0")
}

fn relaxation(s: &Statement, sampling: &Sampling) -> Outcome {
    let show = |c: &(f64, f64, f64, f64)| {
        let names = ["e_tc", "length", "v_l", "t"];
        names.iter().zip([c.0, c.1, c.2, c.3]).map(|(n, v)| (n.to_string(), v.to_string())).collect()
    };
    let cases = (0.02..0.3f64, 0.2..2.0f64, 0.3..3.0f64, 0.2..2.0f64);
    sampling.one_in(4).cases(cases, show, |&(e_tc, length, v_l, t)| {
        // Values in alphabetical order: e_tc, length.
        let effect = ("relaxation-length", None, vec![e_tc, length]);
        let wheel = model("unicycle", &[("wheel_radius", 0.5)], &[], &[effect]).map_err(|e| undefined(&e))?;
        let inputs = [("wheel_rate", "2*c_0"), ("yaw_rate", "0")];
        let path = driven(&wheel, &inputs, &[v_l], &[0.0; 4], &[0.0, t]).map_err(|e| undefined(&e))?;
        let at = |name: &str| match name {
            "e_tc" => Some(e_tc),
            "v_l" => Some(v_l),
            "k_g" => Some(1.0 / length),
            "s" => Some(v_l * t),
            _ => None,
        };
        near("the deviation", path[1][3] - e_tc * v_l, value_said(s, "deviation", &at)?, 1e-9)
    })
}
