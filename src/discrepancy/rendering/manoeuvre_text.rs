//! A manoeuvre in words and numbers.

use crate::discrepancy::experiment::envelope::{Envelope, Turning};
use crate::discrepancy::experiment::manoeuvre::{Manoeuvre, Phase};
use crate::discrepancy::experiment::next_step::PlannedManoeuvre;
use crate::number_format::significant;

/// What to drive, in a sentence with numbers.
pub fn planned(of: &PlannedManoeuvre) -> String {
    sentence(of.manoeuvre, &of.envelope)
}

fn sentence(manoeuvre: &Manoeuvre, envelope: &Envelope) -> String {
    let phases: Vec<String> = manoeuvre.phases.iter().map(|p| stretch(p, envelope)).collect();
    format!("drive {}", phases.join(", then "))
}

fn stretch(p: &Phase, envelope: &Envelope) -> String {
    let number = |x: f64| significant(x.abs(), 2);
    let fastest = p.speed.level.abs() + p.speed.swing;
    let turn = p.turn.level.abs() + p.turn.swing;
    let turn = envelope.bounded(fastest * envelope.speed, turn * envelope.turn);
    let speed = match (p.speed.swing > 0.0, p.speed.level) {
        (true, level) => format!(
            "at a speed that swings between {} and {} m/s every {} s",
            number((level - p.speed.swing) * envelope.speed),
            number(fastest * envelope.speed),
            number(p.speed.period)
        ),
        (false, 0.0) => "on the spot".into(),
        (false, level) => {
            let way = if level < 0.0 { "backwards " } else { "" };
            format!("{way}at {} m/s", number(level * envelope.speed))
        }
    };
    let side = if p.turn.level < 0.0 { "right" } else { "left" };
    let path = match (p.turn.level == 0.0, p.turn.swing > 0.0, envelope.turning) {
        (true, false, _) | (_, _, Turning::Nothing) => "straight ahead".to_string(),
        (_, true, Turning::Rate) => {
            format!("weaving left and right by up to {} rad/s every {} s", number(turn), number(p.turn.period))
        }
        (_, true, Turning::Angle) => {
            format!("steering left and right by up to {} rad every {} s", number(turn), number(p.turn.period))
        }
        (_, _, Turning::Rate) if fastest == 0.0 => format!("turning {side} by {} rad/s", number(turn)),
        (_, _, Turning::Rate) => {
            let radius = fastest * envelope.speed / turn.abs().max(1e-9);
            format!("in circles to the {side} of radius {} m", number(radius))
        }
        (_, _, Turning::Angle) => format!("in circles to the {side}, steering {} rad", number(turn)),
    };
    format!("{} s {speed}, {path}", number(p.seconds))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrepancy::experiment::manoeuvre::samples::{PLAN, envelope};
    use crate::discrepancy::experiment::manoeuvre::{FAST, LEFT, Needs, library, phase, steady, swinging};

    #[test]
    fn only_a_phase_that_goes_back_says_so() {
        let lengths = [("wheel_radius", 0.1), ("track_width", 0.5)];
        let envelope = envelope("differential-drive", &lengths, [7.0, 13.0], [-10.0; 2]);
        let ways = |speed: f64| stretch(&phase(30.0, steady(speed), LEFT), &envelope);
        assert!(ways(-0.6).contains(" backwards at "), "{}", ways(-0.6));
        assert!(ways(0.0).contains(" on the spot, turning left"), "{}", ways(0.0));
        assert!(ways(1.0).contains("s at "), "{}", ways(1.0));
        let backwards = |m: &Manoeuvre| sentence(m, &envelope).contains("backwards");
        assert!(library(&envelope).any(&backwards));
        assert!(library(&envelope).all(|m| backwards(m) == (m.needs == Needs::Reverse)));
    }

    #[test]
    fn who_steers_is_told_an_angle() {
        let car = envelope("car", &[("wheel_radius", 0.3), ("wheelbase", 2.7)], [0.2, 10.0], [0.0, 10.0]);
        let words = stretch(&phase(30.0, FAST, LEFT), &car);
        assert!(words.contains("steering 0.20 rad"), "{words}");
        assert!(library(&car).all(|m| !sentence(m, &car).contains("on the spot") && m.needs != Needs::Reverse));
    }

    #[test]
    fn a_phase_is_told_in_numbers() {
        let lengths = [("wheel_radius", 0.1), ("track_width", 0.5)];
        let envelope = envelope("differential-drive", &lengths, [7.0, 13.0], [-10.0; 2]);
        assert_eq!(
            sentence(&PLAN, &envelope),
            "drive 30 s at 1.0 m/s, in circles to the left of radius 0.83 m, then 10 s at 0.35 m/s, in circles to the right of \
             radius 0.29 m, then 20 s at a speed that swings between 0.20 and 1.0 m/s every 10 s, in circles to the left of \
             radius 1.7 m"
        );
        let weaving = stretch(&phase(60.0, steady(0.8), swinging(0.0, 0.5, 20.0)), &envelope);
        assert_eq!(weaving, "60 s at 0.80 m/s, weaving left and right by up to 0.60 rad/s every 20 s");
    }
}
