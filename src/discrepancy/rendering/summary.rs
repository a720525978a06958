//! The report on one screen of a terminal, and the sentences every form of the report shares.

use super::kinematic_text;
use super::plain_text;
use crate::discrepancy::report::{
    BeforeAfter, CourseFound, Estimate, Gap, Named, Report, Rival, RunClock, Unnamed, Verdict,
};
use crate::discrepancy::report::{judged, judged_alike};
use crate::number_format::{decimals, plain, prefixed, significant, with_error};
use crate::picture::svg::cut;
use std::collections::BTreeMap;

/// Columns of the terminal.
const COLUMNS: usize = 80;
/// Columns of a value with its deviation.
const VALUE: usize = 23;
/// Lines that still fit with the prompt and the list of files written.
const LINES: usize = 24;

/// The verdict in two or three words.
pub fn verdict_name(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::UnusableData => "Unusable data",
        Verdict::NotIdentifiable => "Not identifiable",
        Verdict::Unexplained => "Unexplained",
        Verdict::UnnamedEffect => "Unnamed effect",
        Verdict::MissingEffect => "Missing effect",
        Verdict::NoMissingEffect => "No missing effect",
    }
}

/// The verdict in one sentence: the report's own, or one made from its numbers where it has none.
pub fn verdict_sentence(report: &Report) -> String {
    let own = report.summary.trim();
    if own.is_empty() { composed_sentence(report.verdict, &report.effects, &report.unnamed) } else { own.into() }
}

/// A verdict in a sentence of what was found.
pub(crate) fn composed_sentence(verdict: Verdict, effects: &[Named], unnamed: &[Unnamed]) -> String {
    match verdict {
        Verdict::UnusableData => "The model does not apply to these data, so nothing can be said about it.".into(),
        Verdict::NotIdentifiable => {
            "These runs are too short or too still to tell whether the model misses an effect.".into()
        }
        Verdict::Unexplained => {
            "Model and measurement disagree, and neither an effect of the library nor a simple law explains it.".into()
        }
        Verdict::UnnamedEffect => format!(
            "Model and measurement disagree in a repeatable way at the {}, and no known effect explains it.",
            unnamed.first().map_or("constraints", |u| u.place.as_str())
        ),
        Verdict::MissingEffect if effects.is_empty() => "The model misses an effect.".into(),
        Verdict::MissingEffect => plain_text::sentences_with_ids(effects),
        Verdict::NoMissingEffect => "The model explains these runs to their noise; no effect is missing.".into(),
    }
}

/// Why a rival cannot be told apart, for a person.
pub fn why(rival: &Rival) -> &str {
    match rival.why.as_str() {
        "identical" => "the same constraint under a change of parameter",
        "first order" => "the same to first order",
        "data" => "these runs do not separate them",
        other => other,
    }
}

/// The one-screen summary: at most 24 lines of 80 columns, without control characters.
pub fn summary_text(report: &Report) -> String {
    summary_text_in(report, COLUMNS)
}

/// The same in so many columns; tables stay as wide as they are.
pub fn summary_text_in(report: &Report, columns: usize) -> String {
    let columns = columns.max(COLUMNS);
    let wrapped = |text: &str, indent: usize, most: usize| wrapped_in(columns, text, indent, most);
    let mut lines = wrapped(&format!("{}: {}", verdict_name(report.verdict), verdict_sentence(report)), 0, 4);
    lines.extend(effect_lines(&report.effects, &wrapped));
    lines.extend(
        report
            .unnamed
            .iter()
            .take(2)
            .flat_map(|u| wrapped(&format!("unnamed at the {}: {}", u.place, u.equation), 2, 2)),
    );
    let gap = gap_lines(&report.gap);
    let mut tail = Vec::new();
    if let Some(beside) = &report.kinematic {
        tail.push(String::new());
        tail.extend(wrapped(&kinematic_text::sentences(beside, report).join(" "), 0, 4));
    }
    if let Some(next) = &report.next_experiment {
        tail.push(String::new());
        tail.extend(wrapped(&format!("Next: {}: {}", next.manoeuvre, next.why), 0, 5));
    }
    tail.extend(data_lines(report, &wrapped));
    lines.truncate(LINES - gap.len() - tail.len());
    lines.extend(gap);
    lines.extend(tail);
    lines.iter().map(|line| format!("{}\n", clean(line, columns))).collect()
}

/// A line without control characters, cut to the terminal's columns.
fn clean(line: &str, columns: usize) -> String {
    let printable: String = line.chars().map(|c| if c.is_control() { '?' } else { c }).collect();
    cut(printable.trim_end(), columns)
}

/// Words in lines, the first so deep and the others two deeper, and how many lines at most.
type Wrap<'a> = &'a dyn Fn(&str, usize, usize) -> Vec<String>;

