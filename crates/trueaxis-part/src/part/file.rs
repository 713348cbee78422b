//! The part file.

mod characteristics;

use super::feature::MOST_POINTS;
use super::{Characteristic, Feature, Geometry, Part};
use characteristics::read_characteristic;
use std::f64::consts::PI;
use std::path::Path;
use trueaxis_geometry::Vec3;
use trueaxis_geometry::surface::SurfacePoint;
use trueaxis_input::{CsvTable, Diagnostics, Dimension, Files, Item, Place, Section, SourceText};

/// How far into and out of the material a feature is checked, unless it says so.
const REACH_MM: f64 = 1.0;
/// The same for a surface of the program: between neighbouring tracks of the tool it is rough.
const PROGRAMMED_MM: f64 = 0.1;

impl Part {
    /// A part file by its path.
    pub fn of_file(files: &Files, path: &Path, problems: &mut Diagnostics) -> Option<Self> {
        let text = files.text(path, "a part file (TOML)", problems)?;
        let name = path.display().to_string();
        let source = SourceText::from(files, &name, &text);
        let folder = path.parent().unwrap_or(Path::new(""));
        let part = source.read(|root| Self::read(root, folder));
        let found = source.finish();
        let sound = !found.has_errors();
        problems.append(found);
        part.filter(|_| sound)
    }

    /// Reads the root of a part file; tables of points are looked for in a folder. Every problem is kept in its source.
    pub fn read(root: &Section<'_>, folder: &Path) -> Option<Self> {
        let name = root.require("name", "write the name of the part").and_then(|i| i.text());
        let source = root.text("source").unwrap_or_default().to_owned();
        let hint = "[feature.top] with plane = { at = \"0 0 0 mm\", normal = \"0 0 1\", size = \"80 60 mm\" }";
        let mut features = Vec::new();
        let mut complete = true;
        if let Some(item) = root.require("feature", hint) {
            item.section("feature", |section| {
                for (key, _, item) in section.entries() {
                    let feature = item.section(key, |s| read_feature(s, key, folder)).flatten();
                    complete &= feature.is_some();
                    features.extend(feature);
                }
            });
        }
        let hint = "[[characteristic]] with flatness = \"20 um\", of = \"top\"";
        let asked = root.require("characteristic", hint).and_then(|i| i.list()).unwrap_or_default();
        let read = |item: &Item<'_>| {
            let one = |s: &Section<'_>| read_characteristic(s, &features, complete);
            item.section("characteristic", one).flatten()
        };
        // All are read before the first failure counts, so that every problem is reported.
        let characteristics: Vec<Option<Characteristic>> = asked.iter().map(read).collect();
        let characteristics: Option<Vec<_>> = characteristics.into_iter().collect();
        let part =
            Self { name: name?.to_owned(), source, features, characteristics: characteristics? };
        (complete && !part.characteristics.is_empty()).then_some(part)
    }
}

