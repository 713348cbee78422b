//! A compensated program, as text.

use crate::compensate::program::{Convention, ProgramOptions, Residual, Rewritten, Wrong};
use std::fmt::Write;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::AxisKind;
use trueaxis_report::numbers;

/// Everything that there is to tell.
#[derive(Debug, Clone, Copy)]
pub struct ProgramReport<'a> {
    /// The machine.
    pub machine: &'a Machine,
    /// The program as it was.
    pub program: &'a str,
    /// Where the compensated one is.
    pub output: &'a str,
    /// What was asked for.
    pub options: &'a ProgramOptions,
    /// What came of it.
    pub rewritten: &'a Rewritten,
}

/// One line of the table before and after: what, unit, before, after, and their lines.
pub(super) struct Row {
    pub name: &'static str,
    pub unit: &'static str,
    pub before: f64,
    pub after: f64,
    pub lines: [u32; 2],
}

impl ProgramReport<'_> {
    pub(super) fn rows(&self) -> [Row; 4] {
        let proof = &self.rewritten.proof;
        let row =
            |name, unit, scale: f64, of: fn(&Residual) -> crate::compensate::program::Largest| {
                let (before, after) = (of(&proof.before), of(&proof.after));
                Row {
                    name,
                    unit,
                    before: before.value * scale,
                    after: after.value * scale,
                    lines: [before.line, after.line],
                }
            };
        [
            row("tip at the ends of blocks", "µm", 1e3, |r| r.tip_end),
            row("tool axis at the ends of blocks", "µrad", 1e6, |r| r.axis_end),
            row("tip between them", "µm", 1e3, |r| r.tip),
            row("tool axis between them", "µrad", 1e6, |r| r.axis),
        ]
    }

    pub(super) fn unit(&self, axis: usize) -> (f64, &'static str) {
        match self.machine.axes()[axis].kind {
            AxisKind::Linear => (1e3, "µm"),
            AxisKind::Rotary => (1e6, "µrad"),
        }
    }

    pub(super) fn axis_name(&self, axis: usize) -> String {
        self.machine.axes()[axis].name.to_string()
    }

    pub(super) fn rounding(&self) -> String {
        match self.options.increments {
            Some(i) => {
                let [um, deg] = [i.linear_mm * 1e3, i.rotary_deg].map(numbers::rounded);
                format!("rounded to {um} µm and {deg} deg")
            }
            None => "not rounded".to_owned(),
        }
    }

    /// What a reader of the numbers should know.
    pub(super) fn remarks(&self) -> Vec<String> {
        let found = &self.rewritten.found;
        let mut remarks = Vec::new();
        let mut say = |count: u64, text: String| {
            if count > 0 {
                remarks.push(text);
            }
        };
        say(
            found.circles,
            format!("{} circles became straight pieces within the residual", found.circles),
        );
        say(
            found.words_added,
            format!("{} words were added where a block did not name an axis", found.words_added),
        );
        let n = found.feeds_changed;
        say(
            n,
            format!(
                "{n} blocks that only turn rotary axes have another F, so that they take the same time"
            ),
        );
        let n = found.undecided;
        say(
            n,
            format!(
                "at {n} places an axis reverses by less than its reversal error: this is not compensated"
            ),
        );
        for (why, count) in &found.left {
            remarks.push(format!("{count} blocks are left as they were: {why}"));
        }
        for (why, count) in &found.axis_left {
            remarks.push(format!("at {count} places the tool axis keeps its deviation: {why}"));
        }
        for (i, largest) in found.largest.iter().enumerate() {
            let near = match self.machine.axes()[i].kind {
                AxisKind::Linear => 1.0,
                AxisKind::Rotary => 1e-3,
            };
            if largest.to_travel_end < near {
                let (name, line) = (self.axis_name(i), largest.nearest_line);
                remarks.push(format!("{name} comes to the end of its travel at line {line}"));
            }
        }
        let confidence = &self.rewritten.confidence;
        if confidence.weaker > 0 {
            remarks.push(format!(
                "at {} of {} places the correction of the tip is smaller than its own standard \
                 uncertainty: there it tells nothing",
                confidence.weaker, confidence.looked_at
            ));
        }
        if confidence.looked_at > 0 && confidence.largest_u_mm == 0.0 {
            remarks.push(
                "the machine file states no uncertainties: those of the corrections are not known"
                    .into(),
            );
        }
        remarks
    }

    /// What no correction and wrong signs would leave: name, tip in µm, tool axis in µrad.
    pub(super) fn conventions(&self) -> Vec<(String, f64, f64)> {
        let name = |c: &Convention| match c.what {
            Wrong::NoCorrection => "no correction".to_owned(),
            Wrong::AllSigns => "all signs wrong".to_owned(),
            Wrong::SignOf(axis) => format!("sign of {} wrong", self.axis_name(axis)),
        };
        let rows = self.rewritten.conventions.iter();
        rows.map(|c| (name(c), c.tip_mm * 1e3, c.axis_rad * 1e6)).collect()
    }
}

/// As text.
pub fn program_text(r: &ProgramReport<'_>) -> String {
    let mut text = String::new();
    let found = &r.rewritten.found;
    // Writing to a String cannot fail.
    let _ = writeln!(
        text,
        "{} on {}: {} blocks -> {} ({} split), {}, written to {}\n",
        r.program,
        r.machine.name(),
        found.blocks,
        found.pieces,
        found.split,
        r.rounding(),
        r.output
    );
    let _ = writeln!(text, "read back and simulated on the actual machine, largest deviation:");
    let _ = writeln!(text, "{:36} {:>12} {:>14}   at line", "", "before", "after");
    for row in r.rows() {
        let (before, after) = (number(row.before), number(row.after));
        let _ = writeln!(
            text,
            "  {:34} {before:>12} {after:>14} {:4} {}, {}",
            row.name, row.unit, row.lines[0], row.lines[1]
        );
    }
    let c = &r.rewritten.confidence;
    if c.largest_u_mm > 0.0 {
        let u = number(c.largest_u_mm * 1e3);
        let _ = writeln!(
            text,
            "  {:34} {u:>12}                µm   (k = 1)",
            "standard uncertainty of the tip"
        );
    }
    let _ = writeln!(text, "\nlargest correction of each axis:");
    for (i, largest) in found.largest.iter().enumerate() {
        let (scale, unit) = r.unit(i);
        let value = format!("{:+.3}", largest.value * scale);
        let _ =
            writeln!(text, "  {:2} {value:>12} {unit:4} at line {}", r.axis_name(i), largest.line);
    }
    let change = found.length_change * 1e6;
    let _ = writeln!(
        text,
        "\nfeed kept; the way of the tip in a block changes by up to {change:+.1} µm/m"
    );
    let rows = r.conventions();
    if !rows.is_empty() {
        let _ = writeln!(text, "\nconvention check at the block with the largest correction:");
    }
    for (name, tip, axis) in rows {
        let _ = writeln!(text, "  {name:20} leaves {tip:10.3} µm and {axis:10.3} µrad");
    }
    for remark in r.remarks() {
        let _ = writeln!(text, "note: {remark}");
    }
    text
}

/// Small numbers keep their digits.
pub(super) fn number(value: f64) -> String {
    match value.abs() {
        a if a == 0.0 || a >= 1e-3 => format!("{value:.3}"),
        _ => format!("{value:.1e}"),
    }
}
