//! The file of a test piece: dimensions, path and tolerances with their sources.

use crate::testpiece::cone::{Cone, ConeSize, INDICES};
use crate::testpiece::{IndexName, NasMounting, TestPiece};
use crate::tolerance::{Tolerance, Tolerances};
use std::f64::consts::PI;
use std::path::Path;
use trueaxis_input::plausible::Quantity;
use trueaxis_input::{Diagnostics, Dimension, Files, Item, Section, SourceText};

/// The shapes that a file can describe; a new test piece is a new variant.
#[derive(Debug, Clone)]
pub enum Shape {
    /// `[cone]`
    Cone(Cone),
}

/// A checked file of a test piece.
///
/// # Example
/// ```
/// use trueaxis_input::SourceText;
/// use trueaxis_part::TestPieceFile;
/// let text = r#"
/// name = "our cone"
/// [cone]
/// half_angle = "15 deg"
/// base_diameter = "250 mm"
/// height = "60 mm"
/// sections = ["0 mm", "25 mm", "50 mm"]
/// roundness_at = "25 mm"
/// [tool]
/// diameter = "20 mm"
/// [tolerance]
/// roundness_mzc = "0.1 mm"
/// "#;
/// let source = SourceText::new("our-cone.toml", text);
/// let file = source.read(|root| TestPieceFile::read(root)).expect("all there");
/// assert_eq!(file.tolerances.limit_mm("roundness_mzc_mm"), Some(0.1));
/// assert_eq!(file.piece().position_count(), 72);
/// ```
#[derive(Debug, Clone)]
pub struct TestPieceFile {
    /// Its name.
    pub name: String,
    /// The source of the dimensions.
    pub source: String,
    /// Its shape and dimensions.
    pub shape: Shape,
    /// Its mounting on the fixture, if stated.
    pub mounting: Option<NasMounting>,
    /// Its tolerances.
    pub tolerances: Tolerances,
    /// How it is cut, in this order; empty if the file says nothing of it.
    pub conditions: Vec<CuttingCondition>,
    /// How it is set up before, if stated.
    pub set_up: Option<SetUp>,
}

/// The reference hole of a set-up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SetUp {
    /// Feed of the reference hole, mm/min.
    pub feed_mm_per_min: f64,
    /// Speed of the spindle, 1/min.
    pub spindle_per_min: f64,
    /// Depth of the reference hole below the top face, mm.
    pub hole_depth_mm: f64,
}

/// One turn of the tool about the piece.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct CuttingCondition {
    /// Its name.
    pub name: String,
    /// Feed of the tip, mm/min.
    pub feed_mm_per_min: Option<f64>,
    /// Speed of the spindle, 1/min.
    pub spindle_per_min: Option<f64>,
    /// Height of the end of the cutter above the base, along the axis of the piece, mm.
    pub height_mm: f64,
    /// What stays on the surface, mm: with more of it below, each condition leaves a step.
    pub allowance_mm: f64,
}

/// Default number of tool positions around a cone.
const DEFAULT_POSITIONS: usize = 72;

impl TestPieceFile {
    /// A file by its path.
    pub fn of_file(files: &Files, path: &Path, problems: &mut Diagnostics) -> Option<Self> {
        let text = files.text(path, "a test piece file (TOML)", problems)?;
        let name = path.display().to_string();
        let source = SourceText::new(&name, &text);
        let piece = source.read(Self::read);
        problems.keep((piece, source.finish()))
    }

    /// The file that another file names; every problem is kept in the source of `root`.
    pub fn named_in(root: &Section<'_>, path: &Path) -> Option<Self> {
        let mut problems = Diagnostics::new();
        let piece = Self::of_file(root.files(), path, &mut problems);
        root.take_over(problems);
        piece
    }

    /// Reads and checks the root of a file; every problem is kept in its `SourceText`.
    ///
    /// `None` if the test piece cannot be used; the source then holds at least one error.
    pub fn read(root: &Section<'_>) -> Option<Self> {
        let name = root.require("name", "write the name of the test piece").and_then(|i| i.text());
        let source = root.text("source").unwrap_or_default().to_owned();
        let tool = root
            .require("tool", "add the end mill: [tool] with diameter = \"20 mm\"")
            .and_then(|item| item.section("tool", |s| length(s, "diameter")))
            .flatten();
        let cone = root
            .require("cone", "add the shape: [cone] with half_angle, base_diameter, height …")
            .and_then(|item| item.section("cone", |s| cone_size(s, tool)))
            .flatten();
        let checked = cone.and_then(|size| match Cone::new(name.unwrap_or_default(), size) {
            Ok(cone) => Some(cone),
            Err(error) => {
                root.error("impossible-shape", error.to_string(), "check [cone] and [tool]");
                None
            }
        });
        let height = checked.as_ref().map_or(0.0, |c| c.size().height_mm);
        let mounting = match root.get("mounting") {
            Some(item) => item.section("mounting", |s| mounting(s, height)).flatten().map(Some),
            None => Some(None),
        };
        let tolerances = root
            .require("tolerance", "[tolerance] with roundness_mzc = \"0.1 mm\" …")
            .and_then(|item| item.section("tolerance", tolerances))
            .flatten();
        // Of a piece with another mistake no height is known.
        let top = checked.as_ref().map_or(f64::MAX, |c| c.size().height_mm);
        let conditions = conditions(root, top);
        let set_up = root.section("set_up", read_set_up);
        Some(Self {
            name: name?.to_owned(),
            source,
            shape: Shape::Cone(checked?),
            mounting: mounting?,
            tolerances: tolerances?,
            conditions: conditions?,
            set_up: match set_up {
                Some(stated) => Some(stated?),
                None => None,
            },
        })
    }

