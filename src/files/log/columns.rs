//! `[columns]`: which column of a log holds what.

use super::cells::Cells;
use super::column_entry::{self, ColumnEntry, Kind, Reading};
use super::unit::Dimension;
use crate::error::Result;
use crate::files::model::known::KnownInput;
use crate::files::model::measured::MeasuredEntry;
use crate::files::model::parameters::{Machine, one_per_trailer};
use crate::files::toml::spanned_table::{Section, Value};
use std::collections::BTreeMap;
use std::f64::consts::PI;

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
    /// What is measured beside the pose: its key among `entries`.
    pub measured: Vec<String>,
    /// The inputs, in the order of the catalogue.
    pub inputs: Vec<InputColumn>,
    /// How roles are read of which the file says more than a name; trailers are `trailer_headings[1]` and so on.
    pub entries: BTreeMap<String, ColumnEntry>,
    /// `x` and `y` name longitude and latitude in degrees.
    pub geographic: bool,
    /// The vehicle moves along a line and the file names no `y`: a log may lack it, and the heading.
    pub on_line: bool,
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

/// Columns found in the header of a log.
#[derive(Clone, Debug, PartialEq)]
pub struct Resolved {
    /// Time.
    pub time: Cells,
    /// Measured position along x.
    pub x: Cells,
    /// Measured position along y; none in a log of a vehicle on a line that has no such column.
    pub y: Option<Cells>,
    /// `x` and `y` are longitude and latitude.
    pub geographic: bool,
    /// Measured heading, if the log has one.
    pub heading: Option<Cells>,
    /// Measured headings of the trailers.
    pub trailer_headings: Vec<Cells>,
    /// What is measured beside the pose.
    pub measured: Vec<Cells>,
    /// Standard deviations of x, y and heading, where the log has them.
    pub deviations: [Option<Cells>; 3],
    /// The inputs, in the order of [`Columns::inputs`].
    pub inputs: Vec<ResolvedInput>,
}

/// An input found in a log.
#[derive(Clone, Debug, PartialEq)]
pub struct ResolvedInput {
    /// What it is: the role of the model file, or the one that stands for it.
    pub role: String,
    /// Its place in the header.
    pub cells: Cells,
}

