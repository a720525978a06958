//! Gauss–Legendre quadrature on a panel, with the running integral at its nodes (Davis and Rabinowitz, *Methods of Numerical
//! Integration*, 1984, 2.7; the running integral by Legendre's series, Greengard 1991).

/// The rule of N nodes on (0, 1), exact for polynomials up to degree 2N − 1.
#[derive(Debug)]
pub(crate) struct GaussLegendre<const N: usize> {
    /// Where the integrand is asked for.
    pub nodes: [f64; N],
    /// Their weights; the sum is one.
    pub weights: [f64; N],
    /// Row i: weights of ∫ from 0 to node i of the polynomial through the values.
    running: [[f64; N]; N],
    /// The last two coefficients of Legendre's series of the values, and two in its middle.
    late: [[f64; N]; 2],
    middle: [[f64; N]; 2],
}

/// How fast Legendre's series of some values falls.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Decay {
    /// The largest of the values.
    pub size: f64,
    middle: f64,
    late: f64,
}

/// A series whose end is larger than the square of its middle says does not fall like a power.
const GEOMETRIC: f64 = 3.0;
/// Beyond this share of the values a series has not begun to fall: a kink, whose coefficients in the middle are four times the
/// last ones, looks like a power there.
const ENDED: f64 = 1.0 / (32.0 * GEOMETRIC);
/// What is left out of a series that falls slowly, as of a kink, is so many times its last coefficient.
const TAIL: f64 = 8.0;

impl Decay {
    /// What the rule's integral over a panel of length one is off by at most, as far as the series says: of an analytic
    /// integrand it falls like a power, and what is left out at 2N is as small as the square of what is left out at N.
    pub fn error(&self) -> f64 {
        let squared = self.late * self.late / self.size;
        let falls = self.late * self.size <= GEOMETRIC * self.middle * self.middle && self.late < ENDED * self.size;
        if self.late == 0.0 {
            return 0.0;
        }
        if falls { squared } else { TAIL * self.late }
    }

    /// What the running integral is off by at most at the nodes.
    pub fn running_error(&self, nodes: usize) -> f64 {
        self.late / (2.0 * nodes as f64)
    }
}

impl<const N: usize> GaussLegendre<N> {
    /// The nodes are the zeros of P_N, by Newton's method from their asymptotic places.
    pub fn new() -> Self {
        let nodes: [f64; N] = std::array::from_fn(|i| {
            let mut x = -(std::f64::consts::PI * (i as f64 + 0.75) / (N as f64 + 0.5)).cos();
            for _ in 0..20 {
                x -= polynomials(x, N)[N] / slope(x, N);
            }
            x
        });
        let weights = nodes.map(|x| 2.0 / ((1.0 - x * x) * slope(x, N).powi(2)));
        // aₖ = (2k + 1)/2·Σ wⱼ·Pₖ(xⱼ)·fⱼ
        let coefficient = |k: usize| -> [f64; N] {
            std::array::from_fn(|j| (k as f64 + 0.5) * weights[j] * polynomials(nodes[j], N)[k])
        };
        let all: Vec<[f64; N]> = (0..N).map(coefficient).collect();
        let running = |i: usize| {
            let p = polynomials(nodes[i], N);
            // ∫ Pₖ = (Pₖ₊₁ − Pₖ₋₁)/(2k + 1) from −1 on.
            let integral = |k: usize| if k == 0 { nodes[i] + 1.0 } else { (p[k + 1] - p[k - 1]) / (2 * k + 1) as f64 };
            std::array::from_fn(|j| (0..N).map(|k| 0.5 * integral(k) * all[k][j]).sum())
        };
        Self {
            nodes: nodes.map(|x| 0.5 * (x + 1.0)),
            weights: weights.map(|w| 0.5 * w),
            running: std::array::from_fn(running),
            late: [all[N - 2], all[N - 1]],
            middle: [all[N / 2 - 2], all[N / 2 - 1]],
        }
    }

