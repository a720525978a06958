//! What any bytes must do to every file format and every command: be read, or end in one message.
//!
//! Used by `tests/fuzzed.rs` on every commit and by the targets of `fuzz/` for as long as one likes. A new file format or
//! command is one more row of [`TARGETS`], one function that returns what the program said, and one file of
//! `fuzz/fuzz_targets`.

#[allow(dead_code)]
#[path = "bad_vehicles.rs"]
mod bad_vehicles;

use creepage::claims::{self, ledger};
use creepage::describe::{
    Description, effects_json, effects_text, json, latex, text, vehicle_effects_text, vehicles_json, vehicles_text,
};
use creepage::discrepancy::discover::discover;
use creepage::discrepancy::rendering::html::{gap_svg, html};
use creepage::discrepancy::request::Request;
use creepage::dynamics::{self, Dynamics, simulate_file};
use creepage::files::{EffectsFile, Initial, Inputs, Known, ModelFile, Run, read_claims};
use creepage::formula::Expr;
use creepage::model::Model;
use creepage::motion::{Integrator, Signals, Table, simulate_model};
use creepage::progress::unheard;
use creepage::sweep::{Shard, Sweep};
use creepage::{Error, Result, effects, extensions, vehicles};
use std::path::{Path, PathBuf};
use std::sync::{LazyLock, OnceLock};

/// A way into the program.
pub struct Target {
    /// Its name, that of the file in `fuzz/fuzz_targets` too.
    pub name: &'static str,
    /// Reads the files of a folder; returns whether they were good.
    run: fn(&Path) -> Result<()>,
    /// The names of the files the bytes are cut into at [`CUT`].
    files: &'static [&'static str],
    /// Longer inputs are cut off, to bound the time of one.
    pub longest: usize,
    /// Inputs to begin with.
    pub seeds: fn() -> Vec<Vec<u8>>,
}

/// What parts the files of an input.
const CUT: &[u8] = b"\n=====\n";

/// Every way in.
pub const TARGETS: &[Target] = &[
    Target { name: "formula", run: formula, files: &["formula.txt"], longest: 4096, seeds: formulas },
    Target { name: "model", run: model_file, files: &["model.toml"], longest: 8192, seeds: models },
    Target { name: "effects", run: effects_file, files: &["effects.toml"], longest: 8192, seeds: effects_files },
    Target { name: "claims", run: claims_file, files: &["claims.toml"], longest: 8192, seeds: claims_files },
    Target { name: "run", run: run_file, files: &["run.csv", "model.toml"], longest: 16384, seeds: logged },
    Target { name: "inputs", run: inputs_file, files: &["run.csv", "model.toml"], longest: 16384, seeds: logged },
    Target { name: "describe", run: describe, files: &["model.toml"], longest: 2048, seeds: models },
    Target { name: "simulate", run: simulate, files: &["run.csv", "model.toml"], longest: 4096, seeds: logged },
    Target { name: "discover", run: discovered, files: &["run.csv", "model.toml"], longest: 4096, seeds: logged },
    Target { name: "verify", run: verify, files: &["claims.toml"], longest: 2048, seeds: claims_files },
    Target { name: "list_effects", run: list_effects, files: &["effects.toml"], longest: 4096, seeds: effects_files },
    Target { name: "vehicles", run: own_vehicles, files: &["mine.toml"], longest: 8192, seeds: vehicles_files },
    Target { name: "relatives", run: relatives, files: &["mine.toml"], longest: 8192, seeds: vehicles_files },
    Target { name: "own_model", run: own_model, files: &["mine.toml", "model.toml"], longest: 8192, seeds: own_models },
    Target { name: "dynamics", run: forced, files: &["run.csv", "model.toml"], longest: 4096, seeds: driven },
    Target { name: "sweep", run: swept, files: &["sweep.toml", "model.toml", "run.csv"], longest: 4096, seeds: sweeps },
];

