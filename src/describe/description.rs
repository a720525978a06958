//! The description of a model: everything that follows from it, in formulas.

use super::forces::is_as_stated;
use super::{ConstraintEntry, CreepLimits, DerivativesAt, GivenPoint, Signature, Structure, Symbols};
use crate::effects::Applied;
use crate::error::{Error, Result};
use crate::formula::{Expr, Symbol};
use crate::mechanism::{Constraint, Definitions, Sample};
use crate::model::forces::Law;
use crate::model::{Model, WITH_TRAILERS};
use std::collections::BTreeSet;

/// A model in formulas: symbols, constraints, Pfaffian matrix, Jacobians, equations of motion.
#[derive(Clone, Debug)]
pub struct Description {
    /// The vehicle's id; that of the tractor when it pulls trailers.
    pub vehicle: String,
    /// What it is, in a line.
    pub title: String,
    /// How many trailers it pulls.
    pub trailers: usize,
    /// Coordinates q: x, y, phi, wheels, trailers.
    pub coordinates: Vec<Symbol>,
    /// Every symbol of the formulas.
    pub symbols: Symbols,
    /// The constraints.
    pub constraints: Vec<ConstraintEntry>,
    /// A(q) with A(q)·q̇ = 0: a row for each constraint, a column for each coordinate.
    pub pfaffian: Vec<Vec<Expr>>,
    /// Number of constraints by form; the signature by ranks is part of the structure.
    pub signature: Signature,
    /// The holonomic and nonholonomic part, and the signature by ranks.
    pub structure: Structure,
    /// Why there are no equations of motion, where the constraints do not determine it.
    pub undetermined: Option<Error>,
    /// The equations of motion, each using only earlier ones, states and inputs; where the constraints do not
    /// determine the motion, the definitions of what stands in their rows.
    pub definitions: Vec<Equation>,
    /// Rates of the states that no sensor sees.
    pub states: Vec<Equation>,
    /// Names that effects changed and that are no coefficient in any row: the motion departs from the rows there.
    pub beside_rows: Vec<Symbol>,
    /// The speeds that forces change; none where the inputs say how the vehicle moves.
    pub speeds: Vec<Symbol>,
    /// The inputs, in the order of the log.
    pub inputs: Vec<Symbol>,
    /// The effects the model includes.
    pub effects: Vec<EffectInModel>,
    /// Derivatives of the constraints at a point that was asked for.
    pub derivatives: Option<DerivativesAt>,
}

/// name = formula; for a state, its rate.
///
/// ```
/// let wheel = creepage::Model::new("unicycle", &[("wheel_radius", 0.5)])?;
/// let description = creepage::describe(&wheel)?;
/// assert!(description.states.iter().all(|equation| !equation.formula.to_string().is_empty()));
/// # Ok::<(), creepage::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Equation {
    /// What is defined.
    pub name: Symbol,
    /// How.
    pub formula: Expr,
}

/// An effect of a model.
#[derive(Clone, Debug)]
pub struct EffectInModel {
    /// The effect with its values.
    pub applied: Applied,
    /// What it makes of a definition; `it` is the definition as it was.
    pub changes: Vec<Equation>,
}

/// The most trailers that are written out: matrix, derivatives and ranks grow with the cube of their number.
pub const MAX_TRAILERS: usize = 64;

impl Description {
    /// Derives everything from a model.
    ///
    /// # Errors
    /// When an effect does not apply, formulas use each other in a circle, or there are more than [`MAX_TRAILERS`].
    pub fn of(model: &Model) -> Result<Self> {
        Self::of_measuring(model, &[])
    }

    /// The same where some rates are measured beside those that the logged inputs give.
    ///
    /// # Errors
    /// As [`Description::of`] and [`Structure::of_measuring`].
    pub fn of_measuring(model: &Model, also: &[Symbol]) -> Result<Self> {
        // The constraints are those of the vehicle without forces; the motion is what forces make of it.
        let (whole, model) = (model, &model.kinematic());
        if model.trailers.len() > MAX_TRAILERS {
            let found = model.trailers.len();
            return Err(Error::input(format!("{found} trailers are too many to write out"))
                .help(format!("describe at most {MAX_TRAILERS}; `creepage simulate` takes more")));
        }
        let definitions = model.row_definitions()?;
        let plain = Model { effects: vec![], ..model.clone() }.row_definitions()?;
        let [moving, moving_plain] = match whole.forced {
            Some(_) => [whole.definitions()?, Model { effects: vec![], ..whole.clone() }.definitions()?],
            None => [definitions.clone(), plain.clone()],
        };
        let coordinates = model.coordinates();
        let found = model.constraints();
        let in_rows: BTreeSet<Symbol> = found.iter().flat_map(coefficient_symbols).collect();
        let creeps: BTreeSet<Symbol> = found.iter().map(|c| c.creep.clone()).collect();
        let changed = |s: &Symbol| definitions.get(s) != plain.get(s);
        let in_model = |s: &Symbol| {
            definitions.get(s).filter(|_| in_rows.contains(s) && (creeps.contains(s) || changed(s))).cloned()
        };
        let force = |i: usize| Some(Law::symbol("force", i + 1)).filter(|force| moving.get(force).is_some());
        let of = |(i, c)| ConstraintEntry { held_by: force(i), ..ConstraintEntry::of(c, &coordinates, &in_model) };
        let constraints: Vec<_> = found.iter().enumerate().map(of).collect();
        let entry = |c: &ConstraintEntry| coordinates.iter().map(|q| c.row.coefficient(&q.rate())).collect();
        let sorted = moving.sorted()?.into_iter().filter(|(name, formula)| !is_as_stated(name, formula));
        let mut description = Self {
            vehicle: model.vehicle.id.clone(),
            title: model.vehicle.title.clone(),
            trailers: model.trailers.len(),
            pfaffian: constraints.iter().map(entry).collect(),
            signature: Signature::of(&found),
            structure: Structure::of_measuring(model, also)?,
            undetermined: whole.determined().err(),
            definitions: sorted.map(|(name, f)| Equation { name: name.clone(), formula: f.clone() }).collect(),
            speeds: whole.forced.iter().flat_map(|forced| forced.speeds.clone()).collect(),
            inputs: whole.inputs.iter().map(|role| Symbol::new(role)).collect(),
            states: whole
                .effects
                .iter()
                .flat_map(Applied::states)
                .map(|(name, formula)| Equation { name, formula })
                .collect(),
            beside_rows: moving
                .iter()
                .map(|(n, _)| n.clone())
                .filter(|n| moving.get(n) != moving_plain.get(n) && !in_rows.contains(n))
                .collect(),
            effects: whole.effects.iter().map(|e| EffectInModel::of(e, &moving_plain)).collect(),
            symbols: Symbols::default(),
            derivatives: None,
            coordinates,
            constraints,
        };
        description.symbols = Symbols::of(whole, &moving, &description.used())?;
        description.fill_coefficients(&definitions, &plain);
        Ok(description)
    }

