//! The commands of a document.
//!
//! | where | what is run |
//! |---|---|
//! | a `sh` block | every line that begins with `creepage` or `cargo run --release --`; a `\` at its end joins lines |
//! | a `console` block | what stands behind `$ `; the lines below it must be printed, in their order, `...` apart |
//! | a `toml` block with a comment `# creepage … mine.toml …` | the command, the block being saved as `mine.toml` |
//!
//! A line `# not run: REASON` above a command of a `sh` block leaves it out.

use super::documents::Document;
use super::fences::{self, Fence};

/// A command to run.
pub struct Command {
    /// As it stands in the document, lines joined.
    pub text: String,
    /// The line of the document at which its block begins.
    pub line: usize,
    /// Lines that it must print.
    pub shown: Vec<String>,
    /// What `mine.toml` holds.
    pub mine: Option<String>,
}

const OURS: [&str; 2] = ["creepage ", "cargo run --release -- "];
const MARK: &str = "# not run: ";

/// The program's own form of a line, where it is a command of ours.
fn ours(line: &str) -> Option<String> {
    OURS.iter().find_map(|start| line.strip_prefix(start)).map(|rest| format!("creepage {rest}"))
}

/// All commands of a document.
pub fn of(document: &Document) -> Vec<Command> {
    fences::of(document).iter().flat_map(of_fence).collect()
}

fn of_fence(fence: &Fence) -> Vec<Command> {
    match fence.language.as_str() {
        "sh" => in_shell(fence),
        "console" => in_console(fence),
        "toml" => in_file(fence),
        _ => vec![],
    }
}

/// Lines with their continuations.
fn joined(text: &str) -> Vec<String> {
    text.replace("\\\n", " ").lines().map(|line| line.split_whitespace().collect::<Vec<_>>().join(" ")).collect()
}

fn in_shell(fence: &Fence) -> Vec<Command> {
    let lines = joined(&fence.text);
    let mut found = vec![];
    for (i, line) in lines.iter().enumerate() {
        let excused = i > 0 && lines[i - 1].strip_prefix(MARK).is_some_and(|reason| !reason.trim().is_empty());
        if let Some(text) = ours(line).filter(|_| !excused) {
            found.push(Command { text, line: fence.line, shown: vec![], mine: None });
        }
    }
    found
}

fn in_console(fence: &Fence) -> Vec<Command> {
    let mut found: Vec<Command> = vec![];
    for line in fence.text.lines() {
        match (line.strip_prefix("$ "), found.last_mut()) {
            (Some(command), _) => {
                let text = ours(command).unwrap_or_else(|| command.to_string());
                found.push(Command { text, line: fence.line, shown: vec![], mine: None });
            }
            (None, Some(last)) => last.shown.push(line.to_string()),
            (None, None) => {}
        }
    }
    found
}

fn in_file(fence: &Fence) -> Vec<Command> {
    let commands = fence.text.lines().filter_map(|line| line.split_once("# creepage ").map(|(_, rest)| rest.trim()));
    let of = |rest: &str| Command {
        text: format!("creepage {rest}"),
        line: fence.line,
        shown: vec![],
        mine: Some(fence.text.clone()),
    };
    commands.filter(|rest| rest.contains("mine.toml")).map(of).collect()
}

/// Commands in blocks that nobody would run: without a language, or with a mark that gives no reason.
pub fn unmarked(document: &Document) -> Vec<String> {
    let at = |fence: &Fence, what: &str| format!("{}:{}: {what}", document.name, fence.line);
    let mut faults = vec![];
    for fence in fences::of(document) {
        let is_command = |line: &str| line.starts_with("creepage ") || line.starts_with("$ creepage ");
        let is_shell = ["sh", "console"].contains(&fence.language.as_str());
        if !is_shell && fence.text.lines().any(is_command) {
            faults.push(at(&fence, "a block with commands must be marked `sh` or `console`"));
        }
        if fence.text.lines().any(|line| line.trim_end() == MARK.trim_end()) {
            faults.push(at(&fence, "`# not run:` needs a reason"));
        }
    }
    faults
}
