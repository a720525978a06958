//! The equations of motion of many cases, compiled for lanes.

use super::lanes::{LANES, Lane};
use crate::error::{Error, Result};
use crate::formula::{
    BigRational, Changes, Expr, Graph, Isa, Lanes, Memory, NodeId, Op, Program, Symbol, exact_f64, nearest_f64,
};
use crate::model::Model;
use crate::motion::Signals;
use std::collections::BTreeMap;

/// What drives every case.
///
/// | name in a formula | unit | meaning |
/// |---|---|---|
/// | `t` | s | time |
/// | `log.NAME` | | the logged channel NAME |
/// | a constant of the inputs, fixed or varied | | its value |
/// | a parameter of the model, such as `rotation_creep.e_rc` | SI | its value in the case |
#[derive(Clone, Debug, Default)]
pub struct EnsembleInputs {
    /// A formula for each input of the model, in the model's order.
    pub formulas: Vec<Expr>,
    /// Values of constants; those that vary need none.
    pub constants: BTreeMap<Symbol, f64>,
    /// Logged channels and their names.
    pub log: Option<(Vec<String>, Signals)>,
    /// Times at which a formula has a kink.
    pub knots: Vec<f64>,
}

/// A constant of the inputs' formulas under a name that no model has.
fn constant(name: &Symbol) -> Symbol {
    Symbol::new(&format!("input {name}"))
}

/// Rates and readings over lanes.
pub(crate) struct LaneEquations {
    /// States.
    pub n: usize,
    pub visible: usize,
    pub hidden_names: Vec<String>,
    pub rates: Lanes,
    /// Visible readings, v_l, v_t, phi', then the inputs and what is derived of them.
    pub readings: Lanes,
    /// States that the rates read.
    pub read: Vec<usize>,
    pub log: Option<Signals>,
    /// The delay, where it is the same for all cases.
    pub delay: f64,
    /// Whether the delay varies and the inputs are logged or have kinks, so that cases meet them at different times.
    pub own_clocks: bool,
    /// Whether the sensor shows the states themselves.
    plain_sensor: bool,
    time_slot: usize,
}

/// What a case may vary.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Varied {
    /// A symbol of the model's formulas, such as `rotation_creep.e_rc`.
    Model(Symbol),
    /// A constant of the inputs' formulas.
    Input(Symbol),
    /// A component of the measured pose it starts with: x, y, heading, trailer headings.
    Initial(usize),
}

impl Varied {
    /// Its name in the formulas, if it stands in them.
    fn symbol(&self) -> Option<Symbol> {
        match self {
            Varied::Model(s) => Some(s.clone()),
            Varied::Input(s) => Some(constant(s)),
            Varied::Initial(_) => None,
        }
    }
}

fn exact(value: f64) -> Result<BigRational> {
    exact_f64(value).ok_or_else(|| Error::input("a parameter is not a finite number"))
}

