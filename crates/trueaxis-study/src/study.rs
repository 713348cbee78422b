//! A study: what is varied, how it is drawn, what is made, what is asked of it.

use crate::cases::Case;
use crate::correlation::Correlation;
use crate::design::Design;
use crate::inputs::Input;
use std::path::PathBuf;

/// How many machines must hold their tolerances.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Requirement {
    /// The share of machines. Unit: 1.
    pub machines_ratio: f64,
    /// A machine holds its tolerances if it does on this share of its days. Unit: 1.
    pub days_ratio: f64,
}

impl Default for Requirement {
    /// On every day.
    fn default() -> Self {
        Self { machines_ratio: 1.0, days_ratio: 1.0 }
    }
}

/// A study of many machines on many days.
pub struct Study {
    /// Its name.
    pub name: String,
    /// Its file.
    pub path: PathBuf,
    /// Which samples there are.
    pub design: Design,
    /// What is varied.
    pub inputs: Vec<Input>,
    /// Inputs that are correlated.
    pub correlation: Option<Correlation>,
    /// The groups of the sensitivity analysis.
    pub groups: Vec<String>,
    /// Of each input its group.
    pub group_of: Vec<usize>,
    /// What every machine makes.
    pub cases: Vec<Case>,
    /// What is asked of the machines, if anything is.
    pub requirement: Option<Requirement>,
}

impl std::fmt::Debug for Study {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Study")
            .field("name", &self.name)
            .field("design", &self.design)
            .finish_non_exhaustive()
    }
}

impl Study {
    /// More numbers than this would not fit into the memory of a usual computer.
    pub const MOST_NUMBERS: usize = 200_000_000;

    /// The keys of the outputs, case after case; with the name of the case where there are several.
    pub fn output_keys(&self) -> Vec<String> {
        let several = self.cases.len() > 1;
        let of = |case: &Case| -> Vec<String> {
            let key = |o: &crate::cases::Output| match several {
                true => format!("{}: {}", case.name, o.key),
                false => o.key.clone(),
            };
            case.outputs.iter().map(key).collect()
        };
        self.cases.iter().flat_map(of).collect()
    }
}
