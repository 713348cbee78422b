//! `trueaxis live`: the correction in the control while it cuts.

mod commission;
mod datum;
mod part;

use crate::door::DoorArguments;
use crate::output::{Answer, Format, Outcome, report_and, show, tell};
use clap::{Args, Subcommand, ValueEnum};
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;
use trueaxis::files::disk;
use trueaxis::input::{Diagnostics, Dimension, Place, parse_quantity};
use trueaxis::report::refused_json;
use trueaxis_live::expect::ExpectLive;
use trueaxis_live::file::read_plan;
use trueaxis_live::mock::MockServer;
use trueaxis_live::session::{Session, replay, run_session};
use trueaxis_live::start::mock_of;
use trueaxis_live::status::{LiveStatus, folder_of, shown_state, status_json};
use trueaxis_live::store::{ask_stop, is_running};

/// A run is going on: the first interrupt ends it by its ramp.
static RUNNING: AtomicBool = AtomicBool::new(false);
static STOPPED: AtomicBool = AtomicBool::new(false);

/// Whether an interrupt ends a run by its ramp; the second one ends the program.
pub fn ends_by_its_ramp() -> bool {
    RUNNING.load(Ordering::Relaxed) && !STOPPED.swap(true, Ordering::Relaxed)
}

/// The run.
#[derive(Args)]
#[command(
    args_conflicts_with_subcommands = true,
    after_help = "\
Examples:
  trueaxis live examples/08_live/gantry-mock.toml --for 60s
  trueaxis live status examples/08_live/gantry-mock.toml --format json
  trueaxis live expect examples/08_live/gantry-mock.toml --temperature-log examples/03_predict/torque-arm-hall.csv
  trueaxis live mock fanuc examples/08_live/gantry-mock.toml --port 8193

An interrupt (Ctrl-C) takes the offset back by its slew, then the run ends; a second one ends it at once and
leaves the offset in the control. This is no safety function: the limits of the control stay the last barrier.
Exit status: 0 ended, and nothing of it is in the control; 1 its offset is still there; 2 unusable input."
)]
pub struct Arguments {
    #[command(subcommand)]
    command: Option<LiveCommand>,
    #[command(flatten)]
    run: RunArguments,
}

#[derive(Args)]
struct RunArguments {
    /// The plan: machine, control, sensors, limits
    #[arg(value_name = "LIVE.toml", required = true)]
    plan: Option<PathBuf>,
    /// End after so much, such as 60s or 8h; without it the run ends by an interrupt
    #[arg(long = "for", value_name = "TIME")]
    duration: Option<String>,
    /// Compute everything and write nothing, no heartbeat either
    #[arg(long)]
    dry_run: bool,
    /// A person has seen what was latched, and confirms it
    #[arg(long)]
    confirm: bool,
    /// Record every cycle into this file; trueaxis live replay computes it again
    #[arg(long, value_name = "FILE")]
    record: Option<PathBuf>,
    /// Output as text or as one JSON document
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
}

#[derive(Subcommand)]
enum LiveCommand {
    /// What a run is doing, or what the last one has left
    Status(StatusArguments),
    /// What the correction would leave of the tool on a recorded day
    Expect(ExpectArguments),
    /// End a run by its ramp, from another terminal
    Stop(StopArguments),
    /// The zero of the part is being touched: what the correction lacks there is subtracted from now on
    Datum(DatumArguments),
    /// Say which part is being made, so that what acts on it is recorded; show the record
    Part(part::PartArguments),
    /// Write an offset to one axis, take the reading of an indicator, and compare
    Commission(CommissionArguments),
    /// Compute the orders of a record again and compare them to the last bit
    Replay(ReplayArguments),
    /// A control that is not there, for demonstrations and tests
    Mock(MockArguments),
}

/// The plan of the run.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trueaxis live status examples/08_live/gantry-mock.toml
  trueaxis live status examples/08_live/gantry-mock.toml --last 8h
  trueaxis live status examples/08_live/gantry-mock.toml --format json

With --last it says what the tool was off by the model, before and after the correction; a line is kept each 10 s,
for a day at least. Exit status: 0 shown, 2 unusable input.")]
struct StatusArguments {
    /// The plan
    #[arg(value_name = "LIVE.toml")]
    plan: PathBuf,
    /// What acted over the last hours, too: a time such as 8h
    #[arg(long, value_name = "TIME")]
    last: Option<String>,
    #[command(flatten)]
    door: DoorArguments,
}

/// The plan and the day.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trueaxis live expect examples/08_live/gantry-mock.toml --temperature-log examples/03_predict/torque-arm-hall.csv
  trueaxis live expect examples/08_live/gantry-mock.toml --temperature-log examples/03_predict/torque-arm-hall.csv --without workpiece

Every row of the log is one sample of the sensors. Exit status: 0 done, 2 unusable input.")]
struct ExpectArguments {
    /// The plan
    #[arg(value_name = "LIVE.toml")]
    plan: PathBuf,
    /// The temperatures of the day: a table with time_s and one column for each sensor (scale_x_degC)
    #[arg(long, value_name = "LOG.csv")]
    temperature_log: PathBuf,
    /// Price the loss of this sensor only; without it that of every sensor
    #[arg(long, value_name = "SENSOR")]
    without: Option<String>,
    #[command(flatten)]
    door: DoorArguments,
}