    /// The piece for the simulation.
    pub fn piece(&self) -> &dyn TestPiece {
        match &self.shape {
            Shape::Cone(cone) => cone,
        }
    }
}

/// `[set_up] feed = "0.015 m/min"`, `spindle = "600 rpm"`, `hole_depth = "40 mm"`.
fn read_set_up(section: &Section<'_>) -> Option<SetUp> {
    let positive = |key: &str, dimension: Dimension, example: &str| {
        let item = section.require(key, example)?;
        let value = item.quantity(dimension)?;
        if value <= 0.0 {
            item.error("not-positive", format!("`{key}` must be positive"), example);
        }
        Some(value).filter(|v| *v > 0.0)
    };
    let feed = positive("feed", Dimension::Velocity, "feed = \"15 mm/min\"");
    let spindle = positive("spindle", Dimension::AngularVelocity, "spindle = \"600 rpm\"");
    let depth = positive("hole_depth", Dimension::Length, "hole_depth = \"40 mm\"");
    Some(SetUp {
        feed_mm_per_min: feed? * 60.0,
        // The digits of the file, not those of rad/s and back.
        spindle_per_min: (spindle? * 30.0 / PI * 1e6).round() / 1e6,
        hole_depth_mm: depth?,
    })
}

/// `[[condition]] feed = "1.5 m/min"`, `spindle = "10000 rpm"`, `height`, `allowance`.
fn conditions(root: &Section<'_>, cone_height_mm: f64) -> Option<Vec<CuttingCondition>> {
    let Some(item) = root.get("condition") else { return Some(Vec::new()) };
    let read =
        |one: &Item<'_>| one.section("condition", |s| condition(s, cone_height_mm)).flatten();
    // All are read before the first failure counts, so that every problem is reported.
    let all: Vec<_> = item.list()?.iter().map(read).collect();
    all.into_iter().collect()
}

fn condition(section: &Section<'_>, cone_height_mm: f64) -> Option<CuttingCondition> {
    let positive = |key: &str, dimension: Dimension| -> Option<Option<f64>> {
        let Some(item) = section.get(key) else { return Some(None) };
        let value = item.quantity(dimension)?;
        if value > 0.0 {
            return Some(Some(value));
        }
        item.error(
            "not-positive",
            format!("`{key}` must be positive"),
            "leave it out if it is not known",
        );
        None
    };
    let within = |key: &str, low: f64, high: f64| -> Option<f64> {
        let Some(item) = section.get(key) else { return Some(0.0) };
        let value = item.quantity(Dimension::Length)?;
        if (low..=high).contains(&value) {
            return Some(value);
        }
        let message = format!("`{key}` must be from {low} to {high} mm, found {value} mm");
        item.error(
            "bad-value",
            message,
            "measured from the base of the piece, and from its surface",
        );
        None
    };
    let feed = positive("feed", Dimension::Velocity);
    let spindle = positive("spindle", Dimension::AngularVelocity);
    let height_mm = within("height", 0.0, cone_height_mm);
    let allowance_mm = within("allowance", 0.0, 100.0);
    Some(CuttingCondition {
        name: section.text("name").unwrap_or_default().to_owned(),
        feed_mm_per_min: feed?.map(|mm_per_s| mm_per_s * 60.0),
        // The digits of the file, not those of rad/s and back.
        spindle_per_min: spindle?.map(|rad_per_s| (rad_per_s * 30.0 / PI * 1e6).round() / 1e6),
        height_mm: height_mm?,
        allowance_mm: allowance_mm?,
    })
}

fn length(section: &Section<'_>, key: &str) -> Option<f64> {
    section.require(key, "write a length such as \"60 mm\"")?.quantity(Dimension::Length)
}

fn angle(section: &Section<'_>, key: &str) -> Option<f64> {
    section.require(key, "write an angle such as \"15 deg\"")?.quantity(Dimension::Angle)
}

fn lengths(item: &Item<'_>) -> Option<Vec<f64>> {
    // All are read before the first failure counts, so that every problem is reported.
    let all: Vec<_> = item.list()?.iter().map(|i| i.quantity(Dimension::Length)).collect();
    all.into_iter().collect()
}

