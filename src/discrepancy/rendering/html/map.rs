//! The map: the measured path coloured by the error some seconds ahead, both models from one place, the error over time.
//!
//! What is drawn here stands without a script; the script moves the place, the view and the run.

use super::forecast_data::{self, disks, is_patched, top};
use super::part::holding;
use crate::discrepancy::report::{Forecast, Pictures, Report};
use crate::number_format::{decimals, plain, significant};
use crate::picture::axis::extent;
use crate::picture::svg::{Element, fixed, line, path_data, rect};
use crate::picture::theme::ERRORS;
use std::f64::consts::PI;

/// Width of the drawings, pixels.
const WIDTH: f64 = 1000.0;
/// Around the path, pixels.
const MARGIN: f64 = 40.0;
/// The least and the largest height of the map, pixels.
const HEIGHTS: [f64; 2] = [340.0, 620.0];
/// The strip of errors: its top, its bottom and its height, pixels.
const STRIP: [f64; 3] = [8.0, 116.0, 120.0];

/// The section of the map with its data; none without forecasts.
pub(super) fn section(report: &Report, pictures: &Pictures) -> Option<Element> {
    let of = pictures.forecasts.first()?;
    let worst = worst(of)?;
    let place = Placing::of(of);
    let is_patched = is_patched(report);
    let heading =
        if is_patched { "Where the model as given goes wrong" } else { "Where the model is wrong, and by how much" };
    let drawn = Element::new("div").with("class", "map").child(map(of, report, &place, worst)).child(scale(&place));
    Some(
        Element::new("section")
            .with("id", "where")
            .child(holding("h2", heading))
            .child(tools(&pictures.forecasts, is_patched))
            .child(drawn)
            .child(key(&pictures.forecasts, is_patched))
            .child(
                holding("p", said(of, worst, is_patched))
                    .with("id", "read")
                    .with("class", "read")
                    .with("aria-live", "polite"),
            )
            .child(slider(of, worst))
            .child(strip(of, report, worst))
            .child(ends(of))
            .child(forecast_data::block(report, &pictures.forecasts)),
    )
}

/// The place from which the model as given errs most.
fn worst(of: &Forecast) -> Option<usize> {
    let known = (0..of.error.len()).filter(|i| of.error[*i][0].is_finite());
    known.max_by(|a, b| of.error[*a][0].total_cmp(&of.error[*b][0]))
}

/// From metres to pixels, x to the right and y upwards.
struct Placing {
    middle: [f64; 2],
    scale: f64,
    height: f64,
}

impl Placing {
    fn of(run: &Forecast) -> Self {
        let along = |i: usize| extent(run.pose.iter().map(|p| p[i])).unwrap_or([0.0, 1.0]);
        let [x, y] = [along(0), along(1)];
        let (wide, high) = ((x[1] - x[0]).max(1e-3), (y[1] - y[0]).max(1e-3));
        let inner = WIDTH - 2.0 * MARGIN;
        let height = (inner * high / wide + 2.0 * MARGIN).clamp(HEIGHTS[0], HEIGHTS[1]);
        let scale = (inner / wide).min((height - 2.0 * MARGIN) / high);
        Self { middle: [(x[0] + x[1]) / 2.0, (y[0] + y[1]) / 2.0], scale, height }
    }

    fn at(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [WIDTH / 2.0 + (x - self.middle[0]) * self.scale, self.height / 2.0 - (y - self.middle[1]) * self.scale]
    }
}

fn tools(forecasts: &[Forecast], is_patched: bool) -> Element {
    let button = |id: &str, text: &str| holding("button", text).with("type", "button").with("id", id);
    let by = |id: &str, text: &str, on: &str| button(id, text).with("aria-pressed", on);
    let option = |(i, f): (usize, &Forecast)| {
        let held_out = if f.held_out_from == f64::NEG_INFINITY { ", held out" } else { "" };
        holding("option", format!("{}{held_out}", f.run)).with("value", i.to_string())
    };
    let runs = Element::new("select").with("id", "run").children(forecasts.iter().enumerate().map(option));
    let picker = Element::new("label").text("run, by what remains: ").child(runs);
    let which = [
        holding("span", "coloured by the error of the model").with("class", "small"),
        by("by-before", "as given", "true"),
        by("by-after", "patched", "false"),
    ];
    Element::new("div")
        .with("class", "tools")
        .with("data-live", "")
        .with("hidden", "")
        .child(picker)
        .children(which.into_iter().filter(|_| is_patched))
        .child(button("play", "play"))
        .child(button("closer", "+").with("aria-label", "zoom in"))
        .child(button("farther", "−").with("aria-label", "zoom out"))
        .child(button("whole", "whole path"))
}

