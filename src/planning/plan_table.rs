//! A plan as a log: rows that `simulate` reads by the columns of the model file, inputs first, with the pose they lead to.

use super::execution::{Executed, plan_rows};
use super::plan::Plan;
use crate::files::{ColumnEntry, Kind, ModelFile, quoted};
use crate::model::Model;
use crate::motion::Timing;
use std::fmt::Write;

/// A column of the table: its name, and its numbers as the file has them.
type Column = (String, Vec<f64>);

/// The table as CSV, and the roles that the model file reads in a way that cannot be written, under their own names in SI units.
pub fn plan_table(
    plan: &Plan,
    executed: &Executed,
    model: &Model,
    file: &ModelFile,
    timing: Timing,
) -> (String, Vec<String>) {
    let (time, inputs) = plan_rows(plan, timing);
    let names = &file.columns;
    let mut left = vec![];
    let mut column = |role: &str, name: &str, values: &[f64]| -> Column {
        match names.entries.get(role) {
            None => (name.to_string(), values.to_vec()),
            Some(entry) if is_plain(entry) => {
                let reading = entry.reading;
                let written = values.iter().map(|v| (v - reading.offset) / reading.scale);
                (entry.columns[0].clone(), written.collect())
            }
            Some(_) => {
                left.push(role.to_string());
                (role.to_string(), values.to_vec())
            }
        }
    };
    let mut columns = vec![column("time", &names.time, &time)];
    for (role, values) in model.inputs.iter().zip(&inputs) {
        let name = names.inputs.iter().find(|i| i.role == *role).map_or(role.as_str(), |i| i.column.as_str());
        columns.push(column(role, name, values));
    }
    let of = |name: &str| executed.table.column(name).unwrap_or(&[]);
    if !names.geographic {
        columns.push(column("x", &names.x, of("x")));
        columns.push(column("y", &names.y, of("y")));
    }
    columns.push(column("heading", names.heading.as_deref().unwrap_or("heading"), of("heading")));
    for (i, name) in names.trailer_headings.iter().enumerate() {
        columns.push(column(&format!("trailer_headings[{}]", i + 1), name, of(&format!("trailer_heading_{}", i + 1))));
    }
    (csv(&columns), left)
}

fn is_plain(entry: &ColumnEntry) -> bool {
    matches!(entry.reading.kind, Kind::Number | Kind::Time) && entry.columns.len() == 1
}

fn csv(columns: &[Column]) -> String {
    let mut out = columns.iter().map(|(name, _)| quoted(name)).collect::<Vec<_>>().join(",") + "\n";
    for i in 0..columns[0].1.len() {
        let cells: Vec<String> = columns.iter().map(|(_, v)| format!("{}", v[i])).collect();
        let _ = writeln!(out, "{}", cells.join(","));
    }
    out
}
