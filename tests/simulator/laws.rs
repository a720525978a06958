//! The hidden effects gathered by the place where they act.

use super::hidden::Hidden;

/// The longest integration step, s, where a slip settles within a length that takes a tenth of a second.
const SHORT_STEP: f64 = 0.005;

/// Every hidden law as numbers, neutral where nothing is hidden.
#[derive(Debug, Clone)]
pub struct Laws {
    /// Factors on the radius of (left, right) wheel; a single wheel takes their mean.
    pub radius: (f64, f64),
    /// Rotation creep of (left, right) wheel.
    pub e_rc: (f64, f64),
    /// Rotation creep gained per m/s of rim speed, s/m.
    pub e_rc_per_speed: f64,
    /// Mass over drive viscosity, s; none where the drive grips.
    pub traction: Option<f64>,
    /// Mass over side viscosity, s; none where the wheel holds its track.
    pub cornering: Option<f64>,
    /// Traverse creep at the reference point and at the steered wheel.
    pub e_tc: (f64, f64),
    /// Relaxation length (m) and the traverse creep it tends to.
    pub relaxation: Option<(f64, f64)>,
    /// Lateral slip per v_l²·yaw, s²/m.
    pub per_load: f64,
    /// Lateral slip per yaw·|yaw|, m·s.
    pub per_yaw_square: f64,
    /// Lateral slip per v_l·yaw in left turns, s.
    pub per_left_turn: f64,
    /// Yaw rate per speed, rad/m, and speed per yaw rate, m/rad, behind a logged speed and yaw rate.
    pub odometry: (f64, f64),
    /// Slope along the way: rate (m/s) and direction (rad).
    pub grade: (f64, f64),
    /// Lateral slip per v_l·yaw (s), and the speed that it does not exceed (m/s).
    pub saturating: Option<(f64, f64)>,
    /// Side slope: rate (m/s) and direction (rad).
    pub slope: (f64, f64),
    /// Ground velocity, m/s.
    pub drift: (f64, f64),
    /// Gain and offset (rad/s) of the yaw rate.
    pub yaw: (f64, f64),
    /// Gain, offset (rad) and cubic (1/rad²) of the steering angle.
    pub steering: (f64, f64, f64),
    /// Understeer gradient, s²/m².
    pub understeer: f64,
    /// Factor on the track width.
    pub track: f64,
    /// Factor on the wheelbase.
    pub wheelbase: f64,
    /// Delay from log to motion, s.
    pub delay: f64,
    /// Tracked point, m forward and m left.
    pub lever: (f64, f64),
    /// Measured minus body heading, rad.
    pub misalignment: f64,
    /// For each trailer: traverse creep, factor on its length, metres added to its hitch offset.
    pub trailers: Vec<(f64, f64, f64)>,
}

impl Laws {
    /// Gathers the effects for a vehicle with so many trailers.
    pub fn new(hidden: &[Hidden], trailers: usize) -> Self {
        hidden.iter().fold(Self::neutral(trailers), |laws, effect| laws.with(effect))
    }

    fn neutral(trailers: usize) -> Self {
        Laws {
            radius: (1.0, 1.0),
            e_rc: (0.0, 0.0),
            e_rc_per_speed: 0.0,
            traction: None,
            cornering: None,
            e_tc: (0.0, 0.0),
            relaxation: None,
            per_load: 0.0,
            per_yaw_square: 0.0,
            per_left_turn: 0.0,
            odometry: (0.0, 0.0),
            grade: (0.0, 0.0),
            saturating: None,
            slope: (0.0, 0.0),
            drift: (0.0, 0.0),
            yaw: (1.0, 0.0),
            steering: (1.0, 0.0, 0.0),
            understeer: 0.0,
            track: 1.0,
            wheelbase: 1.0,
            delay: 0.0,
            lever: (0.0, 0.0),
            misalignment: 0.0,
            trailers: vec![(0.0, 1.0, 0.0); trailers],
        }
    }

