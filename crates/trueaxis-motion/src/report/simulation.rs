//! A simulation for people and for programs.

use crate::{
    Drift, Findings, Job, Run, SetUp, Summary, Trouble, TroubleKind, TroubleList, Worst,
    limit_name, shown, unit,
};
use std::fmt::Write as _;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::Travel;
use trueaxis_nc::Control;
use trueaxis_nc::moves::Origin;

/// Everything that a report of a simulation shows.
pub struct Simulation<'a> {
    /// The machine.
    pub machine: &'a Machine,
    /// The program file.
    pub program: &'a str,
    /// Whose program it is.
    pub control: Control,
    /// What stood on the machine.
    pub setup: &'a SetUp,
    /// How it ended.
    pub run: &'a Run,
    /// What it comes to.
    pub summary: &'a Summary,
    /// What went wrong.
    pub troubles: &'a TroubleList,
    /// The file of the path, if one was written.
    pub path_file: Option<&'a str>,
    /// What changing temperatures did, where they followed a log.
    pub drift: Option<&'a Drift>,
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
            troubles: &found.troubles,
            path_file: None,
            drift: found.drift.as_ref(),
        }
    }
}

/// Troubles that the terminal lists.
const MOST_SHOWN: usize = 20;

/// Kinds of troubles that only cost time, in the terminal.
const MOST_MINOR: usize = 6;

pub(super) fn control_name(control: Control) -> &'static str {
    match control {
        Control::Sinumerik840d => "SINUMERIK 840D",
        Control::Fanuc => "FANUC",
        Control::LinuxCnc => "LinuxCNC",
        Control::Heidenhain => "HEIDENHAIN",
    }
}

impl Simulation<'_> {
    /// The block as people name it: `line 12`, with the program where it is not the main one.
    pub fn block(&self, origin: Origin) -> String {
        match (origin.program, self.run.programs.get(origin.program as usize)) {
            (0, _) | (_, None) => format!("line {}", origin.line),
            (_, Some(program)) => format!("{program}:{}", origin.line),
        }
    }
}

/// What went wrong, in one sentence with its figures.
pub fn trouble_text(machine: &Machine, trouble: &Trouble) -> String {
    let name = |axis: usize| machine.axes()[axis].name;
    let value =
        |axis: usize, v: f64| format!("{:.3} {}", shown(machine, axis, v), unit(machine, axis));
    match &trouble.kind {
        TroubleKind::Collision { first, second } => {
            format!("collision: {first} cuts into {second}, clearance 0 mm")
        }
        TroubleKind::NearMiss { first, second } => {
            format!("near miss: {first} comes to {:.3} mm of {second}", trouble.value)
        }
        TroubleKind::RapidInStock { first, second } => {
            format!("rapid through stock: {first} in {second}, clearance 0 mm")
        }
        TroubleKind::OverTravel { axis } => format!(
            "over-travel: {} goes to {}, its end is {}",
            name(*axis),
            value(*axis, trouble.value),
            value(*axis, trouble.limit)
        ),
        TroubleKind::OverSpeed { axis, near_pole } => format!(
            "over-speed: the feed asks {} for {}/s, it has {}/s{}; the control slows down",
            name(*axis),
            value(*axis, trouble.value),
            value(*axis, trouble.limit),
            if *near_pole { " (near a pole of the rotary axes)" } else { "" }
        ),
        TroubleKind::SlowedDown { axis, limit } => {
            let limit = limit_name(*limit);
            let held = 100.0 * trouble.value;
            format!("feed not held: {held:.1} % of it, because of the {limit} of {}", name(*axis))
        }
        TroubleKind::RotaryFlip { axis } => format!(
            "flip: {} turns by {} while the tool turns by {:.3} deg",
            name(*axis),
            value(*axis, trouble.value),
            trouble.limit.to_degrees()
        ),
    }
}

/// The code of a trouble in JSON.
pub fn trouble_code(kind: &TroubleKind) -> &'static str {
    match kind {
        TroubleKind::Collision { .. } => "collision",
        TroubleKind::NearMiss { .. } => "near-miss",
        TroubleKind::RapidInStock { .. } => "rapid-in-stock",
        TroubleKind::OverTravel { .. } => "over-travel",
        TroubleKind::OverSpeed { .. } => "over-speed",
        TroubleKind::SlowedDown { .. } => "slowed-down",
        TroubleKind::RotaryFlip { .. } => "rotary-flip",
    }
}

