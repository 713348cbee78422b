//! The document `trueaxis/identify-tables/1`: error tables from readings.

use crate::verify::error_tables::{ErrorTable, ReferenceLine, Removed, Squareness, TableStudy};
use serde::Serialize;
use trueaxis_machine::describe::to_shown;
use trueaxis_machine::errors::ErrorName;
use trueaxis_report::JsonSchema;

/// What was found.
#[derive(Debug)]
pub struct TablesFound {
    /// The readings.
    pub study: TableStudy,
    /// The tables of error motions.
    pub tables: Vec<ErrorTable>,
    /// The squarenesses.
    pub squarenesses: Vec<Squareness>,
    /// How far the new machine file would be read otherwise, by error. Unit: mm or rad.
    pub read_back: Vec<(ErrorName, f64)>,
}

/// Error tables of a machine.
#[derive(Debug, Serialize, JsonSchema)]
pub struct TablesFoundDocument<'a> {
    /// Which document this is.
    #[schemars(extend("const" = "trueaxis/identify-tables/1"))]
    pub schema: &'static str,
    /// The name of the study.
    pub name: &'a str,
    /// The tables of error motions, axis by axis.
    pub tables: Vec<FoundTable>,
    /// The squarenesses from circles.
    pub squarenesses: Vec<FoundSquareness<'a>>,
}

/// The table of one error motion; of the body, as in the machine file.
#[derive(Debug, Serialize, JsonSchema)]
pub struct FoundTable {
    /// The error by its name of ISO 230-1.
    pub error: String,
    /// `um` or `urad`: the unit of its values.
    pub unit: &'static str,
    /// How many runs in each direction.
    pub runs: usize,
    /// Standard deviation of a single reading, µm or µrad; null where each target was read once. Unit: that of `unit`.
    pub scatter: Option<f64>,
    /// What the set-up of the instrument hides, and was subtracted.
    pub removed: &'static str,
    /// What the angles of the axis did to the readings over the arm of the optics.
    pub arms: Vec<ArmEntry>,
    /// Largest − least of the mean of both directions, µm or µrad. Unit: that of `unit`.
    pub range: f64,
    /// How far the instrument would read otherwise on the new machine, µm or µrad. Unit: that of `unit`.
    pub read_back: f64,
    /// Its rows.
    pub rows: Vec<FoundRow>,
}

/// What an angle did over the arm.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ArmEntry {
    /// The angular error.
    pub error: String,
    /// At most, µm.
    pub most_um: f64,
}

/// A row of a table.
#[derive(Debug, Serialize, JsonSchema)]
pub struct FoundRow {
    /// The position. Unit: mm or deg.
    pub position: f64,
    /// Reached upwards, µm or µrad. Unit: that of `unit`.
    pub up: f64,
    /// Reached downwards, µm or µrad; equal to `up` where one direction was read. Unit: that of `unit`.
    pub down: f64,
    /// Standard uncertainty, µm or µrad. Unit: that of `unit`.
    pub u: f64,
}

/// A squareness.
#[derive(Debug, Serialize, JsonSchema)]
pub struct FoundSquareness<'a> {
    /// The location error that states it.
    pub error: String,
    /// Its value, µrad.
    pub value_urad: f64,
    /// Its standard uncertainty, µrad.
    pub u_urad: f64,
    /// The two axes.
    pub axes: &'a [String; 2],
    /// The angle by which the axes are closer than 90°, as read, µrad.
    pub read_urad: f64,
    /// The same on the machine with its new tables and its old location error, µrad.
    pub before_urad: f64,
    /// The first axis longer than the second over the diameter, read − tables, µm.
    pub scale_difference_um: f64,
}

/// Words for what was subtracted.
pub(super) fn removed_words(removed: Removed) -> &'static str {
    match removed {
        Removed::Zero => "zero",
        Removed::Line(ReferenceLine::LeastSquares) => "least-squares line",
        Removed::Line(ReferenceLine::Ends) => "line through the ends",
        Removed::Line(ReferenceLine::None) => "zero",
        Removed::Eccentricity => "mean and eccentricity",
        Removed::Mean => "mean",
    }
}

/// From mm or rad to µm or µrad, and the unit.
pub(super) fn scale_of(name: ErrorName) -> (f64, &'static str) {
    match name.component.is_rotation() {
        true => (1e6, "urad"),
        false => (1e3, "um"),
    }
}

impl<'a> TablesFoundDocument<'a> {
    /// The document of what was found.
    pub fn of(found: &'a TablesFound) -> Self {
        Self {
            schema: "trueaxis/identify-tables/1",
            name: &found.study.name,
            tables: found.tables.iter().map(|t| found_table(found, t)).collect(),
            squarenesses: found.squarenesses.iter().map(found_squareness).collect(),
        }
    }
}

fn found_table(found: &TablesFound, table: &ErrorTable) -> FoundTable {
    let (scale, unit) = scale_of(table.name);
    let row = |i: usize| FoundRow {
        position: to_shown(&found.study.machine, table.axis, table.positions[i]),
        up: table.up[i] * scale,
        down: table.down[i] * scale,
        u: table.u[i] * scale,
    };
    let arm = |(name, most_mm): &(ErrorName, f64)| ArmEntry {
        error: name.to_string(),
        most_um: most_mm * 1e3,
    };
    let read_back = found.read_back.iter().find(|(name, _)| *name == table.name);
    FoundTable {
        error: table.name.to_string(),
        unit,
        runs: table.runs,
        scatter: table.scatter.map(|s| s * scale),
        removed: removed_words(table.removed),
        arms: table.arms.iter().map(arm).collect(),
        range: table.range() * scale,
        read_back: read_back.map_or(0.0, |(_, worst)| worst * scale),
        rows: (0..table.positions.len()).map(row).collect(),
    }
}

fn found_squareness(found: &Squareness) -> FoundSquareness<'_> {
    FoundSquareness {
        error: found.name.to_string(),
        value_urad: found.value_rad * 1e6,
        u_urad: found.u_rad * 1e6,
        axes: &found.axes,
        read_urad: found.read_rad * 1e6,
        before_urad: found.before_rad * 1e6,
        scale_difference_um: found.scale_difference_mm * 1e3,
    }
}