    fn with(mut self, effect: &Hidden) -> Self {
        match *effect {
            Hidden::RotationCreep { e_rc } => self.creep_further(e_rc, e_rc),
            Hidden::UnequalRotationCreep { e_left, e_right } => self.creep_further(e_left, e_right),
            Hidden::SpeedRotationCreep { per_speed } => self.e_rc_per_speed = per_speed,
            Hidden::WheelRadius { scale } => {
                self.radius.0 *= 1.0 + scale;
                self.radius.1 *= 1.0 + scale;
            }
            Hidden::WheelRadiusMismatch { scale } => self.radius.0 *= 1.0 + scale,
            Hidden::TractionCreep { mass_over_br } => self.traction = Some(mass_over_br),
            Hidden::CorneringCreep { mass_over_bt } => self.cornering = Some(mass_over_bt),
            Hidden::TraverseCreep { e_tc } => self.e_tc.0 = e_tc,
            Hidden::FrontTraverseCreep { e_tc } => self.e_tc.1 = e_tc,
            Hidden::RelaxationLength { length, e_tc } => self.relaxation = Some((length, e_tc)),
            Hidden::LoadDependentCreep { c } => self.per_load = c,
            Hidden::YawSquareSlip { q } => self.per_yaw_square = q,
            Hidden::LeftTurnSlip { q } => self.per_left_turn = q,
            Hidden::OdometryYawPerSpeed { k } => self.odometry.0 = k,
            Hidden::OdometrySpeedPerYaw { k } => self.odometry.1 = k,
            Hidden::Grade { rate, direction } => self.grade = (rate, direction),
            Hidden::SaturatingCreep { c, limit } => self.saturating = Some((c, limit)),
            Hidden::SideSlope { rate, direction } => self.slope = (rate, direction),
            Hidden::Drift { vx, vy } => self.drift = (vx, vy),
            Hidden::YawRateBias { bias } => self.yaw.1 = bias,
            Hidden::YawRateScale { scale } => self.yaw.0 = 1.0 + scale,
            Hidden::SteeringGain { scale } => self.steering.0 = 1.0 + scale,
            Hidden::SteeringOffset { offset } => self.steering.1 = offset,
            Hidden::SteeringCubic { cubic } => self.steering.2 = cubic,
            Hidden::Understeer { gradient } => self.understeer = gradient,
            Hidden::TrackWidth { scale } => self.track = 1.0 + scale,
            Hidden::Wheelbase { scale } => self.wheelbase = 1.0 + scale,
            Hidden::InputDelay { delay } => self.delay = delay,
            Hidden::LeverArm { a, b } => self.lever = (a, b),
            Hidden::HeadingMisalignment { offset } => self.misalignment = offset,
            Hidden::TrailerTraverseCreep { trailer, e_tc } => self.trailers[trailer - 1].0 = e_tc,
            Hidden::TrailerLength { trailer, scale } => {
                self.trailers[trailer - 1].1 = 1.0 + scale;
            }
            Hidden::HitchOffset { trailer, offset } => self.trailers[trailer - 1].2 = offset,
        }
        self
    }

    /// Two creeps of one wheel multiply: 1 − e = (1 − e₁)(1 − e₂).
    fn creep_further(&mut self, left: f64, right: f64) {
        self.e_rc.0 = 1.0 - (1.0 - self.e_rc.0) * (1.0 - left);
        self.e_rc.1 = 1.0 - (1.0 - self.e_rc.1) * (1.0 - right);
    }

    /// Ground speeds (m/s) of the left and right wheel for their nominal rim speeds (m/s).
    pub fn ground_speed(&self, left: f64, right: f64) -> (f64, f64) {
        let one = |rim: f64, e: f64| rim * (1.0 - e - self.e_rc_per_speed * rim.abs());
        (one(self.radius.0 * left, self.e_rc.0), one(self.radius.1 * right, self.e_rc.1))
    }

    /// The longest integration step, s, where a usual one is enough for what the driver does: an eighth of the time in
    /// which a slip settles, so that the scheme converges; a length is one of a tenth of a second and less.
    pub fn longest_step(&self, usual: f64) -> f64 {
        let in_time = [self.traction, self.cornering].into_iter().flatten().map(|time| time / 8.0);
        let in_length = self.relaxation.map(|_| SHORT_STEP);
        in_time.chain(in_length).fold(usual, f64::min)
    }

    /// What gravity adds to the speed along a heading (rad), m/s.
    pub fn downhill(&self, heading: f64) -> f64 {
        let (rate, direction) = self.grade;
        if rate == 0.0 { 0.0 } else { rate * (direction - heading).cos() }
    }

    /// The true steering angle (rad) for the logged one.
    pub fn steered(&self, logged: f64) -> f64 {
        let (gain, offset, cubic) = self.steering;
        logged * gain + offset + cubic * logged.powi(3)
    }

    /// The lateral slip (m/s) that leaves the yaw rate alone, by speed, yaw rate and heading.
    pub fn slip(&self, v_l: f64, yaw: f64, heading: f64) -> f64 {
        let (rate, direction) = self.slope;
        let downhill = if rate == 0.0 { 0.0 } else { rate * (direction - heading).sin() };
        let limited = self.saturating.map_or(0.0, |(c, limit)| limit * (c * v_l * yaw / limit).tanh());
        downhill
            - limited
            - self.per_load * v_l * v_l * yaw
            - self.per_yaw_square * yaw * yaw.abs()
            - self.per_left_turn * v_l * yaw.max(0.0)
    }
}
