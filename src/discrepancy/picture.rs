//! The data behind the report's pictures.

use super::choose::Choice;
use super::data::Data;
use super::discover::{errors, floor};
use super::gap::Predictor;
use super::record::Record;
use super::report::{Candidate, GapCurve, PathPicture, Pictures, Report};
use crate::effects::Applied;
use crate::error::Result;
use crate::model::Model;

/// Horizons of the curve, s.
const CURVE: [f64; 12] = [0.2, 0.5, 1.0, 2.0, 3.0, 5.0, 7.0, 10.0, 15.0, 20.0, 30.0, 45.0];
/// Windows a point of the curve needs.
const FEWEST_WINDOWS: usize = 2;
/// Runs that are drawn.
const MOST_RUNS: usize = 6;

pub(super) fn pictures(data: &Data, model: &Model, choice: &Choice, report: &Report, seed: u64) -> Result<Pictures> {
    let held_out = data.held_out.iter().map(|r| (r, true));
    let fitted = data.fitted.iter().map(|r| (r, false));
    let paths = held_out.take(MOST_RUNS / 2).chain(fitted).take(MOST_RUNS);
    let paths = paths.map(|(r, held_out)| path(r, held_out, model, &choice.after.model)).collect::<Result<_>>()?;
    let rivals: Vec<&Applied> = choice.chosen.iter().flat_map(|c| &c.rivals).collect();
    let candidates = choice.candidates.iter().map(|s| Candidate {
        id: s.applied.label(),
        delta_bic: s.delta_bic,
        chosen: choice.chosen.iter().any(|c| c.applied.same_as(&s.applied)),
        rival: rivals.iter().any(|r| r.same_as(&s.applied)),
    });
    Ok(Pictures {
        paths,
        gap: curve(data, model, choice, seed)?,
        residuals: vec![],
        candidates: candidates.collect(),
        equations: report.effects.iter().map(|e| (e.place.clone(), e.equation.clone())).collect(),
    })
}

fn curve(data: &Data, model: &Model, choice: &Choice, seed: u64) -> Result<GapCurve> {
    let mut curve = GapCurve::default();
    let enough = |records: &[Record], h: f64| errors(records, model, h).map(|e| e.windows() >= FEWEST_WINDOWS);
    let records = if enough(&data.held_out, 1.0)? { &data.held_out } else { &data.fitted };
    for h in CURVE {
        if !enough(records, h)? {
            continue;
        }
        curve.horizon.push(h);
        curve.before.push(errors(records, model, h)?.position_rms());
        curve.after.push(errors(records, &choice.after.model, h)?.position_rms());
        curve.floor.push(floor(records, choice, h, seed)?.position_rms());
    }
    Ok(curve)
}

/// The measured path of a run.
pub(super) fn measured_path(record: &Record, held_out: bool) -> PathPicture {
    let point = |i: usize| [record.columns[0][i], record.columns[1][i]];
    PathPicture {
        run: record.name.clone(),
        held_out,
        measured: record.rows.clone().map(point).collect(),
        ..PathPicture::default()
    }
}

/// Measured and predicted paths; the models are restarted so rarely that a gap shows, and at least once a picture.
fn path(record: &Record, held_out: bool, before: &Model, after: &Model) -> Result<PathPicture> {
    let duration = record.time[record.rows.end - 1] - record.time[record.rows.start];
    let horizon = if duration > 70.0 { 30.0 } else { (duration - 1.5).clamp(1.0, 30.0) };
    let pieces = |model: &Model| -> Result<Vec<Vec<[f64; 2]>>> {
        let p = Predictor::new(model, record)?;
        let xy = |y: Vec<f64>| [y[0], y[1]];
        let piece = |(from, to): (usize, usize)| p.outputs(from, to).into_iter().map(xy).collect();
        Ok(p.windows(horizon).into_iter().map(piece).collect())
    };
    Ok(PathPicture { before: pieces(before)?, after: pieces(after)?, ..measured_path(record, held_out) })
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

/// The constraint whose creep coefficient a name is.
fn constraint_of(name: &str, model: &Model) -> String {
    let found = model.constraints().into_iter().find(|c| c.creep.as_str() == name);
    found.map_or_else(|| name.to_string(), |c| format!("{} = 0", c.row()))
}
