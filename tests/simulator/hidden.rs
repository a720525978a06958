//! What the vehicle really does and its user does not know.

/// A hidden effect: one of the contract's table, or a law outside the library.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Hidden {
    /// `v_l = r·wheel_rate·(1 − e_rc)`.
    RotationCreep { e_rc: f64 },
    /// True wheel radius = nominal·(1 + scale).
    WheelRadius { scale: f64 },
    /// `m·(dv_l/dt − yaw·v_t) = b_R·(r·wheel_rate − v_l)`, with m/b_R in s.
    TractionCreep { mass_over_br: f64 },
    /// `v_t = e_tc·v_l` at the reference point.
    TraverseCreep { e_tc: f64 },
    /// The steered wheel's contact moves `e_tc` to its left for each metre along its rolling direction.
    FrontTraverseCreep { e_tc: f64 },
    /// Measured heading = body heading + offset (rad).
    HeadingMisalignment { offset: f64 },
    /// `m·(dv_t/dt + yaw·v_l) = −b_T·v_t`, with m/b_T in s.
    CorneringCreep { mass_over_bt: f64 },
    /// `v_t = −c·v_l²·yaw`, c in s²/m.
    LoadDependentCreep { c: f64 },
    /// `dv_t/dt = (e_tc·v_l − v_t)·|v_l|/length`, length in m.
    RelaxationLength { length: f64, e_tc: f64 },
    /// True yaw rate = logged + bias (rad/s).
    YawRateBias { bias: f64 },
    /// True yaw rate = logged·(1 + scale).
    YawRateScale { scale: f64 },
    /// True track width = nominal·(1 + scale).
    TrackWidth { scale: f64 },
    /// Left wheel radius = r·(1 + scale), right wheel radius = r.
    WheelRadiusMismatch { scale: f64 },
    /// Each wheel of a driven axle creeps by its own coefficient.
    UnequalRotationCreep { e_left: f64, e_right: f64 },
    /// True steering angle = logged + offset (rad).
    SteeringOffset { offset: f64 },
    /// True steering angle = logged·(1 + scale).
    SteeringGain { scale: f64 },
    /// Yaw rate divided by `1 + gradient·v_l²`, gradient in s²/m².
    Understeer { gradient: f64 },
    /// True wheelbase = nominal·(1 + scale).
    Wheelbase { scale: f64 },
    /// The vehicle does at t what was logged at t − delay (s).
    InputDelay { delay: f64 },
    /// The tracked point is a forward and b left of the reference point, m.
    LeverArm { a: f64, b: f64 },
    /// The ground moves with a constant velocity in world axes, m/s.
    Drift { vx: f64, vy: f64 },
    /// `v_t` gains `rate·sin(direction − heading)`, rate in m/s and direction in rad.
    SideSlope { rate: f64, direction: f64 },
    /// True yaw rate = logged + k·speed, k in rad/m.
    OdometryYawPerSpeed { k: f64 },
    /// True speed = logged + k·yaw rate, k in m/rad.
    OdometrySpeedPerYaw { k: f64 },
    /// `v_l` gains `rate·cos(direction − heading)`, rate in m/s and direction in rad.
    Grade { rate: f64, direction: f64 },
    /// `v_t = −limit·tanh(c·v_l·yaw/limit)`, c in s and limit in m/s.
    SaturatingCreep { c: f64, limit: f64 },
    /// The lateral speed of trailer `trailer` (1 = nearest) is e_tc times its own forward speed.
    TrailerTraverseCreep { trailer: usize, e_tc: f64 },
    /// True length of a trailer = nominal·(1 + scale).
    TrailerLength { trailer: usize, scale: f64 },
    /// True hitch offset of a trailer = nominal + offset (m).
    HitchOffset { trailer: usize, offset: f64 },
    /// Outside the library: `v_t = −q·yaw·|yaw|`, q in m·s.
    YawSquareSlip { q: f64 },
    /// Outside the library: `v_t = −q·v_l·max(yaw, 0)`, it slips in left turns only, q in s.
    LeftTurnSlip { q: f64 },
    /// Outside the library: rotation creep `e_rc = per_speed·|r·wheel_rate|`, per_speed in s/m.
    SpeedRotationCreep { per_speed: f64 },
    /// Outside the library: true steering angle = logged + cubic·logged³, cubic in 1/rad².
    SteeringCubic { cubic: f64 },
}

