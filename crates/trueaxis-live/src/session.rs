//! A run as the command starts it: mock or real control, journal on the disk, real clock, an end by the ramp.

use crate::clock::{Clock, RealClock, date_s};
use crate::control::{Control, Identity};
use crate::cycle::{Correction, CycleInput};
use crate::datum::DatumOrder;
use crate::file::{ControlPlan, Plan, read_plan};
use crate::focas::TcpWire;
use crate::governor::{Earlier, Order, Owned, State};
use crate::history::{HISTORY_S, Peaks, heading, line};
use crate::memory::HeatOfRun;
use crate::metrics::prometheus;
use crate::mock::MockServer;
use crate::part::PartOfRun;
use crate::run::{Cycle, Run, Wish};
use crate::start::{
    check_built, connect, connect_linuxcnc, connect_opcua, doubt, mock_of, owner, sensors_of,
};
use crate::status::{LiveState, folder_of, is_lagging, live_state, status_json};
use crate::store::{DiskStore, StoreFault, kept_datums, kept_heat};
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use trueaxis::input::{Diagnostics, Files, Place};
use trueaxis::machine::heat::ThermalMemory;

/// The state is written so often, s.
const STATE_S: f64 = 1.0;
/// The heat in the scales is kept so often, s.
const HEAT_S: f64 = 60.0;
/// Any port that is free, on this computer only.
const OWN_ADDRESS: &str = "127.0.0.1:0";

/// How a run is started.
#[derive(Debug, Clone, Default)]
pub struct Session {
    /// The plan.
    pub plan: PathBuf,
    /// It ends after so much; without it when it is stopped.
    pub for_s: Option<f64>,
    /// Everything is computed and nothing written, no heartbeat either.
    pub dry: bool,
    /// A person confirms what was latched, or what differs from the journal.
    pub confirmed: bool,
    /// Every cycle goes into this file.
    pub record: Option<PathBuf>,
}

/// Says whether a run shall end.
pub type Stopped<'a> = &'a dyn Fn() -> bool;

/// Receives a line for each change of state.
pub type Lines<'a> = &'a dyn Fn(&str);

/// How it ended.
#[derive(Debug)]
pub struct Ended {
    /// The plan.
    pub plan: Plan,
    /// The last state.
    pub last: LiveState,
    /// Nothing of this program is left in the control.
    pub is_clean: bool,
}

/// Runs until it is stopped: `stopped` says so, `tell` receives a line for each change of state.
///
/// # Errors
/// What is wrong with plan, control or journal; nothing was written then.
pub fn run_session(
    session: &Session,
    files: &Files,
    stopped: Stopped<'_>,
    tell: Lines<'_>,
) -> Result<(Ended, Diagnostics), Diagnostics> {
    let mut problems = Diagnostics::new();
    let plan = problems.keep(read_plan(files, &session.plan));
    let Some(plan) = plan.filter(|_| !problems.has_errors()) else { return Err(problems) };
    let clock = RealClock::start();
    let mock = match own_mock(&plan, tell) {
        Ok(mock) => mock,
        Err(message) => return Err(refused(&plan, "live-no-mock", &message, problems)),
    };
    let Opened { control, identity, held } = match open(&plan, mock.as_ref(), &clock) {
        Ok(opened) => opened,
        Err(found) => {
            problems.append(found);
            return Err(problems);
        }
    };
    if let Some(doubt) = doubt(&plan, &identity) {
        tell(&doubt);
        let hint = "what was published is listed in docs/ladder-watchdog.md, FANUC";
        problems.warn("live-series", Place::whole(&plan.path.display().to_string()), doubt, hint);
    }
    let Some(folder) = folder_of(&plan, &mut problems) else { return Err(problems) };
    let (mut store, earlier) = match DiskStore::open(&folder, &owner(&plan, &identity)) {
        Ok((store, earlier)) => (store.of_plan(&plan.hash), earlier),
        Err(fault) => return Err(unusable(&folder, &fault, problems)),
    };
    let earlier = at_start(held, earlier, mock.is_some());
    if let Some(path) = &session.record
        && let Err(error) = store.record_into(path)
    {
        let place = path.display().to_string();
        problems.error(
            "unwritable-file",
            Place::whole(&place),
            format!("cannot be written: {error}"),
            "name another file or folder",
        );
        return Err(problems);
    }
    let heat = match first_heat(&plan, &folder, clock.now_s()) {
        Ok(heat) => heat,
        Err(message) => {
            let place = folder.join("heat.json").display().to_string();
            problems.error("live-heat", Place::whole(&place), message, HEAT_HINT);
            return Err(problems);
        }
    };
    let run = Run::new(&plan, earlier, control, sensors_of(&plan), store).with_heat(heat);
    let mut run = if session.dry { run.dry() } else { run };
    match first_datum(&plan, &folder, (session.confirmed, run.correction())) {
        Ok(order) => order.into_iter().for_each(|order| run.ask_datum(order)),
        Err(message) => {
            let place = folder.join("datum.json").display().to_string();
            problems.error("live-datum", Place::whole(&place), message, DATUM_HINT);
            return Err(problems);
        }
    }
    let last = drive(session, &plan, (run, &identity), (&clock, stopped, tell));
    let is_clean =
        session.dry || (last.state == State::Off && last.axes.iter().all(|axis| axis.own == 0.0));
    Ok((Ended { plan, last, is_clean }, problems))
}

