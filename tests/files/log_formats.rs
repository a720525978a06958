//! Logs that are no CSV: read back to the same run, or refused with one message.

#[cfg(feature = "mcap")]
use crate::to_bag;
#[cfg(feature = "parquet")]
use crate::to_parquet;
use creepage::files::{ModelFile, Run};
use creepage::{Error, effects, model};
use std::path::{Path, PathBuf};

#[cfg(any(feature = "parquet", feature = "mcap"))]
const EXAMPLE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/runs/cornering/eights.csv");

fn example_model() -> ModelFile {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/runs/cornering/model.toml");
    ModelFile::read(path, &model::known(effects::all())).unwrap()
}

fn written(folder: &tempfile::TempDir, name: &str, bytes: &[u8]) -> PathBuf {
    let path = folder.path().join(name);
    std::fs::write(&path, bytes).unwrap();
    path
}

/// One line, exit code 2, the file named.
fn is_one_message(error: &Error, path: &Path) {
    let message = error.to_string();
    assert_eq!((error.exit_code(), message.lines().count()), (2, 1), "{message}");
    assert!(message.starts_with(&path.display().to_string()), "{message}");
    assert!(message.contains(';'), "advice: {message}");
}

/// A file that is known by its name or by its first bytes names the feature that reads it.
#[cfg(not(all(feature = "parquet", feature = "mcap")))]
fn names_its_feature(files: [&str; 2], bytes: &[u8], feature: &str) {
    let folder = tempfile::tempdir().unwrap();
    for name in files {
        let path = written(&folder, name, bytes);
        let error = Run::read(&path, &example_model()).unwrap_err();
        is_one_message(&error, &path);
        assert!(error.to_string().contains(feature), "{error}");
    }
}

#[cfg(not(feature = "parquet"))]
#[test]
fn a_parquet_file_names_the_feature_that_reads_it() {
    names_its_feature(["run.parquet", "run.csv"], b"PAR1 and so on", "--features parquet");
}

#[cfg(not(feature = "mcap"))]
#[test]
fn a_bag_names_the_feature_that_reads_it() {
    names_its_feature(["run.mcap", "run.csv"], b"\x89MCAP0\r\n and so on", "--features mcap");
}

/// What remains of a file cut off anywhere, or with bytes flipped: an error or a run, never a panic.
#[cfg(any(feature = "parquet", feature = "mcap"))]
fn survives_damage(bytes: &[u8], name: &str, model: &ModelFile) -> [usize; 2] {
    use rand::{Rng, SeedableRng};
    let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(8);
    let folder = tempfile::tempdir().unwrap();
    let (mut refused, mut read) = (0, 0);
    let mut attempt = |bytes: &[u8]| {
        let path = written(&folder, name, bytes);
        match Run::read(&path, model) {
            Err(error) => {
                is_one_message(&error, &path);
                refused += 1;
            }
            Ok(_) => read += 1,
        }
    };
    for cut in (0..60).map(|i| bytes.len() * i / 60).chain(bytes.len().saturating_sub(12)..bytes.len()) {
        attempt(&bytes[..cut]);
    }
    for _ in 0..300 {
        let mut damaged = bytes.to_vec();
        for _ in 0..random.random_range(1..4) {
            let at = random.random_range(0..damaged.len());
            damaged[at] = random.random();
        }
        attempt(&damaged);
    }
    [refused, read]
}

#[cfg(feature = "parquet")]
mod parquet_files {
    use super::*;

    fn example_columns() -> (Vec<String>, Vec<Vec<Option<f64>>>) {
        let mut reader = csv::Reader::from_path(EXAMPLE).unwrap();
        let names: Vec<String> = reader.headers().unwrap().iter().map(str::to_string).collect();
        let mut columns = vec![vec![]; names.len()];
        for row in reader.records() {
            columns.iter_mut().zip(row.unwrap().iter()).for_each(|(c, cell)| c.push(cell.parse().ok()));
        }
        (names, columns)
    }

    #[test]
    fn the_same_run_as_from_csv() {
        let (names, columns) = example_columns();
        let folder = tempfile::tempdir().unwrap();
        let path = written(&folder, "eights.parquet", &to_parquet::parquet(&names, &columns).unwrap());
        let (csv, found) = (Run::read(EXAMPLE, &example_model()).unwrap(), Run::read(&path, &example_model()).unwrap());
        assert!(found.time.len() > 1000);
        assert_eq!(Run { name: csv.name.clone(), path: csv.path.clone(), sha256: csv.sha256.clone(), ..found }, csv);
    }

