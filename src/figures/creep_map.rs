//! The creep map (24)–(25): where coefficients and velocities of the single wheel are one to one.

use super::{Data, Drawing, Figure, Options, fixed, page, plane};
use crate::error::Result;
use crate::model::{Equations, Workspace};
use crate::motion::assembled;
use crate::number_format::decimals;
use crate::picture::axis::Axis;
use crate::picture::maths::maths;
use crate::picture::plot::{Marker, Panel, Size};
use crate::picture::svg::Element;

/// The figure.
pub const FIGURE: Figure = Figure {
    name: "creep-map",
    title: "where coefficients and velocities are one-to-one",
    source: "beyond the paper; (24)–(25), E9",
    draw,
};

const PANEL: Size = Size { width: 198.0, height: 238.0, margins: [38.0, 8.0, 32.0, 42.0] };
/// Lines of constant e_rc and of constant e_tc.
const ROTATION: [f64; 7] = [-0.5, 0.0, 0.5, 1.0, 1.5, 2.0, 2.5];
const TRAVERSE: [f64; 5] = [-1.0, -0.5, 0.0, 0.5, 1.0];

/// v_l/(rω) and v_t/(rω) of the wheel at φ = 0 and the determinant of their derivatives, from its equations of motion.
struct Map {
    equations: Equations,
    workspace: Workspace,
}

impl Map {
    fn new() -> Result<Self> {
        let creeps = [("rotation-creep", None, vec![0.0]), ("traverse-creep", None, vec![0.0])];
        let wheel = assembled("unicycle", &[("wheel_radius", 1.0)], &[], &creeps)?;
        let equations = wheel.equations(&["rotation_creep.e_rc".into(), "traverse_creep.e_tc".into()])?;
        let workspace = equations.workspace(&[0.0, 0.0]);
        Ok(Self { equations, workspace })
    }

    fn at(&mut self, e_rc: f64, e_tc: f64) -> [f64; 3] {
        self.workspace = self.equations.workspace(&[e_rc, e_tc]);
        let one = |name: &crate::formula::Symbol| if name.as_str() == "wheel_rate" { 1.0 } else { 0.0 };
        let u: Vec<f64> = self.equations.inputs.iter().map(one).collect();
        let all = self.equations.rates_and_jacobian(&mut self.workspace, &[0.0; 3], &u);
        let (n, width) = (3, 3 + u.len() + 2);
        let by = |row: usize, column: usize| all[n + row * width + 3 + u.len() + column];
        [all[0], all[1], by(0, 0) * by(1, 1) - by(0, 1) * by(1, 0)]
    }
}

fn draw(options: &Options) -> Result<Drawing> {
    let mut map = Map::new()?;
    let mut data =
        Data::new("", &["e_rc [1]", "e_tc [1]", "v_l/(r omega) [1]", "v_t/(r omega) [1]", "determinant [1]"]);
    for e_rc in ROTATION {
        for e_tc in TRAVERSE {
            data.row([e_rc, e_tc].into_iter().chain(map.at(e_rc, e_tc)).map(|v| fixed(v, 4)));
        }
    }
    let here = [options.rotation(0.2), options.traverse(0.25)];
    let mut elements = vec![
        page::placed(coefficients(here), [2.0, 6.0], PANEL),
        page::placed(velocities(&mut map, here), [200.0, 6.0], PANEL),
    ];
    elements.extend(words(&mut map, here));
    let description = "Left the coefficients, right the velocities they give. The line e_rc = 1 on the left becomes one \
                       point on the right; the line v_l = 0 on the right is reached only in that point.";
    let svg = page::page(FIGURE.name, FIGURE.title, description, 290.0, elements);
    Ok(Drawing { svg, tables: vec![data], text: String::new() })
}

/// Lines of the grid as points (e_rc, e_tc): solid ones of constant e_rc, dashed ones of constant e_tc.
fn grid() -> Vec<(&'static str, Vec<[f64; 2]>)> {
    let across = ROTATION.iter().filter(|e| **e != 1.0).map(|e| ("kept", vec![[*e, -1.0], [*e, 1.0]]));
    let along = TRAVERSE.iter().map(|e| ("third", vec![[ROTATION[0], *e], [ROTATION[6], *e]]));
    along.chain(across).collect()
}

fn coefficients(here: [f64; 2]) -> Element {
    let (x, y) = (Axis::linear("", "", [-0.65, 2.65]), Axis::linear("", "", [-1.15, 1.3]));
    let mut panel = plane::graph(PANEL, x, y);
    for (class, line) in grid() {
        panel.series(class, &line);
    }
    panel.series("crept", &[[1.0, -1.0], [1.0, 1.0]]);
    panel.markers("crept", Marker::Square, &[[1.0, 0.0]]);
    panel.markers("start", Marker::Circle, &[here]);
    let top = panel.place([1.0, 1.0]);
    panel.note(maths("crept", [top[0], top[1] - 6.0], "middle", "$e_{rc}$ = 1"));
    captions(&mut panel, "coefficients", ["$e_{rc}$", "$e_{tc}$"]);
    panel.finish("coefficients", "Coefficients", "The grid of coefficients.")
}

fn velocities(map: &mut Map, here: [f64; 2]) -> Element {
    let mut panel = plane::graph(PANEL, Axis::linear("", "", [-1.7, 1.7]), Axis::linear("", "", [-1.7, 1.7]));
    panel.series("help", &[[0.0, -1.6], [0.0, 1.6]]);
    for (class, line) in grid() {
        let image: Vec<[f64; 2]> = line.iter().map(|e| map.at(e[0], e[1])).map(|v| [v[0], v[1]]).collect();
        panel.pieces(class, &[image], plane::MAX_POINTS);
    }
    let place = |v: [f64; 3]| [v[0], v[1]];
    panel.markers("crept", Marker::Square, &[place(map.at(1.0, 0.0))]);
    panel.markers("start", Marker::Circle, &[place(map.at(here[0], here[1]))]);
    captions(&mut panel, "velocities", ["$v_{l}/(rω)$", "$v_{t}/(rω)$"]);
    panel.finish("velocities", "Velocities", "The image of the grid.")
}

fn captions(panel: &mut Panel, title: &str, [x, y]: [&str; 2]) {
    plane::name(panel, PANEL, title);
    let ([_, right], [bottom, top]) = (PANEL.columns(), PANEL.rows());
    panel.note(maths("caption", [right, bottom + 35.0], "end", x));
    panel.note(maths("caption", [6.0, top - 12.0], "start", y));
}

fn words(map: &mut Map, [e_rc, e_tc]: [f64; 2]) -> Vec<Element> {
    let [v_l, v_t, _] = map.at(e_rc, e_tc);
    let [from, to] = [[e_rc, e_tc], [v_l, v_t]].map(|p| format!("({}, {})", decimals(p[0], 2), decimals(p[1], 2)));
    let lines = [
        "The dashed line $e_{rc}$ = 1 becomes the square at 0.".to_string(),
        format!("Ring: one wheel on both sides, {from} and {to}."),
    ];
    lines.iter().zip([262.0, 279.0]).map(|(text, y)| maths("soft", [10.0, y], "start", text)).collect()
}
