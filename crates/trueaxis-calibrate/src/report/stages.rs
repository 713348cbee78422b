//! The stages of a campaign in text and for programs.

use crate::identify::stages::{Sequence, StageResult, Value, probability};
use crate::plan::StageExpectation;
use serde::Serialize;
use trueaxis_measure::unknowns::design::Design;
use trueaxis_report::JsonSchema;
use trueaxis_report::{Section, Table};

/// A value that becomes surer by less than this share is not listed with a stage.
const HARDLY: f64 = 0.01;

/// Every stage with what it found.
pub(super) fn stage_sections<'a>(design: &Design, sequence: &Sequence) -> Vec<Section<'a>> {
    let numbered = sequence.results.iter().zip(1..);
    let mut sections: Vec<Section<'a>> =
        numbered.map(|(stage, n)| stage_section(design, sequence, stage, n)).collect();
    let words = format!(
        "The result below is that of all readings at once; the stages in their order give the same to {} of a \
         standard uncertainty.",
        share(sequence.difference)
    );
    if let Some(last) = sections.pop() {
        sections.push(last.paragraph(words));
    }
    sections
}

fn share(value: f64) -> String {
    if value < 1e-4 { "less than 0.0001".to_owned() } else { format!("{value:.4}") }
}

fn stage_section<'a>(
    design: &Design,
    sequence: &Sequence,
    stage: &StageResult,
    number: usize,
) -> Section<'a> {
    let date = stage.date.as_ref().map_or(String::new(), |date| format!(", {date}"));
    let mut lines = stage.lines.clone();
    if stage.birge > 1.0 {
        lines.push(format!(
            "its readings scatter {:.2} times as much as their stated noise: it counts as that much less sure",
            stage.birge
        ));
    }
    lines.extend(stage.test.as_ref().map(|test| {
        let verdict = if test.is_conflict() { "contradicts" } else { "agrees with" };
        format!(
            "it {verdict} what was known before: χ² = {:.1}, {} degrees of freedom, p = {}",
            test.chi_square,
            test.degrees_of_freedom,
            probability(test.p)
        )
    }));
    let rows = changed(stage).map(|k| {
        let (unit, scale) = design.shown_unit(k);
        let shown = |value: Value| match value {
            Some((v, u)) => [v * scale, 2.0 * u * scale].map(|n| format!("{n:.3}")),
            None => ["–".to_owned(), String::new()],
        };
        let ([x, u], [y, w]) = (shown(stage.before[k]), shown(stage.after[k]));
        [sequence.names[k].clone(), x, u, y, w, unit.to_owned()]
    });
    let head = ["unknowns", "before", "U (k = 2)", "after this stage", "U (k = 2)", ""];
    let table = Table::new(head).rows(rows).most_on_terminal(usize::MAX);
    Section::new(format!("Stage {number}: {}{date}", stage.name))
        .paragraph(format!("{} numbers read", stage.numbers))
        .list(lines)
        .table(table)
}

/// The unknowns of which a stage says something.
fn changed(stage: &StageResult) -> impl Iterator<Item = usize> {
    (0..stage.after.len()).filter(|k| match (stage.before[*k], stage.after[*k]) {
        (_, None) => false,
        (None, Some(_)) => true,
        (Some((_, u)), Some((_, w))) => w < (1.0 - HARDLY) * u,
    })
}

/// What each stage of a plan will determine.
pub(super) fn planned_section<'a>(
    design: &Design,
    stages: &[StageExpectation],
) -> Option<Section<'a>> {
    if stages.is_empty() {
        return None;
    }
    let names = design.names();
    let rows = names.iter().enumerate().map(|(k, name)| {
        let (unit, scale) = design.shown_unit(k);
        let shown = |s: &StageExpectation| {
            s.u[k].map_or("–".to_owned(), |u| format!("{:.3}", 2.0 * u * scale))
        };
        let all = stages.iter().map(shown);
        std::iter::once(name.clone()).chain(all).chain([unit.to_owned()]).collect::<Vec<_>>()
    });
    let heads = stages.iter().zip(1..).map(|(s, n)| format!("{n}: {}", s.name));
    let heads =
        std::iter::once("U (k = 2) after stage".to_owned()).chain(heads).chain([String::new()]);
    let table = Table::new(heads).rows(rows).most_on_terminal(usize::MAX);
    let note = "Each stage knows what the stages before it hand on, with its covariance.";
    Some(Section::new("What each stage will determine").table(table.note(note)))
}

