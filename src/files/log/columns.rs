//! `[columns]`: which column of a log holds what.

use crate::error::{Error, Result};
use crate::files::model::known::KnownInput;
use crate::files::model::parameters::{Machine, one_per_trailer};
use crate::files::toml::spanned_table::{Section, Value};
use crate::files::toml::suggestions;
use std::collections::BTreeMap;

/// The columns of a model file; a role it leaves out is looked for under its own name.
#[derive(Clone, Debug, PartialEq)]
pub struct Columns {
    /// Time, s.
    pub time: String,
    /// Time in a file of measured poses of its own, s; `time` when the file names none.
    pub truth_time: Option<String>,
    /// Measured position along x, m.
    pub x: String,
    /// Measured position along y, m.
    pub y: String,
    /// Measured heading, rad, when the file names it; otherwise a column `heading` is used where there is one.
    pub heading: Option<String>,
    /// Measured absolute headings of the trailers, rad: one each, or none at all.
    pub trailer_headings: Vec<String>,
    /// The inputs, in the order of the catalogue.
    pub inputs: Vec<InputColumn>,
}

/// The column of one input.
#[derive(Clone, Debug, PartialEq)]
pub struct InputColumn {
    /// What it is, such as `wheel_rate`.
    pub role: String,
    /// Its name in the log.
    pub column: String,
    /// Another role, looked for under its own name where the log has no such `column`;
    /// only for a role the file does not name.
    pub instead: Option<String>,
}

/// Columns found in the header of a log, as indices from zero.
#[derive(Clone, Debug, PartialEq)]
pub struct Resolved {
    /// Time.
    pub time: usize,
    /// Measured position along x.
    pub x: usize,
    /// Measured position along y.
    pub y: usize,
    /// Measured heading, if the log has one.
    pub heading: Option<usize>,
    /// Measured headings of the trailers.
    pub trailer_headings: Vec<usize>,
    /// The inputs, in the order of [`Columns::inputs`].
    pub inputs: Vec<ResolvedInput>,
}

/// An input found in a log.
#[derive(Clone, Debug, PartialEq)]
pub struct ResolvedInput {
    /// What it is: the role of the model file, or the one that stands for it.
    pub role: String,
    /// Its place in the header, from zero.
    pub index: usize,
}

impl Columns {
    pub(crate) fn read(top: &Section, machine: &Machine, trailers: usize, forced: &[String]) -> Result<Self> {
        let section = top.section("columns")?;
        let inputs: Vec<&KnownInput> = machine.parts().flat_map(|v| &v.inputs).collect();
        if let Some(section) = &section {
            let mut keys = keys(&inputs, trailers > 0);
            keys.extend(forced.iter().map(String::as_str));
            section.only(&keys)?;
        }
        let get = |role: &str| section.as_ref().and_then(|s| s.get(role));
        let name = |role: &str| get(role).map_or(Ok(role), |v| v.text()).map(str::to_string);
        let columns = Self {
            time: name("time")?,
            truth_time: get("truth_time").map(|v| v.text().map(str::to_string)).transpose()?,
            x: name("x")?,
            y: name("y")?,
            heading: get("heading").map(|v| v.text().map(str::to_string)).transpose()?,
            trailer_headings: get("trailer_headings").map_or(Ok(Vec::new()), |v| trailer_headings(&v, trailers))?,
            inputs: inputs.iter().map(|known| input(known, &get)).collect::<Result<_>>()?,
        };
        columns.distinct(top, section.as_ref())?;
        Ok(columns)
    }

    /// Finds the columns in the header of a log; errors do not know the file yet.
    pub fn resolve(&self, header: &[String]) -> Result<Resolved> {
        let inputs = self.inputs.iter().map(|input| resolve_input(header, input));
        let pose = self.resolve_pose(header, "time", &self.time)?;
        Ok(Resolved { inputs: inputs.collect::<Result<_>>()?, ..pose })
    }

