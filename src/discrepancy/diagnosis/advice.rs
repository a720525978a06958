//! What to drive or log next where data contradict themselves or say too little: kinds of experiments, as data.

use crate::discrepancy::preprocessing::quantisation::CoarseInput;
use crate::discrepancy::selection::choice::Selected;
use crate::effects::Applied;
use crate::model::Model;

/// An experiment that needs no thinking through with a model.
#[derive(Clone, Debug)]
pub enum Advice {
    /// Varied driving to both sides.
    VariedDriving(Motive),
    /// Changing speeds, of a vehicle on a line.
    VariedSpeed(Motive),
    /// Poses several times as often.
    PosesOftener,
    /// Inputs several times as often: these effects take other values where every second row is left out.
    InputsOftener(Vec<Applied>),
    /// Inputs in finer steps.
    FinerInputs(CoarseInput),
}

impl Advice {
    /// Driving that is as varied as the vehicle can drive.
    pub(crate) fn varied(model: &Model, motive: Motive) -> Self {
        if model.vehicle.line { Self::VariedSpeed(motive) } else { Self::VariedDriving(motive) }
    }
}

/// Why varied driving is advised.
#[derive(Clone, Debug)]
pub enum Motive {
    /// Nothing moved.
    Motion,
    /// The runs are too short.
    Length,
    /// Parts of the runs ask for other values of these effects.
    Contradiction(Vec<Applied>),
    /// A disagreement has no name.
    Nameless,
    /// An effect of plausible size would have been missed.
    Missed(Box<Applied>),
}

/// What mends runs whose parts contradict each other: no manoeuvre can be thought through with a model that is wrong,
/// but where speed and turn change by themselves a law shows as what it is.
pub(crate) fn settling(choice: &Selected) -> Advice {
    let asked = &choice.inconsistent;
    let motive = if asked.is_empty() { Motive::Nameless } else { Motive::Contradiction(asked.clone()) };
    Advice::varied(&choice.before.model, motive)
}
