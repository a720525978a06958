//! Rows that can be used: every number there and finite.

use super::csv_table::Numbers;
use super::time_stamp::Origin;
use crate::error::Result;
use crate::files::toml::text::{hex, open, unreadable};
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::io::Read;
use std::path::Path;

/// Columns without the rows that lack a number in one of those with a name; NaN is a blank cell.
pub(crate) fn usable(columns: Vec<Vec<f64>>, names: &[&str], sha256: String, origin: Origin) -> Numbers {
    let rows = columns.first().map_or(0, Vec::len);
    let mut dropped: BTreeMap<String, usize> = BTreeMap::new();
    let mut kept: Vec<usize> = Vec::with_capacity(rows);
    for i in 0..rows {
        match columns.iter().take(names.len()).position(|c| !c[i].is_finite()) {
            None => kept.push(i),
            Some(c) => {
                let why = if columns[c][i].is_nan() { "blank or NaN cell" } else { "infinite value" };
                *dropped.entry(format!("{why} in column \"{}\"", names[c])).or_default() += 1;
            }
        }
    }
    let columns = columns.into_iter().map(|c| kept.iter().map(|i| c[*i]).collect()).collect();
    Numbers { columns, rows, dropped, sha256, origin }
}

/// SHA-256 of a file, hexadecimal.
pub(crate) fn hash(path: &Path) -> Result<String> {
    let mut file = open(path)?;
    let mut hash = Sha256::new();
    let mut buffer = vec![0; 1 << 16];
    loop {
        match file.read(&mut buffer).map_err(|e| unreadable(path, &e))? {
            0 => return Ok(hex(&hash.finalize())),
            n => hash.update(&buffer[..n]),
        }
    }
}
