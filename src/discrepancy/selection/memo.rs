//! Answers kept for the next time the same is asked (memoisation; Michie 1968).

use crate::discrepancy::estimation::fit::Fit;
use crate::discrepancy::estimation::noise_model::NoiseModel;
use crate::discrepancy::shooting::windows::WindowStates;
use crate::effects::{Applied, Effect};
use std::collections::VecDeque;
use std::sync::Mutex;

/// Answers that are kept: those of a model's effects, one after another.
const KEPT: usize = 8;

/// Fits with another effect in the place of a chosen one, by the fit and the library that were asked.
#[derive(Debug, Default)]
pub struct Memo(Mutex<VecDeque<(Question, Answer)>>);

/// What was asked: all that an answer depends on beside the runs. Fits of two vehicles have no deviance in common to the last bit.
#[derive(Clone, Debug, PartialEq)]
pub struct Question {
    effects: Vec<Applied>,
    deviance: u64,
    window_states: WindowStates,
    variances: NoiseModel,
    chosen: Applied,
    library: Vec<Effect>,
    given: Vec<Applied>,
}

/// Other effects, each with a fit.
pub type Answer = Vec<(Applied, Fit)>;

impl Question {
    /// Which effects of a library may stand in the place of a chosen one of a fit, or of one that the model was given with.
    pub fn of(fit: &Fit, chosen: &Applied, (library, given): (&[Effect], &[Applied])) -> Self {
        Self {
            effects: fit.model.effects.clone(),
            deviance: fit.deviance.to_bits(),
            window_states: fit.window_states.clone(),
            variances: fit.variances.clone(),
            chosen: chosen.clone(),
            library: library.to_vec(),
            given: given.to_vec(),
        }
    }
}

impl Memo {
    /// The answer to a question, found where it was not asked before.
    ///
    /// # Errors
    /// Those of finding it; nothing is kept then.
    pub fn answer<E>(&self, question: Question, find: impl FnOnce() -> Result<Answer, E>) -> Result<Answer, E> {
        let known =
            |kept: &VecDeque<(Question, Answer)>| kept.iter().find(|(q, _)| *q == question).map(|(_, a)| a.clone());
        if let Some(known) = self.0.lock().ok().and_then(|kept| known(&kept)) {
            return Ok(known);
        }
        let found = find()?;
        if let Ok(mut kept) = self.0.lock() {
            kept.push_back((question, found.clone()));
            if kept.len() > KEPT {
                kept.pop_front();
            }
        }
        Ok(found)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrepancy::estimation::noise_model::Start;
    use crate::effects::named;
    use crate::model::freedom::Freedom;
    use std::cell::Cell;

    fn question(deviance: f64) -> Question {
        let start = Start { variance: 1.0, is_measured: true, is_known: false };
        Question {
            effects: vec![],
            deviance: deviance.to_bits(),
            window_states: vec![],
            variances: NoiseModel::starting(Freedom::default(), std::iter::repeat_n(start, 2)),
            chosen: Applied::new(named("rotation-creep").unwrap(), None, vec![0.1]),
            library: vec![],
            given: vec![],
        }
    }

    #[test]
    fn a_question_is_answered_once_by_the_same_problem() {
        let (memo, found) = (Memo::default(), Cell::new(0));
        let ask = |memo: &Memo, question: Question| {
            memo.answer(question, || {
                Ok::<_, ()>({
                    found.set(found.get() + 1);
                    vec![]
                })
            })
        };
        let after = |question: Question| {
            ask(&memo, question).unwrap();
            found.get()
        };
        assert_eq!([after(question(1.0)), after(question(1.0))], [1, 1]);
        // Anything else is another question.
        let other = Applied::new(named("traverse-creep").unwrap(), None, vec![0.1]);
        assert_eq!(after(Question { chosen: other, ..question(1.0) }), 2);
        assert_eq!(after(Question { library: vec![named("wheel-radius").unwrap().clone()], ..question(1.0) }), 3);
        (0..KEPT).for_each(|i| assert_eq!(after(question(2.0 + i as f64)), 4 + i));
        // The first was forgotten meanwhile.
        assert_eq!(after(question(1.0)), 4 + KEPT);
        // What fails is asked again.
        assert!(memo.answer(question(0.0), || Err("no")).is_err());
        assert_eq!(after(question(0.0)), 5 + KEPT);
    }
}
