//! The machine file: from text to a checked [`Machine`], with all problems reported at once.

mod chain_text;
mod equipment_text;
mod error_text;
mod geometry_check;
mod heat_text;
mod joint_text;
mod known_text;
mod model_text;
mod place_text;
mod table_text;

pub use chain_text::ChainText;
pub use known_text::KnownRow;
pub use model_text::{compare_with_shape, read_shape, read_tool_shape};
pub use place_text::{read_direction, read_pose, read_tip, read_vector_mm};

use crate::active::read_active;
use crate::axis::{Axis, AxisKind, Limits, Travel, iso_841_direction, iso_841_sense};
use crate::chain::{ChainBody, ErrorFrame, ErrorModel, Machine, Squareness};
use crate::errors::{BodyName, Rotation};
use crate::tool::ToolAssembly;
use std::path::{Path, PathBuf};
use trueaxis_geometry::Vec3;
use trueaxis_input::plausible::Quantity;
use trueaxis_input::{Diagnostics, Dimension, Files, Item, Section, SourceText};

/// Where the tables that a machine file names come from; this crate opens no file.
pub trait Tables {
    /// The text of a table by the name that the machine file gives it.
    ///
    /// # Errors
    /// A sentence that states why it cannot be read.
    fn text(&self, name: &str) -> Result<String, String>;

    /// How to show the table to the user.
    fn display(&self, name: &str) -> String {
        name.to_owned()
    }
}

/// No tables: for machine files that state all errors themselves.
#[derive(Debug, Clone, Copy)]
pub struct NoTables;

impl Tables for NoTables {
    fn text(&self, _name: &str) -> Result<String, String> {
        Err("this reader has no access to tables".into())
    }
}

/// The tables beside a machine file.
#[derive(Debug, Clone)]
pub struct Folder {
    files: Files,
    path: PathBuf,
}

impl Folder {
    /// The folder of a file.
    pub fn of(files: &Files, file: &Path) -> Self {
        let path = file.parent().unwrap_or(Path::new("")).to_owned();
        Self { files: files.clone(), path }
    }
}

impl Tables for Folder {
    fn text(&self, name: &str) -> Result<String, String> {
        self.files.read_text(&self.path.join(name)).map_err(|e| e.to_string())
    }

    fn display(&self, name: &str) -> String {
        self.path.join(name).display().to_string()
    }
}

/// The machine that a study names by `machine = "…"`, relative to the study file, and its path.
pub fn machine_of(root: &Section<'_>, study: &Path) -> Option<(PathBuf, Machine)> {
    let hint = "the path of the machine file, relative to this file";
    let name = root.require("machine", hint)?.text()?;
    let path = study.parent().unwrap_or(Path::new("")).join(name);
    let (machine, problems) = Machine::read(root.files(), &path);
    root.take_over(problems);
    Some((path, machine?))
}

impl Machine {
    /// Reads and checks a machine file with the tables that it names.
    pub fn read(files: &Files, path: &Path) -> (Option<Self>, Diagnostics) {
        let mut problems = Diagnostics::new();
        let Some(text) = files.text(path, "a machine file (TOML)", &mut problems) else {
            return (None, problems);
        };
        Self::check(&path.display().to_string(), &text, &Folder::of(files, path))
    }

    /// Checks a machine file and everything that it names.
    ///
    /// Returns the machine if there was no error, and everything that was found, with its place.
    ///
    /// ```
    /// use trueaxis_machine::{Machine, file::NoTables};
    /// let text = r#"
    ///     [machine]
    ///     name = "three axes"
    ///     chain = "w b X Y Z t"
    ///     [axis.X]
    ///     travel = ["0 mm", "500 mm"]
    ///     [tool]
    ///     length = "100 mm"
    ///     [location]
    ///     EC0Y = "10 urad"
    /// "#;
    /// let (machine, problems) = Machine::check("machine.toml", text, &NoTables);
    /// assert!(!problems.has_errors());
    /// let machine = machine.unwrap();
    ///
    /// // 10 µrad of squareness at Y = 500 mm move the tool by −5 µm in X.
    /// let command = [0.0, 500.0, 0.0, 0.0, 0.0, 0.0];
    /// let errors = machine.errors_at(&command, &[0.0; 6]).unwrap();
    /// assert!((machine.deviation(&command, &errors).tip_mm.x + 0.005).abs() < 1e-9);
    /// ```
    pub fn check(file: &str, text: &str, tables: &dyn Tables) -> (Option<Self>, Diagnostics) {
        let source = SourceText::new(file, text);
        let machine = source.read(|root| read_machine(root, tables));
        let problems = source.finish();
        (machine.filter(|_| !problems.has_errors()), problems)
    }
}