/// What to do about a zero that cannot be used.
const DATUM_HINT: &str = "touch it again in a run (trueaxis live datum PLAN), or remove it: trueaxis live datum PLAN --clear; --confirm keeps it";

/// The zero of the part at the start: that of an earlier run, or that of the plan.
fn first_datum(
    plan: &Plan,
    folder: &Path,
    (confirmed, correction): (bool, &Correction),
) -> Result<Option<DatumOrder>, String> {
    if let Some(kept) = kept_datums(folder)? {
        return match kept.plan_hash == plan.hash || confirmed {
            true => Ok(Some(DatumOrder::Kept(kept.zeros))),
            false => {
                Err("the zero of the part was touched under another plan or machine file"
                    .to_owned())
            }
        };
    }
    // That of the plan is in the correction already, if it can be computed.
    let planned = plan.datum.as_ref().map(|planned| correction.planned_datum(planned));
    planned.transpose().map_err(|reason| reason.to_string())?;
    Ok(None)
}

/// What to do about heat that cannot be used.
const HEAT_HINT: &str =
    "remove it, and begin while the scales are uniform, or state `time` at their heated places";

/// The heat that an earlier run has left in the scales, on the clock of this one.
fn first_heat(plan: &Plan, folder: &Path, now_s: f64) -> Result<Option<HeatOfRun>, String> {
    if !ThermalMemory::is_needed(&plan.machine) {
        return Ok(None);
    }
    let Some(kept) = kept_heat(folder)? else { return Ok(None) };
    let heat = ThermalMemory::from(kept.heat);
    if kept.machine != plan.machine.name() || !heat.fits(&plan.machine) {
        return Err("it is of other scales, or of other places at them".to_owned());
    }
    let Some(since_s) = date_s().checked_sub(kept.date_s) else {
        return Err(
            "it is of a time that is not yet: the clock of this computer was set back".to_owned()
        );
    };
    #[expect(clippy::cast_precision_loss, reason = "seconds of some years")]
    let since_s = since_s as f64;
    Ok(Some(heat.shifted(now_s - since_s).into()))
}

/// A control that was opened and compared with the plan.
pub(crate) struct Opened {
    pub control: Box<dyn Control>,
    pub identity: Identity,
    /// What it holds of us, where the control itself says so.
    pub held: Option<Owned>,
}

/// What is known of an earlier run: a control that says so itself knows best; a mock of its own begins with nothing in it.
pub(crate) fn at_start(held: Option<Owned>, journal: Earlier, is_mock: bool) -> Earlier {
    match (is_mock, held) {
        (true, _) => Earlier::Nothing,
        (false, Some(held)) => Earlier::Owned(held),
        (false, None) => journal,
    }
}

pub(crate) fn open(
    plan: &Plan,
    mock: Option<&MockServer>,
    clock: &RealClock,
) -> Result<Opened, Diagnostics> {
    check_built(plan)?;
    match &plan.control {
        ControlPlan::Fanuc(fanuc) => {
            let own = mock.map(|server| server.address().to_string());
            let address = fanuc.address.clone().or(own).unwrap_or_default();
            let wire = TcpWire::new(&address, fanuc.timeout_s);
            let (control, identity) = connect((plan, fanuc), wire, clock.now_s())?;
            Ok(Opened { control: Box::new(control), identity, held: None })
        }
        ControlPlan::OpcUa(opcua) => {
            let (control, identity) = connect_opcua(plan, opcua, clock.now_s())?;
            Ok(Opened { control, identity, held: None })
        }
        ControlPlan::LinuxCnc(_) => {
            let (control, identity) = connect_linuxcnc(plan)?;
            let last = control.held().to_vec();
            let held = Owned { base: vec![0; last.len()], before: last.clone(), last };
            Ok(Opened { control: Box::new(control), identity, held: Some(held) })
        }
    }
}

