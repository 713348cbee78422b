//! A path as Parquet is, bit for bit, the path as CSV.
#![cfg(feature = "parquet")]

use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::Field;
use std::path::Path;
use trueaxis::files;
use trueaxis::files::disk;
use trueaxis::input::Diagnostics;
use trueaxis::simulate::{
    CsvTable, Options, ParquetTable, SetUp, headings, read_program, simulate,
};

#[test]
fn parquet_holds_the_numbers_of_csv() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let (machine, _) = files::machine(&root.join("machines/i5-engraver/machine.toml"));
    let machine = machine.expect("a shipped machine");
    let mut problems = Diagnostics::new();
    // More nodes than one row group holds: 900 rounds of about a hundred pieces.
    let text = "G21 G17 G90 G94\nG1 X50 Y0 Z10 F1500\n".to_owned()
        + &"G3 X50 Y0 I-50 J0\nG0 Z12\nG1 Z10 F700\n".repeat(900)
        + "M30\n";
    let folder = std::env::temp_dir().join(format!("trueaxis-parquet-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let file = folder.join("rounds.nc");
    std::fs::write(&file, text).expect("a program");
    let setup = SetUp::default();
    let program = read_program(&disk(), &file, None, &setup, &mut problems).expect("a program");
    let target = std::fs::File::create(folder.join("rounds.parquet")).expect("a file");

    let (mut csv, mut columns) =
        (CsvTable::new(&machine, Vec::new()), ParquetTable::new(&machine, &target));
    let options = Options::default();
    let run = simulate(&machine, &program, &setup, &options, &mut [&mut csv, &mut columns]);
    assert!(!run.problems.has_errors(), "{:?}", run.problems);
    let text = String::from_utf8(csv.finish().expect("a table")).expect("UTF-8");
    columns.finish().expect("a table");
    let written = std::fs::File::open(folder.join("rounds.parquet")).expect("a file");
    std::fs::remove_dir_all(&folder).expect("no folder");

    let reader = SerializedFileReader::new(written).expect("a Parquet file");
    let schema = reader.metadata().file_metadata().schema_descr().columns().to_vec();
    let names: Vec<_> = schema.iter().map(|c| c.name().to_owned()).collect();
    assert_eq!(names, headings(&machine));
    let mut lines = text.lines();
    assert_eq!(lines.next(), Some(names.join(",").as_str()));
    assert!(reader.num_row_groups() >= 2, "{} rows", reader.metadata().file_metadata().num_rows());
    let mut rows = 0;
    for (row, line) in reader.get_row_iter(None).expect("rows").zip(lines.by_ref()) {
        let row = row.expect("a row");
        for ((name, field), word) in row.get_column_iter().zip(line.split(',')) {
            match field {
                Field::Double(value) => {
                    let csv: f64 = word.parse().expect("a number");
                    assert_eq!(value.to_bits(), csv.to_bits(), "{name} in row {rows}: {word}");
                }
                Field::UInt(value) => assert_eq!(value.to_string(), word, "{name} in row {rows}"),
                other => panic!("{name}: {other:?}"),
            }
        }
        rows += 1;
    }
    assert_eq!((rows, lines.count()), (reader.metadata().file_metadata().num_rows(), 0));
}

/// Columns of doubles as a Parquet file.
fn write_log(path: &Path, columns: &[(&str, &[f64])]) {
    use parquet::basic::{Repetition, Type as Physical};
    use parquet::data_type::DoubleType;
    use parquet::file::writer::SerializedFileWriter;
    use parquet::schema::types::Type;
    use std::sync::Arc;
    let field = |name: &str| {
        let field = Type::primitive_type_builder(name, Physical::DOUBLE);
        Arc::new(field.with_repetition(Repetition::REQUIRED).build().expect("a field"))
    };
    let fields = columns.iter().map(|(name, _)| field(name)).collect();
    let schema = Type::group_type_builder("log").with_fields(fields).build().expect("a schema");
    let file = std::fs::File::create(path).expect("a file");
    let mut out = SerializedFileWriter::new(file, Arc::new(schema), Default::default())
        .expect("a Parquet file");
    let mut group = out.next_row_group().expect("a group");
    for (_, values) in columns {
        let mut column = group.next_column().expect("a column").expect("one more");
        column.typed::<DoubleType>().write_batch(values, None, None).expect("written");
        column.close().expect("closed");
    }
    group.close().expect("closed");
    out.close().expect("closed");
}

#[test]
fn a_log_as_parquet_is_the_log_as_csv() {
    let folder = std::env::temp_dir().join(format!("trueaxis-log-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let path = folder.join("hall.parquet");
    let read = || {
        let mut problems = Diagnostics::new();
        let log = trueaxis::simulate::read_temperature_log(&disk(), &path, &mut problems);
        (log, problems.iter().map(|d| d.code).collect::<Vec<_>>())
    };
    let (times, celsius) = ([0.0, 1.0, 2.5], [20.0, 20.25, 21.5]);
    write_log(&path, &[("time_min", &times), ("scale_x_degC", &celsius)]);
    let (log, codes) = read();
    let log = log.expect("a log");
    assert_eq!((log.times_s(), codes), (&[0.0, 60.0, 150.0][..], vec![]));
    assert_eq!(log.celsius("scale_x"), Some(&celsius[..]));
    write_log(&path, &[("time_min", &times), ("scale_x_degC", &[20.0, f64::NAN, 21.0])]);
    assert_eq!(read().1, ["not-a-number"]);
    // No bytes of a broken file do more than be refused.
    write_log(&path, &[("time_min", &times), ("scale_x_degC", &celsius)]);
    let sound = std::fs::read(&path).expect("bytes");
    for at in 0..sound.len() {
        for byte in [0, 0xff, sound[at] ^ 0x10] {
            let mut broken = sound.clone();
            broken[at] = byte;
            std::fs::write(&path, &broken).expect("written");
            let (log, codes) = read();
            assert!(log.is_some() || !codes.is_empty());
        }
        std::fs::write(&path, &sound[..at]).expect("written");
        assert!(read().0.is_none());
    }
    std::fs::remove_dir_all(folder).expect("no folder");
}
