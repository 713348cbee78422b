//! The campaign file: on which machine, with which instruments, which unknowns.

use super::drift::{StatedDrift, read_drift};
use super::element::{element_unknowns, read_radius};
use super::material::{material_unknown, read_material};
use super::prior::read_prior_file;
use super::servo::read_servo;
use super::stages::{Stage, Stages, read_stages, warn_of_doubles};
use super::{Kind, Readings, read_table};
use crate::instruments::drift::{Drift, Walk};
use crate::instruments::instrument::{Assumed, Instrument, Reads, SetupError, SetupUnknown};
use crate::unknowns::design::Design;
use crate::unknowns::minimal::minimal_location_errors;
use crate::unknowns::term::{Shape, Term};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use trueaxis_geometry::Vec3;
use trueaxis_input::foreign;
use trueaxis_input::plausible::{Limits, Quantity};
use trueaxis_input::{CsvTable, Diagnostics, Dimension, Files, Item, Section, SourceText};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::AxisKind;
use trueaxis_machine::errors::{Component, ErrorKind, ErrorName};
use trueaxis_machine::file::{machine_of, read_direction, read_vector_mm};
use trueaxis_machine::heat::Conditions;
use trueaxis_machine::twist::Reference;

/// More instruments in one campaign are a slip of the pen.
const MOST_INSTRUMENTS: usize = 100;

/// A measurement of a machine: planned, simulated or done.
#[derive(Debug, Clone)]
pub struct Campaign {
    /// Its name.
    pub name: String,
    /// Where its files are read from.
    pub files: Files,
    /// The campaign file.
    pub path: PathBuf,
    /// The machine as its file states it, with the unknown errors, at the temperatures.
    pub machine: Machine,
    /// `[temperature]`: it holds for every machine of the campaign.
    pub conditions: Option<Conditions>,
    /// The machine file.
    pub machine_path: PathBuf,
    /// What its readings may be.
    pub limits: Limits,
    /// The unknown errors of the machine.
    pub terms: Vec<Term>,
    /// The instruments as they are set up.
    pub instruments: Vec<Instrument>,
    /// The tables of readings of each instrument.
    pub tables: Vec<Vec<PathBuf>>,
    /// What is calibrated in which order, and what an earlier campaign left.
    pub stages: Stages,
}

impl Campaign {
    /// What follows what: the machine without the unknown errors.
    pub fn design(&self) -> Design {
        let design = Design::new(&self.machine, self.terms.clone(), self.instruments.clone());
        design.with_known(self.stages.prior.as_ref().map(|prior| &prior.known))
    }

    /// An instrument by its name.
    pub fn instrument(&self, name: &str) -> Option<usize> {
        self.instruments.iter().position(|i| i.name == name)
    }

    /// Reads the tables of readings of all instruments.
    pub fn readings(&self, problems: &mut Diagnostics) -> Option<Readings> {
        let mut all = Readings::default();
        let mut sound = true;
        for (index, tables) in self.tables.iter().enumerate() {
            for path in tables {
                let what = "a table of readings (CSV)";
                let table = foreign::mapped_text(&self.files, path, what, problems)
                    .map(|text| CsvTable::parse(&path.display().to_string(), &text, problems));
                let read = table.and_then(|table| {
                    let on = (&self.machine, &self.limits);
                    read_table(&table, on, (&self.instruments, index), problems)
                });
                match read {
                    Some(read) => all.append(&read),
                    None => sound = false,
                }
            }
        }
        (sound && !problems.has_errors()).then_some(all)
    }
}

