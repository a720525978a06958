//! Findings of the state of the data in words.

use super::{defect_text, odd_run_text, other_vehicle_text, rest_text, slip_text, warning_text};
use crate::discrepancy::identifiability::data_finding::{DataFinding, Side};
use crate::discrepancy::preprocessing::unit_errors::Slip;
use crate::discrepancy::report::Finding;
use crate::discrepancy::selection::other_vehicle::OtherVehicle;
use crate::number_format::significant;

/// A finding as the check lists it.
pub fn finding(of: &DataFinding) -> Finding {
    match of {
        DataFinding::Slip(found) => slip(found),
        other => Finding { id: other.id().into(), says: says(other), mend: None },
    }
}

/// A slip as a finding, with the lines that mend it.
pub fn slip(of: &Slip) -> Finding {
    Finding { id: of.id().into(), says: slip_text::sentence(of), mend: slip_text::mend(of) }
}

/// Another vehicle as a finding, with the lines that make the model one of it.
pub fn other_vehicle(of: &OtherVehicle) -> Finding {
    let (says, mend) = (other_vehicle_text::sentence(of), other_vehicle_text::mend(of));
    Finding { id: "other-vehicle".into(), says, mend: Some(mend) }
}

fn says(of: &DataFinding) -> String {
    match of {
        DataFinding::RowsDropped { run, dropped, all, why } => {
            let why: Vec<String> = why.iter().map(|(why, n)| format!("{why}: {n}")).collect();
            format!("{run}: {dropped} of {all} rows are left out ({})", why.join(", "))
        }
        DataFinding::Interrupted { run, times, longest } => {
            format!("{run}: the log is interrupted {times} times, by {} s at most", significant(*longest, 3))
        }
        DataFinding::TimeUnit { run, step } => {
            format!("{run}: rows are {} s apart: is time in seconds?", significant(*step, 3))
        }
        DataFinding::UnevenTimes { run, jitter } => {
            let percent = significant(100.0 * jitter, 2);
            format!("{run}: times between rows scatter by {percent} %: are they those of measuring?")
        }
        DataFinding::Way { run, ratio, cause } => format!("{run}: {}", slip_text::way(*ratio, *cause)),
        DataFinding::Turning { run, ratio, cause } => format!("{run}: {}", slip_text::turning(*ratio, *cause)),
        DataFinding::NoTurns => "these runs hardly turn: what acts in turns does not show".into(),
        DataFinding::OneTurnDirection(side) => {
            let side = match side {
                Side::Left => "left",
                Side::Right => "right",
            };
            format!("these runs turn to the {side} only: a bias, a constant creep and a wrong scale look alike")
        }
        DataFinding::OneSpeed(speed) => {
            let speed = significant(*speed, 2);
            format!("these runs have one speed, {speed} m/s: what grows with speed looks like what does not")
        }
        DataFinding::NoHeading => {
            "no heading is measured: it is told from the path, and small angles hide in it".into()
        }
        DataFinding::Reading { run, says } => format!("{run}: {says}"),
        DataFinding::CoarseInput(input) => warning_text::coarse_input(input),
        DataFinding::ColouredNoise(rows) => {
            let n = significant(*rows, 2);
            format!("the pose's noise is alike over {n} rows: a filtered or smoothed pose")
        }
        DataFinding::UnexplainedMotion(place) => format!(
            "these runs hold motion that the model does not explain, most of it {}: `creepage discover` looks for its cause",
            rest_text::along(place)
        ),
        DataFinding::Defect(defect) => defect_text::sentence(defect),
        DataFinding::ClockJump(jump) => warning_text::clock_jumped(jump),
        DataFinding::Jumps(jumps) => warning_text::jumped(jumps),
        DataFinding::OddRun(odd) => odd_run_text::says(odd),
        DataFinding::Slip(slip) => slip_text::sentence(slip),
        DataFinding::Clock(warning) => warning_text::line(warning),
    }
}
