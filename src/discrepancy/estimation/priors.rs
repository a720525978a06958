//! Normal priors of parameters: each adds its information to the likelihood (maximum a posteriori; Söderström and Stoica,
//! *System Identification*, 1989, chapter B.4).

use super::elimination::ReducedForm;
use crate::formula::Symbol;
use nalgebra::DVector;
use std::collections::BTreeMap;

/// Means and standard deviations of what is known of parameters before any run.
///
/// −2·ln p(θ) = Σ ((θᵢ − μᵢ)/σᵢ)² beside the likelihood; a parameter that is not named has none.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Priors(BTreeMap<Symbol, [f64; 2]>);

impl Priors {
    /// With the prior of one more parameter; a second one of it takes the place of the first.
    pub fn with(mut self, parameter: Symbol, [mean, std]: [f64; 2]) -> Self {
        self.0.insert(parameter, [mean, std]);
        self
    }

    /// Adds them to the quadratic form in (δp, 1) about the values p of free parameters.
    pub fn add_to(&self, e: &mut ReducedForm, free: &[Symbol], p: &DVector<f64>) {
        let last = p.len();
        for (i, [mean, std]) in self.of(free) {
            let (information, off) = (std.powi(-2), p[i] - mean);
            e.form[(i, i)] += information;
            e.form[(i, last)] += information * off;
            e.form[(last, i)] += information * off;
            e.form[(last, last)] += information * off * off;
        }
    }

    /// Σ ((p − μ)/σ)².
    pub fn cost(&self, free: &[Symbol], p: &DVector<f64>) -> f64 {
        self.of(free).map(|(i, [mean, std])| ((p[i] - mean) / std).powi(2)).sum()
    }

    fn of<'a>(&'a self, free: &'a [Symbol]) -> impl Iterator<Item = (usize, [f64; 2])> + 'a {
        free.iter().enumerate().filter_map(|(i, name)| Some((i, *self.0.get(name)?)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One value told by data as 3 ± 0.5 and before as 1 ± 1: (4·3 + 1·1)/5, by hand.
    #[test]
    fn a_prior_weighs_as_its_information() {
        let free = [Symbol::from("a"), Symbol::from("b")];
        let priors = Priors::default().with("a".into(), [9.0, 9.0]).with("a".into(), [1.0, 1.0]);
        let p = DVector::from_vec(vec![3.0, 7.0]);
        let mut e = ReducedForm::nothing(2);
        (e.form[(0, 0)], e.form[(1, 1)]) = (4.0, 1.0);
        priors.add_to(&mut e, &free, &p);
        let (information, gradient) = e.normal();
        let step = information.lu().solve(&-gradient).unwrap();
        assert!((p[0] + step[0] - 13.0 / 5.0).abs() < 1e-15 && step[1] == 0.0);
        assert_eq!((e.cost(), priors.cost(&free, &p)), (4.0, 4.0));
        assert_eq!(e.form, e.form.transpose());
    }
}
