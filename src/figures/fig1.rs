//! Fig. 1: the tyre that creeps.

use super::{Data, Drawing, Figure, Options, Rig, RigWheel, page};
use crate::error::{Error, Result};
use crate::motion::assembled;
use crate::picture::sketch::{Sketch, arc, polar, turned};
use std::f64::consts::FRAC_PI_2;

/// The figure.
pub const FIGURE: Figure =
    Figure { name: "fig1", title: "the creeping tyre of a car's front right wheel", source: "Fig. 1, (1)–(2)", draw };

/// A car of usual size: m, rad, rad/s.
const CAR: [(&str, f64); 3] = [("wheel_radius", 0.32), ("wheelbase", 2.6), ("track_width", 1.5)];
/// Wheel rate, rad/s, and size of the steering angle, rad.
const RATE: f64 = 20.0;
const STEERING: f64 = 0.3;
/// Width of a tyre and half axes of its contact, m.
const TYRE: f64 = 0.2;
const CONTACT: [f64; 2] = [0.15, 0.075];
/// 1/k_g, the relaxation length (E13), m.
const RELAXATION: f64 = 0.2;

/// The contact is held by the ground, the rim drifts outwards: by (1), x_c = −e_tc/k_g with e_tc = ẋ_c/v_l.
///
/// A wheel that creeps to the left is one of a car that turns to the right, and the other way round.
fn draw(options: &Options) -> Result<Drawing> {
    let e = options.traverse(0.3);
    let car = assembled("four-wheel-car", &CAR, &[], &[("front-traverse-creep", None, vec![e])])?;
    let steering = if e < 0.0 { STEERING } else { -STEERING };
    let rig = Rig::of(&car, &[0.0, 0.0, FRAC_PI_2], &[("wheel_rate", RATE), ("steering_angle", steering)])?;
    let front = rig.wheels.iter().find(|w| w.steered).ok_or_else(|| Error::run("the car has no steered axle"))?;
    let wheel = rig.axle(front, 0.5 * CAR[2].1)?.remove(0);
    let creep = wheel.creep_angle();
    let x_c = -RELAXATION * e;
    let mut elements = whole(&rig, &wheel, if e < 0.0 { "a turn to the left" } else { "a turn to the right" })?;
    elements.extend(tyre(creep, x_c));
    let description = "A car in a turn and its front right wheel enlarged: the wheel moves at the angle theta_c \
                       from its plane, and the contact A lies off the projection O of its centre.";
    let quantities = [
        ("e_tc", e, "1"),
        ("theta_c", creep, "rad"),
        ("x_c", x_c, "m"),
        ("wheel speed v", wheel.speed(), "m/s"),
        ("steering angle of the wheel", wheel.heading - FRAC_PI_2, "rad"),
    ];
    Ok(Drawing {
        svg: page::page(FIGURE.name, FIGURE.title, description, 270.0, elements),
        tables: vec![Data::quantities(&quantities)],
        text: String::new(),
    })
}

/// The car from above, its wheels where the description has them.
fn whole(rig: &Rig, wheel: &RigWheel, turn: &str) -> Result<Vec<crate::picture::svg::Element>> {
    let mut s = Sketch::new([72.0, 192.0], 40.0);
    let (place, heading) = rig.bodies[0];
    let body = crate::picture::sketch::rounded(turned([1.3, 0.0], place, heading), heading, [3.9, 1.75], 0.4);
    s.shape("body", &body);
    for axle in &rig.wheels {
        for w in rig.axle(axle, 0.5 * CAR[2].1)? {
            s.wheel(if w.steered { "steered" } else { "wheel" }, w.at, w.heading, [2.0 * CAR[0].1, TYRE]);
        }
    }
    s.circle("ghost", wheel.at, 0.55);
    let middle = turned([1.3, 0.0], place, heading);
    let velocity = rig.velocity(middle)?;
    s.arrow("velocity", middle, [0, 1].map(|i| middle[i] + 0.17 * velocity[i]));
    s.text("soft", place, [0.0, 50.0], "middle", turn);
    // From the ring to the enlargement.
    let ring = s.at(polar(wheel.at, 0.55, 0.0));
    s.add(crate::picture::svg::line("line help", ring, [254.0, ring[1]]));
    Ok(s.finish())
}

/// The tyre enlarged, its plane upright: x to the left, along the wheel up.
fn tyre(creep: f64, x_c: f64) -> Vec<crate::picture::svg::Element> {
    let mut s = Sketch::new([280.0, 138.0], 230.0);
    let radius = CAR[0].1;
    let a = [-x_c, 0.0];
    s.shape("tyre", &crate::picture::sketch::rounded([0.0, 0.0], FRAC_PI_2, [2.0 * radius, TYRE], 0.07));
    let ellipse: Vec<[f64; 2]> = arc([0.0, 0.0], 1.0, [0.0, 4.0 * FRAC_PI_2])
        .iter()
        .map(|p| [a[0] + CONTACT[1] * p[0], CONTACT[0] * p[1]])
        .collect();
    s.shape("patch", &ellipse);
    s.arrow("measure", [0.0, -0.44], [0.0, 0.52]);
    s.text("", [0.0, 0.52], [7.0, 6.0], "start", "$y$");
    s.line("help", &[[a[0], -0.44], [a[0], 0.0]]);
    s.arrow("velocity", [0.0, 0.0], polar([0.0, 0.0], 0.46, FRAC_PI_2 + creep));
    s.text(
        "velocity",
        polar([0.0, 0.0], 0.46, FRAC_PI_2 + creep),
        [if creep < 0.0 { 8.0 } else { -8.0 }, 4.0],
        if creep < 0.0 { "start" } else { "end" },
        "$v$",
    );
    s.angle([0.0, 0.0], 88.0, [FRAC_PI_2, FRAC_PI_2 + creep], "$θ_{c}$", 10.0);
    // The turn pulls the rim outwards, the ground holds the contact.
    let sign = if creep < 0.0 { -1.0 } else { 1.0 };
    s.arrow("force", [0.0, 0.0], [-0.3 * sign, 0.0]);
    s.text("force", [-0.3 * sign, 0.0], [0.0, -8.0], "middle", "$F$");
    s.arrow("force", a, [a[0] + 0.3 * sign, 0.0]);
    s.text("force", [a[0] + 0.3 * sign, 0.0], [0.0, -8.0], "middle", "$f$");
    s.dot([0.0, 0.0]);
    s.dot(a);
    s.text("", [0.0, 0.0], [-7.0 * sign, 15.0], "middle", "$O$");
    s.text("", a, [7.0 * sign, 15.0], "middle", "$A$");
    s.arrow("measure", [0.22, -0.42], [-0.34, -0.42]);
    s.text("", [-0.34, -0.42], [-4.0, 4.0], "end", "$x$");
    s.arrow("ink", [0.0, -0.42], [a[0], -0.42]);
    s.text("", [0.5 * a[0], -0.42], [0.0, 17.0], "middle", "$x_{c}$");
    s.finish()
}