/// Reads a campaign file; `rest` reads the sections of one verb (`[[path]]`, `[truth]` …), those of
/// the others are left alone.
pub fn read_campaign<T>(
    files: &Files,
    path: &Path,
    rest: impl FnOnce(&Section<'_>, &Campaign) -> Option<T>,
) -> (Option<(Campaign, T)>, Diagnostics) {
    let mut problems = Diagnostics::new();
    let Some(text) = files.text(path, "a campaign file (TOML)", &mut problems) else {
        return (None, problems);
    };
    let file = path.display().to_string();
    let source = SourceText::from(files, &file, &text);
    let read = source.read(|root| {
        const VERBS: [&str; 10] = [
            "path",
            "limit",
            "want",
            "candidates",
            "program",
            "truth",
            "disturb",
            "fit",
            "accept",
            "compensation",
        ];
        for verb in VERBS {
            root.get(verb);
        }
        let campaign = read(root, path)?;
        let rest = rest(root, &campaign)?;
        Some((campaign, rest))
    });
    problems.append(source.finish());
    (read.filter(|_| !problems.has_errors()), problems)
}

fn read(root: &Section<'_>, path: &Path) -> Option<Campaign> {
    let folder = path.parent().unwrap_or(Path::new(""));
    let name = root.require("name", "say what is measured").and_then(|i| i.text());
    let machine = machine_of(root, path);
    let conditions = root.section("temperature", Conditions::read);
    let Some((machine_path, machine)) = machine else {
        root.entries();
        return None;
    };
    let machine = match &conditions {
        None => machine,
        Some(conditions) => {
            let mut problems = Diagnostics::new();
            let warm = machine.at(conditions, &mut problems);
            root.take_over(problems);
            let Some(warm) = warm else {
                root.entries();
                return None;
            };
            warm
        }
    };
    let terms = root.section("unknown", |s| read_unknown(s, &machine)).unwrap_or_default();
    let machine = running(root, machine, &terms);
    root.require("instrument", "[instrument.probe] kind = \"probe-ball\"");
    // Stages calibrate what they need, as a prior does.
    let assumes = root.get("stage").is_none() && root.get("prior").is_none();
    let mut instruments = Vec::new();
    let mut tables = Vec::new();
    let mut all_read = true;
    root.section("instrument", |section| {
        for (key, _, item) in section.entries().into_iter().take(MOST_INSTRUMENTS) {
            let warm = (&machine, conditions.as_ref());
            let read = |s: &Section<'_>| read_instrument(s, key, warm, (folder, assumes));
            match item.section(&section.path(key), read).flatten() {
                Some((instrument, files)) => {
                    instruments.push(instrument);
                    tables.push(files);
                }
                None => all_read = false,
            }
        }
    });
    // What names an instrument that could not be read is no error of its own.
    if !all_read {
        root.entries();
        return None;
    }
    let bare = Design::new(&machine, terms.clone(), instruments.clone());
    let mut list = read_stages(root, &bare, path);
    let prior = read_prior_file(root, &bare, folder);
    if let Some(prior) = &prior {
        warn_of_doubles(root, &bare, prior, &list);
        if list.is_empty() {
            // What is read now is compared with what was known, as one stage with another.
            let place = root.get("prior").map(|i| i.place()).unwrap_or_default();
            list.push(Stage::of_all(instruments.len(), place));
        }
    }
    Some(Campaign {
        name: name?.to_owned(),
        files: root.files().clone(),
        path: path.to_owned(),
        machine,
        conditions,
        machine_path,
        limits: root.limits(),
        terms,
        instruments,
        tables,
        stages: Stages { list, prior },
    })
}

/// The machine as its readings show it: what its control compensates by active tables is no error of it; a note says which. An
/// unknown error among them is what remains of it, which no machine file can state together with `active`.
fn running(root: &Section<'_>, machine: Machine, terms: &[Term]) -> Machine {
    let place = root.get("machine").map(|i| i.place()).unwrap_or_default();
    let mut problems = Diagnostics::new();
    let listed =
        terms.iter().map(|t| t.error).filter(|e| machine.active_compensation().contains(e));
    let listed: BTreeSet<String> = listed.map(|e| e.to_string()).collect();
    if !listed.is_empty() {
        let listed = listed.into_iter().collect::<Vec<_>>().join(" ");
        let message = format!(
            "unknown here is {listed}, whose tables are active in the control: readings show what remains of it, and a machine file \
             that states this counts it as zero as long as `active` names it"
        );
        let hint = "measure with the tables switched off and take it out of [compensation] active";
        problems.warn("already-active", place.clone(), message, hint);
    }
    let machine = machine.running("readings are those", place, &mut problems);
    root.take_over(problems);
    machine
}

/// `[unknown]`: `location = "minimal"`, `"all"` or names; `[unknown.motion] EXC = "fourier 2"`;
/// `[unknown.prior] EX0C = "0 ± 20 um"`.
fn read_unknown(section: &Section<'_>, machine: &Machine) -> Vec<Term> {
    let mut terms = match section.get("location") {
        None => Vec::new(),
        Some(item) => read_locations(&item, machine),
    };
    section.section("motion", |s| {
        for (key, _, item) in s.entries() {
            terms.extend(read_motion(&item, key, machine));
        }
    });
    section.section("servo", |s| terms.extend(read_servo(s, machine)));
    section.section("prior", |s| {
        for (key, _, item) in s.entries() {
            read_prior(&item, key, &mut terms);
        }
    });
    terms.sort_by_key(|t| t.index);
    terms
}

fn read_locations(item: &Item<'_>, machine: &Machine) -> Vec<Term> {
    let named = |item: &Item<'_>| -> Option<Term> {
        let name = item.text()?;
        let term = ErrorName::parse(name).and_then(|e| Term::location(machine, e));
        if term.is_none() {
            let message = format!("`{name}` is no location error of {}", machine.chain_text());
            item.error("unknown-error-name", message, "such as EC0Y, EX0C, EA0t");
        }
        term
    };
    if item.is_list() {
        let mut terms: Vec<Term> =
            item.list().unwrap_or_default().iter().filter_map(named).collect();
        terms.sort_by_key(|t| t.index);
        let before = terms.len();
        terms.dedup_by_key(|t| t.index);
        if terms.len() < before {
            let message = "a location error is named twice".to_owned();
            item.error("duplicate-name", message, "name each error once");
        }
        return terms;
    }
    match item.text() {
        Some("minimal") => minimal_location_errors(machine),
        Some("all") => machine
            .bodies()
            .iter()
            .filter(|b| b.axis.is_some())
            .flat_map(|b| {
                Component::ALL.map(|component| ErrorName {
                    body: b.name,
                    kind: ErrorKind::Location,
                    component,
                })
            })
            .filter_map(|e| Term::location(machine, e))
            .collect(),
        Some(_) => {
            let message = "which location errors?".to_owned();
            let hint = "\"minimal\", \"all\", or a list of names [\"EX0C\", \"EC0Y\"]";
            item.error("unknown-error-name", message, hint);
            Vec::new()
        }
        None => Vec::new(),
    }
}

