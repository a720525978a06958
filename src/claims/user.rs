//! A user's own claims, from a file.

use super::{Claim, DerivedFormulas, Status, prove};
use crate::error::Result;
use crate::files::{ClaimEntry, read_claims};
use crate::vehicles::Vehicle;
use std::path::Path;

/// The claims of a TOML file: equations that the normal form proves or refutes, about formulas or about the derived
/// motion of one of these vehicles.
///
/// ```toml
/// [[claim]]
/// id = "course"
/// says = "traverse creep turns the course by arctan e"
/// status = "proved"                    # proved, corrected, refuted or open
/// equations = ["cot(phi + atan(e)) = (cot(phi) - e)/(1 + e*cot(phi))"]
/// printed = []                         # false forms; with them the status is corrected or refuted
/// ```
///
/// ```
/// use creepage::{claims, vehicles};
/// let file = std::env::temp_dir().join(format!("creepage-claims-{}.toml", std::process::id()));
/// let text = "[[claim]]\nid = \"square\"\nsays = \"a product\"\nstatus = \"proved\"\nequations = [\"x^2 = x*x\"]\n";
/// std::fs::write(&file, text).unwrap();
/// let own = claims::read(&file, vehicles::all())?;
/// assert_eq!(own[0].id, "square");
/// # std::fs::remove_file(file).unwrap();
/// # Ok::<(), creepage::Error>(())
/// ```
///
/// # Errors
/// With file, line and column when the file is not of this form.
pub fn read(path: &Path, vehicles: &[Vehicle]) -> Result<Vec<Claim>> {
    let ids: Vec<&str> = vehicles.iter().map(|v| v.id.as_str()).collect();
    Ok(read_claims(path, &ids)?.into_iter().map(|entry| claim(entry, path, vehicles)).collect())
}

fn claim(entry: ClaimEntry, path: &Path, vehicles: &[Vehicle]) -> Claim {
    let status = match entry.status.as_str() {
        "proved" => Status::Proved,
        "corrected" => Status::Corrected,
        "refuted" => Status::Refuted,
        _ => Status::Open,
    };
    let spoken_of =
        |(id, n): &(String, usize)| Some(DerivedFormulas::of_vehicle(vehicles.iter().find(|v| v.id == *id)?, *n));
    let derived = entry.vehicle.as_ref().and_then(spoken_of).unwrap_or_default();
    let claim = Claim::new(&entry.id, status, &entry.says).at(&path.display().to_string()).under(&entry.under);
    let claim = match entry.equations.is_empty() {
        true => claim,
        false => {
            let derived = derived.clone();
            claim.proof("as the file states", &pairs(&entry.equations), move |s, _| prove(&derived, s))
        }
    };
    match entry.printed.is_empty() {
        true => claim,
        false => {
            let printed = pairs(&entry.printed);
            // Where the file knows no true form, the check must at least let each side equal itself.
            let truth = match entry.equations.is_empty() {
                true => printed.iter().map(|(left, _)| (*left, *left)).collect(),
                false => pairs(&entry.equations),
            };
            claim.refutation("as the file says is printed", &printed, &truth, move |s, _| prove(&derived, s))
        }
    }
}

fn pairs(equations: &[(String, String)]) -> Vec<(&str, &str)> {
    equations.iter().map(|(l, r)| (l.as_str(), r.as_str())).collect()
}