    /// The description with the limits between creep and sliding, by which every coefficient is named.
    ///
    /// ```
    /// use creepage::{describe::{CreepLimits, Description}, model::Model};
    /// let wheel = Model::new("unicycle", &[("wheel_radius", 0.5)]).unwrap();
    /// let limits = CreepLimits { traverse: Some("-0.1,0.1".parse().unwrap()), rotation: None };
    /// let description = Description::of(&wheel).unwrap().with_limits(limits);
    /// assert_eq!(description.constraints[1].coefficient.words(), "ideal (limits -0.1 to 0.1)");
    /// assert!(!description.constraints[0].coefficient.is_told());
    /// ```
    pub fn with_limits(mut self, limits: CreepLimits) -> Self {
        for c in &mut self.constraints {
            c.coefficient.limits = limits.of(c.kind.regimes);
        }
        self
    }

    /// The description with the derivatives of the model's constraints at a point.
    ///
    /// # Errors
    /// As [`DerivativesAt::of`].
    pub fn with_derivatives_at(self, model: &Model, point: &GivenPoint) -> Result<Self> {
        Ok(Self { derivatives: Some(DerivativesAt::of(model, point)?), ..self })
    }

    /// Values of the coefficients in the model as it stands, and whether its motion keeps to their rows.
    fn fill_coefficients(&mut self, definitions: &Definitions, plain: &Definitions) {
        let points: Vec<Sample> = (0..3).filter_map(|k| Sample::of(definitions, k)).collect();
        for c in &mut self.constraints {
            c.coefficient.value = self.symbols.get(&c.creep).and_then(|s| s.value);
            c.coefficient.given = definitions.get(&c.creep) != plain.get(&c.creep);
            // Without a motion there is nothing that could depart from the rows.
            c.coefficient.row_holds =
                self.undetermined.is_some() || points.iter().all(|point| point.annihilates(&c.row));
        }
    }

    /// The name of the whole, as in a model file.
    pub fn id(&self) -> &str {
        if self.trailers > 0 { WITH_TRAILERS } else { &self.vehicle }
    }

    /// Every formula of the description, except the changes of effects, which speak of `it`.
    pub fn formulas(&self) -> Vec<Expr> {
        let constraints = self.constraints.iter().flat_map(ConstraintEntry::formulas);
        let equations = self.definitions.iter().chain(&self.states).map(|e| e.formula.clone());
        constraints.chain(equations).chain(self.structure.formulas()).collect()
    }

    /// Every symbol of the description.
    fn used(&self) -> BTreeSet<Symbol> {
        let mut used: BTreeSet<Symbol> = self.formulas().iter().flat_map(Expr::symbols).collect();
        used.extend(self.coordinates.iter().flat_map(|q| [q.clone(), q.rate()]));
        used.extend(self.definitions.iter().chain(&self.states).map(|e| e.name.clone()));
        used.extend(self.effects.iter().flat_map(|e| e.applied.parameters()));
        used.extend(self.speeds.iter().flat_map(|s| [s.clone(), s.rate()]));
        used
    }
}

/// The symbols in the coefficients of a constraint's row.
fn coefficient_symbols(c: &Constraint) -> BTreeSet<Symbol> {
    c.row().terms().iter().flat_map(|(_, e)| e.symbols()).collect()
}

impl EffectInModel {
    fn of(applied: &Applied, definitions: &Definitions) -> Self {
        let names: Vec<Symbol> = definitions.iter().map(|(n, _)| n.clone()).collect();
        let targets = applied.effect.targets(&names, applied.trailer).unwrap_or_default().into_iter();
        let changes = targets.map(|(name, f)| Equation { name, formula: applied.localised(&f) }).collect();
        Self { applied: applied.clone(), changes }
    }
}