/// The plan of the run.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trueaxis live datum examples/08_live/gantry-mock.toml
  trueaxis live datum examples/08_live/gantry-mock.toml --clear

Give it while the axes stand where the zero of the part was touched, the correction as it was at the touch. What was off
there is in the zero already; without this it would be corrected twice. With a run that has reached its target nothing
is subtracted; with one that holds, or a --dry-run, as much as it lacks. It is kept for the next run of this plan. If it
was touched before, without any run, write it into the plan: [datum] at = { ... }, temperatures = { ... }.
Where the control numbers its setups, it is the zero of the one that is in the machine.
Exit status: 0 done, 1 the run refused it, 2 unusable input.")]
struct DatumArguments {
    /// The plan
    #[arg(value_name = "LIVE.toml")]
    plan: PathBuf,
    /// Subtract nothing any more; a [datum] of the plan counts again. In a run for the setup that is in the machine,
    /// without one for all
    #[arg(long)]
    clear: bool,
}

/// The plan of the run.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trueaxis live stop examples/08_live/gantry-mock.toml

The run takes its offset back by the slew and ends; this waits for it, a minute at most. Exit status: 0 it has ended, or none was
running; 1 it still runs; 2 unusable input.")]
struct StopArguments {
    /// The plan
    #[arg(value_name = "LIVE.toml")]
    plan: PathBuf,
}

/// The axis, and how far.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trueaxis live commission my-live.toml --axis X --by \"10 um\" --evidence \"N.N., dial gauge 0.1 um\"

Put an indicator against the tool in the direction of the axis; the axes stand. When the offset acts, type what the
indicator shows, such as 9.8 um; an empty line ends it. The offset goes back by its slew. The line that is printed belongs into
[axis.X] of the plan. Exit status: 0 within a fifth of what was written, 1 not, or no reading; 2 unusable input.")]
struct CommissionArguments {
    /// The plan; its axes need no `commissioned` for this
    #[arg(value_name = "LIVE.toml")]
    plan: PathBuf,
    /// The axis
    #[arg(long, value_name = "AXIS")]
    axis: String,
    /// How far its offset is moved
    #[arg(long, value_name = "LENGTH", default_value = "10 um")]
    by: String,
    /// Who reads which instrument
    #[arg(long, value_name = "TEXT", default_value = "name, instrument")]
    evidence: String,
}

/// The record of a run.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trueaxis live examples/08_live/gantry-mock.toml --for 10s --record day.jsonl
  trueaxis live replay examples/08_live/gantry-mock.toml day.jsonl