/// Words in lines of so many columns, the first `indent` deep and the others two deeper.
fn wrapped_in(columns: usize, text: &str, indent: usize, most: usize) -> Vec<String> {
    let mut lines = vec![" ".repeat(indent)];
    for word in text.split_whitespace() {
        let line = lines.last_mut().expect("one line at least");
        let empty = line.trim().is_empty();
        if !empty && line.chars().count() + 1 + word.chars().count() > columns {
            lines.push(format!("{}{word}", " ".repeat(indent + 2)));
        } else {
            line.push_str(if empty { "" } else { " " });
            line.push_str(word);
        }
    }
    if lines.len() > most {
        lines.truncate(most);
        lines.last_mut().expect("one line at least").push_str(" …");
    }
    lines
}

fn effect_lines(effects: &[Named], wrapped: Wrap) -> Vec<String> {
    if effects.is_empty() {
        return Vec::new();
    }
    let mut lines = vec![String::new(), row("effect", "parameter", "value ± std", "unit", "ΔBIC")];
    lines.extend(effects.iter().take(3).flat_map(|e| one_effect(e, wrapped)));
    if effects.len() > 3 {
        let others: Vec<&str> = effects[3..].iter().map(|e| e.id.as_str()).collect();
        lines.extend(wrapped(&format!("and {}: see the report", others.join(", ")), 2, 2));
    }
    lines
}

fn row(effect: &str, parameter: &str, value: &str, unit: &str, bic: &str) -> String {
    format!("  {:<23}{:<15}{:<24}{:<7}{bic:>9}", cut(effect, 22), cut(parameter, 14), cut(value, VALUE), cut(unit, 6))
}

fn one_effect(effect: &Named, wrapped: Wrap) -> Vec<String> {
    let bic = significant(effect.evidence.delta_bic, 3);
    let mut lines: Vec<String> = Vec::new();
    for (name, estimate) in effect.parameters.iter().take(3) {
        let (id, bic) = if lines.is_empty() { (effect.id.as_str(), bic.as_str()) } else { ("", "") };
        // Trailers are counted.
        let (value, unit) = match name.as_str() {
            "trailer" => (estimate.value.to_string(), ""),
            _ => (brief(estimate), estimate.unit.as_str()),
        };
        lines.push(row(id, name, &value, unit, bic));
        lines.extend(estimate.course.as_ref().map(|c| moving(name, c, unit)));
    }
    if lines.is_empty() {
        lines.push(row(&effect.id, "", "", "", &bic));
    }
    if !effect.indistinguishable_from.is_empty() {
        let rivals: Vec<_> = effect.indistinguishable_from.iter().map(|r| format!("{} ({})", r.id, r.why)).collect();
        lines.extend(wrapped(&format!("not told from {}", rivals.join(", ")), 4, 2));
    }
    lines
}

/// The line of a parameter that moves with time.
fn moving(name: &str, course: &CourseFound, unit: &str) -> String {
    let (value, per, unit) = match (course.per_s, course.per_sqrt_s) {
        (Some(value), _) => (value, "s", format!("{unit}/s")),
        // The column is narrow, and the name says over what time.
        (None, walk) => (walk.unwrap_or_default(), "√s", unit.to_string()),
    };
    let moving = Estimate { value, std: course.std, unit: String::new(), course: None };
    row("", &format!("{name} per {per}"), &brief(&moving), &unit, "")
}

/// A value and its deviation, that one as a power of ten where both are too long for their column.
fn brief(e: &Estimate) -> String {
    let text = with_error(e.value, e.std);
    match (text.split_once(" ± "), e.std) {
        (Some((value, _)), Some(std)) if text.chars().count() > VALUE && !value.starts_with('(') => {
            format!("{value} ± {std:.1e}").replace("e-", "e−")
        }
        _ => text,
    }
}

fn gap_lines(gaps: &[Gap]) -> Vec<String> {
    let alike = judged_alike(gaps).into_iter();
    let judged: Vec<_> = alike.filter_map(|g| judged(g).map(|(name, values)| (g, name, values))).collect();
    let Some((_, name, _)) = judged.first() else { return Vec::new() };
    let largest = |f: fn(&BeforeAfter) -> f64| judged.iter().map(|(_, _, v)| f(v)).fold(0.0, f64::max);
    let (metres, metre) = prefixed(largest(|v| v.position_rms_before), "m");
    let (radians, radian) = prefixed(largest(|v| v.heading_rms_before.unwrap_or(0.0)), "rad");
    let mut lines = vec![String::new(), format!("  gap, {name} runs: before → after | noise floor (RMS)")];
    for (gap, _, v) in judged.iter().take(4) {
        let floor = gap.noise_floor;
        let position = arrow([v.position_rms_before, v.position_rms_after, floor.position_rms], metres, &metre);
        let heading = match (v.heading_rms_before, v.heading_rms_after) {
            (Some(before), Some(after)) => {
                arrow([before, after, floor.heading_rms.unwrap_or(f64::NAN)], radians, &radian)
            }
            _ => String::new(),
        };
        lines.push(format!("  {:>6} s {position:<35} {heading}", plain(gap.horizon_s)));
    }
    lines
}

