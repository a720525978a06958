//! The next experiment in words.

use super::manoeuvre_text::planned;
use super::warning_text::{coarse_input, inconsistent, sampling_sensitive};
use crate::discrepancy::diagnosis::advice::{Advice, Motive};
use crate::discrepancy::experiment::next_step::{Mended, NextStep, PlannedManoeuvre};
use crate::discrepancy::report::NextExperiment;
use crate::effects::Applied;
use crate::number_format::significant;
use crate::wording::listed_to;

/// Names in a sentence.
const NAMED: usize = 4;

/// What to drive or log next, and why.
pub fn next_experiment(step: &NextStep) -> NextExperiment {
    match step {
        NextStep::Advice(advice) => advised(advice),
        NextStep::Separate { chosen, rivals, beyond, manoeuvre, expected_delta_bic, times } => {
            let next = separating(chosen, rivals, planned(manoeuvre), *expected_delta_bic, *times);
            match beyond.is_empty() {
                true => next,
                false => NextExperiment { why: format!("{}; {}", next.why, beyond_reach(beyond)), ..next },
            }
        }
        NextStep::Reveal { effect, manoeuvre, expected_delta_bic } => NextExperiment {
            why: format!(
                "a plausible {} would have been missed; this is expected to show it with a ΔBIC of about {}",
                effect.label(),
                significant(*expected_delta_bic, 2)
            ),
            manoeuvre: planned(manoeuvre),
        },
        NextStep::Mend { mends, manoeuvre } => mending(mends, manoeuvre),
    }
}

fn advised(advice: &Advice) -> NextExperiment {
    let (why, manoeuvre) = match advice {
        Advice::VariedDriving(motive) => (
            motivated(motive, "where speed and turn vary together, one law imitates another"),
            "drive at least 60 s at changing speed with turns to both sides, such as figures of eight",
        ),
        Advice::VariedSpeed(motive) => (
            motivated(motive, "at one speed one law imitates another"),
            "drive at least 60 s at changing speed, slow and fast, speeding up and slowing down",
        ),
        Advice::PosesOftener => (
            "between two rows of poses more happens than from one end of the run to the other".into(),
            "log the poses several times as often, and check the units of their columns",
        ),
        Advice::InputsOftener(effects) => (
            sampling_sensitive(effects),
            "log the inputs several times as often, or as means over the time between rows (input_timing = \
             \"interval-mean\"), or drive with speeds and turns that change more slowly",
        ),
        Advice::FinerInputs(input) => (
            coarse_input(input),
            "log the inputs in finer steps: more ticks a turn, more digits, or ticks counted over longer rows and given as \
             means over them (input_timing = \"interval-mean\")",
        ),
    };
    NextExperiment { why, manoeuvre: manoeuvre.into() }
}

fn motivated(motive: &Motive, imitates: &str) -> String {
    match motive {
        Motive::Motion => "a model is tested by motion".into(),
        Motive::Length => "the runs are too short".into(),
        Motive::Contradiction(effects) => format!("{}: {imitates}", inconsistent(effects)),
        Motive::Nameless => format!("what disagrees in these runs has no name: {imitates}"),
        Motive::Missed(effect) => format!("a plausible {} would have been missed", effect.label()),
    }
}

fn separating(
    chosen: &Applied,
    rivals: &[Applied],
    sentence: String,
    expected_delta_bic: f64,
    times: Option<f64>,
) -> NextExperiment {
    let expected = significant(expected_delta_bic.max(0.0), 2);
    let (manoeuvre, why) = match times {
        Some(t) if t <= 1.0 => (sentence, format!("the minute is expected to do so with a ΔBIC of {expected}")),
        Some(t) => (
            format!("{sentence}; repeat it {t} times"),
            format!("a minute is expected to give a ΔBIC of {expected} only"),
        ),
        None => (
            "no manoeuvre within these speeds and turns separates them in reasonable time; measure the parameter itself \
             instead"
                .to_string(),
            format!("a minute is expected to give a ΔBIC of {expected} at best"),
        ),
    };
    let names: Vec<String> = rivals.iter().map(Applied::label).collect();
    let pair = format!("{} from {}", chosen.label(), names.join(" or "));
    NextExperiment { why: format!("these runs do not tell {pair}; {why}"), manoeuvre }
}

