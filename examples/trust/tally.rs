//! Outcomes counted.

use crate::interval::Share;
use crate::simulator::InputLog;
use crate::suite::case::Kind;
use crate::suite::class;
use crate::suite::judgement::Answer;
use crate::suite::make::Target;
use crate::suite::secret;
use crate::workers::Outcome;
use serde::Serialize;
use std::collections::BTreeMap;

/// Shares by the name of a group.
pub type Groups = BTreeMap<String, Share>;

/// Column of the confusion matrix for silence.
pub const SILENCE: &str = "(nothing)";
/// Column of the confusion matrix for an effect without a name.
pub const UNNAMED: &str = "(unnamed)";

/// All counts of a suite.
#[derive(Default, Serialize)]
pub struct Tally {
    /// Something claimed where nothing is hidden.
    pub false_alarms: Share,
    /// The same where the inputs come in steps or with noise.
    pub false_alarms_coarse: Share,
    /// Both by vehicle, drive, noise, gross errors and inputs.
    pub false_alarms_by: Groups,
    /// All names right where the data determine them, singles.
    pub singles: Share,
    /// The same, pairs.
    pub pairs: Share,
    /// The same, one effect that begins or holds for a time, its time right as well.
    pub in_part: Share,
    /// The same by class of effect and by vehicle.
    pub names_by: Groups,
    /// What answers are to their readers where the data determine them: kind → answer → cases.
    pub answers: BTreeMap<String, BTreeMap<Answer, u64>>,
    /// All names right where the data do not determine them.
    pub undetermined: Share,
    /// Of those answers to undetermined data that are not right, the ones the data excuse.
    pub excused: Share,
    /// Hidden class → named class → cases; singles and nothing hidden.
    pub confusion: BTreeMap<String, BTreeMap<String, u64>>,
    /// 95 % intervals that hold the truth, of effects rightly named.
    pub coverage: Share,
    /// The same by class of effect, by vehicle and by noise.
    pub coverage_by: Groups,
    /// Root mean square error in standard deviations, outermost 1 % left out.
    pub rms_z: f64,
    /// Held-out gap over noise floor where all names are right: horizon → (cases, median, 90 %).
    pub gaps: BTreeMap<String, (usize, f64, f64)>,
}

/// The class of an effect in tables.
pub fn class_text((id, _): Target) -> String {
    match class::of(id) {
        "rotation-creep" => "rotation-creep, wheel-radius",
        "traverse-creep" => "traverse-creep, misalignment",
        "unequal-rotation-creep" => "unequal creep, mismatch",
        "steering-offset" => "steering-offset, front creep",
        other => other,
    }
    .into()
}

/// A value at a share of a sorted list; NaN of none.
pub fn quantile(values: &[f64], share: f64) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.get(((sorted.len() as f64 - 1.0) * share).round() as usize).copied().unwrap_or(f64::NAN)
}

fn count(groups: &mut Groups, name: String, counts: bool) {
    groups.entry(name).or_default().count(counts);
}

fn noise_text(position: f64) -> String {
    let band = match position {
        p if p < 1e-3 => "below 1 mm",
        p if p < 1e-2 => "1 to 10 mm",
        _ => "above 10 mm",
    };
    format!("noise {band}")
}

/// The groups a case belongs to, its effects left out.
fn groups(o: &Outcome) -> Vec<String> {
    let s = &o.case.scenario;
    let exact = InputLog::default();
    let inputs = match s.inputs {
        inputs if inputs == exact => "inputs exact",
        inputs if inputs.noise > 0.0 => "inputs with noise",
        _ => "inputs in steps",
    };
    let errors = if s.outliers.share > 0.0 { "with gross errors" } else { "without gross errors" };
    let drive = format!("drive {}", o.case.drive.name());
    vec![o.case.make.name.into(), noise_text(s.noise.position), drive, errors.into(), inputs.into()]
}

