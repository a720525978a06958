//! The ideal limit: how motion with creep approaches the ideal one.

use super::{Data, Drawing, Figure, Options, fixed, key, page, plane, scientific};
use crate::error::Result;
use crate::model::Trailer;
use crate::motion::{Creep, assembled, driven};
use crate::number_format::decimals;
use crate::picture::axis::Axis;
use crate::picture::maths::maths;
use crate::picture::plot::{Marker, Size};
use crate::picture::svg::Element;

/// The figure.
pub const FIGURE: Figure = Figure {
    name: "ideal-limit",
    title: "creep motion approaches the ideal one with order one",
    source: "beyond the paper; theory/07-ideal-limit",
    draw,
};

const PANEL: Size = Size { width: 396.0, height: 262.0, margins: [52.0, 14.0, 36.0, 42.0] };
/// Creeps, from large to small.
const SCALES: [f64; 9] = [0.3, 0.1, 0.03, 0.01, 0.003, 0.001, 0.0003, 0.0001, 0.00003];
const TIME: f64 = 5.0;

/// A vehicle, its inputs, and what of each creep it has.
struct Entry {
    class: &'static str,
    marker: Marker,
    name: &'static str,
    vehicle: &'static str,
    parameters: &'static [(&'static str, f64)],
    inputs: &'static [(&'static str, &'static str)],
    trailers: usize,
}

const ENTRIES: [Entry; 3] = [
    Entry {
        class: "kept",
        marker: Marker::Circle,
        name: "single wheel",
        vehicle: "unicycle",
        parameters: &[("wheel_radius", 0.5)],
        inputs: &[("wheel_rate", "2 + sin(t)"), ("yaw_rate", "cos(2*t)")],
        trailers: 0,
    },
    Entry {
        class: "crept",
        marker: Marker::Square,
        name: "differential drive, wheels creeping unequally",
        vehicle: "differential-drive",
        parameters: &[("wheel_radius", 0.1), ("track_width", 0.4)],
        inputs: &[("wheel_rate_left", "9 + 2*sin(t)"), ("wheel_rate_right", "10 + 2*cos(2*t)")],
        trailers: 0,
    },
    Entry {
        class: "third",
        marker: Marker::Ring,
        name: "single wheel with three trailers, the last axle",
        vehicle: "unicycle",
        parameters: &[("wheel_radius", 0.5)],
        inputs: &[("wheel_rate", "2 + sin(t)"), ("yaw_rate", "cos(2*t)")],
        trailers: 3,
    },
];

const TRAILERS: [Trailer; 3] =
    [Trailer { length: 1.2, hitch: 0.2 }, Trailer { length: 0.8, hitch: 0.2 }, Trailer { length: 1.0, hitch: 0.2 }];

impl Entry {
    /// The place of the last axle after some seconds at creeps in proportion to a scale.
    fn end(&self, e: f64) -> Result<[f64; 2]> {
        let mut creeps: Vec<Creep> = vec![("traverse-creep", None, vec![0.6 * e])];
        creeps.push(match self.vehicle {
            "differential-drive" => ("unequal-rotation-creep", None, vec![e, -0.5 * e]),
            _ => ("rotation-creep", None, vec![e]),
        });
        creeps.extend((1..=self.trailers).map(|i| ("trailer-traverse-creep", Some(i), vec![-2.0 * e])));
        let model = assembled(self.vehicle, self.parameters, &TRAILERS[..self.trailers], &creeps)?;
        let start = vec![0.0; 3 + self.trailers];
        let states = driven(&model, self.inputs, &[], &start, &[0.0, TIME])?;
        let end = &states[1];
        // The last axle hangs behind by lengths and hitches, along the headings.
        let mut place = [end[0], end[1]];
        for (i, trailer) in TRAILERS[..self.trailers].iter().enumerate() {
            place = crate::picture::sketch::polar(place, -trailer.hitch, end[2 + i]);
            place = crate::picture::sketch::polar(place, -trailer.length, end[3 + i]);
        }
        Ok(place)
    }

