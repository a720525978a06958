//! Dead time of inputs (transport delay; Åström and Murray, *Feedback Systems*, 2008, section 8.4): commands are held back
//! until the input with the longest delay acts, so that all act together as they were planned.

use crate::model::Equations;
use crate::motion::input_delays;

/// The dead times of a model's inputs.
///
/// | symbol | unit | meaning |
/// |---|---|---|
/// | τᵢ | s | delay of input i: it acts as it was commanded τᵢ before |
/// | D | s | `longest` = max(0, max τᵢ): what is planned for t happens at t + D |
/// | D − τᵢ | s | `waits`: how much later than planned input i is commanded |
#[derive(Clone, Debug, PartialEq)]
pub struct DeadTime {
    /// D.
    pub longest: f64,
    /// D − τᵢ, input by input.
    pub waits: Vec<f64>,
}

impl DeadTime {
    /// Of a model without free parameters.
    pub fn of(equations: &Equations) -> Self {
        let delays = input_delays(equations, &[]);
        let longest = delays.iter().copied().fold(0.0, f64::max);
        Self { longest, waits: delays.iter().map(|delay| longest - delay).collect() }
    }

    /// Of a plan that knows no delays, whose vehicle has some: it is watched until the last command has acted.
    pub fn unknown(self) -> Self {
        Self { waits: vec![0.0; self.waits.len()], ..self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::{Applied, named};
    use crate::model::Model;

    fn car(delays: &[(Option<&str>, f64)]) -> Equations {
        let car = Model::new("car", &[("wheel_radius", 0.3), ("wheelbase", 2.0)]).unwrap();
        let delayed = delays.iter().fold(car, |model, (input, delay)| {
            let effect = named("input-delay").unwrap();
            let effect = input.map_or_else(|| effect.clone(), |role| effect.on_input(role, "rad", 1.0));
            model.with_effect(Applied::new(&effect, None, vec![*delay]))
        });
        delayed.equations(&[]).unwrap()
    }

    #[test]
    fn inputs_wait_for_the_one_that_acts_last() {
        let none = DeadTime::of(&car(&[]));
        assert_eq!((none.longest, none.waits), (0.0, vec![0.0; 2]));
        let all = DeadTime::of(&car(&[(None, 0.2)]));
        assert_eq!((all.longest, all.waits), (0.2, vec![0.0; 2]));
        let one = DeadTime::of(&car(&[(None, 0.1), (Some("steering_angle"), 0.3)]));
        assert!((one.longest - 0.4).abs() < 1e-15);
        assert!(one.waits.contains(&0.0) && one.waits.iter().any(|w| (w - 0.3).abs() < 1e-15), "{one:?}");
        // A log that is late: what was logged for later has happened already, and nothing can be commanded before its time.
        let late = DeadTime::of(&car(&[(None, -0.2)]));
        assert_eq!((late.longest, late.waits), (0.0, vec![0.2; 2]));
    }
}
