//! A simulation as a report.

use super::simulation_pictures::{axis_pictures, curves, marks_note};
use super::simulation_views::tool_path;
use super::stock::stock_section;
use super::tool_states::{spindle_section, state_section};
use crate::{
    AxisUse, Drift, Findings, Issue, IssueKind, IssueList, Job, Machined, Run, Series, SetUp,
    Summary, Worst, limit_name, shown, unit,
};
use std::path::Path;
use trueaxis_input::{Diagnostic, Severity};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{AxisKind, Travel};
use trueaxis_nc::Control;
use trueaxis_nc::moves::Origin;
use trueaxis_report::numbers::fixed;
use trueaxis_report::{Columns, Figure, Report, Section, Standing, Table, Verdict};

/// Everything that a report of a simulation shows.
#[derive(Clone, Copy)]
pub struct Simulation<'a> {
    /// The machine.
    pub machine: &'a Machine,
    /// The program file.
    pub program: &'a str,
    /// The control that the program is for.
    pub control: Control,
    /// Tools, work offsets and bodies.
    pub setup: &'a SetUp,
    /// How it ended.
    pub run: &'a Run,
    /// Times, paths, extents and the largest deviations.
    pub summary: &'a Summary,
    /// The issues that were found.
    pub issues: &'a IssueList,
    /// The file of the path, if one was written.
    pub path_file: Option<&'a str>,
    /// The effect of changing temperatures, where they followed a log.
    pub drift: Option<&'a Drift>,
    /// What became of the stock, where it was cut.
    pub machined: Option<&'a Machined>,
}

impl<'a> Simulation<'a> {
    /// What a report of a simulation shows; no file of the path was written.
    pub fn of(job: &'a Job, found: &'a Findings) -> Self {
        Self {
            machine: &job.machine,
            program: job.program.file(),
            control: job.control,
            setup: &job.setup,
            run: &found.run,
            summary: &found.summary,
            issues: &found.issues,
            path_file: None,
            drift: found.drift.as_ref(),
            machined: found.machined.as_ref(),
        }
    }

    /// The block as people name it: `line 12`, with the program where it is not the main one.
    pub fn block(&self, origin: Origin) -> String {
        match (origin.program, self.run.programs.get(origin.program as usize)) {
            (0, _) | (_, None) => format!("line {}", origin.line),
            (_, Some(program)) => format!("{program}:{}", origin.line),
        }
    }

    /// From which block to which.
    fn blocks(&self, issue: &Issue) -> String {
        match issue.first == issue.last {
            true => self.block(issue.first),
            false => format!("{} to {}", self.block(issue.first), self.block(issue.last)),
        }
    }

    fn is_exact(&self) -> bool {
        self.machine.stated_errors().is_empty() && !self.machine.is_at_temperatures()
    }
}

/// Rows of the table of issues, and of other lists that a program can make long.
const MOST_ROWS: usize = 1000;

/// Rows of the table of issues on the terminal.
const MOST_ON_TERMINAL: usize = 26;

pub(super) fn control_name(control: Control) -> &'static str {
    match control {
        Control::Sinumerik840d => "SINUMERIK 840D",
        Control::Fanuc => "FANUC",
        Control::Haas => "HAAS",
        Control::LinuxCnc => "LinuxCNC",
        Control::Heidenhain => "HEIDENHAIN",
    }
}

