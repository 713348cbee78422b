//! What would this lever leave of the tool on a recorded day? Asked before a control is touched.
//!
//! ```text
//!     T(t) of the log ──Machine::at──> errors over the travel at every row, less what was off where the zero was touched
//!     offset(t, q) = −e of the sample before, in whole increments, follows with a dead band
//!     left(t, q)   = e(t, q) + offset + v · |de/dq| · age
//! ```
//!
//! Every row is one sample: of equal rows only the first is computed.

mod found;
mod losses;
mod poses;
mod remarks;
mod report;

pub use losses::ExpectedLoss;
pub use poses::{ExpectedOffset, ExpectedPoses};

use crate::cycle::Correction;
use crate::file::{AxisPlan, Plan, SensorPlan, Source, read_plan};
use crate::governor::Earlier;
use crate::line::Line;
use crate::model::{LiveAxis, Model, at, clamped, remembered};
use found::Found;
use losses::{Day, HOUR_S, TEN_MINUTES_S};
use serde::Serialize;
use std::collections::BTreeMap;
use std::path::PathBuf;
use trueaxis::compensate::values::travel_positions;
use trueaxis::input::{Diagnostics, Files, Place};
use trueaxis::machine::Machine;
use trueaxis::machine::axis::Command;
use trueaxis::machine::heat::{TemperatureLog, ThermalMemory};
use trueaxis::questions::{Question, Tell};
use trueaxis_report::JsonSchema;

/// Places on the travel of an axis.
const PLACES: f64 = 20.0;
/// Rows of the log that are shown, at most.
const MOST_ROWS: usize = 500;

/// A forecast.
#[derive(Debug, Clone)]
pub struct ExpectLive {
    /// The plan.
    pub plan: PathBuf,
    /// The log of the day; without one those of the plan.
    pub log: PathBuf,
    /// Only the loss of this sensor is priced; without it that of every one.
    pub without: Option<String>,
}

/// What a lever would leave.
#[derive(Debug, Serialize, JsonSchema)]
pub struct LiveExpectDocument {
    /// Which document this is.
    #[schemars(extend("const" = "trueaxis/live-expect/1"))]
    pub schema: &'static str,
    /// The name of the plan.
    pub name: String,
    /// The log.
    pub log: String,
    /// Each live axis over the whole day.
    pub axes: Vec<ExpectedAxis>,
    /// Its rows, at most 500: of a longer log the first of so many, with the largest errors of all of them.
    pub times: Vec<ExpectedTime>,
    /// What the loss of each sensor costs on that day.
    pub losses: Vec<ExpectedLoss>,
    /// Tip and tool axis together, where the control takes whole poses; there are no `axes` then. Null with a control of another kind.
    pub poses: Option<ExpectedPoses>,
    /// What no offset of an axis changes: the largest deviation of the tool axis over the day; null without rotary axes and
    /// angular errors.
    pub tool_axis_urad: Option<f64>,
    /// The largest deviation of the tip in the directions that no live axis corrects, and by errors that do not change with
    /// the position of their axis: squareness, straightness, roll. Null where the control takes whole poses.
    pub other_tip_um: Option<f64>,
}

