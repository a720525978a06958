//! The size of a formula: operations, nesting and degree.

use super::{Expr, Node, Symbol};

/// Nodes, nesting and degree of a formula, counted without writing it out; every count stops at its largest number.
///
/// Formulas that are put into one another grow as products, so that a short file may hold a formula longer than any
/// memory. Asking first costs only as much as what is written.
///
/// ```
/// use creepage::formula::{Expr, Size};
/// let square = Expr::parse("it*it").unwrap();
/// let mut size = Size::SYMBOL;
/// for _ in 0..100 {
///     size = Size::of(&square, &|_| size);
/// }
/// assert_eq!((size.depth, size.nodes), (101, usize::MAX));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Size {
    /// Numbers, names and operations.
    pub nodes: usize,
    /// Height of the tree.
    pub depth: usize,
    /// Factors in its longest product.
    pub degree: usize,
}

impl Size {
    /// The size of a name.
    pub const SYMBOL: Size = Size { nodes: 1, depth: 1, degree: 1 };

    /// The size of a formula whose names stand for formulas of the given sizes.
    pub fn of(e: &Expr, symbol: &impl Fn(&Symbol) -> Size) -> Self {
        let of = |e: &Expr| Self::of(e, symbol);
        match e.node() {
            Node::Num(_) => Size { degree: 0, ..Self::SYMBOL },
            Node::Sym(s) => symbol(s),
            Node::Neg(x) | Node::Call(_, x) => of(x).above(),
            Node::Pow(x, n) => {
                let x = of(x);
                let degree = x.degree.max(1).saturating_mul(n.unsigned_abs() as usize);
                Size { degree, ..x.above() }
            }
            Node::Add(a, b) | Node::Sub(a, b) => {
                let (a, b) = (of(a), of(b));
                a.beside(b, a.degree.max(b.degree))
            }
            Node::Mul(a, b) | Node::Div(a, b) => {
                let (a, b) = (of(a), of(b));
                a.beside(b, a.degree.saturating_add(b.degree))
            }
        }
    }

    fn above(self) -> Self {
        Size { nodes: self.nodes.saturating_add(1), depth: self.depth.saturating_add(1), ..self }
    }

    fn beside(self, other: Self, degree: usize) -> Self {
        let nodes = self.nodes.saturating_add(other.nodes);
        Size { nodes, depth: self.depth.max(other.depth), degree }.above()
    }
}
