//! Lagrange's equations with constraints: M·q̈ + h = Q, by derivatives of the kinetic energy.

use super::{Dynamics, Law};
use crate::error::Result;
use crate::formula::{Expr, Graph, NodeId, Symbol};
use crate::mechanism::Row;

/// The parts of M·q̈ + h = Q + Σ λ·∂slip/∂q̇ as nodes of one graph.
///
/// Every rate and every coordinate is a symbol of its own, prescribed ones too: T(q, q̇), slip(q, q̇) and the laws of
/// contact are functions of both.
pub(super) struct Derived {
    pub graph: Graph,
    /// M, row by row.
    pub mass: Vec<NodeId>,
    /// h = Σ ∂²T/∂q̇∂q·q̇ − ∂T/∂q.
    pub bias: Vec<NodeId>,
    /// Q of the forces that drive and of the contacts with a law.
    pub force: Vec<NodeId>,
    /// ∂slip/∂q̇ of the ideal contacts, row by row.
    pub rows: Vec<NodeId>,
    /// d/dt slip of the ideal contacts but for what q̈ adds.
    pub drift: Vec<NodeId>,
    /// Rates of the states of the laws.
    pub memory: Vec<NodeId>,
}

/// The parts of the equations of motion as formulas, lengths and masses as symbols.
///
/// | field | meaning |
/// |---|---|
/// | `coordinates` | q, those that are not prescribed |
/// | `mass` | M(q), symmetric |
/// | `bias` | h(q, q̇) |
/// | `force` | Q: what drives and what contacts with a law do |
/// | `slips` | slip of every contact |
/// | `forces` | force along each slip; for an ideal contact the symbol of its multiplier, `contact_1.force` |
///
/// M·q̈ + h = Q + Σ contact.force·∂slip/∂q̇ over the ideal contacts. Source: Lagrange's equations; paper, (11) and (18)
/// for the forces.
///
/// ```
/// use creepage::dynamics::{Dynamics, Masses};
/// use creepage::formula::identical;
/// use creepage::model::Model;
/// let sleigh = Model::new("sleigh", &[("mass", 2.0), ("inertia", 0.5), ("mass_offset", 0.1)]).unwrap();
/// let sleigh = Dynamics::new(&sleigh, &Masses { mass: 2.0, ..Masses::default() }).unwrap().formulas().unwrap();
/// // About the blade: I + m·a².
/// let said = creepage::formula::Expr::parse("body.inertia + body.mass*body.mass_offset^2").unwrap();
/// assert_eq!(identical(&sleigh.mass[2][2], &said), Some(true));
/// ```
#[derive(Clone, Debug)]
pub struct Formulas {
    /// q.
    pub coordinates: Vec<Symbol>,
    /// M.
    pub mass: Vec<Vec<Expr>>,
    /// h.
    pub bias: Vec<Expr>,
    /// Q.
    pub force: Vec<Expr>,
    /// Slips.
    pub slips: Vec<Expr>,
    /// Forces along the slips.
    pub forces: Vec<Expr>,
}

impl Dynamics {
    /// The equations of motion as formulas.
    ///
    /// # Errors
    /// When definitions of the vehicle use each other in a circle.
    pub fn formulas(&self) -> Result<Formulas> {
        let d = self.derive(false)?;
        let coordinates = self.coordinates();
        let expr = |id: &NodeId| d.graph.expr(*id);
        let force =
            |(i, c): (usize, &super::Contact)| c.force(i + 1).unwrap_or_else(|| Expr::sym(Law::symbol("force", i + 1)));
        Ok(Formulas {
            mass: d.mass.chunks(coordinates.len().max(1)).map(|row| row.iter().map(expr).collect()).collect(),
            bias: d.bias.iter().map(expr).collect(),
            force: d.force.iter().map(expr).collect(),
            slips: self.contacts.iter().map(|c| c.slip.expr()).collect(),
            forces: self.contacts.iter().enumerate().map(force).collect(),
            coordinates,
        })
    }

    /// The contacts without a law.
    pub(super) fn ideal(&self) -> impl Iterator<Item = (usize, &super::Contact)> {
        self.contacts.iter().enumerate().filter(|(_, c)| c.law.is_none())
    }

    /// Derives everything; `with_lengths` puts parameters for radii and lengths.
    pub(super) fn derive(&self, with_lengths: bool) -> Result<Derived> {
        let mut graph = Graph::default();
        if with_lengths {
            self.lengths().insert_into(&mut graph)?;
        }
        let all = &self.mechanism.coordinates;
        let free = self.coordinates();
        let energy = graph.insert(&self.energy());
        let momenta: Vec<NodeId> = free.iter().map(|q| graph.derivatives(&[energy], &q.rate())[0]).collect();
        let columns: Vec<Vec<NodeId>> = free.iter().map(|q| graph.derivatives(&momenta, &q.rate())).collect();
        let mass = (0..free.len()).flat_map(|i| columns.iter().map(move |c| c[i])).collect();
        let carried = along_motion(&mut graph, &momenta, all);
        let bias = free.iter().zip(carried);
        let bias = bias
            .map(|(q, carried)| {
                let slope = graph.derivatives(&[energy], q)[0];
                graph.sub(carried, slope)
            })
            .collect();
        let force = free.iter().map(|q| self.generalized_force(&mut graph, q)).collect();
        let ideal: Vec<Row> = self.ideal().map(|(_, c)| c.slip.clone()).collect();
        let rows = ideal.iter().flat_map(|row| free.iter().map(move |q| row.coefficient(&q.rate())));
        let rows = rows.map(|c| graph.insert(&c)).collect();
        let slips: Vec<NodeId> = ideal.iter().map(|row| graph.insert(&row.expr())).collect();
        let drift = along_motion(&mut graph, &slips, all);
        let memory = self.contacts.iter().enumerate().filter_map(|(i, c)| c.memory(i + 1));
        let memory = memory.map(|(_, rate)| graph.insert(&rate)).collect();
        Ok(Derived { graph, mass, bias, force, rows, drift, memory })
    }

    /// What does work on a coordinate: inputs, and contacts with a law.
    fn generalized_force(&self, graph: &mut Graph, q: &Symbol) -> NodeId {
        let inputs = self.driven.iter().map(|f| (Expr::sym(f.role.as_str()), &f.along));
        let laws = self.contacts.iter().enumerate().filter_map(|(i, c)| Some((c.force(i + 1)?, &c.slip)));
        let parts = inputs.chain(laws).map(|(force, along)| (force, along.coefficient(&q.rate())));
        let sum = parts.filter(|(_, c)| !c.is_zero()).fold(Expr::int(0), |sum, (force, c)| &sum + &(&force * &c));
        graph.insert(&sum)
    }
}

/// Σ ∂/∂q·q̇ of some nodes: their derivatives along the motion at given rates.
fn along_motion(graph: &mut Graph, nodes: &[NodeId], coordinates: &[Symbol]) -> Vec<NodeId> {
    let mut sums: Vec<NodeId> = nodes.iter().map(|_| graph.insert(&Expr::int(0))).collect();
    for q in coordinates {
        let rate = graph.symbol(q.rate());
        for (sum, slope) in sums.iter_mut().zip(graph.derivatives(nodes, q)) {
            let term = graph.mul(slope, rate);
            *sum = graph.add(*sum, term);
        }
    }
    sums
}
