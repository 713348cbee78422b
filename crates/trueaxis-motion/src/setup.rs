//! The set-up: what is on the machine and what is set at the control.
//!
//! Work offsets, tools and the start of the axes come from a set-up file (TOML), with nothing
//! assumed but zeros where it is silent.

mod codes;
mod cutter;
mod setter;
mod tool_state;

pub use cutter::CutterShape;
pub use setter::ToolSetter;
pub use tool_state::{LifeBy, MeasuredSize, ToolLife, ToolState};

use super::collide::{BodyModel, Mesh, Role, ToolShape, load_stl, triangles_of};
use std::collections::BTreeMap;
use std::path::Path;
use trueaxis_geometry::Vec3;
use trueaxis_input::plausible::Quantity;
use trueaxis_input::{Diagnostics, Dimension, Files, Item, Place, Section, SourceText};
use trueaxis_machine::Machine;
use trueaxis_machine::chain::Link;
use trueaxis_machine::file::{
    compare_with_shape, read_pose, read_shape, read_tip, read_tool_shape,
};
use trueaxis_machine::models::{Shape, ToolSegment};
use trueaxis_nc::moves::{Axis, Frame, Position};
use trueaxis_nc::{Control, OwnCode, Program, Settings, sinumerik};

/// A tool of the set-up.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SetUpTool {
    /// Its name in the program or the tool library.
    pub name: String,
    /// The tip in the frame of the tool holder, mm: (0, 0, −length).
    pub tip_mm: Vec3,
    /// Cutting diameter, mm, if stated.
    pub diameter_mm: Option<f64>,
    /// What the control offsets by with radius compensation, mm, if it is not half of the diameter.
    pub radius_offset_mm: Option<f64>,
    /// Radius of the corner, mm.
    pub corner_radius_mm: f64,
    /// Its cylinders from the tip upwards, the cutter first; empty: a cylinder of its diameter.
    pub shape: Vec<ToolSegment>,
    /// The shape of its cutting part, if it is more than diameter and corner radius.
    pub cutter: Option<CutterShape>,
    /// What is known of its wear and its life.
    pub state: ToolState,
}

impl SetUpTool {
    /// Its shape; `None` if neither shape nor diameter is stated.
    pub fn tool_shape(&self) -> Option<ToolShape> {
        let mut segments = self.shape.clone();
        if segments.is_empty() {
            let length_mm = -self.tip_mm.z;
            let diameter_mm = self.diameter_mm.filter(|_| length_mm > 0.0)?;
            segments.push(ToolSegment { diameter_mm, length_mm });
        }
        let corner_radius_mm = self.corner_radius_mm;
        Some(ToolShape { tip_mm: self.tip_mm, segments, corner_radius_mm })
    }
}

/// When bodies count as too near.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Nearness {
    /// Nearer than this is a near miss, mm.
    pub clearance_mm: f64,
    /// See [`Scene::sweep`](super::collide::Scene::sweep), mm.
    pub resolution_mm: f64,
}

impl Default for Nearness {
    fn default() -> Self {
        Self { clearance_mm: 1.0, resolution_mm: 0.5 }
    }
}

/// What is on the machine and what is set at the control.
#[derive(Debug, Clone, Default)]
pub struct SetUp {
    /// Whether there is a set-up file; without one offsets and lengths are 0.
    pub given: bool,
    /// Where subprograms are read from.
    pub files: Files,
    /// Whose program it is, if stated.
    pub control: Option<Control>,
    /// Work offsets by number, from 1 for G54.
    pub work_offsets: BTreeMap<u32, Frame>,
    /// Tools by number.
    pub tools: BTreeMap<u32, SetUpTool>,
    /// Where tools are measured.
    pub setter: Option<ToolSetter>,
    /// Where the file states the tools.
    pub tool_places: BTreeMap<u32, Place>,
    /// Whether moves with radius compensation are those of the contour, not of the centre of the tool.
    pub on_contour: bool,
    /// Whether optional blocks, `/`, are left out.
    pub without_optional: bool,
    /// What codes and programs of the machine builder do, by their names in capital letters.
    pub codes: BTreeMap<String, OwnCode>,
    /// Where the set-up file states them.
    pub code_places: BTreeMap<String, Place>,
    /// Where the axes are before the program, mm and degrees.
    pub start: Option<Position>,
    /// The work offset whose program zero is the workpiece frame of all results.
    pub workpiece_at: Option<u32>,
    /// Stock, fixtures and part, on the workpiece.
    pub bodies: Vec<BodyModel>,
    /// How finely the stock is kept, if stated, mm.
    pub stock_resolution_mm: Option<f64>,
    /// When bodies count as too near.
    pub nearness: Nearness,
}