/// That no manoeuvre tells some effects from the chosen one.
fn beyond_reach(effects: &[Applied]) -> String {
    let names: Vec<String> = effects.iter().map(Applied::label).collect();
    let it = if names.len() == 1 { "that parameter" } else { "those parameters" };
    format!("no manoeuvre within these speeds and turns tells it from {}: measure {it}", names.join(" or "))
}

fn mending(mends: &[Mended], manoeuvre: &PlannedManoeuvre) -> NextExperiment {
    let words = |m: &Mended| match m {
        Mended::Shown(effect) => format!("show {}", effect.label()),
        Mended::Separated(pair) => format!("tell {} from {}", pair[0].label(), pair[1].label()),
    };
    let mut names: Vec<String> = mends.iter().map(words).collect();
    names.dedup();
    let sentence = planned(manoeuvre);
    if names.is_empty() {
        let why = "one minute within these speeds and turns mends nothing of it by itself; this says most".into();
        return NextExperiment { why, manoeuvre: format!("{sentence}; repeat it") };
    }
    NextExperiment { why: format!("the minute is expected to {}", listed_to(&names, NAMED)), manoeuvre: sentence }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrepancy::fixtures::applied;

    /// A vehicle on a line is not told to turn.
    #[test]
    fn what_cannot_turn_is_told_to_change_its_speed() {
        let motives = || [Motive::Motion, Motive::Length, Motive::Nameless];
        for (plane, line) in motives().map(Advice::VariedDriving).iter().zip(motives().map(Advice::VariedSpeed).iter())
        {
            let [plane, line] = [plane, line].map(advised);
            assert!(plane.manoeuvre.contains("figures of eight"), "{plane:?}");
            let says = format!("{} {}", line.why, line.manoeuvre);
            assert!(!says.contains("turn") && !says.contains("eight"), "{says}");
        }
    }

    #[test]
    fn what_no_manoeuvre_tells_is_to_be_measured() {
        let [one, other] = ["rotation-creep", "lever-arm"].map(applied);
        assert_eq!(
            beyond_reach(std::slice::from_ref(&one)),
            "no manoeuvre within these speeds and turns tells it from rotation-creep: measure that parameter"
        );
        assert!(beyond_reach(&[one, other]).ends_with("from rotation-creep or lever-arm: measure those parameters"));
    }

    /// A manoeuvre that is worth the evidence is driven once, another is repeated; below there is none.
    #[test]
    fn how_often_a_manoeuvre_is_driven_is_said() {
        let of = |worth, times| {
            let rivals = [applied("rotation-creep")];
            separating(&applied("traverse-creep"), &rivals, "drive a circle".into(), worth, times)
        };
        for (worth, times, manoeuvre, expected) in [
            (30.0, Some(1.0), "drive a circle", "expected to do so with a ΔBIC of 30"),
            (24.0, Some(2.0), "drive a circle; repeat it 2 times", "ΔBIC of 24 only"),
            (0.8, None, "no manoeuvre within these speeds", "ΔBIC of 0.80 at best"),
            (-3.0, None, "no manoeuvre within these speeds", "ΔBIC of 0 at best"),
        ] {
            let said = of(worth, times);
            assert!(said.manoeuvre.starts_with(manoeuvre) && said.why.contains(expected), "{said:?}");
            assert_eq!(said.manoeuvre.contains("repeat"), manoeuvre.contains("repeat"));
            assert!(said.why.starts_with("these runs do not tell traverse-creep from rotation-creep"), "{said:?}");
        }
    }
}
