//! The effects of a library that apply to a model.

use super::terms::PREFIX;
use super::vehicle_model::Model;
use crate::effects::Effect;
use crate::formula::Symbol;

impl Model {
    /// An effect that acts on one input, on each input of the model, and one that acts on a measured quantity, on each of
    /// these; another one as it is.
    pub fn on_each_input(&self, effect: &Effect) -> Vec<Effect> {
        if effect.per_quantity {
            return self.measured.iter().map(|m| effect.on_input(&m.name, &m.unit, 1.0)).collect();
        }
        match effect.per_input {
            true => self.inputs.iter().map(|role| effect.on_input(role, self.vehicle.unit_of(role), 1.0)).collect(),
            false => vec![effect.clone()],
        }
    }

    /// The effects of a library that apply to the vehicle, one entry for each trailer they may belong to.
    ///
    /// One does not where its formulas would close a circle with those of the model; in the catalogues none can.
    pub fn applicable<'a>(&self, library: &'a [Effect]) -> Vec<(&'a Effect, Option<usize>)> {
        let bare = self.bare_definitions();
        let names: Vec<Symbol> = bare.iter().map(|(n, _)| n.clone()).collect();
        let open = |e: &Effect, t: Option<usize>| self.is_of_catalogue(e) || self.stays_open(&bare, e, t);
        let fits = |e: &Effect, t: Option<usize>| self.targets(e, t, &names).is_some() && open(e, t);
        let all = library.iter().flat_map(|e| e.trailers(self.trailer_count()).into_iter().map(move |t| (e, t)));
        all.filter(|(e, t)| fits(e, *t)).collect()
    }

    fn is_of_catalogue(&self, e: &Effect) -> bool {
        let known = crate::effects::named(&e.id).is_some() || e.id.starts_with(PREFIX);
        known && e.origin.is_none() && crate::vehicles::named(&self.vehicle.id).is_some()
    }
}
