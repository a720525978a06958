//! Lowering: from a program's instructions to steps over registers, with constants folded and products fused.

use super::exec::{Step, execute};
use super::lane_program::{Changes, Lanes};
use crate::formula::program::Instruction;
use crate::formula::{Fun, Program};
use std::collections::HashMap;

/// When an instruction runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Section {
    /// Now: it depends on numbers alone.
    Fold,
    Begin,
    Instant,
    Body,
}

const CASE: u8 = 1;
const CLOCK: u8 = 2;
const LANE: u8 = 4;

/// An instruction after fusing; operands are positions in the program.
#[derive(Clone, Copy)]
enum Fused {
    Plain,
    /// The product of that position is added here; the other operand is the second.
    MulAdd(usize, usize),
    MulSub(usize, usize),
    SubMul(usize, usize),
    /// Sine and cosine of one angle; this position computes both, with the place of the other.
    Pair(Option<usize>),
    /// Computed elsewhere.
    Gone,
}

impl Lanes {
    /// Arranges a program; `changes` says what each of its inputs changes with.
    pub fn new(program: &Program, changes: &[Changes]) -> Self {
        lower(program, changes)
    }
}

fn lower(program: &Program, changes: &[Changes]) -> Lanes {
    let plan = Plan::new(program, changes);
    let mut out = Emitter::new(program, &plan);
    (0..program.code.len()).for_each(|k| out.emit(k));
    out.finish()
}

/// Where everything runs, and what is fused.
struct Plan<'p> {
    program: &'p Program,
    section: Vec<Section>,
    fused: Vec<Fused>,
    /// The last position of the body that reads a value.
    last_use: Vec<usize>,
}

impl<'p> Plan<'p> {
    fn new(program: &'p Program, changes: &[Changes]) -> Self {
        let section = sections(program, changes);
        let fused = fuse(program, &section);
        let mut plan = Self { program, section, fused, last_use: vec![0; program.code.len()] };
        for k in 0..program.code.len() {
            for x in plan.reads(k) {
                plan.last_use[x] = plan.last_use[x].max(k);
            }
        }
        program.outputs.iter().for_each(|o| plan.last_use[*o as usize] = usize::MAX);
        plan
    }

    /// The values that a position reads after fusing.
    fn reads(&self, k: usize) -> Vec<usize> {
        match self.fused[k] {
            Fused::Gone => vec![],
            Fused::MulAdd(product, other) | Fused::MulSub(product, other) | Fused::SubMul(product, other) => {
                let mut found = operands(&self.program.code[product]);
                found.push(other);
                found
            }
            _ => operands(&self.program.code[k]),
        }
    }
}

fn operands(i: &Instruction) -> Vec<usize> {
    match *i {
        Instruction::Input(_) | Instruction::Constant(_) => vec![],
        Instruction::Neg(a) | Instruction::Square(a) | Instruction::Pow(a, _) | Instruction::Call(_, a) => {
            vec![a as usize]
        }
        Instruction::Add(a, b) | Instruction::Sub(a, b) | Instruction::Mul(a, b) | Instruction::Div(a, b) => {
            vec![a as usize, b as usize]
        }
    }
}

fn sections(program: &Program, changes: &[Changes]) -> Vec<Section> {
    let mut bits: Vec<u8> = Vec::with_capacity(program.code.len());
    for i in &program.code {
        let own = match i {
            Instruction::Input(slot) => match changes[*slot as usize] {
                Changes::Case => CASE,
                Changes::Clock => CLOCK,
                Changes::Lane => LANE,
            },
            _ => operands(i).into_iter().fold(0, |all, x| all | bits[x]),
        };
        bits.push(own);
    }
    let section = |b: &u8| match *b {
        0 => Section::Fold,
        CLOCK => Section::Instant,
        CASE => Section::Begin,
        _ => Section::Body,
    };
    bits.iter().map(section).collect()
}

