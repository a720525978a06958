//! The paper's plea: planning must account for creep.

use crate::claims::simulated::{TURN, WHEEL, driven, model, undefined};
use crate::claims::{Claim, Fault, Outcome, Sampling, Statement, Status, Verdict, near, value_said};
use proptest::prelude::*;

pub(crate) fn claims() -> Vec<Claim> {
    vec![
        Claim::new("planning", Status::Sampled, "a plan made on the ideal wheel misses its goal by (κ − 1)·goal when executed with creep, and hits when made with it")
            .at("sections 1 and 5: existing algorithms for planning and control should be modified")
            .under("constant known coefficients; the plan turns the wheel on the spot, then follows a given pair of rates, stretched")
            .chapter("09-planning")
            .code(&["src/motion/trajectory.rs"])
            .tests(&["tests/motion/kinematics.rs"])
            .sample(
                "plans for generated goals, executed in the simulator: where they end",
                &[
                    ("miss_x", "-e_rc*X - (1 - e_rc)*e_tc*Y"),
                    ("miss_y", "(1 - e_rc)*e_tc*X - e_rc*Y"),
                    ("hit_x", "X"),
                    ("hit_y", "Y"),
                ],
                plans,
            ),
    ]
}

/// Creeps, goal, constants of the rates.
type Case = (f64, f64, (f64, f64), Vec<f64>);

fn plans(s: &Statement, sampling: &Sampling) -> Outcome {
    let goals = (-3.0..3.0f64, -3.0..3.0f64);
    let cases = (-0.3..0.3f64, -0.3..0.3f64, goals, prop::collection::vec(-1.0..1.0f64, 7));
    sampling.one_in(4).cases(cases, shown, |case| plan(s, case))
}

fn shown((e_rc, e_tc, (x, y), c): &Case) -> Vec<(String, String)> {
    let mut shown: Vec<(String, String)> =
        [("e_rc", e_rc), ("e_tc", e_tc), ("X", x), ("Y", y)].map(|(n, v)| (n.to_string(), v.to_string())).to_vec();
    shown.extend(c.iter().enumerate().map(|(i, v)| (format!("c_{i}"), v.to_string())));
    shown
}

/// One goal, planned on the ideal wheel and on the creeping one, both executed on the creeping one.
fn plan(s: &Statement, (e_rc, e_tc, goal, c): &Case) -> Verdict {
    let on_ideal = planned(0.0, 0.0, *goal, c)?;
    let on_crept = planned(*e_rc, *e_tc, *goal, c)?;
    let missed = executed(*e_rc, *e_tc, on_ideal, c)?;
    let hit = executed(*e_rc, *e_tc, on_crept, c)?;
    let at = |name: &str| match name {
        "X" => Some(goal.0),
        "Y" => Some(goal.1),
        "e_rc" => Some(*e_rc),
        "e_tc" => Some(*e_tc),
        _ => None,
    };
    near("miss_x", missed.0 - goal.0, value_said(s, "miss_x", &at)?, 1e-8)?;
    near("miss_y", missed.1 - goal.1, value_said(s, "miss_y", &at)?, 1e-8)?;
    near("hit_x", hit.0, value_said(s, "hit_x", &at)?, 1e-8)?;
    near("hit_y", hit.1, value_said(s, "hit_y", &at)?, 1e-8)
}

/// How far to turn on the spot first, and by what to stretch the wheel rate, so that a wheel of these creeps arrives:
/// one run of the model with neither tells.
fn planned(e_rc: f64, e_tc: f64, goal: (f64, f64), c: &[f64]) -> Result<(f64, f64), Fault> {
    let (x, y) = executed(e_rc, e_tc, (0.0, 1.0), c)?;
    // Rates that come back to where they began reach no goal by stretching.
    if x.hypot(y) < 0.3 {
        return Err(Fault::Outside);
    }
    Ok((goal.1.atan2(goal.0) - y.atan2(x), goal.0.hypot(goal.1) / x.hypot(y)))
}

/// Where a creeping wheel ends.
fn executed(e_rc: f64, e_tc: f64, (turn, stretch): (f64, f64), c: &[f64]) -> Result<(f64, f64), Fault> {
    let creeps = [("rotation-creep", None, vec![e_rc]), ("traverse-creep", None, vec![e_tc])];
    let wheel = model("unicycle", &[("wheel_radius", 0.5)], &[], &creeps).map_err(|e| undefined(&e))?;
    let constants: Vec<f64> = c.iter().copied().chain([stretch]).collect();
    let stretched = format!("c_7*({WHEEL})");
    let inputs = [("wheel_rate", stretched.as_str()), ("yaw_rate", TURN)];
    let path = driven(&wheel, &inputs, &constants, &[0.0, 0.0, turn], &[0.0, 1.5]).map_err(|e| undefined(&e))?;
    Ok((path[1][0], path[1][1]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rates_that_come_back_to_where_they_began_are_no_plan() {
        // In the time of 1.5 s once around.
        let circle = |c_4: f64| planned(0.0, 0.0, (1.0, 1.0), &[0.0, 0.0, 0.0, 0.0, c_4, 0.0, 0.0]);
        assert!(matches!(circle(std::f64::consts::TAU / 1.5), Err(Fault::Outside)));
        assert!(circle(0.5).is_ok_and(|(_, stretch)| (0.3..0.7).contains(&stretch)));
    }
}
