//! Reads the file of an RTCP calibration and the tables that it names.

use super::angles::Angles;
use super::centres::Centres;
use super::control::{MachineZero, Names, Slot, Slots};
use super::segments::read_segments;
use super::study::{ReadingSet, RtcpStudy, SAME_RAD, spread};
use super::table::{LARGE_MM, read_rows, read_table};
use std::path::Path;
use trueaxis_geometry::Vec3;
use trueaxis_input::plausible::Quantity;
use trueaxis_input::{Diagnostics, Dimension, Files, Item, Section, SourceText};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::AxisKind;
use trueaxis_machine::errors::BodyName;
use trueaxis_machine::file::{machine_of, read_tip, read_vector_mm};
use trueaxis_machine::twist::Reference;
use trueaxis_measure::instruments::instrument::{SetupError, SetupUnknown, Sight};
use trueaxis_measure::measure::path::Placing;
use trueaxis_measure::measure::{Instrument, Kind};

/// More sets are a slip of the pen.
const MOST_SETS: usize = 50;
/// Poses that are turned by less give little information; perhaps they were meant in rad.
const LITTLE_RAD: f64 = 0.2;

/// What a file is read for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Purpose {
    /// Every table has readings.
    Result,
    /// NC programs: poses are enough.
    Programs,
}

/// Reads an RTCP file with its machine and its tables.
pub fn read_rtcp(files: &Files, path: &Path, purpose: Purpose) -> (Option<RtcpStudy>, Diagnostics) {
    let mut problems = Diagnostics::new();
    let Some(text) = files.text(path, "a file of an RTCP calibration (TOML)", &mut problems) else {
        return (None, problems);
    };
    parse_rtcp(files, path, &text, purpose)
}

/// The same of a text; machine and tables are looked for beside `path`.
pub fn parse_rtcp(
    files: &Files,
    path: &Path,
    text: &str,
    purpose: Purpose,
) -> (Option<RtcpStudy>, Diagnostics) {
    let file = path.display().to_string();
    let source = SourceText::from(files, &file, text);
    let study = source.read(|root| read(root, path, purpose));
    let problems = source.finish();
    (study.filter(|_| !problems.has_errors()), problems)
}

fn read(root: &Section<'_>, path: &Path, purpose: Purpose) -> Option<RtcpStudy> {
    let folder = path.parent().unwrap_or(Path::new(""));
    let name = root.require("name", "say which machine, when").and_then(|i| i.text());
    let found = machine_of(root, path);
    let item = root.get("machine");
    let date = root.get("date").and_then(|i| i.date_or_text());
    let errors = root.get("errors");
    let (Some(item), Some((machine_path, machine))) = (item, found) else {
        root.entries();
        return None;
    };
    let mut machine = match errors.as_ref().map(|i| i.text()) {
        None | Some(Some("stated")) => machine,
        Some(Some("none")) => without_errors(machine),
        Some(other) => {
            if let (Some(other), Some(item)) = (other, &errors) {
                let message = format!("`{other}` is no way to take the errors of the machine file");
                item.error("unknown-choice", message, "\"stated\" (default) or \"none\"");
            }
            machine
        }
    };
    let tool_u_mm = root.section("tool", |s| read_tool(s, &mut machine)).flatten();
    let centres = match Centres::of(&machine) {
        Ok(centres) => centres,
        Err(why) => {
            let hint = "a machine file with two rotary and three linear axes";
            item.error("no-centres", why.to_string(), hint);
            root.entries();
            return None;
        }
    };
    let n = centres.terms.len();
    let control = root
        .get("control")
        .map(|item| item.section("control", |s| read_control(s, &machine, &centres)).flatten());
    let control = match control {
        Some(None) => {
            root.entries();
            return None;
        }
        Some(control) => control,
        None => None,
    };
    let mut angles = Angles::of(&machine, &centres);
    angles.wanted = root.get("angles").and_then(|i| read_angles(&i)).unwrap_or(false);
    let segments = root.section("segments", read_segments).flatten();
    let mut study = RtcpStudy {
        name: name?.to_owned(),
        path: path.to_owned(),
        machine_path,
        set_for_mm: vec![0.0; n],
        now: Vec::new(),
        decimals: 4,
        slots: None,
        machine,
        centres,
        angles,
        segments,
        tool_u_mm: tool_u_mm.unwrap_or([0.0; 2]),
        sets: Vec::new(),
        date,
    };
    if let Some((slots, now, decimals)) = control {
        study.set_for_mm = slots.offsets_of(&now);
        (study.slots, study.now, study.decimals) = (Some(slots), now, decimals);
        check_now(root, &study);
    }
    root.require("readings", "[readings.c-axis] rtcp = true, table = \"c.csv\", …");
    root.section("readings", |section| {
        let sets = section.entries();
        if sets.len() > MOST_SETS {
            let message = format!("{} sets of readings are more than anybody takes", sets.len());
            section.error("too-many-sets", message, &format!("at most {MOST_SETS}"));
        }
        for (key, _, item) in sets.into_iter().take(MOST_SETS) {
            let read = |s: &Section<'_>| read_set(s, key, (&study, purpose), folder);
            let set = item.section(&section.path(key), read);
            study.sets.extend(set.flatten());
        }
    });
    check(root, &study);
    Some(study)
}

