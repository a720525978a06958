//! How the cost of a train grows with its trailers.

use super::harness::Harness;
use super::jacobian;
use creepage::formula::{Changes, Expr, Graph, Isa, Lanes, NodeId, Program, Symbol};

const LANES: usize = jacobian::LANES;

/// Times a program over its lanes, `units` of work a lane.
fn time(harness: &mut Harness, (work, trailers): (&str, usize), lanes: &Lanes, slots: usize, units: usize) {
    let mut memory = lanes.memory::<LANES>();
    (0..slots).for_each(|slot| *memory.input(slot) = std::array::from_fn(|l| jacobian::point(slot, l)));
    lanes.begin(&mut memory, Isa::best());
    harness.size(work, trailers, LANES * units, || lanes.run(&mut memory, Isa::best()));
}

fn compiled(graph: &Graph, slots: &[Symbol], nodes: &[NodeId]) -> Lanes {
    Lanes::new(&Program::compile(graph, slots, nodes).unwrap(), &vec![Changes::Lane; slots.len()])
}

/// The constraint rows at coordinates q + s·v: their value, J·v = d/ds, and the derivative by the first trailer's length.
fn measure(harness: &mut Harness, trailers: usize) {
    let mechanism = jacobian::mechanism(trailers);
    let mut graph = jacobian::defined(&mechanism, trailers);
    let length = Symbol::from("d_1");
    let rows: Vec<NodeId> = mechanism.constraints.iter().map(|c| graph.insert(&c.generic())).collect();
    let q: Vec<Symbol> = mechanism.coordinates.to_vec();
    let all: Vec<Symbol> = q.iter().cloned().chain(q.iter().map(Symbol::rate)).chain([length.clone()]).collect();
    time(harness, ("rows of a train", trailers), &compiled(&graph, &all, &rows), all.len(), trailers);
    let by_length = graph.derivatives(&rows, &length);
    time(harness, ("rows by one length", trailers), &compiled(&graph, &all, &by_length), all.len(), trailers);

    let mut along = jacobian::defined(&mechanism, trailers);
    let mut slots = vec![length, Symbol::from("s")];
    for symbol in q.iter().cloned().chain(q.iter().map(Symbol::rate)) {
        let [at, by] = ["at", "by"].map(|which| Symbol::new(&format!("{which} {symbol}")));
        let moved = &Expr::sym(at.clone()) + &(&Expr::sym("s") * &Expr::sym(by.clone()));
        let moved = along.insert(&moved);
        along.define(symbol, moved);
        slots.extend([at, by]);
    }
    let rows: Vec<NodeId> = mechanism.constraints.iter().map(|c| along.insert(&c.generic())).collect();
    let product = along.derivatives(&rows, &Symbol::from("s"));
    time(harness, ("J v of a train", trailers), &compiled(&along, &slots, &product), slots.len(), trailers);
    let full = jacobian::compiled(trailers);
    let at = ("Jacobian of a train", trailers);
    time(harness, at, &full.lanes, 2 * full.coordinates, full.places.len());
}

/// Costs a trailer, which stay the same where a cost is linear; that of the Jacobian an entry that is not zero.
pub fn all(harness: &mut Harness) {
    [5, 10, 20, 50, 100].into_iter().for_each(|trailers| measure(harness, trailers));
}
