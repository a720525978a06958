//! A formula compiled to a flat list of instructions.

use super::float;
use super::rational::{BigRational, nearest_f64};
use super::{Fun, Graph, NodeId, Op, Scalar, Symbol};

/// One instruction; it writes the register of its own position.
#[derive(Clone, Copy, Debug)]
pub(super) enum Instruction {
    Input(u32),
    Constant(u32),
    Neg(u32),
    Add(u32, u32),
    Sub(u32, u32),
    Mul(u32, u32),
    Div(u32, u32),
    Square(u32),
    Pow(u32, i32),
    Call(Fun, u32),
}

/// Formulas compiled once and run many times: inputs by position, shared sub-expressions computed once.
///
/// A result that is undefined is NaN; a division by zero or an overflow never comes back as a number.
///
/// ```
/// use creepage::formula::{Expr, Graph, Program};
/// let mut g = Graph::default();
/// let v = g.insert(&Expr::parse("r*theta'*cos(phi)").unwrap());
/// let p = Program::compile(&g, &["r".into(), "theta'".into(), "phi".into()], &[v]).unwrap();
/// let mut out = [0.0];
/// p.run(&[0.5, 2.0, 0.0], &mut p.registers(), &mut out);
/// assert_eq!(out, [1.0]);
/// ```
#[derive(Clone, Debug)]
pub struct Program {
    pub(super) code: Vec<Instruction>,
    pub(super) constants: Vec<f64>,
    exact: Vec<BigRational>,
    pub(super) outputs: Vec<u32>,
    pub(super) inputs: usize,
}

impl Program {
    /// Compiles nodes of a graph; `inputs` says which symbol stands at which position.
    ///
    /// # Errors
    /// The name of a symbol that is no input.
    pub fn compile(graph: &Graph, inputs: &[Symbol], outputs: &[NodeId]) -> Result<Program, Symbol> {
        let count = outputs.iter().max().map_or(0, |m| m + 1);
        let needed = graph.reachable(outputs, count);
        let mut register = vec![u32::MAX; count];
        let mut program =
            Program { code: vec![], constants: vec![], exact: vec![], outputs: vec![], inputs: inputs.len() };
        for id in (0..count).filter(|id| needed[*id]) {
            let instruction = program.instruction(graph.op(id), inputs, &register)?;
            register[id] = program.code.len() as u32;
            program.code.push(instruction);
        }
        program.outputs = outputs.iter().map(|id| register[*id]).collect();
        Ok(program)
    }

    fn instruction(&mut self, op: &Op, inputs: &[Symbol], register: &[u32]) -> Result<Instruction, Symbol> {
        let at = |x: &NodeId| register[*x];
        Ok(match op {
            Op::Num(v) => {
                self.constants.push(float::finite(nearest_f64(v)));
                self.exact.push(v.clone());
                Instruction::Constant(self.constants.len() as u32 - 1)
            }
            Op::Sym(s) => {
                let slot = inputs.iter().position(|i| i == s).ok_or_else(|| s.clone())?;
                Instruction::Input(slot as u32)
            }
            Op::Neg(x) => Instruction::Neg(at(x)),
            Op::Add(a, b) => Instruction::Add(at(a), at(b)),
            Op::Sub(a, b) => Instruction::Sub(at(a), at(b)),
            Op::Mul(a, b) => Instruction::Mul(at(a), at(b)),
            Op::Div(a, b) => Instruction::Div(at(a), at(b)),
            Op::Pow(x, 2) => Instruction::Square(at(x)),
            Op::Pow(x, n) => Instruction::Pow(at(x), *n),
            Op::Call(f, x) => Instruction::Call(*f, at(x)),
        })
    }

    /// How many instructions one run takes.
    pub fn len(&self) -> usize {
        self.code.len()
    }

    /// Whether there is nothing to compute.
    pub fn is_empty(&self) -> bool {
        self.code.is_empty()
    }

    /// How many results a run gives.
    pub fn outputs(&self) -> usize {
        self.outputs.len()
    }

    /// Working memory for [`Program::run`]; make it once, use it for every run.
    pub fn registers(&self) -> Vec<f64> {
        vec![0.0; self.code.len()]
    }

    /// Runs the program on floating-point numbers.
    ///
    /// # Panics
    /// When a slice is shorter than the program's inputs, registers or outputs: a fault of the caller.
    pub fn run(&self, inputs: &[f64], registers: &mut [f64], outputs: &mut [f64]) {
        for (k, instruction) in self.code.iter().enumerate() {
            let r = |i: u32| registers[i as usize];
            registers[k] = match *instruction {
                Instruction::Input(i) => inputs[i as usize],
                Instruction::Constant(i) => self.constants[i as usize],
                Instruction::Neg(a) => -r(a),
                Instruction::Add(a, b) => r(a) + r(b),
                Instruction::Sub(a, b) => r(a) - r(b),
                Instruction::Mul(a, b) => r(a) * r(b),
                Instruction::Div(a, b) => float::quotient(r(a), r(b)),
                Instruction::Square(a) => r(a) * r(a),
                Instruction::Pow(a, n) => Scalar::powi(&r(a), n),
                Instruction::Call(f, a) => float::call(f, r(a)),
            };
        }
        for (out, i) in outputs.iter_mut().zip(&self.outputs) {
            *out = float::finite(registers[*i as usize]);
        }
    }

    /// Runs the program in any carrier.
    pub fn run_in<S: Scalar>(&self, inputs: &[S]) -> Vec<S> {
        let mut registers: Vec<S> = Vec::with_capacity(self.code.len());
        for instruction in &self.code {
            let r = |i: u32| &registers[i as usize];
            let value = match *instruction {
                Instruction::Input(i) => inputs[i as usize].clone(),
                Instruction::Constant(i) => S::number(&self.exact[i as usize]),
                Instruction::Neg(a) => r(a).neg(),
                Instruction::Add(a, b) => r(a).add(r(b)),
                Instruction::Sub(a, b) => r(a).sub(r(b)),
                Instruction::Mul(a, b) => r(a).mul(r(b)),
                Instruction::Div(a, b) => r(a).div(r(b)),
                Instruction::Square(a) => r(a).mul(r(a)),
                Instruction::Pow(a, n) => r(a).powi(n),
                Instruction::Call(f, a) => S::call(f, r(a)),
            };
            registers.push(value);
        }
        self.outputs.iter().map(|i| registers[*i as usize].clone()).collect()
    }

    /// Whether the program reads an input at all.
    pub fn reads(&self, input: usize) -> bool {
        self.code.iter().any(|i| matches!(i, Instruction::Input(slot) if *slot as usize == input))
    }

    /// How many inputs a run takes.
    pub fn inputs(&self) -> usize {
        self.inputs
    }
}
