//! The equations of motion of a model, compiled.

use super::{Model, trailer_heading};
use crate::error::{Error, Result};
use crate::formula::{Changes, Expr, Graph, Isa, Lanes, Memory, NodeId, Program, Symbol};
use std::collections::BTreeMap;

/// dz/dt = f(z, u, p) and y = h(z, p) with their exact derivatives, compiled once.
///
/// | symbol | meaning |
/// |---|---|
/// | z | pose x, y, phi, trailer headings, then states that no sensor sees |
/// | u | logged inputs, looked up `delay` seconds in the past |
/// | p | free parameters |
/// | y | measured x, y, heading, trailer headings |
#[derive(Clone, Debug)]
pub struct Equations {
    /// States: pose, trailer headings, hidden states.
    pub states: Vec<Symbol>,
    /// How many of the states are measured (pose and trailer headings).
    pub visible: usize,
    /// Logged inputs.
    pub inputs: Vec<Symbol>,
    /// Free parameters.
    pub free: Vec<Symbol>,
    constants: Vec<f64>,
    rates: Lanes,
    jacobian: Lanes,
    outputs: Lanes,
    delay: Lanes,
}

/// How far beside a kink derivatives are taken, as a share of one.
const BESIDE: f64 = 1e-9;

impl Model {
    /// Values of every fixed symbol of the model's formulas.
    pub fn values(&self) -> BTreeMap<Symbol, f64> {
        let mut values: BTreeMap<Symbol, f64> = self.parameters.iter().map(|(k, v)| (Symbol::new(k), *v)).collect();
        for (i, t) in (self.vehicle.trailers.len() + 1..).zip(&self.trailers) {
            values.insert(Symbol::new(&format!("trailer_length_{i}")), t.length);
            values.insert(Symbol::new(&format!("hitch_offset_{i}")), t.hitch);
        }
        values.insert("sensor.a".into(), self.sensor.lever_arm[0]);
        values.insert("sensor.b".into(), self.sensor.lever_arm[1]);
        values.insert("sensor.heading_offset".into(), self.sensor.heading_offset);
        for e in &self.effects {
            values.extend(e.parameters().into_iter().zip(e.values.iter().copied()));
        }
        values
    }

    /// The symbols of the states: pose, trailer headings, hidden states: coordinates of its own, states of effects.
    pub fn states(&self) -> Vec<Symbol> {
        let mut states: Vec<Symbol> = ["x", "y", "phi"].map(Symbol::from).to_vec();
        states.extend((1..=self.trailer_count()).map(trailer_heading));
        states.extend(self.own_states());
        states.extend(self.effects.iter().flat_map(|e| e.states()).map(|(s, _)| s));
        states
    }

    /// Compiles the equations of motion with the given symbols left free.
    ///
    /// # Errors
    /// When a formula uses a name that nothing defines, or formulas refer to each other in a circle.
    pub fn equations(&self, free: &[Symbol]) -> Result<Equations> {
        let inputs: Vec<Symbol> = self.inputs.iter().map(|i| Symbol::new(i)).collect();
        self.compiled(free, &[&self.states()[..], &inputs, free].concat())
    }

    /// The equations of motion for a simulation: the rates have no derivatives where nothing asks for them. Those of a
    /// train of N trailers are N² formulas.
    pub(crate) fn equations_to_simulate(&self) -> Result<Equations> {
        let hidden = self.effects.iter().any(|e| !e.states().is_empty());
        if hidden { self.equations(&[]) } else { self.compiled(&[], &[]) }
    }

    /// The equations with the derivatives of the rates by some symbols.
    fn compiled(&self, free: &[Symbol], by: &[Symbol]) -> Result<Equations> {
        let definitions = self.definitions()?;
        let mut graph = Graph::default();
        definitions.insert_into(&mut graph)?;
        let states = self.states();
        let visible = 3 + self.trailer_count();
        let mut rates: Vec<NodeId> = states[..visible].iter().map(|s| graph.insert(&Expr::sym(s.rate()))).collect();
        rates.extend(self.own_states().iter().map(|q| graph.insert(&Expr::sym(q.rate()))));
        for (_, rate) in self.effects.iter().flat_map(|e| e.states()) {
            rates.push(graph.insert(&rate));
        }
        let inputs: Vec<Symbol> = self.inputs.iter().map(|i| Symbol::new(i)).collect();
        let values: Vec<(Symbol, f64)> = self.values().into_iter().filter(|(s, _)| !free.contains(s)).collect();
        let slots: Vec<Symbol> =
            [&states[..], &inputs, free].concat().into_iter().chain(values.iter().map(|(s, _)| s.clone())).collect();
        // Parameters are set once for a workspace; what hangs on them alone is computed then.
        let moving = states.len() + inputs.len();
        let changes: Vec<Changes> =
            (0..slots.len()).map(|i| if i < moving { Changes::Lane } else { Changes::Case }).collect();
        let compile = |graph: &Graph, nodes: &[NodeId]| {
            let program = Program::compile(graph, &slots, nodes).map_err(|name| {
                Error::input(format!("a formula uses {name}, which nothing defines"))
                    .help("declare it as a parameter or a state, or correct the name")
            })?;
            Ok::<_, Error>(Lanes::new(&program, &changes))
        };
        let plain = compile(&graph, &rates)?;
        let jacobian = with_derivatives(&mut graph, &rates, by);
        let jacobian = compile(&graph, &jacobian)?;
        let mut measured: Vec<NodeId> = ["x_m", "y_m", "heading_m"].map(|s| graph.insert(&Expr::sym(s))).to_vec();
        measured.extend((1..=self.trailer_count()).map(|i| graph.insert(&Expr::sym(trailer_heading(i)))));
        let measured = with_derivatives(&mut graph, &measured, &[&states[..visible], free].concat());
        let outputs = compile(&graph, &measured)?;
        let delay = graph.insert(&Expr::sym("delay"));
        let delay = with_derivatives(&mut graph, &[delay], free);
        let delay = compile(&graph, &delay)?;
        let constants = values.into_iter().map(|(_, v)| v).collect();
        Ok(Equations {
            states,
            visible,
            inputs,
            free: free.to_vec(),
            constants,
            rates: plain,
            jacobian,
            outputs,
            delay,
        })
    }
}

