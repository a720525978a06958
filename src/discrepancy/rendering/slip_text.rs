//! Slips of units and columns in words.

use super::repair_text;
use crate::discrepancy::preprocessing::unit_errors::{Slip, SlipKind, TurningCause, WayCause};
use crate::number_format::significant;

/// What stands before the lines that mend a slip; a page that shows the lines cuts the sentence here.
pub(crate) const PASTE: &str = " Paste into the model file";

/// A slip as a sentence.
pub fn sentence(slip: &Slip) -> String {
    let run = &slip.run;
    match &slip.kind {
        SlipKind::AngleBeyondHalfTurn { role, largest } => format!(
            "In {run} {role} reaches {} rad, more than half a turn: is it in degrees, or the angle of the steering wheel?",
            significant(*largest, 3)
        ),
        SlipKind::TurnsBetweenRows { turn, step } => {
            let [turn, step] = [turn, step].map(|x| significant(*x, 3));
            format!(
                "The inputs of {run} turn the vehicle by {turn} rad from row to row, in {step} s, so these rows do not show \
                 how it moves: is time in seconds, and are the inputs in SI units?"
            )
        }
        SlipKind::Mirrored => format!(
            "In {run} the path is the mirror image of what the headings say: are x and y swapped, does one of them have the \
             wrong sign, or does the heading count clockwise?"
        ),
        SlipKind::Repair(repaired) => {
            let mend = repair_text::mend_in_line(repaired);
            format!("In {run} {}.{PASTE}: {mend}", repair_text::says(repaired))
        }
        SlipKind::LoggedTwice { roles: [a, b], way } => {
            let way = way.filter(|r| !(0.8..1.25).contains(r)).map_or_else(String::new, |r| {
                format!("; the measured way is {} times what they drive", significant(r, 2))
            });
            format!(
                "In {run} {a} and {b} are the same in every row, and the vehicle turns: one column stands for both{way}.{PASTE}, \
                 with the column's name: [columns]  {b} = \"COLUMN\""
            )
        }
        SlipKind::Stands { role, value } => format!(
            "In {run} {role} is {} in every row, and the vehicle turns: the column holds nothing.{PASTE}, \
             with the right column's name: [columns]  {role} = \"COLUMN\"",
            significant(*value, 3)
        ),
        SlipKind::Bursts { steps: [within, behind], rates } => format!(
            "In {run} rows come in bursts, {} s apart and then {} s, and rates within one are {} times those after it: the \
             times are those of arrival, not of measuring.{PASTE}, with the name of the column that holds \
             the time of measuring: [columns]  time = \"COLUMN\"",
            significant(*within, 2),
            significant(*behind, 2),
            significant(*rates, 2)
        ),
        SlipKind::Turning { ratio, cause } => format!("In {run} {}", turning(*ratio, *cause)),
        SlipKind::Way { ratio, cause, may_spin } => {
            let says = way(*ratio, *cause);
            match may_spin {
                true => format!("In {run} {}, or do the wheels spin?", says.trim_end_matches('?')),
                false => format!("In {run} {says}"),
            }
        }
    }
}

/// The lines of the model file that mend a slip.
pub fn mend(slip: &Slip) -> Option<String> {
    match &slip.kind {
        SlipKind::Repair(repaired) => Some(repair_text::mend(repaired)),
        SlipKind::LoggedTwice { roles: [_, role], .. } | SlipKind::Stands { role, .. } => {
            Some(format!("[columns]\n{role} = \"COLUMN\""))
        }
        SlipKind::Bursts { .. } => Some("[columns]\ntime = \"COLUMN\"".into()),
        _ => None,
    }
}

/// A slip as the end of a sentence.
pub fn clause(slip: &Slip) -> String {
    let says = sentence(slip);
    let mut letters = says.chars();
    let first = letters.next().map(|c| c.to_lowercase().collect::<String>()).unwrap_or_default();
    first + letters.as_str()
}

/// A measured way that is another than the model's.
pub fn way(ratio: f64, cause: WayCause) -> String {
    let why = match cause {
        WayCause::PositionInDegrees => "is the position in degrees of latitude and longitude?",
        WayCause::PositionInMillimetres => "is the position in millimetres?",
        WayCause::PositionInCentimetres => "is the position in centimetres?",
        WayCause::SpeedInMillimetres => "is a speed in millimetres per second?",
        WayCause::RateInDegrees => "is the wheel rate in degrees per second?",
        WayCause::SpeedInKilometresPerHour => "is the speed in km/h?",
        WayCause::RateInTurns => "is the wheel rate in turns per second?",
        WayCause::RateInTurnsPerMinute => "is the wheel rate in turns per minute, or wheel_radius wrong?",
        WayCause::Diameter => "is wheel_radius a diameter, or the other way round?",
        WayCause::TimeUnit => "is time in seconds?",
        WayCause::Unknown => "check wheel_radius and the units of position and wheel rate",
    };
    format!("the measured way is {} times what the model drives: {why}", significant(ratio, 3))
}

/// A measured turning that is another than the model's.
pub fn turning(ratio: f64, cause: TurningCause) -> String {
    let why = match cause {
        TurningCause::HeadingInDegrees => "is the heading in degrees?",
        TurningCause::InputInDegrees => "is the yaw rate, or the angle, in degrees?",
        TurningCause::Backwards => "are left and right swapped, or do angles count clockwise?",
        TurningCause::Unknown => "check track_width or wheelbase, and the units of heading and yaw rate",
    };
    format!("the measured turning is {} times the model's: {why}", significant(ratio, 3))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_vehicle_that_hardly_moves_may_spin_its_wheels() {
        let said = |may_spin| {
            let kind = SlipKind::Way { ratio: 0.01, cause: WayCause::RateInDegrees, may_spin };
            sentence(&Slip { run: "a.csv".into(), kind })
        };
        assert!(said(false).ends_with("degrees per second?") && said(false).starts_with("In a.csv the measured way"));
        assert!(said(true).ends_with("degrees per second, or do the wheels spin?"), "{}", said(true));
        let turning = SlipKind::Turning { ratio: -1.0, cause: TurningCause::Backwards };
        let said = clause(&Slip { run: "B.csv".into(), kind: turning });
        assert!(said.starts_with("in B.csv the measured turning is −1.00 times"), "{said}");
    }
}
