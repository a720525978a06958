//! Defects of rows: what a logger makes of them, and what happens to a vehicle that its model does not know.

use std::ops::Range;

/// Something wrong with rows of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct RowDefect {
    /// Name of the run.
    pub run: String,
    /// What it is.
    pub kind: DefectKind,
}

/// The kinds of it.
#[derive(Clone, Debug, PartialEq)]
pub enum DefectKind {
    /// The measured pose is filled forward.
    Held {
        /// Rows that hold the pose of the row before.
        rows: usize,
        /// Of so many.
        all: usize,
        /// The usual time between poses that are measured, s.
        every: f64,
    },
    /// Rows repeat the row before them, inputs and pose.
    Repeated {
        /// How many.
        rows: usize,
        /// The first one, s.
        first: f64,
    },
    /// An input is far off in single rows.
    Spikes {
        /// The input.
        role: String,
        /// When, s.
        at: Vec<f64>,
    },
    /// An input stands at an end of its range while the vehicle does more.
    Clipped {
        /// The input.
        role: String,
        /// That end.
        value: f64,
        /// Rows in which it stands there.
        rows: usize,
        /// In so many stretches.
        times: usize,
    },
    /// The inputs say motion and the pose stands still, s.
    Stands([f64; 2]),
    /// The pose moves and the inputs say that the vehicle stands, s.
    Carried([f64; 2]),
}

impl RowDefect {
    /// Its kind, for scripts.
    pub fn id(&self) -> &'static str {
        match self.kind {
            DefectKind::Held { .. } => "pose-held",
            DefectKind::Repeated { .. } => "repeated-rows",
            DefectKind::Spikes { .. } => "input-spikes",
            DefectKind::Clipped { .. } => "input-clipped",
            DefectKind::Stands(_) => "lifted",
            DefectKind::Carried(_) => "carried",
        }
    }

    /// The stretch that is left out for it, s.
    pub fn span(&self) -> Option<[f64; 2]> {
        match self.kind {
            DefectKind::Stands(span) | DefectKind::Carried(span) => Some(span),
            _ => None,
        }
    }
}

/// Rows in a row with the same answer, as ranges of those whose answer is yes.
pub(super) fn stretches(rows: usize, is_one: impl Fn(usize) -> bool) -> Vec<Range<usize>> {
    let all: Vec<usize> = (0..rows).filter(|i| is_one(*i)).collect();
    all.chunk_by(|a, b| a + 1 == *b).map(|rows| rows[0]..rows[rows.len() - 1] + 1).collect()
}
