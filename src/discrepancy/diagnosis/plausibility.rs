//! Effects that the runs ask for far beyond what vehicles have: right numbers for a wrong reason, as a rule.

use crate::discrepancy::preprocessing::unit_errors;
use crate::discrepancy::record::run_record::Record;
use crate::discrepancy::selection::choice::Selected;
use crate::effects::Applied;
use crate::error::Result;
use crate::number_format::significant;

/// A share this many times as large as a plausible one is none that wear, load or a careless measurement explain.
const FAR: f64 = 10.0;

/// What the report warns of where a share that was chosen is far beyond a plausible one.
///
/// Lengths, times and rates are left alone: what is usual of them depends on the vehicle's size.
///
/// # Errors
/// When the model's formulas are malformed.
pub(crate) fn warnings(choice: &Selected, records: &[Record]) -> Result<Vec<String>> {
    let far: Vec<String> = choice.chosen.iter().filter_map(|c| far_beyond(&c.applied)).collect();
    let slip = if far.is_empty() { None } else { unit_errors::suspected(&choice.before.model, records)? };
    let doubt = slip.map_or_else(
        || ": check numbers and units of model file and log, or it imitates another effect".into(),
        |slip| format!("; {slip}"),
    );
    Ok(far.into_iter().map(|says| says + &doubt).collect())
}

fn far_beyond(applied: &Applied) -> Option<String> {
    let mut parameters = applied.effect.parameters.iter().zip(&applied.values);
    let ((name, p), value) = parameters.find(|((_, p), v)| p.unit == "1" && v.abs() > FAR * p.size)?;
    Some(format!(
        "{} {name} = {} is far beyond the usual {}",
        applied.label(),
        significant(*value, 3),
        significant(p.size, 2),
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects;

    #[test]
    fn a_share_is_warned_of_and_a_length_is_not() {
        let said = |id: &str, times: f64| {
            let effect = effects::named(id).unwrap();
            let values = effect.parameters.values().map(|p| times * p.size).collect();
            far_beyond(&Applied::new(effect, None, values))
        };
        assert_eq!(said("track-width", 9.0), None);
        assert_eq!(said("track-width", -9.0), None);
        for (times, value) in [(11.0, "0.330"), (-11.0, "−0.330")] {
            let said = said("track-width", times).unwrap();
            assert!(said.contains(&format!("track-width scale = {value} is far beyond the usual 0.030")), "{said}");
        }
        assert_eq!(said("lever-arm", 11.0), None);
    }
}
