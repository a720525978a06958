//! Expressions as a hash-consed graph, in which equal sub-expressions stand once.

use super::{BigRational, Expr, Fun, Node, Symbol};
use num_traits::{Signed, Zero};
use std::collections::HashMap;

/// A node of a [`Graph`].
pub type NodeId = usize;

/// An operation on earlier nodes of a graph.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Op {
    /// An exact number.
    Num(BigRational),
    /// A symbol.
    Sym(Symbol),
    /// −x
    Neg(NodeId),
    /// x + y
    Add(NodeId, NodeId),
    /// x − y
    Sub(NodeId, NodeId),
    /// x·y
    Mul(NodeId, NodeId),
    /// x/y
    Div(NodeId, NodeId),
    /// xⁿ
    Pow(NodeId, i32),
    /// f(x)
    Call(Fun, NodeId),
}

/// A hash-consed store of operations: adding an operation twice gives the same node.
///
/// Names may be *defined*: a later use of the name is the node of its definition, so that a system of
/// definitions (a chain of trailers, say) stays as small as it is written.
///
/// ```
/// use creepage::formula::{Expr, Graph};
/// let mut g = Graph::default();
/// let v = g.insert(&Expr::parse("r*theta'").unwrap());
/// g.define("v", v);
/// g.insert(&Expr::parse("v*cos(phi)").unwrap());
/// g.insert(&Expr::parse("v*sin(phi)").unwrap());
/// assert_eq!(g.len(), 8); // r, theta', r*theta', phi, cos, product, sin, product
/// ```
#[derive(Clone, Default)]
pub struct Graph {
    ops: Vec<Op>,
    total: Vec<bool>,
    index: HashMap<Op, NodeId>,
    defined: HashMap<Symbol, NodeId>,
}

impl Graph {
    /// The operation of a node.
    pub fn op(&self, id: NodeId) -> &Op {
        &self.ops[id]
    }

    /// How many nodes there are.
    pub fn len(&self) -> usize {
        self.ops.len()
    }

    /// Whether there is no node yet.
    pub fn is_empty(&self) -> bool {
        self.ops.is_empty()
    }

    /// Makes every later use of a name stand for a node.
    pub fn define(&mut self, name: impl Into<Symbol>, id: NodeId) {
        self.defined.insert(name.into(), id);
    }

    /// The node of a definition.
    pub fn definition(&self, name: &Symbol) -> Option<NodeId> {
        self.defined.get(name).copied()
    }

    /// Adds an expression and gives its node.
    pub fn insert(&mut self, e: &Expr) -> NodeId {
        match e.node() {
            Node::Num(v) => self.number(v.clone()),
            Node::Sym(s) => match self.defined.get(s) {
                Some(id) => *id,
                None => self.symbol(s.clone()),
            },
            Node::Neg(x) => {
                let x = self.insert(x);
                self.neg(x)
            }
            Node::Add(a, b) => self.binary(a, b, Self::add),
            Node::Sub(a, b) => self.binary(a, b, Self::sub),
            Node::Mul(a, b) => self.binary(a, b, Self::mul),
            Node::Div(a, b) => self.binary(a, b, Self::div),
            Node::Pow(x, n) => {
                let x = self.insert(x);
                self.pow(x, *n)
            }
            Node::Call(f, x) => {
                let x = self.insert(x);
                self.call(*f, x)
            }
        }
    }

    fn binary(&mut self, a: &Expr, b: &Expr, op: fn(&mut Self, NodeId, NodeId) -> NodeId) -> NodeId {
        let (a, b) = (self.insert(a), self.insert(b));
        op(self, a, b)
    }

    /// A bare symbol, whether or not the name is defined.
    pub fn symbol(&mut self, s: Symbol) -> NodeId {
        self.push(Op::Sym(s))
    }

    /// An exact number.
    pub fn number(&mut self, v: BigRational) -> NodeId {
        self.push(Op::Num(v))
    }

    pub(super) fn int(&mut self, n: i64) -> NodeId {
        self.number(BigRational::from(n))
    }

    fn push(&mut self, op: Op) -> NodeId {
        if let Some(id) = self.index.get(&op) {
            return *id;
        }
        let total = match &op {
            Op::Num(_) | Op::Sym(_) => true,
            Op::Neg(x) => self.total[*x],
            Op::Add(a, b) | Op::Sub(a, b) | Op::Mul(a, b) => self.total[*a] && self.total[*b],
            Op::Div(a, b) => self.total[*a] && self.value(*b).is_some_and(|v| !v.is_zero()),
            Op::Pow(x, n) => *n >= 0 && self.total[*x],
            Op::Call(f, x) => f.is_total() && self.total[*x],
        };
        let id = self.ops.len();
        self.ops.push(op.clone());
        self.total.push(total);
        self.index.insert(op, id);
        id
    }

