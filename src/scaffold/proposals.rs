//! Entries of `[columns]` that say more than a name: proposed from names and values of a log.

use super::column_matching::Match;
use super::column_names::{is_compass, is_count, is_place, side_words, unit_of, words};
use super::column_units::{in_degrees, of_times};
use super::samples::Sample;

/// A role with its SI unit.
pub(crate) struct Asked<'a> {
    pub role: &'a str,
    pub unit: &'a str,
}

/// What is proposed for a role.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Proposal {
    /// The role as the file names it: `position` stands for x and y.
    pub role: String,
    /// What stands behind the equals sign.
    pub value: String,
    /// A number in it that the user must put.
    pub placeholder: Option<String>,
}

/// Units of SI that are not written.
const SI: [&str; 5] = ["m", "rad", "rad/s", "m/s", "s"];
/// How well directions must agree to be called one heading.
const ALIKE: f64 = 0.8;

/// A name as a TOML string.
pub(crate) fn quoted(name: &str) -> String {
    toml::Value::String(name.into()).to_string()
}

/// Proposals for roles, by their place; `samples` is empty where no values are at hand.
pub(crate) fn proposals(
    asked: &[Asked],
    matches: &[Match],
    header: &[String],
    samples: &[Sample],
) -> Vec<Option<Proposal>> {
    let mut found: Vec<Option<Proposal>> = vec![None; asked.len()];
    let at = |role: &str| asked.iter().position(|a| a.role == role);
    if let Some(i) = at("time") {
        found[i] = time(&matches[i], header, samples);
    }
    if let (Some(x), Some(y)) = (at("x"), at("y"))
        && matches[x].column.is_none()
        && matches[y].column.is_none()
    {
        found[x] = position(header);
    }
    if let Some(i) = at("heading") {
        let near = at("x").and_then(|x| matches[x].column.clone()).unwrap_or_default();
        if matches[i].column.is_none() {
            found[i] = quaternion(header, &near);
        }
    }
    for (i, asked) in asked.iter().enumerate() {
        if found[i].is_some() || asked.role == "time" {
            continue;
        }
        found[i] = match &matches[i].column {
            Some(column) => in_unit(asked, column, header, samples),
            None if asked.unit == "rad/s" => counted(asked.role, header, samples, matches),
            None => None,
        };
    }
    compass(asked, matches, &mut found, header, samples);
    found
}

/// A pair of whole seconds and nanoseconds, or a column in a unit of its own.
fn time(named: &Match, header: &[String], samples: &[Sample]) -> Option<Proposal> {
    let proposal = |value: String| Some(Proposal { role: "time".into(), value, placeholder: None });
    let pairs = [("sec", "nanosec"), ("sec", "nsec"), ("secs", "nsecs"), ("seconds", "nanoseconds"), ("s", "ns")];
    for (second, nano) in pairs {
        let pair = header.iter().find_map(|name| {
            let stem = name.strip_suffix(second)?;
            let other = format!("{stem}{nano}");
            header.contains(&other).then(|| (name.clone(), other))
        });
        if let Some((second, nano)) = pair {
            return proposal(format!("[{}, {}]", quoted(&second), quoted(&nano)));
        }
    }
    let column = named.column.as_ref()?;
    let sample = sample(column, header, samples);
    if sample.is_some_and(Sample::holds_dates) {
        return None;
    }
    let unit = sample.and_then(of_times).or_else(|| unit_of(column).filter(|u| ["ms", "us", "ns"].contains(u)))?;
    proposal(format!("{{ column = {}, unit = \"{unit}\" }}", quoted(column)))
}

fn sample<'a>(column: &str, header: &[String], samples: &'a [Sample]) -> Option<&'a Sample> {
    samples.get(header.iter().position(|name| name == column)?)
}

/// The columns of latitude and longitude.
fn geographic(header: &[String]) -> Option<[&String; 2]> {
    let one = |wanted: &[&str]| header.iter().find(|name| words(name).iter().any(|w| wanted.contains(&w.as_str())));
    Some([one(&["latitude", "lat"])?, one(&["longitude", "lon", "lng", "long"])?])
}

/// Latitude and longitude.
fn position(header: &[String]) -> Option<Proposal> {
    let [latitude, longitude] = geographic(header)?;
    let value = format!("{{ latitude = {}, longitude = {} }}", quoted(latitude), quoted(longitude));
    Some(Proposal { role: "position".into(), value, placeholder: None })
}