/// One live axis over the day. Numbers are in `unit`.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ExpectedAxis {
    /// Its letter.
    pub axis: String,
    /// um or urad.
    pub unit: &'static str,
    /// The control corrects it along a line of the position.
    pub on_line: bool,
    /// The largest error without the correction. Unit: that of `unit`.
    pub before: f64,
    /// The largest error with it, standing still. Unit: that of `unit`.
    pub after: f64,
    /// Of it: the temperatures have changed since the last sample. Unit: that of `unit`.
    pub by_age: f64,
    /// Of it: whole increments and the dead band; where the control corrects along a line, what a line leaves besides. Unit: that
    /// of `unit`.
    pub by_increment: f64,
    /// More while the axis moves at its largest velocity: velocity × slope × age of the position; nothing where the control
    /// corrects along a line, null where the machine file states no velocity. Unit: that of `unit`.
    pub moving: Option<f64>,
    /// How fast the offset must change then, in the unit per second; null as above. Unit: that of `unit`.
    pub needed_per_s: Option<f64>,
    /// How fast it must change for the temperatures alone, from one row to the next. Unit: that of `unit`.
    pub warms_per_s: f64,
    /// How fast it may change. Unit: that of `unit`.
    pub slew_per_s: f64,
    /// The largest offset that is needed; it is clamped at the limit. Unit: that of `unit`.
    pub needed: f64,
    /// The limit of the plan. Unit: that of `unit`.
    pub limit: f64,
    /// Expanded uncertainty (k = 2) of the error that is corrected, by the machine file, the largest over the day; null where it
    /// states none. Unit: that of `unit`.
    pub expanded_uncertainty: Option<f64>,
}

/// One row of the log, or the largest of some.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ExpectedTime {
    /// In the log.
    pub time_s: f64,
    /// The largest error of each live axis without the correction, in its unit. Unit: that of `unit`.
    pub before: Vec<f64>,
    /// With it. Unit: that of `unit`.
    pub after: Vec<f64>,
}

/// The answer.
#[derive(Debug)]
pub struct LiveExpectAnswer(LiveExpectDocument);

impl Question for ExpectLive {
    type Input = (Plan, TemperatureLog);
    type Answer = LiveExpectAnswer;

    fn read(&self, files: &Files, problems: &mut Diagnostics) -> Option<Self::Input> {
        let plan = problems.keep(read_plan(files, &self.plan));
        let text = files.text(&self.log, "a log of temperatures (CSV)", problems)?;
        let log = TemperatureLog::parse(&self.log.display().to_string(), &text, problems)?;
        let plan = plan?;
        let known = |name: &String| plan.sensors.iter().any(|s| s.settings.name == *name);
        if let Some(name) = self.without.as_ref().filter(|name| !known(name)) {
            let names: Vec<&str> = plan.sensors.iter().map(|s| s.settings.name.as_str()).collect();
            let message = format!("the plan has no sensor `{name}`");
            problems.error("unknown-word", Place::whole("--without"), message, &names.join(", "));
        }
        for sensor in &plan.sensors {
            let column = column(sensor);
            if log.celsius(column).is_none() {
                let names: Vec<&str> = log.sensors().collect();
                let message = format!("the log has no column of `{column}`");
                let place = Place::whole(&self.log.display().to_string());
                problems.error("live-no-column", place, message, &names.join(", "));
            }
        }
        Some((plan, log))
    }

    fn answer(
        &self,
        (plan, log): Self::Input,
        _: Tell<'_>,
        problems: &mut Diagnostics,
    ) -> Option<LiveExpectAnswer> {
        match expect(&plan, &log, self.without.as_deref()) {
            Ok(found) => {
                remarks::on_sensors(&plan, &log, problems);
                remarks::on_slew(&plan, &found, problems);
                Some(LiveExpectAnswer(found))
            }
            Err(message) => {
                let place = Place::whole(&self.plan.display().to_string());
                problems.error(
                    "live-no-forecast",
                    place,
                    message,
                    "check the temperatures of the log and the travels of the machine file",
                );
                None
            }
        }
    }
}

fn column(sensor: &SensorPlan) -> &str {
    match &sensor.source {
        Source::Log { column, .. } => column,
        _ => &sensor.settings.input,
    }
}

/// Of each live axis at its places. Unit: mm or rad.
type Offsets = Vec<Vec<f64>>;
/// The same of errors. Unit: mm or rad.
type Errors = Vec<Vec<f64>>;

/// The column of the log that a sensor is read from.
type Column<'a> = &'a dyn Fn(&SensorPlan) -> String;

/// The errors of all axes over their travels at the temperatures of a row.
struct Row {
    warm: Machine,
    errors: Errors,
}

