//! Windows left out in turn: how well a fitted model predicts what it was not fitted to.

use crate::discrepancy::estimation::elimination::eliminate;
use crate::discrepancy::estimation::fit::{FEWEST_RUNS, Fit};
use crate::discrepancy::estimation::noise_model::NoiseModel;
use crate::discrepancy::estimation::problem::Problem;
use crate::discrepancy::estimation::variance_components::noise_determinant;
use crate::discrepancy::shooting::linearised_window::LinearisedWindow;
use crate::discrepancy::shooting::window_integration::linearise;
use crate::error::Result;
use nalgebra::{DMatrix, DVector};

/// Parts that are left out in turn.
const FOLDS: usize = 5;
/// Deviances this close are the same.
const SAME: f64 = 2.0;
/// Runs that are left out in turn; fewer are cut into thirds.
const FEWEST_PARTS: usize = 3;
/// Windows that are left out together, at most: neighbours share a pose.
const BLOCK: usize = 10;

/// What is left out together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Part {
    /// A whole run: what moves from run to run is no finding.
    Run,
    /// A third of every run.
    Third,
    /// Every fifth block of neighbouring windows.
    Blocks,
}

impl Problem {
    /// Whether a model predicts the parts it was not fitted to better than another: all together, and most of those
    /// in which the two differ at all.
    ///
    /// The parts are runs where there are four or more. Of fewer runs most cannot be asked for: there the parts are
    /// blocks of windows, and no run may be predicted worse from the others.
    ///
    /// # Errors
    /// When the model's formulas are malformed.
    pub fn predicts_better(&self, fit: &Fit, than: &Fit) -> Result<bool> {
        let runs = self.records.len();
        let part = if runs >= FEWEST_RUNS { Part::Run } else { Part::Blocks };
        let [new, old] = [self.linear(fit)?, self.linear(than)?];
        // Parameters that are open without a part of the data are no finding.
        let Some(gained) = self.gains([fit, than], [&new, &old], part, Share::predicted) else { return Ok(false) };
        let (better, worse) = counts(&gained, SAME);
        if total(&gained) <= 0.0 || better <= 2 * worse {
            return Ok(false);
        }
        if !(2..FEWEST_RUNS).contains(&runs) {
            return Ok(true);
        }
        // In the same units: a model that knows its noise better would gain by that alone, and be charged for what it
        // leaves unexplained in another run. A parameter that only one run shows cannot be asked of the others.
        let fit = &in_units_of(fit, than);
        let between = self.gains([fit, than], [&new, &old], Part::Run, Share::predicted);
        Ok(between
            .is_none_or(|gained| total(&gained) > 0.0 && counts(&gained, SAME * than.variance_inflation()).1 == 0))
    }

    /// Whether a model predicts the parts it was not fitted to worse than another, where they can be asked: a part may
    /// hold all that an effect with a scope is told by.
    ///
    /// # Errors
    /// When the model's formulas are malformed.
    pub(crate) fn predicts_worse(&self, fit: &Fit, than: &Fit) -> Result<bool> {
        let part = if self.records.len() >= FEWEST_RUNS { Part::Run } else { Part::Blocks };
        let [new, old] = [self.linear(fit)?, self.linear(than)?];
        Ok(self.gains([fit, than], [&new, &old], part, Share::predicted).is_some_and(|g| total(&g) <= 0.0))
    }

    /// By how much each part is predicted better by the others with a model than with another: runs, or thirds of one or
    /// two of them. Asked at the noise of the other, as what it leaves unexplained in another run counts against neither;
    /// `None` where a part leaves a parameter open.
    ///
    /// # Errors
    /// When the model's formulas are malformed.
    pub(crate) fn gains_by_parts(&self, fit: &Fit, than: &Fit) -> Result<Option<Gains>> {
        let part = if self.records.len() >= FEWEST_PARTS { Part::Run } else { Part::Third };
        let [new, old] = [self.linear(fit)?, self.linear(than)?];
        let gained = self.gains([&in_units_of(fit, than), than], [&new, &old], part, Share::predicted);
        Ok(gained.map(|g| Gains {
            total: total(&g),
            parts: counts(&g, SAME * than.variance_inflation()),
            count: g.len(),
        }))
    }

    /// By how much of deviance a model whose values other parts give misses the parts less than another does: runs, or
    /// blocks of windows of a single run.
    ///
    /// # Errors
    /// When the model's formulas are malformed.
    pub fn missed_less(&self, fit: &Fit, than: &Fit) -> Result<f64> {
        let part = if self.records.len() > 1 { Part::Run } else { Part::Blocks };
        let [new, old] = [self.linear(fit)?, self.linear(than)?];
        let gained = self.gains([&in_units_of(fit, than), than], [&new, &old], part, Share::under);
        Ok(gained.map_or(f64::NEG_INFINITY, |g| total(&g)))
    }

