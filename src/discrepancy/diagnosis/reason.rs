//! Why a verdict was given, as data.

use crate::discrepancy::preprocessing::slip_angle::SlidingRun;
use crate::discrepancy::preprocessing::unit_errors::Slip;
use crate::discrepancy::selection::other_vehicle::OtherVehicle;
use crate::effects::Applied;

/// The reason of a verdict, where the report's numbers do not say it by themselves.
#[derive(Clone, Debug)]
pub enum Reason {
    /// Units or columns are wrong.
    Slip(Slip),
    /// Inputs say that the vehicle moves, poses that it stands.
    PosesStand,
    /// Nothing moves.
    NothingMoves,
    /// Fewer windows than a statement needs.
    TooFewWindows {
        /// Windows there are.
        windows: usize,
        /// Windows needed.
        needed: usize,
    },
    /// The model has no motion somewhere along the runs.
    UndefinedMotion,
    /// The model misses most of the motion, whatever is added.
    MissesMotion {
        /// Of what.
        motion: MissedMotion,
        /// Share that is missed.
        share: f64,
        /// A slip that does so.
        slip: Option<Box<Slip>>,
    },
    /// The vehicle slides beyond creep.
    Slides {
        /// Name of the run.
        run: String,
        /// Start and end, s.
        span: [f64; 2],
        /// The slip angle that is exceeded, rad.
        angle: f64,
    },
    /// The vehicle drifts: its body slides at large angles, whatever the inputs say.
    Drifts(SlidingRun),
    /// The delay between inputs and poses drifts.
    ClocksDrift {
        /// Name of the run.
        run: String,
        /// By how much over the run, s.
        total: f64,
    },
    /// Effects were named, and parts of the runs contradict each other in what remains.
    PartlyInconsistent(Vec<Applied>),
    /// Inputs change faster than they are logged.
    InputsTooSeldom,
    /// Model and data disagree, but not alike in all parts of the runs.
    Inconsistent,
    /// Model and data disagree, and neither an effect nor a law explains it.
    Unexplained,
    /// The poses are explained, and sensors beside them, by these names, disagree with the model.
    SensorsDisagree(Vec<String>),
    /// Another vehicle explains the runs to their noise.
    OtherVehicle(Box<OtherVehicle>),
    /// An effect of plausible size would have been missed.
    Missed(Box<Applied>),
    /// The model leaves less than the noise, more than chance, at these places.
    Trace(Vec<&'static str>),
    /// The model leaves motion at these places that is random from second to second.
    RandomRest(Vec<&'static str>),
    /// A file is too long for its clock to be looked for.
    ClockTooLong {
        /// Name of the run.
        run: String,
        /// s
        lasts: f64,
        /// s
        longest: f64,
    },
    /// Files are too short to find how their clocks belong together.
    ClockTooShort {
        /// Name of the inputs.
        run: String,
        /// Name of the poses.
        truth: String,
        /// s
        lasts: f64,
        /// s
        needed: f64,
    },
    /// No offset of the clocks makes both files one drive.
    ClocksUnlike {
        /// Name of the inputs.
        run: String,
        /// Name of the poses.
        truth: String,
    },
}

/// What a model misses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MissedMotion {
    /// The way.
    Way,
    /// The turning.
    Turning,
}
