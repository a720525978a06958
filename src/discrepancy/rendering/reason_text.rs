//! The reason of a verdict in a sentence.

use super::{other_vehicle_text, slip_text};
use crate::discrepancy::diagnosis::reason::{MissedMotion, Reason};
use crate::discrepancy::preprocessing::slip_angle::SlidingRun;
use crate::discrepancy::preprocessing::unit_errors::Slip;
use crate::number_format::significant;
use crate::wording::listed;

/// A reason as the sentence of a report's verdict.
pub fn sentence(reason: &Reason) -> String {
    match reason {
        Reason::Slip(slip) => slip_text::sentence(slip),
        Reason::PosesStand => {
            "The inputs say that the vehicle moves in these runs, but the poses show no more than their \
                               scatter from row to row, so nothing can be said about its model."
                .into()
        }
        Reason::NothingMoves => {
            "The vehicle does not move in these runs, so nothing can be said about its model.".into()
        }
        Reason::TooFewWindows { windows, needed } => format!(
            "These runs are too short to tell: {windows} windows of one second, and at least {needed} are needed."
        ),
        Reason::UndefinedMotion => {
            "The model is undefined somewhere along these runs (a steering angle of 90°, or Rocard's friction at rest, say), so it \
                                    cannot be fitted."
                .into()
        }
        Reason::MissesMotion { motion, share, slip } => misses(*motion, *share, slip.as_deref()),
        Reason::Slides { run, span: [from, to], angle } => format!(
            "The vehicle slides: in {run} from {from:.1} to {to:.1} s it moves more than {:.0}° beside where its model \
             points, and creep does not describe that; leave this stretch out.",
            angle.to_degrees()
        ),
        Reason::Drifts(SlidingRun { run, span: [from, to], angle, share }) => format!(
            "The vehicle drifts: in {run} from {from:.1} to {to:.1} s its body slides at {:.0}° to its way, and beyond 30° for \
             {:.0} % of the time driven; no coefficient of creep describes that, so leave these stretches out.",
            angle.to_degrees(),
            100.0 * share
        ),
        Reason::ClocksDrift { run, total } => format!(
            "The clocks do not match: in {run} the delay between inputs and measured pose drifts by {:.0} ms, so neither \
             constraints nor effects can be judged; give the log to --truth as well, and its clocks are aligned.",
            1000.0 * total.abs()
        ),
        Reason::PartlyInconsistent(effects) => {
            let names = listed(effects.iter().map(|e| e.label()));
            format!("The model misses {names}; what else remains differs between parts of these runs and is not named.")
        }
        Reason::InputsTooSeldom => "The inputs change faster than they are logged, so nothing can be named.".into(),
        Reason::Inconsistent => "Model and measurement disagree, but not alike in all parts of these runs.".into(),
        Reason::Unexplained => "Model and measurement disagree, and neither an effect of the library nor a simple law \
                                explains it."
            .into(),
        Reason::SensorsDisagree(names) => format!(
            "The poses are explained, but what is measured of {} disagrees with the model by more than its noise, and no effect \
             of the library explains it.",
            listed(names.iter().cloned())
        ),
        Reason::OtherVehicle(other) => other_vehicle_text::sentence(other),
        Reason::Missed(effect) => {
            let label = effect.label();
            format!("Nothing significant was found, but these runs could not have shown a plausible {label}.")
        }
        Reason::Trace(places) => format!(
            "No effect is missing that can be named: the model explains these runs but for a trace at the {}, more than \
             chance and less than their noise.",
            listed(places.iter().copied())
        ),
        Reason::RandomRest(places) => format!(
            "No effect is missing that can be named: what the model leaves at the {} is random from second to second, as slip \
             or noise of the inputs makes it.",
            listed(places.iter().copied())
        ),
        Reason::ClockTooLong { run, lasts, longest } => format!(
            "The clocks of {run} cannot be aligned: it lasts {} s, and at most {} s can be; is its time in seconds?",
            significant(*lasts, 3),
            significant(*longest, 2)
        ),
        Reason::ClockTooShort { run, truth, lasts, needed } => format!(
            "{run} and {truth} are too short to find how their clocks belong together: {} s, and at least {} s are needed.",
            significant(*lasts, 2),
            significant(*needed, 2)
        ),
        Reason::ClocksUnlike { run, truth } => format!(
            "No offset of their clocks makes the inputs of {run} move as the poses of {truth} do: check that both are of one \
             drive, the columns and the units."
        ),
    }
}

fn misses(motion: MissedMotion, share: f64, slip: Option<&Slip>) -> String {
    let motion = match motion {
        MissedMotion::Way => "motion",
        MissedMotion::Turning => "turning",
    };
    let why =
        slip.map_or_else(|| "clocks, columns or units do not match, or the wheels spin.".into(), slip_text::clause);
    let percent = 100.0 * share.min(1.0);
    format!("The model misses {percent:.0} % of the {motion} over one second, whatever is added: {why}")
}
