//! A calibration as text for a terminal.

use crate::discrepancy::calibration_report::{CalibratedEffect, CalibratedValue, Calibration, IntervalBy, Standing};
use crate::discrepancy::rendering::summary::clock_line;
use crate::number_format::{prefixed, significant, with_error};
use crate::picture::svg::cut;
use std::fmt::Write;

/// How a calibration ended, in a sentence.
pub(crate) fn summary(standing: Standing, effects: usize) -> String {
    match (standing, effects) {
        (Standing::Fitted, 1) => "One effect was fitted.".into(),
        (Standing::Fitted, n) => format!("{n} effects were fitted together."),
        _ => "These runs leave the values of these effects open: others fit as well.".into(),
    }
}

/// A calibration for a terminal, 100 columns at most.
pub fn calibration_text(c: &Calibration) -> String {
    let mut text = format!("{}\n", c.summary);
    if !c.effects.is_empty() {
        text.push('\n');
        text.push_str(&row(["effect", "parameter", "value", "95 % interval", "unit", "ΔBIC"]));
        c.effects.iter().for_each(|e| effect(&mut text, e));
    }
    correlations(&mut text, c);
    let noise = c.noise.iter().map(|(name, v)| {
        let (factor, unit) = prefixed(*v, if name == "heading" { "rad" } else { "m" });
        format!("{name} {} {unit}", significant(v * factor, 2))
    });
    let noise: Vec<String> = noise.collect();
    if !noise.is_empty() {
        let _ = writeln!(text, "\n  noise: {}", noise.join(", "));
    }
    if c.remains {
        text.push_str("  Motion is left that these effects do not explain; the deviations count it as random.\n");
    }
    let dropped = if c.data.rows_dropped > 0 { format!(", {} left out", c.data.rows_dropped) } else { String::new() };
    let _ = writeln!(text, "  runs: {}, rows: {}{dropped}", c.data.runs, c.data.rows);
    c.data.clocks.iter().for_each(|clock| text.push_str(&format!("  {}\n", clock_line(clock))));
    c.data.warnings.iter().for_each(|w| text.push_str(&format!("  note: {w}\n")));
    text.chars().map(|c| if c.is_control() && c != '\n' { '?' } else { c }).collect()
}

fn row([effect, parameter, value, interval, unit, bic]: [&str; 6]) -> String {
    let line =
        format!("  {:<26} {:<16} {value:<24} {interval:<22} {unit:<8}{bic:>9}", cut(effect, 26), cut(parameter, 16));
    format!("{}\n", line.trim_end())
}

fn effect(text: &mut String, e: &CalibratedEffect) {
    let on = e.on.clone().or_else(|| e.trailer.map(|i| i.to_string()));
    let label = on.map_or(e.id.clone(), |on| format!("{}@{on}", e.id));
    for (k, (name, p)) in e.parameters.iter().enumerate() {
        let first = if k == 0 {
            [label.clone(), e.delta_bic.map_or("–".into(), |bic| significant(bic, 3))]
        } else {
            [String::new(), String::new()]
        };
        let vanishes = p.at_bound && p.std.is_none();
        let value = if vanishes { "none".into() } else { with_error(p.value, p.std) };
        text.push_str(&row([&first[0], name, &value, &interval(p), &p.unit, &first[1]]));
        if p.at_bound && !vanishes {
            let _ = writeln!(text, "  {:<26} {name} stands at an end of its range: the data ask for more", "");
        }
        if let Some([mean, std]) = p.prior {
            let _ = writeln!(text, "  {:<26} with the prior {}", "", with_error(mean, Some(std)));
        }
    }
}

fn interval(p: &CalibratedValue) -> String {
    let digits = |v: f64| significant(v, digits_of(p));
    let by = if p.by == IntervalBy::Profile { " *" } else { "" };
    match p.interval {
        [Some(low), Some(high)] => format!("{} to {}{by}", digits(low), digits(high)),
        [Some(low), None] => format!("from {}{by}", digits(low)),
        [None, Some(high)] => format!("to {}{by}", digits(high)),
        [None, None] => "open".into(),
    }
}

/// As many digits as show two of the deviation.
fn digits_of(p: &CalibratedValue) -> usize {
    let std = p.std.filter(|s| *s > 0.0 && s.is_finite());
    let more = std.map_or(0.0, |s| (p.value.abs().max(s) / s).log10().floor());
    2 + more.clamp(0.0, 7.0) as usize
}

/// A correlation that is worth a line.
const STRONG: f64 = 0.9;

/// Values that the data tell together more than apart.
fn correlations(text: &mut String, c: &Calibration) {
    if c.effects.iter().flat_map(|e| e.parameters.values()).any(|p| p.by == IntervalBy::Profile) {
        text.push_str("  * by the likelihood with all other values fitted anew\n");
    }
    let Some(covariance) = &c.covariance else { return };
    let at = |i: usize, j: usize| covariance.matrix[i][j];
    for i in 0..covariance.names.len() {
        for j in 0..i {
            let correlation = at(i, j) / (at(i, i) * at(j, j)).sqrt();
            if correlation.abs() > STRONG {
                let (a, b) = (&covariance.names[j], &covariance.names[i]);
                let _ = writeln!(
                    text,
                    "  {a} and {b} are correlated by {}: use their covariance",
                    significant(correlation, 3)
                );
            }
        }
    }
}
