//! The file of an adaptation, read and checked.

use super::cutter::Cutter;
use super::table::{SurfacePoint, read_points};
use std::path::{Path, PathBuf};
use trueaxis_cl::{ClFile, Reading, Word};
use trueaxis_input::{
    Diagnostics, Dimension, Files, Item, MeasuredValue, Place, Section, SourceText,
};
use trueaxis_machine::Machine;

/// A longer path would take hours.
const MOST_PLACES: usize = 200_000;
/// A map of more places shows nothing more.
const MOST_CELLS: usize = 20_000;
/// Cutters that differ by no more are the same: files round.
const SAME_CUTTER_MM: f64 = 5e-3;
/// More other cutters of one path are not named.
const MOST_CUTTERS: usize = 5;

/// How the path follows a blank that lies elsewhere.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Follow {
    /// Every place along its normal by the whole deviation; tool axes are kept.
    #[default]
    Normals,
    /// The whole path with the blank, tool axes too; what remains along the normals.
    Blank,
}

impl Follow {
    /// All, with their words in the file.
    pub const ALL: [(Self, &'static str); 2] = [(Self::Normals, "normals"), (Self::Blank, "blank")];

    /// The word in the file.
    pub fn name(self) -> &'static str {
        Self::ALL.iter().find(|(f, _)| *f == self).map_or("", |(_, name)| name)
    }
}

/// What the path was programmed to touch.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum PathAt {
    /// The finished surface, a layer below the nominal blank.
    #[default]
    Finished,
    /// The nominal blank: the layer is still to be taken.
    Blank,
}

