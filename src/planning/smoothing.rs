//! Smoothing of kinks (Chen and Mangasarian 1995; a homotopy in its width): in effects on an input |x| becomes ε·ln(2·cosh(x/ε)),
//! and its slope tanh(x/ε), so that a search by derivatives sees a slope where a dead band, a limit or play has none.

use super::limits::Limit;
use crate::formula::{BigRational, Expr, Fun, Node};
use crate::model::Model;
use std::borrow::Cow;

/// Widths of the smoothing, one after another, as shares of what the kinks are apart; at last the kinks themselves.
const WIDTHS: [f64; 5] = [0.5, 0.15, 0.05, 0.015, 0.0];

/// By how much wider ε is, for a slope between the kinks at the greatest width.
const SLOPE: f64 = 1.2;

/// The widths that a model is planned for with: none but the last, which changes nothing, where it has no kinks; all but the last
/// where a formula jumps, as sign and step do, which no integration follows in bounded work.
pub fn widths(model: &Model) -> &'static [f64] {
    let of_inputs = model.effects.iter().filter(|a| a.effect.on.is_some()).map(|a| &a.effect);
    let all: Vec<&Expr> =
        of_inputs.flat_map(|e| e.changes.values().chain(e.states.values().map(|s| &s.rate))).collect();
    let has = |is: fn(Fun) -> bool| all.iter().any(|formula| formula.calls(is));
    let (smooth, none) = WIDTHS.split_at(WIDTHS.len() - 1);
    match (has(|f| matches!(f, Fun::Sign | Fun::Step)), has(|f| f == Fun::Abs)) {
        (true, _) => smooth,
        (false, true) => &WIDTHS,
        (false, false) => none,
    }
}

/// The model with its kinks smoothed over a share of what they are apart: of the effect's own value in the unit of the input,
/// or of the input's range.
pub fn smoothed<'m>(model: &'m Model, limits: &[Limit], share: f64) -> Cow<'m, Model> {
    if share == 0.0 {
        return Cow::Borrowed(model);
    }
    let mut model = model.clone();
    for applied in &mut model.effects {
        let Some(on) = applied.effect.on.clone() else { continue };
        let of_input = applied.effect.parameters.values().map(|p| p.unit == applied.effect.on_unit);
        let own = of_input.zip(&applied.values).find(|(is, _)| *is).map(|(_, v)| v.abs());
        let range = limits.iter().find(|l| l.role == on).map_or(1.0, Limit::scale);
        let width = SLOPE * share * own.filter(|v| *v > 0.0).unwrap_or(range).min(range);
        let Ok(width) = BigRational::try_from(width) else { continue };
        let width = Expr::number(&width);
        let effect = &mut applied.effect;
        effect.changes.values_mut().for_each(|formula| *formula = smooth(formula, &width));
        effect.states.values_mut().for_each(|state| state.rate = smooth(&state.rate, &width));
    }
    Cow::Owned(model)
}

/// A formula without kinks. Where |x| is in it, it is evaluated in the place of ε·ln(2·cosh(x/ε)), which overflows.
fn smooth(formula: &Expr, width: &Expr) -> Expr {
    let of = |part: &Expr| smooth(part, width);
    let sign = |x: &Expr| Expr::call(Fun::Tanh, &(x / width));
    match formula.node() {
        Node::Call(Fun::Abs, x) => {
            let abs = Expr::call(Fun::Abs, &of(x));
            let beyond = Expr::call(Fun::Exp, &(&(&abs * &Expr::int(-2)) / width));
            &abs + &(width * &Expr::call(Fun::Ln, &(&Expr::int(1) + &beyond)))
        }
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
        assert!(widths(&car).len() > 1 && widths(&Model { effects: vec![], ..car.clone() }).len() == 1);
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
