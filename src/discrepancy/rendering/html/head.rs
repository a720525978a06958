//! The top of the page: the state, what was driven, the sentence, and what was found in one line each.

use super::part::{self, holding};
use crate::discrepancy::rendering::patched_state::{self, State};
use crate::discrepancy::rendering::summary::{verdict_sentence, why};
use crate::discrepancy::rendering::{plain_text, slip_text, title_text};
use crate::discrepancy::report::{Driving, Estimate, Named, OddRun, Pictures, Report, Verdict};
use crate::discrepancy::report::{judged, middle};
use crate::number_format::{plain, prefixed, significant, with_error};
use crate::picture::svg::Element;
use crate::wording::counted;

/// State, vehicle and data; the sentence; what it amounts to.
pub fn header(report: &Report, pictures: &Pictures) -> Element {
    Element::new("header")
        .child(eyebrow(report, pictures))
        .child(unbroken("h1", &sentence(report)))
        .children(lead(report))
        .children(reasons(report))
}

/// What was found, for anyone: the effects' own sentences where the report's sentence is made of them.
pub fn sentence(report: &Report) -> String {
    let composed = plain_text::sentences_with_ids(&report.effects);
    let is_composed = report.summary.is_empty() || report.summary.starts_with(composed.trim_end_matches('.'));
    let plain = report.verdict == Verdict::MissingEffect
        && report.odd_runs.is_empty()
        && !report.effects.is_empty()
        && report.effects.iter().all(|e| !e.plain.is_empty());
    if plain && is_composed { plain_text::sentences(&report.effects) } else { odd_or_whole(report) }
}

/// The sentence of runs that differ, or else the report's own without the lines to paste, which stand below it.
fn odd_or_whole(report: &Report) -> String {
    let is_told = report.odd_runs.iter().all(|o| !o.plain.is_empty());
    if report.odd_runs.is_empty() || !is_told || report.verdict != Verdict::MissingEffect {
        let whole = verdict_sentence(report);
        let is_mended = report.data.findings.iter().any(|f| f.mend.is_some());
        let cut = whole.split_once(slip_text::PASTE).filter(|_| is_mended).map(|(says, _)| says.to_string());
        return cut.unwrap_or(whole);
    }
    let odd = |o: &OddRun| format!("In {} {}, and in no other run.", o.run, plain_text::within(&o.plain));
    let others = match &report.effects[..] {
        [] => "The model explains the others.".into(),
        effects => format!("In the others {}", plain_text::within(&plain_text::sentences(effects))),
    };
    report.odd_runs.iter().map(odd).chain([others]).collect::<Vec<_>>().join(" ")
}

/// The warnings at the top, where they are the reason that nothing can be said.
fn reasons(report: &Report) -> Option<Element> {
    let warnings = &report.data.warnings;
    let first = report.verdict == Verdict::UnusableData && !warnings.is_empty();
    first.then(|| Element::new("ul").with("class", "found").children(warnings.iter().map(|w| holding("li", w))))
}

/// Words in an element; a short word with a hyphen is not broken at it.
fn unbroken(name: &'static str, text: &str) -> Element {
    let words = text.split_inclusive(' ');
    words.fold(Element::new(name), |element, word| match word.contains('-') && word.chars().count() < 26 {
        true => element.child(holding("span", word.trim_end()).with("class", "whole")).text(" "),
        false => element.text(word),
    })
}

fn eyebrow(report: &Report, pictures: &Pictures) -> Element {
    let vehicle = Some(pictures.vehicle.clone()).filter(|v| !v.is_empty());
    let data = &report.data;
    let driven = match &pictures.driving {
        Some(driving) => driven(driving),
        None => vec![counted(data.runs, "run"), counted(data.rows, "row")],
    };
    let words: Vec<String> = vehicle.into_iter().chain(driven).collect();
    part::eyebrow(State::of(report), &patched_state::name(report), words.join(" · "))
}

/// Runs, time, way and turns.
fn driven(of: &Driving) -> Vec<String> {
    let time = match of.seconds {
        s if s < 120.0 => format!("{s:.0} s"),
        s => format!("{:.0} min", s / 60.0),
    };
    let turns = match (of.left_turns, of.right_turns) {
        (0, 0) => "hardly a turn".into(),
        (left, right) => format!("{left} left and {right} right turns"),
    };
    vec![format!("{} fitted", counted(of.runs, "run")), time, format!("{:.0} m", of.metres), turns]
}

