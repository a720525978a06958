//! A machine as numbers: bodies, wheels, contacts, hitches.

/// How a contact answers its slip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Law {
    /// It does not slip.
    Ideal,
    /// −b·slip, N·s/m.
    Viscous(f64),
    /// −k·slip/|speed|, N.
    Rocard(f64),
}

/// Below this speed Rocard's law, which has no slip angle at rest, grows no stiffer, m/s.
pub const NEARLY_AT_REST: f64 = 0.02;

/// A law with a limit of its force.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grip {
    /// The law.
    pub law: Law,
    /// The force that it does not exceed, N.
    pub limit: f64,
}

impl Grip {
    /// A law without a limit.
    pub fn of(law: Law) -> Self {
        Self { law, limit: f64::INFINITY }
    }

    /// The force along a slip; none of an ideal contact, which multipliers keep.
    pub fn force(&self, slip: f64, speed: f64) -> f64 {
        let force = match self.law {
            Law::Ideal => return 0.0,
            Law::Viscous(b) => -b * slip,
            Law::Rocard(k) => -k * slip / speed.abs().max(NEARLY_AT_REST),
        };
        force / (1.0 + (force / self.limit).powi(2)).sqrt()
    }

    /// Another stiffness, by a factor.
    pub fn scaled(self, by: f64) -> Self {
        let law = match self.law {
            Law::Ideal => Law::Ideal,
            Law::Viscous(b) => Law::Viscous(b * by),
            Law::Rocard(k) => Law::Rocard(k * by),
        };
        Self { law, ..self }
    }
}

/// A rigid body; places on it count from its reference point, ahead and to the left.
#[derive(Clone, Copy, Debug)]
pub struct Solid {
    /// kg.
    pub mass: f64,
    /// About the centre of mass, kg·m².
    pub inertia: f64,
    /// The centre of mass, m.
    pub centre: [f64; 2],
}

/// A wheel that turns about its axle.
#[derive(Clone, Copy, Debug)]
pub struct Wheel {
    /// m.
    pub radius: f64,
    /// kg·m².
    pub inertia: f64,
    /// The input that drives it.
    pub input: Option<usize>,
    /// N·m for each unit of the input.
    pub gain: f64,
    /// N·m·s.
    pub viscous: f64,
    /// N·m.
    pub coulomb: f64,
    /// Half the impulse of the torque that the motor spends on crossing the play of its gear, N·m·s.
    pub play: f64,
}

/// Where something touches the ground.
#[derive(Clone, Copy, Debug)]
pub struct Contact {
    /// The body.
    pub body: usize,
    /// On it, from its reference point.
    pub at: [f64; 2],
    /// The input that is its angle.
    pub steered: Option<usize>,
    /// The wheel that rolls there.
    pub rolls: Option<(usize, Grip)>,
    /// What holds it sideways.
    pub side: Option<Grip>,
}

/// A pin between two bodies.
#[derive(Clone, Copy, Debug)]
pub struct Hitch {
    /// The body ahead.
    pub front: usize,
    /// How far behind its reference point, m.
    pub behind: f64,
    /// How far ahead of the reference point of the next body, m.
    pub length: f64,
}

/// A machine, and what pushes it beside its wheels.
#[derive(Clone, Debug)]
pub struct Machine {
    /// Bodies, the towing one first.
    pub solids: Vec<Solid>,
    /// Wheels.
    pub wheels: Vec<Wheel>,
    /// Contacts.
    pub contacts: Vec<Contact>,
    /// Hitches, from front to back.
    pub hitches: Vec<Hitch>,
    /// The inputs that push the towing body at its centre of mass: ahead, aside, in yaw.
    pub pushes: [Option<usize>; 3],
    /// Rolling resistance, a constant force against the speed, N.
    pub rolling: f64,
    /// Linear and square drag of the towing body, N·s/m and N·s²/m².
    pub drag: [f64; 2],
    /// Drag of its turning, N·m·s.
    pub turning: f64,
    /// Linear drag of each trailer at its reference point, N·s/m.
    pub trailing: Vec<f64>,
    /// Gravity along the ground for the towing body, N, in the world's axes.
    pub hill: [f64; 2],
    /// Height of the centre of mass of the towing body as a share of its wheelbase, midway.
    pub height: f64,
    /// How far wheels roll until their side forces have built up, m; at once where it is zero.
    pub relaxation: f64,
}

impl Machine {
    /// Of these parts, pushed and braked by its wheels alone.
    pub fn of(solids: Vec<Solid>, wheels: Vec<Wheel>, contacts: Vec<Contact>, hitches: Vec<Hitch>) -> Self {
        Self {
            trailing: vec![0.0; solids.len() - 1],
            solids,
            wheels,
            contacts,
            hitches,
            pushes: [None; 3],
            rolling: 0.0,
            drag: [0.0; 2],
            turning: 0.0,
            hill: [0.0; 2],
            height: 0.0,
            relaxation: 0.0,
        }
    }
}