/// Four columns that end in x, y, z and w: those whose name has most in common with that of the position.
fn quaternion(header: &[String], near: &str) -> Option<Proposal> {
    let common = |name: &str| name.chars().zip(near.chars()).take_while(|(a, b)| a == b).count();
    let stems = header.iter().filter_map(|name| name.strip_suffix('w')).filter(|stem| {
        !stem.is_empty() && ["x", "y", "z"].iter().all(|letter| header.contains(&format!("{stem}{letter}")))
    });
    let stem = stems.max_by_key(|stem| (common(stem), std::cmp::Reverse(stem.len())))?;
    let name = stem.strip_suffix(['.', '_', '/']).filter(|name| !name.is_empty()).unwrap_or(stem);
    Some(Proposal { role: "heading".into(), value: format!("{{ quaternion = {} }}", quoted(name)), placeholder: None })
}

/// A column in another unit than that of its role.
fn in_unit(asked: &Asked, column: &str, header: &[String], samples: &[Sample]) -> Option<Proposal> {
    let sample = sample(column, header, samples);
    let angle = asked.unit == "rad" && sample.is_some_and(in_degrees);
    let unit = unit_of(column).or(angle.then_some("deg"))?;
    let fits = match asked.unit {
        "m" => ["mm", "cm", "km", "ft"].contains(&unit),
        "rad" => ["deg", "turns"].contains(&unit),
        "rad/s" => ["deg/s", "rpm", "turns/s", "deg"].contains(&unit),
        "m/s" => ["km/h", "mph"].contains(&unit),
        _ => false,
    };
    if !fits || SI.contains(&unit) {
        return None;
    }
    let unit = if asked.unit == "rad/s" && unit == "deg" { "deg/s" } else { unit };
    let value = format!("{{ column = {}, unit = \"{unit}\" }}", quoted(column));
    Some(Proposal { role: asked.role.into(), value, placeholder: None })
}

/// A wheel's cumulative counts or positions.
fn counted(role: &str, header: &[String], samples: &[Sample], matches: &[Match]) -> Option<Proposal> {
    let sides = side_words(role)?;
    let free = |name: &&String| !matches.iter().any(|m| m.column.as_ref() == Some(*name));
    let fits = |name: &&String, holds: &dyn Fn(&[String]) -> bool| {
        let words = words(name);
        holds(&words) && words.iter().any(|w| sides.contains(&w.as_str()))
    };
    let is_counter = |name: &&String| {
        let counts = sample(name, header, samples).is_some_and(Sample::is_count);
        fits(name, &|words| is_count(words) || counts)
    };
    if let Some(name) = header.iter().filter(free).find(is_counter) {
        let whole = sample(name, header, samples).is_none_or(|s| s.numbers.is_empty() || s.is_whole());
        if whole {
            let value = format!("{{ ticks = {}, ticks_per_turn = 1000 }}", quoted(name));
            let placeholder = Some("ticks_per_turn".to_string());
            return Some(Proposal { role: role.into(), value, placeholder });
        }
    }
    let name = header.iter().filter(free).find(|name| fits(name, &|words| is_place(words)))?;
    let unit = match unit_of(name) {
        Some(unit @ ("deg" | "turns")) => format!(", unit = \"{unit}\""),
        _ => String::new(),
    };
    Some(Proposal { role: role.into(), value: format!("{{ angle = {}{unit} }}", quoted(name)), placeholder: None })
}

/// A heading from north, or clockwise: by the direction in which the vehicle moves, or by its name where it stands.
fn compass(asked: &[Asked], matches: &[Match], found: &mut [Option<Proposal>], header: &[String], samples: &[Sample]) {
    let at = |role: &str| asked.iter().position(|a| a.role == role);
    let Some((i, column)) = at("heading").and_then(|i| Some((i, matches[i].column.as_ref()?))) else { return };
    let values = |column: &str| sample(column, header, samples).map(|s| s.numbers.clone()).unwrap_or_default();
    let degrees = found[i].as_ref().is_some_and(|p| p.value.contains("\"deg\""));
    let factor = if degrees { 1f64.to_radians() } else { 1.0 };
    let heading: Vec<f64> = values(column).iter().map(|h| h * factor).collect();
    let places = places(asked, matches, found, header).map(|[x, y]| [values(&x), values(&y)]);
    let told = places.and_then(|[x, y]| by_path(&x, &y, &heading));
    let [north, clockwise] = told.unwrap_or([is_compass(column); 2]);
    if !north && !clockwise {
        return;
    }
    let unit = if degrees { ", unit = \"deg\"" } else { "" };
    let zero = if north { ", zero = \"north\"" } else { "" };
    let turn = if clockwise { ", turn = \"clockwise\"" } else { "" };
    let value = format!("{{ column = {}{unit}{zero}{turn} }}", quoted(column));
    found[i] = Some(Proposal { role: "heading".into(), value, placeholder: None });
}