fn read_machine(root: &Section<'_>, tables: &dyn Tables) -> Option<Machine> {
    let hint = "a machine file begins with [machine], with name and chain";
    root.require("machine", hint);
    let head = root.section("machine", read_head);
    let Some((head, chain)) = head.and_then(|h| h.chain.clone().map(|chain| (h, chain))) else {
        // Without a chain nothing else can be checked; do not call it unknown.
        root.entries();
        return None;
    };
    let frame = head.error_frame;
    let mut bodies = make_bodies(&chain, frame);
    let axes = read_axes(root, &chain, &mut bodies);
    let workpiece = root.section("workpiece", |s| {
        read_workpiece(s, &mut bodies[0]);
        heat_text::read_workpiece_heat(s)
    });
    let last = bodies.len() - 1;
    let tool = root.section("tool", |s| read_tool(s, &mut bodies[last])).unwrap_or_default();
    root.section("location", |s| error_text::read_location(s, &mut bodies));
    root.section("motion", |s| read_motions(s, &axes, &mut bodies, tables));
    let mut heat = heat_text::read_heat(root, &axes, &bodies);
    heat.workpiece = workpiece.flatten();
    let models = model_text::read_models(root, &bodies);
    let active = root.section("compensation", read_active).unwrap_or_default();
    let machine = Machine {
        name: head.name,
        source: head.source,
        axes,
        workpiece_side: chain.workpiece_side + 1,
        bodies,
        model: head.model,
        tip_mm: tool.tip_mm,
        tip_stated: tool.tip_stated,
        tools: tool.assemblies,
        models,
        heat,
        growth: None,
        active,
        equipment: equipment_text::read_equipment(root),
        joint: None,
        influences: Default::default(),
    };
    let joint = root.section("uncertainty", |s| joint_text::read_joint(s, &machine, tables));
    let machine = match joint.flatten() {
        Some(joint) => machine.with_joint(joint),
        None => machine,
    };
    if let Some(item) = head.chain_item {
        geometry_check::warn_about_directions(&machine, &item);
    }
    Some(machine)
}

struct Head<'s> {
    chain_item: Option<Item<'s>>,
    name: String,
    source: String,
    chain: Option<ChainText>,
    model: ErrorModel,
    error_frame: ErrorFrame,
}

fn read_head<'s>(section: &Section<'s>) -> Head<'s> {
    let name = section.require("name", "give the machine a name").and_then(|i| i.text());
    let hint = "write the bodies in order, such as chain = \"w C' A' b X Y Z t\"";
    let chain_item = section.require("chain", hint);
    let chain = chain_item.and_then(|item| {
        let chain = ChainText::parse(item.text()?);
        match &chain {
            Err(fault) => item.error("bad-chain", fault.clone(), hint),
            Ok(ChainText { notice: Some(notice), .. }) => {
                let long = chain.as_ref().map_or(String::new(), ChainText::long_form);
                item.warn("assumed-chain", notice.clone(), &format!("long form: {long}"));
            }
            Ok(_) => {}
        }
        chain.ok()
    });
    let rotation = choice(
        section,
        "rotation",
        &[("exact", Rotation::Exact), ("small-angle", Rotation::SmallAngle)],
    );
    let squareness = choice(
        section,
        "squareness",
        &[("carried", Squareness::Carried), ("direction", Squareness::Direction)],
    );
    Head {
        chain_item,
        name: name.unwrap_or_default().to_owned(),
        source: section.text("source").unwrap_or_default().to_owned(),
        chain,
        model: ErrorModel {
            rotation: rotation.unwrap_or_default(),
            squareness: squareness.unwrap_or_default(),
        },
        error_frame: read_error_frame(section).unwrap_or_default(),
    }
}

fn read_error_frame(section: &Section<'_>) -> Option<ErrorFrame> {
    choice(section, "error_frame", &[("fixed", ErrorFrame::Fixed), ("moving", ErrorFrame::Moving)])
}

