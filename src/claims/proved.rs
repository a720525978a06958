//! What a proof rests on, recorded while its check runs: what another kernel can prove again.

use super::counted::Counted;
use super::{DerivedFormulas, Equation};
use crate::formula::{Expr, Symbol};
use std::cell::RefCell;
use std::sync::Arc;

/// left = right for all values of the free symbols at which both sides are defined, with the definitions that the
/// sides rest on, each after those it uses.
#[derive(Clone, Debug, PartialEq)]
pub struct Identity {
    /// Names that stand for formulas.
    pub definitions: Vec<(Symbol, Expr)>,
    /// The left side.
    pub left: Expr,
    /// The right side.
    pub right: Expr,
}

/// Something that a check found to be true on its way.
#[derive(Clone, Debug)]
pub enum Proved {
    /// An identity of formulas.
    Identity(Identity),
    /// A growth vector with the counts that follow.
    Growth(Arc<Counted>),
    /// Something of which no theorem is written, by why not.
    WithoutTheorem(&'static str),
}

thread_local! {
    static PROVED: RefCell<Option<Vec<Proved>>> = const { RefCell::new(None) };
}

/// What a check gives, and all that it found to be true on the way.
///
/// A check stays on one thread, so that all it proves is heard.
pub(super) fn recorded<R>(check: impl FnOnce() -> R) -> (R, Vec<Proved>) {
    let outer = PROVED.replace(Some(vec![]));
    let result = check();
    (result, PROVED.replace(outer).unwrap_or_default())
}

/// Notes something that was proved, if anyone listens.
pub(crate) fn record(proved: impl FnOnce() -> Proved) {
    PROVED.with_borrow_mut(|all| {
        if let Some(all) = all {
            all.push(proved());
        }
    });
}

/// Notes an identity that was proved, if anyone listens.
pub(crate) fn record_identity(derived: &DerivedFormulas, equation: &Equation) {
    record(|| {
        Proved::Identity(Identity {
            definitions: derived.under([&equation.left, &equation.right]),
            left: equation.left.clone(),
            right: equation.right.clone(),
        })
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::claims::{Statement, prove};

    #[test]
    fn only_what_is_true_and_only_while_someone_listens() {
        let derived = DerivedFormulas::default().with_text("a", "b + 1").with_text("b", "2*x").with_text("c", "x");
        let ask = |right: &str| prove(&derived, &Statement::parse(&[("a", right)]).unwrap().in_brief());
        assert!(ask("2*x + 1").holds());
        let (outcomes, proved) = recorded(|| [ask("1 + 2*x").holds(), ask("x").holds()]);
        assert_eq!(outcomes, [true, false]);
        let Proved::Identity(first) = &proved[0] else { panic!("{:?}", proved[0]) };
        let names: Vec<&str> = first.definitions.iter().map(|(name, _)| name.as_str()).collect();
        assert_eq!((proved.len(), names), (1, vec!["b", "a"]));
    }
}
