//! Axes: from values with a unit to pixels, with round ticks.

use super::letters::{self, WIDEST};
use super::ticks;
use crate::number_format::{decimals, power_of_ten, significant, ten_to};

/// How values map to lengths.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Scale {
    /// Equal differences, equal lengths.
    Linear,
    /// Equal ratios, equal lengths; only positive values have a place.
    Log,
    /// Linear within ± this value, logarithmic beyond.
    SymLog(f64),
}

/// Room between two labels, in pixels.
const GAP: f64 = 4.0;

/// One axis of a panel.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// How values map to lengths.
    pub scale: Scale,
    /// The values at both ends, in the axis' unit.
    pub range: [f64; 2],
    /// The pixels of both ends.
    pub pixels: [f64; 2],
    name: String,
    unit: String,
}

/// A place on an axis with its label.
#[derive(Clone, Debug, PartialEq)]
pub struct Tick {
    /// Where it is, in pixels.
    pub at: f64,
    /// What is written there.
    pub label: String,
}

impl Axis {
    /// A linear axis over a range in its unit.
    pub fn linear(name: &str, unit: &str, range: [f64; 2]) -> Self {
        Self { scale: Scale::Linear, range, pixels: [0.0, 1.0], name: name.into(), unit: unit.into() }
    }

    /// A logarithmic axis; its range is widened to round values.
    pub fn log(name: &str, unit: &str, range: [f64; 2]) -> Self {
        let round = [range[0] * 0.85, range[1] * 1.18];
        Self { scale: Scale::Log, range: round, ..Self::linear(name, unit, range) }
    }

    /// An axis that is linear within ±`linear` and logarithmic beyond.
    pub fn symlog(name: &str, unit: &str, range: [f64; 2], linear: f64) -> Self {
        Self { scale: Scale::SymLog(linear), ..Self::linear(name, unit, range) }
    }

    /// The axis laid along pixels, from its first value to its last.
    pub fn along(self, pixels: [f64; 2]) -> Self {
        Self { pixels, ..self }
    }

    /// The pixel of a value; NaN where the scale has no place for it.
    pub fn at(&self, value: f64) -> f64 {
        let [from, to] = self.range.map(|v| self.stretch(v));
        let share = (self.stretch(value) - from) / (to - from);
        self.pixels[0] + share * (self.pixels[1] - self.pixels[0])
    }

    fn stretch(&self, value: f64) -> f64 {
        match self.scale {
            Scale::Linear => value,
            Scale::Log if value > 0.0 => value.log10(),
            Scale::Log => f64::NAN,
            Scale::SymLog(l) if value.abs() <= l => value / l,
            Scale::SymLog(l) => value.signum() * (1.0 + (value.abs() / l).log10()),
        }
    }

    /// Values of one unit in pixels, for a linear axis.
    pub fn pixels_per_unit(&self) -> f64 {
        (self.pixels[1] - self.pixels[0]).abs() / (self.range[1] - self.range[0])
    }

    /// Ticks at least `spacing` pixels apart.
    pub fn ticks(&self, spacing: f64) -> Vec<Tick> {
        // Labels of powers of ten are short.
        let spacing = if self.scale == Scale::Log { 0.6 * spacing } else { spacing };
        let count = ((self.pixels[1] - self.pixels[0]).abs() / spacing).floor().max(1.0) as usize;
        let [from, to] = self.range;
        let tick = |value: f64, label: String| Tick { at: self.at(value), label };
        match self.scale {
            Scale::Linear => {
                let (values, step) = ticks::linear(from, to, count);
                values.iter().map(|v| tick(*v, self.linear_label(*v, step))).collect()
            }
            Scale::Log => {
                let told = |count| -> Vec<Tick> {
                    ticks::logarithmic(from, to, count).iter().map(|v| tick(*v, round_label(*v))).collect()
                };
                let all = told(count);
                if self.holds(&all) { all } else { told(count.min(ticks::powers_alone(from, to))) }
            }
            Scale::SymLog(l) => {
                ticks::symmetric(from, to, l, count).iter().map(|v| tick(*v, round_label(*v))).collect()
            }
        }
    }

    /// Whether no two labels of a horizontal axis touch, in the widest usual face; those of a vertical one are low.
    fn holds(&self, ticks: &[Tick]) -> bool {
        let half = |t: &Tick| 0.5 * WIDEST * letters::width(&t.label, letters::SIZE);
        self.pixels[1] < self.pixels[0] || ticks.windows(2).all(|t| t[1].at - t[0].at > half(&t[0]) + half(&t[1]) + GAP)
    }

    fn linear_label(&self, value: f64, step: f64) -> String {
        let scale = ten_to(self.exponent());
        let places = (0..9).find(|p| is_whole(step / scale * ten_to(*p))).unwrap_or(9) as usize;
        decimals((value - self.origin()) / scale, places)
    }

