//! A pose that a low-pass filter has smoothed before it was logged (output dynamics; Ljung, *System Identification*, 1999,
//! chapter 4.2: an output error model behind a known pole): found where a delay is named and leaves a rest, undone, and
//! the runs asked again.
//!
//! A filter of first order delays a slow motion, by its time constant τ or, where it smooths row by row, by (1 − α)/α rows, and
//! cuts corners: beside the delay the corners are then taken for creep. With the filter undone there is no delay left, which
//! determines it: what is left of the delay is what the filter lacks. Both forms are asked. Undone, noise behind the filter is
//! √2·τ/Δt as large: where it hides what the filter does to the corners, the runs are left as they were logged.

use super::discovery::{Clocks, Discovery};
use super::estimation::fit::{Effort, Fit};
use super::estimation::problem::Problem;
use super::estimation::unexplained::remains;
use super::pipeline::discover_by_clocks;
use super::preprocessing::dataset::Data;
use super::rendering::pose_filter_text;
use super::report::{BeforeAfter, Estimate, Gap, Report, Verdict};
use super::request::{Request, common_roles};
use crate::effects::{Applied, of_clock};
use crate::error::Result;
use crate::files::{EffectEntry, ModelFile, PoseFilter, Run};
use crate::model::Model;
use crate::numerics::usual_step;
use crate::progress::OnProgress;

/// Times a filter is undone, at most, before its time constant stands.
const ROUNDS: usize = 12;
/// A delay of so small a share of the time constant is none, and so is one of less than its deviation.
const ARRIVED: f64 = 1e-3;
/// A filter explains a rest where it leaves less than this share of the gap.
const EXPLAINS: f64 = 0.7;
/// A difference of the deviance that is very strong evidence (Kass and Raftery, 1995).
const EVIDENT: f64 = 10.0;

/// How late the pose of runs is, and the deviation of that, s.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Delay {
    by: f64,
    std: Option<f64>,
}

/// A filter of the pose before which the given model explains the runs.
#[derive(Clone, Copy, Debug, PartialEq)]
struct FoundFilter {
    filter: PoseFilter,
    /// How late it makes a slow motion.
    late: Delay,
    /// The deviance of the runs before it.
    deviance: f64,
}

/// A form of filter, by how late it makes a slow motion, s, in rows so many s apart.
type Form = fn(f64, f64) -> PoseFilter;

const FORMS: [Form; 2] =
    [|late, _| PoseFilter::Continuous(late), |late, step| PoseFilter::OfRows(step / (step + late))];

/// Finds what is missing, of a pose before the filter that smoothed it where there was one.
///
/// # Errors
/// As [`discover_by_clocks`].
pub(crate) fn discover_before_filter(request: &Request, clocks: Clocks, progress: &OnProgress) -> Result<Discovery> {
    let found = discover_by_clocks(request, clocks.clone(), progress)?;
    if request.file.sensor.pose_filter.is_some() || !may_be_filtered(&found.report) {
        return Ok(found);
    }
    for of in estimated(request)? {
        let before = |runs: &[Run]| runs.iter().map(|r| r.before_pose_filter(of.filter)).collect::<Vec<Run>>();
        let (runs, held_out) = (before(request.runs), before(request.held_out));
        let again = Request { runs: &runs, held_out: &held_out, ..*request };
        let again = discover_by_clocks(&again, clocks.clone(), progress)?;
        if again.report.verdict != Verdict::NoMissingEffect {
            continue;
        }
        let explains = match beside_what_is_late(&found) {
            Some(others) => refutes(request, &of, others)?,
            None => shrinks(&found.report.gap, &again.report.gap),
        };
        if explains {
            return Ok(told(again, of));
        }
    }
    Ok(found)
}

/// What was found beside what is late; `None` where there is nothing.
fn beside_what_is_late(found: &Discovery) -> Option<Vec<EffectEntry>> {
    let late = || found.report.effects.iter().filter(|e| e.parameters.values().any(is_late));
    let others = found.added.iter().filter(|a| !late().any(|e| e.id == a.id && e.on == a.input));
    Some(others.cloned().collect()).filter(|others: &Vec<EffectEntry>| !others.is_empty())
}

/// Whether the runs before the filter refute what was found beside it: with those values they are explained worse.
fn refutes(request: &Request, of: &FoundFilter, others: Vec<EffectEntry>) -> Result<bool> {
    let mut file = request.file.clone();
    file.effects.extend(others);
    let with = before_filter(request, &model_of(&file, request)?, Some(of.filter))?;
    Ok(with.is_some_and(|with| with.deviance > of.deviance + EVIDENT))
}

fn model_of(file: &ModelFile, request: &Request) -> Result<Model> {
    Model::from_file(file, request.library, &common_roles(request.runs, request.held_out)?)
}

/// Whether something is late, and that is not all.
fn may_be_filtered(report: &Report) -> bool {
    let is_any_late = report.effects.iter().flat_map(|e| e.parameters.values()).any(is_late);
    is_any_late && (report.remains.is_some() || report.effects.len() + report.unnamed.len() > 1)
}

