//! The usual column names of logs for the roles of a model file.

use super::column_units::suffix;

/// A role of `[columns]` and the names that logs give it, the most usual first.
struct Usual {
    role: &'static str,
    names: &'static [&'static str],
}

const USUAL: &[Usual] = &[
    Usual { role: "time", names: &["time", "t", "timestamp", "stamp", "sec", "secs", "seconds", "log_time", "clock"] },
    Usual { role: "x", names: &["x", "px", "pos_x", "x_pos", "position_x", "easting", "east"] },
    Usual { role: "y", names: &["y", "py", "pos_y", "y_pos", "position_y", "northing", "north"] },
    Usual {
        role: "heading",
        names: &[
            "heading",
            "yaw",
            "phi",
            "psi",
            "theta",
            "orientation",
            "angle",
            "compass",
            "bearing",
            "course",
            "azimuth",
        ],
    },
    Usual {
        role: "yaw_rate",
        names: &[
            "yaw_rate",
            "yawrate",
            "phi_dot",
            "yaw_dot",
            "gyro_z",
            "wz",
            "omega_z",
            "angular_velocity_z",
            "angular_z",
            "heading_rate",
            "turn_rate",
            "omega",
            "gyro",
            "psi_dot",
            "r",
            "w",
        ],
    },
    Usual {
        role: "speed",
        names: &[
            "speed",
            "v",
            "velocity",
            "v_wheel",
            "vx",
            "wheel_speed",
            "linear_velocity",
            "linear_x",
            "v_x",
            "v_l",
            "v_odom",
        ],
    },
    Usual { role: "wheel_rate", names: &["wheel_rate", "theta_dot", "wheel_omega", "omega_wheel", "wheel_velocity"] },
    Usual {
        role: "wheel_rate_left",
        names: &[
            "wheel_rate_left",
            "omega_left",
            "left_wheel_rate",
            "left_omega",
            "w_left",
            "wl",
            "omega_l",
            "w_l",
            "left_wheel_velocity",
            "theta_2_dot",
            "left_wheel",
            "left_rate",
            "left",
        ],
    },
    Usual {
        role: "wheel_rate_right",
        names: &[
            "wheel_rate_right",
            "omega_right",
            "right_wheel_rate",
            "right_omega",
            "w_right",
            "wr",
            "omega_r",
            "w_r",
            "right_wheel_velocity",
            "theta_1_dot",
            "right_wheel",
            "right_rate",
            "right",
        ],
    },
    Usual {
        role: "steering_angle",
        names: &["steering_angle", "steer_angle", "steering", "steer", "delta", "steering_wheel", "front_angle"],
    },
];

/// Words of what a vehicle was told or reckons itself, not of what was measured.
const DOUBTFUL: &[&str] =
    &["cmd", "command", "set", "setpoint", "target", "desired", "est", "nominal", "odom", "odometry"];
/// Words of another quantity, whatever stands beside them.
const OTHER: &[&str] = &[
    "acc",
    "accel",
    "acceleration",
    "jerk",
    "tick",
    "ticks",
    "count",
    "counts",
    "std",
    "sigma",
    "var",
    "variance",
    "cov",
    "covariance",
    "current",
    "effort",
    "torque",
];
/// Words of a rate, which no position and no angle has.
const RATES: &[&str] = &["rate", "dot", "vel", "velocity", "speed", "twist", "linear", "angular", "gyro"];
/// Words of a place, which no rate has.
const PLACES: &[&str] = &["position", "pose", "pos", "orientation", "quaternion"];
/// Words of a cumulative count.
const COUNTS: &[&str] = &["tick", "ticks", "count", "counts", "enc", "encoder", "encoders", "pulses"];
/// Words of a heading from north, clockwise.
const COMPASS: &[&str] = &["compass", "bearing", "azimuth", "course", "cog"];

/// The unit that a column's name ends in.
pub(crate) fn unit_of(column: &str) -> Option<&'static str> {
    suffix(&all_words(column)).map(|(unit, _)| unit)
}

/// Whether words are of a cumulative count.
pub(crate) fn is_count(words: &[String]) -> bool {
    words.iter().any(|w| COUNTS.contains(&w.as_str()))
}

/// Whether words are of a joint's position.
pub(crate) fn is_place(words: &[String]) -> bool {
    words.iter().any(|w| ["position", "pos", "angle"].contains(&w.as_str()))
}

/// Whether a name is that of a compass.
pub(crate) fn is_compass(column: &str) -> bool {
    words(column).iter().any(|w| COMPASS.contains(&w.as_str()))
}

/// Words that name the wheel of a role; none for a role that is no wheel's.
pub(crate) fn side_words(role: &str) -> Option<&'static [&'static str]> {
    match role {
        "wheel_rate_left" => Some(&["left", "l", "lw", "lh"]),
        "wheel_rate_right" => Some(&["right", "r", "rw", "rh"]),
        "wheel_rate" => Some(&["wheel", "motor", "drive", "encoder", "enc", "ticks"]),
        _ => None,
    }
}

/// How well a column's name says that it holds a role, better ones first; `None` for a name that says nothing of it.
pub(crate) fn rank(role: &str, column: &str) -> Option<usize> {
    if column == role {
        return Some(0);
    }
    let words = words(column);
    if words.iter().any(|w| OTHER.contains(&w.as_str()) || against(role).contains(&w.as_str())) {
        return None;
    }
    let doubt = if words.iter().any(|w| DOUBTFUL.contains(&w.as_str())) { 1000 } else { 0 };
    let names = USUAL.iter().find(|u| u.role == role).map_or(&[][..], |u| u.names);
    let own = [role];
    let names: Vec<&str> = if names.is_empty() { own.to_vec() } else { names.to_vec() };
    let spelled = names.iter().position(|name| words.join("_") == *name);
    if let Some(at) = spelled {
        return Some(1 + at + doubt);
    }
    // A word more than the name has: "gt_x", "pose.yaw".
    let within = |name: &&str| {
        let name: Vec<&str> = name.split('_').collect();
        words.windows(name.len()).any(|w| w.iter().zip(&name).all(|(a, b)| a == b))
    };
    names.iter().position(within).map(|at| 100 + at + 10 * words.len() + doubt)
}

