//! The test piece before it is cut, and what changes of the machine would do to it.

use super::settings::{ErrorChangeEntry, errors, tool_length};
use crate::desk::{Desk, Job};
use crate::frame::{Array, Arrays};
use crate::refusal::{Refusal, entries};
use crate::request::{Reply, Request, ask};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::Path;
use trueaxis::JsonSchema;
use trueaxis::files::disk;
use trueaxis::geometry::Vec3;
use trueaxis::input::Diagnostics;
use trueaxis::machine::axis::AxisKind;
use trueaxis::machine::errors::ErrorName;
use trueaxis::machine::heat::Conditions;
use trueaxis::part::fit::circle::Zone;
use trueaxis::predict::drawing::{CutPoint, PartPrediction};
use trueaxis::predict::holes::{HolePrediction, HoleStudy};
use trueaxis::predict::{Error, Prediction, SectionResult, Study, WhatIf, preview, read_study};
use trueaxis::questions::{Predict, Predicted};
use trueaxis::report::{DiagnosticEntry, DrawingDocument, HolesDocument, PredictionDocument};

/// The whole prediction of a study, as `trueaxis predict --no-report` computes it.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct PredictRequest {
    /// The study file: a test piece, holes or a part.
    study: String,
    /// Of a part, whether it is judged by its program compensated for the machine, too; no, if left out.
    compensated: Option<bool>,
}

/// The same for a changed machine, without Monte Carlo, fast enough to follow a slider.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct WhatIfRequest {
    /// The study file: a test piece.
    study: String,
    /// Changes of errors by ISO 230-1 name.
    errors: Option<BTreeMap<String, ErrorChangeEntry>>,
    /// The setting angles of rotary axes by name, degrees; those of the study if left out.
    setting_deg: Option<BTreeMap<String, f64>>,
    /// The length of the tool, mm.
    tool_length_mm: Option<f64>,
    /// Temperatures, as `--temperature` of the command line.
    temperature: Option<String>,
}

/// A prediction.
#[derive(Debug, Serialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub(super) enum PredictAnswer<'a> {
    /// Of a test piece.
    TestPiece(Box<PieceEntry<'a>>),
    /// Of holes.
    Holes(Box<HolesEntry<'a>>),
    /// Of a part by its drawing.
    Drawing(Box<DrawingEntry<'a>>),
}

/// The prediction of a test piece. Arrays: for each point of all sections `azimuth_rad` (f32), `error_um` (f32:
/// the radial deviation) and `profile_mm` (f64: two, the actual point in the section).
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct PieceEntry<'a> {
    /// The document of `trueaxis predict`.
    document: PredictionDocument<'a>,
    /// The machine file below the project folder; null if it is outside.
    machine: Option<String>,
    /// The names of the rotary axes.
    rotary: Vec<String>,
    /// The length of the tool, mm.
    tool_length_mm: f64,
    /// The stated errors.
    errors: Vec<ErrorUnitEntry>,
    /// The names of the temperature sensors.
    sensors: Vec<&'a str>,
    /// The sections, in the order of the arrays.
    sections: Vec<SectionEntry>,
    /// The problems of the study.
    diagnostics: Vec<DiagnosticEntry<'a>>,
}

/// A stated error with the unit of its values.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct ErrorUnitEntry {
    /// Its ISO 230-1 name.
    name: String,
    /// `µm` or `µrad`.
    unit: &'static str,
}

/// A measured section of the test piece.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct SectionEntry {
    /// Its height in the workpiece frame, mm.
    z_mm: f64,
    /// Its height above the base of the cone, mm.
    height_mm: f64,
    /// Its nominal radius, mm.
    radius_mm: f64,
    /// How many points it has.
    points: usize,
    /// The reference circles.
    circles: [CircleEntry; 4],
}

/// A reference circle of a section.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct CircleEntry {
    /// `least squares`, `minimum zone`, `maximum inscribed` or `minimum circumscribed`.
    name: &'static str,
    /// Its centre, mm.
    centre_mm: [f64; 2],
    /// Its radius, mm.
    radius_mm: f64,
    /// The distance of the nearest point from the centre, mm.
    inner_mm: f64,
    /// The distance of the farthest point from the centre, mm.
    outer_mm: f64,
}

/// The prediction of holes. Arrays: `holes_mm` (f64: the three nominal coordinates of each hole), `error_um` (f32:
/// the three errors of each hole, set after set).
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct HolesEntry<'a> {
    /// The document of `trueaxis predict`.
    document: HolesDocument<'a>,
    /// The names of the temperature sensors.
    sensors: Vec<&'a str>,
    /// The problems of the study.
    diagnostics: Vec<DiagnosticEntry<'a>>,
}

