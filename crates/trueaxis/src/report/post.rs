//! An NC program from cutter locations.

use std::path::Path;
use trueaxis_machine::Machine;
use trueaxis_post::{Largest, PostOptions, Posted, Verification};
use trueaxis_report::{Report, Section, Standing, Table};

/// A program with what it was made from.
#[derive(Debug, Clone, Copy)]
pub struct PostReport<'a> {
    /// The machine that it is for.
    pub machine: &'a Machine,
    /// The file of the cutter locations.
    pub file: &'a str,
    /// How many points it has.
    pub points: usize,
    /// How it was written.
    pub options: &'a PostOptions,
    /// The program.
    pub posted: &'a Posted,
    /// The program read back and simulated, if that was asked for.
    pub verification: Option<&'a Verification>,
    /// Words of the file that can change motion, spindle or coolant and are not applied.
    pub not_applied: usize,
    /// Its file.
    pub output: &'a Path,
}

impl PostReport<'_> {
    /// Whether nothing is known against the program.
    pub fn is_sound(&self) -> bool {
        self.verification.is_none_or(|v| v.is_within(self.options))
    }
}

/// A program as text and page.
pub fn post_report(report: &PostReport<'_>) -> Report<'static> {
    let PostReport { points, posted, verification, output, .. } = report;
    let mut answer = Report::new(format!(
        "{points} points -> {} blocks in {} lines, {} {}",
        posted.blocks,
        posted.lines,
        if report.is_sound() { "written to" } else { "not written to" },
        output.display()
    ));
    let count =
        |n: usize, one: &str, many: &str| format!("{n} {}", if n == 1 { one } else { many });
    if posted.arcs + posted.holes() > 0 {
        let arcs = count(posted.arcs, "arc", "arcs");
        let holes = count(posted.holes(), "hole drilled by a cycle", "holes drilled by cycles");
        answer = answer.line(format!("{arcs}, {holes} of the control"));
    }
    if posted.rewinds > 0 {
        answer = answer
            .line(format!("the tool retracts {} times for an axis to rewind", posted.rewinds));
    }
    if posted.pole_deviation_rad > 0.0 {
        let degrees = posted.pole_deviation_rad.to_degrees();
        let line = format!("to pass a pole the tool axis was turned by up to {degrees:.6} deg");
        answer = answer.line(line);
    }
    let words = count(report.not_applied, "word", "words");
    let Some(found) = verification else {
        return match report.not_applied {
            0 => answer,
            _ => answer.verdict(Standing::Open, "NOT APPLIED", format!("{words}, listed above")),
        };
    };
    let answer = match (report.is_sound(), report.not_applied) {
        (false, _) => {
            answer.verdict(Standing::Bad, "FAIL", "the program is not within the tolerances")
        }
        (true, 0) => answer.verdict(Standing::Good, "PASS", "the program is within the tolerances"),
        (true, _) => {
            let sentence = format!("as the CL file; NOT APPLIED: {words}, listed above");
            answer.verdict(Standing::Open, "PATH", sentence)
        }
    };
    answer.section(comparison(found, report.options, posted.threads()))
}

fn comparison(found: &Verification, options: &PostOptions, threads: usize) -> Section<'static> {
    let mut table =
        Table::new(["", "largest", "unit", "allowed", "line of program", "line of file"]);
    let mut row = |name: &str, unit: &str, l: &Largest, scale: f64, allowed: String, digits| {
        let value = format!("{:.digits$}", l.value * scale);
        let lines = [l.program_line, l.file_line].map(|line| line.to_string());
        let [program, file] = lines;
        table.push([name.to_owned(), value, unit.to_owned(), allowed, program, file]);
    };
    let degrees = 1_f64.to_degrees();
    let tip = format!("{:.4}", options.tolerance_mm * 1e3);
    let axis = format!("{:.5}", options.axis_tolerance_rad.to_degrees());
    row("tip at the ends of blocks", "µm", &found.tip_at_ends, 1e3, String::new(), 4);
    row("tool axis at the ends of blocks", "µrad", &found.axis_at_ends, 1e6, String::new(), 4);
    row("tip from the path", "µm", &found.tip_between, 1e3, tip.clone(), 4);
    row("tool axis from the path", "deg", &found.axis_between, degrees, axis, 5);
    if threads > 0 {
        row("lead of threads over their depth", "µm", &found.lead, 1e3, tip, 4);
    }
    let note = format!("{} blocks compared", found.compared);
    Section::new("Read back and simulated on the nominal machine").table(table.note(note))
}