    #[test]
    fn a_null_drops_its_row_and_is_counted() {
        let (names, mut columns) = example_columns();
        columns[1][7] = None;
        columns[2][9] = Some(f64::INFINITY);
        let folder = tempfile::tempdir().unwrap();
        let path = written(&folder, "eights.parquet", &to_parquet::parquet(&names, &columns).unwrap());
        let found = Run::read(&path, &example_model()).unwrap();
        let expect = [("blank or NaN cell in column \"x\"", 1), ("infinite value in column \"y\"", 1)];
        assert_eq!(found.why_dropped, expect.map(|(why, n)| (why.to_string(), n)).into());
    }

    #[test]
    fn a_missing_column_suggests_the_near_one() {
        let (mut names, columns) = example_columns();
        names[1] = "X".into();
        let folder = tempfile::tempdir().unwrap();
        let path = written(&folder, "eights.parquet", &to_parquet::parquet(&names, &columns).unwrap());
        let error = Run::read(&path, &example_model()).unwrap_err();
        is_one_message(&error, &path);
        assert!(error.to_string().contains("did you mean \"X\"?"), "{error}");
    }

    #[test]
    fn damage_is_one_message() {
        let (names, mut columns) = example_columns();
        columns.iter_mut().for_each(|c| c.truncate(200));
        let [refused, _] =
            survives_damage(&to_parquet::parquet(&names, &columns).unwrap(), "run.parquet", &example_model());
        assert!(refused > 60, "{refused}");
    }

    #[test]
    fn text_is_no_number() {
        use parquet::data_type::{ByteArray, ByteArrayType};
        use parquet::file::writer::SerializedFileWriter;
        let schema = "message log { REQUIRED BYTE_ARRAY t (UTF8); REQUIRED DOUBLE x; REQUIRED DOUBLE y; \
                      REQUIRED DOUBLE phi; REQUIRED DOUBLE theta_dot; REQUIRED DOUBLE phi_dot; }";
        let schema = std::sync::Arc::new(parquet::schema::parser::parse_message_type(schema).unwrap());
        let mut bytes = Vec::new();
        let mut writer = SerializedFileWriter::new(&mut bytes, schema, std::sync::Arc::default()).unwrap();
        let mut group = writer.next_row_group().unwrap();
        let mut column = group.next_column().unwrap().unwrap();
        column.typed::<ByteArrayType>().write_batch(&[ByteArray::from("noon")], None, None).unwrap();
        column.close().unwrap();
        while let Some(mut column) = group.next_column().unwrap() {
            column.typed::<parquet::data_type::DoubleType>().write_batch(&[1.0], None, None).unwrap();
            column.close().unwrap();
        }
        group.close().unwrap();
        writer.close().unwrap();
        let folder = tempfile::tempdir().unwrap();
        let path = written(&folder, "run.parquet", &bytes);
        let error = Run::read(&path, &example_model()).unwrap_err();
        is_one_message(&error, &path);
        assert!(error.to_string().contains("column \"t\" holds no plain numbers"), "{error}");
    }

    #[test]
    fn time_stamps_are_seconds() {
        use parquet::data_type::{DoubleType, Int64Type};
        use parquet::file::writer::SerializedFileWriter;
        let schema = "message log { REQUIRED INT64 t (TIMESTAMP(NANOS,true)); REQUIRED DOUBLE x; REQUIRED DOUBLE y; \
                      REQUIRED DOUBLE phi; REQUIRED DOUBLE theta_dot; REQUIRED DOUBLE phi_dot; }";
        let schema = std::sync::Arc::new(parquet::schema::parser::parse_message_type(schema).unwrap());
        let mut bytes = Vec::new();
        let mut writer = SerializedFileWriter::new(&mut bytes, schema, std::sync::Arc::default()).unwrap();
        let mut group = writer.next_row_group().unwrap();
        let mut column = group.next_column().unwrap().unwrap();
        column.typed::<Int64Type>().write_batch(&[1_500_000_000, 2_000_000_000], None, None).unwrap();
        column.close().unwrap();
        while let Some(mut column) = group.next_column().unwrap() {
            column.typed::<DoubleType>().write_batch(&[1.0, 2.0], None, None).unwrap();
            column.close().unwrap();
        }
        group.close().unwrap();
        writer.close().unwrap();
        let folder = tempfile::tempdir().unwrap();
        let path = written(&folder, "run.parquet", &bytes);
        assert_eq!(Run::read(&path, &example_model()).unwrap().time, [1.5, 2.0]);
    }
}

