//! Sign and scale of one axis: its offset is written, a person reads an indicator, and the two are compared.
//!
//! The same governor, control and journal as in a run; only the target is a constant. Axes stand; the offset goes back by its
//! slew whatever was read.

use crate::clock::{Clock, RealClock};
use crate::file::{Commissioned, Plan, read_plan_to_commission};
use crate::governor::State;
use crate::run::{Run, Wish};
use crate::session::{Opened, Stopped, at_start, is_gone, open, own_mock, refused, unusable};
use crate::start::{owner, sensors_of};
use crate::status::folder_of;
use crate::store::DiskStore;
use std::ops::Range;
use std::path::PathBuf;
use trueaxis::input::{Diagnostics, Files, Place};

/// What is written, to which axis.
#[derive(Debug, Clone)]
pub struct Commission {
    /// The plan.
    pub plan: PathBuf,
    /// The axis.
    pub axis: String,
    /// As much. Unit: mm or rad.
    pub by: f64,
}

/// What came of it.
#[derive(Debug, Clone, PartialEq)]
pub enum Tried {
    /// The indicator has shown so much. Unit: mm or rad.
    Measured(f64),
    /// No one has answered, or the run was stopped.
    Abandoned,
    /// The offset never stood: the last state and its reason.
    Never(String),
}

/// What a person says, once: none yet, or what the indicator shows, or that it is over. Unit: mm or rad.
pub type Said<'a> = &'a dyn Fn() -> Option<Option<f64>>;

/// Where the steps are shown.
pub type Steps<'a> = &'a dyn Fn(Step);

/// What happens.
#[derive(Debug, Clone, PartialEq)]
pub enum Step {
    /// A line for the reader.
    Line(String),
    /// The offset stands: now the indicator can be read.
    Stands,
}

/// The offset must stand within so much beyond its slew, s.
const MOST_WAIT_S: f64 = 10.0;

/// Writes, waits for the reading, and goes back.
///
/// # Errors
/// What is wrong with plan, control or journal; nothing was written then.
pub fn commission(
    asked: &Commission,
    files: &Files,
    stopped: Stopped<'_>,
    (tell, said): (Steps<'_>, Said<'_>),
) -> Result<(Plan, Tried), Diagnostics> {
    let mut problems = Diagnostics::new();
    let plan = problems.keep(read_plan_to_commission(files, &asked.plan));
    let Some(plan) = plan.filter(|_| !problems.has_errors()) else { return Err(problems) };
    let live = axis_of(&plan, asked, problems.clone())?;
    let clock = RealClock::start();
    let mock = own_mock(&plan, &|line| tell(Step::Line(line.to_owned())));
    let mock = mock.map_err(|m| refused(&plan, "live-no-mock", &m, problems.clone()))?;
    let Opened { control, identity, held } = open(&plan, mock.as_ref(), &clock)?;
    let folder = folder_of(&plan, &mut problems).ok_or_else(|| problems.clone())?;
    let opened = DiskStore::open(&folder, &owner(&plan, &identity));
    let (store, earlier) = opened.map_err(|fault| unusable(&folder, &fault, problems.clone()))?;
    let earlier = at_start(held, earlier, mock.is_some());
    let mut target = vec![0.0; plan.settings.axes.len()];
    // As a person would type it at the control: `sign` is what is tried. Of a line both ends: the same all along the axis.
    let due = (asked.by / plan.axes[live].increment).round();
    let own = plan.offsets_of(live);
    target[own.clone()].fill(due);
    let slew_s = (due / plan.axes[live].limits.slew_per_s).abs();
    let run =
        Run::new(&plan, earlier, control, sensors_of(&plan), store).with_target(target.clone());
    let tried = drive((run, &plan), (&clock, stopped), (own, due), (slew_s, tell, said));
    Ok((plan, tried))
}

