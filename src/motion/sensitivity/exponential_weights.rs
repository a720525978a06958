//! The weights of exponential time differencing (ETDRK4, Cox and Matthews 2002), with the stages of a collocation.

/// How often the course of N within a step is improved. It comes right for a state that follows inputs in the second sweep,
/// for its slope by its time constant in the third, for what hangs on that in the fourth: with three sweeps, slopes by a time
/// constant of a thousandth of the span were off by a hundredth.
pub(crate) const SWEEPS: usize = 4;

/// A state, or its row of sensitivities, within a step.
pub(crate) struct Row<'a, const L: usize> {
    pub now: &'a [[f64; L]],
    /// The rate at `at`.
    pub rate: &'a [[f64; L]],
    pub at: &'a mut [[f64; L]],
    /// N at the beginning, the middle and the end.
    pub n: [&'a mut [[f64; L]]; 3],
}

/// What a state is made of in the middle and at the end of a step.
///
/// With λ the slope of its rate along the state itself, z(t + h) = e^{λh}·z + ∫ e^{λ(t + h − s)}·N(s) ds, N = z′ − λ·z, where
/// N is taken for a parabola through its values at the beginning, the middle and the end of the step. Where λ = 0 that is
/// Simpson's rule; where λh → −∞ the state follows N/−λ, in the middle of the step as at its end, so that what hangs on it
/// does so, too (the weights of ETDRK4, Cox and Matthews 2002, with the stages of a collocation).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Weights<const L: usize> {
    /// λ.
    own: [f64; L],
    /// The length of the step.
    h: [f64; L],
    half: Node<L>,
    whole: Node<L>,
}

/// Shares of the state and of N at the beginning, the middle and the end of the step.
#[derive(Clone, Copy, Debug)]
struct Node<const L: usize> {
    left: [f64; L],
    n: [[f64; L]; 3],
}

impl<const L: usize> Default for Node<L> {
    fn default() -> Self {
        Self { left: [0.0; L], n: [[0.0; L]; 3] }
    }
}

impl<const L: usize> Node<L> {
    /// A share c of the way through steps h. ∫ e^{λ(ch − s)}·sᵏ/k! ds = (ch)ᵏ⁺¹·φₖ₊₁(λch).
    fn new(c: f64, own: &[f64; L], h: &[f64; L]) -> Self {
        let mut node = Self::default();
        for l in 0..L {
            let (h, x) = (h[l], c * own[l] * h[l]);
            let [value, slope, bend] = phi(x);
            let [value, slope, bend] = [c * value, c * c * slope, 4.0 * c * c * c * bend];
            node.left[l] = x.exp();
            node.n[0][l] = h * (value - 3.0 * slope + bend);
            node.n[1][l] = h * (4.0 * slope - 2.0 * bend);
            node.n[2][l] = h * (bend - slope);
        }
        node
    }
}

impl<const L: usize> Default for Weights<L> {
    fn default() -> Self {
        Self { own: [0.0; L], h: [0.0; L], half: Node::default(), whole: Node::default() }
    }
}

impl<const L: usize> Weights<L> {
    /// For steps h.
    pub fn new(own: &[f64; L], h: &[f64; L]) -> Self {
        Self { own: *own, h: *h, half: Node::new(0.5, own, h), whole: Node::new(1.0, own, h) }
    }

    /// Whether these are the weights of steps h.
    #[inline(always)]
    pub fn are_of(&self, own: &[f64; L], h: &[f64; L]) -> bool {
        self.own == *own && self.h == *h
    }

    /// Takes in the rate that was asked for as the k-th of a step, and says where the next one is to be asked for.
    #[inline(always)]
    pub fn take_in(&self, k: usize, row: Row<L>) {
        let Row { now, rate, at, n: [begin, middle, end] } = row;
        let next = if k.is_multiple_of(2) { &self.half } else { &self.whole };
        let next = if k == 2 * SWEEPS { &self.whole } else { next };
        for j in 0..now.len() {
            for l in 0..L {
                let n = rate[j][l] - self.own[l] * at[j][l];
                if k == 0 {
                    begin[j][l] = n;
                }
                if k == 0 || k % 2 == 1 {
                    middle[j][l] = n;
                }
                if k.is_multiple_of(2) {
                    end[j][l] = n;
                }
                at[j][l] = next.left[l] * now[j][l]
                    + next.n[0][l] * begin[j][l]
                    + next.n[1][l] * middle[j][l]
                    + next.n[2][l] * end[j][l];
            }
        }
    }
}

/// φ₁, φ₂, φ₃: φ₀ = eˣ, φₖ₊₁ = (φₖ − 1/k!)/x; by the series of φ₃ where the differences would lose digits.
fn phi(x: f64) -> [f64; 3] {
    if x.abs() < 1.0 {
        // 1/3! + x/4! + x²/5! + … up to 1/18!.
        let third = (4..=18).rev().fold(1.0, |sum, k| 1.0 + sum * x / f64::from(k)) / 6.0;
        let second = 0.5 + x * third;
        [1.0 + x * second, second, third]
    } else {
        let first = x.exp_m1() / x;
        let second = (first - 1.0) / x;
        [first, second, (second - 0.5) / x]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Against the series in sixty terms, on both sides of where the formulas change.
    #[test]
    fn phi_is_its_series() {
        for x in [-6.0, -1.5, -1.0 - 1e-9, -1.0 + 1e-9, -0.3, -1e-9, 0.0, 1e-9, 0.7, 1.0 - 1e-9, 1.0, 2.5f64] {
            for (k, found) in (1..).zip(phi(x)) {
                // Σ xⁿ/(n + k)!
                let first = 1.0 / (1..=k).map(f64::from).product::<f64>();
                let terms = (1..60).scan(first, |term, n| {
                    *term *= x / f64::from(n + k);
                    Some(*term)
                });
                let wanted = first + terms.sum::<f64>();
                assert!((found - wanted).abs() < 1e-14, "φ_{k}({x}) = {found} {wanted}");
            }
        }
        assert_eq!(phi(-1e300), [1e-300, 1e-300, 0.5e-300]);
    }

    /// z′ = λz + N with a parabola for N: both nodes are exact, from a slow state to one that forgets at once.
    #[test]
    fn a_parabola_is_followed() {
        let (h, n) = (2.0, |t: f64| 3.0 - t + 0.5 * t * t);
        for own in [0.0, -0.01, -0.7, -40.0, -1e6] {
            // z = a + bt + ct² + d·e^{λt}, or its integral.
            let exact = |t: f64, z: f64| {
                if own == 0.0 {
                    return z + 3.0 * t - 0.5 * t * t + t * t * t / 6.0;
                }
                let c = -0.5 / own;
                let b = (2.0 * c + 1.0) / own;
                let a = (b - 3.0) / own;
                a + b * t + c * t * t + (z - a) * (own * t).exp()
            };
            let weights = Weights::new(&[own], &[h]);
            for (t, node) in [(1.0, weights.half), (2.0, weights.whole)] {
                let parts = node.n.iter().zip([n(0.0), n(1.0), n(2.0)]).map(|(w, n)| w[0] * n);
                let (found, wanted) = (node.left[0] * 5.0 + parts.sum::<f64>(), exact(t, 5.0));
                assert!((found - wanted).abs() < 1e-9 * wanted.abs(), "λ = {own}, t = {t}: {found} {wanted}");
            }
        }
    }
}
