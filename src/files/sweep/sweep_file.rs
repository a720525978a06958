//! The sweep file (TOML): one model, its inputs, and many cases by grid and sample.

use super::axis::{Axis, Sampled, read_grid, read_sampled};
use crate::error::Result;
use crate::files::toml::formula_text::FormulaText;
use crate::files::toml::location::Spot;
use crate::files::toml::spanned_table::{Section, Source, Value};
use crate::files::toml::suggestions;
use crate::files::toml::text::read_hashed;
use crate::formula::Symbol;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// The most rows of one case: they are held in memory until the case is written.
const MAX_ROWS: f64 = 1e6;
/// The most cases: the number of each is written as a double, which holds it exactly.
const MAX_CASES: usize = 1 << 50;

/// The file of a sweep, read; its names are not yet held against the model.
#[derive(Clone, Debug)]
pub struct SweepFile {
    /// Where it was read.
    pub path: PathBuf,
    /// SHA-256 of its bytes, hexadecimal.
    pub sha256: String,
    /// The model.
    pub model: PathBuf,
    /// The user's own vehicles; those that the model file names are known besides.
    pub vehicles: Option<PathBuf>,
    /// The user's own effects.
    pub effects: Option<PathBuf>,
    /// When the motion begins, s.
    pub start: Option<f64>,
    /// How long it lasts, s.
    pub duration: Option<f64>,
    /// The error asked for.
    pub error: f64,
    /// Which rows are written.
    pub rows: SweepRows,
    /// A log whose channels the formulas may use.
    pub log: Option<PathBuf>,
    /// What drives the model, by role.
    pub inputs: Vec<SweepInput>,
    /// Line and column of `[inputs]`; of the beginning without it.
    pub inputs_at: (usize, usize),
    /// Line and column of `every`; of the beginning without it.
    pub every_at: (usize, usize),
    /// Line and column of `duration`; of `start` or the beginning without it.
    pub duration_at: (usize, usize),
    /// Times at which a formula has a kink.
    pub knots: Vec<f64>,
    /// Constants of the formulas.
    pub constants: BTreeMap<String, (Spot, f64)>,
    /// Quantities that take every combination of their values; the last varies fastest.
    pub grid: Vec<Axis>,
    /// Quantities that are drawn, as often as `count` says for each point of the grid.
    pub sampled: Vec<Sampled>,
    /// Draws for each point of the grid.
    pub count: usize,
    /// The seed of the draws.
    pub seed: u64,
    /// How many cases there are.
    pub cases: usize,
}

/// Rows that a sweep writes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SweepRows {
    /// The last of each case.
    End,
    /// One every so many seconds, and the last.
    Every(f64),
}

/// An input and its formula.
#[derive(Clone, Debug)]
pub struct SweepInput {
    /// Its role.
    pub role: String,
    /// Where it is named.
    pub spot: Spot,
    /// Its formula in `t`.
    pub formula: FormulaText,
}

const KEYS: [&str; 12] = [
    "model",
    "vehicles",
    "effects",
    "start",
    "duration",
    "error",
    "rows",
    "every",
    "inputs",
    "constants",
    "grid",
    "sample",
];

impl SweepFile {
    /// Reads a file; paths in it are relative to its folder.
    ///
    /// # Errors
    /// With file, line and column when it is not of this form.
    pub fn read(path: impl AsRef<Path>) -> Result<Self> {
        let path = path.as_ref();
        let (text, sha256) = read_hashed(path)?;
        let source = Source { path, text: &text };
        let document = source.parse_as(
            "a sweep holds model = \"model.toml\", a duration, formulas under [inputs], and what varies under [grid] or \
             [sample.of]",
        )?;
        let top = Section::top(source, &document);
        top.only(&KEYS)?;
        let beside = |value: &Value| named(value, path.parent().unwrap_or(Path::new("")));
        let optional = |value: Option<Value>| value.as_ref().map(beside).transpose();
        let inputs = top.section("inputs")?;
        let input = |key: &str| inputs.as_ref().and_then(|s| s.get(key));
        let grid = top.section("grid")?.map_or(Ok(vec![]), |s| read_grid(&s))?;
        let (sampled, count, seed) = read_sample(&top)?;
        let cases = grid.iter().try_fold(count, |n, axis| n.checked_mul(axis.values.count()));
        let cases = cases.filter(|n| *n <= MAX_CASES);
        let cases = cases.ok_or_else(|| top.error("there are more than 10^15 cases").help("give fewer values"))?;
        if let Some(twice) = sampled.iter().find(|s| grid.iter().any(|a| a.name == s.name)) {
            let error = twice.spot.error(format!("{} stands under [grid] and [sample.of]", twice.name));
            return Err(error.help("vary it in one of them"));
        }
        Ok(Self {
            path: path.into(),
            sha256,
            model: beside(&top.need("model", "model = \"model.toml\"")?)?,
            vehicles: optional(top.get("vehicles"))?,
            effects: optional(top.get("effects"))?,
            start: top.get("start").map(|v| v.number()).transpose()?,
            duration: top.get("duration").map(|v| v.positive()).transpose()?,
            error: top.get("error").map_or(Ok(1e-10), |v| read_error(&v))?,
            rows: read_rows(&top)?,
            log: optional(input("log"))?,
            knots: input("knots").map_or(Ok(vec![]), |v| read_knots(&v))?,
            inputs: inputs.as_ref().map_or(Ok(vec![]), read_inputs)?,
            inputs_at: inputs.as_ref().map_or((1, 1), Section::place_of),
            every_at: place(top.get("every")),
            duration_at: place(top.get("duration").or_else(|| top.get("start"))),
            constants: top.section("constants")?.map_or(Ok(BTreeMap::new()), |s| read_constants(&s))?,
            grid,
            sampled,
            count,
            seed,
            cases,
        })
    }
}