/// The nodes followed, node by node, by their derivatives with respect to each symbol.
fn with_derivatives(graph: &mut Graph, nodes: &[NodeId], by: &[Symbol]) -> Vec<NodeId> {
    let columns: Vec<Vec<NodeId>> = by.iter().map(|s| graph.derivatives(nodes, s)).collect();
    let row = |i: usize| columns.iter().map(move |c| c[i]);
    nodes.iter().copied().chain((0..nodes.len()).flat_map(row)).collect()
}

/// Working memory for one thread that evaluates [`Equations`].
#[derive(Clone, Debug)]
pub struct Workspace {
    rates: Memory<1>,
    jacobian: Memory<1>,
    outputs: Memory<1>,
    delay: Memory<1>,
    results: Vec<f64>,
}

impl Equations {
    /// Number of states.
    pub fn n(&self) -> usize {
        self.states.len()
    }

    /// Memory for evaluating these equations at given parameters.
    pub fn workspace(&self, p: &[f64]) -> Workspace {
        let results = [&self.rates, &self.jacobian, &self.outputs, &self.delay].map(|l| l.outputs());
        Workspace {
            rates: self.memory(&self.rates, p),
            jacobian: self.memory(&self.jacobian, p),
            outputs: self.memory(&self.outputs, p),
            delay: self.memory(&self.delay, p),
            results: vec![0.0; results.into_iter().max().unwrap_or(0)],
        }
    }

    fn memory(&self, lanes: &Lanes, p: &[f64]) -> Memory<1> {
        let mut memory = lanes.memory();
        let moving = self.n() + self.inputs.len();
        for (i, value) in p.iter().chain(&self.constants).enumerate() {
            *memory.input(moving + i) = [*value];
        }
        lanes.begin(&mut memory, Isa::default());
        memory
    }

    fn load(&self, memory: &mut Memory<1>, z: &[f64], u: &[f64]) {
        z.iter().enumerate().for_each(|(i, z)| *memory.input(i) = [*z]);
        u.iter().enumerate().for_each(|(i, u)| *memory.input(self.n() + i) = [*u]);
    }

    /// dz/dt.
    pub fn rates(&self, w: &mut Workspace, z: &[f64], u: &[f64], rates: &mut [f64]) {
        self.load(&mut w.rates, z, u);
        run(&self.rates, &mut w.rates, rates);
    }

    /// dz/dt followed by the rows of its derivatives with respect to (z, u, p).
    ///
    /// At a kink, where |u| has no derivative though the motion is defined, they are those on the side of larger
    /// inputs: a vehicle that stands still is no reason to give a log up.
    pub fn rates_and_jacobian<'w>(&self, w: &'w mut Workspace, z: &[f64], u: &[f64]) -> &'w [f64] {
        self.load(&mut w.jacobian, z, u);
        run(&self.jacobian, &mut w.jacobian, &mut w.results);
        let (n, outputs) = (self.n(), self.jacobian.outputs());
        let defined = |values: &[f64]| values.iter().all(|v| v.is_finite());
        if defined(&w.results[..n]) && !defined(&w.results[n..outputs]) {
            self.beside(w, z, u);
        }
        &w.results[..outputs]
    }

    /// The derivatives a little beside the inputs; the rates stay those of the inputs.
    fn beside(&self, w: &mut Workspace, z: &[f64], u: &[f64]) {
        let n = self.n();
        let rates = w.results[..n].to_vec();
        let beside: Vec<f64> = u.iter().map(|u| u + BESIDE * (1.0 + u.abs())).collect();
        self.load(&mut w.jacobian, z, &beside);
        run(&self.jacobian, &mut w.jacobian, &mut w.results);
        w.results[..n].copy_from_slice(&rates);
    }

    /// What [`Equations::rates_and_jacobian`] gave last.
    pub fn last_jacobian<'w>(&self, w: &'w Workspace) -> &'w [f64] {
        &w.results[..self.jacobian.outputs()]
    }

    /// What the sensor measures, followed by the rows of its derivatives with respect to (visible z, p).
    pub fn outputs<'w>(&self, w: &'w mut Workspace, z: &[f64]) -> &'w [f64] {
        let z = &z[..self.visible];
        self.load(&mut w.outputs, z, &[]);
        run(&self.outputs, &mut w.outputs, &mut w.results);
        &w.results[..self.outputs.outputs()]
    }

    /// The delay of the inputs, s, followed by its derivatives with respect to p.
    pub fn delay<'w>(&self, w: &'w mut Workspace) -> &'w [f64] {
        run(&self.delay, &mut w.delay, &mut w.results);
        &w.results[..self.delay.outputs()]
    }
}

/// Runs a program; what is undefined is NaN.
fn run(lanes: &Lanes, memory: &mut Memory<1>, results: &mut [f64]) {
    lanes.run(memory, Isa::default());
    for (k, result) in results.iter_mut().enumerate().take(lanes.outputs()) {
        let [value] = *lanes.output(memory, k);
        *result = if value.is_finite() { value } else { f64::NAN };
    }
}