impl LaneEquations {
    /// Compiles; where the values of a case are given, they are put in as if they did not vary.
    pub fn new(model: &Model, inputs: &EnsembleInputs, varied: &[Varied], settled: Option<&[f64]>) -> Result<Self> {
        let mut graph = Graph::default();
        let moving: Vec<Symbol> = varied.iter().filter_map(Varied::symbol).collect();
        let settled = varied.iter().zip(settled.unwrap_or_default()).filter_map(|(v, x)| Some((v.symbol()?, *x)));
        let fixed = model.values().into_iter().chain(inputs.constants.iter().map(|(s, v)| (constant(s), *v)));
        for (symbol, value) in fixed.filter(|(s, _)| !moving.contains(s)).chain(settled) {
            let node = graph.number(exact(value)?);
            graph.define(symbol, node);
        }
        let definitions = model.definitions()?;
        let delay = delay_of(&definitions, &graph)?;
        let varying_delay = delay.as_number().is_none();
        let own_clocks = varying_delay && (inputs.log.is_some() || !inputs.knots.is_empty());
        let delayed = if own_clocks { Expr::int(0) } else { delay.clone() };
        let clock = Symbol::new("clock t");
        let time = graph.insert(&(&Expr::sym(clock.clone()) - &delayed));
        let own = |s: &Symbol| inputs.constants.contains_key(s) || varied.contains(&Varied::Input(s.clone()));
        let names = |formula: &Expr| {
            formula.substitute(&|s| match s.as_str() {
                "t" => Some(Expr::sym(clock_name())),
                _ => own(s).then(|| Expr::sym(constant(s))),
            })
        };
        graph.define(clock_name(), time);
        let mut driven = Vec::new();
        for (input, formula) in model.inputs.iter().zip(&inputs.formulas) {
            let node = graph.insert(&names(formula));
            graph.define(Symbol::new(input), node);
            driven.push(node);
        }
        let channels: Vec<String> =
            inputs.log.iter().flat_map(|(names, _)| names).map(|n| format!("log.{n}")).collect();
        for derived in model.logged_and_derived(&definitions).split_off(model.inputs.len()) {
            let of = model.inputs.iter().position(|i| Symbol::new(i).rate() == derived);
            let node = of.map_or(time, |c| rate_of(&mut graph, driven[c], &clock, &channels));
            graph.define(derived, node);
            driven.push(node);
        }
        definitions.insert_into(&mut graph)?;
        let (states, visible) = (model.states(), 3 + model.trailer_count());
        let rates: Vec<NodeId> = model.state_rates().iter().map(|rate| graph.insert(rate)).collect();
        let sensor =
            ["x_m", "y_m", "heading_m"].map(Symbol::from).into_iter().chain(states[3..visible].iter().cloned());
        let mut readings: Vec<NodeId> = sensor.map(|s| graph.insert(&Expr::sym(s))).collect();
        let shows_state = |(node, s): (&NodeId, &Symbol)| matches!(graph.op(*node), Op::Sym(name) if name == s);
        let plain_sensor = readings.iter().zip(&states).all(shows_state);
        readings.extend(["v_l", "v_t", "phi'"].map(|s| graph.insert(&Expr::sym(s))));
        readings.extend(driven);
        let channels = channels.iter().flat_map(|n| [Symbol::new(n), Symbol::new(n).rate()]);
        // A component of the initial pose has a slot too, so that slots and cases agree; no formula reads it.
        let slot = |v: &Varied| v.symbol().unwrap_or_else(|| Symbol::new("initial pose"));
        let slots: Vec<Symbol> =
            states.iter().cloned().chain(varied.iter().map(slot)).chain([clock]).chain(channels).collect();
        let changes: Vec<Changes> = (0..slots.len())
            .map(|i| match i {
                i if i < states.len() => Changes::Lane,
                i if i < states.len() + varied.len() => Changes::Case,
                _ => Changes::Clock,
            })
            .collect();
        let compile = |nodes: &[NodeId]| {
            Program::compile(&graph, &slots, nodes)
                .map_err(|name| Error::input(format!("a formula uses {}, which nothing defines", shown(&name))))
        };
        let rates = compile(&rates)?;
        let read = (0..states.len()).filter(|i| rates.reads(*i)).collect();
        let readings = compile(&readings)?;
        Ok(Self {
            n: states.len(),
            visible,
            hidden_names: states[visible..].iter().map(ToString::to_string).collect(),
            rates: Lanes::new(&rates, &changes),
            readings: Lanes::new(&readings, &changes),
            read,
            log: inputs.log.as_ref().map(|(_, signals)| signals.clone()),
            delay: delay.as_number().map_or(0.0, |d| nearest_f64(&d)),
            own_clocks,
            plain_sensor,
            time_slot: states.len() + varied.len(),
        })
    }

    /// Whether the pose that is measured is that of the states, and there are no others.
    pub fn starts_as_measured(&self) -> bool {
        self.plain_sensor && self.n == self.visible
    }

    /// Computes the readings at a time.
    pub fn read(&self, t: f64, z: &[Lane], memory: &mut Memory<LANES>, isa: Isa) {
        let channels = self.log.as_ref().map_or(0, |l| l.channels());
        z.iter().enumerate().for_each(|(i, lane)| *memory.input(i) = *lane);
        self.set_clock(t, memory, &mut vec![0.0; channels], &mut vec![0.0; channels]);
        self.readings.run(memory, isa);
    }

    /// Sets time and logged inputs for all lanes.
    #[inline(always)]
    pub fn set_clock(&self, t: f64, memory: &mut Memory<LANES>, logged: &mut [f64], slopes: &mut [f64]) {
        memory.clock(self.time_slot, t);
        if let Some(log) = &self.log {
            log.at(t - self.delay, logged, slopes);
            for (c, value) in logged.iter().enumerate() {
                memory.clock(self.time_slot + 1 + 2 * c, *value);
                memory.clock(self.time_slot + 2 + 2 * c, slopes[c]);
            }
        }
    }
}

/// The rate of what drives: by the time, and by the slopes of logged channels.
fn rate_of(graph: &mut Graph, driven: NodeId, clock: &Symbol, channels: &[String]) -> NodeId {
    let mut rate = graph.derivatives(&[driven], clock)[0];
    for name in channels {
        let name = Symbol::new(name);
        let (by, slope) = (graph.derivatives(&[driven], &name)[0], graph.symbol(name.rate()));
        let part = graph.mul(by, slope);
        rate = graph.add(rate, part);
    }
    rate
}

fn clock_name() -> Symbol {
    Symbol::new("delayed t")
}

fn shown(name: &Symbol) -> String {
    name.as_str().trim_start_matches("input ").to_string()
}

/// The delay of the inputs as a formula of what varies.
fn delay_of(definitions: &crate::mechanism::Definitions, fixed: &Graph) -> Result<Expr> {
    let mut graph = fixed.clone();
    definitions.insert_into(&mut graph)?;
    let node = graph.insert(&Expr::sym("delay"));
    Ok(graph.expr(node))
}
