//! The part of an input in the motion of the body: what it drives and what it turns.

use serde::Deserialize;

/// What a measured input does to the body, with v its speed, m/s, and w its yaw rate, rad/s.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Moves {
    /// It is the speed v, m/s.
    Forward,
    /// The rate of a wheel of radius r that drives: v/r, rad/s.
    Wheel,
    /// The rate of a left wheel, of radius r on an axle of track a: (v - a·w/2)/r, rad/s.
    LeftWheel,
    /// The rate of a right wheel, of radius r on an axle of track a: (v + a·w/2)/r, rad/s.
    RightWheel,
    /// The rate of a wheel of a platform that moves sideways, too: by the wheel's place, heading and rollers, rad/s.
    OmniWheel,
    /// It is the yaw rate w, rad/s.
    Yaw,
    /// A steering angle, rad.
    Steering,
    /// The angle of a rear axle that is steered, too, rad: it turns the body the other way.
    RearSteering,
    /// A force or a torque: it accelerates the body, N or N·m. Of a vehicle with `[dynamics]`, and of no description.
    #[serde(skip)]
    Push,
    /// It changes the shape: it neither drives nor turns the body.
    Shape,
}

impl Moves {
    /// Whether it is the rate of a wheel.
    pub fn is_wheel(self) -> bool {
        matches!(self, Self::Wheel | Self::LeftWheel | Self::RightWheel | Self::OmniWheel)
    }

    /// Whether it says how the body turns and nothing else.
    pub fn is_turning(self) -> bool {
        matches!(self, Self::Yaw | Self::Steering | Self::RearSteering)
    }

    /// What an input of a usual name does, of a vehicle that does not declare it.
    pub(super) fn usual(role: &str) -> Option<Self> {
        Some(match role {
            "speed" => Self::Forward,
            "wheel_rate" => Self::Wheel,
            "wheel_rate_left" => Self::LeftWheel,
            "wheel_rate_right" => Self::RightWheel,
            "yaw_rate" => Self::Yaw,
            "steering_angle" => Self::Steering,
            _ => return None,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vehicles;

    #[test]
    fn every_input_of_the_catalogue_declares_what_it_does() {
        for vehicle in vehicles::all() {
            for (role, input) in &vehicle.inputs {
                assert!(input.moves.is_some(), "{}: {role}", vehicle.id);
                let instead = input.instead.as_ref();
                assert!(instead.is_none_or(|i| i.moves.is_some()), "{}: in the place of {role}", vehicle.id);
                let usual = Moves::usual(role);
                assert!(usual.is_none() || usual == input.moves, "{}: {role} is not the usual one", vehicle.id);
            }
        }
    }

    #[test]
    fn a_declaration_goes_before_a_name() {
        let mut own = vehicles::named("unicycle").unwrap().clone();
        assert_eq!((own.moved_by("speed"), own.moved_by("crank")), (Some(Moves::Forward), None));
        own.inputs.get_mut("yaw_rate").unwrap().moves = None;
        assert_eq!(own.moved_by("yaw_rate"), Some(Moves::Yaw));
        own.inputs.get_mut("yaw_rate").unwrap().moves = Some(Moves::Shape);
        assert_eq!(own.moved_by("yaw_rate"), Some(Moves::Shape));
    }
}
