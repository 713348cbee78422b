//! A compensated program, in text and on a page.

use crate::compensate::program::{
    Convention, Expression, ProgramOptions, Residual, Rewritten, Wrong,
};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::AxisKind;
use trueaxis_report::{Report, Section, Standing, Table, numbers};

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
struct Row {
    name: &'static str,
    unit: &'static str,
    before: f64,
    after: f64,
    lines: [u32; 2],
}

impl ProgramReport<'_> {
    fn rows(&self) -> [Row; 4] {
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

    fn rounding(&self) -> String {
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
        if let Some((line, axis)) = found.additions.first() {
            remarks.push(format!("the first added word is {axis} at line {line}"));
        }
        if let Some(first) = found.expressions.first() {
            remarks.push(format!(
                "{} computed words have their correction added: it is that of this run, also if a parameter has \
                 another value in the next one; blocks that this run did not execute have none",
                found.expressions_corrected
            ));
            let Expression { line, was, is } = first;
            remarks.push(format!("the first of them is {was} at line {line}, now {is}"));
        }
        if let Some(line) = found.begins_elsewhere.first() {
            let count = found.begins_elsewhere.len();
            remarks.push(format!(
                "{count} cuts begin where no corrected word leads (the first at line {line}): their way from there to their \
                 corrected end is not part of the proof"
            ));
        }
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

/// The answer in text and on a page.
pub fn program_report<'a>(r: &ProgramReport<'a>) -> Report<'a> {
    let proof = &r.rewritten.proof;
    let tip_um = |of: &Residual| number(of.tip_end.value * 1e3);
    let sentence = format!(
        "the tip misses its block ends by up to {} µm instead of {} µm, and is within {} µm of its path \
         between them",
        tip_um(&proof.after),
        tip_um(&proof.before),
        number(proof.after.tip.value * 1e3)
    );
    let (standing, verdict) = match r.rewritten.is_proved() {
        true => (Standing::Good, "PROVED"),
        false => (Standing::Bad, "NOT PROVED"),
    };
    Report::new(format!("{} compensated for {}", r.program, r.machine.name()))
        .line(format!("{}, written to {}, {}", r.machine.chain_text(), r.output, r.rounding()))
        .verdict(standing, verdict, sentence)
        .section(deviations(r))
        .section(work(r))
        .section(corrections(r))
        .section(worst(r))
        .section(conventions(r))
}

fn deviations<'a>(r: &ProgramReport<'_>) -> Section<'a> {
    let rows = r.rows().map(|row| {
        let [before_line, after_line] = row.lines.map(|line| line.to_string());
        let (before, after) = (number(row.before), number(row.after));
        [row.name.to_owned(), row.unit.to_owned(), before, before_line, after, after_line]
    });
    let confidence = &r.rewritten.confidence;
    let u = match confidence.largest_u_mm > 0.0 {
        true => format!(
            " Standard uncertainty of the tip by the model: {} µm (k = 1) at the worst of {} places.",
            number(confidence.largest_u_mm * 1e3),
            confidence.looked_at
        ),
        false => String::new(),
    };
    let note = format!(
        "The written program, read back and simulated on the actual machine, against the program as it was \
         on the nominal machine. Lines are those of the program as it was.{u}"
    );
    let table = Table::new(["largest deviation", "unit", "before", "at line", "after", "at line"]);
    Section::new("Deviation of the actual tool, before and after")
        .table(table.rows(rows).note(note))
}

fn work<'a>(r: &ProgramReport<'_>) -> Section<'a> {
    let found = &r.rewritten.found;
    let counts = [
        ("blocks that move the tool", found.blocks),
        ("of these divided into several", found.split),
        ("blocks written for them", found.pieces),
        ("circles that became lines", found.circles),
        ("words added", found.words_added),
        ("computed words corrected", found.expressions_corrected),
        ("feeds changed where only rotary axes turn", found.feeds_changed),
    ];
    let change = format!(
        "The feed is kept; the path length of the tip in a block changes by up to {:+.1} µm/m.",
        found.length_change * 1e6
    );
    let counts = counts.map(|(name, count)| (name, count.to_string()));
    Section::new("Changes").table(Table::pairs(counts)).paragraph(change).list(r.remarks())
}

fn corrections<'a>(r: &ProgramReport<'_>) -> Section<'a> {
    let rows = r.rewritten.found.largest.iter().enumerate().map(|(i, largest)| {
        let (scale, unit) = r.unit(i);
        let value = format!("{:+.3}", largest.value * scale);
        [r.axis_name(i), value, unit.to_owned(), largest.line.to_string()]
    });
    let table = Table::new(["axis", "correction", "unit", "at line"]).rows(rows);
    Section::new("Largest correction of each axis").table(table)
}

fn worst<'a>(r: &ProgramReport<'_>) -> Section<'a> {
    let rows = r.rewritten.proof.worst.iter().map(|block| {
        let [before, after] = [block.tip_before_mm, block.tip_after_mm].map(|v| number(v * 1e3));
        let [from, to] = [block.axis_before_rad, block.axis_after_rad].map(|v| number(v * 1e6));
        [block.line.to_string(), before, after, from, to]
    });
    let headings = [
        "line",
        "tip before, µm",
        "tip after, µm",
        "tool axis before, µrad",
        "tool axis after, µrad",
    ];
    Section::new("Blocks with the largest residual deviation")
        .on_page()
        .table(Table::new(headings).rows(rows))
}

fn conventions<'a>(r: &ProgramReport<'_>) -> Section<'a> {
    let rows =
        r.conventions().into_iter().map(|(name, tip, axis)| [name, number(tip), number(axis)]);
    let note = "What would be left at the block with the largest correction without any, and if the control \
                took it with a wrong sign: a wrong sign makes it about twice as bad as no correction. Try \
                one pose on the machine before the first part.";
    let table = Table::new(["", "tip, µm", "tool axis, µrad"]).rows(rows).note(note);
    Section::new("Convention check").table(table)
}

/// Small numbers keep their digits.
fn number(value: f64) -> String {
    match value.abs() {
        a if a == 0.0 || a >= 1e-3 => format!("{value:.3}"),
        _ => format!("{value:.1e}"),
    }
}
