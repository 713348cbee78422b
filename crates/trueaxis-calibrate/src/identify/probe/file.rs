//! A study of a probe and its hits, read and checked.

use super::datums::{DialTurn, FourHits, ZSteps};
use super::hit::{Gauge, GaugeKind, Hit, Side};
use super::hits_file::{Reading, Setup, parse_hits};
use super::lobing::LobingModel;
use super::log::{Planned, ProbeLog, is_ring_log, parse_plane_log, parse_ring_log};
use super::program::{ProgramSettings, read_program};
use crate::identify::records::table_mark;
use std::path::Path;
use trueaxis_geometry::Vec3;
use trueaxis_input::sheet::{Cells, Sheet};
use trueaxis_input::{
    Diagnostics, Dimension, Files, Item, MeasuredValue, Section, SourceText, parse_quantity,
};

/// Harmonics that are tried unless the study says otherwise.
const MOST_HARMONICS: usize = 12;
/// Directions of the table of the control, as in Zhang et al. 2023.
const STEPS: usize = 60;
/// More than these are a slip.
const LARGEST_COUNT: usize = 3600;
/// Tables of one study.
const MOST_TABLES: usize = 200;

/// What a study is read for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Purpose {
    /// Its hits.
    Result,
    /// Its hits, to correct others by them: they must be as they were measured.
    Calibration,
    /// The programs that make the hits: there may be none yet.
    Programs,
}

/// What is known, what was touched, and where the hits are.
#[derive(Debug, Clone)]
pub struct Study {
    /// The file as the user named it.
    pub file: String,
    /// In words.
    pub name: String,
    /// How the table goes on between the hits.
    pub model: LobingModel,
    /// The highest harmonic that is tried.
    pub most_harmonics: usize,
    /// Directions of the table of the control.
    pub table_steps: usize,
    /// What was touched.
    pub gauge: Gauge,
    /// What touched it.
    pub styli: Vec<Stylus>,
    /// A dial against the ball.
    pub eccentricity: Option<DialTurn>,
    /// Reference tool, gauge block, ring.
    pub z_datum: Option<ZSteps>,
    /// Four hits.
    pub xy_datum: Option<FourHits>,
    /// How the hits are made.
    pub program: Option<ProgramSettings>,
}

/// One stylus with its hits.
#[derive(Debug, Clone)]
pub struct Stylus {
    /// Its name.
    pub name: String,
    /// Radius of its ball as stated, mm.
    pub ball_radius_mm: f64,
    /// What the control writes down.
    pub reading: Reading,
    /// The hits of the calibration.
    pub hits: Vec<Hit>,
    /// Hits in fresh directions that only check it.
    pub check: Vec<Hit>,
}

/// Where the tables of a study come from.
pub struct Tables<'a> {
    /// The text of a table by its name in the study.
    pub load: &'a dyn Fn(&str, &mut Diagnostics) -> Option<String>,
    /// What to call it in messages.
    pub show: &'a dyn Fn(&str) -> String,
}

/// Reads a study and the hits that it names.
pub fn read_study(files: &Files, path: &Path, purpose: Purpose) -> (Option<Study>, Diagnostics) {
    let mut problems = Diagnostics::new();
    let Some(text) = files.text(path, "a study of a touch probe (TOML)", &mut problems) else {
        return (None, problems);
    };
    let beside = |name: &str| path.parent().unwrap_or(Path::new("")).join(name);
    let load = |name: &str, problems: &mut Diagnostics| {
        files.text(&beside(name), "a table of hits (CSV)", problems)
    };
    let show = |name: &str| beside(name).display().to_string();
    let tables = Tables { load: &load, show: &show };
    let file = path.display().to_string();
    let study = problems.keep(parse_study(&file, &text, &tables, purpose));
    (study, problems)
}

/// The same for a text and tables that need not lie on a disk.
pub fn parse_study(
    file: &str,
    text: &str,
    tables: &Tables<'_>,
    purpose: Purpose,
) -> (Option<Study>, Diagnostics) {
    let source = SourceText::new(file, text);
    let study = source.read(|root| read(root, file, (tables, purpose)));
    let problems = source.finish();
    (study.filter(|_| !problems.has_errors()), problems)
}

