//! A study of a surface to be probed, read and checked.

use super::points::{points_of, points_of_table};
use super::virtual_probe::{VirtualProbing, read_virtual};
use std::path::{Path, PathBuf};
use trueaxis_cl::{ClFile, Reading};
use trueaxis_geometry::Vec3;
use trueaxis_geometry::surface::Candidates;
use trueaxis_input::plausible::Quantity;
use trueaxis_input::{Diagnostics, Dimension, Files, MeasuredValue, Section, SourceText, Unit};
use trueaxis_machine::Machine;
use trueaxis_machine::file::{machine_of, read_direction, read_tool_shape};
use trueaxis_machine::models::ToolSegment;
use trueaxis_motion::collide::{Mesh, load_stl};

/// More points than this are hours.
const MOST_POINTS: usize = 5000;

/// What is probed, with what, and how carefully.
#[derive(Debug, Clone)]
pub struct SurfaceStudy {
    /// The file as the user named it.
    pub file: String,
    /// In words.
    pub name: String,
    /// The machine.
    pub machine: Machine,
    /// Where it is described.
    pub machine_path: PathBuf,
    /// Where files are read from.
    pub files: Files,
    /// The file of the surface, as it is shown.
    pub surface_file: String,
    /// Where points may be.
    pub candidates: Candidates,
    /// The part, for collisions, if it is stated.
    pub part: Option<Mesh>,
    /// Least distance of two points, mm.
    pub spacing_mm: f64,
    /// Most points.
    pub most_points: usize,
    /// Normals within `facing_rad` of this direction only.
    pub facing: Option<(Vec3, f64)>,
    /// From the spindle to the centre of the ball, mm.
    pub probe_length_mm: f64,
    /// Standard uncertainty of that length, mm, if it is stated.
    pub u_probe_length_mm: Option<f64>,
    /// The number of the probe in the tool table of the control.
    pub tool: u32,
    /// The study of `identify probe` that calibrates the probe, and its stylus.
    pub calibration: Option<(PathBuf, String)>,
    /// Whether the first point is touched again at the end: it shows the drift.
    pub touches_again: bool,
    /// A true machine, probe and surface to be probed at once.
    pub real: Option<VirtualProbing>,
    /// Radius of the ball, mm.
    pub ball_radius_mm: f64,
    /// The probe from the centre of the ball upwards; empty: a slim one.
    pub shape: Vec<ToolSegment>,
    /// Ball to surface before a touch, mm.
    pub stand_off_mm: f64,
    /// How far the touch goes on below the nominal surface, mm.
    pub beyond_mm: f64,
    /// Ball to surface between touches, mm.
    pub clearance_mm: f64,
    /// Of the touch, mm/min.
    pub touch_feed_mm_per_min: f64,
    /// Between touches, mm/min.
    pub feed_mm_per_min: f64,
}

/// Reads a study and the files that it names.
pub fn read_surface(files: &Files, path: &Path) -> (Option<SurfaceStudy>, Diagnostics) {
    let mut problems = Diagnostics::new();
    let Some(text) = files.text(path, "a study of a surface (TOML)", &mut problems) else {
        return (None, problems);
    };
    let file = path.display().to_string();
    let source = SourceText::from(files, &file, &text);
    let study = source.read(|root| read(root, path));
    problems.append(source.finish());
    (study.filter(|_| !problems.has_errors()), problems)
}