impl Target {
    /// The target of that name.
    pub fn named(name: &str) -> &'static Target {
        TARGETS.iter().find(|t| t.name == name).unwrap()
    }

    /// Puts bytes to it; panics where they do what no input may do.
    pub fn meets(&self, bytes: &[u8]) -> Result<()> {
        let dir = folder();
        let mut rest = &bytes[..bytes.len().min(self.longest)];
        for (i, name) in self.files.iter().enumerate() {
            let last = i + 1 == self.files.len();
            let end = rest.windows(CUT.len()).position(|w| w == CUT).filter(|_| !last);
            std::fs::write(dir.join(name), &rest[..end.unwrap_or(rest.len())]).unwrap();
            rest = end.map_or(&[], |end| &rest[end + CUT.len()..]);
        }
        let met = (self.run)(dir);
        if let Err(error) = &met {
            self.check(error);
        }
        met
    }

    /// One message, for a person, at a place.
    fn check(&self, error: &Error) {
        let said = error.to_string();
        assert!(!error.message().trim().is_empty(), "says nothing: {said}");
        // Only a motion can fail although every file was good.
        let moves = ["simulate", "dynamics", "sweep"].contains(&self.name);
        assert!(error.exit_code() == 2 || moves, "exit code {}: {said}", error.exit_code());
        let file = self.files.iter().find(|name| said.contains(*name));
        assert!(self.name == "formula" || file.is_some() || error.exit_code() == 1, "no file is named: {said}");
        let whole = [
            "is empty",
            "is a binary file",
            "which this build",
            "is UTF-16",
            "is larger than",
            "usable rows",
            "the constraints of",
        ];
        let placed = error.place().is_some() || whole.iter().any(|w| error.message().contains(w));
        assert!(placed || error.exit_code() == 1, "no line is named: {said}");
        let controls = said.chars().filter(|c| c.is_control() && *c != '\n').count();
        assert_eq!(controls, 0, "control characters are sent to the terminal: {said:?}");
    }
}

/// A folder of this process and thread, in memory where there is one.
fn folder() -> &'static Path {
    thread_local! {
        static FOLDER: OnceLock<&'static Path> = const { OnceLock::new() };
    }
    let make = || {
        let top = Path::new("/dev/shm");
        let top = if top.is_dir() { top.to_path_buf() } else { std::env::temp_dir() };
        let dir = top.join(format!("creepage-fuzz-{}-{:?}", std::process::id(), std::thread::current().id()));
        std::fs::create_dir_all(&dir).unwrap();
        &*Box::leak(dir.into_boxed_path())
    };
    FOLDER.with(|f| *f.get_or_init(make))
}

/// Removes the folder of this thread.
pub fn tidy() {
    drop(std::fs::remove_dir_all(folder()));
}

fn formula(dir: &Path) -> Result<()> {
    let bytes = std::fs::read(dir.join("formula.txt")).unwrap();
    let Ok(text) = std::str::from_utf8(&bytes) else { return Ok(()) };
    let e = Expr::parse(text)?;
    let printed = e.to_string();
    let again = Expr::parse(&printed).unwrap_or_else(|x| panic!("{text:?} is printed as {printed:?}: {x}"));
    assert_eq!(again.to_string(), printed, "{text:?}");
    Ok(())
}

/// What model files may name, read once.
fn known() -> &'static Known {
    static KNOWN: LazyLock<Known> = LazyLock::new(|| dynamics::known(effects::all()));
    &KNOWN
}

fn model_file(dir: &Path) -> Result<()> {
    let file = ModelFile::read(dir.join("model.toml"), known())?;
    let again = ModelFile::parse(&file.patched(&file.effects), "model.toml", known()).unwrap();
    assert!(again.effects == file.effects && again.dynamics == file.dynamics);
    Ok(())
}

fn effects_file(dir: &Path) -> Result<()> {
    EffectsFile::read(&dir.join("effects.toml")).map(drop)
}

fn claims_file(dir: &Path) -> Result<()> {
    let vehicles: Vec<&str> = vehicles::all().iter().map(|v| v.id.as_str()).collect();
    read_claims(&dir.join("claims.toml"), &vehicles).map(drop)
}

fn read_model(dir: &Path) -> Result<ModelFile> {
    let file = ModelFile::read(dir.join("model.toml"), known())?;
    Model::check_motion(&file)?;
    Ok(file)
}

fn run_file(dir: &Path) -> Result<()> {
    let run = Run::read(dir.join("run.csv"), &read_model(dir)?)?;
    assert!(run.time.windows(2).all(|t| t[0] < t[1]) && run.time.len() >= 2);
    let poses = [&run.time, &run.x, &run.y].into_iter().chain(&run.heading).chain(&run.trailer_headings);
    // Rows without a pose have inputs all the same.
    let rows = run.apart.as_ref().map_or(&run.time, |a| &a.time);
    let whole = |c: &Vec<f64>, rows: usize| c.len() == rows && c.iter().all(|v| v.is_finite());
    assert!(poses.into_iter().all(|c| whole(c, run.time.len())) && run.inputs.iter().all(|c| whole(c, rows.len())));
    Ok(())
}

