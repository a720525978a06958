//! Formulas that the program derives from a vehicle, by name, for statements to speak of.

use crate::formula::{Expr, Normal, Scalar, Symbol};
use crate::mechanism::Definitions;
use crate::model::{Model, Trailer};
use crate::vehicles;
use crate::vehicles::Vehicle;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::{Arc, OnceLock};

/// Named formulas derived by the program; what they do not define is free.
///
/// | formulas | names |
/// |---|---|
/// | [`DerivedFormulas::of`] a vehicle | v_d, v_l, v_n, v_t, x', y', phi' of its equations of motion; r, a, L, rates and creeps are free |
/// | [`DerivedFormulas::train`] | the same with v_i, vt_i, phi_i' of trailers; d_i, c_i, e_tc_i are free |
/// | [`DerivedFormulas::with`] | any formula one adds: a row, a derivative |
#[derive(Clone, Debug, Default)]
pub struct DerivedFormulas {
    definitions: Definitions,
    /// The normal forms of all of them, worked out when first asked for: many statements are put to the same formulas.
    normal: Arc<OnceLock<BTreeMap<Symbol, Normal>>>,
}

impl DerivedFormulas {
    /// The equations of motion of a vehicle of the catalogue with every creep left free.
    ///
    /// An unknown vehicle defines nothing, so that every statement about it is undefined.
    pub fn of(vehicle: &str) -> Self {
        Self::train(vehicle, 0)
    }

    /// The same with trailers behind it.
    pub fn train(vehicle: &str, trailers: usize) -> Self {
        vehicles::named(vehicle).map_or_else(Self::default, |v| Self::of_vehicle(v, trailers))
    }

    /// The same of any vehicle; one whose constraints do not determine its motion defines nothing.
    ///
    /// ```
    /// use creepage::{claims::DerivedFormulas, extensions};
    /// let vehicles = extensions::vehicles_with_own("examples/bus/bus.toml").unwrap();
    /// let bus = vehicles.iter().find(|v| v.id == "articulated-bus").unwrap();
    /// assert!(DerivedFormulas::of_vehicle(bus, 0).formula("phi_1'").is_some());
    /// ```
    pub fn of_vehicle(vehicle: &Vehicle, trailers: usize) -> Self {
        let behind = vec![Trailer { length: 1.0, hitch: 0.0 }; trailers];
        Model::sample(vehicle).map_or_else(|_| Self::default(), |m| Self::of_model(&m.with_trailers(&behind)))
    }

    /// The equations of motion of a model, its effects included; parameters, inputs and creeps are free.
    pub fn of_model(model: &Model) -> Self {
        let creeps: BTreeSet<Symbol> = model.constraints().into_iter().map(|c| c.creep).collect();
        let mut definitions = Definitions::default();
        let Ok(found) = model.definitions() else { return Self::default() };
        for (name, formula) in found.iter() {
            let parameter = matches!(formula.node(), crate::formula::Node::Sym(_));
            let ideal = creeps.contains(name) && formula.is_zero();
            let chain = ["v_l", "v_t", "x'", "y'"].contains(&name.as_str());
            if chain || !(parameter || ideal) {
                definitions.define(name.clone(), formula.clone());
            }
        }
        Self { definitions, normal: Arc::default() }
    }

    /// With one more formula, in place of an older one of that name.
    pub fn with(mut self, name: &str, formula: Expr) -> Self {
        self.definitions.define(name, formula);
        self.normal = Arc::default();
        self
    }

    /// With a formula given as text; a malformed one is left out, so that what speaks of it is undefined.
    pub fn with_text(self, name: &str, formula: &str) -> Self {
        match Expr::parse(formula) {
            Ok(formula) => self.with(name, formula),
            Err(_) => self,
        }
    }

    /// With definitions forgotten, so that these names are free: what holds then holds whatever they are.
    pub fn freeing(self, names: &[&str]) -> Self {
        let mut definitions = Definitions::default();
        let kept = self.definitions.iter().filter(|(name, _)| !names.contains(&name.as_str()));
        kept.for_each(|(name, formula)| definitions.define(name.clone(), formula.clone()));
        Self { definitions, normal: Arc::default() }
    }

    /// The formula of a name.
    pub fn formula(&self, name: &str) -> Option<&Expr> {
        self.definitions.get(&name.into())
    }

    /// The formula of a name with everything it rests on written out, so that derivatives of it are total; zero for a
    /// name without one.
    pub fn written_out(&self, name: &str) -> Expr {
        self.put_into(self.formula(name).cloned().unwrap_or_default())
    }

    /// A formula with everything that is defined here written out.
    pub fn put_into(&self, mut e: Expr) -> Expr {
        // Definitions are a few deep; a chain ends when nothing is left to put in.
        for _ in 0..24 {
            let next = e.substitute(&|s| self.formula(s.as_str()).cloned());
            if next == e {
                break;
            }
            e = next;
        }
        e
    }

    /// Every value in normal form.
    pub(crate) fn normal(&self) -> &BTreeMap<Symbol, Normal> {
        self.normal.get_or_init(|| self.values(&|s| Normal::symbol(s.clone())))
    }

    /// Every value in a carrier; `free` gives those that are not derived.
    pub fn values<S: Scalar>(&self, free: &impl Fn(&Symbol) -> S) -> BTreeMap<Symbol, S> {
        let needed: BTreeSet<Symbol> = self.definitions.iter().flat_map(|(_, f)| f.symbols()).collect();
        let given: BTreeMap<Symbol, S> =
            needed.into_iter().filter(|s| self.definitions.get(s).is_none()).map(|s| (s.clone(), free(&s))).collect();
        let mut values = self.definitions.evaluate(&|s| given.get(s).cloned()).unwrap_or_default();
        values.extend(given);
        values
    }

    /// Every name that expressions come to, through the definitions.
    fn reached<'a>(&self, from: impl IntoIterator<Item = &'a Expr>) -> BTreeSet<Symbol> {
        let mut waiting: Vec<Symbol> = from.into_iter().flat_map(Expr::symbols).collect();
        let mut reached: BTreeSet<Symbol> = BTreeSet::new();
        while let Some(name) = waiting.pop() {
            if reached.insert(name.clone()) {
                waiting.extend(self.definitions.get(&name).into_iter().flat_map(Expr::symbols));
            }
        }
        reached
    }

    /// The definitions that expressions rest on, each after those it uses.
    pub(crate) fn under<'a>(&self, sides: impl IntoIterator<Item = &'a Expr>) -> Vec<(Symbol, Expr)> {
        let reached = self.reached(sides);
        let sorted = self.definitions.sorted().unwrap_or_default();
        sorted.into_iter().filter(|(name, _)| reached.contains(name)).cloned().collect()
    }

    /// The formulas that an expression rests on, itself included, and the free symbols it comes down to.
    pub fn rests_on(&self, e: &Expr) -> (Vec<Expr>, BTreeSet<Symbol>) {
        let (defined, free): (BTreeSet<Symbol>, BTreeSet<Symbol>) =
            self.reached([e]).into_iter().partition(|name| self.definitions.get(name).is_some());
        let formulas = defined.iter().filter_map(|name| self.definitions.get(name));
        (std::iter::once(e).chain(formulas).cloned().collect(), free)
    }
}
