//! Sequential quadratic programming (Nocedal and Wright, *Numerical Optimization*, 2006, chapter 18): steps by linearised equations
//! and the curvature of the cost, as far as they lower the l₁ merit function.

use super::quadratic_program::QuadraticProgram;
use super::transcription::{Point, Program};

/// Steps at most.
const STEPS: usize = 80;
/// A relative change of the cost that is not worth another step, and how many steps in a row may bring no more.
const SETTLED: f64 = 1e-4;
const IDLE: usize = 3;
/// Projections onto the equations at most.
const PROJECTIONS: usize = 12;
/// How exactly the motion is followed at worst, as a multiple of the tolerance: across kinks, and over long ways.
const FOLLOWED: f64 = 100.0;
/// Shares of what equations are off by that a step tries to take back, for limits that do not let it take back all.
const SHARES: [f64; 4] = [1.0, 0.5, 0.2, 0.05];

/// A point with its cost and what its equations are off by.
struct Iterate {
    point: Point,
    cost: f64,
    violations: Vec<f64>,
}

/// A point at which equations hold; none where the steps do not lead to one.
pub fn solved(program: &Program, start: Point) -> Option<Point> {
    let mut here = Iterate::at(program, start)?;
    let (mut penalty, mut damping, mut best, mut idle) = (1.0, 1e-3, f64::INFINITY, 0);
    for _ in 0..STEPS {
        let Some(step) = Step::from(program, &here.point, damping) else { break };
        // Powell's rule: as large as multipliers ask for, and no larger for long.
        penalty = f64::max(2.0 * step.multiplier, 0.5 * (penalty + 2.0 * step.multiplier)).max(1.0);
        let Some((next, halvings)) = here.along(program, &step, penalty) else {
            damping *= 10.0;
            if damping > 1e4 {
                break;
            }
            continue;
        };
        damping = if halvings == 0 { f64::max(damping * 0.3, 1e-6) } else { (damping * 3.0).min(1e3) };
        here = next;
        if here.off() < program.tolerance {
            idle = if here.cost < best - SETTLED * best.abs().min(1.0) { 0 } else { idle + 1 };
            best = best.min(here.cost);
        }
        if idle == IDLE {
            break;
        }
    }
    (here.off() < 10.0 * program.tolerance).then_some(here.point)
}

/// The point near one at which equations hold: the nearest one of the linearised equations, again and again, whatever it costs.
/// Where that brings them no nearer to the tolerance, what is left is how exactly the motion is followed.
pub fn restored(program: &Program, start: Point) -> Option<Point> {
    let mut here = Iterate::at(program, start)?;
    for _ in 0..PROJECTIONS {
        if here.off() <= program.tolerance {
            break;
        }
        let step = program.projection(&here.point).ok()?.solution(0.1 * program.tolerance)?.x;
        let next = Iterate::at(program, program.moved(&here.point, &step, 1.0))?;
        let (before, after) = (here.off(), next.off());
        let is_followed = before < FOLLOWED * program.tolerance;
        if after >= before {
            return is_followed.then_some(here.point);
        }
        here = next;
        if is_followed && after > 0.5 * before {
            return Some(here.point);
        }
    }
    (here.off() < 10.0 * program.tolerance).then_some(here.point)
}

/// A step and the quadratic program that it solves.
struct Step {
    along: Vec<f64>,
    /// The largest multiplier of an equation.
    multiplier: f64,
    program: QuadraticProgram,
}

impl Step {
    fn from(program: &Program, point: &Point, damping: f64) -> Option<Self> {
        let whole = program.step(point, damping).ok()?;
        SHARES.into_iter().find_map(|share| {
            let asked = whole.with_share(share);
            let found = asked.solution(0.1 * program.tolerance)?;
            Some(Self { along: found.x, multiplier: found.multiplier, program: asked })
        })
    }

    /// The second-order correction (Nocedal and Wright 18.3): the step that takes back the curvature of the equations as well,
    /// which this one met.
    fn corrected(&self, before: &[f64], after: &[f64], accuracy: f64) -> Option<Vec<f64>> {
        let mut program = self.program.clone();
        for (to, (before, after)) in program.equal_to.iter_mut().zip(before.iter().zip(after)) {
            let foreseen = before + *to;
            *to -= after - foreseen;
        }
        Some(program.solution(accuracy)?.x)
    }
}

impl Iterate {
    /// None where the motion is undefined.
    fn at(program: &Program, point: Point) -> Option<Self> {
        let violations = program.violations(&point).ok()?;
        Some(Self { cost: program.cost(&point), violations, point })
    }

    /// The most that an equation is off by.
    fn off(&self) -> f64 {
        size(&self.violations)
    }

    fn merit(&self, penalty: f64) -> f64 {
        self.cost + penalty * self.violations.iter().map(|v| v.abs()).sum::<f64>()
    }

    /// The first point along a step, corrected, then halved as often as needed, that lowers the merit, and how often it was halved.
    /// Where equations hold to rounding the merit may rise by as much.
    fn along(&self, program: &Program, step: &Step, penalty: f64) -> Option<(Self, i32)> {
        let (before, tolerance) = (self.merit(penalty), program.tolerance);
        let lower = |there: &Self| {
            let (merit, is_near) = (there.merit(penalty), there.off() < tolerance && self.off() < 1e3 * tolerance);
            merit < before - 1e-12 * before.abs() || is_near && merit <= before + 10.0 * tolerance * before.abs()
        };
        let whole = Self::at(program, program.moved(&self.point, &step.along, 1.0));
        if let Some(whole) = whole {
            if lower(&whole) {
                return Some((whole, 0));
            }
            // Nearer than that a correction is lost in how exactly the motion is followed.
            let curved = (whole.off() > 10.0 * tolerance).then_some(&whole.violations);
            let correction = curved.and_then(|after| step.corrected(&self.violations, after, 0.1 * tolerance));
            let corrected = correction.and_then(|by| Self::at(program, program.moved(&self.point, &by, 1.0)));
            if let Some(corrected) = corrected.filter(lower) {
                return Some((corrected, 0));
            }
        }
        (1..12).find_map(|halvings| {
            let there = Self::at(program, program.moved(&self.point, &step.along, 0.5_f64.powi(halvings)))?;
            lower(&there).then_some((there, halvings))
        })
    }
}

fn size(violations: &[f64]) -> f64 {
    violations.iter().fold(0.0, |most, v| if v.is_finite() { most.max(v.abs()) } else { f64::INFINITY })
}
