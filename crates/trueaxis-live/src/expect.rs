//! What would this lever leave of the tool on a recorded day? Asked before a control is touched.
//!
//! ```text
//!     T(t) of the log ──Machine::at──> errors over the travel at every row
//!     offset(t, q) = −e of the sample before, in whole increments, follows with a dead band
//!     left(t, q)   = e(t, q) + offset + v · |de/dq| · age
//! ```

mod losses;
mod poses;
mod report;

pub use losses::ExpectedLoss;
pub use poses::{ExpectedOffset, ExpectedPoses};

use crate::cycle::AGE_PERIODS;
use crate::file::{AxisPlan, Plan, SensorPlan, Source, read_plan};
use crate::line::Line;
use crate::model::{LiveAxis, Model, at, remembered};
use losses::{Day, HOUR_S, TEN_MINUTES_S};
use serde::Serialize;
use std::collections::BTreeMap;
use std::path::PathBuf;
use trueaxis::compensate::values::travel_positions;
use trueaxis::input::{Diagnostics, Files, Place};
use trueaxis::machine::Machine;
use trueaxis::machine::axis::{AxisKind, Command};
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
    /// Each row of the log that was evaluated.
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
    /// How fast it may change. Unit: that of `unit`.
    pub slew_per_s: f64,
    /// The largest offset that is needed; it is clamped at the limit. Unit: that of `unit`.
    pub needed: f64,
    /// The limit of the plan. Unit: that of `unit`.
    pub limit: f64,
    /// Expanded uncertainty (k = 2) of the error that is corrected, by the machine file; null where it states none. Unit: that of `unit`.
    pub expanded_uncertainty: Option<f64>,
}

/// One row of the log.
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
                remark_on_ranges(&plan, &log, problems);
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

