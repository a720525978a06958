//! What a formula divides by, and where its functions have poles.

use crate::formula::{Expr, Fun, Node};

/// Every divisor in a formula, those of a part before its own: tan x has cos x, cot x has sin x.
pub(crate) fn divisors(e: &Expr) -> Vec<Expr> {
    let mut found: Vec<Expr> = e.children().into_iter().flat_map(divisors).collect();
    found.extend(match e.node() {
        Node::Div(_, b) => Some(b.clone()),
        Node::Pow(x, n) if *n < 0 => Some(x.clone()),
        Node::Call(Fun::Cot, x) => Some(Expr::call(Fun::Sin, x)),
        Node::Call(Fun::Tan, x) => Some(Expr::call(Fun::Cos, x)),
        _ => None,
    });
    found
}
