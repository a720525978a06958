//! `creepage init`

use super::output::print;
use super::user_catalogues::UserVehicles;
use clap::Args;
use creepage::files::{ModelFile, read_beginning, write_whole};
use creepage::scaffold::{Measures, Starter, Wanted};
use creepage::{Error, Result, effects, model};
use std::path::{Path, PathBuf};

/// Write a commented model file to begin with
#[derive(Args)]
#[command(after_help = "\
Examples:
  creepage init differential-drive --from RUN.csv
  creepage init unicycle --from examples/runs/cornering/eights.csv --out model.toml
  creepage init unicycle --from INPUTS.csv --truth POSES.csv
  creepage init differential-drive --from RUN.csv --urdf robot.urdf
  creepage init n-trailer --tractor car --trailers 2 --out truck.toml
  creepage init articulated-bus --vehicles examples/bus/bus.toml --out bus.toml

Parameters are placeholders with unit and meaning, columns are those of RUN.csv that the roles are likely to mean, with
the units that their names and values speak for; what is not found is to be named. An older file is kept unless --force is given. `creepage vehicles` lists vehicles.")]
pub struct Arguments {
    /// The vehicle
    #[arg(value_name = "VEHICLE")]
    vehicle: String,
    /// Where the model file goes
    #[arg(long, value_name = "FILE", default_value = "model.toml")]
    out: PathBuf,
    /// A log whose columns are matched with what the vehicle needs
    #[arg(long, value_name = "RUN.csv")]
    from: Option<PathBuf>,
    /// A file of poses, where they are not in the log
    #[arg(long, value_name = "POSE.csv", requires = "from")]
    truth: Option<PathBuf>,
    /// A robot's description, whose wheels give radius, track and wheelbase
    #[arg(long, value_name = "ROBOT.urdf")]
    urdf: Option<PathBuf>,
    /// The vehicle in front of trailers [default: car]
    #[arg(long, value_name = "VEHICLE")]
    tractor: Option<String>,
    /// Number of trailers of an n-trailer [default: 1]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u8).range(1..=100))]
    trailers: Option<u8>,
    /// Replace an older file
    #[arg(long)]
    force: bool,
    #[command(flatten)]
    own: UserVehicles,
}

/// Rows of a log that are looked at.
const LOOKED_AT: usize = 2000;

/// Carries out the command.
pub fn run(arguments: &Arguments, quiet: bool) -> Result<()> {
    let read = |path: &PathBuf| {
        let (header, rows) = read_beginning(path, LOOKED_AT)?;
        Ok(((path.display().to_string(), header), rows))
    };
    let (log, rows) = arguments.from.as_ref().map(read).transpose()?.unzip();
    let (truth, truth_rows) = arguments.truth.as_ref().map(read).transpose()?.unzip();
    let vehicles = arguments.own.all()?;
    let is_own = |id: &Option<String>| vehicles.iter().any(|v| Some(&v.id) == id.as_ref() && v.origin.is_some());
    let named = is_own(&Some(arguments.vehicle.clone())) || is_own(&arguments.tractor);
    let own = arguments.own.file().filter(|_| named).map(|file| from_folder_of(&arguments.out, file));
    let starter = Starter::on(
        &vehicles,
        &Wanted {
            vehicle: arguments.vehicle.clone(),
            tractor: arguments.tractor.clone(),
            trailers: arguments.trailers.map(usize::from),
            log,
            truth,
            rows: rows.unwrap_or_default(),
            truth_rows: truth_rows.unwrap_or_default(),
            measures: arguments.urdf.as_ref().map(Measures::read).transpose()?,
            own,
        },
    )?;
    // What is written must be readable, whatever the columns are called.
    ModelFile::parse(&starter.text, &arguments.out, &model::known_on(&vehicles, effects::all()))?;
    if !arguments.force && arguments.out.symlink_metadata().is_ok_and(|m| m.is_file() || m.is_symlink()) {
        return Err(Error::input("is there already")
            .at_file(&arguments.out)
            .help("choose another --out, or give --force"));
    }
    write_whole(&arguments.out, starter.text.as_bytes())?;
    if !quiet {
        print(&screen(&starter, arguments))?;
    }
    Ok(())
}

/// The path of a file as a model file names it that lies elsewhere.
fn from_folder_of(out: &Path, file: &Path) -> String {
    let folder = |path: &Path| path.parent().map(Path::to_path_buf).unwrap_or_default();
    let found = match (folder(out) == folder(file), file.file_name(), std::path::absolute(file)) {
        (true, Some(name), _) => name.into(),
        (_, _, Ok(whole)) if folder(out) != Path::new("") => whole,
        _ => file.to_path_buf(),
    };
    found.display().to_string()
}

fn screen(starter: &Starter, arguments: &Arguments) -> String {
    let state = match starter.missing.as_slice() {
        [] => "it is valid as it stands".into(),
        missing => format!("not complete: name {}", missing.join(", ")),
    };
    let mut text = format!("{} is written; {state}.\n", arguments.out.display());
    if !starter.placeholders.is_empty() {
        text += &format!("  put your values for: {}\n", starter.placeholders.join(", "));
    }
    for (role, column) in &starter.found {
        text += &match column.starts_with(['{', '[']) {
            true => format!("  {role:<18} {column}\n"),
            false => format!("  {role:<18} column \"{column}\"\n"),
        };
    }
    if !starter.missing.is_empty() {
        text += &format!("  name under [columns]: {}\n", starter.missing.join(", "));
    }
    let run = arguments.from.as_ref().map_or("RUN.csv".into(), |p| p.display().to_string());
    let truth = arguments.truth.as_ref().map_or(String::new(), |p| format!(" --truth {}", p.display()));
    text + &format!("next: creepage check {run}{truth} --model {}\n", arguments.out.display())
}
