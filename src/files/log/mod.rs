//! Logs: tables of text, Parquet and MCAP as columns, rows put in order, runs made of them.

pub(crate) mod cells;
pub(crate) mod column_entry;
pub(crate) mod columns;
mod counts;
pub(crate) mod csv_cell;
pub(crate) mod csv_dialect;
pub(crate) mod csv_records;
pub(crate) mod csv_table;
mod folder;
pub(crate) mod header;
pub(crate) mod inputs;
pub(crate) mod log_file;
#[cfg(feature = "mcap")]
pub(crate) mod mcap;
mod outer_join;
pub(crate) mod own_times;
#[cfg(feature = "parquet")]
pub(crate) mod parquet;
pub(crate) mod place;
mod pose_filter;
pub(crate) mod quaternion;
mod reading;
pub(crate) mod row_order;
pub(crate) mod run;
pub(crate) mod stream;
pub(crate) mod tangent_plane;
pub(crate) mod time_stamp;
mod trajectories;
pub(crate) mod two_clocks;
pub(crate) mod unit;
#[cfg(any(feature = "parquet", feature = "mcap"))]
pub(crate) mod usable_rows;