    fn gaps(&self) -> Result<Vec<[f64; 2]>> {
        let ideal = self.end(0.0)?;
        let gap = |e: &f64| self.end(*e).map(|p| [*e, (p[0] - ideal[0]).hypot(p[1] - ideal[1])]);
        SCALES.iter().map(gap).collect()
    }
}

/// The order between two neighbours: how many powers of the creep the gap shrinks with.
fn order(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[1] / b[1]).ln() / (a[0] / b[0]).ln()
}

fn draw(_: &Options) -> Result<Drawing> {
    let curves = ENTRIES.iter().map(Entry::gaps).collect::<Result<Vec<_>>>()?;
    let mut data = Data::new("", &["vehicle", "creep [1]", "distance from the ideal [m]", "order to the next [1]"]);
    for (entry, curve) in ENTRIES.iter().zip(&curves) {
        for (i, point) in curve.iter().enumerate() {
            let order = curve.get(i + 1).map_or(String::new(), |next| fixed(order(*point, *next), 4));
            data.row([entry.name.into(), scientific(point[0], 2), scientific(point[1], 5), order]);
        }
    }
    let elements = picture(&curves);
    let description = "Distance from the ideal motion after five seconds over the size of the creep, both logarithmic: \
                       straight lines of slope one.";
    let svg = page::page(FIGURE.name, FIGURE.title, description, 342.0, elements);
    Ok(Drawing { svg, tables: vec![data], text: String::new() })
}

fn picture(curves: &[Vec<[f64; 2]>]) -> Vec<Element> {
    let values = || curves.iter().flatten().map(|p| p[1]);
    let (low, high) = (values().fold(f64::MAX, f64::min), values().fold(0.0, f64::max));
    let x = Axis::log("size of the creep e", "1", [SCALES[8], SCALES[0]]);
    let mut panel = plane::graph(PANEL, x, Axis::log("distance from the ideal motion", "m", [low, high]));
    for (entry, curve) in ENTRIES.iter().zip(curves) {
        panel.series(entry.class, curve);
        panel.markers(entry.class, entry.marker, curve);
    }
    slope(&mut panel, low, high);
    let mut out =
        vec![page::placed(panel.finish("limit", "The ideal limit", "Distance over creep."), [2.0, 2.0], PANEL)];
    let last = |curve: &Vec<[f64; 2]>| decimals(order(curve[curve.len() - 2], curve[curve.len() - 1]), 4);
    let texts: Vec<String> = ENTRIES.iter().zip(curves).map(|(e, c)| format!("{}: {}", e.name, last(c))).collect();
    let entries: Vec<key::Entry> = ENTRIES
        .iter()
        .zip(&texts)
        .map(|(e, text)| key::Entry { class: e.class, marker: Some(e.marker), text })
        .collect();
    out.extend(key::column(&entries, [14.0, 280.0]));
    out.push(maths("soft", [390.0, 332.0], "end", "numbers: the order, the slope at the smallest creeps"));
    out
}

/// A triangle of slope one.
fn slope(panel: &mut crate::picture::plot::Panel, low: f64, high: f64) {
    let (e, y) = (0.003, (low * high).sqrt() * 0.03);
    let corner = [[e, y], [10.0 * e, y], [10.0 * e, 10.0 * y], [e, y]];
    panel.series("hair", &corner[..3]);
    panel.pieces("hair", &[corner.to_vec()], plane::MAX_POINTS);
    let at = panel.place([10.0 * e, 3.2 * y]);
    panel.note(maths("soft", [at[0] + 6.0, at[1] + 4.0], "start", "1"));
    let at = panel.place([3.2 * e, y]);
    panel.note(maths("soft", [at[0], at[1] + 14.0], "middle", "1"));
}
