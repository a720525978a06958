//! The motion as a sensor sees it: rates of what is measured in terms of what is measured.

use super::relation::Measured;
use crate::formula::{Expr, Fun, Scalar, Symbol};
use crate::mechanism::Definitions;
use crate::model::{Model, trailer_heading};
use std::collections::{BTreeMap, BTreeSet};

/// A model whose true state is written as what the sensor shows, x = x_m − …, φ = heading_m − offset, so that a
/// parameter of the sensor changes the motion as one of a constraint does.
pub struct Motion {
    /// Formulas that the motion comes down to, each after those it uses.
    formulas: Vec<(Symbol, Expr)>,
    /// Names of these and of all others that are defined.
    defined: BTreeSet<Symbol>,
    /// Where the sensor sits: lever_a, lever_b and heading_offset.
    sensor: [Expr; 3],
    measured: Measured,
    /// Headings of trailers that are measured, or that what is measured depends on.
    trailers: Vec<Symbol>,
    /// States that no sensor sees, and their rates.
    pub hidden: Vec<(Symbol, Expr)>,
}

/// How the sensor is taken to see the pose; an effect that rewrites it otherwise is not compared.
const SENSOR: [(&str, &str); 3] = [
    ("x_m", "x + lever_a*cos(phi) - lever_b*sin(phi)"),
    ("y_m", "y + lever_a*sin(phi) + lever_b*cos(phi)"),
    ("heading_m", "phi + heading_offset"),
];

impl Motion {
    /// The motion of a model; `None` where its constraints do not determine it, or its sensor is of another kind.
    pub fn of(model: &Model, measured: Measured) -> Option<Self> {
        let definitions = model.definitions().ok()?;
        let usual =
            |(name, formula): &(&str, &str)| definitions.get(&(*name).into()) == Expr::parse(formula).ok().as_ref();
        if !SENSOR.iter().all(usual) {
            return None;
        }
        let hidden: Vec<(Symbol, Expr)> = model.effects.iter().flat_map(|e| e.states()).collect();
        let mut roots: Vec<Symbol> = ["x'", "y'", "phi'", "delay"].map(Symbol::from).into();
        roots.extend(hidden.iter().flat_map(|(_, rate)| rate.symbols()));
        let seen = rests_on(&definitions, roots.clone());
        let shown = |s: &Symbol| measured.trailers || seen.contains(s);
        let trailers: Vec<Symbol> = (1..=model.trailer_count()).map(trailer_heading).filter(shown).collect();
        roots.extend(trailers.iter().map(Symbol::rate));
        let needed = rests_on(&definitions, roots);
        let formulas = definitions.sorted().ok()?.into_iter().filter(|(name, _)| needed.contains(name)).cloned();
        let sensor = ["lever_a", "lever_b", "heading_offset"].map(|name| definitions.get(&name.into()).cloned());
        let [Some(a), Some(b), Some(offset)] = sensor else { return None };
        Some(Self {
            formulas: formulas.collect(),
            defined: definitions.iter().map(|(name, _)| name.clone()).collect(),
            sensor: [a, b, offset],
            measured,
            trailers,
            hidden,
        })
    }

    /// Rates of the measured x, y and heading, the delay, the rates of trailers' headings and of hidden states.
    ///
    /// `value` gives parameters, inputs and what is measured under the names of the true states; `turn` is how far
    /// a heading that nothing measures is turned.
    pub fn rows<S: Scalar>(&self, value: &impl Fn(&Symbol) -> S, turn: Option<&S>) -> Option<Vec<S>> {
        let [a, b, offset] = &self.sensor;
        let (a, b, offset) = (a.eval(value)?, b.eval(value)?, offset.eval(value)?);
        let shown = value(&"phi".into());
        let phi = match (self.measured.heading, turn) {
            (true, _) => shown.sub(&offset),
            (false, Some(turn)) => shown.add(turn),
            (false, None) => shown,
        };
        let (cos, sin) = (S::call(Fun::Cos, &phi), S::call(Fun::Sin, &phi));
        let arm = [a.mul(&cos).sub(&b.mul(&sin)), a.mul(&sin).add(&b.mul(&cos))];
        let given = |s: &Symbol| match s.as_str() {
            "phi" => Some(phi.clone()),
            "x" => Some(value(s).sub(&arm[0])),
            "y" => Some(value(s).sub(&arm[1])),
            _ if self.defined.contains(s) => None,
            _ => Some(value(s)),
        };
        let values = self.evaluated(&given);
        let of = |name: Symbol| values.get(&name).cloned();
        let yaw = of("phi'".into())?;
        let mut rows = vec![
            of("x'".into())?.sub(&yaw.mul(&arm[1])),
            of("y'".into())?.add(&yaw.mul(&arm[0])),
            yaw,
            of("delay".into())?,
        ];
        for heading in &self.trailers {
            rows.push(of(heading.rate())?);
        }
        let known = |s: &Symbol| values.get(s).cloned().or_else(|| given(s)).unwrap_or_else(|| value(s));
        rows.extend(self.hidden.iter().map(|(_, rate)| rate.eval_undefined_as_value(&known)));
        rows.iter().all(Scalar::is_defined).then_some(rows)
    }

    /// The value of every formula; what `given` gives takes the place of a formula.
    fn evaluated<S: Scalar>(&self, given: &impl Fn(&Symbol) -> Option<S>) -> BTreeMap<&Symbol, S> {
        let undefined = || S::number(&num_traits::Zero::zero()).recip();
        let mut values: BTreeMap<&Symbol, S> = BTreeMap::new();
        for (name, formula) in &self.formulas {
            let known = |s: &Symbol| values.get(s).cloned().or_else(|| given(s)).unwrap_or_else(undefined);
            let value = given(name).unwrap_or_else(|| formula.eval_undefined_as_value(&known));
            values.insert(name, value);
        }
        values
    }

    /// Whether two motions are of the same measured things and hidden states.
    pub fn comparable(&self, other: &Motion) -> bool {
        let names = |m: &Motion| m.hidden.iter().map(|(s, _)| s.clone()).collect::<BTreeSet<_>>();
        self.trailers == other.trailers && self.measured == other.measured && names(self) == names(other)
    }
}

/// Everything that some names come down to.
fn rests_on(definitions: &Definitions, mut waiting: Vec<Symbol>) -> BTreeSet<Symbol> {
    let mut seen = BTreeSet::new();
    while let Some(s) = waiting.pop() {
        if seen.insert(s.clone()) {
            waiting.extend(definitions.get(&s).into_iter().flat_map(Expr::symbols));
        }
    }
    seen
}