    /// Finds the time and the pose in the header of a file that need not hold inputs.
    pub fn resolve_truth(&self, header: &[String]) -> Result<Resolved> {
        match &self.truth_time {
            Some(column) => self.resolve_pose(header, "truth_time", column),
            None => self.resolve_pose(header, "time", &self.time),
        }
    }

    fn resolve_pose(&self, header: &[String], role: &str, time: &str) -> Result<Resolved> {
        let find = |role: &str, column: &str| find(header, role, column);
        Ok(Resolved {
            time: find(role, time)?,
            x: find("x", &self.x)?,
            y: find("y", &self.y)?,
            heading: match &self.heading {
                Some(column) => Some(find("heading", column)?),
                None if header.iter().any(|name| name == "heading") => Some(find("heading", "heading")?),
                None => None,
            },
            trailer_headings: self
                .trailer_headings
                .iter()
                .map(|c| find("trailer_headings", c))
                .collect::<Result<_>>()?,
            inputs: vec![],
        })
    }

    /// Finds time and inputs in the header of a file that need not hold a pose; errors do not know the file yet.
    pub fn resolve_inputs(&self, header: &[String]) -> Result<(usize, Vec<ResolvedInput>)> {
        let inputs = self.inputs.iter().map(|input| resolve_input(header, input));
        Ok((find(header, "time", &self.time)?, inputs.collect::<Result<_>>()?))
    }

    /// One column read as two quantities is a slip of the pen.
    fn distinct(&self, top: &Section, section: Option<&Section>) -> Result<()> {
        let mut seen: BTreeMap<&str, &str> = BTreeMap::new();
        for (role, column) in self.pairs() {
            if let Some(other) = seen.insert(column, role) {
                let value = section.and_then(|s| s.get(role).or_else(|| s.get(other)));
                let message = format!("{other} and {role} are both read from column \"{column}\"");
                let error = value.map_or_else(|| top.error(&message), |v| v.error(&message));
                return Err(error.help("give each its own column under [columns]"));
            }
        }
        Ok(())
    }

    fn pairs(&self) -> impl Iterator<Item = (&str, &str)> {
        let pose = [("time", &self.time), ("x", &self.x), ("y", &self.y)].into_iter();
        let heading = self.heading.iter().map(|c| ("heading", c));
        let trailers = self.trailer_headings.iter().map(|c| ("trailer_headings", c));
        let inputs = self.inputs.iter().map(|i| (i.role.as_str(), &i.column));
        pose.chain(heading).chain(trailers).chain(inputs).map(|(role, column)| (role, column.as_str()))
    }
}

fn keys<'a>(inputs: &[&'a KnownInput], trailers: bool) -> Vec<&'a str> {
    let mut keys = vec!["time", "truth_time", "x", "y", "heading"];
    keys.extend(trailers.then_some("trailer_headings"));
    keys.extend(inputs.iter().flat_map(|i| std::iter::once(&i.role).chain(&i.instead)).map(String::as_str));
    keys
}

fn trailer_headings(value: &Value, trailers: usize) -> Result<Vec<String>> {
    let names = value.list("trailer_headings = [\"phi_1\"]")?;
    one_per_trailer(value, names.len(), trailers)?;
    names.iter().map(|name| name.text().map(str::to_string)).collect()
}

fn input<'a: 'd, 'd>(known: &KnownInput, get: &impl Fn(&str) -> Option<Value<'a, 'd>>) -> Result<InputColumn> {
    let other = known.instead.as_deref().and_then(get);
    let (role, column, instead) = match (get(&known.role), other) {
        (Some(value), Some(other)) => {
            let message = format!("{} and {} are both named, but one drives the vehicle", value.name, other.name);
            return Err(other.source.error(other.key_at, message).help("remove one of the two"));
        }
        (Some(value), None) | (None, Some(value)) => (value.name.clone(), value.text()?.to_string(), None),
        (None, None) => (known.role.clone(), known.role.clone(), known.instead.clone()),
    };
    Ok(InputColumn { role, column, instead })
}

