//! Fig. 2: the disk that rolls less, or more, than it turns.

use super::{Data, Drawing, Figure, Options, page};
use crate::error::Result;
use crate::motion::{assembled, driven};
use crate::number_format::decimals;
use crate::picture::maths::maths;
use crate::picture::sketch::{Sketch, polar};
use crate::picture::svg::Element;
use std::f64::consts::FRAC_PI_2;

/// The figure.
pub const FIGURE: Figure = Figure {
    name: "fig2",
    title: "the one-dimensional disk and its angle of rotation creep",
    source: "Fig. 2, (3)–(8)",
    draw,
};

/// Radius, m; angle turned, rad, in a second.
const RADIUS: f64 = 0.3;
const TURNED: f64 = 2.0;

/// Everything about the two instants that is drawn.
struct Rolled {
    /// Distance, m.
    d: f64,
    theta: f64,
    /// The angle an ideal disk turns on the way d: θ − θ_rc.
    theta_1: f64,
    e: f64,
}

/// Height of one of both pictures, pixels.
const HEIGHT: f64 = 264.0;

/// The disk with a coefficient and with the opposite one: it turns more than it travels, or less.
fn draw(options: &Options) -> Result<Drawing> {
    let e = options.rotation(0.25);
    let both = [rolled(e)?, rolled(-e)?];
    let pictures = both.iter().enumerate().flat_map(|(i, rolled)| picture(rolled, HEIGHT * i as f64));
    let description = "A disk at two instants, with backward-creep and with forward-creep. The contact A has turned to A_2 \
                       while the centre moved by d; an ideal disk would have turned it to A_1. The angle between is theta_rc.";
    let quantities = |of: &Rolled| {
        Data::quantities(&[
            ("e_rc", of.e, "1"),
            ("r", RADIUS, "m"),
            ("theta", of.theta, "rad"),
            ("d", of.d, "m"),
            ("theta_1 = d/r", of.theta_1, "rad"),
            ("theta_rc = theta - theta_1", of.theta - of.theta_1, "rad"),
            ("mean v_A", of.d - RADIUS * TURNED, "m/s"),
        ])
    };
    Ok(Drawing {
        svg: page::page(FIGURE.name, FIGURE.title, description, 2.0 * HEIGHT, pictures.collect()),
        tables: vec![quantities(&both[0])],
        text: String::new(),
    })
}

fn rolled(e: f64) -> Result<Rolled> {
    let disk = assembled("disk", &[("wheel_radius", RADIUS)], &[], &[("rotation-creep", None, vec![e])])?;
    let path = driven(&disk, &[("wheel_rate", "c_0")], &[TURNED], &[0.0; 3], &[0.0, 1.0])?;
    let d = path[1][0];
    Ok(Rolled { d, theta: TURNED, theta_1: d / RADIUS, e })
}

fn picture(rolled: &Rolled, top: f64) -> Vec<Element> {
    let (r, d) = (RADIUS, rolled.d);
    // Both disks and the arrow of the speed fit between the margins whatever the creep.
    let scale = (372.0 / (d + 2.0 * r + 0.1)).min(270.0);
    let mut s = Sketch::new([200.0 - 0.5 * scale * (d + 0.06), top + 206.0], scale);
    let (c, c2) = ([0.0, r], [d, r]);
    s.ground([-r, d + r + 0.1], 0.0);
    s.circle("ghost", c, r);
    s.circle("disk", c2, r);
    s.line("help", &[c, [0.0, 0.0]]);
    s.line("ink", &[c2, [d, 0.0]]);
    // A disk that rolls to the right turns clockwise.
    let at = |angle: f64| -FRAC_PI_2 - angle;
    let (a_1, a_2) = (polar(c2, r, at(rolled.theta_1)), polar(c2, r, at(rolled.theta)));
    s.line("help", &[c2, a_1]);
    s.line("ink", &[c2, a_2]);
    s.angle(c2, 26.0, [at(0.0), at(rolled.theta_1)], "$θ_{1}$", 9.0);
    s.angle(c2, 0.62 * r * scale, [at(0.0), at(rolled.theta)], "$θ$", 9.0);
    s.angle(c2, r * scale + 7.0, [at(rolled.theta_1), at(rolled.theta)], "$θ_{rc}$", 8.0);
    s.arrow("velocity", c2, [d + r + 0.08, r]);
    s.text("velocity", [d + r + 0.08, r], [-2.0, -8.0], "end", "$v_{l}$");
    s.turn("ink", c, r + 12.0 / scale, [FRAC_PI_2 + 0.5, FRAC_PI_2 - 0.5]);
    s.text("", [0.0, 2.0 * r], [0.0, -18.0], "middle", "$ω_{r}$");
    contact_velocity(&mut s, rolled);
    names(&mut s, rolled, [c, c2, a_1, a_2]);
    let (below, shown) = (-34.0 / scale, format!("$d = rθ(1 − e_{{rc}})$,  $e_{{rc}}$ = {}", decimals(rolled.e, 2)));
    s.length([0.0, 0.0], [d, 0.0], below * scale, "");
    s.text("", [0.5 * d, below], [0.0, 15.0], "middle", &shown);
    let mut out = s.finish();
    let name = if rolled.e < 0.0 { "forward-creep" } else { "backward-creep" };
    out.push(maths("heading", [392.0, top + 18.0], "end", name));
    out
}

/// v_A at the contact: backward for e_rc > 0.
fn contact_velocity(s: &mut Sketch, rolled: &Rolled) {
    let v_a = rolled.d - RADIUS * rolled.theta;
    let up = 0.03;
    s.arrow("force", [rolled.d, up], [rolled.d + v_a, up]);
    s.text("force", [rolled.d + 0.5 * v_a, up], [0.0, -7.0], "middle", "$v_{A}$");
}

fn names(s: &mut Sketch, rolled: &Rolled, [c, c2, a_1, a_2]: [[f64; 2]; 4]) {
    s.dot(c);
    s.dot(c2);
    s.text("", c, [-6.0, -6.0], "end", "$C$");
    s.text("", c2, [6.0, -7.0], "start", "$C'$");
    s.text("", [0.0, 0.0], [6.0, -6.0], "start", "$A$");
    let side = if rolled.e < 0.0 { -1.0 } else { 1.0 };
    s.text("", [rolled.d, 0.0], [6.0 * side, -7.0], if side < 0.0 { "end" } else { "start" }, "$A'$");
    // Beyond the ends of the arc of θ_rc, outside of the rim.
    for (p, name, angle) in [(a_1, "$A_{1}$", rolled.theta_1), (a_2, "$A_{2}$", rolled.theta)] {
        s.dot(p);
        let beyond = if (angle - rolled.theta) * side < 0.0 { -0.2 } else { 0.2 };
        let place = polar(c2, RADIUS + 13.0 / s.scale(), -FRAC_PI_2 - angle - side * beyond);
        s.text("", place, [0.0, 4.0], "middle", name);
    }
}
