//! What is read of the messages of a bag, and when.

#![cfg(feature = "mcap")]

use crate::to_bag::Cdr;
use crate::two_names::read_under_two_names;
use creepage::files::{ModelFile, Run};
use creepage::{Result, effects, model};
use std::collections::BTreeMap;

/// A message: its topic, its type, when it was recorded in nanoseconds, and what it says.
type Said = (&'static str, &'static str, u64, Vec<u8>);

const ODOMETRY: &str = "nav_msgs/msg/Odometry";
const JOINTS: &str = "sensor_msgs/msg/JointState";

fn read(messages: &[Said], columns: &str) -> Result<Run> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    let mut writer = mcap::Writer::new(&mut bytes).unwrap();
    let mut channels = BTreeMap::new();
    for (topic, kind, ..) in messages {
        if !channels.contains_key(topic) {
            let schema = writer.add_schema(kind, "ros2msg", b"").unwrap();
            channels.insert(*topic, writer.add_channel(schema, topic, "cdr", &BTreeMap::new()).unwrap());
        }
    }
    for (topic, _, log_time, data) in messages {
        let (channel_id, log_time) = (channels[topic], *log_time);
        let header = mcap::records::MessageHeader { channel_id, sequence: 0, log_time, publish_time: 0 };
        writer.write_to_known_channel(&header, data).unwrap();
    }
    writer.finish().unwrap();
    drop(writer);
    let text = format!("vehicle = \"unicycle\"\n[parameters]\nwheel_radius = 0.1\n[columns]\n{columns}");
    let model = ModelFile::parse(&text, "model.toml", &model::known(effects::all())).unwrap();
    read_under_two_names("run.MCAP", bytes.get_ref(), &model)
}

/// An odometry message at a place, turned by a quaternion, with twelve numbers of a twist that tell themselves apart.
fn odometry(t: f64, place: [f64; 3], turn: [f64; 4]) -> Vec<u8> {
    let twist = [t + 1.0, t + 2.0, t + 3.0, t + 4.0, t + 5.0, t + 6.0];
    let whole = Cdr::stamped(t).text("base").f64s(&place).f64s(&turn).f64s(&[9.0; 36]);
    whole.f64s(&twist).f64s(&[9.0; 36]).done()
}

fn joints(t: f64, names: &[&str], rates: &[f64]) -> Vec<u8> {
    let count = names.len() as u32;
    let named = names.iter().fold(Cdr::stamped(t).u32(count), |cdr, name| cdr.text(name));
    named.u32(0).u32(count).f64s(rates).u32(0).done()
}

/// The quaternion of a body turned by a yaw, then pitched, then rolled.
fn turned(yaw: f64, pitch: f64, roll: f64) -> [f64; 4] {
    let about = |axis: nalgebra::Vector3<f64>, angle| {
        nalgebra::UnitQuaternion::from_axis_angle(&nalgebra::Unit::new_unchecked(axis), angle)
    };
    let [x, y, z] = [nalgebra::Vector3::x(), nalgebra::Vector3::y(), nalgebra::Vector3::z()];
    let q = about(z, yaw) * about(y, pitch) * about(x, roll);
    [q.i, q.j, q.k, q.w]
}

const ODOMETRY_COLUMNS: &str = "time = \"stamp\"\nx = \"/odom:pose.pose.position.x\"\n\
    y = \"/odom:pose.pose.position.y\"\nheading = \"/odom:yaw\"\n\
    wheel_rate = \"/odom:twist.twist.linear.x\"\nyaw_rate = \"/odom:twist.twist.angular.z\"\n";