fn resolve_input(header: &[String], input: &InputColumn) -> Result<ResolvedInput> {
    let there = |column: &String| header.contains(column);
    let stands_in = input.instead.as_ref().filter(|instead| !there(&input.column) && there(instead));
    let (role, column) = stands_in.map_or((&input.role, &input.column), |instead| (instead, instead));
    let index = find(header, role, column).map_err(|error| match &input.instead {
        Some(instead) if !there(column) => missing(header, role, column, Some(instead.as_str())),
        _ => error,
    })?;
    Ok(ResolvedInput { role: role.clone(), index })
}

/// The only place of a column in the header.
fn find(header: &[String], role: &str, column: &str) -> Result<usize> {
    let mut places = header.iter().enumerate().filter(|(_, name)| *name == column).map(|(i, _)| i);
    match (places.next(), places.next()) {
        (Some(index), None) => Ok(index),
        (Some(first), Some(second)) => Err(Error::input(format!(
            "column \"{column}\" stands twice in the header, as cell {} and cell {}",
            first + 1,
            second + 1
        ))
        .help("rename or remove one of them")),
        (None, _) => Err(missing(header, role, column, None)),
    }
}

fn missing(header: &[String], role: &str, column: &str, instead: Option<&str>) -> Error {
    let names: Vec<&str> = header.iter().map(String::as_str).collect();
    let advice = suggestions::advice(column, "the file has", &names);
    let or = instead.map(|other| format!(" or \"{other}\"")).unwrap_or_default();
    let purpose = if role == column { String::new() } else { format!(" for {role}") };
    let error = Error::input(format!("column \"{column}\"{or}{purpose} is missing"));
    if !names.is_empty() && names.iter().all(|name| name.parse::<f64>().is_ok()) {
        return error.help("the first line must hold the names of the columns, but it holds numbers");
    }
    error.help(format!("{advice}; name the right one under [columns] of the model file: {role} = \"…\""))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn columns() -> Columns {
        let drive =
            InputColumn { role: "wheel_rate".into(), column: "wheel_rate".into(), instead: Some("speed".into()) };
        Columns {
            time: "t".into(),
            truth_time: None,
            x: "x".into(),
            y: "y".into(),
            heading: None,
            trailer_headings: vec!["phi_1".into()],
            inputs: vec![drive],
        }
    }

    fn resolve(columns: &Columns, header: &str) -> Result<Resolved> {
        columns.resolve(&header.split(',').map(str::to_string).collect::<Vec<_>>())
    }

    #[test]
    fn the_header_decides_what_was_left_out() {
        let found = resolve(&columns(), "speed,t,x,y,phi_1").unwrap();
        assert_eq!((found.heading, found.inputs[0].role.as_str(), found.inputs[0].index), (None, "speed", 0));
        let found = resolve(&columns(), "speed,t,x,y,phi_1,wheel_rate,heading").unwrap();
        assert_eq!((found.heading, found.inputs[0].role.as_str(), found.inputs[0].index), (Some(6), "wheel_rate", 5));
        assert_eq!((found.time, found.x, found.y, found.trailer_headings), (1, 2, 3, vec![4]));
    }

    #[test]
    fn a_named_column_must_be_there_once() {
        let named = Columns { heading: Some("phi".into()), ..columns() };
        let error = resolve(&named, "t,x,y,phi_1,speed,Phi").unwrap_err().to_string();
        assert!(error.contains("\"phi\" for heading is missing; did you mean \"Phi\"?"), "{error}");
        let error = resolve(&columns(), "t,x,y,phi_1,x,speed").unwrap_err().to_string();
        assert!(error.contains("\"x\" stands twice in the header, as cell 2 and cell 5"), "{error}");
        let error = resolve(&columns(), "0,1,2,3,4,5").unwrap_err().to_string();
        assert!(error.contains("holds numbers"), "{error}");
        assert!(resolve(&columns(), "t,x,y,a,a,phi_1,speed").is_ok(), "columns not used may repeat");
    }
}