/// The place of the axis among the live ones; what is written is within its limit and at least an increment.
fn axis_of(
    plan: &Plan,
    asked: &Commission,
    mut problems: Diagnostics,
) -> Result<usize, Diagnostics> {
    let Some(live) = plan.axes.iter().position(|axis| axis.name == asked.axis) else {
        let names: Vec<&str> = plan.axes.iter().map(|axis| axis.name.as_str()).collect();
        let message = format!("the plan corrects no axis `{}`", asked.axis);
        problems.error("unknown-axis", Place::whole("--axis"), message, &names.join(" "));
        return Err(problems);
    };
    let axis = &plan.axes[live];
    let counted = (asked.by / axis.increment).abs();
    if !(1.0..=f64::from(axis.limits.limit)).contains(&counted) {
        let message = "less than one increment of the axis, or more than its limit".to_owned();
        problems.error("live-limit", Place::whole("--by"), message, "such as \"10 um\"");
        return Err(problems);
    }
    // The control takes whole increments: the ratio would be that of another offset.
    if (counted - counted.round()).abs() > 1e-6 * counted {
        let message = format!("{counted:.3} increments of the axis are no whole number of them");
        problems.error("live-limit", Place::whole("--by"), message, "such as \"10 um\"");
        return Err(problems);
    }
    Ok(live)
}

fn drive(
    (mut run, plan): (Run<'_>, &Plan),
    (clock, stopped): (&RealClock, Stopped<'_>),
    (own, due): (Range<usize>, f64),
    (slew_s, tell, said): (f64, Steps<'_>, Said<'_>),
) -> Tried {
    let (mut stands, mut found) = (false, None);
    let (mut last, mut before) = (String::new(), Vec::new());
    let mut ending: Option<f64> = None;
    loop {
        let cycle = run.cycle(clock, Wish { run: ending.is_none(), confirmed: false });
        let now_s = clock.now_s();
        let order = &cycle.output.order;
        let line = format!("{}: {}", order.state, order.reason);
        if line != last {
            tell(Step::Line(line.clone()));
            last = line;
        }
        if let Some(since_s) = ending {
            if is_gone(&cycle) || now_s - since_s > 1.5 * slew_s + MOST_WAIT_S {
                return found.unwrap_or(Tried::Abandoned);
            }
        } else if stopped() {
            ending = Some(now_s);
        } else if stands {
            match said() {
                Some(Some(measured)) => found = Some(Tried::Measured(measured)),
                Some(None) => found = Some(Tried::Abandoned),
                None => {}
            }
            ending = found.is_some().then_some(now_s);
        } else if is_there(&cycle, order.state, (&own, due, &mut before)) {
            stands = true;
            tell(Step::Stands);
        } else if now_s > slew_s + MOST_WAIT_S {
            (found, ending) = (Some(Tried::Never(last.clone())), Some(now_s));
        }
        clock.wait_until(now_s + plan.period_s);
    }
}

/// The offset acts, and the axes stand.
fn is_there(
    cycle: &crate::run::Cycle,
    state: State,
    (own, due, before): (&Range<usize>, f64, &mut Vec<f64>),
) -> bool {
    let Ok(seen) = &cycle.input.seen else { return false };
    let acting = seen.acting.as_ref().unwrap_or(&seen.offsets);
    let stands = std::mem::replace(before, seen.positions.clone()) == seen.positions;
    state == State::Run
        && stands
        && acting
            .get(own.clone())
            .is_some_and(|all| all.iter().all(|held| (f64::from(*held) - due).abs() < 0.5))
}

/// How much of what was written to an axis it has moved, in the direction that its `sign` says: 1 is right.
pub fn moved_ratio(plan: &Plan, axis: &str, wrote: f64, measured: f64) -> f64 {
    let sign = plan.axes.iter().find(|a| a.name == axis).map_or(1.0, |a| a.sign);
    Commissioned { wrote, measured, evidence: String::new() }.ratio(sign)
}

/// A text as a basic string of TOML holds it.
fn escaped(text: &str) -> String {
    let one = |c: char| match c {
        '"' | '\\' => format!("\\{c}"),
        c if c.is_control() => format!("\\u{:04X}", u32::from(c)),
        c => c.to_string(),
    };
    text.chars().map(one).collect()
}

/// The line for the plan.
pub fn evidence_line(
    plan: &Plan,
    axis: &str,
    (wrote, measured): (f64, f64),
    evidence: &str,
) -> String {
    use trueaxis::machine::axis::AxisKind;
    let live = plan.axes.iter().find(|a| a.name == axis);
    let kind = live.map(|a| plan.machine.axes()[a.axis].kind);
    let shown = |value: f64| match kind {
        Some(AxisKind::Rotary) => format!("{:.6} deg", value.to_degrees()),
        _ => format!("{:.3} um", value * 1e3),
    };
    let (wrote, measured, evidence) = (shown(wrote), shown(measured), escaped(evidence));
    format!(
        "commissioned = {{ wrote = \"{wrote}\", measured = \"{measured}\", evidence = \"{evidence}\" }}"
    )
}
