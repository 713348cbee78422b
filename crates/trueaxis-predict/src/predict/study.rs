//! The study file: which machine, which test piece, how the zero was set, what is asked.

use super::cutting::{DatumAxis, Reference};
use super::monte_carlo::Sampling;
use super::program::CutProgram;
use super::running::running_machine;
use super::servo::{Servo, read_servo};
use super::set_up::{SetUpReadings, read_set_up, with_length};
use super::temperatures::{RunningTemperatures, StudyTemperatures};
use super::{Index, Setting};
use std::path::{Path, PathBuf};
use trueaxis_geometry::Vec3;
use trueaxis_input::plausible::Quantity;
use trueaxis_input::{Diagnostics, Dimension, Files, Item, Section, SourceText};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{AxisKind, Command};
use trueaxis_machine::errors::{BodyName, ErrorKind, ErrorName, StatedError};
use trueaxis_machine::file::read_pose;
use trueaxis_part::testpiece::TestPiece;
use trueaxis_part::tolerance::{Acceptance, Tolerances, Verdict};
use trueaxis_part::{Shape, TestPieceFile};

/// Another way to set the zero or to choose the datum, for comparison.
#[derive(Debug, Clone, PartialEq)]
pub struct Variant {
    /// What is different.
    pub name: String,
    /// How.
    pub reference: Reference,
}

/// Figures that were published or measured, to be compared with the prediction.
#[derive(Debug, Clone, PartialEq)]
pub struct Published {
    /// What they are, and of which part.
    pub source: String,
    /// One line per index: its key, what was measured, and what the source predicted, mm.
    pub rows: Vec<PublishedRow>,
}

/// One published index.
#[derive(Debug, Clone, PartialEq)]
pub struct PublishedRow {
    /// The index of ours that it is compared with.
    pub key: String,
    /// Measured values, mm.
    pub measured_mm: Vec<f64>,
    /// Predicted by the source, mm.
    pub predicted_mm: Option<f64>,
    /// How its definition differs from ours, if it does.
    pub note: String,
}

/// How the uncertainty enters the verdict.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Decision {
    /// Value against tolerance.
    Simple,
    /// ISO 14253-1 with U = k·u.
    Guarded {
        /// The coverage factor k.
        coverage: f64,
    },
}

/// A question to the machine: will this test piece be good?
#[derive(Debug)]
pub struct Study {
    /// Its name.
    pub name: String,
    /// The study file.
    pub path: PathBuf,
    /// The machine with its tool and the mounted part.
    pub machine: Machine,
    /// The machine file.
    pub machine_path: PathBuf,
    /// The test piece and its tolerances.
    pub test_piece: TestPieceFile,
    /// What is allowed: the study's own tolerance file, or that of the test piece.
    pub tolerances: Tolerances,
    /// Location errors that this study replaces, as written.
    pub what_if: Vec<String>,
    /// The log that runs on while the part is cut, if one does.
    pub temperatures: Option<RunningTemperatures>,
    /// How the zero was set, and the datum.
    pub reference: Reference,
    /// What else to look at.
    pub variants: Vec<Variant>,
    /// The rule of the verdict.
    pub decision: Decision,
    /// The part is cut along this program instead of the ideal path.
    pub program: Option<CutProgram>,
    /// How the axes follow at the feeds of the cutting conditions, if it is stated.
    pub servo: Option<Servo>,
    /// What was read while the part was set up, if a file says it.
    pub set_up: Option<SetUpReadings>,
    /// The Monte Carlo run, if one is wanted.
    pub sampling: Option<Sampling>,
    /// Figures to compare with.
    pub published: Option<Published>,
}

impl Study {
    /// More drawn machines than this are a slip of the pen: their run would take days.
    pub const MOST_SAMPLES: usize = 1_000_000_000;

    /// The test piece.
    pub fn piece(&self) -> &dyn TestPiece {
        self.test_piece.piece()
    }

    /// U = k·u of every index if the rule asks for it; the larger of the two u counts.
    pub fn expanded_mm(&self, indices: &[Index]) -> Option<Vec<f64>> {
        let Decision::Guarded { coverage } = self.decision else { return None };
        let u = |i: &Index| i.spread.map_or(i.u_mm, |s| s.u_mm.max(i.u_mm));
        Some(indices.iter().map(|i| coverage * u(i)).collect())
    }

    /// The same of standard uncertainties, mm.
    pub fn expanded_of(&self, u_mm: &[f64]) -> Option<Vec<f64>> {
        let Decision::Guarded { coverage } = self.decision else { return None };
        Some(u_mm.iter().map(|u| coverage * u).collect())
    }

