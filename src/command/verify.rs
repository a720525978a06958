//! `creepage verify` and `creepage claims`

use super::output::{pretty, print};
use super::progress::ProgressLine;
use super::user_catalogues::UserVehicles;
use clap::{Args, ValueEnum};
use creepage::claims::kernel::proofs;
use creepage::claims::{self, Claim, Options, ledger};
use creepage::files::write_all_or_nothing;
use creepage::{Error, Result};
use std::path::PathBuf;

/// Run the claims of the paper and say which status each of them earns
#[derive(Args)]
#[command(after_help = "\
Examples:
  creepage verify
  creepage verify eq-21 theorem-single-body --cases 10000 --seed 7
  creepage verify --claims my_claims.toml mine-1
  creepage verify --claims examples/bus/claims.toml --vehicles examples/bus/bus.toml bus-front

Exit code 0 only if every claim earns the status stated for it.")]
pub struct Arguments {
    /// Claims to run, by id; all when none is named
    #[arg(value_name = "CLAIM")]
    only: Vec<String>,
    /// Cases of each sampled check
    #[arg(long, value_name = "N", allow_negative_numbers = true, default_value_t = Options::default().cases, value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    cases: u32,
    /// Everything generated follows from it
    #[arg(long, value_name = "S", allow_negative_numbers = true, default_value_t = 0)]
    seed: u64,
    /// Adds claims of your own: identities of formulas, see "Checking the theory" in the book
    #[arg(long, value_name = "FILE.toml")]
    claims: Option<PathBuf>,
    #[command(flatten)]
    own: UserVehicles,
    /// How to print the ledger
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    /// In place of running the claims: writes what they prove as theorems for an independent kernel, `coq`, into a folder
    #[arg(long, num_args = 2, value_names = ["KERNEL", "DIR"])]
    export: Option<Vec<String>>,
}

#[derive(Clone, Copy, ValueEnum)]
enum Format {
    Text,
    Json,
    /// The errata of the paper as Markdown
    Errata,
}

/// List the claims with their places and stated statuses
#[derive(Args)]
#[command(after_help = "Example:\n  creepage claims --format contents")]
pub struct List {
    /// Adds claims of your own
    #[arg(long, value_name = "FILE.toml")]
    claims: Option<PathBuf>,
    #[command(flatten)]
    own: UserVehicles,
    /// How to print them
    #[arg(long, value_enum, default_value_t = ListFormat::Text)]
    format: ListFormat,
}

#[derive(Clone, Copy, ValueEnum)]
enum ListFormat {
    Text,
    Json,
    /// From equation number to claim to test to code, as Markdown
    Contents,
}

fn known(own: Option<&PathBuf>, vehicles: &UserVehicles) -> Result<Vec<Claim>> {
    // A file of vehicles is read even where no claim may speak of them: a slip in it is worth knowing.
    let vehicles = vehicles.all()?;
    let mut all = claims::all();
    if let Some(path) = own {
        let own = claims::read(path, &vehicles)?;
        if let Some(twice) = own.iter().find(|c| all.iter().any(|a| a.id == c.id)) {
            return Err(Error::input(format!("the claim {} of {} is already known", twice.id, path.display()))
                .help("give it another id"));
        }
        all.extend(own);
    }
    Ok(all)
}

/// Carries out `creepage verify`.
pub fn run(arguments: &Arguments, quiet: bool) -> Result<()> {
    let all = known(arguments.claims.as_ref(), &arguments.own)?;
    if let Some(unknown) = arguments.only.iter().find(|id| all.iter().all(|c| c.id != **id)) {
        return Err(Error::input(format!("no claim is called {unknown:?}")).help("`creepage claims` lists them"));
    }
    let wanted: Vec<Claim> =
        all.into_iter().filter(|c| arguments.only.is_empty() || arguments.only.contains(&c.id)).collect();
    if let Some(export) = &arguments.export {
        return export_proofs(&wanted, export, quiet);
    }
    let progress = ProgressLine::new(quiet);
    let options = Options { cases: arguments.cases, seed: arguments.seed };
    let made = claims::verify(&wanted, &options, &|p| progress.hear(p))?;
    drop(progress);
    match arguments.format {
        Format::Text if quiet => {}
        Format::Text => print(&ledger::text(&made))?,
        Format::Json => print(&pretty(&ledger::json(&made)))?,
        Format::Errata => print(&ledger::errata(&made))?,
    }
    let unearned: Vec<&str> = made.entries.iter().filter(|e| !e.is_earned()).map(|e| e.claim.id.as_str()).collect();
    match unearned.is_empty() {
        true => Ok(()),
        false => Err(Error::run(format!("the stated status is not earned by {}", unearned.join(", ")))),
    }
}

/// Writes the proofs for another kernel and says what was left out.
fn export_proofs(wanted: &[Claim], export: &[String], quiet: bool) -> Result<()> {
    let [kernel, dir] = export else { return Err(Error::input("--export takes a kernel and a folder")) };
    if kernel != "coq" {
        return Err(Error::input(format!("no kernel is called {kernel:?}")).help("write `--export coq DIR`"));
    }
    let made = proofs(wanted);
    let files = made.files();
    let files: Vec<(&str, &[u8])> = files.iter().map(|(name, text)| (name.as_str(), text.as_bytes())).collect();
    write_all_or_nothing(dir, &files)?;
    if quiet { Ok(()) } else { print(&ledger::proofs_text(&made, dir)) }
}

/// Carries out `creepage claims`.
pub fn list(arguments: &List) -> Result<()> {
    let all = known(arguments.claims.as_ref(), &arguments.own)?;
    print(&match arguments.format {
        ListFormat::Text => ledger::claims_text(&all),
        ListFormat::Json => pretty(&ledger::claims_json(&all)),
        ListFormat::Contents => ledger::contents(&all),
    })
}
