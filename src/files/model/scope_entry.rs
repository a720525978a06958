//! `scope` and `course` of an effect: when and where it holds, and a parameter that moves with time.

use super::known::KnownEffect;
use crate::effects::{DrivingRegime, Scope};
use crate::error::Result;
use crate::files::toml::spanned_table::{Section, Value};
use crate::formula::Expr;

/// How a scope may be written.
const SCOPE_EXAMPLE: &str = "scope = { from = 35.3 }, { from = 35.3, until = 50.1 }, { intervals = [[35.3, 50.1]] }, \
    { regime = \"reverse\" }, { above = { speed = 1.2 } }, { disk = [x, y, radius] } or { where = \"FORMULA > 0\" }";

/// A parameter that moves with time, as a model file says it.
#[derive(Clone, Debug, PartialEq)]
pub struct CourseEntry {
    /// The parameter.
    pub parameter: String,
    /// How it moves.
    pub motion: Motion,
}

/// How a parameter moves with time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Motion {
    /// At a constant rate.
    Linear {
        /// How fast, its unit a second.
        per_s: f64,
        /// The time at which it has its value, s.
        since: f64,
    },
    /// At random.
    RandomWalk {
        /// The deviation of its steps over a second.
        per_sqrt_s: f64,
    },
}

/// Reads the scope of an entry.
pub(super) fn read_scope(section: &Section) -> Result<Option<Scope>> {
    let Some(value) = section.get("scope") else { return Ok(None) };
    let table = value.section_like("scope".into(), SCOPE_EXAMPLE)?;
    let kinds = ["from", "until", "intervals", "regime", "above", "disk", "where"];
    table.only(&kinds)?;
    let given: Vec<&str> = kinds.into_iter().filter(|k| table.get(k).is_some()).collect();
    let time = |key: &str, open: f64| table.get(key).map_or(Ok(open), |v| v.number());
    let scope = match &given[..] {
        ["from"] | ["until"] | ["from", "until"] => {
            let ends = [time("from", f64::NEG_INFINITY)?, time("until", f64::INFINITY)?];
            ordered(&value, ends)?;
            Scope::Times(vec![ends])
        }
        ["intervals"] => Scope::Times(intervals(&table.need("intervals", SCOPE_EXAMPLE)?)?),
        ["regime"] => Scope::Regime(regime(&table.need("regime", SCOPE_EXAMPLE)?)?),
        ["above"] => {
            let above = table.need("above", SCOPE_EXAMPLE)?.section_like("above".into(), SCOPE_EXAMPLE)?;
            above.only(&["speed"])?;
            Scope::Above(above.need("speed", SCOPE_EXAMPLE)?.positive()?)
        }
        ["disk"] => {
            let disk = table.need("disk", SCOPE_EXAMPLE)?;
            let [x, y, radius] = &numbers(&disk)?[..] else {
                return Err(disk.error("disk must be a list of x, y and radius").help("write disk = [x, y, radius]"));
            };
            if *radius <= 0.0 {
                return Err(disk.error(format!("the radius {radius:?} is out of range")).help("it must be above zero"));
            }
            Scope::Disk([*x, *y, *radius])
        }
        ["where"] => Scope::Where(positive(&table.need("where", SCOPE_EXAMPLE)?)?),
        [] => return Err(value.error("the scope is empty").help(format!("write {SCOPE_EXAMPLE}"))),
        _ => {
            let message = format!("the scope says {} at once", given.join(" and "));
            return Err(value.error(message).help(format!("write one of them: {SCOPE_EXAMPLE}")));
        }
    };
    Ok(Some(scope))
}

/// Reads the course of an entry.
pub(super) fn read_course(section: &Section, effect: &KnownEffect) -> Result<Option<CourseEntry>> {
    let Some(value) = section.get("course") else { return Ok(None) };
    let example = "course = { kind = \"linear\", per_s = 0.0004 }";
    let table = value.section_like("course".into(), example)?;
    let kind = table.need("kind", example)?;
    let walks = match kind.text()? {
        "linear" => false,
        "random-walk" => true,
        other => {
            let help = "write kind = \"linear\": a parameter that moves at a constant rate, or kind = \"random-walk\"";
            return Err(kind.error(format!("a course {other:?} is not known")).help(help));
        }
    };
    table.only(if walks { &["kind", "parameter", "per_sqrt_s"] } else { &["kind", "parameter", "per_s", "since"] })?;
    let names: Vec<&str> = effect.parameters.iter().map(|p| p.name.as_str()).collect();
    let parameter = match (table.get("parameter"), &names[..]) {
        (Some(value), names) => {
            let name = value.text()?;
            if !names.contains(&name) {
                let help = format!("write one of {}", names.join(", "));
                return Err(value.error(format!("{} has no parameter {name:?}", effect.id)).help(help));
            }
            name.to_string()
        }
        (None, [only]) => (*only).to_string(),
        (None, names) => {
            let help = format!("write parameter = one of {}", names.join(", "));
            return Err(value.error("the course does not say which parameter moves").help(help));
        }
    };
    let motion = if walks {
        let example = "course = { kind = \"random-walk\", per_sqrt_s = 0.0001 }";
        Motion::RandomWalk { per_sqrt_s: table.need("per_sqrt_s", example)?.positive()? }
    } else {
        let per_s = table.need("per_s", example)?.number()?;
        Motion::Linear { per_s, since: table.get("since").map_or(Ok(0.0), |v| v.number())? }
    };
    Ok(Some(CourseEntry { parameter, motion }))
}