#[cfg(feature = "mcap")]
mod bags {
    use super::*;

    fn rows() -> Vec<[f64; 6]> {
        let run = Run::read(EXAMPLE, &example_model()).unwrap();
        let heading = run.heading.as_ref().unwrap();
        let role = |name: &str| run.roles.iter().position(|r| r == name).unwrap();
        let (wheel, yaw) = (&run.inputs[role("wheel_rate")], &run.inputs[role("yaw_rate")]);
        (0..run.time.len()).map(|i| [run.time[i], run.x[i], run.y[i], heading[i], wheel[i], yaw[i]]).collect()
    }

    fn bag_model(edit: impl Fn(String) -> String) -> ModelFile {
        let text = edit(to_bag::MODEL.to_string());
        ModelFile::parse(&text, "model.toml", &model::known(effects::all())).unwrap()
    }

    fn same(a: &[f64], b: &[f64], within: f64) {
        assert_eq!(a.len(), b.len());
        let worst = a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(worst <= within, "{worst}");
    }

    #[test]
    fn the_same_run_as_from_csv() {
        let folder = tempfile::tempdir().unwrap();
        let path = written(&folder, "eights.mcap", &to_bag::bag(&rows()).unwrap());
        let (csv, found) =
            (Run::read(EXAMPLE, &example_model()).unwrap(), Run::read(&path, &bag_model(|t| t)).unwrap());
        // A time stamp since 1970 has a resolution of 0.24 µs as a double.
        same(&found.time, &csv.time, 5e-7);
        same(&found.apart.as_ref().unwrap().time, &csv.time, 5e-7);
        same(&found.x, &csv.x, 0.0);
        same(found.heading.as_ref().unwrap(), csv.heading.as_ref().unwrap(), 1e-9);
        assert_eq!((&found.roles, &found.inputs), (&csv.roles, &csv.inputs));
        assert_eq!((found.rows_dropped, found.apart.unwrap().one_clock), (0, true));
    }

    #[test]
    fn discover_names_what_hides_in_a_bag() {
        use creepage::discrepancy::discover::discover_aligned;
        use creepage::discrepancy::request::Request;
        use creepage::progress::unheard;
        let folder = tempfile::tempdir().unwrap();
        let path = written(&folder, "eights.mcap", &to_bag::bag(&rows()).unwrap());
        let file = bag_model(|t| t);
        let runs = [Run::read(&path, &file).unwrap()];
        let request =
            Request { file: &file, runs: &runs, held_out: &[], library: effects::all(), horizons: &[], seed: 0 };
        let report = discover_aligned(&request, None, &unheard).unwrap().report;
        let named: Vec<&str> = report.effects.iter().map(|e| e.id.as_str()).collect();
        assert_eq!(named, ["cornering-creep"]);
        assert!(report.data.clocks.is_empty(), "a bag has one clock");
    }

