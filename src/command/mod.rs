//! The command line: arguments → one library call → print.

mod check;
mod completions;
mod describe;
mod discover;
mod export;
mod figures;
mod fit;
mod fleet;
mod init;
mod lists;
mod man;
mod output;
mod plan;
mod plan_task;
mod progress;
mod runs;
mod simulate;
mod stage_text;
mod sweep;
mod terminal;
mod track;
mod user_catalogues;
mod verify;
mod worker_threads;

pub use stage_text::stage_text;

use clap::{Args, CommandFactory, Parser, Subcommand};
use creepage::{Error, Result};
use std::io::Write;

/// Creep kinematics of nonholonomic vehicles: constraints derived, models corrected by measured runs.
#[derive(Parser)]
#[command(name = "creepage", version, about, arg_required_else_help = true)]
pub struct Cli {
    #[command(subcommand)]
    command: Command,
    #[command(flatten)]
    common: Common,
}

/// Options of every command.
#[derive(Args)]
struct Common {
    /// Print nothing but errors
    #[arg(long, short, global = true)]
    quiet: bool,
    /// Threads to use; the output is the same for every number [default: all cores]
    #[arg(long, global = true, allow_negative_numbers = true, value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
}

#[derive(Subcommand)]
enum Command {
    Init(init::Arguments),
    Check(check::Arguments),
    Discover(discover::Arguments),
    Fit(fit::Arguments),
    Export(export::Arguments),
    Plan(plan::Arguments),
    Track(track::Arguments),
    Fleet(fleet::Arguments),
    Simulate(simulate::Arguments),
    Sweep(sweep::Arguments),
    Describe(describe::Arguments),
    Figures(figures::Arguments),
    Vehicles(lists::Vehicles),
    Effects(lists::Effects),
    Verify(verify::Arguments),
    Claims(verify::List),
    Completions(completions::Arguments),
    Man(man::Arguments),
}

/// The exit code of a command that has ended; what went wrong is told on standard error.
pub fn ended(done: Result<()>) -> u8 {
    let Err(error) = done else { return 0 };
    // Where even this cannot be written, the exit code still tells.
    let _ = writeln!(std::io::stderr(), "creepage: {error}");
    error.exit_code()
}

impl Cli {
    /// Carries out the command.
    ///
    /// # Errors
    /// With the exit code the contract gives.
    pub fn run(self) -> Result<()> {
        // Here, where it can be told: threads that cannot be started later would end the process.
        let threads = self.common.threads.map_or(0, usize::from);
        worker_threads::start_pool(threads).map_err(|e| {
            Error::run(format!("no threads could be started: {e}")).help("try --threads 1, or end other programs")
        })?;
        match self.command {
            Command::Init(arguments) => init::run(&arguments, self.common.quiet),
            Command::Check(arguments) => check::run(&arguments, self.common.quiet),
            Command::Discover(arguments) => discover::run(&arguments, self.common.quiet),
            Command::Fit(arguments) => fit::run(&arguments, self.common.quiet),
            Command::Export(arguments) => export::run(&arguments, self.common.quiet),
            Command::Plan(arguments) => plan::run(&arguments, self.common.quiet),
            Command::Track(arguments) => track::run(&arguments, self.common.quiet),
            Command::Fleet(arguments) => fleet::run(&arguments, self.common.quiet),
            Command::Simulate(arguments) => simulate::run(&arguments, self.common.quiet),
            Command::Sweep(arguments) => sweep::run(&arguments, self.common.quiet),
            Command::Describe(arguments) => describe::run(&arguments),
            Command::Figures(arguments) => figures::run(&arguments, self.common.quiet),
            Command::Vehicles(arguments) => lists::vehicles(&arguments),
            Command::Effects(arguments) => lists::effects(&arguments),
            Command::Verify(arguments) => verify::run(&arguments, self.common.quiet),
            Command::Claims(arguments) => verify::list(&arguments),
            Command::Completions(arguments) => completions::run(&arguments, Self::command()),
            Command::Man(arguments) => man::run(&arguments, Self::command(), self.common.quiet),
        }
    }
}