fn inputs_file(dir: &Path) -> Result<()> {
    let inputs = Inputs::read(dir.join("run.csv"), &read_model(dir)?)?;
    assert!(inputs.time.windows(2).all(|t| t[0] < t[1]) && inputs.time.len() >= 2);
    assert!(inputs.columns.iter().all(|c| c.len() == inputs.time.len() && c.iter().all(|v| v.is_finite())));
    Ok(())
}

fn describe(dir: &Path) -> Result<()> {
    described(&ModelFile::read(dir.join("model.toml"), known())?)
}

fn described(file: &ModelFile) -> Result<()> {
    let roles: Vec<String> = file.columns.inputs.iter().map(|i| i.role.clone()).collect();
    let d = Description::of(&Model::from_file(file, effects::all(), &roles)?)?;
    assert!(!text(&d).is_empty() && !latex(&d).is_empty() && json(&d).is_object());
    if file.dynamics.is_some() {
        Dynamics::from_file(file)?;
    }
    Ok(())
}

fn simulate(dir: &Path) -> Result<()> {
    let file = read_model(dir)?;
    let inputs = Inputs::read(dir.join("run.csv"), &file)?;
    let model = Model::from_file(&file, effects::all(), &inputs.roles)?;
    let (signals, start) = begun(&file, &inputs);
    let start: Vec<f64> = [start.x, start.y, start.heading].into_iter().chain(start.trailer_headings).collect();
    finite(&simulate_model(&model, &signals, &inputs.time, &start, &brief())?);
    Ok(())
}

/// The inputs as signals, and the pose to begin with.
fn begun(file: &ModelFile, inputs: &Inputs) -> (Signals, Initial) {
    let signals = Signals::new(&inputs.time, &inputs.columns, file.input_timing.into());
    let start = file.initial.clone().or(inputs.pose.clone());
    let origin = || Initial { trailer_headings: vec![0.0; file.trailers()], ..Initial::default() };
    (signals, start.unwrap_or_else(origin))
}

/// Steps are what a simulation spends; that they end it is tested with the command.
fn brief() -> Integrator {
    Integrator { max_steps: 2_000, ..Integrator::default() }
}

fn finite(table: &Table) {
    assert!(table.columns.iter().flatten().all(|v| v.is_finite()));
}

fn forced(dir: &Path) -> Result<()> {
    let file = ModelFile::read(dir.join("model.toml"), known())?;
    if file.dynamics.is_none() {
        return Ok(());
    }
    Dynamics::from_file(&file)?;
    let inputs = Inputs::read(dir.join("run.csv"), &file)?;
    let (signals, pose) = begun(&file, &inputs);
    finite(&simulate_file(&file, &signals, &inputs.time, &pose, &brief())?);
    Ok(())
}

/// A small part of the table.
fn swept(dir: &Path) -> Result<()> {
    let sweep = Sweep::read(dir.join("sweep.toml"))?;
    let out = dir.join("sweep.csv");
    let part: Shard = format!("1/{}", sweep.cases().div_ceil(40)).parse().unwrap();
    let written = sweep.write(part, &out, &unheard);
    let rows = std::fs::read_to_string(&out);
    drop(std::fs::remove_file(&out));
    let (cases, rows) = (written?.cases, rows.unwrap());
    assert!(rows.lines().count() > cases && !rows.contains("NaN") && !rows.contains("inf"));
    Ok(())
}

fn own_vehicles(dir: &Path) -> Result<()> {
    let mut own = extensions::vehicles_with_own(dir.join("mine.toml"))?;
    own.retain(|v| v.origin.is_some());
    assert!(!vehicles_text(&own)?.is_empty() && vehicles_json(&own)?.is_object());
    Ok(())
}

fn own_model(dir: &Path) -> Result<()> {
    let all = extensions::vehicles_with_own(dir.join("mine.toml"))?;
    described(&ModelFile::read(dir.join("model.toml"), &dynamics::known_on(&all, effects::all()))?)
}