/// What it amounts to: before → after at the middle horizon, the noise, and what is left.
fn lead(report: &Report) -> Option<Element> {
    let rest = report.remains.as_ref().map(|r| format!("Something remains: {}.", r.says));
    let Some((gap, (name, v))) = middle(&report.gap).and_then(|g| Some((g, judged(g)?))) else {
        return rest.map(|r| holding("p", r).with("class", "lead"));
    };
    let (before, after, floor) = (v.position_rms_before, v.position_rms_after, gap.noise_floor.position_rms);
    let (factor, unit) = prefixed(before.max(after), "m");
    let show = |v: f64| format!("{} {unit}", significant(v * factor, 2));
    let (horizon, runs) = (plain(gap.horizon_s), if name == "held-out" { "runs held out" } else { "the fitted runs" });
    let noise = format!("Noise alone makes {}.", show(floor));
    let is_as_given = report.effects.is_empty() && report.unnamed.is_empty();
    let amounts = match is_as_given || show(before) == show(after) {
        true if !is_as_given => {
            format!(
                "On {runs} it changes nothing: {horizon} s of dead reckoning miss by {} with it and without.",
                show(before)
            )
        }
        true => format!("{horizon} s of dead reckoning miss by {} on {runs}.", show(before)),
        false => format!(
            "With this in the model {horizon} s of dead reckoning miss by {} in place of {} on {runs}.",
            show(after),
            show(before)
        ),
    };
    let left = match State::of(report) {
        State::Good if !report.effects.is_empty() => Some("Nothing else is left to find in these runs.".to_string()),
        State::NotUsable if !report.effects.is_empty() => {
            Some("The patched model predicts no better: do not use it.".into())
        }
        // What remains is a part of the sentence unless that is made of effects alone.
        _ if sentence(report) == verdict_sentence(report) => None,
        _ => rest,
    };
    let words: Vec<String> = [amounts, noise].into_iter().chain(left).collect();
    Some(holding("p", words.join(" ")).with("class", "lead"))
}

/// "20× smaller", where it is so.
pub fn shrinkage(before: f64, after: f64) -> Option<String> {
    let ratio = before / after;
    (ratio.is_finite() && ratio >= 1.05).then(|| format!("{}× smaller", significant(ratio, 2)))
}

/// What was found by its id, with its values.
pub fn found(report: &Report) -> Option<Element> {
    let unnamed = report.unnamed.iter().map(|u| {
        Element::new("li")
            .child(holding("strong", "No name"))
            .text(format!(" at the {}: ", u.place))
            .child(holding("code", &u.equation))
    });
    let items: Vec<Element> = report.effects.iter().map(one_line).chain(unnamed).collect();
    (!items.is_empty()).then(|| Element::new("ul").with("class", "found").children(items))
}

/// A parameter with its value and unit; a pure number has none.
pub(crate) fn parameter(name: &str, e: &Estimate) -> String {
    let unit = if e.unit == "1" { "" } else { e.unit.as_str() };
    let shown = format!("{name} = {} {unit}", with_error(e.value, e.std)).trim_end().to_string();
    let moving = e.course.as_ref().map(|c| match (c.per_s, c.per_sqrt_s) {
        (Some(per_s), _) => format!(", moving by {} {unit}/s", with_error(per_s, c.std)),
        (None, walk) => format!(", walking by {} {unit}/√s", with_error(walk.unwrap_or_default(), c.std)),
    });
    shown + &moving.unwrap_or_default()
}

fn one_line(effect: &Named) -> Element {
    let values: Vec<String> = effect.parameters.iter().map(|(name, e)| parameter(name, e)).collect();
    let line = Element::new("li").child(holding("strong", title_text::title(effect)));
    let line = match effect.says.is_empty() {
        true => line.text(format!(" {}", values.join(", "))),
        false => line.text(format!(": {}; {}", effect.says, values.join(", "))),
    };
    let rivals: Vec<_> = effect.indistinguishable_from.iter().map(|r| format!("{} ({})", r.id, why(r))).collect();
    if rivals.is_empty() {
        return line;
    }
    line.child(holding("span", format!("; not told from {}", rivals.join(", "))).with("class", "rivals"))
}

#[cfg(test)]
mod tests {
    use super::{Estimate, parameter, shrinkage};

    #[test]
    fn only_what_shrinks_is_said_to() {
        assert_eq!(shrinkage(0.1, 0.005).as_deref(), Some("20× smaller"));
        assert_eq!(shrinkage(0.106, 0.1).as_deref(), Some("1.1× smaller"));
        for (before, after) in [(0.104, 0.1), (0.1, 0.2), (0.1, 0.0), (f64::NAN, 0.1)] {
            assert_eq!(shrinkage(before, after), None);
        }
    }

    #[test]
    fn a_pure_number_has_no_unit() {
        let told = |unit: &str| {
            parameter("e_rc", &Estimate { value: 0.05, std: Some(0.001), unit: unit.into(), course: None })
        };
        let (number, length) = (told("1"), told("m"));
        assert!(number.starts_with("e_rc = 0.05") && !number.ends_with('1'), "{number}");
        assert_eq!(length, number + " m");
    }
}
