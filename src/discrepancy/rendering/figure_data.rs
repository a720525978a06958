//! The data behind the report's pictures.

use crate::discrepancy::diagnosis::before_after::{ModelComparison, Rollouts};
use crate::discrepancy::localisation::constraint_residuals::ConstraintResiduals;
use crate::discrepancy::preprocessing::dataset::Data;
use crate::discrepancy::record::run_record::Record;
use crate::discrepancy::report::{CandidatePicture, ColumnPicture, PathPicture, Pictures, Report};
use crate::discrepancy::selection::choice::Selected;
use crate::discrepancy::shooting::rollout::Rollout;
use crate::effects::Applied;
use crate::error::Result;
use crate::files::Run;
use crate::model::Model;

/// Runs that are drawn.
const MOST_RUNS: usize = 6;

/// The pictures of a report, the residuals before and after among them.
pub(crate) fn pictures(
    data: &Data,
    choice: &Selected,
    report: &Report,
    judged: &ModelComparison,
    [before, after]: [&[ConstraintResiduals]; 2],
) -> Pictures {
    let drawn = |records: &[Record], [before, after]: &[Rollouts; 2], held_out: bool| -> Vec<PathPicture> {
        let each = records.iter().zip(before.each()).zip(after.each());
        each.map(|((r, before), after)| path(r, held_out, before, after)).take(MOST_RUNS).collect()
    };
    let held_out = drawn(&data.held_out, &judged.held_out, true).into_iter().take(MOST_RUNS / 2);
    let paths = held_out.chain(drawn(&data.fitted, &judged.fitted, false)).take(MOST_RUNS).collect();
    let rivals: Vec<&Applied> = choice.chosen.iter().flat_map(|c| &c.rivals).collect();
    let candidates = choice.candidates.iter().map(|s| CandidatePicture {
        id: s.applied.label(),
        delta_bic: s.delta_bic,
        chosen: choice.chosen.iter().any(|c| c.applied.same_as(&s.applied)),
        rival: rivals.iter().any(|r| r.same_as(&s.applied)),
    });
    let named = report.effects.iter().map(|e| (e.place.clone(), e.equation.clone()));
    let without_name = report.unnamed.iter().map(|u| (u.place.clone(), u.equation.clone()));
    Pictures {
        paths,
        gap: judged.curve(),
        residuals: before.iter().zip(after).flat_map(|(b, a)| b.pictures(a)).collect(),
        candidates: candidates.collect(),
        equations: named.chain(without_name).collect(),
        ..Pictures::default()
    }
}

/// The measured path of a run.
pub(crate) fn measured_path(record: &Record, held_out: bool) -> PathPicture {
    let point = |i: usize| [record.columns[0][i], record.columns[1][i]];
    PathPicture {
        run: record.name.clone(),
        held_out,
        measured: record.rows.clone().map(point).collect(),
        ..PathPicture::default()
    }
}

/// The inputs and the pose of runs as they were logged, each over time.
pub fn columns(runs: &[Run], model: &Model) -> Vec<ColumnPicture> {
    runs.iter().flat_map(|run| columns_of(run, model)).collect()
}

fn columns_of(run: &Run, model: &Model) -> Vec<ColumnPicture> {
    let column = |name: &str, unit: &str, values: &Vec<f64>| ColumnPicture {
        run: run.name.clone(),
        name: name.replace('_', " "),
        unit: unit.into(),
        time: run.time.clone(),
        values: values.clone(),
    };
    let inputs = run.roles.iter().zip(&run.inputs).map(|(role, of)| column(role, model.vehicle.unit_of(role), of));
    let pose = [("x", "m", Some(&run.x)), ("y", "m", Some(&run.y)), ("heading", "rad", run.heading.as_ref())];
    let pose = pose.into_iter().filter_map(|(name, unit, of)| Some(column(name, unit, of?)));
    inputs.chain(pose).collect()
}

/// The measured path of a run beside that of the model as given, which nothing was fitted to.
pub(crate) fn path_as_given(record: &Record, model: &Model) -> Result<PathPicture> {
    let before = pieces(record, &Rollout::new(model, record)?);
    Ok(PathPicture { before, ..measured_path(record, false) })
}

/// Measured and predicted paths; the models are restarted so rarely that a gap shows, and at least once a picture.
fn path(record: &Record, held_out: bool, before: &Rollout, after: &Rollout) -> PathPicture {
    PathPicture { before: pieces(record, before), after: pieces(record, after), ..measured_path(record, held_out) }
}

fn pieces(record: &Record, predictor: &Rollout) -> Vec<Vec<[f64; 2]>> {
    let [first, last] = record.span();
    let horizon = (last - first - 1.5).clamp(1.0, 30.0);
    let xy = |y: Vec<f64>| [y[0], y[1]];
    let piece = |(from, to): (usize, usize)| predictor.outputs(from, to).into_iter().map(xy).collect();
    predictor.windows(horizon).into_iter().map(piece).collect()
}
