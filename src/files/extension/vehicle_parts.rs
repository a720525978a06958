//! `[[vehicle.wheels]]` and `[[vehicle.trailers]]`: the parts of a vehicle with their lengths and symbols.

use super::user_vehicle::{UserPart, UserVehicle};
use super::vehicle_quantities::check_symbol;
use crate::error::Result;
use crate::files::toml::formula_text::FormulaText;
use crate::files::toml::location::Spot;
use crate::files::toml::spanned_table::{Section, Value};
use crate::files::toml::suggestions;
use crate::files::toml::user_file::at_most;
use crate::formula::{Expr, Size, Symbol};
use crate::vehicles::{Section as Trailer, Wheel};
use std::collections::BTreeMap;

/// The most wheels of a vehicle: each is a constraint or two, which are solved as formulas.
const MAX_WHEELS: usize = 40;
/// The most trailers of a vehicle: the formulas of their rates grow with each.
const MAX_TRAILERS: usize = 6;
/// The most factors in a product of a length: constraints are multiplied out, and their terms grow with every factor.
const MAX_FACTORS: usize = 6;
/// What to do about a bare number.
const NEEDS_UNIT: &str = "declare a parameter in m, as in [vehicle.parameters.wheelbase], and write a formula of such";

const KEYS: [&str; 11] = [
    "name",
    "on",
    "forward",
    "left",
    "steering",
    "trail",
    "roller",
    "radius",
    "rate",
    "rotation_creep",
    "traverse_creep",
];
/// A tangent of more than this is that of a right angle.
const RIGHT: f64 = 1e6;

/// A part that is being read.
struct Reader<'s, 'a, 'd> {
    section: &'s Section<'a, 'd>,
    part: UserPart,
}

impl<'s, 'a, 'd> Reader<'s, 'a, 'd> {
    fn new(section: &'s Section<'a, 'd>, example: &str) -> Result<(Self, String)> {
        let name = section.need("name", example)?;
        let spot = Spot::at(section.source, name.span().start);
        let part = UserPart { name: spot, lengths: BTreeMap::new(), symbols: BTreeMap::new() };
        Ok((Self { section, part }, name.text()?.to_string()))
    }

    /// A length; zero when left out.
    fn length(&mut self, key: &'static str) -> Result<Expr> {
        match self.section.get(key) {
            None => Ok(Expr::int(0)),
            Some(value) => self.keep(key, &value),
        }
    }

    /// The angle of rollers, if it is there.
    fn roller(&mut self) -> Result<Option<Expr>> {
        let Some(value) = self.section.get("roller") else { return Ok(None) };
        if value.is_number() {
            return Err(value
                .error("roller is a number without a unit")
                .help("write a formula of an angle in rad: \"pi/4\""));
        }
        let angle = self.keep("roller", &value)?;
        if crate::mechanism::tangent(&angle).eval(&|_| f64::NAN).is_some_and(|t| t.abs() > RIGHT) {
            let error = value.error("a wheel with its rollers across it drives nothing");
            return Err(
                error.help("roller is the angle from the wheel's heading to the axis of the roller on the ground")
            );
        }
        Ok(Some(angle))
    }

    fn keep(&mut self, key: &'static str, value: &Value) -> Result<Expr> {
        if value.is_number() {
            return Err(value.error(format!("{key} is a number without a unit")).help(NEEDS_UNIT));
        }
        let text = FormulaText::read(value)?;
        let formula = text.formula.clone();
        if Size::of(&formula, &|_| Size::SYMBOL).degree > MAX_FACTORS {
            let error = text.error(format!("a length has a product of more than {MAX_FACTORS} factors"));
            return Err(error.help("define a symbol for a part of it"));
        }
        self.part.lengths.insert(key, text);
        Ok(formula)
    }

    /// A symbol, if it is there; `rate` says whether it must be a rate.
    fn symbol(&mut self, key: &'static str, rate: bool) -> Result<Option<Symbol>> {
        let Some(value) = self.section.get(key) else { return Ok(None) };
        let name = value.text()?;
        check_symbol(&value, name)?;
        if name.ends_with('\'') != rate {
            let message = match rate {
                true => format!("{key} = \"{name}\" is no rate"),
                false => format!("{key} = \"{name}\" is a rate"),
            };
            let example = if rate { "theta'" } else { name.trim_end_matches('\'') };
            return Err(value.error(message).help(format!("write a symbol such as \"{example}\"")));
        }
        self.part.symbols.insert(key, Spot::at(value.source, value.span().start));
        Ok(Some(Symbol::new(name)))
    }
}

/// Reads the trailers.
pub(crate) fn read_trailers(own: &mut UserVehicle, section: &Section) -> Result<()> {
    let Some(value) = section.get("trailers") else { return Ok(()) };
    let list = value.list("[[vehicle.trailers]], with double brackets, before each trailer")?;
    at_most(&value, list.len(), MAX_TRAILERS)?;
    for element in list {
        let table = element.section("[[vehicle.trailers]]".into())?;
        table.only(&["name", "length", "hitch"])?;
        let (mut reader, name) = Reader::new(&table, "name = \"rear section\"")?;
        let length = table.need("length", "length = \"d\", from the hitch back to the axle")?;
        let trailer = Trailer { name, length: reader.keep("length", &length)?, hitch: reader.length("hitch")? };
        if own.vehicle.trailers.iter().any(|t| t.name == trailer.name) {
            return Err(twice(&reader.part, "trailers", &trailer.name));
        }
        if own.vehicle.line {
            return Err(reader.part.name.error("a vehicle on a line has no trailer").help("remove it, or line = true"));
        }
        if !own.vehicle.coordinates.is_empty() {
            let error = reader.part.name.error("a vehicle with coordinates of its own has no trailer");
            return Err(error.help("remove it, or write the constraint of its axle"));
        }
        own.vehicle.trailers.push(trailer);
        own.trailers.push(reader.part);
    }
    Ok(())
}

