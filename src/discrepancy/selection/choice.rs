//! The outcome of the selection.

use super::search::Candidate;
use crate::discrepancy::estimation::fit::Fit;
use crate::discrepancy::evidence::regime_stability::Regime;
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

/// A chosen effect, and the fit without it.
pub(crate) struct Weighed {
    pub effect: SelectedEffect,
    pub without: Fit,
}

/// Why an effect that the fit asks for is not named.
#[derive(Clone, Debug, PartialEq)]
pub enum Refusal {
    /// Its value is at an end of its range, or a share of one and more.
    Impossible,
    /// The data leave its value open.
    NoDeviation,
    /// It is worth less than it costs.
    BelowBar,
    /// It only pays along a ridge with another.
    Ridge(Box<Applied>),
    /// With another at its place, of which each explains most of what both do, it leaves a rest there: they imitate a law
    /// that neither of them is.
    Imitation(Box<Applied>),
    /// It only stands beside a law without a name.
    LeansOnLaw,
    /// Its value is another in a regime of driving.
    Regime {
        /// The regime.
        regime: Regime,
        /// Its values elsewhere and there.
        values: [f64; 2],
    },
    /// The noise of the inputs makes as much of nothing.
    InputNoise,
    /// Beside a rest it is worth little, and held-out runs are predicted no better with it.
    NotBorneOut,
    /// Another vehicle explains the data.
    OtherVehicle,
    /// The runs it was fitted to are predicted worse with it over some seconds, and over none better.
    FittedRuns(Growth),
    /// Held-out runs are predicted worse with it.
    HeldOut(Growth),
    /// Held-out runs are predicted worse with all that was found, and it is worth least of that.
    HeldOutTogether(Growth),
}

/// How the gap of some runs grows, or shrinks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Growth {
    /// After so many seconds.
    pub horizon_s: f64,
    /// Whether it is the heading's, in rad, and not the position's, in m.
    pub of_heading: bool,
    /// Without and with what was found.
    pub gap: [f64; 2],
    /// What noise alone makes of it.
    pub floor: f64,
}

/// A gap that is so many times as large as another, and as the noise floor, has grown.
pub(crate) const GREW: f64 = 1.25;
/// A gap of so large a share of another one is as good as the same.
const SAME: f64 = 0.9;

impl Growth {
    /// By how much it grows.
    pub fn factor(&self) -> f64 {
        self.gap[1] / self.gap[0].max(f64::MIN_POSITIVE)
    }

    /// Whether it grows, beyond the noise floor.
    pub fn is_real(&self) -> bool {
        self.factor() > GREW && self.gap[1] > GREW * self.floor
    }

    /// Whether it shrinks.
    pub fn shrinks(&self) -> bool {
        self.factor() < SAME
    }
}

/// What the fit asks for, and is not named.
#[derive(Clone, Debug, PartialEq)]
pub struct Refused {
    /// The effect at its fitted values.
    pub applied: Applied,
    /// Standard deviations of its values, where the data give them.
    pub std: Vec<Option<f64>>,
    /// Why.
    pub why: Refusal,
}

impl Refusal {
    /// Whether held-out runs are the reason.
    pub fn is_held_out(&self) -> bool {
        matches!(self, Self::NotBorneOut | Self::HeldOut(_) | Self::HeldOutTogether(_))
    }
}

impl Refused {
    /// One of the chosen effects.
    pub(crate) fn of(chosen: &[SelectedEffect], applied: Applied, why: Refusal) -> Self {
        let std = chosen.iter().find(|c| c.applied.same_as(&applied)).map_or_else(Vec::new, |c| c.std.clone());
        Self { applied, std, why }
    }
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
    /// What was found and refused again, and why.
    pub refused: Vec<Refused>,
    /// What the interpolation of the inputs may make up of each fitted value; nothing where that could not be asked.
    pub missed: Vec<f64>,
}
