//! The page, the drawing for the README and the one-screen summary.

use crate::reviewed::reviewed;
use crate::synthetic::{bare, path_picture, pictures, report, residual};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use creepage::discrepancy::rendering::html::check_page::check_html;
use creepage::discrepancy::rendering::html::{gap_svg, html};
use creepage::discrepancy::rendering::summary::summary_text;
use creepage::discrepancy::report::*;
use sha2::{Digest, Sha256};

const VERDICTS: [Verdict; 5] = [
    Verdict::UnusableData,
    Verdict::NotIdentifiable,
    Verdict::UnnamedEffect,
    Verdict::MissingEffect,
    Verdict::NoMissingEffect,
];

/// A page without its scripts, which no markup is read in, and the scripts.
fn without_scripts(page: &str) -> (String, Vec<&str>) {
    let (mut rest, mut scripts) = (String::new(), vec![]);
    for (i, part) in page.split("<script").enumerate() {
        match part.split_once("</script>").filter(|_| i > 0) {
            Some((script, after)) => {
                scripts.push(script);
                rest.push_str(after);
            }
            None => rest.push_str(part),
        }
    }
    (rest, scripts)
}

/// Panics unless the page runs nothing but the one script whose hash its policy names; what else it holds is data.
fn check_scripts(page: &str) {
    let (_, scripts) = without_scripts(page);
    let (data, code): (Vec<&str>, Vec<&str>) =
        scripts.into_iter().partition(|s| s.starts_with(" type=\"application/json\""));
    assert!(data.len() <= 1 && code.len() <= 1, "{} blocks of data, {} scripts", data.len(), code.len());
    for block in data {
        serde_json::from_str::<serde_json::Value>(block.split_once('>').unwrap().1).unwrap();
    }
    let allowed = page.split("script-src 'sha256-").nth(1).map(|t| t.split('\'').next().unwrap());
    let hash = |code: &&str| STANDARD.encode(Sha256::digest(code.strip_prefix('>').unwrap()));
    assert_eq!(allowed, code.first().map(hash).as_deref(), "the policy allows the script of the page alone");
}

/// Tags of a text, in order, without the angle brackets; panics where a bracket or an ampersand stands loose.
fn tags(text: &str) -> Vec<&str> {
    let mut tags = Vec::new();
    let mut rest = text;
    while let Some(open) = rest.find('<') {
        check_text(&rest[..open]);
        let close = open + rest[open..].find('>').expect("a tag that ends");
        let tag = &rest[open + 1..close];
        assert!(!tag.contains('<'), "a bracket inside the tag {tag}");
        assert_eq!(tag.matches('"').count() % 2, 0, "quotation marks in {tag}");
        tags.push(tag);
        rest = &rest[close + 1..];
    }
    check_text(rest);
    tags
}

fn check_text(text: &str) {
    assert!(!text.contains('>'), "a loose bracket in {text:.80}");
    for after in text.split('&').skip(1) {
        assert!(["amp;", "lt;", "gt;", "quot;"].iter().any(|e| after.starts_with(e)), "a loose & before {after:.20}");
    }
}

/// Panics unless every tag that opens also closes, in order, and no id stands twice.
fn check_well_formed(text: &str) {
    let mut open = Vec::new();
    let mut ids = std::collections::BTreeSet::new();
    for tag in tags(text) {
        if let Some(id) = tag.split(" id=\"").nth(1).and_then(|t| t.split('"').next()) {
            assert!(ids.insert(id), "the id {id} stands twice");
        }
        match tag.strip_prefix('/') {
            Some(name) => assert_eq!(open.pop(), Some(name)),
            None if tag.ends_with('/') || tag.starts_with('!') => {}
            None => open.push(tag.split(' ').next().unwrap()),
        }
    }
    assert!(open.is_empty(), "never closed: {open:?}");
}

