//! An evaluation as a report.

use super::{
    decisions, evaluation_circular, evaluation_geometric, evaluation_others,
    evaluation_positioning, evaluation_probing,
};
use crate::conditions::Conditions;
use crate::judge::Judged;
use crate::{Evaluated, Standard};
use trueaxis_report::{Picture, Report, Section, Table};

/// Everything that a report of an evaluation shows.
pub struct Evaluation<'a> {
    /// By which standard.
    pub standard: Standard,
    /// The file of the readings.
    pub file: &'a str,
    /// Their conditions.
    pub conditions: &'a Conditions,
    /// The result.
    pub evaluated: &'a Evaluated,
    /// Warnings and notes, each as one text.
    pub remarks: &'a [String],
    /// Figures against their tolerances.
    pub judged: &'a [Judged],
}

/// The tables and pictures of an evaluation, each table with its title.
pub struct Contents {
    /// Before the pictures.
    pub results: Vec<(String, Table)>,
    /// Between them.
    pub pictures: Vec<Picture>,
    /// After the pictures.
    pub details: Vec<(String, Table)>,
}

impl Evaluation<'_> {
    /// Tables and pictures.
    pub fn contents(&self) -> Contents {
        let mut contents = match self.evaluated {
            Evaluated::Positioning(measurement, result) => {
                evaluation_positioning::contents(self.standard, measurement, result)
            }
            Evaluated::Geometric(test) => evaluation_geometric::contents(test),
            Evaluated::Circular(circle) => evaluation_circular::contents(circle),
            Evaluated::Drift(drift) => evaluation_others::drift(drift),
            Evaluated::Diagonals(d) => evaluation_others::diagonals(d),
            Evaluated::Rotation(r) => evaluation_others::rotation(r),
            Evaluated::Probing(p) => evaluation_probing::contents(p),
        };
        contents.results.splice(0..0, decisions::table(self.judged));
        contents
    }

    /// Machine, axis, instrument, date, temperature, where known.
    fn circumstances(&self) -> String {
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

/// An evaluation as a report.
pub fn evaluation_report(evaluation: &Evaluation<'_>) -> Report<'static> {
    let Contents { results, pictures, details } = evaluation.contents();
    let section = |(title, table): (String, Table)| Section::new(title).table(table);
    let remarks = Section::new("Remarks on the readings").on_page();
    let head = Report::new(evaluation.conditions.name.as_deref().unwrap_or(evaluation.file))
        .line(evaluation.standard.title())
        .line(evaluation.circumstances());
    let head = match decisions::verdict(evaluation.judged) {
        Some((standing, word, sentence)) => head.verdict(standing, word, sentence),
        None => head,
    };
    head.sections(results.into_iter().map(section))
        .sections(pictures.into_iter().map(Section::from))
        .section(remarks.list(evaluation.remarks.iter().cloned()))
        .sections(details.into_iter().map(section))
}

/// A value with two decimals, or a dash where there is none.
pub(super) fn cell(value: Option<f64>, scale: f64) -> String {
    match value {
        // No minus before what is shown as zero.
        Some(v) if (v * scale).abs() < 0.005 => "0.00".to_owned(),
        Some(v) => format!("{:.2}", v * scale),
        None => "–".to_owned(),
    }
}
