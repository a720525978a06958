//! The body of the vehicle: wheels on the ground and Newton's law for what slips.

use super::contact::{Contact, Facing, Plane, Twist, arrow, left_of, motion};
use super::lately::Lately;
use super::laws::Laws;
use super::profile::Profile;
use super::trailer::{self, Trailer};
use super::vehicle::{Parameters, Tractor};

/// Where the parts of the state vector stand: pose, velocity through the carpet of the
/// kinematic slips, relaxed slip, then one absolute heading for each trailer.
pub const HEADING: usize = 2;
const VELOCITY: usize = 3;
const RELAXED: usize = 5;
/// The first trailer's heading in the state vector.
pub const TRAILERS: usize = 6;

/// How the reference point moves over the ground, in the body's own axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pace {
    /// Forward speed, m/s.
    pub v_l: f64,
    /// Lateral speed, m/s, left positive.
    pub v_t: f64,
    /// Yaw rate, rad/s.
    pub yaw: f64,
}

/// What the state says about the instant: the pace, the part of the lateral speed that the wheels
/// themselves make, and the forward speed their drive asks for.
struct Instant {
    pace: Pace,
    wheels_v_t: f64,
    asked: f64,
}

/// A vehicle, what it hides and what its driver does.
pub struct Body {
    /// What pulls.
    pub tractor: Tractor,
    /// The dimensions the user believes in.
    pub nominal: Parameters,
    /// Every hidden effect.
    pub laws: Laws,
    /// The trailers with their true dimensions.
    pub trailers: Vec<Trailer>,
    /// The driver.
    pub profile: Profile,
    /// The speed and turn that were asked of the wheels at the last times.
    pub asked: Lately<(f64, f64)>,
    /// How fast the speed that is asked changed at the last times, m/s².
    pub speeding: Lately<f64>,
}

impl Body {
    /// The state at time `t` (s) with pose `(x, y, heading)`, slips at the values the wheels ask for.
    pub fn at_rest_in(&self, t: f64, pose: [f64; 3], trailer_headings: &[f64]) -> Vec<f64> {
        let [x, y, heading] = pose;
        let facing = Facing::new(heading);
        let speed = self.rolling(t, &facing, 0.0).velocity.dot(&facing.forward);
        let relaxed = self.laws.relaxation.map_or(0.0, |(_, e_tc)| e_tc * speed);
        let velocity = self.rolling(t, &facing, relaxed).velocity;
        let mut state = vec![x, y, heading, velocity.x, velocity.y, relaxed];
        state.extend(trailer_headings);
        state
    }

    /// The state carried rigidly to another pose.
    pub fn moved_to(&self, state: &[f64], pose: [f64; 3]) -> Vec<f64> {
        let turn = pose[2] - state[HEADING];
        let velocity = velocity(state);
        let turned = velocity * turn.cos() + left_of(velocity) * turn.sin();
        let mut moved = vec![pose[0], pose[1], pose[2], turned.x, turned.y, state[RELAXED]];
        moved.extend(state[TRAILERS..].iter().map(|heading| heading + turn));
        moved
    }

    /// The motion over the ground at time `t` (s).
    pub fn pace(&self, t: f64, state: &[f64]) -> Pace {
        self.instant(t, state, &Facing::new(state[HEADING])).pace
    }

    /// The time derivative of the state at time `t` (s).
    pub fn rates(&self, t: f64, state: &[f64]) -> Vec<f64> {
        let facing = Facing::new(state[HEADING]);
        let Facing { forward, side, .. } = facing;
        let now = self.instant(t, state, &facing);
        let Pace { v_l, v_t, yaw } = now.pace;
        let over_ground = forward * v_l + side * v_t;
        let along = self.push(t, &now);
        let relaxing = self.relaxing(state[RELAXED], v_l);
        let across = self.side_push(&now, state[RELAXED], along + yaw * now.wheels_v_t, relaxing);
        let force = forward * along + side * across;
        let ground = Plane::new(self.laws.drift.0, self.laws.drift.1);
        let travel = over_ground + ground;
        let mut rates = vec![travel.x, travel.y, yaw, force.x, force.y, relaxing];
        let headings = &state[TRAILERS..];
        let axle = (facing, over_ground, yaw);
        rates.extend(trailer::turning(&self.trailers, axle, headings));
        rates
    }

    /// Force per mass along the heading: the drive's viscosity, or the reaction that keeps the roll.
    fn push(&self, t: f64, now: &Instant) -> f64 {
        let Pace { v_l, v_t, yaw } = now.pace;
        match self.laws.traction {
            Some(time) => (now.asked - v_l) / time + yaw * (v_t - now.wheels_v_t),
            None => self.asked_acceleration(t) - yaw * now.wheels_v_t,
        }
    }

    /// Force per mass across the heading: the side viscosity, or the reaction that keeps the track.
    fn side_push(&self, now: &Instant, relaxed: f64, speeding: f64, relaxing: f64) -> f64 {
        let e_tc = self.laws.e_tc.0;
        match self.laws.cornering {
            Some(time) => -(now.wheels_v_t - e_tc * now.pace.v_l - relaxed) / time,
            None => e_tc * speeding + relaxing + now.pace.yaw * now.pace.v_l,
        }
    }

    /// `(e_tc·v_l − u)·|v_l|/length`, m/s².
    fn relaxing(&self, relaxed: f64, v_l: f64) -> f64 {
        self.laws.relaxation.map_or(0.0, |(length, e_tc)| (e_tc * v_l - relaxed) * v_l.abs() / length)
    }

