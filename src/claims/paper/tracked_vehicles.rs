//! What feedback repairs of a plan made without creep, and what it leaves: one wheel led along a line in closed loop.

use crate::claims::simulated::{model, undefined};
use crate::claims::{Claim, Fault, Outcome, Sampling, Statement, Status, Verdict, near, value_said};
use crate::planning::Task;
use crate::progress::unheard;
use crate::tracking::{Trials, Way, tracked};
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex};

pub(crate) fn claims() -> Vec<Claim> {
    let known = Known::default();
    vec![
        Claim::new(
            "feedback-observer",
            Status::Sampled,
            "feedback on the ideal model keeps one wheel beside its line, the heading off by arctan e_tc; with creep observed it comes onto the line, the heading off as before",
        )
        .at("section 1: the mismatch can be compensated through visual feedback")
        .under("constant coefficients up to 0.2; a straight plan made without creep that leaves the commands room within their limits; poses measured to a micrometre")
        .remark(
            "Where a wheel keeps to a line its course lies along it, whatever steers it: of a pose that is planned without creep \
             feedback can reach the place or the heading.",
        )
        .chapter("09-planning")
        .code(&["src/tracking/predictive_control.rs", "src/tracking/extended_kalman_filter.rs"])
        .tests(&["tests/commands/track.rs"])
        .sample(
            "generated creeps halfway, where the speed is steady: heading off the plan, rad; place across it, as a share of that on the ideal model",
            &[("heading_ideal", "-atan(e_tc)"), ("heading_observed", "-atan(e_tc)"), ("across_observed", "0")],
            move |s, sampling| driven(&known, s, sampling),
        ),
    ]
}

/// Drives that were made, by the bits of their creeps: across the plan and off its heading, on the ideal model and observed.
type Known = Arc<Mutex<BTreeMap<[u64; 2], [[f64; 2]; 2]>>>;

fn driven(known: &Known, s: &Statement, sampling: &Sampling) -> Outcome {
    // Next to no creep there is nothing to be compensated.
    let creeps = (-0.08..0.08f64, 0.12..0.2f64, proptest::bool::ANY);
    let shown = |(e_rc, e_tc, left): &(f64, f64, bool)| {
        let e_tc = if *left { -e_tc } else { *e_tc };
        vec![("e_rc".into(), format!("{e_rc}")), ("e_tc".into(), format!("{e_tc}"))]
    };
    sampling
        .at_most(4)
        .cases(creeps, shown, |(e_rc, e_tc, left)| compared(known, s, *e_rc, if *left { -e_tc } else { *e_tc }))
}

fn compared(known: &Known, s: &Statement, e_rc: f64, e_tc: f64) -> Verdict {
    let key = [e_rc, e_tc].map(f64::to_bits);
    let made = known.lock().ok().and_then(|all| all.get(&key).copied());
    let found = made.map_or_else(|| led(e_rc, e_tc), Ok)?;
    if let Ok(mut all) = known.lock() {
        all.insert(key, found);
    }
    let [ideal, observed] = found;
    let said = |name: &str| value_said(s, name, &|symbol| (symbol == "e_tc").then_some(e_tc));
    near("heading_ideal", ideal[1], said("heading_ideal")?, 5e-4)?;
    near("heading_observed", observed[1], said("heading_observed")?, 5e-4)?;
    near("across_observed", observed[0] / ideal[0], said("across_observed")?, 0.05)
}

fn led(e_rc: f64, e_tc: f64) -> Result<[[f64; 2]; 2], Fault> {
    let creeps = [("rotation-creep", None, vec![e_rc]), ("traverse-creep", None, vec![e_tc])];
    let wheel = model("unicycle", &[("wheel_radius", 0.2)], &[], &creeps).map_err(|e| undefined(&e))?;
    // With time to spare, for a wheel that slips back has to turn faster than planned.
    let straight = Task::from_origin(&wheel, vec![(20.0, 0.0, Some(0.0))], 16);
    let task = Task { duration: Some(34.0), ..straight };
    let trials = Trials { sample: 0.2, noise: [1e-6, 1e-6], drives: 1, horizon: 10, settling: 0.0, seed: 0 };
    let found = tracked(&wheel, &task, &trials, &unheard).map_err(|e| undefined(&e))?;
    let found = found.map_err(|why| Fault::False(format!("no plan: {why:?}")))?;
    let way = |id: &str| found.ways.iter().find(|w| w.id == id).ok_or(Fault::Outside);
    Ok([off(way("ideal")?), off(way("observer")?)])
}

/// Across the plan and off its heading halfway, where the speed is greatest and hence steady.
fn off(way: &Way) -> [f64; 2] {
    let k = way.reference.poses.len() / 2;
    let (is, planned) = (&way.drives[0].poses[k], way.reference.pose(k));
    [is[1] - planned[1], is[2] - planned[2]]
}