/// Roles of the standard deviations of a measured pose.
const DEVIATIONS: [&str; 3] = ["sigma_x", "sigma_y", "sigma_heading"];

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
        let mut entries = BTreeMap::new();
        let mut named = |role: &str, dimension| get(role).map(|v| entry(&v, dimension, &mut entries)).transpose();
        let time = named("time", Some(Dimension::Time))?;
        let truth_time = named("truth_time", Some(Dimension::Time))?;
        let (mut x, mut y) = (named("x", Some(Dimension::Length))?, named("y", Some(Dimension::Length))?);
        let heading = named("heading", Some(Dimension::Angle))?;
        for (role, dimension) in DEVIATIONS.iter().zip([Dimension::Length, Dimension::Length, Dimension::Angle]) {
            if let Some(value) = get(role) {
                let found = column_entry::read(&value, Some(dimension))?;
                let Reading { kind, scale, offset } = found.reading;
                if kind != Kind::Number || offset != 0.0 || scale <= 0.0 {
                    return Err(value
                        .error(format!("{role} takes a column and its unit alone"))
                        .help(format!("write {role} = {{ column = \"…\", unit = \"…\" }}")));
                }
                entries.insert((*role).to_string(), found);
            }
        }
        let on_line = machine.vehicle.line && y.is_none();
        let position = get("position").map(|v| position(&v, [&x, &y])).transpose()?;
        let geographic = position.is_some();
        if let Some([latitude, longitude]) = position {
            (x, y) = (Some(longitude), Some(latitude));
        }
        let trailer_headings =
            get("trailer_headings").map_or(Ok(Vec::new()), |v| trailer_headings(&v, trailers, &mut entries))?;
        let columns = Self {
            time: time.unwrap_or_else(|| "time".into()),
            truth_time,
            x: x.unwrap_or_else(|| "x".into()),
            y: y.unwrap_or_else(|| "y".into()),
            heading,
            trailer_headings,
            measured: vec![],
            inputs: inputs.iter().map(|known| input(known, &get, &mut entries)).collect::<Result<_>>()?,
            entries,
            geographic,
            on_line: on_line && !geographic,
        };
        columns.distinct(top, section.as_ref())?;
        Ok(columns)
    }

    /// Adds what is measured beside the pose.
    pub(crate) fn measure(&mut self, top: &Section, measured: &[MeasuredEntry]) -> Result<()> {
        for entry in measured {
            let column = &entry.column.columns[0];
            if let Some((other, _)) = self.pairs().find(|(_, name)| name == column) {
                let (line, at) = entry.place;
                let message = format!("{other} and {} are both read from column \"{column}\"", entry.role());
                let error = top.error(message).moved_to(line, at);
                return Err(error.help("give each its own column under [columns] and [measured]"));
            }
            self.measured.push(entry.role());
            self.entries.insert(entry.role(), entry.column.clone());
        }
        Ok(())
    }

    /// Finds the columns in the header of a log; errors do not know the file yet.
    pub fn resolve(&self, header: &[String]) -> Result<Resolved> {
        let pose = self.resolve_pose(header, "time", &self.time)?;
        Ok(Resolved { inputs: self.resolve_driven(header)?, ..pose })
    }

    /// Finds the time and the pose in the header of a file that need not hold inputs.
    pub fn resolve_truth(&self, header: &[String]) -> Result<Resolved> {
        match &self.truth_time {
            Some(column) => self.resolve_pose(header, "truth_time", column),
            None => self.resolve_pose(header, "time", &self.time),
        }
    }

    fn resolve_pose(&self, header: &[String], role: &str, time: &str) -> Result<Resolved> {
        let find = |role: &str, column: &str| self.cells(header, role, column);
        let place = |role: &str, column: &str| match self.geographic {
            true => Ok(Cells { reading: DEGREES, ..find(role, column)? }),
            false => find(role, column),
        };
        let angle = |role: &str, column: &str| Ok(Cells { wraps: true, ..find(role, column)? });
        let heading = match &self.heading {
            Some(column) => Some(angle("heading", column)?),
            None if header.iter().any(|name| name == "heading") => Some(angle("heading", "heading")?),
            None => None,
        };
        let trailer = |(i, column): (usize, &String)| angle(&format!("trailer_headings[{}]", i + 1), column);
        let lacks_y = self.on_line && !header.contains(&self.y);
        let deviation = |role: &str| self.entries.get(role).map(|e| find(role, &e.columns[0])).transpose();
        Ok(Resolved {
            time: self.time_cells(header, role, time)?,
            x: place("x", &self.x)?,
            y: (!lacks_y).then(|| place("y", &self.y)).transpose()?,
            geographic: self.geographic,
            heading,
            trailer_headings: self.trailer_headings.iter().enumerate().map(trailer).collect::<Result<_>>()?,
            measured: self
                .measured
                .iter()
                .map(|role| find(role, &self.entries[role].columns[0]))
                .collect::<Result<_>>()?,
            deviations: [deviation(DEVIATIONS[0])?, deviation(DEVIATIONS[1])?, deviation(DEVIATIONS[2])?],
            inputs: vec![],
        })
    }

    /// Finds time and inputs in the header of a file that need not hold a pose; errors do not know the file yet.
    pub fn resolve_inputs(&self, header: &[String]) -> Result<(Cells, Vec<ResolvedInput>)> {
        Ok((self.time_cells(header, "time", &self.time)?, self.resolve_driven(header)?))
    }

    fn resolve_driven(&self, header: &[String]) -> Result<Vec<ResolvedInput>> {
        self.inputs.iter().map(|input| self.resolve_input(header, input)).collect()
    }

    fn time_cells(&self, header: &[String], role: &str, column: &str) -> Result<Cells> {
        let found = self.cells(header, role, column)?;
        let plain = found.reading.kind == Kind::Number;
        Ok(if plain { Cells { reading: Reading::plain(Kind::Time), ..found } } else { found })
    }

    /// The cells of a role.
    fn cells(&self, header: &[String], role: &str, column: &str) -> Result<Cells> {
        Cells::find(header, role, column, self.entries.get(role))
    }

    fn resolve_input(&self, header: &[String], input: &InputColumn) -> Result<ResolvedInput> {
        let there = |column: &String| header.contains(column);
        let stands_in = input.instead.as_ref().filter(|instead| !there(&input.column) && there(instead));
        let (role, column) = stands_in.map_or((&input.role, &input.column), |instead| (instead, instead));
        let cells = self.cells(header, role, column).map_err(|error| match &input.instead {
            Some(instead) if !there(column) => super::cells::missing(header, role, column, Some(instead.as_str())),
            _ => error,
        })?;
        Ok(ResolvedInput { role: role.clone(), cells })
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
        let measured = self.measured.iter().map(|role| (role.as_str(), &self.entries[role].columns[0]));
        let first = pose.chain(heading).chain(trailers).chain(measured).chain(inputs);
        let more = self.entries.iter().filter(|(role, _)| *role != "truth_time");
        let more = more.flat_map(|(role, entry)| entry.columns.iter().skip(1).map(move |c| (role.as_str(), c)));
        first.chain(more).map(|(role, column)| (role, column.as_str()))
    }
}

/// Degrees of latitude and longitude.
const DEGREES: Reading = Reading { kind: Kind::Number, scale: PI / 180.0, offset: 0.0 };

impl Resolved {
    /// What a row needs, in the order in which a run takes it.
    pub(crate) fn needed(&self) -> Vec<&Cells> {
        let mut needed = vec![&self.time];
        needed.extend(self.pose());
        needed.extend(self.inputs.iter().map(|input| &input.cells));
        needed
    }

    /// The cells of the pose.
    pub(crate) fn pose(&self) -> Vec<&Cells> {
        let mut pose = vec![&self.x];
        pose.extend(&self.y);
        pose.extend(&self.heading);
        pose.extend(&self.trailer_headings);
        pose.extend(&self.measured);
        pose
    }