/// The effects of a vehicle, and which of them are one.
fn relatives(dir: &Path) -> Result<()> {
    let mut own = extensions::vehicles_with_own(dir.join("mine.toml"))?;
    own.retain(|v| v.origin.is_some());
    let tell = |id: &str| vehicle_effects_text(id, &own, effects::all());
    assert!(!tell(&own[0].id)?.is_empty());
    Ok(())
}

fn discovered(dir: &Path) -> Result<()> {
    let file = read_model(dir)?;
    let runs = [Run::read(dir.join("run.csv"), &file)?];
    let request =
        Request { file: &file, runs: &runs, held_out: &[], library: effects::all(), horizons: &[0.1], seed: 0 };
    let found = discover(&request, &unheard)?;
    let page = html(&found.report, &found.pictures);
    assert!(page.ends_with("</html>\n") && gap_svg(&found.report, &found.pictures).ends_with("</svg>\n"));
    // A number that is none would stand in a formula; rows are dropped for a "blank or NaN cell".
    let text = serde_json::to_string(&found.report).unwrap();
    assert!(!text.replace("blank or NaN cell", "").contains("NaN"));
    ModelFile::parse(&found.patched(&file), "model.toml", known()).unwrap();
    Ok(())
}

fn verify(dir: &Path) -> Result<()> {
    let claims = claims::read(&dir.join("claims.toml"), creepage::vehicles::all())?;
    let made = claims::verify(&claims, &claims::Options { cases: 5, seed: 0 }, &unheard)?;
    assert!(!ledger::text(&made).is_empty() && ledger::json(&made).is_object());
    Ok(())
}

fn list_effects(dir: &Path) -> Result<()> {
    let library = extensions::with_own(dir.join("effects.toml"))?;
    assert!(
        !effects_text(creepage::vehicles::all(), &library)?.is_empty()
            && effects_json(creepage::vehicles::all(), &library)?.is_object()
    );
    Ok(())
}

/// A path of the repository.
fn here(path: &str) -> PathBuf {
    let top = Path::new(env!("CARGO_MANIFEST_DIR"));
    let top = if top.ends_with("fuzz") { top.parent().unwrap() } else { top };
    top.join(path)
}

fn file(path: &str) -> Vec<u8> {
    std::fs::read(here(path)).unwrap()
}

const RUNS: [(&str, &str); 3] = [("cornering", "eights"), ("steering", "meander"), ("track", "rosette")];

fn models() -> Vec<Vec<u8>> {
    let mut seeds: Vec<_> = RUNS.iter().map(|(d, _)| file(&format!("examples/runs/{d}/model.toml"))).collect();
    seeds.extend([TRAILERS, MANY, HOPPER].map(|t| t.as_bytes().to_vec()));
    seeds.extend(["car", "sleigh"].map(|m| file(&format!("examples/dynamics/{m}.toml"))));
    seeds
}

/// A momentum instead of wheels.
const HOPPER: &str = "vehicle = \"hopper\"\n[parameters]\nbody_inertia = 1\nleg_mass = 1.0\nleg_offset = 0.5\n\
[columns]\nleg_length = \"l\"\n[initial]\npsi = 0.3\n";

/// Forces on everything that `[dynamics]` may speak of.
const TRAIN: &str = "vehicle = \"n-trailer\"\ntractor = \"differential-drive-castor\"\n[parameters]\nwheel_radius = 0.2\n\
track_width = 0.6\ncastor_offset = -0.4\ncastor_trail = 0.05\ncastor_wheel_radius = 0.05\ntrailer_lengths = [1.0]\n[dynamics]\nmass = 30.0\n\
inertia = 3.0\nwheel_inertia = { right-wheel = 0.02, left-wheel = 0.03 }\ncastor_inertia = 0.01\ntrailer_masses = [9.0]\n\
trailer_inertias = [1.0]\ntrailer_mass_offsets = [0.2]\ninputs = [\"force\", \"yaw_torque\"]\n[dynamics.friction]\n\
direction = { law = \"elastic\", stiffness = 2e3, relaxation_length = 0.1 }\n[initial]\nx = 0\ny = 0\nheading = 0\n\
speed = 1.0\nyaw_rate = 0.1\ntrailer_headings = [0.1]\n";