    /// By how much each part is predicted better by the first of two fits; `None` where a part leaves one of its
    /// parameters open.
    fn gains(&self, fits: [&Fit; 2], linear: [&Option<Along>; 2], part: Part, judge: Judge) -> Option<Vec<f64>> {
        let of = |k: usize| self.deviances(fits[k], linear[k].as_ref()?, part, judge);
        let new = of(0)?;
        let old = of(1).unwrap_or_else(|| vec![f64::INFINITY; new.len()]);
        Some(old.iter().zip(&new).map(|(old, new)| old - new).collect())
    }

    /// A fit's model along all windows, where it is defined.
    fn linear(&self, fit: &Fit) -> Result<Option<Along>> {
        let equations = fit.model.free_equations()?;
        Ok(linearise(&equations, &fit.p, &self.records, &self.plan, &fit.window_states))
    }

    /// For every part of the data its deviance by what the others say, to first order about the fit, so that no part is
    /// fitted anew; its poses are its own. Smaller is better; differences between models of the same data count. `None`
    /// where a part leaves a parameter open.
    fn deviances(&self, fit: &Fit, linear: &Along, part: Part, judge: Judge) -> Option<Vec<f64>> {
        let own = self.shares(fit, linear, part)?;
        let shares = own.iter().zip(others(&own, fit.p.len()));
        shares.map(|(own, others)| judge(own, &others)).collect()
    }

    /// What each part of the data says of the values: whole runs, or neighbouring windows cut loose from one another.
    fn shares(&self, fit: &Fit, linear: &Along, part: Part) -> Option<Vec<Share>> {
        let of_runs = || self.plan.iter().map(|s| s.record).zip(linear);
        let cut: Vec<(usize, Vec<LinearisedWindow>)> = match part {
            Part::Run => vec![],
            Part::Third => thirds(&of_runs().collect::<Vec<_>>()),
            Part::Blocks => loose(linear).into_iter().enumerate().map(|(i, b)| (i % FOLDS, b)).collect(),
        };
        let folded: Vec<(usize, &Vec<LinearisedWindow>)> = match part {
            Part::Run => of_runs().collect(),
            _ => cut.iter().map(|(fold, windows)| (*fold, windows)).collect(),
        };
        let folds = folded.iter().map(|(fold, _)| fold + 1).max().unwrap_or(0);
        let mut shares = vec![Share::nothing(fit.p.len()); folds];
        for (fold, windows) in folded {
            shares[fold].add(windows, &fit.variances, fit.p.len())?;
        }
        Some(shares)
    }
}

/// Gains of deviance of parts of the data.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Gains {
    /// Of all of them.
    pub total: f64,
    /// How many gain, and how many lose.
    pub parts: (usize, usize),
    /// How many there are.
    pub count: usize,
}

impl Gains {
    /// Whether every part gains.
    pub(crate) fn is_everywhere(&self) -> bool {
        self.parts.0 == self.count
    }

    /// Whether most parts, and all together, gain.
    pub(crate) fn is_gain(&self) -> bool {
        self.total > 0.0 && self.parts.0 > self.parts.1
    }
}

/// Windows, segment by segment.
pub(crate) type Along = Vec<Vec<LinearisedWindow>>;

/// Blocks of neighbouring windows, cut loose from one another.
pub(crate) fn loose(linear: &Along) -> Along {
    let windows: usize = linear.iter().map(Vec::len).sum();
    let size = (windows / (2 * FOLDS)).clamp(1, BLOCK);
    linear.iter().flat_map(|windows| windows.chunks(size).map(cut_loose)).collect()
}

/// Neighbouring windows without the tie of the last to what follows.
fn cut_loose(block: &[LinearisedWindow]) -> Vec<LinearisedWindow> {
    let mut block = block.to_vec();
    if let Some(last) = block.last_mut() {
        last.back = None;
    }
    block
}

/// The windows of runs, segment by segment, cut where a third of a run's windows ends; which third each piece is of.
fn thirds(segments: &[(usize, &Vec<LinearisedWindow>)]) -> Vec<(usize, Vec<LinearisedWindow>)> {
    let mut found = vec![];
    for of_run in segments.chunk_by(|a, b| a.0 == b.0) {
        let all: usize = of_run.iter().map(|(_, windows)| windows.len()).sum();
        let mut before = 0;
        for (_, windows) in of_run {
            let end = |third: usize| (third * all).div_ceil(3).clamp(before, before + windows.len()) - before;
            let pieces = (0..3).map(|third| (third, &windows[end(third)..end(third + 1)]));
            found.extend(pieces.filter(|(_, p)| !p.is_empty()).map(|(third, piece)| (third, cut_loose(piece))));
            before += windows.len();
        }
    }
    found
}

