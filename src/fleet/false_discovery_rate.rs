//! The false discovery rate (Benjamini and Hochberg, Journal of the Royal Statistical Society B 57, 1995).

/// The q-value of each p-value: the least rate of false discoveries at which it is one.
///
/// qᵢ = min over j with pⱼ ≥ pᵢ of m·pⱼ/rank(j).
pub fn q_values(p: &[f64]) -> Vec<f64> {
    let mut order: Vec<usize> = (0..p.len()).collect();
    order.sort_by(|a, b| p[*a].total_cmp(&p[*b]));
    let mut q = vec![1.0; p.len()];
    let mut least = 1.0_f64;
    for (rank, i) in order.iter().enumerate().rev() {
        least = least.min(p[*i] * p.len() as f64 / (rank + 1) as f64);
        q[*i] = least;
    }
    q
}

#[cfg(test)]
mod tests {
    use super::q_values;

    #[test]
    fn q_values_are_those_of_the_step_up_procedure() {
        let q = q_values(&[0.01, 0.04, 0.03, 0.005]);
        assert_eq!(q.map_round(), [0.02, 0.04, 0.04, 0.02]);
        assert!(q_values(&[]).is_empty());
    }

    trait Rounded {
        fn map_round(&self) -> Vec<f64>;
    }

    impl Rounded for Vec<f64> {
        fn map_round(&self) -> Vec<f64> {
            self.iter().map(|v| (v * 1e9).round() / 1e9).collect()
        }
    }
}
