//! Effects in a sentence.

use crate::effects::Applied;
use crate::model::effect_equation;
use crate::number_format::significant;
use crate::wording::{listed, listed_to};

/// Names in a sentence.
const NAMED: usize = 3;

/// Effects in words, terms by their place.
pub fn named(effects: &[Applied]) -> String {
    let mut names: Vec<String> = Vec::new();
    for effect in effects {
        let name = match effect_equation::is_term(effect) {
            true => format!("a law without name at the {}", effect.effect.place),
            false => effect.label(),
        };
        if !names.contains(&name) {
            names.push(name);
        }
    }
    // The last one takes no more room than its number.
    let most = if names.len() == NAMED + 1 { NAMED + 1 } else { NAMED };
    listed_to(&names, most)
}

/// The parameters of an effect with their values.
pub fn values(effect: &Applied) -> String {
    let each = effect.effect.parameters.keys().zip(&effect.values);
    listed(each.map(|(name, v)| format!("{name} = {}", significant(*v, 3))))
}
