//! The document `trueaxis/identify/1` of the expansion of a scale.

use serde::Serialize;
use trueaxis_report::JsonSchema;
use trueaxis_thermal::expansion::{Expansion, GeometricTable, Runs};

/// A scale: its runs, and what was found from them.
#[derive(Debug)]
pub struct ScaleFound {
    /// The runs.
    pub runs: Runs,
    /// Its coefficient.
    pub found: Expansion,
    /// Its errors at one temperature.
    pub table: GeometricTable,
}

/// The coefficient of expansion and the error table of a scale.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ExpansionDocument<'a> {
    /// Which document this is.
    #[schemars(extend("const" = "trueaxis/identify/1"))]
    pub schema: &'static str,
    /// The name of the study.
    pub name: &'a str,
    /// The letter of its axis, where it is stated.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub axis: Option<&'a str>,
    /// The coefficient of expansion by least squares over all runs, µm/(m·K).
    pub expansion_um_per_m_k: f64,
    /// Its standard uncertainty, µm/(m·K).
    pub u_um_per_m_k: f64,
    /// The coefficient from the slopes of the coldest and the warmest run alone, µm/(m·K).
    pub slope_difference_um_per_m_k: f64,
    /// Standard deviation of the residual error, µm.
    pub residual_um: f64,
    /// Materials of scales that the coefficient allows within ± 2 u.
    pub materials: &'a [&'static str],
    /// The runs.
    pub runs: Vec<RunEntry<'a>>,
    /// The temperature of the scale at which the error table holds, °C.
    pub table_temperature_celsius: f64,
    /// The error table: actual − nominal, as the laser reads it.
    pub table: Vec<TableRow>,
    /// The cubic spline through the table (not-a-knot), piece by piece.
    pub spline: Vec<PieceRow>,
    /// What the reader should know.
    pub warnings: &'a [String],
}

/// A run of the laser.
#[derive(Debug, Serialize, JsonSchema)]
pub struct RunEntry<'a> {
    /// Its name.
    pub name: &'a str,
    /// The temperature of the scale, °C.
    pub temperature_celsius: f64,
    /// The slope of its straight line, µm/m.
    pub slope_um_per_m: f64,
}

/// A row of the error table.
#[derive(Debug, Serialize, JsonSchema)]
pub struct TableRow {
    /// The position, mm.
    pub position_mm: f64,
    /// The positioning error, µm.
    pub error_um: f64,
    /// Its standard uncertainty, µm.
    pub u_um: f64,
}

/// A piece of the spline: with h = position − from, e = ((a·h + b)·h + c)·h + d, µm.
#[derive(Debug, Serialize, JsonSchema)]
pub struct PieceRow {
    /// Where it begins, mm.
    pub from_mm: f64,
    /// Where it ends, mm.
    pub to_mm: f64,
    /// a, µm/mm³.
    pub a_um_per_mm3: f64,
    /// b, µm/mm².
    pub b_um_per_mm2: f64,
    /// c, µm/mm.
    pub c_um_per_mm: f64,
    /// d, µm.
    pub d_um: f64,
}

/// Several scales.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ExpansionsDocument<'a> {
    /// Which document this is.
    #[schemars(extend("const" = "trueaxis/identify-expansions/1"))]
    pub schema: &'static str,
    /// Each of them.
    pub scales: Vec<ExpansionDocument<'a>>,
}

impl<'a> ExpansionDocument<'a> {
    /// The document of a scale.
    pub fn of(scale: &'a ScaleFound) -> Self {
        let ScaleFound { runs, found, table } = scale;
        let entries = runs.runs.iter().zip(&found.slopes).map(|(run, slope)| RunEntry {
            name: &run.name,
            temperature_celsius: run.celsius.value,
            slope_um_per_m: slope * 1e6,
        });
        Self {
            schema: "trueaxis/identify/1",
            name: &runs.name,
            axis: runs.scale.axis.as_deref(),
            expansion_um_per_m_k: found.per_k * 1e6,
            u_um_per_m_k: found.u_per_k * 1e6,
            slope_difference_um_per_m_k: found.slope_difference_per_k * 1e6,
            residual_um: found.residual_mm * 1e3,
            materials: &found.materials,
            runs: entries.collect(),
            table_temperature_celsius: table.reference_celsius,
            table: table_rows(table),
            spline: piece_rows(table),
            warnings: &found.warnings,
        }
    }
}

impl<'a> ExpansionsDocument<'a> {
    /// The document of several scales.
    pub fn of(scales: &'a [ScaleFound]) -> Self {
        let scales = scales.iter().map(ExpansionDocument::of).collect();
        Self { schema: "trueaxis/identify-expansions/1", scales }
    }
}

fn table_rows(table: &GeometricTable) -> Vec<TableRow> {
    let rows = table.positions_mm.iter().zip(&table.errors_mm).zip(&table.u_mm);
    let row = |((p, e), u): ((&f64, &f64), &f64)| TableRow {
        position_mm: *p,
        error_um: e * 1e3,
        u_um: u * 1e3,
    };
    rows.map(row).collect()
}

fn piece_rows(table: &GeometricTable) -> Vec<PieceRow> {
    let pieces = table.pieces().into_iter().map(|p| PieceRow {
        from_mm: p.from_mm,
        to_mm: p.to_mm,
        a_um_per_mm3: p.a_um_per_mm3,
        b_um_per_mm2: p.b_um_per_mm2,
        c_um_per_mm: p.c_um_per_mm,
        d_um: p.d_um,
    });
    pieces.collect()
}
