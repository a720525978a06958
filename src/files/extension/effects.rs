//! Files of a user's own effects (TOML): definitions of a model, rewritten by formulas.

use super::effect_parameter::{read_parameter, read_unit};
use crate::effects::{Effect, PlainSentence, State};
use crate::error::Result;
use crate::files::toml::formula_text::FormulaText;
use crate::files::toml::location::Spot;
use crate::files::toml::spanned_table::{Section, Source, Value};
use crate::files::toml::suggestions::shown;
use crate::files::toml::user_file::{at_most, read_id, read_user_file};
use crate::formula::Symbol;
use crate::provenance::Origin;
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

/// The most effects of a file: `discover` fits each of them.
const MAX_EFFECTS: usize = 50;
/// The most parameters, states or changes of an effect: no data tell more of them apart.
const MAX_PARTS: usize = 12;
/// The most combinations of starts of one effect: each costs a pass over the data.
const MAX_STARTS: usize = 32;
/// Names that have another meaning: `it`, the definition before the change, and the keys of an entry of a model file.
const RESERVED: [&str; 3] = ["it", "id", "trailer"];

/// The effects of a file, read but not yet validated against the vehicles.
#[derive(Clone, Debug)]
pub struct EffectsFile {
    /// The effects, in the order of the file.
    pub effects: Vec<UserEffect>,
}

/// An effect and the places of its parts.
#[derive(Clone, Debug)]
pub struct UserEffect {
    /// The effect.
    pub effect: Effect,
    /// Where its id stands.
    pub id: Spot,
    /// Where each parameter and state is named.
    pub names: BTreeMap<String, Spot>,
    /// Where each input it needs stands.
    pub needs: Vec<Spot>,
    /// Where its limit stands.
    pub limit: Option<Spot>,
    /// Its changes: where the definition is named, and the formula.
    pub changes: BTreeMap<String, (Spot, FormulaText)>,
    /// The rates of its states.
    pub rates: BTreeMap<String, FormulaText>,
}

impl EffectsFile {
    /// Reads a file of effects.
    ///
    /// # Errors
    /// With file, line and column, inside a formula too: a file that cannot be read, a key that is missing or unknown,
    /// a formula that is malformed, a number that no fit can use, two effects of one name.
    pub fn read(path: &Path) -> Result<Self> {
        Self::parse(&read_user_file(path, "effects")?)
    }

    fn parse(origin: &Arc<Origin>) -> Result<Self> {
        let source = Source { path: &origin.path, text: &origin.text };
        let document = source.parse_as(
            "a file of effects holds [[effect]], lines like id = \"my-creep\", and below [effect.changes] lines like \
             \"phi'\" = \"it + bias\", where a name with ' or * stands in quotes",
        )?;
        let top = Section::top(source, &document);
        top.only(&["effect"])?;
        let example = "[[effect]], with double brackets, before each effect";
        let list = top.need("effect", example)?;
        let elements = list.list(example)?;
        at_most(&list, elements.len(), MAX_EFFECTS)?;
        let mut effects: Vec<UserEffect> = Vec::new();
        for element in elements {
            let own = read_effect(&element.section("[[effect]]".into())?, origin)?;
            if effects.iter().any(|e| e.effect.id == own.effect.id) {
                let error = own.id.error(format!("two effects are called \"{}\"", own.effect.id));
                return Err(error.help("give one another id"));
            }
            effects.push(own);
        }
        Ok(Self { effects })
    }
}

/// `sensor.a` is where the sensor sits.
const SENSOR: &str = "sensor";

