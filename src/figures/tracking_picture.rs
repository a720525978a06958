//! Drives with feedback as a picture: the first drive of each way from above, and how far each is from its plan over time.

use super::{key, page, plane};
use crate::picture::axis::Axis;
use crate::picture::plot::{Marker, Size};
use crate::picture::svg::Element;
use crate::tracking::{Tracked, Way, way_in_words};

const ABOVE: Size = Size { width: 396.0, height: 250.0, margins: [40.0, 10.0, 32.0, 40.0] };
const OVER_TIME: Size = Size { width: 396.0, height: 210.0, margins: [52.0, 10.0, 32.0, 40.0] };

/// The ways that are drawn: id, class of the line, marker at its end.
const DRAWN: [(&str, &str, Option<Marker>); 4] = [
    ("model", "measured", None),
    ("ideal-plan", "floor", None),
    ("ideal", "crept", Some(Marker::Square)),
    ("observer", "kept", Some(Marker::Circle)),
];

/// The least error that is drawn, m.
const LEAST: f64 = 1e-5;

/// The picture as a file of its own.
pub fn tracking_picture(found: &Tracked) -> String {
    let all = DRAWN.iter().filter_map(|d| found.ways.iter().find(|w| w.id == d.0).map(|w| (d, w)));
    let drawn: Vec<_> = all.collect();
    let paths: Vec<Vec<[f64; 2]>> = drawn.iter().map(|(_, w)| path(w)).collect();
    let goal = drawn.first().and_then(|(_, w)| w.reference.poses.last()).map_or([0.0; 2], |p| [p[0], p[1]]);
    let ranges = plane::ranges(paths.iter().flatten().chain(&[goal]), 0.06);
    let mut above = plane::plane(ABOVE, ranges);
    let errors: Vec<Vec<[f64; 2]>> = drawn.iter().map(|(_, w)| errors(w, found.report.sample_s)).collect();
    let of = |f: fn(f64, f64) -> f64, i: usize, start: f64| errors.iter().flatten().map(|p| p[i]).fold(start, f);
    let y = Axis::log("distance from its own plan", "m", [of(f64::min, 1, 1e-2), of(f64::max, 1, 2e-2)]);
    let mut over_time = plane::graph(OVER_TIME, Axis::linear("time", "s", [0.0, of(f64::max, 0, 1.0)]), y);
    for (((_, class, marker), _), (path, errors)) in drawn.iter().zip(paths.iter().zip(&errors)) {
        above.pieces(class, std::slice::from_ref(path), plane::MAX_POINTS);
        over_time.pieces(class, std::slice::from_ref(errors), plane::MAX_POINTS);
        if let Some(marker) = marker {
            above.markers(class, *marker, &path[path.len() - 1..]);
            over_time.markers(class, *marker, &errors[errors.len() - 1..]);
        }
    }
    above.markers("start", Marker::Ring, &[goal]);
    let is_bare = found.report.effects.is_empty();
    let entry = |(id, class, marker): &(&str, &'static str, Option<Marker>)| key::Entry {
        class,
        marker: *marker,
        text: way_in_words(id, is_bare),
    };
    let entries: Vec<key::Entry> = drawn.iter().map(|(drawn, _)| entry(drawn)).collect();
    let above = above.finish("above", "Drives from above", "The first drive of each way, x and y in metres.");
    let description = "The mean over all drives, at each sample.";
    let over_time = over_time.finish("over-time", "Distance from the plan over time", description);
    let mut elements: Vec<Element> =
        vec![page::placed(above, [2.0, 2.0], ABOVE), page::placed(over_time, [2.0, 258.0], OVER_TIME)];
    elements.extend(key::column(&entries, [20.0, 484.0]));
    let description = "Above, the paths of a vehicle that creeps, driven to one goal with feedback on several models; below, \
                       how far each is from its own plan over time.";
    page::page("track", "Plans driven with feedback", description, 490.0 + 16.0 * entries.len() as f64, elements)
}

/// The first drive from above.
fn path(way: &Way) -> Vec<[f64; 2]> {
    way.drives.first().map_or(vec![], |d| d.poses.iter().map(|p| [p[0], p[1]]).collect())
}

/// Time and mean distance from the plan.
fn errors(way: &Way, sample: f64) -> Vec<[f64; 2]> {
    let off = |k: usize| {
        let wanted = &way.reference.poses[k];
        let each = way.drives.iter().map(|d| (d.poses[k][0] - wanted[0]).hypot(d.poses[k][1] - wanted[1]));
        each.sum::<f64>() / way.drives.len() as f64
    };
    // At the beginning all stand where the plan does.
    (1..way.reference.poses.len()).map(|k| [k as f64 * sample, off(k).max(LEAST)]).collect()
}
