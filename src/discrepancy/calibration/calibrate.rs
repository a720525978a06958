//! Estimation of the parameters of given effects: maximum likelihood of values with the variances by REML, or the maximum a
//! posteriori where the model file has priors (Ljung, *System Identification*, 1999, chapter 7).

use super::profile_likelihood::{self, Value};
use super::targets::{Target, bounded, entry, resolved};
use crate::discrepancy::calibration_report::{CalibratedEffect, CalibratedValue, Calibration, IntervalBy, Standing};
use crate::discrepancy::clock_alignment::aligned_run::{Aligned, aligned, is_aligned, without_delay};
use crate::discrepancy::diagnosis::findings::{covariance, per_run};
use crate::discrepancy::diagnosis::verdict::{self, Outcome};
use crate::discrepancy::discovery::{Clocks, provenance, summarised};
use crate::discrepancy::estimation::bounds::{is_end_of, range_of, vanishes};
use crate::discrepancy::estimation::fit::{Effort, Fit};
use crate::discrepancy::estimation::priors::Priors;
use crate::discrepancy::estimation::problem::Problem;
use crate::discrepancy::estimation::unexplained;
use crate::discrepancy::evidence::heterogeneity::spreads;
use crate::discrepancy::evidence::parametric_bootstrap::is_regular;
use crate::discrepancy::evidence::score_test;
use crate::discrepancy::preprocessing::dataset::Data;
use crate::discrepancy::preprocessing::input_effects::on_inputs;
use crate::discrepancy::preprocessing::{slips, unit_errors};
use crate::discrepancy::rendering::{calibration_text, reason_text};
use crate::discrepancy::report::Verdict;
use crate::discrepancy::request::{Request, common_roles};
use crate::discrepancy::selection::search::{Search, find, first_of};
use crate::effects::{Applied, Effect, Parameter};
use crate::error::{Error, Result};
use crate::files::{EffectEntry, ModelFile, Run};
use crate::model::Model;
use crate::progress::{OnProgress, Stage, begin};
use std::collections::BTreeMap;

/// Half of a 95 % interval of a normal value, in deviations.
const NORMAL_95: f64 = 1.959_963_984_540_054;

/// A calibration and the entries of the model file that it gives.
pub struct Calibrated {
    /// The answer.
    pub calibration: Calibration,
    /// The effects as a model file has them.
    pub entries: Vec<EffectEntry>,
}

/// Fits the effects that targets name, all together and none selected, clocks of poses in files of their own aligned first.
///
/// # Errors
/// When a target does not name one effect of the vehicle, runs log different inputs, or the model's effects do not apply.
pub fn calibrate(
    request: &Request,
    targets: &[Target],
    near: Option<f64>,
    progress: &OnProgress,
) -> Result<Calibrated> {
    if request.runs.iter().all(is_aligned) {
        return fitted(request, targets, Clocks::default(), progress);
    }
    let (file, delay) = without_delay(request.file);
    let request = &Request { file: &file, ..*request };
    let model = Model::from_file(request.file, request.library, &common_roles(request.runs, &[])?)?;
    let by_one = match aligned(request.runs, 1.0, request, &model, near, progress)? {
        Ok(by_one) => by_one,
        Err(outcome) => return Ok(unusable(request, &Data::default(), &outcome, Clocks::default())),
    };
    let library: Vec<Effect> = request.library.iter().filter(|e| !e.is_of_clock()).cloned().collect();
    let runs: Vec<Run> = by_one.iter().map(|a| a.run.clone()).collect();
    let clocks = Clocks {
        clocks: by_one.iter().map(|a| a.clock(false)).collect(),
        warnings: by_one.iter().filter_map(Aligned::doubt).chain(delay).collect(),
    };
    fitted(&Request { runs: &runs, library: &library, ..*request }, targets, clocks, progress)
}

fn fitted(request: &Request, targets: &[Target], clocks: Clocks, progress: &OnProgress) -> Result<Calibrated> {
    begin(progress, Stage::Rows)?;
    let model = Model::from_file(request.file, request.library, &common_roles(request.runs, &[])?)?;
    let library = on_inputs(request.library, &model, request.runs);
    let wanted = resolved(targets, &model, &library, request.library)?;
    let runs = || request.runs.iter();
    let slip = slips::any(request.file, &model, runs())?;
    if let Some(slip) = slip.or(unit_errors::too_sparse(&model, runs())?) {
        return Ok(unusable(request, &Data::default(), &verdict::unusable(slip), clocks));
    }
    let data = Data::whole(request, &model)?;
    let noise = request.file.noise;
    let problem = Problem::new(data.fitted.clone(), noise.position, noise.heading).knowing_its_inputs(&model)?;
    if let Some(outcome) = verdict::before_fitting(&problem, &model)? {
        return Ok(unusable(request, &data, &outcome, clocks));
    }
    begin(progress, Stage::ModelFit)?;
    let starts = problem.starts(&model)?;
    let Some(before) = problem.fit(&model, &starts, &problem.variances, Effort::FULL)? else {
        return Ok(unusable(request, &data, &verdict::undefined_motion(), clocks));
    };
    let problem = Problem { priors: priors(&wanted, request.file), ..problem };
    let job = Job { request, problem: &problem, before: &before, wanted: &wanted };
    let Some(after) = job.fitted()? else {
        return Err(Error::run("the motion is undefined wherever these effects were fitted")
            .help("fit fewer of them, or give bounds in the model file"));
    };
    job.answer(&after, &data, clocks, progress)
}

