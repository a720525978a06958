//! Logs in Apache Parquet files: flat columns of numbers.

use super::csv_table::Numbers;
use super::place::{Form, Place};
use super::time_stamp::{Origin, of_number};
use super::usable_rows::{hash, usable};
use crate::error::{Error, Result};
use crate::files::toml::suggestions::{reason, shown};
use crate::files::toml::text::open;
use parquet::basic::{ConvertedType, LogicalType, TimeUnit, Type};
use parquet::column::reader::{ColumnReader, ColumnReaderImpl};
use parquet::data_type::DataType;
use parquet::errors::ParquetError;
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::schema::types::ColumnDescriptor;
use std::fs::File;
use std::path::{Path, PathBuf};

/// Rows read at a time.
const BATCH: usize = 8192;

/// An open Parquet file.
pub(crate) struct ParquetLog {
    pub path: PathBuf,
    pub header: Vec<String>,
    reader: SerializedFileReader<File>,
    /// What times are counted from, where they are whole numbers.
    pub origin: Origin,
}

impl ParquetLog {
    /// Opens a file and reads its schema.
    pub fn open(path: &Path) -> Result<Self> {
        let reader = SerializedFileReader::new(open(path)?).map_err(|e| unreadable(path, &e))?;
        let columns = reader.metadata().file_metadata().schema_descr().columns();
        let header = columns.iter().map(|c| c.path().string()).collect();
        Ok(Self { path: path.to_path_buf(), header, reader, origin: Origin::default() })
    }

    /// Reads all rows; `wanted` are places in the header.
    pub fn numbers_and(mut self, wanted: &[Place], more: &[Place]) -> Result<Numbers> {
        let columns = wanted.iter().chain(more).map(|place| self.column(*place)).collect::<Result<Vec<Vec<f64>>>>()?;
        if columns.windows(2).any(|pair| pair[0].len() != pair[1].len()) {
            return Err(broken(&self.path, "its columns have different lengths"));
        }
        let names: Vec<&str> = wanted.iter().map(|c| self.header[c.index].as_str()).collect();
        Ok(usable(columns, &names, hash(&self.path)?, self.origin))
    }

    fn column(&mut self, place: Place) -> Result<Vec<f64>> {
        let c = place.index;
        let metadata = self.reader.metadata();
        let described = metadata.file_metadata().schema_descr().column(c);
        let mut scale = self.scale(&described)?;
        // A time stamp knows its own unit.
        let digits = match (place.form, described.physical_type(), scale) {
            (Form::Stamp(_), Type::INT64, 1e-3) => Some(3),
            (Form::Stamp(_), Type::INT64, 1e-6) => Some(6),
            (Form::Stamp(_), Type::INT64, 1e-9) => Some(9),
            (Form::Stamp(digits), Type::INT64, _) => Some(digits),
            _ => None,
        };
        if digits.is_some() {
            scale = 1.0;
        }
        let unsigned = is_unsigned(&described);
        let failed = |e: ParquetError| unreadable(&self.path, &e);
        let mut origin = self.origin;
        let mut values = Vec::new();
        for group in 0..self.reader.num_row_groups() {
            let rows = self.reader.get_row_group(group).map_err(failed)?;
            match rows.get_column_reader(c).map_err(failed)? {
                ColumnReader::DoubleColumnReader(mut r) => {
                    all(&mut r, &described, &mut values, |x| x).map_err(failed)?
                }
                ColumnReader::FloatColumnReader(mut r) => {
                    all(&mut r, &described, &mut values, f64::from).map_err(failed)?
                }
                ColumnReader::Int32ColumnReader(mut r) => {
                    let number = |x: i32| if unsigned { f64::from(x.cast_unsigned()) } else { f64::from(x) };
                    all(&mut r, &described, &mut values, number).map_err(failed)?;
                }
                ColumnReader::Int64ColumnReader(mut r) if digits.is_some() => {
                    let unit = 10i128.pow(9 - digits.unwrap_or(9));
                    let number = |x: i64| origin.seconds(i128::from(x) * unit);
                    all(&mut r, &described, &mut values, number).map_err(failed)?;
                }
                ColumnReader::Int64ColumnReader(mut r) => {
                    let number = |x: i64| if unsigned { x.cast_unsigned() as f64 } else { x as f64 };
                    all(&mut r, &described, &mut values, number).map_err(failed)?;
                }
                _ => return Err(self.word(&described)),
            }
        }
        values.iter_mut().for_each(|v| *v *= scale);
        if let (Form::Stamp(digits), false) = (place.form, digits.is_some()) {
            let seconds = |v: f64| of_number(v, digits).map_or(f64::NAN, |ns| origin.seconds(ns));
            values = values.into_iter().map(seconds).collect();
        }
        self.origin = origin;
        Ok(values)
    }

