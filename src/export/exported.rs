//! What an export gives.

/// A text for a robot, and what it could not say.
#[derive(Clone, Debug, PartialEq)]
pub struct Exported {
    /// The text.
    pub text: String,
    /// Effects of the model that the target has no place for.
    pub unsaid: Vec<String>,
}
