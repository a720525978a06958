//! Names that would be code in a page stay text: of a column, a file, an effect.

use crate::program;
use std::fs;

const SCRIPT: &str = "<script>alert(1)</script>";

/// The elements of a page or drawing, by name.
fn elements(text: &str) -> Vec<&str> {
    let opened = text.split('<').skip(1);
    opened.map(|t| t.trim_start_matches('/').split([' ', '>', '/', '\n']).next().unwrap()).collect()
}

/// A page without the two scripts of its own: the kept one, and numbers in which no bracket stands.
fn without_own_scripts(page: &str) -> String {
    let kept = include_str!("../../src/discrepancy/rendering/html/explore.js");
    let rest = page.replacen(&format!("<script>{kept}</script>"), "", 1);
    let (before, after) = rest.split_once("<script type=\"application/json\" id=\"forecasts\">").unwrap();
    let (numbers, after) = after.split_once("</script>").unwrap();
    assert!(!numbers.contains('<') && serde_json::from_str::<serde_json::Value>(numbers).is_ok(), "{numbers:.200}");
    format!("{before}{after}")
}

fn creepage(dir: &std::path::Path, arguments: &[&str]) {
    let output = program::creepage(dir, arguments);
    assert!(output.status.success(), "{output:?}");
}

#[test]
fn names_stay_text_in_the_report_and_its_drawings() {
    let dir = tempfile::tempdir().unwrap();
    let put = |name: &str, text: String| fs::write(dir.path().join(name), text).unwrap();
    // A file's name cannot hold a slash.
    let run = "<script>alert(2)<img src=x onerror=alert(3)>.csv";
    let row = |i: usize| {
        let t = i as f64 * 0.05;
        let rate = if i == 7 { "nan".to_string() } else { format!("{}", 2.0 + (0.5 * t).sin()) };
        format!("{t},{},{},0,{rate},0.0\n", 0.5 * (2.0 * t - 2.0 * ((0.5 * t).cos() - 1.0)), 0.001 * (i % 3) as f64)
    };
    put(run, format!("time,x,y,heading,{SCRIPT},yaw_rate\n{}", (0..400).map(row).collect::<String>()));
    put(
        "model.toml",
        format!(
            "# {SCRIPT}\nvehicle = \"unicycle\"\n[parameters]\nwheel_radius = 0.5\n[columns]\nwheel_rate = \"{SCRIPT}\"\n"
        ),
    );
    put(
        "effects.toml",
        format!(
            "[[effect]]\nid = \"gain\"\nwhere = \"{SCRIPT}\"\nsays = \"{SCRIPT}\"\nplain = \"{SCRIPT} {{k | %}}\"\nsource = \"{SCRIPT}\"\n\
             [effect.parameters.k]\nunit = \"1\"\nrange = [-1.0, 1.0]\nsize = 0.1\n[effect.changes]\nv_t = \"it + k*v_l\"\n"
        ),
    );
    creepage(
        dir.path(),
        &["discover", run, "--model", "model.toml", "--effects", "effects.toml", "--horizon", "1", "--out", "out"],
    );
    let read = |name: &str| fs::read_to_string(dir.path().join("out").join(name)).unwrap();
    let page = read("report.html");
    assert!(page.contains("&lt;script&gt;alert(1)&lt;/script&gt;"), "the column is not named");
    assert!(page.contains("&lt;script&gt;alert(2)&lt;img src=x"), "the file is not named");
    for text in [without_own_scripts(&page), read("gap.svg")] {
        let found = elements(&text);
        assert!(!found.iter().any(|e| ["script", "img"].contains(e)), "{found:?}");
    }
    assert!(read("report.json").contains("alert(1)"));
}