/// The prediction of a part by its drawing. Arrays, point after point of all features: `places_mm` (f32: three nominal
/// coordinates each), `normals` (f32: three each, out of the material), `deviation_um`, `by_program_um` (f32: on a machine without
/// errors), `tool`, `program`, `line` (u32: the block that cut it), `time_s` (f32), and of the four errors that displace it most
/// `error` (u32: the number of its name in `error_names`; where there are fewer, of none) and `part_um` (f32).
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct DrawingEntry<'a> {
    /// The document of `trueaxis predict`.
    document: DrawingDocument<'a>,
    /// The files of the program, by their number in `program`.
    programs: &'a [String],
    /// The names of the errors, by their number in `error`.
    error_names: Vec<String>,
    /// The problems of the study.
    diagnostics: Vec<DiagnosticEntry<'a>>,
}

impl Request for PredictRequest {
    type Answer<'a> = PredictAnswer<'a>;

    fn answer(self, desk: &Desk, job: &Job) -> Result<Reply<Self>, Refusal> {
        let study = desk.project.path(&self.study)?;
        let compensated = self.compensated.unwrap_or(false);
        let (predicted, problems) =
            ask(&Predict { study, compensated, ..Predict::default() }, job)?;
        Ok(match &predicted {
            Predicted::Part(study, prediction) => {
                let answer = piece(desk, study, prediction, &problems);
                let answer = PredictAnswer::TestPiece(Box::new(answer));
                Reply::frame(&answer, section_arrays(prediction))
            }
            Predicted::Holes(study, prediction) => {
                let answer = PredictAnswer::Holes(Box::new(HolesEntry {
                    document: HolesDocument::of(study, prediction),
                    sensors: study.machine.heat().sensors(),
                    diagnostics: entries(&problems),
                }));
                Reply::frame(&answer, hole_arrays(study, prediction))
            }
            Predicted::Drawing(study, prediction, _) => {
                let names = study.mounted.stated_errors().into_iter().map(|(_, name)| name);
                let names: Vec<ErrorName> = names.collect();
                let answer = PredictAnswer::Drawing(Box::new(DrawingEntry {
                    document: DrawingDocument::of(study, prediction),
                    programs: &prediction.programs,
                    error_names: names.iter().map(ErrorName::to_string).collect(),
                    diagnostics: entries(&problems),
                }));
                Reply::frame(&answer, point_arrays(prediction, &names))
            }
        })
    }
}

impl Request for WhatIfRequest {
    type Answer<'a> = PredictAnswer<'a>;

    fn answer(self, desk: &Desk, _: &Job) -> Result<Reply<Self>, Refusal> {
        let (mut study, mut problems) = study(&desk.project.path(&self.study)?)?;
        study.sampling = None;
        let conditions = match &self.temperature {
            Some(text) => Conditions::typed("temperature", text, &mut problems),
            None => None,
        };
        let length_mm = self.tool_length_mm.map(|mm| tool_length(mm, &mut problems));
        if length_mm == Some(None) {
            return Err(Refusal::unusable(&problems));
        }
        let angles = self.setting_deg.into_iter().flatten();
        let changes = WhatIf {
            errors: errors(self.errors)?,
            setting_rad: angles.map(|(name, deg)| (name, deg.to_radians())).collect(),
            tool_length_mm: length_mm.flatten(),
            conditions,
        };
        let study = changes.put(study, &mut problems).filter(|_| !problems.has_errors());
        let Some(study) = study else { return Err(Refusal::unusable(&problems)) };
        let prediction = preview(&study).map_err(|e| refused(&e))?;
        let answer =
            PredictAnswer::TestPiece(Box::new(piece(desk, &study, &prediction, &problems)));
        Ok(Reply::frame(&answer, section_arrays(&prediction)))
    }
}

/// A study without errors, and the warnings and notes of its file.
fn study(path: &Path) -> Result<(Study, Diagnostics), Refusal> {
    let (study, problems) = read_study(&disk(), path);
    match study.filter(|_| !problems.has_errors()) {
        Some(study) => Ok((study, problems)),
        None => Err(Refusal::unusable(&problems)),
    }
}

fn refused(error: &Error) -> Refusal {
    let hint = "change the setting, the tool or the mounting, and ask again";
    Refusal::new(422, error.code(), error.to_string(), hint)
}

