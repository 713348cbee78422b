//! A machine as a page needs it: chain, errors, sensors, tools, models.

use super::array;
use super::check_document::TravelEntry;
use serde::Serialize;
use serde_json::Value;
use trueaxis_geometry::Vec3;
use trueaxis_machine::axis::{Axis, AxisKind, AxisSide};
use trueaxis_machine::chain::Link;
use trueaxis_machine::describe::{
    DescribedError, DescribedLink, DescribedSensor, Description, shown, unit,
};
use trueaxis_machine::errors::ErrorKind;
use trueaxis_machine::models::{Model, Shape};
use trueaxis_machine::{Machine, ToolAssembly};
use trueaxis_report::JsonSchema;
use trueaxis_report::numbers::rounded;
use trueaxis_report::{Keyed, document};

/// The links, errors, sensors, tools and models of a machine. A pose is 12 numbers: its rotation row by row, then
/// its origin in mm. Bodies are given by their index among the links; null is the bed.
#[derive(Debug, Default, Serialize, JsonSchema)]
pub struct DescriptionDocument<'a> {
    /// The bodies of the kinematic chain.
    pub links: Vec<LinkEntry>,
    /// The errors of the machine, those without a stated value too.
    pub errors: Vec<ErrorEntry<'a>>,
    /// Its temperature sensors.
    pub sensors: Vec<SensorEntry<'a>>,
    /// The tool in the spindle; absent where there is no machine.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tool: Option<MountedToolEntry>,
    /// The tools of the machine file.
    pub tools: Vec<ToolAssemblyEntry<'a>>,
    /// The models of its bodies.
    pub models: Vec<ModelEntry<'a>>,
}

/// A body of the chain. An axis has `max_velocity_mm_per_s`, `max_acceleration_mm_per_s2` and `max_jerk_mm_per_s3`
/// (`deg` in place of `mm` for a rotary one), null where they are not stated.
#[derive(Debug, Serialize, JsonSchema)]
pub struct LinkEntry {
    /// Its name.
    pub name: String,
    /// `linear`, `rotary`, `workpiece` or `tool`.
    pub kind: &'static str,
    /// `tool` or `workpiece`: the side of the chain on which it stands.
    pub carries: &'static str,
    /// The direction of its axis in its own frame; (0 0 1) for workpiece and tool. Unit: 1.
    pub direction: [f64; 3],
    /// +1 where a positive command moves it along the direction, −1 against it (ISO 841); null for no axis.
    /// Unit: 1.
    pub sense: Option<f64>,
    /// The body that carries it.
    pub parent: Option<usize>,
    /// Its pose on that body with all axes at 0.
    /// Unit: 1 of the nine numbers of the rotation, mm of the three of the shift.
    pub placement: Vec<f64>,
    /// The pose of what is mounted on it.
    /// Unit: 1 of the nine numbers of the rotation, mm of the three of the shift.
    pub mounting: Vec<f64>,
    /// The unit of its positions, `mm` or `deg`; null for no axis.
    pub unit: Option<&'static str>,
    /// Its travel in that unit; null if it is not stated.
    pub travel: Option<TravelEntry>,
    /// Its limits.
    #[serde(flatten)]
    pub limits: Keyed<Option<f64>>,
}

/// An error of the machine.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ErrorEntry<'a> {
    /// Its ISO 230-1 name.
    pub name: String,
    /// The body that it belongs to.
    pub body: usize,
    /// `location` (constant) or `motion` (varies with the position of the axis).
    pub kind: &'static str,
    /// The unit of its values.
    pub unit: &'static str,
    /// Whether the machine file states it.
    pub stated: bool,
    /// The shape of its curve; null if it is not stated.
    pub shape: Option<&'static str>,
    /// Its text in the machine file.
    pub text: Option<&'a str>,
    /// Its line there.
    pub line: Option<usize>,
    /// The file of its table.
    pub table: Option<&'a str>,
    /// Its value, if it is constant. Unit: that of `unit`.
    pub value: Option<f64>,
    /// Its standard uncertainty, if that is constant. Unit: that of `unit`.
    pub u: Option<f64>,
    /// Its curve, sampled over the travel.
    pub curve: Option<CurveEntry>,
    /// How it was measured.
    pub measured: Option<MeasuredEntry<'a>>,
}

/// The curve of an error motion.
#[derive(Debug, Serialize, JsonSchema)]
pub struct CurveEntry {
    /// Positions of the axis. Unit: that of `at_unit`.
    pub at: Vec<f64>,
    /// Their unit, `mm` or `deg`.
    pub at_unit: &'static str,
    /// The mean of both directions there. Unit: that of the error.
    pub values: Vec<f64>,
    /// Positive minus negative direction there; null without reversal. Unit: that of the error.
    pub reversal: Option<Vec<f64>>,
    /// The standard uncertainty there; null if it is not stated. Unit: that of the error.
    pub u: Option<Vec<f64>>,
}

