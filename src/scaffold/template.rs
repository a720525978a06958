//! The text of a model file to begin with.

use super::column_matching::{Match, matched};
use super::proposals::{Asked, Proposal, proposals, quoted};
use super::samples::Sample;
use super::urdf::Measures;
use crate::error::{Error, Result};
use crate::files::advice;
use crate::files::is_without_names;
use crate::model::WITH_TRAILERS;
use crate::vehicles;
use crate::vehicles::Vehicle;
use std::fmt::Write;

/// What a model file is wanted for.
#[derive(Clone, Debug, Default)]
pub struct Wanted {
    /// Id of the vehicle.
    pub vehicle: String,
    /// Id of the vehicle in front, for one with trailers; a car when left out.
    pub tractor: Option<String>,
    /// Number of trailers, for a vehicle with trailers; one when left out.
    pub trailers: Option<usize>,
    /// Name and columns of a log.
    pub log: Option<(String, Vec<String>)>,
    /// Name and columns of a file of poses, where they are not in the log.
    pub truth: Option<(String, Vec<String>)>,
    /// The first rows of the log, where it is a table of text: texts, a row each.
    pub rows: Vec<Vec<String>>,
    /// The first rows of the file of poses.
    pub truth_rows: Vec<Vec<String>>,
    /// What a robot's description says of its wheels.
    pub measures: Option<Measures>,
    /// The file of vehicles that the model file names.
    pub own: Option<String>,
}

/// A model file to begin with.
#[derive(Clone, Debug, PartialEq)]
pub struct Starter {
    /// Its text: valid as it stands, placeholders marked.
    pub text: String,
    /// Roles with the columns that were found for them.
    pub found: Vec<(String, String)>,
    /// Roles that a column must still be named for.
    pub missing: Vec<String>,
    /// Parameters whose values are placeholders.
    pub placeholders: Vec<String>,
    /// The line of the poses' own time.
    truth_time: String,
}

/// Placeholders of the parameters that most vehicles share, in SI units; any other is one, an offset zero.
const USUAL: [(&str, f64); 3] = [("wheel_radius", 0.1), ("track_width", 0.4), ("wheelbase", 0.5)];
/// Roles of time and pose, the first ones.
const POSE: usize = 4;
/// Most trailers of a file to begin with.
const MAX_TRAILERS: usize = 100;

impl Starter {
    /// A model file for a vehicle.
    ///
    /// ```
    /// use creepage::scaffold::{Starter, Wanted};
    /// let log = Some(("run.csv".into(), ["t", "x", "y", "yaw", "v", "gyro_z"].map(String::from).to_vec()));
    /// let starter = Starter::new(&Wanted { vehicle: "unicycle".into(), log, ..Wanted::default() }).unwrap();
    /// assert!(starter.text.contains("speed = \"v\""));
    /// assert!(starter.missing.is_empty());
    /// ```
    ///
    /// # Errors
    /// When a vehicle is unknown, or trailers are wanted of one that has none.
    pub fn new(wanted: &Wanted) -> Result<Self> {
        Self::on(vehicles::all(), wanted)
    }

