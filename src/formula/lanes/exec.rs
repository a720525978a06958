//! The interpreter of steps over registers of lanes.

use super::isa::Kernel;
use super::math;
use crate::formula::Fun;
use crate::formula::float::quotient;

/// One step: operands and result are registers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Step {
    Neg {
        a: u32,
        d: u32,
    },
    Add {
        a: u32,
        b: u32,
        d: u32,
    },
    Sub {
        a: u32,
        b: u32,
        d: u32,
    },
    Mul {
        a: u32,
        b: u32,
        d: u32,
    },
    Div {
        a: u32,
        b: u32,
        d: u32,
    },
    /// a·b + c
    MulAdd {
        a: u32,
        b: u32,
        c: u32,
        d: u32,
    },
    /// a·b − c
    MulSub {
        a: u32,
        b: u32,
        c: u32,
        d: u32,
    },
    /// c − a·b
    SubMul {
        a: u32,
        b: u32,
        c: u32,
        d: u32,
    },
    Power {
        a: u32,
        n: i32,
        d: u32,
    },
    SinCos {
        a: u32,
        s: u32,
        c: u32,
    },
    Call {
        f: Fun,
        a: u32,
        d: u32,
    },
}

/// A list of steps about to run.
pub(super) struct Run<'a, const L: usize> {
    pub code: &'a [Step],
    pub registers: &'a mut [[f64; L]],
}

impl<const L: usize> Kernel for Run<'_, L> {
    #[inline(always)]
    fn run(self) {
        execute(self.code, self.registers);
    }
}

/// Runs steps in their order. Loops over lanes are written out, because closures are not inlined into code for wider
/// vectors.
#[inline(always)]
pub(super) fn execute<const L: usize>(code: &[Step], r: &mut [[f64; L]]) {
    for step in code {
        match *step {
            Step::Neg { a, d } => {
                let mut y = r[a as usize];
                for y in &mut y {
                    *y = -*y;
                }
                r[d as usize] = y;
            }
            Step::Add { a, b, d } => {
                let mut y = [0.0; L];
                let (a, b) = (&r[a as usize], &r[b as usize]);
                for l in 0..L {
                    y[l] = a[l] + b[l];
                }
                r[d as usize] = y;
            }
            Step::Sub { a, b, d } => {
                let mut y = [0.0; L];
                let (a, b) = (&r[a as usize], &r[b as usize]);
                for l in 0..L {
                    y[l] = a[l] - b[l];
                }
                r[d as usize] = y;
            }
            Step::Mul { a, b, d } => {
                let mut y = [0.0; L];
                let (a, b) = (&r[a as usize], &r[b as usize]);
                for l in 0..L {
                    y[l] = a[l] * b[l];
                }
                r[d as usize] = y;
            }
            Step::Div { a, b, d } => {
                let mut y = [0.0; L];
                let (a, b) = (&r[a as usize], &r[b as usize]);
                for l in 0..L {
                    y[l] = quotient(a[l], b[l]);
                }
                r[d as usize] = y;
            }
            Step::MulAdd { a, b, c, d } => {
                let mut y = [0.0; L];
                let (a, b, c) = (&r[a as usize], &r[b as usize], &r[c as usize]);
                for l in 0..L {
                    y[l] = a[l] * b[l] + c[l];
                }
                r[d as usize] = y;
            }
            Step::MulSub { a, b, c, d } => {
                let mut y = [0.0; L];
                let (a, b, c) = (&r[a as usize], &r[b as usize], &r[c as usize]);
                for l in 0..L {
                    y[l] = a[l] * b[l] - c[l];
                }
                r[d as usize] = y;
            }
            Step::SubMul { a, b, c, d } => {
                let mut y = [0.0; L];
                let (a, b, c) = (&r[a as usize], &r[b as usize], &r[c as usize]);
                for l in 0..L {
                    y[l] = c[l] - a[l] * b[l];
                }
                r[d as usize] = y;
            }
            Step::Power { a, n, d } => {
                let y = match n {
                    2 => {
                        let mut y = r[a as usize];
                        for y in &mut y {
                            *y *= *y;
                        }
                        y
                    }
                    _ => math::power(&r[a as usize], n),
                };
                r[d as usize] = y;
            }
            Step::SinCos { a, s, c } => {
                let x = r[a as usize];
                let both = r.get_disjoint_mut([s as usize, c as usize]);
                let [s, c] = both.expect("sine and cosine have registers of their own");
                math::sin_cos(&x, s, c);
            }
            Step::Call { f, a, d } => {
                let y = math::call(f, &r[a as usize]);
                r[d as usize] = y;
            }
        }
    }
}
