//! The part file.

mod asked;
mod characteristics;
mod mesh;
mod openings;
mod repeat;
mod shapes;

use super::feature::MOST_POINTS;
use super::{Characteristic, Extraction, Feature, Geometry, Part, Sampled};
use characteristics::read_characteristic;
use mesh::read_mesh;
use openings::read_openings;
use repeat::repeated;
use shapes::{SHAPES, read_geometry, usual_spacing};
use std::path::Path;
use trueaxis_geometry::Vec3;
use trueaxis_geometry::surface::SurfacePoint;
use trueaxis_input::{CsvTable, Diagnostics, Dimension, Files, Item, Place, Section, SourceText};

/// How far into and out of the material a feature is checked, unless it says so.
const REACH_MM: f64 = 1.0;
/// Rows, sections and points of each: fewer show no form.
const LEAST_COUNT: usize = 3;
/// A cylinder has five unknowns; points of a turn of its helix: fewer may all lie on two lines.
const LEAST_OF_HELIX: usize = 8;
const LEAST_OF_TURN: f64 = 3.0;
/// The same for a surface of the program: between neighbouring tracks of the tool it is rough; and for a thread, whose core hole is not it.
const NEAR_MM: f64 = 0.1;

impl Part {
    /// A part file by its path.
    pub fn of_file(files: &Files, path: &Path, problems: &mut Diagnostics) -> Option<Self> {
        if let Some((what, hint)) = foreign(path) {
            let place = Place::whole(&path.display().to_string());
            problems.error("not-a-part-file", place, what.to_owned(), hint);
            return None;
        }
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
                    let read = |s: &Section<'_>| repeated(s, read_feature(s, key, folder)?);
                    let found = item.section(key, read).flatten();
                    complete &= found.is_some();
                    features.extend(found.unwrap_or_default());
                }
            });
        }
        complete &= is_unique(root, &features);
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

/// What files of other forms are, and what is done with them.
fn foreign(path: &Path) -> Option<(&'static str, &'static str)> {
    let extension = path.extension()?.to_ascii_lowercase();
    match extension.to_str()? {
        "stp" | "step" | "p21" | "igs" | "iges" => Some((
            "geometry of STEP and IGES is not read",
            "export the body as STL and name it in a feature, mesh = { stl = \"part.stl\" }, or its features as QIF",
        )),
        "qif" => Some((
            "a QIF file is drafted first, since it does not state all that is needed",
            "trueaxis part MODEL.qif -o PART.toml",
        )),
        "stl" => Some((
            "a body without features and tolerances",
            "name it in a feature of a part file, mesh = { stl = \"part.stl\" }",
        )),
        _ => None,
    }
}

/// Names of members of patterns are not those of other features.
fn is_unique(root: &Section<'_>, features: &[Feature]) -> bool {
    let twice = features.iter().enumerate().find(|(i, f)| {
        let names = [Some(&f.name), f.pattern.as_ref()];
        features[..*i].iter().any(|other| names.contains(&Some(&other.name)))
    });
    if let Some((_, feature)) = twice {
        let message = format!("two features have the name `{}`", feature.name);
        root.error("double-feature", message, "members of patterns are numbered: NAME_1, NAME_2 …");
    }
    twice.is_none()
}

