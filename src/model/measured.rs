//! What a log measures of the motion beside the pose: any formula of the model, each with a noise of its own.

use crate::effects::measuring;
use crate::error::{Error, Result};
use crate::files::MeasuredEntry;
use crate::formula::{Expr, Symbol};
use crate::vehicles::Vehicle;

/// A quantity of the motion that a column of a log measures.
#[derive(Clone, Debug, PartialEq)]
pub struct MeasuredQuantity {
    /// Its name in the model file.
    pub name: String,
    /// Its formula in symbols of the model, where the rate of any symbol is that symbol with a stroke: `v_l'`.
    pub formula: Expr,
    /// Its SI unit; empty where nothing says it.
    pub unit: String,
    /// Its standard deviation, where it is known.
    pub noise: Option<f64>,
}

impl MeasuredQuantity {
    /// What an entry of a model file means for a vehicle.
    ///
    /// # Errors
    /// At the entry, where the vehicle does not say how an input follows from the motion.
    pub(crate) fn of_entry(entry: &MeasuredEntry, vehicle: &Vehicle) -> Result<Self> {
        let of_input = || {
            let input = Expr::sym(entry.name.as_str());
            vehicle.define.iter().find(|(_, d)| d.formula == input).map(|(name, _)| Expr::sym(name.clone()))
        };
        let formula = entry.formula.clone().or_else(of_input).ok_or_else(|| {
            let (line, column) = entry.place;
            Error::input(format!("nothing says how {} follows from the motion of {}", entry.name, vehicle.id))
                .at(line, column)
                .help(format!("give its formula: {} = {{ column = \"…\", formula = \"…\" }}", entry.name))
        })?;
        Ok(Self { name: entry.name.clone(), formula, unit: entry.unit.clone(), noise: entry.noise })
    }

    /// The definition that it is compared with, which an effect may rewrite.
    pub fn symbol(&self) -> Symbol {
        measuring(&self.name)
    }
}
