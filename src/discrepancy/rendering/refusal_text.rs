//! Why an effect that a fit asks for is not named, in words.

use super::effect_names::named;
use crate::discrepancy::diagnosis::findings::estimates;
use crate::discrepancy::evidence::regime_stability::Regime;
use crate::discrepancy::report::Refuted;
use crate::discrepancy::selection::choice::{Growth, Refusal, Refused};
use crate::number_format::significant;

/// A refused effect as the report lists it; `roles` are the names of the inputs.
pub(crate) fn refuted(refused: &Refused, roles: &[String]) -> Refuted {
    let a = &refused.applied;
    Refuted { id: a.effect.id.clone(), parameters: estimates(a, &refused.std), says: says(refused, roles) }
}

/// The reason as a line.
pub fn says(refused: &Refused, roles: &[String]) -> String {
    let label = named(std::slice::from_ref(&refused.applied));
    match &refused.why {
        Refusal::Impossible => format!("no vehicle has so much {label}, so that is not named"),
        Refusal::NoDeviation => format!("these runs leave the value of {label} open, so that is not named"),
        Refusal::BelowBar => format!("beside the others {label} is worth less than it costs, so that is not named"),
        Refusal::Ridge(other) => {
            format!(
                "{label} pays only as far as it undoes {}, so that is not named",
                named(std::slice::from_ref(other))
            )
        }
        Refusal::Imitation(other) => {
            let other = named(std::slice::from_ref(other));
            format!("{label} and {other} together imitate a law that neither of them is, so that {label} is not named")
        }
        Refusal::LeansOnLaw => format!("{label} stands only beside a law without a name, so that is not named"),
        Refusal::Regime { regime, values: [elsewhere, there] } => {
            let [elsewhere, there] = [elsewhere, there].map(|v| significant(*v, 2));
            let place = place(*regime, roles);
            format!("{label} is {there} {place} and {elsewhere} elsewhere, so that is not named")
        }
        Refusal::InputNoise => {
            format!("the steps or the noise of the inputs alone make such a {label}, so that is not named")
        }
        Refusal::NotBorneOut => {
            format!("held-out runs are predicted no better with {label}, and something remains, so that is not named")
        }
        Refusal::OtherVehicle => format!("another vehicle explains what {label} was found for, so that is not named"),
        Refusal::FittedRuns(growth) => {
            format!("the runs that {label} was fitted to refute it: {}", grows(growth, "it"))
        }
        Refusal::HeldOut(growth) => format!("held-out runs refute {label}: {}", grows(growth, "it")),
        Refusal::HeldOutTogether(growth) => {
            format!(
                "held-out runs refute what was found, of which {label} is worth least: {}",
                grows(growth, "all of it")
            )
        }
    }
}

fn place(regime: Regime, roles: &[String]) -> String {
    let role = |c: usize| roles.get(c).map_or_else(|| format!("input {}", c + 1), Clone::clone);
    match regime {
        Regime::Large(c) => format!("at large {}", role(c)),
        Regime::Positive(c) => format!("at positive {}", role(c)),
        Regime::Growing(c) => format!("while {} grows", role(c)),
        Regime::Late => "in the second half".into(),
    }
}

fn grows(growth: &Growth, with: &str) -> String {
    let [before, after] = growth.gap.map(|gap| significant(gap, 3));
    let (of, unit) = if growth.of_heading { ("heading gap", "rad") } else { ("gap", "m") };
    format!("their {of} after {} s grows with {with} from {before} to {after} {unit}", growth.horizon_s)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrepancy::fixtures::applied;

    fn said(why: Refusal) -> String {
        says(&Refused { applied: applied("traverse-creep"), std: vec![], why }, &["wheel_rate".into()])
    }

    #[test]
    fn every_reason_names_its_effect() {
        let growth = Growth { horizon_s: 5.0, of_heading: true, gap: [0.01, 0.05], floor: 0.01 };
        assert_eq!(
            said(Refusal::HeldOut(growth)),
            "held-out runs refute traverse-creep: their heading gap after 5 s grows with it from 0.0100 to 0.0500 rad"
        );
        assert_eq!(
            said(Refusal::FittedRuns(growth)),
            "the runs that traverse-creep was fitted to refute it: their heading gap after 5 s grows with it from 0.0100 to \
             0.0500 rad"
        );
        let together = said(Refusal::HeldOutTogether(growth));
        assert!(
            together.starts_with("held-out runs refute what was found, of which traverse-creep is worth least: their")
        );
        assert_eq!(
            said(Refusal::Regime { regime: Regime::Large(0), values: [0.1, -0.02] }),
            "traverse-creep is −0.020 at large wheel_rate and 0.10 elsewhere, so that is not named"
        );
        let reasons = [Refusal::Impossible, Refusal::NoDeviation, Refusal::BelowBar, Refusal::LeansOnLaw];
        let others = [Refusal::InputNoise, Refusal::Ridge(applied("lever-arm").into()), Refusal::NotBorneOut];
        let others = others.into_iter().chain([Refusal::OtherVehicle]);
        let imitated = [Refusal::Imitation(applied("lever-arm").into())];
        for why in reasons.into_iter().chain(others).chain(imitated) {
            let line = said(why);
            assert!(line.contains("traverse-creep") && line.ends_with("is not named"), "{line}");
        }
    }
}