/// Panics where a page would ask for anything outside itself, or holds a number that is none.
fn check_harmless(text: &str) {
    let text = text.replace("http://www.w3.org/2000/svg", "").replace("http-equiv", "").to_lowercase();
    for word in ["http", "src=", "href=\"", "url(", "@import", "javascript", "<iframe", "<link", "//"] {
        // A link within the page is no request.
        assert!(!text.replace("href=\"#", "").contains(word), "{word} in the page");
    }
    assert!(!text.contains("<script"), "a script in markup");
    let numbers = text.split(" d=\"").skip(1).map(|t| t.split('"').next().unwrap());
    for d in numbers.chain(text.split(" x=\"").skip(1).map(|t| t.split('"').next().unwrap())) {
        assert!(!d.contains("nan") && !d.contains("inf"), "{d:.60}");
    }
    let mut words = text.split(|c: char| !c.is_alphanumeric());
    assert!(!words.any(|w| w == "nan" || w == "inf"), "a number that is none is written out");
}

/// When an effect holds that holds in part is framed on the strip, and where, on the map.
#[test]
fn a_scope_is_drawn_where_it_holds() {
    let (mut report, mut pictures) = (report(), pictures());
    pictures.forecasts[0].scoped = vec![[0.0, 4.0], [9.0, 12.0]];
    report.effects[0].scope = Some(ScopeFound { disk: Some([1.0, 0.5, 0.7]), ..ScopeFound::default() });
    let [page, _] = check(&report, &pictures);
    let [map, strip] = page.split("id=\"strip\"").collect::<Vec<_>>()[..] else { panic!("one strip") };
    let number = |text: &str, name: &str| -> f64 {
        text.split(&format!(" {name}=\"")).nth(1).unwrap().split('"').next().unwrap().parse().unwrap()
    };
    let rects = strip.split("<rect class=\"scope\"").skip(1).map(|r| [number(r, "x"), number(r, "width")]);
    // The places of the run lie between 0 and 19.5 s.
    let expected = [[0.0, 4.0], [9.0, 3.0]].map(|span| span.map(|t: f64| 1000.0 * t / 19.5));
    let found: Vec<[f64; 2]> = rects.collect();
    assert!(
        found.len() == 2 && found.iter().flatten().zip(expected.iter().flatten()).all(|(a, b)| (a - b).abs() < 0.1)
    );
    assert!(map.contains("<circle class=\"scope\""));
}

#[test]
fn the_page_of_a_check_says_what_the_runs_can_tell() {
    let home = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/runs/cornering/");
    let model = creepage::Model::read(format!("{home}model.toml")).unwrap();
    let eights = creepage::Run::read(format!("{home}eights.csv"), &model).unwrap();
    let mut told = creepage::check(&model, &[eights]).unwrap();
    let page = |told: &creepage::Check| {
        let page = check_html(told, "unicycle", "0.0.0", &[]);
        check_scripts(&page);
        let (markup, _) = without_scripts(&page);
        check_well_formed(&markup);
        check_harmless(&markup);
        page
    };
    let whole = page(&told);
    for effect in &told.effects {
        assert!(whole.contains(&format!(">{}<", effect.id)), "{}", effect.id);
    }
    assert!(whole.contains(&told.summary) && whole.contains("What to drive next") && !whole.contains("<script"));
    // Lines to paste come with a button, hostile words stay words, and what is not known is not drawn.
    told.data.findings[0].mend = Some("[columns]\nx = \"</pre><script>\"".into());
    told.effects.iter_mut().flat_map(|e| e.parameters.values_mut()).for_each(|p| p.smallest_seen = None);
    assert!(page(&told).contains("x = &quot;&lt;/pre&gt;&lt;script&gt;&quot;"));
    (told.effects, told.next_experiment) = (vec![], None);
    page(&told);
}

fn check(report: &Report, pictures: &Pictures) -> [String; 2] {
    let written = [html(report, pictures), gap_svg(report, pictures)];
    for text in &written {
        check_scripts(text);
        let (markup, scripts) = without_scripts(text);
        check_well_formed(&markup);
        check_harmless(&markup);
        // Numbers in base 64 spell anything.
        scripts.iter().filter(|s| s.starts_with('>')).for_each(|code| check_harmless(code));
    }
    written
}

#[test]
fn the_page_is_well_formed_and_asks_for_nothing() {
    let [page, svg] = check(&report(), &pictures());
    assert!(page.contains("default-src 'none'; style-src 'unsafe-inline'"));
    // The gap, the candidates, the constraints and the runs; the map is no figure.
    assert_eq!(page.matches("<figure>").count(), 4);
    assert_eq!(page.matches("<figcaption>").count(), 4);
    assert!(svg.contains("prefers-color-scheme:dark") && page.contains("prefers-color-scheme:dark"));
}