    /// The verdict on index values by the study's rule; `expanded_mm` as from
    /// [`Study::expanded_mm`].
    ///
    /// # Errors
    /// Indices that are not finite.
    pub fn judge(
        &self,
        values_mm: &[f64],
        expanded_mm: Option<&[f64]>,
    ) -> Result<Verdict, trueaxis_part::Error> {
        let acceptance = match expanded_mm {
            None => Acceptance::Simple,
            Some(expanded_mm) => Acceptance::GuardBand { expanded_mm },
        };
        self.tolerances.judge(self.piece().index_names(), values_mm, acceptance)
    }
}

/// Reads a study file and everything that it names; all problems at once.
pub fn read_study(files: &Files, path: &Path) -> (Option<Study>, Diagnostics) {
    let mut problems = Diagnostics::new();
    let Some(text) = files.text(path, "a study file (TOML)", &mut problems) else {
        return (None, problems);
    };
    parse_study(files, path, &text)
}

/// The same of a text; what it names is looked for beside `path`.
pub fn parse_study(files: &Files, path: &Path, text: &str) -> (Option<Study>, Diagnostics) {
    let file = path.display().to_string();
    let source = SourceText::from(files, &file, text);
    let study = source.read(|root| read(root, path));
    let problems = source.finish();
    (study.filter(|_| !problems.has_errors()), problems)
}

fn read(root: &Section<'_>, path: &Path) -> Option<Study> {
    let folder = path.parent().unwrap_or(Path::new(""));
    let name = root.require("name", "give the study a name").and_then(|i| i.text());
    let (machine_path, machine) = running_machine(root, path).unzip();
    let temperatures = StudyTemperatures::read(root, folder, true);
    let machine = machine.and_then(|m| temperatures.warm(root, m));
    let hint = "the file of the test piece, relative to the study file";
    let piece_path = root.require("test_piece", hint).and_then(|i| i.text());
    let test_piece = piece_path.and_then(|p| TestPieceFile::named_in(root, &folder.join(p)));
    let decision = root.section("decision", read_decision);
    let sampling = root.section("monte_carlo", |s| read_sampling(s, Study::MOST_SAMPLES));
    let published = root.section("published", |s| read_published(s, test_piece.as_ref()));
    let (Some(machine), Some(test_piece)) = (machine, test_piece) else {
        // The rest needs both; do not call it unknown.
        root.entries();
        return None;
    };
    let (machine, mut what_if) = read_what_if(root, read_tool(root, machine, &test_piece));
    let set_up = root.get("set_up").map_or(Some(None), |item| read_set_up(&item, root, folder));
    let machine = with_length(root, machine, set_up.flatten(), &mut what_if);
    let tolerances = match root.get("tolerances").map(|item| item.text()) {
        Some(path) => path.and_then(|p| read_tolerance_file(root, &folder.join(p))),
        None => Some(test_piece.tolerances.clone()),
    };
    let reference = read_reference(root, &machine);
    let variants = root.section("compare", |s| read_variants(s, &machine, &reference));
    let decision = decision.unwrap_or(Some(Decision::Simple));
    check_uncertainties(root, decision, &machine);
    let machine = read_mounting(root, machine, &test_piece)?;
    let program = read_program(root, folder, &machine);
    let servo = root.section("servo", |s| read_servo(s, &machine));
    check_servo(
        root,
        servo.is_some(),
        &test_piece,
        [
            (program.is_some(), "`program`"),
            (temperatures.running.is_some(), "a log of temperatures"),
        ],
    );
    Some(Study {
        program,
        servo,
        set_up: set_up?,
        tolerances: tolerances?,
        what_if,
        name: name?.to_owned(),
        path: path.to_owned(),
        machine_path: machine_path?,
        machine,
        test_piece,
        variants: variants.unwrap_or_default(),
        reference,
        decision: decision?,
        temperatures: temperatures.running,
        sampling: sampling.unwrap_or(Some(Sampling::default())).filter(|s| s.samples > 0),
        published,
    })
}

/// `program = "part.mpf"`: what is really cut, compensated or not.
fn read_program(root: &Section<'_>, folder: &Path, machine: &Machine) -> Option<CutProgram> {
    let name = root.get("program")?.text()?;
    let mut problems = Diagnostics::new();
    let program = CutProgram::read(root.files(), &folder.join(name), machine, &mut problems);
    root.take_over(problems);
    program
}

