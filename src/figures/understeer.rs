//! Understeer and oversteer of a car from the traverse creep of its axles.

use super::{Data, Drawing, Figure, Options, Rig, fixed, key, page, plane};
use crate::error::Result;
use crate::model::Model;
use crate::motion::{assembled, driven};
use crate::number_format::decimals;
use crate::picture::axis::Axis;
use crate::picture::maths::maths;
use crate::picture::plot::{Marker, Size};
use crate::picture::svg::Element;

/// The figure.
pub const FIGURE: Figure = Figure {
    name: "understeer",
    title: "understeer of a car whose front axle creeps",
    source: "beyond the paper; theory/05b-corrected-single-body",
    draw,
};

const PATHS: Size = Size { width: 198.0, height: 246.0, margins: [34.0, 8.0, 36.0, 40.0] };
const CURVES: Size = Size { width: 198.0, height: 246.0, margins: [44.0, 14.0, 36.0, 40.0] };
/// A car, m; steering to the left, rad; wheel rate, rad/s; time, s.
const CAR: [(&str, f64); 2] = [("wheel_radius", 0.3), ("wheelbase", 2.6)];
const STEERING: f64 = 0.25;
const RATE: f64 = 8.0;
const TIME: f64 = 14.0;
/// The end of the axis of steering, rad: tyres of road cars turn no further.
const MAX_STEERING: f64 = 0.4;

/// Class, marker, name, and how much of the creep the front and the rear axle have.
const CASES: [(&str, Marker, &str, f64, f64); 4] = [
    ("ideal", Marker::Ring, "ideal", 0.0, 0.0),
    ("crept", Marker::Square, "front axle creeps", 1.0, 0.0),
    ("third", Marker::Ring, "rear axle creeps", 0.0, 1.0),
    ("kept", Marker::Circle, "both creep alike", 1.0, 1.0),
];

/// Creep to the outside of a left turn is negative; it takes yaw rate from the front and gives it at the rear.
fn draw(options: &Options) -> Result<Drawing> {
    let e = options.traverse(-0.08);
    let models = CASES.iter().map(|(_, _, _, front, rear)| car(front * e, rear * e)).collect::<Result<Vec<_>>>()?;
    let times: Vec<f64> = (0..=140).map(|i| TIME * f64::from(i) / 140.0).collect();
    let path = |m: &Model| {
        driven(m, &[("wheel_rate", "c_0"), ("steering_angle", "c_1")], &[RATE, STEERING], &[0.0; 3], &times)
    };
    let paths = models.iter().map(path).collect::<Result<Vec<_>>>()?;
    let curves = models.iter().map(curvatures).collect::<Result<Vec<_>>>()?;
    let mut elements =
        vec![page::placed(above(&paths), [2.0, 2.0], PATHS), page::placed(curvature(&curves), [200.0, 2.0], CURVES)];
    let entry = |(class, marker, text, _, _): &(&'static str, Marker, &'static str, f64, f64)| key::Entry {
        class,
        marker: Some(*marker),
        text,
    };
    let entries: Vec<key::Entry> = CASES.iter().map(entry).collect();
    elements.extend(key::column(&entries[..2], [20.0, 262.0]));
    elements.extend(key::column(&entries[2..], [210.0, 262.0]));
    elements.push(maths(
        "soft",
        [20.0, 300.0],
        "start",
        &format!("$e_{{tc}}$ = {}, left turn with $δ$ = {STEERING} rad", decimals(e, 2)),
    ));
    let description = "Left: paths of a car with a constant steering angle. Right: curvature over steering angle. A front \
                       axle that creeps outwards turns the car less, a rear axle more.";
    Ok(Drawing {
        svg: page::page(FIGURE.name, FIGURE.title, description, 310.0, elements),
        tables: vec![path_table(&times, &paths), curve_table(&curves)],
        text: String::new(),
    })
}

fn car(front: f64, rear: f64) -> Result<Model> {
    assembled("car", &CAR, &[], &[("front-traverse-creep", None, vec![front]), ("traverse-creep", None, vec![rear])])
}

/// Yaw rate over speed against the steering angle.
fn curvatures(model: &Model) -> Result<Vec<[f64; 2]>> {
    let at = |i: i32| {
        let delta = MAX_STEERING * f64::from(i) / 20.0;
        let rig = Rig::of(model, &[0.0; 3], &[("wheel_rate", RATE), ("steering_angle", delta)])?;
        Ok([delta, rig.value("phi'")? / rig.value("v_l")?])
    };
    (0..=20).map(at).collect()
}

fn above(paths: &[Vec<Vec<f64>>]) -> Element {
    let points: Vec<Vec<[f64; 2]>> = paths.iter().map(|p| p.iter().map(|z| [z[0], z[1]]).collect()).collect();
    let mut panel = plane::plane(PATHS, plane::ranges(points.iter().flatten(), 0.05));
    for ((class, marker, ..), path) in CASES.iter().zip(points) {
        panel.markers(class, *marker, &path[path.len() - 1..]);
        panel.pieces(class, &[path], plane::MAX_POINTS);
    }
    plane::name(&mut panel, PATHS, "paths of the rear axle");
    panel.finish("paths", "Paths", "Paths of the rear axle.")
}

fn curvature(curves: &[Vec<[f64; 2]>]) -> Element {
    let range = plane::ranges(curves.iter().flatten(), 0.03);
    let x = Axis::linear("", "", [0.0, MAX_STEERING]);
    let mut panel = plane::graph(CURVES, x, Axis::linear("", "", range[1]));
    // The dash-dotted line lies on the solid one where they nearly agree.
    for ((class, ..), curve) in CASES.iter().zip(curves).rev() {
        panel.series(class, curve);
    }
    for ((class, marker, ..), curve) in CASES.iter().zip(curves).rev() {
        let end = &curve[curve.len() - 1..];
        panel.markers(class, *marker, end);
    }
    let ([_, right], [bottom, top]) = (CURVES.columns(), CURVES.rows());
    panel.note(maths("caption", [right, bottom + 35.0], "end", "steering angle δ, rad"));
    panel.note(maths("caption", [right, top - 12.0], "end", "curvature $φ̇/v_{l}$, 1/m"));
    panel.finish("curvature", "Curvature", "Curvature over steering angle.")
}

fn path_table(times: &[f64], paths: &[Vec<Vec<f64>>]) -> Data {
    let mut data = Data::new("paths", &["case", "t [s]", "x [m]", "y [m]", "phi [rad]"]);
    for ((_, _, name, ..), path) in CASES.iter().zip(paths) {
        for (t, z) in times.iter().zip(path).step_by(5) {
            data.row([(*name).into(), fixed(*t, 2)].into_iter().chain(z[..3].iter().map(|v| fixed(*v, 6))));
        }
    }
    data
}

fn curve_table(curves: &[Vec<[f64; 2]>]) -> Data {
    let mut data = Data::new("curvature", &["case", "steering angle [rad]", "curvature [1/m]"]);
    for ((_, _, name, ..), curve) in CASES.iter().zip(curves) {
        curve.iter().for_each(|p| data.row([(*name).into(), fixed(p[0], 3), fixed(p[1], 6)]));
    }
    data
}