fn piece<'a>(
    desk: &Desk,
    study: &'a Study,
    prediction: &'a Prediction,
    problems: &'a Diagnostics,
) -> PieceEntry<'a> {
    let machine = &study.machine;
    let rotary = machine.axes().iter().filter(|a| a.kind == AxisKind::Rotary);
    let errors = machine.stated_errors().into_iter().map(|(_, name)| name);
    PieceEntry {
        document: PredictionDocument::of(study, prediction),
        machine: desk.project.name_of(&study.machine_path),
        rotary: rotary.map(|a| a.name.to_string()).collect(),
        tool_length_mm: -machine.tip_mm().z,
        errors: errors.map(ErrorUnitEntry::from).collect(),
        sensors: machine.heat().sensors(),
        sections: prediction.sections.iter().map(SectionEntry::from).collect(),
        diagnostics: entries(problems),
    }
}

impl From<ErrorName> for ErrorUnitEntry {
    fn from(name: ErrorName) -> Self {
        let unit = if name.component.is_rotation() { "µrad" } else { "µm" };
        Self { name: name.to_string(), unit }
    }
}

impl From<&SectionResult> for SectionEntry {
    fn from(result: &SectionResult) -> Self {
        let section = &result.section;
        let circles = &section.circles;
        Self {
            z_mm: section.z_mm,
            height_mm: section.height_mm,
            radius_mm: section.radius_mm,
            points: section.azimuth_rad.len(),
            circles: [
                CircleEntry::of("least squares", &circles.lsc),
                CircleEntry::of("minimum zone", &circles.mzc),
                CircleEntry::of("maximum inscribed", &circles.mic),
                CircleEntry::of("minimum circumscribed", &circles.mcc),
            ],
        }
    }
}

impl CircleEntry {
    fn of(name: &'static str, zone: &Zone) -> Self {
        Self {
            name,
            centre_mm: zone.center_mm,
            radius_mm: zone.radius_mm,
            inner_mm: zone.inner_mm,
            outer_mm: zone.outer_mm,
        }
    }
}

/// The points of all sections, one after the other.
fn section_arrays(prediction: &Prediction) -> Arrays {
    let sections = || prediction.sections.iter().map(|s| &s.section);
    let azimuth = sections().flat_map(|s| s.azimuth_rad.iter().map(|a| *a as f32)).collect();
    let error_um = sections().flat_map(|s| s.deviation_mm.iter().map(|e| (e * 1e3) as f32));
    let profile = sections().flat_map(|s| s.profile_mm.iter().flatten().copied());
    vec![
        ("azimuth_rad", Array::F32(azimuth)),
        ("error_um", Array::F32(error_um.collect())),
        ("profile_mm", Array::F64(profile.collect())),
    ]
}

fn point_arrays(prediction: &PartPrediction, names: &[ErrorName]) -> Arrays {
    const EFFECTS: usize = 4;
    let points = || prediction.features.iter().flat_map(|f| &f.points);
    let three = |of: fn(&CutPoint) -> Vec3| {
        let all = points().flat_map(move |p| <[f64; 3]>::from(of(p)));
        Array::F32(all.map(|c| c as f32).collect())
    };
    let float = |of: fn(&CutPoint) -> f64| Array::F32(points().map(|p| of(p) as f32).collect());
    let count = |of: fn(&CutPoint) -> u32| Array::U32(points().map(of).collect());
    let number = |name: &ErrorName| names.iter().position(|n| n == name).unwrap_or(names.len());
    let effects = points().flat_map(|p| (0..EFFECTS).map(|k| p.errors.get(k)));
    let (error, part_um): (Vec<u32>, Vec<f32>) = effects
        .map(|effect| match effect {
            Some(e) => (number(&e.error) as u32, (e.part_mm * 1e3) as f32),
            None => (names.len() as u32, 0.0),
        })
        .unzip();
    vec![
        ("places_mm", three(|p| p.nominal_mm)),
        ("normals", three(|p| p.normal)),
        ("deviation_um", float(|p| 1e3 * p.deviation_mm)),
        ("by_program_um", float(|p| 1e3 * p.by_program_mm)),
        ("tool", count(|p| p.origin.tool)),
        ("program", count(|p| p.origin.program)),
        ("line", count(|p| p.origin.line)),
        ("time_s", float(|p| p.origin.time_s)),
        ("error", Array::U32(error)),
        ("part_um", Array::F32(part_um)),
    ]
}

fn hole_arrays(study: &HoleStudy, prediction: &HolePrediction) -> Arrays {
    let places = study.holes_mm.iter().flat_map(|p| [p.x, p.y, p.z]);
    let of_sets = prediction.sets.iter().flat_map(|set| &set.holes);
    let error_um =
        of_sets.flat_map(|h| [h.error_mm.x, h.error_mm.y, h.error_mm.z].map(|e| (e * 1e3) as f32));
    vec![("holes_mm", Array::F64(places.collect())), ("error_um", Array::F32(error_um.collect()))]
}
