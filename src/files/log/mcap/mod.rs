//! Bags of ROS 2 messages, in MCAP files or in SQLite: a column for every number of a message.
//!
//! Five types are known by heart, whether the bag defines them or not; all others are read by the definition that the bag
//! carries.
//!
//! Columns are called `TOPIC:FIELD`, such as `/odom:pose.pose.position.x`, `/mocap/pose:yaw` or
//! `/joint_states:velocity.left_wheel`; `stamp` is the time in a message's header, `log_time` that of its recording.

pub(crate) mod bag;
mod cdr;
mod container;
mod definition;
mod messages;
mod recorded;
#[cfg(feature = "db3")]
mod sqlite;
