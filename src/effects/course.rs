//! The course of a parameter: one that moves with time at a constant rate.
//!
//! p(t) = p + p_per_s·(t − since)

/// A parameter of an effect that moves with time at a constant rate.
///
/// | symbol | unit | meaning |
/// |---|---|---|
/// | p | of the parameter | its value at `since` |
/// | p_per_s | unit/s | how fast it moves: a parameter of the effect, beside p |
///
/// ```
/// use creepage::effects;
/// let warming = effects::named("yaw-rate-bias").unwrap().drifting("bias", 0.0).unwrap();
/// assert_eq!(warming.parameters["bias_per_s"].unit, "rad/s/s");
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Course {
    /// The parameter that moves.
    pub parameter: String,
    /// The time at which it has its value, s.
    pub since: f64,
}

/// How the rate of a parameter is called.
const RATE: &str = "_per_s";
/// How the time at which it has its value is called in formulas.
pub(super) const SINCE: &str = "since";
impl Course {
    /// The name of the rate among the parameters of the effect.
    pub fn rate(&self) -> String {
        format!("{}{RATE}", self.parameter)
    }
}
