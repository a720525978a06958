//! Report, page and pictures for people.

pub mod check_text;
pub mod figure_data;
pub mod html;
pub mod summary;