    #[test]
    fn topics_of_other_rates_are_brought_to_one_time() {
        let all = rows();
        let mut bytes = std::io::Cursor::new(Vec::new());
        let mut writer = mcap::Writer::new(&mut bytes).unwrap();
        let none = std::collections::BTreeMap::new();
        let schema = writer.add_schema("sensor_msgs/msg/JointState", "ros2msg", b"").unwrap();
        let fast = writer.add_channel(schema, "/fast", "cdr", &none).unwrap();
        let slow = writer.add_channel(schema, "/slow", "cdr", &none).unwrap();
        let schema = writer.add_schema("geometry_msgs/msg/PoseStamped", "ros2msg", b"").unwrap();
        let pose = writer.add_channel(schema, "/pose", "cdr", &none).unwrap();
        for (i, [t, x, y, ..]) in all.iter().take(200).enumerate() {
            let joint = |rate: f64| to_bag::Cdr::stamped(*t).u32(1).text("w").u32(0).u32(1).f64(rate).u32(0).done();
            let at = to_bag::Cdr::stamped(*t).f64s(&[*x, *y, 0.0, 0.0, 0.0, 0.0, 1.0]).done();
            let mut messages = vec![(fast, joint(t.sin())), (pose, at)];
            if i % 4 == 0 {
                messages.push((slow, joint(t.cos())));
            }
            for (channel_id, data) in messages {
                let header = mcap::records::MessageHeader { channel_id, sequence: 0, log_time: 5, publish_time: 0 };
                writer.write_to_known_channel(&header, &data).unwrap();
            }
        }
        writer.finish().unwrap();
        drop(writer);
        let folder = tempfile::tempdir().unwrap();
        let path = written(&folder, "run.mcap", &bytes.into_inner());
        let topics = |text: String| {
            text.replace("/mocap/pose:pose", "/pose:pose")
                .replace("/mocap/pose:yaw", "/pose:yaw")
                .replace("/joint_states:velocity.wheel", "/fast:velocity.w")
                .replace("/imu:angular_velocity.z", "/slow:velocity.w")
        };
        let run = Run::read(&path, &bag_model(topics)).unwrap();
        let time = &run.apart.as_ref().unwrap().time;
        // Behind the last slow message nothing is known of it.
        assert_eq!((time.len(), run.rows_dropped >= 3), (197, true), "{:?}", run.why_dropped);
        let slow = run.roles.iter().position(|r| r == "yaw_rate").unwrap();
        let worst = time.iter().zip(&run.inputs[slow]).map(|(t, v)| (t.cos() - v).abs()).fold(0.0, f64::max);
        assert!(worst < 2e-4, "{worst}");
    }

    #[test]
    fn wrong_topics_fields_and_types_are_explained() {
        let folder = tempfile::tempdir().unwrap();
        let path = written(&folder, "eights.mcap", &to_bag::bag(&rows()[..50]).unwrap());
        let error = Run::read(&path, &bag_model(|t| t.replace("/imu:angular_velocity.z", "/imu:angular_velocity.zz")));
        let error = error.unwrap_err();
        is_one_message(&error, &path);
        assert!(error.to_string().contains("did you mean \"/imu:angular_velocity.z\"?"), "{error}");
        let mut bytes = std::io::Cursor::new(Vec::new());
        let mut writer = mcap::Writer::new(&mut bytes).unwrap();
        let none = std::collections::BTreeMap::new();
        let schema = writer.add_schema("sensor_msgs/msg/Image", "ros2msg", b"").unwrap();
        let channel_id = writer.add_channel(schema, "/camera", "cdr", &none).unwrap();
        let header = mcap::records::MessageHeader { channel_id, sequence: 0, log_time: 5, publish_time: 0 };
        writer.write_to_known_channel(&header, &[0, 1, 0, 0, 1, 2]).unwrap();
        writer.finish().unwrap();
        drop(writer);
        let path = written(&folder, "image.mcap", &bytes.into_inner());
        let error = Run::read(&path, &bag_model(|t| t)).unwrap_err();
        is_one_message(&error, &path);
        assert!(error.to_string().contains("/camera (sensor_msgs/msg/Image)"), "{error}");
    }

    #[test]
    fn damage_is_one_message() {
        let bytes = to_bag::bag(&rows()[..60]).unwrap();
        let [refused, _] = survives_damage(&bytes, "run.mcap", &bag_model(|t| t));
        assert!(refused > 60, "{refused}");
    }

    #[test]
    fn a_message_of_another_layout_than_its_schema_says() {
        let mut bytes = std::io::Cursor::new(Vec::new());
        let mut writer = mcap::Writer::new(&mut bytes).unwrap();
        let none = std::collections::BTreeMap::new();
        let schema = writer.add_schema("nav_msgs/msg/Odometry", "ros2msg", b"").unwrap();
        let channel_id = writer.add_channel(schema, "/odom", "cdr", &none).unwrap();
        let header = mcap::records::MessageHeader { channel_id, sequence: 0, log_time: 5, publish_time: 0 };
        writer.write_to_known_channel(&header, &to_bag::Cdr::stamped(1.0).f64s(&[1.0; 7]).done()).unwrap();
        writer.finish().unwrap();
        drop(writer);
        let folder = tempfile::tempdir().unwrap();
        let path = written(&folder, "odom.mcap", &bytes.into_inner());
        let error = Run::read(&path, &bag_model(|t| t)).unwrap_err();
        is_one_message(&error, &path);
        assert!(error.to_string().contains("/odom is no nav_msgs/msg/Odometry"), "{error}");
    }
}