fn read_feature(section: &Section<'_>, name: &str, folder: &Path) -> Option<Feature> {
    let stated: Vec<(&str, Item<'_>)> =
        SHAPES.iter().filter_map(|kind| section.get(kind).map(|item| (*kind, item))).collect();
    let [(kind, item)] = stated[..] else {
        let message = format!("feature `{name}` has {} shapes, expected one", stated.len());
        section.error("one-shape", message, &format!("one of {}", SHAPES.join(", ")));
        return None;
    };
    let letter = section.text("datum").map(str::to_owned);
    let spacing = section.get("spacing").map(|item| positive(&item, "spacing"));
    let usual_mm = if matches!(kind, "programmed" | "thread") { NEAR_MM } else { REACH_MM };
    let reach = ["below", "above"]
        .map(|key| section.get(key).map_or(Some(usual_mm), |item| positive(&item, key)));
    // Asked for before a mistake of the shape ends the reading: else it would be called unknown.
    let openings = section.get("openings");
    let spacing_mm = match spacing {
        None => None,
        Some(stated) => Some(stated?),
    };
    let (geometry, sampled) = match kind {
        "points" => {
            let points = read_points(section, &folder.join(item.text()?))?;
            (Geometry::Points, Sampled::of_table(points))
        }
        "mesh" => {
            let read = |s: &Section<'_>| read_mesh(s, folder, spacing_mm);
            (Geometry::Points, Sampled::of_table(item.section("mesh", read).flatten()?))
        }
        _ => {
            let geometry = item.section(kind, |s| read_geometry(s, kind)).flatten()?;
            (geometry, sampled(section, name, &geometry, (spacing_mm, openings))?)
        }
    };
    let Sampled { points, is_kept, sections } = sampled;
    let [below_mm, above_mm] = reach;
    Some(Feature {
        name: name.to_owned(),
        letter,
        pattern: None,
        geometry,
        is_thread: kind == "thread",
        points,
        is_kept,
        sections,
        below_mm: below_mm?,
        above_mm: above_mm?,
    })
}

/// The points of a shape where it has no openings.
fn sampled(
    section: &Section<'_>,
    name: &str,
    geometry: &Geometry,
    (spacing_mm, openings): (Option<f64>, Option<Item<'_>>),
) -> Option<Sampled> {
    let extraction = read_extraction(section, spacing_mm, geometry)?;
    let mut sampled = match geometry.sampled(extraction) {
        Ok(found) => found,
        Err(why) => {
            section.error("too-many-points", why, "write a larger `spacing`");
            return None;
        }
    };
    let openings = openings.map_or(Some(Vec::new()), |item| read_openings(&item, geometry))?;
    let is_there = |p: &SurfacePoint| !openings.iter().any(|o| o.contains(&p.point_mm));
    let is_there: Vec<bool> = sampled.points.iter().map(is_there).collect();
    sampled.keep(&is_there);
    if sampled.points.is_empty() {
        let message = format!("nothing remains of `{name}` without its openings");
        section.error("no-points", message, "smaller openings, or a smaller `spacing`");
        return None;
    }
    Some(sampled)
}

/// `spacing`, or as a measuring machine does: `extraction = { sections = 4, points = 12 }`.
fn read_extraction(
    section: &Section<'_>,
    spacing_mm: Option<f64>,
    geometry: &Geometry,
) -> Option<Extraction> {
    let Some(item) = section.get("extraction") else {
        return Some(Extraction::Spacing(spacing_mm.unwrap_or_else(|| usual_spacing(geometry))));
    };
    if spacing_mm.is_some() {
        let message = "both `spacing` and `extraction` are stated".to_owned();
        item.error("contradiction", message, "one of them");
        return None;
    }
    let has_axis = geometry.axis().is_some();
    let (key, other) = if has_axis { ("sections", "rows") } else { ("rows", "sections") };
    item.section("extraction", |s| {
        if let Some(turns) = s.get("helix") {
            return read_helix(s, &turns, geometry);
        }
        let count = |key: &str, hint: &str| {
            let item = s.require(key, hint)?;
            let count = item.count()?;
            if (LEAST_COUNT..=MOST_POINTS).contains(&count) {
                return Some(count);
            }
            let message = format!("{count} {key}: at least {LEAST_COUNT} show a form");
            item.error("bad-count", message, hint);
            None
        };
        if let Some(wrong) = s.get(other) {
            let message = format!("a {} has {key}, not {other}", geometry.name());
            wrong.error("contradiction", message, &format!("{key} = 4"));
            return None;
        }
        let (rows, points) = (count(key, &format!("{key} = 4")), count("points", "points = 12"));
        Some(Extraction::Grid { rows: rows?, points: points? })
    })
    .flatten()
}

/// `extraction = { helix = 5, points = 60 }`: so many turns, so many points in all.
fn read_helix(section: &Section<'_>, turns: &Item<'_>, geometry: &Geometry) -> Option<Extraction> {
    let hint = "a helix of five turns: extraction = { helix = 5, points = 60 }";
    let item = section.require("points", hint)?;
    let (points, turned) = (item.count()?, turns.number()?);
    if !matches!(geometry, Geometry::Cylinder { .. }) {
        let message =
            format!("a helix on a {}: it goes around a cylinder or a hole", geometry.name());
        turns.error("contradiction", message, "rows, or sections, with points of each");
        return None;
    }
    if !(LEAST_OF_HELIX..=MOST_POINTS).contains(&points) {
        let message = format!("{points} points: {LEAST_OF_HELIX} to {MOST_POINTS} on a helix");
        item.error("bad-count", message, hint);
        return None;
    }
    if !(turned >= 1.0 && turned * LEAST_OF_TURN <= points as f64) {
        let many = turned.abs() >= 1e6;
        let turned = if many { format!("{turned:e}") } else { turned.to_string() };
        let message = format!(
            "{points} points on {turned} turns: at least one turn, and three points of each"
        );
        turns.error("bad-count", message, hint);
        return None;
    }
    Some(Extraction::Helix { turns: turned, points })
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
