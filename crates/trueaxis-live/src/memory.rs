//! The heat in the scales over restarts: docs/model.md eq. 243.

use serde::{Deserialize, Serialize};
use trueaxis::machine::Machine;
use trueaxis::machine::heat::{ScaleHeat, ThermalMemory};

/// A [`ThermalMemory`] in a file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct HeatOfRun {
    /// Each scale.
    scales: Vec<HeatOfScale>,
    /// The last row, s.
    last_s: Option<f64>,
}

/// A [`ScaleHeat`] in a file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct HeatOfScale {
    times_s: Vec<f64>,
    changes_k_per_mm: Vec<Vec<f64>>,
}

impl From<ThermalMemory> for HeatOfRun {
    fn from(memory: ThermalMemory) -> Self {
        let scale = |heat: ScaleHeat| HeatOfScale {
            times_s: heat.times_s,
            changes_k_per_mm: heat.changes_k_per_mm,
        };
        Self { scales: memory.scales.into_iter().map(scale).collect(), last_s: memory.last_s }
    }
}

impl From<HeatOfRun> for ThermalMemory {
    fn from(of_run: HeatOfRun) -> Self {
        let scale = |heat: HeatOfScale| ScaleHeat {
            times_s: heat.times_s,
            changes_k_per_mm: heat.changes_k_per_mm,
        };
        Self { scales: of_run.scales.into_iter().map(scale).collect(), last_s: of_run.last_s }
    }
}

impl HeatOfRun {
    /// The same on another clock: what was at 0 is at `by_s`.
    #[must_use]
    pub fn shifted(self, by_s: f64) -> Self {
        ThermalMemory::from(self).shifted(by_s).into()
    }

    /// Whether it can be of a machine.
    pub fn fits(&self, machine: &Machine) -> bool {
        ThermalMemory::from(self.clone()).fits(machine)
    }

    /// Whether there is anything in it.
    pub fn has_begun(&self) -> bool {
        self.last_s.is_some()
    }
}