fn without_errors(mut machine: Machine) -> Machine {
    for (index, _) in machine.stated_errors() {
        machine = machine.with_error(index, None);
    }
    machine
}

/// Whether the directions of the axes are unknowns.
fn read_angles(item: &Item<'_>) -> Option<bool> {
    let hint = "\"stated\" (default: the directions of the rotary axes are those of the machine file) or \"found\"";
    choice(item, ["stated", "found"], "the angles are not taken so", hint)
}

/// `[tool]`: the tip, and how well it is known.
fn read_tool(section: &Section<'_>, machine: &mut Machine) -> Option<[f64; 2]> {
    if let Some(tip) = section.get("tip") {
        *machine = machine.clone().with_tip(read_tip(&tip)?);
    }
    let u = |key: &str| {
        let Some(item) = section.get(key) else { return Some(0.0) };
        let u = item.quantity(Dimension::Length)?;
        if u < 0.0 {
            item.error("bad-size", format!("`{key}` is a standard uncertainty"), "\"1 um\"");
        }
        Some(u.max(0.0))
    };
    Some([u("centring")?, u("length")?])
}

/// `[control]`: names, what stands there now, decimals.
#[allow(clippy::type_complexity)] // why: three parts of one section that part ways at once
fn read_control(
    section: &Section<'_>,
    machine: &Machine,
    centres: &Centres,
) -> Option<(Slots, Vec<(usize, f64)>, u8)> {
    let item = section.require("names", Names::KNOWN)?;
    let zero = section.get("zero").map(|item| match item.text() {
        Some("gauge line") => Some(MachineZero::GaugeLine),
        Some("tip") => Some(MachineZero::Tip),
        Some(other) => {
            let message = format!("machine coordinates do not count to `{other}`");
            item.error("unknown-choice", message, "\"gauge line\" (default) or \"tip\"");
            None
        }
        None => None,
    });
    let decimals = section.get("decimals").map_or(Some(4), |i| i.count()).unwrap_or(4).min(9);
    let now = section.get("now");
    let names = item.text()?;
    let Some(names) = Names::find(names) else {
        item.error("unknown-control", format!("`{names}` is no control here"), Names::KNOWN);
        return None;
    };
    let zero = zero.unwrap_or(Some(MachineZero::default()))?;
    let slots = match Slots::of(names, machine, centres, zero) {
        Ok(slots) => slots,
        Err(why) => {
            let message = format!(
                "{} has no names for {} ({})",
                names.title(),
                machine.name(),
                centres.topology.words()
            );
            item.error(
                "unfit-control",
                format!("{message}: {why}"),
                "leave out [control], or \
                       name another control: the offsets are found all the same",
            );
            return None;
        }
    };
    let now = match now {
        Some(item) => item.section(&section.path("now"), |s| read_now(s, &slots))??,
        None => Vec::new(),
    };
    Some((slots, now, decimals as u8))
}

/// Numbers of the control by name.
fn read_now(section: &Section<'_>, slots: &Slots) -> Option<Vec<(usize, f64)>> {
    let mut now = Vec::new();
    let mut sound = true;
    for (key, _, item) in section.entries() {
        let found = slots.slots.iter().position(|s| answers_to(s, key));
        let Some(k) = found.filter(|k| !slots.slots[*k].closes) else {
            let free = slots.slots.iter().filter(|s| !s.closes).map(|s| s.name.as_str());
            let hint = free.collect::<Vec<_>>().join(", ");
            let message = match found {
                Some(_) => format!("`{key}` follows from the others"),
                None => format!("`{key}` is no number of the centres"),
            };
            item.error("unknown-key", message, &hint);
            sound = false;
            continue;
        };
        match item.quantity(Dimension::Length) {
            Some(mm) => now.push((k, mm)),
            None => sound = false,
        }
    }
    sound.then_some(now)
}

