//! A bag of ROS 2 messages as a log: its topics looked through once, its columns read in a second pass.

use super::messages::Layouts;
use super::recorded::Recorded;
#[cfg(feature = "db3")]
use super::sqlite;
use super::{cdr, container, messages};
use crate::error::{Error, Result};
use crate::files::log::csv_table::Numbers;
use crate::files::log::own_times::at_times;
use crate::files::log::row_order;
use crate::files::log::time_stamp::Origin;
use crate::files::log::usable_rows::{hash, usable};
use crate::files::toml::suggestions;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Names of the times of a message: of its header, and of its recording.
const TIMES: [&str; 3] = ["time", "stamp", "log_time"];
/// The most columns: a file with more of them is no log.
const MAX_COLUMNS: usize = 20_000;

/// A bag whose topics are known.
pub(crate) struct Bag {
    pub path: PathBuf,
    pub header: Vec<String>,
    /// The topic and field of each column behind the times.
    fields: Vec<(String, String)>,
}

impl Bag {
    /// Looks through a file for the topics and fields that it has.
    pub fn open(path: &Path) -> Result<Self> {
        let mut known: BTreeMap<String, Vec<String>> = BTreeMap::new();
        let mut others: BTreeMap<String, String> = BTreeMap::new();
        let (mut columns, mut layouts) = (0, Layouts::default());
        each(path, &mut |n, message| {
            let topic = &message.source.topic;
            let Some(layout) = layouts.of(message.source) else {
                others.entry(topic.clone()).or_insert_with(|| kind(message));
                return Ok(());
            };
            if known.contains_key(topic) && !layout.varies() {
                return Ok(());
            }
            let names = match layout.fields(message.data) {
                Ok(names) => names,
                // What a definition says wrongly of a topic that nobody may ask for is no reason to refuse the bag.
                Err(_) if layout.is_defined() => {
                    others.entry(topic.clone()).or_insert_with(|| kind(message));
                    return Ok(());
                }
                Err(e) => return Err(malformed(path, message, n, e)),
            };
            let fields = known.entry(topic.clone()).or_default();
            for name in names {
                if !fields.contains(&name) {
                    fields.push(name);
                    columns += 1;
                }
            }
            if columns > MAX_COLUMNS {
                return Err(Error::input("has too many fields").at_file(path).help("give a bag with fewer joints"));
            }
            Ok(())
        })?;
        if known.is_empty() {
            let there: Vec<String> = others.iter().map(|(topic, kind)| format!("{topic} ({kind})")).collect();
            let there: Vec<&str> = there.iter().map(String::as_str).collect();
            return Err(Error::input("has no message that creepage reads").at_file(path).help(format!(
                "it reads {}, and any other that the bag defines (ros2msg), in CDR; the bag has: {}",
                messages::NAMES.join(", "),
                suggestions::list(&there)
            )));
        }
        let fields: Vec<(String, String)> =
            known.into_iter().flat_map(|(topic, f)| f.into_iter().map(move |f| (topic.clone(), f))).collect();
        let names = fields.iter().map(|(topic, field)| format!("{topic}:{field}"));
        let header = TIMES.iter().map(|t| (*t).to_string()).chain(names).collect();
        Ok(Self { path: path.to_path_buf(), header, fields })
    }

    /// Reads columns, the time first. Those of the topic with the most messages stay as they are; those of others are
    /// interpolated to its times.
    pub fn numbers(self, wanted: &[usize]) -> Result<Numbers> {
        let by_stamp = wanted.first().is_none_or(|c| self.header[*c] != TIMES[2]);
        let fields: Vec<&(String, String)> =
            wanted.iter().skip(1).filter_map(|c| self.fields.get(c.wrapping_sub(TIMES.len()))).collect();
        if fields.len() + 1 != wanted.len() {
            return Err(Error::input("a time of the messages is named for another quantity")
                .at_file(&self.path)
                .help("name a column TOPIC:FIELD under [columns]"));
        }
        let mut topics = self.read(&fields, by_stamp)?;
        topics.values_mut().for_each(|columns| {
            row_order::sort(columns);
        });
        let sha256 = hash(&self.path)?;
        let longest = topics.iter().max_by_key(|(topic, c)| (c[0].len(), std::cmp::Reverse(*topic)));
        let base = longest.map(|(topic, _)| topic.clone()).unwrap_or_default();
        let time = topics.get(&base).map_or_else(Vec::new, |c| c[0].clone());
        let mut columns = vec![time.clone()];
        let mut next: BTreeMap<&str, usize> = BTreeMap::new();
        for (topic, _) in &fields {
            let at = next.entry(topic).or_insert(0);
            *at += 1;
            let Some(own) = topics.get(topic) else { continue };
            columns.push(match *topic == base {
                true => own[*at].clone(),
                false => at_times(&own[0], &own[*at], &time),
            });
        }
        let names: Vec<&str> = wanted.iter().map(|c| self.header[*c].as_str()).collect();
        Ok(usable(columns, &names, sha256, Origin::default()))
    }

    /// The times and wanted fields of each topic.
    fn read(&self, wanted: &[&(String, String)], by_stamp: bool) -> Result<BTreeMap<String, Vec<Vec<f64>>>> {
        let mut found: BTreeMap<String, Vec<Vec<f64>>> = BTreeMap::new();
        let of = |topic: &str| -> Vec<&str> {
            wanted.iter().filter(|(t, _)| t == topic).map(|(_, field)| field.as_str()).collect()
        };
        for (topic, _) in wanted {
            found.entry(topic.clone()).or_insert_with(|| vec![vec![]; of(topic).len() + 1]);
        }
        let mut layouts = Layouts::default();
        each(&self.path, &mut |n, message| {
            let topic = &message.source.topic;
            let Some(columns) = found.get_mut(topic) else { return Ok(()) };
            let Some(layout) = layouts.of(message.source) else { return Ok(()) };
            let (stamp, values) =
                layout.values(message.data, &of(topic)).map_err(|e| malformed(&self.path, message, n, e))?;
            // A message of other frames says nothing of the one that is asked for.
            if layout.is_defined() && values.iter().all(|v| v.is_nan()) {
                return Ok(());
            }
            let logged = message.log_time as f64 * 1e-9;
            let without = layout.is_defined() && stamp.is_nan();
            columns[0].push(if by_stamp && !without { stamp } else { logged });
            columns[1..].iter_mut().zip(values).for_each(|(c, v)| c.push(v));
            Ok(())
        })?;
        Ok(found)
    }
}

/// Puts every message of a bag to a reader, with how many came before it.
fn each(path: &Path, read: &mut dyn FnMut(usize, &Recorded) -> Result<()>) -> Result<()> {
    #[cfg(feature = "db3")]
    if sqlite::is_one(path) {
        return sqlite::each(path, read);
    }
    container::each(path, read)
}

fn kind(message: &Recorded) -> String {
    let source = message.source;
    if source.kind.is_empty() { source.encoding.clone() } else { source.kind.clone() }
}

fn malformed(path: &Path, message: &Recorded, n: usize, why: cdr::Malformed) -> Error {
    let topic = suggestions::shown(&message.source.topic);
    Error::input(format!("message {} on {topic} is no {} in CDR: {why}", n + 1, suggestions::shown(&kind(message))))
        .at_file(path)
        .help("check the bag's schema; its messages may be of another type than it says")
}
