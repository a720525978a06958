//! Sequential quadratic programming (Nocedal and Wright, *Numerical Optimization*, 2006, chapter 18): steps by linearised equations
//! and the curvature of the cost, as far as they lower the l₁ merit function.

use super::transcription::{Point, Program};

/// Steps at most.
const STEPS: usize = 80;
/// A relative change of the cost that is not worth another step.
const SETTLED: f64 = 1e-6;
/// Shares of what equations are off by that a step tries to take back, for limits that do not let it take back all.
const SHARES: [f64; 4] = [1.0, 0.5, 0.2, 0.05];

/// A point with its cost and what its equations are off by.
struct Iterate {
    point: Point,
    cost: f64,
    violations: Vec<f64>,
}

/// A point at which equations hold, and its cost; none where the steps do not lead to one.
pub fn solved(program: &Program, start: Point) -> Option<(Point, f64)> {
    let mut here = Iterate::at(program, start)?;
    let (mut penalty, mut damping, mut settled) = (1.0, 1e-3, 0);
    for _ in 0..STEPS {
        let Some((step, multiplier)) = step(program, &here.point, damping) else { break };
        penalty = f64::max(penalty, 2.0 * multiplier);
        let Some((next, halvings)) = here.along(program, &step, penalty) else {
            damping *= 10.0;
            if damping > 1e4 {
                break;
            }
            continue;
        };
        damping = if halvings == 0 { f64::max(damping * 0.3, 1e-6) } else { (damping * 3.0).min(1e3) };
        let is_small = (next.cost - here.cost).abs() < SETTLED * next.cost.abs().max(1e-3);
        here = next;
        settled = if is_small && here.off() < program.tolerance { settled + 1 } else { 0 };
        if settled == 2 {
            break;
        }
    }
    (here.off() < 10.0 * program.tolerance).then_some((here.point, here.cost))
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

    /// The first point along a step, halved as often as needed, that lowers the merit, and how often it was halved. Where equations
    /// hold to rounding the merit may rise by as much.
    fn along(&self, program: &Program, step: &[f64], penalty: f64) -> Option<(Self, i32)> {
        let (before, tolerance) = (self.merit(penalty), program.tolerance);
        (0..12).find_map(|halvings| {
            let there = Self::at(program, program.moved(&self.point, step, 0.5_f64.powi(halvings)))?;
            let (merit, is_near) = (there.merit(penalty), there.off() < tolerance && self.off() < 1e3 * tolerance);
            let lower =
                merit < before - 1e-12 * before.abs() || is_near && merit <= before + 10.0 * tolerance * before.abs();
            lower.then_some((there, halvings))
        })
    }
}

fn size(violations: &[f64]) -> f64 {
    violations.iter().fold(0.0, |most, v| if v.is_finite() { most.max(v.abs()) } else { f64::INFINITY })
}

/// The step from a point, and the largest multiplier of its equations.
fn step(program: &Program, point: &Point, damping: f64) -> Option<(Vec<f64>, f64)> {
    let whole = program.step(point, damping).ok()?;
    let found = SHARES.into_iter().find_map(|share| whole.with_share(share).solution())?;
    Some((found.x, found.multiplier))
}
