//! Symbolic derivatives of formulas, taken once on the shared graph.

use super::{Expr, Fun, Graph, NodeId, Op, Symbol};
use std::collections::HashMap;

/// The derivatives of the nodes of a graph along one direction, kept so that none is taken twice.
#[derive(Default)]
struct Derivative {
    known: HashMap<NodeId, NodeId>,
}

impl Graph {
    /// Adds the derivatives of nodes with respect to a symbol and gives their nodes.
    ///
    /// Works without recursion over the nodes in their order, so that long chains are no danger.
    pub fn derivatives(&mut self, of: &[NodeId], with_respect_to: &Symbol) -> Vec<NodeId> {
        self.moved(of, &|graph, s| graph.int(i64::from(s == with_respect_to)))
    }

    /// Adds the derivatives of nodes along a direction, Σ ∂node/∂symbol·rate: a Jacobian times a vector at the cost of
    /// few values.
    ///
    /// ```
    /// use creepage::formula::{Expr, Graph};
    /// let mut g = Graph::default();
    /// let product = g.insert(&Expr::parse("x*y").unwrap());
    /// let (a, b) = (g.symbol("a".into()), g.symbol("b".into()));
    /// let along = g.directional(&[product], &[("x".into(), a), ("y".into(), b)]);
    /// assert_eq!(g.expr(along[0]).to_string(), "y*a + x*b");
    /// ```
    pub fn directional(&mut self, of: &[NodeId], along: &[(Symbol, NodeId)]) -> Vec<NodeId> {
        let along: HashMap<&Symbol, NodeId> = along.iter().map(|(s, rate)| (s, *rate)).collect();
        self.moved(of, &|graph, s| along.get(s).copied().unwrap_or_else(|| graph.int(0)))
    }

    /// The rates of nodes when every symbol moves at a rate of its own.
    fn moved(&mut self, of: &[NodeId], rate: &impl Fn(&mut Self, &Symbol) -> NodeId) -> Vec<NodeId> {
        let last = of.iter().max().map_or(0, |m| m + 1);
        let needed = self.reachable(of, last);
        let mut d = Derivative::default();
        for id in (0..last).filter(|id| needed[*id]) {
            let value = self.derivative_of(id, &d, rate);
            d.known.insert(id, value);
        }
        of.iter().map(|id| d.known[id]).collect()
    }

    /// Which of the first `count` nodes the given ones depend on.
    pub(super) fn reachable(&self, from: &[NodeId], count: usize) -> Vec<bool> {
        let mut needed = vec![false; count];
        from.iter().for_each(|id| needed[*id] = true);
        for id in (0..count).rev() {
            if needed[id] {
                self.arguments(id).into_iter().flatten().for_each(|x| needed[x] = true);
            }
        }
        needed
    }

    /// Whether a node is made of a symbol.
    pub(crate) fn reads(&self, id: NodeId, symbol: &Symbol) -> bool {
        let needed = self.reachable(&[id], id + 1);
        (0..=id).any(|k| needed[k] && matches!(self.op(k), Op::Sym(s) if s == symbol))
    }

    /// The nodes an operation reads.
    pub(super) fn arguments(&self, id: NodeId) -> [Option<NodeId>; 2] {
        match self.op(id) {
            Op::Num(_) | Op::Sym(_) => [None, None],
            Op::Neg(x) | Op::Pow(x, _) | Op::Call(_, x) => [Some(*x), None],
            Op::Add(a, b) | Op::Sub(a, b) | Op::Mul(a, b) | Op::Div(a, b) => [Some(*a), Some(*b)],
        }
    }

    fn derivative_of(&mut self, id: NodeId, d: &Derivative, rate: &impl Fn(&mut Self, &Symbol) -> NodeId) -> NodeId {
        let known = |x: &NodeId| d.known[x];
        match self.op(id).clone() {
            Op::Num(_) => self.int(0),
            Op::Sym(name) => rate(self, &name),
            Op::Neg(x) => self.neg(known(&x)),
            Op::Add(a, b) => self.add(known(&a), known(&b)),
            Op::Sub(a, b) => self.sub(known(&a), known(&b)),
            Op::Mul(a, b) => self.product_rule([a, b], [known(&a), known(&b)]),
            Op::Div(a, b) => self.quotient_rule(id, known(&a), b, known(&b)),
            Op::Pow(x, n) => self.power_rule(x, n, known(&x)),
            // A function of what does not depend on the symbol does not either.
            Op::Call(_, x) if self.is_zero(known(&x)) => known(&x),
            Op::Call(f, x) => {
                let outer = self.function_rule(id, f, x);
                self.mul(outer, known(&x))
            }
        }
    }

