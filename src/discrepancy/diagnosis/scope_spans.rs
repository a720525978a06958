//! When the scopes of found effects are open along a run: each gate evaluated at what the vehicle does there.

use crate::discrepancy::localisation::asked_motion::AskedMotion;
use crate::discrepancy::shooting::rollout::Rollout;
use crate::effects::Applied;
use crate::error::Result;
use crate::formula::{Expr, Symbol};
use crate::model::Model;
use std::collections::BTreeMap;

/// Gates of effects that hold in part, and what they speak of.
#[derive(Default)]
pub(crate) struct Gates {
    /// Each with the numbers of its scope.
    gates: Vec<(Expr, BTreeMap<String, f64>)>,
    asked: AskedMotion,
}

impl Gates {
    /// Of the effects of a model.
    ///
    /// # Errors
    /// When the model's formulas are malformed.
    pub fn of<'a>(model: &Model, effects: impl Iterator<Item = &'a Applied>) -> Result<Self> {
        let scopes = effects.filter_map(|e| e.effect.scope.as_ref());
        let gates: Vec<_> = scopes.map(|s| (s.gate(), s.numbers().into_iter().collect())).collect();
        // Without one nothing has to be known of the model.
        let asked = if gates.is_empty() { AskedMotion::default() } else { AskedMotion::of(model)? };
        Ok(Self { gates, asked })
    }

    /// From when until when some gate is open, looked at at some rows in their order.
    pub fn spans(&self, along: &Rollout, rows: &[usize]) -> Vec<[f64; 2]> {
        if self.gates.is_empty() {
            return vec![];
        }
        let (_, time) = along.rows();
        let mut found: Vec<[f64; 2]> = vec![];
        let mut was_open = false;
        for i in rows {
            let is_open = self.is_open(along, *i);
            match found.last_mut().filter(|_| was_open) {
                Some(span) => span[1] = time[*i],
                None if is_open => found.push([time[*i]; 2]),
                None => {}
            }
            was_open = is_open;
        }
        found
    }

    fn is_open(&self, along: &Rollout, i: usize) -> bool {
        let (place, t) = (along.measured(i), along.rows().1[i]);
        let asked = self.asked.at(along.signals(), t);
        self.gates.iter().any(|(gate, numbers)| {
            let value = |s: &Symbol| match s.as_str() {
                "x" => place[0],
                "y" => place[1],
                "t" => t,
                // Times are those of the log.
                "delay" => 0.0,
                name => numbers.get(name).copied().unwrap_or_else(|| asked.value(s)),
            };
            gate.eval(&value).is_some_and(|open| open > 0.5)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrepancy::fixtures::{applied, equations, logged, unicycle};
    use crate::effects::{DrivingRegime, Scope};

    /// Forwards for ten seconds, back for ten, forwards again; a quarter turn to the left a second in the middle.
    #[test]
    fn a_gate_is_open_when_its_regime_is_driven() {
        let wheel = |t: f64| if (10.0..20.0).contains(&t) { -1.0 } else { 1.0 };
        let turn = |t: f64| if (14.0..16.0).contains(&t) { 0.5 } else { 0.0 };
        let (equations, p) = equations(&[]);
        let time = (0..=600).map(|i| 0.05 * f64::from(i)).collect();
        let record = logged((&equations, &p), time, [&wheel, &turn], &[0.0; 3], 0.0);
        let model = unicycle(&[]);
        let along = Rollout::new(&model, &record).unwrap();
        let rows: Vec<usize> = (0..600).step_by(4).collect();
        let spans = |scopes: &[Scope]| {
            let effects: Vec<Applied> = scopes
                .iter()
                .map(|s| {
                    let creep = applied("rotation-creep");
                    Applied { effect: creep.effect.within(s.clone()), ..creep }
                })
                .collect();
            Gates::of(&model, effects.iter()).unwrap().spans(&along, &rows)
        };
        let near = |found: &[[f64; 2]], [from, until]: [f64; 2]| {
            found.len() == 1 && (found[0][0] - from).abs() < 0.3 && (found[0][1] - until).abs() < 0.3
        };
        assert!(near(&spans(&[Scope::Regime(DrivingRegime::Reverse)]), [10.0, 20.0]));
        assert!(near(&spans(&[Scope::Times(vec![[3.0, 7.0]])]), [3.0, 7.0]));
        assert!(near(&spans(&[Scope::Regime(DrivingRegime::Left)]), [14.0, 16.0]));
        assert_eq!(spans(&[Scope::Times(vec![[3.0, 7.0]]), Scope::Regime(DrivingRegime::Reverse)]).len(), 2);
        assert!(spans(&[]).is_empty());
        // Half a metre a second: ten of them lead out of the disk.
        let disk = spans(&[Scope::Disk([1.0, 0.0, 1.0])]);
        assert!(disk.first().is_some_and(|d| d[0] < 0.3 && (d[1] - 4.0).abs() < 0.5), "{disk:?}");
    }
}
