//! Messages as bags hold them, whatever the file.

/// Where messages of one kind come from, and how they are laid out.
#[derive(Clone, Debug, Default)]
pub(crate) struct Source {
    /// Its number in the bag.
    pub id: u64,
    pub topic: String,
    /// The type of the messages, such as `nav_msgs/msg/Odometry`; empty where the bag does not say.
    pub kind: String,
    /// How messages are written; `cdr` is read.
    pub encoding: String,
    /// The definition of the type, where the bag carries one by the rules of `ros2msg`.
    pub definition: Option<String>,
}

/// A message.
pub(crate) struct Recorded<'a> {
    pub source: &'a Source,
    /// When it was recorded, ns.
    pub log_time: u64,
    pub data: &'a [u8],
}
