//! Strategies of property-based testing (`proptest`) for vehicles and their motions.

use super::moving::Moving;
use super::vehicle::{Drive, Further, Generated, Own, Stand};
use crate::claims::exact_point::{Domain, value};
use crate::formula::Exact;
use proptest::prelude::*;

/// Vehicles that can move without creep, with up to `further` more wheels and `trailers` trailers.
pub fn vehicles(
    drive: impl Strategy<Value = Drive> + Sync + 'static,
    further: usize,
    trailers: usize,
) -> impl Strategy<Value = Generated> + Sync {
    drawn(drive, standing(), further, trailers)
}

/// Vehicles whose further wheels stand anywhere at any heading.
pub fn loose_vehicles(
    drive: impl Strategy<Value = Drive> + Sync + 'static,
    further: usize,
    trailers: usize,
) -> impl Strategy<Value = Generated> + Sync {
    drawn(drive, loose(), further, trailers)
}

/// Any way to be driven.
pub fn any_drive() -> impl Strategy<Value = Drive> + Sync {
    prop::sample::select(vec![Drive::Unicycle, Drive::Differential, Drive::Car, Drive::Tricycle, Drive::Splayed])
}

/// Any motion of any vehicle, creeping as it may.
pub fn moving(further: usize, trailers: usize) -> impl Strategy<Value = Moving> + Sync {
    let twist = [Domain::Nonzero, Domain::Any, Domain::Any].map(value);
    // Steering; a rate of rolling and of turning for each wheel; one for each trailer.
    let rates = prop::collection::vec(value(Domain::Nonzero), 1 + 2 * (3 + further) + trailers);
    (loose_vehicles(any_drive(), further, trailers), twist, rates)
        .prop_map(|(v, twist, rates)| Moving::new(v, twist, rates))
}

fn drawn(
    drive: impl Strategy<Value = Drive> + Sync + 'static,
    stand: impl Strategy<Value = Stand> + Sync + 'static,
    further: usize,
    trailers: usize,
) -> impl Strategy<Value = Generated> + Sync {
    let wheel = (value(Domain::Positive), stand).prop_map(|(radius, stand)| Further { radius, stand });
    let bar = (value(Domain::Positive), value(Domain::Creep));
    (
        (drive, value(Domain::Positive), value(Domain::Angle), curvature(), [own(), own()]),
        prop::collection::vec(wheel, 0..=further),
        prop::collection::vec(bar, 0..=trailers),
        prop::collection::vec(value(Domain::Angle), 2 + further + trailers),
    )
        .prop_map(|((drive, size, axle, curvature, own), further, trailers, angles)| {
            let mut vehicle = Generated { drive, size, axle, curvature, own, further, trailers, angles };
            vehicle.tell_radii_apart();
            vehicle
        })
}

/// One vehicle in four drives straight.
fn curvature() -> impl Strategy<Value = Exact> + Sync {
    (0u8..4, value(Domain::Nonzero)).prop_map(|(kind, v)| if kind == 0 { Exact::ratio(0, 1) } else { v })
}

fn own() -> impl Strategy<Value = Own> + Sync {
    let parts = (value(Domain::Positive), value(Domain::Angle), value(Domain::Nonzero), any::<bool>());
    parts.prop_map(|(radius, heading, distance, backwards)| Own { radius, heading, distance, backwards })
}

fn standing() -> impl Strategy<Value = Stand> + Sync {
    let numbers = (value(Domain::Any), value(Domain::Any), value(Domain::Nonzero));
    (0u8..4, numbers, value(Domain::Angle), any::<bool>()).prop_map(
        |(kind, (along, left, distance), heading, backwards)| match kind {
            0 => Stand::Abreast { distance, backwards },
            1 => Stand::Castor { place: [along, left] },
            _ => Stand::Askew { heading, distance, along },
        },
    )
}

fn loose() -> impl Strategy<Value = Stand> + Sync {
    let place = [value(Domain::Any), value(Domain::Any)];
    (0u8..4, place, value(Domain::Angle)).prop_map(|(kind, place, heading)| match kind {
        0 => Stand::Castor { place },
        _ => Stand::Loose { place, heading },
    })
}