const TRAILERS: &str = "vehicle = \"n-trailer\"\ntractor = \"car\"\n[parameters]\nwheel_radius = 0.3\nwheelbase = 2.5\n\
trailer_lengths = [3.0, 2]\nhitch_offsets = [0.5, 0]\n[columns]\ntrailer_headings = [\"a\", \"b\"]\n[initial]\nx = 0\n\
y = 1\nheading = -2\ntrailer_headings = [0.1, 0.2]\n[noise]\nposition = 0.01\nheading = 0.02\n\
[[effects]]\nid = \"trailer-traverse-creep\"\ntrailer = 2\ne_tc = 0.01\n";

const MANY: &str = "vehicle = \"unicycle\"\ninput_timing = \"interval-mean\"\n[parameters]\nwheel_radius = 0.1\n\
[sensor]\nlever_arm = [0.1, -0.2]\nheading_offset = 0.3\n[[effects]]\nid = \"rotation-creep\"\ne_rc = 0.02\n\
[[effects]]\nid = \"input-delay\"\ndelay = 0.1\n[[effects]]\nid = \"traction-creep\"\nmass_over_bR = 0.2\n\
[[effects]]\nid = \"relaxation-length\"\nlength = 0.5\ne_tc = 0.1\n[[effects]]\nid = \"side-slope\"\nrate = 0.1\n\
direction = 1.0\n";

fn effects_files() -> Vec<Vec<u8>> {
    vec![file("examples/effects/my_effects.toml")]
}

fn claims_files() -> Vec<Vec<u8>> {
    let texts = [
        "[[claim]]\nid = \"course\"\nsays = \"traverse creep turns the course\"\nstatus = \"proved\"\n\
         equations = [\"cot(phi + atan(e)) = (cot(phi) - e)/(1 + e*cot(phi))\"]\n",
        "[[claim]]\nid = \"yaw\"\nstatus = \"corrected\"\nvehicle = \"car\"\ntrailers = 2\nunder = \"no creep\"\n\
         equations = [\"phi' = v_l/L*tan(delta)\", \"(a + b)^2 = a^2 + 2*a*b + b^2\"]\nprinted = [\"phi' = v_l/L\"]\n\
         [[claim]]\nid = \"two\"\nstatus = \"open\"\nequations = [\"sin(2*x) = 2*sin(x)*cos(x)\"]\n",
    ];
    texts.map(|t| t.as_bytes().to_vec()).to_vec()
}

/// Logs of a few rows, each with its model.
fn logged() -> Vec<Vec<u8>> {
    let rows =
        |bytes: Vec<u8>| -> Vec<u8> { bytes.split_inclusive(|b| *b == b'\n').take(24).flatten().copied().collect() };
    let pair = |(d, r): &(&str, &str)| {
        let (log, model) =
            (rows(file(&format!("examples/runs/{d}/{r}.csv"))), file(&format!("examples/runs/{d}/model.toml")));
        [&log, CUT, &model].concat()
    };
    let mut seeds: Vec<Vec<u8>> = RUNS.iter().map(pair).collect();
    let trailers = "time,x,y,heading,wheel_rate,steering_angle,a,b\n0,0,0,0,1,0.1,0,0\n1,1,0,0,1,0.1,0,0\n\
                    2,2,0.1,0.1,1,0.2,0,0\n3,3,0.2,0.1,1,0,0,0\n4,4,0.2,0.1,1,0,0,0\n";
    seeds.push([trailers.as_bytes(), CUT, TRAILERS.as_bytes()].concat());
    let many = "time,x,y,heading,speed,yaw_rate\n0,0,0,0,1,0.1\n1,1,0,0,1,0.1\n2,2,0.1,0.1,1,0.2\n3,3,0.2,0.1,1,0\n";
    seeds.push([many.as_bytes(), CUT, MANY.as_bytes()].concat());
    seeds
}

fn formulas() -> Vec<Vec<u8>> {
    let texts = [
        "cos(delta)*L*phi' - sin(phi + delta)*x' + cos(phi + delta)*y'",
        "-(cot(phi) - e)/(1 + e*cot(phi))^-3 + 1.5e-3*x",
        "sqrt(abs(a.b)) + tanh(exp(ln(u)))*sign(-v)",
        "2^64/3 - 7/0.25*atan(-x)",
    ];
    texts.map(|t| t.as_bytes().to_vec()).to_vec()
}

