//! What runs can tell of a model: fit of the model as given, Fisher information, effects that would be seen.

use super::advice::Open;
use super::check_report::{Health, Pair, Prospect, Seen, Standing};
use super::confusable_pairs::{told_apart, unseparated};
use super::data_finding::DataFinding;
use super::data_quality::{health, of_fit};
use super::detection_power::{Candidate, DetectionThreshold, ExpectedDetection, Table, candidates, groups};
use super::expected_gain::Background;
use super::fisher_information::Driven;
use crate::discrepancy::diagnosis::equivalents::measured;
use crate::discrepancy::diagnosis::reason::Reason;
use crate::discrepancy::diagnosis::verdict;
use crate::discrepancy::estimation::fit::Effort;
use crate::discrepancy::estimation::noise_model::NoiseModel;
use crate::discrepancy::estimation::problem::Problem;
use crate::discrepancy::estimation::unexplained;
use crate::discrepancy::experiment::next_step::NextStep;
use crate::discrepancy::preprocessing::clock_jumps::ClockJump;
use crate::discrepancy::preprocessing::outliers::without_gross_errors;
use crate::discrepancy::preprocessing::prepared_run::{LeftOut, PreparedRun};
use crate::discrepancy::preprocessing::reference_jumps::Jumps;
use crate::discrepancy::preprocessing::row_defects::RowDefect;
use crate::discrepancy::preprocessing::slips;
use crate::discrepancy::preprocessing::unit_errors::too_sparse;
use crate::discrepancy::record::run_record::Record;
use crate::discrepancy::report::Verdict;
use crate::discrepancy::request::common_roles;
use crate::discrepancy::selection::odd_run::odd_runs;
use crate::effects::Effect;
use crate::error::Result;
use crate::files::{ModelFile, Run};
use crate::model::Model;
use crate::progress::{Counter, OnProgress, Stage, begin};
use rayon::prelude::*;

/// What `check` works on.
pub struct Checked<'a> {
    /// The model as its user believes it.
    pub file: &'a ModelFile,
    /// The runs.
    pub runs: &'a [Run],
    /// The effects that may be named.
    pub library: &'a [Effect],
}

/// What runs can tell of a model.
#[derive(Clone, Debug)]
pub(crate) struct Assessment {
    pub standing: Standing,
    pub grounds: Grounds,
    pub data: Health,
    pub findings: Vec<DataFinding>,
    pub effects: Vec<Prospect>,
    pub not_separated: Vec<Pair>,
    pub next: Option<NextStep>,
}

/// Why the runs stand as they do.
#[derive(Clone, Debug)]
pub(crate) enum Grounds {
    /// The runs are not even put to the model, for a reason where there is more to say.
    NotFitted(Option<Reason>),
    /// Ids of the effects that would be missed.
    Missed(Vec<String>),
}

