//! An identity as a theorem: for all real numbers, where no divisor is zero.

use super::folded::folded;
use super::term::{identifier, term};
use crate::claims::divisors;
use crate::claims::proved::Identity;
use crate::formula::{Expr, Symbol};
use std::collections::BTreeSet;
use std::fmt::Write;

/// The theorem with its proof; nothing where a function has no counterpart.
pub(super) fn theorem(name: &str, identity: &Identity) -> Option<String> {
    let identity = &folded(identity);
    let mut out = format!("Theorem {name} :\n");
    let names = names(identity);
    if !names.is_empty() {
        let _ = writeln!(out, "  forall {} : R,", names.join(" "));
    }
    for (defined, formula) in &identity.definitions {
        let _ = writeln!(out, "  {} = {} ->", identifier(defined), term(formula)?);
    }
    for divisor in divisors(identity) {
        let _ = writeln!(out, "  {} <> 0 ->", term(&divisor)?);
    }
    let _ = writeln!(out, "  {} = {}.", term(&identity.left)?, term(&identity.right)?);
    out.push_str("Proof. creepage. Qed.\n");
    Some(out)
}

/// Every name, free ones first.
fn names(identity: &Identity) -> Vec<String> {
    let defined: BTreeSet<&Symbol> = identity.definitions.iter().map(|(name, _)| name).collect();
    let used: BTreeSet<Symbol> = formulas(identity).flat_map(Expr::symbols).collect();
    let free = used.iter().filter(|s| !defined.contains(s)).map(identifier);
    free.chain(identity.definitions.iter().map(|(name, _)| identifier(name))).collect()
}

/// Everything that is divided by, but for numbers, each once.
fn divisors(identity: &Identity) -> Vec<Expr> {
    let mut found = vec![];
    for divisor in formulas(identity).flat_map(divisors::divisors) {
        if divisor.as_number().is_none() && !found.contains(&divisor) {
            found.push(divisor);
        }
    }
    found
}

/// The definitions and both sides.
fn formulas(identity: &Identity) -> impl Iterator<Item = &Expr> {
    identity.definitions.iter().map(|(_, formula)| formula).chain([&identity.left, &identity.right])
}