    /// The exact value of a constant node.
    pub(super) fn value(&self, id: NodeId) -> Option<&BigRational> {
        match &self.ops[id] {
            Op::Num(v) => Some(v),
            _ => None,
        }
    }

    pub(crate) fn is_zero(&self, id: NodeId) -> bool {
        self.value(id).is_some_and(Zero::is_zero)
    }

    /// −x
    pub fn neg(&mut self, x: NodeId) -> NodeId {
        match &self.ops[x] {
            Op::Num(v) => {
                let v = -v;
                self.number(v)
            }
            Op::Neg(inner) => *inner,
            _ => self.push(Op::Neg(x)),
        }
    }

    /// x + y
    pub fn add(&mut self, a: NodeId, b: NodeId) -> NodeId {
        match (self.value(a), self.value(b)) {
            (Some(x), Some(y)) => {
                let v = x + y;
                self.number(v)
            }
            (Some(x), _) if x.is_zero() => b,
            (_, Some(y)) if y.is_zero() => a,
            _ => match self.ops[b] {
                Op::Neg(y) => self.push(Op::Sub(a, y)),
                // A sum has one form whatever the order it was written in.
                _ => self.push(Op::Add(a.min(b), a.max(b))),
            },
        }
    }

    /// x − y
    pub fn sub(&mut self, a: NodeId, b: NodeId) -> NodeId {
        match (self.value(a), self.value(b)) {
            (Some(x), Some(y)) => {
                let v = x - y;
                self.number(v)
            }
            (Some(x), _) if x.is_zero() => self.neg(b),
            (_, Some(y)) if y.is_zero() => a,
            _ if a == b && self.total[a] => self.int(0),
            _ => match self.ops[b] {
                Op::Neg(y) => self.add(a, y),
                _ => self.push(Op::Sub(a, b)),
            },
        }
    }

    /// x·y; zero swallows only what is defined everywhere.
    pub fn mul(&mut self, a: NodeId, b: NodeId) -> NodeId {
        match (self.value(a), self.value(b)) {
            (Some(x), Some(y)) => {
                let v = x * y;
                self.number(v)
            }
            (Some(_), _) => self.scaled(a, b),
            (_, Some(_)) => self.scaled(b, a),
            _ => self.push(Op::Mul(a.min(b), a.max(b))),
        }
    }

    fn scaled(&mut self, number: NodeId, x: NodeId) -> NodeId {
        match self.value(number) {
            Some(v) if v.is_one() => x,
            Some(v) if v.is_zero() && self.total[x] => number,
            Some(v) if v.is_negative() && (-v).is_one() => self.neg(x),
            _ => self.push(Op::Mul(number, x)),
        }
    }

    /// x/y
    pub fn div(&mut self, a: NodeId, b: NodeId) -> NodeId {
        match (self.value(a), self.value(b)) {
            (Some(x), Some(y)) if !y.is_zero() => {
                let v = x / y;
                self.number(v)
            }
            (_, Some(y)) if y.is_one() => a,
            _ => self.push(Op::Div(a, b)),
        }
    }

    /// xⁿ
    pub fn pow(&mut self, x: NodeId, n: i32) -> NodeId {
        match n {
            1 => x,
            0 if self.total[x] => self.int(1),
            _ => self.push(Op::Pow(x, n)),
        }
    }

    /// f(x)
    pub fn call(&mut self, f: Fun, x: NodeId) -> NodeId {
        match f {
            Fun::Sin | Fun::Tan | Fun::Atan | Fun::Tanh if self.is_zero(x) => x,
            Fun::Cos if self.is_zero(x) => self.int(1),
            _ => self.push(Op::Call(f, x)),
        }
    }

    /// The expression a node stands for, with all its definitions written out.
    pub fn expr(&self, id: NodeId) -> Expr {
        let go = |x: &NodeId| self.expr(*x);
        match self.op(id) {
            Op::Num(v) => Expr::number(v),
            Op::Sym(s) => Expr::sym(s.clone()),
            Op::Neg(x) => -&go(x),
            Op::Add(a, b) => &go(a) + &go(b),
            Op::Sub(a, b) => &go(a) - &go(b),
            Op::Mul(a, b) => &go(a) * &go(b),
            Op::Div(a, b) => &go(a) / &go(b),
            Op::Pow(x, n) => go(x).pow(*n),
            Op::Call(f, x) => Expr::call(*f, &go(x)),
        }
    }
}