fn map(of: &Forecast, report: &Report, place: &Placing, at: usize) -> Element {
    let path =
        Element::new("g").with("id", "path").children(coloured(of, place)).children(disks(report).iter().map(|d| {
            let [x, y] = place.at([d[0], d[1]]);
            Element::new("circle")
                .with("class", "scope")
                .number("cx", x)
                .number("cy", y)
                .number("r", d[2] * place.scale)
        }));
    let [title, id] = ["map-title", "map-says"];
    Element::new("svg")
        .with("id", "map")
        .with("viewBox", format!("0 0 {WIDTH} {}", fixed(place.height)))
        .with("role", "img")
        .with("aria-labelledby", format!("{title} {id}"))
        .child(
            holding("title", format!("{} seen from above, coloured by the error {} s ahead", of.run, plain(of.ahead)))
                .with("id", title),
        )
        .child(holding("desc", described(of, is_patched(report))).with("id", id))
        .child(path)
        .child(Element::new("g").with("id", "ghosts").children(ghosts(of, place, at, is_patched(report))))
}

/// The path in six colours, wider where the error is larger, over a casing that keeps it apart from the paper.
fn coloured(of: &Forecast, place: &Placing) -> Vec<Element> {
    let points: Vec<[f64; 2]> = of.pose.iter().map(|p| place.at([p[0], p[1]])).collect();
    let top = top(of);
    let mut pieces = vec![String::new(); ERRORS.len()];
    for (i, pair) in points.windows(2).enumerate() {
        let error = of.error[i + 1][0];
        if !error.is_finite() {
            continue;
        }
        let bin = (ERRORS.len() as f64 * error / top) as usize;
        pieces[bin.min(ERRORS.len() - 1)].push_str(&path_data(pair));
    }
    let drawn = |(k, d): (usize, String)| Element::new("path").with("class", format!("error e{k}")).with("d", d);
    let casing = Element::new("path").with("class", "casing").with("d", path_data(&points));
    std::iter::once(casing).chain(pieces.into_iter().enumerate().filter(|(_, d)| !d.is_empty()).map(drawn)).collect()
}

/// The measured path, both models and the robot from one place on.
fn ghosts(of: &Forecast, place: &Placing, at: usize, is_patched: bool) -> Vec<Element> {
    let line = |class: &str, points: Vec<[f64; 2]>| {
        Element::new("path").with("class", format!("line {class}")).with("d", path_data(&points))
    };
    let until = of.time[at] + of.ahead;
    let ahead =
        (at..of.time.len()).take_while(|j| of.time[*j] <= until).map(|j| place.at([of.pose[j][0], of.pose[j][1]]));
    let mut drawn = vec![line("ahead", ahead.collect())];
    for (class, path) in ["before", "after"].into_iter().zip(&of.paths[at]).take(1 + usize::from(is_patched)) {
        drawn.push(line(class, path.iter().map(|p| place.at(*p)).collect()));
        if let Some(end) = path.last() {
            let [x, y] = place.at(*end);
            let mark = Element::new("circle").with("class", format!("mark {class}"));
            drawn.push(mark.number("cx", x).number("cy", y).number("r", 6.0));
        }
    }
    let [x, y, heading] = of.pose[at];
    let [x, y] = place.at([x, y]);
    let turned = format!("translate({} {}) rotate({})", fixed(x), fixed(y), fixed(-heading * 180.0 / PI));
    drawn.push(
        Element::new("path").with("class", "robot").with("d", "M15 0L-9 9L-4 0L-9 -9Z").with("transform", turned),
    );
    drawn
}

/// A bar of a round length: a quarter of the map at most.
fn scale(place: &Placing) -> Element {
    let metres = WIDTH / place.scale;
    let decade = 10f64.powf((metres / 4.0).log10().floor());
    let step = [5.0, 2.0, 1.0].map(|f| f * decade).into_iter().find(|s| *s <= metres / 4.0).unwrap_or(decade);
    let text = if step < 1.0 { format!("{} mm", plain((1000.0 * step).round())) } else { format!("{} m", plain(step)) };
    holding("span", text)
        .with("class", "scale")
        .with("id", "scale")
        .with("style", format!("width:{}%", fixed(100.0 * step / metres)))
}

