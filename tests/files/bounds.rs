//! Everything a file may hold has a bound, for the sake of time and memory: what lies on it is read as it stands, what lies
//! beyond is refused at its place.

use creepage::files::{Axis, Distribution, EffectsFile, SweepFile, SweepRows, VehiclesFile, read_claims};
use creepage::{Error, Result};
use std::path::Path;

/// Reads a text as a file.
fn reads<T>(text: &str, read: impl FnOnce(&Path) -> Result<T>) -> Result<T> {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("model.toml"), "").unwrap();
    let path = folder.path().join("file.toml");
    std::fs::write(&path, text).unwrap();
    read(&path)
}

/// That one text is read and another refused with some words.
fn bounded<T>(good: &str, bad: &str, why: &str, read: fn(&Path) -> Result<T>) {
    if let Err(error) = reads(good, read) {
        panic!("{error}");
    }
    refused(reads(bad, read), why);
}

fn refused<T>(found: Result<T>, why: &str) {
    let Err(error) = found else { panic!("not refused: {why}") };
    let said: &Error = &error;
    assert_eq!(said.exit_code(), 2);
    assert!(said.to_string().contains(why), "{said}\n{why}");
}

#[test]
fn claims_have_at_most_twenty_trailers_and_four_thousand_characters() {
    let read = |path: &Path| read_claims(path, &["car", "unicycle"]);
    let entry = |rest: &str| format!("[[claim]]\nid = \"a\"\nstatus = \"open\"\n{rest}\n");
    let trailers = |n: usize| entry(&format!("vehicle = \"car\"\ntrailers = {n}"));
    bounded(&trailers(20), &trailers(21), ":5:12: 21 trailers are more than a claim may have; give at most 20", read);
    let found = reads(&trailers(20), read).unwrap();
    assert_eq!(found[0].vehicle, Some(("car".to_string(), 20)));
    // "x = " and a sum of the length that is left.
    let equation = |n: usize| entry(&format!("equations = [\"x = {}1\"]", " ".repeat(n - 5)));
    bounded(&equation(4000), &equation(4001), "an equation has at most 4000 characters", read);
}

/// An effect with one parameter, its name and what it changes.
fn effect(name: &str, parameter: &str, changes: &str) -> String {
    format!(
        "[[effect]]\nid = \"slip\"\nwhere = \"here\"\nsays = \"it slides\"\n[effect.parameters.{name}]\n{parameter}\n\
         [effect.changes]\n{changes}\n"
    )
}

const PARAMETER: &str = "unit = \"1\"\nrange = [-1.0, 1.0]\nsize = 0.1";

#[test]
fn names_of_effects_have_at_most_sixty_characters() {
    let named = |n: usize| {
        let name = "q".repeat(n);
        effect(&name, PARAMETER, &format!("v_t = \"it + {name}*v_l\""))
    };
    bounded(&named(60), &named(61), "cannot name a parameter or a state", EffectsFile::read);
    let id =
        |n: usize| effect("q", PARAMETER, "v_t = \"it + q\"").replace("\"slip\"", &format!("\"{}\"", "s".repeat(n)));
    bounded(&id(60), &id(61), "cannot be the id of an effect", EffectsFile::read);
    let change = |n: usize| effect("q", PARAMETER, &format!("{} = \"it + q\"", "w".repeat(n)));
    bounded(&change(60), &change(61), "is no name of a definition", EffectsFile::read);
}

#[test]
fn formulas_have_at_most_four_hundred_characters_and_sixty_four_factors() {
    // "it + q" and blanks before it do not count; those within do.
    let long = |n: usize| effect("q", PARAMETER, &format!("v_t = \"it + {}q\"", " ".repeat(n - 6)));
    bounded(&long(400), &long(401), "v_t has 401 characters, and 400 are the most", EffectsFile::read);
    let power = |n: usize| effect("q", PARAMETER, &format!("v_t = \"it + q*v_l^{n}\""));
    bounded(&power(63), &power(64), "a product of more than 64 factors", EffectsFile::read);
    let twice = power(64).replace("v_l^64", "v_l^64*v_l^64");
    refused(reads(&twice, EffectsFile::read), "a product of more than 64 factors");
}

