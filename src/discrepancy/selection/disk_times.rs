//! The times at which a vehicle is within a disk of the plane.

use super::scope_screen::Price;
use super::search::Search;
use crate::discrepancy::estimation::fit::{Effort, Fit};
use crate::discrepancy::evidence::information_criterion::bic;
use crate::discrepancy::record::run_record::Record;
use crate::effects::{Applied, Scope};
use crate::error::Result;

/// Visits beyond these are what a place does, and no intervals of time.
const VISITS: usize = 2;

impl Search<'_> {
    /// An effect within a disk, or while the vehicle was there where that says as much: what it entered once alone may as well
    /// have begun then.
    pub(super) fn in_time_instead(
        &self,
        base: &Fit,
        (own, fit): (Applied, Fit),
        price: &Price,
    ) -> Result<(Applied, Fit)> {
        let times = own.effect.scope.as_ref().and_then(|scope| times_within(&self.problem.records, scope));
        let Some(times) = times else { return Ok((own, fit)) };
        let mut then = own.clone();
        then.effect.scope = Some(times);
        let model = fit.model.clone().with_effect(then.clone());
        let Some(begun) = self.problem.fit(&model, &fit.window_states, &fit.variances, Effort::SCREENING)? else {
            return Ok((own, fit));
        };
        let Some((then, other)) = self.refined(base, then.clone(), begun, price.of(&then))? else {
            return Ok((own, fit));
        };
        let n = fit.sample_size.max(other.sample_size);
        let is_as_good = bic(&other, n) <= bic(&fit, n) && !self.problem.predicts_worse(&other, base)?;
        Ok(if is_as_good { (then, other) } else { (own, fit) })
    }
}

/// The times of a few visits to a disk in the only run; `None` for another scope, of several runs, and of many visits.
fn times_within(records: &[Record], scope: &Scope) -> Option<Scope> {
    let ([record], Scope::Disk(disk)) = (records, scope) else { return None };
    let rows = record.rows.clone();
    let visits = visits([&record.time[rows.clone()], &record.columns[0][rows.clone()], &record.columns[1][rows]], disk);
    (1..=VISITS).contains(&visits.len()).then_some(Scope::Times(visits))
}

/// When a path, of times and places, is within a disk; it comes and goes in the middle between two rows.
fn visits([time, x, y]: [&[f64]; 3], [a, b, radius]: &[f64; 3]) -> Vec<[f64; 2]> {
    let is_within = |i: usize| (x[i] - a).hypot(y[i] - b) < *radius;
    let mut visits: Vec<[f64; 2]> = vec![];
    let mut was_within = false;
    for i in 0..time.len() {
        let middle = if i == 0 { f64::NEG_INFINITY } else { 0.5 * (time[i - 1] + time[i]) };
        match (was_within, is_within(i)) {
            (false, true) => visits.push([middle, f64::INFINITY]),
            (true, false) => {
                if let Some(visit) = visits.last_mut() {
                    visit[1] = middle;
                }
            }
            _ => {}
        }
        was_within = is_within(i);
    }
    visits
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A vehicle that goes from one end to the other, and back, within 10 s.
    #[test]
    fn visits_are_told_by_their_times() {
        let time: Vec<f64> = (0..=100).map(|i| 0.1 * f64::from(i)).collect();
        let x: Vec<f64> = time.iter().map(|t| (t - 5.0).abs()).collect();
        let within = |a: f64| visits([&time, &x, &vec![0.0; time.len()]], &[a, 0.0, 0.98]);
        let is_near = |found: &[[f64; 2]], expected: &[[f64; 2]]| {
            let all = found.iter().flatten().zip(expected.iter().flatten());
            found.len() == expected.len() && all.into_iter().all(|(a, b)| a == b || (a - b).abs() < 1e-9)
        };
        let (before, after) = (f64::NEG_INFINITY, f64::INFINITY);
        assert!(is_near(&within(0.0), &[[4.05, 5.95]]), "{:?}", within(0.0));
        assert!(is_near(&within(3.0), &[[1.05, 2.95], [7.05, 8.95]]), "{:?}", within(3.0));
        assert!(is_near(&within(5.0), &[[before, 0.95], [9.05, after]]), "{:?}", within(5.0));
        assert!(within(9.0).is_empty());
    }
}
