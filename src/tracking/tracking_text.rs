//! Driving with feedback in words.

use super::report::TrackingReport;
use crate::number_format::{plain, prefixed, significant};
use std::fmt::Write;

/// The report for a terminal.
pub fn tracking_text(report: &TrackingReport) -> String {
    let mut out = format!(
        "{} drives each, a pose every {} s, measured to {} and {} rad\n\n",
        report.drives,
        plain(report.sample_s),
        length(report.noise.position_m),
        significant(report.noise.heading_rad, 2)
    );
    let _ =
        writeln!(out, "{:<44} {:>12} {:>12} {:>12} {:>12}", "", "off its plan", "at its end", "worst end", "heading");
    for way in &report.ways {
        let _ = writeln!(
            out,
            "{:<44} {:>12} {:>12} {:>12} {:>12}",
            way_in_words(&way.id, report.effects.is_empty()),
            length(way.off_plan_m),
            length(way.end_m),
            length(way.worst_end_m),
            match way.end_rad < 1e-6 {
                true => "< 1 μrad".to_string(),
                false => format!("{} rad", significant(way.end_rad, 2)),
            }
        );
    }
    if !report.observed.is_empty() {
        out.push_str("\nThe observer began with none of them and ended with\n");
    }
    for o in &report.observed {
        let _ = writeln!(
            out,
            "  {:<30} {} ± {}, in truth {}",
            o.name,
            significant(o.found, 3),
            significant(o.deviation, 2),
            significant(o.true_value, 3)
        );
    }
    out
}

/// A way to drive, of a model with or without effects.
pub(crate) fn way_in_words(id: &str, is_bare: bool) -> &'static str {
    match id {
        "model-plan" if is_bare => "plan, no feedback",
        "model" if is_bare => "plan, with feedback",
        "ideal-plan" => "ideal plan, no feedback",
        "ideal" => "ideal plan, feedback on the ideal model",
        "observer" => "ideal plan, feedback with creep observed",
        "model-plan" => "plan with creep, no feedback",
        _ => "plan with creep, feedback on that model",
    }
}

/// What is below a micrometre is nothing to a robot.
fn length(metres: f64) -> String {
    if metres < 1e-6 {
        return "< 1 μm".into();
    }
    let (factor, unit) = prefixed(metres, "m");
    format!("{} {unit}", significant(metres * factor, 2))
}