/// A range holds 0 where the effect vanishes, on its bound too; of a positive parameter it begins at 0 or above.
#[test]
fn ranges_hold_where_the_effect_vanishes() {
    let range = |low: f64, high: f64, rest: &str| {
        let parameter = format!("unit = \"1\"\nrange = [{low:?}, {high:?}]\nsize = 0.1\n{rest}");
        effect("q", &parameter, "v_t = \"it + q*v_l\"")
    };
    let positive = "positive = true\nstart = [0.5]";
    for (good, bad) in [([0.0, 1.0], [0.01, 1.0]), ([-1.0, 0.0], [-1.0, -0.01])] {
        let lacks = format!("range from {:?} to {:?} lacks 0, where the effect vanishes", bad[0], bad[1]);
        bounded(&range(good[0], good[1], ""), &range(bad[0], bad[1], ""), &lacks, EffectsFile::read);
    }
    bounded(
        &range(0.0, 1.0, positive),
        &range(-0.01, 1.0, positive),
        "range of a positive parameter begins at -0.01",
        EffectsFile::read,
    );
    assert!(reads(&range(0.05, 1.0, positive), EffectsFile::read).is_ok());
    refused(reads(&range(0.0, 0.05, ""), EffectsFile::read), "size = 0.1 lies outside of the range 0.0 to 0.05");
    // A magnitude: its negative may be what the range allows.
    assert!(reads(&range(-1.0, 0.05, ""), EffectsFile::read).is_ok());
}

/// A fit wraps an angle into a turn, all of which must be allowed.
#[test]
fn periodic_parameters_have_a_whole_turn() {
    let angle = |low: f64, high: f64| {
        let parameter = format!("unit = \"rad\"\nrange = [{low:?}, {high:?}]\nsize = 0.1\nperiodic = true");
        effect("q", &parameter, "v_t = \"it + sin(q)*v_l\"")
    };
    let pi = std::f64::consts::PI;
    bounded(&angle(-pi, pi), &angle(-3.1, pi), "must hold a whole turn", EffectsFile::read);
    refused(reads(&angle(-pi, 3.1), EffectsFile::read), "must hold a whole turn");
    refused(reads(&angle(3.1, 3.2), EffectsFile::read), "lacks 0");
    let other = angle(-pi, pi).replace("\"rad\"", "\"m\"");
    refused(reads(&other, EffectsFile::read), "a periodic parameter is an angle, not of unit m");
    let both = angle(-pi, pi).replace("periodic", "positive = true\nstart = [0.5]\nperiodic").replace("-3.14", "0.0 #");
    refused(reads(&both.replace("[0.0 #", "[0.0, 3.2] #"), EffectsFile::read), "both positive and periodic");
}

fn sweep_file(path: &Path) -> Result<SweepFile> {
    SweepFile::read(path)
}

fn sweep(rest: &str) -> String {
    format!("model = \"model.toml\"\n{rest}")
}

#[test]
fn a_grid_has_at_most_ten_million_values() {
    let grid = |count: usize| sweep(&format!("[grid]\ne = {{ from = 0.0, to = 0.1, count = {count} }}"));
    let most = 10_000_000;
    let found = reads(&grid(most), sweep_file).unwrap();
    assert_eq!((found.cases, found.grid[0].values.count()), (most, most));
    assert_eq!([found.grid[0].values.at(0), found.grid[0].values.at(most - 1)], [0.0, 0.1]);
    refused(reads(&grid(most + 1), sweep_file), "count = 10000001 is more than 10000000; give fewer values");
    refused(reads(&grid(1), sweep_file), "one value cannot reach from one bound to the other");
    let one = reads(&grid(1).replace("to = 0.1", "to = 0.0"), sweep_file).unwrap();
    let Axis { values, .. } = &one.grid[0];
    assert_eq!((values.count(), values.at(0)), (1, 0.0));
}

#[test]
fn distributions_have_bounds_in_their_order() {
    let drawn = |what: &str| {
        let text = sweep(&format!("[sample]\ncount = 2\n[sample.of]\ne = {{ {what} }}"));
        reads(&text, sweep_file).map(|file| file.sampled[0].from)
    };
    assert_eq!(drawn("normal = [0.5, 0.0]").unwrap(), Distribution::Normal(0.5, 0.0));
    assert_eq!(drawn("normal = [5.0, 0.1]").unwrap(), Distribution::Normal(5.0, 0.1));
    refused(drawn("normal = [0.5, -0.1]"), "normal [0.5, -0.1] has a negative standard deviation");
    assert_eq!(drawn("uniform = [0.2, 0.2]").unwrap(), Distribution::Uniform(0.2, 0.2));
    refused(drawn("uniform = [0.3, 0.2]"), "uniform [0.3, 0.2] begins above its end");
    assert_eq!(drawn("log_uniform = [0.1, 0.2]").unwrap(), Distribution::LogUniform(0.1, 0.2));
    refused(drawn("log_uniform = [0.0, 0.2]"), "has a bound that is not positive");
}

#[test]
fn seeds_are_whole_numbers_up_to_the_last_that_is_one() {
    let seeded = |seed: &str| {
        let text = sweep(&format!("[sample]\ncount = 2\nseed = {seed}\n[sample.of]\ne = {{ uniform = [0.0, 1.0] }}"));
        reads(&text, sweep_file).map(|file| file.seed)
    };
    for good in [0, 7, 1 << 53] {
        assert_eq!(seeded(&good.to_string()).unwrap(), good);
    }
    for bad in ["-1", "0.5", "9007199254740994"] {
        refused(seeded(bad), "seed must be a whole number from 0");
    }
}