fn read_feature(section: &Section<'_>, name: &str, folder: &Path) -> Option<Feature> {
    let kinds = [
        "plane",
        "cylinder",
        "hole",
        "cone",
        "conical_hole",
        "sphere",
        "hollow_sphere",
        "points",
        "programmed",
    ];
    let stated: Vec<(&str, Item<'_>)> =
        kinds.iter().filter_map(|kind| section.get(kind).map(|item| (*kind, item))).collect();
    let [(kind, item)] = stated[..] else {
        let message = format!("feature `{name}` has {} shapes, expected one", stated.len());
        section.error("one-shape", message, &format!("one of {}", kinds.join(", ")));
        return None;
    };
    let letter = section.text("datum").map(str::to_owned);
    let spacing = section.get("spacing").map(|item| positive(&item, "spacing"));
    let usual_mm = if kind == "programmed" { PROGRAMMED_MM } else { REACH_MM };
    let reach = ["below", "above"]
        .map(|key| section.get(key).map_or(Some(usual_mm), |item| positive(&item, key)));
    if kind == "points" {
        let points = item.text().and_then(|file| read_points(section, &folder.join(file)));
        let [below_mm, above_mm] = reach;
        return Some(Feature {
            name: name.to_owned(),
            letter,
            geometry: Geometry::Points,
            points: points?,
            sections: Vec::new(),
            below_mm: below_mm?,
            above_mm: above_mm?,
        });
    }
    let geometry = item.section(kind, |s| read_geometry(s, kind)).flatten()?;
    let spacing_mm = match spacing {
        Some(spacing) => spacing?,
        None => usual_spacing(&geometry),
    };
    let (points, sections) = match geometry.sampled(spacing_mm) {
        Ok(found) => found,
        Err(why) => {
            section.error("too-many-points", why, "write a larger `spacing`");
            return None;
        }
    };
    let openings = openings(section, &geometry)?;
    let is_there = |p: &SurfacePoint| !openings.iter().any(|o| o.contains(&p.point_mm));
    let points: Vec<SurfacePoint> = points.into_iter().filter(is_there).collect();
    if points.is_empty() {
        let message = format!("nothing remains of `{name}` without its openings");
        section.error("no-points", message, "smaller openings, or a smaller `spacing`");
        return None;
    }
    let [below_mm, above_mm] = reach;
    Some(Feature {
        name: name.to_owned(),
        letter,
        geometry,
        points,
        sections,
        below_mm: below_mm?,
        above_mm: above_mm?,
    })
}

/// Where a plane is not: seen along its normal a circle or a rectangle.
struct Opening {
    at_mm: Vec3,
    edges: [Vec3; 2],
    normal: Vec3,
    /// Half of the edges, or the radius twice.
    half_mm: [f64; 2],
    is_round: bool,
}

impl Opening {
    fn contains(&self, point: &Vec3) -> bool {
        let arm = point - self.at_mm;
        match self.is_round {
            true => (arm - self.normal * arm.dot(&self.normal)).norm() <= self.half_mm[0],
            false => (0..2).all(|k| arm.dot(&self.edges[k]).abs() <= self.half_mm[k]),
        }
    }
}

/// `openings = [{ at = "35 15 0 mm", diameter = "32 mm" }, { at = "-25 0 0 mm", size = "52 32 mm" }]`.
fn openings(section: &Section<'_>, geometry: &Geometry) -> Option<Vec<Opening>> {
    let Some(item) = section.get("openings") else { return Some(Vec::new()) };
    let Geometry::Plane { normal, along, .. } = *geometry else {
        let message = "only a plane has `openings`".to_owned();
        item.error("wrong-feature", message, "divide the feature, or take a table of points");
        return None;
    };
    let read = |one: &Item<'_>| one.section("openings", |s| opening(s, normal, along)).flatten();
    let all: Vec<Option<Opening>> = item.list()?.iter().map(read).collect();
    all.into_iter().collect()
}

fn opening(section: &Section<'_>, normal: Vec3, along: Vec3) -> Option<Opening> {
    let at = section.require("at", "its middle: at = \"35 15 0 mm\"").and_then(|i| i.lengths());
    let diameter = section.get("diameter").map(|i| positive(&i, "diameter"));
    let size = section.get("size").map(|i| i.lengths::<2>());
    let (half_mm, is_round) = match (diameter, size) {
        (Some(diameter), None) => ([0.5 * diameter?; 2], true),
        (None, Some(size)) => (size?.map(|s| 0.5 * s), false),
        _ => {
            let message = "an opening has a diameter or a size".to_owned();
            section.error("one-shape", message, "diameter = \"32 mm\" or size = \"52 32 mm\"");
            return None;
        }
    };
    let edges = [along, normal.cross(&along)];
    Some(Opening { at_mm: Vec3::from(at?), edges, normal, half_mm, is_round })
}

/// Some 20 points along the longer side, 36 to 72 around.
fn usual_spacing(geometry: &Geometry) -> f64 {
    // Five sections where that does not crowd the points of each: short cylinders have fewer.
    let round = |radius_mm: f64, length_mm: f64| {
        let around = PI * radius_mm / 18.0;
        around.min((0.2 * length_mm).max(0.5 * around))
    };
    match geometry {
        Geometry::Plane { size_mm, .. } => 0.05 * size_mm[0].max(size_mm[1]),
        Geometry::Cylinder { radius_mm, length_mm, .. } => round(*radius_mm, *length_mm),
        Geometry::Cone { radii_mm, length_mm, .. } => {
            round(radii_mm[0].max(radii_mm[1]), *length_mm)
        }
        Geometry::Sphere { radius_mm, opening_rad, .. } => 0.1 * radius_mm * opening_rad,
        Geometry::Programmed { size_mm, .. } => 0.025 * size_mm[0].max(size_mm[1]),
        Geometry::Points => 1.0,
    }
}

fn read_geometry(section: &Section<'_>, kind: &str) -> Option<Geometry> {
    let at_mm = section
        .require("at", "a place in the workpiece frame: at = \"0 0 0 mm\"")
        .and_then(|i| i.lengths())
        .map(Vec3::from);
    let unit = |key: &str, hint: &str| {
        section.require(key, hint).and_then(|i| i.direction()).map(Vec3::from)
    };
    let size = |key: &str, hint: &str| section.require(key, hint).and_then(|i| positive(&i, key));
    let is_hole = matches!(kind, "hole" | "conical_hole" | "hollow_sphere");
    let axis_hint = "along the axis from `at` on: axis = \"0 0 1\"";
    match kind {
        "plane" => {
            let (normal, along, size_mm) = read_rectangle(section, "out of the material")?;
            Some(Geometry::Plane { at_mm: at_mm?, normal, along, size_mm })
        }
        "programmed" => {
            let depth = size("depth", "how far beyond the rectangle: depth = \"20 mm\"");
            let (normal, along, size_mm) = read_rectangle(section, "towards the eye")?;
            let depth_mm = depth?;
            Some(Geometry::Programmed { at_mm: at_mm?, normal, along, size_mm, depth_mm })
        }
        "cylinder" | "hole" => {
            let axis = unit("axis", axis_hint);
            let diameter = size("diameter", "diameter = \"30 mm\"");
            let length = size("length", "along the axis: length = \"20 mm\"");
            Some(Geometry::Cylinder {
                at_mm: at_mm?,
                axis: axis?,
                radius_mm: 0.5 * diameter?,
                length_mm: length?,
                is_hole,
            })
        }
        "cone" | "conical_hole" => {
            let axis = unit("axis", axis_hint);
            let diameters = section
                .require("diameters", "at both ends: diameters = \"30 20 mm\"")
                .and_then(|i| i.lengths::<2>());
            let length = size("length", "along the axis: length = \"20 mm\"");
            let radii_mm = diameters?.map(|d| 0.5 * d);
            if radii_mm.iter().any(|r| *r < 0.0) || radii_mm[0].max(radii_mm[1]) <= 0.0 {
                section.error(
                    "not-positive",
                    "`diameters` must be positive".into(),
                    "one of them may be 0",
                );
                return None;
            }
            Some(Geometry::Cone {
                at_mm: at_mm?,
                axis: axis?,
                radii_mm,
                length_mm: length?,
                is_hole,
            })
        }
        _ => {
            let axis = unit("axis", "the middle of the part that there is: axis = \"0 0 1\"");
            let diameter = size("diameter", "diameter = \"30 mm\"");
            let hint = "from the axis to the edge: opening = \"60 deg\"";
            let opening =
                section.require("opening", hint).and_then(|i| i.quantity(Dimension::Angle));
            let opening_rad = opening?;
            if !(opening_rad > 0.0 && opening_rad <= PI) {
                section.error("bad-angle", "`opening` must be from 0 to 180 deg".into(), hint);
                return None;
            }
            let radius_mm = 0.5 * diameter?;
            Some(Geometry::Sphere { at_mm: at_mm?, axis: axis?, radius_mm, opening_rad, is_hole })
        }
    }
}

/// `normal`, `along` and `size`.
fn read_rectangle(section: &Section<'_>, is: &str) -> Option<(Vec3, Vec3, [f64; 2])> {
    let normal = section
        .require("normal", &format!("{is}: normal = \"0 0 1\""))
        .and_then(|i| i.direction())
        .map(Vec3::from);
    let along = match section.get("along") {
        Some(item) => item.direction().map(Vec3::from).map(Some),
        None => Some(None),
    };
    let hint = "along its edges: size = \"80 60 mm\"";
    let size = section.require("size", hint).and_then(|i| i.lengths::<2>());
    let (normal, along, size_mm) = (normal?, along?, size?);
    if size_mm.iter().any(|s| *s <= 0.0) {
        section.error("not-positive", "`size` must be positive".into(), "two lengths of edges");
        return None;
    }
    let along = match along {
        None => super::feature::across(&normal)[0],
        Some(along) => {
            let within = along - normal * normal.dot(&along);
            if within.norm() < 0.9 {
                let message = "`along` does not lie in the plane".to_owned();
                let hint = "a direction at right angles to `normal`";
                section.error("bad-direction", message, hint);
                return None;
            }
            within.normalize()
        }
    };
    Some((normal, along, size_mm))
}

fn positive(item: &Item<'_>, key: &str) -> Option<f64> {
    let value = item.quantity(Dimension::Length)?;
    if value > 0.0 {
        return Some(value);
    }
    item.error("not-positive", format!("`{key}` must be positive"), "a length such as \"20 mm\"");
    None
}

/// Columns `x_mm,y_mm,z_mm,nx,ny,nz`.
fn read_points(section: &Section<'_>, path: &Path) -> Option<Vec<SurfacePoint>> {
    let mut problems = Diagnostics::new();
    let text = section.files().text(path, "a table of points", &mut problems);
    let points = text.and_then(|text| {
        let file = path.display().to_string();
        let table = CsvTable::parse(&file, &text, &mut problems);
        if problems.has_errors() {
            return None;
        }
        points_of(&table, &mut problems)
    });
    section.take_over(problems);
    points
}

fn points_of(table: &CsvTable, problems: &mut Diagnostics) -> Option<Vec<SurfacePoint>> {
    let mut columns = Vec::new();
    for name in ["x_mm", "y_mm", "z_mm", "nx", "ny", "nz"] {
        let Some(column) = table.column(name) else {
            let message = format!("the table has no column `{name}`");
            let hint = "x_mm,y_mm,z_mm,nx,ny,nz: a place and the normal out of the material";
            problems.error("missing-column", Place::whole(&table.file), message, hint);
            return None;
        };
        columns.push(&column.values);
    }
    if table.rows() == 0 || table.rows() > MOST_POINTS {
        let message = format!("the table has {} points", table.rows());
        let hint = format!("1 to {MOST_POINTS}");
        problems.error("bad-count", Place::whole(&table.file), message, &hint);
        return None;
    }
    let mut point = |row: usize| {
        let [x, y, z, nx, ny, nz] = [0, 1, 2, 3, 4, 5].map(|k: usize| columns[k][row]);
        let normal = Vec3::new(nx, ny, nz);
        if (normal.norm() - 1.0).abs() > 1e-3 {
            let message = format!("the normal has length {:.4}", normal.norm());
            let hint = "a unit vector out of the material";
            problems.error("bad-direction", table.row_place(row), message, hint);
            return None;
        }
        let normal = normal.normalize();
        let line = u32::try_from(table.row_place(row).line).unwrap_or(u32::MAX);
        Some(SurfacePoint { point_mm: Vec3::new(x, y, z), normal, axis: normal, line })
    };
    (0..table.rows()).map(&mut point).collect()
}
