//! Progress on a terminal.

use super::stage_text::stage_text;
use creepage::{Progress, Stage};
use indicatif::{HumanDuration, ProgressBar, ProgressState, ProgressStyle};
use std::fmt;
use std::io::{IsTerminal, Write};
use std::mem::{Discriminant, discriminant};
use std::ops::ControlFlow;
use std::path::Path;
use std::sync::Mutex;
use std::time::Duration;

/// A line without a count.
const PLAIN: &str = "{spinner} {elapsed} {wide_msg}";
/// A line with a count and the time left.
const COUNTED: &str = "{spinner} {elapsed} [{bar:24}] {human_pos} of {human_len} {wide_msg}{left}";

/// A line that says what is being done and how far it is, drawn only on a terminal and gone at the end.
pub struct ProgressLine {
    bar: ProgressBar,
    /// The stage that is shown, and of how many parts.
    shown: Mutex<Option<(Discriminant<Stage>, usize)>>,
}

impl ProgressLine {
    /// A line, hidden when quiet or when nobody looks.
    pub fn new(quiet: bool) -> Self {
        if quiet || !std::io::stderr().is_terminal() {
            return Self::on(ProgressBar::hidden());
        }
        let line = Self::on(ProgressBar::new_spinner());
        line.style(PLAIN);
        line.bar.enable_steady_tick(Duration::from_millis(120));
        line
    }

    fn on(bar: ProgressBar) -> Self {
        Self { bar, shown: Mutex::new(None) }
    }

    fn style(&self, template: &str) {
        // A malformed template would only lose the colours.
        if let Ok(style) = ProgressStyle::with_template(template) {
            self.bar.set_style(style.with_key("left", time_left));
        }
    }

    /// Shows how far the work is, and lets it go on.
    pub fn hear(&self, p: Progress) -> ControlFlow<()> {
        self.bar.set_message(stage_text(&p.stage));
        let stage = (discriminant(&p.stage), p.of);
        // Where another thread died while it held this, the line is still right.
        let mut shown = self.shown.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
        if p.done == 0 || *shown != Some(stage) {
            *shown = Some(stage);
            self.start(&p);
        }
        // Threads tell in no order: a count that comes late does not go back.
        if p.of > 0 && p.done as u64 > self.bar.position() {
            self.bar.set_position(p.done as u64);
        }
        ControlFlow::Continue(())
    }

    /// Begins a stage; what was there before does not count for the time left.
    fn start(&self, p: &Progress) {
        let before = if let Stage::Cases { found } = p.stage { found } else { 0 };
        self.style(if p.of > 0 { COUNTED } else { PLAIN });
        self.bar.set_length(p.of as u64);
        self.bar.set_position(before as u64);
        self.bar.reset_eta();
    }

    /// What a user should know of a file, above the line and on standard error.
    pub fn warn(&self, file: &Path, warnings: &[String]) {
        // Where a warning cannot be written the result is still good.
        let write = |w: &String| drop(writeln!(std::io::stderr(), "creepage: warning: {}: {w}", file.display()));
        self.bar.suspend(|| warnings.iter().for_each(write));
    }

    /// What is being done now.
    pub fn say(&self, what: &str) {
        self.bar.set_message(what.to_string());
    }
}

impl Drop for ProgressLine {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

/// The time left, once there is a rate to tell it by.
fn time_left(state: &ProgressState, out: &mut dyn fmt::Write) {
    if state.per_sec() > 0.0 {
        // A terminal that takes no more text loses the line, not the work.
        let _ = write!(out, " {} left", HumanDuration(state.eta()));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_knows_how_far_it_is() {
        let line = ProgressLine::on(ProgressBar::hidden());
        let at = |stage: Stage, done: usize, of: usize| {
            assert!(line.hear(Progress { stage, done, of }).is_continue());
            (line.bar.position(), line.bar.length())
        };
        for (done, of) in [(3, 10), (4, 10), (4, 12)] {
            assert_eq!(at(Stage::Cases { found: 2 }, done, of), (done as u64, Some(of as u64)));
        }
        // A count that comes late; the same stage once more; another stage.
        assert_eq!(at(Stage::Cases { found: 2 }, 3, 12), (4, Some(12)));
        assert_eq!(at(Stage::Candidates { chosen: 0 }, 7, 12), (7, Some(12)));
        assert_eq!(at(Stage::Candidates { chosen: 1 }, 0, 12), (0, Some(12)));
        assert_eq!(at(Stage::ModelFit, 0, 0), (0, Some(0)));
    }
}
