//! The kinematic model beside the one with forces, in words.

use crate::discrepancy::report::{BeforeAfter, Estimate, Gap, KinematicComparison, Named, Report, Verdict};
use crate::number_format::{significant, with_error};
use crate::wording::listed;

/// What the kinematic model asks for, and how far it predicts beside the model with forces.
pub fn sentences(beside: &KinematicComparison, forced: &Report) -> Vec<String> {
    [gaps(&beside.report, forced), Some(asks(beside))].into_iter().flatten().collect()
}

/// The effects of the kinematic model with what the forces predict of them.
fn asks(beside: &KinematicComparison) -> String {
    let start = "Driven by what is measured of its wheels the model";
    let value = |i: usize, (name, of): (&String, &Estimate)| {
        let by_forces = beside.predicted(i, name);
        let predicted = by_forces.map_or(String::new(), |v| format!(", by the forces {}", significant(v, 3)));
        let unit = if of.unit == "1" { String::new() } else { format!(" {}", of.unit) };
        format!("{name} {}{unit}{predicted}", with_error(of.value, of.std))
    };
    let one = |(i, e): (usize, &Named)| {
        let values: Vec<String> = e.parameters.iter().map(|p| value(i, p)).collect();
        format!("{} ({})", e.id, values.join("; "))
    };
    match (beside.report.verdict, beside.report.effects.is_empty()) {
        (_, false) => format!("{start} asks for {}.", listed(beside.report.effects.iter().enumerate().map(one))),
        (Verdict::NoMissingEffect, _) => format!("{start} explains these runs as it is."),
        _ => format!("{start} leaves what it cannot name."),
    }
}

/// The held-out errors of both after the shortest horizon that both have.
pub fn gaps(kinematic: &Report, forced: &Report) -> Option<String> {
    let after = |gap: &Gap| gap.held_out.as_ref().map(|h: &BeforeAfter| h.position_rms_after);
    let (gap, own) = forced.gap.iter().find_map(|gap| Some((gap, after(gap)?)))?;
    let other = kinematic.gap.iter().find(|g| (g.horizon_s - gap.horizon_s).abs() < 1e-9).and_then(after)?;
    let (mm, horizon) = (|x: f64| significant(1e3 * x, 3), significant(gap.horizon_s, 2));
    let (other, own) = (mm(other), mm(own));
    Some(format!("Without forces held-out positions are missed by {other} mm after {horizon} s, with them by {own}."))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeMap;

    #[test]
    fn coefficients_stand_beside_what_forces_predict() {
        let report = |verdict: &str, effects: &str| -> Report {
            let text = format!(
                r#"{{"schema": 2, "verdict": "{verdict}", "summary": "", "effects": [{effects}], "unnamed": [], "disagreement": [],
                "gap": [], "next_experiment": null, "steps": [], "data": {{"runs": 1, "rows": 2, "rows_dropped": 0, "why_dropped": {{}},
                "warnings": []}}, "provenance": {{"version": "", "seed": 0, "inputs_sha256": {{}}}}}}"#
            );
            serde_json::from_str(&text).unwrap()
        };
        let creep = r#"{"id": "cornering-creep", "where": "", "parameters": {"mass_over_bT": {"value": 0.11, "std": 0.001, "unit": "s"}},
            "evidence": {"delta_bic": 99.0, "p_value": 0.0}, "indistinguishable_from": [], "equation": ""}"#;
        let by_forces = vec![BTreeMap::from([("mass_over_bT".to_string(), 0.1093)])];
        let forced = report("missing-effect", "");
        let of = |verdict: &str, effects: &str| KinematicComparison {
            report: Box::new(report(verdict, effects)),
            by_forces: by_forces.clone(),
        };
        let said = sentences(&of("missing-effect", creep), &forced).join(" ");
        assert!(
            said.ends_with("the model asks for cornering-creep (mass_over_bT 0.1100 ± 0.0010 s, by the forces 0.109)."),
            "{said}"
        );
        assert!(sentences(&of("no-missing-effect", ""), &forced)[0].ends_with("explains these runs as it is."));
        assert!(sentences(&of("unexplained", ""), &forced)[0].contains("cannot name"));
    }
}