fn choice<T: Copy>(section: &Section<'_>, key: &str, words: &[(&str, T)]) -> Option<T> {
    let item = section.get(key)?;
    let text = item.text()?;
    let found = words.iter().find(|(word, _)| *word == text).map(|(_, value)| *value);
    if found.is_none() {
        let known = words.iter().map(|(word, _)| *word).collect::<Vec<_>>().join(" or ");
        item.error("unknown-word", format!("unknown {key} `{text}`"), &format!("write {known}"));
    }
    found
}

fn make_bodies(chain: &ChainText, frame: ErrorFrame) -> Vec<ChainBody> {
    let mut bodies = vec![ChainBody::new(BodyName::WORKPIECE, None)];
    for (i, name) in chain.axes.iter().enumerate() {
        let mut body = ChainBody::new(*name, Some(i));
        body.error_frame = frame;
        bodies.push(body);
    }
    bodies.push(ChainBody::new(BodyName::TOOL, None));
    bodies
}

fn read_axes(root: &Section<'_>, chain: &ChainText, bodies: &mut [ChainBody]) -> Vec<Axis> {
    let mut axes: Vec<Axis> = Vec::new();
    for (i, &name) in chain.axes.iter().enumerate() {
        let carries = chain.carries(i);
        axes.push(Axis {
            name,
            kind: if name.is_rotary() { AxisKind::Rotary } else { AxisKind::Linear },
            direction: iso_841_direction(name),
            carries,
            sense: iso_841_sense(carries),
            travel: Travel::Unknown,
            limits: Limits::default(),
        });
    }
    root.section("axis", |section| {
        for (key, place, item) in section.entries() {
            let found = axes.iter().position(|a| a.name.to_string() == key);
            let Some(i) = found else {
                let message = format!("the chain has no axis {key}");
                let hint = format!("its axes: {}", chain.long_form());
                section.error_at(place, "unknown-axis", message, &hint);
                continue;
            };
            item.section(&section.path(key), |s| read_axis(s, &mut axes[i], &mut bodies[i + 1]));
        }
    });
    axes
}

fn read_axis(section: &Section<'_>, axis: &mut Axis, body: &mut ChainBody) {
    if let Some(pose) = section.get("placement").and_then(|i| read_pose(&i)) {
        body.placement = pose;
    }
    if let Some(direction) = section.get("direction").and_then(|i| read_direction(&i)) {
        axis.direction = direction;
    }
    if let Some(item) = section.get("sense") {
        match item.number() {
            None => {}
            Some(sense) if sense.abs() == 1.0 => axis.sense = sense,
            Some(_) => item.error(
                "bad-sense",
                "the sense of an axis must be 1 or -1".into(),
                "1: a positive command moves the body in the positive direction; without this \
                 entry ISO 841 applies",
            ),
        }
    }
    if let Some(frame) = read_error_frame(section) {
        body.error_frame = frame;
        if axis.kind == AxisKind::Linear {
            let message = format!("{} is not a rotary axis: error_frame has no effect", axis.name);
            section.warn("no-effect", message, "remove the entry");
        }
    }
    if let Some(travel) = section.get("travel").and_then(|i| read_travel(&i, axis.kind)) {
        axis.travel = travel;
    }
    use Dimension as D;
    let [velocity, acceleration, jerk] = match axis.kind {
        AxisKind::Linear => [D::Velocity, D::Acceleration, D::Jerk],
        AxisKind::Rotary => [D::AngularVelocity, D::AngularAcceleration, D::AngularJerk],
    };
    axis.limits = Limits {
        velocity: positive(section, "max_velocity", velocity),
        acceleration: positive(section, "max_acceleration", acceleration),
        jerk: positive(section, "max_jerk", jerk),
    };
}

fn positive(section: &Section<'_>, key: &str, dimension: Dimension) -> Option<f64> {
    let item = section.get(key)?;
    above_zero(&item, item.quantity(dimension)?, key)
}

fn above_zero(item: &Item<'_>, value: f64, key: &str) -> Option<f64> {
    if value <= 0.0 {
        let hint = "remove the entry if the value is not known";
        item.error("not-positive", format!("`{key}` must be above zero"), hint);
        return None;
    }
    Some(value)
}

