//! Progress on a terminal.

use indicatif::{ProgressBar, ProgressStyle};
use std::io::{IsTerminal, Write};
use std::path::Path;
use std::time::Duration;

/// A line that says what is being done, drawn only on a terminal and gone at the end.
pub struct Progress(ProgressBar);

impl Progress {
    /// A line, hidden when quiet or when nobody looks.
    pub fn new(quiet: bool) -> Self {
        if quiet || !std::io::stderr().is_terminal() {
            return Self(ProgressBar::hidden());
        }
        let bar = ProgressBar::new_spinner();
        // A malformed template would only lose the colours.
        if let Ok(style) = ProgressStyle::with_template("{spinner} {elapsed} {wide_msg}") {
            bar.set_style(style);
        }
        bar.enable_steady_tick(Duration::from_millis(120));
        Self(bar)
    }

    /// A bar with the time left, hidden when quiet or when nobody looks.
    pub fn bar(quiet: bool) -> Self {
        let progress = Self::new(quiet);
        let template = "{spinner} {elapsed} [{wide_bar}] {human_pos}/{human_len} {msg} {eta} left";
        if let (false, Ok(style)) = (progress.0.is_hidden(), ProgressStyle::with_template(template)) {
            progress.0.set_style(style);
        }
        progress
    }

    /// How far it is; what was there before does not count for the time left.
    pub fn at(&self, done: usize, all: usize, found: usize) {
        if self.0.length() != Some(all as u64) {
            self.0.set_length(all as u64);
            self.0.set_position(found as u64);
            self.0.reset_eta();
        }
        self.0.set_position(done as u64);
    }

    /// What a user should know of a file, above the line and on standard error.
    pub fn warn(&self, file: &Path, warnings: &[String]) {
        // Where a warning cannot be written the result is still good.
        let write = |w: &String| drop(writeln!(std::io::stderr(), "creepage: warning: {}: {w}", file.display()));
        self.0.suspend(|| warnings.iter().for_each(write));
    }

    /// What is being done now.
    pub fn say(&self, what: &str) {
        self.0.set_message(what.to_string());
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bar_knows_how_far_it_is() {
        let progress = Progress(ProgressBar::hidden());
        for (done, all) in [(3, 10), (4, 10), (4, 12)] {
            progress.at(done, all, 2);
            assert_eq!((progress.0.position(), progress.0.length()), (done as u64, Some(all as u64)));
        }
    }
}
