//! Off-tracking: how far trailers cut a corner, without creep and with it.

use super::{Data, Drawing, Figure, Options, Rig, fixed, key, page, plane};
use crate::error::Result;
use crate::model::{Model, Trailer};
use crate::motion::{Creep, assembled, driven};
use crate::number_format::decimals;
use crate::picture::axis::Axis;
use crate::picture::maths::maths;
use crate::picture::plot::{Marker, Size};
use crate::picture::svg::Element;

/// The figure.
pub const FIGURE: Figure = Figure {
    name: "off-tracking",
    title: "off-tracking of a car with trailers",
    source: "beyond the paper; theory/06-trailers",
    draw,
};

const PATHS: Size = Size { width: 396.0, height: 262.0, margins: [38.0, 10.0, 32.0, 40.0] };
const RADII: Size = Size { width: 396.0, height: 170.0, margins: [38.0, 14.0, 32.0, 40.0] };
/// A car with trailers hitched on the axles, m; it drives straight, then turns left by a smooth step of the steering.
const CAR: [(&str, f64); 2] = [("wheel_radius", 0.3), ("wheelbase", 2.6)];
const LENGTH: f64 = 2.8;
const TRAILERS: usize = 5;
const INPUTS: [(&str, &str); 2] = [("wheel_rate", "8"), ("steering_angle", "0.15*(1 + tanh(2*(t - 5)))")];
const TIME: f64 = 40.0;
const STEPS: usize = 200;
/// The step at which the train is shown; what comes after goes round in circles.
const SHOWN: usize = 92;
/// Width of the bodies, m, and how far those of trailers go ahead of their axles.
const WIDTH: f64 = 1.5;
const AHEAD: f64 = 1.4;

/// A train after the drive.
struct Train {
    /// The path of each axle, the car's rear axle first.
    paths: Vec<Vec<[f64; 2]>>,
    /// Radius of each axle's circle at the end, m.
    radii: Vec<f64>,
    /// The train half way through the drive.
    shown: Rig,
}

fn draw(options: &Options) -> Result<Drawing> {
    let e = options.traverse(-0.06);
    let times: Vec<f64> = (0..=STEPS).map(|i| TIME * i as f64 / STEPS as f64).collect();
    let [ideal, crept] = [train(0.0, &times)?, train(e, &times)?];
    let mut elements = vec![
        page::placed(above(&ideal, &crept), [2.0, 2.0], PATHS),
        page::placed(radii(&ideal, &crept), [2.0, 262.0], RADII),
    ];
    let shown = format!("every axle of a trailer creeps, $e_{{tc}}$ = {}", decimals(e, 2));
    elements.extend(key::column(
        &[
            key::Entry { class: "ideal", marker: Some(Marker::Ring), text: "without creep" },
            key::Entry { class: "kept", marker: Some(Marker::Circle), text: &shown },
        ],
        [40.0, 444.0],
    ));
    let description = "Left: paths of a car's rear axle and of its fifth trailer through a turn to the left, and the \
                       train at the end. Right: the radius of each axle's circle.";
    Ok(Drawing {
        svg: page::page(FIGURE.name, FIGURE.title, description, 474.0, elements),
        tables: vec![path_table(&times, &ideal, &crept), radius_table(&ideal, &crept)],
        text: String::new(),
    })
}

fn model(e: f64) -> Result<Model> {
    let creeps: Vec<Creep> = (1..=TRAILERS).map(|i| ("trailer-traverse-creep", Some(i), vec![e])).collect();
    assembled("car", &CAR, &[Trailer { length: LENGTH, hitch: 0.0 }; TRAILERS], &creeps)
}

fn train(e: f64, times: &[f64]) -> Result<Train> {
    let model = model(e)?;
    let states = driven(&model, &INPUTS, &[], &[0.0; 3 + TRAILERS], times)?;
    // The angle the steering has come to.
    let steering = crate::formula::Expr::parse(INPUTS[1].1)?;
    let rig = |(t, z): (&f64, &Vec<f64>)| {
        let delta = steering.eval(&|_| *t).unwrap_or(f64::NAN);
        Rig::of(&model, z, &[("wheel_rate", 8.0), ("steering_angle", delta)])
    };
    let rigs = times.iter().zip(&states).map(rig).collect::<Result<Vec<Rig>>>()?;
    let paths = (0..=TRAILERS).map(|i| rigs.iter().map(|r| r.bodies[i].0).collect()).collect();
    let radii = rigs.last().map(radii_of).transpose()?.unwrap_or_default();
    Ok(Train { paths, radii, shown: rigs[SHOWN].clone() })
}

