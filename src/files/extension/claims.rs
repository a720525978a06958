//! Files of a user's own claims (TOML): equations of formulas, each with the status its author gives it.

use crate::error::{Error, Result};
use crate::files::toml::formula_text::too_large;
use crate::files::toml::spanned_table::{Section, Source, Value};
use crate::files::toml::text::read_text;
use crate::formula::Expr;
use std::path::Path;

/// The most trailers of a claim: the normal form of a longer train is out of reach of any machine.
const MAX_TRAILERS: usize = 20;
/// The longest equation, in characters: those of the paper have some hundreds, and a proof takes longer with each.
const MAX_EQUATION_CHARACTERS: usize = 4000;

/// A claim as it stands in a file.
#[derive(Clone, Debug, PartialEq)]
pub struct ClaimEntry {
    /// Its name.
    pub id: String,
    /// What it says in words.
    pub says: String,
    /// The status its author states, by name.
    pub status: String,
    /// What must hold for it to be true.
    pub under: String,
    /// The vehicle whose derived motion the equations may speak of, and its number of trailers.
    pub vehicle: Option<(String, usize)>,
    /// Equations that are true, each as its two sides.
    pub equations: Vec<(String, String)>,
    /// Equations as printed somewhere, which are false.
    pub printed: Vec<(String, String)>,
}

/// Reads the claims of a file; `vehicles` are those an equation may speak of.
///
/// # Errors
/// With file, line and column: a file that cannot be read, a key that is missing or unknown, a formula that is
/// malformed, two claims of one name.
pub fn read_claims(path: &Path, vehicles: &[&str]) -> Result<Vec<ClaimEntry>> {
    let text = read_text(path)?;
    let source = Source { path, text: &text };
    let document = source.parse()?;
    let top = Section::top(source, &document);
    top.only(&["claim"])?;
    let mut entries: Vec<ClaimEntry> = Vec::new();
    for element in top.need("claim", "[[claim]], with double brackets, before each claim")?.list("[[claim]]")? {
        let section = element.section("[[claim]]".into())?;
        let entry = entry(&section, vehicles)?;
        if entries.iter().any(|e| e.id == entry.id) {
            return Err(section.error(format!("two claims are called \"{}\"", entry.id)).help("give one another id"));
        }
        entries.push(entry);
    }
    Ok(entries)
}

fn entry(section: &Section, vehicles: &[&str]) -> Result<ClaimEntry> {
    section.only(&["id", "says", "status", "under", "vehicle", "trailers", "equations", "printed"])?;
    let text = |key: &str| section.get(key).map(|v| v.text().map(str::to_string)).transpose();
    let need = |key: &str, example: &str| section.need(key, example)?.text().map(str::to_string);
    let trailers = section.get("trailers").map(|v| trailers(&v)).transpose()?.unwrap_or(0);
    let vehicle = section.get("vehicle").map(|v| known_vehicle(&v, vehicles)).transpose()?;
    Ok(ClaimEntry {
        id: need("id", "id = \"my-claim\"")?,
        says: text("says")?.unwrap_or_default(),
        status: status(section)?,
        under: text("under")?.unwrap_or_default(),
        vehicle: vehicle.map(|v| (v, trailers)),
        equations: equations(section, "equations")?,
        printed: equations(section, "printed")?,
    })
}

fn status(section: &Section) -> Result<String> {
    let value = section.need("status", "status = \"proved\"")?;
    match value.text()? {
        s @ ("proved" | "corrected" | "refuted" | "open") => Ok(s.to_string()),
        other => Err(value
            .error(format!("a claim of a file cannot be stated {other:?}"))
            .help("write proved, corrected, refuted or open")),
    }
}

fn trailers(value: &Value) -> Result<usize> {
    match value.count()? {
        n if n <= MAX_TRAILERS => Ok(n),
        n => Err(value
            .error(format!("{n} trailers are more than a claim may have"))
            .help(format!("give at most {MAX_TRAILERS}"))),
    }
}

fn known_vehicle(value: &Value, vehicles: &[&str]) -> Result<String> {
    let name = value.text()?;
    match vehicles.contains(&name) {
        true => Ok(name.to_string()),
        false => Err(value.error(format!("no vehicle is called {name:?}")).help("`creepage vehicles` lists them")),
    }
}

fn equations(section: &Section, key: &str) -> Result<Vec<(String, String)>> {
    let Some(value) = section.get(key) else { return Ok(vec![]) };
    value.list(&format!("{key} = [\"left = right\"]"))?.iter().map(equation).collect()
}

fn equation(value: &Value) -> Result<(String, String)> {
    let text = value.text()?;
    let sides = text.split_once('=').filter(|(_, right)| !right.contains('='));
    let (left, right) = sides.ok_or_else(|| value.error("an equation has one =").help("write \"left = right\""))?;
    if text.len() > MAX_EQUATION_CHARACTERS {
        return Err(value
            .error(format!("an equation has at most {MAX_EQUATION_CHARACTERS} characters"))
            .help("write a shorter one"));
    }
    for side in [left, right] {
        let formula = Expr::parse(side.trim()).map_err(|e| misread(value, &e))?;
        if let Some(complaint) = too_large(&formula) {
            return Err(value.error(complaint).help("write smaller powers"));
        }
    }
    Ok((left.trim().to_string(), right.trim().to_string()))
}

/// The complaint about a formula, at the place of the equation in the file.
fn misread(value: &Value, e: &Error) -> Error {
    value.error(format!("a formula cannot be read: {e}"))
}