/// Reads the wheels.
pub(crate) fn read_wheels(own: &mut UserVehicle, section: &Section) -> Result<()> {
    let example = "[[vehicle.wheels]], with double brackets, before each wheel";
    let value = match section.get("wheels") {
        None if !own.vehicle.constraints.is_empty() => return Ok(()),
        _ => section.need("wheels", example)?,
    };
    let list = value.list(example)?;
    at_most(&value, list.len(), MAX_WHEELS)?;
    if list.is_empty() {
        return Err(value.error("the vehicle has no wheel").help(format!("write {example}")));
    }
    for element in list {
        let (wheel, part) = read_new_wheel(&element.section("[[vehicle.wheels]]".into())?, own)?;
        own.vehicle.wheels.push(wheel);
        own.wheels.push(part);
    }
    Ok(())
}

/// Reads the wheels that only follow.
pub(crate) fn read_followers(own: &mut UserVehicle, section: &Section) -> Result<()> {
    let Some(value) = section.get("followers") else { return Ok(()) };
    let list = value.list("[[vehicle.followers]], with double brackets, before each wheel that follows")?;
    at_most(&value, list.len(), MAX_WHEELS)?;
    if !own.vehicle.coordinates.is_empty() {
        let error = value.error("a vehicle with coordinates of its own has no wheel that follows");
        return Err(error.help("remove it, or write its constraint"));
    }
    for element in list {
        let (wheel, part) = read_new_wheel(&element.section("[[vehicle.followers]]".into())?, own)?;
        own.vehicle.followers.push(wheel);
        own.followers.push(part);
    }
    Ok(())
}

/// A wheel that has a name of its own and does something.
fn read_new_wheel(table: &Section, own: &UserVehicle) -> Result<(Wheel, UserPart)> {
    let (wheel, part) = read_wheel(table, own)?;
    if own.vehicle.all_wheels().any(|w| w.name == wheel.name) {
        return Err(twice(&part, "wheels", &wheel.name));
    }
    check_roles(&wheel, &part)?;
    Ok((wheel, part))
}

fn twice(part: &UserPart, what: &str, name: &str) -> crate::Error {
    part.name.error(format!("two {what} are called \"{}\"", suggestions::shown(name))).help("give one another name")
}

fn read_wheel(table: &Section, own: &UserVehicle) -> Result<(Wheel, UserPart)> {
    table.only(&KEYS)?;
    let (mut reader, name) = Reader::new(table, "name = \"front axle\"")?;
    let wheel = Wheel {
        name,
        on: table.get("on").map(|v| read_on(&v, own)).transpose()?,
        forward: reader.length("forward")?,
        left: reader.length("left")?,
        steering: reader.symbol("steering", false)?,
        trail: reader.length("trail")?,
        roller: reader.roller()?,
        radius: reader.symbol("radius", false)?,
        rate: reader.symbol("rate", true)?,
        rotation_creep: reader.symbol("rotation_creep", false)?,
        traverse_creep: reader.symbol("traverse_creep", false)?,
    };
    Ok((wheel, reader.part))
}

fn read_on(value: &Value, own: &UserVehicle) -> Result<String> {
    let name = value.text()?;
    let names: Vec<&str> = own.vehicle.trailers.iter().map(|t| t.name.as_str()).collect();
    match names.contains(&name) {
        true => Ok(name.to_string()),
        false => Err(value
            .error(format!("no trailer of the vehicle is called \"{}\"", suggestions::shown(name)))
            .help(suggestions::advice(name, "trailers", &names))),
    }
}

/// Checks that a wheel rolls, has a direction, or both, with all the keys that this takes.
fn check_roles(wheel: &Wheel, part: &UserPart) -> Result<()> {
    let rolling = [
        ("radius", wheel.radius.is_some(), "radius = \"r\""),
        ("rate", wheel.rate.is_some(), "rate = \"theta'\""),
        ("rotation_creep", wheel.rotation_creep.is_some(), "rotation_creep = \"e_rc\""),
    ];
    let (there, missing): (Vec<_>, Vec<_>) = rolling.into_iter().partition(|(_, is_there, _)| *is_there);
    if let (Some((key, ..)), Some((lacks, _, example))) = (there.first(), missing.first()) {
        let error =
            part.name.error(format!("the wheel \"{}\" has a {key} but no {lacks}", suggestions::shown(&wheel.name)));
        return Err(error.help(format!("a wheel that rolls has radius, rate and rotation_creep: write {example}")));
    }
    let slides = wheel.roller.is_some();
    if slides && (there.is_empty() || wheel.traverse_creep.is_some()) {
        let what = if there.is_empty() { "does not roll" } else { "keeps a direction" };
        let name = suggestions::shown(&wheel.name);
        let error = part.name.error(format!("the wheel \"{name}\" has rollers, but it {what}"));
        return Err(error.help("a wheel with rollers has radius, rate and rotation_creep, and no traverse_creep"));
    }
    if there.is_empty() && wheel.traverse_creep.is_none() {
        let error = part.name.error(format!("the wheel \"{}\" constrains nothing", suggestions::shown(&wheel.name)));
        return Err(error.help(
            "write radius, rate and rotation_creep for one that rolls, traverse_creep for one that keeps a direction",
        ));
    }
    Ok(())
}