/// `EXC = "fourier 2"`, or for all six of an axis `C = "fourier 2"`.
fn read_motion(item: &Item<'_>, key: &str, machine: &Machine) -> Vec<Term> {
    let Some(text) = item.text() else { return Vec::new() };
    let Some(shape) = Shape::parse(text) else {
        let hint = "\"polynomial 3\", \"polynomial 2-4\", \"fourier 2\", \"linear 7\" (knots), or \
                    \"reversal\"; each also with \" + reversal\"";
        item.error("unknown-shape", format!("`{text}` describes no error motion"), hint);
        return Vec::new();
    };
    let of_axis = |body| {
        Component::ALL.map(|component| ErrorName { body, kind: ErrorKind::Motion, component })
    };
    let axis = machine.axes().iter().find(|a| a.name.to_string() == key);
    let errors: Vec<ErrorName> = match axis {
        Some(axis) => of_axis(axis.name).to_vec(),
        None => ErrorName::parse(key).filter(|e| e.kind == ErrorKind::Motion).into_iter().collect(),
    };
    let terms: Vec<Term> = errors.iter().flat_map(|e| shape.terms(machine, *e)).collect();
    if terms.is_empty() {
        let message = format!("`{key}` is no error motion of {}", machine.chain_text());
        item.error("unknown-error-name", message, "such as EXX, ECC, or an axis: all six of it");
    }
    terms
}

fn read_prior(item: &Item<'_>, key: &str, terms: &mut [Term]) {
    let error = ErrorName::parse(key).filter(|e| e.kind == ErrorKind::Location);
    let Some(term) = terms.iter_mut().find(|t| Some(t.error) == error) else {
        let message = format!("`{key}` is not among the unknown location errors");
        return item.error("unknown-error-name", message, "name it in `location` too");
    };
    let angle = term.error.component.is_rotation();
    let dimension = if angle { Dimension::Angle } else { Dimension::Length };
    let Some(known) = item.measured(dimension) else { return };
    match known.u.filter(|u| *u > 0.0) {
        Some(u) => term.prior = Some((known.value, u)),
        None => {
            let message = "what is known before needs its standard uncertainty".to_owned();
            item.error("no-uncertainty", message, "such as \"0 ± 20 um\"");
        }
    }
}

