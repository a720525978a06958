//! How the cost of a train grows with its trailers.

use super::jacobian;
use super::pair::processor_time;
use creepage::formula::{Changes, Expr, Graph, Isa, Lanes, NodeId, Program, Symbol};

const LANES: usize = jacobian::LANES;

/// Nanoseconds a lane.
fn time(lanes: &Lanes, slots: usize) -> f64 {
    let mut memory = lanes.memory::<LANES>();
    (0..slots).for_each(|slot| *memory.input(slot) = std::array::from_fn(|l| jacobian::point(slot, l)));
    lanes.begin(&mut memory, Isa::best());
    let mut best = f64::INFINITY;
    for _ in 0..7 {
        let (start, mut runs) = (processor_time(), 0);
        while processor_time() - start < 4e-3 {
            (0..16).for_each(|_| lanes.run(&mut memory, Isa::best()));
            runs += 16;
        }
        best = best.min((processor_time() - start) / runs as f64);
    }
    1e9 * best / LANES as f64
}

fn compiled(graph: &Graph, slots: &[Symbol], nodes: &[NodeId]) -> Lanes {
    Lanes::new(&Program::compile(graph, slots, nodes).unwrap(), &vec![Changes::Lane; slots.len()])
}

/// The constraint rows at coordinates q + s·v: their value, J·v = d/ds, and the derivative by the first trailer's length.
fn row(trailers: usize) -> [f64; 4] {
    let mechanism = jacobian::mechanism(trailers);
    let mut graph = jacobian::defined(&mechanism, trailers);
    let length = Symbol::from("d_1");
    let rows: Vec<NodeId> = mechanism.constraints.iter().map(|c| graph.insert(&c.generic())).collect();
    let q: Vec<Symbol> = mechanism.coordinates.to_vec();
    let all: Vec<Symbol> = q.iter().cloned().chain(q.iter().map(Symbol::rate)).chain([length.clone()]).collect();
    let value = time(&compiled(&graph, &all, &rows), all.len());
    let by_length = graph.derivatives(&rows, &length);
    let sensitivity = time(&compiled(&graph, &all, &by_length), all.len());

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
    let product = time(&compiled(&along, &slots, &product), slots.len());
    let full = jacobian::compiled(trailers);
    let entries = full.places.len();
    [value, product, sensitivity, time(&full.lanes, 2 * full.coordinates) / entries as f64]
}

/// Prints the costs a trailer, which stay the same where a cost is linear; that of the Jacobian an entry.
pub fn table() {
    println!("\nHow costs grow: a lane, a trailer; of the Jacobian, an entry that is not zero.");
    println!("\n| trailers | rows | J·v | by one length | Jacobian, an entry |\n|---|---|---|---|---|");
    for trailers in [5, 10, 20, 50, 100] {
        let [value, product, sensitivity, entry] = row(trailers);
        let each = [value, product, sensitivity].map(|t| format!("{:.2} ns", t / trailers as f64));
        println!("| {trailers} | {} | {entry:.2} ns |", each.join(" | "));
    }
}
