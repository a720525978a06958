//! Regimes of driving in words.

use crate::discrepancy::localisation::driving_regimes::{DrivingRegime, Stretch};
use crate::discrepancy::report::Disagreement;

/// A stretch as the report lists it.
pub fn disagreement(of: &Stretch) -> Disagreement {
    Disagreement {
        run: of.run.clone(),
        place: of.place.into(),
        from: of.span[0],
        to: of.span[1],
        regime: regime(of.regime).into(),
        share_of_gap: of.share,
    }
}

/// A regime of driving.
pub fn regime(of: DrivingRegime) -> &'static str {
    match of {
        DrivingRegime::Whole => "the whole run",
        DrivingRegime::LeftTurns => "left turns",
        DrivingRegime::RightTurns => "right turns",
        DrivingRegime::Turns => "turns to both sides",
        DrivingRegime::Straight => "straight driving",
        DrivingRegime::Fast => "fast driving",
        DrivingRegime::Slow => "slow driving",
        DrivingRegime::SpeedingUp => "speeding up",
        DrivingRegime::SlowingDown => "slowing down",
        DrivingRegime::HighLoad => "high lateral load",
        DrivingRegime::TightCurves => "tight curves",
        DrivingRegime::Transitions => "entering and leaving curves",
    }
}
