//! A car that is parked by a plan made with its creep, and by one made without.

use super::executed_plans::{Shown, drawing, executed_plans};
use super::{Drawing, Figure, Options};
use crate::error::Result;
use crate::motion::assembled;
use crate::number_format::decimals;
use crate::picture::plot::Size;
use crate::planning::Task;

/// The figure.
pub const FIGURE: Figure =
    Figure { name: "parking", title: "parking a car that creeps", source: "beyond the paper; sections 1 and 5", draw };

const SIZE: Size = Size { width: 396.0, height: 250.0, margins: [40.0, 10.0, 32.0, 40.0] };
const CAR: [(&str, f64); 2] = [("wheel_radius", 0.3), ("wheelbase", 2.6)];
const GOAL: (f64, f64, Option<f64>) = (-6.5, -2.6, Some(0.0));
/// Of understeer, s²/m².
const UNDERSTEER: f64 = 0.05;

fn draw(options: &Options) -> Result<Drawing> {
    let e = options.traverse(-0.06);
    let model = |share: f64| {
        let creeps = [("understeer", None, vec![share * UNDERSTEER]), ("traverse-creep", None, vec![share * e])];
        assembled("car", &CAR, &[], &creeps)
    };
    let task = Task::from_origin(&model(1.0)?, vec![GOAL], 16);
    let description = "Seen from above, in metres: a car backs into a gap beside it, by a plan made without creep, by the same \
                       inputs with creep, and by a plan made with it.";
    let creep =
        format!("understeer {} s²/m², $e_{{tc}}$ = {} at the rear axle", decimals(UNDERSTEER, 2), decimals(e, 2));
    let words = [FIGURE.name, FIGURE.title, description];
    Ok(drawing(&executed_plans(&task, &model)?, &Shown { words, size: SIZE, body: 0, wheelbase: CAR[1].1, creep }))
}
