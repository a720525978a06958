//! Findings of the state of the data, each with its numbers.

use crate::discrepancy::diagnosis::warning::Warning;
use crate::discrepancy::preprocessing::clock_jumps::ClockJump;
use crate::discrepancy::preprocessing::quantisation::CoarseInput;
use crate::discrepancy::preprocessing::reference_jumps::Jumps;
use crate::discrepancy::preprocessing::row_defects::RowDefect;
use crate::discrepancy::preprocessing::unit_errors::{Slip, TurningCause, WayCause};
use crate::discrepancy::selection::odd_run::OddRun;
use std::collections::BTreeMap;

/// Something to know of the data.
#[derive(Clone, Debug, PartialEq)]
pub enum DataFinding {
    /// Many rows of a run are left out.
    RowsDropped {
        /// Name of the run.
        run: String,
        /// Rows left out.
        dropped: usize,
        /// Of so many.
        all: usize,
        /// Rows left out by reason.
        why: BTreeMap<String, usize>,
    },
    /// The log of a run is interrupted.
    Interrupted {
        /// Name of the run.
        run: String,
        /// How often.
        times: usize,
        /// Longest interruption, s.
        longest: f64,
    },
    /// Rows of a run are so far apart, s, that time may have another unit.
    TimeUnit {
        /// Name of the run.
        run: String,
        /// s
        step: f64,
    },
    /// Times between the rows of a run scatter.
    UnevenTimes {
        /// Name of the run.
        run: String,
        /// Share of the usual time.
        jitter: f64,
    },
    /// The measured way is another than the model's.
    Way {
        /// Name of the run.
        run: String,
        /// Measured over modelled.
        ratio: f64,
        /// The usual slip that it looks like.
        cause: WayCause,
    },
    /// The measured turning is another than the model's.
    Turning {
        /// Name of the run.
        run: String,
        /// Measured over modelled.
        ratio: f64,
        /// The usual slip that it looks like.
        cause: TurningCause,
    },
    /// The runs hardly turn.
    NoTurns,
    /// The runs turn to one side only.
    OneTurnDirection(Side),
    /// The runs have one speed, m/s.
    OneSpeed(f64),
    /// No heading is measured.
    NoHeading,
    /// What reading a run's file gave, in words of the reader.
    Reading {
        /// Name of the run.
        run: String,
        /// The words.
        says: String,
    },
    /// An input comes in coarse steps.
    CoarseInput(CoarseInput),
    /// The pose's noise is alike over so many rows.
    ColouredNoise(f64),
    /// The runs hold motion that the model does not explain, most of it at this place of the model.
    UnexplainedMotion(&'static str),
    /// Something is wrong with rows, or in a stretch.
    Defect(RowDefect),
    /// A clock jumps within a run.
    ClockJump(ClockJump),
    /// A slip of units and columns.
    Slip(Slip),
    /// The reference jumps in a stretch, which is left out.
    Jumps(Jumps),
    /// A run differs from the others.
    OddRun(Box<OddRun>),
    /// What a run's clocks leave to know.
    Clock(Box<Warning>),
}

/// A side of the vehicle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// To the left.
    Left,
    /// To the right.
    Right,
}

impl DataFinding {
    /// Whether it says how the vehicle was driven, by its model.
    pub fn is_of_motion(&self) -> bool {
        matches!(
            self,
            Self::Way { .. } | Self::Turning { .. } | Self::NoTurns | Self::OneTurnDirection(_) | Self::OneSpeed(_)
        )
    }

    /// Its kind, for scripts.
    pub fn id(&self) -> &'static str {
        match self {
            Self::RowsDropped { .. } => "rows-dropped",
            Self::Interrupted { .. } => "gaps",
            Self::TimeUnit { .. } => "time-unit",
            Self::UnevenTimes { .. } => "uneven-times",
            Self::Way { .. } => "way",
            Self::Turning { .. } => "turning",
            Self::NoTurns => "no-turns",
            Self::OneTurnDirection(_) => "one-turn-direction",
            Self::OneSpeed(_) => "one-speed",
            Self::NoHeading => "no-heading",
            Self::Reading { .. } => "order",
            Self::CoarseInput(_) => "coarse-inputs",
            Self::ColouredNoise(_) => "coloured-noise",
            Self::UnexplainedMotion(_) => "unexplained-motion",
            Self::Slip(slip) => slip.id(),
            Self::Defect(defect) => defect.id(),
            Self::ClockJump(_) => "clock-jump",
            Self::Jumps(_) => "reference-jumps",
            Self::OddRun(_) => "odd-run",
            Self::Clock(_) => "clock-offset",
        }
    }
}