#[test]
fn every_picture_has_a_title_and_a_description() {
    let [page, svg] = check(&report(), &pictures());
    for text in [page, svg] {
        for drawing in text.split("role=\"img\"").skip(1) {
            let drawing = &drawing[..drawing.len().min(400)];
            assert!(drawing.contains("<title") && drawing.contains("<desc"), "{drawing}");
        }
    }
}

/// Panels stand side by side, none over another and none outside.
#[test]
fn the_panels_of_the_drawing_lie_within_it() {
    let [_, svg] = check(&report(), &pictures());
    let number = |text: &str, name: &str| -> Option<f64> {
        text.split_once(&format!(" {name}=\""))?.1.split_once('"')?.0.parse().ok()
    };
    let tags = || svg.split('<').map(|t| t.split('>').next().unwrap());
    let [width, height] = ["width", "height"].map(|name| number(tags().nth(1).unwrap(), name).unwrap());
    let panels: Vec<[f64; 4]> = tags()
        .filter(|t| t.contains("role=\"img\"") && t.contains(" x=\""))
        .map(|t| ["x", "y", "width", "height"].map(|name| number(t, name).unwrap()))
        .collect();
    assert_eq!(panels.len(), 2);
    assert!(panels.iter().all(|[x, y, w, h]| *x > 0.0 && x + w < width && *y > 0.0 && y + h < height), "{panels:?}");
    assert!(panels.windows(2).all(|p| p[0][0] + p[0][2] <= p[1][0]), "{panels:?}");
}

#[test]
fn the_drawing_says_in_its_title_what_shrank() {
    let [page, svg] = check(&report(), &pictures());
    let (title, _) = svg.split_once("</title>").unwrap();
    let gap = report().gap[1].held_out.unwrap();
    let mm = |v: f64| creepage::number_format::significant(1000.0 * v, 2);
    let shrank = format!(
        "Held-out position error after 5 s: {} → {} mm",
        mm(gap.position_rms_before),
        mm(gap.position_rms_after)
    );
    assert!(title.contains(&shrank), "{title} and {shrank}");
    let on_page = format!("miss by {} mm in place of {} mm", mm(gap.position_rms_after), mm(gap.position_rms_before));
    assert!(page.contains(&on_page), "the page says it, too: {on_page}");
}

/// The heading is for anyone; what the report's own sentence says beyond its effects is not lost.
#[test]
fn the_heading_says_what_was_found_and_nothing_less() {
    let heading = |report: &Report| {
        let [page, _] = check(report, &pictures());
        let (_, after) = page.split_once("<h1>").unwrap();
        after.split_once("</h1>").unwrap().0.to_string()
    };
    let mut found = report();
    let plain = format!("{}.", found.effects[0].plain);
    found.summary = format!("{} (cornering-creep).", found.effects[0].plain);
    assert_eq!(heading(&found), plain);
    found.summary = "The model misses cornering-creep; what else remains differs between parts.".into();
    assert!(heading(&found).contains("what else remains differs"), "{}", heading(&found));
    // A run that differs is told first, and counts as a cause.
    let odd = OddRun {
        run: "c.csv".into(),
        id: "track-width".into(),
        parameters: Default::default(),
        others: Default::default(),
        plain: "The wheels stand 3.0 % further apart than the model says".into(),
        says: "c.csv differs".into(),
    };
    found.odd_runs = vec![odd];
    let both = heading(&found);
    assert!(
        both.starts_with("In c.csv the wheels stand 3.0 % further apart") && both.contains("In the others in turns"),
        "{both}"
    );
    found.effects.clear();
    let [page, _] = check(&found, &pictures());
    assert!(page.contains("Found 1 cause") && page.contains("1 run unlike the others"), "{both}");
}

