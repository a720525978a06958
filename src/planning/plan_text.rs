//! A plan in words.

use super::infeasible::Infeasible;
use super::reachability::Fixed;
use super::report::{PlanReport, Reached};
use crate::number_format::{decimals, plain, prefixed, significant};
use std::fmt::Write;

/// The report for a terminal.
pub fn plan_text(report: &PlanReport) -> String {
    let Reached { x, y, heading, .. } = report.reached;
    let mut out = format!(
        "Reached ({}, {}, {} rad) after {} s and {} m",
        decimals(x, 3),
        decimals(y, 3),
        decimals(heading, 3),
        significant(report.duration_s, 3),
        significant(report.length_m, 3)
    );
    let changes = match report.reversals {
        0 => String::new(),
        1 => ", with one change of direction".into(),
        n => format!(", with {n} changes of direction"),
    };
    let _ = writeln!(out, "{changes}; {}", missed(&report.reached));
    if let Some(off) = report.off_path_m {
        let _ = writeln!(out, "At most {} off the path", length(off));
    }
    if let Some(ideal) = &report.ideal {
        let of = report.effects.join(", ");
        let _ = writeln!(out, "A plan made without {of} would end {} instead", missed(&ideal.reached));
    }
    if let Some(spread) = &report.spread {
        let heading = format!("{} mrad", significant(1e3 * spread.heading_rad, 2));
        let _ = writeln!(
            out,
            "What is not known of the model spreads the end by {} and {heading}",
            length(spread.position_m)
        );
    }
    out
}

fn length(metres: f64) -> String {
    let (factor, unit) = prefixed(metres, "m");
    format!("{} {unit}", significant(metres * factor, 2))
}

fn missed(reached: &Reached) -> String {
    let heading = reached.miss_rad.map(|r| format!(" and {} rad", significant(r.abs(), 2)));
    let heading = heading.filter(|_| reached.miss_rad.is_some_and(|r| r.abs() > 1e-8)).unwrap_or_default();
    match reached.miss_m < 1e-8 && heading.is_empty() {
        true => "at the goal to 10⁻⁸ m".into(),
        false => format!("{} from the goal{heading}", length(reached.miss_m)),
    }
}

/// Why there is no plan, and what to do about it.
pub fn infeasible(why: Infeasible, duration: Option<f64>) -> (String, &'static str) {
    match why {
        Infeasible::Duration => (
            format!(
                "the goal cannot be reached within the limits of the inputs in {} s",
                plain(duration.unwrap_or(0.0))
            ),
            "leave --duration out, or give more of it",
        ),
        Infeasible::Limits => (
            "the goal is reached only beyond the limits of the inputs".into(),
            "widen them by --limit and --rate, or give a way around by --via",
        ),
        Infeasible::JackKnife => (
            "the train reaches the goal only bent by more than 80° at a hitch".into(),
            "give it more room by --via, or a goal that is reached ahead",
        ),
        Infeasible::Fixed(fixed) => {
            let (what, help) = match fixed {
                Fixed::Heading => {
                    ("no input of this vehicle changes the heading", "ask for the heading that it starts with")
                }
                Fixed::Place => ("no input of this vehicle changes the place", "ask for the place where it starts"),
                Fixed::Line => ("this vehicle stays on one line", "ask for a place on the line through its start"),
            };
            (format!("the goal cannot be reached: {what}"), help)
        }
        Infeasible::Unreached => (
            "no plan was found from any of the first guesses, with or without limits".into(),
            "give a way by --via, or a goal nearer to the start",
        ),
    }
}