    /// What is taken from every label, so that a far origin or a clock's epoch does not fill the axis with digits.
    fn origin(&self) -> f64 {
        let [from, to] = self.range;
        let step = ticks::nice_step((to - from).abs());
        let far = self.scale == Scale::Linear && from.abs().min(to.abs()) > 1e4 && from.abs() > 100.0 * step;
        if far { (from / step).floor() * step } else { 0.0 }
    }

    /// The power of ten taken out of every label.
    fn exponent(&self) -> i32 {
        let largest = self.range.iter().map(|v| (v - self.origin()).abs()).fold(0.0, f64::max);
        let exponent = crate::number_format::decade(largest);
        if self.scale != Scale::Linear || (-2..5).contains(&exponent) { 0 } else { exponent.div_euclid(3) * 3 }
    }

    /// The name of the axis with its unit, such as "x, m"; empty for an axis without a name.
    pub fn caption(&self) -> String {
        if self.name.is_empty() {
            return String::new();
        }
        let power = if self.exponent() == 0 { String::new() } else { format!("{} ", power_of_ten(self.exponent())) };
        let unit = format!("{power}{}", self.unit);
        let name = match self.origin() {
            0.0 => self.name.clone(),
            origin if origin < 0.0 => format!("{} + {}", self.name, decimals(-origin, 0)),
            origin => format!("{} − {}", self.name, decimals(origin, 0)),
        };
        if unit.is_empty() { name } else { format!("{name}, {}", unit.trim_end()) }
    }
}

fn is_whole(x: f64) -> bool {
    (x - x.round()).abs() < 1e-6 && x.round() != 0.0
}

fn round_label(value: f64) -> String {
    let large = value.abs() >= 1e5 || (value != 0.0 && value.abs() < 1e-3);
    if large {
        let sign = if value < 0.0 { "−" } else { "" };
        let exponent = crate::number_format::decade(value.abs());
        let mantissa = (value.abs() / ten_to(exponent)).round();
        let factor = if mantissa == 1.0 { String::new() } else { format!("{mantissa}·") };
        return format!("{sign}{factor}{}", power_of_ten(exponent));
    }
    significant(value, 1)
}

/// Smallest and largest of the finite values.
pub fn extent(values: impl IntoIterator<Item = f64>) -> Option<[f64; 2]> {
    let finite = values.into_iter().filter(|v| v.is_finite());
    finite.fold(None, |range: Option<[f64; 2]>, v| Some(range.map_or([v, v], |[a, b]| [a.min(v), b.max(v)])))
}

/// A range widened by a share of its length on both sides, and never empty.
pub fn widened([from, to]: [f64; 2], share: f64) -> [f64; 2] {
    let length = to - from;
    let least = 1e-9 * from.abs().max(to.abs());
    let pad = if length > least { share * length } else { (0.1 * from.abs()).max(1e-6) };
    [from - pad, to + pad]
}

/// Two linear axes with the same scale: the shorter range is widened around its middle.
pub fn equal_aspect(x: Axis, y: Axis) -> (Axis, Axis) {
    let scale = x.pixels_per_unit().min(y.pixels_per_unit());
    (fitted(x, scale), fitted(y, scale))
}