/// The mark and the colour are those of the patched model.
#[test]
fn the_state_is_that_of_the_patched_model() {
    let class = |report: &Report| {
        let [page, _] = check(report, &pictures());
        page.split("<span class=\"verdict ").nth(1).unwrap().split('"').next().unwrap().to_string()
    };
    let mut found = report();
    assert_eq!(class(&found), "good");
    let remains = Remains {
        ratio: 5.0,
        place: "yaw rate".into(),
        from: 1.0,
        to: 2.0,
        regime: "reverse".into(),
        says: "held-out error is 5.0 times the noise".into(),
    };
    found.remains = Some(remains);
    assert_eq!(class(&found), "above");
    let judged = found.gap[1].held_out.as_mut().unwrap();
    judged.position_rms_after = 1.2 * judged.position_rms_before;
    assert_eq!(class(&found), "bad");
    assert_eq!(class(&bare(Verdict::UnusableData)), "bad");
    assert_eq!(class(&bare(Verdict::NotIdentifiable)), "above");
}

/// Where nothing can be said the warnings say why, before any picture; elsewhere they wait at the end.
#[test]
fn the_reason_for_no_answer_stands_at_the_top() {
    for (verdict, at_the_top) in [(Verdict::UnusableData, true), (Verdict::NotIdentifiable, false)] {
        let mut report = bare(verdict);
        report.data.warnings = vec!["the log stands still".into()];
        let [page, _] = check(&report, &pictures());
        let (top, _) = page.split_once("<figure>").unwrap();
        assert_eq!(top.contains("<li>the log stands still</li>"), at_the_top);
    }
}

/// Candidates beyond the usual number are drawn where they are chosen or not told from what is.
#[test]
fn what_is_chosen_is_drawn_however_far_behind() {
    let mut pictures = pictures();
    let one = |i: usize| CandidatePicture {
        id: format!("effect-{i}"),
        delta_bic: 50.0 - i as f64,
        ..CandidatePicture::default()
    };
    pictures.candidates = (0..20).map(one).collect();
    pictures.candidates[0].chosen = true;
    pictures.candidates[16].chosen = true;
    pictures.candidates[18].rival = true;
    let [page, _] = check(&report(), &pictures);
    let is_drawn = |i: usize| page.contains(&format!("effect-{i}<"));
    let drawn: Vec<usize> = (0..20).filter(|i| is_drawn(*i)).collect();
    assert_eq!(drawn, (0..14).chain([16, 18]).collect::<Vec<_>>());
}

#[test]
fn both_axes_of_a_path_have_one_scale() {
    let mut run = path_picture("line.csv", true, 0);
    run.measured = vec![[0.0, 0.0], [10.0, 0.0], [10.0, 1.0]];
    (run.before, run.after) = (vec![], vec![]);
    let page = gap_svg(&bare(Verdict::NoMissingEffect), &Pictures { paths: vec![run], ..Pictures::default() });
    let path = page.split("line measured\" d=\"").last().unwrap().split('"').next().unwrap();
    let points: Vec<Vec<f64>> =
        path[1..].split('L').map(|p| p.split(' ').map(|v| v.parse().unwrap()).collect()).collect();
    let (across, up) = (points[1][0] - points[0][0], points[1][1] - points[2][1]);
    assert!((across - 10.0 * up).abs() < 1.0, "{across} px for 10 m, {up} px for 1 m");
}

#[test]
fn text_from_files_stays_text() {
    let evil = "<script>alert(\"1\")</script>&\u{1b}[31m";
    let (mut report, mut pictures) = (report(), pictures());
    report.summary = evil.into();
    report.effects[0].id = evil.into();
    report.effects[0].equation = evil.into();
    report.disagreement[0].run = evil.into();
    report.data.warnings.push(evil.into());
    report.provenance.inputs_sha256.insert(evil.into(), evil.into());
    pictures.paths.iter_mut().for_each(|p| p.run = evil.into());
    pictures.residuals[0].constraint = evil.into();
    pictures.columns = vec![column(evil, 0.0)];
    pictures.candidates[0].id = evil.into();
    let [page, svg] = check(&report, &pictures);
    assert!(page.contains("&lt;script&gt;alert(&quot;1&quot;)&lt;/script&gt;&amp;"));
    assert!(svg.contains("&lt;script&gt;"));
    assert!(!page.contains('\u{1b}') && !svg.contains('\u{1b}') && !summary_text(&report).contains('\u{1b}'));
}

#[test]
fn the_same_report_gives_the_same_bytes() {
    assert_eq!(check(&report(), &pictures()), check(&report(), &pictures()));
}