/// An issue in one sentence with its values.
pub fn issue_text(machine: &Machine, issue: &Issue) -> String {
    let name = |axis: usize| machine.axes()[axis].name;
    let value =
        |axis: usize, v: f64| format!("{:.3} {}", shown(machine, axis, v), unit(machine, axis));
    match &issue.kind {
        IssueKind::Collision { first, second } => {
            format!("collision: {first} cuts into {second}, clearance 0 mm")
        }
        IssueKind::NearMiss { first, second } => {
            format!("near miss: {first} comes to {:.3} mm of {second}", issue.value)
        }
        IssueKind::RapidInStock { first, second } => {
            format!("rapid through stock: {first} in {second}, clearance 0 mm")
        }
        IssueKind::Gouge { tool } => {
            format!("gouge: tool {tool} cuts {:.3} mm into the part", issue.value)
        }
        IssueKind::OverTravel { axis } => format!(
            "over-travel: {} goes to {}, its end is {}",
            name(*axis),
            value(*axis, issue.value),
            value(*axis, issue.limit)
        ),
        IssueKind::OverSpeed { axis, near_pole, slows } => format!(
            "over-speed: the feed needs {}/s of {}, its limit is {}/s{}; {}",
            value(*axis, issue.value),
            name(*axis),
            value(*axis, issue.limit),
            if *near_pole { " (near a pole of the rotary axes)" } else { "" },
            match *slows {
                true => "the control slows down",
                false => "the timing of three phases keeps the feed, beyond what the axis can do",
            }
        ),
        IssueKind::SlowedDown { axis, limit } => {
            let limit = limit_name(*limit);
            let held = 100.0 * issue.value;
            format!("feed not held: {held:.1} % of it, because of the {limit} of {}", name(*axis))
        }
        IssueKind::RotaryFlip { axis } => format!(
            "flip: {} turns by {} while the tool turns by {:.3} deg",
            name(*axis),
            value(*axis, issue.value),
            issue.limit.to_degrees()
        ),
    }
}

/// The code of an issue in JSON.
pub fn issue_code(kind: &IssueKind) -> &'static str {
    match kind {
        IssueKind::Collision { .. } => "collision",
        IssueKind::NearMiss { .. } => "near-miss",
        IssueKind::RapidInStock { .. } => "rapid-in-stock",
        IssueKind::Gouge { .. } => "gouged-part",
        IssueKind::OverTravel { .. } => "over-travel",
        IssueKind::OverSpeed { .. } => "over-speed",
        IssueKind::SlowedDown { .. } => "slowed-down",
        IssueKind::RotaryFlip { .. } => "rotary-flip",
    }
}

/// Seconds as people read them: `4 min 05.20 s`.
pub fn clock(seconds: f64) -> String {
    let whole = seconds.max(0.0);
    let minutes = (whole / 60.0).floor();
    if minutes < 1.0 {
        return format!("{whole:.2} s");
    }
    let (hours, rest) = ((minutes / 60.0).floor(), whole - minutes * 60.0);
    match hours >= 1.0 {
        true => format!("{hours:.0} h {:02.0} min {rest:05.2} s", minutes - hours * 60.0),
        false => format!("{minutes:.0} min {rest:05.2} s"),
    }
}

/// A simulation as a report; with pictures where `series` holds their curves.
pub fn simulation_report<'a>(s: Simulation<'a>, series: Option<&'a Series>) -> Report<'a> {
    let name = Path::new(s.program).file_name().map_or(s.program.into(), |n| n.to_string_lossy());
    let chain = s.machine.chain_text();
    let verdict = verdict(&s);
    let drawn = series.map(|series| [path_section(s, series), deviation_curves(s, series)]);
    Report::new(format!("{name} on {}", s.machine.name()))
        .line(format!("{} · {chain} · {}", control_name(s.control), clock(s.summary.time_s)))
        .verdict(verdict.standing, verdict.word, verdict.sentence)
        .section(issue_section(&s))
        .section(summary_section(s.summary))
        .sections(s.machined.map(|machined| stock_section(&s, machined)))
        .section(deviation_section(&s))
        .sections(drawn.into_iter().flatten())
        .section(axis_section(s, series))
        .sections(temperature_section(&s))
        .section(minor_section(&s))
        .section(tool_section(&s))
        .sections(state_section(s.setup, s.summary))
        .sections(spindle_section(s.machine))
        .section(Section::new("Messages of the program").list(s.summary.messages.iter().cloned()))
        .section(diagnostic_section(s.run))
        .section(input_section(&s))
}

