//! Rolling contacts in world coordinates, and the one motion of the body that obeys three of them.

use nalgebra::{Vector2, Vector3};

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

/// A heading with the axes it gives a body, which much asks for at every instant.
#[derive(Debug, Clone, Copy)]
pub struct Facing {
    /// The heading, rad.
    pub heading: f64,
    /// The unit vector along it.
    pub forward: Plane,
    /// The unit vector to its left.
    pub side: Plane,
}

impl Facing {
    /// The axes of a body with a heading (rad).
    pub fn new(heading: f64) -> Self {
        let forward = arrow(heading);
        Facing { heading, forward, side: left_of(forward) }
    }
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

/// The motion that obeys all three contacts, by Cramer's rule.
pub fn motion(contacts: [Contact; 3]) -> Twist {
    let [a, b, c] = contacts.each_ref().map(Contact::row);
    let [at_a, at_b, at_c] = contacts.map(|contact| contact.speed);
    let (bc, ca, ab) = (b.cross(&c), c.cross(&a), a.cross(&b));
    let determinant = a.dot(&bc);
    assert!(determinant != 0.0, "the contacts of every vehicle here determine its motion");
    let solved = (bc * at_a + ca * at_b + ab * at_c) / determinant;
    Twist { velocity: solved.xy(), yaw: solved.z }
}
