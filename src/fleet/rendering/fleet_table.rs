//! A fleet as a table: a row for every value of every run, as CSV and as Apache Parquet.

use crate::files::quoted;
use crate::fleet::column::is_target;
use crate::fleet::join::Joined;
use std::fmt::Write;

/// The columns before the tags, and whether they hold numbers.
const COLUMNS: [(&str, bool); 12] = [
    ("robot", false),
    ("run", false),
    ("date", false),
    ("effect", false),
    ("parameter", false),
    ("unit", false),
    ("value", true),
    ("std", true),
    ("robot_value", true),
    ("robot_std", true),
    ("z", true),
    ("odd", false),
];

/// A cell.
enum Cell {
    Text(String),
    Number(Option<f64>),
}

fn text(words: &str) -> Cell {
    Cell::Text(words.into())
}

fn number(v: Option<f64>) -> Cell {
    Cell::Number(v.filter(|v| v.is_finite()))
}

/// Names of the columns, and whether each holds numbers.
fn columns(joined: &Joined) -> Vec<(String, bool)> {
    let tags = joined.mapped.manifest.tags();
    let own = COLUMNS.iter().map(|(name, numbers)| (name.to_string(), *numbers));
    own.chain(tags.iter().map(|t| (t.to_string(), false))).collect()
}

fn rows(joined: &Joined) -> Vec<Vec<Cell>> {
    let tags = joined.mapped.manifest.tags();
    let mut rows = vec![];
    for ((discovered, fitted), report) in joined.fitted.iter().zip(&joined.report.per_robot) {
        for (log, run) in discovered.robot.logs.iter().zip(&fitted.runs) {
            for target in &fitted.targets {
                let effect = run.calibration.effects.iter().find(|e| is_target(e, target));
                for (name, p) in effect.iter().flat_map(|e| &e.parameters) {
                    let of_robot = report.values.get(&format!("{target} {name}"));
                    let date = log.date.as_deref().unwrap_or("");
                    let words = [&discovered.robot.robot, &run.run, date, target, name, &p.unit].map(text);
                    let beside = [of_robot.map(|v| v.value), of_robot.map(|v| v.std), of_robot.and_then(|v| v.z)];
                    let numbers = [Some(p.value), p.std].into_iter().chain(beside).map(number);
                    let odd = text(&of_robot.map_or(String::new(), |v| v.is_odd.to_string()));
                    let tags = tags.iter().map(|t| text(log.tags.get(*t).map_or("", String::as_str)));
                    rows.push(words.into_iter().chain(numbers).chain([odd]).chain(tags).collect());
                }
            }
        }
    }
    rows
}

/// The table as CSV; a number that is not there is an empty cell.
pub fn fleet_table(joined: &Joined) -> String {
    let mut out = columns(joined).iter().map(|(name, _)| quoted(name)).collect::<Vec<_>>().join(",") + "\n";
    for row in rows(joined) {
        let cell = |c: &Cell| match c {
            Cell::Text(words) => quoted(words),
            Cell::Number(v) => v.map_or(String::new(), |v| format!("{v:?}")),
        };
        let _ = writeln!(out, "{}", row.iter().map(cell).collect::<Vec<_>>().join(","));
    }
    out
}

/// The table as Apache Parquet.
///
/// # Errors
/// When it cannot be written.
#[cfg(feature = "parquet")]
pub fn fleet_parquet(joined: &Joined) -> crate::Result<Vec<u8>> {
    let failed = |e: ::parquet::errors::ParquetError| crate::Error::run(format!("no Parquet: {e}"));
    parquet_bytes(&columns(joined), &rows(joined)).map_err(failed)
}

#[cfg(feature = "parquet")]
fn parquet_bytes(
    columns: &[(String, bool)],
    rows: &[Vec<Cell>],
) -> std::result::Result<Vec<u8>, ::parquet::errors::ParquetError> {
    use ::parquet::basic::{LogicalType, Repetition, Type as Physical};
    use ::parquet::data_type::{ByteArray, ByteArrayType, DoubleType};
    use ::parquet::file::properties::WriterProperties;
    use ::parquet::file::writer::SerializedFileWriter;
    use ::parquet::schema::types::Type;
    use std::sync::Arc;
    let field = |(name, numbers): &(String, bool)| match numbers {
        true => Type::primitive_type_builder(name, Physical::DOUBLE).with_repetition(Repetition::OPTIONAL).build(),
        false => Type::primitive_type_builder(name, Physical::BYTE_ARRAY)
            .with_repetition(Repetition::REQUIRED)
            .with_logical_type(Some(LogicalType::String))
            .build(),
    };
    let fields = columns.iter().map(|c| field(c).map(Arc::new)).collect::<std::result::Result<_, _>>()?;
    let schema = Arc::new(Type::group_type_builder("fleet").with_fields(fields).build()?);
    let properties = Arc::new(WriterProperties::builder().set_created_by("creepage".into()).build());
    let mut bytes = vec![];
    let mut writer = SerializedFileWriter::new(&mut bytes, schema, properties)?;
    let mut group = writer.next_row_group()?;
    let mut at = 0;
    while let Some(mut column) = group.next_column()? {
        let cells = || rows.iter().map(|row| &row[at]);
        let numbers: Vec<Option<f64>> =
            cells().filter_map(|c| if let Cell::Number(v) = c { Some(*v) } else { None }).collect();
        if columns[at].1 {
            let there: Vec<i16> = numbers.iter().map(|v| i16::from(v.is_some())).collect();
            let values: Vec<f64> = numbers.into_iter().flatten().collect();
            column.typed::<DoubleType>().write_batch(&values, Some(&there), None)?;
        } else {
            let words = cells().filter_map(|c| if let Cell::Text(t) = c { Some(t.as_str().into()) } else { None });
            column.typed::<ByteArrayType>().write_batch(&words.collect::<Vec<ByteArray>>(), None, None)?;
        }
        column.close()?;
        at += 1;
    }
    group.close()?;
    writer.close()?;
    Ok(bytes)
}