/// Words that say that a column does not hold a role.
fn against(role: &str) -> &'static [&'static str] {
    match role {
        "x" | "y" | "heading" | "steering_angle" => RATES,
        "speed" | "yaw_rate" | "wheel_rate" | "wheel_rate_left" | "wheel_rate_right" => PLACES,
        _ => &[],
    }
}

/// The words of a column's name in lower case, a unit at the end left out.
pub(crate) fn words(column: &str) -> Vec<String> {
    let mut words = all_words(column);
    let unit = suffix(&words).map_or(0, |(_, taken)| taken);
    words.truncate(words.len() - unit);
    words
}

fn all_words(column: &str) -> Vec<String> {
    let spaced: String = column.chars().map(|c| if c.is_alphanumeric() { c } else { ' ' }).collect();
    spaced.split_whitespace().flat_map(humps).collect()
}

/// `wheelRateLeft` as its words.
fn humps(word: &str) -> Vec<String> {
    let mut found: Vec<String> = vec![];
    let mut before = false;
    for c in word.chars() {
        let begins = c.is_uppercase() && before;
        before = c.is_lowercase();
        if begins || found.is_empty() {
            found.push(String::new());
        }
        if let Some(last) = found.last_mut() {
            last.extend(c.to_lowercase());
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn usual_names_are_known() {
        for (role, column) in [
            ("time", "t"),
            ("time", "Time [s]"),
            ("time", "timestamp"),
            ("x", "gt_x"),
            ("x", "X_m"),
            ("y", "pose.position.y"),
            ("heading", "yaw_rad"),
            ("wheel_rate_left", "wheelRateLeft"),
            ("wheel_rate_left", "/joints:left_wheel.velocity"),
            ("yaw_rate", "gyro_z"),
            ("speed", "v_wheel"),
            ("steering_angle", "delta"),
            ("wheel_rate", "theta_dot"),
            ("speed", "/wheel_odom:twist.twist.linear.x"),
            ("yaw_rate", "/imu:angular_velocity.z"),
            ("heading", "orientation"),
            ("heading", "/mocap/pose:yaw"),
        ] {
            assert!(rank(role, column).is_some(), "{column} for {role}");
        }
        for (role, column) in [
            ("x", "vx"),
            ("x", "acc_x"),
            ("wheel_rate_left", "ticks_left"),
            ("time", "throttle"),
            ("heading", "yaw_rate"),
            ("x", "/odom:twist.twist.linear.x"),
            ("wheel_rate_left", "/joints:position.left_wheel"),
            ("wheel_rate", "wheel"),
            ("y", ""),
        ] {
            assert_eq!(rank(role, column), None, "{column} for {role}");
        }
    }

    #[test]
    fn what_was_measured_comes_before_what_was_told() {
        assert!(rank("x", "mocap_x") < rank("x", "odom_x"));
        assert!(rank("speed", "v") < rank("speed", "cmd_speed"));
        assert!(rank("speed", "speed") < rank("speed", "v"));
    }

    /// The role itself, its usual names in their order, names with a word more; what was only told comes last.
    #[test]
    fn ranks_are_in_the_order_of_likelihood() {
        for (role, column, rank_of_it) in [
            ("time", "time", 0),
            ("time", "Time", 1),
            ("time", "t", 2),
            ("time", "t [s]", 2),
            ("x", "gt_x", 120),
            ("yaw_rate", "imu/gyro_z", 134),
            ("yaw_rate", "imu.gyro.z", 134),
            ("yaw_rate", "gyro", 13),
            ("speed", "cmd_speed", 1120),
            ("speed", "odom_v_wheel_x", 1141),
            ("wheel_rate_left", "left", 13),
            ("mass", "mass", 0),
            ("mass", "Mass", 1),
            ("mass", "body_mass", 120),
        ] {
            assert_eq!(rank(role, column), Some(rank_of_it), "{column} for {role}");
        }
    }

    #[test]
    fn words_end_where_signs_or_capitals_begin() {
        for (column, expect) in [
            ("wheelRateLeft", &["wheel", "rate", "left"][..]),
            ("IMU_yaw", &["imu", "yaw"]),
            ("X_m", &["x"]),
            ("m", &["m"]),
            ("v.mps", &["v"]),
            ("m_s", &["m"]),
            ("yaw_radian", &["yaw", "radian"]),
            ("", &[]),
        ] {
            assert_eq!(words(column), expect, "{column}");
        }
    }

    #[test]
    fn a_rate_is_no_place_and_a_place_no_rate() {
        for role in ["x", "y", "heading", "steering_angle"] {
            assert_eq!(rank(role, &format!("{role}_dot")), None);
            assert!(rank(role, &format!("pose_{role}")).is_some());
        }
        for role in ["speed", "yaw_rate", "wheel_rate", "wheel_rate_left", "wheel_rate_right"] {
            assert_eq!(rank(role, &format!("pose_{role}")), None);
            assert!(rank(role, &format!("twist_{role}")).is_some());
        }
        assert!(rank("time", "pose_time").is_some() && rank("time", "twist_time").is_some());
    }
}