fn read(root: &Section<'_>, path: &Path) -> Option<SurfaceStudy> {
    // Every key is asked for before anything is given up, or it would count as unknown.
    let folder = path.parent().unwrap_or(Path::new(""));
    let name = root.require("name", "say which surface").and_then(|i| i.text());
    let machine = machine_of(root, path);
    let unit_mm = read_unit(root);
    let surface = read_candidates(root, folder, unit_mm);
    let part = root.text("part").map(|name| mesh(root, &folder.join(name), unit_mm));
    let spacing = length(root, "spacing", None);
    let most_points = root.get("most_points").map_or(Some(500), |i| i.count());
    if most_points.is_some_and(|n| !(1..=MOST_POINTS).contains(&n)) {
        let message = format!("most_points is not from 1 to {MOST_POINTS}");
        root.error("bad-count", message, "most_points = 500");
    }
    let facing = root.get("facing").map(|item| read_direction(&item));
    let within = root.quantity("within", Dimension::Angle);
    let probe = root.require("probe", "[probe] length = \"120 mm\", ball_diameter = \"2 mm\"");
    let probe = probe.and_then(|item| item.section("probe", read_probe)).flatten();
    let touches_again = root.get("again").map_or(Some(true), |i| i.flag());
    let (machine_path, machine) = machine?;
    let real = match root.get("virtual") {
        None => None,
        Some(item) => {
            let read = item.section("virtual", |s| read_virtual(s, folder, &machine)).flatten();
            Some(read?)
        }
    };
    let facing = match facing {
        Some(direction) => Some((direction?, within.unwrap_or(80_f64.to_radians()))),
        None => None,
    };
    let surface_file =
        root.get("cl").or(root.get("stl")).or(root.get("table")).and_then(|i| i.as_text());
    let surface_file = folder.join(surface_file.unwrap_or_default()).display().to_string();
    let (candidates, of_surface) = surface?;
    let part = match part {
        Some(stated) => Some(stated?),
        None => of_surface,
    };
    let probe = probe?;
    Some(SurfaceStudy {
        file: path.display().to_string(),
        name: name?.to_owned(),
        machine: machine.with_tip(Vec3::new(0.0, 0.0, -probe.length_mm)),
        files: root.files().clone(),
        machine_path,
        surface_file,
        candidates,
        part,
        spacing_mm: spacing?,
        most_points: most_points?,
        facing,
        probe_length_mm: probe.length_mm,
        u_probe_length_mm: probe.u_length_mm,
        tool: probe.tool,
        calibration: probe.calibration.map(|(file, stylus)| (folder.join(file), stylus)),
        touches_again: touches_again?,
        real,
        ball_radius_mm: probe.ball_radius_mm,
        shape: probe.shape,
        stand_off_mm: probe.stand_off_mm,
        beyond_mm: probe.beyond_mm,
        clearance_mm: probe.clearance_mm,
        touch_feed_mm_per_min: probe.touch_feed,
        feed_mm_per_min: probe.feed,
    })
}

struct Probe {
    length_mm: f64,
    u_length_mm: Option<f64>,
    tool: u32,
    calibration: Option<(String, String)>,
    ball_radius_mm: f64,
    shape: Vec<ToolSegment>,
    stand_off_mm: f64,
    beyond_mm: f64,
    clearance_mm: f64,
    touch_feed: f64,
    feed: f64,
}

fn read_probe(section: &Section<'_>) -> Option<Probe> {
    let length_mm = section.require("length", "length = \"90 ± 0.001 mm\"");
    let length_mm = length_mm.and_then(|item| {
        let found = item.measured_of(Quantity::ToolLength)?;
        if found.value <= 0.0 {
            item.error(
                "not-positive",
                "`length` must be more than 0".to_owned(),
                "such as \"90 mm\"",
            );
            return None;
        }
        Some(found)
    });
    let tool = section.get("tool").map_or(Some(1), |i| i.count());
    let calibration = section.text("calibration").map(str::to_owned);
    let stylus = section.text("stylus").map(str::to_owned);
    let ball = length(section, "ball_diameter", None);
    let stand_off = length(section, "stand_off", Some(2.0));
    let beyond = length(section, "beyond", Some(1.0));
    let clearance = length(section, "clearance", Some(10.0));
    let touch_feed = feed(section, "touch_feed", 100.0);
    let feed = feed(section, "feed", 1500.0);
    let shape = match section.get("shape") {
        Some(_) => read_tool_shape(section)?,
        None => Vec::new(),
    };
    let ball_radius_mm = 0.5 * ball?;
    let MeasuredValue { value: length_mm, u: u_length_mm, .. } = length_mm?;
    let probe = Probe {
        length_mm,
        u_length_mm,
        tool: u32::try_from(tool?).unwrap_or(u32::MAX),
        calibration: calibration.map(|c| (c, stylus.unwrap_or_default())),
        ball_radius_mm,
        shape,
        stand_off_mm: stand_off?,
        // The centre of the ball stays outside: a probe that finds nothing shall not be crushed.
        beyond_mm: beyond?.min(0.9 * ball_radius_mm),
        clearance_mm: clearance?,
        touch_feed: touch_feed?,
        feed: feed?,
    };
    if probe.clearance_mm < probe.stand_off_mm {
        let message = "the clearance is less than the stand-off".to_owned();
        section.error("bad-size", message, "clearance = \"10 mm\", stand_off = \"2 mm\"");
        return None;
    }
    Some(probe)
}