fn total(gains: &[f64]) -> f64 {
    gains.iter().sum()
}

/// How many parts are predicted better and worse, those alike left out.
fn counts(gains: &[f64], alike: f64) -> (usize, usize) {
    let count = |sign: f64| gains.iter().filter(|g| sign * **g > alike).count();
    (count(1.0), count(-1.0))
}

/// A fit with the noise and jumps of another.
fn in_units_of(fit: &Fit, other: &Fit) -> Fit {
    Fit { variances: other.variances.clone(), ..fit.clone() }
}

/// The deviance of a part by the form of all others.
type Judge = fn(&Share, &DMatrix<f64>) -> Option<f64>;

/// What a part of the data says of the values, its poses eliminated: twice the negative log likelihood.
#[derive(Clone)]
struct Share {
    /// The quadratic form in (δp, 1).
    form: DMatrix<f64>,
    /// What does not depend on the values.
    constant: f64,
}

impl Share {
    fn nothing(parameters: usize) -> Self {
        Self { form: DMatrix::zeros(parameters + 1, parameters + 1), constant: 0.0 }
    }

    fn add(&mut self, windows: &Vec<LinearisedWindow>, v: &NoiseModel, parameters: usize) -> Option<()> {
        let windows = std::slice::from_ref(windows);
        let eliminated = eliminate(windows, v, parameters)?;
        self.form += eliminated.form;
        self.constant += eliminated.log_determinant + noise_determinant(windows, v);
        Some(())
    }

    /// Twice the negative log of the density that the others predict the part with, their uncertainty included: what
    /// hardly shows in the others is predicted vaguely, and not wrongly.
    fn predicted(&self, others: &DMatrix<f64>) -> Option<f64> {
        let (alone, together) = (Least::of(others)?, Least::of(&(others + &self.form))?);
        Some(together.value - alone.value + together.log_determinant - alone.log_determinant + self.constant)
    }

    /// The part's deviance at the very values where the form of others is least.
    fn under(&self, others: &DMatrix<f64>) -> Option<f64> {
        let at = Least::of(others)?.at;
        Some(at.dot(&(&self.form * &at)) + self.constant)
    }
}

/// The least value of a quadratic form in (δp, 1).
struct Least {
    /// Where it is.
    at: DVector<f64>,
    value: f64,
    /// Of its second derivatives.
    log_determinant: f64,
}

impl Least {
    /// `None` where the form leaves a value open.
    fn of(form: &DMatrix<f64>) -> Option<Self> {
        let p = form.nrows() - 1;
        let (delta, log_determinant) = match p {
            // An empty matrix has no factors.
            0 => (DVector::zeros(0), 0.0),
            _ => {
                let factors = form.view((0, 0), (p, p)).into_owned().cholesky()?;
                (-factors.solve(&form.view((0, p), (p, 1)).column(0)), factors.ln_determinant())
            }
        };
        let at = delta.push(1.0);
        Some(Self { value: at.dot(&(form * &at)), at, log_determinant })
    }
}

