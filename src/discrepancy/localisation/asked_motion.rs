//! The motion that inputs ask for without any effect: what regimes of driving and the gates of scopes are told by.

use crate::error::Result;
use crate::formula::{Expr, Symbol};
use crate::model::Model;
use crate::model::reference_speeds::REFERENCE;
use crate::motion::Signals;
use std::collections::BTreeMap;

/// What a model makes of its inputs alone.
#[derive(Default)]
pub(crate) struct AskedMotion {
    inputs: Vec<String>,
    fixed: BTreeMap<Symbol, f64>,
    speeds: [Expr; 3],
}

/// The same at one time.
pub(crate) struct AskedAt<'a> {
    of: &'a AskedMotion,
    u: Vec<f64>,
    slope: Vec<f64>,
}

impl AskedMotion {
    /// Of a model.
    ///
    /// # Errors
    /// When the model's formulas are malformed.
    pub fn of(model: &Model) -> Result<Self> {
        Ok(Self { inputs: model.inputs.clone(), fixed: model.fixed().values(), speeds: model.reference_speeds()? })
    }

    /// At a time of some inputs.
    pub fn at(&self, signals: &Signals, time: f64) -> AskedAt<'_> {
        let (mut u, mut slope) = (vec![0.0; signals.channels()], vec![0.0; signals.channels()]);
        signals.at(time, &mut u, &mut slope);
        AskedAt { of: self, u, slope }
    }
}

impl AskedAt<'_> {
    /// The forward speed, its rate, and the yaw rate.
    pub fn speeds(&self) -> [f64; 3] {
        self.of.speeds.each_ref().map(|speed| self.speed(speed))
    }

    /// An input, the rate of one, a parameter, or one of these speeds by its name; not a number for any other.
    pub fn value(&self, s: &Symbol) -> f64 {
        match REFERENCE.iter().position(|name| *name == s.as_str()) {
            Some(k) => self.speed(&self.of.speeds[k]),
            None => self.known(s),
        }
    }

    fn speed(&self, of: &Expr) -> f64 {
        of.eval(&|s| self.known(s)).unwrap_or(f64::NAN)
    }

    fn known(&self, s: &Symbol) -> f64 {
        let name = s.as_str();
        let input = |name: &str| self.of.inputs.iter().position(|role| role == name);
        let rate = name.strip_suffix('\'').and_then(input).map(|k| self.slope[k]);
        input(name).map(|k| self.u[k]).or(rate).or_else(|| self.of.fixed.get(s).copied()).unwrap_or(f64::NAN)
    }
}
