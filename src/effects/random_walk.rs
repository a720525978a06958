//! A parameter that walks at random: the other course beside one at a constant rate.

/// A parameter of an effect that walks at random about its value, as the bias of a gyroscope does.
///
/// p(t) = p + w(t), the variance of w(t) − w(t') is per_sqrt_s²·|t − t'|
///
/// | symbol | unit | meaning |
/// |---|---|---|
/// | p | of the parameter | its value, which a simulation takes |
/// | per_sqrt_s | unit/√s | the deviation of its steps over a second |
///
/// ```
/// use creepage::effects::{self, RandomWalk};
/// let mut bias = effects::named("yaw-rate-bias").unwrap().clone();
/// bias.walk = Some(RandomWalk { parameter: "bias".into(), per_sqrt_s: 1e-4, std: None });
/// assert!(bias.course.is_none());
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct RandomWalk {
    /// The parameter that walks.
    pub parameter: String,
    /// The deviation of its steps over a second, in its unit.
    pub per_sqrt_s: f64,
    /// The standard deviation of that, where data gave it.
    pub std: Option<f64>,
}
