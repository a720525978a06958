//! The data behind the report's pictures.

use crate::discrepancy::diagnosis::before_after::{Judged, Predictors};
use crate::discrepancy::preprocessing::dataset::Data;
use crate::discrepancy::record::record::Record;
use crate::discrepancy::report::{Candidate, PathPicture, Pictures, Report};
use crate::discrepancy::selection::select::Choice;
use crate::discrepancy::shooting::rollout::Predictor;
use crate::effects::Applied;
use crate::error::Result;
use crate::model::Model;

/// Runs that are drawn.
const MOST_RUNS: usize = 6;
/// The definition by which inputs lag.
const DELAY: &str = "delay";

pub(crate) fn pictures(data: &Data, choice: &Choice, report: &Report, judged: &Judged) -> Pictures {
    let drawn = |records: &[Record], [before, after]: &[Predictors; 2], held_out: bool| -> Vec<PathPicture> {
        let each = records.iter().zip(before.each()).zip(after.each());
        each.map(|((r, before), after)| path(r, held_out, before, after)).take(MOST_RUNS).collect()
    };
    let held_out = drawn(&data.held_out, &judged.held_out, true).into_iter().take(MOST_RUNS / 2);
    let paths = held_out.chain(drawn(&data.fitted, &judged.fitted, false)).take(MOST_RUNS).collect();
    let rivals: Vec<&Applied> = choice.chosen.iter().flat_map(|c| &c.rivals).collect();
    let candidates = choice.candidates.iter().map(|s| Candidate {
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
        residuals: vec![],
        candidates: candidates.collect(),
        equations: named.chain(without_name).collect(),
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

/// The measured path of a run beside that of the model as given, which nothing was fitted to.
pub(crate) fn path_as_given(record: &Record, model: &Model) -> Result<PathPicture> {
    let before = pieces(record, &Predictor::new(model, record)?);
    Ok(PathPicture { before, ..measured_path(record, false) })
}

/// Measured and predicted paths; the models are restarted so rarely that a gap shows, and at least once a picture.
fn path(record: &Record, held_out: bool, before: &Predictor, after: &Predictor) -> PathPicture {
    PathPicture { before: pieces(record, before), after: pieces(record, after), ..measured_path(record, held_out) }
}

fn pieces(record: &Record, predictor: &Predictor) -> Vec<Vec<[f64; 2]>> {
    let duration = record.time[record.rows.end - 1] - record.time[record.rows.start];
    let horizon = (duration - 1.5).clamp(1.0, 30.0);
    let xy = |y: Vec<f64>| [y[0], y[1]];
    let piece = |(from, to): (usize, usize)| predictor.outputs(from, to).into_iter().map(xy).collect();
    predictor.windows(horizon).into_iter().map(piece).collect()
}

/// What an effect says, as equations: each definition it rewrites, and the rates of its states.
pub fn equation(applied: &Applied, model: &Model) -> String {
    let Ok(definitions) = model.definitions() else { return String::new() };
    let names: Vec<_> = definitions.iter().map(|(n, _)| n.clone()).collect();
    let targets = applied.effect.targets(&names, applied.trailer).unwrap_or_default();
    let mut lines = Vec::new();
    for (name, formula) in targets {
        let old = definitions.get(&name).cloned();
        let short = old.filter(|f| f.to_string().len() <= 24);
        let shown = formula.substitute(&|s| match (s.as_str(), &short) {
            ("it", Some(f)) => Some(f.clone()),
            ("it", None) => Some(crate::formula::Expr::sym(name.clone())),
            _ => None,
        });
        let verb = if short.is_some() { "=" } else { "becomes" };
        lines.push(match name.as_str() {
            n if shown.to_string() == n => constraint_of(n, model),
            n => format!("{n} {verb} {}", shown),
        });
    }
    lines.extend(applied.effect.states.iter().map(|(name, s)| format!("{name}' = {}", s.rate)));
    lines.join("; ")
}

/// The constraint whose creep coefficient a name is; of the time that inputs lag, what it does to them.
fn constraint_of(name: &str, model: &Model) -> String {
    match model.constraints().into_iter().find(|c| c.creep.as_str() == name) {
        Some(constraint) => format!("{} = 0", constraint.row()),
        None if name == DELAY => format!("u(t) becomes u(t - {DELAY})"),
        None => name.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A definition that is zero in the model is a coefficient of a constraint, the inputs' delay, or a name of a user's.
    #[test]
    fn what_was_zero_is_told_by_what_it_is() {
        let model = Model::new("unicycle", &[("wheel_radius", 0.5)]).unwrap();
        assert!(constraint_of("e_rc", &model).ends_with(" = 0"), "{}", constraint_of("e_rc", &model));
        assert_eq!(constraint_of(DELAY, &model), "u(t) becomes u(t - delay)");
        assert_eq!(constraint_of("w_x", &model), "w_x");
    }
}