fn fitted(axis: Axis, pixels_per_unit: f64) -> Axis {
    let half = (axis.pixels[1] - axis.pixels[0]).abs() / pixels_per_unit / 2.0;
    let middle = 0.5 * (axis.range[0] + axis.range[1]);
    Axis { range: [middle - half, middle + half], ..axis }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(axis: &Axis) -> Vec<String> {
        axis.ticks(60.0).into_iter().map(|t| t.label).collect()
    }

    #[test]
    fn ticks_are_round() {
        let axis = Axis::linear("t", "s", [0.0, 10.0]).along([0.0, 300.0]);
        assert_eq!(labels(&axis), ["0", "2", "4", "6", "8", "10"]);
        let axis = Axis::linear("v", "m/s", [-0.3, 0.3]).along([0.0, 300.0]);
        assert_eq!(labels(&axis), ["−0.2", "0.0", "0.2"]);
        let axis = Axis::log("h", "s", [1.0, 30.0]).along([0.0, 300.0]);
        assert_eq!(labels(&axis), ["1", "2", "5", "10", "20"]);
    }

    #[test]
    fn labels_of_a_logarithmic_axis_do_not_touch() {
        let long = Axis::log("", "", [4e-5, 0.4]).along([50.0, 380.0]);
        assert_eq!(labels(&long), ["10⁻⁴", "0.001", "0.01", "0.1"]);
        let upright = Axis::log("", "", [4e-5, 0.4]).along([600.0, 50.0]);
        assert_eq!(labels(&upright).len(), 12);
        let short = Axis::log("", "", [0.2, 20.0]).along([50.0, 330.0]);
        assert_eq!(labels(&short), ["0.2", "0.5", "1", "2", "5", "10", "20"]);
    }

    #[test]
    fn a_logarithmic_axis_without_an_extent_has_ticks_to_fit() {
        for range in [[1.0, 1.0], [0.9, 1.1], [0.0, 1.0]] {
            assert!(Axis::log("", "", range).along([0.0, 10.0]).ticks(60.0).len() < 2);
        }
    }

    #[test]
    fn one_tick_alone_is_no_scale() {
        let axis = Axis::linear("v", "m/s", [-4.0, 4.0]).along([0.0, 130.0]);
        assert_eq!(labels(&axis), ["−4", "−2", "0", "2", "4"]);
    }

    #[test]
    fn far_origins_and_small_values_leave_the_labels() {
        let axis = Axis::linear("x", "m", [4_500_000.0, 4_500_010.0]).along([0.0, 300.0]);
        assert_eq!((labels(&axis)[0].as_str(), axis.caption().as_str()), ("0", "x − 4500000, m"));
        // An easting west of its meridian.
        let axis = Axis::linear("x", "m", [-20_299.0, -20_201.0]).along([0.0, 300.0]);
        assert_eq!((labels(&axis)[0].as_str(), axis.caption().as_str()), ("20", "x + 20300, m"));
        let axis = Axis::linear("v", "m/s", [0.0, 4e-5]).along([0.0, 300.0]);
        assert_eq!((labels(&axis)[1].as_str(), axis.caption().as_str()), ("10", "v, 10⁻⁶ m/s"));
    }

    #[test]
    fn equal_axes_have_equal_scales() {
        let x = Axis::linear("x", "m", [0.0, 10.0]).along([0.0, 300.0]);
        let y = Axis::linear("y", "m", [0.0, 1.0]).along([200.0, 0.0]);
        let (x, y) = equal_aspect(x, y);
        assert!((x.pixels_per_unit() - y.pixels_per_unit()).abs() < 1e-9);
        assert_eq!(x.range, [0.0, 10.0]);
    }

    #[test]
    fn a_logarithmic_axis_has_no_place_for_zero() {
        assert!(Axis::log("h", "s", [1.0, 10.0]).at(0.0).is_nan());
    }

    /// Short numbers are written out: digits are dropped from labels only where they would fill the axis.
    #[test]
    fn near_origins_stay_in_the_labels() {
        for range in [[20e3, 25e3], [1000.0, 1001.0], [10_000.0, 10_001.0], [20_000.0, 20_200.0], [0.0, 99e3]] {
            assert_eq!(Axis::linear("x", "m", range).caption(), "x, m", "{range:?}");
        }
        assert_eq!(Axis::linear("x", "m", [20_200.0, 20_299.0]).caption(), "x − 20200, m");
        assert_eq!(Axis::linear("x", "m", [0.0, 2e5]).caption(), "x, 10³ m");
        assert_eq!(Axis::linear("x", "", [0.0, 2e5]).caption(), "x, 10³");
        assert_eq!(Axis::linear("", "m", [0.0, 2e5]).caption(), "");
        assert_eq!(Axis::log("x", "m", [2e4, 2.01e4]).caption(), "x, m");
        assert_eq!(Axis::log("x", "m", [1e7, 2e7]).caption(), "x, m");
    }

    #[test]
    fn powers_of_ten_are_written_where_digits_would_be_many() {
        let written = [0.0, 1e5, 2e5, -1e5, 5e4, 1e-3, 1e-4, 5e-4, -2e-4].map(round_label);
        assert_eq!(written, ["0", "10⁵", "2·10⁵", "−10⁵", "50000", "0.001", "10⁻⁴", "5·10⁻⁴", "−2·10⁻⁴"]);
    }

    #[test]
    fn a_range_is_widened_and_never_empty() {
        assert_eq!(widened([0.0, 10.0], 0.1), [-1.0, 11.0]);
        assert_eq!(widened([5.0, 5.0], 0.1), [4.5, 5.5]);
        assert_eq!(widened([0.0, 0.0], 0.1), [-1e-6, 1e-6]);
        assert_eq!(widened([1e3, 1e3 + 1e-7], 0.05), [900.0, (1e3 + 1e-7) + 100.0]);
        assert_eq!(extent([f64::NAN, 3.0, -2.0, f64::INFINITY]), Some([-2.0, 3.0]));
        assert_eq!(extent([f64::NAN]), None);
    }

    #[test]
    fn a_symmetric_axis_is_linear_about_zero_and_logarithmic_beyond() {
        let axis = Axis::symlog("e", "m", [-100.0, 100.0], 1.0).along([0.0, 300.0]);
        let places = [-100.0, -10.0, -1.0, -0.5, 0.0, 0.5, 1.0, 10.0, 100.0].map(|v| axis.at(v));
        assert_eq!(places, [0.0, 50.0, 100.0, 125.0, 150.0, 175.0, 200.0, 250.0, 300.0]);
    }
}
