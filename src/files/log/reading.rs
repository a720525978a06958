//! Quantities of a log, read through their cells.

use super::cells::{self, Cells};
use super::csv_table::Numbers;
use super::log_file::Log;
use super::place::Place;
use crate::error::Result;

/// Reads quantities, the time first; a row that lacks one of `more` stays, and has NaN there.
pub(crate) fn read(log: Log, needed: &[&Cells], more: &[&Cells]) -> Result<Numbers> {
    let log = match log {
        Log::Folder(folder) => return folder.read(&[needed, more].concat()),
        log => log,
    };
    let places = |cells: &[&Cells]| cells.iter().flat_map(|c| c.places()).collect::<Vec<Place>>();
    let names: Vec<String> = needed.iter().map(|c| log.header()[c.places[0]].clone()).collect();
    let numbers = match log.has_topics() {
        true => log.numbers_and(&places(&[needed, more].concat()), &[])?,
        false => log.numbers_and(&places(needed), &places(more))?,
    };
    let mut numbers = cells::joined(numbers, &[needed, more].concat());
    cells::drop_rows_without(&mut numbers, &names);
    Ok(numbers)
}

/// As [`read`], with NaN for whatever a row lacks but its time.
pub(crate) fn read_all_rows(log: Log, time: &Cells, more: &[&Cells]) -> Result<Numbers> {
    let places = |cells: &[&Cells]| cells.iter().flat_map(|c| c.places()).collect::<Vec<Place>>();
    let numbers = log.numbers_and(&places(&[time]), &places(more))?;
    Ok(cells::joined(numbers, &[&[time], more].concat()))
}