    /// (a·b)′ = a′·b + a·b′
    ///
    /// A product by a factor that does not move is left out even where the other factor is not defined everywhere: kept
    /// as 0·tan(α), it would pass for a dependence.
    fn product_rule(&mut self, [a, b]: [NodeId; 2], [da, db]: [NodeId; 2]) -> NodeId {
        match (self.is_zero(da), self.is_zero(db)) {
            (true, true) => da,
            (true, false) => self.mul(a, db),
            (false, true) => self.mul(da, b),
            (false, false) => {
                let (left, right) = (self.mul(da, b), self.mul(a, db));
                self.add(left, right)
            }
        }
    }

    /// (a/b)′ = (a′ − (a/b)·b′)/b
    fn quotient_rule(&mut self, quotient: NodeId, da: NodeId, b: NodeId, db: NodeId) -> NodeId {
        if self.is_zero(db) {
            return if self.is_zero(da) { da } else { self.div(da, b) };
        }
        let carried = self.mul(quotient, db);
        let top = self.sub(da, carried);
        self.div(top, b)
    }

    /// (xⁿ)′ = n·xⁿ⁻¹·x′
    fn power_rule(&mut self, x: NodeId, n: i32, dx: NodeId) -> NodeId {
        if n == 0 || self.is_zero(dx) {
            return self.int(0);
        }
        let factor = self.int(i64::from(n));
        let lower = self.pow(x, n - 1);
        let slope = self.mul(factor, lower);
        self.mul(slope, dx)
    }

    /// f′(x), with y = f(x) at hand.
    fn function_rule(&mut self, y: NodeId, f: Fun, x: NodeId) -> NodeId {
        let one = self.int(1);
        match f {
            Fun::Sin => self.call(Fun::Cos, x),
            Fun::Cos => {
                let s = self.call(Fun::Sin, x);
                self.neg(s)
            }
            Fun::Tan => self.one_plus_square(y, 1),
            Fun::Cot => {
                let p = self.one_plus_square(y, 1);
                self.neg(p)
            }
            Fun::Asin => self.arc_slope(x),
            Fun::Acos => {
                let p = self.arc_slope(x);
                self.neg(p)
            }
            Fun::Atan => {
                let p = self.one_plus_square(x, 1);
                self.div(one, p)
            }
            Fun::Tanh => self.one_plus_square(y, -1),
            Fun::Exp => y,
            Fun::Ln => self.div(one, x),
            Fun::Sqrt => {
                let two = self.int(2);
                let p = self.mul(two, y);
                self.div(one, p)
            }
            // x/|x|: the sign, and undefined at zero like the derivative itself.
            Fun::Abs => self.div(x, y),
            // 0/|x|: zero, and undefined at zero.
            Fun::Sign => {
                let size = self.call(Fun::Abs, x);
                let zero = self.int(0);
                self.div(zero, size)
            }
            // A gate is open or closed; what it does at the instant of the change is the integrator's.
            Fun::Step => self.int(0),
        }
    }

    /// 1 ± x²
    fn one_plus_square(&mut self, x: NodeId, sign: i64) -> NodeId {
        let one = self.int(1);
        let square = self.pow(x, 2);
        if sign > 0 { self.add(one, square) } else { self.sub(one, square) }
    }

    /// 1/√(1 − x²)
    fn arc_slope(&mut self, x: NodeId) -> NodeId {
        let inside = self.one_plus_square(x, -1);
        let root = self.call(Fun::Sqrt, inside);
        let one = self.int(1);
        self.div(one, root)
    }
}

impl Expr {
    /// The derivative of a formula with respect to a symbol.
    ///
    /// ```
    /// use creepage::formula::Expr;
    /// let sigma = Expr::parse("(q - e)/(1 + e*q)").unwrap();
    /// let d = sigma.derivative(&"e".into());
    /// // -(1 + q^2)/(1 + e*q)^2
    /// let at = |s: &str| if s == "q" { 2.0 } else { 0.5 };
    /// assert_eq!(d.eval(&|s| at(s.as_str())), Some(-1.25));
    /// ```
    pub fn derivative(&self, with_respect_to: &Symbol) -> Expr {
        let mut graph = Graph::default();
        let id = graph.insert(self);
        let d = graph.derivatives(&[id], with_respect_to);
        graph.expr(d[0])
    }
}
