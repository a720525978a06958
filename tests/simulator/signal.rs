//! Smooth functions of time whose means over an interval are known in closed form.

use std::ops::{Add, Mul, Neg};

/// One term of a signal.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Term {
    /// `level`
    Constant { level: f64 },
    /// `amplitude·sin(rate·t + phase)`
    Wave { amplitude: f64, rate: f64, phase: f64 },
    /// `height·(1 + tanh((t − at)/width))/2`
    Step { height: f64, at: f64, width: f64 },
}

impl Term {
    fn value(self, t: f64) -> f64 {
        match self {
            Term::Constant { level } => level,
            Term::Wave { amplitude, rate, phase } => amplitude * (rate * t + phase).sin(),
            Term::Step { height, at, width } => 0.5 * height * (1.0 + ((t - at) / width).tanh()),
        }
    }

    /// A function whose derivative is `value`.
    fn antiderivative(self, t: f64) -> f64 {
        match self {
            Term::Constant { level } => level * t,
            Term::Wave { amplitude, rate, phase } => -amplitude / rate * (rate * t + phase).cos(),
            Term::Step { height, at, width } => 0.5 * height * (t - at + width * ln_cosh((t - at) / width)),
        }
    }

    fn scaled(self, by: f64) -> Self {
        match self {
            Term::Constant { level } => Term::Constant { level: level * by },
            Term::Wave { amplitude, rate, phase } => Term::Wave { amplitude: amplitude * by, rate, phase },
            Term::Step { height, at, width } => Term::Step { height: height * by, at, width },
        }
    }

    /// The term read backwards, `t ↦ value(end − t)`.
    fn reversed(self, end: f64) -> Self {
        match self {
            Term::Constant { .. } => self,
            Term::Wave { amplitude, rate, phase } => Term::Wave { amplitude, rate: -rate, phase: phase + rate * end },
            Term::Step { height, at, width } => Term::Step { height, at: end - at, width: -width },
        }
    }
}

/// `ln cosh x` without overflow for large arguments.
fn ln_cosh(x: f64) -> f64 {
    x.abs() + (-2.0 * x.abs()).exp().ln_1p() - std::f64::consts::LN_2
}

/// A sum of constants, sine waves and smooth steps, defined for all times (s).
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Signal(Vec<Term>);

impl Signal {
    /// The constant `level`.
    pub fn constant(level: f64) -> Self {
        Signal(vec![Term::Constant { level }])
    }

    /// `amplitude·sin(2π·t/period + phase)`, period in s and phase in rad.
    pub fn wave(amplitude: f64, period: f64, phase: f64) -> Self {
        let rate = std::f64::consts::TAU / period;
        Signal(vec![Term::Wave { amplitude, rate, phase }])
    }

    /// `height·(1 + tanh((t − at)/width))/2`, a step of `height` around the time `at` (s).
    pub fn step(height: f64, at: f64, width: f64) -> Self {
        Signal(vec![Term::Step { height, at, width }])
    }

    /// A bump of `height` between the times `from` and `to` (s); its area is `height·(to − from)`.
    pub fn pulse(height: f64, from: f64, to: f64, width: f64) -> Self {
        Self::step(height, from, width) + Self::step(-height, to, width)
    }

    /// The value at time `t` (s).
    pub fn value(&self, t: f64) -> f64 {
        self.0.iter().map(|term| term.value(t)).sum()
    }

    /// The exact mean between the times `from` and `to` (s); the value where they coincide.
    pub fn mean(&self, from: f64, to: f64) -> f64 {
        if from == to {
            return self.value(to);
        }
        let area = |term: &Term| term.antiderivative(to) - term.antiderivative(from);
        self.0.iter().map(area).sum::<f64>() / (to - from)
    }

    /// The signal read backwards from `end` (s): `t ↦ value(end − t)`.
    pub fn reversed(&self, end: f64) -> Self {
        Signal(self.0.iter().map(|term| term.reversed(end)).collect())
    }
}

impl Add for Signal {
    type Output = Signal;
    fn add(mut self, other: Signal) -> Signal {
        self.0.extend(other.0);
        self
    }
}

impl Mul<f64> for Signal {
    type Output = Signal;
    fn mul(self, by: f64) -> Signal {
        Signal(self.0.into_iter().map(|term| term.scaled(by)).collect())
    }
}

impl Neg for Signal {
    type Output = Signal;
    fn neg(self) -> Signal {
        self * -1.0
    }
}
