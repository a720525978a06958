//! An identity as a theorem: for all real numbers, where no divisor is zero.

use super::folded::folded;
use super::term::{identifier, term};
use crate::claims::identities::Identity;
use crate::formula::{Expr, Fun, Node, Symbol};
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
    let formulas = identity.definitions.iter().map(|(_, formula)| formula);
    let used: BTreeSet<Symbol> = formulas.chain([&identity.left, &identity.right]).flat_map(Expr::symbols).collect();
    let free = used.iter().filter(|s| !defined.contains(s)).map(identifier);
    free.chain(identity.definitions.iter().map(|(name, _)| identifier(name))).collect()
}

/// Everything that is divided by, but for numbers, each once.
fn divisors(identity: &Identity) -> Vec<Expr> {
    let mut found = vec![];
    let formulas = identity.definitions.iter().map(|(_, formula)| formula);
    formulas.chain([&identity.left, &identity.right]).for_each(|e| divided_by(e, &mut found));
    found
}

fn divided_by(e: &Expr, found: &mut Vec<Expr>) {
    e.children().into_iter().for_each(|part| divided_by(part, found));
    let divisor = match e.node() {
        Node::Div(_, b) => b.clone(),
        Node::Pow(x, n) if *n < 0 => x.clone(),
        Node::Call(Fun::Cot, x) => Expr::call(Fun::Sin, x),
        Node::Call(Fun::Tan, x) => Expr::call(Fun::Cos, x),
        _ => return,
    };
    if divisor.as_number().is_none() && !found.contains(&divisor) {
        found.push(divisor);
    }
}
