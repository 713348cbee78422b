//! The state of a run, as the document `trueaxis/live-status/1`, a report, and the question that reads it.

use crate::control::Identity;
use crate::cycle::Correction;
use crate::file::{AxisPlan, Plan, read_plan};
use crate::governor::{Reason, State};
use crate::history::{LiveHistory, history};
use crate::run::{Counts, Cycle};
use crate::store::{Event, is_running, last_events, last_state, own_folder};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::path::PathBuf;
use trueaxis::input::{Diagnostics, Files, Place};
use trueaxis::machine::axis::AxisKind;
use trueaxis::questions::{Answer, Question, Tell, complete};
use trueaxis_report::JsonSchema;
use trueaxis_report::numbers::fixed;
use trueaxis_report::{Report, Section, Table, document};

/// The state of a live run, or what the last run has left.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct LiveStatusDocument {
    /// Which document this is.
    #[schemars(extend("const" = "trueaxis/live-status/1"))]
    pub schema: String,
    /// The name of the plan.
    pub name: String,
    /// Whether a run is going on now.
    pub running: bool,
    /// The last state that is known; null if the plan never ran here.
    pub last: Option<LiveState>,
    /// The last changes of state, the oldest first.
    #[serde(default)]
    pub events: Vec<LiveEventEntry>,
    /// The last hours; null if they were not asked for.
    #[serde(default)]
    pub history: Option<LiveHistory>,
}

/// A change of state.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct LiveEventEntry {
    /// When, seconds since 1970 (UTC).
    pub date_s: u64,
    /// The clock of its run, s from its start.
    pub time_s: f64,
    /// The state.
    pub state: String,
    /// Why.
    pub reason: String,
}

/// The state after one cycle.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct LiveState {
    /// The state.
    pub state: State,
    /// Why it is in that state, in words.
    pub reason: String,
    /// The same for programs.
    pub cause: Reason,
    /// The clock of the run, s from its start.
    pub time_s: f64,
    /// When it was written, seconds since 1970 (UTC).
    pub date_s: u64,
    /// Which error is compensated: comprehensive, or that of the machine alone.
    pub of: String,
    /// The plan and machine file that the run began with; an edited file has no effect on it.
    pub plan_hash: String,
    /// The control, as it says it: kind, series and version.
    pub control: Vec<String>,
    /// The live axes.
    pub axes: Vec<LiveAxisEntry>,
    /// The sensors.
    pub sensors: Vec<LiveSensorEntry>,
    /// The feed along the path; null without a link.
    pub feed_mm_per_min: Option<f64>,
    /// An axis has used four fifths of its limit.
    pub near_limit: bool,
    /// An offset is late by more than the `lag` of its axis: the feed is too fast for the period.
    #[serde(default)]
    pub lagging: bool,
    /// An axis stands outside its travel: its error is that of the end.
    pub outside_travel: bool,
    /// The part whose record is filled; null without one.
    #[serde(default)]
    pub part: Option<String>,
    /// The number of the setup that is in the machine; null where the control does not say.
    #[serde(default)]
    pub setup: Option<i32>,
    /// Cycles so far.
    pub cycles: u64,
    /// Periods in which no cycle began.
    pub missed: u64,
    /// Writes of offsets so far.
    pub writes: u64,
    /// Writes that failed.
    pub failed_writes: u64,
}

/// One live axis.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct LiveAxisEntry {
    /// Its letter.
    pub axis: String,
    /// The unit of its numbers: um or urad.
    pub unit: String,
    /// The position of the program, mm or deg; null without a link. Unit: mm or deg.
    pub position: Option<f64>,
    /// The offset that the control holds, in the unit. Unit: that of `unit`.
    pub offset: Option<f64>,
    /// The offset that acts, where the control reports it. Unit: that of `unit`.
    pub acting: Option<f64>,
    /// The part of the offset that this program has written. Unit: that of `unit`.
    pub own: f64,
    /// Where it goes. Unit: that of `unit`.
    pub target: Option<f64>,
    /// Its limit. Unit: that of `unit`.
    pub limit: f64,
    /// How far the offset is late, because the target moves and the position is two periods old; null without two targets.
    /// Unit: that of `unit`.
    #[serde(default)]
    pub lag: Option<f64>,
    /// What was missing when the zero of the part was touched, and is subtracted; of tip and tool axis together X, Y and Z of the
    /// tip in the workpiece. Null without such a zero. Unit: that of `unit`.
    #[serde(default)]
    pub datum: Option<f64>,
}

