//! A log of temperatures as a Parquet file: the columns of the CSV table, by the same names.

use trueaxis_input::{CsvTable, Diagnostics, Place};

/// The table of a Parquet file; what is wrong with it goes to `problems`.
#[cfg(not(feature = "parquet"))]
pub fn table(file: &str, _: Vec<u8>, problems: &mut Diagnostics) -> Option<CsvTable> {
    problems.error(
        "parquet-not-built",
        Place::whole(file),
        "this program was built without Parquet".to_owned(),
        "build it with `cargo build --release -p trueaxis-cli --features parquet`, or give the log \
         as CSV",
    );
    None
}

/// The table of a Parquet file; what is wrong with it goes to `problems`.
#[cfg(feature = "parquet")]
pub fn table(file: &str, bytes: Vec<u8>, problems: &mut Diagnostics) -> Option<CsvTable> {
    let columns = match read(bytes) {
        Ok(columns) => columns,
        Err(message) => {
            let message = format!("cannot be read as Parquet: {message}");
            let hint = "columns of numbers: time_s, then one per sensor, such as scale_x_degC";
            problems.error("bad-parquet", Place::whole(file), message, hint);
            return None;
        }
    };
    let mut found = Diagnostics::new();
    let table = CsvTable::from_columns(file, columns, &mut found);
    let sound = !found.has_errors();
    problems.append(found);
    sound.then_some(table)
}

/// No log has more rows: one a second for four months.
#[cfg(feature = "parquet")]
const MOST_ROWS: i64 = 10_000_000;

#[cfg(feature = "parquet")]
fn read(bytes: Vec<u8>) -> Result<Vec<(String, Vec<f64>)>, String> {
    use parquet::file::reader::{FileReader, SerializedFileReader};
    use parquet::record::Field;
    let reader = SerializedFileReader::new(bytes::Bytes::from(bytes)).map_err(|e| e.to_string())?;
    let metadata = reader.metadata().file_metadata();
    if !(0..=MOST_ROWS).contains(&metadata.num_rows()) {
        return Err(format!("{} rows, at most {MOST_ROWS} are read", metadata.num_rows()));
    }
    let fields = metadata.schema().get_fields();
    if let Some(group) = fields.iter().find(|f| !f.is_primitive()) {
        return Err(format!("column `{}` is not a column of numbers", group.name()));
    }
    let mut columns: Vec<(String, Vec<f64>)> =
        fields.iter().map(|f| (f.name().to_owned(), Vec::new())).collect();
    for row in reader.get_row_iter(None).map_err(|e| e.to_string())? {
        let row = row.map_err(|e| e.to_string())?;
        for ((name, values), (_, field)) in columns.iter_mut().zip(row.get_column_iter()) {
            values.push(match field {
                Field::Double(value) => *value,
                Field::Float(value) => f64::from(*value),
                Field::Int(value) => f64::from(*value),
                Field::UInt(value) => f64::from(*value),
                Field::Long(value) => *value as f64,
                Field::ULong(value) => *value as f64,
                // Reported with its row when the table is made.
                Field::Null => f64::NAN,
                _ => return Err(format!("column `{name}` is not a column of numbers")),
            });
        }
    }
    Ok(columns)
}
