//! Butcher tableaux of explicit Runge–Kutta methods: the classical order 4, and order 8 of Dormand and Prince.

/// An explicit Runge–Kutta method with steps of given length.
///
/// | symbol | meaning |
/// |---|---|
/// | cᵢ | when a stage is evaluated, in steps |
/// | aᵢⱼ | what the rate of stage j adds to the state of stage i, in steps |
/// | bⱼ | what the rate of stage j adds to the result |
pub(crate) struct Tableau {
    /// Order: the error of a run is proportional to this power of the step.
    pub order: i32,
    /// cᵢ
    pub c: &'static [f64],
    /// aᵢⱼ, row by row; the first stage has no row.
    pub a: &'static [&'static [f64]],
    /// bⱼ
    pub b: &'static [f64],
}

/// Dormand and Prince's method of order 8 in 12 stages (E. Hairer, S. P. Nørsett, G. Wanner, *Solving Ordinary
/// Differential Equations I*, II.5, program DOP853; with c₁₂ = 1).
pub(crate) const ORDER_8: Tableau = Tableau { order: 8, c: &C, a: &A, b: &B };

/// The classical method of order 4 in 4 stages.
pub(crate) const ORDER_4: Tableau = Tableau {
    order: 4,
    c: &[0.0, 0.5, 0.5, 1.0],
    a: &[&[0.5], &[0.0, 0.5], &[0.0, 0.0, 1.0]],
    b: &[1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0],
};

/// cᵢ of order 8.
pub(crate) const C: [f64; 12] = [
    0.0,
    0.05260015195876773,
    0.0789002279381516,
    0.1183503419072274,
    0.2816496580927726,
    0.3333333333333333,
    0.25,
    0.3076923076923077,
    0.6512820512820513,
    0.6,
    0.8571428571428571,
    1.0,
];
/// aᵢⱼ of order 8.
pub(crate) const A: [&[f64]; 11] = [
    &[0.05260015195876773],
    &[0.0197250569845379, 0.0591751709536137],
    &[0.02958758547680685, 0.0, 0.08876275643042054],
    &[0.2413651341592667, 0.0, -0.8845494793282861, 0.924834003261792],
    &[0.037037037037037035, 0.0, 0.0, 0.17082860872947386, 0.12546768756682242],
    &[0.037109375, 0.0, 0.0, 0.17025221101954405, 0.06021653898045596, -0.017578125],
    &[
        0.03709200011850479,
        0.0,
        0.0,
        0.17038392571223998,
        0.10726203044637328,
        -0.015319437748624402,
        0.008273789163814023,
    ],
    &[
        0.6241109587160757,
        0.0,
        0.0,
        -3.3608926294469414,
        -0.868219346841726,
        27.59209969944671,
        20.154067550477894,
        -43.48988418106996,
    ],
    &[
        0.47766253643826434,
        0.0,
        0.0,
        -2.4881146199716677,
        -0.590290826836843,
        21.230051448181193,
        15.279233632882423,
        -33.28821096898486,
        -0.020331201708508627,
    ],
    &[
        -0.9371424300859873,
        0.0,
        0.0,
        5.186372428844064,
        1.0914373489967295,
        -8.149787010746927,
        -18.52006565999696,
        22.739487099350505,
        2.4936055526796523,
        -3.0467644718982196,
    ],
    &[
        2.273310147516538,
        0.0,
        0.0,
        -10.53449546673725,
        -2.0008720582248625,
        -17.9589318631188,
        27.94888452941996,
        -2.8589982771350235,
        -8.87285693353063,
        12.360567175794303,
        0.6433927460157636,
    ],
];
/// bⱼ of order 8.
pub(crate) const B: [f64; 12] = [
    0.054293734116568765,
    0.0,
    0.0,
    0.0,
    0.0,
    4.450312892752409,
    1.8915178993145003,
    -5.801203960010585,
    0.3111643669578199,
    -0.1521609496625161,
    0.20136540080403034,
    0.04471061572777259,
];
/// The result of order 8 less one of order 5, as weights of the rates.
pub(crate) const E5: [f64; 12] = [
    0.01312004499419488,
    0.0,
    0.0,
    0.0,
    0.0,
    -1.2251564463762044,
    -0.4957589496572502,
    1.6643771824549864,
    -0.35032884874997366,
    0.3341791187130175,
    0.08192320648511571,
    -0.022355307863886294,
];
/// The weights of rates 1, 9 and 12 in a result of order 3.
pub(crate) const E3: [f64; 3] = [0.2440944881889764, 0.7338466882816118, 0.022058823529411766];

#[cfg(test)]
mod tests {
    use super::*;

    /// Rows sum to c, and the quadrature Σ b·cᵏ⁻¹ = 1/k holds to the order.
    #[test]
    fn conditions_of_order() {
        for t in [ORDER_8, ORDER_4] {
            for (row, c) in t.a.iter().zip(&t.c[1..]) {
                assert!((row.iter().sum::<f64>() - c).abs() < 1e-13, "{c}");
            }
            for k in 1..=t.order {
                let sum: f64 = t.b.iter().zip(t.c).map(|(b, c)| b * c.powi(k - 1)).sum();
                assert!((sum - 1.0 / f64::from(k)).abs() < 1e-13, "order {} at {k}", t.order);
            }
        }
        assert!(E5.iter().sum::<f64>().abs() < 1e-14 && (E3.iter().sum::<f64>() - 1.0).abs() < 1e-15);
    }
}
