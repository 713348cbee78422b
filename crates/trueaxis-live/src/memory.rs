//! The heat in the scales over restarts: docs/model.md eq. 243.

use serde::{Deserialize, Serialize};
use trueaxis::machine::heat::{ScaleHeat, ThermalMemory};

/// A [`ThermalMemory`] in a file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct HeatOfRun {
    /// Of each scale when its flux has changed (s), and by how much at each place (K/mm).
    scales: Vec<(Vec<f64>, Vec<Vec<f64>>)>,
    /// The last row, s.
    last_s: Option<f64>,
}

impl From<ThermalMemory> for HeatOfRun {
    fn from(ThermalMemory { scales, last_s }: ThermalMemory) -> Self {
        let scale = |heat: ScaleHeat| (heat.times_s, heat.changes_k_per_mm);
        Self { scales: scales.into_iter().map(scale).collect(), last_s }
    }
}

impl From<HeatOfRun> for ThermalMemory {
    fn from(HeatOfRun { scales, last_s }: HeatOfRun) -> Self {
        let scale = |(times_s, changes_k_per_mm)| ScaleHeat { times_s, changes_k_per_mm };
        Self { scales: scales.into_iter().map(scale).collect(), last_s }
    }
}
