//! Figures: their data against numbers this project did not make, against themselves as reviewed, and their files.

use crate::reviewed::reviewed;
use creepage::energy_rule::Reading;
use creepage::figures::{self, Drawing, FIGURES, Options, Rig, readings};
use creepage::progress::unheard;
use std::collections::BTreeMap;
use std::sync::LazyLock;

/// Every figure as it is drawn without options, made once for all tests.
static DRAWN: LazyLock<BTreeMap<&'static str, Drawing>> = LazyLock::new(|| {
    let drawn = figures::draw(&[], &Options::default(), &unheard).unwrap();
    drawn.into_iter().map(|(figure, drawing)| (figure.name, drawing)).collect()
});

fn one(name: &str, options: &Options) -> Drawing {
    figures::draw(&[name.into()], options, &unheard).unwrap().remove(0).1
}

fn with(e_rc: Option<f64>, e_tc: Option<f64>) -> Options {
    Options::new(e_rc, e_tc, "A").unwrap()
}

/// The numbers of a table of quantities by name.
fn quantities(drawing: &Drawing) -> BTreeMap<String, f64> {
    drawing.tables[0].rows().iter().map(|r| (r[0].clone(), r[1].parse().unwrap())).collect()
}

#[test]
fn figures_are_as_reviewed() {
    for (name, drawing) in DRAWN.iter() {
        for (file, text) in drawing.files(name) {
            // One element or one row a line, and long tables thinned, so that a difference can be read.
            let text = match file.ends_with(".svg") {
                true => text[text.find("</style>").unwrap()..].replace("><", ">\n<"),
                false => thinned(&text),
            };
            reviewed(&format!("figures/{}", file.replace('.', "-")), &text);
        }
    }
}

/// The head of a table and at most about forty of its rows.
fn thinned(csv: &str) -> String {
    let lines: Vec<&str> = csv.lines().collect();
    let stride = (lines.len() / 40).max(1);
    let kept = lines.iter().enumerate().filter(|(i, _)| *i == 0 || (i - 1) % stride == 0);
    kept.map(|(_, line)| format!("{line}\n")).collect()
}

#[test]
fn the_style_of_a_figure_is_as_reviewed() {
    reviewed("figures/style", &creepage::picture::theme::figure());
}

/// End points of Fig. 7: x, y, phi, theta, distance, certified by quadrature with thirty digits.
#[allow(clippy::approx_constant)]
const ENDS: [(&str, &str, [f64; 5]); 9] = [
    ("i", "A", [-0.006597390125, 0.159192881471, 6.271696615277, 11.558226581217, 5.838071687684]),
    ("ii", "nonconservative", [0.034557519189, 0.172787595947, 6.283185307180, 11.579410174250, 6.494800227784]),
    ("ii", "A", [-0.092205095712, 0.211707655900, 6.142874885731, 11.320700794607, 6.349692168517]),
    ("ii", "A_l", [-0.069537915899, 0.203283454924, 6.168440816090, 11.367839519080, 6.376131908870]),
    ("ii", "B", [0.033697738082, 0.168488690411, 6.283185307180, 11.291317789854, 6.333211471911]),
    ("iii", "C1", [0.557385828446, 1.558887238976, 8.954677863154, 11.579410174250, 6.368688333176]),
    ("iii", "D", [-0.981863365110, 1.142114912833, 5.034512821008, 11.579410174250, 6.368688333176]),
    ("iv", "C2", [0.434018829856, 0.160875597244, 6.751326191022, 12.415148877413, 6.336839147648]),
    ("iv", "F", [0.011593978237, 0.162708903587, 6.259285729741, 11.531611019373, 5.885870952056]),
];

/// The ends a figure's file gives, by case and reading.
fn ends() -> BTreeMap<(String, String), Vec<f64>> {
    let table = DRAWN["fig7"].tables.iter().find(|t| t.suffix() == "-ends").unwrap();
    let number = |cell: &String| cell.parse().unwrap();
    table.rows().iter().map(|r| ((r[0].clone(), r[1].clone()), r[2..].iter().map(number).collect())).collect()
}

#[test]
fn the_ends_of_fig_7_are_certified() {
    let ends = ends();
    assert_eq!(ends.len(), 1 + 4 * Reading::ALL.len());
    for (case, reading, wanted) in ENDS {
        for (f, w) in ends[&(case.to_string(), reading.to_string())].iter().zip(wanted) {
            assert!((f - w).abs() < 1e-9, "case {case}, reading {reading}: {f} {w}");
        }
    }
}

#[test]
fn the_ends_of_fig_7_are_those_of_the_reference_file() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/reference/fig7_reference.json");
    let other = "/work/shared/reference/fig7_reference.json";
    let Ok(text) = std::fs::read_to_string(path).or_else(|_| std::fs::read_to_string(other)) else {
        eprintln!("SKIPPED: {path} is not there; the numbers in this file were still checked");
        return;
    };
    let all: serde_json::Value = serde_json::from_str(&text).unwrap();
    for ((case, reading), found) in ends().iter().filter(|((case, _), _)| case != "all") {
        let wanted = &all["cases"][case]["trajectories"][reading];
        for (f, key) in found.iter().zip(["x", "y", "phi", "theta", "distance"]) {
            let w: f64 = wanted[key].as_str().unwrap().parse().unwrap();
            assert!((f - w).abs() < 1e-9, "case {case}, reading {reading}, {key}: {f} {w}");
        }
    }
}

