//! Formulas and names in files: written as text.

use super::{Expr, Symbol};
use serde::de::{Deserialize, Deserializer, Error};

impl<'de> Deserialize<'de> for Expr {
    fn deserialize<D: Deserializer<'de>>(d: D) -> Result<Self, D::Error> {
        Expr::parse(&String::deserialize(d)?).map_err(D::Error::custom)
    }
}

impl<'de> Deserialize<'de> for Symbol {
    fn deserialize<D: Deserializer<'de>>(d: D) -> Result<Self, D::Error> {
        let symbol = Symbol::new(&String::deserialize(d)?);
        if symbol.is_well_formed() { Ok(symbol) } else { Err(D::Error::custom(format!("{symbol:?} is no name"))) }
    }
}
