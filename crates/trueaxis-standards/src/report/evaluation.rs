//! An evaluation for people: the same tables for the terminal and the page.

use crate::conditions::Conditions;
use crate::{Evaluated, Standard};
use trueaxis_report::{Block, Picture, write_block};

/// Everything that a report of an evaluation shows.
pub struct Evaluation<'a> {
    /// By which standard.
    pub standard: Standard,
    /// The file of the readings.
    pub file: &'a str,
    /// What is known beside them.
    pub conditions: &'a Conditions,
    /// The result.
    pub evaluated: &'a Evaluated,
    /// Warnings and notes, each as one text.
    pub remarks: &'a [String],
}

/// What all reports of an evaluation show, in their order.
pub struct Sheets {
    /// Before the pictures.
    pub figures: Vec<Block>,
    /// Behind them.
    pub details: Vec<Block>,
    /// Between them.
    pub pictures: Vec<Picture>,
}

impl Evaluation<'_> {
    /// Tables and pictures.
    pub fn sheets(&self) -> Sheets {
        match self.evaluated {
            Evaluated::Positioning(measurement, result) => {
                super::evaluation_positioning::sheets(self.standard, measurement, result)
            }
            Evaluated::Circular(circle) => super::evaluation_circular::sheets(circle),
            Evaluated::Drift(drift) => super::evaluation_others::drift_sheets(drift),
            Evaluated::Diagonals(d) => super::evaluation_others::diagonal_sheets(d),
            Evaluated::Rotation(r) => super::evaluation_others::rotation_sheets(r),
        }
    }

    /// What was measured, in words.
    pub(super) fn title(&self) -> &str {
        self.conditions.name.as_deref().unwrap_or(self.file)
    }

    /// Machine, axis, instrument, date, temperature, where known.
    pub(super) fn circumstances(&self) -> String {
        let c = self.conditions;
        let axis = c.axis.as_ref().map(|a| format!("axis {a}"));
        let temperature = c.temperature_c.map(|t| match t.u {
            Some(u) => format!("{} ± {u} °C", t.value),
            None => format!("{} °C", t.value),
        });
        let parts = [
            c.machine.clone(),
            axis,
            c.instrument_name.clone(),
            c.date.clone(),
            temperature,
            Some(self.file.to_owned()),
        ];
        parts.into_iter().flatten().collect::<Vec<_>>().join(" · ")
    }
}

/// A figure, or a dash where there is none.
pub(super) fn figure(value: Option<f64>, scale: f64) -> String {
    match value {
        // No minus before what is shown as zero.
        Some(v) if (v * scale).abs() < 0.005 => "0.00".to_owned(),
        Some(v) => format!("{:.2}", v * scale),
        None => "–".to_owned(),
    }
}

/// The evaluation as the terminal shows it.
pub fn evaluation_text(evaluation: &Evaluation<'_>) -> String {
    let sheets = evaluation.sheets();
    let mut out = format!(
        "{}\n  {}\n  {}\n",
        evaluation.title(),
        evaluation.standard.title(),
        evaluation.circumstances()
    );
    for block in sheets.figures.iter().chain(&sheets.details) {
        // Writing into a text cannot fail.
        let _ = write_block(&mut out, block);
    }
    out
}
