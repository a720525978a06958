//! Where a planner's searches begin: curves of the tracked point through the poses of a task, and how long they usually take.

use super::initial_guess::{Curve, FirstGuess, curves, followed, nearest, straight};
use super::limits::Limit;
use super::planner::Planner;
use super::task::Task;

impl Planner {
    /// First guesses, round by round.
    pub(super) fn guesses(&self, task: &Task, reaches: &[f64]) -> Vec<Vec<FirstGuess>> {
        let (first, _) = self.point.at(&self.start);
        let (through, spans) = (self.poses(task, first), task.legs());
        let rounds = match task.path.length() > 0.0 {
            true => vec![followed(&task.path, first, task.spans)],
            false => reaches.iter().map(|reach| curves(&through, &spans, *reach)).collect(),
        };
        let guess = |curve: Curve| {
            let on_body = self.on_body(&curve, task);
            let usual = self.usual_duration(&on_body, &task.limits);
            FirstGuess { poses: curve.poses, on_body, usual }
        };
        rounds.into_iter().map(|round: Vec<Curve>| round.into_iter().map(guess).collect()).collect()
    }

    /// The duration by which costs measure time, the same wherever a search begins.
    pub(super) fn a_usual_duration(&self, task: &Task, guesses: &[Vec<FirstGuess>]) -> f64 {
        let shortest = guesses.iter().flatten().map(|guess| guess.usual).fold(f64::INFINITY, f64::min);
        self.moving(task).unwrap_or(shortest)
    }

    /// The start, then the poses to pass, a heading that does not matter along the way to the next.
    fn poses(&self, task: &Task, first: [f64; 3]) -> Vec<[f64; 3]> {
        let mut all = vec![first];
        for (i, (x, y, heading)) in task.poses.iter().enumerate() {
            let [x0, y0, before] = all[i];
            let on = task.poses.get(i + 1).map_or((*x, *y, x0, y0), |(x1, y1, _)| (*x1, *y1, x0, y0));
            let along = (on.1 - on.3).atan2(on.0 - on.2);
            all.push([*x, *y, nearest(heading.unwrap_or(along), before)]);
        }
        all
    }

    /// A curve of the tracked point as one of the body, as if a train were straight.
    fn on_body(&self, curve: &Curve, task: &Task) -> Curve {
        let straight = |heading: f64| straight(&self.start, &self.equations, [0.0, 0.0, heading]);
        let offset = self.point.at(&straight(0.0)).0;
        let turn = if task.of_trailer == 0 { offset[2] } else { 0.0 };
        let body = |[x, y, heading]: &[f64; 3]| {
            let at = self.point.at(&straight(heading - turn)).0;
            [x - at[0], y - at[1], heading - turn]
        };
        Curve { poses: curve.poses.iter().map(body).collect(), ahead: curve.ahead.clone(), length: curve.length }
    }

    /// A duration in which limits let a curve be followed with ease.
    fn usual_duration(&self, curve: &Curve, limits: &[Limit]) -> f64 {
        let mut w = self.equations.workspace(&[]);
        let mut rates = vec![0.0; self.equations.n()];
        let mut full: Vec<f64> = limits.iter().map(|l| if l.rests { l.scale() } else { 0.0 }).collect();
        full.resize(self.equations.inputs.len(), 0.0);
        // A speed that follows the wheels has followed them.
        self.equations.rates(&mut w, &self.in_equilibrium(&full), &full, &mut rates);
        let speed = rates[0].hypot(rates[1]).max(1e-3);
        let turned: f64 = curve.poses.windows(2).map(|p| (p[1][2] - p[0][2]).abs()).sum();
        let slowest = limits.iter().map(|l| l.scale() / l.rate).fold(0.0, f64::max);
        2.5 * curve.length / speed + 1.5 * turned + 2.0 * slowest
    }
}