impl Hidden {
    /// The contract's name of the effect; none for a law outside the library.
    pub fn id(&self) -> Option<&'static str> {
        Some(match self {
            Hidden::RotationCreep { .. } => "rotation-creep",
            Hidden::WheelRadius { .. } => "wheel-radius",
            Hidden::TractionCreep { .. } => "traction-creep",
            Hidden::TraverseCreep { .. } => "traverse-creep",
            Hidden::FrontTraverseCreep { .. } => "front-traverse-creep",
            Hidden::HeadingMisalignment { .. } => "heading-misalignment",
            Hidden::CorneringCreep { .. } => "cornering-creep",
            Hidden::LoadDependentCreep { .. } => "load-dependent-creep",
            Hidden::RelaxationLength { .. } => "relaxation-length",
            Hidden::YawRateBias { .. } => "yaw-rate-bias",
            Hidden::YawRateScale { .. } => "yaw-rate-scale",
            Hidden::TrackWidth { .. } => "track-width",
            Hidden::WheelRadiusMismatch { .. } => "wheel-radius-mismatch",
            Hidden::UnequalRotationCreep { .. } => "unequal-rotation-creep",
            Hidden::SteeringOffset { .. } => "steering-offset",
            Hidden::SteeringGain { .. } => "steering-gain",
            Hidden::Understeer { .. } => "understeer",
            Hidden::Wheelbase { .. } => "wheelbase",
            Hidden::InputDelay { .. } => "input-delay",
            Hidden::LeverArm { .. } => "lever-arm",
            Hidden::Drift { .. } => "drift",
            Hidden::SideSlope { .. } => "side-slope",
            Hidden::OdometryYawPerSpeed { .. } => "odometry-yaw-per-speed",
            Hidden::OdometrySpeedPerYaw { .. } => "odometry-speed-per-yaw",
            Hidden::Grade { .. } => "grade",
            Hidden::SaturatingCreep { .. } => "saturating-creep",
            Hidden::TrailerTraverseCreep { .. } => "trailer-traverse-creep",
            Hidden::TrailerLength { .. } => "trailer-length",
            Hidden::HitchOffset { .. } => "hitch-offset",
            Hidden::YawSquareSlip { .. }
            | Hidden::LeftTurnSlip { .. }
            | Hidden::SpeedRotationCreep { .. }
            | Hidden::SteeringCubic { .. } => return None,
        })
    }

    /// The contract's parameter names with their true values, SI units.
    pub fn parameters(&self) -> Vec<(&'static str, f64)> {
        match *self {
            Hidden::RotationCreep { e_rc } => vec![("e_rc", e_rc)],
            Hidden::TractionCreep { mass_over_br } => vec![("mass_over_bR", mass_over_br)],
            Hidden::CorneringCreep { mass_over_bt } => vec![("mass_over_bT", mass_over_bt)],
            Hidden::TraverseCreep { e_tc } | Hidden::FrontTraverseCreep { e_tc } => {
                vec![("e_tc", e_tc)]
            }
            Hidden::HeadingMisalignment { offset } | Hidden::SteeringOffset { offset } => {
                vec![("offset", offset)]
            }
            Hidden::WheelRadius { scale }
            | Hidden::YawRateScale { scale }
            | Hidden::TrackWidth { scale }
            | Hidden::WheelRadiusMismatch { scale }
            | Hidden::SteeringGain { scale }
            | Hidden::Wheelbase { scale } => vec![("scale", scale)],
            Hidden::LoadDependentCreep { c } => vec![("c", c)],
            Hidden::RelaxationLength { length, e_tc } => vec![("length", length), ("e_tc", e_tc)],
            Hidden::YawRateBias { bias } => vec![("bias", bias)],
            Hidden::UnequalRotationCreep { e_left, e_right } => {
                vec![("e_left", e_left), ("e_right", e_right)]
            }
            Hidden::Understeer { gradient } => vec![("gradient", gradient)],
            Hidden::InputDelay { delay } => vec![("delay", delay)],
            Hidden::LeverArm { a, b } => vec![("a", a), ("b", b)],
            Hidden::Drift { vx, vy } => vec![("vx", vx), ("vy", vy)],
            Hidden::OdometryYawPerSpeed { k } | Hidden::OdometrySpeedPerYaw { k } => vec![("k", k)],
            Hidden::SaturatingCreep { c, limit } => vec![("c", c), ("limit", limit)],
            Hidden::SideSlope { rate, direction } | Hidden::Grade { rate, direction } => {
                vec![("rate", rate), ("direction", direction)]
            }
            Hidden::TrailerTraverseCreep { trailer, e_tc } => {
                vec![("trailer", trailer as f64), ("e_tc", e_tc)]
            }
            Hidden::TrailerLength { trailer, scale } => {
                vec![("trailer", trailer as f64), ("scale", scale)]
            }
            Hidden::HitchOffset { trailer, offset } => {
                vec![("trailer", trailer as f64), ("offset", offset)]
            }
            Hidden::YawSquareSlip { q } | Hidden::LeftTurnSlip { q } => vec![("q", q)],
            Hidden::SpeedRotationCreep { per_speed } => vec![("per_speed", per_speed)],
            Hidden::SteeringCubic { cubic } => vec![("cubic", cubic)],
        }
    }
}
