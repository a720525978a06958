//! `creepage completions`

use super::output::print;
use clap::{Args, Command};
use clap_complete::{Shell, generate};
use creepage::Result;

/// Print a script that completes commands and options in a shell
#[derive(Args)]
#[command(after_help = "\
Examples:
  creepage completions bash > ~/.local/share/bash-completion/completions/creepage
  creepage completions zsh > ~/.zfunc/_creepage
  creepage completions fish > ~/.config/fish/completions/creepage.fish")]
pub struct Arguments {
    /// The shell
    #[arg(value_enum)]
    shell: Shell,
}

/// Carries out the command.
pub fn run(arguments: &Arguments, mut all: Command) -> Result<()> {
    let mut script = Vec::new();
    generate(arguments.shell, &mut all, "creepage", &mut script);
    print(&String::from_utf8_lossy(&script))?;
    Ok(())
}