    fn instant(&self, t: f64, state: &[f64], facing: &Facing) -> Instant {
        let forward = facing.forward;
        let ideal = self.rolling(t, facing, state[RELAXED]);
        let asked = ideal.velocity.dot(&forward);
        let wheels = match self.laws.traction {
            Some(_) => {
                let v_l = velocity(state).dot(&forward);
                self.rolling_at(v_l, ideal.yaw, t, facing, state[RELAXED])
            }
            None => ideal,
        };
        let v_l = wheels.velocity.dot(&forward);
        let held = match self.laws.cornering {
            Some(_) => velocity(state),
            None => wheels.velocity,
        };
        let wheels_v_t = held.dot(&facing.side);
        let yaw = wheels.yaw / (1.0 + self.laws.understeer * v_l * v_l);
        let v_t = wheels_v_t + self.laws.slip(v_l, yaw, facing.heading);
        Instant { pace: Pace { v_l, v_t, yaw }, wheels_v_t, asked }
    }

    /// The motion in which every wheel obeys its contact.
    fn rolling(&self, t: f64, facing: &Facing, relaxed: f64) -> Twist {
        let (drive, turn) = self.wheels(t, facing);
        motion([drive, self.rear_track(facing, relaxed), turn])
    }

    /// The same with the forward speed given and the drive free to spin.
    fn rolling_at(&self, v_l: f64, ideal_yaw: f64, t: f64, facing: &Facing, relaxed: f64) -> Twist {
        let turn = if self.tractor.is_steered() { self.wheels(t, facing).1 } else { Contact::turning(ideal_yaw) };
        let drive = Contact::new(Plane::zeros(), facing.forward, v_l);
        motion([drive, self.rear_track(facing, relaxed), turn])
    }

    /// The rear axle moves across its heading only by creep.
    fn rear_track(&self, facing: &Facing, relaxed: f64) -> Contact {
        let across = facing.side - facing.forward * self.laws.e_tc.0;
        Contact::new(Plane::zeros(), across, relaxed)
    }

    /// The driving contact and the one that turns the body.
    fn wheels(&self, t: f64, facing: &Facing) -> (Contact, Contact) {
        let Facing { forward, side, .. } = *facing;
        let (speed, turn) = self.asked_of_wheels(t);
        let centre = Plane::zeros();
        let downhill = self.laws.downhill(facing.heading);
        let ground = self.axle_speed(speed) + downhill;
        match self.tractor {
            Tractor::Unicycle => {
                let (yaw_per_speed, speed_per_yaw) = self.laws.odometry;
                let yaw = turn * self.laws.yaw.0 + self.laws.yaw.1 + yaw_per_speed * speed;
                let ground = ground + speed_per_yaw * turn;
                (Contact::new(centre, forward, ground), Contact::turning(yaw))
            }
            Tractor::DifferentialDrive => {
                let rim = 0.5 * self.nominal.track_width * turn;
                let (left, right) = self.laws.ground_speed(speed - rim, speed + rim);
                let reach = side * (0.5 * self.nominal.track_width * self.laws.track);
                let [left, right] = [left, right].map(|speed| speed + downhill);
                (Contact::new(reach, forward, left), Contact::new(-reach, forward, right))
            }
            Tractor::Car | Tractor::FourWheelCar => {
                (Contact::new(centre, forward, ground), self.front(facing, turn, None))
            }
            Tractor::Tricycle => (self.front(facing, turn, Some(ground)), self.front(facing, turn, None)),
        }
    }

    /// The middle of a driven axle moves at the mean of its wheels' ground speeds; a single wheel is
    /// an axle of two alike.
    fn axle_speed(&self, rim: f64) -> f64 {
        let (left, right) = self.laws.ground_speed(rim, rim);
        0.5 * (left + right)
    }

    /// The steered wheel: it rolls at a speed (m/s) along its own heading, or holds its track across it.
    fn front(&self, facing: &Facing, logged: f64, rolls: Option<f64>) -> Contact {
        let at = facing.forward * (self.nominal.wheelbase * self.laws.wheelbase);
        let along = arrow(facing.heading + self.laws.steered(logged));
        match rolls {
            Some(speed) => Contact::new(at, along, speed),
            None => Contact::new(at, left_of(along) - along * self.laws.e_tc.1, 0.0),
        }
    }

    /// Nominal rim speed (m/s) and turn (rad/s or rad) that act at time `t`.
    fn asked_of_wheels(&self, t: f64) -> (f64, f64) {
        let logged_at = t - self.laws.delay;
        self.asked.at(logged_at, || (self.profile.speed.value(logged_at), self.profile.turn.value(logged_at)))
    }

    /// How fast the speed asked by the drive changes, m/s²: it depends on time alone, so a
    /// five-point difference (error h⁴·s⁗′/30 ~ 1e-13) serves every law alike.
    fn asked_acceleration(&self, t: f64) -> f64 {
        if self.laws.cornering.is_none() {
            // Then the velocity state is not read: its drift does no harm.
            return 0.0;
        }
        self.speeding.at(t, || {
            let h = 1e-3;
            let ahead = Facing::new(0.0);
            let asked = |steps: f64| self.rolling(t + steps * h, &ahead, 0.0).velocity.x;
            (8.0 * (asked(1.0) - asked(-1.0)) - (asked(2.0) - asked(-2.0))) / (12.0 * h)
        })
    }
}

fn velocity(state: &[f64]) -> Plane {
    Plane::new(state[VELOCITY], state[VELOCITY + 1])
}