    /// As [`Self::new`], for one of these vehicles.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn on(vehicles: &[Vehicle], wanted: &Wanted) -> Result<Self> {
        let train = wanted.vehicle == WITH_TRAILERS;
        let vehicle = if train { tractor(vehicles, wanted)? } else { single(vehicles, wanted)? };
        let trailers = if train { wanted.trailers.unwrap_or(1) } else { 0 };
        if trailers > MAX_TRAILERS {
            return Err(Error::input(format!("{trailers} trailers are too many to begin with"))
                .help(format!("give at most {MAX_TRAILERS}, and add lengths to the file")));
        }
        let mut starter = Self {
            text: String::new(),
            found: vec![],
            missing: vec![],
            placeholders: vec![],
            truth_time: String::new(),
        };
        starter.head(wanted, vehicle, trailers);
        starter.parameters(vehicle, trailers, wanted.measures.as_ref());
        starter.columns(wanted, vehicle, trailers);
        starter.text.push_str(TAIL);
        Ok(starter)
    }

    fn head(&mut self, wanted: &Wanted, vehicle: &Vehicle, trailers: usize) {
        self.line(
            "# What is believed of the vehicle. SI units: m, rad, s, kg; x forward, y left, angles counter-clockwise.",
        );
        self.line("# Lines that begin with # are comments; `creepage describe` shows what this file says.");
        self.line("");
        let title = if trailers > 0 { "a tractor with trailers" } else { &vehicle.title };
        self.entry(&format!("vehicle = \"{}\"", wanted.vehicle), title);
        if let Some(own) = &wanted.own {
            self.entry(&format!("vehicles = {}", quoted(own)), "where it is described, from the folder of this file");
        }
        if trailers > 0 {
            self.entry(&format!("tractor = \"{}\"", vehicle.id), &vehicle.title);
        }
        self.entry(
            "input_timing = \"sample\"",
            "\"interval-mean\" if a row holds the mean since the row before (encoder counts)",
        );
        if let Some(advice) = &vehicle.instead {
            self.line(&format!("# It can be described, not fitted: {advice}."));
        }
    }

    fn parameters(&mut self, vehicle: &Vehicle, trailers: usize, measures: Option<&Measures>) {
        if vehicle.parameters.is_empty() && trailers == 0 {
            return;
        }
        self.line(
            "\n[parameters]                      # placeholders: put what you measured, or what the drawing says",
        );
        for (name, p) in &vehicle.parameters {
            let left_out = measures.map(|m| m.left_out(name)).unwrap_or_default();
            if let Some(value) = measures.and_then(|m| m.of(name)) {
                let source = measures.map(|m| plain(&m.source)).unwrap_or_default();
                self.entry(
                    &format!("{name} = {value:?}"),
                    &format!("{}; {}, from {source}{left_out}", p.unit, p.meaning),
                );
                continue;
            }
            let usual = USUAL.iter().find(|(usual, _)| usual == name).map(|(_, value)| *value);
            let value = usual.unwrap_or(if name.ends_with("offset") { 0.0 } else { 1.0 });
            let optional = if p.optional { "# " } else { "" };
            let may = if p.optional { "; may be left out" } else { "" };
            self.entry(&format!("{optional}{name} = {value:?}"), &format!("{}; {}{may}{left_out}", p.unit, p.meaning));
            if !p.optional {
                self.placeholders.push(name.clone());
            }
        }
        if trailers > 0 {
            let list = |value: &str| vec![value; trailers].join(", ");
            self.entry(
                &format!("trailer_lengths = [{}]", list("1.0")),
                "m; from hitch to axle, nearest the tractor first",
            );
            self.entry(&format!("hitch_offsets = [{}]", list("0.0")), "m; hitch behind the axle ahead of it");
            self.placeholders.extend(["trailer_lengths".into(), "hitch_offsets".into()]);
        }
    }

    fn columns(&mut self, wanted: &Wanted, vehicle: &Vehicle, trailers: usize) {
        let described = roles(vehicle);
        let header = wanted.log.as_ref().map(|(_, header)| header.as_slice());
        let poses = wanted.truth.as_ref().map(|(_, header)| header.as_slice());
        let stands: Vec<(String, String)> =
            described.iter().filter_map(|r| r.instead_of.clone().map(|of| (of, r.name.clone()))).collect();
        let asked: Vec<Asked> = described.iter().map(|r| Asked { role: &r.name, unit: &r.unit }).collect();
        let (mut matches, mut proposed) = looked_at(&asked, &stands, header.unwrap_or(&[]), &wanted.rows);
        if let Some(poses) = poses {
            let (own, of_own) = looked_at(&asked[..POSE], &[], poses, &wanted.truth_rows);
            matches[1..POSE].clone_from_slice(&own[1..]);
            proposed[1..POSE].clone_from_slice(&of_own[1..]);
            self.truth_time(&own[0], of_own[0].as_ref(), &matches[0]);
        }
        self.line("\n[columns]                         # role = name of the column; a role left out is looked for by its own name");
        if let Some((name, header)) = &wanted.log {
            self.line(&format!("# columns of {}: {}", plain(name), listed(header)));
        }
        if let Some((name, header)) = &wanted.truth {
            self.line(&format!("# columns of {}: {}", plain(name), listed(header)));
        }
        let known = |i: usize| if (1..POSE).contains(&i) { poses.or(header).is_some() } else { header.is_some() };
        let has = |role: &str| {
            let of = |(m, p): (&Match, &Option<Proposal>)| m.role == role && (m.column.is_some() || p.is_some());
            matches.iter().zip(&proposed).any(of)
        };
        let by_position = proposed.iter().flatten().any(|p| p.role == "position");
        for (i, (role, m)) in described.iter().zip(&matches).enumerate() {
            let replaced = stands.iter().any(|(a, b)| (a == &role.name && has(b)) || (b == &role.name && has(a)));
            match &proposed[i] {
                _ if by_position && role.name == "y" => {}
                Some(proposal) => self.proposal(role, proposal),
                None => self.column(role, m, known(i), replaced),
            }
            if i == 0 {
                let line = std::mem::take(&mut self.truth_time);
                self.text.push_str(&line);
            }
        }
        let behind = trailers + vehicle.trailers.len();
        if behind > 0 {
            let names: Vec<String> = (1..=behind).map(|i| format!("\"phi_{i}\"")).collect();
            self.entry(
                &format!("# trailer_headings = [{}]", names.join(", ")),
                "rad; measured absolute headings, all of them or none",
            );
        }
    }

    /// The time of the poses, where it is called otherwise than that of the inputs.
    fn truth_time(&mut self, own: &Match, proposed: Option<&Proposal>, inputs: &Match) {
        let Some(column) = own.column.as_ref().filter(|c| inputs.column.as_ref() != Some(c)) else { return };
        let value = proposed.map_or_else(|| quoted(column), |p| p.value.clone());
        self.found.push(("truth_time".into(), proposed.map_or_else(|| column.clone(), |p| p.value.clone())));
        let entry = format!("truth_time = {value}");
        self.truth_time = format!("{entry:<33} # s; time in the file of poses\n");
    }

    /// An entry that says more than a name.
    fn proposal(&mut self, role: &Role, proposal: &Proposal) {
        self.found.push((proposal.role.clone(), proposal.value.clone()));
        let put = proposal.placeholder.as_ref().map_or(String::new(), |name| format!("; put your {name}"));
        self.entry(
            &format!("{} = {}", proposal.role, proposal.value),
            &format!("in {}; {}{put}", role.unit, role.meaning),
        );
        if let Some(name) = proposal.placeholder.as_ref().filter(|name| !self.placeholders.contains(name)) {
            self.placeholders.push(name.clone());
        }
    }

    fn column(&mut self, role: &Role, m: &Match, known: bool, replaced: bool) {
        let name = &role.name;
        let what = format!("{}; {}", role.unit, role.meaning);
        let others = match m.others.is_empty() {
            true => String::new(),
            false => format!("; or {}?", m.others.iter().map(|o| plain(o)).collect::<Vec<_>>().join(", ")),
        };
        match &m.column {
            Some(column) => {
                self.found.push((name.clone(), column.clone()));
                self.entry(&format!("{name} = {}", quoted(column)), &format!("{what}{others}"));
            }
            None if known && !role.optional && !replaced && role.instead_of.is_none() => {
                self.missing.push(name.clone());
                self.entry(
                    &format!("# {name} = \"…\""),
                    &format!("{what}; not found in the log: name its column{others}"),
                );
            }
            None if known || role.optional => {
                self.entry(&format!("# {name} = \"{name}\""), &format!("{what}{others}"));
            }
            None => self.entry(&format!("{name} = \"{name}\""), &what),
        }
    }

    fn line(&mut self, text: &str) {
        self.text.push_str(text);
        self.text.push('\n');
    }

    fn entry(&mut self, text: &str, comment: &str) {
        // A string takes all.
        let _ = writeln!(self.text, "{text:<33} # {}", plain(comment));
    }
}