fn cone_size(section: &Section<'_>, tool_diameter_mm: Option<f64>) -> Option<ConeSize> {
    let half_angle_rad = angle(section, "half_angle");
    let base_diameter_mm = length(section, "base_diameter");
    let height_mm = length(section, "height");
    let heights = section
        .require("sections", "write the heights above the base, the first 0: [\"0 mm\", \"25 mm\"]")
        .and_then(|item| lengths(&item));
    let roundness_height_mm = length(section, "roundness_at");
    let angular = match section.get("angularity_over") {
        Some(item) => lengths(&item),
        None => heights.clone(),
    };
    let positions = match section.get("positions") {
        Some(item) => item.count(),
        None => Some(DEFAULT_POSITIONS),
    };
    Some(ConeSize {
        half_angle_rad: half_angle_rad?,
        base_diameter_mm: base_diameter_mm?,
        height_mm: height_mm?,
        tool_diameter_mm: tool_diameter_mm?,
        positions: positions?,
        heights_mm: heights?,
        roundness_height_mm: roundness_height_mm?,
        angularity_heights_mm: angular?,
    })
}

fn mounting(section: &Section<'_>, cone_height_mm: f64) -> Option<NasMounting> {
    let pedestal_height_mm = length(section, "pedestal_height");
    let fixture_height_mm = length(section, "fixture_height");
    let fixture_length_mm = length(section, "fixture_length");
    let inclination_rad = angle(section, "inclination");
    let rotation_rad = match section.get("rotation") {
        Some(item) => item.quantity(Dimension::Angle),
        None => Some(0.0),
    };
    Some(NasMounting {
        cone_height_mm,
        pedestal_height_mm: pedestal_height_mm?,
        fixture_height_mm: fixture_height_mm?,
        fixture_length_mm: fixture_length_mm?,
        inclination_rad: inclination_rad?,
        rotation_rad: rotation_rad?,
    })
}

impl Tolerances {
    /// Reads the root of a tolerance file: `source` and `[tolerance]` as in a test piece file.
    ///
    /// # Example
    /// ```
    /// use trueaxis_input::SourceText;
    /// use trueaxis_part::tolerance::Tolerances;
    /// let text = "source = \"drawing 12\"\n[tolerance]\nroundness_mzc = \"0.05 mm\"";
    /// let source = SourceText::new("ours.toml", text);
    /// let allowed = source.read(Tolerances::read).expect("all there");
    /// assert_eq!(allowed.limit_mm("roundness_mzc_mm"), Some(0.05));
    /// ```
    pub fn read(root: &Section<'_>) -> Option<Self> {
        let source = root.text("source").unwrap_or_default();
        let hint = "[tolerance] with roundness_mzc = \"0.1 mm\" …";
        let item = root.require("tolerance", hint)?;
        let mut tolerances = item.section("tolerance", tolerances)??;
        for tolerance in tolerances.0.iter_mut().filter(|t| t.source.is_empty()) {
            tolerance.source = source.to_owned();
        }
        Some(tolerances)
    }
}

/// Reads `[tolerance]`: every key is an index, with or without its `_mm`.
///
/// `None` if one of them cannot be used.
fn tolerances(section: &Section<'_>) -> Option<Tolerances> {
    let mut good = Vec::new();
    let mut complete = true;
    for (key, place, item) in section.entries() {
        let Some(index) = find(key) else {
            let known = INDICES.map(|i| i.key.trim_end_matches("_mm")).join(", ");
            section.error_at(
                place,
                "unknown-index",
                format!("`{key}` is not an index of this test piece"),
                &format!("indices of this test piece: {known}"),
            );
            complete = false;
            continue;
        };
        if good.iter().any(|t: &Tolerance| t.index == index) {
            let message = format!("`{}` is given twice, with and without `_mm`", index.key);
            section.error_at(place, "duplicate-index", message, "keep one of them");
            complete = false;
        } else if let Some(tolerance) = tolerance(section, &item, index) {
            good.push(tolerance);
        } else {
            complete = false;
        }
    }
    for index in INDICES.iter().filter(|i| i.decisive) {
        if complete && !good.iter().any(|t| t.index == *index) {
            section.warn(
                "missing-tolerance",
                format!("`{}` is decisive, but has no tolerance", index.key),
                "without a tolerance the verdict does not include it",
            );
        }
    }
    complete.then_some(Tolerances(good))
}

fn find(key: &str) -> Option<IndexName> {
    INDICES.into_iter().find(|i| i.key == key || i.key.trim_end_matches("_mm") == key)
}

/// `"0.1 mm"`, or a table with `limit` and `source`.
fn tolerance(section: &Section<'_>, item: &Item<'_>, index: IndexName) -> Option<Tolerance> {
    let (limit, source) = if item.is_table() {
        item.section(&section.path(index.key), |s| {
            let limit = s.require("limit", "write a length such as \"0.1 mm\"");
            let value = limit.as_ref().and_then(|i| i.quantity_of(Quantity::Deviation));
            (value.zip(limit), s.text("source").unwrap_or_default().to_owned())
        })?
    } else {
        (item.quantity_of(Quantity::Deviation).map(|v| (v, *item)), String::new())
    };
    let (limit_mm, place) = limit?;
    if limit_mm <= 0.0 {
        place.error(
            "tolerance-not-positive",
            format!("a tolerance of {limit_mm} mm cannot be met"),
            "write a tolerance above zero",
        );
        return None;
    }
    Some(Tolerance { index, limit_mm, source })
}