    /// What a unit of the column is in SI units: time stamps are counts of a fraction of a second.
    fn scale(&self, column: &ColumnDescriptor) -> Result<f64> {
        if column.max_rep_level() > 0 {
            return Err(self.word(column));
        }
        Ok(match (column.physical_type(), column.logical_type_ref(), column.converted_type()) {
            (Type::INT64, Some(LogicalType::Timestamp(t)), _) => match t.unit {
                TimeUnit::MILLIS => 1e-3,
                TimeUnit::MICROS => 1e-6,
                TimeUnit::NANOS => 1e-9,
            },
            (Type::INT64, _, ConvertedType::TIMESTAMP_MILLIS) => 1e-3,
            (Type::INT64, _, ConvertedType::TIMESTAMP_MICROS) => 1e-6,
            (_, Some(LogicalType::Decimal(_)), _) | (_, _, ConvertedType::DECIMAL) => return Err(self.word(column)),
            (Type::DOUBLE | Type::FLOAT | Type::INT32 | Type::INT64, _, _) => 1.0,
            _ => return Err(self.word(column)),
        })
    }

    fn word(&self, column: &ColumnDescriptor) -> Error {
        let name = column.path().string();
        Error::input(format!("column \"{}\" holds no plain numbers but {}", shown(&name), column.physical_type()))
            .at_file(&self.path)
            .help("write it as a flat column of floating-point or whole numbers")
    }
}

/// Whether the bits of a whole number are one without a sign: a counter that runs over 2³¹ is no negative number.
fn is_unsigned(column: &ColumnDescriptor) -> bool {
    match column.logical_type_ref() {
        Some(LogicalType::Integer(int)) => !int.is_signed,
        _ => matches!(column.converted_type(), ConvertedType::UINT_32 | ConvertedType::UINT_64),
    }
}

/// Appends the values of a column in one group of rows; NaN where there is none.
fn all<T: DataType>(
    reader: &mut ColumnReaderImpl<T>,
    column: &ColumnDescriptor,
    to: &mut Vec<f64>,
    mut number: impl FnMut(T::T) -> f64,
) -> std::result::Result<(), ParquetError>
where
    T::T: Copy,
{
    let most = column.max_def_level();
    let (mut levels, mut values) = (Vec::new(), Vec::new());
    loop {
        levels.clear();
        values.clear();
        let given = (most > 0).then_some(&mut levels);
        let (records, _, _) = reader.read_records(BATCH, given, None, &mut values)?;
        if records == 0 {
            return Ok(());
        }
        let mut present = values.iter().map(|v| number(*v));
        match most {
            0 => to.extend(present),
            _ => {
                to.extend(levels.iter().map(|l| if *l == most { present.next().unwrap_or(f64::NAN) } else { f64::NAN }))
            }
        }
    }
}

fn unreadable(path: &Path, e: &ParquetError) -> Error {
    broken(path, &e.to_string())
}

fn broken(path: &Path, why: &str) -> Error {
    Error::input(format!("cannot be read as Parquet: {}", reason(why)))
        .at_file(path)
        .help("write the file again; it may be cut off")
}
