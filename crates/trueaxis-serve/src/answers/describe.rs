//! The machine: what it is, where its tool is, and one error of it put into its file.

use super::machine::Draft;
use super::settings::{are_positions, tool_length};
use crate::desk::{Desk, Job};
use crate::frame::Array;
use crate::project::version;
use crate::refusal::{Refusal, entries};
use crate::request::{Reply, Request};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use trueaxis::JsonSchema;
use trueaxis::describe::{self, set_error as put_error};
use trueaxis::files::disk;
use trueaxis::geometry::Vec3;
use trueaxis::geometry::frame::Pose;
use trueaxis::input::{Diagnostics, Place};
use trueaxis::machine::Machine;
use trueaxis::machine::axis::Approach;
use trueaxis::machine::file::Folder;
use trueaxis::machine::heat::Conditions;
use trueaxis::report::{
    CheckDocument, DescriptionDocument, DiagnosticEntry, PoseDocument, PoseReport,
};
use trueaxis::simulate::collide::{BodyModel, load_models};

/// The machine as data; of one that cannot be used, what is wrong with it.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct DescribeRequest {
    /// The machine file.
    machine: String,
    /// Its text, if it is being edited.
    text: Option<String>,
}

/// A machine.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct DescribeAnswer<'a> {
    /// Its links, errors, sensors, tools and models; all empty where it cannot be used.
    #[serde(flatten)]
    description: DescriptionDocument<'a>,
    /// Whether it can be used, and the problems of its file.
    check: CheckDocument<'a>,
    /// The version of the text, for `save`.
    version: String,
    /// The text of the machine file.
    text: &'a str,
}

impl Request for DescribeRequest {
    type Answer<'a> = DescribeAnswer<'a>;

    fn answer(self, desk: &Desk, _: &Job) -> Result<Reply<Self>, Refusal> {
        let Draft { machine, text, problems, .. } = Draft::read(desk, &self.machine, self.text)?;
        let machine = machine.as_ref();
        let description = machine.map(|machine| describe::describe(machine, Some(&text)));
        Ok(Reply::json(&DescribeAnswer {
            description: description.as_ref().map(DescriptionDocument::from).unwrap_or_default(),
            check: CheckDocument::of(machine, &problems.clone().sorted()),
            version: version(text.as_bytes()),
            text: &text,
        }))
    }
}

/// The surfaces of the models of a machine, those of STL files too.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct ModelsRequest {
    /// The machine file.
    machine: String,
    /// Its text, if it is being edited.
    text: Option<String>,
}

/// Models. Array: `corners_mm` (f32: the corners of the triangles, nine numbers each, model after model).
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct ModelsAnswer<'a> {
    /// The models.
    models: Vec<SurfaceEntry<'a>>,
    /// The problems of the machine file and its models.
    diagnostics: Vec<DiagnosticEntry<'a>>,
}

/// A model as triangles.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct SurfaceEntry<'a> {
    /// Its name.
    name: &'a str,
    /// The body that it moves with, as an index of the links; null is the bed.
    body: Option<usize>,
    /// Its pose on that body: rotation row by row, then origin, mm.
    placement: [f64; 12],
    /// How many triangles it has.
    triangles: usize,
}

impl Request for ModelsRequest {
    type Answer<'a> = ModelsAnswer<'a>;

    fn answer(self, desk: &Desk, _: &Job) -> Result<Reply<Self>, Refusal> {
        let Draft { machine, path, mut problems, .. } =
            Draft::read(desk, &self.machine, self.text)?;
        let Some(machine) = machine else { return Err(Refusal::unusable(&problems)) };
        let models = load_models(&disk(), &machine, &path, &mut problems);
        let answer = ModelsAnswer {
            models: models.iter().map(SurfaceEntry::from).collect(),
            diagnostics: entries(&problems),
        };
        Ok(Reply::frame(&answer, vec![("corners_mm", corners(&models))]))
    }
}

impl<'a> From<&'a BodyModel> for SurfaceEntry<'a> {
    fn from(model: &'a BodyModel) -> Self {
        Self {
            name: &model.name,
            body: model.node,
            placement: twelve(&model.placement),
            triangles: model.mesh.triangles().len(),
        }
    }
}

/// The corners of the triangles of models, mm.
pub(super) fn corners(models: &[BodyModel]) -> Array {
    let corners = models.iter().flat_map(|model| model.mesh.triangles()).flatten();
    Array::F32(corners.flat_map(|c| [c.x as f32, c.y as f32, c.z as f32]).collect())
}