/// Speed over yaw rate, which all axles share in a steady turn.
fn radii_of(rig: &Rig) -> Result<Vec<f64>> {
    let turn = rig.value("phi'")?;
    let car = rig.velocity(rig.bodies[0].0)?;
    let speeds = std::iter::once(car[0].hypot(car[1])).chain(rig.wheels[2..].iter().map(super::RigWheel::speed));
    Ok(speeds.map(|v| v / turn).collect())
}

fn above(ideal: &Train, crept: &Train) -> Element {
    // The circles that follow would hide the corner.
    let shown = |path: &Vec<[f64; 2]>| path[..=SHOWN].to_vec();
    let all: Vec<[f64; 2]> =
        [ideal, crept].iter().flat_map(|t| [&t.paths[0], &t.paths[TRAILERS]]).flat_map(shown).collect();
    let mut panel = plane::plane(PATHS, plane::ranges(all.iter(), 0.08));
    panel.pieces("hair", &[shown(&ideal.paths[0])], plane::MAX_POINTS);
    panel.pieces("ideal", &[shown(&ideal.paths[TRAILERS])], plane::MAX_POINTS);
    panel.pieces("kept", &[shown(&crept.paths[TRAILERS])], plane::MAX_POINTS);
    for (class, marker, train) in [("kept", Marker::Circle, crept), ("ideal", Marker::Ring, ideal)] {
        panel.markers(class, marker, &train.paths[TRAILERS][SHOWN..=SHOWN]);
    }
    let bodies = crept.shown.outlines(CAR[1].1, AHEAD, WIDTH);
    panel.pieces("hair", &bodies, 4 * plane::MAX_POINTS);
    plane::name(&mut panel, PATHS, "rear axle of the car, and axle of the fifth trailer");
    panel.finish("paths", "Paths", "Paths of the car's rear axle and of the fifth trailer.")
}

fn radii(ideal: &Train, crept: &Train) -> Element {
    let points = |t: &Train| t.radii.iter().enumerate().map(|(i, r)| [i as f64, *r]).collect::<Vec<[f64; 2]>>();
    let (a, b) = (points(ideal), points(crept));
    let range = plane::ranges(a.iter().chain(&b), 0.08);
    let x = Axis::linear("axle (0: the car's)", "", [-0.2, TRAILERS as f64 + 0.2]);
    let mut panel = plane::graph(RADII, x, Axis::linear("", "", range[1]));
    for (class, marker, points) in [("kept", Marker::Circle, &b), ("ideal", Marker::Ring, &a)] {
        panel.series(class, points);
        panel.markers(class, marker, points);
    }
    panel.note(maths("caption", [RADII.columns()[1], RADII.rows()[1] - 12.0], "end", "radius in a steady turn, m"));
    panel.finish("radii", "Radii", "Radius of each axle's circle.")
}

fn path_table(times: &[f64], ideal: &Train, crept: &Train) -> Data {
    let names = ["t [s]", "car x [m]", "car y [m]", "last x ideal [m]", "last y ideal [m]", "last x [m]", "last y [m]"];
    let mut data = Data::new("paths", &names);
    for (i, t) in times.iter().enumerate().step_by(5) {
        let places = [ideal.paths[0][i], ideal.paths[TRAILERS][i], crept.paths[TRAILERS][i]].concat();
        data.row(std::iter::once(fixed(*t, 1)).chain(places.into_iter().map(|v| fixed(v, 5))));
    }
    data
}

fn radius_table(ideal: &Train, crept: &Train) -> Data {
    let mut data = Data::new("radii", &["axle", "radius ideal [m]", "radius with creep [m]"]);
    for (i, (a, b)) in ideal.radii.iter().zip(&crept.radii).enumerate() {
        data.row([i.to_string(), fixed(*a, 5), fixed(*b, 5)]);
    }
    data
}