/// Every field of an odometry message stands where its name says, and the yaw is that of a body on uneven ground.
#[test]
fn an_odometry_message_is_read_whole() {
    let turns = [(0.4, 0.0, 0.0), (1.9, 0.2, -0.1), (-2.8, -0.3, 0.25), (-0.7, 0.6, 1.1)];
    let said = |(i, (yaw, pitch, roll)): (usize, (f64, f64, f64))| {
        let t = i as f64;
        ("/odom", ODOMETRY, 5, odometry(t, [10.0 + t, 20.0 - t, 30.0], turned(yaw, pitch, roll)))
    };
    let messages: Vec<Said> = turns.into_iter().enumerate().map(said).collect();
    let run = read(&messages, ODOMETRY_COLUMNS).unwrap();
    assert_eq!((run.time.as_slice(), run.x.as_slice()), (&[0.0, 1.0, 2.0, 3.0][..], &[10.0, 11.0, 12.0, 13.0][..]));
    assert_eq!(run.y, [20.0, 19.0, 18.0, 17.0]);
    let input = |role: &str| &run.inputs[run.roles.iter().position(|r| r == role).unwrap()];
    assert_eq!(input("wheel_rate"), &[1.0, 2.0, 3.0, 4.0]);
    assert_eq!(input("yaw_rate"), &[6.0, 7.0, 8.0, 9.0]);
    for (found, (yaw, pitch, roll)) in run.heading.unwrap().into_iter().zip(turns) {
        let apart = (found - yaw + std::f64::consts::PI).rem_euclid(std::f64::consts::TAU) - std::f64::consts::PI;
        assert!(apart.abs() < 1e-12, "yaw {yaw}, pitch {pitch}, roll {roll}: {found}");
    }
    assert_eq!((run.rows_dropped, run.why_dropped.len()), (0, 0));
}

/// A quaternion that was never set has no yaw; one that is merely not of length one has.
#[test]
fn a_quaternion_that_was_never_set_has_no_yaw() {
    let turns = [[0.0; 4], [0.0, 0.0, 0.5, 0.5], [0.0, 0.0, 1.0, 1.0], [0.1, 0.0, 0.0, 0.1]];
    let said = |(i, turn)| ("/odom", ODOMETRY, 5, odometry(i as f64, [0.0; 3], turn));
    let messages: Vec<Said> = turns.into_iter().enumerate().map(said).collect();
    let run = read(&messages, ODOMETRY_COLUMNS).unwrap();
    assert_eq!((run.time.len(), run.rows_dropped), (2, 2), "{:?}", run.why_dropped);
    run.heading.unwrap().iter().for_each(|h| assert!((h - std::f64::consts::FRAC_PI_2).abs() < 1e-12, "{h}"));
}

/// A body on its side or on its head has a quaternion as good as any.
#[test]
fn every_quaternion_of_length_one_has_a_yaw() {
    let pi = std::f64::consts::PI;
    for (axis, yaw) in [0.0, pi, pi, 0.0].into_iter().enumerate() {
        let mut turn = [0.0; 4];
        turn[axis] = -1.0;
        let messages = [0.0, 1.0].map(|t| ("/odom", ODOMETRY, 5, odometry(t, [0.0; 3], turn)));
        let run = read(&messages, ODOMETRY_COLUMNS).unwrap();
        run.heading.unwrap().iter().for_each(|h| assert!((h.abs() - yaw).abs() < 1e-12, "{turn:?}: {h}"));
    }
}

#[test]
fn poses_without_inputs_are_told() {
    let mut messages: Vec<Said> = Vec::new();
    for t in [0.0, 0.1, 0.2] {
        messages.push(("/odom", ODOMETRY, 5, odometry(t, [t, 0.0, 0.0], turned(0.0, 0.0, 0.0))));
        messages.push(("/joints", JOINTS, 5, joints(t + 100.0, &["left", "right"], &[t, t])));
    }
    let columns = ODOMETRY_COLUMNS
        .replace("/odom:twist.twist.linear.x", "/joints:velocity.right")
        .replace("/odom:twist.twist.angular.z", "/joints:velocity.left");
    let error = read(&messages, &columns).unwrap_err();
    assert!(error.to_string().contains("its poses have no inputs at their times; check the stamps"), "{error}");
}