#[test]
fn every_verdict_reads_with_and_without_pictures() {
    for verdict in VERDICTS {
        let [page, svg] = check(&bare(verdict), &Pictures::default());
        assert!(!page.contains("<figure>") && page.contains("<h1>") && !page.contains("<h1></h1>"));
        assert!(svg.contains("<text class=\"title\""));
        let mut full = report();
        full.verdict = verdict;
        check(&full, &pictures());
    }
}

#[test]
fn an_unnamed_effect_shows_its_place_and_equation() {
    let mut report = bare(Verdict::UnnamedEffect);
    let [place, equation] = ["traverse constraint", "v_t = -0.03*v_l^2"].map(String::from);
    report.unnamed.push(Unnamed { place, equation, held_out_reduction: 0.8, parameters: Default::default() });
    let [page, _] = check(&report, &Pictures::default());
    assert!(
        page.contains("at the traverse constraint: <code>v_t = -0.03*v_l^2</code>")
            && page.contains("v_t = -0.03*v_l^2")
            && page.contains("80 %")
    );
    assert!(summary_text(&report).contains("v_t = -0.03*v_l^2"));
}

#[test]
fn values_that_are_no_numbers_break_lines_and_never_reach_the_page() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let (mut report, mut pictures) = (report(), pictures());
        pictures.paths[2].measured[500] = [bad, 0.0];
        pictures.paths[2].before[1] = vec![[bad, bad]; 3];
        pictures.residuals[1].before[100] = bad;
        pictures.residuals[0].noise = bad;
        pictures.gap.after[2] = bad;
        pictures.gap.floor[0] = bad;
        pictures.candidates[3].delta_bic = bad;
        pictures.forecasts[0].pose[3] = [bad; 3];
        pictures.forecasts[0].paths[4][1] = vec![[bad, 0.0]; 5];
        pictures.forecasts[0].error[5] = [bad; 2];
        pictures.forecasts[0].floor = bad;
        pictures.columns = vec![column("speed", bad)];
        report.gap[1].held_out.as_mut().unwrap().position_rms_after = bad;
        report.effects[0].evidence.delta_bic = bad;
        report.effects[0].parameters.get_mut("mass_over_bT").unwrap().value = bad;
        let [page, _] = check(&report, &pictures);
        assert!(!page.contains("cy=\"0\""), "a marker for no value");
        let path = page.split("line measured\" d=\"").nth(1).unwrap().split('"').next().unwrap();
        assert_eq!(path.matches('M').count(), 2, "the line breaks once");
        assert!(!summary_text(&report).contains("NaN") && !summary_text(&report).contains("inf"));
    }
    check(
        &report(),
        &Pictures { paths: vec![PathPicture { measured: vec![[f64::NAN; 2]; 9], ..Default::default() }], ..pictures() },
    );
}

fn column(name: &str, first: f64) -> ColumnPicture {
    let (time, values) = (vec![0.0, 0.1, 0.2], vec![first, 1.0, 2.0]);
    ColumnPicture { run: "a.csv".into(), name: name.into(), unit: "m/s".into(), time, values }
}

#[test]
fn the_columns_of_data_that_cannot_be_used_are_drawn() {
    let columns = (0..25).map(|_| column("speed", 0.5)).collect();
    let [page, _] = check(&bare(Verdict::UnusableData), &Pictures { columns, ..Pictures::default() });
    assert_eq!(page.matches("Between 0.500 and 2.00 m/s, from 0 s to 0.200 s.").count(), 24);
    assert!(page.contains("Not drawn: 1 further column."));
}

