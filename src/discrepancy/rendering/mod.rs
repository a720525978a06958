//! Report, page and pictures for people.

pub mod figure_data;
pub mod html;
pub mod summary;
