//! The coordinate systems of a machine in the sense of Jiang et al.: simulation space, part program, nodes, models.

use serde::Serialize;
use trueaxis_geometry::Vec3;
use trueaxis_geometry::frame::{Bed, Body, Pose};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::Command;
use trueaxis_machine::errors::ErrorValues;
use trueaxis_report::JsonSchema;
use trueaxis_report::numbers::fixed;
use trueaxis_report::{Section, Table};

/// A coordinate system of the machine with all axes at 0, without errors, in the machine frame (SCS).
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct FrameEntry {
    /// `SCS`: simulation space, the machine frame. `PCS`: part program, the workpiece frame without a work offset.
    /// `NCS`: node, a body of the chain. `UCS`: model.
    pub frame: &'static str,
    /// The body that it belongs to; `b` is the bed.
    pub body: String,
    /// The name of the model; absent for other frames.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub model: Option<String>,
    /// Its origin.
    pub origin_mm: [f64; 3],
    /// Its x axis, a unit vector. Unit: 1.
    pub x: [f64; 3],
    /// Its y axis, a unit vector. Unit: 1.
    pub y: [f64; 3],
    /// Its z axis, a unit vector. Unit: 1.
    pub z: [f64; 3],
}

impl FrameEntry {
    fn new(frame: &'static str, body: &str, model: Option<&str>, pose: &Pose<Bed, Body>) -> Self {
        let [x, y, z] = [Vec3::x(), Vec3::y(), Vec3::z()].map(|e| clean(pose.linear() * e));
        let origin_mm = clean(*pose.shift_mm());
        Self { frame, body: body.to_owned(), model: model.map(str::to_owned), origin_mm, x, y, z }
    }
}

/// Every coordinate system of the machine: SCS, PCS, one NCS for each body from the workpiece to the tool, one
/// UCS for each model.
pub fn frames(machine: &Machine) -> Vec<FrameEntry> {
    let poses = machine.body_poses(&Command::default(), &ErrorValues::default());
    let bodies = machine.bodies();
    let names: Vec<String> = bodies.iter().map(|b| b.name.to_string()).collect();
    let mut found = vec![FrameEntry::new("SCS", "b", None, &Pose::identity())];
    let nodes = names.iter().zip(&poses);
    found.extend(nodes.clone().take(1).map(|(n, p)| FrameEntry::new("PCS", n, None, p)));
    found.extend(nodes.map(|(n, p)| FrameEntry::new("NCS", n, None, p)));
    found.extend(machine.models().iter().map(|model| {
        let node = model.body.map_or(Pose::identity(), |body| poses[body]);
        let body = model.body.map_or("b", |body| names[body].as_str());
        FrameEntry::new("UCS", body, Some(&model.name), &(node * model.placement.relabel()))
    }));
    found
}

/// The coordinate systems as a table.
pub fn frames_section(machine: &Machine) -> Section<'static> {
    let rows = frames(machine).into_iter().map(|f| {
        let name = f.model.map_or(f.body.clone(), |model| format!("{} {model}", f.body));
        let numbers = [f.origin_mm.map(|v| fixed(v, 4))];
        let axes = [f.x, f.y, f.z].map(|axis| axis.map(|v| fixed(v, 6)).join(" "));
        [f.frame.to_owned(), name].into_iter().chain(numbers.into_iter().flatten()).chain(axes)
    });
    let headings = ["frame", "of", "x mm", "y mm", "z mm", "x axis", "y axis", "z axis"];
    Section::new("Coordinate systems in the machine frame, all axes at 0")
        .table(Table::new(headings).rows(rows))
        .paragraph(
            "SCS: simulation space, the machine frame. PCS: part program; the work offset of a program is added \
             to it. NCS: node, a body of the chain. UCS: model.",
        )
}

/// Without a minus before a zero.
fn clean(v: Vec3) -> [f64; 3] {
    [v.x, v.y, v.z].map(|number| number + 0.0)
}