/// The rows of a log, one after the other; rows with the same readings are computed once.
struct Rows<'a> {
    plan: &'a Plan,
    model: &'a Model,
    places: &'a [Vec<f64>],
    heat: Heat<'a>,
    /// What was off where the zero was touched. Unit: mm or rad.
    at_touch: Vec<f64>,
    /// The last row that was computed, and its place.
    last: Option<(usize, Row)>,
}

impl<'a> Rows<'a> {
    fn of(
        plan: &'a Plan,
        model: &'a Model,
        (log, column): (&'a TemperatureLog, Column<'a>),
        places: &'a [Vec<f64>],
    ) -> Result<Self, String> {
        let (heat, at_touch) = (Heat::of(plan, log, column), off_at_touch(plan)?);
        Ok(Self { plan, model, places, heat, at_touch, last: None })
    }

    /// Goes on to a row; whether it differs from the one before.
    fn go_to(&mut self, i: usize) -> Result<bool, String> {
        let is_same = |at: usize| self.heat.readings(at) == self.heat.readings(i);
        if self.heat.memory.is_none() && self.last.as_ref().is_some_and(|(at, _)| is_same(*at)) {
            return Ok(false);
        }
        let mut found = row(self.plan, self.model, (&mut self.heat, i), self.places)?;
        for (errors, off) in found.errors.iter_mut().zip(&self.at_touch) {
            errors.iter_mut().for_each(|error| *error -= off);
        }
        self.last = Some((i, found));
        Ok(true)
    }

    fn row(&self) -> Result<&Row, String> {
        self.last.as_ref().map(|(_, row)| row).ok_or_else(|| "the log has no row".to_owned())
    }
}

/// The forecast of a day.
///
/// # Errors
/// What the machine file says against it.
pub fn expect(
    plan: &Plan,
    log: &TemperatureLog,
    without: Option<&str>,
) -> Result<LiveExpectDocument, String> {
    if plan.control.takes_pose() {
        let (poses, losses) = poses::expect(plan, log, without)?;
        let document = Found::default().document(plan, log, losses);
        return Ok(LiveExpectDocument {
            poses: Some(poses),
            axes: Vec::new(),
            other_tip_um: None,
            ..document
        });
    }
    let model = model_of(plan);
    let places: Vec<Vec<f64>> =
        plan.axes.iter().map(|axis| places(&plan.machine, axis.axis)).collect();
    let mut found = Found::new(plan);
    let own = |sensor: &SensorPlan| column(sensor).to_owned();
    let mut rows = Rows::of(plan, &model, (log, &own), &places)?;
    let times = log.times_s();
    let telling = moments(log, &columns(plan), UNCERTAIN_ROWS);
    let (mut errors, mut held): (Vec<Errors>, Vec<(usize, Offsets)>) = (Vec::new(), Vec::new());
    let mut before: Option<Offsets> = None;
    for i in 0..times.len() {
        let is_new = rows.go_to(i)?;
        let row = rows.row()?;
        let sampled = errors.last().unwrap_or(&row.errors);
        let now = follow(plan, (sampled, &places), before.as_ref());
        let since_s = i.checked_sub(1).map(|last| times[i] - times[last]);
        found.changes(since_s, errors.last(), &row.errors);
        let is_shown = i % shown_step(times.len()) == 0;
        found.add(plan, (times[i], is_shown), (&row.errors, sampled, &now), &places);
        if is_new {
            found.others(plan, (&model, &row.warm), &places)?;
        }
        if telling.contains_key(&i) {
            found.uncertainty(plan, &row.warm, &places);
        }
        errors.push(row.errors.clone());
        if is_shown {
            held.push((i, now.clone()));
        }
        before = Some(now);
    }
    if errors.is_empty() {
        return Err("the log has no row".to_owned());
    }
    let after = found.after(plan);
    let day = Day { plan, model: &model, log, places: &places, errors, held, after };
    Ok(found.document(plan, log, day.losses(without)?))
}

