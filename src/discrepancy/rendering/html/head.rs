//! The top of the page: verdict, headline numbers, what was found, what to drive next.

use super::part::holding;
use crate::discrepancy::rendering::summary::{verdict_name, verdict_sentence, why};
use crate::discrepancy::rendering::title_text;
use crate::discrepancy::report::{Estimate, Named, Report, Verdict};
use crate::discrepancy::report::{judged, middle};
use crate::number_format::{plain, prefixed, significant, with_error};
use crate::picture::svg::Element;
use crate::wording::counted;

/// The verdict as one sentence, the gap before and after, and the effects in one line each.
pub fn header(report: &Report) -> Element {
    Element::new("header")
        .child(eyebrow(report))
        .child(unbroken("h1", &verdict_sentence(report)))
        .children(headline(report))
        .children(found(report))
        .children(reasons(report))
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

fn eyebrow(report: &Report) -> Element {
    let good = matches!(report.verdict, Verdict::MissingEffect | Verdict::NoMissingEffect);
    let class = if good { "verdict good" } else { "verdict" };
    let data = &report.data;
    let what = format!("creepage, {} and {} rows", counted(data.runs, "run"), data.rows);
    Element::new("p")
        .with("class", "eyebrow")
        .child(holding("span", verdict_name(report.verdict)).with("class", class))
        .text(what)
}

/// Before → after at the middle horizon, how much smaller, and the noise floor.
fn headline(report: &Report) -> Option<Element> {
    let gap = middle(&report.gap)?;
    let (name, values) = judged(gap)?;
    let (before, after) = (values.position_rms_before, values.position_rms_after);
    let (factor, unit) = prefixed(before.max(after), "m");
    let show = |v: f64| significant(v * factor, 2);
    let horizon = plain(gap.horizon_s);
    let arrow = if show(before) == show(after) {
        format!("{} {unit}", show(after))
    } else {
        format!("{} → {} {unit}", show(before), show(after))
    };
    let mut row = Element::new("div").with("class", "headline");
    row = row.child(number(&arrow, &format!("{name} position error after {horizon} s"), ""));
    if let Some(times) = shrinkage(before, after) {
        row = row.child(number(&times, "with the patched model", "minor"));
    }
    Some(row.child(number(&format!("{} {unit}", show(gap.noise_floor.position_rms)), "noise floor", "minor")))
}

fn number(value: &str, meaning: &str, class: &str) -> Element {
    Element::new("dl").with("class", class).child(holding("dt", meaning)).child(holding("dd", value))
}

/// "20× smaller", where it is so.
pub fn shrinkage(before: f64, after: f64) -> Option<String> {
    let ratio = before / after;
    (ratio.is_finite() && ratio >= 1.05).then(|| format!("{}× smaller", significant(ratio, 2)))
}

fn found(report: &Report) -> Option<Element> {
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

/// What to drive next, where the data cannot tell.
pub fn next_experiment(report: &Report) -> Option<Element> {
    let next = report.next_experiment.as_ref()?;
    let body = Element::new("aside").with("class", "next").child(holding("strong", "What to drive next"));
    Some(body.child(holding("p", &next.manoeuvre)).child(holding("p", &next.why)))
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
