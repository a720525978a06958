//! How an effect reads as an equation.

use crate::effects::Applied;
use crate::formula::Expr;
use crate::model::{COEFFICIENT, Model, PREFIX};
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
pub fn equation(applied: &Applied, model: &Model) -> String {
    let Ok(definitions) = model.definitions() else { return String::new() };
    let names: Vec<_> = definitions.iter().map(|(n, _)| n.clone()).collect();
    let targets = applied.effect.targets(&names, applied.trailer).unwrap_or_default();
    let mut lines = Vec::new();
    for (name, formula) in targets {
        let old = definitions.get(&name).cloned();
        let short = old.filter(|f| f.to_string().len() <= 24);
        let shown = formula.substitute(&|s| match (s.as_str(), &short) {
            ("it", Some(f)) => Some(f.clone()),
            ("it", None) => Some(Expr::sym(name.clone())),
            _ => None,
        });
        let verb = if short.is_some() { "=" } else { "becomes" };
        lines.push(match name.as_str() {
            n if shown.to_string() == n => constraint_of(n, model),
            n => format!("{n} {verb} {}", shown),
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

    /// A definition that is zero in the model is a coefficient of a constraint, the inputs' delay, or a name of a user's.
    #[test]
    fn what_was_zero_is_told_by_what_it_is() {
        let model = Model::new("unicycle", &[("wheel_radius", 0.5)]).unwrap();
        assert!(constraint_of("e_rc", &model).ends_with(" = 0"), "{}", constraint_of("e_rc", &model));
        assert_eq!(constraint_of(DELAY, &model), "u(t) becomes u(t - delay)");
        assert_eq!(constraint_of("w_x", &model), "w_x");
    }
}