fn read_instrument(
    section: &Section<'_>,
    name: &str,
    (machine, conditions): (&Machine, Option<&Conditions>),
    (folder, assumes): (&Path, bool),
) -> Option<(Instrument, Vec<PathBuf>)> {
    let kinds = Kind::all().map(Kind::name).collect::<Vec<_>>().join(", ");
    let item = section.require("kind", &kinds)?;
    let kind = Kind::find(item.text()?);
    let Some(kind) = kind else {
        item.error("unknown-instrument", "no instrument is called that".into(), &kinds);
        section.entries();
        return None;
    };
    let point = |key: &str| section.get(key).and_then(|i| read_vector_mm(&i));
    let tool_point_mm = point(kind.tool_point()).unwrap_or(machine.tip_mm());
    let reference_point_mm = point(kind.reference_point()).unwrap_or_else(Vec3::zeros);
    let direction = section.get("direction").and_then(|i| read_direction(&i));
    let noise = section.require("noise", "the standard uncertainty of a reading, such as \"1 um\"");
    let noise = noise.and_then(|i| read_noise(&i, kind));
    let length_mm = match kind.element() {
        Some(element) => read_radius(section, element, direction.is_some()),
        None => section.quantity("length", Dimension::Length).unwrap_or(0.0),
    };
    if kind == Kind::TouchProbeBall && length_mm <= 0.0 {
        let message = "how far is the centre of the stylus from the centre of the ball?".to_owned();
        section.error(
            "missing-key",
            message,
            "length = \"15 mm\": radius of the ball + of the stylus",
        );
    }
    let reference = section.get("stands_on").and_then(|i| read_reference(&i));
    let material = read_material(section, kind, machine, conditions);
    let towards = direction.unwrap_or(Vec3::x());
    let (mut unknowns, walk) = match section.get("unknown") {
        None => (kind.usual_setup(), Walk::default()),
        Some(item) => {
            item.section(&section.path("unknown"), |s| read_unknowns(s, kind, towards, machine))?
        }
    };
    let material = material?;
    unknowns.extend(material.as_ref().and_then(material_unknown));
    let reads = section.get("reads").map(|i| read_reads(&i, kind));
    let length = assumed_length(machine, kind, &unknowns).filter(|_| assumes);
    let assumed = Assumed { reads: reads.is_none(), length: length.is_some() };
    unknowns.extend(length);
    let tables = section.get("readings").map(|i| read_tables(&i, folder)).unwrap_or_default();
    Some((
        Instrument {
            name: name.to_owned(),
            kind,
            sight: kind.sight(),
            reference: reference.unwrap_or_default(),
            tool_point_mm,
            reference_point_mm,
            direction: towards,
            length_mm,
            noise: noise?,
            unknowns,
            material,
            reads: reads.flatten().unwrap_or_default(),
            assumed,
            drift: Drift { walk, from_s: 0.0 },
        },
        tables,
    ))
}

/// How well the length of a tool is known where it is not stated: a presetter, or a length that was touched off.
pub const LENGTH_U_MM: f64 = 0.05;

/// The length of the tool as an unknown, where rotary axes make it count and the campaign says nothing of it.
fn assumed_length(machine: &Machine, kind: Kind, stated: &[SetupUnknown]) -> Option<SetupUnknown> {
    let error = SetupError::ToolPoint(2);
    let turns = machine.axes().iter().any(|a| a.kind == AxisKind::Rotary);
    let is_stated = stated.iter().any(|u| matches!(u.error, SetupError::ToolPoint(_)));
    (turns && (kind.holds_a_ball() || kind.element().is_some()) && !is_stated)
        .then(|| SetupUnknown { name: kind.unknown_name(error), error, prior_u: Some(LENGTH_U_MM) })
}

/// Which way the numbers count.
fn read_reads(item: &Item<'_>, kind: Kind) -> Option<Reads> {
    let [defined, opposite] = kind.words_of_reads();
    match item.text()? {
        word if word == defined => Some(Reads::AsDefined),
        word if word == opposite => Some(Reads::Opposite),
        other => {
            let message = format!("a {} does not read `{other}`", kind.name());
            let hint = match kind {
                Kind::ProbeBall => {
                    "\"ball\": ball − socket, where the ball was seen; \"tool\": socket − ball, the tool against the ball"
                }
                Kind::BallCentre => {
                    "\"ball\": where the ball was seen; \"tool\": where the tool stood when it was sent to the ball"
                }
                _ => {
                    "\"deviation\": true − commanded; \"correction\": what must be added, the other way round"
                }
            };
            item.error("unknown-reads", message, hint);
            None
        }
    }
}

fn read_reference(item: &Item<'_>) -> Option<Reference> {
    match item.text()? {
        "workpiece" | "table" => Some(Reference::Workpiece),
        "bed" | "floor" => Some(Reference::Bed),
        other => {
            let message = format!("nothing stands on `{other}`");
            item.error(
                "unknown-reference",
                message,
                "\"workpiece\" (the table) or \"bed\" (the floor)",
            );
            None
        }
    }
}

