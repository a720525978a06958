//! Effects with a state at every contact, as the deflections of tyres are: one entry of the library for vehicles with any
//! number of contacts.

use super::effect::{Effect, State, matches};
use crate::formula::{Expr, Symbol};
use std::borrow::Cow;
use std::collections::BTreeMap;

impl Effect {
    /// An effect with a state at every contact, with those at the contacts of a vehicle whose definitions have these names; any
    /// other effect, and one that finds no contact, as it is.
    ///
    /// ```
    /// use creepage::effects;
    /// let relaxing = effects::named("relaxation").unwrap();
    /// let names = ["built_force_2".into(), "contact_2.speed".into(), "built_force_5".into()];
    /// let states: Vec<String> = relaxing.at_contacts(&names).states.keys().cloned().collect();
    /// assert_eq!(states, ["lagging_2", "lagging_5"]);
    /// // A vehicle without such contacts does not have the effect.
    /// assert!(relaxing.at_contacts(&[]).targets(&[], None).is_none());
    /// ```
    pub fn at_contacts(&self, names: &[Symbol]) -> Cow<'_, Self> {
        if !self.per_contact {
            return Cow::Borrowed(self);
        }
        let changed = |pattern: &str| names.iter().map(Symbol::as_str).filter(|n| matches(pattern, n)).collect();
        let found: Vec<(&Expr, Vec<&str>)> = self.changes.iter().map(|(p, formula)| (formula, changed(p))).collect();
        if found.iter().any(|(_, names)| names.is_empty()) {
            return Cow::Borrowed(self);
        }
        let mut own = Self { changes: BTreeMap::new(), states: BTreeMap::new(), per_contact: false, ..self.clone() };
        for (formula, names) in found {
            for name in names {
                let number = name.rsplit('_').next().unwrap_or(name);
                own.changes.insert(name.to_string(), numbered(formula, number));
                let of_state = |(key, s): (&String, &State)| {
                    (numbered_name(key, number), State { rate: numbered(&s.rate, number), ..s.clone() })
                };
                own.states.extend(self.states.iter().map(of_state));
            }
        }
        Cow::Owned(own)
    }
}

/// A formula of a contact with its number in place of `n`.
fn numbered(formula: &Expr, number: &str) -> Expr {
    formula.substitute(&|s| Some(Expr::sym(Symbol::new(&numbered_name(s.as_str(), number)))))
}

/// The name of a quantity of a contact: `side_force_n` of the second is `side_force_2`, `contact_n.speed` is `contact_2.speed`.
fn numbered_name(name: &str, number: &str) -> String {
    match name.split_once("_n") {
        Some((stem, rest)) if rest.is_empty() || rest.starts_with('.') => format!("{stem}_{number}{rest}"),
        _ => name.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_stand_at_the_end_of_a_stem() {
        let of = |name: &str| numbered_name(name, "3");
        assert_eq!(
            [of("asked_force_n"), of("contact_n.speed"), of("body_normal"), of("it")],
            ["asked_force_3", "contact_3.speed", "body_normal", "it"]
        );
        let rate = Expr::parse("(asked_force_n - lagging_n)*abs(contact_n.speed)/length").unwrap();
        assert_eq!(numbered(&rate, "12").to_string(), "(asked_force_12 - lagging_12)*abs(contact_12.speed)/length");
    }
}