/// How an error was measured.
#[derive(Debug, Serialize, JsonSchema)]
pub struct MeasuredEntry<'a> {
    /// The instrument.
    pub instrument: Option<&'a str>,
    /// The date, as written.
    pub date: Option<&'a str>,
    /// The temperature, °C.
    pub temperature_celsius: Option<f64>,
}

/// A temperature sensor.
#[derive(Debug, Serialize, JsonSchema)]
pub struct SensorEntry<'a> {
    /// Its name.
    pub name: &'a str,
    /// What its temperature is used for.
    pub drives: &'a [String],
}

/// The tool in the spindle.
#[derive(Debug, Serialize, JsonSchema)]
pub struct MountedToolEntry {
    /// Its tip from the gauge line of the spindle, mm.
    pub tip_mm: [f64; 3],
    /// Its length, mm.
    pub length_mm: f64,
    /// Its diameter, mm, where a tool of the machine file has this length.
    pub diameter_mm: Option<f64>,
}

/// A tool of the machine file.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ToolAssemblyEntry<'a> {
    /// Its name.
    pub name: &'a str,
    /// From the gauge line of the spindle to the tip, mm.
    pub length_mm: f64,
    /// Its cutting diameter, mm.
    pub diameter_mm: Option<f64>,
    /// Its corner radius, mm.
    pub corner_radius_mm: Option<f64>,
    /// Its holder, in words.
    pub holder: Option<&'a str>,
    /// Its outline from the tip upwards: diameter and length of each cylinder, mm.
    pub segments_mm: Vec<[f64; 2]>,
}

/// The model of a body.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ModelEntry<'a> {
    /// Its name.
    pub name: &'a str,
    /// The body that it moves with.
    pub body: Option<usize>,
    /// Its pose on that body. Unit: 1 of the nine numbers of the rotation, mm of the three of the shift.
    pub placement: Vec<f64>,
    /// Its shape.
    pub shape: ShapeEntry<'a>,
}

/// The shape of a model.
#[derive(Debug, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ShapeEntry<'a> {
    /// A file of triangles.
    Stl {
        /// The file, relative to the machine file.
        path: &'a str,
        /// The length of its unit, mm.
        unit_mm: f64,
    },
    /// A box: its sizes along x, y and z, mm.
    Box([f64; 3]),
    /// A cone, or a cylinder.
    Cone {
        /// Diameter at its base, mm.
        base_diameter_mm: f64,
        /// Diameter at its top, mm.
        top_diameter_mm: f64,
        /// Its length, mm.
        length_mm: f64,
    },
    /// A prism.
    Prism {
        /// Its outline in x and y, mm.
        outline_mm: &'a [[f64; 2]],
        /// Its length along z, mm.
        length_mm: f64,
    },
}

impl<'a> From<&'a Description<'_>> for DescriptionDocument<'a> {
    fn from(description: &'a Description<'_>) -> Self {
        let machine = description.machine;
        let errors = description.errors.iter();
        Self {
            links: description.links.iter().map(LinkEntry::from).collect(),
            errors: errors
                .map(|e| ErrorEntry::of(e, description.links[e.index.body].axis))
                .collect(),
            sensors: description.sensors.iter().map(SensorEntry::from).collect(),
            tool: Some(MountedToolEntry::from(machine)),
            tools: machine.tools().iter().map(ToolAssemblyEntry::from).collect(),
            models: machine.models().iter().map(ModelEntry::from).collect(),
        }
    }
}

impl From<&DescribedLink<'_>> for LinkEntry {
    fn from(link: &DescribedLink<'_>) -> Self {
        let kind = match link.axis.map(|a| a.kind) {
            Some(AxisKind::Linear) => "linear",
            Some(AxisKind::Rotary) => "rotary",
            None if link.carries == AxisSide::Workpiece => "workpiece",
            None => "tool",
        };
        let limits = link.axis.map(|axis| {
            let (unit, limits) = (unit(axis), axis.limits);
            [
                (format!("max_velocity_{unit}_per_s"), limits.velocity),
                (format!("max_acceleration_{unit}_per_s2"), limits.acceleration),
                (format!("max_jerk_{unit}_per_s3"), limits.jerk),
            ]
            .map(|(key, value)| (key, value.map(|v| rounded(shown(axis, v)))))
        });
        Self {
            name: link.body.name.to_string(),
            kind,
            carries: if link.carries == AxisSide::Workpiece { "workpiece" } else { "tool" },
            // The workpiece and the tool do not move; a direction they have all the same: that of the tool.
            direction: array(link.axis.map_or(Vec3::z(), |a| a.direction)),
            sense: link.axis.map(|a| a.sense),
            parent: link.parent,
            placement: pose(&link.parent_from_link),
            mounting: pose(&link.body.mounting),
            unit: link.axis.map(unit),
            travel: link.axis.and_then(TravelEntry::of),
            limits: limits.into_iter().flatten().collect(),
        }
    }
}

