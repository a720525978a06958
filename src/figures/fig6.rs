//! Fig. 6: the single wheel on the plane.

use super::{Data, Drawing, Figure, Options, Rig, RigWheel, fixed, page, plane};
use crate::error::{Error, Result};
use crate::motion::{assembled, driven};
use crate::picture::sketch::{Sketch, polar, turned};
use crate::picture::svg::Element;
use std::f64::consts::FRAC_PI_2;

/// The figure.
pub const FIGURE: Figure =
    Figure { name: "fig6", title: "the single wheel and its two creeps", source: "Fig. 6, (22)–(25)", draw };

/// Radius, m, wheel and yaw rate, rad/s, and the time shown, s.
const RADIUS: f64 = 0.3;
const RATES: [f64; 2] = [4.0, 0.5];
const TIME: f64 = 1.4;
/// Width of the wheel, m, and seconds of way that an arrow of a velocity shows.
const WIDTH: f64 = 0.09;
const SECONDS: f64 = 0.42;

fn draw(options: &Options) -> Result<Drawing> {
    let (e_rc, e_tc) = (options.rotation(0.15), options.traverse(0.3));
    let run = |e_rc: f64, e_tc: f64| -> Result<_> {
        let creeps = [("rotation-creep", None, vec![e_rc]), ("traverse-creep", None, vec![e_tc])];
        let wheel = assembled("unicycle", &[("wheel_radius", RADIUS)], &[], &creeps)?;
        let times: Vec<f64> = (0..=30).map(|i| TIME * f64::from(i) / 30.0).collect();
        let inputs = [("wheel_rate", "c_0"), ("yaw_rate", "c_1")];
        let path = driven(&wheel, &inputs, &RATES, &[0.25, 0.2, 0.2], &times)?;
        Ok((wheel, times, path))
    };
    let (wheel, times, crept) = run(e_rc, e_tc)?;
    let (_, _, ideal) = run(0.0, 0.0)?;
    let rig = Rig::of(&wheel, &crept[crept.len() - 1], &[("wheel_rate", RATES[0]), ("yaw_rate", RATES[1])])?;
    let placed = rig.wheels.first().ok_or_else(|| Error::run("the single wheel has no wheel"))?;
    let mut data = Data::new("", &["t [s]", "x [m]", "y [m]", "phi [rad]", "x ideal [m]", "y ideal [m]"]);
    for ((t, c), i) in times.iter().zip(&crept).zip(&ideal) {
        data.row([fixed(*t, 3)].into_iter().chain([c[0], c[1], c[2], i[0], i[1]].map(|v| fixed(v, 6))));
    }
    let mut elements = above(&rig, placed, &crept, &ideal)?;
    elements.extend(aside(&rig)?);
    let description = "A wheel from above at x, y with heading phi: its velocity has the parts v_l along and v_t across \
                       the wheel. The ideal path is dash-dotted. Beside it the wheel from the side.";
    let svg = page::page(FIGURE.name, FIGURE.title, description, 290.0, elements);
    Ok(Drawing { svg, tables: vec![data], text: String::new() })
}

/// The wheel from above, with the way it came.
fn above(rig: &Rig, wheel: &RigWheel, crept: &[Vec<f64>], ideal: &[Vec<f64>]) -> Result<Vec<Element>> {
    let points = |path: &[Vec<f64>]| path.iter().map(|z| [z[0], z[1]]).collect::<Vec<[f64; 2]>>();
    let (at, phi) = (wheel.at, wheel.heading);
    // As large as the wheel beside it lets it be, whatever the creep.
    let tip = [0, 1].map(|i| at[i] + SECONDS * wheel.velocity[i]);
    let [x, y] = plane::ranges(points(ideal).iter().chain(&points(crept)).chain(&[tip, polar(at, 0.66, phi)]), 0.0);
    let scale = (222.0 / x[1]).min(226.0 / y[1]).min(122.0);
    let mut s = Sketch::new([26.0, 266.0], scale);
    let (right, top) = ([317.0 / scale, 0.0], [0.0, 222.0 / scale]);
    s.arrow("measure", [0.0, 0.0], right);
    s.arrow("measure", [0.0, 0.0], top);
    s.text("", right, [4.0, 4.0], "start", "$x$");
    s.text("", top, [0.0, -6.0], "middle", "$y$");
    s.text("", [0.0, 0.0], [-7.0, 12.0], "middle", "$O$");
    s.line("ideal", &points(ideal));
    s.line("kept", &points(crept));
    s.line("help", &[[at[0], 0.0], at]);
    s.line("help", &[[0.0, at[1]], at]);
    let radius = wheel.radius.unwrap_or(RADIUS);
    s.wheel("wheel", at, phi, [2.0 * radius, WIDTH]);
    s.line("help", &[at, [at[0] + 0.5, at[1]]]);
    s.line("help", &[at, polar(at, 0.66, phi)]);
    s.angle(at, 33.0, [0.0, phi], "$φ$", 9.0);
    let (v_l, v_t) = (rig.value("v_l")?, rig.value("v_t")?);
    let tip = |l: f64, t: f64| turned([SECONDS * l, SECONDS * t], at, phi);
    s.arrow("velocity", at, tip(v_l, 0.0));
    s.arrow("velocity", at, tip(0.0, v_t));
    s.arrow("force", at, [0, 1].map(|i| at[i] + SECONDS * wheel.velocity[i]));
    s.line("help", &[tip(v_l, 0.0), tip(v_l, v_t), tip(0.0, v_t)]);
    s.text("velocity", tip(v_l, 0.0), [8.0, 4.0], "start", "$v_{l}$");
    s.text(
        "velocity",
        tip(0.0, v_t),
        [if v_t < 0.0 { 7.0 } else { -7.0 }, 2.0],
        if v_t < 0.0 { "start" } else { "end" },
        "$v_{t}$",
    );
    s.text("force", tip(v_l, v_t), [0.0, -7.0], "middle", "$v$");
    s.dot(at);
    s.text("", [at[0], 0.0], [0.0, 15.0], "middle", "$x$");
    s.text("", [0.0, at[1]], [-8.0, 4.0], "end", "$y$");
    Ok(s.finish())
}

/// The wheel from the side: radius, rate, and the velocity of its contact.
fn aside(rig: &Rig) -> Result<Vec<Element>> {
    let mut s = Sketch::new([322.0, 214.0], 118.0);
    let (r, c) = (rig.value("r")?, [0.0, rig.value("r")?]);
    s.ground([-0.5, 0.55], 0.0);
    s.circle("disk", c, r);
    s.line("ink", &[c, polar(c, r, 2.4)]);
    s.text("", polar(c, 0.55 * r, 2.4), [5.0, -4.0], "start", "$r$");
    s.turn("ink", c, r + 0.07, [FRAC_PI_2 + 0.6, FRAC_PI_2 - 0.6]);
    s.text("", [0.0, 2.0 * r], [0.0, -15.0], "middle", "$θ̇ = ω_{r}$");
    s.dot(c);
    let scale = 0.3;
    let magnified = 0.9;
    s.arrow("velocity", c, [scale * rig.value("v_l")?, r]);
    s.text("velocity", [scale * rig.value("v_l")?, r], [3.0, -6.0], "start", "$v_{l}$");
    let v_a = magnified * (rig.value("v_l")? - r * rig.value("theta'")?);
    s.arrow("force", [0.0, 0.03], [v_a, 0.03]);
    s.text("force", [0.5 * v_a, 0.0], [0.0, 21.0], "middle", "$v_{A}$");
    Ok(s.finish())
}
