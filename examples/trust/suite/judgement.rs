//! An answer held against the truth.

use super::case::{Case, Kind};
use super::class;
use super::make::Target;
use super::secret;
use super::trial::Trial;
use creepage::discrepancy::report::{Gap, Named, Report, Verdict};
use creepage::effects;
use std::f64::consts::TAU;

/// Rivals that the data leave open count as the name while there are no more than so many.
const FEW: usize = 3;

/// One fitted parameter of a rightly named effect.
#[derive(Clone, Debug)]
pub struct Parameter {
    /// The class of the effect.
    pub effect: &'static str,
    /// The parameter.
    pub name: &'static str,
    /// What the simulator hid.
    pub truth: f64,
    /// What was found.
    pub value: f64,
    /// Its standard deviation; NaN where none was given.
    pub std: f64,
}

impl Parameter {
    /// Error in standard deviations.
    pub fn z(&self) -> f64 {
        let off = self.value - self.truth;
        let off = if self.name == "direction" { off - TAU * (off / TAU).round() } else { off };
        off / self.std
    }

    /// Whether the 95 % interval holds the truth.
    pub fn covered(&self) -> bool {
        self.z().abs() <= 1.959_963_985
    }
}

/// What an answer is worth.
#[derive(Clone, Debug, Default)]
pub struct Judgement {
    /// The verdict, or the error.
    pub verdict: String,
    /// Every named effect's target.
    pub named: Vec<Target>,
    /// Where each of them holds, as the report has it.
    pub scopes: Vec<String>,
    /// For each hidden effect, whether it was named.
    pub found: Vec<bool>,
    /// Named effects that nothing hidden accounts for.
    pub extra: Vec<Target>,
    /// Whether an effect without a name was claimed.
    pub unnamed: bool,
    /// Whether verdict and names are all right.
    pub right: bool,
    /// What the answer is to its reader.
    pub answer: Answer,
    /// Whether the data excuse a wrong answer: they do not show the effect, or not apart from what was named.
    pub excused: bool,
    /// Parameters of the effects named by the right name.
    pub parameters: Vec<Parameter>,
    /// Held-out position gap after, over the noise floor, at 1 s and 5 s.
    pub gap_over_floor: [Option<f64>; 2],
    /// The same before anything was added.
    pub gap_before: [Option<f64>; 2],
}

/// Judges the answer to a case.
pub fn judge(case: &Case, trial: &Trial) -> Judgement {
    match &trial.answer {
        Ok(report) => judged(case, report),
        Err(why) => {
            let found = vec![false; case.scenario.hidden.len()];
            Judgement { verdict: why.clone(), found, ..Judgement::default() }
        }
    }
}

fn judged(case: &Case, report: &Report) -> Judgement {
    let named: Vec<Target> = report.effects.iter().map(target).collect();
    let mut left: Vec<usize> = (0..named.len()).collect();
    let mut parameters = Vec::new();
    let mut by_class = false;
    let mut found = Vec::new();
    let in_time = |named: &Named| case.scenario.span.is_none_or(|span| begins(named, span));
    for hidden in &case.scenario.hidden {
        let wanted = secret::target(hidden);
        let timed = |i: &usize| in_time(&report.effects[*i]);
        let by_name = left.iter().position(|i| class::same(named[*i], wanted) && timed(i));
        let by_rival = || left.iter().position(|i| listed(&report.effects[*i], wanted) && timed(i));
        let hit = by_name.or_else(by_rival);
        by_class |= hit.is_some() && by_name.is_none();
        found.push(hit.is_some());
        let hit = hit.map(|at| left.remove(at));
        if let Some(hit) = hit.filter(|_| by_name.is_some()) {
            parameters.extend(measured(hidden, &report.effects[hit]));
        }
    }
    // Beside an effect that goes by another name its companion's parameters mean something else too.
    if parameters.len() < case.scenario.hidden.iter().map(|h| secret::parameters(h).len()).sum::<usize>() {
        parameters.clear();
    }
    let extra: Vec<Target> = left.into_iter().map(|i| named[i]).collect();
    let unnamed = report.verdict == Verdict::UnnamedEffect;
    let nothing = case.kind == Kind::Nothing || case.scenario.hidden.is_empty();
    let fits = match report.verdict {
        Verdict::MissingEffect => !nothing,
        Verdict::UnnamedEffect | Verdict::Unexplained => false,
        // Silence on a poor log that hides nothing is no false alarm.
        Verdict::NoMissingEffect | Verdict::NotIdentifiable | Verdict::UnusableData => nothing,
    };
    let right = fits && extra.is_empty() && found.iter().all(|f| *f);
    let excused = !right && excused(case, &found, &extra);
    let is_silent = report.verdict == Verdict::NoMissingEffect && !nothing;
    let answer = match right {
        true if by_class => Answer::Class,
        true => Answer::Right,
        false if extra.is_empty() && !is_silent && !(nothing && unnamed) => Answer::HonestRest,
        false => Answer::Wrong,
    };
    let ratio = |pick: fn(&Gap) -> Option<f64>| [1.0, 5.0].map(|h| at(report, h).and_then(pick));
    Judgement {
        verdict: verdict(report.verdict).into(),
        named,
        scopes: report.effects.iter().map(scope_text).collect(),
        found,
        extra,
        unnamed,
        right,
        answer,
        excused,
        parameters,
        gap_over_floor: ratio(|g| Some(g.held_out?.position_rms_after / g.noise_floor.position_rms)),
        gap_before: ratio(|g| Some(g.held_out?.position_rms_before / g.noise_floor.position_rms)),
    }
}