/// Logs of forces, each with its model.
fn driven() -> Vec<Vec<u8>> {
    let first = |name: &str, rows: usize| -> Vec<u8> {
        let log = file(&format!("examples/dynamics/{name}.csv"));
        log.split_inclusive(|b| *b == b'\n').take(rows).flatten().copied().collect()
    };
    let forces = b"time,force,yaw_torque\n0,1,0.1\n0.1,2,0.1\n0.3,1,-0.2\n".to_vec();
    let pairs = [
        (first("drive", 8), file("examples/dynamics/car.toml")),
        (first("times", 8), file("examples/dynamics/sleigh.toml")),
        (forces, TRAIN.as_bytes().to_vec()),
    ];
    pairs.map(|(log, model)| [&log, CUT, &model].concat()).to_vec()
}

fn vehicles_files() -> Vec<Vec<u8>> {
    let texts = [bad_vehicles::GOOD, bad_vehicles::ROPE, FLIER].map(|t| t.as_bytes().to_vec());
    texts.into_iter().chain([file("examples/bus/bus.toml")]).collect()
}

/// A momentum that is derived from an energy, and a wheel that is logged under another name.
const FLIER: &str = "[[vehicle]]\nid = \"flier\"\ntitle = \"two bodies in flight\"\nheading = \"psi\"\n\
parameters.ratio = { unit = \"1\", meaning = \"of the moments of inertia\" }\n\
inputs.turn = { unit = \"rad/s\", meaning = \"rate of the joint\" }\n[vehicle.define]\n\
k = { formula = \"ratio\", unit = \"1\", meaning = \"ratio\" }\n\
\"theta'\" = { formula = \"turn\", unit = \"rad/s\", meaning = \"rate of the joint\" }\n\
[[vehicle.coordinates]]\nname = \"psi\"\nunit = \"rad\"\nmeaning = \"of the first\"\n\
[[vehicle.coordinates]]\nname = \"theta\"\nunit = \"rad\"\nmeaning = \"of the joint\"\n\
[[vehicle.constraints]]\nname = \"angular momentum\"\ntype = \"momentum\"\n\
energy = \"psi'^2/2 + k*(psi' + theta')^2/2\"\ngenerator = { psi = \"1\" }\ncreep = \"e_sc\"\n";

/// Vehicles of a file, each with a model of it.
fn own_models() -> Vec<Vec<u8>> {
    let cart = "vehicle = \"my-cart\"\n[parameters]\nwheel_radius = 0.1\nwheelbase = 0.5\n[[effects]]\n\
                id = \"rotation-creep\"\ne_rc = 0.02\n";
    let flier = "vehicle = \"flier\"\n[parameters]\nratio = 0.5\n";
    let pairs = [
        (bad_vehicles::GOOD.as_bytes().to_vec(), cart.as_bytes().to_vec()),
        (FLIER.as_bytes().to_vec(), flier.as_bytes().to_vec()),
        (file("examples/bus/bus.toml"), file("examples/bus/model.toml")),
    ];
    pairs.map(|(own, model)| [&own, CUT, &model].concat()).to_vec()
}

/// Sweeps with a model, and with a log.
fn sweeps() -> Vec<Vec<u8>> {
    let wheels = String::from_utf8(file("examples/sweeps/wheels.toml")).unwrap();
    let wheels = wheels.replace("wheel.toml", "model.toml");
    let logged = "model = \"model.toml\"\nstart = 0\nduration = 2\nerror = 1e-6\nrows = \"end\"\n[inputs]\n\
                  log = \"run.csv\"\nknots = [0.5, 1.0]\nwheel_rate = \"(q + k)*log.wheel_rate\"\n[constants]\nq = 1.0\n\
                  [grid]\nk = [0.0, 0.01]\nwheel_radius = { from = 0.09, to = 0.11, count = 3 }\n[sample]\ncount = 3\n\
                  [sample.of]\ninitial.x = { log_uniform = [0.1, 2.0] }\ninitial.heading = { normal = [0, 0.1] }\n";
    let model = "vehicle = \"unicycle\"\n[parameters]\nwheel_radius = 0.1\n";
    let log = "time,wheel_rate,yaw_rate\n0,1,0.1\n1,2,0.1\n2,1,0.2\n3,1,0\n";
    let first = [wheels.as_bytes(), CUT, &file("examples/sweeps/wheel.toml")].concat();
    let second = [logged.as_bytes(), CUT, model.as_bytes(), CUT, log.as_bytes()].concat();
    vec![first, second]
}