/// A delay or a lag.
fn is_late(parameter: &Estimate) -> bool {
    parameter.unit == "s" && parameter.value > 0.0
}

/// The filters before which the given model explains the runs, the likeliest first.
fn estimated(request: &Request) -> Result<Vec<FoundFilter>> {
    let (Some(delay), Some(step)) = (of_clock(), usual_step(&request.runs[0].time)) else { return Ok(vec![]) };
    let model = model_of(request.file, request)?;
    let delayed = model.clone().with_effect(Applied::new(delay, None, vec![0.0]).freed());
    let logged = left(request, &delayed, None)?;
    let mut found: Vec<FoundFilter> = vec![];
    for form in FORMS {
        let Some(late) = settled(request, &delayed, logged, |late| form(late, step))? else { continue };
        let filter = form(late.by, step);
        let fit = before_filter(request, &model, Some(filter))?.filter(|fit| !remains(fit));
        found.extend(fit.map(|fit| FoundFilter { filter, late, deviance: fit.deviance }));
    }
    found.sort_by(|a, b| a.deviance_as_logged(request).total_cmp(&b.deviance_as_logged(request)));
    Ok(found)
}

/// How late a filter makes the pose that leaves no delay, from the delay of the runs as they were logged.
fn settled(
    request: &Request,
    delayed: &Model,
    logged: Option<Delay>,
    filter: impl Fn(f64) -> PoseFilter,
) -> Result<Option<Delay>> {
    let (mut late, mut lacking) = (0.0, logged);
    for _ in 0..ROUNDS {
        let Some(Delay { by, std }) = lacking else { return Ok(None) };
        late += by;
        if late <= 0.0 {
            return Ok(None);
        }
        if by.abs() < std.unwrap_or(0.0).max(ARRIVED * late) {
            return Ok(Some(Delay { by: late, std }));
        }
        lacking = left(request, delayed, Some(filter(late)))?;
    }
    Ok(None)
}

/// The delay of the runs before a filter, or as they were logged; `None` where they cannot be fitted.
fn left(request: &Request, delayed: &Model, filter: Option<PoseFilter>) -> Result<Option<Delay>> {
    let fit = before_filter(request, delayed, filter)?;
    Ok(fit.map(|fit| Delay { by: fit.p[0], std: fit.variance(0).map(f64::sqrt) }))
}

impl FoundFilter {
    /// The deviance of the rows as they were logged: before a filter each of them has another weight, and the density of what
    /// was logged is that of the pose before the filter times that weight.
    fn deviance_as_logged(&self, request: &Request) -> f64 {
        let weight = |run: &Run| usual_step(&run.time).map_or(0.0, |step| self.filter.weight(step).ln());
        let columns = |run: &Run| 2 + usize::from(run.heading.is_some()) + run.trailer_headings.len();
        let of_run = |run: &Run| (run.time.len() * columns(run)) as f64 * weight(run);
        self.deviance - 2.0 * request.runs.iter().map(of_run).sum::<f64>()
    }
}

/// A fit to the runs as they were before a filter, or as they are.
fn before_filter(request: &Request, model: &Model, filter: Option<PoseFilter>) -> Result<Option<Fit>> {
    let before = |run: &Run| filter.map_or_else(|| run.clone(), |filter| run.before_pose_filter(filter));
    let runs: Vec<Run> = request.runs.iter().map(before).collect();
    let data = Data::of(&Request { runs: &runs, held_out: &[], ..*request }, model)?;
    let problem = Problem::new(data.fitted, request.file.noise.position, request.file.noise.heading);
    let problem = problem.knowing_its_inputs(model)?;
    let starts = problem.starts(model)?;
    problem.fit(model, &starts, &problem.variances, Effort::FULL)
}

/// Whether the gap after the longest time that both tell shrinks by far, of the fitted runs or of held-out ones: the noise
/// of a pose before its filter is larger, and hides the gap of a few windows.
fn shrinks(from: &[Gap], to: &[Gap]) -> bool {
    let longest = |of: fn(&Gap) -> Option<BeforeAfter>| {
        let both = |(a, b): (&Gap, &Gap)| Some([of(a)?, of(b)?].map(|v| v.position_rms_after));
        from.iter().zip(to).rev().find_map(both).is_some_and(|[before, after]| after < EXPLAINS * before)
    };
    longest(|g| g.held_out) || longest(|g| g.fit)
}

/// What is found before the filter, and the filter.
fn told(mut found: Discovery, of: FoundFilter) -> Discovery {
    let finding = pose_filter_text::finding(of.filter, of.late.by, of.late.std);
    found.report.summary = pose_filter_text::summary(of.filter, of.late.by, of.late.std);
    found.report.data.warnings.insert(0, finding.says.clone());
    found.report.data.findings.push(finding);
    Discovery { pose_filter: Some(of.filter), ..found }
}