/// One u for all channels or a list of three.
fn read_noise(item: &Item<'_>, kind: Kind) -> Option<[f64; 3]> {
    let noise = if kind.sight().is_angle() { Quantity::AngularNoise } else { Quantity::Noise };
    let one = |item: &Item<'_>| {
        // Below zero is another mistake than above the range.
        let dimension = noise.dimension();
        let u =
            item.unjudged(dimension).filter(|u| *u <= 0.0).or_else(|| item.quantity_of(noise))?;
        if u <= 0.0 {
            let message = "a reading without noise would outweigh all others".to_owned();
            item.error(
                "no-noise",
                message,
                "the standard uncertainty of a reading, such as \"1 um\"",
            );
        }
        Some(u).filter(|u| *u > 0.0)
    };
    if !item.is_list() {
        return one(item).map(|u| [u; 3]);
    }
    let list: Vec<Option<f64>> = item.list()?.iter().map(one).collect();
    let [Some(x), Some(y), Some(z)] = list[..] else {
        item.error(
            "bad-list",
            "three channels have three".into(),
            "[\"1 um\", \"1 um\", \"2 um\"]",
        );
        return None;
    };
    Some([x, y, z])
}

fn read_tables(item: &Item<'_>, folder: &Path) -> Vec<PathBuf> {
    let items = if item.is_list() { item.list().unwrap_or_default() } else { vec![*item] };
    items.iter().filter_map(|i| i.text()).map(|p| folder.join(p)).collect()
}

/// The table of readings of an instrument where it is written; its name must not lead out of the folder.
pub fn readings_file(instrument: &str) -> String {
    let safe = |c: char| if c.is_alphanumeric() || "-_.".contains(c) { c } else { '_' };
    format!("{}.csv", instrument.chars().map(safe).collect::<String>())
}

/// `unknown` of an instrument; where nothing but a drift is stated the usual ones remain.
fn read_unknowns(
    section: &Section<'_>,
    kind: Kind,
    direction: Vec3,
    machine: &Machine,
) -> (Vec<SetupUnknown>, Walk) {
    let drift = section.get("drift").map(|i| read_drift(&i, kind, direction, machine));
    let alone = drift.is_some() && section.entries().iter().all(|(key, ..)| *key == "drift");
    let mut unknowns = if alone { kind.usual_setup() } else { read_setup(section, kind) };
    let StatedDrift { rates, walk } = drift.unwrap_or_default();
    unknowns.extend(rates);
    (unknowns, walk)
}

/// `unknown = { ball = "free", socket = "20 um", scale = "0.5 um/m" }`: free, or the standard
/// uncertainty with which it is known.
fn read_setup(section: &Section<'_>, kind: Kind) -> Vec<SetupUnknown> {
    let three = [0, 1, 2];
    let turn = format!("{}_turn", kind.reference_point());
    let mut unknowns = Vec::new();
    for (key, _, item) in section.entries().into_iter().filter(|(key, ..)| *key != "drift") {
        let (errors, dimension): (Vec<SetupError>, _) = if key == kind.tool_point() {
            (three.map(SetupError::ToolPoint).to_vec(), Dimension::Length)
        } else if key == kind.reference_point() {
            (three.map(SetupError::ReferencePoint).to_vec(), Dimension::Length)
        } else if key == turn {
            (three.map(SetupError::ReferenceTurn).to_vec(), Dimension::Angle)
        } else if key == kind.zero() {
            let zeros = (0..kind.zeros()).map(SetupError::Zero).collect();
            let angle = kind.sight().is_angle();
            (zeros, if angle { Dimension::Angle } else { Dimension::Length })
        } else if let Some(own) = element_unknowns(kind, key) {
            let angle = key == "tilt";
            (own, if angle { Dimension::Angle } else { Dimension::Length })
        } else if key == "scale" {
            (vec![SetupError::Scale], Dimension::Angle)
        } else {
            let message = format!("`{key}` is nothing of the set-up of a {}", kind.name());
            let hint = format!(
                "{}, {}, {turn}, {}, scale, drift",
                kind.tool_point(),
                kind.reference_point(),
                kind.zero()
            );
            item.error("unknown-key", message, &hint);
            continue;
        };
        let free = item.as_text() == Some("free");
        let prior_u = if free { None } else { item.quantity(dimension) };
        if !free && prior_u.is_none_or(|u| u <= 0.0) {
            continue;
        }
        unknowns.extend(errors.into_iter().map(|error| SetupUnknown {
            name: kind.unknown_name(error),
            error,
            prior_u,
        }));
    }
    unknowns
}
