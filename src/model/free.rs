//! The free part of a model: the effects whose values are still to be fitted.

use super::equations::Equations;
use super::vehicle_model::Model;
use crate::effects::Applied;
use crate::error::Result;
use crate::formula::Symbol;

impl Model {
    /// The effects whose values are free, in the model's order.
    ///
    /// ```
    /// # fn main() -> Result<(), creepage::error::Error> {
    /// let model = creepage::model::Model::new("unicycle", &[("wheel_radius", 0.5)])?;
    /// assert_eq!(model.free_effects().count(), 0);
    /// # Ok(()) }
    /// ```
    pub fn free_effects(&self) -> impl Iterator<Item = &Applied> {
        self.effects.iter().filter(|e| e.free)
    }

    /// The parameters of the free effects, effect by effect.
    pub fn free_parameters(&self) -> Vec<Symbol> {
        self.free_effects().flat_map(Applied::parameters).collect()
    }

    /// Their values, in the same order.
    pub fn free_values(&self) -> Vec<f64> {
        self.free_effects().flat_map(|e| e.values.iter().copied()).collect()
    }

    /// The equations with derivatives by the free parameters.
    ///
    /// # Errors
    /// When the model's formulas do not determine its motion.
    pub fn free_equations(&self) -> Result<Equations> {
        self.equations(&self.free_parameters())
    }
}