fn ordered(value: &Value, [from, until]: [f64; 2]) -> Result<()> {
    if from < until {
        return Ok(());
    }
    let help = "an interval ends after it begins, in seconds of the log's own clock";
    Err(value.error(format!("the scope ends at {until:?} before it begins at {from:?}")).help(help))
}

fn intervals(list: &Value) -> Result<Vec<[f64; 2]>> {
    let example = "intervals = [[35.3, 50.1], [63.0, 68.5]]";
    let mut found: Vec<[f64; 2]> = vec![];
    for element in list.list(example)? {
        let times: Vec<f64> =
            element.list("[1.0, 2.0]")?.iter().map(Value::number_or_infinity).collect::<Result<_>>()?;
        let [from, until] = times[..] else {
            return Err(element.error("an interval must be a list of two times").help(format!("write {example}")));
        };
        ordered(&element, [from, until])?;
        if found.last().is_some_and(|[_, end]| from < *end) {
            let help = "intervals follow one another and do not overlap";
            return Err(element
                .error(format!("the interval from {from:?} begins before the one before it ends"))
                .help(help));
        }
        found.push([from, until]);
    }
    match found.is_empty() {
        true => Err(list.error("there is no interval").help(format!("write {example}"))),
        false => Ok(found),
    }
}

fn numbers(list: &Value) -> Result<Vec<f64>> {
    list.list("[1.0, 2.0]")?.iter().map(Value::number).collect()
}

fn regime(value: &Value) -> Result<DrivingRegime> {
    let name = value.text()?;
    DrivingRegime::named(name).ok_or_else(|| {
        let all: Vec<&str> = DrivingRegime::all().map(DrivingRegime::name).collect();
        value.error(format!("no regime is called {name:?}")).help(format!("write one of {}", all.join(", ")))
    })
}

/// The formula of `FORMULA > 0`.
fn positive(value: &Value) -> Result<Expr> {
    let text = value.text()?;
    let formula = text.rsplit_once('>').filter(|(_, zero)| zero.trim() == "0").map(|(formula, _)| formula);
    let Some(formula) = formula else {
        return Err(value.error("a scope by a formula ends in > 0").help("write where = \"x - 3 > 0\""));
    };
    Expr::parse(formula).map_err(|e| value.error(format!("{e}")).help("write where = \"x - 3 > 0\""))
}

#[cfg(test)]
mod tests {
    use crate::effects;
    use crate::files::ModelFile;
    use crate::model;

    fn read(line: &str) -> crate::error::Result<ModelFile> {
        let head = "vehicle = \"unicycle\"\n[parameters]\nwheel_radius = 0.5\n[[effects]]\n";
        let text = format!("{head}id = \"yaw-rate-bias\"\nbias = 0.01\n{line}\n");
        ModelFile::parse(&text, "model.toml", &model::known(effects::all()))
    }

    #[test]
    fn scopes_and_courses_are_read_and_written_back() {
        for line in [
            "scope = { from = 35.3 }",
            "scope = { until = 35.3 }",
            "scope = { from = 35.3, until = 50.1 }",
            "scope = { intervals = [[1.0, 2.0], [3.0, 4.5]] }",
            "scope = { intervals = [[-inf, 2.0], [3.0, inf]] }",
            "scope = { regime = \"reverse\" }",
            "scope = { above = { speed = 1.2 } }",
            "scope = { disk = [6.27, -8.98, 2.68] }",
            "scope = { where = \"x - 3 > 0\" }",
            "course = { kind = \"linear\", parameter = \"bias\", per_s = 0.0004 }",
            "course = { kind = \"linear\", parameter = \"bias\", per_s = 0.0004, since = 12.0 }",
            "course = { kind = \"random-walk\", parameter = \"bias\", per_sqrt_s = 0.0004 }",
        ] {
            let file = read(line).unwrap();
            let entry = &file.effects[0];
            let plain = read("").unwrap();
            let written = plain.patched(std::slice::from_ref(entry));
            assert!(written.trim_end().ends_with(&format!("bias = 0.01\n{line}")), "{written}");
        }
    }

    #[test]
    fn a_malformed_scope_has_one_message_with_its_place() {
        let told = |line: &str| read(line).unwrap_err().to_string();
        for (line, expected) in [
            ("scope = { from = 3.0, until = 2.0 }", "ends at 2.0 before it begins at 3.0"),
            ("scope = { intervals = [[1.0, 3.0], [2.0, 4.0]] }", "begins before the one before it ends"),
            ("scope = { intervals = [[1.0, inf], [2.0, 4.0]] }", "begins before the one before it ends"),
            ("scope = { intervals = [[nan, 1.0]] }", "finite"),
            ("scope = { regime = \"sideways\" }", "no regime is called"),
            ("scope = { disk = [1.0, 2.0] }", "x, y and radius"),
            ("scope = { where = \"x - 3\" }", "ends in > 0"),
            ("scope = { from = 1.0, regime = \"left\" }", "from and regime at once"),
            ("scope = {}", "empty"),
            ("course = { kind = \"cubic\", per_s = 1.0 }", "not known"),
            ("course = { kind = \"linear\", per_s = 1.0, parameter = \"scale\" }", "no parameter"),
            ("course = { kind = \"random-walk\", per_s = 1.0 }", "per_s"),
            ("course = { kind = \"random-walk\", per_sqrt_s = -1.0 }", "-1.0"),
        ] {
            let told = told(line);
            assert!(told.starts_with("model.toml:7:") && told.contains(expected), "{line}: {told}");
        }
    }
}