/// What runs can tell of a model: fit of the model as given, information, effects that would be seen.
///
/// # Errors
/// When runs log different inputs, or the model file's effects do not apply to its vehicle.
pub(crate) fn assess(of: &Checked, progress: &OnProgress) -> Result<Assessment> {
    let roles = common_roles(of.runs, &[])?;
    let model = Model::from_file(of.file, of.library, &roles)?;
    let sought: Vec<Effect> = of.library.iter().filter(|e| !e.unsought).cloned().collect();
    let of = &Checked { library: &sought, ..*of };
    begin(progress, Stage::Rows)?;
    let slip = slips::any(of.file, &model, of.runs)?;
    let is_slip = slip.is_some();
    let sparse = if is_slip { slip } else { too_sparse(&model, of.runs)? };
    let timing = of.file.input_timing;
    let prepared = |r: &Run| -> Result<(PreparedRun, LeftOut)> {
        if sparse.is_some() {
            return Ok((PreparedRun::as_it_is(r, &model, timing), LeftOut::default()));
        }
        let run = PreparedRun::of(r, &model, timing)?;
        let (record, gross) = without_gross_errors(&run.record, &model)?;
        let left_out = LeftOut { gross, ..run.left_out };
        Ok((PreparedRun { record, ..run }, left_out))
    };
    let prepared: Vec<(PreparedRun, LeftOut)> = of.runs.par_iter().map(prepared).collect::<Result<_>>()?;
    let (prepared, left_out): (Vec<PreparedRun>, Vec<LeftOut>) = prepared.into_iter().unzip();
    let clocks: Vec<ClockJump> = prepared.iter().filter_map(|r| r.clock.clone()).collect();
    let jumps: Vec<Jumps> = prepared.iter().flat_map(|r| r.jumps.clone()).collect();
    let defects: Vec<RowDefect> = prepared.iter().flat_map(|r| r.defects.clone()).collect();
    let records: Vec<Record> = prepared.into_iter().map(|r| r.record).collect();
    let (data, mut findings) = health(&model, of.runs, &records, &left_out)?;
    findings.extend(defects.into_iter().map(DataFinding::Defect));
    findings.extend(clocks.into_iter().map(DataFinding::ClockJump));
    findings.extend(jumps.into_iter().map(DataFinding::Jumps));
    if let Some(slip) = sparse {
        // What follows from the slip is no finding of its own.
        if is_slip {
            findings.retain(|f| !f.is_of_motion());
            findings.push(DataFinding::Slip(slip.clone()));
        }
        return Ok(without_fit(data, findings, verdict::unusable(slip)));
    }
    let problem = Problem::new(records, of.file.noise.position, of.file.noise.heading);
    if let Some(outcome) = verdict::before_fitting(&problem, &model)? {
        return Ok(without_fit(data, findings, outcome));
    }
    begin(progress, Stage::ModelFit)?;
    let starts = problem.starts(&model)?;
    let fit = problem.fit(&model, &starts, &problem.variances, Effort::FULL)?;
    let Some(fit) = fit else { return Ok(without_fit(data, findings, verdict::undefined_motion())) };
    let data = data.with_fit(problem.variances.measurement(), &fit, problem.records[0].measures_heading());
    findings.extend(of_fit(&fit));
    if unexplained::remains(&fit) {
        let odd = odd_runs(&problem, &model, of.library, progress)?;
        findings.extend(odd.into_iter().map(Box::new).map(DataFinding::OddRun));
    }
    let all = candidates(&model, of.library);
    let counter = Counter::begin(progress, Stage::Detection, all.len())?;
    let calm = (0..fit.variances.process().len()).fold(fit.variances.clone(), NoiseModel::without_jump);
    let variances = [calm.clone(), fit.variances.clone()];
    let variance_inflation = [fit.noise_correlation_time, fit.variance_inflation()];
    let bar = DetectionThreshold {
        sample_size: fit.sample_size,
        candidates: model.applicable(of.library).len().max(1) as f64,
    };
    let driven =
        Driven { records: problem.records.clone(), plan: problem.plan.clone(), starts: fit.window_states.clone() };
    let table = Table::of(&model, &driven, &all, &groups(&all), &variances, variance_inflation)?;
    let ground = Background { calm, alike: fit.noise_correlation_time };
    let shown = |c: &Candidate| {
        let shown = ExpectedDetection::of(&model, &driven, c, &bar, &ground)?;
        counter.one().map(|()| shown)
    };
    let shown: Vec<ExpectedDetection> = all.par_iter().map(shown).collect::<Result<_>>()?;
    // Of an effect that is looked at in several directions the one that shows least.
    let weakest = |i: &usize| {
        let same = (0..all.len()).filter(|j| all[*j].applied.same_as(&all[*i].applied));
        same.min_by(|a, b| shown[*a].gain.total_cmp(&shown[*b].gain)) == Some(*i)
    };
    let listed: Vec<usize> = (0..all.len()).filter(weakest).collect();
    let effects: Vec<Prospect> = listed.iter().map(|i| table.prospect(&all, *i, &shown[*i], &bar)).collect();
    let of_kind = |wanted: &dyn Fn(Seen) -> bool| -> Vec<usize> {
        listed.iter().zip(&effects).filter(|(_, e)| wanted(e.seen)).map(|(i, _)| *i).collect()
    };
    let seen = of_kind(&|s| s != Seen::No);
    let told = |a: usize, b: usize| told_apart(&model, &driven, &all, a, b, &ground);
    let pairs = unseparated(&model, &table, &all, &seen, measured(&problem.records[0]), &told)?;
    begin(progress, Stage::Experiment)?;
    let open = Open {
        missed: of_kind(&|s| s == Seen::No),
        pairs: pairs.iter().filter(|u| u.pair.why == "data").map(|u| (u.candidates, u.pair.misfit)).collect(),
        all: &all,
        shown: &shown,
        ground,
        bar,
    };
    let next = open.advice(&problem, &fit)?;
    let mut not_separated: Vec<_> = pairs.into_iter().map(|u| u.pair).collect();
    not_separated.sort_by(|a, b| a.misfit.total_cmp(&b.misfit));
    let missed: Vec<String> = effects.iter().filter(|e| e.seen == Seen::No).map(|e| e.id.clone()).collect();
    let standing = standing(&missed, of.library);
    Ok(Assessment { standing, grounds: Grounds::Missed(missed), data, findings, effects, not_separated, next })
}

impl Assessment {
    /// The answer for runs that are not even put to the model.
    pub(crate) fn cut_short(outcome: verdict::Outcome) -> Self {
        without_fit(Health::default(), vec![], outcome)
    }
}

fn without_fit(data: Health, findings: Vec<DataFinding>, outcome: verdict::Outcome) -> Assessment {
    let standing = match outcome.verdict {
        Verdict::UnusableData => Standing::UnusableData,
        _ => Standing::NotIdentifiable,
    };
    Assessment {
        standing,
        grounds: Grounds::NotFitted(outcome.reason),
        data,
        findings,
        effects: vec![],
        not_separated: vec![],
        next: outcome.next.map(NextStep::Advice),
    }
}

/// A basic effect that would be missed decides.
fn standing(missed: &[String], library: &[Effect]) -> Standing {
    match library.iter().any(|e| e.basic && missed.contains(&e.id)) {
        true => Standing::NotIdentifiable,
        false => Standing::Identifiable,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A basic effect that would be missed decides, a user's own as well as one of the catalogue.
    #[test]
    fn a_basic_effect_that_is_missed_says_not_identifiable() {
        let own = Effect { id: "my-creep".into(), basic: true, ..Effect::default() };
        let missed = [own.id.clone()];
        let plain = Effect { basic: false, ..own.clone() };
        let told = |effect| standing(&missed, &[effect]);
        assert_eq!((told(own), told(plain)), (Standing::NotIdentifiable, Standing::Identifiable));
    }
}