/// The result in a word and a sentence, the same for text, page and document.
pub(super) fn verdict(s: &Simulation<'_>) -> Verdict {
    let count = |n: u64, noun: &str| format!("{n} {noun}{}", if n == 1 { "" } else { "s" });
    let critical = s.issues.list.iter().filter(|t| t.critical).map(|t| t.stretches).sum::<u64>();
    let all = s.issues.found();
    let errors = s.run.problems.iter().filter(|d| d.severity == Severity::Error).count() as u64;
    let left_out = s.run.motion_left_out().count() as u64;
    let beyond = s.run.beyond_equipment().count() as u64;
    let (standing, word, sentence) = match (critical, all - critical) {
        _ if errors == 0 && left_out > 0 => {
            let functions = count(left_out, "function");
            let sentence = format!("{functions} of motion not executed: see the diagnostics");
            (Standing::Bad, "NOT COMPLETE", sentence)
        }
        _ if errors > 0 => {
            let sentence = format!("{} in the program", count(errors, "error"));
            (Standing::Bad, "NOT COMPLETE", sentence)
        }
        (0, _) if beyond > 0 => {
            let requests = count(beyond, "request");
            let sentence =
                format!("{requests} beyond spindle, magazine or tools: see the diagnostics");
            (Standing::Bad, "NOT POSSIBLE", sentence)
        }
        (0, 0) => {
            let sentence = "no issue found that endangers part or machine".to_owned();
            (Standing::Good, "NO ISSUES", sentence)
        }
        (0, slow) => {
            let sentence =
                format!("{} found, without danger for part and machine", count(slow, "issue"));
            (Standing::Open, "SLOWER", sentence)
        }
        (critical, _) if !s.setup.given => {
            let issues = count(critical, "critical issue");
            let sentence = format!(
                "work offsets and tool lengths count as 0, and {issues} found with that may not be those \
                 of the shop: state the set-up first"
            );
            (Standing::Open, "NO SET-UP", sentence)
        }
        (critical, slow) => {
            let also = if slow > 0 { format!(", and {slow} more") } else { String::new() };
            let sentence = format!("{}{also} found", count(critical, "critical issue"));
            (Standing::Bad, "CRITICAL", sentence)
        }
    };
    Verdict { standing, word: word.to_owned(), sentence }
}

fn summary_section(summary: &Summary) -> Section<'static> {
    let (all, rapid, dwell) = (summary.time_s, summary.rapid_s, summary.dwell_s);
    let (feed_mm, rapid_mm) = (summary.feed_mm, summary.rapid_mm);
    let mm = |v: f64| format!("{v:.1}");
    let table = Table::new(["", "with feed", "rapid", "waiting", "total"])
        .row([
            "time".to_owned(),
            clock(all - rapid - dwell),
            clock(rapid),
            clock(dwell),
            clock(all),
        ])
        .row([
            "path of the tip, mm".to_owned(),
            mm(feed_mm),
            mm(rapid_mm),
            String::new(),
            mm(feed_mm + rapid_mm),
        ]);
    let mut note = format!("{} moves, {} points of the path", summary.moves, summary.nodes);
    if let Some([low, high]) = summary.cut_box_mm {
        let range = |i: usize| format!("{} … {}", fixed(low[i], 3), fixed(high[i], 3));
        let (x, y, z) = (range(0), range(1), range(2));
        note += &format!("; with feed the tip reaches X {x}, Y {y}, Z {z} mm");
    }
    if summary.stops > 0 {
        note += &format!("; {} stops", summary.stops);
    }
    Section::new("Summary").table(table.note(note + "."))
}

