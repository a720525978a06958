//! What values the parameters of free effects may take.

use crate::discrepancy::record::angle::wrapped;
use crate::effects::{Applied, Parameter};
use crate::model::Model;
use crate::model::effect_equation::is_term;
use nalgebra::DVector;

/// A positive value below this share of its plausible size is as good as neutral, and a stiff state to integrate.
const LEAST_SHARE: f64 = 0.04;

/// So near an end of its range a value may be beyond it, in deviations.
const DEVIATIONS: f64 = 2.0;

/// Where a fit stops: a positive value short of zero.
pub fn range_of(p: &Parameter) -> [f64; 2] {
    if p.positive { [p.range[0].max(p.size * LEAST_SHARE), p.range[1]] } else { p.range }
}

/// Whether an effect stands at the edge of its range where it vanishes.
pub fn vanishes(effect: &Applied) -> bool {
    let mut values = effect.effect.parameters.values().zip(&effect.values);
    values.any(|(p, v)| p.positive && is_sunk(*v, range_of(p)))
}

/// Whether a value of an effect stands at an end of its range: the data ask for more than any vehicle has, which says
/// that they tell nothing of it, or that it imitates something else.
pub fn is_at_an_end(effect: &Applied) -> bool {
    effect.effect.parameters.values().zip(&effect.values).any(|(p, v)| is_end_of(p, *v))
}

/// The same of one value.
pub fn is_end_of(p: &Parameter, v: f64) -> bool {
    !p.periodic && p.range.iter().any(|end| (v - end).abs() <= 1e-9 * (p.range[1] - p.range[0]))
}

/// Whether a value lies within so many of its deviations of an end of its range, other than one at which its effect vanishes:
/// the likelihood is not one of an inner point there, and the deviation none of it.
pub fn is_near_an_end(p: &Parameter, v: f64, std: f64) -> bool {
    let ends = if p.positive { &p.range[1..] } else { &p.range[..] };
    !p.periodic && ends.iter().any(|end| (v - end).abs() <= DEVIATIONS * std)
}

/// Whether an effect of the catalogue takes a share of one and more: no coefficient of creep and no scale that is off by
/// all of itself describes a vehicle.
fn is_whole(effect: &Applied) -> bool {
    let mut values = effect.effect.parameters.values().zip(&effect.values);
    effect.effect.origin.is_none() && !is_term(effect) && values.any(|(p, v)| p.unit == "1" && v.abs() >= 1.0)
}

/// Whether an effect may be named at its values at all.
pub fn is_possible(effect: &Applied) -> bool {
    !is_at_an_end(effect) && !is_whole(effect)
}

/// What values the parameters may take.
pub struct Bounds {
    range: Vec<[f64; 2]>,
    positive: Vec<bool>,
    periodic: Vec<bool>,
    /// Lengths of vectors, each with the place of its angle.
    vectors: Vec<[usize; 2]>,
    /// Positive values that begin above the edge at which their effect vanishes.
    may_sink: Vec<bool>,
}

/// Whether a positive value stands at the edge at which its effect vanishes.
fn is_sunk(v: f64, range: [f64; 2]) -> bool {
    v <= range[0] * 1.001
}

impl Bounds {
    /// The bounds of a model's free effects.
    pub fn of(model: &Model) -> Self {
        let all = || model.free_effects().flat_map(|e| e.effect.parameters.values());
        let begin = model.free_values();
        Self {
            may_sink: all().zip(begin).map(|(p, v)| p.positive && !is_sunk(v, range_of(p))).collect(),
            range: all().map(range_of).collect(),
            positive: all().map(|p| p.positive).collect(),
            periodic: all().map(|p| p.periodic).collect(),
            vectors: vectors_of(model),
        }
    }

    /// Whether a value is the length of a vector.
    fn is_length(&self, i: usize) -> bool {
        self.vectors.iter().any(|[length, _]| *length == i)
    }

    /// A step held inside: a positive value is at most divided or multiplied by five, unless it is the length of a vector, which
    /// goes on through zero.
    pub fn step(&self, p: &DVector<f64>, step: &DVector<f64>) -> DVector<f64> {
        DVector::from_fn(p.len(), |i, _| {
            if self.periodic[i] || self.is_length(i) {
                return step[i];
            }
            let target = p[i] + step[i];
            let target = if self.positive[i] { target.clamp(p[i] / 5.0, p[i] * 5.0) } else { target };
            target.clamp(self.range[i][0], self.range[i][1]) - p[i]
        })
    }

    /// Whether a value has sunk to the edge at which its effect vanishes, and a step leads no way back.
    pub fn has_sunk(&self, p: &DVector<f64>, step: &DVector<f64>) -> bool {
        let end = self.within(p, step);
        let is_down = |i: usize| if self.is_length(i) { is_sunk(end[i], self.range[i]) } else { step[i] <= 0.0 };
        (0..p.len()).any(|i| self.may_sink[i] && is_sunk(p[i], self.range[i]) && is_down(i))
    }

    /// The point a step leads to, held inside; a periodic value loses its whole turns, and a vector is moved by the step along and
    /// across itself: (a, α) → |(a + Δa, a·Δα)| and α + arctan(a·Δα/(a + Δa)), which is the same to first order, and all there is
    /// to an effect that is linear in the vector.
    pub fn within(&self, p: &DVector<f64>, step: &DVector<f64>) -> DVector<f64> {
        let target = p + self.step(p, step);
        let mut end = DVector::from_fn(p.len(), |i, _| match self.periodic[i] {
            true => wrapped(target[i]),
            // What is added and taken away again is rounded.
            false => target[i].clamp(self.range[i][0], self.range[i][1]),
        });
        for [length, angle] in &self.vectors {
            let (along, across) = (target[*length], p[*length] * (target[*angle] - p[*angle]));
            end[*length] = along.hypot(across).clamp(self.range[*length][0], self.range[*length][1]);
            end[*angle] = wrapped(p[*angle] + across.atan2(along));
        }
        end
    }
}

