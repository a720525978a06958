//! Fig. 7: the simulation of the single wheel, four cases.

use super::readings;
use super::readings::CASES;
use super::{Data, Drawing, Figure, Options, fixed, key, page, plane};
use crate::energy_rule::{EndPoint, FIG7_DURATION, Reading, fig7_case, fig7_path};
use crate::error::Result;
use crate::number_format::plain;
use crate::picture::maths::maths;
use crate::picture::plot::{Marker, Panel, Size};
use crate::picture::svg::{Element, path};

/// The figure.
pub const FIGURE: Figure = Figure {
    name: "fig7",
    title: "the simulated wheel: ideal, non-conservative, conservative",
    source: "Fig. 7",
    draw,
};

/// A panel, and where the four are.
const PANEL: Size = Size { width: 198.0, height: 228.0, margins: [34.0, 22.0, 44.0, 40.0] };
const TOP: f64 = 26.0;
/// Steps of a curve.
const STEPS: usize = 180;
/// Decimals of lengths and angles at the end, finer than the reference asks for.
const END_DECIMALS: usize = 10;

/// The curves of a case.
struct Case {
    name: &'static str,
    e: [f64; 2],
    ideal: Vec<EndPoint>,
    plain: Vec<EndPoint>,
    kept: Vec<EndPoint>,
}

/// Four cases, each ideal, with creep at the ideal rates (non-conservative) and with rates scaled so that the energy
/// rule holds in the reading asked for (conservative).
fn draw(options: &Options) -> Result<Drawing> {
    let times: Vec<f64> = (0..=STEPS).map(|i| FIG7_DURATION * i as f64 / STEPS as f64).collect();
    let path = |e_rc, e_tc, reading| fig7_path(e_rc, e_tc, reading, &times);
    let case = |(name, e_rc, e_tc): &(&'static str, f64, f64)| {
        Ok(Case {
            name,
            e: [*e_rc, *e_tc],
            ideal: path(0.0, 0.0, Reading::NonConservative)?,
            plain: path(*e_rc, *e_tc, Reading::NonConservative)?,
            kept: path(*e_rc, *e_tc, options.reading)?,
        })
    };
    let cases = CASES.iter().map(case).collect::<Result<Vec<_>>>()?;
    let description = format!(
        "Four panels, x and y in metres: the ideal path dash-dotted, the non-conservative one dashed, the conservative \
         one (reading {}) solid.",
        options.reading.name()
    );
    let judged = readings::table()?;
    Ok(Drawing {
        svg: page::page(
            FIGURE.name,
            FIGURE.title,
            &description,
            TOP + 2.0 * PANEL.height,
            picture(&cases, options.reading),
        ),
        tables: vec![paths(&cases, &times, options.reading), ends()?, judged.data()],
        text: judged.text(),
    })
}

fn xy(path: &[EndPoint]) -> Vec<[f64; 2]> {
    path.iter().map(|p| [p.x, p.y]).collect()
}

fn picture(cases: &[Case], reading: Reading) -> Vec<Element> {
    let all: Vec<[f64; 2]> = cases.iter().flat_map(|c| [xy(&c.ideal), xy(&c.plain), xy(&c.kept)].concat()).collect();
    let ranges = plane::ranges(all.iter(), 0.04);
    let kept = format!("conservative, {}", reading.name().replace("_l", "$_{l}$"));
    let mut out = key::row(
        &[
            key::Entry { class: "ideal", marker: Some(Marker::Ring), text: "ideal" },
            key::Entry { class: "crept", marker: Some(Marker::Square), text: "non-conservative" },
            key::Entry { class: "kept", marker: Some(Marker::Circle), text: &kept },
        ],
        [8.0, 14.0],
    );
    for (i, case) in cases.iter().enumerate() {
        let at = [if i % 2 == 0 { 2.0 } else { 200.0 }, TOP + PANEL.height * (i / 2) as f64];
        out.push(page::placed(panel(case, ranges), at, PANEL));
    }
    out
}

fn panel(case: &Case, ranges: [[f64; 2]; 2]) -> Element {
    let mut panel = plane::plane(PANEL, ranges);
    // The solid line lies on the dashed one where they agree, and leaves its edges to be seen.
    for (class, path) in [("ideal", &case.ideal), ("crept", &case.plain), ("kept", &case.kept)] {
        panel.pieces(class, &[xy(path)], plane::MAX_POINTS);
    }
    // Small marks on large ones: all three are seen where they end together.
    for (class, marker, path) in [
        ("crept", Marker::Square, &case.plain),
        ("kept", Marker::Circle, &case.kept),
        ("ideal", Marker::Ring, &case.ideal),
    ] {
        panel.markers(class, marker, &xy(&path[path.len() - 1..]));
    }
    panel.markers("start", Marker::Ring, &[[case.ideal[0].x, case.ideal[0].y]]);
    sense(&mut panel, &case.ideal);
    let [e_rc, e_tc] = case.e.map(plain);
    let name = format!("({}) $e_{{rc}}$ = {e_rc}, $e_{{tc}}$ = {e_tc}", case.name);
    panel.note(maths("", [4.0, 14.0], "start", &name));
    let title = format!("Case ({})", case.name);
    panel.finish(&format!("case-{}", case.name), &title, "The three paths of this case.")
}

/// An arrow at an eighth of the ideal path: the sense of motion of all three.
fn sense(panel: &mut Panel, ideal: &[EndPoint]) {
    let at = |i: usize| panel.place([ideal[i].x, ideal[i].y]);
    let ([x, y], before) = (at(STEPS / 8), at(STEPS / 8 - 2));
    let along = (y - before[1]).atan2(x - before[0]);
    let corner = |length: f64, turn: f64| [x + length * (along + turn).cos(), y + length * (along + turn).sin()];
    panel.note(path("head", &[corner(6.0, 0.0), corner(5.5, 2.5), corner(5.5, -2.5)]));
}

fn paths(cases: &[Case], times: &[f64], reading: Reading) -> Data {
    let names = ["case", "curve", "t [s]", "x [m]", "y [m]", "phi [rad]", "theta [rad]", "distance [m]"];
    let mut data = Data::new("paths", &names);
    for case in cases {
        let kept = format!("conservative {}", reading.name());
        for (curve, path) in [("ideal", &case.ideal), ("non-conservative", &case.plain), (kept.as_str(), &case.kept)] {
            for (t, p) in times.iter().zip(path) {
                let numbers = numbers(p).map(|v| fixed(v, 6));
                data.row([case.name.into(), curve.into(), fixed(*t, 6)].into_iter().chain(numbers));
            }
        }
    }
    data
}

fn numbers(p: &EndPoint) -> [f64; 5] {
    [p.x, p.y, p.phi, p.theta, p.distance]
}

/// The ends of every case under every reading.
fn ends() -> Result<Data> {
    let names = ["case", "reading", "x [m]", "y [m]", "phi [rad]", "theta [rad]", "distance [m]"];
    let mut data = Data::new("ends", &names);
    let mut row = |case: &str, reading: &str, end: EndPoint| {
        let cells = numbers(&end).map(|v| fixed(v, END_DECIMALS));
        data.row([case.into(), reading.into()].into_iter().chain(cells));
    };
    row("all", "ideal", fig7_case(0.0, 0.0, Reading::NonConservative)?);
    for (name, e_rc, e_tc) in CASES {
        for reading in Reading::ALL {
            row(name, reading.name(), fig7_case(e_rc, e_tc, reading)?);
        }
    }
    Ok(data)
}
