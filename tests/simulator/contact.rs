//! Rolling contacts in world coordinates, and the one motion of the body that obeys three of them.

use nalgebra::{Matrix3, Vector2, Vector3};

/// A vector in the plane of the ground, world axes.
pub type Plane = Vector2<f64>;

/// The unit vector at `angle` (rad) from the world's x axis.
pub fn arrow(angle: f64) -> Plane {
    Plane::new(angle.cos(), angle.sin())
}

/// `v` turned a quarter to the left.
pub fn left_of(v: Plane) -> Plane {
    Plane::new(-v.y, v.x)
}

/// Velocity of the reference point (m/s, world axes) and yaw rate (rad/s).
#[derive(Debug, Clone, Copy)]
pub struct Twist {
    /// Velocity of the reference point, m/s.
    pub velocity: Plane,
    /// Yaw rate, rad/s.
    pub yaw: f64,
}

/// One linear statement about the motion: `toward·velocity + lever·yaw = speed`.
#[derive(Debug, Clone, Copy)]
pub struct Contact {
    toward: Plane,
    lever: f64,
    speed: f64,
}

impl Contact {
    /// The body point `at` (m from the reference point, world axes) moves along `toward` at `speed` (m/s).
    pub fn new(at: Plane, toward: Plane, speed: f64) -> Self {
        Contact { toward, lever: toward.dot(&left_of(at)), speed }
    }

    /// The body turns at `yaw` (rad/s), whatever its wheels do.
    pub fn turning(yaw: f64) -> Self {
        Contact { toward: Plane::zeros(), lever: 1.0, speed: yaw }
    }

    fn row(&self) -> Vector3<f64> {
        Vector3::new(self.toward.x, self.toward.y, self.lever)
    }
}

/// The motion that obeys all three contacts.
pub fn motion(contacts: [Contact; 3]) -> Twist {
    let rows = contacts.map(|contact| contact.row().transpose());
    let speeds = Vector3::from(contacts.map(|contact| contact.speed));
    let solved =
        Matrix3::from_rows(&rows).lu().solve(&speeds).expect("the contacts of every vehicle here determine its motion");
    Twist { velocity: solved.xy(), yaw: solved.z }
}
