//! Effects that the runs ask for far beyond what vehicles have: right numbers for a wrong reason, as a rule.

use super::warning::Warning;
use crate::discrepancy::preprocessing::unit_errors;
use crate::discrepancy::record::run_record::Record;
use crate::discrepancy::selection::choice::Selected;
use crate::effects::Applied;
use crate::error::Result;

/// A share this many times as large as a plausible one is none that wear, load or a careless measurement explain.
const FAR: f64 = 10.0;

/// What the report warns of where a share that was chosen is far beyond a plausible one.
///
/// Lengths, times and rates are left alone: what is usual of them depends on the vehicle's size.
///
/// # Errors
/// When the model's formulas are malformed.
pub(crate) fn warnings(choice: &Selected, records: &[Record]) -> Result<Vec<Warning>> {
    let far: Vec<&Applied> = choice.chosen.iter().map(|c| &c.applied).filter(|a| far_beyond(a).is_some()).collect();
    let slip = if far.is_empty() { None } else { unit_errors::suspected(&choice.before.model, records)? };
    let warning = |applied: &Applied| {
        let (parameter, value, usual) = far_beyond(applied)?;
        Some(Warning::Implausible {
            applied: Box::new(applied.clone()),
            parameter: parameter.into(),
            value,
            usual,
            slip: slip.clone(),
        })
    };
    Ok(far.into_iter().filter_map(warning).collect())
}

/// The first share of an effect that is far beyond its usual size: its name, value and usual size.
fn far_beyond(applied: &Applied) -> Option<(&str, f64, f64)> {
    let mut parameters = applied.effect.parameters.iter().zip(&applied.values);
    let ((name, p), value) = parameters.find(|((_, p), v)| p.unit == "1" && v.abs() > FAR * p.size)?;
    Some((name, *value, p.size))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects;

    #[test]
    fn a_share_is_warned_of_and_a_length_is_not() {
        let at = |id: &str, times: f64| {
            let effect = effects::named(id).unwrap();
            let values = effect.parameters.values().map(|p| times * p.size).collect();
            far_beyond(&Applied::new(effect, None, values)).map(|(name, value, usual)| (name.to_string(), value, usual))
        };
        assert_eq!(at("track-width", 9.0), None);
        assert_eq!(at("track-width", -9.0), None);
        for times in [11.0, -11.0] {
            assert_eq!(at("track-width", times), Some(("scale".into(), times * 0.03, 0.03)));
        }
        assert_eq!(at("lever-arm", 11.0), None);
    }
}
