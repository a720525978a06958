//! One run, on which repairs of its data are tried, and what accepts one.

use super::dead_reckoning::DeadReckoning;
use super::repairs::{Change, InputRepair, inputs};
use super::signed_ratios::{Motion, Ratio, SignedRatios, Windows};
use crate::files::{ModelFile, Run};

/// A model that leaves more of the way, or of the turning, unexplained fails; an ordinary effect leaves less.
pub(super) const FAILS: f64 = 0.15;
/// Repaired data leave less than this share unexplained.
pub(super) const REPAIRED: f64 = 0.04;
/// A repair takes away all but this share of what was unexplained.
const LEFT: f64 = 0.25;
/// Ratios after a repair.
pub(super) const RIGHT: [f64; 2] = [0.85, 1.18];
/// Slopes about the means after a repair: an offset makes no ratio.
const RIGHT_ABOUT_MEAN: [f64; 2] = [0.75, 1.33];
/// Motions whose share about their means is less hardly vary.
const VARIES: f64 = 0.03;
/// Ratios within this factor may be an offset's where nothing varies.
const LARGE: f64 = 5.0;

/// Inputs and pose of one run, to try repairs on.
pub(crate) struct Trial<'a> {
    pub file: &'a ModelFile,
    pub run: &'a Run,
    pub reckoning: DeadReckoning<'a>,
    pub windows: Windows,
    pub measured: Vec<Motion>,
}

impl Trial<'_> {
    /// The motions that inputs reckon.
    pub fn reckoned(&self, inputs: &[Vec<f64>]) -> Vec<Motion> {
        let [x, y, heading] = self.reckoning.path(inputs);
        self.windows.motions([&x, &y], self.run.heading.as_ref().map(|_| &heading[..]))
    }

    /// The ratios after some inputs were repaired.
    pub fn with(&self, repairs: &[InputRepair]) -> SignedRatios {
        let inputs = inputs(self.run, self.file.input_timing, repairs);
        self.windows.ratios(&self.reckoned(&inputs), &self.measured)
    }

    /// The reading of one input's column as another.
    pub fn repair(&self, role: &str, source: &str, change: Change) -> InputRepair {
        let named = self.file.columns.inputs.iter().find(|c| c.role == source);
        let column = named.map_or(source, |c| &c.column).to_string();
        InputRepair { role: role.into(), source: source.into(), column, change }
    }
}

/// Whether data are right after a repair, where before they were grossly wrong.
pub(crate) fn accepts(before: &SignedRatios, after: &SignedRatios, is_scale: bool) -> bool {
    let within = |[low, high]: [f64; 2], x: f64| (low..high).contains(&x);
    let is_right = |r: Ratio| {
        let [slope, share] = r.varied;
        r.unexplained < REPAIRED && within(RIGHT, r.slope) && (share < VARIES || within(RIGHT_ABOUT_MEAN, slope))
    };
    // Where the motion hardly varies an offset of the input makes a ratio as well.
    let told = |b: Option<Ratio>, a: Option<Ratio>| match (b, a) {
        (Some(b), Some(a)) if is_scale && b.unexplained > FAILS => {
            a.varied[1] > VARIES || !within([1.0 / LARGE, LARGE], b.size)
        }
        _ => true,
    };
    let has_all = before.way.is_some() == after.way.is_some() && before.turn.is_some() <= after.turn.is_some();
    has_all
        && after.each().count() > 0
        && after.each().all(is_right)
        && told(before.way, after.way)
        && told(before.turn, after.turn)
        && after.unexplained() < LEFT * before.unexplained()
}
