//! What to drive next, as data: a manoeuvre thought through with the model, or a general advice.

use super::envelope::Envelope;
use super::manoeuvre::Manoeuvre;
use crate::discrepancy::diagnosis::advice::Advice;
use crate::effects::Applied;

/// A manoeuvre at the speeds and turns of a vehicle.
#[derive(Clone, Debug)]
pub struct PlannedManoeuvre {
    /// Shares of speeds and turns.
    pub manoeuvre: &'static Manoeuvre,
    /// The speeds and turns.
    pub envelope: Envelope,
}

/// The next experiment.
#[derive(Clone, Debug)]
pub enum NextStep {
    /// One that needs no thinking through.
    Advice(Advice),
    /// A manoeuvre that tells an effect from others that explain the same runs.
    Separate {
        /// The effect that was chosen.
        chosen: Applied,
        /// The others that a manoeuvre tells from it.
        rivals: Vec<Applied>,
        /// Those that none does.
        beyond: Vec<Applied>,
        /// The manoeuvre that is expected to tell most.
        manoeuvre: PlannedManoeuvre,
        /// The evidence to expect of it once.
        expected_delta_bic: f64,
        /// How often it has to be driven; `None` where that is beyond reason.
        times: Option<f64>,
    },
    /// A manoeuvre that shows an effect of plausible size, and the evidence to expect.
    Reveal {
        /// The effect.
        effect: Applied,
        /// The manoeuvre.
        manoeuvre: PlannedManoeuvre,
        /// The evidence to expect.
        expected_delta_bic: f64,
    },
    /// A manoeuvre that mends most of what some runs leave open.
    Mend {
        /// What it is expected to mend by itself; nothing where it has to be repeated.
        mends: Vec<Mended>,
        /// The manoeuvre.
        manoeuvre: PlannedManoeuvre,
    },
}

/// An open question that a manoeuvre settles.
#[derive(Clone, Debug)]
pub enum Mended {
    /// An effect shows.
    Shown(Box<Applied>),
    /// Two effects are told apart.
    Separated(Box<[Applied; 2]>),
}