/// What a log offers for roles, by its header and its first rows.
fn looked_at(
    asked: &[Asked],
    stands: &[(String, String)],
    header: &[String],
    rows: &[Vec<String>],
) -> (Vec<Match>, Vec<Option<Proposal>>) {
    let samples = Sample::of(header.len(), rows);
    let names: Vec<String> = asked.iter().map(|a| a.role.to_string()).collect();
    let letters = |name: &str, stem: &str| ["x", "y", "z", "w"].iter().any(|l| format!("{stem}{l}") == name);
    let of_quaternion = |name: &str| {
        let stems = header.iter().filter_map(|n| n.strip_suffix('w'));
        let mut whole = stems.filter(|stem| ["x", "y", "z"].iter().all(|l| header.contains(&format!("{stem}{l}"))));
        whole.any(|stem| !stem.is_empty() && letters(name, stem))
    };
    let may_hold = |role: &str, c: usize| {
        let sample = &samples[c];
        match role {
            "time" => sample.may_hold_numbers() || sample.holds_dates(),
            "heading" => sample.may_hold_numbers() && !sample.is_constant() && !of_quaternion(&header[c]),
            "x" | "y" => sample.may_hold_numbers() && !of_quaternion(&header[c]),
            _ => sample.may_hold_numbers() && !sample.is_count() && !of_quaternion(&header[c]),
        }
    };
    let mut matches = matched(&names, stands, header, &may_hold);
    let without_names = is_without_names(header);
    if let (true, Some(c)) =
        (without_names, (0..header.len()).find(|c| samples[*c].rises() || samples[*c].holds_dates()))
    {
        matches[0].column = Some(header[c].clone());
    }
    let proposed = proposals(asked, &matches, header, &samples);
    (matches, proposed)
}