fn read_effect(section: &Section, origin: &Arc<Origin>) -> Result<UserEffect> {
    section.only(&[
        "id",
        "where",
        "says",
        "plain",
        "source",
        "per_trailer",
        "per_contact",
        "basic",
        "walks",
        "needs",
        "limit",
        "parameters",
        "states",
        "changes",
    ])?;
    let text = |key: &str, example: &str| section.need(key, example)?.text().map(str::to_string);
    let id = section.need("id", "id = \"my-creep\"")?;
    let limit = section.get("limit");
    let mut own = UserEffect {
        effect: Effect {
            id: read_id(&id, "an effect", &[SENSOR])?,
            place: text("where", "where = \"traverse constraint\"")?,
            says: text("says", "says = \"what the vehicle really does\"")?,
            source: section.get("source").map(|v| v.text()).transpose()?.unwrap_or("the user's own").into(),
            per_trailer: section.get("per_trailer").map_or(Ok(false), |v| v.truth())?,
            per_contact: section.get("per_contact").map_or(Ok(false), |v| v.truth())?,
            basic: section.get("basic").map_or(Ok(false), |v| v.truth())?,
            walks: section.get("walks").map_or(Ok(false), |v| v.truth())?,
            limit: limit.as_ref().map(|v| v.text().map(str::to_string)).transpose()?,
            origin: Some(origin.clone()),
            ..Effect::default()
        },
        id: Spot::at(section.source, id.span().start),
        names: BTreeMap::new(),
        needs: vec![],
        limit: limit.map(|v| Spot::at(section.source, v.span().start)),
        changes: BTreeMap::new(),
        rates: BTreeMap::new(),
    };
    own.read_needs(section)?;
    own.read_parameters(section)?;
    own.read_states(section)?;
    own.read_changes(section)?;
    own.read_plain(section)?;
    own.check_use()?;
    Ok(own)
}

impl UserEffect {
    fn read_needs(&mut self, section: &Section) -> Result<()> {
        let Some(value) = section.get("needs") else { return Ok(()) };
        let list = value.list("needs = [\"yaw_rate\"]")?;
        at_most(&value, list.len(), MAX_PARTS)?;
        for role in list {
            self.effect.needs.push(role.text()?.to_string());
            self.needs.push(Spot::at(section.source, role.span().start));
        }
        Ok(())
    }

    fn read_parameters(&mut self, section: &Section) -> Result<()> {
        let value = section.need("parameters", "[effect.parameters.c] and below it unit, range and size")?;
        let entries = value.section("[effect.parameters]".into())?.entries();
        at_most(&value, entries.len(), MAX_PARTS)?;
        if entries.is_empty() {
            return Err(value.error("the effect has no parameter").help("write [effect.parameters.c] for one"));
        }
        for entry in entries {
            self.name(&entry)?;
            let parameter = read_parameter(&entry, &format!("[effect.parameters.{}]", entry.name))?;
            self.effect.parameters.insert(entry.name.clone(), parameter);
        }
        let combinations: usize = self.effect.parameters.values().map(|p| p.start.len()).product();
        match combinations <= MAX_STARTS {
            true => Ok(()),
            false => Err(value
                .error(format!("the starts of the parameters have {combinations} combinations"))
                .help(format!("leave at most {MAX_STARTS}; each costs a pass over the data"))),
        }
    }

    fn read_states(&mut self, section: &Section) -> Result<()> {
        let Some(value) = section.get("states") else { return Ok(()) };
        let entries = value.section("[effect.states]".into())?.entries();
        at_most(&value, entries.len(), MAX_PARTS)?;
        for entry in entries {
            self.name(&entry)?;
            let state = entry.section(format!("[effect.states.{}]", entry.name))?;
            state.only(&["unit", "rate"])?;
            let unit = read_unit(&state)?;
            let rate = FormulaText::read(&state.need("rate", "rate = \"(v_t - u)/tau\"")?)?;
            self.effect.states.insert(entry.name.clone(), State { unit, rate: rate.formula.clone() });
            self.rates.insert(entry.name.clone(), rate);
        }
        Ok(())
    }

    /// Takes down the name of a parameter or a state.
    fn name(&mut self, entry: &Value) -> Result<()> {
        let name = &entry.name;
        let identifier = name.starts_with(|c: char| c.is_ascii_alphabetic())
            && name.len() <= 60
            && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
            && !format!("{name}_").contains("__")
            && Symbol::new(name).is_well_formed();
        if !identifier || RESERVED.contains(&name.as_str()) {
            return Err(entry.key_error(format!("\"{}\" cannot name a parameter or a state", shown(name))).help(
                "begin with a letter, go on with letters, digits and _; functions, it, id and trailer are taken",
            ));
        }
        match self.names.insert(name.clone(), Spot::at(entry.source, entry.key_at)) {
            None => Ok(()),
            Some(_) => Err(entry
                .key_error(format!("{name} is both a parameter and a state"))
                .help("give one of them another name")),
        }
    }

