//! How an effect reads as an equation.

use crate::effects::Applied;
use crate::formula::{Expr, Symbol};
use crate::model::{COEFFICIENT, Model, PREFIX, terms};
use crate::number_format::significant;

/// Whether an effect is a term of the library without names.
pub fn is_term(effect: &Applied) -> bool {
    effect.effect.id.starts_with(PREFIX)
}

/// A term with its number in place, such as `v_t = v_n - 0.1294*phi'*abs(phi')`.
pub fn term_equation(term: &Applied, model: &Model) -> String {
    let shown = equation(term, model);
    let Some(k) = term.values.first() else { return shown };
    let number = significant(k.abs(), 5);
    let sign = if *k < 0.0 { "-" } else { "+" };
    let name = term.symbol(COEFFICIENT).to_string();
    let shown = shown.replace(&name, COEFFICIENT);
    match shown.rsplit_once(&format!("+ {COEFFICIENT}")) {
        Some((before, after)) => format!("{before}{sign} {number}{after}"),
        None => shown,
    }
}

/// The definition by which inputs lag.
const DELAY: &str = "delay";

/// What an effect says, as equations: each definition it rewrites, and the rates of its states.
///
/// What is zero in the model is left out, and a term has the yaw rate's name in it where the model writes it out.
pub fn equation(applied: &Applied, model: &Model) -> String {
    let Ok(definitions) = model.definitions() else { return String::new() };
    let names: Vec<_> = definitions.iter().map(|(n, _)| n.clone()).collect();
    let targets = applied.effect.targets(&names, applied.trailer).unwrap_or_default();
    let effect = &applied.effect;
    let own = |s: &Symbol| effect.parameters.contains_key(s.as_str()) || effect.states.contains_key(s.as_str());
    let vanishes = |s: &Symbol| !own(s) && definitions.get(s).is_some_and(Expr::is_zero);
    let mut lines = Vec::new();
    for (name, formula) in targets {
        let formula = terms::shown(effect).unwrap_or(formula);
        let old = definitions.get(&name).cloned();
        let short = old.filter(|f| f.to_string().len() <= 24);
        let shown = formula.substitute(&|s| match (s.as_str(), &short) {
            ("it", Some(f)) => Some(f.clone()),
            ("it", None) => Some(Expr::sym(name.clone())),
            _ => None,
        });
        let shown = shown.substitute(&|s| (*s != name && vanishes(s)).then(|| Expr::int(0)));
        let verb = if short.is_some() { "=" } else { "becomes" };
        lines.push(match name.as_str() {
            n if shown.to_string() == n => constraint_of(n, model),
            n => format!("{n} {verb} {shown}"),
        });
    }
    lines.extend(applied.effect.states.iter().map(|(name, s)| format!("{name}' = {}", s.rate)));
    lines.join("; ")
}

/// The constraint whose creep coefficient a name is; of the time that inputs lag, what it does to them.
fn constraint_of(name: &str, model: &Model) -> String {
    match model.constraints().into_iter().find(|c| c.creep.as_str() == name) {
        Some(constraint) => format!("{} = 0", constraint.row()),
        None if name == DELAY => format!("u(t) becomes u(t - {DELAY})"),
        None => name.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Beside a steered wheel the model writes the yaw rate out, with creep coefficients that are zero.
    #[test]
    fn an_equation_for_people_has_no_zero_in_it_and_names_the_yaw_rate() {
        let car = Model::new("car", &[("wheel_radius", 0.3), ("wheelbase", 2.5)]).unwrap();
        let shown = |id: &str| {
            let term = car.term(id).unwrap().unwrap();
            term_equation(&Applied::new(&term, None, vec![-0.35]), &car)
        };
        assert_eq!(shown("unnamed-rotation-yaw2"), "v_l = v_d - 0.35000*phi'^2");
        assert_eq!(shown("unnamed-yaw-abs-yaw"), "phi' becomes phi' - 0.35000*abs(phi')");
        for effect in crate::effects::all().iter().filter(|e| e.id != "front-traverse-creep") {
            let applied = Applied::new(effect, None, effect.starts().swap_remove(0));
            assert!(!equation(&applied, &car).contains("e_f"), "{}: {}", effect.id, equation(&applied, &car));
        }
    }

    /// A definition that is zero in the model is a coefficient of a constraint, the inputs' delay, or a name of a user's.
    #[test]
    fn what_was_zero_is_told_by_what_it_is() {
        let model = Model::new("unicycle", &[("wheel_radius", 0.5)]).unwrap();
        assert!(constraint_of("e_rc", &model).ends_with(" = 0"), "{}", constraint_of("e_rc", &model));
        assert_eq!(constraint_of(DELAY, &model), "u(t) becomes u(t - delay)");
        assert_eq!(constraint_of("w_x", &model), "w_x");
    }
}