    /// ∫ over the panel, of length one.
    #[inline(always)]
    pub fn integral(&self, values: &[f64; N]) -> f64 {
        dot(&self.weights, values)
    }

    /// ∫ from its beginning to each node.
    #[inline(always)]
    pub fn running(&self, values: &[f64; N]) -> [f64; N] {
        std::array::from_fn(|i| dot(&self.running[i], values))
    }

    /// How Legendre's series of the values falls.
    #[inline(always)]
    pub fn decay(&self, values: &[f64; N]) -> Decay {
        let largest = |some: &[[f64; N]; 2]| dot(&some[0], values).abs().max(dot(&some[1], values).abs());
        let size = values.iter().fold(0.0_f64, |most, v| most.max(v.abs()));
        Decay { size, middle: largest(&self.middle), late: largest(&self.late) }
    }
}

/// Σ aᵢ·bᵢ.
#[inline(always)]
fn dot<const N: usize>(a: &[f64; N], b: &[f64; N]) -> f64 {
    let mut sum = 0.0;
    for i in 0..N {
        sum += a[i] * b[i];
    }
    sum
}

/// P₀ … P_n at a place.
fn polynomials(x: f64, n: usize) -> Vec<f64> {
    let mut p = vec![1.0, x];
    for k in 1..n {
        let k_ = k as f64;
        p.push(((2.0 * k_ + 1.0) * x * p[k] - k_ * p[k - 1]) / (k_ + 1.0));
    }
    p
}

/// P_n′.
fn slope(x: f64, n: usize) -> f64 {
    let p = polynomials(x, n);
    n as f64 * (x * p[n] - p[n - 1]) / (x * x - 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Monomials to degree 2N − 1, and their running integrals to degree N − 1; the next degree is missed.
    #[test]
    fn polynomials_are_integrated() {
        let rule = GaussLegendre::<6>::new();
        let power = |k: i32| rule.nodes.map(|x| x.powi(k));
        for k in 0..12 {
            assert!((rule.integral(&power(k)) - 1.0 / f64::from(k + 1)).abs() < 2e-15, "{k}");
        }
        assert!((rule.integral(&power(12)) - 1.0 / 13.0).abs() > 1e-9);
        for k in 0..6 {
            for (found, x) in rule.running(&power(k)).iter().zip(rule.nodes) {
                assert!((found - x.powi(k + 1) / f64::from(k + 1)).abs() < 2e-15, "{k}");
            }
        }
    }

    /// The error is never more than is said: of functions that bend more and more, of a pole near by, and of a kink.
    #[test]
    fn what_is_off_is_said() {
        let rule = GaussLegendre::<16>::new();
        let mut told = 0;
        for bend in [0.5, 2.0, 6.0, 12.0, 20.0, 30.0, 45.0] {
            let found = rule.nodes.map(|x: f64| (bend * x).cos());
            let (error, said) = ((rule.integral(&found) - bend.sin() / bend).abs(), rule.decay(&found).error());
            assert!(error < said + 1e-15, "{bend}: {error} {said}");
            told += usize::from(said < 1e-10);
        }
        assert!(told >= 3, "{told}");
        for off in [1.0, 0.3, 0.1, 0.01] {
            let found = rule.nodes.map(|x: f64| 1.0 / (x + off));
            let (error, said) = ((rule.integral(&found) - (1.0 / off).ln_1p()).abs(), rule.decay(&found).error());
            assert!(error < said + 1e-15, "{off}: {error} {said}");
        }
        for (kink, length) in [(0.37, 1.0), (0.51, 1e-2), (0.9, 1e-3)] {
            let found = rule.nodes.map(|x: f64| 1.0 + length * (x - kink).abs());
            let exact = 1.0 + length * 0.5 * (kink * kink + (1.0 - kink) * (1.0 - kink));
            let (error, said) = ((rule.integral(&found) - exact).abs(), rule.decay(&found).error());
            assert!(error < said, "{kink}: {error} {said}");
        }
    }
}
