//! The information that records hold about effects, poses and jumps eliminated.

use crate::discrepancy::estimation::elimination::{InformationFilter, ReducedForm};
use crate::discrepancy::estimation::noise_model::NoiseModel;
use crate::discrepancy::record::run_record::Record;
use crate::discrepancy::shooting::window_integration::each_window;
use crate::discrepancy::shooting::windows::{Segment, WindowStates};
use crate::effects::Applied;
use crate::error::Result;
use crate::model::Model;
use nalgebra::DMatrix;
use rayon::prelude::*;

/// Records cut into windows, with the poses a model passes through.
pub(crate) struct Driven {
    pub records: Vec<Record>,
    pub plan: Vec<Segment>,
    pub starts: WindowStates,
}

/// The information about some effects together.
#[derive(Clone, Debug)]
pub(crate) struct Information {
    matrix: DMatrix<f64>,
    /// The columns of each effect, in the order they were asked for.
    columns: Vec<Vec<usize>>,
}

impl Driven {
    /// The information about effects together, for each set of variances; `None` where the motion is undefined.
    pub fn information(
        &self,
        model: &Model,
        effects: &[Applied],
        variances: &[NoiseModel],
    ) -> Result<Option<Vec<Information>>> {
        let joint = effects.iter().fold(model.fixed(), |m, e| m.with_effect(e.clone().freed()));
        let free = joint.free_parameters();
        let equations = joint.equations(&free)?;
        let p = joint.free_values();
        // Windows are eliminated as they come: those of a large library could not be kept.
        let along = |(segment, starts): (&Segment, &Vec<Vec<f64>>)| {
            let mut chains: Vec<InformationFilter> =
                variances.iter().map(|v| InformationFilter::new(v, p.len(), false)).collect();
            let record = &self.records[segment.record];
            each_window(&equations, &p, record, segment, starts, |w| chains.iter_mut().try_for_each(|c| c.push(&w)))?;
            Some(chains)
        };
        let chains: Option<Vec<Vec<InformationFilter>>> = self.plan.par_iter().zip(&self.starts).map(along).collect();
        let Some(chains) = chains else { return Ok(None) };
        let mut totals = vec![ReducedForm::nothing(p.len()); variances.len()];
        for chain in chains {
            for (total, chain) in totals.iter_mut().zip(chain) {
                if total.add(chain).is_none() {
                    return Ok(None);
                }
            }
        }
        let position = |e: &Applied| -> Vec<usize> {
            e.parameters().iter().filter_map(|s| free.iter().position(|f| f == s)).collect()
        };
        let columns: Vec<Vec<usize>> = effects.iter().map(position).collect();
        let one = |e: &ReducedForm| {
            let matrix = e.normal().0;
            let good = matrix.iter().all(|x| x.is_finite());
            good.then(|| Information { matrix, columns: columns.clone() })
        };
        Ok(totals.iter().map(one).collect())
    }
}

impl Information {
    /// All of it divided: values that are alike count once.
    pub fn over(mut self, variance_inflation: f64) -> Information {
        self.matrix /= variance_inflation;
        self
    }

    /// The part that two effects share; of one with itself, its own.
    pub fn block(&self, a: usize, b: usize) -> DMatrix<f64> {
        let (rows, columns) = (&self.columns[a], &self.columns[b]);
        DMatrix::from_fn(rows.len(), columns.len(), |i, j| self.matrix[(rows[i], columns[j])])
    }

    /// Standard deviations of an effect's values by themselves; none in a direction that is as good as open.
    pub fn deviations(&self, a: usize) -> Vec<Option<f64>> {
        let block = self.block(a, a);
        let eigen = block.clone().symmetric_eigen();
        let largest = eigen.eigenvalues.iter().copied().fold(0.0, f64::max);
        let variance = |i: usize| -> Option<f64> {
            let mut sum = 0.0;
            for (k, value) in eigen.eigenvalues.iter().enumerate() {
                let share = eigen.eigenvectors[(i, k)].powi(2);
                if *value <= 1e-12 * largest {
                    // An open direction leaves open whatever takes part in it.
                    if share > 1e-9 {
                        return None;
                    }
                    continue;
                }
                sum += share / value;
            }
            Some(sum.sqrt()).filter(|s| s.is_finite() && *s > 0.0)
        };
        (0..block.nrows()).map(variance).collect()
    }

    /// sᵀI s of one effect.
    pub fn misfit(&self, a: usize, s: &[f64]) -> f64 {
        quadratic(&self.block(a, a), s)
    }

    /// The misfit that remains of effect b of size s where effect a is fitted.
    pub fn misfit_beside(&self, b: usize, s: &[f64], a: usize) -> f64 {
        let (own, mixed) = (self.block(a, a), self.block(a, b));
        let mut regular = own.clone();
        (0..own.nrows()).for_each(|i| {
            regular[(i, i)] = if own[(i, i)] > 0.0 { own[(i, i)] * (1.0 + 1e-9) } else { 1.0 };
        });
        let Some(own) = regular.cholesky() else { return 0.0 };
        let explained = mixed.tr_mul(&own.solve(&mixed));
        quadratic(&(self.block(b, b) - explained), s).max(0.0)
    }
}

fn quadratic(matrix: &DMatrix<f64>, s: &[f64]) -> f64 {
    let s = nalgebra::DVector::from_column_slice(s);
    s.dot(&(matrix * &s))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two effects of one and two parameters with a known matrix.
    fn information() -> Information {
        let matrix = DMatrix::from_row_slice(3, 3, &[4.0, 2.0, 0.0, 2.0, 4.0, 0.0, 0.0, 0.0, 0.0]);
        Information { matrix, columns: vec![vec![0], vec![1, 2]] }
    }

    #[test]
    fn what_nothing_measures_has_no_deviation() {
        let i = information();
        assert_eq!(i.deviations(0), [Some(0.5)]);
        assert_eq!(i.deviations(1), [Some(0.5), None]);
        assert_eq!(i.over(4.0).deviations(0), [Some(1.0)]);
    }

    #[test]
    fn what_one_effect_explains_of_another_is_not_misfit() {
        let i = information();
        assert_eq!(i.misfit(0, &[0.5]), 1.0);
        // 4 − 2·2/4 = 3.
        assert!((i.misfit_beside(0, &[1.0], 1) - 3.0).abs() < 1e-6);
        assert!((i.misfit_beside(1, &[1.0, 7.0], 0) - 3.0).abs() < 1e-6);
    }
}
