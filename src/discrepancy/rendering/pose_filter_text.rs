//! A filter that smooths the measured pose, in words.

use crate::discrepancy::report::Finding;
use crate::number_format::{significant, with_error};

/// The filter as a finding, with the lines of the model file that undo it.
pub fn finding(time_constant: f64, std: Option<f64>) -> Finding {
    let says = format!(
        "the measured pose is smoothed by a low-pass filter with a time constant of {} s, as a localisation or a receiver \
         makes it; the filter is undone before the fit",
        with_error(time_constant, std)
    );
    Finding {
        id: "pose-filter".into(),
        says,
        mend: Some(format!("[sensor]\npose_filter = {}", significant(time_constant, 4))),
    }
}

/// The answer where nothing else is missing.
pub fn summary(time_constant: f64, std: Option<f64>) -> String {
    format!(
        "The measured pose is smoothed by a low-pass filter of {} s; of the pose before it the model explains these runs to \
         their noise, and no effect is missing.",
        with_error(time_constant, std)
    )
}
