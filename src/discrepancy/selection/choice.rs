//! The outcome of the selection.

use super::search::Candidate;
use crate::discrepancy::estimation::fit::Fit;
use crate::effects::Applied;
use crate::model::Model;

/// An effect that was chosen.
#[derive(Clone, Debug)]
pub struct SelectedEffect {
    /// The effect at its fitted values.
    pub applied: Applied,
    /// Standard deviations of its values, where the data give them.
    pub std: Vec<Option<f64>>,
    /// BIC without minus BIC with the effect, beside all others.
    pub delta_bic: f64,
    /// Probability of so large an improvement where the effect is not there.
    pub p_value: f64,
    /// Effects that these data do not tell from it.
    pub rivals: Vec<Applied>,
}

/// The outcome of the selection.
#[derive(Clone, Debug)]
pub struct Selected {
    /// The model as given.
    pub before: Fit,
    /// The model with the chosen effects.
    pub after: Fit,
    /// The chosen effects, in the order of the model.
    pub chosen: Vec<SelectedEffect>,
    /// The models on the way, after each addition.
    pub steps: Vec<(String, Model)>,
    /// All candidates as they stood against the model as given.
    pub candidates: Vec<Candidate>,
    /// Effects and terms that the whole data ask for, and parts of them with other values, so that they are not kept.
    pub inconsistent: Vec<Applied>,
    /// Effects and terms that come and go with how often the inputs are logged, so that they are not kept.
    pub sampling_sensitive: Vec<Applied>,
}