fn read(
    root: &Section<'_>,
    file: &str,
    (tables, purpose): (&Tables<'_>, Purpose),
) -> Option<Study> {
    // Every key is asked for before anything is given up, or it would count as unknown.
    let name = root.require("name", "say which probe").and_then(|i| i.text()).map(str::to_owned);
    root.text("source");
    let names = LobingModel::ALL.map(|(model, name)| (name, model));
    let model = choice(root, "model", &names).unwrap_or(LobingModel::Fourier);
    let most_harmonics = count(root, "most_harmonics", MOST_HARMONICS, 2);
    let table_steps = count(root, "table_steps", STEPS, 4);
    let ring = root.section("ring", |s| read_gauge(s, GaugeKind::Ring));
    let sphere = root.section("sphere", |s| read_gauge(s, GaugeKind::Sphere));
    let gauge = match (ring, sphere) {
        (Some(gauge), None) | (None, Some(gauge)) => gauge,
        (ring, _) => {
            let message = match ring {
                Some(_) => "a study is about one gauge: a ring or a sphere".to_owned(),
                None => "neither [ring] nor [sphere] is there".to_owned(),
            };
            let hint = "[ring] diameter = \"62 mm\", centre = \"0 0 mm\"";
            root.error("missing-gauge", message, hint);
            None
        }
    };
    if model == LobingModel::Spline && gauge.as_ref().is_some_and(|g| g.kind == GaugeKind::Sphere) {
        let message = "a spline goes around a ring only".to_owned();
        root.error("unsuitable-model", message, "on a sphere: model = \"fourier\"");
    }
    let program = root.section("program", read_program);
    let logs = Logs { tables, purpose, program: program.as_ref().and_then(Option::as_ref) };
    let styli = read_styli(root, gauge.as_ref(), &logs);
    let eccentricity = root.section("eccentricity", |s| read_dial(s, tables)).flatten();
    let z_datum = root.section("z_datum", |s| read_z(s, &logs)).flatten();
    let four = root.section("xy_datum", |s| read_four(s, gauge.as_ref(), &logs)).flatten();
    Some(Study {
        file: file.to_owned(),
        name: name?,
        model,
        most_harmonics,
        table_steps,
        gauge: gauge?,
        styli: styli?,
        eccentricity,
        z_datum,
        xy_datum: four,
        program: match program {
            Some(stated) => Some(stated?),
            None => None,
        },
    })
}

/// Where hits come from, and what was planned of them.
struct Logs<'a> {
    tables: &'a Tables<'a>,
    purpose: Purpose,
    program: Option<&'a ProgramSettings>,
}

impl Logs<'_> {
    fn planned(&self, hits: Option<usize>) -> Option<Planned> {
        let program = self.program?;
        Some(Planned { hits: hits.unwrap_or(program.directions), tool: Some(program.tool) })
    }

    /// The log that a datum names; hits that are corrected already say nothing of the probe.
    fn of_datum(
        &self,
        section: &Section<'_>,
        read: ReadLog,
        hits: Option<usize>,
    ) -> Option<ProbeLog> {
        let item = section.get("log")?;
        let name = item.text()?;
        let mut found = Diagnostics::new();
        let planned = hits.and_then(|hits| self.planned(Some(hits)));
        let log = (self.tables.load)(name, &mut found)
            .and_then(|text| read(&(self.tables.show)(name), &text, planned, &mut found));
        section.take_over(found);
        let log = log?;
        if log.is_corrected {
            let message = "the control has corrected these hits: they say nothing of the probe";
            item.error(
                "corrected-log",
                message.to_owned(),
                "the log of the program without correction",
            );
            return None;
        }
        Some(log)
    }
}

type ReadLog = fn(&str, &str, Option<Planned>, &mut Diagnostics) -> Option<ProbeLog>;