/// The normal priors that a model file has for effects.
fn priors(wanted: &[(&Effect, Option<usize>)], file: &ModelFile) -> Priors {
    let of = |(effect, trailer): &(&Effect, Option<usize>)| {
        let applied = Applied::new(effect, *trailer, vec![0.0; effect.parameters.len()]);
        let known = entry(file, effect, *trailer).map(|e| e.known.clone()).unwrap_or_default();
        known
            .into_iter()
            .filter_map(move |(name, known)| Some((applied.symbol(&name), known.prior?)))
            .collect::<Vec<_>>()
    };
    wanted.iter().flat_map(of).fold(Priors::default(), |all, (name, prior)| all.with(name, prior))
}

struct Job<'a> {
    request: &'a Request<'a>,
    problem: &'a Problem,
    before: &'a Fit,
    wanted: &'a [(&'a Effect, Option<usize>)],
}

impl Job<'_> {
    /// All effects free: from where each alone promises most, and one after another beside those before; the better of both.
    fn together(&self) -> Result<Option<Fit>> {
        let model = &self.before.model;
        let promises = score_test::promises(self.problem, self.before, model, self.wanted)?.single;
        let begin = |model: Model, a: &Applied| model.with_effect(bounded(a.clone().freed(), self.request.file));
        let at_once = promises.iter().map(|p| &p.applied).fold(model.clone(), begin);
        let fit = |model: &Model, by: &Fit| {
            let variances = &self.before.variances;
            self.problem.fit(model, &by.window_states, variances, Effort::FULL)
        };
        let mut best = fit(&at_once, self.before)?;
        if self.wanted.len() == 1 {
            return Ok(best);
        }
        let mut by_steps = Some(self.before.clone());
        for (effect, trailer) in self.wanted {
            let Some(here) = by_steps.take() else { break };
            let one = score_test::promises(self.problem, &here, &here.model, &[(*effect, *trailer)])?.single;
            let Some(one) = one.first() else { break };
            by_steps = fit(&begin(here.model.clone(), &one.applied), &here)?;
        }
        if by_steps.as_ref().is_some_and(|s| best.as_ref().is_none_or(|b| s.deviance < b.deviance)) {
            best = by_steps;
        }
        Ok(best)
    }

    /// All effects together, but for those that vanish.
    fn fitted(&self) -> Result<Option<Fit>> {
        match self.together()? {
            Some(fit) => self.without_vanished(fit),
            None => Ok(None),
        }
    }

    /// A fit without the effects that vanish in it: at the end of its range a value has no deviation, and what the likelihood
    /// promises beyond is not to be had.
    fn without_vanished(&self, mut fit: Fit) -> Result<Option<Fit>> {
        while fit.model.free_effects().any(vanishes) {
            let mut model = fit.model.clone();
            model.effects.retain(|e| !e.free || !vanishes(e));
            match self.problem.fit(&model, &fit.window_states, &self.before.variances, Effort::FULL)? {
                Some(smaller) => fit = smaller,
                None => return Ok(None),
            }
        }
        Ok(Some(fit))
    }

    /// Intervals of an effect that vanishes: from the end of its range to what the likelihood allows.
    fn vanished(&self, fit: &Fit, at: &Applied) -> Result<Vec<Told>> {
        let with = Fit { model: fit.model.clone().with_effect(at.clone()), ..fit.clone() };
        let told = |(k, (name, p)): (usize, (&String, &Parameter))| {
            let value = Value { i: fit.p.len() + k, name: &at.symbol(name), at: at.values[k], range: range_of(p) };
            let upper = if p.positive { profile_likelihood::upper_end(self.problem, &with, &value)? } else { None };
            Ok(Told { std: None, interval: [None, upper], by: IntervalBy::Profile, at_bound: p.positive })
        };
        at.effect.parameters.iter().enumerate().map(told).collect()
    }

    /// Deviations and intervals of an effect that stands.
    fn told(&self, fit: &Fit, at: &Applied, std: &[Option<f64>]) -> Result<Vec<Told>> {
        let first = first_of(fit, at);
        let told = |(k, (name, p)): (usize, (&String, &Parameter))| {
            let (value, std) = (at.values[k], std.get(k).copied().flatten());
            let at_bound = is_end_of(p, value);
            // A time is moved along what the inputs do, which is no line.
            if is_regular(at) && !at.effect.is_of_clock() {
                let interval = [-1.0, 1.0].map(|side| std.map(|s| value + side * NORMAL_95 * s));
                return Ok(Told { std, interval, by: IntervalBy::Wald, at_bound });
            }
            let of = Value { i: first + k, name: &at.symbol(name), at: value, range: p.range };
            let interval = profile_likelihood::interval(self.problem, fit, &of)?;
            Ok(Told { std, interval, by: IntervalBy::Profile, at_bound })
        };
        at.effect.parameters.iter().enumerate().map(told).collect()
    }

    /// An effect where it vanishes.
    fn at_its_end(&self, effect: &Effect, trailer: Option<usize>) -> Applied {
        let start = effect.starts().into_iter().next().unwrap_or_default();
        let mut at = bounded(Applied::new(effect, trailer, start).freed(), self.request.file);
        for (value, p) in at.values.iter_mut().zip(effect.parameters.values()).filter(|(_, p)| p.positive) {
            *value = range_of(p)[0];
        }
        at
    }

    fn answer(&self, after: &Fit, data: &Data, clocks: Clocks, progress: &OnProgress) -> Result<Calibrated> {
        // Nothing is searched for: only what each is worth beside the others is asked.
        let weighed = Search::over(self.problem, self.before, &[]).weighed(after, None, &[], progress)?;
        let runs = spreads(after);
        let mut effects = vec![];
        let mut entries = vec![];
        for (effect, trailer) in self.wanted {
            let like = Applied::new(effect, *trailer, vec![0.0; effect.parameters.len()]);
            match find(&after.model, &like).filter(|e| e.free) {
                Some(at) => {
                    let weight = weighed.iter().find(|w| w.effect.applied.same_as(&at)).map(|w| &w.effect);
                    let told = self.told(after, &at, weight.map_or(&[], |w| &w.std))?;
                    let per_run = per_run(&at, &runs, first_of(after, &at), &self.problem.records);
                    let delta_bic = weight.map(|w| w.delta_bic);
                    effects.push(CalibratedEffect { delta_bic, per_run, ..self.effect(&at, told) });
                    entries.push(at.entry());
                }
                None => {
                    let at = self.at_its_end(effect, *trailer);
                    effects.push(self.effect(&at, self.vanished(after, &at)?));
                }
            }
        }
        let told = after.covariance.is_some();
        let standing = if told { Standing::Fitted } else { Standing::NotIdentifiable };
        let calibration = Calibration {
            verdict: standing,
            summary: calibration_text::summary(standing, effects.len()),
            effects,
            covariance: covariance(after),
            noise: self.noise(after),
            remains: unexplained::remains(after),
            deviance_gained: self.before.deviance - after.deviance,
            ..nothing(self.request, data, clocks)
        };
        Ok(Calibrated { calibration, entries })
    }

    fn noise(&self, fit: &Fit) -> BTreeMap<String, f64> {
        let measured = fit.variances.measurement();
        let headed = self.problem.records[0].measures_heading();
        let names = ["position", "heading"].into_iter().zip(measured).filter(|(name, _)| *name == "position" || headed);
        names.map(|(name, noise)| (name.to_string(), noise.variance.sqrt())).collect()
    }

    fn effect(&self, at: &Applied, told: Vec<Told>) -> CalibratedEffect {
        let known = entry(self.request.file, &at.effect, at.trailer).map(|e| &e.known);
        let of = |((k, (name, p)), told): ((usize, (&String, &Parameter)), Told)| {
            let Told { std, interval, by, at_bound } = told;
            let prior = known.and_then(|known| known.get(name)?.prior);
            let unit = p.unit.clone();
            (name.clone(), CalibratedValue { value: at.values[k], std, unit, interval, by, at_bound, prior })
        };
        CalibratedEffect {
            id: at.effect.id.clone(),
            says: at.effect.says.clone(),
            on: at.effect.on.clone(),
            trailer: at.trailer,
            parameters: at.effect.parameters.iter().enumerate().zip(told).map(of).collect(),
            delta_bic: None,
            per_run: BTreeMap::new(),
        }
    }
}

/// How well a value is known.
struct Told {
    std: Option<f64>,
    interval: [Option<f64>; 2],
    by: IntervalBy,
    at_bound: bool,
}

/// The answer for runs that the model cannot be put to.
fn unusable(request: &Request, data: &Data, outcome: &Outcome, clocks: Clocks) -> Calibrated {
    let summary = outcome.reason.as_ref().map(reason_text::sentence).unwrap_or_default();
    let verdict = match outcome.verdict {
        Verdict::NotIdentifiable => Standing::NotIdentifiable,
        _ => Standing::UnusableData,
    };
    Calibrated { calibration: Calibration { verdict, summary, ..nothing(request, data, clocks) }, entries: vec![] }
}

fn nothing(request: &Request, data: &Data, clocks: Clocks) -> Calibration {
    Calibration {
        schema: 1,
        verdict: Standing::UnusableData,
        summary: String::new(),
        effects: vec![],
        covariance: None,
        noise: BTreeMap::default(),
        remains: false,
        deviance_gained: 0.0,
        data: summarised(request, data, vec![], clocks),
        provenance: provenance(request),
    }
}
