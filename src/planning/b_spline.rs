//! Clamped uniform B-splines (de Boor, *A Practical Guide to Splines*, 2001, chapters IX–X): inputs as few coefficients, each of
//! which acts near its place, and which bound value and slope.

/// Splines of a degree on equal spans of [0, 1].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BSpline {
    /// The degree: 2 or 3.
    pub degree: usize,
    /// How many polynomial pieces there are.
    pub spans: usize,
}

impl BSpline {
    /// How many coefficients there are.
    pub fn coefficients(self) -> usize {
        self.spans + self.degree
    }

    /// A knot, in spans.
    fn knot(self, i: usize) -> f64 {
        i.saturating_sub(self.degree).min(self.spans) as f64
    }

    /// The mean of the knots that a coefficient acts between, in spans: where the coefficients of a straight line are its values.
    pub fn greville(self, j: usize) -> f64 {
        (1..=self.degree).map(|i| self.knot(j + i)).sum::<f64>() / self.degree as f64
    }

    /// How far apart two neighbouring coefficients are: their difference by this is a coefficient of the slope, by spans.
    pub fn pitch(self, j: usize) -> f64 {
        (self.knot(j + self.degree + 1) - self.knot(j + 1)) / self.degree as f64
    }

    /// The weights of coefficients span, span + 1, … at a place of a span, 0 ≤ s ≤ 1, and their slopes by s; zeros behind them.
    pub fn weights(self, span: usize, s: f64) -> ([f64; 4], [f64; 4]) {
        let x = span as f64 + s;
        let lower = self.of_degree(self.degree - 1, span, x);
        let value = self.of_degree(self.degree, span, x);
        // The slope of a spline has coefficients that are differences by their pitch.
        let mut slope = [0.0; 4];
        for (i, weight) in lower.iter().enumerate().take(self.degree) {
            let by = weight / self.pitch(span + i);
            slope[i] -= by;
            slope[i + 1] += by;
        }
        (value, slope)
    }

    /// The values of the splines of a degree that are not zero on a span, by Cox's and de Boor's recursion.
    fn of_degree(self, degree: usize, span: usize, x: f64) -> [f64; 4] {
        let at = self.degree + span;
        let mut weights = [1.0, 0.0, 0.0, 0.0];
        for d in 1..=degree {
            let mut next = [0.0; 4];
            for (i, w) in weights.iter().enumerate().take(d) {
                let (left, right) = (self.knot(at + 1 + i - d), self.knot(at + 1 + i));
                let share = (x - left) / (right - left);
                next[i] += (1.0 - share) * w;
                next[i + 1] += share * w;
            }
            weights = next;
        }
        weights
    }

    /// The value of a spline at a share of the whole.
    pub fn at(self, coefficients: &[f64], share: f64) -> f64 {
        let x = (share * self.spans as f64).clamp(0.0, self.spans as f64);
        let span = (x as usize).min(self.spans - 1);
        let (weights, _) = self.weights(span, x - span as f64);
        weights.iter().zip(&coefficients[span..]).map(|(w, c)| w * c).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_add_up_to_one_and_slopes_are_those_of_the_values() {
        for degree in [2, 3] {
            let spline = BSpline { degree, spans: 5 };
            let c: Vec<f64> = (0..spline.coefficients()).map(|j| (j as f64 * 1.3).sin()).collect();
            for span in 0..5 {
                for s in [0.0, 0.3, 1.0] {
                    let (value, slope) = spline.weights(span, s);
                    assert!((value.iter().sum::<f64>() - 1.0).abs() < 1e-14);
                    let of = |w: &[f64]| w.iter().zip(&c[span..]).map(|(w, c)| w * c).sum::<f64>();
                    let near = |s: f64| of(&spline.weights(span, s).0);
                    let by_difference = (near(s + 1e-5) - near(s - 1e-5)) / 2e-5;
                    assert!((of(&slope) - by_difference).abs() < 1e-9, "{degree} {span} {s}");
                }
            }
            assert_eq!((spline.at(&c, 0.0), spline.at(&c, 1.0)), (c[0], c[c.len() - 1]));
        }
    }

    #[test]
    fn a_straight_line_has_its_values_as_coefficients() {
        let spline = BSpline { degree: 3, spans: 4 };
        let line: Vec<f64> = (0..spline.coefficients()).map(|j| 2.0 + 0.5 * spline.greville(j)).collect();
        for share in [0.0, 0.1, 0.55, 1.0] {
            assert!((spline.at(&line, share) - 2.0 - 0.5 * 4.0 * share).abs() < 1e-13);
        }
        // Every coefficient of the slope is the slope.
        assert!((0..6).all(|j| ((line[j + 1] - line[j]) / spline.pitch(j) - 0.5).abs() < 1e-13));
    }
}
