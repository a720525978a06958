//! The equations of motion of a model compiled: formulas and their exact derivatives to programs over lanes.

use super::build::TIME;
use super::equations::{Derived, Equations, Fineness};
use super::freedom::{Freedom, Speed};
use super::vehicle_model::Model;
use super::{observation, state};
use crate::effects::{Scope, delaying};
use crate::error::{Error, Result};
use crate::formula::{Changes, Expr, Graph, Lanes, NodeId, Program, Symbol};
use crate::mechanism::Definitions;
use std::collections::{BTreeMap, BTreeSet};

impl Model {
    /// Values of every fixed symbol of the model's formulas.
    pub fn values(&self) -> BTreeMap<Symbol, f64> {
        let mut values: BTreeMap<Symbol, f64> = self.parameters.iter().map(|(k, v)| (Symbol::new(k), *v)).collect();
        for (i, t) in (self.vehicle.trailers.len() + 1..).zip(&self.trailers) {
            values.insert(Symbol::new(&format!("trailer_length_{i}")), t.length);
            values.insert(Symbol::new(&format!("hitch_offset_{i}")), t.hitch);
        }
        values.extend(self.forced.iter().flat_map(|forced| forced.values.clone()));
        values.insert("sensor.a".into(), self.sensor.lever_arm[0]);
        values.insert("sensor.b".into(), self.sensor.lever_arm[1]);
        values.insert("sensor.heading_offset".into(), self.sensor.heading_offset);
        for e in &self.effects {
            values.extend(e.parameters().into_iter().zip(e.values.iter().copied()));
            values.extend(e.constants());
        }
        values
    }

    /// The symbols of the states: pose, trailer headings, hidden states: coordinates of its own, states of effects.
    pub fn states(&self) -> Vec<Symbol> {
        let mut states: Vec<Symbol> = state::node_symbols(self.trailer_count()).collect();
        states.extend(self.own_states());
        states.extend(self.effects.iter().flat_map(|e| e.states()).map(|(s, _)| s));
        states
    }

    /// How many states are free at the start of every window.
    fn nodes(&self) -> usize {
        state::nodes(self.freedom()).len()
    }

    /// What of the vehicle is free at the start of every window.
    pub(crate) fn freedom(&self) -> Freedom {
        let speeds = self.forced.iter().flat_map(|forced| &forced.nodes).map(Speed::named).collect();
        Freedom { trailers: self.trailer_count(), speeds, quantities: self.measured.iter().map(|m| m.noise).collect() }
    }

    /// The rates of the states, in their order.
    pub(crate) fn state_rates(&self) -> Vec<Expr> {
        let states = self.states();
        let hidden = self.effects.iter().flat_map(|e| e.states()).map(|(_, rate)| rate);
        let of_effects = self.effects.iter().map(|e| e.states().len()).sum::<usize>();
        let own = states[..states.len() - of_effects].iter().map(|s| Expr::sym(s.rate()));
        own.chain(hidden).collect()
    }

    /// What a symbol is that no column of a log gives, but the log as a whole.
    fn derived(&self, s: &Symbol) -> Option<Derived> {
        if s.as_str() == TIME {
            return Some(Derived::Time);
        }
        self.inputs.iter().position(|i| Symbol::new(i).rate() == *s).map(Derived::Rate)
    }

    /// The logged inputs, then what the formulas ask of the log beside: the time, rates of inputs.
    pub(crate) fn logged_and_derived(&self, definitions: &Definitions) -> Vec<Symbol> {
        let logged: Vec<Symbol> = self.inputs.iter().map(|i| Symbol::new(i)).collect();
        if self.effects.is_empty() && self.forced.is_none() && self.measured.is_empty() {
            return logged;
        }
        let values = self.values();
        let given = |s: &Symbol| logged.contains(s) || definitions.get(s).is_some() || values.contains_key(s);
        let formulas = definitions.iter().map(|(_, f)| f.clone()).chain(self.state_rates());
        let asked: BTreeSet<Symbol> =
            formulas.flat_map(|f| f.symbols()).filter(|s| self.derived(s).is_some() && !given(s)).collect();
        logged.into_iter().chain(asked).collect()
    }

    /// Compiles the equations of motion with the given symbols left free.
    ///
    /// # Errors
    /// When a formula uses a name that nothing defines, or formulas refer to each other in a circle.
    pub fn equations(&self, free: &[Symbol]) -> Result<Equations> {
        let inputs = self.logged_and_derived(&self.definitions()?);
        self.compiled(free, &[&self.states()[..], &inputs, free].concat())
    }

    /// The equations of motion with the derivatives of the rates by free symbols alone.
    pub(crate) fn equations_by(&self, free: &[Symbol]) -> Result<Equations> {
        self.compiled(free, free)
    }

