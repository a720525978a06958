//! The paper's plea on vehicles whose heading creeps as well: plans by direct multiple shooting, with creep and without.

use crate::claims::simulated::{model, undefined};
use crate::claims::{
    Claim, DerivedFormulas, Fault, Outcome, Sampling, Statement, Status, Verdict, near, proving, value_said,
};
use crate::model::Model;
use crate::motion::Timing;
use crate::planning::{Plan, Task, execute, plan};
use crate::progress::unheard;

pub(crate) fn claims() -> Vec<Claim> {
    vec![
        Claim::new(
            "planning-vehicles",
            Status::Sampled,
            "on wheels, differential drives and cars a plan made with creep reaches its goal, and one made without it misses by the slope of its end in the coefficients, to second order",
        )
        .at("sections 1 and 5: existing algorithms for planning and control should be modified")
        .under("constant known coefficients up to 0.06; goals ahead; inputs within usual limits")
        .chapter("09-planning")
        .code(&["src/planning/planner.rs", "src/planning/shooting.rs", "src/planning/execution.rs"])
        .tests(&["tests/commands/plan.rs"])
        .sample(
            "generated creeps and goals: distance from the goal, m, by another integration; order of what the slope leaves",
            &[("hit", "0"), ("order", "2")],
            plans,
        ),
        scaling(),
    ]
}

/// What one factor on the inputs undoes, and what none does.
fn scaling() -> Claim {
    let wheel = DerivedFormulas::of("unicycle").with_text("e_tc", "tan(alpha)").with_text("phi", "psi - alpha");
    let car = DerivedFormulas::of("car").with_text("e_f", "0").with_text("delta", "0");
    let trailer = DerivedFormulas::train("unicycle", 1).with_text("c_1", "0").with_text("e_tc", "0");
    Claim::new(
        "uniform-scaling",
        Status::Proved,
        "one factor on the wheel rate and a turn at the start undo the creep of one wheel; no factor undoes that of a car's rear axle or of a trailer, which turn where nothing is commanded to turn",
    )
    .at("sections 1 and 5: existing algorithms for planning and control should be modified")
    .under("constant coefficients, e_rc ≠ 1, e_tc = tan α; yaw rates where steering and hitch are straight")
    .remark("A factor leaves zero zero: the yaw rate of the ideal car at δ = 0, and of the ideal trailer in line, is zero at any speed.")
    .chapter("09-planning")
    .code(&["src/model/build.rs"])
    .tests(&["tests/commands/plan.rs"])
    .proof(
        "one wheel, its rate times cos α/(1 − e_rc), its heading less α: the velocity of the ideal wheel",
        &[("v_l*cos(phi) - v_t*sin(phi)", "r*plan*cos(psi)"), ("v_l*sin(phi) + v_t*cos(phi)", "r*plan*sin(psi)")],
        proving(wheel.with_text("theta'", "plan*cos(alpha)/(1 - e_rc)")),
    )
    .proof("a car with its wheels straight", &[("phi'", "-e_tc*v_l/L")], proving(car))
    .proof("a trailer in line", &[("phi_1'", "-e_tc_1*v_l/d_1")], proving(trailer.with_text("phi_1", "phi")))
}

/// The vehicle, two coefficients, the goal.
type Case = (usize, (f64, f64), (f64, f64, f64));

fn plans(s: &Statement, sampling: &Sampling) -> Outcome {
    let creeps = (-0.06..0.06f64, -0.06..0.06f64);
    let goals = (1.5..3.0f64, -0.8..0.8f64, -0.5..0.5f64);
    sampling.at_most(6).cases((0..3usize, creeps, goals), shown, |case| planned(s, case))
}

fn shown((vehicle, creeps, goal): &Case) -> Vec<(String, String)> {
    let vehicle = ["unicycle", "differential-drive", "car"][*vehicle];
    vec![
        ("vehicle".into(), vehicle.into()),
        ("creeps".into(), format!("{creeps:?}")),
        ("goal".into(), format!("{goal:?}")),
    ]
}

/// A vehicle whose two coefficients are a share of those of the case.
fn creeping(&(vehicle, (a, b), _): &Case, share: f64) -> Result<Model, Fault> {
    let (a, b) = (share * a, share * b);
    let found = match vehicle {
        0 => {
            let creeps = [("rotation-creep", None, vec![a]), ("traverse-creep", None, vec![b])];
            model("unicycle", &[("wheel_radius", 0.2)], &[], &creeps)
        }
        1 => {
            let creeps = [("unequal-rotation-creep", None, vec![a, b])];
            model("differential-drive", &[("wheel_radius", 0.1), ("track_width", 0.4)], &[], &creeps)
        }
        _ => {
            let creeps = [("front-traverse-creep", None, vec![a]), ("traverse-creep", None, vec![b])];
            model("car", &[("wheel_radius", 0.3), ("wheelbase", 1.0)], &[], &creeps)
        }
    };
    found.map_err(|e| undefined(&e))
}

fn planned(s: &Statement, case: &Case) -> Verdict {
    let (creeping_model, ideal) = (creeping(case, 1.0)?, creeping(case, 0.0)?);
    let (x, y, heading) = case.2;
    let task = Task::from_origin(&ideal, vec![(x, y, Some(heading))], 10);
    let found = |model: &Model| -> Result<Plan, Fault> {
        let found = plan(model, &task, &unheard).map_err(|e| undefined(&e))?;
        found.map_err(|why| Fault::False(format!("no plan: {why:?}")))
    };
    let end = |plan: &Plan, model: &Model| -> Result<[f64; 3], Fault> {
        execute(plan, &task, model, Timing::Sample).map(|e| e.end).map_err(|e| undefined(&e))
    };
    let off = |a: [f64; 3], b: [f64; 3]| (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f64>().sqrt();
    let goal = [x, y, heading];
    near("hit", off(end(&found(&creeping_model)?, &creeping_model)?, goal), value_said(s, "hit", &|_| None)?, 1e-8)?;
    let made_without = found(&ideal)?;
    let at = |share: f64| end(&made_without, &creeping(case, share)?);
    let (ahead, behind) = (at(1e-3)?, at(-1e-3)?);
    let slope = [0, 1, 2].map(|i| (ahead[i] - behind[i]) / 2e-3);
    let left = |share: f64| Ok(off(at(share)?, [0, 1, 2].map(|i| goal[i] + share * slope[i])));
    let (whole, half) = (left(1.0)?, left(0.5)?);
    // Coefficients next to nothing leave nothing to be told.
    if whole < 1e-6 {
        return Err(Fault::Outside);
    }
    near("order", (whole / half).log2(), value_said(s, "order", &|_| None)?, 0.25)
}