fn key(all: &[Forecast], is_patched: bool) -> Element {
    let of = &all[0];
    let is_scoped = all.iter().any(|f| !f.scoped.is_empty());
    let entry = |class: &str, text: String| {
        let swatch = Element::new("i").with("class", format!("swatch {class}"));
        Element::new("span").child(swatch).text(text)
    };
    let steps = (0..ERRORS.len()).map(|k| Element::new("i").with("class", format!("step e{k}")));
    let ramp = Element::new("span")
        .text(format!("error {} s ahead: 0 ", plain(of.ahead)))
        .child(Element::new("span").with("class", "ramp").with("aria-hidden", "true").children(steps))
        .text(" ")
        .child(holding("span", length(top(of))).with("id", "most"));
    Element::new("p")
        .with("class", "legend")
        .child(ramp)
        .child(entry("ahead", format!("measured, the next {} s", plain(of.ahead))))
        .child(entry("before", if is_patched { "model as given from there" } else { "model from there" }.into()))
        .children(is_patched.then(|| entry("after", "patched model from there".into())))
        .child(entry("noise", "noise alone".into()))
        .child(entry("kept", "held out".into()))
        .children(is_scoped.then(|| entry("framed", "when the effect holds".into())))
}

fn slider(of: &Forecast, at: usize) -> Element {
    Element::new("input")
        .with("type", "range")
        .with("id", "cursor")
        .with("min", "0")
        .with("max", (of.time.len() - 1).to_string())
        .with("value", at.to_string())
        .with("aria-label", "time in the run")
        .with("data-live", "")
        .with("hidden", "")
}

fn strip(of: &Forecast, report: &Report, at: usize) -> Element {
    let (from, top) = (of.time[0], top(of));
    let span = (of.time[of.time.len() - 1] - from).max(1e-9);
    let x = |t: f64| WIDTH * (t - from) / span;
    let [high, low, height] = STRIP;
    let shaded = of.scoped.iter().map(|span| {
        let [a, b] = span.map(|t| x(t).clamp(0.0, WIDTH));
        rect("scope", [a, high - 4.0], b - a, low - high + 4.0)
    });
    let y = |error: f64| low - (low - high) * error / top;
    let held = of.held_out_from.clamp(from, from + span);
    let held = rect("held", [x(held), high - 4.0], WIDTH - x(held), low - high + 4.0);
    let floor = of.floor.is_finite().then(|| line("line floor", [0.0, y(of.floor)], [WIDTH, y(of.floor)]));
    let curve = |k: usize, class: &str| {
        let points: Vec<[f64; 2]> = of.time.iter().zip(&of.error).map(|(t, e)| [x(*t), y(e[k])]).collect();
        Element::new("path").with("class", format!("line {class}")).with("d", path_data(&points))
    };
    let curves = Element::new("g")
        .with("id", "strips")
        .child(held)
        .children(shaded)
        .children(floor)
        .child(curve(0, "before"))
        .children(is_patched(report).then(|| curve(1, "after")));
    Element::new("svg")
        .with("id", "strip")
        .with("viewBox", format!("0 0 {WIDTH} {height}"))
        .with("preserveAspectRatio", "none")
        .with("role", "img")
        .with("aria-labelledby", "strip-title strip-says")
        .child(holding("title", format!("The error {} s ahead over time", plain(of.ahead))).with("id", "strip-title"))
        .child(holding("desc", described(of, is_patched(report))).with("id", "strip-says"))
        .child(curves)
        .child(line("axis", [0.0, low], [WIDTH, low]))
        .child(line("now", [x(of.time[at]), high - 4.0], [x(of.time[at]), low]).with("id", "now"))
}

/// What stands at the ends of the strip, as text that does not shrink with it.
fn ends(of: &Forecast) -> Element {
    let span = |id: &str, text: String| holding("span", text).with("id", id);
    Element::new("p")
        .with("class", "ends")
        .child(span("strip-from", format!("{} s", decimals(of.time[0], 1))))
        .child(Element::new("span").text("error ahead, up to ").child(span("strip-top", length(top(of)))))
        .child(span("strip-until", format!("{} s", decimals(of.time[of.time.len() - 1], 1))))
}

fn said(of: &Forecast, at: usize, is_patched: bool) -> String {
    let [before, after] = of.error[at].map(length);
    let off = match is_patched {
        true => format!("the model as given is off by {before}, the patched one by {after}"),
        false => format!("the model is off by {before}"),
    };
    format!("At {} s: {} s later {off}.", decimals(of.time[at], 1), plain(of.ahead))
}

/// What the picture shows, with its numbers.
fn described(of: &Forecast, is_patched: bool) -> String {
    let largest = |k: usize| of.error.iter().map(|e| e[k]).filter(|e| e.is_finite()).fold(0.0, f64::max);
    let at = worst(of).map_or(0.0, |i| of.time[i]);
    let most = format!("errs most from {} s on, by {}", decimals(at, 1), length(largest(0)));
    match is_patched {
        true => format!("The model as given {most}; the patched one by {} at most.", length(largest(1))),
        false => format!("The model {most}."),
    }
}

/// A length to two digits.
fn length(m: f64) -> String {
    if m < 0.9995 { format!("{} mm", significant(1000.0 * m, 2)) } else { format!("{} m", significant(m, 2)) }
}
