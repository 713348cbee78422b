//! The document `trueaxis/identify/1` of the expansion of a scale.

use schemars::JsonSchema;
use serde::Serialize;
use serde_json::Value;
use trueaxis_calibrate::identify::expansion::{Expansion, Runs};
use trueaxis_report::document;

/// The coefficient of expansion of a scale.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ExpansionDocument<'a> {
    /// Which document this is.
    #[schemars(extend("const" = "trueaxis/identify/1"))]
    pub schema: &'static str,
    /// The name of the study.
    pub name: &'a str,
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

/// The document `trueaxis/identify/1`.
pub fn expansion_json(data: &Runs, found: &Expansion) -> Value {
    let runs = data.runs.iter().zip(&found.slopes).map(|(run, slope)| RunEntry {
        name: &run.name,
        temperature_celsius: run.celsius.value,
        slope_um_per_m: slope * 1e6,
    });
    document(&ExpansionDocument {
        schema: "trueaxis/identify/1",
        name: &data.name,
        expansion_um_per_m_k: found.per_k * 1e6,
        u_um_per_m_k: found.u_per_k * 1e6,
        slope_difference_um_per_m_k: found.slope_difference_per_k * 1e6,
        residual_um: found.residual_mm * 1e3,
        materials: &found.materials,
        runs: runs.collect(),
        warnings: &found.warnings,
    })
}