/// Reads a set-up file for a machine; all problems at once.
///
/// ```no_run
/// # let files = trueaxis_input::Files::none();
/// let (machine, _) = trueaxis_machine::Machine::read(&files, "machines/i5-engraver/machine.toml".as_ref());
/// let path = "examples/02_simulate/ring-fanuc.setup.toml".as_ref();
/// let (setup, problems) = trueaxis_motion::read_setup(&files, path, &machine.unwrap());
/// assert!(!problems.has_errors() && setup.unwrap().given);
/// ```
pub fn read_setup(files: &Files, path: &Path, machine: &Machine) -> (Option<SetUp>, Diagnostics) {
    let mut problems = Diagnostics::new();
    let Some(text) = files.text(path, "a set-up file (TOML)", &mut problems) else {
        return (None, problems);
    };
    let folder = path.parent().unwrap_or(Path::new(""));
    let setup =
        problems.keep(parse_setup(files, &path.display().to_string(), &text, folder, machine));
    (setup, problems)
}

/// Reads the text of a set-up file; the files that it names lie in a folder.
pub fn parse_setup(
    files: &Files,
    file: &str,
    text: &str,
    folder: &Path,
    machine: &Machine,
) -> (Option<SetUp>, Diagnostics) {
    let source = SourceText::from(files, file, text);
    let setup = source.read(|root| read(root, machine, folder));
    let problems = source.finish();
    (Some(setup).filter(|_| !problems.has_errors()), problems)
}

fn read(root: &Section<'_>, machine: &Machine, folder: &Path) -> SetUp {
    let mut setup = SetUp { given: true, files: root.files().clone(), ..SetUp::default() };
    setup.control = root.get("control").and_then(|item| read_control(&item));
    root.text("name");
    root.section("work_offset", |section| {
        for (key, place, item) in section.entries() {
            let Some(number) = offset_number(key) else {
                let message = format!("`{key}` is not a work offset");
                let hint = "G54 to G59, G59.1, G54.1P7, G505 to G599, or its number";
                section.error_at(place, "bad-work-offset", message, hint);
                continue;
            };
            if let Some(frame) = item.section(key, read_offset) {
                setup.work_offsets.insert(number, frame);
            }
        }
    });
    root.section("tool", |section| {
        for (key, place, item) in section.entries() {
            let Ok(number) = key.parse::<u32>() else {
                let message = format!("`{key}` is not a tool number");
                section.error_at(place, "bad-tool", message, "[tool.1] with name and length");
                continue;
            };
            if let Some(Some(tool)) = item.section(key, |s| read_tool(s, machine)) {
                setup.tools.insert(number, tool);
                setup.tool_places.insert(number, place);
            }
        }
        check_sisters(section, &setup);
    });
    setup.setter = root.section("tool_setter", setter::read_setter).flatten();
    check_reference(root, &setup);
    root.section("codes", |section| {
        (setup.codes, setup.code_places) = codes::read(section, setup.control);
    });
    if let Some(item) = root.get("archive") {
        read_archive(root, &item, folder, &mut setup);
    }
    (setup.bodies, setup.stock_resolution_mm) = read_bodies(root, folder);
    if let Some(nearness) = root.section("collision", read_nearness) {
        setup.nearness = nearness;
    }
    setup.start = root.section("start", read_position);
    setup.workpiece_at = root.get("workpiece_at").and_then(|item| {
        let number = offset_number(item.text()?);
        if number.is_none() {
            item.error("bad-work-offset", "this is not a work offset".into(), "write \"G54\"");
        }
        number
    });
    setup
}

/// A sister tool must be there, and be another one.
fn check_sisters(section: &Section<'_>, setup: &SetUp) {
    for (number, tool) in &setup.tools {
        let Some(sister) = tool.state.sister else { continue };
        if sister != *number && setup.tools.contains_key(&sister) {
            continue;
        }
        let message = match sister == *number {
            true => format!("tool {number} is named as its own sister"),
            false => format!("the set-up has no tool {sister}, the sister of tool {number}"),
        };
        let place = setup.tool_places.get(number).cloned().unwrap_or_else(|| section.place());
        section.error_at(place, "unknown-tool", message, "name a tool of this file");
    }
}

