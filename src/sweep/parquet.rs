//! The table of a sweep as Apache Parquet, by the crate `parquet` without its Arrow half.

use super::table::STATUS;
use crate::error::{Error, Result};
use crate::files::{unwritable, write_whole_with};
use ::parquet::basic::{LogicalType, Repetition, Type as Physical};
use ::parquet::data_type::{ByteArray, ByteArrayType, DoubleType, Int64Type};
use ::parquet::errors::ParquetError;
use ::parquet::file::properties::WriterProperties;
use ::parquet::file::reader::{FileReader, SerializedFileReader};
use ::parquet::file::writer::SerializedFileWriter;
use ::parquet::record::Field;
use ::parquet::schema::types::Type;
use std::fs::File;
use std::io::{BufReader, Read};
use std::path::Path;
use std::sync::Arc;

/// Rows of a row group; the same for every way a table comes about, so that its bytes are.
const GROUP_ROWS: usize = 1 << 16;

/// Writes the rows of a journal as a table.
pub(super) fn write(journal: &mut File, out: &Path, columns: &[String]) -> Result<()> {
    write_whole_with(out, |file| copy(journal, file, out, columns))
}

fn copy(journal: &mut File, file: &File, out: &Path, columns: &[String]) -> Result<()> {
    let mut writer = Writer::new(file, out, columns)?;
    let mut from = BufReader::with_capacity(1 << 20, journal);
    let (mut bytes, mut row) = (vec![0; 8 * columns.len()], vec![0.0; columns.len()]);
    loop {
        match from.read_exact(&mut bytes) {
            Err(e) if e.kind() == std::io::ErrorKind::UnexpectedEof => break,
            Err(e) => return Err(unwritable(out, &e)),
            Ok(()) => {}
        }
        for (value, bytes) in row.iter_mut().zip(bytes.chunks_exact(8)) {
            *value = f64::from_le_bytes(bytes.try_into().unwrap_or_default());
        }
        writer.push(&row)?;
    }
    writer.finish()
}

/// A table being written: the number of the case, numbers that may be missing, the status.
pub(super) struct Writer<'f> {
    writer: SerializedFileWriter<&'f File>,
    columns: Vec<Vec<f64>>,
    out: std::path::PathBuf,
}

impl<'f> Writer<'f> {
    pub fn new(file: &'f File, out: &Path, columns: &[String]) -> Result<Self> {
        let schema = schema(columns).map_err(|e| failed(out, &e))?;
        let properties = Arc::new(WriterProperties::builder().set_created_by("creepage".into()).build());
        let writer = SerializedFileWriter::new(file, Arc::new(schema), properties).map_err(|e| failed(out, &e))?;
        Ok(Self { writer, columns: vec![vec![]; columns.len()], out: out.into() })
    }

    pub fn push(&mut self, row: &[f64]) -> Result<()> {
        self.columns.iter_mut().zip(row).for_each(|(column, value)| column.push(*value));
        if self.columns[0].len() == GROUP_ROWS { self.group() } else { Ok(()) }
    }

    pub fn finish(mut self) -> Result<()> {
        self.group()?;
        self.writer.close().map(drop).map_err(|e| failed(&self.out, &e))
    }

    fn group(&mut self) -> Result<()> {
        if self.columns[0].is_empty() {
            return Ok(());
        }
        self.write_group().map_err(|e| failed(&self.out, &e))?;
        self.columns.iter_mut().for_each(Vec::clear);
        Ok(())
    }

    fn write_group(&mut self) -> std::result::Result<(), ParquetError> {
        let mut group = self.writer.next_row_group()?;
        let (mut index, last) = (0, self.columns.len() - 1);
        while let Some(mut column) = group.next_column()? {
            let values = &self.columns[index];
            if index == 0 {
                let cases: Vec<i64> = values.iter().map(|v| *v as i64).collect();
                column.typed::<Int64Type>().write_batch(&cases, None, None)?;
            } else if index == last {
                let words: Vec<ByteArray> = values.iter().map(|v| STATUS[*v as usize].into()).collect();
                column.typed::<ByteArrayType>().write_batch(&words, None, None)?;
            } else {
                let there: Vec<i16> = values.iter().map(|v| i16::from(v.is_finite())).collect();
                let values: Vec<f64> = values.iter().copied().filter(|v| v.is_finite()).collect();
                column.typed::<DoubleType>().write_batch(&values, Some(&there), None)?;
            }
            column.close()?;
            index += 1;
        }
        group.close().map(drop)
    }
}

fn schema(columns: &[String]) -> std::result::Result<Type, ParquetError> {
    let last = columns.len() - 1;
    let field = |(i, name): (usize, &String)| {
        let built = match i {
            0 => Type::primitive_type_builder(name, Physical::INT64).with_repetition(Repetition::REQUIRED).build(),
            i if i == last => Type::primitive_type_builder(name, Physical::BYTE_ARRAY)
                .with_repetition(Repetition::REQUIRED)
                .with_logical_type(Some(LogicalType::String))
                .build(),
            _ => Type::primitive_type_builder(name, Physical::DOUBLE).with_repetition(Repetition::OPTIONAL).build(),
        };
        built.map(Arc::new)
    };
    let fields = columns.iter().enumerate().map(field).collect::<std::result::Result<_, _>>()?;
    Type::group_type_builder("sweep").with_fields(fields).build()
}

/// Reads the rows of a table with these columns.
pub(super) fn read(path: &Path, columns: &[String], take: &mut dyn FnMut(&[f64]) -> Result<()>) -> Result<()> {
    let file = crate::files::open(path)?;
    let wrong = |e: ParquetError| Error::input(format!("is no Parquet table: {e}")).at_file(path);
    let reader = SerializedFileReader::new(file).map_err(wrong)?;
    let names: Vec<String> =
        reader.metadata().file_metadata().schema_descr().columns().iter().map(|c| c.name().to_string()).collect();
    if names != columns {
        return Err(Error::input("is a table of another sweep").at_file(path).help("join parts of one sweep"));
    }
    for row in reader.get_row_iter(None).map_err(wrong)? {
        let row = row.map_err(wrong)?;
        let number = |field: &Field| match field {
            Field::Long(n) => *n as f64,
            Field::Double(v) => *v,
            Field::Str(word) => STATUS.iter().position(|s| s == word).map_or(f64::NAN, |i| i as f64),
            _ => f64::NAN,
        };
        let values: Vec<f64> = row.get_column_iter().map(|(_, field)| number(field)).collect();
        take(&values)?;
    }
    Ok(())
}

fn failed(out: &Path, why: &ParquetError) -> Error {
    Error::run(format!("cannot be written: {why}")).at_file(out)
}
