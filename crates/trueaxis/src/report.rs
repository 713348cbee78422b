//! Predictions, simulations and evaluations for people and for programs.
//!
//! [`text`] is what the terminal shows, [`json`] the document `trueaxis/predict/1`, [`html`] one
//! page that opens offline; [`simulation_text`], [`simulation_json`] and [`simulation_html`] are the
//! same for a simulation.

mod adapt;
mod adapt_maps;
mod adapt_page;
mod calibrations;
mod certificate;
mod certificate_blocks;
mod certificate_page;
mod check;
mod comparison;
mod compensation;
mod description;
mod diagnostic;
mod evaluation;
mod evaluation_circular;
mod evaluation_html;
mod evaluation_json;
mod evaluation_others;
mod evaluation_plots;
mod evaluation_positioning;
mod holes;
mod holes_html;
mod html;
mod identification;
mod identification_arrows;
mod identification_page;
mod json;
mod measurement;
pub mod numbers;
mod page;
mod picture_page;
mod plan;
mod plan_page;
mod plots;
mod pose;
mod probe;
mod probe_page;
mod program;
mod program_page;
mod rtcp;
mod simulation;
mod simulation_page;
mod simulation_plots;
mod simulation_views;
mod surface;
mod tables;
mod text;
mod thermal;
mod thermal_page;

pub use adapt::{AdaptReport, AdaptedProgram, adapt_json, adapt_text};
pub use adapt_page::adapt_html;
pub use calibrations::{
    CalibrationsReport, calibrations_html, calibrations_json, calibrations_text,
};
pub use certificate::{certificate_json, certificate_text};
pub use certificate_page::certificate_html;
pub use check::{check_json, check_text};
pub use comparison::{comparison_html, comparison_json, comparison_text};
pub use compensation::{
    compensation_csv, compensation_json, compensation_text, compensation_warnings,
};
pub use description::description_json;
pub use diagnostic::{diagnostic_json, remarks};
pub use evaluation::{Block, Evaluation, Sheets, evaluation_text};
pub use evaluation_html::evaluation_html;
pub use evaluation_json::evaluation_json;
pub use evaluation_plots::{Band, Picture, Polar, PolarLine, Scatter};
pub use holes::{holes_json, holes_text};
pub use holes_html::holes_html;
pub use html::html;
pub use identification::{
    IdentificationReport, conventions_json, conventions_text, identification_json,
    identification_text,
};
pub use identification_arrows::Arrow;
pub use identification_page::identification_html;
pub use json::json;
pub use measurement::{MeasuredReport, measurement_html, measurement_json, measurement_text};
pub use plan::{PlanReport, plan_json, plan_text};
pub use plan_page::plan_html;
pub use plots::DrawingError;
pub use pose::{
    Bodies, Budget, PoseReport, array, bodies, bodies_json, bodies_table, budget, budget_json,
    budget_table, deviation_json, pose_json, pose_text,
};
pub use probe::{corrected_csv, probe_json, probe_table_csv, probe_text};
pub use probe_page::probe_html;
pub use program::{ProgramReport, program_json, program_text};
pub use program_page::program_html;
pub use rtcp::{RtcpReport, rtcp_json, rtcp_text};
pub use simulation::{Simulation, simulation_json, simulation_text, trouble_code, trouble_text};
pub use simulation_page::simulation_html;
pub use surface::{surface_json, surface_text};
pub use tables::{TablesReport, tables_json, tables_text};
pub use text::text;
pub use thermal::{thermal_json, thermal_lines, thermal_text};
pub use thermal_page::thermal_html;

use crate::predict::{Index, Prediction, Share};
use trueaxis_machine::axis::{Axis, AxisKind, Command};
use trueaxis_part::testpiece::{Family, Feature, IndexName};

/// The feature in one word.
fn feature(name: &IndexName) -> &'static str {
    match name.feature {
        Feature::Roundness => "roundness",
        Feature::Coaxiality => "coaxiality",
        Feature::Angularity => "angularity",
        Feature::Volumetric => "volumetric",
    }
}

/// The indices that the verdict hangs on, with their place in every list of values.
fn decisive(prediction: &Prediction) -> impl Iterator<Item = (usize, &Index)> {
    prediction.indices.iter().enumerate().filter(|(_, i)| i.name.decisive)
}

fn family_key(family: Family) -> Option<&'static str> {
    match family {
        Family::Paper => Some("paper"),
        Family::Iso => Some("iso"),
        Family::Spatial => None,
    }
}

/// How much an index falls if an error is taken away, mm.
fn relief<T>(prediction: &Prediction, index: usize, share: &Share<T>) -> f64 {
    prediction.indices[index].value_mm - share.without_mm[index]
}

/// The shares that matter most for one index: by the larger of relief and effect alone.
fn ranked<'a, T>(
    prediction: &Prediction,
    index: usize,
    shares: &'a [Share<T>],
    most: usize,
) -> Vec<&'a Share<T>> {
    let mut ranked: Vec<_> = shares.iter().collect();
    let weight = |s: &Share<T>| relief(prediction, index, s).abs().max(s.alone_mm[index].abs());
    ranked.sort_by(|a, b| weight(b).total_cmp(&weight(a)));
    ranked.truncate(most);
    ranked
}

/// mm or degrees.
fn shown(axis: &Axis, value: f64) -> f64 {
    match axis.kind {
        AxisKind::Linear => value,
        AxisKind::Rotary => value.to_degrees(),
    }
}

fn unit(axis: &Axis) -> &'static str {
    match axis.kind {
        AxisKind::Linear => "mm",
        AxisKind::Rotary => "deg",
    }
}

/// `X 3114.7601 mm  C 0.0000 deg`.
fn command_words(axes: &[Axis], command: &Command) -> String {
    let words: Vec<String> = axes
        .iter()
        .zip(command)
        // + 0.0: no minus before a zero.
        .map(|(axis, q)| format!("{} {:.4} {}", axis.name, shown(axis, *q) + 0.0, unit(axis)))
        .collect();
    words.join("  ")
}