fn choice<T: Copy>(section: &Section<'_>, key: &str, names: &[(&str, T)]) -> Option<T> {
    let item = section.get(key)?;
    let text = item.text()?;
    let found = names.iter().find(|(name, _)| *name == text);
    if found.is_none() {
        let known: Vec<String> = names.iter().map(|(n, _)| format!("\"{n}\"")).collect();
        let message = format!("`{text}` is not known here");
        item.error("unknown-word", message, &known.join(" or "));
    }
    found.map(|(_, value)| *value)
}

fn count(root: &Section<'_>, key: &str, default: usize, least: usize) -> usize {
    let Some(item) = root.get(key) else { return default };
    let Some(value) = item.count() else { return default };
    if !(least..=LARGEST_COUNT).contains(&value) {
        let message = format!("{value} is not from {least} to {LARGEST_COUNT}");
        item.error("bad-count", message, &format!("{key} = {default}"));
    }
    value.min(LARGEST_COUNT)
}

fn positive(section: &Section<'_>, key: &str, hint: &str) -> Option<MeasuredValue> {
    let item = section.require(key, hint)?;
    let found = item.measured(Dimension::Length)?;
    if found.value <= 0.0 {
        item.error("not-positive", format!("{} mm is not positive", found.value), hint);
        return None;
    }
    Some(found)
}

fn read_gauge(section: &Section<'_>, kind: GaugeKind) -> Option<Gauge> {
    let diameter = positive(section, "diameter", "diameter = \"62 ± 0.0005 mm\"");
    let wanted = if kind == GaugeKind::Ring { 2 } else { 3 };
    let centre = section.get("centre").map(|item| read_centre(&item, wanted));
    let u_centre = section.get("centre_u").map(|item| (item, item.quantity(Dimension::Length)));
    if let Some((item, Some(u))) = &u_centre
        && *u < 0.0
    {
        let message = format!("{u} mm is below zero");
        item.error("negative-uncertainty", message, "centre_u = \"0.5 um\"");
    }
    if let (Some((item, _)), None) = (&u_centre, &centre) {
        let message = "the uncertainty of a centre that is not stated".to_owned();
        item.error("missing-key", message, "centre = \"0 0 mm\"");
    }
    let side = match kind {
        GaugeKind::Ring => {
            let sides = [("inside", Side::Inside), ("outside", Side::Outside)];
            choice(section, "side", &sides).unwrap_or(Side::Inside)
        }
        GaugeKind::Sphere => Side::Outside,
    };
    let centre_mm = match centre {
        Some(stated) => Some(stated?),
        None => None,
    };
    let diameter = diameter?;
    Some(Gauge {
        kind,
        side,
        radius_mm: 0.5 * diameter.value,
        u_radius_mm: 0.5 * diameter.u.unwrap_or(0.0),
        centre_mm,
        u_centre_mm: u_centre.and_then(|u| u.1).unwrap_or(0.0),
    })
}

fn read_centre(item: &Item<'_>, wanted: usize) -> Option<Vec3> {
    let text = item.text()?;
    let mut words: Vec<&str> = text.split_whitespace().collect();
    let unit = words.pop().unwrap_or_default();
    let read = |word: &&str| parse_quantity(&format!("{word} {unit}"), Dimension::Length);
    let values: Result<Vec<f64>, _> = words.iter().map(read).collect();
    match values {
        Ok(v) if v.len() == wanted => Some(Vec3::from_fn(|i, _| v.get(i).copied().unwrap_or(0.0))),
        _ => {
            let message = format!("`{text}` is not {wanted} lengths");
            let hint =
                "numbers, then the unit, such as \"0 0 mm\" (ring) or \"0 0 -200 mm\" (sphere)";
            item.error("bad-vector", message, hint);
            None
        }
    }
}

fn read_styli(root: &Section<'_>, gauge: Option<&Gauge>, logs: &Logs<'_>) -> Option<Vec<Stylus>> {
    let hint = "[stylus.NAME] ball_diameter = \"4 mm\", hits = [\"ring.csv\"]";
    let item = root.require("stylus", hint)?;
    let mut styli = Vec::new();
    let mut sound = true;
    item.section("stylus", |all| {
        for (name, _, item) in all.entries() {
            let path = format!("stylus.{name}");
            let found = item.section(&path, |s| read_stylus(s, name, gauge, logs)).flatten();
            sound &= found.is_some();
            styli.extend(found);
        }
        if all.entries().is_empty() {
            all.error("missing-key", "no stylus is named".to_owned(), hint);
            sound = false;
        }
    })?;
    sound.then_some(styli)
}

