//! Models from files: what a file may say, and the model it says.

use super::measured::MeasuredQuantity;
use super::terms;
use super::trailer::Trailer;
use super::vehicle_model::{Model, Sensor};
use crate::effects::{Applied, Effect, RandomWalk};
use crate::error::{Error, Result};
use crate::files::{
    CourseEntry, EffectEntry, Known, KnownDynamics, KnownEffect, KnownInput, KnownParameter, KnownVehicle, ModelFile,
    Motion,
};
use crate::vehicles;
use crate::vehicles::Vehicle;

/// The id of a vehicle with trailers; its tractor is a vehicle of the catalogue.
pub const WITH_TRAILERS: &str = "n-trailer";

/// What a model file may name: the vehicles of the catalogue and the effects of a library.
pub fn known(library: &[Effect]) -> Known {
    known_on(vehicles::all(), library)
}

/// What a model file may name: these vehicles and the effects of a library.
///
/// ```
/// use creepage::{effects, extensions, model};
/// let vehicles = extensions::vehicles_with_own("examples/bus/bus.toml").unwrap();
/// assert!(model::known_on(&vehicles, effects::all()).vehicle("articulated-bus").is_some());
/// ```
pub fn known_on(vehicles: &[Vehicle], library: &[Effect]) -> Known {
    let train = KnownVehicle { id: WITH_TRAILERS.into(), trailers: true, ..KnownVehicle::default() };
    Known {
        vehicles: vehicles.iter().map(known_vehicle).chain([train]).collect(),
        effects: library.iter().map(known_effect).collect(),
        terms: terms::ids().into_iter().map(known_term).collect(),
    }
}

fn known_term(id: String) -> KnownEffect {
    let [min, max] = terms::RANGE;
    let k = KnownParameter { name: terms::COEFFICIENT.into(), min, max };
    KnownEffect { id, parameters: vec![k], ..KnownEffect::default() }
}

fn known_vehicle(v: &Vehicle) -> KnownVehicle {
    let names =
        |optional: bool| v.parameters.iter().filter(move |(_, p)| p.optional == optional).map(|(k, _)| k.clone());
    let input = |(role, i): (&String, &vehicles::Input)| KnownInput {
        role: role.clone(),
        instead: i.instead.as_ref().map(|i| i.role.clone()),
        unit: i.unit.clone(),
        instead_unit: i.instead.as_ref().map(|i| i.unit.clone()).unwrap_or_default(),
    };
    KnownVehicle {
        id: v.id.clone(),
        parameters: names(false).collect(),
        optional_parameters: names(true).collect(),
        inputs: v.inputs.iter().map(input).collect(),
        heading: v.heading.as_ref().map(ToString::to_string),
        stays: v.stays(),
        trailers: false,
        tractor: v.pulls(),
        line: v.line,
        dynamics: KnownDynamics::default(),
        sections: v.trailers.len(),
        description: Some(v.clone()),
    }
}

fn known_effect(e: &Effect) -> KnownEffect {
    let parameter = |(name, p): (&String, &crate::effects::Parameter)| KnownParameter {
        name: name.clone(),
        min: p.range[0],
        max: p.range[1],
    };
    KnownEffect {
        id: e.id.clone(),
        parameters: e.parameters.iter().map(parameter).collect(),
        per_trailer: e.per_trailer,
        per_input: e.per_input,
        per_quantity: e.per_quantity,
        input_optional: e.input_optional,
    }
}

impl Model {
    /// That a file's model can be simulated and fitted: the constraints of its vehicle determine the motion.
    ///
    /// # Errors
    /// As [`Model::determined`], with the file.
    pub fn check_motion(file: &ModelFile) -> Result<()> {
        Self::from_file(&ModelFile { effects: vec![], ..file.clone() }, &[], &[])?
            .determined()
            .map_err(|e| e.at_file(&file.path))
    }

    /// The model of a file whose columns say which inputs are logged.
    ///
    /// # Errors
    /// As [`Model::from_file`].
    pub fn of_file(file: &ModelFile, library: &[Effect]) -> Result<Self> {
        let roles: Vec<String> = file.columns.inputs.iter().map(|i| i.role.clone()).collect();
        Self::from_file(file, library, &roles)
    }

