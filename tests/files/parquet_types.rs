//! Columns of a Parquet file of every type that holds plain numbers, and of those that do not.

#![cfg(feature = "parquet")]

use creepage::files::{ModelFile, Run};
use creepage::{Result, effects, model};
use parquet::column::writer::ColumnWriter;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::parser::parse_message_type;
use std::sync::Arc;

use crate::two_names::read_under_two_names;

/// A log whose time and abscissa have types of their own; the ordinate and the rest are doubles.
fn read(time: (&str, Cells), x: (&str, Cells)) -> Result<Run> {
    let schema = format!(
        "message log {{ {} ; {} ; REQUIRED DOUBLE y; REQUIRED DOUBLE phi; REQUIRED DOUBLE theta_dot; \
         REQUIRED DOUBLE phi_dot; }}",
        time.0, x.0
    );
    let schema = Arc::new(parse_message_type(&schema).unwrap());
    let mut bytes = Vec::new();
    let mut writer = SerializedFileWriter::new(&mut bytes, schema, Arc::default()).unwrap();
    let mut group = writer.next_row_group().unwrap();
    let others = [4.0, 5.0, 6.0, 7.0].map(|v| Cells::Double(vec![v, v + 0.5]));
    for cells in [time.1, x.1].into_iter().chain(others) {
        let mut column = group.next_column().unwrap().unwrap();
        match (column.untyped(), cells) {
            (ColumnWriter::Int32ColumnWriter(w), Cells::Int(v)) => {
                let v: Vec<i32> = v.into_iter().map(|v| v as i32).collect();
                w.write_batch(&v, Some(&[1, 1]), Some(&[0, 0])).unwrap();
            }
            (ColumnWriter::Int64ColumnWriter(w), Cells::Int(v)) => {
                w.write_batch(&v, None, None).unwrap();
            }
            (ColumnWriter::FloatColumnWriter(w), Cells::Float(v)) => {
                w.write_batch(&v, None, None).unwrap();
            }
            (ColumnWriter::DoubleColumnWriter(w), Cells::Double(v)) => {
                w.write_batch(&v, None, None).unwrap();
            }
            _ => panic!("cells of another type"),
        }
        column.close().unwrap();
    }
    group.close().unwrap();
    writer.close().unwrap();
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/runs/cornering/model.toml");
    let model = ModelFile::read(file, &model::known(effects::all())).unwrap();
    read_under_two_names("run.Parquet", &bytes, &model)
}

enum Cells {
    Int(Vec<i64>),
    Float(Vec<f32>),
    Double(Vec<f64>),
}

use Cells::{Double, Float, Int};

const TIME: (&str, [f64; 2]) = ("REQUIRED DOUBLE t", [0.0, 1.0]);

#[test]
fn numbers_of_every_width_are_read() {
    let time = || (TIME.0, Double(TIME.1.to_vec()));
    for (kind, cells, wanted) in [
        ("REQUIRED DOUBLE x", Double(vec![0.1, -2.5]), [0.1, -2.5]),
        ("REQUIRED FLOAT x", Float(vec![0.25, -2.5]), [0.25, -2.5]),
        ("REQUIRED INT32 x", Int(vec![7, -9]), [7.0, -9.0]),
        ("REQUIRED INT64 x", Int(vec![1 << 40, -9]), [2f64.powi(40), -9.0]),
        ("REQUIRED INT32 x (INTEGER(32,false))", Int(vec![7, 3_000_000_000]), [7.0, 3e9]),
        ("REQUIRED INT32 x (UINT_32)", Int(vec![7, 3_000_000_000]), [7.0, 3e9]),
        ("REQUIRED INT32 x (INTEGER(32,true))", Int(vec![7, -9]), [7.0, -9.0]),
        ("REQUIRED INT64 x (INTEGER(64,false))", Int(vec![7, i64::MIN]), [7.0, 2f64.powi(63)]),
        ("OPTIONAL INT32 x (INTEGER(16,true))", Int(vec![7, -9]), [7.0, -9.0]),
    ] {
        let run = read(time(), (kind, cells)).unwrap_or_else(|e| panic!("{kind}: {e}"));
        assert_eq!((run.time.as_slice(), run.x.as_slice()), (&TIME.1[..], &wanted[..]), "{kind}");
        assert_eq!(run.y, [4.0, 4.5], "{kind}");
    }
}

/// A count of a fraction of a second is told in seconds, by the present way to say so and by the older one.
#[test]
fn time_stamps_of_every_unit_are_seconds() {
    for (kind, unit) in [
        ("TIMESTAMP(MILLIS,true)", 1_000),
        ("TIMESTAMP(MICROS,false)", 1_000_000),
        ("TIMESTAMP(NANOS,true)", 1_000_000_000),
        ("TIMESTAMP_MILLIS", 1_000),
        ("TIMESTAMP_MICROS", 1_000_000),
    ] {
        let time = (format!("REQUIRED INT64 t ({kind})"), Int(vec![3 * unit / 2, 4 * unit]));
        let run = read((&time.0, time.1), ("REQUIRED DOUBLE x", Double(vec![0.0; 2]))).unwrap();
        assert_eq!(run.time, [1.5, 4.0], "{kind}");
    }
}

/// What would be read as another number is refused by name.
#[test]
fn decimals_and_lists_are_refused() {
    for kind in ["REQUIRED INT32 x (DECIMAL(9,2))", "REQUIRED INT64 x (DECIMAL(9,2))", "REPEATED INT32 x"] {
        let error = read((TIME.0, Double(TIME.1.to_vec())), (kind, Int(vec![7, -9]))).unwrap_err();
        assert_eq!(error.exit_code(), 2);
        assert!(error.to_string().contains("column \"x\" holds no plain numbers but INT"), "{kind}: {error}");
    }
}
