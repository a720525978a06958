//! The check as text.

use super::reason_text;
use crate::discrepancy::identifiability::check::{Assessment, Grounds};
use crate::discrepancy::identifiability::check_report::{
    Check, Health, Parameter, Prospect, RunHealth, Seen, Standing,
};
use crate::discrepancy::rendering::summary::clock_line;
use crate::number_format::{prefixed, significant};
use crate::picture::svg::cut;
use crate::wording::listed;
use std::fmt::Write;

/// Names in the summary.
const NAMED: usize = 4;

/// An assessment in a sentence.
pub(crate) fn summary(of: &Assessment) -> String {
    let missed = match &of.grounds {
        Grounds::NotFitted(reason) => return reason.as_ref().map(reason_text::sentence).unwrap_or_default(),
        Grounds::Missed(missed) => missed,
    };
    let named = listed(missed.iter().take(NAMED).map(String::as_str));
    let more = missed.len().saturating_sub(NAMED);
    let more = if more > 0 { format!(" (and {more} more)") } else { String::new() };
    match (missed.is_empty(), of.standing) {
        (true, _) => "These runs would show every effect of the library that applies, at its plausible size.".into(),
        (false, Standing::Identifiable) => {
            format!("These runs would show the basic effects at their plausible sizes, but not {named}{more}.")
        }
        (false, _) => format!("These runs would not show {named}{more} at a plausible size."),
    }
}

/// The check for a terminal, 100 columns at most.
pub fn check_text(check: &Check) -> String {
    let mut text = format!("{}: {}\n", name(check.verdict), check.summary);
    data(&mut text, &check.data);
    if !check.effects.is_empty() {
        effects(&mut text, &check.effects);
    }
    pairs(&mut text, check);
    if let Some(next) = &check.next_experiment {
        let _ = write!(text, "\nNext: {}\n  ({})\n", next.manoeuvre, next.why);
    }
    text.lines().map(|l| format!("{}\n", printable(l))).collect()
}

fn name(standing: Standing) -> &'static str {
    match standing {
        Standing::UnusableData => "Unusable data",
        Standing::NotIdentifiable => "Not identifiable",
        Standing::Identifiable => "Identifiable",
    }
}

fn printable(line: &str) -> String {
    line.trim_end().chars().map(|c| if c.is_control() { '?' } else { c }).collect()
}

fn data(text: &mut String, data: &Health) {
    let _ = writeln!(
        text,
        "\n  {:<28}{:>8}{:>9}{:>9}  {:<16}{:>6}{:>7}{:>7}",
        "run", "rows", "time", "rate", "speed, 90 %", "left", "right", "stands"
    );
    data.runs.iter().for_each(|r| run(text, r));
    let noise = noises(data);
    if !noise.is_empty() {
        let _ = writeln!(text, "  noise: {}", noise.join(", "));
    }
    data.clocks.iter().for_each(|c| text.push_str(&format!("  {}\n", clock_line(c))));
    for finding in data.findings.iter().filter(|f| f.mend.is_none()) {
        let _ = writeln!(text, "  note: {}", finding.says);
    }
}

/// The noise of position and heading, as far as they are known.
pub(super) fn noises(data: &Health) -> Vec<String> {
    let noise = [(data.position_noise, "m", "position"), (data.heading_noise, "rad", "heading")];
    let noise = noise.into_iter().filter_map(|(v, unit, what)| {
        let v = v?;
        let (factor, unit) = prefixed(v, unit);
        Some(format!("{what} {} {unit}", significant(v * factor, 2)))
    });
    noise.collect()
}

/// The speeds of most of the time.
pub(super) fn speeds(r: &RunHealth) -> String {
    r.speed.map_or("–".into(), |s| format!("{} to {} m/s", significant(s[0], 2), significant(s[2], 2)))
}

/// An effect with the trailer it acts on.
pub(super) fn label(effect: &Prospect) -> String {
    effect.trailer.map_or(effect.id.clone(), |i| format!("{} (trailer {i})", effect.id))
}

fn run(text: &mut String, r: &RunHealth) {
    let percent = |x: f64| format!("{:.0} %", 100.0 * x);
    let speed = speeds(r);
    let dropped = if r.rows_dropped > 0 { format!("  ({} dropped)", r.rows_dropped) } else { String::new() };
    let _ = writeln!(
        text,
        "  {:<28}{:>8}{:>7} s{:>6} Hz  {speed:<16}{:>6}{:>7}{:>7}{dropped}",
        cut(&r.run, 27),
        r.rows,
        significant(r.duration_s, 3),
        significant(r.rate_hz, 3),
        percent(r.left),
        percent(r.right),
        percent(r.standing),
    );
}

fn effects(text: &mut String, effects: &[Prospect]) {
    let calm = |p: &Parameter| p.std == p.std_unexplained;
    let all_calm = effects.iter().flat_map(|e| e.parameters.values()).all(calm);
    let columns = |effect: &str, parameter: &str, numbers: [&str; 3], unit: &str, seen: &str| {
        format!(
            "  {:<27}{:<14}{:>11}{:>11}{:>11}  {unit:<7}{seen}\n",
            cut(effect, 26),
            cut(parameter, 13),
            numbers[0],
            numbers[1],
            numbers[2]
        )
    };
    text.push('\n');
    text.push_str(&columns("effect", "parameter", ["std", "seen from", "plausible"], "unit", "seen"));
    for effect in effects {
        let label = label(effect);
        let seen = match effect.seen {
            Seen::Yes => "yes",
            Seen::OnceExplained => "once the rest is explained",
            Seen::No => "not-identifiable",
        };
        for (i, (name, p)) in effect.parameters.iter().enumerate() {
            let number = |x: Option<f64>| x.map_or("–".into(), |x| significant(x, 2));
            let numbers = [number(p.std), number(p.smallest_seen), number(Some(p.plausible))];
            let numbers = numbers.each_ref().map(String::as_str);
            let (label, seen) = if i == 0 { (label.as_str(), seen) } else { ("", "") };
            text.push_str(&columns(label, name, numbers, &p.unit, seen));
        }
    }
    if !all_calm {
        let ratio = |p: &Parameter| p.std_unexplained.zip(p.std).map(|(a, b)| a / b);
        let most = effects.iter().flat_map(|e| e.parameters.values()).filter_map(ratio).fold(1.0, f64::max);
        if most > 1.2 {
            let _ = writeln!(
                text,
                "  As long as part of the motion is unexplained, deviations are up to {} times larger.",
                significant(most, 2)
            );
        }
    }
}

fn pairs(text: &mut String, check: &Check) {
    for (why, heading) in [
        ("data", "These runs would not tell apart, though others can:"),
        ("first order", "The same to first order, told apart by large values only:"),
        ("identical", "The same under a change of parameter, told apart by no run:"),
    ] {
        let of_kind: Vec<String> = check
            .not_separated
            .iter()
            .filter(|p| p.why == why)
            .map(|p| format!("{} and {}", p.effects[0], p.effects[1]))
            .collect();
        if of_kind.is_empty() {
            continue;
        }
        let _ = writeln!(text, "\n{heading}");
        text.extend(of_kind.iter().map(|pair| format!("  {pair}\n")));
    }
}
