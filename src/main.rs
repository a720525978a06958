//! The command `creepage`.

mod command;

use clap::Parser;
use std::process::ExitCode;

fn main() -> ExitCode {
    match command::Cli::parse().run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("creepage: {error}");
            ExitCode::from(error.exit_code())
        }
    }
}