/// Seconds by which a beginning or an end may be off.
const OFF: f64 = 3.0;

/// Whether a named effect begins when the hidden one does, and ends then.
fn begins(named: &Named, [from, to]: [f64; 2]) -> bool {
    let near = |found: Option<f64>, truth: f64| match found {
        Some(t) => (t - truth).abs() < OFF,
        None => truth.is_infinite(),
    };
    let one = |begin: Option<f64>, end: Option<f64>| near(begin, from) && near(end, to);
    named.scope.as_ref().is_some_and(|s| match &s.intervals[..] {
        [] => one(s.from, s.until),
        all => all.iter().any(|[begin, end]| one(Some(*begin), Some(*end).filter(|t| t.is_finite()))),
    })
}

/// What an answer is to its reader.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, serde::Serialize)]
pub enum Answer {
    /// All that is hidden is named, and nothing else.
    Right,
    /// A name of the same class stands in the list of what is not told from it.
    Class,
    /// Nothing that is not there is named; something remains or is left open.
    HonestRest,
    /// Something is named, or called a law, that is not there; or nothing is said though something is there. So is no
    /// answer at all.
    #[default]
    Wrong,
}

impl Answer {
    /// All, as columns of a table.
    pub const ALL: [(Answer, &'static str); 4] = [
        (Answer::Right, "right"),
        (Answer::Class, "class"),
        (Answer::HonestRest, "honest rest"),
        (Answer::Wrong, "wrong"),
    ];
}

/// The library's own name of a verdict.
fn verdict(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::UnusableData => "unusable-data",
        Verdict::NotIdentifiable => "not-identifiable",
        Verdict::Unexplained => "unexplained",
        Verdict::UnnamedEffect => "unnamed-effect",
        Verdict::MissingEffect => "missing-effect",
        Verdict::NoMissingEffect => "no-missing-effect",
    }
}

/// The scope and the course of a named effect.
fn scope_text(named: &Named) -> String {
    let scope = named.scope.as_ref().and_then(|s| serde_json::to_string(s).ok());
    let moves = named.parameters.values().any(|p| p.course.is_some());
    scope.unwrap_or_else(|| if moves { "course" } else { "always" }.into())
}

fn target(named: &Named) -> Target {
    let id = effects::all().iter().map(|e| e.id.as_str()).find(|id| *id == named.id).unwrap_or("unknown");
    (id, named.parameters.get("trailer").map(|t| t.value as usize))
}

/// Whether an effect is listed as not told from a named one: proved ones always, others while the list is short.
fn listed(named: &Named, wanted: Target) -> bool {
    let rivals = &named.indistinguishable_from;
    let same = |id: &str| class::of(id) == class::of(wanted.0);
    rivals.iter().any(|r| same(&r.id) && (r.why != "data" || rivals.len() <= FEW))
}

/// Every parameter of a hidden effect with what was found for it, by the class' own parameters.
fn measured(hidden: &crate::simulator::Hidden, named: &Named) -> Vec<Parameter> {
    let id = secret::target(hidden).0;
    let found: Vec<(&'static str, f64, f64)> = named
        .parameters
        .iter()
        .filter(|(name, _)| *name != "trailer")
        .map(|(name, e)| {
            let (name, value, factor) = class::converted(&named.id, name, e.value);
            (name, value, factor * e.std.unwrap_or(f64::NAN))
        })
        .collect();
    let truth = secret::parameters(hidden).into_iter().map(|(name, v)| class::converted(id, name, v));
    let effect = class::of(id);
    truth
        .filter_map(|(name, truth, _)| {
            let (_, value, std) = found.iter().find(|(n, ..)| *n == name)?;
            Some(Parameter { effect, name, truth, value: *value, std: *std })
        })
        .collect()
}

/// Whether every fault is one the data cannot prevent.
fn excused(case: &Case, found: &[bool], extra: &[Target]) -> bool {
    let missed: Vec<usize> = (0..found.len()).filter(|i| !found[*i]).collect();
    let visible = |i: &usize| case.powers[*i].visible >= super::power::VISIBLE;
    let excuses = |e: &Target| missed.iter().any(|i| case.powers[*i].excuses(*e));
    !missed.is_empty() && extra.iter().all(excuses) && (!extra.is_empty() || missed.iter().all(|i| !visible(i)))
}

fn at(report: &Report, horizon: f64) -> Option<&Gap> {
    report.gap.iter().find(|g| (g.horizon_s - horizon).abs() < 0.3 * horizon)
}