fn place(value: Option<Value>) -> (usize, usize) {
    value.map_or((1, 1), |v| v.source.line_and_column(v.key_at))
}

/// A file that the sweep names.
fn named(value: &Value, folder: &Path) -> Result<PathBuf> {
    let found = folder.join(value.text()?);
    match found.exists() {
        true => Ok(found),
        false => Err(value
            .error(format!("no file is at \"{}\"", suggestions::shown(&found.display().to_string())))
            .help("give its path from the folder of this file")),
    }
}

fn read_error(value: &Value) -> Result<f64> {
    match value.positive()? {
        error if (1e-13..=1.0).contains(&error) => Ok(error),
        error => Err(value.error(format!("error = {error:?} is out of range")).help("it must lie within 1e-13 and 1")),
    }
}

fn read_rows(top: &Section) -> Result<SweepRows> {
    let every = top.get("every").map(|v| v.positive()).transpose()?;
    if let Some(value) = top.get("rows") {
        let advice = "write rows = \"end\", or every = 0.1 for a row each 0.1 s";
        return match (value.text()?, every) {
            ("end", None) => Ok(SweepRows::End),
            ("end", Some(_)) => Err(value.error("rows = \"end\" and every contradict each other").help(advice)),
            (other, _) => Err(value.error(format!("unknown rows \"{other}\"")).help(advice)),
        };
    }
    Ok(every.map_or(SweepRows::End, SweepRows::Every))
}

fn read_knots(value: &Value) -> Result<Vec<f64>> {
    let knots: Vec<f64> = value.list("knots = [3.0]")?.iter().map(Value::number).collect::<Result<_>>()?;
    match knots.windows(2).all(|w| w[0] < w[1]) {
        true => Ok(knots),
        false => Err(value.error("knots have to rise").help("write them in the order of time, each once")),
    }
}

fn read_inputs(section: &Section) -> Result<Vec<SweepInput>> {
    let formulas = section.entries().into_iter().filter(|v| v.name != "log" && v.name != "knots");
    let input = |v: Value| {
        let formula = FormulaText::read(&v)?;
        Ok(SweepInput { role: v.name.clone(), spot: Spot::at(v.source, v.key_at), formula })
    };
    formulas.map(input).collect()
}

fn read_constants(section: &Section) -> Result<BTreeMap<String, (Spot, f64)>> {
    let mut found = BTreeMap::new();
    for value in section.entries() {
        if !Symbol::new(&value.name).is_well_formed() {
            let error =
                value.key_error(format!("{:?} cannot be the name of a constant", suggestions::shown(&value.name)));
            return Err(error.help("begin with a letter, go on with letters, digits and _"));
        }
        if value.name == "t" {
            return Err(value.key_error("t is the time and cannot be a constant").help("give it another name"));
        }
        found.insert(value.name.clone(), (Spot::at(value.source, value.key_at), value.number()?));
    }
    Ok(found)
}

fn read_sample(top: &Section) -> Result<(Vec<Sampled>, usize, u64)> {
    let Some(section) = top.section("sample")? else { return Ok((vec![], 1, 0)) };
    section.only(&["count", "seed", "of"])?;
    let count = section.need("count", "count = 1000 under [sample]")?.count()?;
    let seed = section.get("seed").map_or(Ok(0), |v| match v.number()? {
        n if n >= 0.0 && n.fract() == 0.0 && n <= 2f64.powi(53) => Ok(n as u64),
        _ => Err(v.error("seed must be a whole number from 0").help("write seed = 1")),
    })?;
    let of = section.need("of", "[sample.of] and below it lines like e = { uniform = [0.0, 0.1] }")?;
    Ok((read_sampled(&of.section("[sample.of]".into())?)?, count, seed))
}

impl SweepRows {
    /// The times of the rows, from `start` to `end`.
    ///
    /// # Errors
    /// When there are more than a million, or so close that rounding makes two of them one.
    pub fn times(self, start: f64, end: f64) -> Result<Vec<f64>> {
        let SweepRows::Every(every) = self else { return Ok(vec![end]) };
        let whole = ((end - start) / every * (1.0 - 1e-12)).ceil();
        if whole >= MAX_ROWS {
            let error = crate::Error::input(format!("every = {every:?} gives more than a million rows a case"));
            return Err(error.help("write a larger one"));
        }
        let inner = (0..whole as usize).map(|i| start + every * i as f64);
        let times: Vec<f64> = inner.chain([end]).collect();
        match times.windows(2).all(|w| w[0] < w[1]) {
            true => Ok(times),
            false => Err(crate::Error::input(format!("every = {every:?} is lost in rounding beside times of {end:?}"))
                .help("write a larger one, or count the time from another start")),
        }
    }
}
