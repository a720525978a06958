//! One error for the whole program: what is wrong, where, and what to do about it.

use std::fmt;
use std::path::{Path, PathBuf};

/// The result of anything that can fail for a reason a user should read.
pub type Result<T> = std::result::Result<T, Error>;

/// Whose fault an [`Error`] is; it decides the exit code of the command.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Wrong usage or unusable input: exit code 2.
    Input,
    /// A run that failed although its input was good: exit code 1.
    Run,
}

/// A message for a person, with the place it speaks of.
///
/// ```
/// use creepage::Error;
/// let e = Error::input("column \"speed\" is missing").at_file("run.csv").at(1, 7)
///     .help("name it under [columns] of the model file");
/// assert_eq!(e.to_string(), "run.csv:1:7: column \"speed\" is missing; name it under [columns] of the model file");
/// assert_eq!(e.exit_code(), 2);
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Error {
    kind: Kind,
    message: String,
    file: Option<PathBuf>,
    place: Option<(usize, usize)>,
    help: Option<String>,
    excerpt: Option<String>,
}

impl Error {
    /// Unusable input or wrong usage.
    pub fn input(message: impl Into<String>) -> Self {
        Self::new(Kind::Input, message.into())
    }

    /// A run that failed on good input.
    pub fn run(message: impl Into<String>) -> Self {
        Self::new(Kind::Run, message.into())
    }

    fn new(kind: Kind, message: String) -> Self {
        Self { kind, message, file: None, place: None, help: None, excerpt: None }
    }

    /// The file the message speaks of; an inner file named before is kept.
    pub fn at_file(mut self, path: impl AsRef<Path>) -> Self {
        self.file.get_or_insert_with(|| path.as_ref().to_path_buf());
        self
    }

    /// Line and column, both counted from one; an inner place named before is kept.
    pub fn at(mut self, line: usize, column: usize) -> Self {
        self.place.get_or_insert((line, column));
        self
    }

    /// What the reader should do.
    pub fn help(mut self, advice: impl Into<String>) -> Self {
        self.help.get_or_insert_with(|| advice.into());
        self
    }

    /// Lines shown under the message, such as a formula with a caret.
    pub fn excerpt(mut self, lines: impl Into<String>) -> Self {
        self.excerpt.get_or_insert_with(|| lines.into());
        self
    }

    /// What is wrong, without place and advice.
    pub fn message(&self) -> &str {
        &self.message
    }

    /// Line and column, when known.
    pub fn place(&self) -> Option<(usize, usize)> {
        self.place
    }

    /// The exit code the contract gives this error: 2 for input, 1 for a failed run.
    pub fn exit_code(&self) -> u8 {
        match self.kind {
            Kind::Input => 2,
            Kind::Run => 1,
        }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(file) = &self.file {
            write!(f, "{}:", file.display())?;
        }
        if let Some((line, column)) = self.place {
            write!(f, "{line}:{column}:")?;
        }
        if self.file.is_some() || self.place.is_some() {
            write!(f, " ")?;
        }
        write!(f, "{}", self.message)?;
        if let Some(help) = &self.help {
            write!(f, "; {help}")?;
        }
        if let Some(excerpt) = &self.excerpt {
            write!(f, "\n{excerpt}")?;
        }
        Ok(())
    }
}

impl std::error::Error for Error {}