fn length(section: &Section<'_>, key: &str, default: Option<f64>) -> Option<f64> {
    let item = match (section.get(key), default) {
        (Some(item), _) => item,
        (None, Some(value)) => return Some(value),
        (None, None) => section.require(key, &format!("{key} = \"2 mm\""))?,
    };
    let value = item.quantity(Dimension::Length)?;
    if value <= 0.0 {
        item.error("not-positive", format!("`{key}` must be more than 0"), "such as \"2 mm\"");
        return None;
    }
    Some(value)
}

fn feed(section: &Section<'_>, key: &str, default: f64) -> Option<f64> {
    let Some(item) = section.get(key) else { return Some(default) };
    let value = item.quantity(Dimension::Velocity)? * 60.0;
    if value <= 0.0 {
        item.error(
            "not-positive",
            format!("`{key}` must be more than 0"),
            "such as \"100 mm/min\"",
        );
        return None;
    }
    Some(value)
}

fn read_unit(root: &Section<'_>) -> f64 {
    let Some(item) = root.get("unit") else { return 1.0 };
    let found = item.text().map(|text| Unit::find(text, Dimension::Length));
    match found {
        Some(Ok(unit)) => unit.to_inner(1.0),
        Some(Err(e)) => {
            item.error(e.code(), e.to_string(), &e.hint());
            1.0
        }
        None => 1.0,
    }
}

fn mesh(root: &Section<'_>, path: &Path, unit_mm: f64) -> Option<Mesh> {
    let mut found = Diagnostics::new();
    let mesh = load_stl(root.files(), path, unit_mm, &mut found);
    root.take_over(found);
    mesh
}

/// The candidates, and the part if the surface itself is one.
fn read_candidates(
    root: &Section<'_>,
    folder: &Path,
    unit_mm: f64,
) -> Option<(Candidates, Option<Mesh>)> {
    let (cl, stl, table) = (root.get("cl"), root.get("stl"), root.get("table"));
    let lean = root.quantity("lean", Dimension::Angle);
    let towards = root.get("towards").map(|item| read_direction(&item));
    let normals = root.get("normals");
    let are_normals = match normals.map(|item| (item, item.text())) {
        None => false,
        Some((_, Some("axis"))) => true,
        Some((_, Some("neighbours"))) => false,
        Some((item, text)) => {
            let message = format!("`{}` is not known here", text.unwrap_or_default());
            let hint = "\"axis\" (the tool axis is the normal) or \"neighbours\" (default)";
            item.error("unknown-word", message, hint);
            return None;
        }
    };
    match (cl, stl, table) {
        (None, None, Some(item)) => {
            let path = folder.join(item.text()?);
            let mut found = Diagnostics::new();
            let text = root.files().text(&path, "a table of points and normals (CSV)", &mut found);
            let points = text.and_then(|text| {
                let file = path.display().to_string();
                points_of_table(&file, &text, &mut found)
            });
            root.take_over(found);
            let up = match towards {
                Some(stated) => stated?,
                None => Vec3::z(),
            };
            let mut points = points?;
            let (s, c) = lean.unwrap_or(0.0).sin_cos();
            for point in &mut points {
                let across = up - point.normal * up.dot(&point.normal);
                if let Some(across) = across.try_normalize(1e-9) {
                    point.axis = point.normal * c + across * s;
                }
            }
            Some((Candidates::Points { points, are_normals: true }, None))
        }
        (Some(item), None, None) => {
            let path = folder.join(item.text()?);
            let mut found = Diagnostics::new();
            let bytes = root.files().bytes(&path, "a cutter-location file", &mut found);
            let read = bytes.map(|b| {
                let reading = Reading::default();
                ClFile::read(&path.display().to_string(), b, &reading)
            });
            let file = read.map(|(file, problems)| {
                found.append(problems);
                file
            });
            root.take_over(found);
            let candidates = points_of(&file?, are_normals);
            if matches!(&candidates, Candidates::Points { points, .. } if points.is_empty()) {
                item.error("no-points", "the file has no point in feed".to_owned(), "");
                return None;
            }
            Some((candidates, None))
        }
        (None, Some(item), None) => {
            let mesh = mesh(root, &folder.join(item.text()?), unit_mm)?;
            Some((Candidates::Facets(mesh.triangles().to_vec()), Some(mesh)))
        }
        _ => {
            let message = "the surface comes from one file: `cl`, `stl` or `table`".to_owned();
            let hint = "cl = \"part.cls\", stl = \"part.stl\" or table = \"points.csv\"";
            root.error("missing-key", message, hint);
            None
        }
    }
}