/// The simulation as the terminal shows it.
pub fn simulation_text(s: &Simulation<'_>) -> String {
    let mut out = String::new();
    // Writing into a text cannot fail.
    let _ = write_text(s, &mut out);
    out
}

fn write_text(s: &Simulation<'_>, out: &mut String) -> std::fmt::Result {
    let (summary, machine) = (s.summary, s.machine);
    writeln!(out, "{} on {}", s.program, machine.name())?;
    writeln!(out, "  {}    {}\n", machine.chain_text(), control_name(s.control))?;
    writeln!(
        out,
        "  time      {}   ({} with feed, {} rapid, {} waiting)",
        clock(summary.time_s),
        clock(summary.time_s - summary.rapid_s - summary.dwell_s),
        clock(summary.rapid_s),
        clock(summary.dwell_s)
    )?;
    writeln!(
        out,
        "  way       {:.1} mm with feed, {:.1} mm rapid   ({} moves, {} places)",
        summary.feed_mm, summary.rapid_mm, summary.moves, summary.nodes
    )?;
    if let Some([low, high]) = summary.cut_box_mm {
        writeln!(
            out,
            "  tip       X {} … {}   Y {} … {}   Z {} … {} mm, with feed",
            fixed(low.x, 3),
            fixed(high.x, 3),
            fixed(low.y, 3),
            fixed(high.y, 3),
            fixed(low.z, 3),
            fixed(high.z, 3)
        )?;
    }
    writeln!(
        out,
        "\n  axis        lowest      highest         travel          fastest    reversals"
    )?;
    for (i, axis) in summary.axes.iter().enumerate() {
        if axis.lowest > axis.highest {
            continue;
        }
        let limits = match machine.axes()[i].travel {
            Travel::Between(a, b) => {
                format!("{:.0} … {:.0}", shown(machine, i, a), shown(machine, i, b))
            }
            Travel::Unlimited => "without end".to_owned(),
            Travel::Unknown => "not stated".to_owned(),
        };
        writeln!(
            out,
            "  {:<4} {:>12} {:>12} {:>3} {:>16} {:>10.2} {:>3}/s {:>8}",
            machine.axes()[i].name.to_string(),
            fixed(shown(machine, i, axis.lowest), 3),
            fixed(shown(machine, i, axis.highest), 3),
            unit(machine, i),
            limits,
            shown(machine, i, axis.fastest.value.abs()),
            unit(machine, i),
            axis.reversals
        )?;
    }
    if machine.stated_errors().is_empty() && !machine.is_at_temperatures() {
        writeln!(out, "\n  the machine file states no errors: the actual tool is the nominal one")?;
        return write_end(s, out);
    }
    writeln!(out, "\n  deviation of the actual tool from the nominal one, with feed")?;
    let at = |w: &Worst| format!("{}, {}", s.block(w.origin), clock(w.time_s));
    writeln!(
        out,
        "  tip         {:>9.2} µm   at {}   ({:.2} µm rms)",
        summary.feed_tip.value * 1e3,
        at(&summary.feed_tip),
        summary.feed_tip_rms_mm * 1e3
    )?;
    for (name, worst) in ["feed", "normal", "binormal"].iter().zip(&summary.along_path) {
        writeln!(out, "  {name:<11} {:>9.2} µm   at {}", worst.value * 1e3, at(worst))?;
    }
    let axis = &summary.feed_axis;
    writeln!(out, "  tool axis   {:>9.2} µrad at {}", axis.value * 1e6, at(axis))?;
    write_end(s, out)
}

fn write_end(s: &Simulation<'_>, out: &mut String) -> std::fmt::Result {
    if let Some(drift) = s.drift {
        write_drift(s, drift, out)?;
    }
    write_troubles(s, out)?;
    if let Some(path) = s.path_file {
        writeln!(out, "\n  path: {path}")?;
    }
    Ok(())
}

