//! `creepage fleet map` and `creepage fleet join`

use super::output::{Format, print, print_answer};
use super::progress::ProgressLine;
use super::user_catalogues::UserCatalogues;
use clap::{Args, Subcommand};
use creepage::files::{Manifest, write_all_or_nothing};
use creepage::fleet::{Joined, Mapped, Rows, fleet_html, fleet_table, fleet_text, join, map};
use creepage::sweep::Shard;
use creepage::{Error, Result};
use std::path::PathBuf;

/// Many robots, many runs: what they share, which differ, and a model for each
#[derive(Args)]
#[command(after_help = "\
Examples:
  creepage fleet map FLEET.csv --out rows
  creepage fleet join rows --out fleet

FLEET.csv has a line for every log: robot,log,model and, where there are such, run,date,truth and any tags (floor, load, tyre).
Paths in it are taken from its folder. See `creepage help fleet map`.")]
pub struct Arguments {
    #[command(subcommand)]
    step: Step,
}

#[derive(Subcommand)]
enum Step {
    Map(MapArguments),
    Join(JoinArguments),
}

/// Ask discover of every robot of a manifest, robot by robot
#[derive(Args)]
#[command(after_help = "\
Examples:
  creepage fleet map FLEET.csv --out rows
  creepage fleet map FLEET.csv --out rows --shard 3/8

Stopped at any moment and started again it goes on where it was; a robot whose model or logs have changed is asked anew. Shards
may run anywhere that sees the same files; their rows go into one folder. Robots whose files cannot be used are told at the
end, with exit code 2; the rows of all others are kept.")]
struct MapArguments {
    /// The table of logs
    #[arg(value_name = "MANIFEST.csv")]
    manifest: PathBuf,
    /// Folder for the rows
    #[arg(long, value_name = "ROWS")]
    out: PathBuf,
    /// Ask the robots of the I-th of N parts, counted from 1
    #[arg(long, value_name = "I/N", allow_hyphen_values = true)]
    shard: Option<Shard>,
    #[command(flatten)]
    own: UserCatalogues,
}

/// Put the rows of a fleet together
#[derive(Args)]
#[command(after_help = "\
Example:
  creepage fleet join rows --out fleet

Fits every run with the effects that the fleet needs, significant or not, and writes fleet.json, fleet.html, fleet.csv (and
fleet.parquet where the program was built with that feature), robots/ROBOT.toml, with robots/ROBOT.yaml where ROS 2 has a controller for the vehicle. Fits that were made before are kept in
ROWS.")]
struct JoinArguments {
    /// The folder of rows
    #[arg(value_name = "ROWS")]
    rows: PathBuf,
    /// Folder for what the fleet says
    #[arg(long, value_name = "DIR", default_value = "fleet")]
    out: PathBuf,
    /// Join what rows there are, where some are missing
    #[arg(long)]
    incomplete: bool,
    /// How to print it
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

/// Carries out the command.
pub fn run(arguments: &Arguments, quiet: bool) -> Result<()> {
    match &arguments.step {
        Step::Map(arguments) => run_map(arguments, quiet),
        Step::Join(arguments) => run_join(arguments, quiet),
    }
}

fn run_map(arguments: &MapArguments, quiet: bool) -> Result<()> {
    let manifest = Manifest::read(&arguments.manifest)?;
    let [vehicles, effects] = arguments.own.files().map(|path| path.map(PathBuf::from));
    let mapped = Mapped { schema: 1, manifest, vehicles, effects };
    let progress = ProgressLine::new(quiet);
    let shard = arguments.shard.unwrap_or(Shard::WHOLE);
    let done = map(&mapped, &Rows::at(&arguments.out), shard, &|p| progress.hear(p))?;
    drop(progress);
    if !quiet {
        let found =
            if done.found > 0 { format!(", {} of them from an earlier map", done.found) } else { String::new() };
        let kept = done.robots - done.failed.len();
        print(&format!("rows of {kept} robots{found} are in {}\n", arguments.out.display()))?;
    }
    let mut failed = done.failed.into_iter();
    let Some((robot, first)) = failed.next() else { return Ok(()) };
    for (robot, e) in failed {
        eprintln!("creepage: robot {robot}: {e}");
    }
    eprintln!("creepage: robot {robot}:");
    Err(first)
}

fn run_join(arguments: &JoinArguments, quiet: bool) -> Result<()> {
    let progress = ProgressLine::new(quiet);
    let joined = join(&Rows::at(&arguments.rows), arguments.incomplete, &|p| progress.hear(p))?;
    drop(progress);
    write(&joined, arguments)?;
    print_answer(&joined.report, arguments.format, quiet, |report| {
        format!(
            "{}\nfleet.html, fleet.json, fleet.csv and robots/ are in {}\n",
            fleet_text(report),
            arguments.out.display()
        )
    })
}

fn write(joined: &Joined, arguments: &JoinArguments) -> Result<()> {
    let json = serde_json::to_string_pretty(&joined.report).map_err(|e| Error::run(format!("no JSON: {e}")))?;
    let robots: Vec<(String, &str)> = joined.models.iter().flat_map(|m| m.files()).collect();
    let robots: Vec<(&str, &[u8])> = robots.iter().map(|(name, text)| (name.as_str(), text.as_bytes())).collect();
    write_all_or_nothing(arguments.out.join("robots"), &robots)?;
    let (page, table) = (fleet_html(&joined.report), fleet_table(joined));
    let files = [("fleet.json", json + "\n"), ("fleet.html", page), ("fleet.csv", table)];
    let mut files: Vec<(&str, Vec<u8>)> = files.into_iter().map(|(name, text)| (name, text.into_bytes())).collect();
    files.extend(parquet(joined)?.map(|bytes| ("fleet.parquet", bytes)));
    let files: Vec<(&str, &[u8])> = files.iter().map(|(name, bytes)| (*name, bytes.as_slice())).collect();
    write_all_or_nothing(&arguments.out, &files)
}

#[cfg(feature = "parquet")]
fn parquet(joined: &Joined) -> Result<Option<Vec<u8>>> {
    creepage::fleet::fleet_parquet(joined).map(Some)
}

#[cfg(not(feature = "parquet"))]
fn parquet(_: &Joined) -> Result<Option<Vec<u8>>> {
    Ok(None)
}
