//! Logs: CSV, Parquet and MCAP as columns, rows put in order, runs made of them.

pub(crate) mod columns;
pub(crate) mod csv_cell;
pub(crate) mod csv_records;
pub(crate) mod csv_table;
pub(crate) mod header;
pub(crate) mod inputs;
pub(crate) mod log_file;
#[cfg(feature = "mcap")]
pub(crate) mod mcap;
#[cfg(feature = "parquet")]
pub(crate) mod parquet;
pub(crate) mod row_order;
pub(crate) mod run;
pub(crate) mod two_clocks;
#[cfg(any(feature = "parquet", feature = "mcap"))]
pub(crate) mod usable_rows;