/// Recording has a clock of its own, in nanoseconds.
#[test]
fn times_of_recording_are_read_in_seconds() {
    let said =
        |i: u64| ("/odom", ODOMETRY, 3_000_000_000 + 250_000_000 * i, odometry(0.0, [0.0; 3], turned(0.1, 0.0, 0.0)));
    let messages: Vec<Said> = (0..3).map(said).collect();
    let run = read(&messages, &ODOMETRY_COLUMNS.replace("stamp", "log_time")).unwrap();
    assert_eq!(run.time, [0.0, 0.25, 0.5]);
}

/// One message of joint states may tell of other joints than the next; an odometry message never differs, so a broken one
/// of a topic that nobody asked for is no reason to refuse a bag.
#[test]
fn only_joints_differ_from_message_to_message() {
    let mut messages: Vec<Said> = Vec::new();
    for i in 0..6 {
        let t = 0.1 * f64::from(i);
        messages.push(("/odom", ODOMETRY, 5, odometry(t, [t, 0.0, 0.0], turned(0.0, 0.0, 0.0))));
        let joint = [joints(t, &["left"], &[t]), joints(t, &["left", "right"], &[t, 2.0 * t])];
        let joint = joint.into_iter().nth(usize::from(i > 0)).unwrap();
        messages.push(("/joints", JOINTS, 5, joint));
        let cut = if i == 0 { odometry(t, [0.0; 3], [0.0; 4]) } else { Cdr::stamped(t).done() };
        messages.push(("/other", ODOMETRY, 5, cut));
    }
    let columns = ODOMETRY_COLUMNS
        .replace("/odom:twist.twist.linear.x", "/joints:velocity.right")
        .replace("/odom:twist.twist.angular.z", "/joints:velocity.left");
    let run = read(&messages, &columns).unwrap();
    let wheel = &run.inputs[run.roles.iter().position(|r| r == "wheel_rate").unwrap()];
    assert_eq!(run.time.len(), 5, "{:?}", run.why_dropped);
    wheel.iter().zip(&run.apart.unwrap().time).for_each(|(v, t)| assert!((v - 2.0 * t).abs() < 1e-6, "{v} at {t}"));
}

/// A bag with more joints than any robot has is refused before it fills the memory with their names.
#[test]
fn the_number_of_joints_has_a_bound() {
    let names = |n: usize| (0..n).map(|i| format!("j{i}")).collect::<Vec<_>>();
    let bag = |n: usize| -> Vec<Said> {
        let names = names(n);
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        let rate = |t: f64| joints(t, &names, &vec![t; n]);
        let pose = |t: f64| odometry(t, [0.0; 3], turned(0.0, 0.0, 0.0));
        let said = |t: f64| [("/odom", ODOMETRY, 5, pose(t)), ("/joints", JOINTS, 5, rate(t))];
        [0.0, 0.1, 0.2].into_iter().flat_map(said).collect()
    };
    let columns = ODOMETRY_COLUMNS.replace("/odom:twist.twist.linear.x", "/joints:velocity.j7");
    // Ten fields are those of the odometry.
    assert_eq!(read(&bag(19_990), &columns).unwrap().time.len(), 3);
    let error = read(&bag(19_991), &columns).unwrap_err();
    assert!(error.to_string().contains("has too many fields; give a bag with fewer joints"), "{error}");
}

#[test]
fn what_is_wrong_with_a_message_is_said() {
    let good = || odometry(0.0, [0.0; 3], turned(0.0, 0.0, 0.0));
    let mut encoded = good();
    encoded[1] = 9;
    let mut text = good();
    // The first character of the frame's name.
    text[16] = 0xff;
    for (broken, why) in [
        (good()[..40].to_vec(), "it ends too early"),
        (encoded, "its encoding 0x0009 is not plain CDR"),
        (text, "a text in it is not UTF-8"),
    ] {
        let error = read(&[("/odom", ODOMETRY, 5, broken)], ODOMETRY_COLUMNS).unwrap_err();
        assert!(error.to_string().contains(why), "{error}");
    }
}
