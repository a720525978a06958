//! The equations of one case at a time, by which the sensor is inverted at the start of a block.

use super::equations::Varied;
use crate::error::Result;
use crate::formula::Symbol;
use crate::model::{Equations, Model};

/// What finding a start needs beside the lanes: the equations one case at a time.
pub(crate) struct Start {
    pub(super) equations: Equations,
    /// Which of the varied quantities are parameters of the equations.
    pub(super) free: Vec<usize>,
}

impl Start {
    pub fn new(model: &Model, varied: &[Varied]) -> Result<Self> {
        let of_model = |v: &Varied| matches!(v, Varied::Model(_));
        let free: Vec<usize> = (0..varied.len()).filter(|i| of_model(&varied[*i])).collect();
        let symbols: Vec<Symbol> = varied
            .iter()
            .filter_map(|v| match v {
                Varied::Model(s) => Some(s.clone()),
                _ => None,
            })
            .collect();
        Ok(Self { equations: model.equations(&symbols)?, free })
    }
}
