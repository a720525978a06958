//! A plan made on the ideal wheel and executed by a wheel that creeps.

use super::executed_plans::columns;
use super::{Data, Drawing, Figure, Options, fixed, key, page, plane};
use crate::error::Result;
use crate::motion::{assembled, driven};
use crate::number_format::decimals;
use crate::picture::maths::maths;
use crate::picture::plot::{Marker, Size};
use crate::picture::svg::line;

/// The figure.
pub const FIGURE: Figure = Figure {
    name: "planning",
    title: "a plan made on the ideal wheel, executed with creep",
    source: "beyond the paper; sections 1 and 5",
    draw,
};

const PANEL: Size = Size { width: 396.0, height: 250.0, margins: [40.0, 10.0, 32.0, 40.0] };
const GOAL: [f64; 2] = [4.0, 1.5];
const TIME: f64 = 4.0;
/// Rates of the plan before it is turned and stretched: c_0 stretches the wheel rate.
const RATES: [(&str, &str); 2] = [("wheel_rate", "c_0*(2 + sin(1.5*t))"), ("yaw_rate", "1.1*cos(1.4*t)")];

/// How far the wheel turns on the spot first, rad, and by what its rate is stretched.
#[derive(Clone, Copy)]
struct Plan {
    turn: f64,
    stretch: f64,
}

/// The path of a wheel of given creeps that executes a plan.
fn executed(e: [f64; 2], plan: Plan, times: &[f64]) -> Result<Vec<[f64; 2]>> {
    let creeps = [("rotation-creep", None, vec![e[0]]), ("traverse-creep", None, vec![e[1]])];
    let wheel = assembled("unicycle", &[("wheel_radius", 0.5)], &[], &creeps)?;
    let path = driven(&wheel, &RATES, &[plan.stretch], &[0.0, 0.0, plan.turn], times)?;
    Ok(path.iter().map(|z| [z[0], z[1]]).collect())
}

/// The plan that brings a wheel of given creeps to the goal; one run of the model with neither turn nor stretch tells.
fn planned(e: [f64; 2]) -> Result<Plan> {
    let end = executed(e, Plan { turn: 0.0, stretch: 1.0 }, &[0.0, TIME])?[1];
    let angle = |p: [f64; 2]| p[1].atan2(p[0]);
    Ok(Plan { turn: angle(GOAL) - angle(end), stretch: GOAL[0].hypot(GOAL[1]) / end[0].hypot(end[1]) })
}

fn draw(options: &Options) -> Result<Drawing> {
    let e = [options.rotation(0.06), options.traverse(-0.12)];
    let times: Vec<f64> = (0..=120).map(|i| TIME * f64::from(i) / 120.0).collect();
    let (on_ideal, on_crept) = (planned([0.0; 2])?, planned(e)?);
    let paths = [executed([0.0; 2], on_ideal, &times)?, executed(e, on_ideal, &times)?, executed(e, on_crept, &times)?];
    let mut data = Data::new("", &columns("t [s]"));
    for (i, t) in times.iter().enumerate().step_by(4) {
        let places = paths.iter().flat_map(|p| p[i]).map(|v| fixed(v, 6));
        data.row(std::iter::once(fixed(*t, 3)).chain(places));
    }
    let end = paths[1][times.len() - 1];
    let miss = (end[0] - GOAL[0]).hypot(end[1] - GOAL[1]);
    let mut panel = plane::plane(PANEL, plane::ranges(paths.iter().flatten().chain(&[GOAL]), 0.06));
    for (class, marker, path) in [
        ("measured", Marker::Circle, &paths[2]),
        ("crept", Marker::Square, &paths[1]),
        ("ideal", Marker::Ring, &paths[0]),
    ] {
        panel.pieces(class, std::slice::from_ref(path), plane::MAX_POINTS);
        if class == "crept" {
            panel.markers(class, marker, &path[path.len() - 1..]);
        }
    }
    let (goal, missed) = (panel.place(GOAL), panel.place(end));
    panel.note(line("line help", goal, missed));
    panel.markers("start", Marker::Circle, &[GOAL]);
    panel.note(maths("strong", [goal[0] + 10.0, goal[1] - 15.0], "end", "goal"));
    panel.note(maths("", [missed[0] - 8.0, missed[1] + 16.0], "end", &format!("misses by {} m", fixed(miss, 2))));
    let mut elements = vec![page::placed(panel.finish("plan", "Plan", "Three paths to a goal."), [2.0, 2.0], PANEL)];
    elements.extend(key::column(
        &[
            key::Entry { class: "ideal", marker: None, text: "plan on the ideal wheel" },
            key::Entry {
                class: "crept",
                marker: Some(Marker::Square),
                text: "the same rates on the wheel that creeps",
            },
            key::Entry { class: "measured", marker: None, text: "plan made with the creep, executed" },
        ],
        [20.0, 266.0],
    ));
    let shown = e.map(|e| decimals(e, 2));
    elements.push(maths(
        "soft",
        [390.0, 20.0],
        "end",
        &format!("$e_{{rc}}$ = {}, $e_{{tc}}$ = {}", shown[0], shown[1]),
    ));
    let description = "Seen from above, in metres: the planned path, the path the creeping wheel takes instead, and the \
                       path of a plan that knows the creep.";
    let svg = page::page(FIGURE.name, FIGURE.title, description, 312.0, elements);
    Ok(Drawing { svg, tables: vec![data], text: String::new() })
}
