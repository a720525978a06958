//! Messages of a bag that are read by the definitions that it carries.

#![cfg(feature = "mcap")]

use crate::two_names::read_under_two_names;
use creepage::files::{ModelFile, Run};
use creepage::{Result, effects, model};
use std::collections::BTreeMap;

const WHEELS: (&str, &str) = ("own_msgs/msg/Wheels", "uint8 gear\nfloat32[2] rates\n");
const TF: (&str, &str) = (
    "tf2_msgs/msg/TFMessage",
    "geometry_msgs/TransformStamped[] transforms
================
MSG: geometry_msgs/TransformStamped
std_msgs/Header header
string child_frame_id
Transform transform
================
MSG: geometry_msgs/Transform
Vector3 translation
Quaternion rotation
================
MSG: geometry_msgs/Vector3
float64 x
float64 y
float64 z
================
MSG: geometry_msgs/Quaternion
float64 x 0
float64 y 0
float64 z 0
float64 w 1
================
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
================
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
",
);

/// Plain CDR, little endian.
struct Written(Vec<u8>);

impl Written {
    fn new() -> Self {
        Self(vec![0, 1, 0, 0])
    }

    fn put<const N: usize>(mut self, bytes: [u8; N]) -> Self {
        while !(self.0.len() - 4).is_multiple_of(N) {
            self.0.push(0);
        }
        self.0.extend(bytes);
        self
    }

    fn u32(self, value: u32) -> Self {
        self.put(value.to_le_bytes())
    }

    fn text(self, text: &str) -> Self {
        let mut to = self.u32(text.len() as u32 + 1);
        to.0.extend(text.bytes().chain([0]));
        to
    }

    /// A frame at a time in tenths of a second.
    fn transform(self, tenths: u32, frame: &str, [x, y, heading]: [f64; 3]) -> Self {
        let to = self.u32(tenths / 10).u32(100_000_000 * (tenths % 10)).text("odom").text(frame);
        let (sin, cos) = (0.5 * heading).sin_cos();
        [x, y, 0.0, 0.0, 0.0, sin, cos].into_iter().fold(to, |to, v| to.put(v.to_le_bytes()))
    }
}

/// What is recorded at every tenth of a second: topic (wheels, then frames), time in ns, message.
fn recorded() -> Vec<(usize, u64, Vec<u8>)> {
    let of_row = |i: u32| {
        let t = 0.1 * f64::from(i);
        let rates = Written::new().put([3]).put((t as f32).to_le_bytes()).put((0.5 * t as f32).to_le_bytes());
        let body = Written::new().u32(1).transform(i, "base_link", [t, 1.0 - t, 0.3 * t]);
        let arm = Written::new().u32(1).transform(i, "arm", [9.0; 3]);
        // What has no header was recorded when it happened, and frames a little later.
        let time = 100_000_000 * u64::from(i);
        [(0, time, rates.0), (1, time + 30_000_000, body.0), (1, time + 30_000_000, arm.0)]
    };
    (0..20).flat_map(of_row).collect()
}

/// Topics of the messages, with the type and the definition of each.
fn topics(wheels: &str) -> [(&'static str, &'static str, String); 2] {
    [("/wheels", WHEELS.0, wheels.into()), ("/tf", TF.0, TF.1.into())]
}

/// A bag whose wheels are recorded at every tenth of a second, and whose frames are told in messages of their own.
fn bag(wheels: &str) -> Vec<u8> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    let mut writer = mcap::Writer::new(&mut bytes).unwrap();
    let channels = topics(wheels).map(|(topic, name, definition)| {
        let schema = writer.add_schema(name, "ros2msg", definition.as_bytes()).unwrap();
        writer.add_channel(schema, topic, "cdr", &BTreeMap::new()).unwrap()
    });
    for (topic, log_time, data) in recorded() {
        let header =
            mcap::records::MessageHeader { channel_id: channels[topic], sequence: 0, log_time, publish_time: 0 };
        writer.write_to_known_channel(&header, &data).unwrap();
    }
    writer.finish().unwrap();
    drop(writer);
    bytes.into_inner()
}

const MODEL: &str = "vehicle = \"unicycle\"\n[parameters]\nwheel_radius = 0.1\n[columns]\ntime = \"stamp\"\n\
    x = \"/tf:base_link.transform.translation.x\"\ny = \"/tf:base_link.transform.translation.y\"\n\
    heading = \"/tf:base_link.transform.rotation.yaw\"\n\
    wheel_rate = \"/wheels:rates[0]\"\nyaw_rate = \"/wheels:rates[1]\"\n";