fn read_stylus(
    section: &Section<'_>,
    name: &str,
    gauge: Option<&Gauge>,
    logs: &Logs<'_>,
) -> Option<Stylus> {
    let ball = positive(section, "ball_diameter", "ball_diameter = \"4 mm\"");
    let reading = choice(section, "reading", &Reading::ALL.map(|(r, name)| (name, r)));
    let before = logs.purpose == Purpose::Programs;
    let hits = match section.get("hits") {
        // Programs are written before there are hits.
        None if before => Some(Vec::new()),
        Some(item) => item.list(),
        None => section.require("hits", "hits = [\"ring.csv\"]").and_then(|i| i.list()),
    };
    let check = section.get("check").map(|i| i.list());
    let (gauge, ball) = (gauge?, ball?);
    let ball_radius_mm = 0.5 * ball.value;
    if gauge.contact_mm(ball_radius_mm) <= 0.0 {
        let message = "the ball does not fit into the ring".to_owned();
        section.error("wrong-size", message, "are diameters of ring and ball swapped?");
        return None;
    }
    let setup = Setup {
        gauge,
        ball_radius_mm,
        reading: reading.unwrap_or(Reading::Spindle),
        orientation_rad: 0.0,
        on_gauge: true,
    };
    let (hits, check) = match (before, check) {
        (true, _) => (Vec::new(), Vec::new()),
        (false, None) => (read_tables(section, &hits?, (&setup, false), logs)?, Vec::new()),
        (false, Some(list)) => (
            read_tables(section, &hits?, (&setup, false), logs)?,
            read_tables(section, &list?, (&setup, true), logs)?,
        ),
    };
    Some(Stylus { name: name.to_owned(), ball_radius_mm, reading: setup.reading, hits, check })
}

