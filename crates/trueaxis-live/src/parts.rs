//! The parts that runs of a plan have recorded, as the document `trueaxis/live-part/1`.

use crate::file::{Plan, read_plan};
use crate::part::{headings_of, part_heading, plan_hash_of, unknown_blocks_of};
use crate::status::{folder_of, is_linear};
use crate::store::{part_now, part_path, parts};
use serde::Serialize;
use serde_json::Value;
use std::path::PathBuf;
use trueaxis::input::{CsvTable, Diagnostics, Files, Place};
use trueaxis::questions::{Answer, Question, Tell, complete};
use trueaxis_report::JsonSchema;
use trueaxis_report::numbers::fixed;
use trueaxis_report::{Report, Section, Table, document};

/// The records of parts.
#[derive(Debug, Serialize, JsonSchema)]
pub struct LivePartDocument {
    /// Which document this is.
    #[schemars(extend("const" = "trueaxis/live-part/1"))]
    pub schema: String,
    /// The name of the plan.
    pub name: String,
    /// All parts with a record, by their names.
    pub parts: Vec<String>,
    /// The one that is made now; null if there is none.
    pub recording: Option<String>,
    /// The one that was asked for; null if none was.
    pub part: Option<LivePartEntry>,
}

/// What acted while one part was made.
#[derive(Debug, Serialize, JsonSchema)]
pub struct LivePartEntry {
    /// Its name.
    pub part: String,
    /// The file of its record.
    pub file: String,
    /// Its rows: ends of blocks, and places where X and Y stood.
    pub rows: usize,
    /// When its first row was made, seconds since 1970 (UTC); null without rows.
    pub begun_s: Option<f64>,
    /// When its last row was made, seconds since 1970 (UTC).
    pub ended_s: Option<f64>,
    /// The rows at which the correction had not followed throughout the block, the first 50.
    pub not_followed: Vec<LivePartRow>,
    /// How many these are.
    pub not_followed_count: usize,
    /// How often another run went on with it: what was made in between is not in it.
    pub interruptions: usize,
    /// Blocks of which nothing was known: they have no row.
    pub unknown_blocks: usize,
    /// The live axes.
    pub axes: Vec<LivePartAxis>,
    /// The sensors.
    pub sensors: Vec<LivePartSensor>,
}

/// One row.
#[derive(Debug, Serialize, JsonSchema)]
pub struct LivePartRow {
    /// The number of the program; 0 where the control does not say. Unit: 1.
    pub program: f64,
    /// The sequence number or line. Unit: 1.
    pub block: f64,
    /// The clock of the run, s from its start.
    pub time_s: f64,
}

/// One live axis over the rows.
#[derive(Debug, Serialize, JsonSchema)]
pub struct LivePartAxis {
    /// Its letter.
    pub axis: String,
    /// The unit of its numbers: um or urad.
    pub unit: String,
    /// The smallest and the largest that acted. Unit: that of `unit`.
    pub acted: [f64; 2],
    /// The largest that was missing or too much at the end of a block, by the model. Unit: that of `unit`.
    pub left: f64,
    /// The same anywhere in a block, rapids included. Unit: that of `unit`.
    pub left_largest: f64,
}

/// One sensor over the rows.
#[derive(Debug, Serialize, JsonSchema)]
pub struct LivePartSensor {
    /// The sensor of the machine file.
    pub sensor: String,
    /// The lowest and the highest.
    pub celsius: [f64; 2],
}

/// The parts of a plan.
#[derive(Debug, Clone)]
pub struct LivePart {
    /// The plan.
    pub plan: PathBuf,
    /// The part that is asked for.
    pub part: Option<String>,
}

/// The answer.
#[derive(Debug)]
pub struct LivePartAnswer(LivePartDocument);

/// Rows that are listed.
const MOST_ROWS: usize = 50;

impl Question for LivePart {
    type Input = (Plan, PathBuf, Option<Record>);
    type Answer = LivePartAnswer;

