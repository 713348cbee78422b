//! `live.toml`: the plan of a run, read and checked as a whole before anything is opened.

mod axes;
mod control;
mod datum;
mod opcua;
mod sensors;
mod sources;

pub use axes::{AxisPlan, Commissioned, RIGHT, WRONG};
pub use control::{Bound, ControlPlan, FanucPlan, LinuxCncPlan};
pub use datum::PlannedDatum;
pub use opcua::{OpcUaPlan, OpcUaServer, Security};
pub use sensors::{SensorPlan, Source};

use crate::control::Mode;
use crate::governor::{AfterHold, OnDifference, Settings};
use crate::line::at_positions;
use crate::model::Part;
use std::path::{Path, PathBuf};
use trueaxis::compensate::not_twice;
use trueaxis::input::{Diagnostics, Dimension, Files, Item, Place, Section, SourceText};
use trueaxis::machine::Machine;
use trueaxis::machine::axis::Command;
use trueaxis::predict::holes::Compensation;

/// The plan of a run.
#[derive(Debug, Clone)]
pub struct Plan {
    /// The file.
    pub path: PathBuf,
    /// Its name.
    pub name: String,
    /// The machine; what tables in the control compensate is no error any more.
    pub machine: Machine,
    /// Which error is compensated.
    pub of: Compensation,
    /// Which part of it.
    pub part: Part,
    /// The control.
    pub control: ControlPlan,
    /// The live axes.
    pub axes: Vec<AxisPlan>,
    /// The sensors.
    pub sensors: Vec<SensorPlan>,
    /// The limits and policies.
    pub settings: Settings,
    /// Of the loop.
    pub period_s: f64,
    /// Where the zero of the part was touched without any correction, if the plan says so.
    pub datum: Option<PlannedDatum>,
    /// Where journal and state are kept; by default in the folder of the user for such files.
    pub folder: Option<PathBuf>,
    /// Of the text of the plan and of the machine, in hexadecimal: a journal and a record belong to one plan.
    pub hash: String,
}

impl Plan {
    /// Values of each axis at a position, from those of a control: two, of the ends of the travel, where it corrects along a line.
    pub fn at_position(&self, values: impl Iterator<Item = f64>, at: &Command) -> Vec<f64> {
        at_positions(self.axes.iter().map(|axis| (axis.line, at[axis.axis])), values).collect()
    }

    /// The same where no position is known: the larger of two.
    pub fn largest(&self, counts: &[i32]) -> Vec<f64> {
        let own = |live| counts.get(self.offsets_of(live)).unwrap_or_default();
        let largest =
            |live| own(live).iter().max_by_key(|n| n.abs()).map_or(0.0, |n| f64::from(*n));
        (0..self.axes.len()).map(largest).collect()
    }

    /// Which offsets of the control are those of a live axis.
    pub fn offsets_of(&self, live: usize) -> std::ops::Range<usize> {
        let from: usize = self.axes.iter().take(live).map(AxisPlan::offsets).sum();
        from..from + self.axes.get(live).map_or(0, AxisPlan::offsets)
    }
}

/// Reads a plan with all that it names.
pub fn read_plan(files: &Files, path: &Path) -> (Option<Plan>, Diagnostics) {
    read_for(files, path, false)
}

/// The same of a plan whose axes are yet to be commissioned.
pub fn read_plan_to_commission(files: &Files, path: &Path) -> (Option<Plan>, Diagnostics) {
    read_for(files, path, true)
}

fn read_for(files: &Files, path: &Path, commissions: bool) -> (Option<Plan>, Diagnostics) {
    let mut problems = Diagnostics::new();
    let Some(text) = files.text(path, "the plan of a live run (TOML)", &mut problems) else {
        return (None, problems);
    };
    let file = path.display().to_string();
    let source = SourceText::from(files, &file, &text);
    let read = source.read(|root| read(root, path, commissions));
    problems.append(source.finish());
    let plan = read.map(|mut plan| {
        plan.hash = hash(&[&text, &format!("{:?}", plan.machine)]);
        plan
    });
    (plan.filter(|_| !problems.has_errors()), problems)
}

