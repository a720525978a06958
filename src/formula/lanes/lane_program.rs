//! A compiled formula run over blocks of lanes, the interpretation paid once a block.

use super::exec::{self, Run, Step};
use super::isa::Isa;
use super::rows::Rows;

/// What an input of a program changes with; steps that need not be repeated are not.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Changes {
    /// Set once for each block of cases: a parameter.
    Case,
    /// The same for all lanes at an instant: the time, a logged input.
    Clock,
    /// Anything else: a state.
    Lane,
}

/// A [`Program`](crate::formula::Program) arranged to run over blocks of `L` lanes: the interpretation is paid once a block, and the loops over
/// lanes become vector instructions.
///
/// What depends on parameters alone runs once a block of cases, what depends on time alone runs once for all lanes, and
/// sine and cosine of one angle are computed together.
///
/// Results agree with [`Program::run`](crate::formula::Program::run) to rounding: sums and products are the same, a sine or cosine differs by at most
/// 2 units in the last place, a tangent or cotangent by 6, as the standard library's are not the same on every system.
/// Between processors, and whatever the width of their vectors, the results are the same bits.
///
/// ```
/// use creepage::formula::{Changes, Expr, Graph, Isa, Lanes, Program};
/// let mut g = Graph::default();
/// let v = g.insert(&Expr::parse("r*theta'*cos(phi)").unwrap());
/// let p = Program::compile(&g, &["r".into(), "theta'".into(), "phi".into()], &[v]).unwrap();
/// let lanes = Lanes::new(&p, &[Changes::Case, Changes::Clock, Changes::Lane]);
/// let mut memory = lanes.memory::<4>();
/// *memory.input(0) = [0.5, 1.0, 1.5, 2.0];
/// *memory.input(2) = [0.0; 4];
/// memory.clock(1, 2.0);
/// lanes.begin(&mut memory, Isa::best());
/// lanes.run(&mut memory, Isa::best());
/// assert_eq!(lanes.output(&memory, 0), &[1.0, 2.0, 3.0, 4.0]);
/// ```
#[derive(Clone, Debug)]
pub struct Lanes {
    pub(super) constants: Vec<f64>,
    pub(super) inputs: usize,
    /// Once a block of cases.
    pub(super) begin: Vec<Step>,
    /// Once an instant, one lane wide.
    pub(super) instant: Vec<Step>,
    /// From a register of the instant to one of the lanes.
    pub(super) handed: Vec<(u32, u32)>,
    pub(super) body: Vec<Step>,
    pub(super) outputs: Vec<u32>,
    pub(super) registers: usize,
    pub(super) instant_registers: usize,
}

/// Registers of one thread that runs [`Lanes`].
#[derive(Clone, Debug)]
pub struct Memory<const L: usize> {
    block: Rows<L>,
    instant: Rows<1>,
}

impl<const L: usize> Memory<L> {
    /// The lanes of an input.
    #[inline(always)]
    pub fn input(&mut self, slot: usize) -> &mut [f64; L] {
        &mut self.block[slot]
    }

    /// Sets an input that is the same for all lanes.
    #[inline(always)]
    pub fn clock(&mut self, slot: usize, value: f64) {
        self.instant[slot] = [value];
    }
}

impl Lanes {
    /// Working memory, constants in place.
    pub fn memory<const L: usize>(&self) -> Memory<L> {
        let (mut block, mut instant) = (Rows::new(self.registers), Rows::new(self.instant_registers));
        for (i, value) in self.constants.iter().enumerate() {
            block[self.inputs + i] = [*value; L];
            instant[self.inputs + i] = [*value];
        }
        Memory { block, instant }
    }

    /// Computes what depends on parameters alone; call it when they have changed.
    pub fn begin<const L: usize>(&self, memory: &mut Memory<L>, isa: Isa) {
        execute(&self.begin, &mut memory.block, isa);
    }

    /// Runs the program on all lanes.
    #[inline]
    pub fn run<const L: usize>(&self, memory: &mut Memory<L>, isa: Isa) {
        execute(&self.instant, &mut memory.instant, Isa::default());
        for (from, to) in &self.handed {
            memory.block[*to as usize] = [memory.instant[*from as usize][0]; L];
        }
        execute(&self.body, &mut memory.block, isa);
    }

    /// Computes what depends on the instant alone and adds it to a list, for [`Lanes::run_at`].
    pub fn push_instant<const L: usize>(&self, memory: &mut Memory<L>, values: &mut Vec<f64>) {
        execute(&self.instant, &mut memory.instant, Isa::default());
        values.extend(self.handed.iter().map(|(from, _)| memory.instant[*from as usize][0]));
    }

    /// How many numbers [`Lanes::push_instant`] adds.
    #[inline(always)]
    pub fn instant_len(&self) -> usize {
        self.handed.len()
    }

    /// As [`Lanes::run`] at an instant of which everything is known, inlined into a [`Kernel`](crate::formula::Kernel) of the
    /// caller.
    #[inline(always)]
    pub fn run_at<const L: usize>(&self, memory: &mut Memory<L>, instant: &[f64]) {
        for ((_, to), value) in self.handed.iter().zip(instant) {
            memory.block[*to as usize] = [*value; L];
        }
        exec::execute(&self.body, &mut memory.block);
    }

    /// A result of the last run; NaN or infinite where it is undefined.
    #[inline(always)]
    pub fn output<'m, const L: usize>(&self, memory: &'m Memory<L>, k: usize) -> &'m [f64; L] {
        &memory.block[self.outputs[k] as usize]
    }

    /// How many results there are.
    pub fn outputs(&self) -> usize {
        self.outputs.len()
    }

    /// How many steps a run takes on all lanes.
    pub fn len(&self) -> usize {
        self.body.len()
    }

    /// Whether nothing is left to do for each lane.
    pub fn is_empty(&self) -> bool {
        self.body.is_empty()
    }
}

/// Runs steps; where there are none nothing is called.
#[inline]
fn execute<const L: usize>(code: &[Step], registers: &mut [[f64; L]], isa: Isa) {
    if !code.is_empty() {
        isa.dispatch(Run { code, registers });
    }
}
