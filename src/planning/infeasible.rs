//! Reasons why a goal is not reached.

use super::reachability::Fixed;

/// Why there is no plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Infeasible {
    /// There is one without the limits of the inputs.
    Limits,
    /// There is one that bends the train further.
    JackKnife,
    /// There is one that takes longer.
    Duration,
    /// It would change of the pose, or of one to pass, what no input changes.
    Fixed(Fixed),
    /// None was found without any of them either.
    Unreached,
}
