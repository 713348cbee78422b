//! The path of a simulation as a file: CSV, or Parquet by its extension.

use crate::files::{Part, PartWriter};
use std::io;
#[cfg(feature = "parquet")]
use std::io::Write;
use std::path::Path;
use trueaxis_input::Diagnostics;
#[cfg(not(feature = "parquet"))]
use trueaxis_input::Place;
use trueaxis_machine::Machine;
#[cfg(feature = "parquet")]
use trueaxis_motion::ParquetTable;
use trueaxis_motion::{BodyTable, CsvTable, Observer};

fn is_parquet(path: &Path) -> bool {
    path.extension().is_some_and(|e| e.eq_ignore_ascii_case("parquet"))
}

/// Whether this program was built to write such a file.
pub(super) fn check(path: &Path, problems: &mut Diagnostics) {
    #[cfg(not(feature = "parquet"))]
    if is_parquet(path) {
        problems.error(
            "parquet-not-built",
            Place::whole(&path.display().to_string()),
            "this program was built without Parquet".to_owned(),
            "build it with `cargo build --release -p trueaxis-cli --features parquet`, or name a \
             .csv file",
        );
    }
    #[cfg(feature = "parquet")]
    let _ = (path, problems);
}

/// The table of bodies in a file.
pub(super) fn bodies_table(part: &Part) -> BodyTable<PartWriter<'_>> {
    BodyTable::new(part.writer())
}

/// A table that is being written.
pub(super) enum PathTable<'f> {
    Csv(Box<CsvTable<PartWriter<'f>>>),
    #[cfg(feature = "parquet")]
    Parquet(Box<ParquetTable<PartWriter<'f>>>),
}

impl<'f> PathTable<'f> {
    /// Begins the table of a machine in a file that will stand at a path.
    pub(super) fn begin(machine: &Machine, path: &Path, part: &'f Part) -> Self {
        #[cfg(feature = "parquet")]
        if is_parquet(path) {
            return Self::Parquet(Box::new(ParquetTable::new(machine, part.writer())));
        }
        let _ = path;
        Self::Csv(Box::new(CsvTable::new(machine, part.writer())))
    }

    /// The observer of the simulation.
    pub(super) fn observer(&mut self) -> &mut dyn Observer {
        match self {
            Self::Csv(table) => &mut **table,
            #[cfg(feature = "parquet")]
            Self::Parquet(table) => &mut **table,
        }
    }

    /// Writes what is still buffered.
    pub(super) fn finish(self) -> io::Result<()> {
        match self {
            Self::Csv(table) => table.finish().map(drop),
            #[cfg(feature = "parquet")]
            Self::Parquet(table) => table.finish().and_then(|mut out| out.flush()),
        }
    }
}