/// By the whole name, or without the part that says nothing: `MD24550[0]`, `y-offset`.
fn answers_to(slot: &Slot, key: &str) -> bool {
    let name = slot.name.as_str();
    let short = name
        .split_once(' ')
        .zip(name.find('['))
        .map(|((number, _), at)| format!("{number}{}", &name[at..]));
    let pin = name.rsplit_once("kins.").map(|(_, pin)| pin);
    key == name || short.as_deref() == Some(key) || pin == Some(key)
}

/// What stands in the control should be near what the machine file says.
fn check_now(root: &Section<'_>, study: &RtcpStudy) {
    let far = study.set_for_mm.iter().enumerate().max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
    if let Some((k, d)) = far.filter(|(_, d)| d.abs() > LARGE_MM) {
        let message = format!(
            "[control.now] and the machine file differ by {d:.3} mm in {}",
            study.centres.words(&study.machine, k)
        );
        let hint = "numbers of the control count from its machine zero; the placements of the \
                    machine file, and `zero = \"tip\"`, decide where that is";
        root.warn("far-from-machine-file", message, hint);
    }
}

fn read_set(
    section: &Section<'_>,
    name: &str,
    (study, purpose): (&RtcpStudy, Purpose),
    folder: &Path,
) -> Option<ReadingSet> {
    let tcp = section.require("rtcp", "true if RTCP (TCP, TRAORI, M128) was on, else false");
    let tcp = tcp.and_then(|i| i.flag());
    let hint = "about where the ball or mandrel stands in the workpiece frame: \"40 0 30 mm\"";
    let ball_mm = section.require("ball", hint).and_then(|i| read_vector_mm(&i));
    let noise = section.require("noise", "the standard uncertainty of a reading, such as \"1 um\"");
    let noise_mm = noise.and_then(|item| {
        let u = item.unjudged(Dimension::Length).filter(|u| *u <= 0.0);
        let u = u.or_else(|| item.quantity_of(Quantity::Noise))?;
        if u <= 0.0 {
            let message = "a reading without noise would outweigh all others".to_owned();
            item.error("no-noise", message, "such as \"1 um\"");
        }
        Some(u).filter(|u| *u > 0.0)
    });
    let hint =
        "\"spindle\" (along x y z of the spindle) or \"table\" (along those of the workpiece)";
    let in_spindle = section
        .require("indicator", hint)
        .and_then(|i| choice(&i, ["table", "spindle"], "nothing holds an indicator there", hint));
    let reads_ball = section.get("reads").map_or(Some(false), |i| {
        let hint = "\"tool\" (true − commanded, default) or \"ball\" (the other way round)";
        choice(&i, ["tool", "ball"], "nothing else is read", hint)
    });
    let found = section.get("found").map_or(Some(false), |i| i.flag());
    if section.get("reads").is_none() && found == Some(false) && purpose == Purpose::Result {
        let message = format!(
            "readings.{name}: which way its numbers count is not stated; taken is \"tool\": the tool against the ball \
             (true − commanded)"
        );
        let hint = "reads = \"tool\", or \"ball\" for the opposite: where the ball was seen (ball − tool, as a probe-ball of \
                    `identify` reads). The wrong one turns the sign of every offset";
        section.warn("reads-not-stated", message, hint);
    }
    let at = section.section("at", |s| read_at(s, &study.machine)).unwrap_or_default();
    let tip_mm = match section.get("tip") {
        Some(item) => read_vector_mm(&item),
        None => Some(study.machine.tip_mm()),
    };
    let set_for_mm = match (section.get("now"), &study.slots) {
        (None, _) => Some(study.set_for_mm.clone()),
        (Some(item), Some(slots)) => {
            let own = item.section(&section.path("now"), |s| read_now(s, slots)).flatten();
            own.map(|own| set_for(study, slots, &own))
        }
        (Some(item), None) => {
            let message = "whose numbers are these?".to_owned();
            item.error("missing-key", message, "[control] names = \"fanuc\"");
            None
        }
    };
    let table_item = section.require("table", "a CSV table: A,C,x_um,y_um,z_um")?;
    let table = read_table(section, &folder.join(table_item.text()?))?;
    let set = ReadingSet {
        name: name.to_owned(),
        tcp: tcp?,
        in_spindle: in_spindle?,
        reads_ball: reads_ball?,
        instrument: instrument(name, tip_mm?, ball_mm?, noise_mm?),
        set_for_mm: set_for_mm?,
        rows: Vec::new(),
        file: table.file.clone(),
    };
    // Axes that stand where the indicator reads zero are readings themselves.
    let found = found? || purpose == Purpose::Programs;
    read_rows(section, study, set, &table, (&at, found))
}

