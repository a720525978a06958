//! What N trailers cost: steps of the compiled programs, which no machine's mood changes.

use creepage::formula::{Changes, Expr, Graph, Lanes, NodeId, Op, Program, Symbol};
use creepage::model::{Model, Trailer};

const HARD: [usize; 4] = [5, 10, 20, 40];

/// The rates of a train as nodes, its states, and every slot.
fn train(n: usize) -> (Graph, Vec<NodeId>, Vec<Symbol>, Vec<Symbol>) {
    let model = Model::new("unicycle", &[("wheel_radius", 0.5)]).unwrap();
    let model = model.with_trailers(&vec![Trailer { length: 1.0, hitch: 0.2 }; n]);
    let mut graph = Graph::default();
    model.definitions().unwrap().insert_into(&mut graph).unwrap();
    let states = model.states();
    let rates = states.iter().map(|s| graph.insert(&Expr::sym(s.rate()))).collect();
    let inputs = model.inputs.iter().map(|i| Symbol::new(i));
    let slots = states.iter().cloned().chain(inputs).chain(model.values().into_keys()).collect();
    (graph, rates, states, slots)
}

fn steps(graph: &Graph, nodes: &[NodeId], slots: &[Symbol]) -> usize {
    let program = Program::compile(graph, slots, nodes).unwrap();
    Lanes::new(&program, &vec![Changes::Lane; slots.len()]).len()
}

/// The cost grows by the same number of steps with each trailer.
fn is_linear(cost: impl Fn(usize) -> usize) {
    let costs = HARD.map(&cost);
    let slope = |i: usize| (costs[i + 1] - costs[i]) as f64 / (HARD[i + 1] - HARD[i]) as f64;
    let slopes = [slope(0), slope(1), slope(2)];
    assert!(slopes.iter().all(|s| (s / slopes[0] - 1.0).abs() < 0.05), "{costs:?}");
}

#[test]
fn values_are_linear_in_the_trailers() {
    is_linear(|n| {
        let (graph, rates, _, slots) = train(n);
        steps(&graph, &rates, &slots)
    });
}

#[test]
fn the_sensitivity_to_a_parameter_is_linear_in_the_trailers() {
    // The explicit part ∂f/∂p, for a parameter that every trailer feels.
    is_linear(|n| {
        let (mut graph, rates, _, slots) = train(n);
        let slopes = graph.derivatives(&rates, &"wheel_radius".into());
        steps(&graph, &[rates, slopes].concat(), &slots)
    });
}

#[test]
fn a_jacobian_times_a_vector_is_linear_in_the_trailers() {
    is_linear(|n| {
        let (mut graph, rates, states, mut slots) = train(n);
        let direction: Vec<Symbol> = states.iter().map(|s| Symbol::new(&format!("along.{s}"))).collect();
        let along: Vec<NodeId> = direction.iter().map(|d| graph.symbol(d.clone())).collect();
        let product = graph.directional(&rates, &states.iter().cloned().zip(along).collect::<Vec<_>>());
        slots.extend(direction);
        steps(&graph, &[rates, product].concat(), &slots)
    });
}

/// What is cheap is right, too: the derivatives, each times its rate.
#[test]
fn a_jacobian_times_a_vector_is_the_sum_of_its_columns() {
    let (mut graph, rates, states, slots) = train(3);
    let value = |name: &Symbol| 0.3 + 0.17 * slots.iter().position(|s| s == name).unwrap_or(0) as f64;
    let numbers: Vec<f64> = (0..states.len()).map(|k| 1.0 - 0.37 * k as f64).collect();
    let along: Vec<(Symbol, NodeId)> = states
        .iter()
        .cloned()
        .zip(numbers.iter().map(|x| graph.insert(&Expr::parse(&format!("{x}")).unwrap())))
        .collect();
    let columns: Vec<Vec<NodeId>> = states.iter().map(|s| graph.derivatives(&rates, s)).collect();
    let product = graph.directional(&rates, &along);
    assert_eq!(product.len(), rates.len());
    let at = |id: NodeId| graph.expr(id).eval(&value).unwrap();
    for (i, found) in product.iter().enumerate() {
        let sum: f64 = columns.iter().zip(&numbers).map(|(column, x)| at(column[i]) * x).sum();
        assert!((at(*found) - sum).abs() < 1e-12 * (1.0 + sum.abs()), "row {i}: {} and {sum}", at(*found));
    }
}

/// An entry more costs no more steps in a long train than in a short one.
#[test]
fn a_jacobian_is_linear_in_its_entries() {
    let costs = HARD.map(|n| {
        let (mut graph, rates, states, slots) = train(n);
        let entries: Vec<NodeId> = states.iter().flat_map(|s| graph.derivatives(&rates, s)).collect();
        let zero = |id: &NodeId| matches!(graph.op(*id), Op::Num(v) if *v == creepage::formula::BigRational::default());
        let entries: Vec<NodeId> = entries.iter().copied().filter(|id| !zero(id)).collect();
        // A trailer hangs on the headings before it and on its own, and on no other.
        assert_eq!(entries.len(), n * (n + 3) / 2 + 2);
        (steps(&graph, &entries, &slots) as f64, entries.len() as f64)
    });
    let slopes: Vec<f64> = costs.windows(2).map(|w| (w[1].0 - w[0].0) / (w[1].1 - w[0].1)).collect();
    assert!(slopes.windows(2).all(|w| w[1] <= w[0]), "steps for an entry more: {slopes:?} of {costs:?}");
}
