//! Files of a user's own effects and vehicles: their size, their ids, the number of entries and of factors they may have.

use super::formula_text::FormulaText;
use super::spanned_table::Value;
use super::suggestions::shown;
use super::text::read_hashed;
use crate::error::{Error, Result};
use crate::formula::Size;
use crate::provenance::Origin;
use std::path::Path;
use std::sync::Arc;

/// The largest file of a user's own, in bytes: a vehicle has some dozens of lines and an effect a few, so that a larger
/// file is another one given by mistake.
const MAX_BYTES: usize = 256 << 10;
/// The most factors in a product of a formula of a constraint: it is multiplied out, and its terms grow with every factor.
const MAX_FACTORS: usize = 8;

/// A file's text, kept as the origin of what it defines.
pub(crate) fn read_user_file(path: &Path, what: &str) -> Result<Arc<Origin>> {
    let (text, sha256) = read_hashed(path)?;
    if text.len() > MAX_BYTES {
        return Err(Error::input("is larger than 256 KiB")
            .at_file(path)
            .help(format!("check that this is the file of {what} you meant")));
    }
    Ok(Arc::new(Origin { path: path.into(), sha256, text }))
}

/// A name for model files, which becomes part of symbols: letters, digits and hyphens, and none that is reserved.
pub(crate) fn read_id(value: &Value, of: &str, reserved: &[&str]) -> Result<String> {
    let id = value.text()?;
    let good = id.starts_with(|c: char| c.is_ascii_alphabetic())
        && id.len() <= 60
        && id.chars().all(|c| c.is_ascii_alphanumeric() || c == '-');
    match good && !reserved.contains(&id) {
        true => Ok(id.to_string()),
        false => Err(value
            .error(format!("\"{}\" cannot be the id of {of}", shown(id)))
            .help("begin with a letter, go on with letters, digits and hyphens, at most 60")),
    }
}

/// Refuses a list of more than `most` entries.
pub(crate) fn at_most(value: &Value, found: usize, most: usize) -> Result<()> {
    match found <= most {
        true => Ok(()),
        false => Err(value.error(format!("{} has {found} entries", value.name)).help(format!("give at most {most}"))),
    }
}

/// Reads a formula that is small enough to be multiplied out.
pub(crate) fn bounded(value: &Value) -> Result<FormulaText> {
    let text = FormulaText::read(value)?;
    match Size::of(&text.formula, &|_| Size::SYMBOL).degree > MAX_FACTORS {
        true => Err(too_long(&text)),
        false => Ok(text),
    }
}

fn too_long(text: &FormulaText) -> Error {
    let error = text.error(format!("a constraint has a product of more than {MAX_FACTORS} factors"));
    error.help("define a symbol for a part of it")
}