/// One sensor.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct LiveSensorEntry {
    /// Its name.
    pub sensor: String,
    /// The sensor of the machine file that it is.
    pub input: String,
    /// Its temperature; null if it cannot be used.
    pub celsius: Option<f64>,
    /// The age of its last good sample.
    pub age_s: Option<f64>,
    /// Why it cannot be used.
    pub fault: Option<String>,
    /// The sensor that stands in for it.
    pub instead: Option<String>,
}

impl LiveStatusDocument {
    fn of(name: &str, running: bool, last: Option<LiveState>) -> Self {
        let (schema, name) = ("trueaxis/live-status/1".to_owned(), name.to_owned());
        Self { schema, name, running, last, events: Vec::new(), history: None }
    }
}

/// The state after a cycle.
pub fn live_state(
    plan: &Plan,
    control: &Identity,
    cycle: &Cycle,
    correction: &Correction,
    counts: Counts,
) -> LiveState {
    let at = cycle.output.programmed;
    let counted =
        |list: &[i32]| at.map(|at| plan.at_position(list.iter().map(|n| f64::from(*n)), &at));
    let own = plan.largest(&correction.governor().corrections());
    let own = counted(&correction.governor().corrections()).unwrap_or(own);
    let datum = |i: usize| correction.datum().and_then(|datum| datum.missing.get(i)).copied();
    let order = &cycle.output.order;
    let seen = cycle.input.seen.as_ref().ok();
    let offsets = seen.and_then(|seen| counted(&seen.offsets));
    let acting = seen.and_then(|seen| counted(seen.acting.as_ref()?));
    let lag = cycle.output.lag.as_ref().zip(at);
    let lag = lag.map(|(lag, at)| plan.at_position(lag.iter().copied(), &at));
    let target = cycle.output.target.as_ref().map(|target| &target.here);
    let axes = plan.axes.iter().enumerate().map(|(i, axis)| {
        let is_linear = is_linear(plan, axis);
        let scale = axis.increment * if is_linear { 1e3 } else { 1e6 };
        let shown = |list: &Vec<f64>| list.get(i).map(|n| n * scale);
        let position = at.map(|at| at[axis.axis]);
        LiveAxisEntry {
            axis: axis.name.clone(),
            unit: if is_linear { "um" } else { "urad" }.to_owned(),
            position: position.map(|at| if is_linear { at } else { at.to_degrees() }),
            offset: offsets.as_ref().and_then(shown),
            acting: acting.as_ref().and_then(shown),
            own: shown(&own).unwrap_or(0.0),
            target: target.and_then(shown),
            limit: f64::from(axis.limits.limit) * scale,
            datum: datum(i).map(|missing| missing * if is_linear { 1e3 } else { 1e6 }),
            lag: lag.as_ref().and_then(shown),
        }
    });
    let sensors =
        plan.sensors.iter().zip(&cycle.output.sensors).map(|(sensor, judged)| LiveSensorEntry {
            sensor: sensor.settings.name.clone(),
            input: sensor.settings.input.clone(),
            celsius: judged.celsius.as_ref().ok().copied(),
            age_s: judged.age_s,
            fault: judged.celsius.as_ref().err().map(ToString::to_string),
            instead: judged.instead.map(|i| plan.sensors[i].settings.name.clone()),
        });
    LiveState {
        state: order.state,
        reason: order.reason.to_string(),
        cause: order.reason.clone(),
        time_s: cycle.input.now_s,
        date_s: crate::clock::date_s(),
        of: plan.of.name().to_owned(),
        plan_hash: plan.hash.clone(),
        control: vec![control.kind.clone(), control.series.clone(), control.version.clone()],
        axes: axes.collect(),
        sensors: sensors.collect(),
        feed_mm_per_min: seen.map(|seen| seen.feed_mm_per_min),
        near_limit: order.near_limit,
        lagging: is_lagging(plan, cycle),
        outside_travel: cycle.output.target.as_ref().is_some_and(|t| t.is_clamped),
        part: None,
        setup: correction.setups().now(),
        cycles: counts.cycles,
        missed: counts.missed,
        writes: counts.writes,
        failed_writes: counts.failed,
    }
}

/// Whether its numbers are lengths.
pub fn is_linear(plan: &Plan, axis: &AxisPlan) -> bool {
    plan.machine.axes()[axis.axis].kind == AxisKind::Linear
}

