//! Fig. 4: the sleigh that does not go where its blade points.

use super::{Data, Drawing, Figure, Options, page, plane};
use crate::error::Result;
use crate::model::Model;
use crate::motion::{assembled, driven};
use crate::picture::sketch::{Sketch, polar, turned};
use crate::picture::svg::Element;
use std::f64::consts::FRAC_PI_2;

/// The figure.
pub const FIGURE: Figure =
    Figure { name: "fig4", title: "traverse creep of the Chaplygin sleigh", source: "Fig. 4, (14)–(17)", draw };

/// v_l, m/s, and ω_z, rad/s: a turn to the right; the time from A to A', s; place and heading at A.
const SPEED: f64 = 1.0;
const TURN: f64 = -0.8;
const TIME: f64 = 1.3;
const START: [f64; 3] = [0.75, 0.5, 1.05];
/// Length of the arrow of v_l, m.
const TIP: f64 = 0.75;
/// Length and half width of the body, m.
const BODY: [f64; 2] = [0.5, 0.13];

/// The blade's direction constraint is that of the single wheel, whose motion is determined by v_l and ω_z.
fn path(e: f64, times: &[f64]) -> Result<Vec<Vec<f64>>> {
    let wheel = assembled("unicycle", &[("wheel_radius", 1.0)], &[], &[("traverse-creep", None, vec![e])])?;
    driven(&wheel, &[("wheel_rate", "c_0"), ("yaw_rate", "c_1")], &[SPEED, TURN], &START, times)
}

fn draw(options: &Options) -> Result<Drawing> {
    let e = options.traverse(0.3);
    let times: Vec<f64> = (0..=26).map(|i| TIME * f64::from(i) / 26.0).collect();
    let (crept, ideal) = (path(e, &times)?, path(0.0, &times)?);
    let mut data = Data::new("", &["t [s]", "x [m]", "y [m]", "phi [rad]", "x ideal [m]", "y ideal [m]"]);
    for ((t, c), i) in times.iter().zip(&crept).zip(&ideal) {
        data.row([super::fixed(*t, 3)].into_iter().chain([c[0], c[1], c[2], i[0], i[1]].map(|v| super::fixed(v, 6))));
    }
    let description = "A sleigh at A with its blade along xi. Ideally it would follow the dashed circle about B; with \
                       creep it moves at the angle phi_tc to its blade and reaches A'.";
    Ok(Drawing {
        svg: page::page(FIGURE.name, FIGURE.title, description, 300.0, picture(e, &crept)?),
        tables: vec![data],
        text: String::new(),
    })
}

fn picture(e: f64, crept: &[Vec<f64>]) -> Result<Vec<Element>> {
    let phi = START[2];
    let (a, creep) = ([START[0], START[1]], e.atan());
    let radius = SPEED / TURN.abs();
    let b = polar(a, radius, phi - FRAC_PI_2);
    let points: Vec<[f64; 2]> = crept.iter().map(|z| [z[0], z[1]]).collect();
    let circle = crate::picture::sketch::arc(b, radius, [phi + FRAC_PI_2 + 0.3, 0.75]);
    // The drawing is as large as its sheet lets it be, whatever the creep.
    let [x, y] =
        plane::ranges(points.iter().chain(&circle).chain(&[[-0.05, 0.0], [b[0] + 0.2, b[1] - 0.2], [0.0, 1.75]]), 0.0);
    let scale = (356.0 / (x[1] - x[0])).min(262.0 / (y[1] - y[0]));
    let mut s = Sketch::new([22.0 - scale * x[0], 280.0 + scale * y[0]], scale);
    axes(&mut s);
    s.line("ideal", &circle);
    s.line("help", &[a, b]);
    s.line("kept", &points);
    let last = &crept[crept.len() - 1];
    blade(&mut s, a, phi, "body")?;
    blade(&mut s, [last[0], last[1]], last[2], "ghost")?;
    moving_axes(&mut s, a, phi);
    let tip = TIP;
    s.arrow("velocity", a, polar(a, tip, phi));
    s.arrow("velocity", a, turned([0.0, tip * e], a, phi));
    s.arrow("force", a, turned([tip, tip * e], a, phi));
    s.line("help", &[turned([tip, 0.0], a, phi), turned([tip, tip * e], a, phi), turned([0.0, tip * e], a, phi)]);
    s.angle(a, 0.88 * scale, [phi, phi + creep], "$φ_{tc}$", 11.0);
    s.line("help", &[a, [a[0] + 0.5, a[1]]]);
    s.angle(a, 0.36 * scale, [0.0, phi], "$φ$", 9.0);
    names(&mut s, [a, b, [last[0], last[1]]], e);
    Ok(s.finish())
}