impl PathAt {
    const ALL: [(Self, &'static str); 2] = [(Self::Finished, "finished"), (Self::Blank, "blank")];
}

/// Where the inner surface of the wall is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Inner {
    /// Parallel to the outer one, as on a blank of even thickness.
    #[default]
    Follows,
    /// Where it is on the nominal part, as on a mandrel.
    Nominal,
}

impl Inner {
    const ALL: [(Self, &'static str); 2] = [(Self::Follows, "follows"), (Self::Nominal, "nominal")];
}

/// What is cut into which wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wall {
    /// The layer to remove.
    pub layer_mm: f64,
    /// What the path touches.
    pub path_at: PathAt,
    /// Of the blank before the cut.
    pub thickness_mm: f64,
    /// Its standard uncertainty.
    pub u_thickness_mm: f64,
    /// No wall may be thinner.
    pub least_mm: f64,
    /// Where its other side is.
    pub inner: Inner,
}

/// How far is too far.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    /// Of the blank from its nominal place.
    pub shift_mm: f64,
    /// Of the blank from its nominal attitude.
    pub turn_rad: f64,
    /// Of any reading from the blank as it lies.
    pub form_mm: f64,
    /// From a place that is cut to the nearest probed one.
    pub reach_mm: f64,
    /// A feed motion higher above the nominal blank cuts nothing.
    pub air_mm: f64,
    /// How deep the cutter may enter the wanted surface beside the place that it cuts.
    pub gouge_mm: f64,
}

/// Everything that an adaptation needs.
#[derive(Debug, Clone)]
pub struct AdaptStudy {
    /// In words.
    pub name: String,
    /// The machine that cuts.
    pub machine: Machine,
    /// The path for the nominal blank.
    pub path: ClFile,
    /// The table of the measured points, for messages.
    pub table: String,
    /// The blank as probed.
    pub points: Vec<SurfacePoint>,
    /// The cutter.
    pub cutter: Cutter,
    /// The wall.
    pub wall: Wall,
    /// Standard uncertainty of a reading of the probe.
    pub noise_mm: f64,
    /// Over what distance the form stays alike; `None`: cross-validation says.
    pub length_mm: Option<f64>,
    /// How the path follows.
    pub follow: Follow,
    /// How far is too far.
    pub bounds: Bounds,
    /// A blank that is known better, for the virtual cut, and its table.
    pub blank: Option<(String, Vec<SurfacePoint>)>,
}

/// The table of deviations that a study of hits gives (`identify surface`), as text.
pub type FromHits<'a> = &'a dyn Fn(&Path, &mut Diagnostics) -> Option<String>;

/// Reads a study with the machine, the path and the tables that it names; `measured` may be a study of hits (`.toml`),
/// which the caller turns into a table.
pub fn read_adapt_study(
    files: &Files,
    path: &Path,
    from_hits: FromHits<'_>,
) -> (Option<AdaptStudy>, Diagnostics) {
    let mut problems = Diagnostics::new();
    let what = "a study of an adaptation (TOML)";
    let Some(text) = files.text(path, what, &mut problems) else { return (None, problems) };
    let file = path.display().to_string();
    let source = SourceText::from(files, &file, &text);
    let folder = path.parent().unwrap_or(Path::new("")).to_owned();
    let study = source.read(|root| read(root, &folder, from_hits));
    problems.append(source.finish());
    (study.filter(|_| !problems.has_errors()), problems)
}

fn read(root: &Section<'_>, folder: &Path, from_hits: FromHits<'_>) -> Option<AdaptStudy> {
    // Every key is asked for before anything is given up, or it would count as unknown.
    let name = root.require("name", "say what is cut").and_then(|i| i.text()).map(str::to_owned);
    let beside = |key: &str, hint: &str| -> Option<PathBuf> {
        root.require(key, hint).and_then(|i| i.text()).map(|t| folder.join(t))
    };
    let machine = beside("machine", "machine = \"machine.toml\"");
    let cl = beside("path", "path = \"part.cls\": the cutter locations for the nominal blank");
    let table = beside(
        "measured",
        "measured = \"blank.csv\": point,x_mm,y_mm,z_mm,i,j,k,deviation_um; or a study of hits, \"hits.toml\"",
    );
    let cutter = root.require("cutter", "[cutter] diameter = \"8 mm\", corner_radius = \"4 mm\"");
    let cutter = cutter.and_then(|i| i.section("cutter", read_cutter)).flatten();
    let wall = read_wall(root);
    let probe = root.require("probe", "[probe] noise = \"1.5 um\"");
    let noise_mm = probe.and_then(|i| i.section("probe", read_noise)).flatten();
    let (follow, mut bounds) = read_registration(root);
    let length_mm = read_field(root, &mut bounds);
    let blank = root.section("virtual_cut", |s| s.text("blank").map(|t| folder.join(t))).flatten();
    let mut found = Diagnostics::new();
    let machine = machine.and_then(|path| {
        let (machine, problems) = Machine::read(root.files(), &path);
        found.append(problems);
        machine
    });
    let cl = cl.and_then(|path| read_path(root.files(), &path, &mut found));
    if let (Some(path), Some(cutter)) = (&cl, &cutter) {
        compare_cutters(path, cutter, &mut found);
    }
    let points = table.as_ref().and_then(|path| {
        if path.extension().is_some_and(|e| e.eq_ignore_ascii_case("toml")) {
            let text = from_hits(path, &mut found)?;
            return points_of(&path.display().to_string(), &text, &mut found);
        }
        read_table(root.files(), path, &mut found)
    });
    let blank = blank.map(|path| {
        Some((path.display().to_string(), read_table(root.files(), &path, &mut found)?))
    });
    root.take_over(found);
    Some(AdaptStudy {
        name: name?,
        machine: machine?,
        path: cl?,
        table: table?.display().to_string(),
        points: points?,
        cutter: cutter?,
        wall: wall?,
        noise_mm: noise_mm?,
        length_mm,
        follow,
        bounds,
        blank: blank.flatten(),
    })
}

fn read_table(files: &Files, path: &Path, problems: &mut Diagnostics) -> Option<Vec<SurfacePoint>> {
    let text = files.text(path, "a table of measured points (CSV)", problems)?;
    points_of(&path.display().to_string(), &text, problems)
}

fn points_of(file: &str, text: &str, problems: &mut Diagnostics) -> Option<Vec<SurfacePoint>> {
    let points = read_points(file, text, problems)?;
    if points.len() > MOST_CELLS {
        let message = format!("{} points are more than {MOST_CELLS}", points.len());
        problems.error("too-many-points", Place::whole(file), message, "thin the table");
        return None;
    }
    Some(points)
}

fn read_path(files: &Files, path: &Path, problems: &mut Diagnostics) -> Option<ClFile> {
    let text = files.bytes(path, "a cutter-location file", problems)?;
    let (file, found) = ClFile::read(&path.display().to_string(), text, &Reading::default());
    let sound = !found.has_errors();
    problems.append(found);
    let places = file.points().count();
    if places > MOST_PLACES {
        let message = format!("{places} places of the tool are more than {MOST_PLACES}");
        let hint = "adapt the operations one after the other";
        problems.error("too-many-places", Place::whole(file.name()), message, hint);
        return None;
    }
    sound.then_some(file)
}

/// The path was computed for the cutter that it states (CUTTER), and is moved for that of the study.
fn compare_cutters(path: &ClFile, cutter: &Cutter, problems: &mut Diagnostics) {
    let mut said = Vec::new();
    for record in path.records() {
        let Word::Cutter { diameter_mm, corner_radius_mm } = record.word else { continue };
        let corner_mm = corner_radius_mm.unwrap_or(cutter.corner_mm);
        let [is, of_file] = [[2.0 * cutter.radius_mm, cutter.corner_mm], [diameter_mm, corner_mm]];
        let differ = is.iter().zip(of_file).any(|(a, b)| (a - b).abs() > SAME_CUTTER_MM);
        if !differ || said.contains(&of_file) || said.len() == MOST_CUTTERS {
            continue;
        }
        said.push(of_file);
        let corner =
            corner_radius_mm.map_or_else(String::new, |r| format!(" with a corner of {r} mm"));
        let message = format!(
            "the path states a cutter of {diameter_mm} mm{corner}, the study one of {} mm with a corner of {} mm",
            is[0], is[1]
        );
        let place = Place { file: path.name().to_owned(), line: record.line as usize, column: 1 };
        let hint = "with another cutter the path touches elsewhere: correct [cutter], or write the path for it";
        problems.warn("other-cutter", place, message, hint);
    }
}

/// A length above a limit, or a problem.
fn length(section: &Section<'_>, key: &str, usual: f64) -> f64 {
    section.get(key).and_then(|i| positive(&i)).unwrap_or(usual)
}

fn positive(item: &Item<'_>) -> Option<f64> {
    let value = item.quantity(Dimension::Length)?;
    if value <= 0.0 {
        item.error("not-positive", "it is not positive".to_owned(), "such as \"0.15 mm\"");
        return None;
    }
    Some(value)
}

/// A wall of less than nothing is a hole: a least wall below 0 would call a path good that cuts through.
fn not_negative(item: &Item<'_>) -> Option<f64> {
    let value = item.quantity(Dimension::Length)?;
    if value < 0.0 {
        item.error("not-positive", "it is negative".to_owned(), "such as \"0.05 mm\"");
        return None;
    }
    Some(value)
}

fn read_cutter(section: &Section<'_>) -> Option<Cutter> {
    let diameter = section.require("diameter", "diameter = \"8 mm\"").and_then(|i| positive(&i));
    let hint = "corner_radius = \"4 mm\": half of the diameter for a ball, \"0 mm\" for a flat end";
    let corner = section.require("corner_radius", hint);
    let corner_mm = corner.and_then(|i| i.quantity(Dimension::Length));
    let (diameter, corner_mm) = (diameter?, corner_mm?);
    if !(0.0..=0.5 * diameter * (1.0 + 1e-9)).contains(&corner_mm) {
        let message =
            format!("a corner of {corner_mm} mm does not fit a diameter of {diameter} mm");
        section.error("bad-cutter", message, hint);
        return None;
    }
    Some(Cutter { radius_mm: 0.5 * diameter, corner_mm: corner_mm.min(0.5 * diameter) })
}

fn word<T: Copy>(item: &Item<'_>, words: &[(T, &str)]) -> Option<T> {
    let text = item.text()?;
    let found = words.iter().find(|(_, name)| *name == text);
    if found.is_none() {
        let names: Vec<String> = words.iter().map(|(_, name)| format!("\"{name}\"")).collect();
        item.error("unknown-word", format!("`{text}` is not known here"), &names.join(" or "));
    }
    found.map(|(value, _)| *value)
}

fn read_wall(root: &Section<'_>) -> Option<Wall> {
    let layer = root.require("layer", "[layer] depth = \"0.15 mm\"");
    let layer = layer.and_then(|item| {
        item.section("layer", |s| {
            let depth = s.require("depth", "depth = \"0.15 mm\"").and_then(|i| positive(&i));
            let at = s.get("path").map_or(Some(PathAt::default()), |i| word(&i, &PathAt::ALL));
            Some((depth?, at?))
        })
    });
    let hint = "[wall] thickness = \"0.25 ± 0.005 mm\", least = \"0.05 mm\"";
    let wall = root.require("wall", hint).and_then(|item| {
        item.section("wall", |s| {
            let thickness = s.require("thickness", hint);
            let thickness = thickness.and_then(|i| i.measured(Dimension::Length));
            let least = s.require("least", hint).and_then(|i| not_negative(&i));
            let inner = s.get("inner").map_or(Some(Inner::default()), |i| word(&i, &Inner::ALL));
            Some((checked_thickness(s, thickness?)?, least?, inner?))
        })
    });
    let (layer_mm, path_at) = layer??;
    let (thickness, least_mm, inner) = wall??;
    let wanted = thickness.value - layer_mm;
    if wanted < least_mm {
        let message = format!(
            "a layer of {layer_mm} mm leaves {wanted:.4} mm of a wall of {} mm, less than the least \
             {least_mm} mm",
            thickness.value
        );
        root.error("layer-too-deep", message, "remove less, or begin with a thicker blank");
    }
    let u_thickness_mm = thickness.u.unwrap_or(0.0);
    Some(Wall { layer_mm, path_at, thickness_mm: thickness.value, u_thickness_mm, least_mm, inner })
}

fn checked_thickness(section: &Section<'_>, thickness: MeasuredValue) -> Option<MeasuredValue> {
    if thickness.value > 0.0 {
        return Some(thickness);
    }
    let message = format!("a wall of {} mm is none", thickness.value);
    section.error("not-positive", message, "thickness = \"0.25 ± 0.005 mm\"");
    None
}

fn read_noise(section: &Section<'_>) -> Option<f64> {
    let hint = "noise = \"1.5 um\": the standard uncertainty of one hit of the probe";
    section.require("noise", hint).and_then(|i| positive(&i))
}

fn read_registration(root: &Section<'_>) -> (Follow, Bounds) {
    let mut bounds = Bounds {
        shift_mm: 0.2,
        turn_rad: 0.2_f64.to_radians(),
        form_mm: 0.3,
        reach_mm: 3.0,
        air_mm: 1.0,
        gouge_mm: 0.005,
    };
    let mut follow = Follow::default();
    root.section("registration", |s| {
        follow = s.get("follow").and_then(|i| word(&i, &Follow::ALL)).unwrap_or_default();
        bounds.shift_mm = length(s, "most_shift", bounds.shift_mm);
        bounds.form_mm = length(s, "most_form", bounds.form_mm);
        let turn = s.get("most_turn").and_then(|i| i.quantity(Dimension::Angle));
        bounds.turn_rad = turn.unwrap_or(bounds.turn_rad).abs();
    });
    root.section("path_check", |s| {
        bounds.air_mm = length(s, "air", bounds.air_mm);
        bounds.gouge_mm = length(s, "gouge", bounds.gouge_mm);
    });
    (follow, bounds)
}

fn read_field(root: &Section<'_>, bounds: &mut Bounds) -> Option<f64> {
    let field = root.section("field", |s| {
        bounds.reach_mm = length(s, "reach", bounds.reach_mm);
        s.get("length").and_then(|i| positive(&i))
    });
    field.flatten()
}
