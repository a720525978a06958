//! The symbols of a formula that are angles.

use super::{Expr, Fun, Node, Symbol};
use std::collections::BTreeSet;

impl Expr {
    /// The symbols that stand for angles: the formula takes their sine, cosine, tangent or cotangent, alone or in a sum
    /// with whole factors.
    ///
    /// ```
    /// use creepage::formula::Expr;
    /// let e = Expr::parse("r*cos(phi + 2*delta + atan(e))").unwrap();
    /// let names: Vec<String> = e.angles().iter().map(|s| s.to_string()).collect();
    /// assert_eq!(names, ["delta", "phi"]);
    /// ```
    pub fn angles(&self) -> BTreeSet<Symbol> {
        let mut found = BTreeSet::new();
        collect(self, false, &mut found);
        found
    }
}

fn collect(e: &Expr, in_angle: bool, found: &mut BTreeSet<Symbol>) {
    match e.node() {
        Node::Sym(s) if in_angle => {
            found.insert(s.clone());
        }
        Node::Call(f, x) => collect(x, matches!(f, Fun::Sin | Fun::Cos | Fun::Tan | Fun::Cot), found),
        Node::Neg(_) | Node::Add(..) | Node::Sub(..) => {
            e.children().iter().for_each(|c| collect(c, in_angle, found));
        }
        Node::Mul(a, b) => {
            let times = |n: &Expr| in_angle && n.as_number().is_some();
            collect(a, times(b), found);
            collect(b, times(a), found);
        }
        _ => e.children().iter().for_each(|c| collect(c, false, found)),
    }
}