    fn read_changes(&mut self, section: &Section) -> Result<()> {
        let example = "[effect.changes] and below it lines like v_t = \"it + c*v_l\"";
        let value = section.need("changes", example)?;
        let entries = value.section("[effect.changes]".into())?.entries();
        at_most(&value, entries.len(), MAX_PARTS)?;
        if entries.is_empty() {
            return Err(value.error("the effect changes nothing").help(format!("write {example}")));
        }
        for entry in entries {
            self.check_key(&entry)?;
            let formula = FormulaText::read(&entry)?;
            self.effect.changes.insert(entry.name.clone(), formula.formula.clone());
            self.changes.insert(entry.name.clone(), (Spot::at(entry.source, entry.key_at), formula));
        }
        let is_numbered = |key: &String| key.ends_with('*');
        if self.effect.per_contact && !self.effect.changes.keys().all(is_numbered) {
            return Err(value
                .error("the effect is per_contact, but changes a definition that no contact has")
                .help("end every name with *, such as \"built_force*\", or remove per_contact"));
        }
        match self.effect.per_trailer && !self.effect.changes.keys().any(|k| k.contains("{trailer}")) {
            false => Ok(()),
            true => Err(value
                .error("the effect is per_trailer, but changes the same on every trailer")
                .help("write {trailer} in a name, such as \"e_tc_{trailer}\", or remove per_trailer")),
        }
    }

    /// The sentence for anyone: of known names, and of an input or a trailer only where the effect has one.
    fn read_plain(&mut self, section: &Section) -> Result<()> {
        let Some(value) = section.get("plain") else { return Ok(()) };
        let plain = PlainSentence::parse(value.text()?).map_err(|e| {
            let error = value.error(format!("the sentence cannot be read: {}", e.message()));
            error.help("write {formula | unit} for a number, {formula ? words : words} for words that follow its sign")
        })?;
        let names: Vec<&str> = self.effect.parameters.keys().map(String::as_str).collect();
        if let Some(name) = plain.unknown(&names).first() {
            return Err(value
                .error(format!("the sentence has a {name}, which is no parameter of the effect"))
                .help(format!("it knows {}, speed and turning", names.join(", "))));
        }
        self.effect.plain = Some(plain);
        Ok(())
    }

    fn check_key(&self, entry: &Value) -> Result<()> {
        let numbered = entry.name.replace("{trailer}", "1");
        let stem = numbered.strip_suffix('*').unwrap_or(&numbered);
        if !Symbol::new(stem).is_well_formed() || entry.name.len() > 60 {
            return Err(entry
                .key_error(format!("\"{}\" is no name of a definition", shown(&entry.name)))
                .help("write a name such as v_t, \"phi'\", \"r*\" or, with per_trailer, \"d_{trailer}\""));
        }
        if numbered != entry.name && !self.effect.per_trailer {
            return Err(entry
                .key_error(format!("\"{}\" speaks of a trailer", entry.name))
                .help("write per_trailer = true below the id"));
        }
        Ok(())
    }

    /// Checks that every parameter and every state occurs in a change or in the rate of a state that does.
    fn check_use(&self) -> Result<()> {
        let mut used: Vec<Symbol> = self.effect.changes.values().flat_map(|f| f.symbols()).collect();
        let mut seen = 0;
        while seen < used.len() {
            let rate = self.effect.states.get(used[seen].as_str()).map(|s| s.rate.symbols());
            let new: Vec<Symbol> = rate.into_iter().flatten().filter(|s| !used.contains(s)).collect();
            used.extend(new);
            seen += 1;
        }
        let idle = self.names.iter().find(|(name, _)| !used.iter().any(|s| s.as_str() == name.as_str()));
        match idle {
            None => Ok(()),
            Some((name, spot)) => Err(spot
                .error(format!("{name} has no say in what the effect changes"))
                .help("use it in a formula below [effect.changes], or remove it")),
        }
    }
}
