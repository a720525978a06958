//! The result of a fleet for people: text, a page, a table.

pub mod caterpillar;
pub mod fleet_html;
pub mod fleet_table;
pub mod fleet_text;
mod over_time;