/// The curves end where the table of ends says, and begin at the origin.
#[test]
fn the_curves_of_fig_7_lead_to_its_ends() {
    let drawing = &DRAWN["fig7"];
    let paths = &drawing.tables[0];
    let ends = ends();
    for (case, curve, reading) in [("i", "non-conservative", "nonconservative"), ("iii", "conservative A", "A")] {
        let rows: Vec<_> = paths.rows().iter().filter(|r| r[0] == case && r[1] == curve).collect();
        let [first, last] = [rows[0], rows[rows.len() - 1]];
        assert!(first[3..].iter().all(|v| v == "0.000000"), "{first:?}");
        for (f, w) in last[3..].iter().zip(&ends[&(case.to_string(), reading.to_string())]) {
            assert!((f.parse::<f64>().unwrap() - w).abs() < 1e-6, "{case} {curve}: {f} {w}");
        }
    }
}

/// Which sentence holds under which reading: none, A, A_l, B, C1, C2, D, F.
const HOLDS: [(&str, &str); 9] = [
    ("S1", "YYYYYYYY"),
    ("S1'", "-YYY-Y-Y"),
    ("S2a", "-YY---YY"),
    ("S2b", "-YYY---Y"),
    ("S2c", "YYYYYYYY"),
    ("S2", "-YY---YY"),
    ("S3", "-YY--Y-Y"),
    ("S4", "-Y-Y--Y-"),
    ("S4b", "----YY--"),
];

#[test]
fn readings_are_judged_as_the_theory_has_them() {
    let judged = readings::table().unwrap();
    let found: Vec<(&str, String)> = judged
        .sentences
        .iter()
        .map(|(id, _, holds)| (*id, holds.iter().map(|h| if *h { 'Y' } else { '-' }).collect()))
        .collect();
    let wanted: Vec<(&str, String)> = HOLDS.iter().map(|(id, row)| (*id, (*row).to_string())).collect();
    assert_eq!(found, wanted);
    for (f, w) in judged.ratios.iter().zip([1.0, 1.23182, 1.23069, 1.26873, 0.759843, 1.06043, 0.857745, 1.23398]) {
        assert!((f - w).abs() < 6e-6, "{f} {w}");
    }
    assert!(judged.text().contains("S4b  the energy is constant in time"));
}

/// The table in the documentation is the one computed. After a change: write `readings.md` from the message.
#[test]
fn the_table_in_the_documentation_is_the_computed_one() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/src/figures/readings.md");
    let computed = readings::table().unwrap().markdown();
    let kept = std::fs::read_to_string(path).unwrap();
    assert!(kept == computed, "src/figures/readings.md is stale; it should be\n{computed}");
}

/// The picture for the README is the figure.
#[test]
fn the_picture_in_the_readme_is_the_figure() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/fig7.svg");
    let kept = std::fs::read_to_string(path).unwrap();
    assert!(kept == DRAWN["fig7"].svg, "examples/fig7.svg is stale: `creepage figures fig7 --out examples`");
}

#[test]
fn another_reading_is_another_picture() {
    let b = one("fig7", &Options::new(None, None, "b").unwrap());
    assert!(b.svg != DRAWN["fig7"].svg && b.svg.contains("reading B"));
    assert_eq!(b.tables[1], DRAWN["fig7"].tables[1], "the ends are those of every reading anyway");
}

/// What the coefficients are must show: e_rc where wheels roll, e_tc where they have a direction.
#[test]
fn coefficients_change_the_picture() {
    let rolls = ["fig2", "fig3", "fig6", "fig8", "creep-map", "planning"];
    let directs = [
        "fig1",
        "fig4",
        "fig5",
        "fig6",
        "fig8",
        "creep-map",
        "understeer",
        "off-tracking",
        "planning",
        "parking",
        "backing",
    ];
    for name in rolls {
        assert!(one(name, &with(Some(-0.13), None)).svg != DRAWN[name].svg, "{name} does not show e_rc");
    }
    for name in directs {
        assert!(one(name, &with(None, Some(-0.13))).svg != DRAWN[name].svg, "{name} does not show e_tc");
    }
}

#[test]
fn the_angles_drawn_are_those_of_the_coefficients() {
    for e in [-0.4, -0.1, 0.0, 0.2, 0.5] {
        let disk = quantities(&one("fig2", &with(Some(e), None)));
        assert!((disk["theta_rc = theta - theta_1"] - e * disk["theta"]).abs() < 1e-6, "{disk:?}");
        assert!((disk["d"] - disk["r"] * disk["theta"] * (1.0 - e)).abs() < 1e-6);
        let tyre = quantities(&one("fig1", &with(None, Some(e))));
        assert!((tyre["theta_c"] - e.atan()).abs() < 1e-6, "{tyre:?}");
        let sleigh = quantities(&one("fig5", &with(None, Some(e))));
        assert!((sleigh["phi_tc"] - e.atan()).abs() < 1e-6, "{sleigh:?}");
    }
}

