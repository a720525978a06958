//! Writes a log as Parquet, a column of doubles for each of its columns.
//!
//! ```text
//! cargo run --release --features parquet --example to_parquet -- RUN.csv RUN.parquet
//! creepage discover RUN.parquet --model MODEL.toml --out report
//! ```

use parquet::data_type::DoubleType;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::Type;
use std::error::Error;
use std::sync::Arc;

#[allow(dead_code)]
fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [from, to] = &arguments[..] else { return Err("give RUN.csv and RUN.parquet".into()) };
    let mut reader = csv::Reader::from_path(from)?;
    let names: Vec<String> = reader.headers()?.iter().map(|n| n.trim().to_string()).collect();
    let mut columns = vec![vec![]; names.len()];
    for row in reader.records() {
        let row = row?;
        columns.iter_mut().zip(row.iter()).for_each(|(c, cell)| c.push(cell.trim().parse().ok()));
    }
    std::fs::write(to, parquet(&names, &columns)?)?;
    Ok(())
}

/// The bytes of a Parquet file; a cell without a number is null.
pub fn parquet(names: &[String], columns: &[Vec<Option<f64>>]) -> Result<Vec<u8>, Box<dyn Error>> {
    let column = |name: &String| Type::primitive_type_builder(name, parquet::basic::Type::DOUBLE).build().map(Arc::new);
    let fields = names.iter().map(column).collect::<Result<Vec<_>, _>>()?;
    let schema = Arc::new(Type::group_type_builder("log").with_fields(fields).build()?);
    let mut bytes = Vec::new();
    let mut writer = SerializedFileWriter::new(&mut bytes, schema, Arc::new(WriterProperties::default()))?;
    let mut group = writer.next_row_group()?;
    for cells in columns {
        let Some(mut to) = group.next_column()? else { return Err("fewer columns than names".into()) };
        let levels: Vec<i16> = cells.iter().map(|c| i16::from(c.is_some())).collect();
        let values: Vec<f64> = cells.iter().flatten().copied().collect();
        to.typed::<DoubleType>().write_batch(&values, Some(&levels), None)?;
        to.close()?;
    }
    group.close()?;
    writer.close()?;
    Ok(bytes)
}
