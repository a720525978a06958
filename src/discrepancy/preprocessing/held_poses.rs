//! A pose that is filled forward: it repeats exactly while the inputs say motion, and then catches up.

use super::path_pair::PathPair;
use crate::discrepancy::record::local_polynomial::median;
use crate::files::Run;

/// A pose that repeats while the vehicle moves by more than so many of its own smallest steps is held.
const STEPS: f64 = 3.0;
/// Share of the reckoned motion by which the next pose catches up.
const CATCHES_UP: f64 = 0.5;
/// Rows that are worth a word.
const FEWEST: usize = 3;

/// Rows that hold the pose of the row before them, in rising order.
///
/// A coarse pose repeats as well, until the vehicle has moved by one of its steps; and that of a vehicle that stands although
/// its wheels turn catches up with nothing.
pub(super) fn rows(pair: PathPair) -> Vec<usize> {
    let run = pair.run;
    let least = STEPS * step_of(&run.x).max(step_of(&run.y));
    let least_turn = STEPS * run.heading.as_deref().map_or(0.0, step_of);
    let mut found = vec![];
    let mut fresh = 0;
    for next in 1..run.time.len() {
        if repeats(run, next) {
            continue;
        }
        let last = next - 1;
        if last > fresh {
            let (within, until, measured) =
                (pair.reckoned(fresh, last), pair.reckoned(fresh, next), pair.measured(fresh, next));
            let moves = within.way > least && measured.way > CATCHES_UP * until.way;
            let turned = |m: Option<f64>| m.unwrap_or(0.0).abs();
            let turns = turned(within.turn) > least_turn && turned(measured.turn) > CATCHES_UP * turned(until.turn);
            if moves || (turns && run.heading.is_some()) {
                found.extend(fresh + 1..next);
            }
        }
        fresh = next;
    }
    if found.len() < FEWEST { vec![] } else { found }
}

/// The usual time between the poses that are measured, s.
pub(super) fn every(run: &Run, held: &[usize]) -> f64 {
    let mut is_held = vec![false; run.time.len()];
    held.iter().for_each(|i| is_held[*i] = true);
    let fresh: Vec<f64> = (0..run.time.len()).filter(|i| !is_held[*i]).map(|i| run.time[i]).collect();
    median(&mut fresh.windows(2).map(|w| w[1] - w[0]).collect::<Vec<_>>()).unwrap_or(f64::NAN)
}

fn repeats(run: &Run, i: usize) -> bool {
    let same = |column: &Vec<f64>| column[i] == column[i - 1];
    same(&run.x) && same(&run.y) && run.heading.iter().chain(&run.trailer_headings).all(same)
}

/// How far the nearest two values of a column are apart: its step, where it has one.
fn step_of(column: &[f64]) -> f64 {
    let mut values = column.to_vec();
    values.sort_by(f64::total_cmp);
    let changes = values.windows(2).map(|w| w[1] - w[0]).filter(|c| *c > 0.0);
    changes.min_by(f64::total_cmp).unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrepancy::fixtures::unicycle_file;

    /// A drive along a bow at 20 Hz, as its pose is logged.
    fn run(logged: impl Fn(u32) -> [f64; 3]) -> (Run, [Vec<f64>; 3]) {
        let mut log = String::from("time,x,y,heading,wheel_rate,yaw_rate\n");
        for i in 0..200_u32 {
            let [x, y, heading] = logged(i);
            log += &format!("{},{x},{y},{heading},1,0.2\n", 0.05 * f64::from(i));
        }
        let run = Run::parse("run.csv", &log, &unicycle_file("")).unwrap();
        let reckoned = [0, 1, 2].map(|k| (0..200).map(|i| bow(f64::from(i))[k]).collect());
        (run, reckoned)
    }

    fn bow(row: f64) -> [f64; 3] {
        let turned = 0.2 * 0.05 * row;
        [turned.sin() / 0.2, (1.0 - turned.cos()) / 0.2, turned]
    }

    #[test]
    fn a_pose_that_catches_up_is_held_and_a_coarse_one_is_not() {
        let found = |logged: &dyn Fn(u32) -> [f64; 3]| {
            let (run, reckoned) = run(logged);
            let held = rows(PathPair { run: &run, reckoned: &reckoned });
            (held.len(), every(&run, &held))
        };
        let (held, every) = found(&|i| bow(f64::from(i / 5 * 5)));
        assert!(held == 156 && (every - 0.25).abs() < 1e-9, "{held} {every}");
        // One pose that is lost now and then.
        assert_eq!(found(&|i| bow(f64::from(if i % 50 == 7 { i - 1 } else { i }))).0, 4);
        assert_eq!(found(&|i| bow(f64::from(i))).0, 0);
        // Steps of a decimetre, of which the vehicle makes one in two rows.
        assert_eq!(found(&|i| bow(f64::from(i)).map(|v| (10.0 * v).round() / 10.0)).0, 0);
        // The wheels spin for two seconds, and the pose stands.
        let stuck = |i: u32| bow(f64::from(if i > 100 { i.max(140) - 40 } else { i }));
        assert_eq!(found(&stuck).0, 0);
    }
}
