//! A vehicle with masses, contacts and forces: all that its motion follows from.

use super::bodies::{Body, bodies, castors, reference, rolling_rates, spinning, unprimed};
use super::contact::Contact;
use super::driving_force::{Force, forces, wheel_torques};
use super::law::laws;
use super::masses::{Masses, inertia_of};
use crate::error::{Error, Result};
use crate::formula::{Expr, Symbol};
use crate::mechanism::{Definitions, Mechanism};
use crate::model::constraints::mechanism;
use crate::model::vehicle_model::Model;
use std::collections::BTreeMap;

/// The dynamics of a vehicle: coordinates, kinetic energy, contacts and forces, derived from its description.
///
/// | symbol | unit | meaning |
/// |---|---|---|
/// | q | m, rad | coordinates of the mechanism that are not prescribed |
/// | `body.mass`, `body.inertia`, `body.mass_offset` | kg, kg·m², m | see [`Masses`]; `trailer_1.mass` and so on |
/// | `theta.inertia` | kg·m² | moment of the wheel of angle `theta` about its axle |
/// | `contact_1.coefficient` … | | parameters of the law of the first contact |
///
/// Valid on a level plane, for bodies that do not pitch, roll or bend. Every contact is ideal until it is given a law.
///
/// ```
/// use creepage::dynamics::{Dynamics, Masses};
/// use creepage::model::Model;
/// let sleigh = Model::new("sleigh", &[("mass", 2.0), ("inertia", 0.5), ("mass_offset", 0.1)]).unwrap();
/// let masses = Masses { mass: 2.0, inertia: 0.5, mass_offset: 0.1, ..Masses::default() };
/// let sleigh = Dynamics::new(&sleigh, &masses).unwrap().with_law("blade-direction", "viscous", &[50.0]).unwrap();
/// assert_eq!(sleigh.contacts[0].slip.to_string(), "-sin(phi)*x' + cos(phi)*y'");
/// ```
#[derive(Clone, Debug)]
pub struct Dynamics {
    /// Coordinates and constraints.
    pub mechanism: Mechanism,
    /// One contact for each constraint, in their order.
    pub contacts: Vec<Contact>,
    /// Coordinates whose motion is given: steering angles.
    pub prescribed: Vec<Symbol>,
    pub(crate) model: Model,
    pub(crate) bodies: Vec<Body>,
    pub(crate) driven: Vec<Force>,
    pub(crate) by_rate: bool,
    values: BTreeMap<Symbol, f64>,
}

/// Teeth of a gear come to rest on a flank at this rate, 1/s: quickly beside all that poses show, and slowly enough to follow.
const FLANK_RATE: f64 = 100.0;

impl Dynamics {
    /// The dynamics of a model with masses, every contact ideal, driven by nothing but its steering.
    ///
    /// # Errors
    /// When the model includes effects, its vehicle has sections of its own, or the masses do not fit its trailers.
    pub fn new(model: &Model, masses: &Masses) -> Result<Self> {
        if let Some(effect) = model.effects.first() {
            return Err(Error::input(format!("the effect {} has no place beside forces", effect.label()))
                .help("remove it: with forces, creep follows from the laws of contact"));
        }
        if !model.vehicle.trailers.is_empty() {
            let message = format!("no forces are known for {}, which has sections of its own", model.vehicle.id);
            return Err(Error::input(message).help("forces move a vehicle of one section and the trailers behind it"));
        }
        if masses.trailers.len() != model.trailers.len() {
            let (given, wanted) = (masses.trailers.len(), model.trailers.len());
            return Err(Error::input(format!("{given} trailers have a mass, the model has {wanted} trailers")));
        }
        let vehicle = &model.vehicle;
        let mechanism = mechanism(vehicle, model.trailers.len());
        let prescribed = mechanism.coordinates.iter().filter(|q| vehicle.define.contains_key(q)).cloned().collect();
        let mut values = model.values();
        values.extend(masses.values());
        for rate in rolling_rates(vehicle) {
            values.insert(inertia_of(&unprimed(&rate)), masses.wheels.get(&rate).copied().unwrap_or(0.0));
        }
        for angle in castors(vehicle) {
            values.insert(inertia_of(&angle), masses.castors.get(&angle).copied().unwrap_or(0.0));
        }
        Ok(Self {
            contacts: mechanism.constraints.iter().map(Contact::of).collect(),
            bodies: bodies(vehicle, model.trailers.len()),
            mechanism,
            prescribed,
            model: model.clone(),
            driven: vec![],
            by_rate: false,
            values,
        })
    }

    /// Gives a contact a law in place of the constraint.
    ///
    /// # Errors
    /// When the contact or the law is unknown, or a number of values other than the law's is given.
    pub fn with_law(mut self, contact: &str, law: &str, values: &[f64]) -> Result<Self> {
        let law = laws().iter().find(|l| l.id == law).ok_or_else(|| {
            let known: Vec<&str> = laws().iter().map(|l| l.id.as_str()).collect();
            Error::input(format!("no law of contact is called {law:?}")).help(format!("known: {}", known.join(", ")))
        })?;
        if law.parameters.len() != values.len() {
            let (given, wanted) = (values.len(), law.parameters.len());
            return Err(Error::input(format!("{given} values are given, the law {} has {wanted}", law.id)));
        }
        let names: Vec<String> = self.contacts.iter().map(|c| c.name.clone()).collect();
        let found = self.contacts.iter_mut().find(|c| c.name == contact);
        let found = found.ok_or_else(|| {
            Error::input(format!("no contact is called {contact:?}")).help(format!("known: {}", names.join(", ")))
        })?;
        found.law = Some((law.clone(), values.to_vec()));
        Ok(self)
    }

