//! A car with a trailer that is backed by a plan made with its creep, and by one made without.

use super::executed_plans::{Shown, drawing, executed_plans};
use super::{Drawing, Figure, Options};
use crate::error::Result;
use crate::model::Trailer;
use crate::motion::{Creep, assembled};
use crate::number_format::decimals;
use crate::picture::plot::Size;
use crate::planning::Task;

/// The figure.
pub const FIGURE: Figure = Figure {
    name: "backing",
    title: "backing a train that creeps",
    source: "beyond the paper; sections 1 and 5",
    draw,
};

const SIZE: Size = Size { width: 396.0, height: 220.0, margins: [40.0, 10.0, 32.0, 40.0] };
const CAR: [(&str, f64); 2] = [("wheel_radius", 0.3), ("wheelbase", 2.6)];
const TRAILERS: [Trailer; 1] = [Trailer { length: 5.0, hitch: 0.3 }];
/// Of the trailer's axle.
const GOAL: (f64, f64, Option<f64>) = (-14.0, 3.0, Some(0.0));

fn draw(options: &Options) -> Result<Drawing> {
    let e = options.traverse(0.04);
    let model = |share: f64| {
        let of_trailers = (1..=TRAILERS.len()).map(|i| ("trailer-traverse-creep", Some(i), vec![share * e]));
        let creeps: Vec<Creep> =
            std::iter::once(("traverse-creep", None, vec![share * e])).chain(of_trailers).collect();
        assembled("car", &CAR, &TRAILERS, &creeps)
    };
    let task = Task { of_trailer: TRAILERS.len(), ..Task::from_origin(&model(1.0)?, vec![GOAL], 16) };
    let description = "Seen from above, in metres: a car with a trailer backs by a plan made without creep, by the same inputs with \
                       creep, and by a plan made with it. Backing is unstable: what is a little off at first bends the train.";
    let creep = format!("every axle creeps, $e_{{tc}}$ = {}; paths of the trailer's axle", decimals(e, 2));
    let words = [FIGURE.name, FIGURE.title, description];
    Ok(drawing(
        &executed_plans(&task, &model)?,
        &Shown { words, size: SIZE, body: TRAILERS.len(), wheelbase: CAR[1].1, creep },
    ))
}