fn deviation_section(s: &Simulation<'_>) -> Section<'static> {
    let section =
        Section::new("Largest deviation of the actual tool from the nominal one, with feed");
    if s.is_exact() {
        return section
            .paragraph("The machine file states no errors: the actual tool is the nominal one.");
    }
    let row = |name: &str, scale: f64, worst: &Worst| {
        let value = fixed(worst.value * scale, 2);
        [name.to_owned(), value, s.block(worst.origin), clock(worst.time_s)]
    };
    let summary = s.summary;
    let [feed, normal, binormal] = &summary.along_path;
    let rms = fixed(summary.feed_tip_rms_mm * 1e3, 2);
    let table = Table::new(["in the workpiece", "value", "at", "when"])
        .row(row("tip, µm", 1e3, &summary.feed_tip))
        .row(["tip, root mean square, µm".to_owned(), rms, String::new(), String::new()])
        .row(row("along the feed, µm", 1e3, feed))
        .row(row("along the normal, µm", 1e3, normal))
        .row(row("along the binormal, µm", 1e3, binormal))
        .row(row("tool axis, µrad", 1e6, &summary.feed_axis))
        .note(
            "The normal lies across the feed on the side of the tool axis, the binormal across both: \
             for an upright tool they are the height and the side of the cut.",
        );
    section.table(table)
}

fn path_section<'a>(s: Simulation<'a>, series: &'a Series) -> Section<'a> {
    let section = Section::new("Path of the tool tip in the workpiece");
    if series.points().len() < 2 {
        return section;
    }
    let worst =
        if s.summary.feed_tip.value > 0.0 { " The largest deviation is drawn on top." } else { "" };
    let note = format!(
        "Nominal path in the workpiece frame, all views at one scale. Rapid moves may leave the \
         picture.{worst}"
    );
    section.figure(Figure::new(note, || tool_path(series.points())))
}

fn deviation_curves<'a>(s: Simulation<'a>, series: &'a Series) -> Section<'a> {
    let section = Section::new("Deviation and speed over time");
    if s.summary.nodes == 0 {
        return section;
    }
    section
        .note(format!(
            "Deviation of the actual tool from the nominal one, in the workpiece, rapid moves included. \
             Each column shows the lowest and the highest value in its stretch of time. The speed is in \
             deg/min where only rotary axes move.{}",
            marks_note(&s)
        ))
        .figure(Figure::new("", move || curves(&s, series)))
}

fn axis_section<'a>(s: Simulation<'a>, series: Option<&'a Series>) -> Section<'a> {
    let mut positions =
        Table::new(["axis", "lowest", "highest", "unit", "travel", "path", "reversals"]);
    let mut speeds = Table::new(["axis", "fastest", "limit", "used", "as m/min", "at"]);
    for (i, of) in s.summary.axes.iter().enumerate() {
        let axis = &s.machine.axes()[i];
        let name = axis.name.to_string();
        if of.lowest > of.highest {
            positions.push([name, "does not move".to_owned()]);
            continue;
        }
        let digits = |v: f64| fixed(shown(s.machine, i, v), 3);
        let cells = [
            name,
            digits(of.lowest),
            digits(of.highest),
            unit(s.machine, i).to_owned(),
            travel(&s, i),
            format!("{:.1}", shown(s.machine, i, of.travelled)),
            of.reversals.to_string(),
        ];
        let inside = [of.lowest, of.highest].iter().all(|q| axis.travel.contains(*q));
        positions = if inside { positions.row(cells) } else { positions.bold_row(cells) };
        speeds = speed_row(&s, i, of, speeds);
    }
    let section = Section::new("Axes").table(positions).table(speeds);
    let Some(series) = series.filter(|_| s.summary.nodes > 0) else { return section };
    let pictures = axis_pictures(s, series);
    section.grid(Columns::One, pictures).note(format!(
        "Positions and speeds over time; ends of travel and speed limits are red lines where they come \
         into view.{}",
        marks_note(&s)
    ))
}

pub(super) fn travel(s: &Simulation<'_>, axis: usize) -> String {
    match s.machine.axes()[axis].travel {
        Travel::Between(a, b) => {
            let of = |v: f64| shown(s.machine, axis, v);
            format!("{:.0} … {:.0} {}", of(a), of(b), unit(s.machine, axis))
        }
        Travel::Unlimited => "unlimited".to_owned(),
        Travel::Unknown => "not stated".to_owned(),
    }
}

fn speed_row(s: &Simulation<'_>, index: usize, of: &AxisUse, speeds: Table) -> Table {
    let (axis, fastest) = (&s.machine.axes()[index], of.fastest.value.abs());
    let limit = axis.limits.velocity;
    let speed = |v: f64| format!("{:.2} {}/s", shown(s.machine, index, v), unit(s.machine, index));
    // As on the plates of machines.
    let per_minute = match (axis.kind, limit) {
        (AxisKind::Rotary, _) => String::new(),
        (AxisKind::Linear, None) => format!("{:.2}", fastest * 0.06),
        (AxisKind::Linear, Some(v)) => format!("{:.2} of {:.2}", fastest * 0.06, v * 0.06),
    };
    let cells = [
        axis.name.to_string(),
        speed(fastest),
        limit.map_or_else(|| "not stated".to_owned(), speed),
        limit.map_or_else(String::new, |v| format!("{:.0} %", 100.0 * fastest / v)),
        per_minute,
        if fastest > 0.0 { s.block(of.fastest.origin) } else { String::new() },
    ];
    match limit.is_some_and(|v| fastest > v * (1.0 + 1e-6)) {
        true => speeds.bold_row(cells),
        false => speeds.row(cells),
    }
}

fn temperature_section(s: &Simulation<'_>) -> Option<Section<'static>> {
    let drift = s.drift?;
    let run = drift.run();
    let (from_s, to_s) = (run.start_s, run.start_s + drift.time_s());
    let sensors = drift.sensors().into_iter().map(|sensor| {
        let (low, high) = (sensor.lowest_celsius, sensor.highest_celsius);
        [sensor.sensor, format!("{low:.2} … {high:.2}")]
    });
    let worst = &drift.tip;
    let mut found = format!(
        "Drift of the deviation of the tip since the start, with feed: {:.2} µm at most, at {}, {}; \
         {:.2} µm at the end.",
        worst.value * 1e3,
        s.block(worst.origin),
        clock(worst.time_s),
        drift.last_mm * 1e3
    );
    if drift.unknown > 0 {
        let points = drift.unknown;
        found +=
            &format!(" Not known at {points} points, because an error table ends before them.");
    }
    let log = run.log.file();
    let time = format!(
        "Log {log}, from {} to {} of its time ({from_s:.1} s to {to_s:.1} s).",
        clock(from_s),
        clock(to_s)
    );
    let table = Table::new(["sensor", "°C"]).rows(sensors);
    Some(Section::new("Temperatures").paragraph(time).table(table).paragraph(found))
}

/// A row of a table of issues.
fn issue_row(s: &Simulation<'_>, t: &Issue, also: &str) -> [String; 5] {
    let together = match t.stretches {
        n if n > 1 && also.is_empty() => {
            format!(" ({n} stretches put together, the worst of them)")
        }
        _ => String::new(),
    };
    [
        if t.critical { "critical" } else { "time" }.to_owned(),
        s.blocks(t),
        clock(t.from_s),
        clock(t.to_s - t.from_s),
        issue_text(s.machine, t) + also + &together,
    ]
}

fn issue_table() -> Table {
    Table::new(["", "block", "from", "for", "issue"])
}

/// Issues that cost time only.
fn minor_issues<'a>(s: &Simulation<'a>) -> Vec<&'a Issue> {
    s.issues.list.iter().filter(|t| !t.critical).collect()
}

