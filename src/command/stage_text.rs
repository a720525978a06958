//! Stages of long work in words, for the line of progress.

use creepage::Stage;

/// What is done in a stage.
pub fn stage_text(stage: &Stage) -> String {
    match stage {
        Stage::Rows => "looking at the rows".into(),
        Stage::ClockAlignment => "runs; aligning their clocks".into(),
        Stage::ClockRefinement => "runs; aligning their clocks beside what was chosen".into(),
        Stage::ModelFit => "fitting the model as it is".into(),
        Stage::Candidates { chosen } => format!("candidates weighed, {chosen} chosen"),
        Stage::Scopes => "looking for what holds in part only".into(),
        Stage::UnnamedTerms => "looking for an equation of what has no name".into(),
        Stage::PartsOfData => "parts of the data asked for the same effects".into(),
        Stage::InputSampling => "asking every second row of the inputs for the same effects".into(),
        Stage::Evidence => "effects; weighing the evidence for each".into(),
        Stage::Draws => "data sets drawn without an effect; what it would gain on each".into(),
        Stage::HeldOut => "opening the held-out data".into(),
        Stage::Detection => "effects; weighing what each would leave in these runs".into(),
        Stage::Experiment => "thinking manoeuvres through".into(),
        Stage::Cases { found: 0 } => "cases".into(),
        Stage::Cases { found } => format!("cases, {found} of them from a run that was stopped"),
        Stage::Drives => "drives with feedback".into(),
        Stage::FirstGuesses => "first guesses; looking for a plan from each".into(),
        Stage::Robots => "robots; finding what each misses".into(),
        Stage::FleetFits => "robots; fitting their runs with what the fleet needs".into(),
        Stage::Claims { id } => format!("pieces of evidence; {id}"),
        Stage::Figures { name } => format!("figures; drawing {name}"),
    }
}
