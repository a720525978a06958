//! How runs were driven: how long and how far, how fast, and how often to each side.

use super::motion_ratios::{STRAIGHT, Step, steps_along};
use crate::discrepancy::report::Driving;
use crate::discrepancy::shooting::rollout::Rollout;
use crate::effects::TypicalMotion;

/// A turn to one side of so much is one turn, rad.
const ONE_TURN: f64 = 0.5;
/// Less than this share of what is usual is not moving, or not turning.
const LITTLE: f64 = 0.1;

/// The driving of some runs by a model along them, in windows of a second.
pub(crate) fn driving(along: &[Rollout]) -> Driving {
    let each: Vec<Vec<Step>> = along.iter().map(steps_along).collect();
    let all: Vec<&Step> = each.iter().flatten().collect();
    let rates = |f: &dyn Fn(&Step) -> f64| all.iter().map(|s| f(s).abs() / s.seconds).collect::<Vec<f64>>();
    let [left_turns, right_turns] =
        each.iter().map(|s| turns(s)).fold([0, 0], |[a, b], [left, right]| [a + left, b + right]);
    let spans = along.iter().map(|r| {
        let (rows, time) = r.rows();
        [time[rows.start], time[rows.end - 1]]
    });
    Driving {
        runs: along.len(),
        seconds: spans.clone().map(|[from, until]| until - from).sum(),
        metres: all.iter().map(|s| s.way.abs()).sum(),
        left_turns,
        right_turns,
        motion: TypicalMotion {
            speed: usual(rates(&|s| s.way)),
            turning: usual(rates(&|s| s.turn)),
            until: spans.map(|[_, until]| until).fold(0.0, f64::max),
        },
    }
}

/// The median of what is more than little; zero where there is nothing.
fn usual(mut sizes: Vec<f64>) -> f64 {
    sizes.sort_by(f64::total_cmp);
    let most = sizes.get((0.9 * sizes.len() as f64) as usize).copied().unwrap_or(0.0);
    let from = sizes.partition_point(|s| *s <= LITTLE * most);
    sizes.get((from + sizes.len()) / 2).copied().unwrap_or(0.0)
}

/// Turns to the left and to the right: stretches of windows that turn to one side, and far enough.
fn turns(steps: &[Step]) -> [usize; 2] {
    let mut counted = [0, 0];
    let mut turned: f64 = 0.0;
    let mut is_counted = false;
    for step in steps {
        if step.turn.abs() < STRAIGHT || step.turn * turned < 0.0 {
            (turned, is_counted) = (0.0, false);
        }
        turned += step.turn;
        if turned.abs() > ONE_TURN && !is_counted {
            counted[usize::from(turned < 0.0)] += 1;
            is_counted = true;
        }
    }
    counted
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrepancy::fixtures::{equations, logged, unicycle};

    /// Left, right, straight on, and left again, ten seconds each.
    #[test]
    fn turns_are_counted_by_side_and_ways_added() {
        let turn = |t: f64| [0.5, -0.4, 0.0, 0.5][((t / 10.0) as usize).min(3)];
        let wheel = |_: f64| 2.0;
        let (equations, p) = equations(&[]);
        let time = (0..=640).map(|i| f64::from(i) / 16.0).collect();
        let record = logged((&equations, &p), time, [&wheel, &turn], &[0.0; 3], 0.0);
        let along = || Rollout::new(&unicycle(&[]), &record).unwrap();
        let told = driving(&[along(), along()]);
        assert_eq!((told.runs, told.left_turns, told.right_turns), (2, 4, 2));
        assert!((told.seconds - 80.0).abs() < 1e-9, "{told:?}");
        // Wheels of half a metre; the last window of each run is not whole.
        assert!((told.metres - 80.0).abs() < 3.0 && (told.motion.speed - 1.0).abs() < 0.01, "{told:?}");
        assert!((0.4..=0.5).contains(&told.motion.turning), "{told:?}");
    }

    #[test]
    fn what_stands_has_no_speed() {
        assert_eq!(usual(vec![0.0; 8]), 0.0);
        assert_eq!(usual(vec![]), 0.0);
        assert_eq!(usual(vec![0.0, 1.0, 2.0, 3.0, 0.001]), 2.0);
    }
}