/// Critical issues one by one, the others once for each kind.
fn issue_section(s: &Simulation<'_>) -> Section<'static> {
    let critical = || s.issues.list.iter().filter(|t| t.critical);
    let mut issues = issue_table().most_on_terminal(MOST_ON_TERMINAL);
    for issue in critical().take(MOST_ROWS) {
        issues = issues.bold_row(issue_row(s, issue, ""));
    }
    let minor = minor_issues(s);
    for (worst, count) in minor_kinds(&minor) {
        let also = match count {
            1 => String::new(),
            n => format!(" ({n} stretches, this is the worst)"),
        };
        issues.push(issue_row(s, worst, &also));
    }
    let left_out = critical().skip(MOST_ROWS).map(|t| t.stretches).sum::<u64>();
    let section = Section::new("Issues");
    match (issues.rows.is_empty(), left_out) {
        (true, _) => section.paragraph("None found."),
        (_, 0) => section.table(issues),
        (_, n) => section.table(issues.note(format!("… and {n} more of the same kinds."))),
    }
}

/// Every stretch of the issues that cost time, where their kinds do not list them all.
fn minor_section(s: &Simulation<'_>) -> Section<'static> {
    let section = Section::new("Issues that cost time, every stretch").on_page();
    let minor = minor_issues(s);
    if minor_kinds(&minor).len() == minor.len() {
        return section;
    }
    let table = issue_table().rows(minor.iter().take(MOST_ROWS).map(|t| issue_row(s, t, "")));
    section.table(match minor.len().saturating_sub(MOST_ROWS) {
        0 => table,
        more => table.note(format!("… and {more} more rows: `--format json` has them all.")),
    })
}

/// The worst issue of each kind and how many stretches of it there are, the worst first.
fn minor_kinds<'t>(minor: &[&'t Issue]) -> Vec<(&'t Issue, u64)> {
    let badness = |t: &Issue| (t.value - t.limit).abs();
    let mut kinds: Vec<(&Issue, u64)> = Vec::new();
    for issue in minor {
        match kinds.iter_mut().find(|(other, _)| other.kind == issue.kind) {
            Some((worst, count)) => {
                *count += issue.stretches;
                if badness(issue) >= badness(worst) {
                    *worst = issue;
                }
            }
            None => kinds.push((issue, issue.stretches)),
        }
    }
    kinds.sort_by(|a, b| badness(b.0).total_cmp(&badness(a.0)));
    kinds
}