impl Tally {
    /// Counts outcomes; those whose time was measured count as well.
    pub fn of(outcomes: &[Outcome]) -> Self {
        let mut tally = Tally::default();
        for outcome in outcomes {
            match outcome.case.scenario.hidden.is_empty() {
                true => tally.nothing_hidden(outcome),
                false => tally.something_hidden(outcome),
            }
            tally.confuse(outcome);
        }
        tally.errors(outcomes);
        tally.ratios(outcomes);
        tally
    }

    fn nothing_hidden(&mut self, o: &Outcome) {
        if o.case.hides_rounding {
            return;
        }
        let alarm = !o.judgement.right;
        match o.case.kind {
            Kind::Coarse => self.false_alarms_coarse.count(alarm),
            _ => self.false_alarms.count(alarm),
        }
        groups(o).into_iter().for_each(|g| count(&mut self.false_alarms_by, g, alarm));
    }

    fn something_hidden(&mut self, o: &Outcome) {
        let right = o.judgement.right;
        if o.case.determined() {
            *self.answers.entry(o.case.kind.name().into()).or_default().entry(o.judgement.answer).or_default() += 1;
        }
        if !o.case.determined() {
            self.undetermined.count(right);
            if !right {
                self.excused.count(o.judgement.excused);
            }
            return;
        }
        match o.case.kind {
            Kind::InPart => self.in_part.count(right),
            _ if o.case.scenario.hidden.len() > 1 => self.pairs.count(right),
            _ => self.singles.count(right),
        }
        let effects = o.case.scenario.hidden.iter().map(|h| class_text(secret::target(h)));
        effects.chain(groups(o)).for_each(|g| count(&mut self.names_by, g, right));
    }

    /// One cell for every effect named; pairs and undetermined cases stay out.
    fn confuse(&mut self, o: &Outcome) {
        if o.case.scenario.hidden.len() > 1 || !o.case.determined() {
            return;
        }
        let hidden = o.case.scenario.hidden.first().map_or(SILENCE.into(), |h| class_text(secret::target(h)));
        let row = self.confusion.entry(hidden).or_default();
        let mut named: Vec<String> = o.judgement.named.iter().map(|t| class_text(*t)).collect();
        named.dedup();
        named.extend(o.judgement.unnamed.then(|| UNNAMED.to_string()));
        if named.is_empty() {
            named.push(SILENCE.into());
        }
        named.into_iter().for_each(|name| *row.entry(name).or_default() += 1);
    }

    fn errors(&mut self, outcomes: &[Outcome]) {
        let mut squares = Vec::new();
        for o in outcomes.iter().filter(|o| o.judgement.right) {
            for p in &o.judgement.parameters {
                self.coverage.count(p.covered());
                let effect = class_text((p.effect, None));
                std::iter::once(effect).chain(groups(o)).for_each(|g| count(&mut self.coverage_by, g, p.covered()));
                squares.push(p.z() * p.z());
            }
        }
        squares.sort_by(f64::total_cmp);
        squares.truncate((0.99 * squares.len() as f64).ceil() as usize);
        self.rms_z = (squares.iter().sum::<f64>() / squares.len() as f64).sqrt();
    }

    fn ratios(&mut self, outcomes: &[Outcome]) {
        for (i, horizon) in ["1 s", "5 s"].into_iter().enumerate() {
            for (what, hides) in [("effects named", true), ("nothing hidden", false)] {
                let right = outcomes.iter().filter(|o| o.judgement.right && o.case.scenario.hidden.is_empty() != hides);
                let ratios: Vec<f64> = right.filter_map(|o| o.judgement.gap_over_floor[i]).collect();
                let row = (ratios.len(), quantile(&ratios, 0.5), quantile(&ratios, 0.9));
                self.gaps.insert(format!("{horizon}, {what}"), row);
            }
        }
    }
}

/// Times of the cases whose time was measured, s: how many, median, 90 %, longest.
pub fn times(outcomes: &[Outcome]) -> (usize, [f64; 3]) {
    let timed = outcomes.iter().filter(|o| o.case.kind == Kind::Timed);
    let seconds: Vec<f64> = timed.map(|o| o.trial.seconds).collect();
    (seconds.len(), [0.5, 0.9, 1.0].map(|share| quantile(&seconds, share)))
}
