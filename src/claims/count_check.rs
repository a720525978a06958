//! The check of statements about counted numbers: ranks, growth vectors, integrals.

use super::counted::Counted;
use super::proved::{Proved, record};
use super::{Outcome, Statement};
use crate::formula::{Expr, Node, Symbol};
use std::sync::Arc;

/// Compares numbers with what is said of them; what proves one is recorded.
pub(super) fn compare(statement: &Statement, number: impl Fn(&Symbol) -> Option<(i64, Proved)>) -> Outcome {
    Outcome::all(statement.in_question().iter().map(|equation| {
        let Node::Sym(name) = equation.left.node() else {
            return Outcome::Undefined(format!("{} is not counted", equation.left));
        };
        let Some((found, by)) = number(name) else { return Outcome::Undefined(format!("{name} is not known")) };
        if equation.right.tidy().as_number() != Expr::int(found).as_number() {
            return Outcome::failure(format!("{name} is {found}, the statement says {}", equation.right));
        }
        record(|| by);
        Outcome::PROVED
    }))
}

/// Compares the numbers of one mechanism with what is said of them.
pub(super) fn compare_with(statement: &Statement, counted: Option<Counted>) -> Outcome {
    let Some(counted) = counted.map(Arc::new).filter(|c| c.number("rank").is_some()) else {
        return Outcome::Undefined("the numbers are not proved".into());
    };
    compare(statement, |name| Some((counted.number(name.as_str())?, Proved::Growth(counted.clone()))))
}
