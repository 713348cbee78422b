//! The path of a simulation as a file: CSV, or Parquet by its extension.

use crate::report_file::{Written, may_write};
use std::fs::File;
use std::io::{self, BufWriter};
use std::path::Path;
use trueaxis::files::Part;
use trueaxis::input::Diagnostics;
#[cfg(not(feature = "parquet"))]
use trueaxis::input::Place;
use trueaxis::machine::Machine;
#[cfg(feature = "parquet")]
use trueaxis::simulate::ParquetTable;
use trueaxis::simulate::{CsvTable, Observer};

const CSV: Written =
    Written::file("--path", "the table of a path", &[b"time_s,program,line,tool,"]);
/// The table of bodies.
pub const BODIES: Written =
    Written::file("--bodies", "the table of bodies", &[b"time_s,program,line,body,"]);
const PARQUET: Written = Written::file("--path", "a Parquet file", &[b"par1"]);

fn is_parquet(path: &Path) -> bool {
    path.extension().is_some_and(|e| e.eq_ignore_ascii_case("parquet"))
}

/// Whether the path can be written there by this program; before the work, not after it.
pub fn may_write_path(path: &Path, problems: &mut Diagnostics) {
    if !is_parquet(path) {
        return may_write(path, &CSV, problems);
    }
    may_write(path, &PARQUET, problems);
    #[cfg(not(feature = "parquet"))]
    problems.error(
        "parquet-not-built",
        Place::whole(&path.display().to_string()),
        "this program was built without Parquet".to_owned(),
        "build it with `cargo build --release -p trueaxis-cli --features parquet`, or name a .csv \
         file",
    );
}

/// A table that is being written.
pub enum PathTable<'f> {
    Csv(Box<CsvTable<BufWriter<&'f File>>>),
    #[cfg(feature = "parquet")]
    Parquet(Box<ParquetTable<&'f File>>),
}

impl<'f> PathTable<'f> {
    /// Begins the table of a machine in a file that will stand at a path.
    pub fn begin(machine: &Machine, path: &Path, part: &'f Part) -> Self {
        #[cfg(feature = "parquet")]
        if is_parquet(path) {
            return Self::Parquet(Box::new(ParquetTable::new(machine, part.file())));
        }
        let _ = path;
        let out = BufWriter::with_capacity(1 << 16, part.file());
        Self::Csv(Box::new(CsvTable::new(machine, out)))
    }

    /// The observer of the simulation.
    pub fn observer(&mut self) -> &mut dyn Observer {
        match self {
            Self::Csv(table) => &mut **table,
            #[cfg(feature = "parquet")]
            Self::Parquet(table) => &mut **table,
        }
    }

    /// Writes what is still buffered.
    pub fn finish(self) -> io::Result<()> {
        match self {
            Self::Csv(table) => table.finish().map(drop),
            #[cfg(feature = "parquet")]
            Self::Parquet(table) => table.finish().map(drop),
        }
    }
}
