//! Plans made with creep and without it, driven by one vehicle: the bodies along the way.

use super::{Data, Drawing, Rig, fixed, key, page, plane};
use crate::error::{Error, Result};
use crate::model::Model;
use crate::motion::Timing;
use crate::picture::maths::maths;
use crate::picture::plot::{Marker, Size};
use crate::planning::{Plan, Task, execute, plan};
use crate::progress::unheard;

/// A drive: the vehicle row by row, and how far its end is from the goal.
pub struct DrivenPlan {
    /// The bodies, row by row.
    pub rigs: Vec<Rig>,
    /// m.
    pub miss: f64,
    /// s.
    pub duration: f64,
}

impl DrivenPlan {
    /// The path of a body: 0 the tractor's reference point, then the trailers' axles.
    pub fn path(&self, body: usize) -> Vec<[f64; 2]> {
        self.rigs.iter().map(|r| r.bodies[body].0).collect()
    }
}

/// Three drives of a task: the plan made without creep where there is none, the same with creep, the plan made with it.
///
/// # Errors
/// When a goal is not reached, or a motion is undefined.
pub fn executed_plans(task: &Task, model: &impl Fn(f64) -> Result<Model>) -> Result<[DrivenPlan; 3]> {
    let (ideal, creeping) = (model(0.0)?, model(1.0)?);
    let made = |model: &Model| -> Result<Plan> {
        plan(model, task, &unheard)?.map_err(|why| Error::run(format!("the figure's goal is not reached: {why:?}")))
    };
    let (without, with) = (made(&ideal)?, made(&creeping)?);
    Ok([driven(&without, task, &ideal)?, driven(&without, task, &creeping)?, driven(&with, task, &creeping)?])
}

fn driven(plan: &Plan, task: &Task, model: &Model) -> Result<DrivenPlan> {
    let executed = execute(plan, task, model, Timing::Sample)?;
    let table = &executed.table;
    let states = 3 + model.trailer_count();
    let steering = |k: usize| plan.command(1, table.columns[0][k]);
    let rig = |k: usize| {
        let z: Vec<f64> = (0..states).map(|i| table.columns[1 + i][k]).collect();
        Rig::of(model, &z, &[(model.inputs[0].as_str(), 1.0), (model.inputs[1].as_str(), steering(k))])
    };
    let rigs = (0..table.rows()).map(rig).collect::<Result<_>>()?;
    Ok(DrivenPlan { rigs, miss: executed.miss, duration: plan.duration })
}

/// How far a trailer's body goes ahead of its axle, and how wide bodies are, m.
const AHEAD: f64 = 1.6;
const WIDTH: f64 = 1.6;

/// How a figure shows its drives.
pub struct Shown {
    /// Name, title, and for those who do not see it.
    pub words: [&'static str; 3],
    /// The panel.
    pub size: Size,
    /// Whose path is drawn: 0 the car's, then the trailers'.
    pub body: usize,
    /// The car's wheelbase, m.
    pub wheelbase: f64,
    /// What the model has, as a formula.
    pub creep: String,
}

/// The three drives from above with the vehicle at both ends.
pub fn drawing(drives: &[DrivenPlan; 3], shown: &Shown) -> Drawing {
    let [_, missed, reached] = drives;
    let paths = drives.each_ref().map(|d| d.path(shown.body));
    let ends = [&reached.rigs[0], &reached.rigs[reached.rigs.len() - 1], &missed.rigs[missed.rigs.len() - 1]];
    let bodies = ends.map(|rig| rig.outlines(shown.wheelbase, AHEAD, WIDTH));
    let all = bodies.iter().flatten().chain(&paths).flatten();
    let mut panel = plane::plane(shown.size, plane::ranges(all, 0.04));
    panel.pieces("hair", &bodies[0], 4 * plane::MAX_POINTS);
    panel.pieces("hair", &bodies[1], 4 * plane::MAX_POINTS);
    panel.pieces("help", &bodies[2], 4 * plane::MAX_POINTS);
    let [on_ideal, crept, kept] = &paths;
    for (class, marker, path) in
        [("measured", None, kept), ("crept", Some(Marker::Square), crept), ("ideal", None, on_ideal)]
    {
        panel.pieces(class, std::slice::from_ref(path), plane::MAX_POINTS);
        if let Some(marker) = marker {
            panel.markers(class, marker, &path[path.len() - 1..]);
        }
    }
    panel.markers("start", Marker::Circle, &kept[..1]);
    let [name, title, description] = shown.words;
    let above = panel.finish("above", title, description);
    let misses = format!("the same inputs on the vehicle that creeps: {} m off", fixed(missed.miss, 2));
    let below = shown.size.height + 16.0;
    let mut elements = vec![page::placed(above, [2.0, 2.0], shown.size)];
    elements.extend(key::column(
        &[
            key::Entry { class: "ideal", marker: None, text: "plan made without creep, on the ideal vehicle" },
            key::Entry { class: "crept", marker: Some(Marker::Square), text: &misses },
            key::Entry { class: "measured", marker: None, text: "plan made with the creep, executed" },
        ],
        [20.0, below],
    ));
    elements.push(maths("soft", [20.0, below + 52.0], "start", &shown.creep));
    let svg = page::page(name, title, description, below + 62.0, elements);
    let text = format!(
        "{title}: {} s, {} m off without creep in the plan\n",
        fixed(reached.duration, 1),
        fixed(missed.miss, 3)
    );
    Drawing { svg, tables: vec![table(&paths)], text }
}

/// The columns of a table of three paths, behind what tells its rows apart.
pub fn columns(first: &'static str) -> [&'static str; 7] {
    [
        first,
        "x planned [m]",
        "y planned [m]",
        "x executed [m]",
        "y executed [m]",
        "x planned with creep [m]",
        "y planned with creep [m]",
    ]
}

/// The paths, row by row.
fn table(paths: &[Vec<[f64; 2]>; 3]) -> Data {
    let mut data = Data::new("", &columns("row"));
    let rows = paths.iter().map(Vec::len).max().unwrap_or(0);
    for k in (0..rows).step_by(10) {
        let places = paths.iter().flat_map(|p| p[k.min(p.len() - 1)]).map(|v| fixed(v, 4));
        data.row(std::iter::once(k.to_string()).chain(places));
    }
    data
}
