//! Sweeps: one model, many cases, a table of what became of them.

mod cases;
mod join;
mod journal;
pub(crate) mod names;
#[cfg(feature = "parquet")]
mod parquet;
mod prepared_sweep;
mod run;
mod shard;
mod table;

pub use prepared_sweep::Sweep;
pub use run::Summary;
pub use shard::Shard;
#[doc(hidden)]
pub use table::Format;
