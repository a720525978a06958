//! What remains above the noise floor, said whatever else is named.

use super::verdict::disagrees;
use crate::discrepancy::estimation::fit::Fit;
use crate::discrepancy::estimation::unexplained;
use crate::discrepancy::localisation::constraint_residuals::ConstraintResiduals;
use crate::discrepancy::localisation::driving_regimes::disagreements;
use crate::discrepancy::report::{Gap, Remains, judged, judged_alike};
use crate::number_format::significant;

/// A gap beyond so many floors is not the noise.
const ABOVE: f64 = 1.5;

/// What a model leaves: where most of it is, and by how much the gap exceeds its floor; `None` at the floor.
pub(crate) fn remains(fit: &Fit, after: &[ConstraintResiduals], gaps: &[Gap]) -> Option<Remains> {
    let largest = largest_ratio(gaps);
    let stands_out = disagrees(fit, after);
    let is_left = unexplained::remains(fit) && largest.is_some_and(|(_, ratio)| ratio > ABOVE);
    if !stands_out && !is_left {
        return None;
    }
    let (name, ratio) = largest?;
    let most = disagreements(after).into_iter().next()?;
    let of = match most.place.as_str() {
        "rotation constraint" => "along the vehicle",
        "traverse constraint" => "across the vehicle",
        "yaw rate" => "in yaw",
        _ => "at the trailers",
    };
    let during = if most.regime == "the whole run" { String::new() } else { format!(", during {}", most.regime) };
    let seconds = |t: f64| significant(t, 3);
    let says = format!(
        "{name} error is {} times the noise, most of it {of}, from {} s to {} s of {}{during}",
        significant(ratio, 2),
        seconds(most.from),
        seconds(most.to),
        most.run,
    );
    Some(Remains { ratio, place: most.place, from: most.from, to: most.to, regime: most.regime, says })
}

/// The largest share of a floor that a gap is, and what the gap is judged on.
fn largest_ratio(gaps: &[Gap]) -> Option<(&'static str, f64)> {
    let of = |g: &&Gap| {
        let (name, v) = judged(g)?;
        let position = v.position_rms_after / g.noise_floor.position_rms;
        let heading = v.heading_rms_after.zip(g.noise_floor.heading_rms).map_or(0.0, |(a, f)| a / f);
        Some((name, position.max(heading))).filter(|(_, ratio)| ratio.is_finite())
    };
    judged_alike(gaps).iter().filter_map(of).max_by(|a, b| a.1.total_cmp(&b.1))
}