/// A role as the file explains it.
struct Role {
    name: String,
    unit: String,
    meaning: String,
    optional: bool,
    /// The role that it stands for.
    instead_of: Option<String>,
}

fn roles(vehicle: &Vehicle) -> Vec<Role> {
    let pose = [
        ("time", "s", "one number, rising", false),
        ("x", "m", "measured position", false),
        ("y", "m", "measured position", false),
        ("heading", "rad", "measured heading, may be wrapped; leave it out if there is none (GPS)", true),
    ];
    let role = |(name, unit, meaning, optional): (&str, &str, &str, bool)| Role {
        name: name.into(),
        unit: unit.into(),
        meaning: meaning.into(),
        optional,
        instead_of: None,
    };
    let mut found: Vec<Role> = pose.into_iter().map(role).collect();
    for (name, input) in &vehicle.inputs {
        found.push(role((name, &input.unit, &input.meaning, false)));
        if let Some(other) = &input.instead {
            let meaning = format!("instead of {name}");
            found.push(Role { instead_of: Some(name.clone()), ..role((&other.role, &other.unit, &meaning, true)) });
        }
    }
    found
}

fn single<'v>(vehicles: &'v [Vehicle], wanted: &Wanted) -> Result<&'v Vehicle> {
    let ids: Vec<&str> = vehicles.iter().map(|v| v.id.as_str()).chain([WITH_TRAILERS]).collect();
    if wanted.tractor.is_some() || wanted.trailers.is_some() {
        return Err(Error::input(format!("only {WITH_TRAILERS} has trailers and a tractor")).help(format!(
            "write `creepage init {WITH_TRAILERS} --tractor {}`",
            wanted.tractor.as_deref().unwrap_or(&wanted.vehicle)
        )));
    }
    vehicles.iter().find(|v| v.id == wanted.vehicle).ok_or_else(|| unknown("vehicle", &wanted.vehicle, &ids))
}

fn tractor<'v>(vehicles: &'v [Vehicle], wanted: &Wanted) -> Result<&'v Vehicle> {
    let ids: Vec<&str> = vehicles.iter().filter(|v| v.pulls()).map(|v| v.id.as_str()).collect();
    let id = wanted.tractor.as_deref().unwrap_or("car");
    vehicles.iter().find(|v| v.id == id && v.pulls()).ok_or_else(|| unknown("tractor", id, &ids))
}

fn unknown(noun: &str, id: &str, ids: &[&str]) -> Error {
    let shown = crate::files::shown(id);
    Error::input(format!("unknown {noun} \"{shown}\"")).help(advice(id, &format!("known {noun}s"), ids))
}

/// A text that may stand in a comment.
fn plain(text: &str) -> String {
    text.chars().map(|c| if c.is_control() { ' ' } else { c }).collect()
}

/// Column names shown in a comment.
const SHOWN_COLUMNS: usize = 40;

fn listed(header: &[String]) -> String {
    let mut text =
        header.iter().take(SHOWN_COLUMNS).map(|name| crate::files::shown(name)).collect::<Vec<_>>().join(", ");
    if header.len() > SHOWN_COLUMNS {
        text.push_str(&format!(", … ({} in all)", header.len()));
    }
    text
}

const TAIL: &str = "
# Where the measured pose sits on the body, as far as it is known; what is not known is found as an effect.
# [sensor]
# lever_arm = [0.0, 0.0]          # m; forward and left of the reference point
# heading_offset = 0.0            # rad; measured heading minus body heading

# Scatter of the measured pose (1 sigma); estimated from the data when left out.
# [noise]
# position = 0.002                # m
# heading = 0.002                 # rad

# Where `creepage simulate` begins.
# [initial]
# x = 0.0                         # m
# y = 0.0                         # m
# heading = 0.0                   # rad

# What the model already includes; `creepage discover` writes here what it finds, `creepage effects` lists what there is.
# [[effects]]
# id = \"rotation-creep\"
# e_rc = 0.03                     # 1
";
