//! Fig. 8: vehicles with two, three and four wheels, and a car with trailers.

use super::{Data, Drawing, Figure, Options, Rig, RigWheel, fixed, page};
use crate::describe::Signature;
use crate::error::Result;
use crate::model::{Model, Trailer};
use crate::motion::{Creep, assembled};
use crate::number_format::decimals;
use crate::picture::maths::maths;
use crate::picture::sketch::{Sketch, rounded, turned};
use crate::picture::svg::Element;
use std::f64::consts::FRAC_PI_2;

/// The figure.
pub const FIGURE: Figure = Figure {
    name: "fig8",
    title: "two, three and four wheels, and a car with trailers",
    source: "Fig. 8, (26)–(28)",
    draw,
};

/// A vehicle of the figure: the catalogue's, with numbers that make it readable.
struct Entry {
    title: &'static str,
    vehicle: &'static str,
    parameters: &'static [(&'static str, f64)],
    inputs: &'static [(&'static str, f64)],
    trailers: usize,
    /// Place of the reference point on the sheet, pixels to a metre, heading.
    at: [f64; 2],
    scale: f64,
    heading: f64,
    /// The body ahead of and behind the reference point, and its width, m.
    body: [f64; 3],
}

const TRACK: f64 = 1.5;
/// The radius of wheels that the description gives none, and the width of all, as shares of the largest radius.
const WIDTH: f64 = 0.55;
/// Lengths and hitches of the trailers, and how each is turned against the one ahead.
const TRAILERS: [(f64, f64, f64); 3] = [(2.6, 0.7, -0.3), (2.2, 0.4, -0.28), (2.2, 0.4, -0.25)];

const ENTRIES: [Entry; 4] = [
    Entry {
        title: "two wheels",
        vehicle: "differential-drive",
        parameters: &[("wheel_radius", 0.1), ("track_width", 0.5)],
        inputs: &[("wheel_rate_left", 6.0), ("wheel_rate_right", 8.0)],
        trailers: 0,
        at: [66.0, 128.0],
        scale: 140.0,
        heading: FRAC_PI_2,
        body: [0.16, 0.16, 0.34],
    },
    Entry {
        title: "three wheels",
        vehicle: "tricycle",
        parameters: &[("wheel_radius", 0.3), ("wheelbase", 1.7)],
        inputs: &[("wheel_rate", 4.5), ("steering_angle", 0.45)],
        trailers: 0,
        at: [200.0, 154.0],
        scale: 38.0,
        heading: FRAC_PI_2,
        body: [1.9, 0.4, 1.0],
    },
    Entry {
        title: "four wheels",
        vehicle: "four-wheel-car",
        parameters: &[("wheel_radius", 0.32), ("wheelbase", 2.4), ("track_width", TRACK)],
        inputs: &[("wheel_rate", 5.0), ("steering_angle", 0.4)],
        trailers: 0,
        at: [336.0, 160.0],
        scale: 33.0,
        heading: FRAC_PI_2,
        body: [3.0, 0.6, 1.55],
    },
    Entry {
        title: "a car with three trailers",
        vehicle: "car",
        parameters: &[("wheel_radius", 0.32), ("wheelbase", 2.4)],
        inputs: &[("wheel_rate", 5.0), ("steering_angle", 0.4)],
        trailers: 3,
        at: [282.0, 296.0],
        scale: 29.0,
        heading: 0.45,
        body: [3.0, 0.5, 1.55],
    },
];

fn draw(options: &Options) -> Result<Drawing> {
    let (e_rc, e_tc) = (options.rotation(0.1), options.traverse(0.15));
    let names = ["vehicle", "wheel", "x [m]", "y [m]", "heading [rad]", "vx [m/s]", "vy [m/s]", "creep angle [rad]"];
    let (mut data, mut elements) = (Data::new("", &names), Vec::new());
    for entry in &ENTRIES {
        let model = entry.model(e_rc, e_tc)?;
        let rig = entry.rig(&model)?;
        elements.extend(entry.picture(&rig)?);
        elements.extend(entry.words(&model));
        for w in &rig.wheels {
            let angle = if w.e_tc.is_some() { fixed(w.creep_angle(), 6) } else { String::new() };
            let cells = [w.at[0], w.at[1], w.heading, w.velocity[0], w.velocity[1]].map(|v| fixed(v, 6));
            data.row([entry.title.into(), w.name.clone()].into_iter().chain(cells).chain([angle]));
        }
    }
    let shown = [e_rc, e_tc].map(|e| decimals(e, 2));
    let values = format!("$e_{{rc}}$ = {}, $e_{{tc}}$ = {}", shown[0], shown[1]);
    for (y, words) in [(356.0, "Arrows: velocities of contacts, and of the middles of axles."), (373.0, &values)] {
        elements.push(maths("soft", [200.0, y], "middle", words));
    }
    let description = "Four vehicles from above, wheels where their descriptions have them. An arrow is the velocity of a \
                       wheel's contact, off its heading by the creep.";
    Ok(Drawing {
        svg: page::page(FIGURE.name, FIGURE.title, description, 384.0, elements),
        tables: vec![data],
        text: String::new(),
    })
}