    fn read(&self, files: &Files, problems: &mut Diagnostics) -> Option<Self::Input> {
        let plan = problems.keep(read_plan(files, &self.plan))?;
        let folder = folder_of(&plan, problems)?;
        let Some(part) = &self.part else { return Some((plan, folder, None)) };
        if !parts(&folder).contains(part) {
            let place = Place::whole(&self.plan.display().to_string());
            let message = format!("no part `{part}` was recorded with this plan");
            problems.error("live-part", place, message, "trueaxis live part PLAN lists them");
            return None;
        }
        let path = part_path(&folder, part);
        let text = files.text(&path, "the record of a part", problems)?;
        let file = path.display().to_string();
        check_plan(&plan, (part, &text), Place::whole(&file), problems);
        let table = CsvTable::parse(&file, &text, problems);
        let unknown_blocks = unknown_blocks_of(&text);
        let record = Record { part: part.clone(), table, unknown_blocks };
        (!problems.has_errors()).then_some((plan, folder, Some(record)))
    }

    fn answer(
        &self,
        (plan, folder, part): Self::Input,
        _: Tell<'_>,
        _: &mut Diagnostics,
    ) -> Option<LivePartAnswer> {
        Some(LivePartAnswer(LivePartDocument {
            schema: "trueaxis/live-part/1".to_owned(),
            name: plan.name.clone(),
            parts: parts(&folder),
            recording: part_now(&folder),
            part: part.map(|record| entry(&plan, record)),
        }))
    }
}

/// The record of one part.
#[derive(Debug)]
pub struct Record {
    part: String,
    table: CsvTable,
    unknown_blocks: usize,
}

/// Whether a record is one of this plan: its axes and sensors are those of its own.
fn check_plan(plan: &Plan, (part, text): (&str, &str), place: Place, problems: &mut Diagnostics) {
    let hint = "show it with the plan that it was made with";
    if headings_of(text) != headings_of(&part_heading(plan, part)) {
        let message = "the record was made for other axes or sensors than those of the plan";
        problems.error("live-part", place, message.to_owned(), hint);
    } else if plan_hash_of(text) != Some(&plan.hash) {
        let message =
            "the record was begun with another plan or machine file, or they were edited since";
        problems.warn("live-part", place, message.to_owned(), hint);
    }
}

fn entry(plan: &Plan, record: Record) -> LivePartEntry {
    let Record { part, table, unknown_blocks } = record;
    let column = |name: &str| table.column(name).map_or(&[][..], |c| c.values.as_slice());
    let range = |values: &[f64]| {
        let ends = (f64::INFINITY, f64::NEG_INFINITY);
        let (low, high) = values.iter().fold(ends, |(l, h), v| (l.min(*v), h.max(*v)));
        if values.is_empty() { [0.0; 2] } else { [low, high] }
    };
    let most = |values: &[f64]| values.iter().fold(0.0_f64, |most, v| most.max(v.abs()));
    let axes = plan.axes.iter().map(|axis| {
        let (unit, name) = (if is_linear(plan, axis) { "um" } else { "urad" }, &axis.name);
        LivePartAxis {
            axis: name.clone(),
            unit: unit.to_owned(),
            acted: range(column(&format!("{name}_acted_{unit}"))),
            left: most(column(&format!("{name}_left_{unit}"))),
            left_largest: most(column(&format!("{name}_left_largest_{unit}"))),
        }
    });
    let sensors = plan.sensors.iter().map(|sensor| {
        let name = sensor.settings.input.clone();
        LivePartSensor { celsius: range(column(&format!("{name}_degC"))), sensor: name }
    });
    let at = |name: &str, row: usize| column(name).get(row).copied().unwrap_or(0.0);
    let lost = column("followed").iter().enumerate().filter(|(_, followed)| **followed == 0.0);
    let lost: Vec<usize> = lost.map(|(row, _)| row).collect();
    let shown = lost.iter().take(MOST_ROWS).map(|row| LivePartRow {
        program: at("program", *row),
        block: at("block", *row),
        time_s: at("time_s", *row),
    });
    LivePartEntry {
        part,
        file: table.file.clone(),
        rows: table.rows(),
        begun_s: column("date_s").first().copied(),
        ended_s: column("date_s").last().copied(),
        not_followed: shown.collect(),
        not_followed_count: lost.len(),
        interruptions: interruptions(column("time_s"), column("date_s")),
        unknown_blocks,
        axes: axes.collect(),
        sensors: sensors.collect(),
    }
}