/// The mock of a plan, on this computer.
pub(crate) fn own_mock(plan: &Plan, tell: &dyn Fn(&str)) -> Result<Option<MockServer>, String> {
    let Some(mock) = mock_of(plan) else { return Ok(None) };
    let server = MockServer::start(mock, OWN_ADDRESS)
        .map_err(|error| format!("the mock cannot start: {error}"))?;
    tell(&format!("mock of a FANUC control at {}", server.address()));
    Ok(Some(server))
}

pub(crate) fn refused(
    plan: &Plan,
    code: &'static str,
    message: &str,
    mut problems: Diagnostics,
) -> Diagnostics {
    let place = Place::whole(&plan.path.display().to_string());
    problems.error(
        code,
        place,
        message.to_owned(),
        "start it again, or name the address of a control",
    );
    problems
}

pub(crate) fn unusable(
    folder: &Path,
    fault: &StoreFault,
    mut problems: Diagnostics,
) -> Diagnostics {
    let place = Place::whole(&folder.display().to_string());
    let message = fault.to_string();
    match fault {
        StoreFault::Held => problems.error(
            "live-already-running",
            place,
            message,
            "two runs would write into the same offset: end the other one first",
        ),
        StoreFault::Other(_) => problems.error(
            "live-other-journal",
            place,
            message,
            "name another folder: [journal] folder = …; remove this one only if its offset is not in the control any more",
        ),
        StoreFault::Foreign(_) => problems.error(
            "live-no-journal",
            place,
            message,
            "a run would write over it or remove it: name a folder of its own",
        ),
        StoreFault::Disk(_) => problems.error(
            "live-no-journal",
            place,
            message,
            "without its journal a run does not know which offset is its own: name a folder that can be written",
        ),
    }
    problems
}

