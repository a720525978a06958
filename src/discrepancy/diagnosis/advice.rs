//! What to drive or log next where data contradict themselves or say too little.

use crate::discrepancy::report::NextExperiment;
use crate::discrepancy::selection::choice::Selected;
use crate::effects::Applied;
use crate::model::effect_equation;
use crate::wording::listed_to;

pub(crate) fn drive(why: &str) -> NextExperiment {
    NextExperiment {
        why: why.into(),
        manoeuvre: "drive at least 60 s at changing speed with turns to both sides, such as figures of eight".into(),
    }
}

/// Names in a sentence.
const NAMED: usize = 3;

/// That parts of the data ask for something differently; `None` where they agree.
pub(crate) fn contradiction(choice: &Selected) -> Option<String> {
    let names = named(&choice.inconsistent);
    names.map(|names| format!("parts of these runs ask for other values of {names}"))
}

/// Effects in words, terms by their place.
pub(crate) fn named(effects: &[Applied]) -> Option<String> {
    let mut names: Vec<String> = Vec::new();
    for effect in effects {
        let name = match effect_equation::is_term(effect) {
            true => format!("a law without name at the {}", effect.effect.place),
            false => effect.label(),
        };
        if !names.contains(&name) {
            names.push(name);
        }
    }
    // The last one takes no more room than its number.
    let most = if names.len() == NAMED + 1 { NAMED + 1 } else { NAMED };
    (!names.is_empty()).then(|| listed_to(&names, most))
}

/// What mends runs whose parts contradict each other: no manoeuvre can be thought through with a model that is wrong,
/// but where speed and turn change by themselves a law shows as what it is.
pub(crate) fn settling(choice: &Selected) -> NextExperiment {
    let asked = contradiction(choice).unwrap_or_else(|| "what disagrees in these runs has no name".into());
    drive(&format!("{asked}: where speed and turn vary together, one law imitates another"))
}

/// What mends inputs that change between their rows.
pub(crate) fn oftener(why: &str) -> NextExperiment {
    NextExperiment {
        why: why.into(),
        manoeuvre: "log the inputs several times as often, or as means over the time between rows (input_timing = \
                    \"interval-mean\"), or drive with speeds and turns that change more slowly"
            .into(),
    }
}

/// What mends inputs that come in steps.
pub(crate) fn finer(why: &str) -> NextExperiment {
    NextExperiment {
        why: why.into(),
        manoeuvre: "log the inputs in finer steps: more ticks a turn, more digits, or ticks counted over longer rows and given \
                    as means over them (input_timing = \"interval-mean\")"
            .into(),
    }
}
