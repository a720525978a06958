//! The inputs that drive a vehicle, as functions of time.

use crate::error::{Error, Result};
use crate::formula::{Changes, Expr, Graph, Isa, Lanes, Program, Symbol};
use crate::motion::Signals;

/// Inputs as functions of time, with their slopes and the times where they are not smooth.
pub trait Drive {
    /// Values and slopes of all inputs at a time.
    fn at(&self, t: f64, value: &mut [f64], slope: &mut [f64]);
    /// Where a derivative of an input jumps, in rising order.
    fn knots(&self) -> &[f64];
    /// How many inputs there are.
    fn channels(&self) -> usize;
    /// What gives the values alone, for many times, with memory of its own.
    fn values(&self) -> impl FnMut(f64, &mut [f64]) {
        let mut slope = vec![0.0; self.channels()];
        move |t, value| self.at(t, value, &mut slope)
    }
    /// The same of L times side by side.
    fn values_at<const L: usize>(&self) -> impl FnMut(&[f64; L], &mut [[f64; L]]) {
        let (mut values, mut one) = (self.values(), vec![0.0; self.channels()]);
        move |t, out| {
            for (l, t) in t.iter().enumerate() {
                values(*t, &mut one);
                out.iter_mut().zip(&one).for_each(|(out, value)| out[l] = *value);
            }
        }
    }
}

impl Drive for Signals {
    fn at(&self, t: f64, value: &mut [f64], slope: &mut [f64]) {
        Signals::at(self, t, value, slope);
    }
    fn knots(&self) -> &[f64] {
        Signals::knots(self)
    }
    fn channels(&self) -> usize {
        Signals::channels(self)
    }
}

/// Inputs given as formulas of the time `t`, with their exact slopes.
///
/// | symbol | unit | meaning |
/// |---|---|---|
/// | t | s | time |
///
/// Where a formula is undefined, so is the input; an integration through it is an error.
///
/// ```
/// use creepage::formula::Expr;
/// use creepage::motion::{Drive, Formulas};
/// let wheel = Expr::parse("u_0 - t/20").unwrap();
/// let inputs = Formulas::new(&[wheel], &[("u_0".into(), 2.0)]).unwrap();
/// let (mut value, mut slope) = ([0.0], [0.0]);
/// inputs.at(4.0, &mut value, &mut slope);
/// assert_eq!((value[0], slope[0]), (1.8, -0.05));
/// ```
#[derive(Clone, Debug)]
pub struct Formulas {
    program: Program,
    /// The values without their slopes.
    values: Lanes,
    constants: Vec<f64>,
    channels: usize,
    knots: Vec<f64>,
}

impl Formulas {
    /// Inputs by their formulas in `t` and named constants.
    ///
    /// # Errors
    /// When a formula uses a name that is neither.
    pub fn new(formulas: &[Expr], constants: &[(Symbol, f64)]) -> Result<Self> {
        let mut graph = Graph::default();
        let values: Vec<_> = formulas.iter().map(|f| graph.insert(f)).collect();
        let slopes = graph.derivatives(&values, &"t".into());
        let slots: Vec<Symbol> = std::iter::once("t".into()).chain(constants.iter().map(|(s, _)| s.clone())).collect();
        let compile = |nodes: &[_]| {
            Program::compile(&graph, &slots, nodes).map_err(|name| {
                Error::input(format!("an input's formula uses {name}, which nothing defines"))
                    .help("the time is called t")
            })
        };
        let mut changes = vec![Changes::Case; slots.len()];
        changes[0] = Changes::Lane;
        let values_alone = Lanes::new(&compile(&values)?, &changes);
        let program = compile(&[values, slopes].concat())?;
        let constants = constants.iter().map(|(_, v)| *v).collect();
        Ok(Self { program, values: values_alone, constants, channels: formulas.len(), knots: vec![] })
    }

    /// The inputs with times at which a formula has a kink; they have to rise.
    pub fn with_knots(self, knots: &[f64]) -> Self {
        Self { knots: knots.to_vec(), ..self }
    }
}

impl Drive for Formulas {
    fn at(&self, t: f64, value: &mut [f64], slope: &mut [f64]) {
        let slots: Vec<f64> = std::iter::once(t).chain(self.constants.iter().copied()).collect();
        let mut out = vec![0.0; 2 * self.channels];
        self.program.run(&slots, &mut self.program.registers(), &mut out);
        value.copy_from_slice(&out[..self.channels]);
        slope.copy_from_slice(&out[self.channels..]);
    }
    fn values(&self) -> impl FnMut(f64, &mut [f64]) {
        let mut values = self.values_at::<1>();
        move |t, value| values(&[t], value.as_chunks_mut().0)
    }
    fn values_at<const L: usize>(&self) -> impl FnMut(&[f64; L], &mut [[f64; L]]) {
        // One time alone fills no vector.
        let (mut memory, isa) = (self.values.memory::<L>(), Isa::for_lanes(L));
        self.constants.iter().enumerate().for_each(|(i, value)| *memory.input(1 + i) = [*value; L]);
        self.values.begin(&mut memory, Isa::default());
        move |t, value| {
            *memory.input(0) = *t;
            self.values.run(&mut memory, isa);
            value.iter_mut().enumerate().for_each(|(k, value)| *value = *self.values.output(&memory, k));
        }
    }
    fn knots(&self) -> &[f64] {
        &self.knots
    }
    fn channels(&self) -> usize {
        self.channels
    }
}