/// The loop until it is stopped, and the ramp after it.
fn drive(
    session: &Session,
    plan: &Plan,
    (mut run, identity): (Run<'_>, &Identity),
    (clock, stopped, tell): (&RealClock, Stopped<'_>, Lines<'_>),
) -> LiveState {
    let ramp_s = plan
        .axes
        .iter()
        .map(|a| f64::from(a.limits.limit) / a.limits.slew_per_s)
        .fold(0.0, f64::max);
    let mut confirmed = session.confirmed;
    // Since when the correction is no more wanted, s; and whether it has gone.
    let (mut ending, gone) = (None, std::cell::Cell::new(false));
    let asked = std::cell::Cell::new(false);
    let (columns, mut peaks, mut kept_s) = (heading(plan), Peaks::default(), 0.0);
    let mut last: Option<LiveState> = None;
    let mut part = PartOfRun::default();
    let mut heat_s = 0.0;
    run.go(
        clock,
        plan.period_s,
        |now_s| {
            let over =
                asked.get() || stopped() || session.for_s.is_some_and(|for_s| now_s >= for_s);
            if over && ending.is_none() {
                ending = Some(now_s);
            }
            let late = ending.is_some_and(|since_s| now_s - since_s > 1.5 * ramp_s + 10.0);
            let confirmed = std::mem::take(&mut confirmed);
            (!late && !gone.get()).then_some(Wish { run: ending.is_none(), confirmed })
        },
        |run, cycle| {
            gone.set(is_gone(cycle) && !cycle.input.run);
            peaks.add(plan, cycle, run.correction());
            part.cycle(plan, cycle, run);
            let due = last.as_ref().is_none_or(|last| {
                let order = &cycle.output.order;
                cycle.input.now_s - last.time_s >= STATE_S
                    || last.state != order.state
                    || !last.cause.is_like(&order.reason)
                    || last.lagging != is_lagging(plan, cycle)
            });
            if due || gone.get() {
                part.ask(plan, cycle.input.now_s, run);
                let state = live_state(plan, identity, cycle, run.correction(), run.counts());
                let state = LiveState { part: part.name().map(str::to_owned), ..state };
                let said = format!("{:8.1} s  {}: {}", state.time_s, state.state, state.reason);
                let same = last.as_ref().is_some_and(|last| {
                    last.state == state.state && last.cause.is_like(&state.cause)
                });
                if !same {
                    tell(&said);
                }
                if state.lagging && last.as_ref().is_none_or(|last| !last.lagging) {
                    tell(&late(plan, &state));
                }
                // A state that cannot be shown does not end a run; the journal says so.
                let _ = run.store().state(&status_json(plan, true, Some(state.clone())));
                let _ = run.store().metrics(prometheus(&plan.name, &state));
                if state.time_s - kept_s >= HISTORY_S {
                    kept_s = state.time_s;
                    run.store().history(&columns, line(&state, &mut peaks));
                }
                if state.time_s - heat_s >= HEAT_S || gone.get() {
                    heat_s = state.time_s;
                    keep_heat(run, state.time_s);
                }
                asked.set(asked.get() || run.store().is_stop_asked());
                if let Some(order) = run.store().datum_order() {
                    run.ask_datum(order);
                }
                last = Some(state);
            }
        },
    );
    part.end(clock.now_s(), &mut run);
    // why: `go` makes a cycle before it can end: at 0 s nothing is over, unless it is stopped at once.
    last.unwrap_or_else(|| {
        let cycle = run.cycle(clock, Wish::default());
        live_state(plan, identity, &cycle, run.correction(), run.counts())
    })
}

/// Heat that cannot be kept is missing in the next run, which then says so.
fn keep_heat(run: &mut Run<'_>, now_s: f64) {
    let heat = run.correction().memory().filter(|heat| heat.last_s.is_some()).cloned();
    if let Some(heat) = heat {
        let _ = run.store().heat(heat.shifted(-now_s).into());
    }
}

pub(crate) fn is_gone(cycle: &Cycle) -> bool {
    cycle.output.order.state == State::Off
}

/// Which offsets are late, and by how much.
fn late(plan: &Plan, state: &LiveState) -> String {
    let axes = state.axes.iter().zip(&plan.axes).filter(|(_, plan)| plan.lag.is_some());
    let each =
        axes.map(|(axis, _)| format!("{} {:.1} {}", axis.axis, axis.lag.unwrap_or(0.0), axis.unit));
    let each: Vec<String> = each.collect();
    format!(
        "{:8.1} s  the offsets are late: {}; feed less, or a shorter period",
        state.time_s,
        each.join(", ")
    )
}

/// What a replay has shown.
#[derive(Debug, Clone, PartialEq)]
pub struct Replayed {
    /// Cycles of the record.
    pub cycles: usize,
    /// The first cycle whose order differs, from 1.
    pub differs: Option<usize>,
}

/// Computes the orders of a record again.
///
/// # Errors
/// A record that cannot be read, or of a plan that is none.
pub fn replay(files: &Files, plan: &Path, record: &Path) -> Result<Replayed, Diagnostics> {
    let mut problems = Diagnostics::new();
    let plan = problems.keep(read_plan(files, plan));
    let Some(plan) = plan.filter(|_| !problems.has_errors()) else { return Err(problems) };
    let shown = record.display().to_string();
    let bytes = files.read(record).map_err(|error| {
        let mut problems = Diagnostics::new();
        problems.error(
            "unreadable-file",
            Place::whole(&shown),
            error.to_string(),
            "name the record of a run",
        );
        problems
    })?;
    let mut correction = Correction::new(&plan, None);
    let mut replayed = Replayed { cycles: 0, differs: None };
    for line in BufReader::new(&bytes[..]).lines() {
        let read =
            line.ok().and_then(|line| serde_json::from_str::<(CycleInput, Order)>(&line).ok());
        let Some((input, order)) = read else {
            let place = Place { file: shown.clone(), line: replayed.cycles + 1, column: 1 };
            let message = "this line is no cycle of a record".to_owned();
            problems.error(
                "live-record",
                place,
                message,
                "a run that was killed leaves a line that is cut: remove it",
            );
            return Err(problems);
        };
        replayed.cycles += 1;
        if correction.step(&input).order != order && replayed.differs.is_none() {
            replayed.differs = Some(replayed.cycles);
        }
    }
    if replayed.cycles == 0 {
        let message = "this record has no cycle: nothing was replayed".to_owned();
        let hint = "name the record of a run that has made cycles";
        problems.error("live-record", Place::whole(&shown), message, hint);
        return Err(problems);
    }
    Ok(replayed)
}
