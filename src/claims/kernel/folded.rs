//! An identity with its numbers put in: definitions that are numbers, and sines and cosines of zero.

use crate::claims::proved::Identity;
use crate::formula::{Expr, Fun, Node, Symbol};
use std::collections::BTreeMap;

/// The same identity without definitions that are numbers; what these make vanish is left out.
pub(super) fn folded(identity: &Identity) -> Identity {
    let mut numbers: BTreeMap<Symbol, Expr> = BTreeMap::new();
    let mut definitions = vec![];
    for (name, formula) in &identity.definitions {
        let formula = fold(formula, &numbers);
        if formula.as_number().is_some() {
            numbers.insert(name.clone(), formula);
        } else {
            definitions.push((name.clone(), formula));
        }
    }
    // The left side is spoken of by its name.
    let side = |e: &Expr| fold(e, &numbers);
    Identity { definitions, left: side(&identity.left), right: side(&identity.right) }
}

fn fold(e: &Expr, numbers: &BTreeMap<Symbol, Expr>) -> Expr {
    let go = |e: &Expr| fold(e, numbers);
    match e.node() {
        Node::Sym(s) => numbers.get(s).unwrap_or(e).clone(),
        Node::Pow(x, n) => power(&go(x), *n),
        Node::Call(f, x) => call(*f, &go(x)),
        _ => e.with_parts(go),
    }
}

fn power(x: &Expr, n: i32) -> Expr {
    match (x.is_zero(), x.is_one()) {
        (true, _) if n > 0 => Expr::int(0),
        (_, true) => Expr::int(1),
        _ => x.pow(n),
    }
}

fn call(f: Fun, x: &Expr) -> Expr {
    match f {
        Fun::Sin | Fun::Tan | Fun::Atan if x.is_zero() => Expr::int(0),
        Fun::Cos if x.is_zero() => Expr::int(1),
        _ => Expr::call(f, x),
    }
}