/// Following errors need a feed, and a path that is gone again and again.
fn check_servo(
    root: &Section<'_>,
    is_stated: bool,
    piece: &TestPieceFile,
    others: [(bool, &str); 2],
) {
    if !is_stated {
        return;
    }
    for (_, other) in others.iter().filter(|(there, _)| *there) {
        let message =
            format!("[servo] is for the path of the test piece; the study has {other} too");
        root.error("contradiction", message, "leave one of them out");
    }
    if piece.conditions.iter().all(|c| c.feed_mm_per_min.is_none()) {
        let message =
            "following errors depend on the feed, and the test piece states none".to_owned();
        root.error("no-feed", message, "[[condition]] name = \"finish\", feed = \"3 m/min\"");
    }
}

/// A guard band of nothing would pass what is not known.
pub(super) fn check_uncertainties(
    root: &Section<'_>,
    decision: Option<Decision>,
    machine: &Machine,
) {
    let Some(Decision::Guarded { .. }) = decision else { return };
    let names = errors_without_u(machine);
    if !names.is_empty() {
        let message = format!("ISO 14253-1 needs u of every error; none for {}", names.join(" "));
        let hint = "state them in the machine file (\"12 ± 1 urad\"), or say rule = \"simple\"";
        root.error("no-uncertainty", message, hint);
    }
}

/// The errors whose uncertainty the machine file does not state.
pub(super) fn errors_without_u(machine: &Machine) -> Vec<String> {
    let stated = machine.stated_errors();
    let without = stated.iter().filter(|(index, name)| {
        let body = &machine.bodies()[index.body];
        body.stated(name.kind, name.component).is_some_and(|s| s.u.is_none())
    });
    let mut names: Vec<String> = without.map(|(_, name)| name.to_string()).collect();
    names.extend(machine.coefficients_without_u());
    names
}

/// A file with `source` and `[tolerance]`, used instead of the tolerances of the test piece.
fn read_tolerance_file(root: &Section<'_>, path: &Path) -> Option<Tolerances> {
    let mut problems = Diagnostics::new();
    let text = root.files().text(path, "a tolerance file (TOML)", &mut problems);
    let tolerances = text.and_then(|text| {
        let file = path.display().to_string();
        let source = SourceText::new(&file, &text);
        let tolerances = source.read(Tolerances::read);
        problems.append(source.finish());
        tolerances
    });
    root.take_over(problems);
    tolerances
}

/// `[tool] name = "…"` or `length = "…"`; without it the tool of the machine file.
fn read_tool(root: &Section<'_>, machine: Machine, piece: &TestPieceFile) -> Machine {
    let tip = root.section("tool", |s| {
        let length = s.get("length");
        let name = s.get("name");
        if length.is_some() == name.is_some() {
            let message = "the tool is given by its name or by its length".to_owned();
            s.error("one-tool", message, "keep one of `name` and `length`");
        }
        let named = name.and_then(|item| named_length(&item, &machine, piece));
        let length_mm = length.and_then(|item| item.quantity_of(Quantity::ToolLength)).or(named);
        length_mm.map(|length_mm| Vec3::new(0.0, 0.0, -length_mm))
    });
    match tip.flatten() {
        Some(tip) => machine.with_tip(tip),
        None => machine,
    }
}

fn named_length(item: &Item<'_>, machine: &Machine, piece: &TestPieceFile) -> Option<f64> {
    let name = item.text()?;
    let tool = machine.tools().iter().find(|t| t.name == name);
    if tool.is_none() {
        let known: Vec<_> = machine.tools().iter().map(|t| t.name.as_str()).collect();
        let message = format!("the machine file has no tool `{name}`");
        let hint = match known.is_empty() {
            true => "it has no [tool.library]; give a `length` instead".to_owned(),
            false => format!("its tools: {}", known.join(", ")),
        };
        item.error("unknown-tool", message, &hint);
    }
    let Shape::Cone(cone) = &piece.shape;
    let wanted = cone.size().tool_diameter_mm;
    if let Some(other) = tool.and_then(|t| t.diameter_mm).filter(|d| *d != wanted) {
        let message = format!("`{name}` has a diameter of {other} mm");
        let hint = format!("the path of the test piece is made for {wanted} mm");
        item.warn("other-diameter", message, &hint);
    }
    tool.map(|t| t.length_mm)
}