fn write_drift(s: &Simulation<'_>, drift: &Drift, out: &mut String) -> std::fmt::Result {
    let run = drift.run();
    let (from_s, to_s) = (run.start_s, run.start_s + drift.time_s());
    writeln!(
        out,
        "\n  temperatures of {}, from {} to {} of its time",
        run.log.file(),
        clock(from_s),
        clock(to_s)
    )?;
    for sensor in drift.sensors() {
        let (low, high) = (sensor.lowest_celsius, sensor.highest_celsius);
        writeln!(out, "  {:<15} {low:>7.2} … {high:.2} °C", sensor.sensor)?;
    }
    let worst = &drift.tip;
    writeln!(
        out,
        "  drift of the deviation since the start: {:.2} µm at the most, at {}, {}; {:.2} µm at the end",
        worst.value * 1e3,
        s.block(worst.origin),
        clock(worst.time_s),
        drift.last_mm * 1e3
    )?;
    if drift.unknown > 0 {
        let places = drift.unknown;
        writeln!(out, "  not known at {places} places, since an error table ends before them")?;
    }
    Ok(())
}

fn write_troubles(s: &Simulation<'_>, out: &mut String) -> std::fmt::Result {
    let list = &s.troubles.list;
    if list.is_empty() {
        return writeln!(out, "\n  no trouble found");
    }
    let count = list.len() as u64 + s.troubles.left_out;
    writeln!(out, "\n  {count} trouble{} found", if count == 1 { "" } else { "s" })?;
    let grave: Vec<&Trouble> = list.iter().filter(|t| t.grave).collect();
    for trouble in grave.iter().take(MOST_SHOWN) {
        let text = trouble_text(s.machine, trouble);
        writeln!(out, "  ! {}  {}  {text}", clock(trouble.from_s), blocks(s, trouble))?;
    }
    if grave.len() > MOST_SHOWN {
        let hidden = grave.len() - MOST_SHOWN;
        writeln!(out, "    … and {hidden} more; --format json and the report have them")?;
    }
    write_minor(s, out)
}

/// What costs only time: one line for each kind, with its worst place.
fn write_minor(s: &Simulation<'_>, out: &mut String) -> std::fmt::Result {
    let mut kinds: Vec<(&TroubleKind, Vec<&Trouble>)> = Vec::new();
    for trouble in s.troubles.list.iter().filter(|t| !t.grave) {
        match kinds.iter_mut().find(|(kind, _)| **kind == trouble.kind) {
            Some((_, all)) => all.push(trouble),
            None => kinds.push((&trouble.kind, vec![trouble])),
        }
    }
    let badness = |t: &Trouble| (t.value - t.limit).abs();
    let worst_of = |all: &[&Trouble]| all.iter().map(|t| badness(t)).fold(0.0, f64::max);
    kinds.sort_by(|a, b| worst_of(&b.1).total_cmp(&worst_of(&a.1)));
    let hidden = kinds.len().saturating_sub(MOST_MINOR);
    for (_, all) in kinds.into_iter().take(MOST_MINOR) {
        let Some(worst) = all.iter().max_by(|a, b| badness(a).total_cmp(&badness(b))) else {
            continue;
        };
        let times = match all.len() {
            1 => String::new(),
            n => format!("   ({n} stretches, this is the worst)"),
        };
        let text = trouble_text(s.machine, worst);
        writeln!(out, "  · {}  {}  {text}{times}", clock(worst.from_s), blocks(s, worst))?;
    }
    if hidden > 0 {
        writeln!(out, "    … and {hidden} more kinds; --format json and the report have them")?;
    }
    Ok(())
}

/// From which block to which.
pub(super) fn blocks(s: &Simulation<'_>, trouble: &Trouble) -> String {
    match trouble.first == trouble.last {
        true => s.block(trouble.first),
        false => format!("{} to {}", s.block(trouble.first), s.block(trouble.last)),
    }
}

/// A number with so many decimals, without a minus before a zero.
fn fixed(value: f64, digits: usize) -> String {
    let text = format!("{value:.digits$}");
    let zero = text.trim_start_matches(['-', '0', '.']).is_empty();
    if zero { text.trim_start_matches('-').to_owned() } else { text }
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
