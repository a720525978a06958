//! The command `creepage`.

use clap::Parser;
use creepage::command::{Cli, ended};
use std::process::ExitCode;

fn main() -> ExitCode {
    ExitCode::from(ended(Cli::parse().run()))
}
