//! The path as a Parquet file: the columns of [`CsvTable`](super::CsvTable), row group by row
//! group, so that memory does not grow with the program.

use super::table::{Row, WHOLE};
use super::{Batch, Observer, headings};
use parquet::basic::{Compression, ConvertedType, Encoding, Repetition, Type as Physical};
use parquet::data_type::{DoubleType, Int32Type};
use parquet::errors::{ParquetError, Result};
use parquet::file::metadata::KeyValue;
use parquet::file::properties::{EnabledStatistics, WriterProperties};
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::{ColumnPath, Type};
use std::io::{self, Write};
use std::sync::Arc;
use trueaxis_machine::Machine;

/// Rows of a row group: 12 MB in memory for a machine with five axes.
const ROWS: usize = 1 << 16;

/// Writes each node as a row: time, block, axes, nominal tool, deviation.
///
/// Lengths and angles are DOUBLE, bit for bit the numbers of the CSV table; program, line, tool and
/// rapid (1 or 0) are unsigned INT32. No value is ever missing.
pub struct ParquetTable<W: Write + Send> {
    machine: Machine,
    out: Option<SerializedFileWriter<W>>,
    whole: [Vec<i32>; WHOLE.len()],
    numbers: Vec<Vec<f64>>,
    rows: usize,
    failed: Option<ParquetError>,
}

impl<W: Write + Send> ParquetTable<W> {
    /// Begins the file.
    pub fn new(machine: &Machine, out: W) -> Self {
        let names = headings(machine);
        let writer = begin(machine, &names, out);
        let mut table = Self {
            machine: machine.clone(),
            out: None,
            whole: Default::default(),
            numbers: vec![Vec::new(); names.len() - WHOLE.len()],
            rows: 0,
            failed: None,
        };
        match writer {
            Ok(writer) => table.out = Some(writer),
            Err(error) => table.failed = Some(error),
        }
        table
    }

    /// Writes what is still in the buffer, and the foot of the file.
    ///
    /// # Errors
    /// The first error of the disk.
    pub fn finish(mut self) -> io::Result<W> {
        let written = match self.failed.take() {
            Some(error) => Err(error),
            None => self.write_group(),
        };
        let foot = written.and_then(|()| match self.out.take() {
            Some(out) => out.into_inner(),
            None => Err(ParquetError::General("the file was not started".to_owned())),
        });
        foot.map_err(io::Error::other)
    }

    fn write_group(&mut self) -> Result<()> {
        let (Some(out), true) = (&mut self.out, self.rows > 0) else { return Ok(()) };
        let mut group = out.next_row_group()?;
        let (mut whole, mut numbers) = (self.whole.iter(), self.numbers.iter());
        for column in 0..WHOLE.len() + self.numbers.len() {
            let Some(mut writer) = group.next_column()? else { break };
            if is_whole(column) {
                let values = whole.next().map_or(&[][..], Vec::as_slice);
                writer.typed::<Int32Type>().write_batch(values, None, None)?;
            } else {
                let values = numbers.next().map_or(&[][..], Vec::as_slice);
                writer.typed::<DoubleType>().write_batch(values, None, None)?;
            }
            writer.close()?;
        }
        group.close()?;
        self.whole.iter_mut().for_each(Vec::clear);
        self.numbers.iter_mut().for_each(Vec::clear);
        self.rows = 0;
        Ok(())
    }
}

/// Whether a column, counted as in [`headings`], is one of [`WHOLE`].
fn is_whole(column: usize) -> bool {
    (1..=WHOLE.len()).contains(&column)
}

fn begin<W: Write + Send>(
    machine: &Machine,
    names: &[String],
    out: W,
) -> Result<SerializedFileWriter<W>> {
    let mut fields = Vec::new();
    // Doubles compress best with their bytes side by side; dictionaries do not help them.
    let mut properties = WriterProperties::builder()
        .set_compression(Compression::SNAPPY)
        .set_statistics_enabled(EnabledStatistics::Chunk)
        .set_max_row_group_row_count(None)
        .set_created_by(format!("trueaxis {}", trueaxis_report::VERSION))
        .set_key_value_metadata(Some(vec![
            KeyValue::new("schema".to_owned(), "trueaxis/path/1".to_owned()),
            KeyValue::new("machine".to_owned(), machine.name().to_owned()),
            KeyValue::new("chain".to_owned(), machine.chain_text()),
        ]));
    for (column, name) in names.iter().enumerate() {
        let field = if is_whole(column) {
            let field = Type::primitive_type_builder(name, Physical::INT32);
            field.with_converted_type(ConvertedType::UINT_32)
        } else {
            let path = ColumnPath::from(name.as_str());
            properties = properties
                .set_column_dictionary_enabled(path.clone(), false)
                .set_column_encoding(path, Encoding::BYTE_STREAM_SPLIT);
            Type::primitive_type_builder(name, Physical::DOUBLE)
        };
        fields.push(Arc::new(field.with_repetition(Repetition::REQUIRED).build()?));
    }
    let schema = Type::group_type_builder("path").with_fields(fields).build()?;
    SerializedFileWriter::new(out, Arc::new(schema), Arc::new(properties.build()))
}

impl<W: Write + Send> Observer for ParquetTable<W> {
    fn path(&mut self, batch: &Batch<'_>) {
        if self.failed.is_some() {
            return;
        }
        for i in 0..batch.nodes.len() {
            let row = Row::of(&self.machine, batch, i);
            for (column, value) in self.whole.iter_mut().zip(row.whole) {
                // The bits of an unsigned number; the schema states that it has no sign.
                column.push(value.cast_signed());
            }
            for (column, value) in self.numbers.iter_mut().zip(row.numbers()) {
                column.push(*value);
            }
            self.rows += 1;
            if self.rows == ROWS
                && let Err(error) = self.write_group()
            {
                self.failed = Some(error);
                return;
            }
        }
    }
}