/// Of so many rows one is shown.
fn shown_step(rows: usize) -> usize {
    rows.div_ceil(MOST_ROWS).max(1)
}

/// Rows at which the uncertainty is computed, besides those with the extremes of a sensor.
const UNCERTAIN_ROWS: usize = 30;

fn columns(plan: &Plan) -> Vec<&str> {
    plan.sensors.iter().map(column).collect()
}

/// Which rows of a log tell of its day, in their order, where not all of them are evaluated: so many evenly over it, which are
/// shown (`true`), with each the row before it, that its sample is of, and the last rows within ten minutes and within an hour
/// after it. Also, shown: between two of them the one that changes most from the row before it, and the extremes of each sensor.
fn moments(log: &TemperatureLog, columns: &[&str], most: usize) -> BTreeMap<usize, bool> {
    let times_s = log.times_s();
    let values: Vec<&[f64]> = columns.iter().filter_map(|column| log.celsius(column)).collect();
    let step = times_s.len().div_ceil(most).max(1);
    let mut found = BTreeMap::new();
    let change = |i: usize| {
        values.iter().map(|column| (column[i] - column[i - 1]).abs()).fold(0.0, f64::max)
    };
    let mut shown: Vec<usize> = (0..times_s.len()).step_by(step).collect();
    for i in shown.clone() {
        for span_s in [TEN_MINUTES_S, HOUR_S] {
            let after = times_s.partition_point(|t| *t <= times_s[i] + span_s);
            found.entry(after - 1).or_insert(false);
        }
        let within = i.max(1)..(i + step).min(times_s.len());
        shown.extend(within.max_by(|a, b| change(*a).total_cmp(&change(*b))));
    }
    for column in values {
        let rows = 0..column.len();
        shown.extend(rows.clone().max_by(|a, b| column[*a].total_cmp(&column[*b])));
        shown.extend(rows.min_by(|a, b| column[*a].total_cmp(&column[*b])));
    }
    for i in shown {
        found.entry(i.saturating_sub(1)).or_insert(false);
        found.insert(i, true);
    }
    found
}

/// What was off of each live axis where the plan says that the zero of the part was touched: it is in the zero. Unit: mm or rad.
fn off_at_touch(plan: &Plan) -> Result<Vec<f64>, String> {
    let Some(planned) = &plan.datum else { return Ok(vec![0.0; plan.axes.len()]) };
    let touched = Correction::new(plan, Earlier::Nothing).planned_datum(planned);
    // Nothing acted then: what was missing of the correction is minus the error.
    Ok(touched.map_err(|reason| reason.to_string())?.missing.iter().map(|m| -m).collect())
}

fn model_of(plan: &Plan) -> Model {
    let axes = plan.axes.iter().map(LiveAxis::from).collect();
    Model::new(plan.machine.clone(), plan.of, plan.part, axes)
}

fn places(machine: &Machine, axis: usize) -> Vec<f64> {
    use trueaxis::machine::axis::Travel;
    let own = &machine.axes()[axis];
    let step = match own.travel {
        Travel::Between(from, to) => (to - from) / PLACES,
        Travel::Unlimited | Travel::Unknown => std::f64::consts::TAU / PLACES,
    };
    travel_positions(own, step).unwrap_or_else(|| vec![0.0])
}

/// The other axes at 0, or at the end of their travel that is next to it.
fn command_at(plan: &Plan, live: usize, place: f64) -> Command {
    let (mut command, _) = clamped(&plan.machine, &Command::default());
    command[plan.axes[live].axis] = place;
    command
}

/// The machine over a log, row by row.
struct Heat<'a> {
    plan: &'a Plan,
    log: &'a TemperatureLog,
    column: Column<'a>,
    /// The heat in its scales up to a row; none of a machine without heated places.
    memory: Option<ThermalMemory>,
    next: usize,
}

