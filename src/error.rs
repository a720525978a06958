//! One error for the whole program: what is wrong, where, and what to do about it.

use std::fmt;
use std::path::{Path, PathBuf};

/// The result of anything that can fail for a reason a user should read.
///
/// ```
/// fn radius(text: &str) -> creepage::Result<f64> {
///     text.parse().map_err(|_| creepage::Error::input(format!("{text:?} is no number")))
/// }
/// assert!(radius("0.3").is_ok() && radius("wide").is_err());
/// ```
pub type Result<T> = std::result::Result<T, Error>;

/// Whose fault an [`Error`] is; it decides the exit code of the command.
///
/// ```
/// use creepage::{Error, ErrorKind};
/// assert_eq!(Error::run("the motion is undefined").kind(), ErrorKind::Run);
/// assert_eq!(creepage::Model::parse("vehicle = 7").unwrap_err().kind(), ErrorKind::Input);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Wrong usage or unusable input: exit code 2.
    Input,
    /// A run that failed although its input was good: exit code 1.
    Run,
    /// An answer that was asked to end the command: exit code 3.
    Verdict,
    /// Work that its listener stopped: exit code 1.
    Stopped,
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
pub struct Error(Box<Inner>);

/// Behind a pointer, so that a result without an error stays small.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Inner {
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

    /// An answer that was asked to end the command.
    pub fn verdict(message: impl Into<String>) -> Self {
        Self::new(Kind::Verdict, message.into())
    }

    /// Work that its listener stopped.
    pub(crate) fn stopped() -> Self {
        Self::new(Kind::Stopped, "the work was stopped before its end".into())
    }

    fn new(kind: Kind, message: String) -> Self {
        Self(Box::new(Inner { kind, message, file: None, place: None, help: None, excerpt: None }))
    }

    /// The file the message speaks of; an inner file named before is kept.
    pub fn at_file(mut self, path: impl AsRef<Path>) -> Self {
        self.0.file.get_or_insert_with(|| path.as_ref().to_path_buf());
        self
    }

    /// Line and column, both counted from one; an inner place named before is kept.
    pub fn at(mut self, line: usize, column: usize) -> Self {
        self.0.place.get_or_insert((line, column));
        self
    }

    /// What the reader should do.
    pub fn help(mut self, advice: impl Into<String>) -> Self {
        self.0.help.get_or_insert_with(|| advice.into());
        self
    }

    /// Lines shown under the message, such as a formula with a caret.
    pub fn excerpt(mut self, lines: impl Into<String>) -> Self {
        self.0.excerpt.get_or_insert_with(|| lines.into());
        self
    }

    /// The same error at another place, for a text that is part of a file.
    pub fn moved_to(mut self, line: usize, column: usize) -> Self {
        self.0.place = Some((line, column));
        self
    }

    /// What is wrong, without place and advice.
    pub fn message(&self) -> &str {
        &self.0.message
    }

    /// Line and column, when known.
    pub fn place(&self) -> Option<(usize, usize)> {
        self.0.place
    }

    /// The file it speaks of, where it speaks of one.
    pub fn file(&self) -> Option<&Path> {
        self.0.file.as_deref()
    }

    /// What the reader should do, where there is something.
    pub fn advice(&self) -> Option<&str> {
        self.0.help.as_deref()
    }

    /// Whose fault it is.
    pub fn kind(&self) -> Kind {
        self.0.kind
    }

    /// The exit code the contract gives this error: 2 for input, 1 for a failed run, 3 for an answer asked to fail.
    pub fn exit_code(&self) -> u8 {
        match self.0.kind {
            Kind::Input => 2,
            Kind::Run | Kind::Stopped => 1,
            Kind::Verdict => 3,
        }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(file) = &self.0.file {
            write!(f, "{}:", file.display())?;
        }
        if let Some((line, column)) = self.0.place {
            write!(f, "{line}:{column}:")?;
        }
        if self.0.file.is_some() || self.0.place.is_some() {
            write!(f, " ")?;
        }
        write!(f, "{}", self.0.message)?;
        if let Some(help) = &self.0.help {
            write!(f, "; {help}")?;
        }
        if let Some(excerpt) = &self.0.excerpt {
            write!(f, "\n{excerpt}")?;
        }
        Ok(())
    }
}

impl std::error::Error for Error {}