/// The gauge of the tool setter must be there.
fn check_reference(root: &Section<'_>, setup: &SetUp) {
    let reference = setup.setter.as_ref().and_then(|s| s.reference);
    if let Some(number) = reference.filter(|n| !setup.tools.contains_key(n)) {
        let message = format!("the set-up has no tool {number}, the reference of the tool setter");
        root.error("unknown-tool", message, "name a tool of this file whose length is calibrated");
    }
}

/// `[stock]` with its resolution, `[part]` and every `[[fixture]]`; places in the workpiece frame.
fn read_bodies(root: &Section<'_>, folder: &Path) -> (Vec<BodyModel>, Option<f64>) {
    let (mut bodies, mut resolution_mm) = (Vec::new(), None);
    bodies.extend(root.section("stock", |s| {
        resolution_mm = read_resolution(s);
        read_body(root, s, "stock", Role::Stock, folder)
    }));
    bodies.extend(root.section("part", |s| read_body(root, s, "part", Role::Part, folder)));
    let mut bodies: Vec<BodyModel> = bodies.into_iter().flatten().collect();
    for item in root.get("fixture").and_then(|item| item.list()).unwrap_or_default() {
        let name = format!("fixture {}", bodies.len());
        let read = |s: &Section<'_>| read_body(root, s, &name, Role::Fixture, folder);
        bodies.extend(item.section("fixture", read).flatten());
    }
    (bodies, resolution_mm)
}

fn read_body(
    root: &Section<'_>,
    section: &Section<'_>,
    name: &str,
    role: Role,
    folder: &Path,
) -> Option<BodyModel> {
    let name = section.text("name").unwrap_or(name).to_owned();
    let placement = section.get("placement").map_or(Some(Link::identity()), |i| read_pose(&i))?;
    let mesh = match read_shape(section)? {
        Shape::Stl { path, unit_mm } => {
            let mut problems = Diagnostics::new();
            let mesh = load_stl(section.files(), &folder.join(path), unit_mm, &mut problems);
            root.take_over(problems);
            mesh?
        }
        shape => triangles_of(&shape).and_then(Mesh::new)?,
    };
    // The workpiece is the first body of the chain.
    Some(BodyModel { name, node: Some(0), placement, role, mesh })
}

/// `resolution = "0.5 mm"` of `[stock]`.
fn read_resolution(section: &Section<'_>) -> Option<f64> {
    let item = section.get("resolution")?;
    let value = item.quantity(Dimension::Length)?;
    if value <= 0.0 {
        item.error("bad-stock", format!("{value} mm is not a resolution"), "such as \"0.5 mm\"");
        return None;
    }
    Some(value)
}

fn read_nearness(section: &Section<'_>) -> Nearness {
    let usual = Nearness::default();
    let length = |key: &str, usual: f64| {
        let value = section.quantity(key, Dimension::Length).unwrap_or(usual);
        if value < 0.0 || (key == "resolution" && value < 1e-3) {
            let message = format!("{value} mm is not a {key}");
            section.error("bad-collision", message, "such as clearance = \"1 mm\"");
        }
        value.max(0.0)
    };
    Nearness {
        clearance_mm: length("clearance", usual.clearance_mm),
        resolution_mm: length("resolution", usual.resolution_mm).max(1e-3),
    }
}

/// Work offsets and tools of a SINUMERIK dump; what the set-up file itself states has priority.
fn read_archive(root: &Section<'_>, item: &Item<'_>, folder: &Path, setup: &mut SetUp) {
    let Some(name) = item.text() else { return };
    let path = folder.join(name);
    let bytes = match root.files().read(&path) {
        Ok(bytes) => bytes,
        Err(error) => {
            let message = format!("`{name}` cannot be read: {error}");
            item.error("unreadable-file", message, "expected a dump such as INITIAL.INI here");
            return;
        }
    };
    let (archive, problems) = sinumerik::read_archive(&path.display().to_string(), &bytes);
    root.take_over(problems);
    for (number, frame) in archive.work_offsets {
        setup.work_offsets.entry(number).or_insert(frame);
    }
    for (number, tool) in archive.tools {
        let length = &tool.length_mm.0;
        setup.tools.entry(number).or_insert(SetUpTool {
            name: tool.name,
            tip_mm: -Vec3::new(length[0], length[1], length[2]),
            diameter_mm: Some(2.0 * tool.radius_mm).filter(|d| *d > 0.0),
            radius_offset_mm: Some(tool.radius_mm),
            corner_radius_mm: tool.corner_radius_mm,
            shape: Vec::new(),
            state: ToolState::default(),
            cutter: None,
        });
    }
}