impl Entry {
    /// Every wheel creeps alike along, and every axle alike across.
    fn model(&self, e_rc: f64, e_tc: f64) -> Result<Model> {
        let trailers: Vec<Trailer> =
            TRAILERS[..self.trailers].iter().map(|&(length, hitch, _)| Trailer { length, hitch }).collect();
        let mut creeps: Vec<Creep> = vec![("rotation-creep", None, vec![e_rc]), ("traverse-creep", None, vec![e_tc])];
        if self.inputs.iter().any(|(name, _)| *name == "steering_angle") {
            creeps.push(("front-traverse-creep", None, vec![e_tc]));
        }
        creeps.extend((1..=self.trailers).map(|i| ("trailer-traverse-creep", Some(i), vec![e_tc])));
        assembled(self.vehicle, self.parameters, &trailers, &creeps)
    }

    fn rig(&self, model: &Model) -> Result<Rig> {
        let mut state = vec![0.0, 0.0, self.heading];
        for (_, _, turn) in &TRAILERS[..self.trailers] {
            state.push(state[state.len() - 1] + turn);
        }
        Rig::of(model, &state, self.inputs)
    }

    fn picture(&self, rig: &Rig) -> Result<Vec<Element>> {
        let mut s = Sketch::new(self.at, self.scale);
        let radius = rig.wheels.iter().filter_map(|w| w.radius).fold(0.0, f64::max);
        let [ahead, behind, width] = self.body;
        let (place, heading) = rig.bodies[0];
        let middle = turned([0.5 * (ahead - behind), 0.0], place, heading);
        s.shape("body", &rounded(middle, heading, [ahead + behind, width], 0.12 * width.min(ahead + behind)));
        for (i, (at, heading)) in rig.bodies.iter().enumerate().skip(1) {
            let length = TRAILERS[i - 1].0;
            let middle = turned([0.42 * length - 0.35, 0.0], *at, *heading);
            s.shape("body", &rounded(middle, *heading, [0.84 * length, width], 0.15));
            s.line("ink", &[rig.hitches[i - 1], *at]);
            s.dot(rig.hitches[i - 1]);
        }
        let side = [2.0 * radius, WIDTH * radius];
        for wheel in &rig.wheels {
            let pair = self.pair(rig, wheel)?;
            // An axle whose wheels are described has a direction of its own, and no wheel.
            let alone = if wheel.radius.is_some() || wheel.steered { vec![wheel.clone()] } else { vec![] };
            for w in if pair.is_empty() { alone } else { pair } {
                s.wheel(if w.steered { "steered" } else { "wheel" }, w.at, w.heading, side);
            }
        }
        let seconds = 26.0 / self.scale / rig.wheels[0].speed().max(1e-9);
        for wheel in &rig.wheels {
            // A steered axle touches the ground at its two wheels, which have velocities of their own.
            let pair = if wheel.steered { self.pair(rig, wheel)? } else { vec![] };
            for w in if pair.is_empty() { std::slice::from_ref(wheel) } else { &pair[..] } {
                s.arrow("velocity", w.at, [0, 1].map(|k| w.at[k] + seconds * w.velocity[k]));
            }
        }
        s.dot(place);
        Ok(s.finish())
    }

    /// The two wheels that stand for an axle; none for a single wheel, and for an axle whose wheels are described.
    fn pair(&self, rig: &Rig, wheel: &RigWheel) -> Result<Vec<RigWheel>> {
        if wheel.name.starts_with("trailer") {
            let one = |side: f64| RigWheel {
                at: turned([0.0, 0.5 * side * TRACK], wheel.at, wheel.heading),
                ..wheel.clone()
            };
            return Ok(vec![one(-1.0), one(1.0)]);
        }
        match (wheel.name.contains("axle"), self.vehicle) {
            (true, "tricycle") => rig.axle(wheel, 0.62),
            (true, "differential-drive") => Ok(vec![]),
            (true, _) => rig.axle(wheel, 0.5 * TRACK),
            _ => Ok(vec![]),
        }
    }

    /// The title and the count of coefficients.
    fn words(&self, model: &Model) -> Vec<Element> {
        let signature = Signature::of(&model.constraints());
        let power = |letter: &str, n: usize| if n == 1 { letter.into() } else { format!("{letter}$^{{{n}}}$") };
        let count = format!("{}{}", power("R", signature.count('R')), power("T", signature.count('T')));
        let (x, y) = if self.trailers > 0 { (90.0, 214.0) } else { (self.at[0], 18.0) };
        vec![
            maths("heading", [x.max(66.0), y], "middle", self.title),
            maths("", [x.max(66.0), y + 17.0], "middle", &count),
        ]
    }
}
