//! Where a fit of an effect begins: the starting values of its parameters, and which of them lead to different ends.

use super::effect::Effect;

impl Effect {
    /// Whether the first of its starts is where it vanishes, so that a step to first order may be taken from there.
    pub(crate) fn vanishes_first(&self) -> bool {
        self.parameters.values().all(|p| p.start.first() == Some(&0.0))
    }

    /// All combinations of the parameters' starting values.
    pub fn starts(&self) -> Vec<Vec<f64>> {
        self.combined(|_| usize::MAX)
    }

    /// Those of its starts from which a descent may end elsewhere: of a vector any direction will do, for a step turns it as
    /// far as it must.
    pub(crate) fn separate_starts(&self) -> Vec<Vec<f64>> {
        let angle = self.vector().map(|[_, angle]| angle);
        self.combined(|i| if angle == Some(i) { 1 } else { usize::MAX })
    }

    /// The places of the one positive and the one periodic parameter, length and angle of a vector, where there is one of each.
    pub(crate) fn vector(&self) -> Option<[usize; 2]> {
        let the_one = |is: fn(&super::Parameter) -> bool| {
            let mut places = self.parameters.values().enumerate().filter(|(_, p)| is(p)).map(|(i, _)| i);
            places.next().filter(|_| places.next().is_none())
        };
        Some([the_one(|p| p.positive)?, the_one(|p| p.periodic)?])
    }

    /// All combinations of so many starting values of each parameter.
    fn combined(&self, most: impl Fn(usize) -> usize) -> Vec<Vec<f64>> {
        self.parameters.values().enumerate().fold(vec![vec![]], |starts, (i, p)| {
            let some = || p.start.iter().take(most(i));
            let grown = starts.iter().flat_map(|s| some().map(|v| [s.as_slice(), &[*v]].concat()));
            grown.collect()
        })
    }
}

#[cfg(test)]
mod tests {
    use crate::effects::named;

    /// A slope has four directions to be seen in, and one to be fitted from; creep that saturates is fitted from all of its starts.
    #[test]
    fn a_vector_is_fitted_from_one_direction() {
        let slope = named("side-slope").unwrap();
        let names: Vec<&str> = slope.parameters.keys().map(String::as_str).collect();
        assert_eq!(slope.vector().map(|places| places.map(|i| names[i])), Some(["rate", "direction"]));
        assert_eq!((slope.starts().len(), slope.separate_starts()), (4, vec![vec![-2.4, 0.05]]));
        let creep = named("saturating-creep").unwrap();
        assert_eq!((creep.vector(), creep.separate_starts()), (None, creep.starts()));
    }
}