impl<'a> Heat<'a> {
    fn of(plan: &'a Plan, log: &'a TemperatureLog, column: Column<'a>) -> Self {
        let memory = ThermalMemory::is_needed(&plan.machine).then(ThermalMemory::default);
        Self { plan, log, column, memory, next: 0 }
    }

    fn readings(&self, i: usize) -> Vec<(&'a str, f64)> {
        let reading = |s: &'a SensorPlan| {
            let celsius = self.log.celsius(&(self.column)(s)).and_then(|column| column.get(i));
            celsius.map(|celsius| (s.settings.input.as_str(), *celsius))
        };
        self.plan.sensors.iter().filter_map(reading).collect()
    }

    /// The machine at a row; rows are asked in their order.
    fn machine_at(&mut self, i: usize) -> Result<Machine, String> {
        let (machine, readings) = (&self.plan.machine, self.readings(i));
        let Some(mut memory) = self.memory.take() else { return at(machine, &readings) };
        for row in self.next..=i {
            let known = self.readings(row);
            let read = |name: &str| known.iter().find(|(of, _)| *of == name).map(|(_, c)| *c);
            let taken = memory.take(machine, self.log.times_s()[row], &read);
            taken.map_err(|fault| fault.to_string())?;
        }
        self.next = i + 1;
        let warm = remembered(machine, &memory, self.log.times_s()[i], &readings);
        self.memory = Some(memory);
        warm
    }
}

fn row(
    plan: &Plan,
    model: &Model,
    (heat, i): (&mut Heat<'_>, usize),
    places: &[Vec<f64>],
) -> Result<Row, String> {
    let warm = heat.machine_at(i)?;
    let error = |(live, places): (usize, &Vec<f64>)| {
        let axis = plan.axes[live].axis;
        let at = |place: &f64| {
            model.error(&warm, axis, &command_at(plan, live, *place)).map_err(|r| r.to_string())
        };
        places.iter().map(at).collect::<Result<Vec<f64>, String>>()
    };
    let errors = places.iter().enumerate().map(error).collect::<Result<_, _>>()?;
    Ok(Row { warm, errors })
}

/// The offsets at all places, mm or rad.
fn follow(
    plan: &Plan,
    (sampled, places): (&Errors, &[Vec<f64>]),
    before: Option<&Offsets>,
) -> Offsets {
    let axis = |(live, errors): (usize, &Vec<f64>)| {
        let (own, before) = (&plan.axes[live], before.map(|all| &all[live]));
        let wanted: Vec<f64> = errors.iter().map(|e| -e).collect();
        if let Some(ends) = own.line {
            return on_line(own, ends, (&places[live], &wanted), before);
        }
        let one = |(i, wanted): (usize, &f64)| followed(own, *wanted, before.map(|all| all[i]));
        wanted.iter().enumerate().map(one).collect()
    };
    sampled.iter().enumerate().map(axis).collect()
}

/// Of an axis along which the control corrects by a line: its ends follow, and all places are on it.
fn on_line(
    own: &AxisPlan,
    ends: [f64; 2],
    (places, wanted): (&[f64], &[f64]),
    before: Option<&Vec<f64>>,
) -> Vec<f64> {
    let target = Line::through(places, wanted, ends);
    let held = before.map(|before| Line::through(places, before, ends).values);
    let end = |i: usize| followed(own, target.values[i], held.map(|held| held[i]));
    let line = Line { ends, values: [end(0), end(1)] };
    places.iter().map(|place| line.at(*place)).collect()
}

/// One offset, mm or rad: in whole increments it follows with the dead band, within the limit.
fn followed(own: &AxisPlan, wanted: f64, before: Option<f64>) -> f64 {
    let limit = f64::from(own.limits.limit);
    let target = (wanted / own.increment).clamp(-limit, limit);
    let held = before.map(|before| before / own.increment);
    let stays = held.filter(|held| (target - held).abs() < own.limits.dead_band.max(1.0));
    stays.unwrap_or_else(|| target.round()) * own.increment
}