    /// The rates of the states as a program for any carrier of numbers, by states, inputs and free symbols, then by values
    /// that stay: what the compiled derivatives are held against.
    pub(crate) fn rates_of_any_carrier(&self, free: &[Symbol]) -> Result<(Program, Vec<f64>)> {
        let definitions = self.definitions()?;
        let (graph, rates) = self.graph_of_rates(&definitions)?;
        let (slots, constants) = self.slots(free, &self.logged_and_derived(&definitions));
        Ok((Program::compile(&graph, &slots, &rates).map_err(undefined_name)?, constants))
    }

    /// The definitions as a graph, and the rates of the states in it.
    fn graph_of_rates(&self, definitions: &Definitions) -> Result<(Graph, Vec<NodeId>)> {
        let mut graph = Graph::default();
        definitions.insert_into(&mut graph)?;
        let rates = self.state_rates().iter().map(|rate| graph.insert(rate)).collect();
        Ok((graph, rates))
    }

    /// What a program is given: states, inputs, free symbols, then all other values, which follow.
    fn slots(&self, free: &[Symbol], inputs: &[Symbol]) -> (Vec<Symbol>, Vec<f64>) {
        let values = self.values().into_iter().filter(|(s, _)| !free.contains(s));
        let (names, constants): (Vec<Symbol>, Vec<f64>) = values.unzip();
        ([&self.states()[..], inputs, free, &names].concat(), constants)
    }

    /// The equations of motion for a simulation: the rates have no derivatives where nothing asks for them. Those of a
    /// train of N trailers are N² formulas.
    pub(crate) fn equations_to_simulate(&self) -> Result<Equations> {
        let hidden = self.states().len() > self.nodes();
        if hidden { self.equations(&[]) } else { self.compiled(&[], &[]) }
    }

    /// The equations with the derivatives of the rates by some symbols.
    fn compiled(&self, free: &[Symbol], by: &[Symbol]) -> Result<Equations> {
        let definitions = self.definitions()?;
        let (mut graph, rates) = self.graph_of_rates(&definitions)?;
        let states = self.states();
        let visible = self.nodes();
        let inputs = self.logged_and_derived(&definitions);
        let derived = inputs[self.inputs.len()..].iter().filter_map(|s| self.derived(s)).collect();
        let edges = self.effects.iter().filter_map(|e| e.effect.scope.as_ref()).flat_map(Scope::edges).collect();
        let (slots, constants) = self.slots(free, &inputs);
        // Parameters are set once for a workspace; what hangs on them alone is computed then.
        let moving = states.len() + inputs.len();
        let changes: Vec<Changes> =
            (0..slots.len()).map(|i| if i < moving { Changes::Lane } else { Changes::Case }).collect();
        let compile = |graph: &Graph, nodes: &[NodeId]| {
            let program = Program::compile(graph, &slots, nodes).map_err(undefined_name)?;
            Ok::<_, Error>(Lanes::new(&program, &changes))
        };
        let plain = compile(&graph, &rates)?;
        let jacobian = with_derivatives(&mut graph, &rates, by);
        let read = live(&graph, &jacobian, rates.len());
        let heading_comes_first = self.forced.is_none() && heading_comes_first(&graph, &rates, &states);
        let is_linear_in_hidden = is_linear(&mut graph, &jacobian, &states[visible..], [visible, by.len()]);
        let carried = match visible < states.len() {
            true => carried(&mut graph, &jacobian, &read, [visible, states.len(), by.len()]),
            false => None,
        };
        let carried =
            carried.map(|nodes| Ok::<_, Error>((live(&graph, &nodes, rates.len()), compile(&graph, &nodes)?)));
        let carried = carried.transpose()?;
        let (has_own_slope, own_slopes) =
            own_slopes(&graph, &jacobian, &states, by).into_iter().unzip::<_, _, Vec<_>, Vec<_>>();
        let own_slopes = compile(&graph, &own_slopes)?;
        let jacobian = compile(&graph, &jacobian)?;
        let speeds: &[Symbol] = self.forced.as_ref().map_or(&[], |forced| &forced.nodes);
        let outputs = observation::outputs(self.freedom());
        let measured: Vec<NodeId> = outputs.map(|y| graph.insert(&Expr::sym(y.symbol_among(speeds)))).collect();
        let measured = with_derivatives(&mut graph, &measured, &[&states[..visible], free].concat());
        let outputs = compile(&graph, &measured)?;
        let quantities: Vec<NodeId> = self.measured.iter().map(|m| graph.insert(&Expr::sym(m.symbol()))).collect();
        let quantities = with_derivatives(&mut graph, &quantities, &[&states[..], &inputs, free].concat());
        let quantities = compile(&graph, &quantities)?;
        let own = |role: &String| definitions.get(&delaying(role)).filter(|f| !f.is_zero()).cloned();
        let own_delays = if self.inputs.iter().any(|role| own(role).is_some()) { self.inputs.len() } else { 0 };
        let own = self.inputs.iter().take(own_delays).map(|role| own(role).unwrap_or_default());
        let delays: Vec<NodeId> = [Expr::sym("delay")].into_iter().chain(own).map(|f| graph.insert(&f)).collect();
        let delay = with_derivatives(&mut graph, &delays, free);
        let delay = compile(&graph, &delay)?;
        let whole = Equations {
            states,
            visible,
            poses: visible - speeds.len(),
            is_forced: self.forced.is_some(),
            inputs,
            derived,
            edges,
            free: free.to_vec(),
            constants,
            rates: plain,
            jacobian,
            live: read,
            own_slopes,
            has_own_slope,
            outputs,
            quantities,
            quantity_count: self.measured.len(),
            delay,
            own_delays,
            fineness: Fineness::default(),
            heading_comes_first,
            is_linear_in_hidden,
            carried: None,
        };
        let carried = carried.map(|(live, jacobian)| Box::new(Equations { live, jacobian, ..whole.clone() }));
        Ok(Equations { carried, ..whole })
    }
}