/// A stage for programs.
#[derive(Debug, Serialize, JsonSchema)]
pub struct StageEntry<'a> {
    /// Its name.
    pub name: &'a str,
    /// When it was done, as written; null if none is stated.
    pub date: Option<&'a str>,
    /// How many numbers were read.
    pub numbers: usize,
    /// What was found without the axes of the machine, in words.
    pub found: &'a [String],
    /// By how much its readings scatter more than stated, 1 or more. Unit: 1.
    pub birge_ratio: f64,
    /// Whether it agrees with the stages before it; null if they say nothing of the same.
    pub agreement: Option<AgreementEntry<'a>>,
    /// Every unknown after this stage.
    pub known: Vec<StageValue<'a>>,
}

/// The test of a stage against the stages before it.
#[derive(Debug, Serialize, JsonSchema)]
pub struct AgreementEntry<'a> {
    /// χ². Unit: 1.
    pub chi_square: f64,
    /// Its degrees of freedom.
    pub degrees_of_freedom: usize,
    /// Probability of a larger χ² by chance. Unit: 1.
    pub p: f64,
    /// Whether they contradict each other.
    pub conflict: bool,
    /// The unknown that differs most; null if none can be compared alone.
    pub worst: Option<&'a str>,
}

/// An unknown after a stage.
#[derive(Debug, Serialize, JsonSchema)]
pub struct StageValue<'a> {
    /// Its name.
    pub name: &'a str,
    /// `um`, `urad`, `ms` or `um/m`.
    pub unit: &'static str,
    /// Its value; null if it is not known yet. Unit: that of `unit`.
    pub value: Option<f64>,
    /// Its standard uncertainty. Unit: that of `unit`.
    pub u: Option<f64>,
    /// Its standard uncertainty before this stage; null if it was not known. Unit: that of `unit`.
    pub u_before: Option<f64>,
}

/// The stages for programs.
pub(super) fn stage_entries<'a>(design: &Design, sequence: &'a Sequence) -> Vec<StageEntry<'a>> {
    let entry = |stage: &'a StageResult| StageEntry {
        name: &stage.name,
        date: stage.date.as_deref(),
        numbers: stage.numbers,
        found: &stage.lines,
        birge_ratio: stage.birge,
        agreement: stage.test.as_ref().map(|test| AgreementEntry {
            chi_square: test.chi_square,
            degrees_of_freedom: test.degrees_of_freedom,
            p: test.p,
            conflict: test.is_conflict(),
            worst: test.worst.map(|c| sequence.names[c.unknown].as_str()),
        }),
        known: (0..sequence.names.len())
            .map(|k| {
                let (unit, scale) = design.shown_unit(k);
                StageValue {
                    name: &sequence.names[k],
                    unit: plain(unit),
                    value: stage.after[k].map(|(v, _)| v * scale),
                    u: stage.after[k].map(|(_, u)| u * scale),
                    u_before: stage.before[k].map(|(_, u)| u * scale),
                }
            })
            .collect(),
    };
    sequence.results.iter().map(entry).collect()
}

fn plain(unit: &str) -> &'static str {
    match unit {
        "µrad" => "urad",
        "µm/m" => "um/m",
        "ms" => "ms",
        _ => "um",
    }
}

/// A stage of a plan for programs.
#[derive(Debug, Serialize, JsonSchema)]
pub struct PlannedStageEntry<'a> {
    /// Its name.
    pub name: &'a str,
    /// The uncertainty of each unknown after it.
    pub expected: Vec<PlannedValue>,
}

/// What is expected of an unknown after a stage.
#[derive(Debug, Serialize, JsonSchema)]
pub struct PlannedValue {
    /// Its name.
    pub name: String,
    /// `um`, `urad`, `ms` or `um/m`.
    pub unit: &'static str,
    /// Expanded uncertainty (k = 2); null if it is not known then. Unit: that of `unit`.
    pub expanded_k2: Option<f64>,
}

/// The stages of a plan for programs.
pub(super) fn planned_entries<'a>(
    design: &Design,
    stages: &'a [StageExpectation],
) -> Vec<PlannedStageEntry<'a>> {
    let names = design.names();
    let value = |stage: &StageExpectation, k: usize| {
        let (unit, scale) = design.shown_unit(k);
        let expanded_k2 = stage.u[k].map(|u| 2.0 * u * scale);
        PlannedValue { name: names[k].clone(), unit: plain(unit), expanded_k2 }
    };
    let entry = |stage: &'a StageExpectation| PlannedStageEntry {
        name: &stage.name,
        expected: (0..names.len()).map(|k| value(stage, k)).collect(),
    };
    stages.iter().map(entry).collect()
}