/// The correction does not use a reading outside the range of its sensor; a forecast from it is one of another plan.
fn remark_on_ranges(plan: &Plan, log: &TemperatureLog, problems: &mut Diagnostics) {
    for sensor in &plan.sensors {
        let Some(celsius) = log.celsius(column(sensor)) else { continue };
        let [low, high] = sensor.settings.range;
        let outside: Vec<f64> =
            celsius.iter().copied().filter(|c| !(low..=high).contains(c)).collect();
        let Some(first) = outside.first() else { continue };
        let name = &sensor.settings.name;
        let message = format!(
            "{} of {} readings of `{name}` are outside its range of {low} to {high} °C, {first} °C for one: the correction \
             would not use them, this forecast does",
            outside.len(),
            celsius.len()
        );
        let hint = format!("is range of [sensor.{name}] right for this day?");
        problems.warn("live-range", Place::whole(&plan.path.display().to_string()), message, &hint);
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

/// The errors of one axis over its travel at the temperatures of a row.
struct Row {
    warm: Machine,
    errors: Errors,
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
    let mut rows: Vec<(usize, Errors)> = Vec::new();
    let mut held: Vec<(usize, Offsets)> = Vec::new();
    let own = |sensor: &SensorPlan| column(sensor).to_owned();
    let mut heat = Heat::of(plan, log, &own);
    let mut last = None;
    for (i, is_shown) in moments(log.times_s(), MOST_ROWS) {
        let row = row(plan, &model, (&mut heat, i), &places)?;
        if is_shown {
            let sampled = rows.last().map_or(&row.errors, |(_, errors)| errors);
            let now = follow(plan, (sampled, &places), held.last().map(|(_, before)| before));
            found.add(plan, log.times_s()[i], (&row.errors, sampled, &now), &places);
            found.others(plan, &row, &places)?;
            held.push((rows.len(), now));
        }
        rows.push((i, row.errors));
        last = Some(row.warm);
    }
    found.uncertainty(plan, &last.ok_or("the log has no row")?, &places);
    let day = Day { plan, model: &model, log, places: &places, rows, held };
    Ok(found.document(plan, log, day.losses(without)?))
}

/// Which rows of a log are evaluated, in their order: at most so many over the day, which are shown; with each the row before it,
/// that its sample is of, and the last rows within ten minutes and within an hour after it. So what a forecast says does not
/// depend on how many rows a log has.
fn moments(times_s: &[f64], most: usize) -> Vec<(usize, bool)> {
    let step = times_s.len().div_ceil(most).max(1);
    let mut found = BTreeMap::new();
    for i in (0..times_s.len()).step_by(step) {
        for span_s in [TEN_MINUTES_S, HOUR_S] {
            let after = times_s.partition_point(|t| *t <= times_s[i] + span_s);
            found.entry(after - 1).or_insert(false);
        }
        found.entry(i.saturating_sub(1)).or_insert(false);
        found.insert(i, true);
    }
    found.into_iter().collect()
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

fn command_at(plan: &Plan, live: usize, place: f64) -> Command {
    let mut command = Command::default();
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

/// What was found so far, mm and rad.
#[derive(Default)]
struct Found {
    axes: Vec<Worst>,
    times: Vec<ExpectedTime>,
    other_mm: f64,
    turned_rad: f64,
}

#[derive(Default, Clone)]
struct Worst {
    before: f64,
    after: f64,
    by_age: f64,
    by_increment: f64,
    slope: f64,
    needed: f64,
    u: Option<f64>,
}

fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.map(f64::abs).fold(0.0, f64::max)
}

fn shown(plan: &Plan, live: usize) -> f64 {
    match plan.machine.axes()[plan.axes[live].axis].kind {
        AxisKind::Linear => 1e3,
        AxisKind::Rotary => 1e6,
    }
}

impl Found {
    fn new(plan: &Plan) -> Self {
        let axes = vec![Worst::default(); plan.axes.len()];
        Self { axes, times: Vec::new(), other_mm: 0.0, turned_rad: 0.0 }
    }

    fn add(
        &mut self,
        plan: &Plan,
        time_s: f64,
        (errors, sampled, held): (&Errors, &Errors, &Offsets),
        places: &[Vec<f64>],
    ) {
        let (mut before, mut after) = (Vec::new(), Vec::new());
        for (live, worst) in self.axes.iter_mut().enumerate() {
            let (errors, then, held) = (&errors[live], &sampled[live], &held[live]);
            let left = errors.iter().zip(held).map(|(e, h)| e + h);
            let (without, with) = (largest(errors.iter().copied()), largest(left));
            worst.before = worst.before.max(without);
            worst.after = worst.after.max(with);
            worst.by_age = worst.by_age.max(largest(errors.iter().zip(then).map(|(e, t)| e - t)));
            worst.by_increment =
                worst.by_increment.max(largest(then.iter().zip(held).map(|(t, h)| t + h)));
            worst.needed = worst.needed.max(largest(then.iter().copied()));
            let steps = errors.windows(2).zip(places[live].windows(2));
            // A control that follows the position by itself is not late with it.
            if plan.axes[live].line.is_none() {
                let slopes = steps.map(|(e, q)| (e[1] - e[0]) / (q[1] - q[0]));
                worst.slope = worst.slope.max(largest(slopes));
            }
            before.push(without * shown(plan, live));
            after.push(with * shown(plan, live));
        }
        self.times.push(ExpectedTime { time_s, before, after });
    }

    /// What the live axes do not correct: of the deviation at each place that which is not the error of an axis in its own
    /// direction, and the tool axis.
    fn others(&mut self, plan: &Plan, row: &Row, places: &[Vec<f64>]) -> Result<(), String> {
        for (live, places) in places.iter().enumerate() {
            for (i, place) in places.iter().enumerate() {
                let command = command_at(plan, live, *place);
                let errors = row.warm.errors_at(&command, &[0.0; 6]).map_err(|e| e.to_string())?;
                let deviation = row.warm.deviation(&command, &errors);
                let mut tip_mm = deviation.tip_mm;
                for (other, axis) in plan.axes.iter().enumerate() {
                    if plan.machine.axes()[axis.axis].kind != AxisKind::Linear {
                        continue;
                    }
                    // The error of another live axis at its zero.
                    let error =
                        if other == live { row.errors[live][i] } else { row.errors[other][0] };
                    let mut step = command;
                    step[axis.axis] += 1.0;
                    let none = Default::default();
                    let along = row.warm.pose(&step, &none).shift_mm()
                        - row.warm.pose(&command, &none).shift_mm();
                    tip_mm -= along * error;
                }
                self.other_mm = self.other_mm.max(tip_mm.norm());
                self.turned_rad = self.turned_rad.max(deviation.axis.norm());
            }
        }
        Ok(())
    }

    fn uncertainty(&mut self, plan: &Plan, last: &Machine, places: &[Vec<f64>]) {
        use trueaxis::compensate::values::{Order, compensation_values};
        for (live, worst) in self.axes.iter_mut().enumerate() {
            let axis = &plan.axes[live];
            let (positions, increment) = (places[live].clone(), axis.increment);
            let order = Order {
                axis: axis.axis,
                command: Command::default(),
                positions,
                increment,
                of: plan.of,
            };
            let table = compensation_values(last, &order).ok();
            let u = table.iter().flat_map(|t| &t.nodes).filter_map(|n| n.u);
            worst.u = u.fold(None, |most: Option<f64>, u| Some(most.map_or(u, |m| m.max(u))));
        }
    }

    fn document(
        self,
        plan: &Plan,
        log: &TemperatureLog,
        losses: Vec<ExpectedLoss>,
    ) -> LiveExpectDocument {
        let axis = |(live, worst): (usize, &Worst)| {
            let (own, scale) = (&plan.axes[live], shown(plan, live));
            let machine = &plan.machine.axes()[own.axis];
            let speed = machine.limits.velocity;
            ExpectedAxis {
                axis: own.name.clone(),
                unit: if machine.kind == AxisKind::Linear { "um" } else { "urad" },
                on_line: own.line.is_some(),
                before: worst.before * scale,
                after: worst.after * scale,
                by_age: worst.by_age * scale,
                by_increment: worst.by_increment * scale,
                moving: speed.map(|v| v * worst.slope * AGE_PERIODS * plan.period_s * scale),
                needed_per_s: speed.map(|v| v * worst.slope * scale),
                slew_per_s: own.limits.slew_per_s * own.increment * scale,
                needed: worst.needed * scale,
                limit: f64::from(own.limits.limit) * own.increment * scale,
                expanded_uncertainty: worst.u.map(|u| 2.0 * u * scale),
            }
        };
        LiveExpectDocument {
            schema: "trueaxis/live-expect/1",
            name: plan.name.clone(),
            log: log.file().to_owned(),
            axes: self.axes.iter().enumerate().map(axis).collect(),
            times: self.times,
            losses,
            poses: None,
            tool_axis_urad: (self.turned_rad > 0.0).then_some(self.turned_rad * 1e6),
            other_tip_um: Some(self.other_mm * 1e3),
        }
    }
}