/// The places of lengths and angles of vectors among the values of a model's free effects.
fn vectors_of(model: &Model) -> Vec<[usize; 2]> {
    let mut first = 0;
    let mut found = vec![];
    for effect in model.free_effects() {
        found.extend(effect.effect.vector().map(|places| places.map(|i| first + i)));
        first += effect.values.len();
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects;
    use std::f64::consts::PI;

    fn with(id: &str, values: &[f64]) -> Applied {
        Applied::new(effects::named(id).unwrap(), None, values.to_vec())
    }

    /// A positive value whose range begins further up stops there, not below it.
    #[test]
    fn a_fit_stops_inside_of_what_a_file_may_say() {
        let mut effect = effects::named("cornering-creep").unwrap().clone();
        let p = effect.parameters.get_mut("mass_over_bT").unwrap();
        (p.range, p.size) = ([0.2, 5.0], 0.25);
        let applied = |v: f64| Applied::new(&effect, None, vec![v]);
        let model = Model::new("unicycle", &[("wheel_radius", 0.5)]).unwrap().with_effect(applied(0.3).freed());
        let at =
            |p: f64, step: f64| Bounds::of(&model).within(&DVector::from_vec(vec![p]), &DVector::from_vec(vec![step]));
        assert_eq!(at(0.3, -0.2)[0], 0.2);
        assert_eq!(at(0.3, 9.0)[0], 1.5);
        assert_eq!((vanishes(&applied(0.2)), vanishes(&applied(0.21))), (true, false));
    }

    /// The way across ±π is as short as any other.
    #[test]
    fn an_angle_goes_on_where_it_is_wrapped() {
        let mut slope = with("side-slope", &[3.1, 0.05]);
        slope.effect.parameters.get_mut("rate").unwrap().positive = false;
        assert_eq!(slope.effect.parameters.keys().collect::<Vec<_>>(), ["direction", "rate"]);
        let model = Model::new("unicycle", &[("wheel_radius", 0.5)]).unwrap().with_effect(slope.freed());
        let (bounds, p) = (Bounds::of(&model), DVector::from_vec(vec![3.1, 0.05]));
        let step = DVector::from_vec(vec![0.1, 0.01]);
        assert!((bounds.step(&p, &step) - &step).norm() < 1e-15);
        let there = bounds.within(&p, &step);
        assert!((there[0] - (3.2 - 2.0 * PI)).abs() < 1e-12 && (there[1] - 0.06).abs() < 1e-15, "{there}");
    }

    /// A step of a slope is one of its two components: through zero to the other side, and across as far as it turns.
    #[test]
    fn a_slope_is_moved_by_its_components() {
        let slope = with("side-slope", &[0.5, 0.05]);
        let model = Model::new("unicycle", &[("wheel_radius", 0.5)]).unwrap().with_effect(slope.freed());
        let (bounds, p) = (Bounds::of(&model), DVector::from_vec(vec![0.5, 0.05]));
        for [across, along] in [[0.0, -0.13], [0.04, -0.09], [-0.6, 0.02], [1e-5, 1e-5]] {
            let there = bounds.within(&p, &DVector::from_vec(vec![across / 0.05, along]));
            let at = |angle: f64, length: f64| [length * angle.cos(), length * angle.sin()];
            let (e, end) = ([0.5_f64.cos(), 0.5_f64.sin()], at(there[0], there[1]));
            let wanted = [(0.05 + along) * e[0] - across * e[1], (0.05 + along) * e[1] + across * e[0]];
            assert!((end[0] - wanted[0]).abs() < 1e-15 && (end[1] - wanted[1]).abs() < 1e-15, "{end:?} {wanted:?}");
        }
        // Turned back through the edge at which it vanishes it is not lost; sunk to it, it is.
        let edge = DVector::from_vec(vec![0.5, 0.05 * LEAST_SHARE]);
        let sunk = |along: f64| bounds.has_sunk(&edge, &DVector::from_vec(vec![0.0, along]));
        assert!(sunk(-0.001) && !sunk(-0.05));
    }

    /// Sunk and pressed further down it is lost; on its way back, or where it began at the edge, it is not.
    #[test]
    fn a_value_that_sinks_to_where_it_vanishes_is_lost() {
        let bounds = |v: f64| {
            let model = Model::new("unicycle", &[("wheel_radius", 0.5)]).unwrap();
            Bounds::of(&model.with_effect(with("traction-creep", &[v]).freed()))
        };
        let sunk = |begin: f64, p: f64, step: f64| {
            bounds(begin).has_sunk(&DVector::from_vec(vec![p]), &DVector::from_vec(vec![step]))
        };
        let edge = 0.05 * LEAST_SHARE;
        assert!(sunk(0.05, edge, -0.1) && sunk(0.05, edge * 1.0005, 0.0));
        assert!(!sunk(0.05, edge, 0.001) && !sunk(0.05, 2.0 * edge, -0.1) && !sunk(edge, edge, -0.1));
    }

    #[test]
    fn an_end_of_the_range_is_no_value() {
        assert!(is_at_an_end(&with("lever-arm", &[-100.0, 3.0])) && is_at_an_end(&with("lever-arm", &[0.1, 100.0])));
        assert!(!is_at_an_end(&with("lever-arm", &[-99.0, 3.0])));
        // An angle has no end.
        assert!(!is_at_an_end(&with("side-slope", &[PI, 0.05])));
    }
}
