//! Where model and measurement disagree, said as data, as a page and as a screen of text.

pub mod html;
pub mod report;
pub mod summary;