fn read(wheels: &str) -> Result<Run> {
    let model = ModelFile::parse(MODEL, "model.toml", &model::known(effects::all())).unwrap();
    read_under_two_names("run.mcap", &bag(wheels), &model)
}

/// The pose is that of a frame of /tf, at the stamps of its own; a message without a header has the time of its recording.
#[test]
fn any_message_is_read_by_its_definition() {
    let run = read(WHEELS.1).unwrap();
    assert_eq!((run.time.len(), run.rows_dropped), (20, 0), "{:?}", run.why_dropped);
    for (i, t) in run.time.iter().enumerate() {
        let pose = [run.x[i], run.y[i], run.heading.as_ref().unwrap()[i]];
        assert!(pose.iter().zip([*t, 1.0 - t, 0.3 * t]).all(|(a, b)| (a - b).abs() < 1e-9), "{t}: {pose:?}");
    }
    let apart = run.apart.unwrap();
    let near = |column: &[f64], factor: f64| column.iter().zip(&apart.time).all(|(v, t)| (v - factor * t).abs() < 1e-6);
    assert!(near(&run.inputs[0], 1.0) && near(&run.inputs[1], 0.5) && apart.time.len() == 20);
}

/// A topic whose definition does not hold is no reason to refuse a bag, and its columns are not there.
#[test]
fn a_definition_that_does_not_hold_leaves_its_topic_out() {
    for wrong in ["float64[9] rates\n", "wstring name\n", "Unknown rates\n", ""] {
        let error = read(wrong).unwrap_err().to_string();
        assert!(error.contains("column \"/wheels:rates[0]\""), "{wrong}: {error}");
    }
}

/// The bag that recordings before MCAP are, with or without the table of definitions.
#[cfg(feature = "db3")]
mod in_sqlite {
    use super::*;
    use rusqlite::{Connection, params};

    /// The bytes of a bag in SQLite.
    fn bag(with_definitions: bool) -> Vec<u8> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("run_0.db3");
        let bag = Connection::open(&path).unwrap();
        bag.execute_batch(
            "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL,
                serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL);
             CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp INTEGER NOT NULL,
                data BLOB NOT NULL);",
        )
        .unwrap();
        if with_definitions {
            bag.execute_batch(
                "CREATE TABLE message_definitions(id INTEGER PRIMARY KEY, topic_type TEXT NOT NULL, encoding TEXT NOT NULL,
                    encoded_message_definition TEXT NOT NULL, type_description_hash TEXT NOT NULL);",
            )
            .unwrap();
        }
        for (i, (topic, kind, definition)) in topics(WHEELS.1).into_iter().enumerate() {
            let id = i as i64 + 1;
            bag.execute("INSERT INTO topics VALUES (?1, ?2, ?3, 'cdr', '')", params![id, topic, kind]).unwrap();
            if with_definitions {
                let one = "INSERT INTO message_definitions VALUES (?1, ?2, 'ros2msg', ?3, '')";
                bag.execute(one, params![id, kind, definition]).unwrap();
            }
        }
        // Written in another order than that of their times.
        for (topic, time, data) in recorded().into_iter().rev() {
            let one = "INSERT INTO messages(topic_id, timestamp, data) VALUES (?1, ?2, ?3)";
            bag.execute(one, params![topic as i64 + 1, time as i64, data]).unwrap();
        }
        drop(bag);
        std::fs::read(path).unwrap()
    }

    fn read(bytes: &[u8]) -> Result<Run> {
        let model = ModelFile::parse(MODEL, "model.toml", &model::known(effects::all())).unwrap();
        read_under_two_names("run.db3", bytes, &model)
    }

    #[test]
    fn a_bag_in_sqlite_is_read_as_one_in_mcap() {
        let (here, there) = (read(&bag(true)).unwrap(), super::read(WHEELS.1).unwrap());
        assert_eq!((&here.time, &here.x, &here.y, &here.heading), (&there.time, &there.x, &there.y, &there.heading));
        assert_eq!(here.inputs, there.inputs);
    }

    #[test]
    fn a_bag_without_definitions_says_what_it_has_and_a_broken_one_that_it_is_broken() {
        let error = read(&bag(false)).unwrap_err().to_string();
        assert!(error.contains("/wheels (own_msgs/msg/Wheels)") && error.contains("nav_msgs/Odometry"), "{error}");
        let mut cut = bag(true);
        cut.truncate(5000);
        let error = read(&cut).unwrap_err().to_string();
        assert!(error.contains("SQLite") && error.contains("reindex"), "{error}");
    }
}