    /// Gives every contact the same law.
    ///
    /// # Errors
    /// As [`Dynamics::with_law`].
    pub fn with_laws(self, law: &str, values: &[f64]) -> Result<Self> {
        let names: Vec<String> = self.contacts.iter().map(|c| c.name.clone()).collect();
        names.iter().try_fold(self, |dynamics, name| dynamics.with_law(name, law, values))
    }

    /// Drives it by forces and torques, inputs in this order before the steering.
    ///
    /// # Errors
    /// When the vehicle has no such force.
    pub fn driven_by(mut self, roles: &[&str]) -> Result<Self> {
        let known = forces(&self.model.vehicle, &self.bodies[0]);
        let find = |role: &&str| {
            known.iter().find(|f| f.role == *role).cloned().ok_or_else(|| {
                let names: Vec<&str> = known.iter().map(|f| f.role.as_str()).collect();
                let message = format!("the {} is not driven by {role:?}", self.model.vehicle.id);
                Error::input(message).help(format!("known: {}", names.join(", ")))
            })
        };
        self.driven = roles.iter().map(find).collect::<Result<_>>()?;
        let turns_wheels = wheel_torques(&self.model.vehicle).iter().any(|t| roles.contains(&t.role.as_str()));
        self.values.extend(turns_wheels.then(|| ("flank_rate".into(), FLANK_RATE)));
        Ok(self)
    }

    /// Steers it by the rate of the steering angle, which then is a state, in place of the angle.
    pub fn steered_by_rate(self) -> Self {
        Self { by_rate: true, ..self }
    }

    /// The inputs: forces and torques, then the steering.
    ///
    /// ```
    /// use creepage::dynamics::{Dynamics, Masses};
    /// use creepage::model::Model;
    /// let car = Model::new("car", &[("wheel_radius", 0.3), ("wheelbase", 2.6)]).unwrap();
    /// let car = Dynamics::new(&car, &Masses { mass: 900.0, inertia: 1100.0, ..Masses::default() }).unwrap();
    /// assert_eq!(car.driven_by(&["wheel_torque"]).unwrap().inputs(), ["wheel_torque", "steering_angle"]);
    /// ```
    pub fn inputs(&self) -> Vec<String> {
        let forces = self.driven.iter().map(|f| f.role.clone());
        forces.chain(self.steering().into_iter().map(|s| if self.by_rate { rate_role(&s) } else { s })).collect()
    }

    /// The logged angles that the prescribed coordinates are made of.
    pub(crate) fn steering(&self) -> Vec<String> {
        let vehicle = &self.model.vehicle;
        let used = |q: &Symbol| vehicle.define.get(q).map(|d| d.formula.symbols()).unwrap_or_default();
        let symbols: Vec<Symbol> = self.prescribed.iter().flat_map(used).collect();
        vehicle.inputs.keys().filter(|role| symbols.iter().any(|s| s.as_str() == role.as_str())).cloned().collect()
    }

    /// The coordinates that move by forces.
    pub fn coordinates(&self) -> Vec<Symbol> {
        self.mechanism.coordinates.iter().filter(|q| !self.prescribed.contains(q)).cloned().collect()
    }

    /// The kinetic energy of bodies and wheels, J.
    ///
    /// ```
    /// use creepage::dynamics::{Dynamics, Masses};
    /// use creepage::model::Model;
    /// let disk = Model::new("disk", &[("wheel_radius", 0.5)]).unwrap();
    /// let disk = Dynamics::new(&disk, &Masses { mass: 2.0, ..Masses::default() }).unwrap();
    /// assert_eq!(disk.energy().to_string(), "body.mass*(s'^2/2) + theta.inertia*(theta'^2/2)");
    /// ```
    pub fn energy(&self) -> Expr {
        let bodies = self.bodies.iter().map(Body::energy).fold(Expr::int(0), |sum, e| &sum + &e);
        &bodies + &spinning(&self.model.vehicle)
    }

    /// Speed along and across the body at the reference point.
    pub(crate) fn speeds(&self) -> [Expr; 2] {
        let body = crate::mechanism::Heading::along("phi");
        let v = reference(&self.model.vehicle);
        [v.along(&body).expr(), v.along(&body.left()).expr()]
    }

    /// Values of every symbol that does not move.
    pub(crate) fn values(&self) -> BTreeMap<Symbol, f64> {
        let laws = self.contacts.iter().enumerate().flat_map(|(i, c)| c.values(i + 1));
        self.values.clone().into_iter().chain(laws).collect()
    }

    /// Lengths and radii by the parameters they are made of.
    pub(crate) fn lengths(&self) -> Definitions {
        let vehicle = &self.model.vehicle;
        let moves = |s: &Symbol| vehicle.inputs.contains_key(s.as_str());
        let mut found = Definitions::default();
        for (name, definition) in self.model.bare_definitions().iter() {
            let own = vehicle.define.get(name).is_some_and(|d| !d.formula.symbols().iter().any(moves));
            let primed = name.as_str().ends_with('\'');
            let trailer =
                ["d_", "c_"].iter().any(|p| name.as_str().starts_with(p)) && !vehicle.define.contains_key(name);
            if (own && !primed && !self.mechanism.coordinates.contains(name)) || trailer {
                found.define(name.clone(), definition.clone());
            }
        }
        found
    }
}

/// The rate of a steering input.
pub(crate) fn rate_role(angle: &str) -> String {
    if angle.ends_with("angle") { angle.replace("angle", "rate") } else { format!("{angle}_rate") }
}
