//! Bags of ROS 2 messages in MCAP files: a column for every number of the messages that are known.
//!
//! Columns are called `TOPIC:FIELD`, such as `/odom:pose.pose.position.x`, `/mocap/pose:yaw` or
//! `/joint_states:velocity.left_wheel`; `stamp` is the time in a message's header, `log_time` that of its recording.

pub(crate) mod bag;
mod cdr;
mod messages;