Exit status: 0 the same orders, 1 an order differs, 2 unusable input.")]
struct ReplayArguments {
    /// The plan of the run
    #[arg(value_name = "LIVE.toml")]
    plan: PathBuf,
    /// The record
    #[arg(value_name = "RECORD.jsonl")]
    record: PathBuf,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum MockKind {
    /// FANUC by FOCAS2 over Ethernet
    Fanuc,
}

/// The mock.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trueaxis live mock fanuc examples/08_live/gantry-mock.toml --port 8193

Its axes move along the stops of [mock], its ladder watches the heartbeat. It serves this computer only, until
it is interrupted or --for is over. Exit status: 0 ended, 2 unusable input.")]
struct MockArguments {
    /// The kind of control
    #[arg(value_enum)]
    kind: MockKind,
    /// A plan with address = \"mock\"
    #[arg(value_name = "LIVE.toml")]
    plan: PathBuf,
    /// The port; 0 takes any that is free
    #[arg(long, default_value = "8193")]
    port: u16,
    /// End after so much, such as 60s
    #[arg(long = "for", value_name = "TIME")]
    duration: Option<String>,
}

pub fn run(arguments: &Arguments) -> Outcome {
    match &arguments.command {
        None => run_live(&arguments.run),
        Some(LiveCommand::Status(a)) => status(a),
        Some(LiveCommand::Expect(a)) => {
            let (plan, log) = (a.plan.clone(), a.temperature_log.clone());
            a.door.door().ask(&ExpectLive { plan, log, without: a.without.clone() })
        }
        Some(LiveCommand::Stop(arguments)) => stop(arguments),
        Some(LiveCommand::Datum(arguments)) => datum::run(arguments.clear, &arguments.plan),
        Some(LiveCommand::Part(arguments)) => part::run(arguments),
        Some(LiveCommand::Commission(arguments)) => commission::run(arguments),
        Some(LiveCommand::Replay(arguments)) => run_replay(arguments),
        Some(LiveCommand::Mock(arguments)) => run_mock(arguments),
    }
}

fn status(arguments: &StatusArguments) -> Outcome {
    let door = arguments.door.door();
    match duration("--last", arguments.last.as_ref()) {
        Ok(last_s) => {
            let hours = last_s.map(|s| s / 3600.0);
            door.ask(&LiveStatus { plan: arguments.plan.clone(), hours })
        }
        Err(problems) => refuse(problems, door.format),
    }
}

/// A time such as `60s`.
fn duration(option: &str, text: Option<&String>) -> Result<Option<f64>, Diagnostics> {
    let Some(text) = text else { return Ok(None) };
    let found = parse_quantity(text, Dimension::Time).ok().filter(|s| *s > 0.0);
    found.map(Some).ok_or_else(|| {
        let mut problems = Diagnostics::new();
        let message = format!("`{text}` is no time");
        problems.error("bad-duration", Place::whole(option), message, "such as 60s, 10min or 8h");
        problems
    })
}

fn refuse(problems: Diagnostics, format: Format) -> Outcome {
    report_and(problems.clone(), "nothing was written to the control");
    if format == Format::Json {
        show(&Answer::Json(refused_json(&problems)));
    }
    Outcome::Unusable
}

fn run_live(arguments: &RunArguments) -> Outcome {
    let for_s = match duration("--for", arguments.duration.as_ref()) {
        Ok(for_s) => for_s,
        Err(problems) => return refuse(problems, arguments.format),
    };
    let session = Session {
        plan: arguments.plan.clone().unwrap_or_default(),
        for_s,
        dry: arguments.dry_run,
        confirmed: arguments.confirm,
        record: arguments.record.clone(),
    };
    RUNNING.store(true, Ordering::Relaxed);
    let stopped = || STOPPED.load(Ordering::Relaxed);
    let (ended, problems) = match run_session(&session, &disk(), &stopped, &|line| tell(line)) {
        Ok(ended) => ended,
        Err(problems) => return refuse(problems, arguments.format),
    };
    report_and(problems, "");
    let shown = show(&match arguments.format {
        Format::Json => Answer::Json(status_json(&ended.plan, false, Some(ended.last.clone()))),
        Format::Text => Answer::Text(shown_state(&ended.plan, &ended.last)),
    });
    if !ended.is_clean {
        tell(
            "the offset of this run is still in the control: start it again, or clear it at the control",
        );
        return Outcome::No;
    }
    shown
}

fn stop(arguments: &StopArguments) -> Outcome {
    let (plan, mut problems) = read_plan(&disk(), &arguments.plan);
    let folder = plan.as_ref().and_then(|plan| folder_of(plan, &mut problems));
    let Some(folder) = folder else { return refuse(problems, Format::Text) };
    if !is_running(&folder) {
        return show(&Answer::Text("no run of this plan is going on\n".to_owned()));
    }
    if let Err(error) = ask_stop(&folder) {
        let place = Place::whole(&folder.display().to_string());
        problems.error(
            "live-no-journal",
            place,
            format!("cannot be written: {error}"),
            "stop it as the user who has started it",
        );
        return refuse(problems, Format::Text);
    }
    for _ in 0..600 {
        if !is_running(&folder) {
            return show(&Answer::Text("the run has ended\n".to_owned()));
        }
        std::thread::sleep(Duration::from_millis(100));
    }
    show(&Answer::Text(
        "the run has not ended within a minute: see trueaxis live status\n".to_owned(),
    ));
    Outcome::No
}

fn run_replay(arguments: &ReplayArguments) -> Outcome {
    match replay(&disk(), &arguments.plan, &arguments.record) {
        Err(problems) => refuse(problems, Format::Text),
        Ok(replayed) => match replayed.differs {
            None => show(&Answer::Text(format!("{} cycles, the same orders\n", replayed.cycles))),
            Some(cycle) => {
                let text = format!(
                    "{} cycles; cycle {cycle} is the first with another order\n",
                    replayed.cycles
                );
                show(&Answer::Text(text));
                Outcome::No
            }
        },
    }
}

fn run_mock(arguments: &MockArguments) -> Outcome {
    let MockKind::Fanuc = arguments.kind;
    let (plan, mut problems) = read_plan(&disk(), &arguments.plan);
    let for_s = match duration("--for", arguments.duration.as_ref()) {
        Ok(for_s) => for_s,
        Err(found) => return refuse(found, Format::Text),
    };
    let place = Place::whole(&arguments.plan.display().to_string());
    let Some(plan) = plan else { return refuse(problems, Format::Text) };
    let Some(mock) = mock_of(&plan) else {
        let message = "the plan has no mock".to_owned();
        problems.error(
            "live-no-mock",
            place,
            message,
            "address = \"mock\" and [mock] with feed and stops",
        );
        return refuse(problems, Format::Text);
    };
    let server = match MockServer::start(mock, &format!("127.0.0.1:{}", arguments.port)) {
        Ok(server) => server,
        Err(error) => {
            let message = format!("the mock cannot start: {error}");
            problems.error(
                "live-no-mock",
                place,
                message,
                "name another --port; 0 takes any that is free",
            );
            return refuse(problems, Format::Text);
        }
    };
    tell(&format!("mock of a FANUC control at {}", server.address()));
    server.wait(for_s);
    Outcome::Done
}