/// FNV-1a with 64 bits: it tells whether two texts are the same, not who wrote them.
fn hash(texts: &[&str]) -> String {
    let bytes = texts.iter().flat_map(|text| text.bytes());
    let sum = bytes.fold(0xcbf2_9ce4_8422_2325u64, |sum, byte| {
        (sum ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    });
    format!("{sum:016x}")
}

fn read(root: &Section<'_>, path: &Path, commissions: bool) -> Option<Plan> {
    let folder = path.parent().unwrap_or(Path::new(""));
    let name = root.text("name").map(str::to_owned);
    let machine = read_machine(root, folder);
    let correction = root.section("correction", read_correction);
    let Some(machine) = machine else {
        // The rest needs the machine; do not call it unknown.
        root.entries();
        return None;
    };
    let (of, part, without_part) =
        correction.unwrap_or((Compensation::Comprehensive, Part::Whole, false));
    check_of(root, &machine, of, without_part);
    let mut axes = axes::read_axes(root, &machine);
    let control = control::read_control(root, folder, &machine, (&axes, commissions));
    check_pose(root, &machine, of, control.as_ref());
    let pose = control.as_ref().is_some_and(ControlPlan::takes_pose);
    let sensors = sensors::read_sensors(root, folder, &machine, (&axes, of, pose));
    let datum = sensors.as_deref().and_then(|sensors| {
        root.section("datum", |section| datum::read_datum(section, &machine, sensors)).flatten()
    });
    let (period_s, window_s) = root.section("cycle", read_cycle).unwrap_or((0.05, 0.5));
    let policy = root.section("policy", read_policy).unwrap_or_default();
    let journal = root.section("journal", |s| s.text("folder").map(|text| folder.join(text)));
    let control = control?;
    axes.iter_mut().enumerate().for_each(|(i, axis)| axis.line = control.line(i));
    // Of a line both ends have the limits of the axis.
    let limits = axes.iter().flat_map(|axis| std::iter::repeat_n(axis.limits, axis.offsets()));
    let settings = Settings {
        axes: limits.collect(),
        window_s,
        hold_s: policy.hold_s,
        after_hold: policy.after_hold,
        ramp_in_cut: policy.ramp_in_cut,
        modes: policy.modes,
        on_difference: policy.on_difference,
        ladder_ramps: control.has_watchdog(),
    };
    Some(Plan {
        path: path.to_owned(),
        name: name.unwrap_or_else(|| machine.name().to_owned()),
        machine,
        of,
        part,
        control,
        axes,
        sensors: sensors?,
        settings,
        period_s,
        datum,
        folder: journal.flatten(),
        hash: String::new(),
    })
}

fn read_machine(root: &Section<'_>, folder: &Path) -> Option<Machine> {
    let item = root.require("machine", "machine = \"machine.toml\"")?;
    let path = folder.join(item.text()?);
    let (machine, problems) = Machine::read(root.files(), &path);
    root.take_over(problems);
    let machine = machine?;
    let mut notes = Diagnostics::new();
    let machine = not_twice(&machine, Place::whole(&path.display().to_string()), &mut notes);
    root.take_over(notes);
    Some(machine)
}

/// A word of a list; a problem if it is none of them.
fn word<T: Copy>(item: &Item<'_>, known: &[(&str, T)]) -> Option<T> {
    let text = item.text()?;
    let found = known.iter().find(|(name, _)| *name == text);
    if found.is_none() {
        let names: Vec<&str> = known.iter().map(|(name, _)| *name).collect();
        item.error("unknown-word", format!("`{text}` is not known here"), &names.join(", "));
    }
    found.map(|(_, value)| *value)
}

fn read_correction(section: &Section<'_>) -> (Compensation, Part, bool) {
    let kinds =
        [("comprehensive", Compensation::Comprehensive), ("machine", Compensation::Machine)];
    let parts = [("whole", Part::Whole), ("thermal", Part::Thermal)];
    let of = section.get("of").and_then(|item| word(&item, &kinds));
    let part = section.get("part").and_then(|item| word(&item, &parts));
    let without = section.get("without_part").and_then(|item| item.flag());
    (of.unwrap_or(Compensation::Comprehensive), part.unwrap_or(Part::Whole), without == Some(true))
}

/// The machine alone under a workpiece that grows makes the part worse: only where there is no part.
fn check_of(root: &Section<'_>, machine: &Machine, of: Compensation, without_part: bool) {
    if of == Compensation::Machine && machine.heat().workpiece.is_some() && !without_part {
        let message = "the correction of the machine alone makes the part worse: its scales then no longer grow with the workpiece".to_owned();
        let hint = "[correction] of = \"comprehensive\" with a sensor on the workpiece; for a laser without a part: without_part = true";
        match root.get("correction") {
            Some(item) => item.error("live-machine-only", message, hint),
            None => root.error("live-machine-only", message, hint),
        }
    }
}

/// The pose is that of the tool in the part: there is no form of it for the machine alone.
fn check_pose(
    root: &Section<'_>,
    machine: &Machine,
    of: Compensation,
    control: Option<&ControlPlan>,
) {
    let alone = of == Compensation::Machine && machine.heat().workpiece.is_some();
    if alone && control.is_some_and(ControlPlan::takes_pose) {
        let message =
            "this control takes the pose of the tool in the workpiece: the machine alone has none"
                .to_owned();
        let hint = "[correction] of = \"comprehensive\", or a machine file without [workpiece]";
        root.error("live-machine-only", message, hint);
    }
}

/// A time above zero.
fn time(section: &Section<'_>, key: &str, usual_s: f64) -> f64 {
    let Some(item) = section.get(key) else { return usual_s };
    let Some(found) = item.unjudged(Dimension::Time) else { return usual_s };
    if found <= 0.0 {
        item.error("not-positive", format!("`{key}` is above zero"), "such as \"500 ms\"");
        return usual_s;
    }
    found
}

fn read_cycle(section: &Section<'_>) -> (f64, f64) {
    (time(section, "period", 0.05), time(section, "window", 0.5))
}

struct Policy {
    hold_s: f64,
    after_hold: AfterHold,
    ramp_in_cut: bool,
    modes: Vec<Mode>,
    on_difference: OnDifference,
}

impl Default for Policy {
    fn default() -> Self {
        Self {
            hold_s: 5.0,
            after_hold: AfterHold::Stay,
            ramp_in_cut: false,
            modes: vec![Mode::Automatic],
            on_difference: OnDifference::Latch,
        }
    }
}

fn read_policy(section: &Section<'_>) -> Policy {
    let usual = Policy::default();
    let hold_s = time(section, "hold", usual.hold_s);
    let after = [("stay", AfterHold::Stay), ("ramp", AfterHold::Ramp)];
    let after_hold = section.get("after_hold").and_then(|item| word(&item, &after));
    let ramp_in_cut = section.get("ramp_in_cut").and_then(|item| item.flag()).unwrap_or(false);
    let modes = section.get("modes").and_then(|item| {
        let modes = item.list()?;
        if modes.is_empty() {
            let message = "without a mode the offsets never change".to_owned();
            item.error("bad-list", message, "modes = [\"automatic\"]");
        }
        modes.iter().map(|mode| word(mode, &Mode::NAMED)).collect::<Option<Vec<_>>>()
    });
    let difference = [("latch", OnDifference::Latch), ("adopt", OnDifference::Adopt)];
    let on_difference = section.get("on_difference").and_then(|item| word(&item, &difference));
    Policy {
        hold_s,
        after_hold: after_hold.unwrap_or(usual.after_hold),
        ramp_in_cut,
        modes: modes.unwrap_or(usual.modes),
        on_difference: on_difference.unwrap_or(usual.on_difference),
    }
}