/// Whether an offset is late by more than its plan allows.
pub fn is_lagging(plan: &Plan, cycle: &Cycle) -> bool {
    let (Some(lag), Some(at)) = (&cycle.output.lag, &cycle.output.programmed) else { return false };
    let lags = plan.at_position(lag.iter().copied(), at);
    let is_late =
        |(lag, axis): (f64, &AxisPlan)| axis.lag.is_some_and(|most| lag * axis.increment > most);
    lags.into_iter().zip(&plan.axes).any(is_late)
}

/// The document of a run, going on or ended.
pub fn status_json(plan: &Plan, running: bool, last: Option<LiveState>) -> Value {
    complete(document(&LiveStatusDocument::of(&plan.name, running, last)), &Diagnostics::new())
}

/// A state as text.
pub fn shown_state(plan: &Plan, last: &LiveState) -> String {
    state_report(Report::new(&plan.name), last).text()
}

/// Where the journal of a plan is kept; a problem where the system names no place for it.
pub fn folder_of(plan: &Plan, problems: &mut Diagnostics) -> Option<PathBuf> {
    let found = plan.folder.clone().or_else(|| own_folder(&plan.path, plan.machine.name()));
    if found.is_none() {
        let place = Place::whole(&plan.path.display().to_string());
        let message = "the system names no folder for the journal".to_owned();
        problems.error("live-no-folder", place, message, "[journal] folder = \"journal\"");
    }
    found
}

/// What a run is doing, or what it has left.
#[derive(Debug, Clone)]
pub struct LiveStatus {
    /// The plan.
    pub plan: PathBuf,
    /// The last hours, too. Unit: h.
    pub hours: Option<f64>,
}

/// Events of a document.
const MOST_EVENTS: usize = 50;
/// Events of a text.
const SHOWN_EVENTS: usize = 8;

fn shown_event(event: &Event) -> LiveEventEntry {
    LiveEventEntry {
        date_s: event.date_s,
        time_s: event.at_s,
        state: event.event.clone(),
        reason: event.what.clone(),
    }
}

/// The answer.
#[derive(Debug)]
pub struct LiveStatusAnswer {
    document: LiveStatusDocument,
    /// The age of the state; none where there is none. Unit: s.
    age_s: Option<u64>,
}

impl LiveStatusAnswer {
    /// The document itself.
    pub fn into_document(self) -> LiveStatusDocument {
        self.document
    }
}

impl Question for LiveStatus {
    type Input = (Plan, PathBuf);
    type Answer = LiveStatusAnswer;

    fn read(&self, files: &Files, problems: &mut Diagnostics) -> Option<Self::Input> {
        let plan = problems.keep(read_plan(files, &self.plan))?;
        let folder = folder_of(&plan, problems)?;
        Some((plan, folder))
    }

    fn answer(
        &self,
        (plan, folder): Self::Input,
        _: Tell<'_>,
        problems: &mut Diagnostics,
    ) -> Option<LiveStatusAnswer> {
        let place = || Place::whole(&folder.join("state.json").display().to_string());
        let read = |value| serde_json::from_value::<LiveStatusDocument>(value).ok();
        let Ok(Some(last)) = last_state(&folder).map(|found| match found {
            Some(value) => read(value).map(|document| document.last),
            None => Some(None),
        }) else {
            let message = "the state of the last run cannot be read".to_owned();
            let hint = "it was cut, or is of another version of this program: remove it";
            problems.error("live-state", place(), message, hint);
            return None;
        };
        let now_s = crate::clock::date_s();
        let age_s = last.as_ref().map(|last| now_s.saturating_sub(last.date_s));
        let running = is_running(&folder);
        if let Some(age_s) = age_s.filter(|age_s| running && *age_s > FRESH_S) {
            let message =
                format!("the run has not said anything for {age_s} s: what is shown is of then");
            let hint = "it stands still, or its disk takes nothing: look at the machine and at the process";
            problems.warn("live-state", place(), message, hint);
        }
        if last.as_ref().is_some_and(|last| last.plan_hash != plan.hash) {
            let message = "the state is of a run with another plan or machine file, or they were edited since";
            let hint = "what is shown is of that run; an edited file has no effect on it";
            problems.warn("live-state", place(), message.to_owned(), hint);
        }
        let mut document = LiveStatusDocument::of(&plan.name, running, last);
        document.events = last_events(&folder, MOST_EVENTS).iter().map(shown_event).collect();
        document.history = self.hours.map(|hours| history(&folder, &plan, (hours, now_s)));
        Some(LiveStatusAnswer { document, age_s })
    }
}