fn arrow([before, after, floor]: [f64; 3], factor: f64, unit: &str) -> String {
    let [before, after, floor] = [before, after, floor].map(|v| significant(v * factor, 3));
    format!("{before:>7} → {after:>7} | {floor:>7} {unit}")
}

/// A time and its deviation in seconds, to the deviation's second digit: clocks may be years apart.
pub fn seconds(e: &Estimate) -> String {
    match e.std.filter(|s| *s > 0.0 && s.is_finite()) {
        Some(std) => {
            let places = (1.0 - std.log10().floor()).clamp(0.0, 9.0) as usize;
            format!("{} ± {std:.places$}", decimals(e.value, places))
        }
        None => decimals(e.value, 3),
    }
}

/// How the clocks of a run stand to each other, in words.
pub fn clock_line(c: &RunClock) -> String {
    let offset = seconds(&c.offset_s);
    let drift = with_error(1e6 * c.drift.value, c.drift.std.map(|s| 1e6 * s));
    format!("clock of {}: offset {offset} s, drift {drift} µs/s", c.run)
}

/// Why most of the rows that were dropped were.
fn reason(why_dropped: &BTreeMap<String, usize>) -> String {
    match why_dropped.iter().max_by_key(|(_, n)| **n) {
        Some((why, n)) if why_dropped.len() == 1 && *n > 0 => format!(": {why}"),
        Some((why, n)) if *n > 0 => format!(": {why}, …"),
        _ => String::new(),
    }
}

fn data_lines(report: &Report, wrapped: Wrap) -> Vec<String> {
    let data = &report.data;
    let runs = if data.runs == 1 { "1 run".to_string() } else { format!("{} runs", data.runs) };
    let mut lines = vec![
        String::new(),
        format!("  data: {runs}, {} rows used, {} dropped{}", data.rows, data.rows_dropped, reason(&data.why_dropped)),
    ];
    lines.extend(data.clocks.iter().take(2).flat_map(|c| wrapped(&clock_line(c), 2, 2)));
    if data.clocks.len() > 2 {
        lines.push(format!("  … and {} more clocks", data.clocks.len() - 2));
    }
    if let Some(first) = data.warnings.first() {
        let more =
            if data.warnings.len() > 1 { format!(" (and {} more)", data.warnings.len() - 1) } else { String::new() };
        lines.extend(wrapped(&format!("warning: {first}{more}"), 2, 3));
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_clock_is_said_in_seconds_and_microseconds_a_second() {
        let estimate = |value, std, unit: &str| Estimate { value, std: Some(std), unit: unit.into(), course: None };
        let clock = RunClock {
            run: "in.csv".into(),
            truth: "poses.csv".into(),
            held_out: false,
            offset_s: estimate(-12.34567, 0.002, "s"),
            drift: estimate(2.5e-5, 3e-6, "1"),
            at_s: 100.0,
            correlation: 0.99,
            other_offset_s: None,
        };
        assert_eq!(clock_line(&clock), "clock of in.csv: offset −12.3457 ± 0.0020 s, drift 25.0 ± 3.0 µs/s");
    }

    #[test]
    fn lines_are_as_full_as_they_may_be() {
        let wrapped = |text: &str, indent: usize, most: usize| wrapped_in(COLUMNS, text, indent, most);
        let text = |first: usize| format!("{} {}", "a".repeat(first), "b".repeat(COLUMNS - first - 1));
        // One blank, and to the column all that a line holds.
        assert_eq!(wrapped(&text(60), 0, 9), [text(60)]);
        assert_eq!(wrapped(&format!("{}c", text(60)), 0, 9), ["a".repeat(60), format!("  {}c", "b".repeat(19))]);
        assert_eq!(wrapped("one two", 2, 9), ["  one two"]);
    }

    #[test]
    fn a_deviation_that_is_none_is_not_said() {
        let said = |std| seconds(&Estimate { value: -12.34567, std, unit: "s".into(), course: None });
        assert_eq!(said(Some(0.002)), "−12.3457 ± 0.0020");
        for std in [None, Some(0.0), Some(f64::INFINITY), Some(f64::NAN)] {
            assert_eq!(said(std), said(None), "{std:?}");
        }
        assert!(!said(None).contains('±'));
    }
}