fn tool_section(s: &Simulation<'_>) -> Section<'static> {
    let mm = |v: f64| fixed(v, 3);
    let row = |(number, moves): (&u32, &u64)| {
        let tool = s.setup.tools.get(number);
        [
            if *number == 0 { "none yet".to_owned() } else { format!("T{number}") },
            tool.map_or_else(|| "as in the machine file".to_owned(), |t| t.name.clone()),
            mm(-tool.map_or(s.machine.tip_mm(), |t| t.tip_mm).z),
            tool.and_then(|t| t.diameter_mm).map_or_else(String::new, mm),
            moves.to_string(),
        ]
    };
    let table = Table::new(["tool", "name", "length, mm", "diameter, mm", "number of moves"]);
    Section::new("Tools").table(table.rows(s.summary.tools.iter().take(MOST_ROWS).map(row)))
}

/// On the terminal the diagnostics stand above the answer.
fn diagnostic_section(run: &Run) -> Section<'static> {
    let row = |d: &Diagnostic| {
        let place = match d.place.line {
            0 => "whole".to_owned(),
            line => format!("{line}:{}", d.place.column),
        };
        [place, d.severity.to_string(), d.message.clone(), d.hint.clone()]
    };
    let table = Table::new(["place", "", "message", "hint"]);
    let table = table.rows(run.problems.iter().take(MOST_ROWS).map(row));
    Section::new("Notes on the program").on_page().table(table)
}

fn input_section(s: &Simulation<'_>) -> Section<'static> {
    let offsets: Vec<String> = s.setup.work_offsets.keys().map(ToString::to_string).collect();
    let offsets = if offsets.is_empty() { "none".to_owned() } else { offsets.join(", ") };
    let setup = match s.setup.given {
        true => format!("given: {} tools; work offsets {offsets}", s.setup.tools.len()),
        false => "none: work offsets and tool lengths are 0".to_owned(),
    };
    let called = s.run.programs.iter().skip(1).take(MOST_ROWS);
    let table = Table::pairs([("program", s.program)])
        .rows(called.map(|program| ["subprogram", program]))
        .rows([
            ["control", control_name(s.control)],
            ["set-up", &setup],
            ["machine", s.machine.name()],
            ["source of the machine", s.machine.source()],
            ["stated errors", &s.machine.stated_errors().len().to_string()],
        ])
        .rows(s.path_file.map(|path| ["path", path]));
    Section::new("Inputs").table(table)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn seconds_are_readable() {
        assert_eq!(clock(5.2), "5.20 s");
        assert_eq!(clock(245.2), "4 min 05.20 s");
        assert_eq!(clock(3725.0), "1 h 02 min 05.00 s");
    }
}
