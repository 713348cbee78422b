//! Tool setting in text and on a page: the plan with its program, and what was measured.

use super::surface::issues;
use crate::identify::tool_setting::{MeasuredTool, ToolReadings, setup_lines};
use crate::plan::program::ProgramCheck;
use crate::plan::tool_setting::{SetTool, ToolSetting};
use trueaxis_motion::MeasuredSize;
use trueaxis_report::{Report, Section, Standing, Table};

/// The touches with what the check of their program says.
pub fn setting_report<'a>(setting: &ToolSetting, check: &ProgramCheck) -> Report<'a> {
    let setter = &setting.setter;
    let spindle = match setter.speed_per_minute {
        Some(speed) => format!("turns with {speed:.0} 1/min against its cutting sense"),
        None => "stands still".to_owned(),
    };
    let row = |(k, tool): (usize, &SetTool)| {
        let touches = setting.touches.iter().filter(|t| t.tool == k).count();
        let mm = |v: Option<f64>| {
            v.map_or_else(|| "not stated".to_owned(), |v| format!("{:.1}", v * 1e3))
        };
        [
            format!("T{}", tool.number),
            if tool.is_reference { "gauge".to_owned() } else { tool.name.clone() },
            format!("{:.4}", setting.expected_length_mm(tool)),
            tool.diameter_mm
                .filter(|_| touches > 1)
                .map_or_else(String::new, |d| format!("{d:.4}")),
            touches.to_string(),
            mm(tool.state.breakage_mm),
            mm(tool.state.wear_length_mm),
            mm(tool.state.wear_radius_mm),
        ]
    };
    let table = Table::new([
        "tool",
        "",
        "length, mm",
        "diameter, mm",
        "touches",
        "breakage, µm",
        "wear of length, µm",
        "wear of radius, µm",
    ]);
    let report = Report::new("Tool setting")
        .line(format!("{} tools on {}", setting.tools.len(), setting.machine.name()))
        .line(format!(
            "setter: face at X {} Y {} Z {}, cylinder {} mm; the spindle {spindle}",
            setter.at_mm.x, setter.at_mm.y, setter.at_mm.z, setter.diameter_mm[0]
        ))
        .line(format!("{:.1} min", check.duration_s / 60.0));
    let report = match check.is_sound() {
        true => report.verdict(Standing::Good, "SAFE", "nothing is in its way"),
        false => report.verdict(Standing::Bad, "NOT SAFE", "not to be run"),
    };
    report
        .section(Section::new("Tools").table(table.rows(setting.tools.iter().enumerate().map(row))))
        .section(
            Section::new("Check of the program")
                .list(issues(check))
                .paragraph("The setter itself is no body of the check: the tools touch it."),
        )
}

/// What was measured.
pub fn tools_report<'a>(readings: &ToolReadings) -> Report<'a> {
    let unfit = readings.tools.iter().filter(|t| !t.standing.is_fit()).count();
    let row = |t: &MeasuredTool| {
        let size = |s: &MeasuredSize| [format!("{:.4}", s.mm), format!("{:.1}", 2e3 * s.u_mm)];
        let [length, of_length] = size(&t.length);
        let [diameter, of_diameter] = t.diameter.as_ref().map_or_else(Default::default, size);
        let wear = format!("{:+.1}", (t.length.mm - t.nominal_mm) * 1e3);
        let radius = t.standing.radius_off_mm.filter(|_| t.diameter.is_some());
        let radius = radius.map_or_else(String::new, |[d, _]| format!("{:+.1}", d * 1e3));
        let word = t.standing.word().to_owned();
        [format!("T{}", t.number), word, length, of_length, wear, diameter, of_diameter, radius]
    };
    let table = Table::new([
        "tool",
        "state",
        "length, mm",
        "U (k = 2), µm",
        "− nominal, µm",
        "diameter, mm",
        "U (k = 2), µm",
        "radius − nominal, µm",
    ]);
    let faults = readings.tools.iter().flat_map(|t| {
        t.standing.faults.iter().map(|(_, words)| format!("tool {}: {words}", t.number))
    });
    let doubts = readings.tools.iter().flat_map(|t| {
        t.standing.doubts.iter().map(|words| format!("tool {}, not decided: {words}", t.number))
    });
    let mut report = Report::new("Measured tools");
    if readings.is_virtual {
        report = report.line("a virtual machine wrote the log");
    }
    let report = match unfit {
        0 => report.verdict(Standing::Good, "FIT", "no tool is beyond its limits"),
        n => report.verdict(Standing::Bad, "NOT FIT", format!("{n} of them to be replaced")),
    };
    let drift = match &readings.drift {
        Some(d) => format!(
            "Gauge: spindle and setter have drifted by {:+.1} µm (U = {:.1} µm, k = 2) since the face was calibrated; \
             the lengths are corrected by it.",
            d.mm * 1e3,
            2e3 * d.u_mm
        ),
        None => "No gauge was measured: drift of spindle and setter is not corrected.".to_owned(),
    };
    report
        .section(
            Section::new("Tools")
                .table(table.rows(readings.tools.iter().map(row)))
                .list(faults.chain(doubts)),
        )
        .section(Section::new("Drift").paragraph(drift).list(readings.missing.iter().cloned()))
        .section(
            Section::new("For the set-up file")
                .list(setup_lines(readings, None).lines().map(str::to_owned)),
        )
}