/// All hits of a list of tables, each `"a.csv"` or `{ table = "a.csv", orientation = "180 deg" }`.
fn read_tables(
    section: &Section<'_>,
    list: &[Item<'_>],
    (setup, checks): (&Setup<'_>, bool),
    logs: &Logs<'_>,
) -> Option<Vec<Hit>> {
    let tables = logs.tables;
    let (mut hits, mut named, mut sound) = (Vec::new(), Vec::new(), true);
    let mut read: Vec<(String, &str)> = Vec::new();
    for item in list.iter().take(MOST_TABLES) {
        let (name, orientation_rad) = match item.is_table() {
            false => (item.text(), None),
            true => item
                .section("hits", |s| {
                    let table = s.require("table", "table = \"ring.csv\"").and_then(|i| i.text());
                    (table, s.quantity("orientation", Dimension::Angle))
                })
                .unwrap_or_default(),
        };
        let Some(name) = name else {
            sound = false;
            continue;
        };
        if named.contains(&name) {
            let message = format!("`{name}` is named twice");
            let hint = "hits and their copy are no two witnesses";
            item.error("duplicate-table", message, hint);
            sound = false;
            continue;
        }
        named.push(name);
        let mut found = Diagnostics::new();
        let own = Setup { orientation_rad: orientation_rad.unwrap_or(0.0), ..*setup };
        let text = (tables.load)(name, &mut found);
        let shown = (tables.show)(name);
        let mark = text.as_deref().map(table_mark);
        if let Some((_, twin)) = read.iter().find(|(known, _)| mark.as_ref() == Some(known)) {
            let message = format!("`{name}` has the same readings as `{twin}`");
            let hint = "hits and their copy are no two witnesses";
            item.error("duplicate-table", message, hint);
            sound = false;
            continue;
        }
        read.extend(mark.map(|mark| (mark, name)));
        let rows = text.and_then(|text| match is_ring_log(&text) {
            true => ring_hits(item, (&shown, &text), (setup, checks), logs, &mut found),
            false => parse_hits(&shown, &text, &own, &mut found),
        });
        section.take_over(found);
        sound &= rows.is_some();
        hits.extend(rows.into_iter().flatten());
    }
    sound.then_some(hits)
}

/// Hits of the log of a program: it says directions and orientation itself, and has the spindle.
fn ring_hits(
    item: &Item<'_>,
    (shown, text): (&str, &str),
    (setup, checks): (&Setup<'_>, bool),
    logs: &Logs<'_>,
    found: &mut Diagnostics,
) -> Option<Vec<Hit>> {
    let refuse = |code, message: &str, hint: &str| {
        item.error(code, message.to_owned(), hint);
        None
    };
    if setup.gauge.kind != GaugeKind::Ring {
        return refuse("other-log", "the log of a ring, but the study is about a sphere", "[ring]");
    }
    if item.is_table() {
        let hint = "hits = [\"ring-hits.log\"]";
        return refuse("other-log", "the log says the orientation of the spindle itself", hint);
    }
    if setup.reading == Reading::Point {
        let hint = "leave out reading = \"point\"";
        return refuse("wrong-reading", "the log has positions of the spindle, not points", hint);
    }
    // Hits of a check are in other directions than those of the calibration.
    let planned = if checks { None } else { logs.planned(None) };
    let log = parse_ring_log(shown, text, planned, found)?;
    if log.is_corrected && logs.purpose == Purpose::Calibration {
        let message =
            "the control has corrected these hits: other hits cannot be corrected by them";
        return refuse("corrected-log", message, "the log of the program without correction");
    }
    if log.is_corrected && checks {
        let message = "the control has corrected these hits: a check with them corrects them twice";
        let hint =
            "name them as `hits` of a study of their own: what it finds is what the table leaves";
        return refuse("corrected-log", message, hint);
    }
    if log.is_corrected {
        let message =
            "the control has corrected these hits: what is found here is what its table leaves";
        let hint = "for a calibration take the log of the program without correction";
        item.warn("corrected-log", message.to_owned(), hint);
    }
    Some(log.hits)
}

fn read_dial(section: &Section<'_>, tables: &Tables<'_>) -> Option<DialTurn> {
    let at_rad = section.quantity("at", Dimension::Angle).unwrap_or(0.0);
    let name = section.require("table", "columns angle_deg,reading_um")?.text()?;
    let mut found = Diagnostics::new();
    let readings = (tables.load)(name, &mut found).and_then(|text| {
        let sheet = Sheet::parse(&(tables.show)(name), &text, |_| Cells::Numbers, &mut found)?;
        let (Some(angle), Some(reading)) = (sheet.about("angle"), sheet.about("reading")) else {
            let message = "the table lacks `angle_deg` or `reading_um`".to_owned();
            let hint = "angle of the spindle, reading of the dial (plunger in: positive)";
            found.error("missing-column", sheet.headings_place(), message, hint);
            return None;
        };
        let angles = sheet.inner(angle, Dimension::Angle, &mut found)?;
        let readings = sheet.inner(reading, Dimension::Length, &mut found)?;
        Some(angles.into_iter().zip(readings).collect())
    });
    section.take_over(found);
    let turn = DialTurn { at_rad, readings: readings? };
    if super::datums::eccentricity(&turn).is_none() {
        let message = format!("{} readings do not determine the eccentricity", turn.readings.len());
        section.error("too-few-hits", message, "four readings or more around a whole turn");
        return None;
    }
    Some(turn)
}

fn read_z(section: &Section<'_>, logs: &Logs<'_>) -> Option<ZSteps> {
    let length = positive(section, "reference_length", "reference_length = \"100 ± 0.001 mm\"");
    let block = positive(section, "block", "block = \"50 ± 0.0002 mm\"");
    let hint = "the spindle when the reference tool touches the block on the ring";
    let reference = section.require("reference_z", hint);
    let reference = reference.and_then(|i| i.measured(Dimension::Length));
    let names = section.get("log").is_some();
    let stated = section.get("probe_z");
    let probe_z_mm = match stated {
        _ if logs.purpose == Purpose::Programs => Some(vec![0.0]),
        None if names => {
            let hits = logs.program.and_then(|p| p.face).map(|f| f.hits);
            let log = logs.of_datum(section, parse_plane_log, hits);
            log.map(|log| log.hits.iter().map(|h| h.spindle_mm.z).collect())
        }
        Some(item) if names => {
            let message = "both `probe_z` and `log` are stated".to_owned();
            item.error("two-readings", message, "keep one of them");
            None
        }
        Some(item) => item
            .list()
            .and_then(|list| list.into_iter().map(|i| i.quantity(Dimension::Length)).collect()),
        None => {
            let hint = "probe_z = [\"-210.012 mm\"], or log = \"z-datum.log\"";
            section.require("probe_z", hint);
            None
        }
    };
    let probe_z_mm: Vec<f64> = probe_z_mm?;
    if probe_z_mm.is_empty() {
        let message = "no trigger is stated".to_owned();
        section.error("too-few-hits", message, "probe_z = [\"-210.012 mm\"]");
        return None;
    }
    Some(ZSteps {
        reference_length_mm: length?,
        block_mm: block?,
        reference_z_mm: reference?,
        probe_z_mm,
    })
}

/// The spindle at X+, X−, Y+, Y−, stated or from a log.
fn four_places(section: &Section<'_>, logs: &Logs<'_>) -> Option<[f64; 4]> {
    let names = ["x_plus", "x_minus", "y_plus", "y_minus"];
    if section.get("log").is_none() {
        let hint = "the spindle at the trigger, such as \"28.97 mm\"; or log = \"four-hits.log\"";
        let hits = names.map(|key| section.require(key, hint));
        let hits = hits.map(|h| h.and_then(|i| i.quantity(Dimension::Length)));
        let [Some(a), Some(b), Some(c), Some(d)] = hits else { return None };
        return Some([a, b, c, d]);
    }
    let stated: Vec<Item<'_>> = names.iter().filter_map(|key| section.get(key)).collect();
    if let Some(item) = stated.first() {
        let message = "both places and `log` are stated".to_owned();
        item.error("two-readings", message, "keep one of them");
        return None;
    }
    let log = logs.of_datum(section, parse_ring_log, Some(4))?;
    let along = |x: f64, y: f64| {
        let near = |h: &&Hit| h.direction.dot(&Vec3::new(x, y, 0.0)) > 0.999_999;
        log.hits.iter().find(near).map(|h| if x == 0.0 { h.spindle_mm.y } else { h.spindle_mm.x })
    };
    let found = [along(1.0, 0.0), along(-1.0, 0.0), along(0.0, 1.0), along(0.0, -1.0)];
    let [Some(a), Some(b), Some(c), Some(d)] = found else {
        let message = "the log has not the four directions D0, D180, D90, D270".to_owned();
        section.error("other-directions", message, "the log of four-hits, not that of the ring");
        return None;
    };
    Some([a, b, c, d])
}

fn read_four(section: &Section<'_>, gauge: Option<&Gauge>, logs: &Logs<'_>) -> Option<FourHits> {
    if logs.purpose == Purpose::Programs {
        section.entries();
        return None;
    }
    let [a, b, c, d] = four_places(section, logs)?;
    let gauge = gauge?;
    let Some(centre) = gauge.centre_mm.filter(|_| gauge.kind == GaugeKind::Ring) else {
        let message =
            "four hits determine the offset only with a known centre of a ring".to_owned();
        section.error("missing-key", message, "[ring] centre = \"0 0 mm\"");
        return None;
    };
    if a <= b || c <= d {
        let message = "the hit in the positive direction is not beyond that in the negative one";
        let hint = "within a ring x_plus is the greater; are they swapped?";
        section.error("wrong-side", message.to_owned(), hint);
        return None;
    }
    let centre_mm = [centre.x, centre.y];
    Some(FourHits { hits_mm: [a, b, c, d], centre_mm, ring_radius_mm: gauge.radius_mm })
}