fn choice(item: &Item<'_>, [no, yes]: [&str; 2], wrong: &str, hint: &str) -> Option<bool> {
    let text = item.text()?;
    if text != no && text != yes {
        item.error("unknown-choice", format!("`{text}`: {wrong}"), hint);
        return None;
    }
    Some(text == yes)
}

/// The offsets with some numbers of the control changed.
fn set_for(study: &RtcpStudy, slots: &Slots, own: &[(usize, f64)]) -> Vec<f64> {
    let mut all = own.to_vec();
    all.extend(study.now.iter().filter(|(k, _)| own.iter().all(|(o, _)| o != k)));
    slots.offsets_of(&all)
}

/// The tool against a ball whose place need not be known.
fn instrument(name: &str, tip_mm: Vec3, ball_mm: Vec3, noise_mm: f64) -> Instrument {
    let free = |i: usize| SetupUnknown {
        name: format!("ball_{}", ['x', 'y', 'z'][i]),
        error: SetupError::ReferencePoint(i),
        prior_u: None,
    };
    Instrument {
        name: name.to_owned(),
        kind: Kind::ProbeBall,
        sight: Sight::Along,
        reference: Reference::Workpiece,
        tool_point_mm: tip_mm,
        reference_point_mm: ball_mm,
        direction: Vec3::x(),
        length_mm: 0.0,
        noise: [noise_mm; 3],
        unknowns: [0, 1, 2].map(free).to_vec(),
        material: None,
        reads: Default::default(),
        assumed: Default::default(),
        drift: Default::default(),
    }
}

/// Axes that stand still, by letter.
fn read_at(section: &Section<'_>, machine: &Machine) -> Vec<(BodyName, f64)> {
    let mut at = Vec::new();
    for axis in machine.axes() {
        let Some(item) = section.get(&axis.name.to_string()) else { continue };
        at.extend(item.quantity(dimension(axis.kind)).map(|q| (axis.name, q)));
    }
    at
}

fn dimension(kind: AxisKind) -> Dimension {
    match kind {
        AxisKind::Linear => Dimension::Length,
        AxisKind::Rotary => Dimension::Angle,
    }
}

/// Whether anything was turned at all.
fn check(root: &Section<'_>, study: &RtcpStudy) {
    let rotary = |(i, axis): (usize, &trueaxis_machine::axis::Axis)| {
        let of = |set: &ReadingSet| spread(set.rows.iter().map(|r| r.command[i]));
        let widest = study.sets.iter().map(of).fold(0.0, f64::max);
        (axis.kind == AxisKind::Rotary).then_some((axis.name, widest))
    };
    let turned: Vec<(BodyName, f64)> =
        study.machine.axes().iter().enumerate().filter_map(rotary).collect();
    if study.sets.is_empty() {
        return;
    }
    if turned.iter().all(|(_, by)| *by < SAME_RAD) {
        let message = "no rotary axis is turned within any set of readings".to_owned();
        let hint = "read at poses that are turned, half a turn apart if the axis can; one pose \
                    determines no centre";
        root.error("no-turned-poses", message, hint);
        return;
    }
    for (name, by) in turned.iter().filter(|(_, by)| (SAME_RAD..LITTLE_RAD).contains(by)) {
        let message = format!("{name} is turned by {:.3} deg at most", by.to_degrees());
        let hint = "its centre is known far better from wide turns; are the angles in rad? they \
                    are read as deg";
        root.warn("little-turned", message, hint);
    }
    for set in study.sets.iter().filter(|s| s.tcp) {
        if Placing::of(&study.machine, &set.instrument).is_err() {
            root.error("cannot-follow", format!("`{}`: the tip cannot be held", set.name), "");
        }
    }
}