fn read_travel(item: &Item<'_>, kind: AxisKind) -> Option<Travel> {
    let hint =
        "write [from, to], such as [\"0 mm\", \"6200 mm\"], or \"unlimited\" for a rotary axis";
    if !item.is_list() {
        if item.as_text() == Some("unlimited") && kind == AxisKind::Rotary {
            return Some(Travel::Unlimited);
        }
        item.error("bad-travel", "the travel must be two positions".into(), hint);
        return None;
    }
    let quantity = match kind {
        AxisKind::Linear => Quantity::Length,
        AxisKind::Rotary => Quantity::RotaryPosition,
    };
    let ends = item.list()?;
    let [from, to] = &ends[..] else {
        item.error("bad-travel", "the travel must be two positions".into(), hint);
        return None;
    };
    let (from, to) = (from.quantity_of(quantity), to.quantity_of(quantity));
    let (from, to) = (from?, to?);
    if from >= to {
        item.error("bad-travel", "the end of the travel is not above its start".into(), hint);
        return None;
    }
    Some(Travel::Between(from, to))
}

fn read_workpiece(section: &Section<'_>, body: &mut ChainBody) {
    if let Some(pose) = section.get("placement").and_then(|i| read_pose(&i)) {
        body.placement = pose;
    }
    if let Some(pose) = section.get("mounting").and_then(|i| read_pose(&i)) {
        body.mounting = pose;
    }
}

#[derive(Default)]
struct ToolSide {
    tip_mm: Vec3,
    tip_stated: bool,
    assemblies: Vec<ToolAssembly>,
}

fn read_tool(section: &Section<'_>, body: &mut ChainBody) -> ToolSide {
    if let Some(pose) = section.get("placement").and_then(|i| read_pose(&i)) {
        body.placement = pose;
    }
    let length = section.quantity_of("length", Quantity::ToolLength);
    let tip = section.get("tip").and_then(|i| read_tip(&i));
    if length.is_some() && tip.is_some() {
        let message = "`length` and `tip` both state the position of the tip".to_owned();
        section.error("duplicate-tip", message, "keep one of them");
    }
    let tip_stated = length.is_some() || tip.is_some();
    let tip_mm = tip.unwrap_or(Vec3::new(0.0, 0.0, -length.unwrap_or(0.0)));
    let mut assemblies = Vec::new();
    section.section("library", |library| {
        for (name, _, item) in library.entries() {
            let path = library.path(name);
            if let Some(Some(tool)) = item.section(&path, |s| read_assembly(name, s)) {
                assemblies.push(tool);
            }
        }
    });
    ToolSide { tip_mm, tip_stated, assemblies }
}

fn read_assembly(name: &str, section: &Section<'_>) -> Option<ToolAssembly> {
    let length = section
        .require("length", "write the distance from the gauge line to the tip, such as \"100 mm\"");
    let diameter_mm = section
        .get("diameter")
        .and_then(|i| above_zero(&i, i.quantity_of(Quantity::Diameter)?, "diameter"));
    let corner_radius_mm = section.get("corner_radius").and_then(|item| {
        let radius = item.quantity(Dimension::Length)?;
        let largest = diameter_mm.map_or(f64::INFINITY, |d| 0.5 * d * (1.0 + 1e-12));
        if !(0.0..=largest).contains(&radius) {
            let message = "the corner radius must be between zero and half the diameter".to_owned();
            item.error(
                "bad-tool",
                message,
                "write half the diameter for a ball-nose tool, 0 for a sharp corner",
            );
        }
        Some(radius)
    });
    let holder = section.text("holder").map(str::to_owned);
    let shape = model_text::read_tool_shape(section).unwrap_or_default();
    model_text::compare_with_shape(section, diameter_mm, &shape);
    let length_mm = length?.quantity_of(Quantity::ToolLength)?;
    let name = name.to_owned();
    Some(ToolAssembly { name, length_mm, diameter_mm, corner_radius_mm, holder, shape })
}

fn read_motions(
    section: &Section<'_>,
    axes: &[Axis],
    bodies: &mut [ChainBody],
    tables: &dyn Tables,
) {
    for (key, place, item) in section.entries() {
        let Some(i) = axes.iter().position(|a| a.name.to_string() == key) else {
            let message = format!("the chain has no axis {key}");
            section.error_at(
                place,
                "unknown-axis",
                message,
                "[motion] needs the letter of an axis of the chain",
            );
            continue;
        };
        item.section(&section.path(key), |s| {
            error_text::read_motion(s, &axes[i], &mut bodies[i + 1], tables);
        });
    }
}
