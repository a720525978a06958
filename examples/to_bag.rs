//! Writes a bundled run as a bag of ROS 2 messages: wheel rate as a joint state, yaw rate of an IMU, poses of a motion
//! capture, each with stamps of its own; and the model file that names their topics.
//!
//! ```text
//! cargo run --release --features mcap --example to_bag -- FOLDER
//! creepage discover FOLDER/eights.mcap --model FOLDER/model.toml --out report
//! ```

use std::collections::BTreeMap;
use std::error::Error;
use std::io::Cursor;
use std::path::PathBuf;

/// The model file that names the topics.
pub const MODEL: &str = include_str!("formats/bag.toml");

#[allow(dead_code)]
fn main() -> Result<(), Box<dyn Error>> {
    let folder = PathBuf::from(std::env::args().nth(1).ok_or("give a folder")?);
    let run = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/runs/cornering/eights.csv");
    let mut reader = csv::Reader::from_path(run)?;
    let names: Vec<String> = reader.headers()?.iter().map(|n| n.trim().to_string()).collect();
    let at = |name: &str| names.iter().position(|n| n == name).ok_or(format!("no column {name}"));
    let wanted = [at("t")?, at("x")?, at("y")?, at("phi")?, at("theta_dot")?, at("phi_dot")?];
    let mut rows = vec![];
    for row in reader.records() {
        let row = row?;
        let numbers = wanted.map(|c| row.get(c).and_then(|cell| cell.trim().parse::<f64>().ok()).unwrap_or(f64::NAN));
        rows.push(numbers);
    }
    std::fs::create_dir_all(&folder)?;
    std::fs::write(folder.join("eights.mcap"), bag(&rows)?)?;
    std::fs::write(folder.join("model.toml"), MODEL)?;
    Ok(())
}

/// When the run began, s.
pub const START: f64 = 1_700_000_000.0;

/// The bytes of a bag; a row is t, x, y, heading, wheel rate, yaw rate.
pub fn bag(rows: &[[f64; 6]]) -> Result<Vec<u8>, Box<dyn Error>> {
    let mut bytes = Cursor::new(Vec::new());
    let mut writer = mcap::Writer::new(&mut bytes)?;
    let mut channel = |topic: &str, kind: &str| -> Result<u16, Box<dyn Error>> {
        let schema = writer.add_schema(kind, "ros2msg", b"")?;
        Ok(writer.add_channel(schema, topic, "cdr", &BTreeMap::new())?)
    };
    let joints = channel("/joint_states", "sensor_msgs/msg/JointState")?;
    let imu = channel("/imu", "sensor_msgs/msg/Imu")?;
    let pose = channel("/mocap/pose", "geometry_msgs/msg/PoseStamped")?;
    for (sequence, [t, x, y, heading, wheel_rate, yaw_rate]) in rows.iter().enumerate() {
        let message = [
            (joints, joint_state(*t, *wheel_rate)),
            (imu, imu_of(*t, *yaw_rate)),
            (pose, pose_of(*t, *x, *y, *heading)),
        ];
        for (channel_id, data) in message {
            let time = ((START + t) * 1e9) as u64;
            let sequence = sequence as u32;
            let header = mcap::records::MessageHeader { channel_id, sequence, log_time: time, publish_time: time };
            writer.write_to_known_channel(&header, &data)?;
        }
    }
    writer.finish()?;
    drop(writer);
    Ok(bytes.into_inner())
}

/// A message in little-endian CDR.
pub struct Cdr(Vec<u8>);

impl Cdr {
    /// A message that begins with a header's stamp and frame.
    pub fn stamped(t: f64) -> Self {
        let nanoseconds = ((START + t.floor()) as i64, ((t - t.floor()) * 1e9).round() as u32);
        Cdr(vec![0, 1, 0, 0]).u32(nanoseconds.0 as u32).u32(nanoseconds.1).text("map")
    }

    fn aligned(mut self, to: usize) -> Self {
        while !(self.0.len() - 4).is_multiple_of(to) {
            self.0.push(0);
        }
        self
    }

    pub fn u32(self, value: u32) -> Self {
        let mut here = self.aligned(4);
        here.0.extend(value.to_le_bytes());
        here
    }

    pub fn f64(self, value: f64) -> Self {
        let mut here = self.aligned(8);
        here.0.extend(value.to_le_bytes());
        here
    }

    pub fn f64s(self, values: &[f64]) -> Self {
        values.iter().fold(self, |here, v| here.f64(*v))
    }

    pub fn text(self, text: &str) -> Self {
        let mut here = self.u32(text.len() as u32 + 1);
        here.0.extend(text.as_bytes());
        here.0.push(0);
        here
    }

    pub fn done(self) -> Vec<u8> {
        self.0
    }
}

fn turn(heading: f64) -> [f64; 4] {
    [0.0, 0.0, (0.5 * heading).sin(), (0.5 * heading).cos()]
}

fn joint_state(t: f64, rate: f64) -> Vec<u8> {
    let named = Cdr::stamped(t).u32(1).text("wheel");
    named.u32(1).f64(rate * t).u32(1).f64(rate).u32(0).done()
}

fn imu_of(t: f64, yaw_rate: f64) -> Vec<u8> {
    let angular = [0.0, 0.0, yaw_rate];
    Cdr::stamped(t).f64s(&turn(0.0)).f64s(&[0.0; 9]).f64s(&angular).f64s(&[0.0; 9]).f64s(&[0.0; 12]).done()
}

fn pose_of(t: f64, x: f64, y: f64, heading: f64) -> Vec<u8> {
    Cdr::stamped(t).f64s(&[x, y, 0.0]).f64s(&turn(heading)).done()
}