#[test]
fn errors_of_a_sweep_lie_between_what_can_be_kept_and_one() {
    let error = |text: &str| reads(&sweep(&format!("error = {text}")), sweep_file).map(|file| file.error);
    assert_eq!([error("1e-13").unwrap(), error("0.5").unwrap(), error("1.0").unwrap()], [1e-13, 0.5, 1.0]);
    for bad in ["9e-14", "1.1"] {
        refused(error(bad), "is out of range; it must lie within 1e-13 and 1");
    }
}

#[test]
fn knots_of_a_sweep_rise() {
    let knots = |text: &str| reads(&sweep(&format!("[inputs]\nknots = {text}")), sweep_file).map(|file| file.knots);
    assert_eq!(knots("[1.5, 3.0]").unwrap(), [1.5, 3.0]);
    for bad in ["[3.0, 3.0]", "[3.0, 1.5]"] {
        refused(knots(bad), "knots have to rise; write them in the order of time, each once");
    }
}

/// Rows begin at the start and end at the end, which comes once; there are at most a million steps.
#[test]
fn rows_of_a_sweep() {
    let times = |every: f64, start: f64, end: f64| SweepRows::Every(every).times(start, end);
    assert_eq!(times(0.5, 1.0, 2.0).unwrap(), [1.0, 1.5, 2.0]);
    assert_eq!(times(0.75, 1.0, 2.0).unwrap(), [1.0, 1.75, 2.0]);
    assert_eq!(times(0.1, 0.0, 0.3).unwrap().len(), 4);
    assert_eq!(SweepRows::End.times(1.0, 2.0).unwrap(), [2.0]);
    assert_eq!(times(1.0, 5.0, 999_999.0 + 5.0).unwrap().len(), 1_000_000);
    refused(
        times(1.0, 5.0, 1_000_000.0 + 5.0),
        "every = 1.0 gives more than a million rows a case; write a larger one",
    );
}

/// The vehicle of the examples, some of its text replaced.
fn vehicle(edits: &[(&str, &str)]) -> Result<VehiclesFile> {
    let mut text = include_str!("../../examples/bus/bus.toml").to_string();
    for (old, new) in edits {
        assert!(text.contains(old), "{old}");
        text = text.replace(old, new);
    }
    reads(&text, VehiclesFile::read)
}

#[test]
fn names_of_vehicles_have_at_most_sixty_characters() {
    let role = |n: usize| vehicle(&[("wheel_rate", &"w".repeat(n))]);
    assert!(role(60).is_ok());
    refused(role(61), "cannot name a parameter or an input");
    let symbol = |n: usize| vehicle(&[("theta'", &format!("{}'", "t".repeat(n - 1)))]);
    assert!(symbol(60).is_ok());
    refused(symbol(61), "is no symbol");
    for bad in ["9w", "w-x", "sin", "tractor"] {
        refused(vehicle(&[("inputs.wheel_rate", &format!("inputs.\"{bad}\""))]), "cannot name a parameter or an input");
    }
    for bad in ["9t'", "t-u'", "it"] {
        refused(vehicle(&[("theta'", bad)]), "is no symbol");
    }
}

#[test]
fn lengths_of_vehicles_have_at_most_six_factors() {
    let forward =
        |n: usize| vehicle(&[("forward = \"L\"", &format!("forward = \"L^{n}/joint_offset^{n}*joint_offset\""))]);
    refused(forward(20), "a length has a product of more than 6 factors; define a symbol for a part of it");
    let power = |n: usize| {
        vehicle(&[
            ("unit = \"m\"\nmeaning = \"the joint", "unit = \"1\"\nmeaning = \"the joint"),
            ("forward = \"L\"", &format!("forward = \"L*joint_offset^{}\"", n - 1)),
        ])
    };
    assert!(power(6).is_ok(), "{}", power(6).unwrap_err());
    refused(power(7), "a length has a product of more than 6 factors");
    refused(vehicle(&[("forward = \"L\"", "forward = 2.5")]), "forward is a number without a unit");
}

/// A file of a user's own has at most 256 KiB.
#[test]
fn files_of_a_users_own_have_a_size() {
    let padded = |n: usize| {
        let text = effect("q", PARAMETER, "v_t = \"it + q*v_l\"");
        format!("{text}#{}\n", "x".repeat(n - text.len() - 2))
    };
    bounded(&padded(256 << 10), &padded((256 << 10) + 1), "is larger than 256 KiB", EffectsFile::read);
}