fn axes(s: &mut Sketch) {
    s.arrow("measure", [0.0, 0.0], [0.42, 0.0]);
    s.arrow("measure", [0.0, 0.0], [0.0, 0.42]);
    s.text("", [0.42, 0.0], [5.0, 4.0], "start", "$x$");
    s.text("", [0.0, 0.42], [0.0, -6.0], "middle", "$y$");
    s.text("", [0.0, 0.0], [-6.0, 12.0], "middle", "$O$");
}

fn moving_axes(s: &mut Sketch, a: [f64; 2], phi: f64) {
    s.line("help", &[a, polar(a, 1.2, phi)]);
    s.line("help", &[a, polar(a, 0.5, phi + FRAC_PI_2)]);
    s.text("", polar(a, 1.2, phi), [8.0, 0.0], "middle", "$ξ$");
    s.text("", polar(a, 0.5, phi + FRAC_PI_2), [-6.0, -2.0], "middle", "$η$");
}

/// The body of the sleigh and its blade, which the catalogue has at the reference point.
fn blade(s: &mut Sketch, at: [f64; 2], heading: f64, class: &str) -> Result<()> {
    let sleigh = Model::new("sleigh", &[("mass", 1.0), ("inertia", 1.0), ("mass_offset", 0.0)])?;
    let outline = [[-0.3, 1.0], [-0.3, -1.0], [0.55, -1.0], [0.75, 0.0], [0.55, 1.0]];
    let points: Vec<_> = outline.iter().map(|[l, w]| turned([l * BODY[0], w * BODY[1]], at, heading)).collect();
    s.shape(class, &points);
    for wheel in &sleigh.vehicle.wheels {
        let number = |e: &crate::formula::Expr| e.eval(&|_| f64::NAN).unwrap_or(0.0);
        let place = turned([number(&wheel.forward), number(&wheel.left)], at, heading);
        s.wheel(if class == "body" { "wheel" } else { class }, place, heading, [0.34, 0.05]);
    }
    Ok(())
}

fn names(s: &mut Sketch, [a, b, end]: [[f64; 2]; 3], e: f64) {
    let phi = START[2];
    s.dot(a);
    s.dot(b);
    s.dot(end);
    s.text("", a, [-4.0, 42.0], "start", "$A$ = $C$");
    s.text("", b, [6.0, 12.0], "start", "$B$");
    s.text("", end, [-2.0, 32.0], "middle", "$A'$");
    let (aside, anchor) = if e < 0.0 { (-8.0, "end") } else { (8.0, "start") };
    s.text("velocity", polar(a, TIP, phi), [aside, 8.0], anchor, "$v_{l}$");
    let sideways = turned([0.0, TIP * e], a, phi);
    s.text(
        "velocity",
        sideways,
        [if e < 0.0 { 6.0 } else { -6.0 }, 10.0],
        if e < 0.0 { "start" } else { "end" },
        "$v_{t}$",
    );
    s.text(
        "force",
        turned([TIP, TIP * e], a, phi),
        [-0.75 * aside, -6.0],
        if e < 0.0 { "start" } else { "end" },
        "$v$",
    );
    let middle = [0, 1].map(|i| 0.5 * (a[i] + b[i]));
    s.text("", middle, [-4.0, 22.0], "middle", "$v_{l}/ω_{z}$");
    s.turn("ink", b, 0.13, [2.6, 0.4]);
    s.text("", b, [18.0, -14.0], "start", "$ω_{z}$");
}