/// `[what_if] EA0A = "-450 urad"`, `EZ0t = "0 ± 3 um"`: location errors that are replaced in this study; without
/// an uncertainty that of the machine file stays.
fn read_what_if(root: &Section<'_>, machine: Machine) -> (Machine, Vec<String>) {
    let mut changed = machine;
    let mut named = Vec::new();
    let mut words = Vec::new();
    root.section("what_if", |s| {
        for (key, place, item) in s.entries() {
            let name = ErrorName::parse(key).filter(|n| n.kind == ErrorKind::Location);
            let Some(name) = name else {
                let message = format!("`{key}` is no location error of ISO 230-1");
                s.error_at(place, "unknown-error-name", message, "such as EC0Y, EX0C, EA0t");
                continue;
            };
            if named.contains(&name) {
                let message = format!("{name} is given twice");
                s.error_at(place, "duplicate-error", message, "keep one of its spellings");
                continue;
            }
            named.push(name);
            let rotation = name.component.is_rotation();
            let dimension = if rotation { Dimension::Angle } else { Dimension::Length };
            let Some(value) = item.measured(dimension) else { continue };
            match changed.clone().with_location(name, value.value) {
                Some(machine) => {
                    changed = match (machine.error_index(name), value.u) {
                        (Some(index), Some(u)) => {
                            let stated = StatedError::constant(value.value, Some(u));
                            machine.with_error(index, Some(stated))
                        }
                        _ => machine,
                    };
                    words.push(format!("{name} = {}", item.as_text().unwrap_or_default()));
                }
                None => {
                    let message = format!("{name}: the chain has no body {}", name.body);
                    s.error_at(place, "unknown-body", message, "name a body of the chain, w or t");
                }
            }
        }
    });
    (changed, words)
}

/// `[mounting] fixture = "3100 1250 -1200 mm"`: the fixture of the test piece there; without it
/// the workpiece stands where the machine file states.
fn read_mounting(root: &Section<'_>, machine: Machine, piece: &TestPieceFile) -> Option<Machine> {
    if let Some(item) = root.get("mounting") {
        let fixture = item.section("mounting", |s| {
            let hint = "where the fixture stands: fixture = \"3100 1250 -1200 mm\"";
            s.require("fixture", hint).and_then(|i| read_pose(&i))
        })??;
        let Some(mounting) = piece.mounting else {
            let hint = "give it a [mounting], or mount the workpiece in the machine file";
            item.error("no-mounting", "the test piece says not how it is mounted".into(), hint);
            return None;
        };
        return Some(machine.with_workpiece(fixture, mounting.fixture_from_workpiece().relabel()));
    }
    if let Some(mounting) = piece.mounting {
        let wanted = mounting.fixture_from_workpiece();
        let have = &machine.bodies()[0].mounting;
        if (wanted.linear() - have.linear()).amax() > 1e-9 {
            root.warn(
                "other-mounting",
                "the machine file mounts the workpiece at another angle than the test piece".into(),
                "the machine file counts; with [mounting] fixture = \"…\" the test piece would",
            );
        }
    }
    Some(machine)
}

fn read_reference(root: &Section<'_>, machine: &Machine) -> Reference {
    let setting = root.section("setting", |s| read_setting(s, machine, &[]));
    let datum = root.section("datum", read_datum);
    Reference {
        setting: setting.flatten().unwrap_or_default(),
        datum: datum.flatten().unwrap_or_default(),
    }
}

/// The key of the datum beside the keys of a setting point.
const HOLE: &str = "reference_hole_depth";

/// `C = "90 deg"`, `A = "10 deg"`, or `perfect = true`; `others` are keys that someone else reads.
pub(super) fn read_setting(
    section: &Section<'_>,
    machine: &Machine,
    others: &[&str],
) -> Option<Setting> {
    let perfect = section.get("perfect").and_then(|i| i.flag()).unwrap_or(false);
    let mut rotary = Command::default();
    for (key, place, item) in section.entries() {
        if key == "perfect" || others.contains(&key) {
            continue;
        }
        let axis = key.chars().next().filter(|_| key.len() == 1).and_then(BodyName::new);
        let index = axis.and_then(|name| machine.axis_index(name));
        let index = index.filter(|&i| machine.axes()[i].kind == AxisKind::Rotary);
        let Some(index) = index else {
            let message = format!("the machine has no rotary axis `{key}`");
            let hint = "the setting point fixes the rotary axes; the linear ones follow from it";
            section.error_at(place, "unknown-axis", message, hint);
            continue;
        };
        if perfect {
            let message = format!("a perfect zero does not depend on {key}");
            let hint = "take out the axis, or perfect = true";
            section.error_at(place, "contradiction", message, hint);
        }
        rotary[index] = item.quantity(Dimension::Angle).unwrap_or(0.0);
    }
    Some(if perfect { Setting::Perfect } else { Setting::Touched { rotary } })
}

/// The key of the other datum.
const BEST_FIT: &str = "best_fit";

