//! What the text says that Fig. 7 shows, read off the simulated paths.

use super::symmetry::{all_of, within};
use crate::claims::simulated::undefined;
use crate::claims::{Claim, Fault, Statement, Status, Verdict};
use crate::energy_rule::{EndPoint, FIG7_DURATION, Instant, Reading, fig7_case, fig7_stepwise};
use crate::motion::Drive;

const CHAPTER: &str = "08-simulation";
const CODE: &str = "src/energy_rule/readings.rs";
const TESTS: &str = "tests/reports/fig7.rs";

pub(crate) fn claims() -> Vec<Claim> {
    vec![dominance(), third_case(), steps()]
}

fn base(id: &str, says: &str) -> Claim {
    Claim::new(id, Status::Sampled, says).chapter(CHAPTER).code(&[CODE]).tests(&[TESTS])
}

fn end(e_rc: f64, e_tc: f64, reading: Reading) -> Result<EndPoint, Fault> {
    fig7_case(e_rc, e_tc, reading).map_err(|e| undefined(&e))
}

/// Whether what was found is what a statement says of a name.
fn told(s: &Statement, name: &str, found: f64, tolerance: f64) -> Verdict {
    within(name, found, s.number(name).unwrap_or(f64::NAN), tolerance)
}

fn dominance() -> Claim {
    base("fig-7-dominance", "type R dominates in case (iii) of Fig. 7 and type T in case (iv), by the share of the displacement from the ideal end that lies along and across it")
        .at("section 4, simulation: \"combined decelerated forward-creep and counterclockwise right-creep\"; \"type R dominates in the (iii) case\"")
        .under("no energy rule; at the end, where along : across = |e_rc| : |(1 − e_rc)·e_tc|")
        .remark("The wheel is braked throughout and turns to the left; all four cases have e_rc < 0, forward-creep, and e_tc < 0, right-creep.")
        .sample(
            "along over across of (iii) and (iv); wheel rate at the end over that at the start, yaw rate",
            &[("third", "45.4545"), ("fourth", "0.004995"), ("slower", "0.842920"), ("yaw", "1")],
            |s, _| all_of([dominant(s)]),
        )
}

fn dominant(s: &Statement) -> Verdict {
    let ideal = end(0.0, 0.0, Reading::NonConservative)?;
    let share = |e_rc, e_tc| {
        let crept = end(e_rc, e_tc, Reading::NonConservative)?;
        // The ideal end lies on the y axis.
        Ok((crept.y - ideal.y).abs() / (crept.x - ideal.x).abs())
    };
    told(s, "third", share(-0.1, -0.002)?, 6e-5)?;
    told(s, "fourth", share(-0.001, -0.2)?, 6e-7)?;
    let rates = Reading::NonConservative.rates(0.0, 0.0).map_err(|e| undefined(&e))?;
    let (mut first, mut last, mut slope) = ([0.0; 2], [0.0; 2], [0.0; 2]);
    rates.at(0.0, &mut first, &mut slope);
    rates.at(FIG7_DURATION, &mut last, &mut slope);
    told(s, "slower", last[1] / first[1], 6e-7)?;
    told(s, "yaw", last[0], 1e-12)
}

fn third_case() -> Claim {
    base("fig-7-third-case", "in case (iii) the rotated angle of the creeping motion is less than that of the ideal one, in spite of the larger distance: under reading A of the energy rule, and not without a rule")
        .at("section 4, simulation: \"the rotated angle of creep motion is less than that of the ideal one, in spite of large traveling distance\"")
        .under("heading and path after 2π s")
        .remark("Without the rule the yaw rate is given, and no heading can differ. The sentence speaks of one reading of the rule, and helps to choose it.")
        .sample(
            "heading and path, creeping less ideal, under reading A and without a rule",
            &[("A.turned", "-0.114747"), ("A.went", "0.462617"), ("none.turned", "0"), ("none.went", "0.578983")],
            |s, _| all_of([third(s)]),
        )
}

fn third(s: &Statement) -> Verdict {
    let ideal = end(0.0, 0.0, Reading::NonConservative)?;
    for (name, reading) in [("A", Reading::A), ("none", Reading::NonConservative)] {
        let crept = end(-0.1, -0.002, reading)?;
        told(s, &format!("{name}.turned"), crept.phi - ideal.phi, 6e-7)?;
        told(s, &format!("{name}.went"), crept.distance - ideal.distance, 6e-7)?;
    }
    Ok(())
}

fn steps() -> Claim {
    base("fig-7-steps", "rates rescaled at the start of every integration step and held during it tend to reading A with the first order of the step: the two kinds of creep differ by the initial velocities of a step, and by no more")
        .at("section 4, simulation: \"the conservative and non-conservative creeps differ at the initial velocities in every integration steps\"")
        .under("case (ii), reading A")
        .remark("A scheme that rescales what it has rescaled before has no limit; the sentence does not say which is meant.")
        .sample("order between 400 and 4000 steps, rates of the start; and of the middle of a step", &[("order", "1"), ("order_of_middle", "2")], |s, _| {
            all_of([order(s, "order", Instant::Start).and_then(|()| order(s, "order_of_middle", Instant::Middle))])
        })
}

fn order(s: &Statement, name: &str, instant: Instant) -> Verdict {
    let limit = end(-0.1, -0.2, Reading::A)?;
    let error = |steps| {
        let found = fig7_stepwise(-0.1, -0.2, Reading::A, steps, instant).map_err(|e| undefined(&e))?;
        Ok::<f64, Fault>((found.x - limit.x).hypot(found.y - limit.y))
    };
    told(s, name, (error(400)? / error(4000)?).log10(), 0.02)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::claims::Outcome;

    #[test]
    fn a_number_that_is_not_told_is_false() {
        let s = Statement::parse(&[("order", "1")]).unwrap();
        assert!(told(&s, "order", 1.01, 0.02).is_ok());
        assert!(told(&s, "order", 1.03, 0.02).is_err() && told(&s, "other", 1.0, 1.0).is_err());
        assert!(all_of([Err(Fault::Outside)]) != Outcome::PROVED);
    }
}