fn read_control(item: &Item<'_>) -> Option<Control> {
    let text = item.text()?;
    let control = control_named(text);
    if control.is_none() {
        let message = format!("unknown control `{text}`");
        item.error("unknown-control", message, CONTROLS);
    }
    control
}

/// The names of the controls, for hints.
pub const CONTROLS: &str = "sinumerik, fanuc, haas, linuxcnc or heidenhain";

/// The control by its name, upper or lower case.
pub fn control_named(name: &str) -> Option<Control> {
    match name.to_ascii_lowercase().as_str() {
        "sinumerik" | "sinumerik 840d" | "840d" | "siemens" => Some(Control::Sinumerik840d),
        "fanuc" => Some(Control::Fanuc),
        "haas" => Some(Control::Haas),
        "linuxcnc" => Some(Control::LinuxCnc),
        "heidenhain" | "klartext" => Some(Control::Heidenhain),
        _ => None,
    }
}

/// The number of a work offset by its name: G54 is 1, G59.3 is 9, G54.1P1 is 10; SINUMERIK's G505
/// is 5.
fn offset_number(name: &str) -> Option<u32> {
    let name = name.to_ascii_uppercase().replace(' ', "");
    if let Ok(number) = name.parse::<u32>() {
        return Some(number);
    }
    let code = name.strip_prefix('G')?;
    if let Some(further) = code.strip_prefix("54.1P") {
        return further.parse::<u32>().ok().filter(|p| (1..=300).contains(p)).map(|p| p + 9);
    }
    match code {
        "59.1" => Some(7),
        "59.2" => Some(8),
        "59.3" => Some(9),
        _ => match code.parse::<u32>().ok()? {
            code @ 54..=59 => Some(code - 53),
            code @ 505..=599 => Some(code - 500),
            _ => None,
        },
    }
}

fn read_position(section: &Section<'_>) -> Position {
    let mut position = Position::default();
    for axis in Axis::ALL {
        let dimension = if axis.is_rotary() { Dimension::Angle } else { Dimension::Length };
        if let Some(value) = section.quantity(&axis.to_string(), dimension) {
            position[axis] = if axis.is_rotary() { value.to_degrees() } else { value };
        }
    }
    position
}

fn read_offset(section: &Section<'_>) -> Frame {
    let mut frame = Frame::shifted(read_position(section));
    if let Some(turn) = section.get("turn").and_then(|item| read_pose(&item)) {
        let linear = turn.linear();
        frame.linear = std::array::from_fn(|i| std::array::from_fn(|j| linear[(i, j)]));
    }
    frame
}