/// Products that are only added become one step with the sum; sine and cosine of one angle become one step.
fn fuse(program: &Program, section: &[Section]) -> Vec<Fused> {
    let n = program.code.len();
    let mut uses = vec![0; n];
    program.code.iter().flat_map(operands).for_each(|x| uses[x] += 1);
    program.outputs.iter().for_each(|o| uses[*o as usize] += 2);
    let product = |x: usize, at: usize, fused: &[Fused]| {
        let lonely = matches!(program.code[x], Instruction::Mul(..)) && uses[x] == 1;
        lonely && section[x] == section[at] && matches!(fused[x], Fused::Plain)
    };
    let mut fused = vec![Fused::Plain; n];
    let mut angles: HashMap<(Section, u32), (usize, Fun)> = HashMap::new();
    for k in 0..n {
        match program.code[k] {
            Instruction::Add(a, b) | Instruction::Sub(a, b) if a != b => {
                let minus = matches!(program.code[k], Instruction::Sub(..));
                let (a, b) = (a as usize, b as usize);
                let (gone, kind) = if product(b, k, &fused) {
                    (b, if minus { Fused::SubMul(b, a) } else { Fused::MulAdd(b, a) })
                } else if product(a, k, &fused) {
                    (a, if minus { Fused::MulSub(a, b) } else { Fused::MulAdd(a, b) })
                } else {
                    continue;
                };
                (fused[gone], fused[k]) = (Fused::Gone, kind);
            }
            Instruction::Call(f @ (Fun::Sin | Fun::Cos), a) => match angles.get(&(section[k], a)) {
                Some((first, other)) if *other != f => {
                    fused[*first] = Fused::Pair(Some(k));
                    fused[k] = Fused::Gone;
                }
                _ => {
                    angles.insert((section[k], a), (k, f));
                    fused[k] = Fused::Pair(None);
                }
            },
            _ => {}
        }
    }
    fused
}

/// Writes steps and hands out registers.
struct Emitter<'p> {
    plan: &'p Plan<'p>,
    /// The register of a value in the file of its own section.
    place: Vec<u32>,
    /// The register of the lanes that a value of the instant is handed to.
    handed: HashMap<usize, u32>,
    free: Vec<u32>,
    folded: Vec<Step>,
    lanes: Lanes,
}

impl<'p> Emitter<'p> {
    fn new(program: &Program, plan: &'p Plan<'p>) -> Self {
        // A place for every number that is computed now, and one for what nobody asks for.
        let mut constants = program.constants.clone();
        let folded = plan.section.iter().filter(|s| **s == Section::Fold).count();
        constants.resize(program.constants.len() + folded + 1, 0.0);
        let fixed = program.inputs + constants.len();
        let lanes = Lanes {
            constants,
            inputs: program.inputs,
            begin: vec![],
            instant: vec![],
            handed: vec![],
            body: vec![],
            outputs: vec![],
            registers: fixed,
            instant_registers: fixed,
        };
        Self {
            plan,
            place: vec![u32::MAX; program.code.len()],
            handed: HashMap::new(),
            free: vec![],
            folded: vec![],
            lanes,
        }
    }

    fn emit(&mut self, k: usize) {
        let inputs = self.lanes.inputs as u32;
        let instruction = self.plan.program.code[k];
        match instruction {
            Instruction::Input(slot) => return self.place[k] = slot,
            Instruction::Constant(i) => return self.place[k] = inputs + i,
            _ if matches!(self.plan.fused[k], Fused::Gone) => return,
            _ => {}
        }
        let reads: Vec<u32> = self.plan.reads(k).into_iter().map(|x| self.at(x, k)).collect();
        self.release(k);
        let d = self.register(k);
        self.place[k] = d;
        let step = match (self.plan.fused[k], instruction) {
            (Fused::MulAdd(..), _) => Step::MulAdd { a: reads[0], b: reads[1], c: reads[2], d },
            (Fused::MulSub(..), _) => Step::MulSub { a: reads[0], b: reads[1], c: reads[2], d },
            (Fused::SubMul(..), _) => Step::SubMul { a: reads[0], b: reads[1], c: reads[2], d },
            (Fused::Pair(other), Instruction::Call(f, _)) => self.pair(k, f, other, reads[0]),
            (_, i) => plain(i, &reads, d),
        };
        match self.plan.section[k] {
            Section::Fold => self.folded.push(step),
            Section::Begin => self.lanes.begin.push(step),
            Section::Instant => self.lanes.instant.push(step),
            Section::Body => self.lanes.body.push(step),
        }
    }

