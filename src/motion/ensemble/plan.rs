//! How a sweep of cases is first integrated: the order of the method and the number of steps.

/// How a sweep's cases are first tried: the order, and how many steps.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    pub(super) order: i32,
    pub(super) steps: f64,
}
