//! A generated vehicle in a generated configuration, by its parts: how it is driven, its wheels, its trailers.

use crate::claims::exact_point::written;
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
pub(super) struct Own {
    pub(super) radius: Exact,
    /// Of splayed wheels; the others face as their axle.
    pub(super) heading: Exact,
    /// Of splayed wheels, from the point where their axles meet.
    pub(super) distance: Exact,
    /// Of the wheels of an axle.
    pub(super) backwards: bool,
}

/// Where a further wheel stands.
#[derive(Clone, Debug)]
pub(super) enum Stand {
    Abreast { distance: Exact, backwards: bool },
    Castor { place: [Exact; 2] },
    Askew { heading: Exact, distance: Exact, along: Exact },
    Loose { place: [Exact; 2], heading: Exact },
}

#[derive(Clone, Debug)]
pub(super) struct Further {
    pub(super) radius: Exact,
    pub(super) stand: Stand,
}

/// A generated vehicle in a generated configuration; all lengths are rational numbers, all angles rational points of
/// the circle.
#[derive(Clone, Debug)]
pub struct Generated {
    /// How it is driven.
    pub drive: Drive,
    /// Track or wheelbase.
    pub(super) size: Exact,
    /// The heading of its axle in the body.
    pub(super) axle: Exact,
    /// Yaw per length of the ideal motion it was made around; where it is steered, the steering decides.
    pub(super) curvature: Exact,
    pub(super) own: [Own; 2],
    pub(super) further: Vec<Further>,
    /// Bar and hitch.
    pub(super) trailers: Vec<(Exact, Exact)>,
    /// Of the body, of steering, of castors and of trailers.
    pub(super) angles: Vec<Exact>,
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
