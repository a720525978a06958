//! Smoothing of kinks (Chen and Mangasarian 1995; a homotopy in its width): in effects on an input |x| becomes √(x² + ε²), so
//! that a search by derivatives sees a slope where a dead band, a limit or play has none.

use super::limits::Limit;
use crate::formula::{BigRational, Expr, Fun, Node};
use crate::model::Model;
use std::borrow::Cow;

/// Widths of the smoothing, one after another, as shares of what the kinks are apart.
const WIDTHS: [f64; 3] = [0.5, 0.15, 0.03];

/// The widths that a model is planned for with; one, which changes nothing, where it has no kinks.
pub fn widths(model: &Model) -> &'static [f64] {
    if has_kinks(model) { &WIDTHS } else { &WIDTHS[..1] }
}

/// Whether a model has kinks in effects on an input.
fn has_kinks(model: &Model) -> bool {
    model.effects.iter().any(|a| a.effect.on.is_some() && formulas(&a.effect).any(has_kink))
}

/// The model with its kinks smoothed over a share of what they are apart: of the effect's own value in the unit of the input,
/// or of the input's range.
pub fn smoothed<'m>(model: &'m Model, limits: &[Limit], share: f64) -> Cow<'m, Model> {
    if !has_kinks(model) {
        return Cow::Borrowed(model);
    }
    let mut model = model.clone();
    for applied in &mut model.effects {
        let Some(on) = applied.effect.on.clone() else { continue };
        let of_input = applied.effect.parameters.values().map(|p| p.unit == applied.effect.on_unit);
        let own = of_input.zip(&applied.values).find(|(is, _)| *is).map(|(_, v)| v.abs());
        let range = limits.iter().find(|l| l.role == on).map_or(1.0, Limit::scale);
        let width = share * own.filter(|v| *v > 0.0).unwrap_or(range).min(range);
        let Ok(width) = BigRational::try_from(width) else { continue };
        let square = Expr::number(&width).pow(2);
        let effect = &mut applied.effect;
        effect.changes.values_mut().for_each(|formula| *formula = smooth(formula, &square));
        effect.states.values_mut().for_each(|state| state.rate = smooth(&state.rate, &square));
    }
    Cow::Owned(model)
}

fn formulas(effect: &crate::effects::Effect) -> impl Iterator<Item = &Expr> {
    effect.changes.values().chain(effect.states.values().map(|s| &s.rate))
}

fn has_kink(formula: &Expr) -> bool {
    let here = matches!(formula.node(), Node::Call(Fun::Abs | Fun::Sign | Fun::Step, _));
    here || formula.children().iter().any(|part| has_kink(part))
}

/// A formula without kinks; `square` is ε².
fn smooth(formula: &Expr, square: &Expr) -> Expr {
    let of = |part: &Expr| smooth(part, square);
    let root = |x: &Expr| Expr::call(Fun::Sqrt, &(&x.pow(2) + square));
    let sign = |x: &Expr| x / &root(x);
    match formula.node() {
        Node::Call(Fun::Abs, x) => root(&of(x)),
        Node::Call(Fun::Sign, x) => sign(&of(x)),
        Node::Call(Fun::Step, x) => &(&Expr::int(1) + &sign(&of(x))) / &Expr::int(2),
        _ => formula.with_parts(of),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::{Applied, named};

    /// Far from its kinks a dead band is what it was; within it, it has a slope.
    #[test]
    fn a_dead_band_has_a_slope_and_is_the_same_far_from_its_edges() {
        let car = Model::new("car", &[("wheel_radius", 0.3), ("wheelbase", 2.0)]).unwrap();
        let band = named("input-dead-band").unwrap().on_input("steering_angle", "rad", 0.6);
        let car = car.with_effect(Applied::new(&band, None, vec![0.1]));
        assert!(has_kinks(&car) && !has_kinks(&Model { effects: vec![], ..car.clone() }));
        let acts = |share: f64, u: f64| {
            let model = smoothed(&car, &Limit::usual(&car), share);
            let (_, formula) = model.effects[0].effect.changes.first_key_value().unwrap();
            formula.eval(&|s| if s.as_str() == "it" { u } else { 0.1 }).unwrap()
        };
        assert!((acts(0.03, 0.5) - 0.4).abs() < 1e-5 && (acts(0.5, 0.5) - 0.4).abs() < 5e-3);
        assert!(acts(0.5, 0.01) > 5e-4 && acts(0.03, 0.01).abs() < 5e-6);
        assert!((acts(0.03, -0.5) + acts(0.03, 0.5)).abs() < 1e-12);
    }
}
