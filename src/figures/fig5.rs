//! Fig. 5: bending and torsion of the sleigh. No elastic model exists; the angle is φ_tc.

use super::{Data, Drawing, Figure, Options, page};
use crate::error::Result;
use crate::motion::{assembled, driven};
use crate::number_format::decimals;
use crate::picture::maths::maths;
use crate::picture::sketch::{Sketch, polar, rounded};
use crate::picture::svg::Element;
use std::f64::consts::FRAC_PI_2;

/// The figure.
pub const FIGURE: Figure =
    Figure { name: "fig5", title: "bending and vertical torsion of the sleigh", source: "Fig. 5, (18)–(19)", draw };

/// Height of the centre of mass in the drawing.
const HEIGHT: f64 = 1.0;

/// Both pictures are bent by the angle between the sleigh's velocity and its blade.
fn draw(options: &Options) -> Result<Drawing> {
    let e = options.traverse(0.3);
    let blade = assembled("unicycle", &[("wheel_radius", 1.0)], &[], &[("traverse-creep", None, vec![e])])?;
    let moved = driven(&blade, &[("wheel_rate", "1"), ("yaw_rate", "0")], &[], &[0.0; 3], &[0.0, 1.0])?;
    let angle = moved[1][1].atan2(moved[1][0]);
    let mut elements = bending(angle);
    elements.extend(torsion(angle));
    for (x, text) in [(100.0, "bending, from behind"), (300.0, "torsion, from above")] {
        elements.push(maths("heading", [x, 20.0], "middle", text));
    }
    let shown = format!("$φ_{{tc}}$ = {} rad. A schematic of the angle, no elastic model.", decimals(angle, 2));
    elements.push(maths("soft", [200.0, 232.0], "middle", &shown));
    let description = "Left: the centre of mass C is bent sideways off the contact A. Right: the contact is twisted \
                       against the body. Both by phi_tc.";
    let quantities =
        [("e_tc", e, "1"), ("phi_tc", angle, "rad"), ("C left of A over height", angle.tan() * HEIGHT, "1")];
    Ok(Drawing {
        svg: page::page(FIGURE.name, FIGURE.title, description, 244.0, elements),
        tables: vec![Data::quantities(&quantities)],
        text: String::new(),
    })
}

/// The sleigh from behind in a turn to the right: left is left.
fn bending(angle: f64) -> Vec<Element> {
    let mut s = Sketch::new([105.0, 186.0], 110.0);
    let aside = -HEIGHT * angle.tan();
    s.ground([-0.85, 0.85], 0.0);
    s.line("help", &[[0.0, 0.0], [0.0, 1.15]]);
    // A beam held at its foot, bent at its end.
    let beam: Vec<[f64; 2]> =
        (0..=20).map(|i| f64::from(i) / 20.0).map(|h| [aside * h * h * (3.0 - h) / 2.0, h]).collect();
    s.line("velocity", &beam);
    let c = [aside, HEIGHT];
    s.wheel("body", c, aside.atan2(-HEIGHT) + FRAC_PI_2, [0.2, 0.2]);
    let sign = if angle < 0.0 { -1.0 } else { 1.0 };
    s.arrow("force", c, [c[0] - 0.42 * sign, c[1]]);
    s.text("force", [c[0] - 0.42 * sign, c[1]], [0.0, -8.0], "middle", "$F$");
    s.arrow("force", [0.0, 0.03], [0.5 * sign, 0.03]);
    s.text("force", [0.5 * sign, 0.0], [0.0, -10.0], "middle", "$f_{T}$");
    s.angle([0.0, 0.0], 78.0, [FRAC_PI_2, FRAC_PI_2 - aside.atan2(HEIGHT)], "$φ_{tc}$", 12.0);
    s.line("help", &[[0.0, 0.0], c]);
    s.dot(c);
    s.dot([0.0, 0.0]);
    s.text("", c, [0.0, -16.0], "middle", "$C$");
    s.text("", [0.0, 0.0], [-9.0 * sign, -7.0], if sign > 0.0 { "end" } else { "start" }, "$A$");
    s.finish()
}

/// The sleigh from above, the body's heading upwards.
fn torsion(angle: f64) -> Vec<Element> {
    let mut s = Sketch::new([300.0, 126.0], 110.0);
    let o = [0.0, 0.0];
    s.shape("body", &rounded(o, FRAC_PI_2, [1.15, 0.62], 0.15));
    s.wheel("ghost", o, FRAC_PI_2, [0.8, 0.14]);
    s.wheel("wheel", o, FRAC_PI_2 + angle, [0.8, 0.14]);
    s.line("help", &[[0.0, -0.75], [0.0, 0.78]]);
    s.line("velocity", &[polar(o, -0.5, FRAC_PI_2 + angle), polar(o, 0.72, FRAC_PI_2 + angle)]);
    s.angle(o, 66.0, [FRAC_PI_2, FRAC_PI_2 + angle], "$φ_{tc}$", 22.0);
    let sign = if angle < 0.0 { -1.0 } else { 1.0 };
    s.turn(
        "force",
        o,
        0.44,
        [
            -0.5 * sign + if sign > 0.0 { 0.0 } else { 2.0 * FRAC_PI_2 },
            0.6 * sign + if sign > 0.0 { 0.0 } else { 2.0 * FRAC_PI_2 },
        ],
    );
    s.text("force", [0.48 * sign, 0.0], [4.0 * sign, 4.0], if sign > 0.0 { "start" } else { "end" }, "$τ_{T}$");
    // The friction over the contact's length, behind its middle as seen from the body.
    for share in [-0.3, -0.15, 0.0, 0.15, 0.3] {
        let foot = polar(o, share, FRAC_PI_2 + angle);
        s.arrow("force", foot, [foot[0] + (0.17 - 0.3 * share) * sign, foot[1]]);
    }
    // A bar over the letter, drawn: few fonts have it.
    let foot = s.at(polar(o, -0.3, FRAC_PI_2 + angle));
    let [x, y] = [foot[0] + if sign > 0.0 { 36.0 } else { -46.0 }, foot[1] + 6.0];
    s.add(maths("force", [x, y], "start", "$f_{T}$"));
    s.add(crate::picture::svg::line("line force bar", [x + 1.0, y - 12.0], [x + 7.0, y - 12.0]));
    s.dot(o);
    s.text("", o, [-14.0 * sign, 4.0], "middle", "$A$");
    s.text("", [0.0, 0.78], [7.0, 6.0], "start", "$ξ$");
    s.finish()
}