    /// What a row may lack.
    pub(crate) fn spare(&self) -> Vec<&Cells> {
        self.deviations.iter().flatten().collect()
    }

    /// Time and inputs.
    pub(crate) fn driven(&self) -> Vec<&Cells> {
        std::iter::once(&self.time).chain(self.inputs.iter().map(|input| &input.cells)).collect()
    }
}

/// The main column of a role; what else the file says of it is kept.
pub(crate) fn entry(
    value: &Value,
    dimension: Option<Dimension>,
    entries: &mut BTreeMap<String, ColumnEntry>,
) -> Result<String> {
    let found = column_entry::read(value, dimension)?;
    let main = found.columns[0].clone();
    if !matches!(found.reading, Reading { kind: Kind::Number | Kind::Time, scale: 1.0, offset: 0.0 }) {
        entries.insert(value.name.clone(), found);
    }
    Ok(main)
}

fn position(value: &Value, places: [&Option<String>; 2]) -> Result<[String; 2]> {
    match places.iter().any(|p| p.is_some()) {
        true => Err(value
            .key_error("position stands in place of x and y, and one of them is named too")
            .help("remove x and y")),
        false => column_entry::position(value),
    }
}

fn keys<'a>(inputs: &[&'a KnownInput], trailers: bool) -> Vec<&'a str> {
    let mut keys = vec!["time", "truth_time", "x", "y", "position", "heading"];
    keys.extend(DEVIATIONS);
    keys.extend(trailers.then_some("trailer_headings"));
    keys.extend(inputs.iter().flat_map(|i| std::iter::once(&i.role).chain(&i.instead)).map(String::as_str));
    keys
}

fn trailer_headings(
    value: &Value,
    trailers: usize,
    entries: &mut BTreeMap<String, ColumnEntry>,
) -> Result<Vec<String>> {
    let names = value.list("trailer_headings = [\"phi_1\"]")?;
    one_per_trailer(value, names.len(), trailers)?;
    names.iter().map(|name| entry(name, Some(Dimension::Angle), entries)).collect()
}

fn input<'a: 'd, 'd>(
    known: &KnownInput,
    get: &impl Fn(&str) -> Option<Value<'a, 'd>>,
    entries: &mut BTreeMap<String, ColumnEntry>,
) -> Result<InputColumn> {
    let other = known.instead.as_deref().and_then(get);
    let (value, unit) = match (get(&known.role), other) {
        (Some(value), Some(other)) => {
            let message = format!("{} and {} are both named, but one drives the vehicle", value.name, other.name);
            return Err(other.source.error(other.key_at, message).help("remove one of the two"));
        }
        (Some(value), None) => (value, &known.unit),
        (None, Some(value)) => (value, &known.instead_unit),
        (None, None) => {
            let role = known.role.clone();
            return Ok(InputColumn { column: role.clone(), role, instead: known.instead.clone() });
        }
    };
    let column = entry(&value, Dimension::of_si(unit), entries)?;
    Ok(InputColumn { role: value.name.clone(), column, instead: None })
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
            measured: vec![],
            inputs: vec![drive],
            entries: BTreeMap::new(),
            geographic: false,
            on_line: false,
        }
    }

    fn resolve(columns: &Columns, header: &str) -> Result<Resolved> {
        columns.resolve(&header.split(',').map(str::to_string).collect::<Vec<_>>())
    }

    #[test]
    fn the_header_decides_what_was_left_out() {
        let found = resolve(&columns(), "speed,t,x,y,phi_1").unwrap();
        assert_eq!(
            (
                found.heading.clone().map(|h| h.places[0]),
                found.inputs[0].role.as_str(),
                found.inputs[0].cells.places[0]
            ),
            (None, "speed", 0)
        );
        let found = resolve(&columns(), "speed,t,x,y,phi_1,wheel_rate,heading").unwrap();
        assert_eq!(
            (
                found.heading.clone().map(|h| h.places[0]),
                found.inputs[0].role.as_str(),
                found.inputs[0].cells.places[0]
            ),
            (Some(6), "wheel_rate", 5)
        );
        let y = found.y.as_ref().unwrap();
        assert_eq!([&found.time, &found.x, y, &found.trailer_headings[0]].map(|c| c.places[0]), [1, 2, 3, 4]);
    }

    #[test]
    fn a_named_column_must_be_there_once() {
        let named = Columns { heading: Some("phi".into()), ..columns() };
        let error = resolve(&named, "t,x,y,phi_1,speed,Phi").unwrap_err().to_string();
        assert!(error.contains("\"phi\" for heading is missing; did you mean \"Phi\"?"), "{error}");
        let error = resolve(&columns(), "t,x,y,phi_1,x,speed").unwrap_err().to_string();
        assert!(error.contains("\"x\" stands twice in the header, as cell 2 and cell 5"), "{error}");
        let error = resolve(&columns(), "1,2,3,4,5,6").unwrap_err().to_string();
        assert!(error.contains("no names of columns: they are called 1 to 6"), "{error}");
        assert!(resolve(&columns(), "t,x,y,a,a,phi_1,speed").is_ok(), "columns not used may repeat");
    }
}
