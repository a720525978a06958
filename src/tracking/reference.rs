//! The reference of tracking: a plan at the samples of a controller.

/// What a model is led along: measured values and commands, a row a sample.
#[derive(Clone, Debug)]
pub struct Reference {
    /// x, y, heading, headings of trailers.
    pub poses: Vec<Vec<f64>>,
    /// The commands under which the model that it was planned on goes there.
    pub commands: Vec<Vec<f64>>,
}

impl Reference {
    /// Row of a sample; behind the end it stays.
    fn at(rows: &[Vec<f64>], k: usize) -> &[f64] {
        rows.get(k).or(rows.last()).map_or(&[], Vec::as_slice)
    }

    /// The commands of a sample.
    pub fn command(&self, k: usize) -> &[f64] {
        Self::at(&self.commands, k)
    }

    /// The pose of a sample.
    pub fn pose(&self, k: usize) -> &[f64] {
        Self::at(&self.poses, k)
    }
}