fn read_tool(section: &Section<'_>, machine: &Machine) -> Option<SetUpTool> {
    let mut tool = SetUpTool::default();
    if let Some(item) = section.get("assembly") {
        let name = item.text()?;
        let Some(found) = machine.tools().iter().find(|t| t.name == name) else {
            let message = format!("the machine file has no tool `{name}`");
            item.error("unknown-tool", message, "name one of its [tool.library], or give length");
            return None;
        };
        tool.name.clone_from(&found.name);
        tool.tip_mm.z = -found.length_mm;
        tool.diameter_mm = found.diameter_mm;
        tool.corner_radius_mm = found.corner_radius_mm.unwrap_or(0.0);
        tool.shape.clone_from(&found.shape);
    }
    if let Some(name) = section.text("name") {
        name.clone_into(&mut tool.name);
    }
    let length = section.quantity_of("length", Quantity::ToolLength);
    if let Some(length_mm) = length {
        tool.tip_mm = Vec3::new(0.0, 0.0, -length_mm);
    }
    if let Some(tip_mm) = section.get("tip").and_then(|item| read_tip(&item)) {
        tool.tip_mm = tip_mm;
    } else if length.is_none() && section.get("assembly").is_none() {
        let message = "the tool has no length".to_owned();
        section.error("missing-value", message, "length = \"100 mm\", or assembly, or tip");
    }
    tool.diameter_mm = section.quantity_of("diameter", Quantity::Diameter).or(tool.diameter_mm);
    if tool.diameter_mm.is_some_and(|d| d <= 0.0) || length.is_some_and(|l| l < 0.0) {
        let message =
            "the diameter of a tool is positive and its length is not negative".to_owned();
        section.error("bad-tool", message, "length = \"100 mm\", diameter = \"10 mm\"");
    }
    tool.radius_offset_mm = section.quantity("radius_offset", Dimension::Length);
    let corner = section.quantity("corner_radius", Dimension::Length);
    tool.corner_radius_mm = corner.unwrap_or(tool.corner_radius_mm);
    if let Some(shape) = read_tool_shape(section) {
        tool.shape = shape;
    }
    if section.get("shape").is_some() || section.get("diameter").is_some() {
        compare_with_shape(section, tool.diameter_mm, &tool.shape);
    }
    tool.cutter = section.section("cutter", cutter::read_cutter).flatten();
    if section.get("cutter").is_some()
        && tool.diameter_mm.is_some()
        && let Err(why) = tool.cutter()
    {
        let hint =
            "cutter = { point = \"118 deg\" }, { side = \"5 deg\" }, { corner_at = \"4 10 mm\" }";
        section.error("bad-tool", format!("the cutter: {why}"), hint);
    }
    tool.state = tool_state::read_state(section);
    Some(tool)
}

impl SetUp {
    /// The settings of the interpreter.
    pub fn settings(&self, keep_going: bool) -> Settings {
        let length = |t: &SetUpTool| {
            let mut length = Position::default();
            length.0[..3].copy_from_slice((-t.tip_mm).as_slice());
            length
        };
        let radius = |t: &SetUpTool| t.radius_offset_mm.or(t.diameter_mm.map(|d| d / 2.0));
        Settings {
            keep_going,
            radii: self.tools.iter().filter_map(|(n, t)| Some((*n, radius(t)?))).collect(),
            on_contour: self.on_contour,
            skipped_blocks_too: !self.without_optional,
            tools: self.tools.iter().map(|(number, t)| (*number, length(t))).collect(),
            tool_names: self.tools.iter().map(|(n, t)| (t.name.clone(), *n)).collect(),
            work_offsets: self.work_offsets.clone(),
            codes: self.codes.clone(),
            ..Settings::default()
        }
    }

    /// The same, but moves with radius compensation are those of the contour.
    #[must_use]
    pub fn on_contour(&self) -> Self {
        Self { on_contour: true, ..self.clone() }
    }

    /// The same, but optional blocks are left out.
    #[must_use]
    pub fn without_optional(&self) -> Self {
        Self { without_optional: true, ..self.clone() }
    }

    /// The machine whose workpiece frame is that of the results.
    pub fn mounted(&self, machine: &Machine) -> Machine {
        let frame = self.workpiece_at.map(|number| self.work_offsets.get(&number));
        match frame {
            None => machine.clone(),
            Some(frame) => super::basic::mount(machine, &frame.copied().unwrap_or(Frame::IDENTITY)),
        }
    }

    /// What a user must know who gave no set-up, and names of codes that the control of the program cannot have.
    pub fn check_for(&self, program: &Program, problems: &mut Diagnostics) {
        if self.control.is_none() {
            for (name, place) in &self.code_places {
                if let Err(hint) = codes::check_name(name, Some(program.dialect().control)) {
                    let message = codes::not_a_name(name, Some(program.dialect().control));
                    problems.error("bad-code", place.clone(), message, hint);
                }
            }
        }
        if !self.given {
            let message = "no set-up file: work offsets and tool lengths are 0, and programs with \
                           tool-centre-point control count from the workpiece frame of the \
                           machine file"
                .to_owned();
            problems.warn(
                "no-set-up",
                Place::whole(program.file()),
                message,
                "give --setup FILE.toml",
            );
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn offsets_have_the_numbers_of_their_controls() {
        let numbers = ["G54", "g59", "G59.3", "G54.1 P2", "G505", "12", "G53", "X"];
        let found = numbers.map(offset_number);
        assert_eq!(found, [Some(1), Some(6), Some(9), Some(11), Some(5), Some(12), None, None]);
    }
}
