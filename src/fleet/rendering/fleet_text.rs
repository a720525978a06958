//! A fleet's report in words.

use crate::fleet::report::{FleetEffect, FleetParameter, FleetReport, Interval, OddRobot, OwnEffect, TagEffect};
use crate::number_format::{probability, significant, with_error};
use crate::wording::{counted, listed, listed_to};
use std::fmt::Write;

/// Names in a sentence at most.
const NAMES: usize = 6;

/// The whole answer in two or three sentences.
pub fn summary(report: &FleetReport) -> String {
    let names: Vec<String> = report.effects.iter().map(|e| e.effect.clone()).collect();
    let needs = match names.len() {
        0 => "No effect is needed by more robots than mistakes explain.".to_string(),
        _ => format!("The fleet needs {}.", listed(names.iter().map(String::as_str))),
    };
    let differing: std::collections::BTreeSet<&str> = report
        .odd_robots
        .iter()
        .map(|o| o.robot.as_str())
        .chain(report.own_effects.iter().map(|o| o.robot.as_str()))
        .collect();
    let differing: Vec<String> = differing.into_iter().map(String::from).collect();
    let odd = match differing.len() {
        0 => " No robot differs from the others.".to_string(),
        1 => format!(" {} differs from the others.", differing[0]),
        _ => format!(" {} differ from the others.", listed_to(&differing, NAMES)),
    };
    let runs: Vec<String> =
        report.odd_runs.iter().filter_map(|o| Some(format!("{} of {}", o.run.as_ref()?, o.robot))).collect();
    let runs = match runs.len() {
        0 => String::new(),
        1 => format!(" The run {} differs from the others of its robot.", runs[0]),
        _ => format!(" The runs {} differ from the others of their robots.", listed_to(&runs, NAMES)),
    };
    needs + &odd + &runs
}

/// A robot or a run that differs, in a sentence.
pub fn odd(odd: &OddRobot) -> String {
    let who = odd.run.as_ref().map_or_else(|| odd.robot.clone(), |run| format!("{run} of {}", odd.robot));
    let others = if odd.run.is_some() { "its other runs" } else { "the others" };
    format!(
        "{who}: {} {} = {}{}, {others} {}; {} deviations away, p = {}",
        odd.effect,
        odd.parameter,
        with_error(odd.value, Some(odd.std)),
        unit(&odd.unit),
        significant(odd.others, 3),
        significant(odd.z.abs(), 2),
        probability(odd.p_value)
    )
}

/// An effect of one robot alone, in a sentence.
pub fn own(own: &OwnEffect) -> String {
    let values =
        own.parameters.iter().map(|(name, e)| format!("{name} = {}{}", with_error(e.value, e.std), unit(&e.unit)));
    let part = if own.in_part { " in part only" } else { "" };
    format!("{}: {}{part}, which nobody else needs; {}", own.robot, own.effect, values.collect::<Vec<_>>().join(", "))
}

/// What is to know of the rows: robots that are missing, values that runs do not tell.
pub fn warnings(missing: &[String], without: &[(String, usize)]) -> Vec<String> {
    let robots = (!missing.is_empty())
        .then(|| format!("{} without a row: {}", counted(missing.len(), "robot"), listed_to(missing, NAMES)));
    let values = without.iter().filter(|(_, n)| *n > 0);
    let values = values.map(|(name, n)| format!("{} not telling {name}", counted(*n, "run")));
    robots.into_iter().chain(values).collect()
}

fn unit(unit: &str) -> String {
    if unit == "1" { String::new() } else { format!(" {unit}") }
}

