//! Vehicles that are generated: wheels of any radius, place and heading, fixed, steered or castors, and trailers.
//!
//! No wheel has the radius of another. A fixed wheel is mounted at an angle to the body. Rigid bodies only turn about a
//! point, so an ideal vehicle moves only if the axles of all its fixed and steered wheels meet in one point, or are
//! parallel; which of its wheels stand so is part of its making:
//!
//! | wheel | stands | leaves the ideal vehicle |
//! |---|---|---|
//! | abreast | on the line of the axle, facing as it does or backwards | all freedoms |
//! | castor | anywhere, at any angle | all freedoms |
//! | askew | at any heading, its axle through the centre of turning; parallel where the vehicle drives straight | one: circling that centre |
//! | loose | anywhere, at any heading | none; it moves by creep alone |
//!
//! [`vehicles`] makes those that the theorems speak of, which creep *near* an ideal motion: none of their wheels is
//! loose. [`loose_vehicles`] makes any.

mod describe;
mod moving;
mod plane;
mod stand;
mod strategy;

pub use moving::{Contact, Moving};
pub use stand::{Facing, Placed};
pub use strategy::{any_drive, loose_vehicles, moving, vehicles};

use super::exact_point::written;
use crate::formula::Exact;

/// How a generated vehicle is driven.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Drive {
    /// One wheel at the reference point; its yaw rate is measured.
    Unicycle,
    /// Two wheels with a rate each on the axle of the reference point, each facing forward or backwards.
    Differential,
    /// One drive angle at the rear axle, a steered front axle.
    Car,
    /// The front wheel is driven and steered.
    Tricycle,
    /// Two wheels with a rate each that stand at an angle to each other; their axles meet.
    Splayed,
}

/// A wheel that the way of driving needs.
#[derive(Clone, Debug)]
struct Own {
    radius: Exact,
    /// Of splayed wheels; the others face as their axle.
    heading: Exact,
    /// Of splayed wheels, from the point where their axles meet.
    distance: Exact,
    /// Of the wheels of an axle.
    backwards: bool,
}

/// Where a further wheel stands.
#[derive(Clone, Debug)]
enum Stand {
    Abreast { distance: Exact, backwards: bool },
    Castor { place: [Exact; 2] },
    Askew { heading: Exact, distance: Exact, along: Exact },
    Loose { place: [Exact; 2], heading: Exact },
}

#[derive(Clone, Debug)]
struct Further {
    radius: Exact,
    stand: Stand,
}

/// A generated vehicle in a generated configuration; all lengths are rational numbers, all angles rational points of
/// the circle.
#[derive(Clone, Debug)]
pub struct Generated {
    /// How it is driven.
    pub drive: Drive,
    /// Track or wheelbase.
    size: Exact,
    /// The heading of its axle in the body.
    axle: Exact,
    /// Yaw per length of the ideal motion it was made around; where it is steered, the steering decides.
    curvature: Exact,
    own: [Own; 2],
    further: Vec<Further>,
    /// Bar and hitch.
    trailers: Vec<(Exact, Exact)>,
    /// Of the body, of steering, of castors and of trailers.
    angles: Vec<Exact>,
}

impl Generated {
    /// How many trailers it pulls.
    pub fn trailers(&self) -> usize {
        self.trailers.len()
    }

    /// What it is, for people.
    pub fn shown(&self) -> Vec<(String, String)> {
        let mut shown = vec![("drive".to_string(), format!("{:?}", self.drive).to_lowercase())];
        let wheels = self.wheels().unwrap_or_default();
        shown.extend(wheels.iter().filter(|w| w.radius.is_some()).map(|w| (w.name.clone(), w.to_string())));
        for (i, (bar, hitch)) in self.trailers.iter().enumerate() {
            shown.push((format!("trailer {}", i + 1), format!("(d {}, c {})", written(bar), written(hitch))));
        }
        shown
    }
}