fn undefined_name(name: Symbol) -> Error {
    Error::input(format!("a formula uses {name}, which nothing defines"))
        .help("declare it as a parameter or a state, or correct the name")
}

/// The nodes followed, node by node, by their derivatives with respect to each symbol.
fn with_derivatives(graph: &mut Graph, nodes: &[NodeId], by: &[Symbol]) -> Vec<NodeId> {
    let columns: Vec<Vec<NodeId>> = by.iter().map(|s| graph.derivatives(nodes, s)).collect();
    let row = |i: usize| columns.iter().map(move |c| c[i]);
    nodes.iter().copied().chain((0..nodes.len()).flat_map(row)).collect()
}

/// The states whose rate depends on themselves, and how, of rates that are followed by their derivatives; none where those by the
/// states are not among them.
fn own_slopes(graph: &Graph, nodes: &[NodeId], states: &[Symbol], by: &[Symbol]) -> Vec<(usize, NodeId)> {
    let column = |state: &Symbol| by.iter().position(|s| s == state);
    let own = |(i, state): (usize, &Symbol)| Some((i, nodes[states.len() + i * by.len() + column(state)?]));
    states.iter().enumerate().filter_map(own).filter(|(_, node)| !graph.is_zero(*node)).collect()
}

/// Which of the derivatives that follow so many rates are not zero by their formula.
fn live(graph: &Graph, nodes: &[NodeId], rates: usize) -> Vec<usize> {
    (rates..nodes.len()).filter(|k| !graph.is_zero(nodes[*k])).collect()
}

/// Whether states are a pose alone, the rate of its heading made of no state, and those of its place of the heading at most.
fn heading_comes_first(graph: &Graph, rates: &[NodeId], states: &[Symbol]) -> bool {
    let reads = |i: usize, j: usize| graph.reads(rates[i], &states[j]);
    let direction = state::DIRECTION;
    states.len() == 3
        && (0..3).all(|j| !reads(direction, j))
        && state::PLACE.iter().all(|i| state::PLACE.iter().all(|j| !reads(*i, *j)))
}

/// Whether the rates behind the first ones, followed by so many derivatives each, are linear in some of the states.
fn is_linear(graph: &mut Graph, nodes: &[NodeId], hidden: &[Symbol], [visible, width]: [usize; 2]) -> bool {
    let n = visible + hidden.len();
    if width < n {
        return false;
    }
    let of = |i: usize| n + i * width;
    let own: Vec<NodeId> = (visible..n).flat_map(|i| nodes[of(i) + visible..of(i) + n].to_vec()).collect();
    hidden.iter().all(|h| graph.derivatives(&own, h).into_iter().all(|node| graph.is_zero(node)))
}

/// Rates and derivatives without what only the pose is moved by; `None` where hidden states, or the steps that they
/// are integrated in, ask for the pose.
fn carried(
    graph: &mut Graph,
    nodes: &[NodeId],
    live: &[usize],
    [visible, n, width]: [usize; 3],
) -> Option<Vec<NodeId>> {
    let is_live = |i: usize, j: usize| live.binary_search(&(n + i * width + j)).is_ok();
    let mut asked =
        (0..n).filter(|i| *i == state::DIRECTION || *i >= visible).flat_map(|i| (0..visible).map(move |j| (i, j)));
    let steps = (0..visible).any(|i| is_live(i, i));
    if width < n || steps || asked.any(|(i, j)| is_live(i, j)) {
        return None;
    }
    let zero = graph.insert(&Expr::int(0));
    let kept = |k: usize| k == state::DIRECTION || (visible..n).contains(&k) || k >= n + visible * width;
    Some(nodes.iter().enumerate().map(|(k, node)| if kept(k) { *node } else { zero }).collect())
}
