//! The check in one line: runs → fit of the model as given → information → what it says.

use super::advice::Open;
use super::check_report::{Check, Health, Prospect, Seen, Standing};
use super::confusable_pairs::{told_apart, unseparated};
use super::data_quality::health;
use super::detection_power::{Candidate, DetectionThreshold, ExpectedDetection, Table, candidates, groups};
use super::expected_gain::Background;
use super::fisher_information::Driven;
use crate::discrepancy::diagnosis::equivalents::measured;
use crate::discrepancy::diagnosis::verdict;
use crate::discrepancy::estimation::fit::Effort;
use crate::discrepancy::estimation::noise_model::NoiseModel;
use crate::discrepancy::estimation::problem::Problem;
use crate::discrepancy::preprocessing::outliers::without_gross_errors;
use crate::discrepancy::preprocessing::unit_errors::too_sparse;
use crate::discrepancy::record::run_record::Record;
use crate::discrepancy::report::Verdict;
use crate::discrepancy::request::common_roles;
use crate::effects::Effect;
use crate::error::Result;
use crate::files::{ModelFile, Run};
use crate::model::Model;
use crate::wording::listed;
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

/// Names in the summary.
const NAMED: usize = 4;

/// Says what runs can tell of a model.
///
/// ```no_run
/// use creepage::discrepancy::identifiability::{Checked, check};
/// use creepage::files::{ModelFile, Run};
/// use creepage::{effects, model};
/// let file = ModelFile::read("model.toml", &model::known(effects::all())).unwrap();
/// let runs = [Run::read("run.csv", &file).unwrap()];
/// let answer = check(&Checked { file: &file, runs: &runs, library: effects::all() }, &|_| ()).unwrap();
/// println!("{}", answer.summary);
/// ```
///
/// # Errors
/// When runs log different inputs, or the model file's effects do not apply to its vehicle.
pub fn check(of: &Checked, progress: &dyn Fn(&str)) -> Result<Check> {
    let roles = common_roles(of.runs, &[])?;
    let model = Model::from_file(of.file, of.library, &roles)?;
    progress("looking at the rows");
    let sparse = too_sparse(&model, of.runs)?;
    let record = |r: &Run| {
        let record = Record::of_run(r, of.file.input_timing, model.trailer_count());
        if sparse.is_some() { Ok((record, 0)) } else { without_gross_errors(&record, &model) }
    };
    let clean: Vec<(Record, usize)> = of.runs.par_iter().map(record).collect::<Result<_>>()?;
    let (records, gross): (Vec<Record>, Vec<usize>) = clean.into_iter().unzip();
    let data = health(&model, of.runs, &records, &gross)?;
    if let Some(why) = sparse {
        return Ok(without_fit(data, verdict::unusable(why)));
    }
    let problem = Problem::new(records, of.file.noise.position, of.file.noise.heading);
    if let Some(outcome) = verdict::before_fitting(&problem, &model)? {
        return Ok(without_fit(data, outcome));
    }
    progress("fitting the model as it is");
    let starts = problem.starts(&model)?;
    let fit = problem.fit(&model, &starts, &problem.variances, Effort::FULL)?;
    let Some(fit) = fit else { return Ok(without_fit(data, verdict::undefined_motion())) };
    let data = data.with_fit(problem.variances.measurement(), &fit, problem.records[0].has_heading);
    progress("weighing what each effect would leave in these runs");
    let all = candidates(&model, of.library);
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
    let shown = |c: &Candidate| ExpectedDetection::of(&model, &driven, c, &bar, &ground);
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
    progress("thinking manoeuvres through");
    let open = Open {
        missed: of_kind(&|s| s == Seen::No),
        pairs: pairs.iter().filter(|u| u.pair.why == "data").map(|u| (u.candidates, u.pair.misfit)).collect(),
        all: &all,
        shown: &shown,
        ground,
        bar,
    };
    let next_experiment = open.advice(&problem, &fit)?;
    let mut not_separated: Vec<_> = pairs.into_iter().map(|u| u.pair).collect();
    not_separated.sort_by(|a, b| a.misfit.total_cmp(&b.misfit));
    let (verdict, summary) = standing(&effects, of.library);
    Ok(Check { schema: 1, verdict, summary, data, effects, not_separated, next_experiment })
}

impl Check {
    /// The answer for runs that are not even put to the model.
    pub(crate) fn cut_short(outcome: verdict::Outcome) -> Self {
        without_fit(Health::default(), outcome)
    }
}

fn without_fit(data: Health, outcome: verdict::Outcome) -> Check {
    let verdict = match outcome.verdict {
        Verdict::UnusableData => Standing::UnusableData,
        _ => Standing::NotIdentifiable,
    };
    Check {
        schema: 1,
        verdict,
        summary: outcome.sentence.unwrap_or_default(),
        data,
        effects: vec![],
        not_separated: vec![],
        next_experiment: outcome.next_experiment,
    }
}

/// The verdict by the basic effects, and a sentence.
fn standing(effects: &[Prospect], library: &[Effect]) -> (Standing, String) {
    let missed: Vec<&str> = effects.iter().filter(|e| e.seen == Seen::No).map(|e| e.id.as_str()).collect();
    let basic = library.iter().any(|e| e.basic && missed.contains(&e.id.as_str()));
    let named = listed(missed.iter().copied().take(NAMED));
    let more = missed.len().saturating_sub(NAMED);
    let more = if more > 0 { format!(" (and {more} more)") } else { String::new() };
    match (missed.is_empty(), basic) {
        (true, _) => (
            Standing::Identifiable,
            "These runs would show every effect of the library that applies, at its plausible size.".into(),
        ),
        (false, false) => (
            Standing::Identifiable,
            format!("These runs would show the basic effects at their plausible sizes, but not {named}{more}."),
        ),
        (false, true) => {
            (Standing::NotIdentifiable, format!("These runs would not show {named}{more} at a plausible size."))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeMap;

    /// A basic effect that would be missed decides, a user's own as well as one of the catalogue.
    #[test]
    fn a_basic_effect_that_is_missed_says_not_identifiable() {
        let own = Effect { id: "my-creep".into(), basic: true, ..Effect::default() };
        let missed = Prospect {
            id: own.id.clone(),
            trailer: None,
            place: String::new(),
            seen: Seen::No,
            parameters: BTreeMap::new(),
        };
        let plain = Effect { basic: false, ..own.clone() };
        let told = |effect| standing(std::slice::from_ref(&missed), &[effect]).0;
        assert_eq!((told(own), told(plain)), (Standing::NotIdentifiable, Standing::Identifiable));
    }
}