    fn pair(&mut self, k: usize, f: Fun, other: Option<usize>, a: u32) -> Step {
        let first = self.place[k];
        let fixed = (self.lanes.inputs + self.lanes.constants.len()) as u32;
        let second = match other {
            Some(other) => self.register(other),
            None if self.plan.section[k] == Section::Fold => fixed - 1,
            None => self.register(k),
        };
        match other {
            Some(other) => self.place[other] = second,
            // The one that nobody asked for.
            None if self.plan.section[k] == Section::Body => self.free.push(second),
            None => {}
        }
        if f == Fun::Sin { Step::SinCos { a, s: first, c: second } } else { Step::SinCos { a, s: second, c: first } }
    }

    /// The register from which position k reads a value.
    fn at(&mut self, x: usize, k: usize) -> u32 {
        let from_instant = self.plan.section[x] == Section::Instant;
        if !from_instant || self.plan.section[k] == Section::Instant {
            return self.place[x];
        }
        self.hand(x)
    }

    fn hand(&mut self, x: usize) -> u32 {
        if let Some(register) = self.handed.get(&x) {
            return *register;
        }
        // Not one that was free: it would be overwritten before it is read.
        let register = self.lanes.registers as u32;
        self.lanes.registers += 1;
        self.lanes.handed.push((self.place[x], register));
        self.handed.insert(x, register);
        register
    }

    /// Gives back the registers of values of the body that are read here for the last time.
    fn release(&mut self, k: usize) {
        let mut done: Vec<usize> = self.plan.reads(k);
        done.dedup();
        for x in done {
            let temporary = self.plan.section[x] == Section::Body && !operands(&self.plan.program.code[x]).is_empty();
            if temporary && self.plan.last_use[x] == k && !self.free.contains(&self.place[x]) {
                self.free.push(self.place[x]);
            }
        }
    }

    /// A register for the result of a position.
    fn register(&mut self, k: usize) -> u32 {
        if self.plan.section[k] == Section::Fold {
            let before = self.plan.section[..k].iter().filter(|s| **s == Section::Fold).count();
            return (self.lanes.inputs + self.plan.program.constants.len() + before) as u32;
        }
        if self.plan.section[k] == Section::Instant {
            self.lanes.instant_registers += 1;
            return self.lanes.instant_registers as u32 - 1;
        }
        if self.plan.section[k] == Section::Body
            && let Some(register) = self.free.pop()
        {
            return register;
        }
        self.lanes.registers += 1;
        self.lanes.registers as u32 - 1
    }

    fn finish(mut self) -> Lanes {
        let mut file: Vec<[f64; 1]> = vec![[0.0]; self.lanes.inputs];
        file.extend(self.lanes.constants.iter().map(|c| [*c]));
        execute(&self.folded, &mut file);
        self.lanes.constants = file.split_off(self.lanes.inputs).into_iter().flatten().collect();
        for o in &self.plan.program.outputs {
            let x = *o as usize;
            let register = if self.plan.section[x] == Section::Instant { self.hand(x) } else { self.place[x] };
            self.lanes.outputs.push(register);
        }
        self.lanes
    }
}

fn plain(i: Instruction, reads: &[u32], d: u32) -> Step {
    let a = reads[0];
    let b = reads.get(1).copied().unwrap_or(a);
    match i {
        Instruction::Neg(_) => Step::Neg { a, d },
        Instruction::Add(..) => Step::Add { a, b, d },
        Instruction::Sub(..) => Step::Sub { a, b, d },
        Instruction::Mul(..) => Step::Mul { a, b, d },
        Instruction::Div(..) => Step::Div { a, b, d },
        Instruction::Square(_) => Step::Power { a, n: 2, d },
        Instruction::Pow(_, n) => Step::Power { a, n, d },
        Instruction::Call(f, _) => Step::Call { f, a, d },
        Instruction::Input(_) | Instruction::Constant(_) => {
            unreachable!("inputs and constants have places of their own")
        }
    }
}
