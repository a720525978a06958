//! Runs beside one another: values run by run, and a run that differs.

use super::head::parameter;
use super::part::{Cell, table};
use crate::discrepancy::report::{Estimate, OddRun, Report};
use crate::number_format::{probability, significant, with_error};
use crate::picture::svg::Element;
use std::collections::BTreeMap;

/// The tables of several runs, where there is a row.
pub fn tables(report: &Report) -> Vec<Element> {
    [odd(report), per_run(report), spread(report)].into_iter().flatten().collect()
}

fn odd(report: &Report) -> Option<Element> {
    let shown = |of: &BTreeMap<String, Estimate>| {
        Cell::Lines(of.iter().map(|(name, p)| parameter(name, p).replace(' ', "\u{a0}")).collect())
    };
    let row = |o: &OddRun| vec![Cell::text(&o.run), Cell::text(&o.id), shown(&o.parameters), shown(&o.others)];
    let headings = ["run", "effect", "its value ± std", "that of the others ± std"];
    table(
        "Runs that differ from the others, and are fitted apart",
        &headings,
        report.odd_runs.iter().map(row).collect(),
    )
}

fn per_run(report: &Report) -> Option<Element> {
    let rows = report.effects.iter().flat_map(|e| {
        e.per_run.iter().flat_map(move |(name, of)| {
            of.runs.iter().map(move |r| {
                let value = with_error(r.value, Some(r.std));
                vec![Cell::text(format!("{} {name}", e.id)), Cell::text(&r.run), Cell::Number(value)]
            })
        })
    });
    table("What each run says alone", &["parameter", "run", "#value ± std"], rows.collect())
}

fn spread(report: &Report) -> Option<Element> {
    let rows = report.effects.iter().flat_map(|e| {
        e.per_run.iter().map(move |(name, of)| {
            vec![
                Cell::text(format!("{} {name}", e.id)),
                Cell::Number(significant(of.tau, 3)),
                Cell::Number(significant(of.q, 3)),
                Cell::Number(probability(of.p_value)),
            ]
        })
    });
    let headings = ["parameter", "#τ, std between runs", "#Q", "#p if all runs are alike"];
    table("How far the runs differ", &headings, rows.collect())
}
