//! Fig. 3: radius lines of a disk that is twisted. No elastic model exists; the twist is θ_rc.

use super::{Data, Drawing, Figure, Options, fixed, page};
use crate::error::Result;
use crate::motion::{assembled, driven};
use crate::number_format::decimals;
use crate::picture::maths::maths;
use crate::picture::sketch::{Sketch, polar};
use crate::picture::svg::Element;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// The figure.
pub const FIGURE: Figure =
    Figure { name: "fig3", title: "deformed radius lines of a twisted disk", source: "Fig. 3, (11)–(12)", draw };

/// Radius, m; the angle turned in a second, rad; the hub's share of the radius; how many lines are drawn.
const RADIUS: f64 = 0.3;
const TURNED: f64 = 1.0;
const HUB: f64 = 0.16;
const LINES: usize = 12;
/// How far around the contact the rim is held, rad: a choice of the drawing.
const REACH: f64 = 1.3;

/// At the contact the rim lags behind the hub by θ_rc = θ − d/r; between them the lag grows with the square of the radius and
/// falls off around the rim, which is how the picture is drawn and nothing more.
fn draw(options: &Options) -> Result<Drawing> {
    let e = options.rotation(0.25);
    let disk = assembled("disk", &[("wheel_radius", RADIUS)], &[], &[("rotation-creep", None, vec![e])])?;
    let d = driven(&disk, &[("wheel_rate", "c_0")], &[TURNED], &[0.0; 3], &[0.0, 1.0])?[1][0];
    let lag = TURNED - d / RADIUS;
    let description = "A disk whose hub is turned by a torque and whose rim is held back by the ground: its radius lines \
                       bend, at the contact by theta_rc from hub to rim.";
    let mut lines = Data::new("", &["line", "share of radius", "angle undeformed [rad]", "angle deformed [rad]"]);
    for k in 0..LINES {
        for share in [HUB, 0.5, 1.0] {
            let straight = straight(k, lag);
            let bent = straight + bend(k, lag, share);
            lines.row([k.to_string(), fixed(share, 2), fixed(straight, 6), fixed(bent, 6)]);
        }
    }
    Ok(Drawing {
        svg: page::page(FIGURE.name, FIGURE.title, description, 258.0, picture(e, lag)),
        tables: vec![lines],
        text: String::new(),
    })
}

fn angle_of(line: usize) -> f64 {
    -FRAC_PI_2 + TAU * line as f64 / LINES as f64
}

/// Where a line that is not bent would end: the one that ends at the contact has been turned on by the lag.
fn straight(line: usize, lag: f64) -> f64 {
    angle_of(line) - lag
}

/// The hub turns clockwise, what lags behind it is turned counter-clockwise: most at the contact, where the ground holds the
/// rim, and little on the far side.
fn bend(line: usize, lag: f64, share: f64) -> f64 {
    let from_contact = (angle_of(line) + FRAC_PI_2 + PI).rem_euclid(TAU) - PI;
    lag * ((share - HUB) / (1.0 - HUB)).powi(2) * (-(from_contact / REACH).powi(2)).exp()
}

fn picture(e: f64, lag: f64) -> Vec<Element> {
    let mut s = Sketch::new([122.0, 132.0], 300.0);
    let (c, r) = ([0.0, 0.0], RADIUS);
    s.ground([-1.2 * r, 1.3 * r], -r);
    s.circle("disk", c, r);
    for k in 0..LINES {
        let from = polar(c, HUB * r, straight(k, lag));
        s.line("help", &[from, polar(c, r, straight(k, lag))]);
        let bent = (0..=16).map(|i| HUB + (1.0 - HUB) * f64::from(i) / 16.0);
        let points: Vec<_> = bent.map(|share| polar(c, share * r, straight(k, lag) + bend(k, lag, share))).collect();
        s.line(if k == 0 { "velocity" } else { "ink" }, &points);
    }
    s.circle("disk", c, HUB * r);
    s.turn("force", c, 0.5 * HUB * r, [FRAC_PI_2 + 2.4, FRAC_PI_2 - 2.4]);
    s.angle(c, r * 300.0 - 9.0, [straight(0, lag), angle_of(0)], "$θ_{rc}$", -13.0);
    let sign = if lag < 0.0 { -1.0 } else { 1.0 };
    s.arrow("force", [0.0, -r - 0.035], [0.34 * r * sign, -r - 0.035]);
    s.text(
        "force",
        [0.34 * r * sign, -r - 0.035],
        [5.0 * sign, 5.0],
        if sign > 0.0 { "start" } else { "end" },
        "$f_{R}$",
    );
    s.turn("ink", c, r + 0.04, [FRAC_PI_2 + 0.45, FRAC_PI_2 - 0.45]);
    s.text("", [0.0, r + 0.04], [0.0, -7.0], "middle", "$ω_{r}$");
    let mut out = s.finish();
    out.extend(words(e, lag));
    out
}

/// What is beside the disk.
fn words(e: f64, lag: f64) -> Vec<Element> {
    let lines = [
        ("force", "$τ_{R}$ turns the hub".to_string()),
        ("force", "$f_{R}$ holds the rim".to_string()),
        ("", format!("$e_{{rc}} = f_{{R}}/(b_{{R}} r ω_{{r}})$ = {}", decimals(e, 2))),
        ("", format!("$θ_{{rc}} = e_{{rc}} θ$ = {} rad", decimals(lag, 2))),
        ("soft", "for $θ$ = 1 rad".to_string()),
        ("soft", "A schematic: no elastic".to_string()),
        ("soft", "model, only the angle.".to_string()),
    ];
    let tops = [52.0, 70.0, 98.0, 116.0, 133.0, 168.0, 184.0];
    lines.iter().zip(tops).map(|((class, text), y)| maths(class, [244.0, y], "start", text)).collect()
}
