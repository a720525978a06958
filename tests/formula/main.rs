//! The language of formulas: what it means, prints, differentiates, compiles and refuses.

mod agree;
mod bounds;
mod carriers;
mod creep;
mod derivatives;
mod edges;
mod exact;
mod jets;
mod lanes;
mod malformed;
mod normal;
mod print;
mod simplify;
#[path = "../support/mod.rs"]
mod support;
mod units;