/// The report for a terminal.
pub fn fleet_text(report: &FleetReport) -> String {
    let mut out = format!("{}\n\n", report.summary);
    let _ = writeln!(out, "{}, {}", counted(report.robots, "robot"), counted(report.runs, "run"));
    let verdicts: Vec<String> = report.verdicts.iter().map(|(v, n)| format!("{n} {v}")).collect();
    let _ = writeln!(out, "discover says of them: {}", verdicts.join(", "));
    report.effects.iter().for_each(|e| effect(&mut out, e));
    let own = report.own_effects.iter().map(|o| &o.says);
    let odd: Vec<&String> = report.odd_robots.iter().map(|o| &o.says).chain(own).collect();
    list(&mut out, "Robots that differ", &odd);
    list(&mut out, "Runs that differ", &report.odd_runs.iter().map(|o| &o.says).collect::<Vec<_>>());
    let left: Vec<String> = report.not_needed.iter().map(not_needed).collect();
    list(&mut out, "Named by robots and not needed by the fleet", &left.iter().collect::<Vec<_>>());
    list(&mut out, "Warnings", &report.warnings.iter().collect::<Vec<_>>());
    out
}

fn list(out: &mut String, heading: &str, lines: &[&String]) {
    if !lines.is_empty() {
        let _ = writeln!(out, "\n{heading}");
        for line in lines {
            let _ = writeln!(out, "  {line}");
        }
    }
}

fn effect(out: &mut String, e: &FleetEffect) {
    let also = if e.also_named.is_empty() {
        String::new()
    } else {
        format!(" (also named {})", listed(e.also_named.iter().map(String::as_str)))
    };
    let _ = writeln!(out, "\n{}{also}: {}; named by {}", e.effect, e.says, counted(e.named_by, "robot"));
    for (name, p) in &e.parameters {
        let unit = unit(&p.unit);
        match (&p.mean, &p.between_robots) {
            (Some(mean), Some(between)) => {
                let _ = writeln!(out, "  {name:<16} mean {}{unit}", with_error(mean.value, mean.std));
                let _ = writeln!(out, "  {:<16} between robots {}{unit}", "", spread(between));
            }
            _ => {
                let _ = writeln!(out, "  {name:<16} too few robots tell it for a mean");
            }
        }
        if let Some(within) = p.between_runs {
            let _ = writeln!(out, "  {:<16} between runs {}{unit}", "", significant(within, 2));
        }
        for t in &p.tags {
            let _ = writeln!(out, "  {:<16} {}", "", tag(t, p));
        }
    }
}

/// A spread with its interval.
pub fn spread(between: &Interval) -> String {
    let [low, high] = between.interval.map(|v| significant(v, 2));
    format!("{} ({low} to {high})", significant(between.value, 2))
}

/// How a parameter depends on a tag, in a phrase.
pub fn tag(t: &TagEffect, p: &FleetParameter) -> String {
    let value = format!("{}{}", with_error(t.value, Some(t.std)), unit(&p.unit));
    let p = probability(t.p_value);
    match (&t.level, &t.against) {
        (Some(level), Some(against)) => format!("{value} more with {} {level} than {against}, p = {p}", t.tag),
        _ if t.tag == "date" => format!("{value} a day, p = {p}"),
        _ => format!("{value} for one of {}, p = {p}", t.tag),
    }
}

/// What robots name and the fleet does not need, in a phrase.
pub fn not_needed(n: &crate::fleet::report::NotNeeded) -> String {
    let why = match n.not_told_apart {
        true => "the runs do not tell it from what is needed".to_string(),
        false => format!("q = {}", probability(n.q_value)),
    };
    format!("{} by {}; {why}", n.effect, listed_to(&n.robots, NAMES))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_differs_is_said_with_its_value_and_that_of_the_others() {
        let one = OddRobot {
            robot: "robot17".into(),
            run: None,
            effect: "wheel-radius-mismatch".into(),
            parameter: "scale".into(),
            value: 0.045,
            std: 0.0001,
            unit: "1".into(),
            others: 0.0003,
            z: 12.0,
            p_value: 1e-9,
            says: String::new(),
        };
        let says = odd(&one);
        assert!(
            says.starts_with("robot17: wheel-radius-mismatch scale = 0.04500 ± 0.00010, the others 0.000300"),
            "{says}"
        );
        let run = OddRobot { run: Some("b".into()), ..one };
        assert!(odd(&run).starts_with("b of robot17: ") && odd(&run).contains("its other runs"));
    }
}
