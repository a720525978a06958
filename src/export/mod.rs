//! Export: a model with its findings as what a robot reads.
//!
//! | target | what is written |
//! |---|---|
//! | `ros2-diff-drive` | parameters of ROS 2's `diff_drive_controller` |
//! | `ros2-steering` | parameters of ROS 2's `steering_controllers_library` and `tricycle_controller` |
//! | `vesc` | gains and offsets of a VESC driver, as F1TENTH cars have it |
//! | `wpilib` | constants of WPILib's kinematics |
//! | `urdf` | a given description with corrected wheels and tracked frame |
//! | `json` | corrected parameters and corrections |
//! | `c`, `cpp`, `python`, `rust` | a step of the model with its Jacobian, an observer and the inverse kinematics, without dependencies |
//!
//! What a target cannot say stands in a comment of it, and in [`Exported::unsaid`].

mod code;
mod corrections;
mod description_lines;
mod exported;
mod function;
mod language;
mod parameters;
mod robot_description;

pub use code::Code;
pub(crate) use code::WALK;
pub use description_lines::description_lines;
pub use exported::Exported;
pub use language::Language;
pub use parameters::{Gains, Target};
pub use robot_description::patched_description;