/// For each part the form of all others: sums from both ends, so that the cost is linear in the parts and nothing
/// cancels.
fn others(own: &[Share], parameters: usize) -> Vec<DMatrix<f64>> {
    let nothing = DMatrix::zeros(parameters + 1, parameters + 1);
    let mut after = vec![nothing.clone()];
    for share in own.iter().skip(1).rev() {
        after.push(&after[after.len() - 1] + &share.form);
    }
    let mut before = nothing;
    let both = own.iter().zip(after.into_iter().rev()).map(|(share, after)| {
        let sum = &before + after;
        before += &share.form;
        sum
    });
    both.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// (a − x)² + (b − y)² + c, times a weight.
    fn share(a: f64, b: f64, c: f64, weight: f64) -> Share {
        let form = DMatrix::from_row_slice(3, 3, &[1.0, 0.0, -a, 0.0, 1.0, -b, -a, -b, a * a + b * b + c]) * weight;
        Share { form, constant: 0.5 }
    }

    fn close(a: f64, b: f64) -> bool {
        (a - b).abs() < 1e-12
    }

    #[test]
    fn each_part_is_judged_where_the_others_are_at_their_best() {
        let parts = [share(1.0, 0.0, 0.0, 1.0), share(3.0, 2.0, 0.0, 1.0), share(6.0, -4.0, 7.0, 2.0)];
        let judged: Vec<f64> = parts.iter().zip(others(&parts, 2)).map(|(p, o)| p.under(&o).expect("told")).collect();
        // The others' means, weighted: (5, -2), (13/3, -8/3), (2, 1).
        assert!(close(judged[0], 16.0 + 4.0 + 0.5), "{judged:?}");
        assert!(close(judged[1], (4.0_f64 / 3.0).powi(2) + (14.0_f64 / 3.0).powi(2) + 0.5), "{judged:?}");
        assert!(close(judged[2], 2.0 * (16.0 + 25.0 + 7.0) + 0.5), "{judged:?}");
    }

    /// −2 log of the density of N(mean, variance) at a.
    fn density(a: f64, mean: f64, variance: f64) -> f64 {
        (a - mean).powi(2) / variance + variance.ln()
    }

    /// (a − x)²/s², twice the negative log of the density of a under N(x, s²).
    fn measured(a: f64, variance: f64) -> Share {
        let form = DMatrix::from_row_slice(2, 2, &[1.0, -a, -a, a * a]) / variance;
        Share { form, constant: variance.ln() }
    }

    #[test]
    fn what_the_others_hardly_show_is_predicted_vaguely() {
        let parts = [measured(5.0, 0.01), measured(1.0, 4.0), measured(3.0, 9.0)];
        let judged: Vec<f64> =
            parts.iter().zip(others(&parts, 1)).map(|(p, o)| p.predicted(&o).expect("told")).collect();
        // The others' mean by their weights and its variance, to which the part's own is added.
        let variance = 1.0 / (1.0 / 4.0 + 1.0 / 9.0);
        let mean = variance * (1.0 / 4.0 + 3.0 / 9.0);
        assert!(close(judged[0], density(5.0, mean, variance + 0.01)), "{judged:?}");
        let variance = 1.0 / (100.0 + 1.0 / 9.0);
        let mean = variance * (500.0 + 3.0 / 9.0);
        assert!(close(judged[1], density(1.0, mean, variance + 4.0)), "{judged:?}");
        // At the values alone it is wrong by forty deviations of its own.
        let at = parts[0].under(&others(&parts, 1)[0]).expect("told");
        assert!(at > 1000.0 && judged[0] < 10.0, "{at} {judged:?}");
    }

    /// Thirds of a run go on over its segments, and no window is tied to one of another third.
    #[test]
    fn a_run_is_cut_into_thirds() {
        let window = || LinearisedWindow {
            gram: vec![],
            count: vec![],
            blocks: vec![],
            back: Some(DMatrix::zeros(0, 0)),
            axes: DMatrix::zeros(0, 0),
            duration: 1.0,
            mismatch: vec![],
            initial_state_dof: 0.0,
        };
        let segment = |windows: usize| vec![window(); windows];
        let [first, second, other] = [4, 2, 3].map(segment);
        let cut = thirds(&[(0, &first), (0, &second), (1, &other)]);
        let told = |(third, windows): &(usize, Vec<LinearisedWindow>)| {
            assert!(
                windows.iter().rev().skip(1).all(|w| w.back.is_some()) && windows[windows.len() - 1].back.is_none()
            );
            (*third, windows.len())
        };
        let cut: Vec<(usize, usize)> = cut.iter().map(told).collect();
        assert_eq!(cut, [(0, 2), (1, 2), (2, 2), (0, 1), (1, 1), (2, 1)]);
    }

    /// Most parts and all together.
    #[test]
    fn a_gain_is_one_of_most_parts() {
        let gains = |total: f64, parts| Gains { total, parts, count: 3 }.is_gain();
        assert!(gains(1.0, (2, 1)) && gains(1.0, (3, 0)));
        assert!(!gains(1.0, (1, 1)) && !gains(-1.0, (2, 1)) && !gains(1.0, (0, 0)));
        let everywhere = |parts| Gains { total: 1.0, parts, count: 3 }.is_everywhere();
        assert!(everywhere((3, 0)) && !everywhere((2, 0)) && !everywhere((2, 1)));
    }

    #[test]
    fn parts_alike_count_for_no_model() {
        assert_eq!(counts(&[3.0, -3.0, 1.9, -1.9, 7.0], 2.0), (2, 1));
        assert_eq!(counts(&[], 2.0), (0, 0));
    }

    #[test]
    fn one_part_alone_leaves_the_values_open() {
        let alone = [share(1.0, 2.0, 0.0, 1.0)];
        assert_eq!(others(&alone, 2).iter().filter_map(|o| alone[0].under(o)).count(), 0);
        assert_eq!(others(&alone, 2).iter().filter_map(|o| alone[0].predicted(o)).count(), 0);
        assert!(others(&[], 2).is_empty());
    }

    #[test]
    fn without_values_a_part_is_judged_as_it_is() {
        let part = Share { form: DMatrix::from_element(1, 1, 4.0), constant: -1.0 };
        assert_eq!(part.under(&DMatrix::zeros(1, 1)), Some(3.0));
        assert_eq!(part.predicted(&DMatrix::zeros(1, 1)), Some(3.0));
    }
}
