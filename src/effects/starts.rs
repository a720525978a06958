//! Where a fit of an effect begins: the starting values of its parameters, and which of them lead to different ends.

use super::effect::{Effect, Parameter};

impl Effect {
    /// Whether the first of its starts is where it vanishes, so that a step to first order may be taken from there.
    pub(crate) fn vanishes_first(&self) -> bool {
        self.parameters.values().all(|p| p.start.first() == Some(&0.0))
    }

    /// All combinations of the parameters' starting values.
    pub fn starts(&self) -> Vec<Vec<f64>> {
        self.parameters.values().fold(vec![vec![]], |starts, p| {
            let grown = starts.iter().flat_map(|s| p.start.iter().map(|v| [s.as_slice(), &[*v]].concat()));
            grown.collect()
        })
    }

    /// Those of its starts from which a descent may end elsewhere: of a vector any direction will do, for a step turns it as
    /// far as it must.
    pub(crate) fn separate_starts(&self) -> Vec<Vec<f64>> {
        let mut starts = self.starts();
        if let Some([_, angle]) = self.vector() {
            let first = starts[0][angle];
            starts.retain(|s| s[angle] == first);
        }
        starts
    }

    /// The places of the one positive and the one periodic parameter, length and angle of a vector that the effect is linear in,
    /// where it has one of each. What they are of a user's own effect nobody has said.
    pub(crate) fn vector(&self) -> Option<[usize; 2]> {
        if self.origin.is_some() {
            return None;
        }
        let the_one = |is: fn(&Parameter) -> bool| {
            let mut places = self.parameters.values().enumerate().filter(|(_, p)| is(p)).map(|(i, _)| i);
            places.next().filter(|_| places.next().is_none())
        };
        Some([the_one(|p| p.positive)?, the_one(|p| p.periodic)?])
    }
}

#[cfg(test)]
mod tests {
    use crate::effects::{all, named};
    use crate::formula::Expr;
    use crate::mechanism::{Definitions, Sample};
    use crate::provenance::Origin;
    use std::f64::consts::FRAC_PI_2;

    /// f(a, α) = a·cos α·f(1, 0) + a·sin α·f(1, π/2) for what every effect with a vector adds to a definition.
    #[test]
    fn effects_are_linear_in_their_vectors() {
        let samples: Vec<Sample> = (0..9).filter_map(|k| Sample::of(&Definitions::default(), k)).collect();
        let mut with_vector = 0;
        for effect in all() {
            let Some(places) = effect.vector() else { continue };
            with_vector += 1;
            let names: Vec<&str> = effect.parameters.keys().map(String::as_str).collect();
            let [length, angle] = places.map(|i| names[i]);
            for change in effect.changes.values() {
                let added = change - &Expr::sym("it");
                let at = |a: f64, alpha: f64| {
                    let number = |x: f64| Expr::parse(&format!("{x:?}")).unwrap();
                    added.substitute(&|s| match s.as_str() {
                        name if name == length => Some(number(a)),
                        name if name == angle => Some(number(alpha)),
                        _ => None,
                    })
                };
                for sample in &samples {
                    let value = |a: f64, alpha: f64| sample.value(&at(a, alpha)).unwrap();
                    let parts = 2.0 * 0.7_f64.cos() * value(1.0, 0.0) + 2.0 * 0.7_f64.sin() * value(1.0, FRAC_PI_2);
                    assert!((value(2.0, 0.7) - parts).abs() < 1e-9 * (1.0 + parts.abs()), "{}", effect.id);
                }
            }
        }
        assert!(with_vector > 2, "side slope, grade, a slope of forces");
    }

    /// A slope has four directions to be seen in, and one to be fitted from; creep that saturates is fitted from all of its starts.
    #[test]
    fn a_vector_is_fitted_from_one_direction() {
        let slope = named("side-slope").unwrap();
        let names: Vec<&str> = slope.parameters.keys().map(String::as_str).collect();
        assert_eq!(slope.vector().map(|places| places.map(|i| names[i])), Some(["rate", "direction"]));
        assert_eq!((slope.starts().len(), slope.separate_starts()), (4, vec![vec![-2.4, 0.05]]));
        let creep = named("saturating-creep").unwrap();
        assert_eq!((creep.vector(), creep.separate_starts()), (None, creep.starts()));
        let origin = Origin { path: "own.toml".into(), sha256: String::new(), text: String::new() };
        let own = crate::effects::Effect { origin: Some(origin.into()), ..slope.clone() };
        assert_eq!((own.vector(), own.separate_starts()), (None, own.starts()));
    }
}
