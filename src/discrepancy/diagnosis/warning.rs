//! What a reader of a report has to know beside its answer, as data.

use crate::discrepancy::preprocessing::dataset::DatasetNote;
use crate::discrepancy::preprocessing::quantisation::CoarseInput;
use crate::discrepancy::preprocessing::unit_errors::Slip;
use crate::discrepancy::report::RemainingSensor;
use crate::discrepancy::selection::choice::Growth;
use crate::discrepancy::selection::choice::Refused;
use crate::effects::Applied;

/// A warning.
#[derive(Clone, Debug, PartialEq)]
pub enum Warning {
    /// What reading a run's file gave, in words of the reader.
    Reading {
        /// Name of the run.
        run: String,
        /// The words.
        says: String,
    },
    /// How a run enters the data.
    Dataset(DatasetNote),
    /// No run is long enough for a horizon, s.
    HorizonTooLong(f64),
    /// Parts of the runs ask for other values of effects.
    Inconsistent(Vec<Applied>),
    /// Effects take other values where every second row of the inputs is left out.
    SamplingSensitive(Vec<Applied>),
    /// An effect of the model file that the runs ask for with other values.
    Restated {
        /// As the file has it.
        old: Box<Applied>,
        /// As it was fitted.
        new: Box<Applied>,
    },
    /// A parameter far beyond its usual size.
    Implausible {
        /// The effect.
        applied: Box<Applied>,
        /// The parameter.
        parameter: String,
        /// Its value.
        value: f64,
        /// Its usual size.
        usual: f64,
        /// A slip of units that does the same.
        slip: Option<Slip>,
    },
    /// Held-out runs do not bear out an effect.
    Refuted(Box<Refused>),
    /// The held-out gap grew.
    HeldOutGapGrew {
        /// By how much.
        growth: Growth,
        /// Whether there are windows enough to judge by.
        is_judged: bool,
    },
    /// A quantity measured beside the pose that the last model misses by more than its noise.
    SensorMissed(RemainingSensor),
    /// An input in coarse steps.
    CoarseInput(CoarseInput),
    /// An input in few steps whose smooth course between them explains more than any effect.
    TakenAsRounded(CoarseInput),
    /// Another offset of a run's clocks, s, fits nearly as well as its own.
    ClockOffsetInDoubt {
        /// Name of the run.
        run: String,
        /// The offset that was taken.
        own: f64,
        /// The other one.
        other: f64,
    },
    /// The model's delay of the inputs is left out: the offset of the clocks has it.
    DelayLeftOut,
}