#[test]
fn a_million_rows_still_give_a_small_page() {
    let mut pictures = pictures();
    let long = |i: usize| {
        let t = i as f64 * 1e-3;
        [t.sin() * 20.0 + (i % 7) as f64 * 0.01, (t * 1.3).cos() * 15.0]
    };
    for path in &mut pictures.paths {
        path.measured = (0..1_000_000).map(long).collect();
        path.before = path.measured.chunks(1000).map(<[_]>::to_vec).collect();
        path.after = path.before.clone();
    }
    let mut more = pictures.paths.clone();
    more.iter_mut().for_each(|p| p.held_out = false);
    pictures.paths.extend(more);
    let mut residual = residual("traverse constraint", "long.csv", 0.1, 1);
    residual.time = (0..1_000_000).map(|i| i as f64 * 1e-3).collect();
    residual.before = (0..1_000_000_u64).map(|i| (i * 7919 % 1000) as f64 * 1e-3).collect();
    residual.after = residual.before.clone();
    let short = crate::synthetic::residual("traverse constraint", "short.csv", 0.1, 1);
    pictures.residuals = [vec![residual; 30], vec![short; 47]].concat();
    pictures.paths.push(path_picture("seventh.csv", false, 1));
    let [page, svg] = check(&report(), &pictures);
    println!("page {} bytes, drawing {} bytes", page.len(), svg.len());
    assert_eq!(page.matches("id=\"path-").count(), 2 * 6, "six runs: a title and a description each");
    assert!(page.contains("Not drawn: 1 further run.") && page.contains("Not drawn: 5 further pairs"));
    assert_eq!(page.matches("residual-29-both-title").count(), 2, "one strip for both models");
    assert!(page.len() < 1_500_000, "{} bytes", page.len());
    assert!(svg.len() < 300_000, "{} bytes", svg.len());
}

#[test]
fn the_summary_fits_a_screen() {
    let mut crowded = report();
    crowded.summary = "A long sentence that goes on and on. ".repeat(20);
    crowded.effects = vec![crowded.effects[0].clone(); 9];
    crowded.gap = vec![crowded.gap[1].clone(); 9];
    crowded.data.warnings = vec!["a warning that is much longer than one line of a terminal ".repeat(5); 4];
    crowded.next_experiment.as_mut().unwrap().why = "because ".repeat(60);
    for report in VERDICTS.map(bare).into_iter().chain([report(), crowded]) {
        let text = summary_text(&report);
        assert!(text.lines().count() <= 24, "{} lines\n{text}", text.lines().count());
        assert!(text.lines().all(|l| l.chars().count() <= 80), "{text}");
    }
    assert!(summary_text(&report()).contains("0.1094 ± 0.0021"));
    let mut sharp = report();
    let estimate = sharp.effects[0].parameters.get_mut("mass_over_bT").unwrap();
    (estimate.value, estimate.std) = (-0.009900918, Some(7.4e-7));
    assert!(summary_text(&sharp).contains(" −0.00990092 ± 7.4e−7 "), "{}", summary_text(&sharp));
}

#[test]
fn the_summary_is_as_reviewed() {
    reviewed("summary", &summary_text(&report()));
}

/// The same pictures with a far origin, a clock's epoch, long names and a small gap.
fn hard(mut pictures: Pictures) -> Pictures {
    for path in &mut pictures.paths {
        path.run = "a-very-long-name-of-a-run-recorded-on-a-rainy-day-2024-11-21T10-22-33.csv".into();
        let pieces = path.before.iter_mut().chain(&mut path.after).chain([&mut path.measured]);
        pieces.flatten().for_each(|p| *p = [500_000.0 + 20.0 * p[0], 4_500_000.0 + p[1]]);
    }
    for residual in &mut pictures.residuals {
        residual.run = pictures.paths[0].run.clone();
        residual.time.iter_mut().for_each(|t| *t += 1.7e9);
        residual.before.iter_mut().chain(&mut residual.after).for_each(|v| *v *= 1e-4);
        residual.noise *= 1e-4;
    }
    pictures.candidates.iter_mut().for_each(|c| c.delta_bic *= -0.01);
    pictures.candidates[5].id = "an-effect-of-the-user-with-a-long-name".into();
    pictures
}

/// Writes the pages to look at into `target/look`: `cargo test --release --test reports html -- --ignored`.
#[test]
#[ignore = "writes files to look at"]
fn pages_to_look_at() {
    let dir = concat!(env!("CARGO_MANIFEST_DIR"), "/target/look");
    std::fs::create_dir_all(dir).unwrap();
    let write = |name: &str, text: String| std::fs::write(format!("{dir}/{name}"), text).unwrap();
    write("missing.html", html(&report(), &pictures()));
    write("gap.svg", gap_svg(&report(), &pictures()));
    write("hard.html", html(&report(), &hard(pictures())));
    write("hard.svg", gap_svg(&report(), &hard(pictures())));
    for verdict in VERDICTS {
        write(&format!("bare-{verdict:?}.html"), html(&bare(verdict), &Pictures::default()));
    }
    println!("{}", summary_text(&report()));
}