fn pose(pose: &Link) -> Vec<f64> {
    let rows = (0..3).flat_map(|i| array(pose.linear().row(i).transpose()));
    rows.chain(array(*pose.shift_mm())).collect()
}

impl<'a> ErrorEntry<'a> {
    fn of(error: &'a DescribedError<'_>, axis: Option<&Axis>) -> Self {
        let (unit_of_error, size) = error.unit();
        let scaled = |value: f64| rounded(value / size) + 0.0;
        let all = |values: &Vec<f64>| values.iter().map(|v| scaled(*v)).collect::<Vec<_>>();
        let curve = error.curve.as_ref().zip(axis).map(|(curve, axis)| CurveEntry {
            at: curve.at.iter().map(|q| rounded(shown(axis, *q)) + 0.0).collect(),
            at_unit: unit(axis),
            values: all(&curve.values),
            reversal: curve.reversal.as_ref().map(all),
            u: curve.u.as_ref().map(all),
        });
        let measured = error.stated.map(|stated| MeasuredEntry {
            instrument: stated.measured.instrument.as_deref(),
            date: stated.measured.date.as_deref(),
            temperature_celsius: stated.measured.temperature_celsius,
        });
        let is_location = error.name.kind == ErrorKind::Location;
        Self {
            name: error.name.to_string(),
            body: error.index.body,
            kind: if is_location { "location" } else { "motion" },
            unit: unit_of_error,
            stated: error.stated.is_some(),
            shape: error.shape(),
            text: error.text.as_deref(),
            line: error.line,
            table: error.table.as_deref(),
            value: error.constant().map(scaled),
            u: error.u().map(scaled),
            curve,
            measured,
        }
    }
}

impl<'a> From<&'a DescribedSensor<'_>> for SensorEntry<'a> {
    fn from(sensor: &'a DescribedSensor<'_>) -> Self {
        Self { name: sensor.name, drives: &sensor.drives }
    }
}

impl From<&Machine> for MountedToolEntry {
    fn from(machine: &Machine) -> Self {
        let tip_mm = machine.tip_mm();
        // Which of its tools stands in the spindle is not stated, but one of that length may.
        let same = |t: &&ToolAssembly| Vec3::new(0.0, 0.0, -t.length_mm) == tip_mm;
        Self {
            tip_mm: array(tip_mm),
            length_mm: -tip_mm.z + 0.0,
            diameter_mm: machine.tools().iter().find(same).and_then(|t| t.diameter_mm),
        }
    }
}

impl<'a> From<&'a ToolAssembly> for ToolAssemblyEntry<'a> {
    fn from(tool: &'a ToolAssembly) -> Self {
        Self {
            name: &tool.name,
            length_mm: tool.length_mm,
            diameter_mm: tool.diameter_mm,
            corner_radius_mm: tool.corner_radius_mm,
            holder: tool.holder.as_deref(),
            segments_mm: tool.shape.iter().map(|s| [s.diameter_mm, s.length_mm]).collect(),
        }
    }
}

impl<'a> From<&'a Model> for ModelEntry<'a> {
    fn from(model: &'a Model) -> Self {
        let shape = match &model.shape {
            Shape::Stl { path, unit_mm } => ShapeEntry::Stl { path, unit_mm: *unit_mm },
            Shape::Box { size_mm } => ShapeEntry::Box(array(*size_mm)),
            Shape::Cone { base_diameter_mm, top_diameter_mm, length_mm } => ShapeEntry::Cone {
                base_diameter_mm: *base_diameter_mm,
                top_diameter_mm: *top_diameter_mm,
                length_mm: *length_mm,
            },
            Shape::Prism { outline_mm, length_mm } => {
                ShapeEntry::Prism { outline_mm, length_mm: *length_mm }
            }
        };
        Self { name: &model.name, body: model.body, placement: pose(&model.placement), shape }
    }
}

/// The links, errors, sensors, tools and models of a machine.
pub fn description_json(description: &Description<'_>) -> Value {
    document(&DescriptionDocument::from(description))
}