/// The columns along x and y, east and north.
fn places(asked: &[Asked], matches: &[Match], found: &[Option<Proposal>], header: &[String]) -> Option<[String; 2]> {
    let at = |role: &str| asked.iter().position(|a| a.role == role);
    let (x, y) = (at("x")?, at("y")?);
    if found[x].as_ref().is_some_and(|p| p.role == "position") {
        let [latitude, longitude] = geographic(header)?;
        return Some([longitude.clone(), latitude.clone()]);
    }
    Some([matches[x].column.clone()?, matches[y].column.clone()?])
}

/// Whether headings count from north and clockwise, by the direction of the path; none where the path does not tell.
///
/// Degrees of longitude are shorter than those of latitude, which turns no direction by more than some tens of degrees: the
/// quarters are told all the same.
fn by_path(x: &[f64], y: &[f64], heading: &[f64]) -> Option<[bool; 2]> {
    if x.len() != y.len() || x.len() != heading.len() || x.len() < 20 {
        return None;
    }
    // Steps that are long beside the scatter of the places.
    let stride = (x.len() / 40).max(2);
    let steps = (0..x.len() - stride).map(|i| (x[i + stride] - x[i], y[i + stride] - y[i], heading[i + stride / 2]));
    let steps: Vec<(f64, f64, f64)> = steps.collect();
    let longest = steps.iter().map(|(a, b, _)| a.hypot(*b)).fold(0.0, f64::max);
    let moving = steps.iter().filter(|(a, b, _)| a.hypot(*b) > 0.3 * longest);
    let mean = |sign: f64| {
        let (mut c, mut s, mut n) = (0.0, 0.0, 0.0);
        for (a, b, h) in moving.clone() {
            let d = b.atan2(*a) - sign * h;
            (c, s, n) = (c + d.cos(), s + d.sin(), n + 1.0);
        }
        (s.hypot(c) / n, s.atan2(c))
    };
    let ((left, at_left), (right, at_right)) = (mean(1.0), mean(-1.0));
    let (clockwise, alike, at) = if right > left { (true, right, at_right) } else { (false, left, at_left) };
    let quarter = (at / std::f64::consts::FRAC_PI_2).round() as i32;
    if alike < ALIKE || (left - right).abs() < 0.2 || quarter.abs() > 1 || quarter < 0 {
        return None;
    }
    Some([quarter == 1, clockwise])
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_2;

    #[test]
    fn the_path_tells_where_headings_count_from() {
        let turn: Vec<f64> = (0..200).map(|i| 0.03 * f64::from(i)).collect();
        let (x, y): (Vec<f64>, Vec<f64>) = turn.iter().map(|a| (a.sin(), 1.0 - a.cos())).unzip();
        let told = |f: &dyn Fn(f64) -> f64| by_path(&x, &y, &turn.iter().map(|a| f(*a)).collect::<Vec<_>>());
        assert_eq!(told(&|a| a), Some([false, false]));
        assert_eq!(told(&|a| FRAC_PI_2 - a), Some([true, true]));
        assert_eq!(told(&|a| -a), Some([false, true]));
        assert_eq!(told(&|a| a - FRAC_PI_2), Some([true, false]));
        assert_eq!(told(&|a| 7.0 * a), None, "no heading of this path");
    }

    #[test]
    fn a_quaternion_is_chosen_beside_the_position() {
        let header: Vec<String> = ["imu.q", "pose.orientation."]
            .iter()
            .flat_map(|stem| ["x", "y", "z", "w"].map(|l| format!("{stem}{l}")))
            .collect();
        let value = |near: &str| quaternion(&header, near).unwrap().value;
        assert_eq!(value("pose.position.x"), "{ quaternion = \"pose.orientation\" }");
        assert_eq!(value("imu.x"), "{ quaternion = \"imu.q\" }");
        assert_eq!(quaternion(&header[..3], ""), None);
    }
}