    /// The model that a file describes, logged by the given input roles.
    ///
    /// # Errors
    /// When an effect of the file does not apply to its vehicle.
    pub fn from_file(file: &ModelFile, library: &[Effect], roles: &[String]) -> Result<Model> {
        let id = file.tractor.as_deref().unwrap_or(&file.vehicle);
        let vehicle = file.description.as_ref().or_else(|| vehicles::named(id));
        let vehicle = vehicle.ok_or_else(|| Error::input(format!("no vehicle is called {id:?}")))?;
        let trailers = file.trailer_lengths.iter().zip(&file.hitch_offsets);
        let mut model = Model {
            vehicle: vehicle.clone(),
            trailers: trailers.map(|(length, hitch)| Trailer { length: *length, hitch: *hitch }).collect(),
            parameters: file.parameters.clone(),
            sensor: Sensor { lever_arm: file.sensor.lever_arm, heading_offset: file.sensor.heading_offset },
            measured: vec![],
            inputs: roles.to_vec(),
            effects: vec![],
            forced: None,
            solution: Default::default(),
        };
        // Under forces the inputs of a log are those of the motion with forces.
        if roles.is_empty() || file.dynamics.is_some() {
            model.inputs = vehicle.inputs.keys().cloned().collect();
        }
        if let Some(entry) = &file.dynamics {
            let (line, column) = entry.place;
            model = model.with_forces(entry).map_err(|e| e.at_file(&file.path).at(line, column))?;
        }
        let measured = file.measured.iter().map(|entry| MeasuredQuantity::of_entry(entry, vehicle));
        model.measured = measured.collect::<Result<_>>().map_err(|e| e.at_file(&file.path))?;
        model.check_measured(file)?;
        for entry in &file.effects {
            let term = if entry.id.starts_with(terms::PREFIX) { model.term(&entry.id)? } else { None };
            let of = (vehicle, &model.measured[..]);
            let known = applied(entry, library, of).or_else(|| applied(entry, term.as_slice(), of));
            let known = known.ok_or_else(|| {
                Error::input(format!("unknown effect {:?}", entry.id)).at_file(&file.path).at(entry.line, 1)
            })?;
            model.effects.push(model.at_contacts(known));
            model.row_definitions().and_then(|d| d.sorted().map(|_| ())).map_err(|e| {
                let advice = "remove the entry; `creepage describe` shows what the vehicle has";
                e.at_file(&file.path).at(entry.line, 1).help(advice)
            })?;
        }
        Ok(model)
    }
}

fn applied(
    entry: &EffectEntry,
    library: &[Effect],
    (vehicle, measured): (&Vehicle, &[MeasuredQuantity]),
) -> Option<Applied> {
    let effect = library.iter().find(|e| e.id == entry.id)?;
    let mut effect = effect.clone();
    if let Some(role) = &entry.input {
        let unit = match effect.per_quantity {
            true => &measured.iter().find(|m| m.name == *role)?.unit,
            false => vehicle.unit_of(role),
        };
        effect = effect.on_input(role, unit, 1.0);
    }
    let mut per_s = None;
    match entry.course.as_ref().map(|c| (c.parameter.clone(), c.motion)) {
        Some((parameter, Motion::Linear { per_s: rate, since })) => {
            effect = effect.drifting(&parameter, since)?;
            per_s = Some(rate);
        }
        Some((parameter, Motion::RandomWalk { per_sqrt_s })) => {
            effect.walk = Some(RandomWalk { parameter, per_sqrt_s, std: None });
        }
        None => {}
    }
    let rate = |name: &String| per_s.filter(|_| effect.course.as_ref().is_some_and(|c| c.rate() == *name));
    let values = effect.parameters.keys().map(|name| entry.parameters.get(name).copied().or_else(|| rate(name)));
    let values = values.collect::<Option<_>>()?;
    effect.scope.clone_from(&entry.scope);
    Some(Applied::new(&effect, entry.trailer, values))
}

impl Applied {
    /// The effect as an entry of a model file.
    pub fn entry(&self) -> EffectEntry {
        let mut parameters = self.named_values();
        let course = self.effect.course.as_ref().and_then(|c| {
            let per_s = parameters.remove(&c.rate())?;
            Some(CourseEntry { parameter: c.parameter.clone(), motion: Motion::Linear { per_s, since: c.since } })
        });
        let walk = self.effect.walk.as_ref().map(|w| {
            let motion = Motion::RandomWalk { per_sqrt_s: w.per_sqrt_s };
            CourseEntry { parameter: w.parameter.clone(), motion }
        });
        EffectEntry {
            id: self.effect.id.clone(),
            trailer: self.trailer,
            input: self.effect.on.clone(),
            of_sensor: self.effect.per_quantity,
            scope: self.effect.scope.clone(),
            course: course.or(walk),
            parameters,
            defined_in: self.effect.origin.as_ref().map(|o| o.path.clone()),
            ..EffectEntry::default()
        }
    }
}
