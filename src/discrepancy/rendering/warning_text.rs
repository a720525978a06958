//! Warnings in words.

use super::defect_text;
use super::effect_names::{named, values};
use super::refusal_text;
use super::slip_text;
use crate::discrepancy::diagnosis::warning::Warning;
use crate::discrepancy::preprocessing::clock_jumps::ClockJump;
use crate::discrepancy::preprocessing::dataset::DatasetNote;
use crate::discrepancy::preprocessing::quantisation::CoarseInput;
use crate::discrepancy::preprocessing::reference_jumps::Jumps;
use crate::effects::Applied;
use crate::number_format::significant;

/// A stretch in which the reference jumps.
pub fn jumped(of: &Jumps) -> String {
    let [from, to] = of.span;
    match of.times {
        1 => format!("{}: the measured pose jumps at {to:.1} s; the rows around it are left out", of.run),
        n => format!(
            "{}: the measured pose jumps {n} times between {from:.1} and {to:.1} s; this stretch is left out",
            of.run
        ),
    }
}

/// A clock that jumps.
pub fn clock_jumped(of: &ClockJump) -> String {
    let (run, by) = (&of.run, significant(of.by.abs(), 2));
    let way = if of.by > 0.0 { "later" } else { "earlier" };
    format!(
        "{run}: the clock of the pose or of the inputs jumps at {:.0} s: from then on the pose is {by} s {way}",
        of.at
    )
}

/// A warning as a line.
pub fn line(warning: &Warning) -> String {
    match warning {
        Warning::Reading { run, says } => format!("{run}: {says}"),
        Warning::Dataset(DatasetNote::Defect(defect)) => defect_text::sentence(defect),
        Warning::Dataset(DatasetNote::Jumps(jumps)) => jumped(jumps),
        Warning::Dataset(DatasetNote::ClockJump(jump)) => clock_jumped(jump),
        Warning::Dataset(DatasetNote::Interrupted { run, pieces }) => {
            format!("{run}: the log is interrupted; it is used in {pieces} pieces")
        }
        Warning::Dataset(DatasetNote::NotFitted { run }) => {
            format!("{run}: too short for a window of one second; it is not fitted")
        }
        Warning::SensorMissed(sensor) => {
            let number = |x: f64| format!("{} {}", significant(x, 2), sensor.unit).trim_end().to_string();
            let (rms, noise) = (number(sensor.rms), number(sensor.noise));
            format!("{}: the last model says it to {rms} (RMS), its rows scatter by {noise} alone", sensor.name)
        }
        Warning::HorizonTooLong(h) => format!("the runs are too short for a gap after {h} s"),
        Warning::Inconsistent(effects) => format!("{}, so that is not named", inconsistent(effects)),
        Warning::SamplingSensitive(effects) => format!("{}, so that is not named", sampling_sensitive(effects)),
        Warning::Restated { old, new } => {
            let (label, old, new) = (new.label(), values(old), values(new));
            format!("the model has {label} with {old}; these runs ask for {new} in its place")
        }
        Warning::Implausible { applied, parameter, value, usual, slip } => {
            let doubt = slip.as_ref().map_or_else(
                || ": check numbers and units of model file and log, or it imitates another effect".into(),
                |slip| format!("; {}", slip_text::clause(slip)),
            );
            let [value, usual] = [(value, 3), (usual, 2)].map(|(x, digits)| significant(*x, digits));
            format!("{} {parameter} = {value} is far beyond the usual {usual}{doubt}", applied.label())
        }
        Warning::Refuted(refused) => refusal_text::says(refused, &[]),
        Warning::HeldOutGapGrew { growth, is_judged } => {
            let [before, after] = growth.gap.map(|gap| significant(gap, 3));
            let says =
                if *is_judged { "those runs do not bear it out" } else { "one window of it, too few to judge by" };
            let horizon = growth.horizon_s;
            format!("the held-out gap after {horizon} s grows with what was found, from {before} to {after} m: {says}")
        }
        Warning::CoarseInput(input) => coarse_input(input),
        Warning::TakenAsRounded(input) => taken_as_rounded(input),
        Warning::ClockOffsetInDoubt { run, own, other } => {
            let [own, other] = [own, other].map(|offset| significant(*offset, 4));
            format!(
                "{run}: a clock offset of {other} s fits nearly as well as {own} s; give --clock-offset if you know it"
            )
        }
        Warning::DelayLeftOut => {
            "the model's input-delay is left out: it is one with the offset of the clocks, which has it".into()
        }
    }
}

/// That parts of the runs ask for effects differently.
pub fn inconsistent(effects: &[Applied]) -> String {
    format!("parts of these runs ask for other values of {}", named(effects))
}

/// That effects take other values where the inputs are logged half as often.
pub fn sampling_sensitive(effects: &[Applied]) -> String {
    format!("with every second row of the inputs left out these runs ask for other values of {}", named(effects))
}

/// An input that is taken as rounded, and not as commands.
pub fn taken_as_rounded(input: &CoarseInput) -> String {
    let CoarseInput { run, role, step, unit } = input;
    let step = significant(*step, 2);
    format!(
        "{run}: {role} comes in steps of {step} {unit}; a smooth course between them explains more than any effect, so that it \
         is taken as rounded"
    )
}

/// An input that comes in steps.
pub fn coarse_input(input: &CoarseInput) -> String {
    let CoarseInput { run, role, step, unit } = input;
    format!("{run}: {role} comes in steps of {} {unit}; what it does within one is not logged", significant(*step, 2))
}
