//! The pose that a goal speaks of: what the sensor measures of the tractor, or the axle of a trailer.

use crate::error::{Error, Result};
use crate::formula::{Expr, Fun, Graph, Program, Symbol};
use crate::model::{Equations, Model, trailer_heading};
use nalgebra::DMatrix;

/// A pose as a function of the states, with its derivatives.
pub struct TrackedPoint {
    program: Program,
    constants: Vec<f64>,
    states: usize,
}

impl TrackedPoint {
    /// What the sensor measures of the tractor for 0, else the middle of a trailer's axle and the trailer's heading.
    ///
    /// # Errors
    /// When the model has no such trailer.
    pub fn of(model: &Model, equations: &Equations, trailer: usize) -> Result<Self> {
        if trailer > model.trailer_count() {
            let message =
                format!("the model has {} trailers, and the goal is of number {trailer}", model.trailer_count());
            return Err(Error::input(message).help("0 is the tractor, 1 the trailer nearest to it"));
        }
        let mut graph = Graph::default();
        model.definitions()?.insert_into(&mut graph)?;
        let wanted: Vec<Expr> = match trailer {
            0 => crate::model::observation::outputs(0).map(|y| Expr::sym(y.symbol())).collect(),
            _ => axle(trailer).to_vec(),
        };
        let nodes: Vec<_> = wanted.iter().map(|e| graph.insert(e)).collect();
        let columns: Vec<_> = equations.states.iter().map(|s| graph.derivatives(&nodes, s)).collect();
        let all: Vec<_> = nodes.iter().copied().chain((0..3).flat_map(|i| columns.iter().map(move |c| c[i]))).collect();
        let (names, constants): (Vec<Symbol>, Vec<f64>) = model.values().into_iter().unzip();
        let slots = [&equations.states[..], &names].concat();
        let program = Program::compile(&graph, &slots, &all)
            .map_err(|name| Error::input(format!("the goal's place uses {name}, which nothing defines")))?;
        Ok(Self { program, constants, states: equations.states.len() })
    }

    /// x, y, heading, and their derivatives by the states.
    pub fn at(&self, z: &[f64]) -> ([f64; 3], DMatrix<f64>) {
        let mut found = vec![0.0; 3 + 3 * self.states];
        self.program.run(&[z, &self.constants].concat(), &mut self.program.registers(), &mut found);
        ([found[0], found[1], found[2]], DMatrix::from_row_slice(3, self.states, &found[3..]))
    }
}

/// Place and heading of a trailer's axle: back to each hitch, back along each trailer.
fn axle(trailer: usize) -> [Expr; 3] {
    let heading = |i: usize| if i == 0 { Expr::sym("phi") } else { Expr::sym(trailer_heading(i)) };
    let length = |stem: &str, i: usize| Expr::sym(Symbol::new(&format!("{stem}_{i}")));
    let place = |name: &str, f: Fun| {
        (1..=trailer).fold(Expr::sym(name), |at, i| {
            let hitch = &length("c", i) * &Expr::call(f, &heading(i - 1));
            let bar = &length("d", i) * &Expr::call(f, &heading(i));
            &(&at - &hitch) - &bar
        })
    };
    [place("x", Fun::Cos), place("y", Fun::Sin), heading(trailer)]
}