/// `reference_hole_depth = "40 mm"`, or `best_fit = true`.
fn read_datum(section: &Section<'_>) -> Option<DatumAxis> {
    if let Some(item) = section.get(BEST_FIT) {
        if section.get(HOLE).is_some() {
            let message = "the datum is the hole or the best fit".to_owned();
            item.error("contradiction", message, "take one of them out");
        }
        return item.flag()?.then_some(DatumAxis::BestFit);
    }
    let item = section.get(HOLE)?;
    let depth_mm = item.quantity(Dimension::Length)?;
    if depth_mm <= 0.0 {
        let hint = "its axis comes from two points of the hole";
        item.error("not-positive", "a reference hole has a depth".into(), hint);
        return None;
    }
    Some(DatumAxis::ReferenceHole { depth_mm })
}

/// `[compare."zero touched with the tool tilted"] C = "90 deg", A = "10 deg"`.
fn read_variants(section: &Section<'_>, machine: &Machine, studied: &Reference) -> Vec<Variant> {
    let mut variants = Vec::new();
    for (name, _, item) in section.entries() {
        let reference = item.section(&section.path(name), |s| {
            let datum = read_datum(s);
            let moved = s.entries().iter().any(|(key, ..)| ![HOLE, BEST_FIT].contains(key));
            let setting = if moved { read_setting(s, machine, &[HOLE, BEST_FIT]) } else { None };
            Reference {
                setting: setting.unwrap_or(studied.setting),
                datum: datum.unwrap_or(studied.datum),
            }
        });
        if let Some(reference) = reference {
            variants.push(Variant { name: name.to_owned(), reference });
        }
    }
    variants
}

/// `rule = "simple"` or `rule = "ISO 14253-1"` with `coverage = 2`.
pub(super) fn read_decision(section: &Section<'_>) -> Option<Decision> {
    let coverage = section.get("coverage").map_or(Some(2.0), |i| i.number());
    let item = section.require("rule", "rule = \"simple\" or \"ISO 14253-1\"")?;
    match item.text()? {
        "simple" => {
            if let Some(unused) = section.get("coverage") {
                let message = "the simple rule has no coverage factor".to_owned();
                unused.error("contradiction", message, "take it out, or rule = \"ISO 14253-1\"");
            }
            Some(Decision::Simple)
        }
        "ISO 14253-1" => {
            let coverage = coverage?;
            if coverage <= 0.0 {
                item.error("not-positive", "the coverage factor is above zero".into(), "k = 2");
                return None;
            }
            Some(Decision::Guarded { coverage })
        }
        other => {
            let hint = "write simple or ISO 14253-1";
            item.error("unknown-word", format!("`{other}` is no rule of decision"), hint);
            None
        }
    }
}

/// `samples = 100000`, `seed = 7`; 0 samples: no run.
pub(super) fn read_sampling(section: &Section<'_>, most: usize) -> Option<Sampling> {
    let default = Sampling::default();
    let samples = section.get("samples").map_or(Some(default.samples), |item| {
        let samples = item.count()?;
        if samples > most {
            let hint = format!("at most {most}; 10000 give u of an index to 1 %");
            item.error("too-many-samples", "the run would take too long".into(), &hint);
        }
        Some(samples)
    })?;
    let seed = section.get("seed").map_or(Some(default.seed as usize), |i| i.count())?;
    if samples == 1 {
        section.error("too-few-samples", "one sample has no spread".into(), "0, or 2 and more");
        return None;
    }
    Some(Sampling { samples, seed: seed as u64 })
}

/// `source = "…"`, and per index `roundness_mzc = { measured = ["0.038 mm", …], predicted = … }`.
fn read_published(section: &Section<'_>, piece: Option<&TestPieceFile>) -> Published {
    let source = section.text("source").unwrap_or_default().to_owned();
    let mut rows = Vec::new();
    for (key, place, item) in section.entries() {
        if key == "source" {
            continue;
        }
        if let Some(piece) = piece {
            let known: Vec<_> = piece.piece().index_names().iter().map(|n| n.key).collect();
            if !known.contains(&key) {
                let message = format!("the test piece has no index `{key}`");
                let hint = format!("its indices: {}", known.join(", "));
                section.error_at(place, "unknown-index", message, &hint);
            }
        }
        let row = item.section(&section.path(key), |s| {
            let measured = s.get("measured").and_then(|i| i.list()).unwrap_or_default();
            let measured_mm =
                measured.iter().filter_map(|i| i.quantity(Dimension::Length)).collect();
            let predicted_mm = s.quantity("predicted", Dimension::Length);
            let note = s.text("note").unwrap_or_default().to_owned();
            PublishedRow { key: key.to_owned(), measured_mm, predicted_mm, note }
        });
        rows.extend(row);
    }
    Published { source, rows }
}