/// A date and the clock of a run part by no more within a run, s.
const DRIFT_S: f64 = 2.0;

/// How often another run went on: each has a clock of its own, which begins at another date.
fn interruptions(times_s: &[f64], dates_s: &[f64]) -> usize {
    let pairs = times_s.windows(2).zip(dates_s.windows(2));
    let is_other = |(times, dates): (&[f64], &[f64])| {
        let (passed_s, by_date_s) = (times[1] - times[0], dates[1] - dates[0]);
        passed_s < 0.0 || (by_date_s - passed_s).abs() > DRIFT_S
    };
    pairs.filter(|pair| is_other(*pair)).count()
}

impl Answer for LivePartAnswer {
    fn document(&self, problems: &Diagnostics) -> Value {
        complete(document(&self.0), problems)
    }

    fn report(&self) -> Report<'_> {
        let LivePartDocument { name, parts, recording, part, .. } = &self.0;
        let report = Report::new(name);
        let report = match recording {
            Some(part) => report.line(format!("{part} is recorded now")),
            None => report.line("no part is recorded now: trueaxis live part PLAN --begin NAME"),
        };
        match part {
            None => report.section(Section::new("Parts").list(parts.clone())),
            Some(part) => part_report(report, part),
        }
    }
}

fn part_report<'a>(report: Report<'a>, part: &'a LivePartEntry) -> Report<'a> {
    let unit = |unit: &str| if unit == "um" { "µm" } else { "µrad" }.to_owned();
    let axes = part.axes.iter().map(|axis| {
        let [low, high] = axis.acted.map(|v| fixed(v, 1));
        let (left, largest) = (fixed(axis.left, 1), fixed(axis.left_largest, 1));
        [axis.axis.clone(), low, high, left, largest, unit(&axis.unit)]
    });
    let headings =
        ["axis", "acted, least", "most", "left at the end of a block", "anywhere in it", ""];
    let sensors = part.sensors.iter().map(|sensor| {
        let [low, high] = sensor.celsius.map(|v| fixed(v, 2));
        [sensor.sensor.clone(), low, high]
    });
    let rows = part
        .not_followed
        .iter()
        .map(|row| [fixed(row.program, 0), fixed(row.block, 0), fixed(row.time_s, 1)]);
    let seconds = part.begun_s.zip(part.ended_s).map_or(0.0, |(begun, ended)| ended - begun);
    let report = report
        .line(format!("{}: {} rows over {} s", part.part, part.rows, fixed(seconds, 0)))
        .line(format!("record: {}", part.file))
        .section(Section::new("What acted").table(
            Table::new(headings).rows(axes).note(
                "Motion of the tool along the axis; what was left is what acted less the target, by the model.",
            ),
        ))
        .section(Section::new("Sensors").table(Table::new(["sensor", "°C, least", "most"]).rows(sensors)));
    let lacks = [
        (part.rows == 0).then(|| "nothing is recorded yet".to_owned()),
        Some(part.interruptions).filter(|n| *n > 0).map(|n| {
            format!("{n} times another run went on with it: what was made in between is not in it")
        }),
        Some(part.unknown_blocks)
            .filter(|n| *n > 0)
            .map(|n| format!("{n} blocks of which nothing was known are not in it")),
    ];
    let lacks: Vec<String> = lacks.into_iter().flatten().collect();
    let is_whole = lacks.is_empty();
    let report = lacks.into_iter().fold(report, Report::line);
    match part.not_followed_count {
        0 if is_whole => report.line("the correction followed its target throughout"),
        0 => report,
        count => report.section(
            Section::new(format!("{count} rows without the correction, or with a part of it"))
                .table(Table::new(["program", "block", "s from the start"]).rows(rows)),
        ),
    }
}
