//! A cell to read, and how its text becomes a number.

/// A cell to read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Place {
    /// Its place in the header, from zero.
    pub index: usize,
    pub form: Form,
}

/// How the text of a cell becomes a number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Form {
    /// As it stands.
    Number,
    /// As it stands, or a date.
    Time,
    /// Units of 10 to this negative power of a second.
    Stamp(u32),
}