/// Nominal and actual place of the tool and of every body at one position of the axes.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct PoseRequest {
    /// The machine file.
    machine: String,
    /// Its text, if it is being edited.
    text: Option<String>,
    /// The position by axis name, mm and degrees; an axis that is left out is at 0.
    at: Option<BTreeMap<String, f64>>,
    /// The length of the tool, mm; that of the machine file if it is left out.
    tool_length_mm: Option<f64>,
    /// Temperatures, as `--temperature` of the command line.
    temperature: Option<String>,
}

/// A pose. Arrays: `nominal`, `actual` (f64: for each body its rotation row by row, then its origin, mm, in the
/// machine frame).
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct PoseAnswer<'a> {
    /// The document of `trueaxis pose`.
    pose: PoseDocument,
    /// The names of the bodies, in the order of the arrays.
    bodies: Vec<&'a str>,
    /// The problems of the machine file and of the position.
    diagnostics: Vec<DiagnosticEntry<'a>>,
}

impl Request for PoseRequest {
    type Answer<'a> = PoseAnswer<'a>;

    fn answer(self, desk: &Desk, _: &Job) -> Result<Reply<Self>, Refusal> {
        let Draft { machine, mut problems, .. } = Draft::read(desk, &self.machine, self.text)?;
        let Some(mut machine) = machine else { return Err(Refusal::unusable(&problems)) };
        if let Some(length_mm) = self.tool_length_mm {
            let Some(length_mm) = tool_length(length_mm, &mut problems) else {
                return Err(Refusal::unusable(&problems));
            };
            machine = machine.with_tip(Vec3::new(0.0, 0.0, -length_mm));
        }
        let warm = match &self.temperature {
            Some(text) => Conditions::typed("temperature", text, &mut problems)
                .and_then(|conditions| machine.at(&conditions, &mut problems)),
            None => Some(machine),
        };
        let place = Place::whole("at");
        if !are_positions(self.at.as_ref(), &place, &mut problems) {
            return Err(Refusal::unusable(&problems));
        }
        let at = self.at.iter().flatten().map(|(name, value)| (name.as_str(), *value));
        let report = warm.as_ref().and_then(|machine| {
            let command = describe::command(machine, at, &place, &mut problems)?;
            PoseReport::at(machine, &command, &Approach::default(), &place, &mut problems)
        });
        let Some(report) = report.filter(|_| !problems.has_errors()) else {
            return Err(Refusal::unusable(&problems));
        };
        let bodies = report.bodies();
        let poses = |which: usize| bodies.iter().flat_map(move |(_, poses)| twelve(&poses[which]));
        let arrays = vec![
            ("nominal", Array::F64(poses(0).collect())),
            ("actual", Array::F64(poses(1).collect())),
        ];
        let answer = PoseAnswer {
            pose: PoseDocument::from(&report),
            bodies: bodies.iter().map(|(name, _)| &**name).collect(),
            diagnostics: entries(&problems),
        };
        Ok(Reply::frame(&answer, arrays))
    }
}

/// Rotation row by row, then origin in mm.
pub(super) fn twelve<To, From>(pose: &Pose<To, From>) -> [f64; 12] {
    let (r, o) = (pose.linear(), pose.shift_mm());
    let row = |i: usize| [r[(i, 0)], r[(i, 1)], r[(i, 2)]];
    let ([a, b, c], [d, e, f], [g, h, i]) = (row(0), row(1), row(2));
    [a, b, c, d, e, f, g, h, i, o.x, o.y, o.z]
}

/// The text of the machine file with one error in it; nothing is saved.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct SetErrorRequest {
    /// The machine file.
    machine: String,
    /// Its present text.
    text: String,
    /// The ISO 230-1 name of the error.
    error: String,
    /// The error as it is written in the file; empty to remove it.
    value: String,
}

/// The machine file with the error.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct SetErrorAnswer<'a> {
    /// Its new text.
    text: &'a str,
    /// The problems of the new text.
    diagnostics: Vec<DiagnosticEntry<'a>>,
}

impl Request for SetErrorRequest {
    type Answer<'a> = SetErrorAnswer<'a>;

    fn answer(self, desk: &Desk, _: &Job) -> Result<Reply<Self>, Refusal> {
        let name = &self.machine;
        let path = desk.project.path(name)?;
        let folder = Folder::of(&disk(), &path);
        let text = put_error(&self.text, name, &folder, &self.error, &self.value)
            .map_err(|problems| Refusal::unusable(&problems))?;
        let (_, problems): (_, Diagnostics) = Machine::check(name, &text, &folder);
        Ok(Reply::json(&SetErrorAnswer { text: &text, diagnostics: entries(&problems) }))
    }
}