/// A wheel in a figure is a wheel of the model: it stands where the description has it, whatever the vehicle.
#[test]
fn wheels_are_where_the_description_has_them() {
    let model = |id: &str, p: &[(&str, f64)]| creepage::model::Model::new(id, p).unwrap();
    let car = model("car", &[("wheel_radius", 0.3), ("wheelbase", 2.6)]);
    let quarter = std::f64::consts::FRAC_PI_2;
    let rig = Rig::of(&car, &[1.0, 2.0, quarter], &[("wheel_rate", 4.0), ("steering_angle", 0.3)]).unwrap();
    let front = rig.wheels.iter().find(|w| w.steered).unwrap();
    assert!((front.at[0] - 1.0).abs() < 1e-12 && (front.at[1] - 4.6).abs() < 1e-12, "{front:?}");
    assert!((front.heading - quarter - 0.3).abs() < 1e-12 && front.creep_angle().abs() < 1e-12);
    let lengths = [("castor_offset", -0.3), ("castor_trail", 0.04), ("castor_wheel_radius", 0.03)];
    let lengths = [&[("wheel_radius", 0.1), ("track_width", 0.4)][..], &lengths].concat();
    let castor = model("differential-drive-castor", &lengths);
    let inputs = [("wheel_rate_left", 5.0), ("wheel_rate_right", 7.0), ("gamma", quarter)];
    let rig = Rig::of(&castor, &[0.0; 3], &inputs).unwrap();
    // Wheel 1 is the right one; the castor's contact trails behind its axis along the wheel.
    assert_eq!((rig.wheels[0].at, rig.wheels[1].at), ([0.0, -0.2], [0.0, 0.2]));
    let contact = rig.wheels[3].at;
    assert!((contact[0] + 0.3).abs() < 1e-12 && (contact[1] + 0.04).abs() < 1e-12, "{contact:?}");
    assert!(rig.wheels[0].speed() > rig.wheels[1].speed());
}

/// Every wheel and axle moves off its heading by its own coefficient, trailers too.
#[test]
fn velocities_drawn_obey_the_constraints() {
    let table = &DRAWN["fig8"].tables[0];
    let mut seen = 0;
    for row in table.rows().iter().filter(|r| !r[7].is_empty()) {
        let angle: f64 = row[7].parse().unwrap();
        assert!((angle - 0.15f64.atan()).abs() < 2e-6, "{row:?}");
        seen += 1;
    }
    assert_eq!(seen, 10);
}

/// Coordinates of every path: within the sheet, but for the nested panels, whose lines are cut at their frames.
#[test]
fn no_schematic_leaves_its_sheet() {
    for e in [-0.5, -0.2, 0.2, 0.5] {
        for name in ["fig1", "fig2", "fig3", "fig4", "fig5", "fig6", "fig8"] {
            let svg = one(name, &with(Some(e), Some(e))).svg;
            let height: f64 = svg.split(" height=\"").nth(1).unwrap().split('"').next().unwrap().parse().unwrap();
            for data in svg.split(" d=\"").skip(1).map(|d| d.split('"').next().unwrap()) {
                let points = data.split(['M', 'L', 'Z']).filter(|p| !p.is_empty());
                for p in points {
                    let (x, y) = p.split_once(' ').unwrap();
                    let (x, y): (f64, f64) = (x.parse().unwrap(), y.parse().unwrap());
                    assert!(
                        (-1.0..401.0).contains(&x) && (-1.0..=height + 1.0).contains(&y),
                        "{name} at e = {e}: {x}, {y}"
                    );
                }
            }
        }
    }
}

#[test]
fn every_figure_is_well_formed_and_self_contained() {
    for figure in FIGURES {
        let svg = &DRAWN[figure.name].svg;
        assert!(
            svg.contains("<title") && svg.contains("<desc") && svg.contains("prefers-color-scheme:dark"),
            "{}",
            figure.name
        );
        assert!(!svg.contains("NaN") && !svg.contains("var("), "{}", figure.name);
        let outside = svg.replace("http://www.w3.org/2000/svg", "");
        assert!(["http", "href", "url(", "<script"].iter().all(|w| !outside.contains(w)), "{}", figure.name);
        assert!(!DRAWN[figure.name].tables.is_empty());
        for table in &DRAWN[figure.name].tables {
            let columns = table.csv().lines().next().unwrap().split(',').count();
            assert!(table.csv().lines().all(|l| l.split(',').count() == columns), "{}{}", figure.name, table.suffix());
        }
    }
}

#[test]
fn the_same_figure_is_the_same_bytes() {
    for name in ["fig7", "off-tracking"] {
        assert_eq!(one(name, &Options::default()), DRAWN[name]);
    }
}
