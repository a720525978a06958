//! A filter that smooths the measured pose, in words.

use crate::discrepancy::report::Finding;
use crate::files::PoseFilter;
use crate::number_format::{significant, with_error};

/// The filter as a finding, with the lines of the model file that undo it.
pub fn finding(filter: PoseFilter, late: f64, std: Option<f64>) -> Finding {
    let says = format!(
        "the measured pose is smoothed by {}, as a localisation or a receiver makes it; the filter is undone before the fit",
        named(filter, late, std)
    );
    let (key, value) = filter.entry();
    Finding { id: "pose-filter".into(), says, mend: Some(format!("[sensor]\n{key} = {}", significant(value, 4))) }
}

/// The answer where nothing else is missing.
pub fn summary(filter: PoseFilter, late: f64, std: Option<f64>) -> String {
    format!(
        "The measured pose is smoothed by {}; of the pose before it the model explains these runs to their noise, and no \
         effect is missing.",
        named(filter, late, std)
    )
}

fn named(filter: PoseFilter, late: f64, std: Option<f64>) -> String {
    let late = with_error(late, std);
    match filter {
        PoseFilter::Continuous(_) => format!("a low-pass filter with a time constant of {late} s"),
        PoseFilter::OfRows(share) => format!(
            "a low-pass filter that takes {} % of each new pose and makes it late by {late} s",
            significant(100.0 * share, 3)
        ),
    }
}
