//! The equations of motion with forces compiled: masses, rows and forces of the derivation to programs.

use super::derive::Derived;
use super::observed::{Observed, undefined};
use super::system::System;
use super::{Dynamics, Law};
use crate::error::{Error, Result};
use crate::formula::{Expr, Graph, NodeId, Program, Symbol};

impl Dynamics {
    /// Compiles the equations of motion.
    ///
    /// ```
    /// use creepage::dynamics::{Dynamics, Masses};
    /// use creepage::model::Model;
    /// let disk = Model::new("disk", &[("wheel_radius", 0.5)]).unwrap();
    /// let masses = Masses { mass: 2.0, wheels: [("theta'".into(), 0.25)].into(), ..Masses::default() };
    /// let disk = Dynamics::new(&disk, &masses).unwrap().driven_by(&["wheel_torque"]).unwrap().compile().unwrap();
    /// // A torque of 1.5 N·m on a disk that rolls: v' = (τ/r)/(m + J/r²) = 1 m/s².
    /// assert!((disk.rates(&[0.0; 4], &[1.5], &[0.0])[2] - 1.0).abs() < 1e-12);
    /// ```
    ///
    /// # Errors
    /// When a formula uses a name that nothing defines, or the steering cannot be given as it is.
    pub fn compile(&self) -> Result<System> {
        let mut d = self.derive(true)?;
        let (free, steering) = (self.coordinates(), self.steering());
        if self.by_rate && self.prescribed.iter().any(|q| self.steered_otherwise(q)) {
            return Err(Error::input("this steering is a formula of its input and cannot be given by its rate")
                .help("give the steering angle"));
        }
        self.check_steered_rows()?;
        let rate = |s: &[Symbol]| s.iter().map(Symbol::rate).collect::<Vec<_>>();
        let memory: Vec<Symbol> =
            self.contacts.iter().enumerate().filter_map(|(i, c)| c.memory(i + 1)).map(|(s, _)| s).collect();
        let forces: Vec<Symbol> = self.driven.iter().map(|f| Symbol::new(&f.role)).collect();
        let states = [&free[..], &rate(&free), &memory].concat();
        let given = [&self.prescribed[..], &rate(&self.prescribed), &forces].concat();
        let (names, constants): (Vec<Symbol>, Vec<f64>) = self.values().into_iter().unzip();
        let unknown = unknowns(&free, self.ideal().count());
        let slots = [&states[..], &given, &unknown, &names].concat();
        let compile = |graph: &Graph, nodes: &[NodeId]| Program::compile(graph, &slots, nodes).map_err(undefined);
        let difference: Vec<NodeId> = d.force.iter().zip(&d.bias).map(|(q, h)| d.graph.sub(*q, *h)).collect();
        let motion = compile(&d.graph, &[&d.mass[..], &difference, &d.rows, &d.drift, &d.memory].concat())?;
        let mut all: Vec<Symbol> = states;
        all.extend(if self.by_rate { self.prescribed.clone() } else { vec![] });
        let slopes = residual_slopes(&mut d, &difference, &unknown, &all);
        let slopes = compile(&d.graph, &slopes)?;
        let observed = Observed::compile(self, &mut d.graph, &slots)?;
        let prescribed = self.prescribed.len();
        Ok(System {
            states: all,
            inputs: self.inputs(),
            n: free.len(),
            ideal: self.ideal().count(),
            line: self.model.vehicle.line,
            observed,
            forces: forces.len(),
            memory: memory.len(),
            by_rate: self.by_rate,
            constants,
            motion,
            slopes,
            steering: self.steering_program(&steering)?,
            prescribed,
        })
    }

    fn steered_otherwise(&self, q: &Symbol) -> bool {
        let formula = self.model.vehicle.define.get(q).map(|d| &d.formula);
        !formula.is_some_and(|f| self.steering().iter().any(|s| *f == Expr::sym(s.as_str())))
    }

    /// An ideal contact behind the axis of a steered wheel is swung by the steering itself, whose acceleration is not
    /// among the inputs.
    fn check_steered_rows(&self) -> Result<()> {
        let swung = |c: &super::Contact| self.prescribed.iter().any(|q| !c.slip.coefficient(&q.rate()).is_zero());
        match self.ideal().find(|(_, c)| swung(c)) {
            None => Ok(()),
            Some((_, c)) => Err(c.swung_error()),
        }
    }

    /// Prescribed coordinates and their rates from logged angles and their slopes.
    fn steering_program(&self, steering: &[String]) -> Result<Program> {
        let mut graph = Graph::default();
        let names: Vec<Symbol> = steering.iter().map(|s| Symbol::new(s)).collect();
        let formula = |q: &Symbol| self.model.vehicle.define.get(q).map(|d| d.formula.clone()).unwrap_or_default();
        let angles: Vec<NodeId> = self.prescribed.iter().map(|q| graph.insert(&formula(q))).collect();
        let mut rates: Vec<NodeId> = angles.iter().map(|_| graph.insert(&Expr::int(0))).collect();
        for name in &names {
            let slope = graph.symbol(name.rate());
            for (rate, by) in rates.iter_mut().zip(graph.derivatives(&angles, name)) {
                let term = graph.mul(by, slope);
                *rate = graph.add(*rate, term);
            }
        }
        let values: Vec<Symbol> = self.values().into_keys().collect();
        let slopes: Vec<Symbol> = names.iter().map(Symbol::rate).collect();
        Program::compile(&graph, &[names, slopes, values].concat(), &[angles, rates].concat()).map_err(undefined)
    }
}

/// Symbols of accelerations and multipliers.
fn unknowns(free: &[Symbol], ideal: usize) -> Vec<Symbol> {
    let accelerations = free.iter().map(|q| q.rate().rate());
    accelerations.chain((1..=ideal).map(|j| Law::symbol("multiplier", j))).collect()
}

/// ∂/∂z of what the unknowns make zero: M·q̈ − Aᵀλ − (Q − h) and A·q̈ + Ȧq̇, then of the rates of the laws' states.
fn residual_slopes(d: &mut Derived, difference: &[NodeId], unknown: &[Symbol], states: &[Symbol]) -> Vec<NodeId> {
    let n = difference.len();
    let symbols: Vec<NodeId> = unknown.iter().map(|s| d.graph.symbol(s.clone())).collect();
    let (accelerations, multipliers) = symbols.split_at(n);
    let mut residual = Vec::new();
    for (i, difference) in difference.iter().enumerate() {
        let mut sum = d.graph.neg(*difference);
        for (k, a) in accelerations.iter().enumerate() {
            let term = d.graph.mul(d.mass[i * n + k], *a);
            sum = d.graph.add(sum, term);
        }
        for (j, multiplier) in multipliers.iter().enumerate() {
            let term = d.graph.mul(d.rows[j * n + i], *multiplier);
            sum = d.graph.sub(sum, term);
        }
        residual.push(sum);
    }
    for (j, drift) in d.drift.clone().into_iter().enumerate() {
        let mut sum = drift;
        for (k, a) in accelerations.iter().enumerate() {
            let term = d.graph.mul(d.rows[j * n + k], *a);
            sum = d.graph.add(sum, term);
        }
        residual.push(sum);
    }
    residual.extend(d.memory.clone());
    let columns: Vec<Vec<NodeId>> = states.iter().map(|s| d.graph.derivatives(&residual, s)).collect();
    (0..residual.len()).flat_map(|i| columns.iter().map(move |c| c[i])).collect()
}