/// A run writes its state each second; one that is older than this stands still, s.
const FRESH_S: u64 = 5;

impl Answer for LiveStatusAnswer {
    fn document(&self, problems: &Diagnostics) -> Value {
        complete(document(&self.document), problems)
    }

    fn report(&self) -> Report<'_> {
        let LiveStatusDocument { name, running, last, history, events, .. } = &self.document;
        let report = Report::new(name).line(if *running { "running" } else { "not running" });
        let Some(last) = last else { return report.line("it has not run here") };
        let report = self
            .age_s
            .into_iter()
            .fold(report, |report, age_s| report.line(format!("its state of {age_s} s ago:")));
        let report = state_report(report, last);
        let report = match history {
            Some(history) => report.section(history_section(history)),
            None => report,
        };
        match events.is_empty() {
            true => report,
            false => report.section(events_section(events)),
        }
    }
}

/// What the last hours were, axis by axis.
fn history_section(history: &LiveHistory) -> Section<'_> {
    let rows = history.axes.iter().map(|axis| {
        let unit = if axis.unit == "um" { "µm" } else { "µrad" };
        let numbers = [axis.before_max, axis.left_max, axis.before_rms, axis.left_rms];
        let shown = |value: Option<f64>| value.map_or_else(|| "–".to_owned(), |v| fixed(v, 1));
        let [a, b, c, d] = numbers.map(shown);
        [axis.axis.clone(), a, b, c, d, unit.to_owned()]
    });
    let headings = ["axis", "largest before", "after", "rms before", "after", ""];
    let title = match history.hours < 1.0 {
        true => format!("The last {} min: off by the model", fixed(60.0 * history.hours, 1)),
        false => format!("The last {} h: off by the model", fixed(history.hours, 1)),
    };
    let table = Table::new(headings).rows(rows);
    Section::new(title).table(match history.date_s.is_empty() {
        true => table.note("Nothing was recorded in that time."),
        false => table,
    })
}

fn events_section(events: &[LiveEventEntry]) -> Section<'_> {
    let last = events.iter().skip(events.len().saturating_sub(SHOWN_EVENTS));
    let rows = last.map(|e| [fixed(e.time_s, 1), e.state.clone(), e.reason.clone()]);
    Section::new("Last events").table(Table::new(["s from the start", "state", "why"]).rows(rows))
}

/// A state for readers.
pub fn state_report<'a>(report: Report<'a>, last: &LiveState) -> Report<'a> {
    let shown =
        |value: Option<f64>, digits| value.map_or_else(|| "–".to_owned(), |v| fixed(v, digits));
    let axes = last.axes.iter().map(|axis| {
        let unit = if axis.unit == "um" { "µm" } else { "µrad" };
        [
            axis.axis.clone(),
            shown(axis.position, 3),
            shown(axis.offset, 1),
            shown(axis.acting, 1),
            shown(axis.target, 1),
            shown(axis.lag, 1),
            shown(axis.datum, 1),
            fixed(axis.limit, 0),
            unit.to_owned(),
        ]
    });
    let headings = [
        "axis",
        "position, mm or deg",
        "offset",
        "acts",
        "target",
        "late by",
        "zero off by",
        "limit",
        "",
    ];
    let sensors = last.sensors.iter().map(|sensor| {
        let fault = match (&sensor.fault, &sensor.instead) {
            (Some(fault), _) => fault.clone(),
            (None, Some(other)) => format!("{other} stands in"),
            (None, None) => String::new(),
        };
        [sensor.sensor.clone(), shown(sensor.celsius, 2), shown(sensor.age_s, 1), fault]
    });
    let counts = format!(
        "{} cycles, {} periods missed, {} writes, {} failed",
        last.cycles, last.missed, last.writes, last.failed_writes
    );
    let part = last.part.iter().map(|part| format!("part {part} is recorded"));
    let setup = last.setup.iter().map(|number| format!("setup {number}"));
    part.chain(setup)
        .fold(report, Report::line)
        .line(format!(
            "{}: {} ({} s after the start)",
            last.state,
            last.reason,
            fixed(last.time_s, 1)
        ))
        .line(counts)
        .section(Section::new("Offsets").table(Table::new(headings).rows(axes)))
        .section(
            Section::new("Sensors").table(Table::new(["sensor", "°C", "age, s", ""]).rows(sensors)),
        )
}
