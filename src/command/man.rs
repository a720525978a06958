//! `creepage man`

use super::output::print;
use clap::{Args, Command};
use clap_mangen::Man;
use creepage::files::write_all_or_nothing;
use creepage::{Error, Result};
use std::path::PathBuf;

/// Print the manual page, or write one for every command
#[derive(Args)]
#[command(after_help = "\
Examples:
  creepage man | man -l -
  creepage man --out ~/.local/share/man/man1")]
pub struct Arguments {
    /// Folder for the pages of all commands: creepage.1, creepage-discover.1, …
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

/// Carries out the command.
pub fn run(arguments: &Arguments, mut all: Command, quiet: bool) -> Result<()> {
    all.build();
    let Some(out) = &arguments.out else {
        print(&page(all)?)?;
        return Ok(());
    };
    let mut pages = vec![("creepage.1".to_string(), page(all.clone())?)];
    for command in all.get_subcommands().filter(|c| c.get_name() != "help") {
        pages.push((format!("creepage-{}.1", command.get_name()), page(command.clone())?));
    }
    let files: Vec<(&str, &[u8])> = pages.iter().map(|(name, text)| (name.as_str(), text.as_bytes())).collect();
    write_all_or_nothing(out, &files)?;
    if !quiet {
        print(&format!("{} pages are in {}\n", pages.len(), out.display()))?;
    }
    Ok(())
}

fn page(command: clap::Command) -> Result<String> {
    let mut text = Vec::new();
    Man::new(command).render(&mut text).map_err(|e| Error::run(format!("no manual page: {e}")))?;
    Ok(String::from_utf8_lossy(&text).into_owned())
}
